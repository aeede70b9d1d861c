//! The implementations of the seams that live here hold to the seams' promises.

use proptest::prelude::*;
use simworld_core::action::Action;
use simworld_core::geometry::{Point3, Pose, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::kinematic::{KinematicBody, KinematicDynamics};
use simworld_core::scene::{EntityDesc, EntityKind, Shape, World};
use simworld_core::seed::Seed;
use simworld_core::testing::{check_dynamics, check_embodiment, check_scene};

/// Five hundred things of all sizes, from a parcel to a stadium, some with names and goods on sale that change; one in seven
/// is taken away again, and every second of those comes back.
fn jumble(seed: u64) -> World {
    let mut rng = Seed(seed).stream("tests/jumble").rng();
    let mut world = World::new();
    for index in 0..500 {
        let at = Point3::new(rng.normal(0.0, 400.0), rng.normal(0.0, 400.0), rng.uniform(-5.0, 80.0));
        let size = 0.2 * simworld_core::ops::pow(1000.0, rng.unit());
        let shape = match rng.below(4) {
            0 => Shape::Sphere { radius: size },
            1 => Shape::Cylinder { radius: size, height: 3.0 * size },
            2 => Shape::Capsule { radius: size, height: 4.0 * size },
            _ => Shape::cuboid(size, 2.0 * size, 0.5 * size),
        };
        let mut thing = EntityDesc::new(EntityKind::Prop, pose_facing(at, rng.uniform(-3.0, 3.0)), shape);
        if index % 3 == 0 {
            thing = thing.named(format!("The {} Ann's {index}", ["Red", "Old", "red & old"][rng.below(3)]));
        }
        if index % 5 == 0 {
            thing = thing.with("sells", ["tea, ice cream", "tea", " , "][rng.below(3)]);
        }
        let id = world.spawn(thing).unwrap();
        if index % 10 == 0 {
            world.set_attribute(id, "sells", Some("coffee,tea".into()).filter(|_| index % 20 == 0)).unwrap();
        }
        if index % 7 == 0 {
            let thing = world.remove(id).unwrap();
            if index % 2 == 0 {
                world.respawn(id, thing).unwrap();
            }
        }
    }
    world
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(6))]

    #[test]
    fn the_world_is_a_scene(seed in any::<u64>()) {
        check_scene(&jumble(seed));
    }
}

#[test]
fn a_kinematic_body_is_an_embodiment() {
    check_embodiment(|| Box::new(KinematicBody::walker(Pose::identity())));
}

#[test]
fn kinematic_bodies_are_dynamics() {
    let mut world = World::new();
    let mut walkers: Vec<EntityId> = Vec::new();
    for index in 0..8 {
        let pose = pose_facing(Point3::new(f64::from(index), 0.0, 0.0), 0.3 * f64::from(index));
        let shape = Shape::Capsule { radius: 0.25, height: 1.8 };
        walkers.push(world.spawn(EntityDesc::new(EntityKind::Person, pose, shape)).unwrap());
    }
    for (index, walker) in walkers.iter().enumerate() {
        world.actuate(*walker, Action::MoveForward { speed: 0.2 * index as f64 }).unwrap();
    }
    check_dynamics(&world, || {
        let mut bodies = KinematicDynamics::new();
        for (index, walker) in walkers.iter().enumerate() {
            let pose = pose_facing(Point3::new(index as f64, 0.0, 0.0), 0.3 * index as f64);
            bodies.insert(*walker, Box::new(KinematicBody::walker(pose)));
        }
        Box::new(bodies)
    });
}
