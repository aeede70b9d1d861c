//! Lanes side by side: which lie beside which, who may drive on them, and where one would rather be.

use simworld_core::id::LaneId;
use simworld_core::net::{LaneKind, Road, RoadNetwork, polyline};

use super::{Track, Tracks};
use crate::Leg;
use crate::vehicle::VehicleKind;
use crate::vehicle::manager::NONE;

/// The neighbours of each lane, left and right: those that lead the same way and touch it. A median or parked vehicles keep
/// lanes apart.
pub(in crate::vehicle) fn beside(network: &RoadNetwork) -> Vec<[Track; 2]> {
    let mut beside = vec![[NONE; 2]; network.lanes.len()];
    for (a, b) in network.roads.iter().flat_map(|road| pairs(network, road)) {
        let (one, other) = (&network.lanes[a.index()], &network.lanes[b.index()]);
        let middle = polyline::at(&other.path, other.length * 0.5).0;
        let Some(near) = polyline::closest(&one.path, &middle) else { continue };
        if near.distance < (one.width + other.width) * 0.5 + 0.5 {
            let side = usize::from(near.lateral < 0.0);
            beside[a.index()][side] = b.0;
            beside[b.index()][1 - side] = a.0;
        }
    }
    beside
}

/// The lane of those who come the other way, on streets of one lane each way for everybody, or [`NONE`]: there one gets round what
/// stands on the own lane over it. A median keeps the two apart.
pub(in crate::vehicle) fn opposite(network: &RoadNetwork) -> Vec<Track> {
    let mut opposite = vec![NONE; network.lanes.len()];
    for road in &network.roads {
        let ([forward], [backward]) = (&road.forward[..], &road.backward[..]) else { continue };
        let (one, other) = (&network.lanes[forward.index()], &network.lanes[backward.index()]);
        let middle = polyline::at(&other.path, other.length * 0.5).0;
        let near = polyline::closest(&one.path, &middle);
        let touch = near.is_some_and(|near| near.distance < (one.width + other.width) * 0.5 + 0.5);
        if touch && one.kind == LaneKind::Driving && other.kind == LaneKind::Driving {
            opposite[forward.index()] = backward.0;
            opposite[backward.index()] = forward.0;
        }
    }
    opposite
}

/// The pairs of lanes of a road that may lie side by side and lead the same way.
fn pairs(network: &RoadNetwork, road: &Road) -> Vec<(LaneId, LaneId)> {
    let mut pairs = Vec::new();
    for (lanes, from) in [(&road.forward, road.from), (&road.backward, road.to)] {
        pairs.extend(lanes.windows(2).map(|pair| (pair[0], pair[1])));
        // From the middle outwards the cycle lanes follow the outermost lane, on whichever side that is.
        let cycle: Vec<LaneId> =
            road.cycle.iter().copied().filter(|lane| network.lanes[lane.index()].from == from).collect();
        pairs.extend(cycle.windows(2).map(|pair| (pair[0], pair[1])));
        if let Some(outermost) = lanes.last() {
            pairs.extend(cycle.iter().map(|lane| (*outermost, *lane)));
        }
    }
    pairs
}

/// Whether each lane is the last of its direction before the kerb, cycle lanes apart.
pub(in crate::vehicle) fn outermost(network: &RoadNetwork) -> Vec<bool> {
    let mut outermost = vec![false; network.lanes.len()];
    for lanes in network.roads.iter().flat_map(|road| [&road.forward, &road.backward]) {
        if let Some(lane) = lanes.last() {
            outermost[lane.index()] = true;
        }
    }
    outermost
}

impl Tracks {
    /// Whether a kind may drive on a lane.
    #[inline]
    pub(crate) fn may_use(&self, lane: Track, kind: VehicleKind) -> bool {
        kind.may_use(self.kinds[lane as usize])
    }

    /// How well a lane suits a kind: a lane of its own before all others, for riders the right one before the rest; a lane that
    /// is not for it least.
    pub(crate) fn suits(&self, lane: Track, kind: VehicleKind) -> i8 {
        let lane_kind = self.kinds[lane as usize];
        if !kind.may_use(lane_kind) {
            -1
        } else if kind.prefers(lane_kind) {
            2
        } else {
            i8::from(kind.is_rider() && self.outermost[lane as usize])
        }
    }

    /// The lanes of a leg on which a kind may drive, its cycle lanes among them.
    pub(crate) fn lanes_of(&self, leg: Leg, kind: VehicleKind) -> impl Iterator<Item = Track> {
        let network = &self.network;
        let cycle = network.roads.get(leg.road().index()).map_or(&[][..], |road| &road.cycle);
        let on_leg = move |lane: &&LaneId| Leg::of(network, **lane) == leg;
        let lanes = leg.lanes(network).iter().chain(cycle.iter().filter(on_leg));
        lanes.map(|lane| lane.0).filter(move |lane| self.may_use(*lane, kind))
    }
}
