//! Ways for vehicles, in two levels: the legs of the roads from here to the goal, then the path along their lanes.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};

use simworld_core::geometry::Point2;
use simworld_core::id::{ConnectionId, LaneId};
use simworld_core::net::{RoadNetwork, polyline};
use simworld_core::scene::Scene;

use super::change::{Change, LEAST};
use super::junction::Line;
use crate::lanes::{OnLane, beside, lane, leg_of};

/// Length over which one goes from a lane to the next, m.
const CHANGE: f64 = 25.0;
/// From a junction one goes on so far in the lane that one came in on, m.
const SETTLES: f64 = 12.0;

/// A path along lanes with what holds on it.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Way {
    pub(super) path: Vec<Point2>,
    pub(super) lines: Vec<Line>,
    /// Up to which station which speed is allowed, m and m/s, ascending.
    pub(super) limits: Vec<(f64, f64)>,
    /// From lane to lane.
    pub(super) changes: Vec<Change>,
}

/// Where a way begins.
#[derive(Clone, Copy, Debug)]
pub(super) struct From<'a> {
    pub(super) on: &'a OnLane,
    /// The first point of the path.
    pub(super) at: Point2,
    /// No change of lanes is begun before so many metres.
    pub(super) hold: f64,
    /// The lanes by whose ends the first leg may be left: all, or the one where one is.
    pub(super) lanes: Lanes,
}

/// Which lanes of a leg may be used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Lanes {
    All,
    Own,
}

impl From<'_> {
    fn exits(&self, network: &RoadNetwork) -> Vec<LaneId> {
        match self.lanes {
            Lanes::All => beside(network, self.on.lane),
            Lanes::Own => vec![self.on.lane],
        }
    }
}

/// The lane that stands for all lanes of its road that go the same way: the first of them.
fn leg(network: &RoadNetwork, id: LaneId) -> LaneId {
    beside(network, id).first().copied().unwrap_or(id)
}

/// The way from a place on a lane to another; legs that are shut, named by their first lanes, are left out unless one stands on
/// them. `None` if no lanes lead there.
pub(super) fn way(
    network: &RoadNetwork,
    from: &From<'_>,
    to: &OnLane,
    is_shut: &dyn Fn(LaneId) -> bool,
) -> Option<Way> {
    let (first, last) = (leg(network, from.on.lane), leg(network, to.lane));
    let is_ahead = to.station > from.on.station + from.hold + 1.0;
    let changes = from.on.lane != to.lane;
    let has_room = !changes || to.station > from.on.station + from.hold + LEAST;
    if first == last && is_ahead && has_room && (from.lanes == Lanes::All || !changes) {
        return Some(assemble(network, from, to, &[]));
    }
    let turns = legs(network, from, last, is_shut)?;
    Some(assemble(network, from, to, &turns))
}

/// Whether the world has closed the direction of the road that a lane is part of.
pub(super) fn is_closed(scene: &dyn Scene, network: &RoadNetwork, id: LaneId) -> bool {
    scene.is_closed(leg_of(network, id))
}

/// The connections from leg to leg on the shortest way, by Dijkstra; of equal lengths the lower lane goes first. The first
/// leg is left at its end even if it is the last as well.
fn legs(
    network: &RoadNetwork,
    from: &From<'_>,
    last: LaneId,
    is_shut: &dyn Fn(LaneId) -> bool,
) -> Option<Vec<ConnectionId>> {
    let first = leg(network, from.on.lane);
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
        for own in if is_start { from.exits(network) } else { beside(network, at) } {
            for id in &lane(network, own).outgoing {
                let way = &network.connections[id.index()];
                let next = leg(network, way.to);
                if !lane(network, way.to).is_driven() || is_shut(next) {
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

/// Of the ways of the same turn the one that asks for the fewest changes of lanes, on the leg behind it and on that before.
fn towards(
    network: &RoadNetwork,
    turn: ConnectionId,
    wanted: LaneId,
    from: Option<&From<'_>>,
) -> ConnectionId {
    let chosen = &network.connections[turn.index()];
    let rank = |id: LaneId| {
        let lanes = beside(network, id);
        lanes.iter().position(|lane| *lane == id).unwrap_or(lanes.len()) as i64
    };
    let lanes = from.map_or_else(|| beside(network, chosen.from), |from| from.exits(network));
    let ways = lanes.into_iter().flat_map(|from| lane(network, from).outgoing.clone());
    let same = ways.filter(|id| {
        let way = &network.connections[id.index()];
        leg(network, way.to) == leg(network, chosen.to) && lane(network, way.to).is_driven()
    });
    let changes = |id: &ConnectionId| {
        let way = &network.connections[id.index()];
        let own = from.map_or(0, |from| (rank(way.from) - rank(from.on.lane)).abs());
        ((rank(way.to) - rank(wanted)).abs() + own, *id)
    };
    same.min_by_key(changes).unwrap_or(turn)
}

/// The path over these turns: on every leg from the lane that one comes in on to the one that one leaves by.
fn assemble(network: &RoadNetwork, from: &From<'_>, to: &OnLane, turns: &[ConnectionId]) -> Way {
    let mut wanted = to.lane;
    let mut chosen: Vec<ConnectionId> = Vec::with_capacity(turns.len());
    for (index, turn) in turns.iter().enumerate().rev() {
        let turn = towards(network, *turn, wanted, (index == 0).then_some(from));
        wanted = network.connections[turn.index()].from;
        chosen.push(turn);
    }
    chosen.reverse();
    let mut way = Way { path: vec![from.at], ..Way::default() };
    let (mut at, mut station, mut hold) = (from.on.lane, from.on.station, from.hold);
    for turn in chosen {
        let connection = &network.connections[turn.index()];
        let stretch = Stretch { from: at, station, to: connection.from, until: f64::INFINITY, hold };
        stretch.drive(network, &mut way);
        way.lines.push(Line::new(polyline::length(&way.path), turn));
        way.path.extend(connection.path.iter().skip(1));
        // Through the junction one goes as the slower of the two roads allows; its bends slow down further.
        let limit = lane(network, at).speed_limit.min(lane(network, connection.to).speed_limit);
        way.limits.push((polyline::length(&way.path), limit));
        (at, station, hold) = (connection.to, 0.0, SETTLES);
    }
    Stretch { from: at, station, to: to.lane, until: to.station, hold }.drive(network, &mut way);
    way
}

/// A part of a leg: from a lane at a station to another of its lanes, up to a station or the end.
struct Stretch {
    from: LaneId,
    station: f64,
    to: LaneId,
    until: f64,
    hold: f64,
}

impl Stretch {
    /// Lengthens a way by it, with the changes of lanes as early as they can be.
    fn drive(&self, network: &RoadNetwork, way: &mut Way) {
        let Self { from, station, to, until, hold } = *self;
        let lanes = beside(network, from);
        let place = |id: LaneId| lanes.iter().position(|lane| *lane == id);
        let end = until.min(lane(network, to).length).max(station);
        let passed: Vec<LaneId> = match (place(from), place(to)) {
            (Some(a), Some(b)) if a <= b => lanes[a..=b].to_vec(),
            (Some(a), Some(b)) => lanes[b..=a].iter().rev().copied().collect(),
            _ => vec![to],
        };
        let count = (passed.len() - 1) as f64;
        // Where there is no room for all of it the changes share what there is.
        let hold = hold.min((end - station - count * LEAST).max(0.0));
        let share = (end - station - hold) / count.max(1.0);
        let mut at = station;
        for (index, pair) in passed.windows(2).enumerate() {
            let begin = station + hold + share.min(CHANGE + 4.0) * index as f64;
            way.path.extend(polyline::slice(&lane(network, pair[0]).path, at, begin));
            tidy(&mut way.path);
            let so_far = polyline::length(&way.path);
            at = begin + CHANGE.min(share * 0.9);
            way.path.extend(polyline::slice(&lane(network, pair[1]).path, at, at + 0.5));
            let last = end - (count - index as f64) * LEAST;
            way.changes.push(Change {
                begin: so_far,
                end: polyline::length(&way.path),
                latest: so_far + (last - begin).max(0.0),
                from: pair[0],
                to: pair[1],
                is_begun: false,
                waited: 0.0,
            });
        }
        let last = passed.last().copied().unwrap_or(to);
        way.path.extend(polyline::slice(&lane(network, last).path, at, end));
        tidy(&mut way.path);
        way.limits.push((polyline::length(&way.path), lane(network, from).speed_limit));
    }
}

/// Takes out points that lie on others.
fn tidy(path: &mut Vec<Point2>) {
    path.dedup_by(|a, b| (*a - *b).norm() < 1e-6);
}
