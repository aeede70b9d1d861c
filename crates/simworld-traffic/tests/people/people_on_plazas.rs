//! On a plaza people walk side by side, wherever there is room, and leave it nowhere but at its gates.

use std::sync::Arc;

use simworld_core::geometry::Point2;
use simworld_core::id::PlazaId;
use simworld_core::net::{Footpath, NetworkConfig, Plaza, RoadNetwork, StreetPlan};
use simworld_core::seed::Seed;
use simworld_traffic::{Pedestrian, Traffic, TrafficConfig};

/// The gates of the plaza, south and north, m: a hair beyond its edge, as rounding leaves them.
const GATES: [Point2; 2] = [Point2::new(55.3, 24.995), Point2::new(55.3, 85.005)];
/// So near to a gate people keep to the way through it, m.
const NEAR: f64 = 3.0;

fn ring(corners: &[(f64, f64)]) -> Vec<Point2> {
    corners.iter().map(|(x, y)| Point2::new(*x, *y)).collect()
}

/// A grid with a plaza of 60 m by 60 m in its first block, and things of such boxes on it: least and greatest corner, m.
fn with_plaza(things: &[[(f64, f64); 2]]) -> Arc<RoadNetwork> {
    let plan = StreetPlan::grid(3, 3, 110.0);
    let mut network = RoadNetwork::derive(&plan, &NetworkConfig::default()).unwrap();
    let hole = |[(a, b), (c, d)]: &[(f64, f64); 2]| ring(&[(*a, *b), (*a, *d), (*c, *d), (*c, *b)]);
    network.plazas = vec![Plaza {
        edge: ring(&[(25.0, 25.0), (85.0, 25.0), (85.0, 85.0), (25.0, 85.0)]),
        holes: things.iter().map(hole).collect(),
    }];
    let way = |path: [Point2; 2], joins, plaza| Footpath {
        path: path.to_vec(),
        width: 3.0,
        joins,
        plaza,
        ..Footpath::default()
    };
    network.footpaths = vec![
        way([Point2::new(55.3, 7.1), GATES[0]], [true, false], None),
        way(GATES, [false; 2], Some(PlazaId(0))),
        way([GATES[1], Point2::new(55.3, 102.9)], [false, true], None),
    ];
    network.check().unwrap();
    Arc::new(network)
}

/// What was seen of a stream of people each way across the plaza.
struct Seen {
    /// How far from the straight way they were, a number each second and walker on the plaza, m.
    aside: Vec<f64>,
    sent: usize,
    arrived: usize,
}

fn cross(network: &Arc<RoadNetwork>, seed: u64, seconds: u32) -> Seen {
    let config = TrafficConfig { vehicles: 0, pedestrians: 0, ..TrafficConfig::default() };
    let mut traffic = Traffic::new(Arc::clone(network), &config, Seed(seed)).unwrap();
    let ends = [Point2::new(55.3, 7.1), Point2::new(55.3, 102.9)];
    let mut seen = Seen { aside: Vec::new(), sent: 0, arrived: 0 };
    let plaza = &network.plazas[0];
    let is_within = |walker: &&Pedestrian| {
        let far = |gate: &Point2| (walker.position - gate).norm() > NEAR;
        walker.is_present() && GATES.iter().all(far) && (25.5..84.5).contains(&walker.position.y)
    };
    for step in 0..10 * seconds {
        if step % 20 == 0 && step < 10 * (seconds - 240) {
            for (from, to) in [(0, 1), (1, 0)] {
                seen.sent += usize::from(traffic.add_walker(ends[from], Some(ends[to])).is_ok());
            }
        }
        traffic.step(0.1);
        seen.arrived += traffic.walks().len();
        for walker in traffic.pedestrians().iter().filter(is_within) {
            assert!(plaza.contains(walker.position), "somebody at {} has left the plaza", walker.position);
            if step % 10 == 0 {
                seen.aside.push(walker.position.x - 55.3);
            }
        }
    }
    seen
}

#[test]
fn people_spread_over_a_plaza_and_all_come_across() {
    let seen = cross(&with_plaza(&[]), 4, 460);
    assert!(seen.sent > 150 && seen.arrived == seen.sent, "{} of {}", seen.arrived, seen.sent);
    let count = seen.aside.len() as f64;
    let mean = seen.aside.iter().sum::<f64>() / count;
    let spread = (seen.aside.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / count).sqrt();
    assert!(spread > 3.0, "within {spread} m of the way");
    assert!(mean.abs() < 1.0, "{mean} m beside the way");
}

#[test]
fn nobody_walks_into_what_stands_on_a_plaza() {
    let seeds = if std::env::var_os("SIMWORLD_SOAK").is_some() { 400 } else { 12 };
    for seed in 0..seeds {
        let mut rng = Seed(seed).stream("things").rng();
        let mut things = Vec::new();
        for _ in 0..8 {
            let (x, y) = (rng.uniform(27.0, 80.0), rng.uniform(29.0, 76.0));
            let (w, d) = (rng.uniform(1.0, 5.0), rng.uniform(1.0, 5.0));
            let is_on_the_way = x - 0.8 < 55.3 && x + w + 0.8 > 55.3;
            let touches = |other: &[(f64, f64); 2]| {
                let [(a, b), (c, d2)] = *other;
                x < c + 0.5 && a < x + w + 0.5 && y < d2 + 0.5 && b < y + d + 0.5
            };
            if !is_on_the_way && !things.iter().any(touches) {
                things.push([(x, y), (x + w, y + d)]);
            }
        }
        let seen = cross(&with_plaza(&things), seed, 360);
        assert!(seen.sent > 80 && seen.arrived == seen.sent, "{seed}: {} of {}", seen.arrived, seen.sent);
    }
}
