//! What fifty robot dogs cost that trot on their motors, beside the time they trot: a tenth of a second of the world, in 20
//! substeps. Less than a tenth of a second is faster than real time.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use simworld_core::action::Action;
use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::scene::{EntityDesc, EntityKind, Shape, World};
use simworld_core::seam::Dynamics;
use simworld_physics::{PhysicsConfig, PhysicsDynamics, QuadrupedConfig};

const DOGS: usize = 50;

/// So many dogs, two metres apart, that trot side by side.
fn pack(dogs: usize) -> (World, PhysicsDynamics) {
    let mut world = World::new();
    let mut physics = PhysicsDynamics::new(PhysicsConfig::default()).expect("the default settings are sound");
    for dog in 0..dogs {
        let pose = pose_facing(Point3::new(0.0, 2.0 * dog as f64, 0.0), 0.0);
        let desc = EntityDesc::new(EntityKind::Dog, pose, Shape::cuboid(0.7, 0.35, 0.5));
        let id = world.spawn(desc).expect("there is room");
        physics.add_quadruped(&world, id, QuadrupedConfig::default()).expect("an upright body");
        world.actuate(id, Action::MoveForward { speed: 0.6 }).expect("a dog moves");
    }
    (world, physics)
}

fn step(world: &mut World, physics: &mut PhysicsDynamics) {
    world.begin_step();
    physics.step(world, 0.1).expect("the physics goes on");
    world.finish_step();
}

fn quadrupeds(criterion: &mut Criterion) {
    for dogs in [1, DOGS] {
        let (mut world, mut physics) = pack(dogs);
        (0..20).for_each(|_| step(&mut world, &mut physics));
        criterion.bench_function(&format!("{dogs} quadrupeds, 0.1 s"), |bencher| {
            bencher.iter(|| {
                step(&mut world, &mut physics);
                black_box(world.len());
            });
        });
    }
}

criterion_group!(benches, quadrupeds);
criterion_main!(benches);
