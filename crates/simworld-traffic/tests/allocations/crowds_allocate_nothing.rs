//! After a warm-up, a crowd and the walkers of a city ask the heap for nothing, and come to the same bits on any threads.

use std::sync::Arc;

use crate::counting::allocations;
use simworld_core::geometry::{Point2, Vector2};
use simworld_core::net::{Alone, NetworkConfig, RoadNetwork, StreetPlan, Workers};
use simworld_core::seed::Seed;
use simworld_traffic::crowd::{AnticipationVelocity, Crowd, Person, Walls, Wish};
use simworld_traffic::{Pedestrian, Traffic, TrafficConfig};

/// So many threads, each with every so-manieth part.
struct Threads(usize);

impl Workers for Threads {
    fn run(&self, parts: usize, work: &(dyn Fn(usize) + Sync)) {
        std::thread::scope(|scope| {
            for first in 0..self.0 {
                scope.spawn(move || (first..parts).step_by(self.0).for_each(work));
            }
        });
    }
}

fn hall() -> (Vec<Person>, Vec<Wish>, Walls) {
    let mut rng = Seed(3).stream("hall").rng();
    let place = |index: u32| Point2::new(f64::from(index % 50) + 0.5, f64::from(index / 50) + 0.5);
    let people = (0..1500).map(|index| Person::standing(place(index), Vector2::x())).collect();
    let wish = |_| Wish {
        direction: if rng.chance(0.5) { Vector2::x() } else { -Vector2::x() },
        speed: rng.normal_clamped(1.34, 0.26, 0.5, 2.2),
    };
    let wishes = (0..1500).map(wish).collect();
    let at = Point2::new;
    let walls = Walls::new(vec![
        (at(0.0, 0.0), at(50.0, 0.0)),
        (at(0.0, 30.0), at(50.0, 30.0)),
        (at(0.0, 0.0), at(0.0, 30.0)),
        (at(50.0, 0.0), at(50.0, 30.0)),
    ]);
    (people, wishes, walls)
}

#[test]
fn the_counter_counts() {
    assert_eq!(allocations(&mut || drop(std::hint::black_box(Box::new(7)))), 1);
}

#[test]
fn a_crowd() {
    let (mut people, mut wishes, walls) = hall();
    let (model, mut crowd) = (AnticipationVelocity::default(), Crowd::default());
    let mut walk = |steps: u32| {
        for _ in 0..steps {
            // To and fro, so that it does not pack at the walls and more and more are seen at once.
            for (person, wish) in people.iter().zip(&mut wishes) {
                if (person.position.x - 25.0) * wish.direction.x > 23.0 {
                    wish.direction = -wish.direction;
                }
            }
            crowd.step(&model, &mut people, &wishes, &[], &walls, 0.1);
        }
    };
    walk(1200);
    assert_eq!(allocations(&mut || walk(50)), 0);
}

#[test]
fn walkers_of_a_city() {
    let network = RoadNetwork::derive(&StreetPlan::grid(3, 3, 110.0), &NetworkConfig::default()).unwrap();
    let config = TrafficConfig { vehicles: 0, pedestrians: 800, ..TrafficConfig::default() };
    let mut traffic = Traffic::new(Arc::new(network), &config, Seed(3)).unwrap();
    (0..3000).for_each(|_| traffic.step(0.1));
    assert_eq!(allocations(&mut || (0..50).for_each(|_| traffic.step(0.1))), 0);
}

#[test]
fn threads_change_no_bit() {
    let walk = |workers: &dyn Workers| {
        let (mut people, wishes, walls) = hall();
        let (model, mut crowd) = (AnticipationVelocity::default(), Crowd::default());
        for _ in 0..40 {
            crowd.step_on(workers, &model, &mut people, &wishes, &[], &walls, 0.1);
        }
        people
    };
    let alone = walk(&Alone);
    for threads in [2, 8] {
        assert_eq!(walk(&Threads(threads)), alone, "{threads} threads");
    }
}

/// Of the 150 bytes a walker may take, those here stay from step to step; the others are 24 of its decision, 32 as the others
/// see it, 4 of its rank, and 4 to 8 of its cell.
#[test]
fn a_walker_is_small() {
    assert!(size_of::<Pedestrian>() <= 80, "{} bytes", size_of::<Pedestrian>());
}

/// A walker without a journey, with its cell, its decision and everything else that a step keeps for it.
#[test]
fn a_walker_takes_no_more_than_its_share() {
    let plan = StreetPlan::grid(14, 14, 200.0);
    let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("a grid is a network");
    let config = TrafficConfig { vehicles: 0, pedestrians: 5000, ..TrafficConfig::default() };
    let mut traffic = Traffic::new(Arc::new(network), &config, Seed(3)).expect("the settings are in range");
    for _ in 0..50 {
        traffic.step(0.1);
    }
    let each = traffic.walker_bytes() as f64 / f64::from(traffic.placed().pedestrians);
    assert!(each <= 150.0, "{each} bytes");
}
