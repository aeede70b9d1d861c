//! Streets on which one can drive on without end.
//!
//! The map of a real place ends, and some of its one-way streets only lead off it. Who turns at random goes nowhere, so nobody takes him away
//! at such an end: he would stand there for good, and all who come behind him.

use simworld_core::id::LaneId;
use simworld_core::net::{Lane, RoadNetwork};

use super::VehicleKind;
use crate::Leg;

/// Whether a car can drive on from each lane without end, if need be from a lane beside it. Lanes that cars may not use are
/// not judged.
pub(super) fn lead_on(network: &RoadNetwork) -> Vec<bool> {
    let legs = legs_that_lead_on(network);
    let leads_on = |(number, lane): (usize, &Lane)| {
        !VehicleKind::Car.may_use(lane.kind) || legs[Leg::of(network, LaneId(number as u32)).index()]
    };
    network.lanes.iter().enumerate().map(leads_on).collect()
}

/// Whether each leg leads to another that leads on: what is left when those that lead nowhere are taken away, and then those
/// that lead to these alone.
fn legs_that_lead_on(network: &RoadNetwork) -> Vec<bool> {
    let mut steps = steps(network);
    let mut onward = vec![0_u32; network.roads.len() * 2];
    for (_, from) in &steps {
        onward[*from as usize] += 1;
    }
    steps.sort_unstable();
    let mut ends: Vec<u32> = (0..onward.len() as u32).filter(|leg| onward[*leg as usize] == 0).collect();
    while let Some(end) = ends.pop() {
        let first = steps.partition_point(|(to, _)| *to < end);
        for (_, from) in steps[first..].iter().take_while(|(to, _)| *to == end) {
            onward[*from as usize] -= 1;
            if onward[*from as usize] == 0 {
                ends.push(*from);
            }
        }
    }
    onward.iter().map(|count| *count > 0).collect()
}

/// The ways of cars from leg to leg: where each leads, and whence.
fn steps(network: &RoadNetwork) -> Vec<(u32, u32)> {
    let may_use = |lane: LaneId| VehicleKind::Car.may_use(network.lanes[lane.index()].kind);
    let leg = |lane: LaneId| Leg::of(network, lane).index() as u32;
    let ways = network.connections.iter().filter(|way| may_use(way.from) && may_use(way.to));
    ways.map(|way| (leg(way.to), leg(way.from))).collect()
}
