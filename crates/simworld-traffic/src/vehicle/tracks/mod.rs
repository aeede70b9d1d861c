//! Tracks: lanes and the ways across intersections, numbered together, with what a driver must know of each.
//!
//! What is known of them before anybody drives: the [parts](layout) that threads work on, which lanes lie [side by side](lanes),
//! [lead on](leading) or [without end](onward), and where ways [meet](mod@conflicts) by the ground that bodies [sweep](swept) over. Which lanes
//! are [closed](closures) changes as time goes on.

pub(super) mod beside;
pub(super) mod closures;
pub(super) mod conflicts;
pub(super) mod lanes;
pub(super) mod layout;
pub(super) mod leading;
pub(super) mod meeting;
pub(super) mod onward;
pub(super) mod swept;

use std::sync::Arc;

use beside::Beside;
use closures::Closures;
use conflicts::{Conflict, conflicts};
use layout::{Layout, Place};
use leading::is_sure;
use meeting::{Held, Meeting};
use simworld_core::geometry::Point2;
use simworld_core::id::{ConnectionId, LaneId};
use simworld_core::lists::Lists;
use simworld_core::net::{Connection, Lane, LaneKind, RoadNetwork, Turn, polyline};
use simworld_core::ops::{self, wrap_angle};

use super::VehicleKind;
use super::junctions::clusters::Clusters;
use super::junctions::trailing::SPARE;
use super::manager::NONE;
use super::trips::kerb;
use crate::{Leg, Router, TrafficConfig};

/// A lane or a connection: lanes come first.
pub(crate) type Track = u32;

/// A place on a connection where people may cross it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Strip {
    pub(crate) crossing: u32,
    /// Where a vehicle's front must stop to leave the strip free, m along the connection; may be negative.
    pub(crate) stop: f64,
    /// Where the strip ends, m along the connection.
    pub(crate) end: f64,
}

/// A body on a track that is not the traffic's own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Obstacle {
    pub(crate) track: Track,
    /// Its near and its far side, m along the track.
    pub(crate) near: f64,
    pub(crate) far: f64,
    /// How far beside the middle of the track it begins, m; not above zero where it covers it.
    pub(crate) aside: f64,
    /// How far it reaches to the right and to the left of the middle of the track: its least and its greatest place to the left, m.
    pub(crate) reach: (f64, f64),
    /// How fast it goes along the track, m/s, zero if it stands or comes towards one.
    pub(crate) v: f64,
    /// Whether it stands.
    pub(crate) stands: bool,
}

impl Obstacle {
    /// Whether it leaves no room for a vehicle of half that width, m, beside it; cars and what is narrower keep as far off as cars do.
    pub(crate) fn bars(&self, half_width: f64) -> bool {
        /// Half the width that cars want for themselves, m, and what broader ones want at each side.
        const USUAL: f64 = 1.3;
        const TO_SIDE: f64 = 0.2;
        self.aside < (half_width + TO_SIDE).max(USUAL)
    }
}

/// What a step asks of a way across an intersection, apart from its lists: a line of the cache.
#[repr(align(64))]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Way {
    pub(crate) from: Track,
    pub(crate) to: Track,
    /// The number of its signal group, or [`NONE`].
    pub(crate) signal: u32,
    /// Whether it turns across oncoming traffic.
    pub(crate) crosses_oncoming: bool,
    /// Whether a stop sign stands before it.
    pub(crate) stops: bool,
    /// Whether it turns and gives way.
    pub(crate) turns_by_gaps: bool,
    /// Whether it leads over crossings, and whether nobody meets it or crosses it.
    pub(super) has_strips: bool,
    is_alone: bool,
    /// Whether long vehicles share it with nobody on some other way.
    pub(super) is_tight: bool,
    /// Its number in its part, and where the lane is kept to which it leads.
    pub(super) local: u32,
    pub(super) there: Place,
    /// Its length, m, and the speed allowed on it by law and curvature, m/s.
    pub(super) length: f64,
    pub(super) speed: f64,
    /// The ways that meet it: one asks for all of them who is there, and hardly ever for where they meet.
    meeting: Meeting,
}

const _: () = assert!(size_of::<Way>() == 64);

/// The network as drivers see it.
#[derive(Clone, Debug)]
pub(crate) struct Tracks {
    /// The network with near junctions joined, on which one drives, and as it was given.
    pub(crate) network: Arc<RoadNetwork>,
    pub(crate) drawn: Arc<RoadNetwork>,
    /// By connection: the lanes inside of joined junctions over which it leads.
    pub(crate) through: Lists<LaneId>,
    pub(crate) lanes: usize,
    /// Length of each track, m.
    pub(crate) length: Vec<f64>,
    /// Speed allowed on each track by law and curvature, m/s.
    pub(crate) speed: Vec<f64>,
    /// The ways across, by connection.
    pub(crate) ways: Vec<Way>,
    /// Their signal groups again, which are asked for in each step of a red light, and whether one can count on a change of lanes
    /// behind each.
    pub(super) signals: Vec<u32>,
    sure: Vec<bool>,
    /// The connections whose vehicles could touch one on this connection, and where.
    pub(crate) conflicts: Lists<Conflict>,
    /// The other connections from the same lane, each with the station on it at which a rear is clear of this one, m.
    pub(crate) siblings: Lists<(u32, f64)>,
    /// Ways so near to each connection that a long vehicle on either touches whoever is on the other in the turn, and those on
    /// which it touches another long one.
    pub(crate) tight: Lists<u32>,
    pub(crate) narrow: Lists<u32>,
    /// The lanes to the left and to the right of each lane that lead the same way, or [`NONE`].
    pub(crate) beside: Vec<[Track; 2]>,
    /// How wide each lane is, m: whoever changes lanes asks for it in each step.
    width: Vec<f64>,
    /// The lane beside each lane on which the others come, on streets of one lane each way, or [`NONE`].
    pub(super) opposite: Vec<Track>,
    /// What each lane is for.
    pub(super) kinds: Vec<LaneKind>,
    /// Whether one can drive on from each lane without end.
    pub(super) leads_on: Vec<bool>,
    /// Whether each lane is in a roundabout.
    ring: Vec<bool>,
    /// Whether each lane is the last of its leg before the kerb or the cycle lane.
    pub(crate) outermost: Vec<bool>,
    /// How far to the left of each lane the parking strip at its kerb lies, m; 0 where there is none.
    pub(super) kerb: Vec<f32>,
    /// The ways from the end of each lane, with the leg to which each leads.
    exits: Lists<(u32, Leg)>,
    pub(crate) router: Router,
    /// The crossings on each connection, in the order in which it meets them.
    pub(crate) strips: Lists<Strip>,
    /// The short lanes between junctions near one another.
    pub(super) clusters: Clusters,
    /// Which part of the network each track belongs to.
    pub(crate) layout: Layout,
}

impl Tracks {
    pub(crate) fn new(network: Arc<RoadNetwork>, config: &TrafficConfig) -> Self {
        let (drawn, joined) = (Arc::clone(&network), network.join_near(config.join_nearer));
        let (network, through) = match joined {
            Some(joined) => (Arc::new(joined.network), joined.through.into_iter().collect()),
            None => (network, drawn.connections.iter().map(|_| Vec::new()).collect::<Lists<LaneId>>()),
        };
        let lane_lengths = network.lanes.iter().map(|lane| lane.length);
        let way_lengths = network.connections.iter().map(|connection| connection.length);
        let length: Vec<f64> = lane_lengths.chain(way_lengths).collect();
        let lane_speeds = network.lanes.iter().map(|lane| lane.speed_limit);
        let way_speeds = network.connections.iter().enumerate().map(|(index, connection)| {
            let limit = network.lanes[connection.to.index()].speed_limit;
            let tightest = if through[index].is_empty() { curve_speed } else { bends_speed };
            limit.min(tightest(connection, config.lateral_acceleration))
        });
        let speed: Vec<f64> = lane_speeds.chain(way_speeds).collect();
        let connections = 0..network.connections.len();
        let beside = lanes::beside(&network);
        let Beside { short, tight, narrow } = Beside::new(&network, config);
        let conflicts = conflicts(&network, config, short);
        let mut layout = Layout::new(&network);
        layout.measure(&network, &length, &speed);
        let strips: Lists<Strip> = connections.clone().map(|index| strips(&network, index)).collect();
        let way = |index: usize| {
            let track = network.lanes.len() + index;
            let ends = (layout.local(track as Track), layout.place(network.connections[index].to.0));
            let has_strips = !strips[index].is_empty();
            let is_tight = !tight[index].is_empty();
            let is_met = !conflicts[index].is_empty() || is_tight || !narrow[index].is_empty();
            let meeting = Meeting::new(&layout, network.lanes.len(), index, &conflicts[index]);
            Way {
                has_strips,
                is_alone: !has_strips && !is_met,
                is_tight,
                meeting,
                ..way(&network, index, ends, (length[track], speed[track]))
            }
        };
        let ways: Vec<Way> = connections.clone().map(way).collect();
        Self {
            lanes: network.lanes.len(),
            signals: ways.iter().map(|way| way.signal).collect(),
            sure: ways.iter().map(|way| is_sure(length[way.to as usize])).collect(),
            ways,
            conflicts,
            siblings: connections.map(|index| siblings(&network, index)).collect(),
            tight,
            narrow,
            strips,
            length,
            speed,
            kerb: kerb::places(&network, &beside),
            beside,
            width: network.lanes.iter().map(|lane| lane.width).collect(),
            opposite: lanes::opposite(&network),
            kinds: network.lanes.iter().map(|lane| lane.kind).collect(),
            leads_on: onward::lead_on(&network),
            ring: network.lanes.iter().map(|lane| network.roads[lane.road.index()].roundabout).collect(),
            outermost: lanes::outermost(&network),
            exits: network.lanes.iter().map(|lane| exits(&network, lane)).collect(),
            router: Router::new(&network),
            clusters: Clusters::new(&network, config),
            layout,
            through,
            network,
            drawn,
        }
    }

    pub(crate) fn count(&self) -> usize {
        self.length.len()
    }

    /// The connection that a track is; `None` for lanes.
    #[inline]
    pub(crate) fn connection(&self, track: Track) -> Option<usize> {
        (track as usize).checked_sub(self.lanes)
    }

    /// The lane to which a connection leads.
    #[inline]
    pub(crate) fn lane_after(&self, connection: usize) -> Track {
        self.ways[connection].to
    }

    /// Whether a leg is inside of joined junctions: nobody is ever on its lanes.
    pub(crate) fn is_inside(&self, leg: Leg) -> bool {
        leg.lanes(&self.network).is_empty() && !leg.lanes(&self.drawn).is_empty()
    }

    /// Whether a lane is in a roundabout.
    pub(super) fn is_in_ring(&self, lane: Track) -> bool {
        self.ring[lane as usize]
    }

    /// Whether nobody meets a way or crosses it, as on a bend: there one drives up to whoever is behind it.
    #[inline]
    pub(super) fn is_alone(&self, way: usize) -> bool {
        self.ways[way].is_alone
    }

    /// Where a way meets those that somebody holds: `held` says which of its part these are.
    #[inline]
    pub(super) fn conflicts_held(
        &self,
        way: usize,
        held: &Held,
        is_held: impl Fn(u32) -> bool,
    ) -> impl Iterator<Item = &Conflict> {
        let meeting = self.ways[way].meeting;
        // Mostly nobody holds any of them, and no list is looked up.
        let all = if meeting.is_met(held) { &self.conflicts[way] } else { &[] };
        meeting.held(all, held, is_held)
    }

    /// Distance between the middles of two lanes side by side, m.
    pub(crate) fn apart(&self, a: Track, b: Track) -> f64 {
        (self.width[a as usize] + self.width[b as usize]) * 0.5
    }

    /// The way from a lane to an open lane of a leg, if one leads there; best to one on which the kind may drive, and from which
    /// the legs `after` that are reached, or, for who has none, one can drive on.
    pub(crate) fn way_to(
        &self,
        closures: &Closures,
        lane: Track,
        leg: Leg,
        after: &[Leg],
        kind: VehicleKind,
    ) -> Option<u32> {
        let leads_there = |exit: &&(u32, Leg)| exit.1 == leg && !closures.bars(self, exit.0 as usize);
        let ways = self.exits[lane as usize].iter().filter(leads_there).map(|exit| exit.0);
        let worth = |way: u32| {
            let may_use = self.may_use(self.ways[way as usize].to, kind);
            (may_use, self.leads_on_to(way, after))
        };
        // Of equals the first.
        ways.rev().max_by_key(|way| worth(*way))
    }

    /// The ways from the end of a lane, with the leg to which each leads.
    pub(super) fn exits(&self, lane: Track) -> &[(u32, Leg)] {
        &self.exits[lane as usize]
    }

    pub(crate) fn path(&self, track: Track) -> &[Point2] {
        match self.connection(track) {
            Some(connection) => &self.network.connections[connection].path,
            None => &self.network.lanes[LaneId(track).index()].path,
        }
    }

    /// Whether a vehicle of that length has its rear in the junction behind while it turns round at the end of a lane: who comes
    /// the other way waits for it there, and it for him.
    fn is_trap(&self, lane: Track, length: f64) -> bool {
        let turns_round = |way: &ConnectionId| self.network.connections[way.index()].turn == Turn::UTurn;
        self.length[lane as usize] < length + SPARE
            && self.network.lanes[lane as usize].outgoing.iter().all(turns_round)
    }

    /// The ways on from a lane, with their weights by turn for a vehicle of such a kind and length, into `weights`. Where one
    /// leads to streets on which one can drive on, those that end somewhere have no weight.
    pub(crate) fn weighted_ways(
        &self,
        lane: Track,
        (kind, length): (VehicleKind, f64),
        turns: &[f64; 3],
        weights: &mut Vec<f64>,
    ) -> &[ConnectionId] {
        let ways = &self.network.lanes[lane as usize].outgoing;
        // Better to turn round before who comes than to go where one stands for good.
        let worth = |way: &ConnectionId| {
            let after = self.lane_after(way.index());
            match (self.may_use(after, kind), self.leads_on[after as usize], self.is_trap(after, length)) {
                (false, ..) => 0,
                (_, false, _) => 1,
                (.., true) => 2,
                _ => 3,
            }
        };
        let best = ways.iter().map(worth).max().unwrap_or(0).max(1);
        weights.clear();
        weights.extend(
            ways.iter().map(|way| if worth(way) == best { self.weight(way.index(), turns) } else { 0.0 }),
        );
        ways
    }

    /// The weight of a way by its turn.
    pub(crate) fn weight(&self, way: usize, turns: &[f64; 3]) -> f64 {
        match self.network.connections[way].turn {
            Turn::Straight => turns[0],
            Turn::Right => turns[1],
            Turn::Left => turns[2],
            Turn::UTurn => 1.0,
        }
    }
}

fn exits(network: &RoadNetwork, lane: &Lane) -> Vec<(u32, Leg)> {
    let leg = |way: &ConnectionId| Leg::of(network, network.connections[way.index()].to);
    lane.outgoing.iter().map(|way| (way.0, leg(way))).collect()
}

fn way(
    network: &RoadNetwork,
    index: usize,
    (local, there): (usize, Place),
    (length, speed): (f64, f64),
) -> Way {
    let connection = &network.connections[index];
    Way {
        from: connection.from.0,
        to: connection.to.0,
        signal: connection.signal.map_or(NONE, |group| group.index() as u32),
        crosses_oncoming: connection.turn == network.driving_side.turn_across(),
        stops: network.stops_at(connection.from),
        turns_by_gaps: connection.turn != Turn::Straight && !connection.yields_to.is_empty(),
        has_strips: false,
        is_alone: true,
        is_tight: false,
        local: local as u32,
        there,
        length,
        speed,
        meeting: Meeting::default(),
    }
}

/// The speed at which the tightest part of a path is taken, m/s.
fn curve_speed(way: &Connection, lateral: f64) -> f64 {
    let Connection { path, length, turn, .. } = way;
    let (_, first) = polyline::at(path, 0.0);
    let (_, last) = polyline::at(path, *length);
    let turned = if *turn == Turn::UTurn {
        // Round a turning circle one turns by more than from the first heading to the last.
        let turns = path.windows(3).map(|three| {
            let (before, after) = (three[1] - three[0], three[2] - three[1]);
            ops::atan2(before.perp(&after), before.dot(&after)).abs()
        });
        turns.sum::<f64>()
    } else {
        wrap_angle(last - first).abs()
    };
    if turned < 0.15 {
        return f64::INFINITY;
    }
    (lateral * length / turned).sqrt().max(2.5)
}

/// The speed at which the tightest bend of a way across joined junctions is taken, m/s: it turns in a part of it alone.
fn bends_speed(way: &Connection, lateral: f64) -> f64 {
    /// As long as a turn of a car, m.
    const BEND: f64 = 10.0;
    let heading = |station: f64| polyline::at(&way.path, station.min(way.length)).1;
    let pieces = way.length.ceil() as usize;
    let turned = |piece: usize| wrap_angle(heading(piece as f64 + BEND) - heading(piece as f64)).abs();
    let most = (0..pieces).map(turned).fold(0.0, f64::max);
    if most < 0.15 { f64::INFINITY } else { (lateral * BEND.min(way.length) / most).sqrt().max(2.5) }
}

/// The ways that part from this one, and where.
fn siblings(network: &RoadNetwork, connection: usize) -> Vec<(u32, f64)> {
    /// Paths farther apart than this carry two vehicles beside each other, m.
    const APART: f64 = 2.8;
    let own = &network.connections[connection];
    let others = network.lanes[own.from.index()].outgoing.iter().filter(|id| id.index() != connection);
    others
        .map(|id| {
            let other = &network.connections[id.index()];
            let metres = other.length.ceil().max(1.0);
            let is_near = |station: &f64| {
                let point = polyline::at(&other.path, *station).0;
                polyline::closest(&own.path, &point).is_some_and(|near| near.distance < APART)
            };
            let mut stations = (1..=metres as u32).map(|metre| other.length * f64::from(metre) / metres);
            (id.0, stations.rfind(is_near).unwrap_or(0.0) + 0.5)
        })
        .collect()
}

fn strips(network: &RoadNetwork, connection: usize) -> Vec<Strip> {
    /// Room for toes and bumpers, m.
    const ROOM: f64 = 0.7;
    let connection = &network.connections[connection];
    let mut strips: Vec<Strip> = connection
        .crossings
        .iter()
        .filter_map(|id| {
            let crossing = &network.crossings[id.index()];
            let mut station = 0.0;
            for piece in connection.path.windows(2) {
                let span = (piece[1] - piece[0]).norm();
                if let Some((share, _)) = polyline::crossing(piece[0], piece[1], crossing.start, crossing.end)
                {
                    let middle = station + share * span;
                    let half = crossing.width * 0.5 + ROOM;
                    return Some(Strip { crossing: id.0, stop: middle - half, end: middle + half });
                }
                station += span;
            }
            None
        })
        .collect();
    strips.sort_by(|a, b| a.stop.total_cmp(&b.stop));
    strips
}
