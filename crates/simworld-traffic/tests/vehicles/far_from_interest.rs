//! Far from all interest drivers decide every half second: they still touch nobody, run no red light, and get about as far.

use std::sync::Arc;

use simworld_core::geometry::Point2;
use simworld_core::hash::StateHash;
use simworld_core::net::{Aspect, CrossSection, NetworkConfig, RoadNetwork, StreetPlan};
use simworld_core::seed::Seed;
use simworld_traffic::{Body, Interest, Traffic, TrafficConfig, TrafficError};

fn grid(interest: Option<Vec<Interest>>) -> Traffic {
    let mut plan = StreetPlan::grid(5, 5, 140.0);
    plan.sections[0] = CrossSection::two_way(2, 2);
    let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("a grid is a network");
    let config = TrafficConfig { vehicles: 240, pedestrians: 100, ..TrafficConfig::default() };
    let mut traffic = Traffic::new(Arc::new(network), &config, Seed(21)).expect("the settings are in range");
    traffic.set_interest(interest).expect("the places are sound");
    traffic
}

/// Pairs of vehicles whose bodies overlap, by exact rectangles over a sweep along x.
fn collisions(bodies: &mut [Body]) -> usize {
    let solid = |body: &Body| body.shape.obb(&body.pose);
    bodies.sort_by(|a, b| a.pose.translation.x.total_cmp(&b.pose.translation.x));
    let near = |a: &Body, b: &Body| b.pose.translation.x - a.pose.translation.x < 14.0;
    let touching = |(index, a): (usize, &Body)| {
        let after = bodies[index + 1..].iter().take_while(|b| near(a, b));
        after.filter(|b| solid(a).footprints_overlap(&solid(b))).count()
    };
    bodies.iter().enumerate().map(touching).sum()
}

/// The way that everybody has come in so many steps, m; on the way nobody touches anybody or enters on red.
fn drive(traffic: &mut Traffic, steps: u32) -> f64 {
    let network = Arc::clone(traffic.network());
    let lanes = network.lanes.len() as u32;
    let mut before = vec![u32::MAX; traffic.placed().vehicles as usize];
    let (mut bodies, mut way) = (Vec::new(), 0.0);
    for step in 0..steps {
        let aspects = traffic.signals().to_vec();
        traffic.step(0.1);
        for (id, track, _, speed) in traffic.stations() {
            way += speed * 0.1;
            let old = std::mem::replace(&mut before[id as usize], track);
            if track >= lanes && old < lanes {
                let connection = &network.connections[(track - lanes) as usize];
                let red = connection.signal.is_some_and(|group| aspects[group.index()] == Aspect::Red);
                assert!(!red, "vehicle {id} entered on red at step {step}");
            }
        }
        if step % 3 == 0 {
            bodies.clear();
            bodies.extend(traffic.vehicles());
            assert_eq!(collisions(&mut bodies), 0, "vehicles touch at step {step}");
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
