//! Walkers begin to cross on walk alone, are across before the cars come, and leave the carriageway otherwise; however many
//! they are, they keep apart and get on.

use std::sync::Arc;

use simworld_core::net::{Aspect, NetworkConfig, RoadNetwork, StreetPlan, polyline};
use simworld_core::seed::Seed;
use simworld_traffic::{Traffic, TrafficConfig};

#[test]
fn walker_never_enters_closed_crosswalk() {
    let network =
        Arc::new(RoadNetwork::derive(&StreetPlan::grid(3, 3, 110.0), &NetworkConfig::default()).unwrap());
    let config =
        TrafficConfig { vehicles: 25, pedestrians: 200, crossing_weight: 3.0, ..TrafficConfig::default() };
    let mut traffic = Traffic::new(Arc::clone(&network), &config, Seed(2)).unwrap();
    let mut was_on = vec![None; 200];
    let mut begun = 0;
    for step in 0..6000 {
        let aspects = traffic.signals().to_vec();
        traffic.step(0.1);
        for (index, walker) in traffic.pedestrians().iter().enumerate() {
            if let Some(crossing) = walker.crossing() {
                let signal = network.crossings[crossing.index()].signal.expect("every crossing has a signal");
                let aspect = aspects[signal.index()];
                if was_on[index] != Some(crossing) {
                    assert_eq!(
                        aspect,
                        Aspect::Green,
                        "walker {index} began to cross on {aspect:?} at step {step}"
                    );
                    begun += 1;
                }
                assert_ne!(aspect, Aspect::Red, "walker {index} is still on the road at step {step}");
            }
            was_on[index] = walker.crossing();
        }
    }
    assert!(begun > 500, "only {begun} crossings in ten minutes");
}

#[test]
fn walkers_keep_off_the_lanes() {
    let network =
        Arc::new(RoadNetwork::derive(&StreetPlan::grid(3, 3, 110.0), &NetworkConfig::default()).unwrap());
    let config = TrafficConfig { vehicles: 0, pedestrians: 150, ..TrafficConfig::default() };
    let mut traffic = Traffic::new(Arc::clone(&network), &config, Seed(3)).unwrap();
    for _ in 0..3000 {
        traffic.step(0.1);
        for walker in traffic.pedestrians().iter().filter(|walker| walker.crossing().is_none()) {
            let road = network
                .roads
                .iter()
                .filter_map(|road| {
                    polyline::closest(&road.centerline, &walker.position).map(|c| (c.distance, road))
                })
                .min_by(|a, b| a.0.total_cmp(&b.0))
                .expect("there are roads");
            assert!(road.0 > road.1.width * 0.5 - 1.0, "a walker is {:.1} m from a centreline", road.0);
        }
    }
}

#[test]
fn many_walkers_keep_apart_and_get_on() {
    let network =
        Arc::new(RoadNetwork::derive(&StreetPlan::grid(3, 3, 110.0), &NetworkConfig::default()).unwrap());
    let config = TrafficConfig { vehicles: 20, pedestrians: 1200, ..TrafficConfig::default() };
    let mut traffic = Traffic::new(network, &config, Seed(5)).unwrap();
    assert_eq!(traffic.placed().pedestrians, 1200);
    let apart = 2.0 * config.walking.radius;
    let mut places = Vec::new();
    for minute in 0..5 {
        let before: Vec<_> = traffic.pedestrians().iter().map(|walker| walker.position).collect();
        for _ in 0..600 {
            traffic.step(0.1);
            places.clear();
            places.extend(traffic.pedestrians().iter().map(|walker| walker.position));
            places.sort_by(|a, b| a.x.total_cmp(&b.x));
            for (index, place) in places.iter().enumerate() {
                let near = places[index + 1..].iter().take_while(|other| other.x - place.x < apart);
                for other in near {
                    assert!((other - place).norm() > apart - 1e-9, "{place} and {other} overlap");
                }
            }
        }
        let moved =
            traffic.pedestrians().iter().zip(&before).filter(|(w, old)| (w.position - *old).norm() > 5.0);
        let moved = moved.count();
        assert!(moved > 1000, "only {moved} of 1200 got on in minute {minute}");
    }
}
