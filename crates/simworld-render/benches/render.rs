//! Frames per second of one camera over a scene of 10,000 boxes, everything read back.
//!
//! `cargo bench -p simworld-render`; on a machine without an adapter it says so and measures nothing.
#![allow(missing_docs)]

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::scene::{EntityDesc, EntityKind, Shape, World};
use simworld_core::seed::Seed;
use simworld_render::{Frame, RenderConfig, Renderer};

/// Boxes of one to ten metres on a square of 800 m.
fn boxes(kind: EntityKind) -> World {
    let mut world = World::new();
    let mut rng = Seed(3).stream("bench/boxes").rng();
    for _ in 0..10_000 {
        let at = Point3::new(rng.uniform(-400.0, 400.0), rng.uniform(-400.0, 400.0), 0.0);
        let side = |rng: &mut simworld_core::seed::StreamRng| rng.uniform(1.0, 10.0);
        let shape = Shape::cuboid(side(&mut rng), side(&mut rng), side(&mut rng));
        let desc = EntityDesc::new(kind, pose_facing(at, rng.uniform(0.0, 3.0)), shape);
        world.spawn(desc).expect("a box in the world");
    }
    world
}

fn frames(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("640x480, 10,000 boxes");
    group.throughput(Throughput::Elements(1)).sample_size(20);
    let cases = [
        ("plain, no shadows", EntityKind::Prop, 0),
        ("plain, shadows", EntityKind::Prop, 2048),
        ("facades, shadows", EntityKind::Building, 2048),
    ];
    for (name, kind, shadow_resolution) in cases {
        let config = RenderConfig { shadow_resolution, ..RenderConfig::default() };
        let mut renderer = match Renderer::new(&config) {
            Ok(renderer) => renderer,
            Err(error) => {
                println!("not measured: {error}");
                return;
            }
        };
        let world = boxes(kind);
        let intrinsics = Intrinsics::from_fov(640, 480, 1.2).expect("a size in range");
        let camera =
            Camera::looking_at(Point3::new(-420.0, 0.0, 40.0), Point3::new(0.0, 0.0, 0.0), intrinsics);
        let mut frame = Frame::new();
        group.bench_function(name, |bencher| {
            bencher.iter(|| renderer.render(&world, &camera, &mut frame).expect("it is drawn"));
        });
    }
    group.finish();
}

criterion_group!(benches, frames);
criterion_main!(benches);
