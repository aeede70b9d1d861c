//! What a step of the delivery task costs: twenty couriers that decide, bid and are accounted for. Bodies stand
//! still, so the figure is the task's and the minds' alone.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use simworld_agents::delivery::{DeliveryConfig, DeliveryTask, Persona, PolicyKind};
use simworld_agents::mind::Mind;
use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityDesc, EntityKind, Place, Shape, World};
use simworld_core::seam::{Outcome, Task, TaskContext, TaskOutput};
use simworld_core::seed::Seed;

fn town() -> (World, Vec<EntityId>) {
    let mut world = World::new();
    let at = |index: usize| {
        pose_facing(Point3::new((index % 10) as f64 * 60.0, (index / 10) as f64 * 60.0, 0.0), 0.0)
    };
    for index in 0..100 {
        let place = if index % 5 == 0 { Place::Restaurant } else { Place::Home };
        let house =
            EntityDesc::new(EntityKind::Building, at(index), Shape::cuboid(10.0, 10.0, 8.0)).used_as(place);
        world.spawn(house).expect("a sound house");
    }
    let body = Shape::Capsule { radius: 0.25, height: 1.8 };
    let walker = |index| EntityDesc::new(EntityKind::Person, at(index), body);
    let couriers = (0..20).map(|index| world.spawn(walker(index)).expect("a sound walker")).collect();
    (world, couriers)
}

fn episode(world: &World, couriers: &[EntityId], steps: usize) -> DeliveryTask {
    let mut task = DeliveryTask::new(DeliveryConfig::default()).expect("the defaults are in range");
    let (mut out, mut wanted) = (TaskOutput::default(), Vec::new());
    task.reset(world, couriers, Seed(1), &mut out).expect("the town has all it needs");
    let stream = Seed(1).stream("bench");
    let mut minds: Vec<_> = (0..couriers.len())
        .map(|index| PolicyKind::ALL[index % 12].mind(Persona::default(), stream.indexed(index as u64)))
        .collect();
    for _ in 0..steps {
        let mut intents = Vec::new();
        for (mind, who) in minds.iter_mut().zip(couriers) {
            mind.decide(&task, world, *who, &mut wanted).expect("policies do not fail");
            intents.extend(wanted.drain(..).map(|intent| (*who, intent)));
        }
        out.clear();
        let context =
            TaskContext { scene: world, agents: couriers, intents: &intents, events: &[], spawned: &[] };
        task.step(&context, &mut out, &mut Outcome::default()).expect("a step succeeds");
    }
    task
}

fn steps(criterion: &mut Criterion) {
    let (world, couriers) = town();
    criterion.bench_function("delivery/20_couriers_1000_steps", |bencher| {
        bencher.iter(|| black_box(episode(&world, &couriers, 1000)));
    });
}

criterion_group!(benches, steps);
criterion_main!(benches);
