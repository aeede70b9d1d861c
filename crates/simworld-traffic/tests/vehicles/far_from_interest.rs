//! Far from all interest the traffic goes once a round of half a second: nobody touches anybody or runs a red light, also where
//! it meets the traffic near an interest, and everybody gets about as far.

use std::sync::Arc;

use simworld_core::geometry::{Point2, planar};
use simworld_core::hash::StateHash;
use simworld_core::net::{Aspect, CrossSection, NetworkConfig, RoadNetwork, StreetPlan};
use simworld_core::scene::World;
use simworld_core::seam::Dynamics;
use simworld_core::seed::Seed;
use simworld_traffic::{Body, Drive, Interest, Traffic, TrafficConfig, TrafficDynamics, TrafficError};

use crate::contacts::assert_apart;

fn grid(interest: Option<Vec<Interest>>) -> Traffic {
    grid_of(5, 240, interest)
}

/// A grid of so many junctions along each side, with so many vehicles.
fn grid_of(junctions: usize, vehicles: u32, interest: Option<Vec<Interest>>) -> Traffic {
    let mut plan = StreetPlan::grid(junctions, junctions, 140.0);
    plan.sections[0] = CrossSection::two_way(2, 2);
    let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("a grid is a network");
    let config = TrafficConfig { vehicles, pedestrians: 100, ..TrafficConfig::default() };
    let mut traffic = Traffic::new(Arc::new(network), &config, Seed(21)).expect("the settings are in range");
    traffic.set_interest(interest).expect("the places are sound");
    traffic
}

/// Where the vehicles are, by number.
fn places(traffic: &Traffic) -> Vec<Point2> {
    let mut bodies: Vec<Body> = traffic.vehicles().collect();
    bodies.sort_by_key(|body| body.id);
    bodies.iter().map(|body| planar(&body.pose)).collect()
}

/// The way that everybody has come in so many steps, m, straight from second to second; on the way nobody touches anybody or enters on red.
fn drive(traffic: &mut Traffic, steps: u32) -> f64 {
    let network = Arc::clone(traffic.network());
    let lanes = network.lanes.len() as u32;
    let mut before = vec![u32::MAX; traffic.placed().vehicles as usize];
    let mut way = 0.0;
    let mut places = places(traffic);
    for step in 0..steps {
        let aspects = traffic.signals().to_vec();
        traffic.step(0.1);
        for (id, track, _, _) in traffic.stations() {
            let old = std::mem::replace(&mut before[id as usize], track);
            if track >= lanes && old < lanes {
                let connection = &network.connections[(track - lanes) as usize];
                let red = connection.signal.is_some_and(|group| aspects[group.index()] == Aspect::Red);
                assert!(!red, "vehicle {id} entered on red at step {step}");
            }
        }
        if step % 10 == 9 {
            let now = self::places(traffic);
            way += places.iter().zip(&now).map(|(old, new)| (new - old).norm()).sum::<f64>();
            places = now;
        }
        if step % 3 == 0 {
            assert_apart(traffic, step as usize);
        }
    }
    way
}

#[test]
fn far_from_interest_traffic_is_as_safe_and_about_as_fast() {
    let (mut near, mut far) = (grid(None), grid(Some(Vec::new())));
    let (all, rare) = (drive(&mut near, 4000), drive(&mut far, 4000));
    assert_ne!(near.digest(), far.digest(), "fewer decisions are other decisions");
    assert!((rare / all - 1.0).abs() < 0.1, "{rare:.0} m far from interest, {all:.0} m near it");
    let counters = far.counters();
    assert!(counters.lane_changes > 20 && counters.crossings > 240, "{counters:?}");
    // The hard stop that backs up half a second without a look is hardly ever needed.
    assert!(counters.forced_stops * 10_000 < counters.updates, "{counters:?}");
}

/// An interest in the corner of a grid of several parts.
fn corner() -> Vec<Interest> {
    vec![Interest { center: Point2::origin(), radius: 300.0 }]
}

/// How many vehicles have moved in a step, beside those that go at all.
fn movers(traffic: &mut Traffic) -> usize {
    let before = places(traffic);
    traffic.step(0.1);
    before.iter().zip(places(traffic)).filter(|(old, new)| *old != new).count()
}

#[test]
fn near_and_far_traffic_meet_safely() {
    let mut whole = grid_of(9, 700, None);
    let mut part = grid_of(9, 700, Some(corner()));
    let (all, some) = (drive(&mut whole, 2500), drive(&mut part, 2500));
    assert!((some / all - 1.0).abs() < 0.1, "{some:.0} m where some are far, {all:.0} m where nobody is");
    // Rounds end after the fifth step of five: until then only those near the corner move.
    let counts: Vec<usize> = (0..5).map(|_| movers(&mut part)).collect();
    assert!(counts[..4].iter().all(|count| (1..counts[4] / 2).contains(count)), "{counts:?}");
}

#[test]
fn who_is_driven_moves_in_every_step_wherever_it_is() {
    let mut traffic = grid_of(9, 700, Some(Vec::new()));
    (0..100).for_each(|_| traffic.step(0.1));
    let id = traffic.stations().max_by(|a, b| a.3.total_cmp(&b.3)).expect("somebody drives").0;
    traffic.drive(id, Drive::default()).expect("it is on a lane");
    for _ in 0..20 {
        let before = traffic.vehicle(id).expect("it is there");
        traffic.step(0.1);
        let after = traffic.vehicle(id).expect("it is there");
        let way = (planar(&after.pose) - planar(&before.pose)).norm();
        assert!((way - after.twist.linear.norm() * 0.1).abs() < 0.1, "{way} m in a step");
    }
}

#[test]
fn interest_that_moves_harms_nobody() {
    let mut traffic = grid_of(9, 700, None);
    for turn in 0..12 {
        let center = Point2::new(100.0 * f64::from(turn), 100.0 * f64::from(turn));
        traffic.set_interest(Some(vec![Interest { center, radius: 250.0 }])).expect("the place is sound");
        // In the middle of a round, so that those who come near are behind.
        drive(&mut traffic, 93);
    }
}

#[test]
fn saved_in_the_middle_of_a_round_it_goes_on_to_the_bit() {
    let network = Arc::clone(grid_of(9, 0, None).network());
    let config = TrafficConfig { vehicles: 700, pedestrians: 300, ..TrafficConfig::default() };
    let made = || {
        let mut world = World::new();
        world.set_roads(Arc::clone(&network));
        let dynamics = TrafficDynamics::new(&mut world, &config, Seed(21)).expect("there is room");
        (world, dynamics)
    };
    let (mut world, mut dynamics) = made();
    dynamics.traffic_mut().set_interest(Some(corner())).expect("the place is sound");
    (0..203).for_each(|_| dynamics.step(&mut world, 0.1).expect("the world is its own"));
    let saved = dynamics.save().expect("all of it can be saved");
    let (_, mut again) = made();
    again.restore(&world, &saved).expect("it is a state of such traffic");
    let mut copy = world.clone();
    for number in 0..60 {
        dynamics.step(&mut world, 0.1).expect("the world is its own");
        again.step(&mut copy, 0.1).expect("the world is as it was");
        assert_eq!(dynamics.traffic().digest(), again.traffic().digest(), "step {number}");
    }
}

#[test]
fn an_interest_that_reaches_all_is_as_none() {
    let center = Point2::new(280.0, 280.0);
    let mut all = grid(Some(vec![Interest { center, radius: 1e4 }]));
    let mut none = grid(None);
    for _ in 0..300 {
        all.step(0.1);
        none.step(0.1);
    }
    assert_eq!(all.digest(), none.digest());
}

#[test]
fn an_unsound_interest_is_refused() {
    let mut traffic = grid(None);
    for (radius, x, field) in [
        (-1.0, 0.0, "interest.radius"),
        (f64::NAN, 0.0, "interest.radius"),
        (1.0, f64::NAN, "interest.center"),
    ] {
        let place = Interest { center: Point2::new(x, 0.0), radius };
        let refused = traffic.set_interest(Some(vec![place]));
        assert!(
            matches!(refused, Err(TrafficError::Config { field: found, .. }) if found == field),
            "{refused:?}"
        );
    }
}
