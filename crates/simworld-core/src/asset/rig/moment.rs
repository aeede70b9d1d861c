//! How a rig stands as it is shown: at moments of its clips that are told apart, and on the way from one to another.

use serde::{Deserialize, Serialize};

use super::{Clip, POSE_RATE};

/// Moments of a clip that are told apart, a second: all who are in the same one are drawn as one mesh. Between two [poses](POSE_RATE) there is one more, half-way from joint to joint.
pub const MOMENT_RATE: f64 = 60.0;

/// How long a clip takes to go over into the one that follows it, s of the world's clock.
pub const MIX_SECONDS: f64 = 0.2;

/// Moments from a pose to the next.
pub(super) const MOMENTS_A_POSE: u32 = (MOMENT_RATE / POSE_RATE) as u32;

/// Steps in which one moment goes over into another.
pub(super) const MIX_STEPS: u8 = 12;

/// A moment of a clip.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ClipMoment {
    /// Which of the rig's clips.
    pub clip: u32,
    /// Which moment, at [`MOMENT_RATE`] from its beginning.
    pub number: u32,
}

/// How a rig stands as it is shown: at a moment of a clip, at rest, or on the way from one of these to another.
///
/// ```
/// use simworld_core::asset::{ClipMoment, MIX_SECONDS, RigPose};
/// let [walk, run] = [0, 1].map(|clip| Some(ClipMoment { clip, number: 7 }));
/// assert_eq!(RigPose::between(walk, run, 0.0), RigPose::at(walk));
/// assert_eq!(RigPose::between(walk, run, MIX_SECONDS), RigPose::at(run));
/// assert!(RigPose::at(None).is_rest() && !RigPose::between(walk, None, 0.1).is_rest());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct RigPose {
    pub(super) from: Option<ClipMoment>,
    pub(super) to: Option<ClipMoment>,
    /// How far it is on its way, in [`MIX_STEPS`]; all of them where both are the same.
    pub(super) share: u8,
}

impl RigPose {
    /// As no clip moves it.
    pub const REST: Self = Self::at(None);

    /// At a moment, or at rest.
    pub const fn at(moment: Option<ClipMoment>) -> Self {
        Self { from: moment, to: moment, share: MIX_STEPS }
    }

    /// So many seconds after it set out from one moment to another, which it reaches after [`MIX_SECONDS`].
    pub fn between(from: Option<ClipMoment>, to: Option<ClipMoment>, seconds: f64) -> Self {
        // Ticks are sums of fractions: a hair before a step is that step.
        let share = (seconds / MIX_SECONDS * f64::from(MIX_STEPS) + 1e-6) as u8;
        if share >= MIX_STEPS || from == to {
            Self::at(to)
        } else if share == 0 {
            Self::at(from)
        } else {
            Self { from, to, share }
        }
    }

    /// Whether no clip moves it.
    pub fn is_rest(self) -> bool {
        self == Self::REST
    }
}

impl Clip {
    /// How many moments it has.
    pub fn moments(&self) -> u32 {
        // Bounded by what a rig may have; a clip of one key is one moment.
        ((self.seconds() * MOMENT_RATE).ceil() as u32).max(1)
    }

    /// In which of its moments it is, so long after it began: it starts over when it ends.
    pub fn moment_at(&self, seconds: f64) -> u32 {
        let whole = self.seconds();
        if whole <= 0.0 || !seconds.is_finite() {
            return 0;
        }
        // A hair before a moment is that moment.
        let within = (seconds + 1e-9).rem_euclid(whole);
        ((within * MOMENT_RATE) as u32).min(self.moments() - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::super::Rig;
    use super::super::tests::{arm, is_near};
    use super::*;

    const fn moment(number: u32) -> ClipMoment {
        ClipMoment { clip: 0, number }
    }

    #[test]
    fn a_clip_starts_over_when_it_ends() {
        let clip = &arm().clips[0];
        assert_eq!((clip.seconds(), clip.poses(), clip.moments()), (1.0, 30, 60));
        for (seconds, number) in
            [(0.0, 0), (0.5, 30), (0.999, 59), (1.0, 0), (1.5, 30), (-0.25, 45), (3.2, 12), (f64::NAN, 0)]
        {
            assert_eq!(clip.moment_at(seconds), number, "{seconds} s");
        }
        let still = Clip::default();
        assert_eq!((still.poses(), still.moments(), still.moment_at(4.0)), (1, 1, 0));
    }

    /// The hand of an arm that bends by a quarter in a second, at some angle.
    fn hand(angle: f32) -> [f32; 3] {
        [1.0 + angle.cos(), angle.sin(), 0.0]
    }

    #[test]
    fn moments_are_told_apart_sixty_times_a_second() {
        let rig = Rig::new(arm()).unwrap();
        for number in [0, 1, 7, 30, 59, 60] {
            let posed = rig.posed(RigPose::at(Some(moment(number))));
            let angle = std::f32::consts::FRAC_PI_2 * number as f32 / 60.0;
            assert!(is_near(posed.positions[2], hand(angle)), "{number}: {:?}", posed.positions[2]);
        }
        assert_eq!(rig.posed(RigPose::REST), rig.rest());
        let none = RigPose::at(Some(ClipMoment { clip: 7, number: 30 }));
        assert_eq!(rig.posed(none), rig.rest(), "there is no such clip");
    }

    /// Limbs turn on their way from clip to clip, and keep their length.
    #[test]
    fn one_pose_goes_over_into_another_from_joint_to_joint() {
        let rig = Rig::new(arm()).unwrap();
        let (straight, bent) = (None, Some(moment(60)));
        for (seconds, share) in [(-1.0, 0.0), (0.0, 0.0), (0.05, 0.25), (0.1, 0.5), (0.2, 1.0), (9.0, 1.0)] {
            for (from, to, share) in [(straight, bent, share), (bent, straight, 1.0 - share)] {
                let posed = rig.posed(RigPose::between(from, to, seconds));
                let angle = std::f32::consts::FRAC_PI_2 * share;
                assert!(is_near(posed.positions[2], hand(angle)), "{seconds} s: {:?}", posed.positions[2]);
            }
        }
        assert_eq!(RigPose::between(bent, bent, 0.1), RigPose::at(bent));
        assert_eq!(RigPose::between(straight, bent, f64::NAN), RigPose::at(straight));
    }
}
