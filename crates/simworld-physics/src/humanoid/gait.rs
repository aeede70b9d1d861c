//! How somebody who walks holds its limbs.
//!
//! The length of a cycle of two steps follows from speed and leg (Inman, Ralston and Todd, Human Walking, 1981, as in
//! Boulic, Magnenat-Thalmann and Thalmann, A global human walking model, The Visual Computer 6, 1990). Each foot stays on
//! its print while it bears and swings to the next, which is put on what lies there: treads, kerbs, slopes. The hips come
//! down as far as the legs need, and each leg, two links in the plane of the way, reaches its print in closed form.

use simworld_core::exertion::Exertion;
use simworld_core::geometry::{Point3, Pose, Vector2, Vector3, direction};
use simworld_core::limbs::{ArmAngles, JointAngles, LegAngles};
use simworld_core::ops;

use serde::{Deserialize, Serialize};

use super::balance::look_down;
use super::{Humanoid, Posture};
use crate::body::Surroundings;
use crate::convert::to_vector;

/// Lengths as shares of the height (Winter 2009, figure 4.1): hips, thigh, shank, ankle, and from the middle to a leg.
const HIP: f64 = 0.530;
pub(super) const THIGH: f64 = 0.245;
pub(super) const SHANK: f64 = 0.246;
const ANKLE: f64 = 0.039;
const BESIDE: f64 = 0.052;
/// A leg is never quite straight.
const STRETCH: f64 = 0.995;
/// Length of a cycle over the height of the hips is this times the root of the speed over that height (Boulic 1990; speed
/// in heights of the hips a second).
const CYCLE: f64 = 1.346;
/// Share of the cycle in which a foot of somebody who runs bears.
const RUNNING_DUTY: f64 = 0.38;
/// How high a foot swings over the higher one of its prints, as a share of the height.
const CLEARANCE: f64 = 0.03;
/// An arm swings by this share of the angle of the other leg.
const SWING: f64 = 0.6;
/// Elbows of somebody who walks and who runs, radians.
const ELBOWS: [f64; 2] = [0.2, 1.4];
/// Who has not moved for so long stands on both feet, s.
const STANDING: f64 = 0.25;
/// What stands for a share of the stride of who stands, and of who has told none yet.
const STILL: f64 = -1.0;
pub(super) const NEVER: f64 = -2.0;

/// A foot: the print it is on or swings to, and the one it swings from.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Foot {
    from: Point3,
    to: Point3,
    /// Slope of the ground under the print, upwards along the way.
    slope: f64,
}

/// Where somebody is in its stride.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Gait {
    /// Share of the cycle that has passed since the left foot came down.
    phase: f64,
    /// Share of the cycle in which a foot bears.
    duty: f64,
    /// m/s.
    speed: f64,
    /// Time without a way, s.
    still: f64,
    /// Left and right.
    feet: [Foot; 2],
}

impl Default for Gait {
    fn default() -> Self {
        let foot = Foot { from: Point3::origin(), to: Point3::origin(), slope: 0.0 };
        Self { phase: 0.0, duty: 0.6, speed: 0.0, still: STANDING, feet: [foot; 2] }
    }
}

/// Length of a cycle of two steps, m, at a speed in m/s with hips at a height in m.
fn cycle_length(speed: f64, hips: f64) -> f64 {
    CYCLE * hips * (speed / hips).sqrt()
}

/// Share of the cycle in which a foot bears (Boulic 1990: the time of bearing is 0.752 of the cycle less 0.143 s).
fn duty(speed: f64, hips: f64) -> f64 {
    if speed > Exertion::change_to_running() {
        return RUNNING_DUTY;
    }
    let time = cycle_length(speed, hips) / speed;
    (0.752 - 0.143 / time).clamp(0.5, 0.75)
}

impl Gait {
    fn is_standing(&self) -> bool {
        self.still >= STANDING
    }

    /// The share of the cycle since the left (0) or the right foot (1) came down.
    fn phase_of(&self, foot: usize) -> f64 {
        (self.phase + 0.5 * foot as f64).fract()
    }

    /// Where a foot is.
    fn place(&self, foot: usize, clearance: f64) -> Point3 {
        let Foot { from, to, .. } = self.feet[foot];
        let phase = self.phase_of(foot);
        if phase < self.duty {
            return to;
        }
        let share = (phase - self.duty) / (1.0 - self.duty);
        let smooth = share * share * (3.0 - 2.0 * share);
        let mut place = from + (to - from) * smooth;
        let over = from.z.max(to.z) - (from.z + (to.z - from.z) * smooth);
        place.z += (over + clearance) * ops::sin(std::f64::consts::PI * share);
        place
    }
}

/// The angles with which a leg reaches an ankle so far ahead of and below the hip, m; the ground rises by `slope`.
fn reach(ahead: f64, below: f64, thigh: f64, shank: f64, slope: f64) -> LegAngles {
    let way = ops::hypot(ahead, below).clamp((thigh - shank).abs() + 1e-6, STRETCH * (thigh + shank));
    let cosine = |opposite: f64, a: f64, b: f64| {
        ops::acos(((a * a + b * b - opposite * opposite) / (2.0 * a * b)).clamp(-1.0, 1.0))
    };
    let knee_flexion = std::f64::consts::PI - cosine(way, thigh, shank);
    let hip_flexion = ops::atan2(ahead, below) + cosine(shank, thigh, way);
    // The sole lies on the ground.
    let ankle_dorsiflexion = knee_flexion - hip_flexion + ops::atan2(slope, 1.0);
    LegAngles { hip_flexion, knee_flexion, ankle_dorsiflexion, ..LegAngles::default() }
}

impl Humanoid {
    /// Whether it has arms and legs as people do.
    fn has_limbs(&self) -> bool {
        self.abilities == simworld_core::action::ActionSet::humanoid()
    }

    /// Goes on in its stride by a substep; `carried` is how far it was taken along, m.
    pub(super) fn tread(&mut self, carried: &Vector3, around: &Surroundings<'_>, dt: f64) {
        if !self.has_limbs() || self.motion.posture != Posture::Standing {
            return;
        }
        let way = (self.plan.way - carried - self.plan.shifted).xy();
        let hips = HIP * self.height;
        let mut gait = self.motion.gait;
        for foot in &mut gait.feet {
            foot.from += carried;
            foot.to += carried;
        }
        gait.speed = way.norm() / dt;
        if gait.speed < 0.05 || !self.motion.grounded {
            gait.still += dt;
        } else {
            if gait.is_standing() {
                // The left foot goes first, from where it stands.
                gait.feet = [0, 1].map(|foot| self.below(foot));
                gait.phase = gait.duty;
            }
            gait.still = 0.0;
            gait.duty = duty(gait.speed, hips);
            let length = cycle_length(gait.speed, hips);
            let before = [0, 1].map(|foot| gait.phase_of(foot));
            let first = gait.phase == gait.duty;
            gait.phase = (gait.phase + way.norm() / length).fract();
            for (foot, before) in before.into_iter().enumerate() {
                let now = gait.phase_of(foot);
                if (before < gait.duty || first && foot == 0) && now >= gait.duty {
                    let ahead = way / way.norm() * (length * (1.0 - 0.5 * gait.duty));
                    gait.feet[foot] = self.print(foot, gait.feet[foot].to, ahead, around);
                }
            }
        }
        self.motion.gait = gait;
    }

    /// To the left of its middle, m.
    fn beside(&self, foot: usize) -> Vector2 {
        let heading = direction(self.motion.yaw);
        let left = BESIDE * self.height * if foot == 0 { 1.0 } else { -1.0 };
        Vector2::new(-heading.y, heading.x) * left
    }

    /// A foot straight below its hip.
    fn below(&self, foot: usize) -> Foot {
        let beside = self.beside(foot);
        let place = self.feet() + Vector3::new(beside.x, beside.y, 0.0);
        Foot { from: place, to: place, slope: 0.0 }
    }

    /// The next print of a foot, on what lies there; at its own height where nothing is within a step.
    fn print(&self, foot: usize, from: Point3, ahead: Vector2, around: &Surroundings<'_>) -> Foot {
        let offset = self.beside(foot) + ahead;
        let level = self.feet() + Vector3::new(offset.x, offset.y, 0.0);
        if self.plan.strolls {
            return Foot { from, to: level, slope: 0.0 }; // it walks by looks alone
        }
        let reach = 2.0 * around.config().step_height;
        let found = look_down(to_vector(&level.coords), reach, around, &around.queries());
        let Some(ground) = found else { return Foot { from, to: level, slope: 0.0 } };
        let slope = match ahead.try_normalize(1e-9) {
            Some(ahead) => -ground.normal.xy().dot(&ahead) / ground.normal.z,
            None => 0.0,
        };
        Foot { from, to: Point3::new(level.x, level.y, ground.height), slope }
    }

    /// Whether somebody who walks by looks alone has told how it holds its limbs, as far as that can be seen from there: an eighth of a
    /// cycle ago at most.
    pub(super) fn has_told(&mut self) -> bool {
        if !self.plan.strolls {
            return false;
        }
        let (gait, told) = (&self.motion.gait, self.plan.told);
        let now = if gait.is_standing() { STILL } else { gait.phase };
        let apart = (now - told).abs();
        let is_news = if now < 0.0 || told < 0.0 { now != told } else { apart.min(1.0 - apart) >= 0.125 };
        if is_news {
            self.plan.told = now;
        }
        !is_news
    }

    /// How it holds its limbs.
    pub(super) fn joints(&self) -> Option<JointAngles> {
        if !self.has_limbs() {
            return None;
        }
        if let Some(found) = self.plan.limp.or_else(|| self.rising_joints()) {
            return Some(found);
        }
        let gait = &self.motion.gait;
        match self.motion.posture {
            Posture::Seated | Posture::Aboard => return Some(JointAngles::seated(self.height)),
            Posture::Standing if !gait.is_standing() || self.is_crouched() => {}
            Posture::Standing | Posture::Riding => return Some(JointAngles::default()),
        }
        let body = simworld_core::geometry::pose_facing(self.feet(), self.motion.yaw);
        Some(self.stride(gait, &body))
    }

    fn stride(&self, gait: &Gait, body: &Pose) -> JointAngles {
        let [hip, thigh, shank, ankle] = [HIP, THIGH, SHANK, ANKLE].map(|share| share * self.height);
        let ankles = [0, 1].map(|foot| {
            let place = body.inverse() * gait.place(foot, CLEARANCE * self.height);
            (place.x, place.z + ankle)
        });
        let ankles = if gait.is_standing() { [(0.0, ankle); 2] } else { ankles };
        // The hips are as high as the leg that reaches farthest allows; in running neither has to.
        let length = STRETCH * (thigh + shank);
        let highest = ankles.map(|(ahead, up)| up + (length * length - ahead * ahead).max(0.0).sqrt());
        let bears = |foot: usize| gait.phase_of(foot) < gait.duty;
        let limits = (0..2).filter(|foot| bears(*foot)).map(|foot| highest[foot]);
        let straight = hip - (self.height - self.stature());
        let hips = limits.fold(straight, f64::min).max(straight.min(0.6 * hip));
        let [left_leg, right_leg] = [0, 1].map(|foot: usize| {
            let (ahead, up) = ankles[foot];
            reach(ahead, (hips - up).max(0.05 * hip), thigh, shank, gait.feet[foot].slope)
        });
        let elbow_flexion = ELBOWS[usize::from(gait.speed > Exertion::change_to_running())];
        // Straight below the hip a leg that bears is bent a little; the swing of the arms is about that.
        let arm = |other: usize| {
            let (ahead, up) = ankles[other];
            let shoulder_flexion = SWING * ops::atan2(ahead, hips - up);
            ArmAngles { shoulder_flexion, elbow_flexion, ..ArmAngles::default() }
        };
        let (left_arm, right_arm) = (arm(1), arm(0));
        JointAngles {
            left_leg,
            right_leg,
            left_arm,
            right_arm,
            hip_drop: hip - hips,
            ..JointAngles::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cadence_and_step_are_those_of_people() {
        // Adults of 1.75 m at 1.34 m/s take 105 to 120 steps a minute of 0.68 to 0.77 m (Winter 1991; Perry 1992).
        let hips = HIP * 1.75;
        let step = 0.5 * cycle_length(1.34, hips);
        let cadence = 60.0 * 1.34 / step;
        assert!((0.68..0.77).contains(&step) && (105.0..120.0).contains(&cadence), "{step} m, {cadence}/min");
        let bearing = duty(1.34, hips);
        assert!((0.58..0.66).contains(&bearing), "a foot bears for 60 % of the cycle: {bearing}");
        assert!(duty(2.5, hips) < 0.5, "who runs flies");
    }

    #[test]
    fn a_leg_reaches_what_it_is_to_reach() {
        let (thigh, shank) = (0.43, 0.43);
        for (ahead, below) in [(0.0, 0.8), (0.3, 0.7), (-0.35, 0.75), (0.2, 0.5), (0.4, 0.3)] {
            let leg = reach(ahead, below, thigh, shank, 0.0);
            // Forward kinematics: each link from the vertical, forward positive.
            let shin = leg.hip_flexion - leg.knee_flexion;
            let x = thigh * ops::sin(leg.hip_flexion) + shank * ops::sin(shin);
            let z = thigh * ops::cos(leg.hip_flexion) + shank * ops::cos(shin);
            assert!((x - ahead).abs() < 1e-9 && (z - below).abs() < 1e-9, "{x}, {z} for {ahead}, {below}");
            assert!(leg.knee_flexion >= 0.0, "knees do not bend backwards");
            assert!((shin + leg.ankle_dorsiflexion).abs() < 1e-9, "the sole is level");
        }
    }
}
