//! Who goes first, and behind whom one may go.

use std::sync::Arc;

use simworld_core::net::{Alone, NetworkConfig, RoadNetwork, StreetPlan, Zone};
use simworld_core::seed::Seed;

use super::*;
use crate::vehicle::clock::Moment;
use crate::vehicle::manager::VehicleManager;
use crate::vehicle::queues::path::Path;
use crate::vehicle::scene::Sight;
use crate::vehicle::tracks::Tracks;
use crate::vehicle::tracks::beside::Pairs;
use crate::{Counters, TrafficConfig};

#[test]
fn one_comes_as_near_as_one_could_still_stop() {
    let (hardest, to_zone) = (5.4, 12.0);
    for (v, time) in [(0.0, 2.0), (4.0, 1.5), (8.0, 1.0), (10.0, 0.5)] {
        let acceleration = in_time(v, time, to_zone, hardest);
        let after = v + acceleration * time;
        let left = to_zone - (v + after) * 0.5 * time;
        let needed = after * (after / (2.0 * hardest) + RELIES_FOR) + RELIES_UP_TO;
        assert!((left - needed).abs() < 1e-9, "{left} m left of {needed} m from {v} m/s in {time} s");
    }
    // Who is bound to be out of the way is no reason to brake, and who would have to be passed too soon is one to stop.
    assert_eq!(in_time(8.0, 0.0, to_zone, hardest), f64::INFINITY);
    assert_eq!(in_time(13.0, 3.0, to_zone, hardest), f64::NEG_INFINITY);
}

#[test]
fn who_rolls_needs_a_shorter_gap() {
    let zone = |enter, leave| Zone { enter, leave };
    let conflict = Conflict {
        way: 0,
        yields: true,
        critical: 4.1,
        merges: false,
        pairs: Pairs::ALL,
        own: zone(4.8, 13.9),
        other: zone(8.9, 17.9),
    };
    let asks = |distance, v| {
        let asker = Asker {
            distance,
            v,
            length: 4.5,
            acceleration: 1.95,
            speed: 5.7,
            delay: 0.0,
            haste: Haste::NONE,
        };
        // The least gap between its own line and that of who comes.
        let gone = conflict.own.passed() + asker.length;
        asker.time(gone) + asker.asks_for(&conflict, gone) - asker.time(0.0)
    };
    assert!((asks(BEFORE_LINE, 0.0) - 4.1).abs() < 1e-6);
    assert!(asks(4.0, 4.0) < 3.7 && asks(4.0, 4.0) > 3.0);
}

/// Whether a car that waits at its line crosses behind another that stands at the beginning of the lane behind its way, with its rear so far
/// beyond the stretch that both ways share, m.
fn crosses_behind(beyond: f64) -> bool {
    let config = NetworkConfig { signals_from_roads: 0, ..NetworkConfig::default() };
    let network = RoadNetwork::derive(&StreetPlan::crossroads(100.0), &config).expect("it is a plan");
    let config = TrafficConfig::default();
    let tracks = Tracks::new(Arc::new(network), &config);
    let mut vehicles = VehicleManager::new(&tracks);
    let way = |way: usize| &tracks.ways[way];
    let length = |way: u32| tracks.length[tracks.lanes + way as usize];
    // It ends early enough for the rear of one who stands beyond to be on the way still.
    let crosses = |(own, other): &(usize, &Conflict)| {
        !other.merges
            && way(*own).from != way(other.way as usize).from
            && other.other.passed() + beyond < length(other.way)
    };
    let mut pairs =
        (0..tracks.ways.len()).flat_map(|way| tracks.conflicts[way].iter().map(move |other| (way, other)));
    let (own, conflict) = pairs.find(crosses).expect("ways cross");
    let (before, after) = (way(own).from, tracks.lane_after(conflict.way as usize));
    let car = |id, s| Vehicle::new(config.vehicle_type(0), 0, 1.0, id, s);
    let own_lane = Vehicle { next: own as u32, ..car(0, tracks.length[before as usize] - 0.5) };
    let s = conflict.other.passed() + beyond - length(conflict.way) + own_lane.length();
    let stands = Vehicle { next: conflict.way, halt: s as f32, ..car(1, s) };
    vehicles.junctions.grant(&tracks, &stands, &config);
    vehicles.junctions.arrive(after, &stands, &config);
    let stands = Vehicle { next: NONE, holding: conflict.way, ..stands };
    for (lane, vehicle) in [(before, own_lane), (after, stands)] {
        vehicles.whereabouts.push(lane);
        vehicles.storage.add(lane, &vehicle, &config);
        vehicles.push(&tracks, lane, vehicle, Path::new(lane, NONE, 0.0, 0.0));
    }
    let zeros = vec![0; tracks.network.crossings.len()];
    let sight = Sight { aspects: &[], shown: &[], walkers: &zeros, waiting: &zeros, obstacles: &[] };
    let mut counters = Counters::default();
    for step in 0..300 {
        let at = Moment { now: step as f64 * 0.1, dt: 0.1, step };
        vehicles.step(&tracks, &config, Seed(1).stream("cars"), sight, at, &mut counters, &Alone);
    }
    assert!((vehicles.queue(&tracks, after)[0].s - s).abs() < 0.5, "it was to stand");
    vehicles.queue(&tracks, before).is_empty()
}

#[test]
fn who_stands_with_his_rear_out_of_the_way_keeps_nobody_from_going() {
    assert!(crosses_behind(0.2));
    assert!(!crosses_behind(-0.6));
}

#[test]
fn the_order_goes_on_when_numbers_begin_anew() {
    assert!(is_before(3, 4) && !is_before(4, 3) && !is_before(4, 4));
    assert!(is_before(u32::MAX, 2) && !is_before(2, u32::MAX));
}
