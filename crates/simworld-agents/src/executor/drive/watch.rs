//! How fast the road ahead allows to go: bends, lights, who has the right of way, people and things on the path.

use std::ops::ControlFlow;

use simworld_core::geometry::{Aabb, Point2, Vector2};
use simworld_core::id::EntityId;
use simworld_core::net::{Aspect, Connection, RoadNetwork, polyline};
use simworld_core::ops::{atan2, wrap_angle};
use simworld_core::scene::{EntityKind, EntityRef, Scene};

use super::{Driving, Line};
use crate::lanes::lane;

/// Braking that passengers find comfortable, m/s² (ISO 15622 allows adaptive cruise control up to 3.5).
pub(super) const BRAKING: f64 = 2.0;
/// Harder braking, for a light that has just changed, m/s².
const FIRM: f64 = 3.5;
/// Acceleration across in bends that passengers find comfortable, m/s².
const LATERAL: f64 = 2.0;
/// Room kept before whatever one stops for, m.
const GAP: f64 = 2.0;
/// Room kept before a thing that stands in the way for good, m: enough to pull out past it.
const TO_PASS: f64 = 6.0;
/// Room kept before a stop line, m.
const TO_LINE: f64 = 0.8;
/// Room to each side of the vehicle that has to be free, m.
const BESIDE: f64 = 0.4;
/// How far ahead one looks at least, and at most, m.
const SIGHT: (f64, f64) = (15.0, 90.0);
/// How long ahead one foresees where people and crossing vehicles will be, s.
const FORESIGHT: f64 = 2.0;
/// From so far on one decides whether to give way, m.
const APPROACH: f64 = 20.0;
/// Vehicles this near to a junction on their way to it have the right of way, m.
const COMING: f64 = 30.0;
/// After so long without a gap one goes when nobody is in the junction, s.
const PATIENT: f64 = 20.0;
/// So near to the end of the path one stops, m.
const STOPPED: f64 = 0.7;
/// Slower than this counts as standing, m/s.
const STANDING: f64 = 0.3;

/// What the driver sees of its own vehicle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Own<'a> {
    /// The vehicle and who is in it.
    pub(super) ids: &'a [EntityId],
    pub(super) at: Point2,
    pub(super) speed: f64,
    pub(super) half_length: f64,
    pub(super) half_width: f64,
}

/// What the road ahead allows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Allowed {
    /// m/s.
    pub(super) speed: f64,
    /// What stands in the way, if that is what holds one up, and where it begins and ends along the path and reaches to the
    /// left, m.
    pub(super) obstacle: Option<Obstacle>,
    /// Whether one waits for a light or for others who go first: then nobody is stuck.
    pub(super) waits: bool,
}

/// Something on the path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Obstacle {
    pub(super) id: EntityId,
    pub(super) begin: f64,
    pub(super) end: f64,
    /// Its left edge beside the path, positive to the left, m.
    pub(super) left: f64,
    pub(super) stands: bool,
}

/// The speed from which one stops within a distance, m/s.
fn stopping(room: f64, braking: f64) -> f64 {
    (2.0 * braking * room.max(0.0)).sqrt()
}

impl Driving {
    /// The speed that the path and everything on it allow.
    pub(super) fn allowed(
        &mut self,
        scene: &dyn Scene,
        own: &Own<'_>,
        wish: Option<f64>,
        dt: f64,
    ) -> Allowed {
        let limit =
            self.limits.iter().find(|(end, _)| self.station < *end).map_or(self.open_limit(), |(_, v)| *v);
        let mut allowed = Allowed { speed: wish.unwrap_or(limit).min(limit), obstacle: None, waits: false };
        let end = polyline::length(&self.path);
        let left = end - self.station;
        // One creeps up to the end, and stands there.
        let last = if left < STOPPED { 0.0 } else { stopping(left - STOPPED, BRAKING).max(0.4) };
        allowed.speed = allowed.speed.min(last).min(self.bends(own.speed));
        if let Some(network) = scene.roads() {
            let held = self.at_lines(scene, network, own, dt);
            if held < allowed.speed {
                allowed.speed = held;
                allowed.waits = held < STANDING * 4.0;
            }
        }
        if let Some((speed, obstacle)) =
            self.behind_others(scene, own).filter(|(speed, _)| *speed < allowed.speed)
        {
            (allowed.speed, allowed.obstacle) = (speed, Some(obstacle));
        }
        allowed
    }

    fn open_limit(&self) -> f64 {
        /// Where no road says how fast, m/s.
        const OPEN_GROUND: f64 = 5.0;
        self.limits.last().map_or(OPEN_GROUND, |(_, limit)| *limit)
    }

    /// By the bends ahead.
    fn bends(&self, speed: f64) -> f64 {
        const STEP: f64 = 3.0;
        let sight = (speed * speed / (2.0 * BRAKING) + 10.0).min(SIGHT.1);
        let mut least = f64::INFINITY;
        let window = polyline::slice(&self.path, self.station, self.station + sight + 2.0 * STEP);
        let mut along = 0.0;
        while along < sight {
            let [a, b, c] =
                [along, along + STEP, along + 2.0 * STEP].map(|station| polyline::at(&window, station).0);
            let turn = wrap_angle(bearing(c - b) - bearing(b - a)).abs();
            if (c - b).norm() > 0.5 && (b - a).norm() > 0.5 {
                let curvature = turn / STEP;
                let there = if curvature > 1e-3 { (LATERAL / curvature).sqrt() } else { f64::INFINITY };
                least = least.min((there * there + 2.0 * BRAKING * along).sqrt());
            }
            along += STEP;
        }
        least.max(2.0)
    }

    /// By lights, stop signs, the right of way, and people on crossings, at the lines ahead.
    fn at_lines(&mut self, scene: &dyn Scene, network: &RoadNetwork, own: &Own<'_>, dt: f64) -> f64 {
        let mut least = f64::INFINITY;
        let station = self.station;
        for line in &mut self.lines {
            let room = line.station - station - own.half_length - TO_LINE;
            // The line is passed once the nose is over it.
            if room < -TO_LINE - 0.5 || room > SIGHT.1 {
                continue;
            }
            let turn = &network.connections[line.turn.index()];
            let red = match turn.signal.and_then(|group| scene.signals().get(group.index())) {
                Some(Aspect::Red) => true,
                Some(Aspect::Yellow) => own.speed * own.speed / (2.0 * FIRM) <= room,
                _ => false,
            };
            let sign = turn.signal.is_none() && network.stops_at(turn.from) && line.waited < 1.0;
            let near = room < APPROACH.max(own.speed * 2.0);
            let yields = near && gives_way(scene, network, turn, own, line);
            let people = near && people_cross(scene, network, turn);
            if red || sign || yields || people {
                least = least.min(stopping(room, BRAKING));
                if room < 1.5 && own.speed < STANDING {
                    line.waited += dt;
                }
            }
        }
        least
    }

    /// By who and what is on the path: the speed, and the first of them that forces one to slow down.
    fn behind_others(&self, scene: &dyn Scene, own: &Own<'_>) -> Option<(f64, Obstacle)> {
        let sight = (own.speed * own.speed / (2.0 * BRAKING) + SIGHT.0).min(SIGHT.1);
        let path = polyline::slice(&self.path, self.station, self.station + sight + own.half_length);
        let mut slowest: Option<(f64, Obstacle)> = None;
        let _ = scene.visit(&Aabb::column_around(own.at, sight + own.half_length), &mut |other| {
            // Streets lead past houses; the box around one that is no box reaches where its walls do not.
            let is_house = other.kind == EntityKind::Building;
            let is_other =
                !own.ids.contains(&other.id) && other.attachment.is_none() && other.is_solid() && !is_house;
            if is_other
                && let Some((speed, obstacle)) = self.slows(&path, own, &other)
                && slowest.as_ref().is_none_or(|(least, _)| speed < *least)
            {
                slowest = Some((speed, obstacle));
            }
            ControlFlow::Continue(())
        });
        slowest
    }

    /// The speed that leaves room behind a thing on the path, now or by the time that one foresees.
    fn slows(&self, path: &[Point2], own: &Own<'_>, other: &EntityRef<'_>) -> Option<(f64, Obstacle)> {
        let velocity = other.twist.linear.xy();
        let moves = velocity.norm() > STANDING;
        let ahead_of_time = if other.kind.is_mobile() && moves { FORESIGHT } else { 0.0 };
        let is_person = matches!(other.kind, EntityKind::Person | EntityKind::Dog | EntityKind::Robot);
        let room = own.half_width + if is_person { BESIDE * 2.0 } else { BESIDE };
        let reach = footprint_on(path, other, Vector2::zeros(), room);
        let later = if ahead_of_time > 0.0 {
            footprint_on(path, other, velocity * ahead_of_time, room)
        } else {
            None
        };
        // Vehicles that will cross the path are left to the right of way at lines; people are not.
        let (begin, end, left) = reach.or(later.filter(|_| is_person))?;
        if begin < own.half_length * 0.5 && end < own.half_length {
            return None; // beside or behind
        }
        // Before what will not move off one keeps room to pull out.
        let room_before = if other.kind.is_mobile() { GAP } else { TO_PASS };
        let gap = begin - own.half_length - room_before;
        let heading = polyline::at(path, begin).1;
        let along = velocity.dot(&simworld_core::geometry::direction(heading)).max(0.0);
        let speed = (along * along + 2.0 * BRAKING * gap.max(0.0)).sqrt();
        let speed = if gap <= 0.0 { along.min(1.0).min(if gap < -1.0 { 0.0 } else { along }) } else { speed };
        let (begin, end) = (begin + self.station, end + self.station);
        Some((speed, Obstacle { id: other.id, begin, end, left, stands: !moves }))
    }
}

fn bearing(way: Vector2) -> f64 {
    atan2(way.y, way.x)
}

/// From where to where a thing reaches along the path, and its left edge, if it comes within `room` of it.
fn footprint_on(
    path: &[Point2],
    other: &EntityRef<'_>,
    moved: Vector2,
    room: f64,
) -> Option<(f64, f64, f64)> {
    let corners = other.obb().footprint();
    let middle = other.planar() + moved;
    let mut points = corners.map(|corner| corner + moved).to_vec();
    points.push(middle);
    let (mut begin, mut end, mut right, mut left) =
        (f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY);
    let last = polyline::length(path);
    for point in &points {
        let near = polyline::closest(path, point)?;
        // Beyond the ends of the path its distance says nothing of a side.
        let beyond = near.station <= 0.0 || near.station >= last;
        let lateral =
            if beyond && near.distance > room { near.lateral.signum() * near.distance } else { near.lateral };
        begin = begin.min(near.station);
        end = end.max(near.station);
        right = right.min(lateral);
        left = left.max(lateral);
    }
    let on_path = right <= room && left >= -room && end > 0.0 && begin < last;
    on_path.then_some((begin, end, left))
}

/// Whether somebody who goes first is in the junction or about to enter it.
fn gives_way(
    scene: &dyn Scene,
    network: &RoadNetwork,
    turn: &Connection,
    own: &Own<'_>,
    line: &Line,
) -> bool {
    let others = if turn.signal.is_some() || line.waited < PATIENT {
        &turn.yields_to
    } else {
        return blocked(scene, network, turn, own);
    };
    let coming = others.iter().any(|id| {
        let other = &network.connections[id.index()];
        let stopped_by_red =
            other.signal.is_some_and(|group| scene.signals().get(group.index()) == Some(&Aspect::Red));
        let from = &lane(network, other.from).path;
        let length = lane(network, other.from).length;
        let approach = polyline::slice(from, length - COMING, length);
        !stopped_by_red && somebody_on(scene, own, &approach, STANDING)
            || somebody_on(scene, own, &other.path, -1.0)
    });
    coming || blocked(scene, network, turn, own)
}

/// Whether somebody is in the junction on a path that crosses one's own.
fn blocked(scene: &dyn Scene, network: &RoadNetwork, turn: &Connection, own: &Own<'_>) -> bool {
    let crosses = |id: &simworld_core::id::ConnectionId| {
        let other = &network.connections[id.index()];
        other.from != turn.from && somebody_on(scene, own, &other.path, STANDING)
    };
    turn.conflicts.iter().any(crosses)
}

/// Whether a vehicle faster than that is on a path and goes its way.
fn somebody_on(scene: &dyn Scene, own: &Own<'_>, path: &[Point2], faster: f64) -> bool {
    let Some(middle) = path.get(path.len() / 2) else { return false };
    let reach = path.iter().map(|point| (point - middle).norm()).fold(0.0, f64::max) + 2.0;
    let mut found = false;
    let _ = scene.visit(&Aabb::column_around(*middle, reach), &mut |other| {
        let is_other = other.kind.is_vehicle() && other.attachment.is_none() && !own.ids.contains(&other.id);
        if is_other && other.twist.ground_speed() > faster {
            found = polyline::closest(path, &other.planar()).is_some_and(|near| {
                let way = simworld_core::geometry::direction(polyline::at(path, near.station).1);
                near.distance < 1.5
                    && way
                        .dot(&simworld_core::geometry::direction(simworld_core::geometry::yaw_of(other.pose)))
                        > 0.5
            });
        }
        if found { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    found
}

/// Whether somebody is on a crossing that the path passes over, or steps on to it.
fn people_cross(scene: &dyn Scene, network: &RoadNetwork, turn: &Connection) -> bool {
    turn.crossings.iter().any(|id| {
        let crossing = &network.crossings[id.index()];
        let strip = [crossing.start, crossing.end];
        let (middle, length) =
            (crossing.start + (crossing.end - crossing.start) * 0.5, polyline::length(&strip));
        let mut found = false;
        let _ = scene.visit(&Aabb::column_around(middle, length * 0.5 + 1.0), &mut |other| {
            let walks = matches!(other.kind, EntityKind::Person | EntityKind::Dog | EntityKind::Robot);
            if walks && other.attachment.is_none() {
                let soon = other.planar() + other.twist.linear.xy();
                found = [other.planar(), soon].iter().any(|at| {
                    polyline::closest(&strip, at).is_some_and(|near| {
                        near.station > 0.3
                            && near.station < length - 0.3
                            && near.distance < crossing.width * 0.5 + 0.3
                    })
                });
            }
            if found { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        found
    })
}
