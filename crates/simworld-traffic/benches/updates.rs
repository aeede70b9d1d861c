//! Vehicle and pedestrian updates per second on one core: on a grid with 7 to 8 vehicles per lane-kilometre, and in a crowd
//! of 10 000 between walls at one per m².

use std::sync::Arc;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use simworld_core::geometry::{Point2, Vector2};
use simworld_core::net::{NetworkConfig, RoadNetwork, StreetPlan};
use simworld_core::seed::Seed;
use simworld_traffic::crowd::{AnticipationVelocity, Crowd, Person, Walls, Wish};
use simworld_traffic::{Traffic, TrafficConfig};

/// Traffic after its first minute, when it has left its starting places.
fn running(columns: usize, vehicles: u32, pedestrians: u32) -> Traffic {
    let plan = StreetPlan::grid(columns, columns, 200.0);
    let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("a grid is a network");
    let config = TrafficConfig { vehicles, pedestrians, ..TrafficConfig::default() };
    let mut traffic = Traffic::new(Arc::new(network), &config, Seed(1)).expect("the settings are in range");
    assert_eq!((traffic.placed().vehicles, traffic.placed().pedestrians), (vehicles, pedestrians));
    for _ in 0..600 {
        traffic.step(0.1);
    }
    traffic
}

fn updates(c: &mut Criterion) {
    let mut group = c.benchmark_group("updates");
    for (name, columns, vehicles, pedestrians) in [
        ("1k vehicles", 13, 1_000, 0),
        ("10k vehicles", 42, 10_000, 0),
        ("10k pedestrians", 19, 0, 10_000),
        ("10k vehicles, 10k pedestrians", 42, 10_000, 10_000),
    ] {
        let mut traffic = running(columns, vehicles, pedestrians);
        group.throughput(Throughput::Elements(u64::from(vehicles + pedestrians)));
        group.bench_function(name, |bencher| bencher.iter(|| traffic.step(0.1)));
    }
    group.finish();
}

/// Ten thousand people who walk to and fro in ten halls of 100 by 10 m, half of them each way.
fn crowd(c: &mut Criterion) {
    let model = AnticipationVelocity::default();
    let mut rng = Seed(1).stream("halls").rng();
    let place = |index: u32| Point2::new(f64::from(index % 100) + 0.5, f64::from(index / 100) + 0.5);
    let mut people: Vec<Person> =
        (0..10_000).map(|index| Person::standing(place(index), Vector2::x())).collect();
    let mut wishes: Vec<Wish> = people
        .iter()
        .map(|_| {
            let direction = if rng.unit() < 0.5 { Vector2::x() } else { -Vector2::x() };
            Wish { direction, speed: rng.normal_clamped(1.34, 0.26, 0.5, 2.2) }
        })
        .collect();
    let at = Point2::new;
    let mut walls: Vec<(Point2, Point2)> =
        (0..=10).map(|hall| f64::from(hall) * 10.0).map(|y| (at(0.0, y), at(100.0, y))).collect();
    walls.extend([0.0, 100.0].map(|x| (at(x, 0.0), at(x, 100.0))));
    let (walls, mut crowd) = (Walls::new(walls), Crowd::default());
    let mut step = || {
        for (person, wish) in people.iter().zip(&mut wishes) {
            if (person.position.x - 50.0) * wish.direction.x > 48.0 {
                wish.direction = -wish.direction;
            }
        }
        crowd.step(&model, &mut people, &wishes, &[], &walls, 0.1);
    };
    for _ in 0..600 {
        step();
    }
    let mut group = c.benchmark_group("crowd");
    group.throughput(Throughput::Elements(10_000));
    group.bench_function("10k pedestrians between walls, 1 per m²", |bencher| bencher.iter(&mut step));
    group.finish();
}

criterion_group!(benches, updates, crowd);
criterion_main!(benches);
