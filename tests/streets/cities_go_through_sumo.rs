//! A generated city written as SUMO's network and read again is the same network to drive on.

use std::collections::BTreeMap;
use std::sync::Arc;

use simworld_citygen::{City, CityConfig};
use simworld_core::net::{RoadNetwork, Turn};
use simworld_core::seed::Seed;
use simworld_traffic::sumo::SumoNet;
use simworld_traffic::{Leg, Traffic, TrafficConfig};

/// Ways across by the names of the edges that they join, with how they turn and whether they have a signal.
type Ways = BTreeMap<(String, String), Vec<(u8, bool)>>;

fn turn(turn: Turn) -> u8 {
    match turn {
        Turn::Straight => 0,
        Turn::Right => 1,
        Turn::Left => 2,
        Turn::UTurn => 3,
    }
}

/// The name that the city's file gives a leg: `r7` along road 7, `-r7` against it.
fn edge(leg: Leg, network: &RoadNetwork, lane: simworld_core::id::LaneId) -> String {
    let road = leg.road();
    let forward = network.roads[road.index()].from == network.lanes[lane.index()].from;
    format!("{}r{}", if forward { "" } else { "-" }, road.0)
}

fn ways(network: &RoadNetwork, name: impl Fn(simworld_core::id::LaneId) -> String) -> Ways {
    let mut ways = Ways::new();
    for way in network.connections.iter().filter(|way| network.lanes[way.from.index()].is_driven()) {
        let key = (name(way.from), name(way.to));
        ways.entry(key).or_default().push((turn(way.turn), way.signal.is_some()));
    }
    for list in ways.values_mut() {
        list.sort_unstable();
    }
    ways
}

fn crossings_made(network: impl Into<Arc<RoadNetwork>>) -> u64 {
    let config = TrafficConfig { vehicles: 120, pedestrians: 60, ..TrafficConfig::default() };
    let mut traffic = Traffic::new(network.into(), &config, Seed(3)).expect("it holds together");
    for _ in 0..3000 {
        traffic.step(0.1);
    }
    assert_eq!(
        traffic.vehicles().count() as u64 + traffic.counters().arrived,
        u64::from(traffic.placed().vehicles)
    );
    traffic.counters().crossings
}

#[test]
fn what_is_written_is_read_again() {
    for seed in 1..4 {
        let city = City::generate(&CityConfig::with_roads(60), Seed(seed)).expect("it grows");
        let own = &city.network;
        let mut xml = Vec::new();
        city.write_sumo(&mut xml).expect("memory takes it");
        let read = SumoNet::read(xml.as_slice()).expect("it is a network");
        assert!(read.warnings.is_empty(), "{:?}", read.warnings);
        assert_eq!(read.network.check(), Ok(()));
        let name = |lane| edge(Leg::of(own, lane), own, lane);
        let again = |lane| read.names.edge(Leg::of(&read.network, lane)).to_owned();
        let (before, after) = (ways(own, name), ways(&read.network, again));
        for (key, list) in &before {
            assert_eq!(after.get(key), Some(list), "from {} to {} of seed {seed}", key.0, key.1);
        }
        assert_eq!(before.len(), after.len());
        let driven = |network: &RoadNetwork| network.lanes.iter().filter(|lane| lane.is_driven()).count();
        assert_eq!(driven(own), driven(&read.network));
        // The file has two decimals: half a centimetre at either end of each lane.
        for lane in (0..own.lanes.len()).map(simworld_core::id::LaneId::from_index) {
            let one = &own.lanes[lane.index()];
            if !one.is_driven() {
                continue;
            }
            let leg = read.names.leg(&name(lane)).expect("every leg is there");
            let near = |other: &&simworld_core::id::LaneId| {
                let other = &read.network.lanes[other.index()];
                (other.path[0] - one.path[0]).norm() < 0.02 && (other.length - one.length).abs() < 0.05
            };
            let found = leg.lanes(&read.network).iter().find(near).expect("every lane is where it was");
            let other = &read.network.lanes[found.index()];
            assert!(
                (other.speed_limit - one.speed_limit).abs() < 0.01 && (other.width - one.width).abs() < 0.01
            );
        }
        assert_eq!(own.crossings.len(), read.network.crossings.len());
        let conflicts =
            |network: &RoadNetwork| network.connections.iter().map(|way| way.conflicts.len()).sum::<usize>();
        let (ours, theirs) = (conflicts(own), conflicts(&read.network));
        assert_eq!(ours, theirs, "ways that touch, seed {seed}");
        let plans = |network: &RoadNetwork| -> Vec<f64> {
            let mut cycles: Vec<f64> = network
                .signals
                .iter()
                .map(|plan| plan.phases.iter().map(|phase| phase.duration).sum())
                .collect();
            cycles.sort_by(f64::total_cmp);
            cycles
        };
        assert_eq!(plans(own).len(), plans(&read.network).len());
        let (mine, read) = (crossings_made(own.clone()), crossings_made(read.network));
        let ratio = mine as f64 / read as f64;
        assert!((0.8..1.25).contains(&ratio), "{mine} crossings here, {read} there");
    }
}
