//! Drivers stop for bodies that are not the traffic's own.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_3};
use std::sync::Arc;

use simworld_core::geometry::{Point3, Vector2, direction, planar, pose_facing, yaw_of};
use simworld_core::net::{NetworkConfig, RoadNetwork, StreetPlan, Turn, polyline};
use simworld_core::scene::Shape;
use simworld_core::seed::Seed;
use simworld_traffic::vehicle::VehicleType;
use simworld_traffic::{Body, Foreign, Traffic, TrafficConfig};

#[test]
fn drivers_stop_behind_a_body_on_their_lane() {
    let config = TrafficConfig { vehicles: 40, pedestrians: 0, ..TrafficConfig::default() };
    let plan = StreetPlan::grid(3, 3, 120.0);
    let network = Arc::new(RoadNetwork::derive(&plan, &NetworkConfig::default()).unwrap());
    let mut traffic = Traffic::new(Arc::clone(&network), &config, Seed(1)).unwrap();
    // Towards the end of the first lane that nobody has reached yet.
    let taken: Vec<(u32, f64)> = traffic.stations().map(|(_, track, s, _)| (track, s)).collect();
    let lane = (0..network.lanes.len())
        .find(|lane| taken.iter().all(|(track, s)| *track as usize != *lane || *s < 30.0))
        .expect("a lane whose second half is free");
    let station = network.lanes[lane].length - 25.0;
    let position = polyline::at(&network.lanes[lane].path, station).0;
    let body = Foreign::standing(position, 0.3);
    let mut nearest = f64::INFINITY;
    for step in 0..3000 {
        traffic.step_among(&[body], 0.1);
        for vehicle in traffic.vehicles() {
            let distance = vehicle.shape.planar_distance(&vehicle.pose, &position);
            nearest = nearest.min(distance);
            assert!(distance > body.radius, "step {step}: {vehicle:?} drove into the body");
        }
    }
    assert!(nearest < 5.0, "nobody ever came: {nearest} m");
}

#[test]
fn nobody_starts_into_a_body_that_swings_round_before_it() {
    let config =
        TrafficConfig { vehicles: 40, pedestrians: 0, pass_obstacles: false, ..TrafficConfig::default() };
    let plan = StreetPlan::grid(3, 3, 120.0);
    let network = Arc::new(RoadNetwork::derive(&plan, &NetworkConfig::default()).unwrap());
    let mut traffic = Traffic::new(Arc::clone(&network), &config, Seed(1)).unwrap();
    let lane =
        (0..network.lanes.len()).find(|lane| network.lanes[*lane].length > 80.0).expect("streets are long");
    let blocked = polyline::at(&network.lanes[lane].path, network.lanes[lane].length - 25.0).0;
    for _ in 0..1500 {
        traffic.step_among(&[Foreign::standing(blocked, 0.3)], 0.1);
    }
    let distance = |body: &Body| body.shape.planar_distance(&body.pose, &blocked);
    let first =
        traffic.vehicles().min_by(|a, b| distance(a).total_cmp(&distance(b))).expect("there are vehicles");
    assert!(
        first.twist.ground_speed() < 0.05 && distance(&first) < 5.0,
        "nobody stands before it: {first:?}"
    );
    // A truck that turns round in the street: it stands across the lane, one of its sides beside the nose of who waits.
    let yaw = yaw_of(&first.pose);
    let (ahead, left) = (direction(yaw), direction(yaw + FRAC_PI_2));
    let middle = planar(&first.pose) + ahead * (first.shape.size().x * 0.5 + 1.1) + left * 1.75;
    let axis = yaw + FRAC_PI_3 * 2.0;
    let truck = Foreign {
        position: middle,
        radius: 3.5,
        half_width: 1.2,
        direction: direction(axis),
        velocity: Vector2::zeros(),
        height: 0.0,
    };
    let solid = Shape::cuboid(7.0, 2.4, 3.0).obb(&pose_facing(Point3::new(middle.x, middle.y, 0.0), axis));
    for step in 0..300 {
        for vehicle in traffic.vehicles() {
            let touches = vehicle.shape.obb(&vehicle.pose).footprints_overlap(&solid);
            assert!(!touches, "step {step}: {vehicle:?} drove into the truck");
        }
        traffic.step_among(&[truck], 0.1);
    }
    // When it is gone one goes on.
    (0..300).for_each(|_| traffic.step(0.1));
    let gone =
        traffic.vehicle(first.id).is_none_or(|now| (planar(&now.pose) - planar(&first.pose)).norm() > 20.0);
    assert!(gone, "it never started again");
}

/// A car that has half pulled out leaves room for cars and none for buses.
#[test]
fn the_broad_stop_where_the_narrow_have_room() {
    for (width, passes) in [(1.8, true), (2.5, false)] {
        let types = vec![VehicleType { width, ..VehicleType::default() }];
        // Over the oncoming lane both would pass.
        let config = TrafficConfig {
            vehicles: 40,
            pedestrians: 0,
            types,
            pass_obstacles: false,
            ..TrafficConfig::default()
        };
        let network = Arc::new(
            RoadNetwork::derive(&StreetPlan::grid(3, 3, 120.0), &NetworkConfig::default())
                .expect("a grid is a network"),
        );
        let mut traffic = Traffic::new(Arc::clone(&network), &config, Seed(1)).expect("sound settings");
        let path = &network
            .lanes
            .iter()
            .find(|lane| lane.length > 80.0 && lane.is_driven())
            .expect("streets are long")
            .path;
        let (place, yaw) = polyline::at(path, 60.0);
        let edge = 1.35;
        let middle = place - direction(yaw + FRAC_PI_2) * (edge + 0.9);
        let parked = Foreign {
            radius: 2.25,
            half_width: 0.9,
            direction: direction(yaw),
            ..Foreign::standing(middle, 0.0)
        };
        let solid = Shape::cuboid(4.5, 1.8, 1.5).obb(&pose_facing(Point3::new(middle.x, middle.y, 0.0), yaw));
        let (mut beside, mut behind) = (0, 0);
        for step in 0..2000 {
            traffic.step_among(&[parked], 0.1);
            for vehicle in traffic.vehicles() {
                let touches = vehicle.shape.obb(&vehicle.pose).footprints_overlap(&solid);
                assert!(!touches, "step {step}: {vehicle:?} drove along the car");
                let way = planar(&vehicle.pose) - place;
                let along = way.dot(&direction(yaw));
                let is_there = way.perp(&direction(yaw)).abs() < 0.5 && along.abs() < 12.0;
                beside += usize::from(is_there && along.abs() < 2.0);
                behind += usize::from(is_there && along < -4.0 && vehicle.twist.ground_speed() < 0.1);
            }
        }
        assert_eq!(beside > 0, passes, "{width} m wide: {beside} steps beside it, {behind} behind it");
        assert_eq!(behind > 500, !passes, "{width} m wide: {beside} steps beside it, {behind} behind it");
    }
}

/// Strangers run through junctions as if they were alone, at any time. Who has leave to cross lets them pass, where a driver of the
/// traffic would not come.
#[test]
fn strangers_that_keep_no_rules_are_let_pass() {
    let config = TrafficConfig { vehicles: 70, pedestrians: 0, ..TrafficConfig::default() };
    let plan = StreetPlan::grid(3, 3, 120.0);
    let network = Arc::new(RoadNetwork::derive(&plan, &NetworkConfig::default()).unwrap());
    let mut traffic = Traffic::new(Arc::clone(&network), &config, Seed(1)).unwrap();
    let ways: Vec<_> = network.connections.iter().filter(|way| way.turn == Turn::Straight).collect();
    let mut rng = Seed(3).stream("test/strangers").rng();
    let (mut passes, mut contacts) = (0, 0);
    while passes < 200 {
        (0..20).for_each(|_| traffic.step(0.1));
        let way = ways[rng.below(ways.len())];
        let start = way.path[0];
        let shape = Shape::cuboid(4.5, 1.8, 1.5);
        let near = |body: &Body| body.shape.planar_distance(&body.pose, &start) < 9.0;
        if traffic.vehicles().any(|body| near(&body)) {
            continue;
        }
        passes += 1;
        let (mut station, mut v, mut touched) = (0.0_f64, 1.0_f64, false);
        while station < way.length + 3.0 {
            v = (v + 0.2).min(8.0);
            station += v * 0.1;
            let (at, yaw) = polyline::at(&way.path, station.min(way.length));
            let at = at + direction(yaw) * (station - way.length).max(0.0);
            let solid = shape.obb(&pose_facing(Point3::new(at.x, at.y, 0.0), yaw));
            let stranger = Foreign {
                position: at,
                radius: 2.25,
                half_width: 0.9,
                direction: direction(yaw),
                velocity: direction(yaw) * v,
                height: 0.0,
            };
            traffic.step_among(&[stranger], 0.1);
            touched |= traffic.vehicles().any(|body| {
                body.twist.ground_speed() > 0.3 && body.shape.obb(&body.pose).footprints_overlap(&solid)
            });
        }
        contacts += usize::from(touched);
    }
    // Some come too late for anybody to stop. Who looks only when leave is given touches 29.
    assert!(contacts <= 18, "{contacts} of {passes} strangers were touched by who drove");
}
