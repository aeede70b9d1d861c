//! Levels of detail: how many there are, and who comes in them.

use simworld_core::scene::{EntityKind, EntityRef, Scene};

use crate::sources::model_of;

/// How much of an entity is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Detail {
    /// A few pixels: one mesh of few triangles.
    Far,
    /// All parts that move, coarsely.
    Middle,
    /// Everything.
    Near,
}

impl Detail {
    /// What has a larger ball, m, has its details in less of it.
    pub(crate) const LARGE: f64 = 8.5;

    /// Pixels across a ball below which that in it is far, and below which it is in the middle: of what is not large, and of what is.
    pub(crate) fn thresholds() -> [[f64; 2]; 2] {
        [1.0, 0.3].map(|share| [28.0, 80.0].map(|pixels| pixels / share))
    }

    pub(super) const ALL: [Self; 3] = [Self::Far, Self::Middle, Self::Near];
    /// The bits of all of them.
    pub(crate) const EVERY: u8 = 7;

    /// Its bit in a set of levels.
    pub(crate) const fn bit(self) -> u8 {
        1 << self as u8
    }
}

/// Whether an entity moves about, and is dressed otherwise from level of detail to level of detail. What is drawn as a model or as links is not, nor
/// is a robot.
pub(crate) fn comes_in_levels(entity: &EntityRef<'_>, scene: &dyn Scene) -> bool {
    let is_modelled = || entity.info.asset.and_then(|id| model_of(scene, id)).is_some();
    let kind = entity.kind;
    let is_in_levels = kind.is_vehicle() || matches!(kind, EntityKind::Person | EntityKind::Dog);
    is_in_levels && scene.links(entity.id).is_none() && !is_modelled()
}

#[cfg(test)]
mod tests {
    use simworld_core::geometry::{Point3, Twist, Vector3, pose_facing};
    use simworld_core::limbs::JointAngles;
    use simworld_core::scene::{EntityDesc, Shape, World};

    use super::*;
    use crate::look::{Looks, resident};

    /// Somebody of every kind that moves, some of whom stand, sit or lie.
    fn somebodies(world: &mut World) -> Vec<simworld_core::id::EntityId> {
        let (tall, cycle) = (Shape::Capsule { radius: 0.25, height: 1.8 }, Shape::cuboid(1.75, 0.6, 1.6));
        let kinds = [
            (EntityKind::Person, tall),
            (EntityKind::Person, tall),
            (EntityKind::Person, tall),
            (EntityKind::Car, Shape::cuboid(4.5, 1.8, 1.5)),
            (EntityKind::Truck, Shape::cuboid(8.0, 2.5, 3.2)),
            (EntityKind::Bus, Shape::cuboid(12.0, 2.5, 3.1)),
            (EntityKind::Bicycle, cycle),
            (EntityKind::Motorcycle, cycle),
            (EntityKind::Scooter, cycle),
            (EntityKind::Dog, Shape::cuboid(0.8, 0.3, 0.6)),
        ];
        let mut ids = Vec::new();
        for (number, (kind, shape)) in kinds.into_iter().enumerate() {
            let pose = pose_facing(Point3::new(number as f64 * 20.0, 1.0, 0.0), 0.3);
            let id = world.spawn(EntityDesc::new(kind, pose, shape)).unwrap();
            let twist = Twist { linear: Vector3::x(), angular: Vector3::zeros() };
            world.set_motion(id, pose, twist).unwrap();
            ids.push(id);
        }
        let mut crouched = JointAngles::default();
        (crouched.left_leg.hip_flexion, crouched.left_leg.knee_flexion) = (1.3, 2.1);
        (crouched.right_leg, crouched.hip_drop) = (crouched.left_leg, 0.5);
        world.set_joints(ids[1], crouched).unwrap();
        world.set_joints(ids[2], JointAngles::seated(1.8)).unwrap();
        ids
    }

    /// What is drawn of somebody at a level is the same, in the same order, whichever other levels are dressed with it.
    #[test]
    fn levels_are_dressed_alone_as_together() {
        let mut world = World::new();
        let ids = somebodies(&mut world);
        for (number, id) in ids.into_iter().enumerate() {
            let entity = world.entity(id).unwrap();
            assert!(comes_in_levels(&entity, &world), "{}", entity.kind);
            let at = |levels: u8, detail: Detail| {
                let mut parts: Vec<resident::Part> = Vec::new();
                Looks::default().dress(&entity, &world, levels, &mut parts);
                assert!(parts.iter().all(|part| part.details & !levels == 0), "{} of {levels}", entity.kind);
                let own = parts.iter().filter(|part| part.details & detail.bit() != 0);
                let mut own: Vec<_> = own.map(|part| (part.mesh, part.look, part.pose)).collect();
                // Batches are drawn by mesh, then by part.
                own.sort_by_key(|(mesh, ..)| *mesh);
                own
            };
            for detail in Detail::ALL {
                let whole = at(Detail::EVERY, detail);
                assert!(!whole.is_empty());
                for levels in (1..Detail::EVERY).filter(|levels| levels & detail.bit() != 0) {
                    assert!(at(levels, detail) == whole, "{} {number}, {detail:?} of {levels}", entity.kind);
                }
            }
        }
    }
}
