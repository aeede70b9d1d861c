//! Which clip of its model an entity plays, and where in it it is.

use super::{EntityRef, Scene};
use crate::asset::{Asset, ClipMoment, Rig, RigPose};
use crate::value::Value;

/// The attribute of an entity that names the [clip](crate::asset::Clip) that its model plays; without it, its motion and its gesture say. Where the model has
/// none of that name it stands as it rests.
pub const CLIP: &str = "clip";

/// The attribute of an entity that says when its clip began, s of the world's clock; 0 without it.
pub const CLIP_SINCE: &str = "clip_since";

/// The attribute of an entity that says how fast its clip is played: 1 without it, backwards below 0.
pub const CLIP_RATE: &str = "clip_rate";

/// The attribute of an entity whose clip is played once and not over and over: it stays in the last pose.
pub const CLIP_ONCE: &str = "clip_once";

/// Slower ones rest, m/s.
const MOVING: f64 = 0.2;
/// Faster ones run: the speed at which grown people change over (Hreljac 1993), m/s.
const RUNNING: f64 = 2.1;

/// What clips are called by those who make models.
const RESTING: [&str; 5] = ["idle", "survey", "stand", "breath", "rest"];
const WALKING: [&str; 4] = ["walk", "trot", "move", "run"];
const HURRYING: [&str; 6] = ["run", "gallop", "sprint", "trot", "walk", "move"];

impl EntityRef<'_> {
    /// The clip of its model that it plays when the world's clock shows so many seconds, and how far it is in it, s; none where it stands as it rests.
    ///
    /// What its attribute [`CLIP`] names; else the clip of its gesture; else one of walking or running, where it moves, and of idling,
    /// where it does not. A model that knows none of these plays its first clip: the sails of a mill turn. A beast that can only walk stands still when it rests.
    ///
    /// Where `way` says how far it has come (see [`Stride::way`](super::Stride)), in metres of its model, who walks or runs is as far in its clip as its [feet](Rig::pace) go on that way, so that they do not
    /// slide; all else goes by the clock.
    pub fn playing(&self, rig: &Rig, seconds: f64, way: Option<f64>) -> Option<(usize, f64)> {
        let attributes = &self.info.attributes;
        let number =
            |key: &str| attributes.get(key).and_then(Value::as_f64).filter(|number| number.is_finite());
        let (clip, by_feet) = match attributes.get(CLIP) {
            Some(Value::Text(name)) => (rig.clip(name)?, false),
            Some(_) => return None,
            None => self.clip_by_motion(rig)?,
        };
        let rate = number(CLIP_RATE).unwrap_or(1.0);
        if let (true, Some(way), Some(pace)) = (by_feet, way, rig.pace(clip)) {
            return Some((clip, way / pace * rate));
        }
        let since = (seconds - number(CLIP_SINCE).unwrap_or(0.0)) * rate;
        let is_once = attributes.get(CLIP_ONCE) == Some(&Value::Bool(true));
        let whole = rig.clips()[clip].seconds();
        // A hair before the end, behind which it would begin anew.
        let last = (whole - 1e-6).max(0.0);
        let within = match (is_once, rate < 0.0) {
            (false, _) => since,
            (true, false) => since.clamp(0.0, last),
            (true, true) => (last + since).clamp(0.0, last),
        };
        Some((clip, within))
    }

    /// How its model, which is that of an asset, stands as it is shown: where it is in its [clip](Self::playing), or on its way there from the one before, if the scene [keeps account](Scene::stride) of that.
    pub fn rig_pose(&self, asset: &Asset, rig: &Rig, scene: &dyn Scene) -> RigPose {
        let (stride, seconds) = (scene.stride(self.id), scene.clock().seconds());
        let now = self.moment(asset, rig, seconds, stride.map(|stride| stride.way));
        stride.map_or(RigPose::at(now), |stride| stride.pose(now, &scene.clock()))
    }

    /// The moment of its clip at which it is, having come so far, m.
    pub(super) fn moment(
        &self,
        asset: &Asset,
        rig: &Rig,
        seconds: f64,
        way: Option<f64>,
    ) -> Option<ClipMoment> {
        // Who is longer than its model has longer legs.
        let way = way.map(|way| way * asset.collider.size().x / self.info.shape.size().x);
        let (clip, within) = self.playing(rig, seconds, way)?;
        Some(ClipMoment { clip: clip as u32, number: rig.clips()[clip].moment_at(within) })
    }

    /// The clip, and whether its feet go by the way.
    fn clip_by_motion(&self, rig: &Rig) -> Option<(usize, bool)> {
        if let Some(clip) = self.gesture().and_then(|gesture| rig.clip_like(&[gesture.as_str()])) {
            return Some((clip, false));
        }
        let speed = self.twist.linear.norm();
        let words: &[&str] = match speed {
            speed if speed >= RUNNING => &HURRYING,
            speed if speed >= MOVING => &WALKING,
            _ => &RESTING,
        };
        let found = rig.clip_like(words).map(|clip| (clip, speed >= MOVING));
        found.or_else(|| rig.clip_like(&HURRYING).is_none().then_some((0, false)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::asset::{Bone, Channel, Clip, Curve, Interpolation, Joint, Path, RigDesc, SkinVertex};
    use crate::geometry::{Point3, Twist, Vector3, pose_facing};
    use crate::scene::{EntityDesc, EntityKind, GESTURE, Scene, Shape, World};

    /// Clips of these names, each of 2 s.
    fn rig(names: &[&str]) -> Rig {
        let curve =
            Curve { interpolation: Interpolation::Linear, times: vec![0.0, 2.0], values: vec![0.0; 6] };
        let clip = |name: &&str| Clip {
            name: (*name).to_owned(),
            channels: vec![Channel { joint: 0, path: Path::Translation, curve: curve.clone() }],
        };
        Rig::new(RigDesc {
            joints: vec![Joint::default()],
            bones: vec![Bone::of(0)],
            vertices: vec![SkinVertex::default()],
            clips: names.iter().map(clip).collect(),
        })
        .unwrap()
    }

    fn fox(speed: f64, attributes: &[(&str, Value)]) -> (World, crate::id::EntityId) {
        let mut world = World::new();
        let pose = pose_facing(Point3::origin(), 0.0);
        let mut desc = EntityDesc::new(EntityKind::Dog, pose, Shape::cuboid(0.8, 0.3, 0.6));
        desc.twist = Twist { linear: Vector3::x() * speed, ..Twist::default() };
        for (key, value) in attributes {
            desc = desc.with(*key, value.clone());
        }
        let id = world.spawn(desc).unwrap();
        (world, id)
    }

    fn plays(
        names: &[&str],
        speed: f64,
        attributes: &[(&str, Value)],
        seconds: f64,
    ) -> Option<(String, f64)> {
        let (world, id) = fox(speed, attributes);
        let rig = rig(names);
        let (clip, since) = world.entity(id).unwrap().playing(&rig, seconds, None)?;
        Some((rig.clips()[clip].name.clone(), since))
    }

    #[test]
    fn motion_says_what_is_played() {
        let all = ["Survey", "Walk", "Run"];
        for (speed, wanted) in [(0.0, "Survey"), (1.3, "Walk"), (4.0, "Run")] {
            assert_eq!(plays(&all, speed, &[], 0.5), Some((wanted.to_owned(), 0.5)));
        }
        assert_eq!(plays(&["fox_walk"], 4.0, &[], 0.0).unwrap().0, "fox_walk");
        assert_eq!(plays(&["fox_walk"], 0.0, &[], 0.0), None, "who can only walk stands still");
        assert_eq!(plays(&["sails"], 0.0, &[], 7.0), Some(("sails".to_owned(), 7.0)));
    }

    #[test]
    fn a_name_goes_before_a_gesture_and_that_before_motion() {
        let all = ["idle", "walk", "wave"];
        let waves = (GESTURE, Value::from("wave"));
        assert_eq!(plays(&all, 1.0, std::slice::from_ref(&waves), 0.0).unwrap().0, "wave");
        assert_eq!(plays(&all, 1.0, &[waves.clone(), (CLIP, "Idle".into())], 0.0).unwrap().0, "idle");
        assert_eq!(plays(&all, 1.0, &[waves, (CLIP, "swim".into())], 0.0), None);
    }

    #[test]
    fn a_clip_has_its_own_time() {
        let at =
            |attributes: &[(&str, Value)], seconds| plays(&["turn"], 0.0, attributes, seconds).unwrap().1;
        assert_eq!(at(&[(CLIP_SINCE, 3.0.into())], 4.5), 1.5);
        assert_eq!(at(&[(CLIP_SINCE, 3.0.into()), (CLIP_RATE, 2.0.into())], 4.5), 3.0);
        let once = (CLIP_ONCE, Value::Bool(true));
        assert!((at(std::slice::from_ref(&once), 9.0) - 2.0).abs() < 1e-5);
        assert_eq!(at(&[once.clone(), (CLIP_SINCE, 3.0.into())], 1.0), 0.0);
        let back = at(&[once, (CLIP_RATE, (-1.0).into())], 1.5);
        assert!((back - 0.5).abs() < 1e-5, "{back}");
    }
}
