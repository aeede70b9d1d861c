//! What is said for whoever draws: how limbs are held and where links are.

use std::sync::Arc;

use super::slots::check_pose;
use super::{World, WorldError};
use crate::geometry::Pose;
use crate::id::EntityId;
use crate::limbs::JointAngles;
use crate::links::{KeptLinks, LinkForm};

impl World {
    /// Says how somebody holds its limbs: for whoever draws it. It has no part in digests or snapshots, since it follows from
    /// what moves it, which says it anew every step. Who holds them as before does not count as changed.
    ///
    /// # Errors
    /// No such entity.
    pub fn set_joints(&mut self, id: EntityId, joints: JointAngles) -> Result<(), WorldError> {
        self.check_alive(id)?;
        if self.joints.insert(id, joints) != Some(joints) {
            self.touch(id.index());
        }
        Ok(())
    }

    /// Says where the links of an entity are, entity from link, a pose each: for whoever draws it. As with
    /// [joints](Self::set_joints), it has no part in digests or snapshots, and who is as before does not count as changed. Poses go
    /// into the memory of those before; the forms are looked at only when they are others than before.
    ///
    /// # Errors
    /// No such entity, not a pose each, a pose that is none, a shape that is no solid, or a model that is none or no fit for its shape; then
    /// nothing has changed.
    pub fn set_links(
        &mut self,
        id: EntityId,
        forms: &Arc<[LinkForm]>,
        poses: &[Pose],
    ) -> Result<(), WorldError> {
        self.check_alive(id)?;
        if forms.len() != poses.len() {
            return Err(WorldError::Links { id, forms: forms.len(), poses: poses.len() });
        }
        poses.iter().try_for_each(check_pose)?;
        let known = self.links.get_mut(&id).filter(|kept| Arc::ptr_eq(&kept.forms, forms));
        if let Some(kept) = known {
            if kept.poses == poses {
                return Ok(());
            }
            kept.poses.clear();
            kept.poses.extend_from_slice(poses);
        } else {
            for (link, LinkForm { shape, model, .. }) in forms.iter().enumerate() {
                shape.validate()?;
                let sound = model.as_ref().map_or(Ok(()), |model| model.validate_surface(shape.size()));
                sound.map_err(|error| WorldError::LinkModel { id, link, error })?;
            }
            self.links.insert(id, KeptLinks { forms: Arc::clone(forms), poses: poses.to_vec() });
        }
        self.touch(id.index());
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Point3, pose_facing};
    use crate::hash::StateHash;
    use crate::scene::{EntityDesc, EntityKind, Scene, Shape};

    #[test]
    fn links_are_told_kept_and_gone_with_their_entity() {
        let mut world = World::new();
        let pose = pose_facing(Point3::origin(), 0.0);
        let id = world.spawn(EntityDesc::new(EntityKind::Robot, pose, Shape::cuboid(1.0, 1.0, 1.0))).unwrap();
        let before = world.digest();
        let form = LinkForm::solid(Shape::cuboid(0.1, 0.1, 0.5), None);
        let forms: Arc<[LinkForm]> = Arc::from([form.clone(), form]);
        let poses = [Pose::translation(0.0, 0.0, 0.5), Pose::translation(0.3, 0.0, 1.0)];
        world.set_links(id, &forms, &poses).unwrap();
        let told: Vec<_> = world.links(id).unwrap().iter().map(|(form, pose)| (form, *pose)).collect();
        assert_eq!(told, [(&forms[0], poses[0]), (&forms[1], poses[1])]);
        assert_eq!(world.digest(), before, "they follow from what moves them");

        let changes = |world: &World, mark| world.changed_since(mark).unwrap().count();
        world.finish_step();
        world.finish_step();
        let mark = world.mark();
        world.set_links(id, &forms, &poses).unwrap();
        assert_eq!(changes(&world, mark), 0, "who is as before has not changed");
        world.set_links(id, &forms, &[poses[1], poses[0]]).unwrap();
        assert_eq!(changes(&world, mark), 1);

        let short = world.set_links(id, &forms, &poses[..1]);
        assert_eq!(short, Err(WorldError::Links { id, forms: 2, poses: 1 }));
        let nowhere = [poses[0], Pose::translation(f64::NAN, 0.0, 0.0)];
        assert!(matches!(world.set_links(id, &forms, &nowhere), Err(WorldError::Pose { .. })));
        let thin: Arc<[LinkForm]> = Arc::from([LinkForm::solid(Shape::cuboid(0.0, 1.0, 1.0), None)]);
        assert!(matches!(world.set_links(id, &thin, &poses[..1]), Err(WorldError::Shape(_))));
        let hollow = Some(Arc::new(crate::asset::Model::default()));
        let hollow: Arc<[LinkForm]> = Arc::from([LinkForm { model: hollow, ..forms[0].clone() }]);
        let refused = world.set_links(id, &hollow, &poses[..1]);
        assert!(matches!(refused, Err(WorldError::LinkModel { link: 0, .. })), "{refused:?}");
        assert_eq!(world.links(id).unwrap().iter().next().unwrap().1, &poses[1], "nothing has changed");

        world.remove(id).unwrap();
        assert!(world.links(id).is_none());
    }
}
