//! The ways of bicycles across a junction: from one cycle lane on to the next, or to the outermost lane for everybody.
//! Nothing but a cycle lane leads from one, and only cycle lanes lead to one: motor vehicles never get there.

use super::connections::{leaving, turn_between};
use super::legs::Leg;
use crate::id::LaneId;
use crate::net::{RoadNetwork, StreetPlan, Turn};

/// Where the cycle lanes of a leg lead: straight on and round the near corner; across oncoming traffic only where there
/// is no other way, for elsewhere one turns in two steps; back at a dead end.
pub(super) fn movements(
    network: &RoadNetwork,
    plan: &StreetPlan,
    legs: &[Leg],
    leg: &Leg,
) -> Vec<(LaneId, LaneId, Turn)> {
    let road = &network.roads[leg.street];
    let arrives = |lane: &LaneId| (network.lanes[lane.index()].to == road.from) == leg.at_start;
    let mut found = Vec::new();
    for from in road.cycle.iter().copied().filter(arrives) {
        let others = legs.iter().filter(|other| other.street != leg.street);
        let ways: Vec<(LaneId, LaneId, Turn)> = others
            .filter_map(|other| Some((from, way_out(network, other)?, turn_between(plan, leg, other))))
            .collect();
        let is_plain = |way: &&(LaneId, LaneId, Turn)| matches!(way.2, Turn::Straight | Turn::Right);
        if ways.iter().any(|way| is_plain(&way)) {
            found.extend(ways.iter().filter(is_plain));
        } else if ways.is_empty() {
            found.extend(way_out(network, leg).map(|to| (from, to, Turn::UTurn)));
        } else {
            found.extend(ways);
        }
    }
    found.sort_unstable();
    found
}

/// The lane on which a bicycle leaves over a leg: the outermost cycle lane, or else the outermost of all.
fn way_out(network: &RoadNetwork, leg: &Leg) -> Option<LaneId> {
    let road = &network.roads[leg.street];
    let leaves = |lane: &&LaneId| (network.lanes[lane.index()].from == road.from) == leg.at_start;
    // Cycle lanes are listed from left to right along the centreline; the outermost is the rightmost as one leaves.
    let cycle =
        if leg.at_start { road.cycle.iter().rev().find(leaves) } else { road.cycle.iter().find(leaves) };
    cycle.or_else(|| leaving(network, leg).last()).copied()
}
