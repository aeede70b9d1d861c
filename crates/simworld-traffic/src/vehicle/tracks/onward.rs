//! Lanes on which one can drive on without end.
//!
//! The map of a real place ends, and some of its one-way streets only lead off it. Who turns at random goes nowhere, so nobody takes him away
//! at such an end: he would stand there for good, and all who come behind him.

use simworld_core::net::RoadNetwork;

use crate::vehicle::VehicleKind;

/// Whether one can drive on from each lane without end: in a car, and from lanes of their own, others.
pub(super) fn lead_on(network: &RoadNetwork) -> Vec<bool> {
    let is_for_cars = |lane: usize| VehicleKind::Car.may_use(network.lanes[lane].kind);
    let cars = ways_onward(network, is_for_cars);
    // Buses and riders come from their own lanes to those of cars, and are no better off there.
    let all = ways_onward(network, |lane| !is_for_cars(lane) || cars[lane] > 0);
    (0..network.lanes.len())
        .map(|lane| if is_for_cars(lane) { cars[lane] > 0 } else { all[lane] > 0 })
        .collect()
}

/// How many ways from each lane to others of these lead on: what is left when lanes that lead nowhere are taken away, and then those that lead to
/// these alone.
fn ways_onward(network: &RoadNetwork, joins: impl Fn(usize) -> bool) -> Vec<u32> {
    let ways = network.connections.iter().map(|way| (way.to.index(), way.from.index()));
    let mut ways: Vec<(usize, usize)> = ways.filter(|(to, from)| joins(*to) && joins(*from)).collect();
    ways.sort_unstable();
    let mut onward = vec![0_u32; network.lanes.len()];
    for (_, from) in &ways {
        onward[*from] += 1;
    }
    let mut ends: Vec<usize> = (0..onward.len()).filter(|lane| onward[*lane] == 0).collect();
    while let Some(end) = ends.pop() {
        let first = ways.partition_point(|(to, _)| *to < end);
        for (_, from) in ways[first..].iter().take_while(|(to, _)| *to == end) {
            onward[*from] -= 1;
            if onward[*from] == 0 {
                ends.push(*from);
            }
        }
    }
    onward
}
