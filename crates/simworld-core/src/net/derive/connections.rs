//! Connections: the ways across an intersection, which of them touch, and who gives way.

use std::borrow::Cow;
use std::ops::Range;

use super::ends::{End, Ends};
use super::legs::{Leg, Legs};
use super::near_side::Search;
use super::trace::{Strip, Trace, Traces};
use super::workers::{self, PART, Workers};
use super::{cycles, hammerhead, kerbs, near_side, ways};
use crate::geometry::Point2;
use crate::id::{ConnectionId, CrossingId, IntersectionId, LaneId};
use crate::net::{
    Connection, Control, Few, Intersection, LaneWays, Phase, RoadClass, RoadNetwork, SignalGroup, SignalPlan,
    StreetPlan, Turn, TurnSet, polyline,
};
use crate::ops::wrap_angle;

/// Paths nearer than this touch: a vehicle's width and a margin, m.
const TOUCHING: f64 = 2.4;
/// A change of heading below this counts as straight on, radians.
const STRAIGHT: f64 = 0.7;
/// Nobody is stopped by a light on lanes shorter than this, m: a bus would stand in the junction behind.
const INNER: f64 = 12.0;
/// Distance between the kerb of a turning circle or a hammerhead and a lane's width about the way round it, m.
const KERB_CLEARANCE: f64 = 0.5;

/// The connections of some intersections, under construction; their numbers begin at zero.
#[derive(Default)]
struct Builder {
    made: Vec<Connection>,
    // The memory of the work at one intersection, kept for the next.
    movements: Vec<(LaneId, LaneId, Turn)>,
    traces: Traces,
    claims: Vec<Claim>,
    met: Vec<Meeting>,
    strips: Vec<(CrossingId, Strip)>,
    search: Search,
}

/// The connections of some intersections that follow one another, with numbers from zero on. Lanes, crossings and signals
/// must be there.
pub(super) fn of_nodes(
    network: &RoadNetwork,
    plan: &StreetPlan,
    (legs, ends): (&Legs, &[Ends]),
    nodes: Range<usize>,
) -> Vec<Connection> {
    let mut builder = Builder::default();
    // As many as there are where every street has one lane each way.
    let ways = |node: usize| legs[node].len() * legs[node].len().saturating_sub(1).max(1);
    builder.made.reserve(nodes.clone().map(ways).sum());
    for node in nodes {
        builder.add(network, plan, (IntersectionId::from_index(node), &legs[node]), ends);
    }
    builder.made
}

/// Finds what the connections of one intersection touch and over which crossings they lead, where nobody derived them; the
/// first only if `meetings` are wanted.
pub(in crate::net) fn settle(network: &mut RoadNetwork, place: IntersectionId, meetings: bool) {
    let ids = network.intersections[place.index()].connections.clone();
    let made = ids.iter().map(|id| network.connections[id.index()].clone()).collect();
    let mut builder = Builder { made, ..Builder::default() };
    for (rank, connection) in builder.made.iter().enumerate() {
        let id = ConnectionId::from_index(rank);
        builder.claims.push(claim(network, connection, id, &mut builder.traces));
    }
    if meetings {
        let signals = network.intersections[place.index()].signals;
        builder.set_conflicts(signals.map(|index| &network.signals[index as usize]), 0);
        for other in
            builder.made.iter_mut().flat_map(|own| own.conflicts.iter_mut().chain(&mut own.yields_to))
        {
            *other = ids[other.index()];
        }
    }
    builder.set_crossings(&network.intersections[place.index()].crossings, network);
    for (id, connection) in ids.iter().zip(builder.made) {
        network.connections[id.index()] = connection;
    }
}

/// Adds connections that were made for the intersections of each part of the work, with numbers from zero on.
pub(super) fn append(network: &mut RoadNetwork, mut made: Vec<Vec<Connection>>, workers: &dyn Workers) {
    let mut firsts = Vec::with_capacity(made.len());
    let count = made.iter().fold(0, |first, part| {
        firsts.push(first as u32);
        first + part.len()
    });
    let parts = made.iter_mut().zip(network.intersections.chunks_mut(PART)).zip(firsts);
    workers::hand_out(workers, parts, |((made, places), first)| number(made, places, first));
    for part in made {
        for (number, connection) in (network.connections.len()..).zip(&part) {
            network.lanes[connection.from.index()].outgoing.push(ConnectionId::from_index(number));
        }
        workers::take_over(&mut network.connections, part, count);
    }
}

/// Numbers the connections of the intersections of one part from a first one on, and tells the intersections.
fn number(made: &mut [Connection], places: &mut [Intersection], first: u32) {
    let mut next = first;
    for own in made.chunk_by_mut(|a, b| a.intersection == b.intersection) {
        let end = next + own.len() as u32;
        places[own[0].intersection.index() % PART].connections = (next..end).map(ConnectionId).collect();
        for connection in own {
            for other in connection.conflicts.iter_mut().chain(&mut connection.yields_to) {
                other.0 += first;
            }
        }
        next = end;
    }
}

impl Builder {
    /// Adds the connections of one intersection.
    fn add(
        &mut self,
        network: &RoadNetwork,
        plan: &StreetPlan,
        (id, legs): (IntersectionId, &[Leg]),
        ends: &[Ends],
    ) {
        let first = self.made.len();
        let signals = network.intersections[id.index()].signals;
        let signals = signals.map(|index| &network.signals[index as usize]);
        for (index, leg) in legs.iter().enumerate() {
            let signal = signals.filter(|_| !is_inner(network, leg)).map(|signals| signals.groups[index]);
            set_movements(network, plan, legs, leg, &mut self.movements);
            self.movements.extend(cycles::movements(network, plan, legs, leg));
            let place = Place { id, legs, leg: index };
            for movement in &self.movements {
                let between = (ends[movement.0.index()].end, ends[movement.1.index()].begin);
                self.made.push(connection(network, &place, between, *movement, signal, &mut self.search));
            }
        }
        let crossings = &network.intersections[id.index()].crossings;
        // At most dead ends there is one way and nothing that it could touch.
        if self.made.len() < first + 2 && crossings.is_empty() {
            return;
        }
        self.traces.clear();
        self.claims.clear();
        for (index, connection) in self.made.iter().enumerate().skip(first) {
            let id = ConnectionId::from_index(index);
            self.claims.push(claim(network, connection, id, &mut self.traces));
        }
        self.set_conflicts(signals, first);
        self.set_crossings(crossings, network);
    }
}

/// Whether a leg is as good as a part of the junction: who waited on it would stand in the junction behind.
fn is_inner(network: &RoadNetwork, leg: &Leg) -> bool {
    let is_short = |lane: &LaneId| {
        let lane = &network.lanes[lane.index()];
        lane.length < INNER && network.intersections[lane.from.index()].roads.len() > 2
    };
    arriving(network, leg).iter().all(is_short)
}

/// Lanes that arrive over a leg, and lanes that leave over it, from the middle outwards.
pub(super) fn arriving<'a>(network: &'a RoadNetwork, leg: &Leg) -> &'a [LaneId] {
    let road = &network.roads[leg.street];
    if leg.at_start { &road.backward } else { &road.forward }
}

pub(super) fn leaving<'a>(network: &'a RoadNetwork, leg: &Leg) -> &'a [LaneId] {
    let road = &network.roads[leg.street];
    if leg.at_start { &road.forward } else { &road.backward }
}

/// Finds which lanes of a leg lead to which lanes of the others, written over `found`.
fn set_movements(
    network: &RoadNetwork,
    plan: &StreetPlan,
    legs: &[Leg],
    leg: &Leg,
    found: &mut Vec<(LaneId, LaneId, Turn)>,
) {
    let from = arriving(network, leg);
    found.clear();
    add_ways_on(network, plan, legs, leg, (arrows(plan, leg), ways::of(plan, leg)), found);
    // Arrows that no street answers are a mistake: better without them than back.
    if found.is_empty() {
        add_ways_on(network, plan, legs, leg, (&[], &[]), found);
    }
    if found.is_empty() {
        lane_to_lane(from, leaving(network, leg), Turn::UTurn, found);
    }
    let stranded: Vec<LaneId> =
        from.iter().copied().filter(|lane| found.iter().all(|f| f.0 != *lane)).collect();
    if let Some((_, to, turn)) = found.first().copied() {
        found.extend(stranded.into_iter().map(|lane| (lane, to, turn)));
    }
    // Of one lane in the order of the legs to which its ways lead, whatever the numbers of those.
    found.sort_by_key(|(from, ..)| *from);
}

/// Adds the ways from the lanes of a leg over a junction: those that are known, and to other streets those that arrows allow.
fn add_ways_on(
    network: &RoadNetwork,
    plan: &StreetPlan,
    legs: &[Leg],
    leg: &Leg,
    (arrows, known): (&[TurnSet], &[LaneWays]),
    found: &mut Vec<(LaneId, LaneId, Turn)>,
) {
    let from = arriving(network, leg);
    for other in legs.iter().filter(|other| other.street != leg.street) {
        let turn = turn_between(plan, leg, other);
        if ways::add(network, known, legs, (leg, other, turn), found) {
            continue;
        }
        let to = leaving(network, other);
        // Where only two roads meet, all lanes follow the bend.
        if legs.len() == 2 {
            lane_to_lane(from, to, turn, found);
            continue;
        }
        let usable: Cow<'_, [LaneId]> = match turn {
            _ if arrows.len() == from.len() => from
                .iter()
                .zip(arrows)
                .filter(|(_, arrow)| arrow.allows(turn))
                .map(|(lane, _)| *lane)
                .collect(),
            Turn::Straight => from.into(),
            Turn::Right => from[from.len().saturating_sub(1)..].into(),
            Turn::Left | Turn::UTurn => from[..from.len().min(1)].into(),
        };
        match turn {
            Turn::Straight => lane_to_lane(&usable, to, turn, found),
            // Side by side, along the outer kerb or along the middle.
            Turn::Right => {
                found.extend(usable.iter().rev().zip(to.iter().rev()).map(|(a, b)| (*a, *b, turn)));
            }
            Turn::Left | Turn::UTurn => found.extend(usable.iter().zip(to).map(|(a, b)| (*a, *b, turn))),
        }
    }
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

/// A junction, and the leg over which one arrives.
struct Place<'a> {
    id: IntersectionId,
    legs: &'a [Leg],
    leg: usize,
}

/// The middle of the way from one lane to another: round the turning circle or in the hammerhead of a dead end, or a smooth
/// curve that keeps off the kerb.
fn path(
    network: &RoadNetwork,
    place: &Place<'_>,
    ((start, arriving_along), (end, end_along)): (End, End),
    (from, to, turn): (LaneId, LaneId, Turn),
    search: &mut Search,
) -> Vec<Point2> {
    let leg = &place.legs[place.leg];
    let (entry, exit) = (&network.lanes[from.index()], &network.lanes[to.index()]);
    if turn == Turn::UTurn && (leg.turning > 0.0 || leg.hammerhead) {
        let ahead = leg.direction();
        let left = |point: Point2| ahead.perp(&(point - leg.node));
        let lanes = arriving(network, leg);
        let outside = lanes.iter().rev().take_while(|lane| **lane != from).count() as f64;
        let keep = KERB_CLEARANCE + entry.width * (0.5 + outside);
        let between = (left(start), -left(end));
        let round = if leg.hammerhead { hammerhead::turning_path } else { kerbs::turning_path };
        if let Some(mut path) = round(leg, between, keep) {
            // A street that bends before its end has its lanes end a little beside.
            let last = path.len() - 1;
            (path[0], path[last]) = (start, end);
            return path;
        }
    }
    let next = (place.leg + 1) % place.legs.len();
    if turn == Turn::UTurn || place.legs[next].street != exit.road.index() {
        return search.curves.curve(start, arriving_along, end, end_along);
    }
    let way = near_side::Way { from: leg, start, to: &place.legs[next], end };
    let corner = (&network.intersections[place.id.index()], place.leg);
    near_side::keep_off(network, corner, &way, (arriving_along, end_along), search)
}

fn connection(
    network: &RoadNetwork,
    place: &Place<'_>,
    between: (End, End),
    (from, to, turn): (LaneId, LaneId, Turn),
    signal: Option<SignalGroup>,
    search: &mut Search,
) -> Connection {
    let path = path(network, place, between, (from, to, turn), search);
    Connection {
        from,
        to,
        intersection: place.id,
        turn,
        length: polyline::length(&path),
        path,
        signal,
        conflicts: Few::new(),
        yields_to: Few::new(),
        crossings: Few::new(),
    }
}

/// What decides between two connections that touch.
struct Claim {
    id: ConnectionId,
    from: LaneId,
    to: LaneId,
    trace: Trace,
    /// Paths nearer than this touch; narrow lanes side by side do not, or nobody could use them.
    near: f64,
    rank: (u8, u8, ConnectionId),
    signal: Option<SignalGroup>,
    /// How many others it touches, and to how many it gives way.
    counts: (usize, usize),
}

/// Two connections that touch, by their ranks among those of the intersection.
struct Meeting {
    a: usize,
    b: usize,
    /// Whether the first gives way, if they ever go together.
    yields: Option<bool>,
}

impl Builder {
    /// Sets which of the connections from `first` on touch each other, and which give way.
    fn set_conflicts(&mut self, signals: Option<&SignalPlan>, first: usize) {
        let Self { made, claims, traces, met, .. } = self;
        met.clear();
        for rank in 0..claims.len() {
            let (before, after) = claims.split_at_mut(rank + 1);
            let a = &mut before[rank];
            for (further, b) in after.iter_mut().enumerate() {
                // From one lane it is one file of vehicles: the follower sees its leader.
                if a.from == b.from || (a.to != b.to && !traces.touch(&a.trace, &b.trace, a.near)) {
                    continue;
                }
                let yields = go_together(signals, a, b).then(|| a.rank > b.rank);
                for (claim, gives_way) in [(&mut *a, true), (b, false)] {
                    claim.counts.0 += 1;
                    claim.counts.1 += usize::from(yields == Some(gives_way));
                }
                met.push(Meeting { a: rank, b: rank + 1 + further, yields });
            }
        }
        let own = &mut made[first..];
        for (connection, claim) in own.iter_mut().zip(claims.iter()) {
            connection.conflicts.reserve_exact(claim.counts.0);
            connection.yields_to.reserve_exact(claim.counts.1);
        }
        // Ascending, as the pairs are: of each connection first those with lower ones, then those with higher ones.
        for Meeting { a, b, yields } in met.iter() {
            own[*a].conflicts.push(claims[*b].id);
            own[*b].conflicts.push(claims[*a].id);
            match yields {
                Some(true) => own[*a].yields_to.push(claims[*b].id),
                Some(false) => own[*b].yields_to.push(claims[*a].id),
                None => {}
            }
        }
    }

    /// Sets over which crossings of the intersection each connection leads.
    fn set_crossings(&mut self, all: &[CrossingId], network: &RoadNetwork) {
        let Self { made, claims, traces, strips, .. } = self;
        let strip = |id: &CrossingId| {
            let crossing = &network.crossings[id.index()];
            (*id, Strip::of(crossing.start, crossing.end))
        };
        strips.clear();
        strips.extend(all.iter().map(strip));
        for claim in claims.iter() {
            let over = strips.iter().filter(|(_, strip)| traces.crosses(&claim.trace, strip));
            made[claim.id.index()].crossings = over.map(|(crossing, _)| *crossing).collect();
        }
    }
}

fn claim(network: &RoadNetwork, connection: &Connection, id: ConnectionId, traces: &mut Traces) -> Claim {
    Claim {
        id,
        from: connection.from,
        to: connection.to,
        trace: traces.add(&connection.path),
        near: TOUCHING.min(0.9 * network.lanes[connection.from.index()].width),
        rank: right_of_way(network, connection, id),
        signal: connection.signal,
        counts: (0, 0),
    }
}

/// Whether signals ever let both go at once; always without signals.
fn go_together(plan: Option<&SignalPlan>, a: &Claim, b: &Claim) -> bool {
    let (Some(first), Some(second)) = (a.signal, b.signal) else { return true };
    let both = |phase: &Phase| phase.green.contains(&first) && phase.green.contains(&second);
    plan.is_some_and(|plan| first == second || plan.phases.iter().any(both))
}

/// The place in the order of right of way, lowest first: the ring of a roundabout and the short lanes without a light before a
/// junction with lights, the higher road class, then straight before right before left; the index settles the rest, so that two
/// never give way to each other.
fn right_of_way(network: &RoadNetwork, connection: &Connection, id: ConnectionId) -> (u8, u8, ConnectionId) {
    let lane = &network.lanes[connection.from.index()];
    let controlled = network.intersections[connection.intersection.index()].control == Control::Signals;
    let road = &network.roads[lane.road.index()];
    let class = match road.class {
        // Who is in a roundabout, or between two junctions where nobody can wait, goes first.
        _ if road.roundabout => 0,
        _ if controlled && connection.signal.is_none() && lane.length < INNER => 0,
        // Beside junctions with lights, joined to them, who has none gives way to those who have.
        _ if controlled => 1 + u8::from(connection.signal.is_none()),
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
