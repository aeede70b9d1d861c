//! The world store: 10 000 bodies that move each step, and what a reader asks.

use std::hint::black_box;
use std::ops::ControlFlow;

use criterion::{Criterion, criterion_group, criterion_main};
use simworld_core::geometry::{Aabb, Point2, Point3, Pose, Twist, Vector3, direction, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
use simworld_core::seed::Seed;

const BODIES: u32 = 10_000;
const WIDTH: f64 = 2000.0;

fn crowd() -> (World, Vec<f64>) {
    let mut rng = Seed(1).stream("bench/crowd").rng();
    let mut world = World::new();
    let mut headings = Vec::new();
    for _ in 0..BODIES {
        let at = Point3::new(rng.uniform(0.0, WIDTH), rng.uniform(0.0, WIDTH), 0.0);
        headings.push(rng.uniform(-3.0, 3.0));
        let shape = Shape::Capsule { radius: 0.25, height: 1.8 };
        world.spawn(EntityDesc::new(EntityKind::Person, pose_facing(at, 0.0), shape)).expect("sound");
    }
    world.finish_step();
    (world, headings)
}

fn step(world: &mut World, headings: &[f64]) {
    world.begin_step();
    for (index, heading) in headings.iter().enumerate() {
        let id = EntityId::new(index as u32, 0);
        let velocity = direction(*heading) * 1.4;
        let velocity = Vector3::new(velocity.x, velocity.y, 0.0);
        let pose = *world.entity(id).expect("nobody leaves").pose;
        let moved = Pose::from_parts((pose.translation.vector + velocity * 0.1).into(), pose.rotation);
        world.set_motion(id, moved, Twist { linear: velocity, ..Twist::ZERO }).expect("within the world");
    }
    world.finish_step();
}

fn bench(criterion: &mut Criterion) {
    let (mut world, headings) = crowd();
    criterion.bench_function("step of 10 000 walking bodies", |b| b.iter(|| step(&mut world, &headings)));
    let (world, _) = crowd();
    let mut rng = Seed(2).stream("bench/reads").rng();
    criterion.bench_function("visit of a 50 m square (about 6 bodies)", |b| {
        b.iter(|| {
            let center = Point2::new(rng.uniform(0.0, WIDTH), rng.uniform(0.0, WIDTH));
            let mut count = 0_usize;
            let _ = world.visit(&Aabb::column_around(center, 25.0), &mut |entity| {
                count += entity.id.index();
                ControlFlow::Continue(())
            });
            black_box(count)
        });
    });
    criterion.bench_function("nearest of 10 000 bodies", |b| {
        b.iter(|| {
            let center = Point2::new(rng.uniform(0.0, WIDTH), rng.uniform(0.0, WIDTH));
            black_box(world.nearest(center, 500.0, &|_| true).map(|entity| entity.id))
        });
    });
    criterion.bench_function("snapshot of 10 000 bodies", |b| b.iter(|| black_box(world.snapshot())));
}

criterion_group!(benches, bench);
criterion_main!(benches);
