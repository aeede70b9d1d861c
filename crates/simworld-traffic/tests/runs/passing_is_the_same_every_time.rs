//! Who passes what stands on a lane does so to the bit on any number of threads, and goes on from what was saved in the middle of it.

use std::sync::Arc;

use simworld_core::geometry::{Point2, Point3, pose_facing};
use simworld_core::hash::{StateDigest, StateHash};
use simworld_core::id::RoadId;
use simworld_core::net::{LaneDirection, NetworkConfig, RoadNetwork, Street, StreetPlan, Workers, polyline};
use simworld_core::scene::{EntityDesc, EntityKind, Shape, World};
use simworld_core::seam::Dynamics;
use simworld_core::seed::Seed;
use simworld_traffic::{Flow, Foreign, Leg, Route, Traffic, TrafficConfig, TrafficDynamics};

use crate::lent_threads::Threads;

/// A city of several parts with a cone on every fifth street.
fn digests(workers: Option<Box<dyn Workers + Send + Sync>>) -> Vec<StateDigest> {
    let network = RoadNetwork::derive(&StreetPlan::grid(12, 12, 110.0), &NetworkConfig::default());
    let network = Arc::new(network.expect("a grid is a network"));
    let config = TrafficConfig { vehicles: 400, pedestrians: 0, ..TrafficConfig::default() };
    let mut traffic = Traffic::new(Arc::clone(&network), &config, Seed(8)).expect("sound settings");
    if let Some(workers) = workers {
        traffic.set_workers(workers);
    }
    let taken: Vec<(u32, f64)> = traffic.stations().map(|at| (at.1, at.2)).collect();
    let is_free = |lane: u32| taken.iter().all(|(track, s)| *track != lane || (s - 35.0).abs() > 15.0);
    let cones: Vec<Foreign> = (0..network.lanes.len())
        .step_by(5)
        .filter(|lane| network.lanes[*lane].is_driven() && is_free(*lane as u32))
        .map(|lane| Foreign::standing(polyline::at(&network.lanes[lane].path, 35.0).0, 0.2))
        .collect();
    let digests = (0..8).map(|_| {
        (0..100).for_each(|_| traffic.step_among(&cones, 0.1));
        traffic.digest()
    });
    let digests = digests.collect();
    let counters = traffic.counters();
    assert!(counters.obstacles_passed > 20, "they pass the cones: {counters:?}");
    digests
}

#[test]
fn passing_is_the_same_on_any_number_of_threads() {
    let alone = digests(None);
    assert_eq!(alone, digests(Some(Box::new(Threads(2)))));
}

/// A street with a cone in a world, and traffic both ways.
fn street() -> (World, TrafficDynamics) {
    let plan = StreetPlan {
        nodes: vec![Point2::new(0.0, 0.0), Point2::new(300.0, 0.0)],
        streets: vec![Street::simple(0, 1)],
        ..StreetPlan::default()
    };
    let network = RoadNetwork::derive(&plan, &NetworkConfig::default());
    let network = Arc::new(network.expect("a street is a network"));
    let mut world = World::new();
    world.set_roads(Arc::clone(&network));
    let config = TrafficConfig { vehicles: 0, pedestrians: 0, ..TrafficConfig::default() };
    let mut traffic = TrafficDynamics::new(&mut world, &config, Seed(4)).expect("it has roads");
    for direction in [LaneDirection::Forward, LaneDirection::Backward] {
        let route = Route(vec![Leg::new(RoadId(0), direction)]);
        let flow = Flow { until: 300.0, ..Flow::new(route, 150.0) };
        traffic.traffic_mut().add_flow(flow).expect("it can be driven");
    }
    let lane = network.roads[0].forward[0];
    let at = polyline::at(&network.lanes[lane.index()].path, 140.0).0;
    let pose = pose_facing(Point3::new(at.x, at.y, 0.0), 0.0);
    let cone = EntityDesc::new(EntityKind::Cone, pose, Shape::Cylinder { radius: 0.2, height: 0.7 });
    world.spawn(cone).expect("a cone on the street");
    (world, traffic)
}

fn run(world: &mut World, traffic: &mut TrafficDynamics, steps: usize) {
    for _ in 0..steps {
        world.begin_step();
        traffic.step(world, 0.1).expect("traffic flows");
        world.finish_step();
    }
}

#[test]
fn what_was_saved_in_the_middle_of_it_goes_on() {
    let (mut world, mut traffic) = street();
    while traffic.traffic().counters().obstacles_passed < 2 {
        assert!(traffic.traffic().seconds() < 240.0, "nobody passes the cone");
        run(&mut world, &mut traffic, 1);
    }
    // At once, half way out, and by.
    let mut saves = Vec::new();
    for steps in [0, 15, 30] {
        run(&mut world, &mut traffic, steps);
        saves.push((traffic.traffic().seconds(), world.clone(), traffic.save().expect("it can be saved")));
    }
    run(&mut world, &mut traffic, 600);
    for (saved_at, mut copy, saved) in saves {
        let (_, mut resumed) = street();
        resumed.restore(&copy, &saved).expect("it is of this traffic");
        let left = ((traffic.traffic().seconds() - saved_at) / 0.1).round() as usize;
        run(&mut copy, &mut resumed, left);
        assert_eq!(resumed.traffic().digest(), traffic.traffic().digest(), "saved at {saved_at} s");
    }
    assert!(traffic.traffic().counters().obstacles_passed > 2, "others passed it since");
}
