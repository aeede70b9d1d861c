//! Who has a model that moves: how far each has come, and what it shows, kept up at the end of every step.

use std::collections::BTreeMap;

use super::World;
use crate::asset::{Asset, Rig};
use crate::geometry::Vector3;
use crate::id::{AssetId, EntityId};
use crate::scene::{Scene, Stride};

/// By entity whose model has clips, what is remembered of it; nothing before the end of its first step.
pub(super) type Strides = BTreeMap<EntityId, Option<Stride>>;

impl World {
    /// Begins to keep account of an entity, if the model of its asset has clips.
    pub(super) fn keep_stride(&mut self, id: EntityId, asset: Option<AssetId>) {
        if asset.is_some_and(|asset| self.rig_of(asset).is_some()) {
            self.strides.insert(id, None);
        }
    }

    fn rig_of(&self, asset: AssetId) -> Option<(&Asset, &Rig)> {
        let asset = self.assets.get(asset)?;
        Some((asset, asset.model.as_ref()?.rig.as_ref()?))
    }

    /// Follows all of them to the end of the step, when the clock shows the next tick. Who goes over to another clip is shown otherwise from now on, and counts as changed.
    pub(super) fn stride_on(&mut self) {
        let mut strides = std::mem::take(&mut self.strides);
        let mut changed = Vec::new();
        for (id, stride) in &mut strides {
            if self.follow_stride(*id, stride) {
                changed.push(id.index());
            }
        }
        self.strides = strides;
        for slot in changed {
            self.touch(slot);
        }
    }

    /// True if it goes over to another clip.
    fn follow_stride(&self, id: EntityId, stride: &mut Option<Stride>) -> bool {
        let found = self.entity(id).and_then(|entity| Some((entity, self.rig_of(entity.info.asset?)?)));
        let Some((entity, (asset, rig))) = found else { return false };
        let (at, ahead) = (entity.position(), entity.pose.rotation * Vector3::x());
        let known = stride.is_some();
        let stride = stride.get_or_insert_with(|| Stride::new(at, None));
        stride.go(at, &ahead);
        let now = entity.moment(asset, rig, self.clock.seconds(), Some(stride.way));
        if known {
            return stride.show(now, &self.clock);
        }
        *stride = Stride::new(at, now);
        false
    }

    /// Takes up what a snapshot remembers, of those who are there and have such a model.
    pub(super) fn resume_strides(&mut self, saved: &[(EntityId, Stride)]) {
        for (id, stride) in saved.iter().filter(|(_, stride)| stride.is_sound()) {
            if let Some(known) = self.strides.get_mut(id) {
                *known = Some(*stride);
            }
        }
    }

    /// What is remembered of everybody.
    pub(super) fn saved_strides(&self) -> Vec<(EntityId, Stride)> {
        self.strides.iter().filter_map(|(id, stride)| Some((*id, (*stride)?))).collect()
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::asset::{
        Bone, Channel, Clip, ClipMoment, Curve, Hull, Interpolation, Joint, Model, ModelPart, ModelVertex,
        Path, RigDesc, RigPose, SkinVertex,
    };
    use crate::geometry::{Point3, Pose, Twist, pose_facing};
    use crate::hash::StateHash;
    use crate::scene::{CLIP, EntityKind, Shape};

    const HEADING: f64 = 0.7;
    /// m/s: 0.7 m under each foot in half a second.
    const PACE: f64 = 1.4;

    fn curve(times: &[f32], values: &[[f32; 3]]) -> Curve {
        let (times, values) = (times.to_vec(), values.concat());
        Curve { interpolation: Interpolation::Linear, times, values }
    }

    /// Somebody of 2 m on two feet, the first vertices, who can stand and walk.
    fn walker() -> Asset {
        let corners = [[-0.5, -0.5, 0.0], [0.5, -0.5, 0.0], [0.0, 0.5, 0.5], [0.0, 0.0, 2.0]];
        let feet = [1, 2, 0, 0];
        let vertex = |position| ModelVertex { position, normal: [0.0, 0.0, 1.0], ..ModelVertex::default() };
        let skin = |(position, bone)| SkinVertex { position, bones: [bone; 4], ..SkinVertex::default() };
        let channel = |joint, curve| Channel { joint, path: Path::Translation, curve };
        let back = curve(
            &[0.0, 0.5, 0.75, 1.0],
            &[[0.35, 0.0, 0.0], [-0.35, 0.0, 0.0], [0.0, 0.0, 0.3], [0.35, 0.0, 0.0]],
        );
        let ahead = curve(
            &[0.0, 0.25, 0.5, 1.0],
            &[[-0.35, 0.0, 0.0], [0.0, 0.0, 0.3], [0.35, 0.0, 0.0], [-0.35, 0.0, 0.0]],
        );
        let clip = |name: &str, channels| Clip { name: name.to_owned(), channels };
        let hung = Joint { parent: Some(0), ..Joint::default() };
        let rig = Rig::new(RigDesc {
            joints: vec![Joint::default(), hung, hung],
            bones: [0, 1, 2].map(Bone::of).to_vec(),
            vertices: corners.into_iter().zip(feet).map(skin).collect(),
            clips: vec![
                clip("idle", vec![channel(0, curve(&[0.0, 1.0], &[[0.0; 3]; 2]))]),
                clip("walk", vec![channel(1, back), channel(2, ahead)]),
            ],
        });
        let model = Model {
            vertices: corners.map(vertex).to_vec(),
            triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
            parts: vec![ModelPart { name: "all".to_owned(), triangles: 4, ..ModelPart::default() }],
            hulls: vec![Hull { points: corners.to_vec() }],
            rig: Some(rig.unwrap()),
            ..Model::default()
        };
        let asset = Asset::new("walker", EntityKind::Dog, Shape::cuboid(1.0, 1.0, 2.0));
        Asset { model: Some(Arc::new(model)), ..asset }
    }

    fn place() -> (World, EntityId) {
        let (mut world, asset) = (World::new(), walker());
        let id = world.add_asset(asset.clone()).unwrap();
        let id = world.spawn(asset.at(id, pose_facing(Point3::origin(), HEADING))).unwrap();
        (world, id)
    }

    fn parts(world: &World, id: EntityId) -> (&Asset, &Rig) {
        world.rig_of(world.entity(id).unwrap().info.asset.unwrap()).unwrap()
    }

    fn shown(world: &World, id: EntityId) -> RigPose {
        let (asset, rig) = parts(world, id);
        world.entity(id).unwrap().rig_pose(asset, rig, world)
    }

    /// The moment that it would be at without the one before.
    fn moment(world: &World, id: EntityId) -> Option<ClipMoment> {
        let (asset, rig) = parts(world, id);
        let way = world.stride(id).map(|stride| stride.way);
        world.entity(id).unwrap().moment(asset, rig, world.clock().seconds(), way)
    }

    /// Goes ahead by a speed for a step.
    fn go(world: &mut World, id: EntityId, speed: f64) {
        let pose = *world.entity(id).unwrap().pose;
        let ahead = pose.rotation * Vector3::x() * speed;
        let pose =
            Pose::from_parts((pose.translation.vector + ahead * world.clock().dt()).into(), pose.rotation);
        world.set_motion(id, pose, Twist { linear: ahead, ..Twist::ZERO }).unwrap();
        world.finish_step();
    }

    /// However fast it goes, and backwards: a foot that bears stands where it is on the ground.
    #[test]
    fn feet_do_not_slide() {
        for speed in [0.5, 1.1, 1.4, 1.9, -0.8] {
            let (mut world, id) = place();
            assert!((parts(&world, id).1.pace(1).unwrap() - PACE).abs() < 1e-5);
            (0..6).for_each(|_| go(&mut world, id, speed));
            let feet = |world: &World| {
                let posed = parts(world, id).1.posed(shown(world, id));
                let at = |[x, y, z]: [f32; 3]| Point3::new(f64::from(x), f64::from(y), f64::from(z));
                [0, 1].map(|foot| world.entity(id).unwrap().pose * at(posed.positions[foot]))
            };
            let (mut before, mut bearing) = (feet(&world), 0);
            for _ in 0..40 {
                go(&mut world, id, speed);
                let now = feet(&world);
                for (a, b) in before.iter().zip(&now).filter(|(a, b)| a.z < 0.01 && b.z < 0.01) {
                    // What two moments in a sixtieth of a second may be off.
                    assert!((b - a).norm() < 0.03, "{speed} m/s: from {a} to {b}");
                    bearing += 1;
                }
                before = now;
            }
            assert!(bearing > 15, "{speed} m/s: {bearing}");
            // Account is kept from the end of the first step on.
            let gone = 45.0 * 0.1 * speed;
            assert!((world.stride(id).unwrap().way - gone).abs() < 1e-9);
        }
    }

    #[test]
    fn one_clip_goes_over_into_the_next() {
        let (mut world, id) = place();
        assert_eq!(world.stride(id), None, "nothing is known yet");
        (0..3).for_each(|_| world.finish_step());
        let stood = moment(&world, id);
        assert_eq!((stood.unwrap().clip, shown(&world, id)), (0, RigPose::at(stood)));
        // What changes between steps is shown as it was, until the next one.
        let pose = *world.entity(id).unwrap().pose;
        let ahead = pose.rotation * Vector3::x() * PACE;
        world.set_motion(id, pose, Twist { linear: ahead, ..Twist::ZERO }).unwrap();
        assert_eq!(shown(&world, id), RigPose::at(stood));
        let mark = world.mark();
        go(&mut world, id, PACE);
        let walks = moment(&world, id);
        assert_eq!((walks.unwrap().clip, shown(&world, id)), (1, RigPose::between(stood, walks, 0.1)));
        assert!(world.touched_since(mark).unwrap().any(|slot| slot == id.index()));
        // Saved in the middle of it, it goes on.
        let again = World::restore(world.snapshot()).unwrap();
        assert_eq!((shown(&again, id), again.stride(id)), (shown(&world, id), world.stride(id)));
        assert_eq!(again.digest(), world.digest());
        go(&mut world, id, PACE);
        assert_eq!(shown(&world, id), RigPose::at(moment(&world, id)), "that is over");
        // What it does not know it does not play: it goes over to how it rests.
        world.set_attribute(id, CLIP, Some("swim".into())).unwrap();
        let walked = moment_before(&world, id);
        world.finish_step();
        assert_eq!(shown(&world, id), RigPose::between(walked, None, 0.1));
        world.finish_step();
        assert!(shown(&world, id).is_rest());
    }

    /// What was shown at the end of the last step, though something else is told since.
    fn moment_before(world: &World, id: EntityId) -> Option<ClipMoment> {
        let mut before = world.clone();
        before.set_attribute(id, CLIP, None).unwrap();
        moment(&before, id)
    }

    /// Who changes again while it changes goes on from what is seen more of.
    #[test]
    fn a_change_of_a_change_begins_where_more_is_seen() {
        let (mut world, id) = place();
        (0..3).for_each(|_| world.finish_step());
        let clock = crate::clock::Clock::new(20_000).unwrap();
        let mut fine = World::with_clock(clock);
        let asset = walker();
        let number = fine.add_asset(asset.clone()).unwrap();
        let quick = fine.spawn(asset.at(number, pose_facing(Point3::origin(), 0.0))).unwrap();
        (0..3).for_each(|_| fine.finish_step());
        let stood = moment(&fine, quick);
        for (steps, goes_on_from_standing) in [(2, true), (7, false)] {
            let mut world = fine.clone();
            (0..steps).for_each(|_| go(&mut world, quick, PACE));
            let walked = moment(&world, quick);
            world.set_attribute(quick, CLIP, Some("swim".into())).unwrap();
            world.finish_step();
            let from = if goes_on_from_standing { stood } else { walked };
            assert_eq!(shown(&world, quick), RigPose::between(from, None, 0.02), "after {steps} steps");
        }
        world.remove(id).unwrap();
        world.finish_step();
        assert_eq!(world.stride(id), None);
    }
}
