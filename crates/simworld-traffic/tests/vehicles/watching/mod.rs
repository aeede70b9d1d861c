//! Somebody who watches a traffic: nobody touches anybody, nobody enters on red.

use std::sync::Arc;

use simworld_core::net::{Aspect, NetworkConfig, RoadNetwork, StreetPlan};
use simworld_core::seed::Seed;
use simworld_traffic::{Counters, Traffic, TrafficConfig};

use crate::contacts::assert_apart;

/// Traffic on a grid of streets of 130 m.
pub(crate) fn on_grid(columns: usize, config: &TrafficConfig, seed: u64) -> Traffic {
    let plan = StreetPlan::grid(columns, columns, 130.0);
    let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("a grid is a network");
    Traffic::new(Arc::new(network), config, Seed(seed)).expect("the settings are in range")
}

/// Drives on for so many steps of 0.1 s; panics if bodies overlap or somebody enters on red who may not.
pub(crate) fn drive(traffic: &mut Traffic, steps: u32, may_pass_red: impl Fn(u32) -> bool) -> Counters {
    let network = Arc::clone(traffic.network());
    let lanes = network.lanes.len() as u32;
    let mut before: Vec<(u32, u32)> = traffic.stations().map(|vehicle| (vehicle.0, vehicle.1)).collect();
    for step in 0..steps {
        let aspects = traffic.signals().to_vec();
        traffic.step(0.1);
        let mut now: Vec<(u32, u32)> = traffic.stations().map(|vehicle| (vehicle.0, vehicle.1)).collect();
        now.sort_unstable();
        before.sort_unstable();
        for (id, track) in now.iter().copied().filter(|(_, track)| *track >= lanes) {
            let old = before.binary_search_by_key(&id, |vehicle| vehicle.0).map(|rank| before[rank].1);
            let connection = &network.connections[(track - lanes) as usize];
            let red = connection.signal.is_some_and(|group| aspects[group.index()] == Aspect::Red);
            let entered = old.is_ok_and(|old| old < lanes);
            assert!(!(entered && red) || may_pass_red(id), "vehicle {id} entered on red at step {step}");
        }
        before = now;
        assert_apart(traffic, step as usize);
    }
    traffic.counters()
}
