//! Rain, snow and fog: slower, farther apart, and nobody hits anybody.

use std::sync::Arc;

use simworld_core::environment::{Environment, Weather};
use simworld_core::geometry::Point2;
use simworld_core::hash::StateHash;
use simworld_core::id::RoadId;
use simworld_core::net::{LaneDirection, NetworkConfig, RoadNetwork, Street, StreetPlan};
use simworld_core::scene::World;
use simworld_core::seam::Dynamics;
use simworld_core::seed::Seed;
use simworld_traffic::vehicle::VehicleKind;
use simworld_traffic::{
    Arrivals, DrivingConditions, Flow, Leg, Route, Traffic, TrafficConfig, TrafficDynamics,
};

/// A straight road of a kilometre.
fn road() -> Arc<RoadNetwork> {
    let mut plan =
        StreetPlan { nodes: vec![Point2::new(0.0, 0.0), Point2::new(1000.0, 0.0)], ..StreetPlan::default() };
    plan.streets.push(Street::simple(0, 1));
    Arc::new(RoadNetwork::derive(&plan, &NetworkConfig::default()).unwrap())
}

fn weather(rain: f64, snow: f64) -> DrivingConditions {
    DrivingConditions::from_weather(&Weather { rain, snow, ..Weather::default() })
}

/// Trips in twenty minutes at a demand, and their mean time, s.
fn trips(per_hour: f64, conditions: DrivingConditions) -> (usize, f64) {
    let mut config = TrafficConfig { vehicles: 0, pedestrians: 0, conditions, ..TrafficConfig::default() };
    config.types.iter_mut().for_each(|row| row.speed_deviation = 0.0);
    let mut traffic = Traffic::new(road(), &config, Seed(1)).unwrap();
    let route = Route(vec![Leg::new(RoadId(0), LaneDirection::Forward)]);
    let flow =
        Flow { kind: Some(VehicleKind::Car), arrivals: Arrivals::Uniform, ..Flow::new(route, per_hour) };
    traffic.add_flow(flow).unwrap();
    let (mut count, mut time) = (0, 0.0);
    for step in 0..15_000 {
        traffic.step(0.1);
        for trip in traffic.ended().iter().filter(|_| step > 3000) {
            count += 1;
            time += trip.left - trip.entered;
        }
    }
    (count, time / count as f64)
}

#[test]
fn free_speeds_fall_as_published() {
    let (_, dry) = trips(20.0, DrivingConditions::default());
    for conditions in [weather(1.0, 0.0), weather(20.0, 0.0), weather(0.0, 20.0)] {
        let (_, time) = trips(20.0, conditions);
        let kept = dry / time;
        assert!((kept - conditions.speed).abs() < 0.02, "{kept} of the speed in {conditions:?}");
    }
}

/// Vehicles that a queue which never ends sends over a signal in half an hour.
fn discharge(conditions: DrivingConditions) -> f64 {
    // A long green, so that what passes in one is more than a few.
    let signals = NetworkConfig { green: 60.0, ..NetworkConfig::default() };
    let network = RoadNetwork::derive(&StreetPlan::crossroads(400.0), &signals).unwrap();
    let mut config = TrafficConfig { vehicles: 0, pedestrians: 0, conditions, ..TrafficConfig::default() };
    config.types.iter_mut().for_each(|row| row.speed_deviation = 0.0);
    let mut traffic = Traffic::new(Arc::new(network), &config, Seed(1)).unwrap();
    let across = Route(vec![
        Leg::new(RoadId(0), LaneDirection::Backward),
        Leg::new(RoadId(2), LaneDirection::Forward),
    ]);
    traffic.add_flow(Flow { kind: Some(VehicleKind::Car), ..Flow::new(across, 2500.0) }).unwrap();
    (0..3000).for_each(|_| traffic.step(0.1));
    let before = traffic.counters().crossings;
    (0..18_000).for_each(|_| traffic.step(0.1));
    assert!(traffic.outside() > 50, "the queue was to be endless");
    (traffic.counters().crossings - before) as f64
}

#[test]
fn capacities_fall_as_published() {
    let dry = discharge(DrivingConditions::default());
    for conditions in [weather(4.0, 0.0), weather(20.0, 0.0), weather(0.0, 20.0)] {
        let kept = discharge(conditions) / dry;
        println!("{kept:.3} of the capacity where {} was measured", conditions.capacity);
        assert!((kept - conditions.capacity).abs() < 0.06, "{kept} of the capacity in {conditions:?}");
    }
}

#[test]
fn in_fog_one_drives_as_far_as_one_sees() {
    let fog = |visibility| DrivingConditions { visibility, ..DrivingConditions::default() };
    let ((_, near), (_, far)) = (trips(20.0, fog(30.0)), trips(20.0, fog(5000.0)));
    let speed = 1000.0 / near;
    assert!((speed / fog(30.0).sight_speed() - 1.0).abs() < 0.08, "{speed} m/s");
    assert!(far < near * 0.75);
}

#[test]
fn the_weather_of_the_world_is_minded_and_saved() {
    let network = RoadNetwork::derive(&StreetPlan::grid(3, 3, 120.0), &NetworkConfig::default()).unwrap();
    let mut world = World::new();
    world.set_roads(Arc::new(network));
    let bare = world.clone();
    let config = TrafficConfig { vehicles: 50, pedestrians: 10, ..TrafficConfig::default() };
    let mut dynamics = TrafficDynamics::new(&mut world, &config, Seed(1)).unwrap();
    let mut resumed = TrafficDynamics::new(&mut bare.clone(), &config, Seed(1)).unwrap();
    let run = |dynamics: &mut TrafficDynamics, world: &mut World, steps: u32| {
        (0..steps).for_each(|_| dynamics.step(world, 0.1).unwrap());
    };
    run(&mut dynamics, &mut world, 300);
    let snow = Weather { snow: 15.0, temperature: -5.0, ..Weather::default() };
    world.set_environment(Environment { weather: snow, ..Environment::default() }).unwrap();
    run(&mut dynamics, &mut world, 300);
    assert_eq!(dynamics.traffic().conditions(), DrivingConditions::from_weather(&snow));
    let saved = dynamics.save().unwrap();
    let mut copy = world.clone();
    resumed.restore(&copy, &saved).unwrap();
    run(&mut dynamics, &mut world, 300);
    run(&mut resumed, &mut copy, 300);
    assert_eq!(dynamics.traffic().digest(), resumed.traffic().digest());
    let counters = dynamics.traffic().counters();
    assert_eq!((counters.forced_stops, counters.locks), (0, 0), "{counters:?}");
    // The sky clears.
    world.set_environment(Environment::default()).unwrap();
    run(&mut dynamics, &mut world, 1);
    assert_eq!(dynamics.traffic().conditions(), DrivingConditions::default());
}
