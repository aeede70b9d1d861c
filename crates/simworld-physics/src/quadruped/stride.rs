//! How the legs of a quadruped swing that is led over the ground: a trot by the way that it goes, for whoever draws it.
//!
//! Feet stay where they stand while they bear and swing to where they bear next, two at a time across; each leg reaches its foot
//! by its closed form. Nothing of it moves the body.

use serde::{Deserialize, Serialize};
use simworld_core::geometry::{Pose, Vector2, Vector3, planar};
use simworld_core::ops;

use super::Quadruped;
use super::articulation::PerJoint;
use crate::humanoid::Posture;

/// What goes less far than this in a substep stands, m.
const STILL: f64 = 1e-5;
/// A cycle of two steps is no shorter and no longer than this, in lengths of a leg.
const CYCLE: [f64; 2] = [0.25, 1.4];
/// The share of the cycle at which each leg comes down: those across from one another together.
const TROT: [f64; 4] = [0.0, 0.5, 0.5, 0.0];

/// Where it is in its stride.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Stride {
    /// The share of the cycle that has passed.
    phase: f64,
    /// From a foot's coming down to its next, as seen from the body, m; none while it stands.
    cycle: Option<Vector2>,
}

impl Quadruped {
    /// Goes on in its stride by the way from where it was before.
    pub(super) fn stride_from(&mut self, before: &Pose) {
        let way = planar(&self.state.pose) - planar(before);
        let length = way.norm();
        if length < STILL || self.cheap.posture() != Posture::Standing {
            self.motion.stride.cycle = None;
            return;
        }
        let ahead = self.state.pose.rotation.inverse() * Vector3::new(way.x, way.y, 0.0);
        let speed = self.state.twist.linear.xy().norm();
        let leg = self.config.model.thigh + self.config.model.shank;
        let cycle = (speed / self.config.gait.frequency).clamp(CYCLE[0] * leg, CYCLE[1] * leg);
        let stride = &mut self.motion.stride;
        stride.phase = (stride.phase + length / cycle).fract();
        stride.cycle = ahead.xy().try_normalize(1e-12).map(|ahead| ahead * cycle);
    }

    /// The angles of its legs there.
    pub(super) fn strided(&self) -> PerJoint {
        let (model, gait) = (&self.config.model, &self.config.gait);
        let height = model.standing_height();
        let Stride { phase, cycle: Some(cycle) } = self.motion.stride else { return self.standing(height) };
        std::array::from_fn(|leg| {
            let geometry = model.leg(leg);
            let phase = (phase + TROT[leg]).fract();
            // From half a way of bearing ahead of the hip to half of it behind.
            let (share, lift) = if phase < gait.duty {
                (0.5 - phase / gait.duty, 0.0)
            } else {
                let swing = (phase - gait.duty) / (1.0 - gait.duty);
                (
                    swing * swing * (3.0 - 2.0 * swing) - 0.5,
                    gait.apex * ops::sin(std::f64::consts::PI * swing),
                )
            };
            let way = cycle * (gait.duty * share);
            let below = Vector3::new(way.x, geometry.offset + way.y, model.foot_radius + lift - height);
            let mut angles = geometry.reach(&(geometry.hip + below));
            for (joint, angle) in angles.iter_mut().enumerate() {
                let [low, high] = model.limits_of(leg, joint);
                *angle = angle.clamp(low, high);
            }
            angles
        })
    }
}
