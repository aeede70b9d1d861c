//! One step of 0.1 s in a city: 20 people on foot among 120 of traffic's and some 2000 fixed solids.
//!
//! The blocks are 80 m wide with four buildings and a row of trees, lamps and bins along each side, so the couriers
//! walk along kerbs with obstacles in reach, as they do in a generated city.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use simworld_core::action::Action;
use simworld_core::geometry::Point3;
use simworld_core::geometry::{Twist, direction, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
use simworld_core::seam::Dynamics;
use simworld_core::seed::Seed;
use simworld_physics::{HumanoidConfig, PhysicsConfig, PhysicsDynamics};

const BLOCKS: i32 = 8;
const BLOCK: f64 = 80.0;

struct City {
    world: World,
    walkers: Vec<EntityId>,
    traffic: Vec<(EntityId, f64)>,
}

fn spawn(world: &mut World, kind: EntityKind, x: f64, y: f64, yaw: f64, shape: Shape) -> EntityId {
    let pose = pose_facing(Point3::new(x, y, 0.0), yaw);
    world.spawn(EntityDesc::new(kind, pose, shape)).expect("a sound entity")
}

fn city() -> City {
    let mut world = World::new();
    for (i, j) in (0..BLOCKS).flat_map(|i| (0..BLOCKS).map(move |j| (i, j))) {
        let (x, y) = (f64::from(i) * BLOCK, f64::from(j) * BLOCK);
        for (dx, dy) in [(-14.0, -14.0), (14.0, -14.0), (-14.0, 14.0), (14.0, 14.0)] {
            spawn(&mut world, EntityKind::Building, x + dx, y + dy, 0.0, Shape::cuboid(24.0, 24.0, 15.0));
        }
        for k in 0..7 {
            let along = f64::from(k) * 9.0 - 27.0;
            let pole = Shape::Cylinder { radius: 0.15, height: 5.0 };
            for side in [-32.0, 32.0] {
                spawn(&mut world, EntityKind::Tree, x + along, y + side, 0.0, pole);
                spawn(
                    &mut world,
                    EntityKind::TrashBin,
                    x + side,
                    y + along,
                    0.3,
                    Shape::cuboid(0.5, 0.5, 1.0),
                );
            }
        }
    }
    let mut rng = Seed(1).stream("bench/city").rng();
    let mut street =
        || (rng.below(BLOCKS as usize) as f64 * BLOCK, rng.uniform(-30.0, 530.0), rng.bits() % 4);
    let heading = |quarter: u64| quarter as f64 * std::f64::consts::FRAC_PI_2;
    let person = Shape::Capsule { radius: 0.25, height: 1.75 };
    let mut walkers = Vec::new();
    let mut traffic = Vec::new();
    for index in 0..140 {
        let (across, along, quarter) = street();
        let (x, y) = if quarter % 2 == 0 { (along, across + 34.0) } else { (across + 34.0, along) };
        match index {
            0..20 => walkers.push(spawn(&mut world, EntityKind::Person, x, y, heading(quarter), person)),
            20..100 => {
                let id = spawn(&mut world, EntityKind::Person, x + 1.0, y + 1.0, heading(quarter), person);
                traffic.push((id, 1.34));
            }
            _ => {
                let (x, y) = if quarter % 2 == 0 { (x, y + 4.0) } else { (x + 4.0, y) };
                let id =
                    spawn(&mut world, EntityKind::Car, x, y, heading(quarter), Shape::cuboid(4.3, 1.8, 1.5));
                traffic.push((id, 8.0));
            }
        }
    }
    City { world, walkers, traffic }
}

/// Traffic goes straight on and turns back at the edge of the city.
fn move_traffic(world: &mut World, traffic: &mut [(EntityId, f64)], dt: f64) {
    for (id, speed) in traffic {
        let entity = world.entity(*id).expect("traffic is not removed");
        let (mut pose, mut twist) = (*entity.pose, Twist::ZERO);
        let way = direction(simworld_core::geometry::yaw_of(&pose)) * *speed;
        twist.linear.x = way.x;
        twist.linear.y = way.y;
        pose.translation.vector += twist.linear * dt;
        if !(-60.0..=620.0).contains(&pose.translation.x) || !(-60.0..=620.0).contains(&pose.translation.y) {
            *speed = -*speed;
        }
        world.set_motion(*id, pose, twist).expect("a sound pose");
    }
}

fn city_tick(criterion: &mut Criterion) {
    let City { mut world, walkers, mut traffic } = city();
    let mut physics = PhysicsDynamics::new(PhysicsConfig::default()).expect("sound settings");
    for id in &walkers {
        physics.add_humanoid(&world, *id, HumanoidConfig::default()).expect("a person's shape");
    }
    let mut step = move |world: &mut World| {
        world.begin_step();
        let dt = world.clock().dt();
        move_traffic(world, &mut traffic, dt);
        let tick = world.clock().tick().0;
        for (index, id) in walkers.iter().enumerate() {
            if (tick + index as u64).is_multiple_of(100) {
                let _ = world.actuate(*id, Action::Rotate { angle: std::f64::consts::FRAC_PI_2 });
            }
            let _ = world.actuate(*id, Action::MoveForward { speed: 1.4 });
        }
        physics.step(world, dt).expect("the step goes well");
        world.finish_step();
    };
    step(&mut world);
    println!("{} entities, 20 of them walking under physics", world.len());
    criterion.bench_function("city_tick", |bencher| bencher.iter(|| step(black_box(&mut world))));
}

criterion_group!(benches, city_tick);
criterion_main!(benches);
