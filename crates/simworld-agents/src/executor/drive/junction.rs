//! Lines and junctions: lights, stop signs, gaps in the streams that go first, and room behind.
//!
//! The gaps are those that the traffic takes ([`CriticalGaps`]), and the stretches on which ways meet are the same
//! ([`WayTrace`]). Of others one knows neither where they will turn nor whether they mean to wait: whoever is in a lane may take
//! each of its ways, and one who gives way counts until it could not stop any more.

use serde::{Deserialize, Serialize};
use simworld_core::geometry::Point2;
use simworld_core::id::ConnectionId;
use simworld_core::net::{
    Aspect, Connection, CriticalGaps, Ends, RoadNetwork, WayTrace, Zone, polyline, time_over,
};
use simworld_core::ops::wrap_angle;
use simworld_core::scene::Scene;

use super::Driving;
use super::around::{STANDING, Seen};
use super::bend;
use super::people::{self, Strip};
use super::watch::{BRAKING, GAP, LATERAL, Own, stopping};
use crate::lanes::lane;

/// Harder braking, for a light that has just changed, m/s²; and the hardest.
const FIRM: f64 = 3.5;
const HARDEST: f64 = 6.0;
/// Room kept before a stop line, m: feet lag behind what one wants. Who stands over it by less than this has not passed it.
const TO_LINE: f64 = 1.5;
pub(super) const OVER: f64 = 0.5;
/// The last metres to a line are driven no faster than they last this long, s: what feet lag behind is less.
const LAG: f64 = 0.8;
/// One stands at a line that is nearer than this, m.
const AT_LINE: f64 = 3.0;
/// One stands this long at a stop sign, s.
const STOPS: f64 = 1.0;
/// Room to both sides of two bodies that pass each other, m.
const SWEPT: f64 = 0.9;
/// The width that others are taken to have, m: a truck's.
const OTHERS: f64 = 2.4;
/// Acceleration with which one crosses, and with which others are expected to come and to clear the way, m/s².
const CROSSES: f64 = 1.3;
const COMES: f64 = 1.5;
const CLEARS: f64 = 1.0;
/// Acceleration to the side with which others are expected to clear it in a bend, m/s².
const CAREFUL: f64 = 1.5;
/// Braking with which others are expected to stop, m/s².
const EASILY: f64 = 2.5;
/// A gap begins with the start, s: from the decision to the line.
const START: f64 = 1.2;
/// Time that one wants between two who meet, s.
const MARGIN: f64 = 0.6;
/// Who rolls so near to its line while one stands at one's own, or has hardly started, is not relied on to stop, m and m/s.
const NEAR_LINE: f64 = 15.0;
const STARTS: f64 = 2.5;
/// Vehicles are looked for within this distance of their line, m.
pub(super) const SIGHT: f64 = 100.0;
/// After so long at the line those who stand are not waited for any more, s: they let one go, or cannot go themselves.
const PATIENT: f64 = 4.0;
/// Who turned across nobody in a whole green goes at the end of it, after so long at the line, s.
const WHOLE_GREEN: f64 = 5.0;
/// There is time enough for that while yellow has shown for less than this, s.
const FRESH: f64 = 0.6;

/// A stop line on the path.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Line {
    /// m along the path.
    pub(super) station: f64,
    /// The way across the junction behind it.
    pub(super) turn: ConnectionId,
    /// How long one has stood at it, s.
    pub(super) waited: f64,
    /// For how long one has seen its light at yellow, s.
    yellow: f64,
    /// Whether one is over it.
    pub(super) is_passed: bool,
    /// What one has to mind beyond it, once one is near.
    junction: Option<Junction>,
}

/// A junction as who crosses it has to mind it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Junction {
    meetings: Vec<Meeting>,
    pub(super) strips: Vec<Strip>,
    /// Length of the way across, m, and the speed there, m/s.
    length: f64,
    speed: f64,
}

/// Another way that meets one's own.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Meeting {
    way: ConnectionId,
    /// The gap that one needs before those who come on it, if they go first, s.
    critical: Option<f64>,
    ends: Ends,
    own: Zone,
    other: Zone,
    /// How fast others go round its bend, m/s.
    pace: f64,
}

/// Why one waits at a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Wait {
    /// For the light.
    Light,
    /// For others: who goes first, walks, or stands behind the junction.
    Others,
}

impl Line {
    pub(super) fn new(station: f64, turn: ConnectionId) -> Self {
        Self { station, turn, waited: 0.0, yellow: 0.0, is_passed: false, junction: None }
    }
}

impl Junction {
    fn new(network: &RoadNetwork, turn: &Connection, own: &Own<'_>) -> Self {
        let gaps = CriticalGaps::default();
        let trace = WayTrace::new(turn);
        let near = own.half_width + OTHERS * 0.5 + SWEPT;
        let meet = |id: &ConnectionId| {
            let other = &network.connections[id.index()];
            let ends = Ends::of(turn, other);
            let theirs = WayTrace::new(other);
            Meeting {
                way: *id,
                critical: turn.yields_to.contains(id).then(|| gaps.critical(network, turn, other)),
                ends,
                own: trace.zone(&theirs, near, ends),
                other: theirs.zone(&trace, near, ends),
                pace: round_bend(other, CAREFUL),
            }
        };
        let others = turn.conflicts.iter().filter(|id| network.connections[id.index()].from != turn.from);
        let swung_into = bend::swung_into(network, turn, own).into_iter().map(|(id, near)| {
            let other = &network.connections[id.index()];
            let theirs = WayTrace::new(other);
            let (mine, theirs) =
                (trace.zone(&theirs, near, Ends::Apart), theirs.zone(&trace, near, Ends::Apart));
            let pace = round_bend(other, CAREFUL);
            // One waits for whoever would come meanwhile, and asks for no more.
            Meeting { way: id, critical: Some(START), ends: Ends::Apart, own: mine, other: theirs, pace }
        });
        let limit = lane(network, turn.from).speed_limit.min(lane(network, turn.to).speed_limit);
        Self {
            meetings: others.map(meet).chain(swung_into).collect(),
            strips: people::strips(network, turn),
            length: turn.length,
            speed: round_bend(turn, LATERAL).min(limit),
        }
    }
}

/// The speed for the mean bend of a way across at that acceleration to the side, m/s; infinite where it is straight.
fn round_bend(way: &Connection, lateral: f64) -> f64 {
    let turned = wrap_angle(polyline::at(&way.path, way.length).1 - polyline::at(&way.path, 0.0).1).abs();
    if turned > 0.15 { (lateral * way.length / turned).sqrt().max(2.5) } else { f64::INFINITY }
}

/// How one would cross: from where the front is, m before the line, and how fast.
#[derive(Clone, Copy, Debug)]
struct Asker {
    distance: f64,
    v: f64,
    speed: f64,
    length: f64,
    waited: f64,
}

impl Asker {
    /// When the front is at a station of the way, s.
    fn time(&self, station: f64) -> f64 {
        time_over(self.distance + station, self.v, CROSSES, self.speed.max(self.v))
    }

    /// When the rear has left the stretch that a way shares with one's own, with what another that ends in the same lane needs to
    /// come down to one's own speed, s.
    fn gone(&self, meeting: &Meeting, other: f64) -> f64 {
        let passed = meeting.own.passed() + self.length;
        let there =
            (self.v * self.v + 2.0 * CROSSES * (self.distance + passed)).max(0.0).sqrt().min(self.speed);
        let excess = if meeting.ends == Ends::Together { (other - there).max(0.0) } else { 0.0 };
        self.time(passed) + excess * excess / (2.0 * EASILY * other.max(1.0)) + MARGIN
    }

    /// Whether somebody on its way across leaves one time: it is gone, or will be, or comes later.
    fn passes_on_way(&self, meeting: &Meeting, front: f64, other: &Seen, speed: f64) -> bool {
        let (rear, v) = (front - 2.0 * other.half_length, other.speed());
        if rear >= meeting.other.passed() {
            return true;
        }
        if other.stands() {
            let is_before = front < meeting.other.enter() + 0.3;
            return is_before && (meeting.critical.is_none() || self.waited > PATIENT);
        }
        let clears = time_over(meeting.other.passed() - rear, v, CLEARS, speed.min(meeting.pace).max(3.0));
        let comes = time_over(meeting.other.enter() - front, v, COMES, speed.max(v));
        clears + MARGIN * 0.5 <= self.time(meeting.own.enter()) || self.gone(meeting, v) <= comes
    }

    /// Whether somebody so far before its line leaves one time.
    fn passes_before(&self, meeting: &Meeting, distance: f64, other: &Seen, limit: f64) -> bool {
        let v = other.speed();
        let comes = |station: f64| time_over(distance + station, v, COMES, limit.max(v));
        if other.stands() && (self.waited > PATIENT || distance > 15.0) {
            return true; // it lets one go, or cannot go
        }
        let clear = self.gone(meeting, v) <= comes(meeting.other.enter());
        match meeting.critical {
            Some(critical) => clear && self.time(0.0) + critical - START <= comes(0.0),
            // It gives way, if it still can; but before one who stands it may go, and who rolls so near to its line means to.
            None if self.v < STARTS && !other.stands() && distance < NEAR_LINE => clear,
            None => clear || v * v <= 2.0 * EASILY * distance.max(0.0),
        }
    }
}

impl Driving {
    /// By lights, stop signs, who goes first, people and the room behind junctions: the speed, and why one waits.
    pub(super) fn at_lines(
        &mut self,
        scene: &dyn Scene,
        network: &RoadNetwork,
        own: &Own<'_>,
        around: &[Seen],
        dt: f64,
    ) -> (f64, Option<Wait>) {
        let (station, mut least, mut why) = (self.station, f64::INFINITY, None);
        let front = station + own.half_length;
        let horizon = 8.0 + 1.5 * own.speed + own.speed * own.speed * 0.25;
        self.lines.retain(|line| line.rest(network) > station - own.half_length);
        for index in 0..self.lines.len() {
            let room = self.lines[index].station - front;
            if room > horizon {
                break;
            }
            let next = self.lines.get(index + 1).map(|next| (next.station, next.light(scene, network)));
            let path = &self.path;
            let line = &mut self.lines[index];
            let turn = &network.connections[line.turn.index()];
            let junction = line.junction.get_or_insert_with(|| Junction::new(network, turn, own));
            line.is_passed |= room < -OVER;
            if line.is_passed {
                let strips = junction.strips.iter();
                let held = strips.map(|strip| strip.hold(network, own, around, path, line.station, front));
                least = held.fold(least, f64::min);
                continue;
            }
            let light = line.light(scene, network);
            let can_stop = own.speed * own.speed <= 2.0 * HARDEST * (room + OVER).max(0.0);
            line.yellow = if light == Light::Ends { line.yellow + dt } else { 0.0 };
            let ends = light == Light::Ends
                && line.waited > WHOLE_GREEN
                && (line.yellow < FRESH || own.speed > STANDING)
                && turn.turn == network.driving_side.turn_across();
            let barred = match light {
                Light::Free => false,
                Light::Ends => !ends && own.speed * own.speed <= 2.0 * FIRM * room.max(0.0),
                Light::Stop => true,
            };
            let wait = if barred {
                Some(Wait::Light)
            } else {
                let view = Crossing { scene, network, turn, own, around, path };
                view.must_wait(line, room, next).then_some(Wait::Others)
            };
            if let Some(wait) = wait.filter(|_| can_stop) {
                let left = (room - TO_LINE).max(0.0);
                let held = stopping(left, BRAKING).min(left / LAG);
                if held < least {
                    (least, why) = (held, Some(wait));
                }
                if room < AT_LINE && own.speed < STANDING {
                    line.waited += dt;
                }
            }
        }
        (least, why)
    }
}

/// What a light says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Light {
    /// It lets one go, or there is none.
    Free,
    /// Yellow.
    Ends,
    /// Red.
    Stop,
}

impl Line {
    fn light(&self, scene: &dyn Scene, network: &RoadNetwork) -> Light {
        let signal = network.connections[self.turn.index()].signal;
        match signal.and_then(|group| scene.signals().get(group.index())) {
            Some(Aspect::Red) => Light::Stop,
            Some(Aspect::Yellow) => Light::Ends,
            _ => Light::Free,
        }
    }

    /// Whether one has come out of the junction behind it.
    pub(super) fn is_behind(&self, network: &RoadNetwork, station: f64) -> bool {
        self.is_passed && self.rest(network) < station
    }

    /// Where the way behind it ends, m along the path.
    fn rest(&self, network: &RoadNetwork) -> f64 {
        self.station + network.connections[self.turn.index()].length
    }
}

/// A junction ahead with all that is around.
struct Crossing<'a> {
    scene: &'a dyn Scene,
    network: &'a RoadNetwork,
    turn: &'a Connection,
    own: &'a Own<'a>,
    around: &'a [Seen],
    path: &'a [Point2],
}

impl Crossing<'_> {
    fn must_wait(&self, line: &Line, room: f64, next: Option<(f64, Light)>) -> bool {
        let Some(junction) = &line.junction else { return false };
        let sign = self.turn.signal.is_none() && self.network.stops_at(self.turn.from) && line.waited < STOPS;
        let asker = Asker {
            distance: room,
            v: self.own.speed.max(0.0),
            speed: junction.speed,
            length: self.own.half_length * 2.0,
            waited: line.waited,
        };
        sign || people::cross(self.network, self.turn, self.around, line.waited)
            || self.is_blocked(line, junction, next)
            || junction.meetings.iter().any(|meeting| !self.has_gap(&asker, meeting))
    }

    /// Whether one's rear would stay in the junction.
    fn is_blocked(&self, line: &Line, junction: &Junction, next: Option<(f64, Light)>) -> bool {
        if junction.meetings.is_empty() && junction.strips.is_empty() {
            return false;
        }
        let begin = line.station + junction.length;
        let needed = self.own.half_length * 2.0 + GAP;
        if next.is_some_and(|next| self.is_full(line, begin, needed, next)) {
            return true;
        }
        let beyond = polyline::slice(self.path, begin, begin + needed + 10.0);
        let ahead = self.around.iter().filter(|other| other.kind.is_vehicle() && other.speed() < 2.0);
        ahead.filter_map(|other| Some((other.along(&beyond, 1.5)?, other))).any(|(station, other)| {
            // At the very begin it may stand in the junction as well.
            let rear = if station > 0.0 { station - other.half_length } else { 0.0 };
            rear + 2.0 * other.speed() < needed
        })
    }

    /// Whether the room between a junction and the next line is too short for one and for all who go ahead, since they must stand there.
    fn is_full(&self, line: &Line, begin: f64, needed: f64, (station, light): (f64, Light)) -> bool {
        let ahead = polyline::slice(self.path, line.station, station);
        let queue =
            self.around.iter().filter(|other| other.kind.is_vehicle() && other.along(&ahead, 1.5).is_some());
        let taken: f64 = queue.map(|other| 2.0 * other.half_length + GAP).sum();
        match light {
            Light::Free => false,
            Light::Ends => taken > 0.0 && station - begin < taken + needed,
            Light::Stop => station - begin < taken + needed,
        }
    }

    /// Whether those on a way that meets one's own, and before it, leave time to cross.
    fn has_gap(&self, asker: &Asker, meeting: &Meeting) -> bool {
        let way = &self.network.connections[meeting.way.index()];
        let from = lane(self.network, way.from);
        let light = way.signal.and_then(|group| self.scene.signals().get(group.index()));
        let red = light.is_some_and(|light| *light != Aspect::Green);
        let middle = polyline::at(&way.path, way.length * 0.5).0;
        let approach = polyline::slice(&from.path, from.length - SIGHT, from.length);
        let length = polyline::length(&approach);
        let vehicles = self.around.iter().filter(|other| {
            other.kind.is_vehicle() && (other.at - middle).norm() < SIGHT + way.length + other.half_length
        });
        for other in vehicles {
            if let Some(station) = other.along(&way.path, 1.5).filter(|station| *station > 0.0) {
                if !asker.passes_on_way(
                    meeting,
                    station + other.half_length,
                    other,
                    from.speed_limit.min(9.0),
                ) {
                    return false;
                }
            } else if let Some(station) = other.along(&approach, 1.7) {
                let distance = length - station - other.half_length;
                let v = other.speed();
                // At a light that is not green one relies on those who can still stop.
                let stops = red && v * v <= 2.0 * FIRM * distance.max(0.0);
                if !stops && !asker.passes_before(meeting, distance.max(0.0), other, from.speed_limit) {
                    return false;
                }
            }
        }
        true
    }
}
