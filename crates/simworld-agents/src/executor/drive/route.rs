//! Ways for vehicles, in two levels: the legs of the roads from here to the goal, then the path along their lanes.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};

use simworld_core::geometry::Point2;
use simworld_core::id::{ConnectionId, LaneId};
use simworld_core::net::{RoadNetwork, polyline};

use super::Line;
use crate::lanes::{OnLane, beside, lane};

/// Length over which one goes from a lane to the next, m.
const CHANGE: f64 = 25.0;

/// A path along lanes with what holds on it.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Way {
    pub(super) path: Vec<Point2>,
    pub(super) lines: Vec<Line>,
    /// Up to which station which speed is allowed, m and m/s, ascending.
    pub(super) limits: Vec<(f64, f64)>,
}

/// The lane that stands for all lanes of its road that go the same way: the first of them.
fn leg(network: &RoadNetwork, id: LaneId) -> LaneId {
    beside(network, id).first().copied().unwrap_or(id)
}

/// The way from a point, by a place on a lane, to another; roads whose leg is in `closed` are left out unless one stands on them. `None` if no
/// lanes lead there.
pub(super) fn way(
    network: &RoadNetwork,
    from: &OnLane,
    to: &OnLane,
    closed: &[LaneId],
    start: Point2,
) -> Option<Way> {
    let (first, last) = (leg(network, from.lane), leg(network, to.lane));
    if first == last && to.station > from.station + CHANGE.min(1.0) {
        return Some(assemble(network, from, to, &[], start));
    }
    let turns = legs(network, first, last, closed)?;
    Some(assemble(network, from, to, &turns, start))
}

/// The connections from leg to leg on the shortest way, by Dijkstra; of equal lengths the lower lane goes first. The first
/// leg is left at its end even if it is the last as well.
fn legs(network: &RoadNetwork, first: LaneId, last: LaneId, closed: &[LaneId]) -> Option<Vec<ConnectionId>> {
    let mut before: BTreeMap<LaneId, (ConnectionId, LaneId)> = BTreeMap::new();
    let mut open = BinaryHeap::new();
    // Lengths in millimetres, which are ordered.
    open.push(Reverse((0_u64, first, true)));
    let mut least: BTreeMap<LaneId, u64> = BTreeMap::new();
    while let Some(Reverse((length, at, is_start))) = open.pop() {
        if at == last && !is_start {
            return Some(trace(first, last, &before));
        }
        if !is_start && least.get(&at).is_some_and(|least| length > *least) {
            continue;
        }
        for own in beside(network, at) {
            for id in &lane(network, own).outgoing {
                let way = &network.connections[id.index()];
                let next = leg(network, way.to);
                if !lane(network, way.to).is_driven() || closed.contains(&next) {
                    continue;
                }
                let total = length + ((lane(network, own).length + way.length) * 1000.0) as u64;
                if least.get(&next).is_none_or(|least| total < *least) {
                    least.insert(next, total);
                    before.insert(next, (*id, at));
                    open.push(Reverse((total, next, false)));
                }
            }
        }
    }
    None
}

fn trace(
    first: LaneId,
    last: LaneId,
    before: &BTreeMap<LaneId, (ConnectionId, LaneId)>,
) -> Vec<ConnectionId> {
    let (mut turns, mut at) = (Vec::new(), last);
    while let Some((turn, from)) = before.get(&at) {
        turns.push(*turn);
        at = *from;
        if at == first {
            break;
        }
    }
    turns.reverse();
    turns
}

/// The connection of the same turn that ends nearest to a wanted lane.
fn towards(network: &RoadNetwork, turn: ConnectionId, wanted: LaneId) -> ConnectionId {
    let chosen = &network.connections[turn.index()];
    let lanes = beside(network, wanted);
    let rank = |id: LaneId| lanes.iter().position(|lane| *lane == id).unwrap_or(lanes.len()) as i64;
    let ways = beside(network, chosen.from).into_iter().flat_map(|from| lane(network, from).outgoing.clone());
    let same = ways.filter(|id| {
        let way = &network.connections[id.index()];
        leg(network, way.to) == leg(network, chosen.to) && lane(network, way.to).is_driven()
    });
    same.min_by_key(|id| ((rank(network.connections[id.index()].to) - rank(wanted)).abs(), *id))
        .unwrap_or(turn)
}

/// The path over these turns: on every leg from the lane that one comes in on to the one that one leaves by.
fn assemble(network: &RoadNetwork, from: &OnLane, to: &OnLane, turns: &[ConnectionId], start: Point2) -> Way {
    let mut wanted = to.lane;
    let mut chosen: Vec<ConnectionId> = Vec::with_capacity(turns.len());
    for turn in turns.iter().rev() {
        let turn = towards(network, *turn, wanted);
        wanted = network.connections[turn.index()].from;
        chosen.push(turn);
    }
    chosen.reverse();
    let mut way = Way { path: vec![start], ..Way::default() };
    let (mut at, mut station) = (from.lane, from.station);
    for turn in chosen {
        let connection = &network.connections[turn.index()];
        along(network, &mut way, at, station, connection.from, None);
        let end = polyline::length(&way.path);
        way.lines.push(Line { station: end, turn, waited: 0.0 });
        way.path.extend(connection.path.iter().skip(1));
        // Through the junction one goes as the slower of the two roads allows; its bends slow down further.
        let limit = lane(network, at).speed_limit.min(lane(network, connection.to).speed_limit);
        way.limits.push((polyline::length(&way.path), limit));
        (at, station) = (connection.to, 0.0);
    }
    along(network, &mut way, at, station, to.lane, Some(to.station));
    way
}

/// Along a leg from a lane at a station to another of its lanes, up to a station or the end, changing lanes at even
/// distances.
fn along(network: &RoadNetwork, way: &mut Way, from: LaneId, station: f64, to: LaneId, until: Option<f64>) {
    let lanes = beside(network, from);
    let place = |id: LaneId| lanes.iter().position(|lane| *lane == id);
    let end = until.unwrap_or(f64::INFINITY).min(lane(network, to).length).max(station);
    let passed: Vec<LaneId> = match (place(from), place(to)) {
        (Some(a), Some(b)) if a <= b => lanes[a..=b].to_vec(),
        (Some(a), Some(b)) => lanes[b..=a].iter().rev().copied().collect(),
        _ => vec![to],
    };
    let share = (end - station) / passed.len() as f64;
    for (index, id) in passed.iter().enumerate() {
        let half = CHANGE.min(share) * 0.5;
        let begin = station + share * index as f64 + if index > 0 { half } else { 0.0 };
        let stop = station + share * (index + 1) as f64 - if index + 1 < passed.len() { half } else { 0.0 };
        way.path.extend(polyline::slice(&lane(network, *id).path, begin, stop));
    }
    way.path.dedup_by(|a, b| (*a - *b).norm() < 1e-6);
    way.limits.push((polyline::length(&way.path), lane(network, from).speed_limit));
}
