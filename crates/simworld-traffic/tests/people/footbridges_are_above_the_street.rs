//! Walkers on a footbridge are above the street: they are as high as it is, drivers below do not mind them, nor do those who walk below.

use std::sync::Arc;

use simworld_core::geometry::{Point2, Point3, Twist, Vector2, pose_facing};
use simworld_core::net::{FOOTBRIDGE_STOREY, Footpath, NetworkConfig, RoadNetwork, STAIRS_GRADE, StreetPlan};
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
use simworld_core::seam::Dynamics;
use simworld_core::seed::Seed;
use simworld_traffic::{Body, Foreign, Traffic, TrafficConfig, TrafficDynamics};

/// Where the bridge crosses the southernmost street, between its junctions.
const MIDDLE: Point2 = Point2::new(60.0, 0.0);

/// A grid with a bridge over a street, from ways on both sides of it.
fn network() -> Arc<RoadNetwork> {
    let plan = StreetPlan::grid(3, 3, 120.0);
    let mut network = RoadNetwork::derive(&plan, &NetworkConfig::default()).unwrap();
    let way = |level, joins, ends: [(f64, f64); 2]| Footpath {
        path: ends.map(|(x, y)| Point2::new(x, y)).to_vec(),
        width: 3.0,
        joins,
        level,
        ..Footpath::default()
    };
    network.footpaths = vec![
        way(0, [true, false], [(40.0, -7.0), (60.0, -20.0)]),
        way(1, [false; 2], [(60.0, -20.0), (60.0, 25.0)]),
        way(0, [false, true], [(60.0, 25.0), (60.0, 113.0)]),
    ];
    network.check().unwrap();
    Arc::new(network)
}

fn config(vehicles: u32) -> TrafficConfig {
    TrafficConfig { vehicles, pedestrians: 0, pass_obstacles: false, ..TrafficConfig::default() }
}

/// Somebody on the lane below the bridge, at a height, m.
fn person(height: f64) -> Foreign {
    Foreign { height, ..Foreign::standing(MIDDLE + Vector2::new(0.0, -1.75), 0.3) }
}

/// How many vehicles pass below the bridge on that side of the street in ten minutes, and how many stand before it, step by step.
fn passing(mut step: impl FnMut(&mut Traffic)) -> (usize, usize) {
    let mut traffic = Traffic::new(network(), &config(40), Seed(3)).unwrap();
    let (mut passed, mut stood) = (0, 0);
    for _ in 0..6000 {
        let before: Vec<(u32, f64)> = traffic.vehicles().map(|it| (it.id, it.pose.translation.x)).collect();
        step(&mut traffic);
        for (id, x) in before {
            let Some(now) = traffic.vehicle(id) else { continue };
            let at = now.pose.translation;
            let is_there = (-3.5..0.0).contains(&at.y) && (at.x - MIDDLE.x).abs() < 20.0;
            passed += usize::from(is_there && x < MIDDLE.x && at.x >= MIDDLE.x);
            stood += usize::from(is_there && at.x < MIDDLE.x && now.twist.ground_speed() < 0.05);
        }
    }
    (passed, stood)
}

#[test]
fn drivers_mind_who_is_on_the_street_and_not_who_is_above_it_or_below() {
    let free = passing(|traffic| traffic.step(0.1));
    assert!(free.0 > 20, "{free:?}");
    for height in [FOOTBRIDGE_STOREY, -3.0] {
        assert_eq!(passing(|traffic| traffic.step_among(&[person(height)], 0.1)), free, "at {height} m");
    }
    let blocked = passing(|traffic| traffic.step_among(&[person(0.0)], 0.1));
    assert!(blocked.0 < 5 && blocked.1 > 1000, "{blocked:?}");
}

/// Positions and speeds of all vehicles of a world after five minutes, with somebody over a lane who belongs to others, or a walker of the
/// traffic that somebody else moves.
fn in_a_world(height: Option<f64>, is_own: bool) -> Vec<(f64, f64, f64)> {
    let mut world = World::new();
    world.set_roads(network());
    let mut dynamics = TrafficDynamics::new(&mut world, &config(40), Seed(3)).unwrap();
    let at = person(0.0).position;
    let step = |world: &mut World, dynamics: &mut TrafficDynamics| {
        world.begin_step();
        dynamics.step(world, 0.1).unwrap();
        world.finish_step();
    };
    let number = height.filter(|_| is_own).map(|_| dynamics.traffic_mut().add_walker(MIDDLE, None).unwrap());
    step(&mut world, &mut dynamics);
    if let Some(height) = height {
        let pose = pose_facing(Point3::new(at.x, at.y, height), 0.0);
        if let Some(number) = number {
            let id = dynamics.pedestrians()[number as usize];
            dynamics.hand_over(id).unwrap();
            world.set_motion(id, pose, Twist::ZERO).unwrap();
        } else {
            let shape = Shape::Capsule { radius: 0.3, height: 1.7 };
            world.spawn(EntityDesc::new(EntityKind::Person, pose, shape)).unwrap();
        }
    }
    for _ in 0..3000 {
        step(&mut world, &mut dynamics);
    }
    let place = |body: Body| (body.pose.translation.x, body.pose.translation.y, body.twist.ground_speed());
    dynamics.traffic().vehicles().map(place).collect()
}

#[test]
fn so_they_do_in_a_world() {
    let free = in_a_world(None, false);
    for is_own in [false, true] {
        assert_eq!(in_a_world(Some(FOOTBRIDGE_STOREY), is_own), free, "own: {is_own}");
        assert_ne!(in_a_world(Some(0.0), is_own), free, "own: {is_own}");
    }
}

#[test]
fn walkers_are_as_high_as_their_way() {
    let mut world = World::new();
    world.set_roads(network());
    let mut dynamics = TrafficDynamics::new(&mut world, &config(0), Seed(3)).unwrap();
    let to = Some(Point2::new(MIDDLE.x, 100.0));
    let number = dynamics.traffic_mut().add_walker(Point2::new(40.0, -7.0), to).unwrap();
    let (mut highest, mut last, mut below) = (0.0_f64, 0.0_f64, 0);
    while dynamics.traffic().walks().is_empty() {
        world.begin_step();
        dynamics.step(&mut world, 0.1).unwrap();
        world.finish_step();
        let Some(entity) = world.entity(dynamics.pedestrians()[number as usize]) else { break };
        let at = entity.pose.translation;
        // Nobody walks faster than 3 m/s; who cuts a sharp corner comes from one way to the other at a step of stairs.
        assert!((at.z - last).abs() < 0.3 * STAIRS_GRADE + 0.05, "from {last} to {} m at {}", at.z, at.y);
        let over_street = (at.y.abs() < 3.5).then_some(at.z);
        below += usize::from(over_street.is_some_and(|height| height < FOOTBRIDGE_STOREY - 1e-6));
        (highest, last) = (highest.max(at.z), at.z);
    }
    assert_eq!((highest, last, below), (FOOTBRIDGE_STOREY, 0.0, 0));
}

#[test]
fn who_walks_below_does_not_meet_who_is_above() {
    // Somebody stands in the way of who walks along the sidewalk below the bridge: on it, or on the sidewalk.
    let walk = |height: Option<f64>| {
        let mut traffic = Traffic::new(network(), &config(0), Seed(5)).unwrap();
        let id = traffic.add_walker(Point2::new(30.0, 5.0), Some(Point2::new(90.0, 5.0))).unwrap();
        let row = [3.9, 4.4, 4.9, 5.4, 5.9].map(|y| Foreign::standing(Point2::new(MIDDLE.x, y), 0.3));
        let row: Vec<Foreign> =
            row.into_iter().filter_map(|body| Some(Foreign { height: height?, ..body })).collect();
        let mut way = Vec::new();
        for _ in 0..1200 {
            traffic.step_among(&row, 0.1);
            let walker = &traffic.pedestrians()[id as usize];
            way.push(walker.is_present().then_some(walker.position));
        }
        way
    };
    let alone = walk(None);
    assert_eq!(alone.last(), Some(&None), "nobody came");
    assert_eq!(walk(Some(FOOTBRIDGE_STOREY)), alone);
    assert_ne!(walk(Some(0.0)), alone);
}

#[test]
fn heights_of_free_walkers_are_checked_and_saved() {
    let make = |seed| {
        let mut world = World::new();
        world.set_roads(network());
        let dynamics = TrafficDynamics::new(&mut world, &config(0), Seed(seed)).unwrap();
        (world, dynamics)
    };
    let (mut world, mut dynamics) = make(5);
    let traffic = dynamics.traffic_mut();
    let id = traffic.add_walker(MIDDLE, None).unwrap();
    assert_eq!(traffic.walker_height(id), FOOTBRIDGE_STOREY);
    assert!(traffic.place_walker_at_height(id, 1.0).is_err());
    traffic.free_walker(id).unwrap();
    assert_eq!(traffic.walker_height(id), FOOTBRIDGE_STOREY);
    assert!(traffic.place_walker_at_height(id, f64::NAN).is_err());
    traffic.place_walker_at_height(id, 2.5).unwrap();
    dynamics.step(&mut world, 0.1).unwrap();
    let saved = dynamics.save().unwrap();
    let (_, mut copy) = make(5);
    copy.restore(&world, &saved).unwrap();
    assert_eq!(copy.traffic().walker_height(id), 2.5);
}
