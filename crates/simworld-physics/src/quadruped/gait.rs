//! The trot: when a foot stands and swings, where it comes down, and how it gets there.
//!
//! Diagonal pairs of feet alternate. A foot comes down ahead of its hip by half of what the body goes while it stands, and by a
//! share of the speed that is too much (Raibert, Legged Robots That Balance, 1986), at the height that a look at the ground
//! finds there.

use nalgebra::UnitQuaternion;
use serde::{Deserialize, Serialize};
use simworld_core::geometry::{Point3, Vector2, Vector3};
use simworld_core::ops;

use super::{Command, GaitParameters, QuadrupedModel, QuadrupedState};

/// A foot with less load than this is in the air, N.
const CONTACT: f64 = 2.0;
/// A foot that has lost the ground for so long feels for it, s.
const LOST: f64 = 0.03;
/// How fast it does that, m/s, and how far below the body's plane at most, m.
const FEEL: f64 = 0.6;
const FEEL_DEPTH: f64 = 0.12;
/// How much of a speed that is too much a foot steps out for, s.
const CATCH: f64 = 0.05;
/// Feet come down no farther than this from under their hips, m.
const REACH: f64 = 0.17;
/// Nor do they come down closer to one another than this, m: shanks would meet.
const APART: f64 = 0.06;
/// A foot is aimed so far into the ground, m.
const PRESS: f64 = 0.006;
/// The share of the swing in which the foot goes up and in which it goes ahead.
const LIFT: f64 = 0.42;
const AHEAD: [f64; 2] = [0.12, 0.85];
/// From this share of the swing on, the foot stands as soon as it meets something.
const EARLY: f64 = 0.5;
/// Commands slower than this, m/s and rad/s, are for standing.
const SLOW: f64 = 0.02;
/// A body that stands steps when it moves so fast, m/s, or a foot is so far from its place, m.
const UPSET: f64 = 0.22;
const ASTRAY: f64 = 0.07;

/// One foot.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Foot {
    /// Whether it is on its way.
    pub(super) swings: bool,
    /// Where its middle left the ground and where it goes, world frame, m.
    from: Point3,
    to: Point3,
    /// Where it stood last, world frame, m.
    pub(super) grip: Point3,
    /// Since when nothing bears it, s.
    pub(super) lost: f64,
}

/// Where a quadruped is in its gait.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Gait {
    /// Share of the cycle since the front left foot came down.
    phase: f64,
    /// Whether it steps at all, and for how long, s.
    pub(super) trots: bool,
    since: f64,
    pub(super) feet: [Foot; 4],
    /// The plane under the feet: height at the middle of the feet, and how it rises towards x and y of the world.
    pub(super) level: f64,
    pub(super) rise: Vector2,
}

/// The middle of a foot as a target: place and velocity, world frame.
pub(super) type Way = (Vector3, Vector3);

/// The ground under a place, if it is looked at and found: its height, m.
pub(super) type Look<'a> = &'a dyn Fn(&Vector3) -> Option<f64>;

fn smooth(share: f64) -> f64 {
    let share = share.clamp(0.0, 1.0);
    share * share * (3.0 - 2.0 * share)
}

impl Gait {
    /// A body that stands with its feet there.
    pub(super) fn standing(feet: [Vector3; 4]) -> Self {
        let feet = feet.map(|foot| {
            let place = Point3::from(foot);
            Foot { swings: false, from: place, to: place, grip: place, lost: 0.0 }
        });
        let mut gait = Self { feet, ..Self::default() };
        gait.lay_plane(1.0);
        gait
    }

    /// The share of the cycle since a foot came down: diagonal feet go together.
    fn phase_of(&self, foot: usize) -> f64 {
        let later = if foot == 0 || foot == 3 { 0.0 } else { 0.5 };
        (self.phase + later).fract()
    }

    /// The share of its swing that a foot has behind it, if its time is to swing.
    fn swing(&self, foot: usize, duty: f64) -> Option<f64> {
        let phase = self.phase_of(foot);
        (self.trots && phase >= duty).then(|| (phase - duty) / (1.0 - duty))
    }

    /// Draws the plane through where the feet stood last; `share` is how much of the way to it is gone.
    fn lay_plane(&mut self, share: f64) {
        let [a, b, c, d] = self.feet.map(|foot| foot.grip.coords);
        let middle = (a + b + c + d) * 0.25;
        let (ahead, left) = ((a + b - c - d) * 0.5, (a + c - b - d) * 0.5);
        let normal = ahead.cross(&left);
        let rise = if normal.z > 1e-6 { -normal.xy() / normal.z } else { Vector2::zeros() };
        let rise = rise * (1.0 / rise.norm().max(1.0));
        self.level += (middle.z - self.level) * share;
        self.rise += (rise - self.rise) * share;
    }

    /// The slope under the feet, unit length.
    pub(super) fn normal(&self) -> Vector3 {
        Vector3::new(-self.rise.x, -self.rise.y, 1.0).normalize()
    }

    /// Height of the plane under the feet below a place, m.
    pub(super) fn height_below(&self, place: &Vector3) -> f64 {
        let middle = self.feet.iter().fold(Vector3::zeros(), |sum, foot| sum + foot.grip.coords) * 0.25;
        self.level + self.rise.dot(&(place - middle).xy())
    }

    /// Goes on by `dt` s: which feet stand, which swing, and where those go.
    pub(super) fn advance(
        &mut self,
        (model, gait): (&QuadrupedModel, &GaitParameters),
        sensed: &QuadrupedState,
        feet: &[Vector3; 4],
        (command, heading): (&Command, f64),
        look: Look<'_>,
        dt: f64,
    ) {
        self.decide(model, gait, sensed, feet, (command, heading));
        if self.trots {
            self.phase = (self.phase + dt * gait.frequency).fract();
            self.since += dt;
        }
        for (foot, place) in feet.iter().enumerate() {
            let bears = sensed.loads[foot] > CONTACT;
            let share = self.swing(foot, gait.duty);
            let state = &mut self.feet[foot];
            state.lost = if bears { 0.0 } else { state.lost + dt };
            match share {
                Some(share) if !state.swings && share < EARLY => {
                    (state.swings, state.from) = (true, Point3::from(*place));
                }
                Some(share) if state.swings && share > EARLY && bears => state.swings = false,
                None => state.swings = false,
                _ => {}
            }
            if state.swings {
                let left = (1.0 - share.unwrap_or(1.0)) * (1.0 - gait.duty) / gait.frequency;
                let to = self.foothold((model, gait), sensed, foot, (command, heading), left, look);
                self.feet[foot].to = to;
            } else if bears {
                state.grip = Point3::from(*place);
            }
        }
        self.lay_plane((dt / 0.08).min(1.0));
    }

    /// Whether to step: when told to go, when pushed, or when a foot is out of place; and to stop only with feet in place.
    fn decide(
        &mut self,
        model: &QuadrupedModel,
        gait: &GaitParameters,
        sensed: &QuadrupedState,
        feet: &[Vector3; 4],
        (command, heading): (&Command, f64),
    ) {
        let wanted = ops::hypot(command.forward, command.lateral) > SLOW || command.turning.abs() > SLOW;
        let speed = sensed.linear.xy().norm();
        let astray = (0..4).map(|foot| (feet[foot] - hip_of(model, sensed, foot, heading)).xy().norm());
        let astray = astray.fold(0.0, f64::max);
        if !self.trots && (wanted || speed > UPSET || astray > ASTRAY) {
            (self.trots, self.since, self.phase) = (true, 0.0, gait.duty - 0.5 + 1e-9);
        } else if self.trots && !wanted && speed < 0.5 * UPSET && astray < 0.6 * ASTRAY && self.since > 0.8 {
            let all_stand = (0..4).all(|foot| self.swing(foot, gait.duty).is_none());
            self.trots = !all_stand;
        }
    }

    /// Where a foot is to come down that has `left` s to swing.
    fn foothold(
        &self,
        (model, gait): (&QuadrupedModel, &GaitParameters),
        sensed: &QuadrupedState,
        foot: usize,
        (command, heading): (&Command, f64),
        left: f64,
        look: Look<'_>,
    ) -> Point3 {
        let hip = hip_of(model, sensed, foot, heading);
        let arm = hip - sensed.trunk.translation.vector;
        let about = Vector3::z() * command.turning;
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), heading);
        let wanted = turn * Vector3::new(command.forward, command.lateral, 0.0);
        let is = Vector3::new(sensed.linear.x, sensed.linear.y, 0.0);
        let stand = gait.duty / gait.frequency;
        let step = (is + about.cross(&arm)) * (stand * 0.5) + (is - wanted) * CATCH;
        let step = step * (REACH / step.norm().max(REACH));
        let place =
            self.off_others(foot, hip + is * left + step, |other| hip_of(model, sensed, other, heading));
        let plane = self.height_below(&place);
        let height = look(&place).map_or(plane, |ground| ground + model.foot_radius);
        Point3::new(place.x, place.y, height.clamp(plane - 0.2, plane + 0.2))
    }

    /// A place for a foot, put off where the others stand or come down, towards where its own hip is as seen from theirs.
    fn off_others(&self, foot: usize, place: Vector3, hip: impl Fn(usize) -> Vector3) -> Vector3 {
        let mut place = place;
        for (other, state) in self.feet.iter().enumerate().filter(|(other, _)| *other != foot) {
            let there = if state.swings { state.to } else { state.grip };
            let away = (hip(foot) - hip(other)).xy().normalize();
            let between = (place - there.coords).xy();
            let (along, aside) = (between.dot(&away), away.perp(&between).abs());
            if aside < APART {
                let least = (APART * APART - aside * aside).sqrt();
                let missing = away * (least - along).max(0.0);
                place += Vector3::new(missing.x, missing.y, 0.0);
            }
        }
        place
    }

    /// Where the middle of a foot is to be now, and how fast; none for a foot that stands and bears.
    pub(super) fn way(
        &self,
        foot: usize,
        gait: &GaitParameters,
        feet: &[Vector3; 4],
        dt: f64,
    ) -> Option<Way> {
        let state = &self.feet[foot];
        if !state.swings {
            let lost = state.lost > LOST && self.trots;
            let deep = self.height_below(&feet[foot]) - FEEL_DEPTH;
            return (lost && feet[foot].z > deep).then(|| {
                let down = Vector3::new(0.0, 0.0, -FEEL);
                (Vector3::new(state.grip.x, state.grip.y, feet[foot].z) + down * 0.02, down)
            });
        }
        let share = self.swing(foot, gait.duty)?;
        let now = self.arc(foot, share, gait.apex);
        let next = self.arc(foot, share + dt * gait.frequency / (1.0 - gait.duty), gait.apex);
        Some((next, (next - now) / dt))
    }

    fn arc(&self, foot: usize, share: f64, apex: f64) -> Vector3 {
        let Foot { from, to, .. } = self.feet[foot];
        let (from, to) = (from.coords, to.coords - Vector3::z() * PRESS);
        let ahead = smooth((share - AHEAD[0]) / (AHEAD[1] - AHEAD[0]));
        let top = from.z.max(to.z) + apex;
        let height = if share < LIFT {
            from.z + (top - from.z) * smooth(share / LIFT)
        } else {
            top + (to.z - top) * smooth((share - LIFT) / (1.0 - LIFT))
        };
        let level = from.lerp(&to, ahead);
        Vector3::new(level.x, level.y, height)
    }
}

/// The point over which a foot stands at rest: beside its hip, world frame, m.
fn hip_of(model: &QuadrupedModel, sensed: &QuadrupedState, foot: usize, heading: f64) -> Vector3 {
    let leg = model.leg(foot);
    let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), heading);
    let beside = Vector3::new(leg.hip.x, leg.hip.y + leg.offset, 0.0);
    sensed.trunk.translation.vector + turn * beside
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Feet 0.38 and 0.25 m apart, as they stand under the trunk of the default model.
    fn places() -> [Vector3; 4] {
        std::array::from_fn(|foot| {
            let (ahead, left) =
                (if foot < 2 { 0.19 } else { -0.19 }, if foot.is_multiple_of(2) { 0.127 } else { -0.127 });
            Vector3::new(ahead, left, 0.02)
        })
    }

    #[test]
    fn feet_come_down_beside_those_that_stand() {
        let gait = Gait::standing(places());
        let put = |foot: usize, x: f64, y: f64| {
            let place = gait.off_others(foot, Vector3::new(x, y, 0.02), |other| places()[other]);
            (place - Vector3::new(x, y, 0.02)).xy()
        };
        assert_eq!(put(2, -0.1, 0.13), Vector2::zeros(), "far enough from all");
        // A hind foot that would come down on the fore foot, or beyond it, does so behind it.
        for x in [0.15, 0.19, 0.25] {
            let moved = put(2, x, 0.127);
            assert!((x + moved.x - (0.19 - APART)).abs() < 1e-9 && moved.y.abs() < 1e-9, "{x}: {moved}");
        }
        let moved = put(0, -0.19, 0.127 + 0.03);
        let away = ops::hypot(moved.x, 0.03);
        assert!((away - APART).abs() < 1e-9 && moved.x > 0.0, "{moved}");
    }
}
