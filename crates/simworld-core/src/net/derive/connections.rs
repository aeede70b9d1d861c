//! Connections: the ways across an intersection, which of them touch, and who gives way.

use super::legs::Leg;
use super::trace::Trace;
use super::{cycles, kerbs};
use crate::geometry::{Point2, Vector2, direction};
use crate::id::{ConnectionId, IntersectionId, LaneId};
use crate::net::{
    Connection, Control, Phase, RoadClass, RoadNetwork, SignalGroup, SignalPlan, StreetPlan, Turn, TurnSet,
    polyline,
};
use crate::ops::wrap_angle;

/// Paths nearer than this touch: a vehicle's width and a margin, m.
const TOUCHING: f64 = 2.4;
/// A change of heading below this counts as straight on, radians.
const STRAIGHT: f64 = 0.7;

/// Distance between the kerb of a turning circle and a lane's width about the way round it, m.
const KERB_CLEARANCE: f64 = 0.5;

/// Adds the connections of one intersection.
pub(super) fn add(network: &mut RoadNetwork, plan: &StreetPlan, id: IntersectionId, legs: &[Leg]) {
    let first = network.connections.len();
    let vehicle_groups =
        network.signals.last().filter(|plan| plan.intersection == id).map(|plan| plan.groups.clone());
    for (index, leg) in legs.iter().enumerate() {
        let signal = vehicle_groups.as_ref().map(|groups| groups[index]);
        let cycled = cycles::movements(network, plan, legs, leg);
        for (from, to, turn) in movements(network, plan, legs, leg).into_iter().chain(cycled) {
            let path = path(network, leg, (from, to), turn);
            add_connection(network, id, (from, to), turn, signal, path);
        }
    }
    let own: Vec<ConnectionId> = (first..network.connections.len()).map(ConnectionId::from_index).collect();
    set_conflicts(network, id, &own);
    set_crossings(network, id, &own);
    network.intersections[id.index()].connections = own;
}

/// Lanes that arrive over a leg, and lanes that leave over it, from the middle outwards.
fn arriving<'a>(network: &'a RoadNetwork, leg: &Leg) -> &'a [LaneId] {
    let road = &network.roads[leg.street];
    if leg.at_start { &road.backward } else { &road.forward }
}

pub(super) fn leaving<'a>(network: &'a RoadNetwork, leg: &Leg) -> &'a [LaneId] {
    let road = &network.roads[leg.street];
    if leg.at_start { &road.forward } else { &road.backward }
}

/// Which lanes of a leg lead to which lanes of the others.
fn movements(
    network: &RoadNetwork,
    plan: &StreetPlan,
    legs: &[Leg],
    leg: &Leg,
) -> Vec<(LaneId, LaneId, Turn)> {
    let from = arriving(network, leg);
    let mut found = ways_on(network, plan, legs, leg, arrows(plan, leg));
    // Arrows that no street answers are a mistake: better without them than back.
    if found.is_empty() {
        found = ways_on(network, plan, legs, leg, &[]);
    }
    if found.is_empty() {
        lane_to_lane(from, leaving(network, leg), Turn::UTurn, &mut found);
    }
    let stranded: Vec<LaneId> =
        from.iter().copied().filter(|lane| found.iter().all(|f| f.0 != *lane)).collect();
    if let Some((_, to, turn)) = found.first().copied() {
        found.extend(stranded.into_iter().map(|lane| (lane, to, turn)));
    }
    // Of one lane in the order of the legs to which its ways lead, whatever the numbers of those.
    found.sort_by_key(|(from, ..)| *from);
    found
}

/// The ways from the lanes of a leg over a junction that arrows allow.
fn ways_on(
    network: &RoadNetwork,
    plan: &StreetPlan,
    legs: &[Leg],
    leg: &Leg,
    arrows: &[TurnSet],
) -> Vec<(LaneId, LaneId, Turn)> {
    let from = arriving(network, leg);
    let mut found = Vec::new();
    for other in legs.iter().filter(|other| other.street != leg.street) {
        let turn = turn_between(plan, leg, other);
        let to = leaving(network, other);
        // Where only two roads meet, all lanes follow the bend.
        if legs.len() == 2 {
            lane_to_lane(from, to, turn, &mut found);
            continue;
        }
        let usable: Vec<LaneId> = match turn {
            _ if arrows.len() == from.len() => from
                .iter()
                .zip(arrows)
                .filter(|(_, arrow)| arrow.allows(turn))
                .map(|(lane, _)| *lane)
                .collect(),
            Turn::Straight => from.to_vec(),
            Turn::Right => from.last().copied().into_iter().collect(),
            Turn::Left | Turn::UTurn => from.first().copied().into_iter().collect(),
        };
        match turn {
            Turn::Straight => lane_to_lane(&usable, to, turn, &mut found),
            // Side by side, along the outer kerb or along the middle.
            Turn::Right => {
                found.extend(usable.iter().rev().zip(to.iter().rev()).map(|(a, b)| (*a, *b, turn)));
            }
            Turn::Left | Turn::UTurn => found.extend(usable.iter().zip(to).map(|(a, b)| (*a, *b, turn))),
        }
    }
    found
}

/// The arrows on the lanes that arrive over a leg, from the middle outwards; none if there are none.
fn arrows<'a>(plan: &'a StreetPlan, leg: &Leg) -> &'a [TurnSet] {
    let turns = &plan.streets[leg.street].turns;
    if leg.at_start { &turns.backward } else { &turns.forward }
}

/// Each lane to the one of its rank; those in excess on either side share the outermost. Nothing where one side is a
/// one-way street of the other direction.
fn lane_to_lane(from: &[LaneId], to: &[LaneId], turn: Turn, found: &mut Vec<(LaneId, LaneId, Turn)>) {
    if from.is_empty() || to.is_empty() {
        return;
    }
    for rank in 0..from.len().max(to.len()) {
        found.push((from[rank.min(from.len() - 1)], to[rank.min(to.len() - 1)], turn));
    }
}

/// The turn from one leg to another. On to the ring of a roundabout and off it one turns right, whatever the angle.
pub(super) fn turn_between(plan: &StreetPlan, from: &Leg, to: &Leg) -> Turn {
    let change = wrap_angle(to.heading - from.heading - std::f64::consts::PI);
    let in_ring = |leg: &Leg| plan.streets[leg.street].roundabout;
    match (in_ring(from), in_ring(to)) {
        (true, true) => Turn::Straight,
        (false, false) if change.abs() <= STRAIGHT => Turn::Straight,
        (false, false) if change > 0.0 => Turn::Left,
        _ => Turn::Right,
    }
}

/// The middle of the way from one lane to another: round the turning circle of a dead end, or a smooth curve.
fn path(network: &RoadNetwork, leg: &Leg, (from, to): (LaneId, LaneId), turn: Turn) -> Vec<Point2> {
    let (entry, exit) = (&network.lanes[from.index()], &network.lanes[to.index()]);
    let (start, start_heading) = polyline::at(&entry.path, entry.length);
    let (end, end_heading) = polyline::at(&exit.path, 0.0);
    if turn == Turn::UTurn && leg.turning > 0.0 {
        let ahead = leg.direction();
        let left = |point: Point2| ahead.perp(&(point - leg.node));
        let lanes = arriving(network, leg);
        let outside = lanes.iter().rev().take_while(|lane| **lane != from).count() as f64;
        let keep = KERB_CLEARANCE + entry.width * (0.5 + outside);
        if let Some(mut path) = kerbs::turning_path(leg, (left(start), -left(end)), keep) {
            // A street that bends before its end has its lanes end a little beside.
            let last = path.len() - 1;
            (path[0], path[last]) = (start, end);
            return path;
        }
    }
    curve(start, direction(start_heading), end, direction(end_heading))
}

fn add_connection(
    network: &mut RoadNetwork,
    intersection: IntersectionId,
    (from, to): (LaneId, LaneId),
    turn: Turn,
    signal: Option<SignalGroup>,
    path: Vec<Point2>,
) {
    let id = ConnectionId::from_index(network.connections.len());
    network.connections.push(Connection {
        from,
        to,
        intersection,
        turn,
        length: polyline::length(&path),
        path,
        signal,
        conflicts: Vec::new(),
        yields_to: Vec::new(),
        crossings: Vec::new(),
    });
    network.lanes[from.index()].outgoing.push(id);
}

/// A cubic Bézier curve that leaves and arrives along the given directions, a point about every metre.
fn curve(start: Point2, leaving: Vector2, end: Point2, arriving: Vector2) -> Vec<Point2> {
    let apart = (end - start).norm();
    // Longer handles where the curve turns back, so that a U-turn bulges like half a circle.
    let turned_back = (1.0 - leaving.dot(&arriving)) * 0.5;
    let handle = apart * (0.36 + 0.3 * turned_back * turned_back);
    let (a, b) = (start + leaving * handle, end - arriving * handle);
    let pieces = (apart.ceil() as usize).clamp(4, 200);
    (0..=pieces)
        .map(|index| {
            let t = index as f64 / pieces as f64;
            let s = 1.0 - t;
            let sum = start.coords * (s * s * s)
                + a.coords * (3.0 * s * s * t)
                + b.coords * (3.0 * s * t * t)
                + end.coords * (t * t * t);
            sum.into()
        })
        .collect()
}

/// What decides between two connections that touch.
struct Claim<'a> {
    id: ConnectionId,
    from: LaneId,
    to: LaneId,
    trace: Trace<'a>,
    /// Paths nearer than this touch; narrow lanes side by side do not, or nobody could use them.
    near: f64,
    rank: (u8, u8, ConnectionId),
    signal: Option<SignalGroup>,
}

fn set_conflicts(network: &mut RoadNetwork, id: IntersectionId, own: &[ConnectionId]) {
    let plan = network.signals.last().filter(|plan| plan.intersection == id);
    let claims: Vec<Claim<'_>> = own.iter().map(|id| claim(network, *id)).collect();
    let mut met: Vec<(ConnectionId, ConnectionId, Option<bool>)> = Vec::with_capacity(claims.len() * 4);
    for (index, a) in claims.iter().enumerate() {
        for b in &claims[index + 1..] {
            // From one lane it is one file of vehicles: the follower sees its leader.
            if a.from != b.from && (a.to == b.to || a.trace.touches(&b.trace, a.near)) {
                met.push((a.id, b.id, go_together(plan, a, b).then(|| a.rank > b.rank)));
            }
        }
    }
    for (a, b, yields) in met {
        network.connections[a.index()].conflicts.push(b);
        network.connections[b.index()].conflicts.push(a);
        match yields {
            Some(true) => network.connections[a.index()].yields_to.push(b),
            Some(false) => network.connections[b.index()].yields_to.push(a),
            None => {}
        }
    }
    for connection in own {
        let connection = &mut network.connections[connection.index()];
        connection.conflicts.sort_unstable();
        connection.yields_to.sort_unstable();
    }
}

fn claim(network: &RoadNetwork, id: ConnectionId) -> Claim<'_> {
    let connection = &network.connections[id.index()];
    Claim {
        id,
        from: connection.from,
        to: connection.to,
        trace: Trace::of(&connection.path),
        near: TOUCHING.min(0.9 * network.lanes[connection.from.index()].width),
        rank: right_of_way(network, id),
        signal: connection.signal,
    }
}

/// Whether signals ever let both go at once; always without signals.
fn go_together(plan: Option<&SignalPlan>, a: &Claim<'_>, b: &Claim<'_>) -> bool {
    let (Some(first), Some(second)) = (a.signal, b.signal) else { return true };
    let both = |phase: &Phase| phase.green.contains(&first) && phase.green.contains(&second);
    plan.is_some_and(|plan| first == second || plan.phases.iter().any(both))
}

/// The place in the order of right of way, lowest first: the ring of a roundabout, the higher road class, then straight before right before
/// left; the index settles the rest, so that two never give way to each other.
fn right_of_way(network: &RoadNetwork, id: ConnectionId) -> (u8, u8, ConnectionId) {
    let connection = &network.connections[id.index()];
    let road = network.lanes[connection.from.index()].road;
    let controlled = network.intersections[connection.intersection.index()].control == Control::Signals;
    let road = &network.roads[road.index()];
    let class = match road.class {
        // Who is in a roundabout goes first.
        _ if road.roundabout => 0,
        _ if controlled => 1,
        RoadClass::Highway => 1,
        RoadClass::Arterial => 2,
        RoadClass::Local => 3,
    };
    let turn = match connection.turn {
        Turn::Straight => 0,
        Turn::Right => 1,
        Turn::Left => 2,
        Turn::UTurn => 3,
    };
    (class, turn, id)
}

fn set_crossings(network: &mut RoadNetwork, id: IntersectionId, own: &[ConnectionId]) {
    let crossings = network.intersections[id.index()].crossings.clone();
    for connection in own {
        let path = &network.connections[connection.index()].path;
        let over: Vec<_> = crossings
            .iter()
            .copied()
            .filter(|crossing| {
                let strip = &network.crossings[crossing.index()];
                path.windows(2)
                    .any(|piece| polyline::crossing(piece[0], piece[1], strip.start, strip.end).is_some())
            })
            .collect();
        network.connections[connection.index()].crossings = over;
    }
}
