//! Drivers stop for bodies that are not the traffic's own.

use std::sync::Arc;

use simworld_core::net::{NetworkConfig, RoadNetwork, StreetPlan, polyline};
use simworld_core::seed::Seed;
use simworld_traffic::{Foreign, Traffic, TrafficConfig};

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
