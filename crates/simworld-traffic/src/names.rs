//! What the parts of a network are called in files: its own numbers, or the names of the file that it came from.

use std::collections::BTreeMap;

use simworld_core::id::{ConnectionId, IntersectionId, LaneId, RoadId};
use simworld_core::net::{Connection, LaneDirection, Road, RoadNetwork, Side, Turn};

use crate::Leg;

/// Names of edges, lanes, the internal lanes of connections, and junctions.
///
/// Those of a network that has none are the ones that the city generator's SUMO writer gives: edges `r7` and `-r7`,
/// lanes `r7_0` counted from the right with the sidewalk first, internal lanes `:j3_5_0`, junctions `j3`.
///
/// ```
/// use simworld_core::net::{NetworkConfig, RoadNetwork, StreetPlan};
/// use simworld_traffic::NetworkNames;
/// let network = RoadNetwork::derive(&StreetPlan::crossroads(100.0), &NetworkConfig::default())?;
/// let names = NetworkNames::of(&network);
/// let lane = network.roads[0].forward[0];
/// assert_eq!((names.lane(lane), names.lane_id("r0_1")), ("r0_1", Some(lane)));
/// # Ok::<(), simworld_core::net::NetworkError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NetworkNames {
    /// By leg; empty where nobody drives or rides.
    pub(crate) edges: Vec<String>,
    pub(crate) lanes: Vec<String>,
    pub(crate) connections: Vec<String>,
    pub(crate) junctions: Vec<String>,
    legs: BTreeMap<String, Leg>,
    lane_ids: BTreeMap<String, LaneId>,
}

impl NetworkNames {
    /// The names that follow from numbers.
    pub fn of(network: &RoadNetwork) -> Self {
        let mut names = Self {
            edges: vec![String::new(); network.roads.len() * 2],
            lanes: vec![String::new(); network.lanes.len()],
            connections: vec![String::new(); network.connections.len()],
            junctions: (0..network.intersections.len()).map(|index| format!("j{index}")).collect(),
            ..Self::default()
        };
        let mut ranks = vec![0; network.lanes.len()];
        for (index, road) in network.roads.iter().enumerate() {
            for direction in [LaneDirection::Forward, LaneDirection::Backward] {
                let id = RoadId::from_index(index);
                let edge = format!("{}r{index}", if direction == LaneDirection::Forward { "" } else { "-" });
                let (lanes, side) = of_edge(network, road, direction);
                let first = usize::from(network.sidewalk(id, side).is_some_and(|walk| walk.path.len() > 1));
                for (rank, lane) in lanes.iter().rev().enumerate() {
                    ranks[lane.index()] = first + rank;
                    names.lanes[lane.index()] = format!("{edge}_{}", first + rank);
                }
                names.edges[Leg::new(id, direction).index()] = edge;
            }
        }
        for (index, place) in network.intersections.iter().enumerate() {
            let mut links = place.connections.clone();
            links.sort_by_key(|id| link_order(network, IntersectionId::from_index(index), &ranks, *id));
            for (link, id) in links.iter().enumerate() {
                names.connections[id.index()] = format!(":j{index}_{link}_0");
            }
        }
        names.indexed()
    }

    /// The same, ready to be asked by name.
    pub(crate) fn indexed(mut self) -> Self {
        let legs = self.edges.iter().enumerate().filter(|(_, name)| !name.is_empty());
        self.legs = legs.map(|(index, name)| (name.clone(), Leg::from_index(index))).collect();
        let lanes = self.lanes.iter().enumerate();
        self.lane_ids = lanes.map(|(index, name)| (name.clone(), LaneId::from_index(index))).collect();
        self
    }

    /// The edge that a leg is; empty for one that is none.
    pub fn edge(&self, leg: Leg) -> &str {
        self.edges.get(leg.index()).map_or("", String::as_str)
    }

    /// A lane.
    pub fn lane(&self, lane: LaneId) -> &str {
        self.lanes.get(lane.index()).map_or("", String::as_str)
    }

    /// The internal lane on which a connection begins.
    pub fn connection(&self, connection: ConnectionId) -> &str {
        self.connections.get(connection.index()).map_or("", String::as_str)
    }

    /// A junction.
    pub fn junction(&self, intersection: IntersectionId) -> &str {
        self.junctions.get(intersection.index()).map_or("", String::as_str)
    }

    /// The leg that an edge is.
    pub fn leg(&self, edge: &str) -> Option<Leg> {
        self.legs.get(edge).copied()
    }

    /// The lane of a name.
    pub fn lane_id(&self, name: &str) -> Option<LaneId> {
        self.lane_ids.get(name).copied()
    }
}

/// The lanes of an edge from left to right, those for bicycles last, and the side on which its sidewalk is.
fn of_edge(network: &RoadNetwork, road: &Road, direction: LaneDirection) -> (Vec<LaneId>, Side) {
    let (driven, leaves, side) = match direction {
        LaneDirection::Backward => (&road.backward, road.to, Side::Left),
        _ => (&road.forward, road.from, Side::Right),
    };
    let cycle = road.cycle.iter().filter(|lane| network.lanes[lane.index()].from == leaves);
    (driven.iter().chain(cycle).copied().collect(), side)
}

/// Links count clockwise by incoming road, then from the right by lane, then by where they lead, as netconvert's do.
fn link_order(
    network: &RoadNetwork,
    place: IntersectionId,
    ranks: &[usize],
    id: ConnectionId,
) -> (usize, usize, u8, ConnectionId) {
    let Connection { from, turn, .. } = network.connections[id.index()];
    let road = network.lanes[from.index()].road;
    let leg = network.intersections[place.index()].roads.iter().rev().position(|other| *other == road);
    let turn = match turn {
        Turn::Right => 0,
        Turn::Straight => 1,
        Turn::Left => 2,
        Turn::UTurn => 3,
    };
    (leg.unwrap_or(0), ranks[from.index()], turn, id)
}
