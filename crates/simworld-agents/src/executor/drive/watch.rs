//! How fast the road ahead allows to go: bends, lines, changes of lanes, people and things on the path.

use simworld_core::control::Driver;
use simworld_core::geometry::{Obb, Point2, Vector2, direction, yaw_of};
use simworld_core::id::EntityId;
use simworld_core::net::polyline;
use simworld_core::ops::{atan2, wrap_angle};
use simworld_core::scene::{EntityKind, EntityRef, Scene};

use super::around::{STANDING, Seen};
use super::change::Outlook;
use super::junction::Wait;
use super::plan::Wish;
use super::route::Lanes;
use super::turn_round::TURNED;
use super::{CannotArrive, Driving, MISSED, NEVER, NO_GAP};

/// Braking that passengers find comfortable, m/s² (ISO 15622 allows adaptive cruise control up to 3.5).
pub(super) const BRAKING: f64 = 2.0;
/// Acceleration across in bends that passengers find comfortable, m/s².
pub(super) const LATERAL: f64 = 2.0;
/// Room kept before whatever one stops for, m.
pub(super) const GAP: f64 = 2.0;
/// Time kept behind who drives ahead, s.
const HEADWAY: f64 = 1.0;
/// Room kept before a thing that stands in the way for good, m: enough to pull out past it.
const TO_PASS: f64 = 6.0;
/// Room to each side of the vehicle that has to be free, m.
const BESIDE: f64 = 0.4;
/// How far ahead one looks at least, and at most, m.
pub(super) const SIGHT: (f64, f64) = (15.0, 90.0);
/// How long ahead one foresees where people will be, s.
const FORESIGHT: [f64; 3] = [0.0, 1.0, 2.0];
/// Whose front is turned so far from one's way comes towards one, as the cosine of the angle between.
const AGAINST: f64 = -0.5;
/// So near to the end of the path one stops, m.
const STOPPED: f64 = 0.7;

/// What the driver sees of its own vehicle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Own<'a> {
    /// The vehicle and who is in it.
    pub(super) ids: &'a [EntityId],
    pub(super) at: Point2,
    pub(super) ahead: Vector2,
    pub(super) speed: f64,
    /// How fast it turns, to the left, radians/s.
    pub(super) turns: f64,
    pub(super) half_length: f64,
    pub(super) half_width: f64,
    pub(super) solid: Obb,
}

impl<'a> Own<'a> {
    pub(super) fn new(vehicle: &EntityRef<'_>, ids: &'a [EntityId]) -> Self {
        let size = vehicle.info.shape.size();
        let ahead = direction(yaw_of(vehicle.pose));
        Self {
            ids,
            at: vehicle.planar(),
            ahead,
            speed: vehicle.twist.linear.xy().dot(&ahead),
            turns: vehicle.twist.angular.z,
            half_length: size.x * 0.5,
            half_width: size.y * 0.5,
            solid: vehicle.obb(),
        }
    }

    /// At what angle its front wheels stand, by how it turns, radians to the left; `None` while it hardly moves.
    pub(super) fn wheels(&self) -> Option<f64> {
        /// m/s.
        const ROLLS: f64 = 0.2;
        (self.speed > ROLLS).then(|| atan2(self.turns * self.wheelbase(), self.speed))
    }

    /// Between its axles, m.
    pub(super) fn wheelbase(&self) -> f64 {
        Driver::of_length(self.half_length * 2.0).wheelbase
    }

    /// Length and width, m.
    pub(super) fn size(&self) -> (f64, f64) {
        (self.half_length * 2.0, self.half_width * 2.0)
    }
}

/// What the road ahead allows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Allowed {
    /// m/s.
    pub(super) speed: f64,
    /// What stands in the way, if that is what holds one up.
    pub(super) obstacle: Option<Obstacle>,
    /// Whether one waits for a light or for others who go first: then nobody is stuck.
    pub(super) waits: bool,
}

/// Something on the path: where it begins and ends along it, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Obstacle {
    pub(super) id: EntityId,
    pub(super) begin: f64,
    pub(super) end: f64,
    /// Its right and its left edge beside the path, positive to the left, m.
    pub(super) right: f64,
    pub(super) left: f64,
    pub(super) stands: bool,
    pub(super) is_mobile: bool,
    /// Whether it is a vehicle that looks against the way that one goes.
    pub(super) comes: bool,
}

/// The speed from which one stops within a distance, m/s.
pub(super) fn stopping(room: f64, braking: f64) -> f64 {
    (2.0 * braking * room.max(0.0)).sqrt()
}

impl Driving {
    /// The speed that the path and everything on it allow.
    pub(super) fn allowed(
        &mut self,
        scene: &dyn Scene,
        vehicle: &EntityRef<'_>,
        own: &Own<'_>,
        around: &[Seen],
        wish: Option<f64>,
        dt: f64,
    ) -> Result<Allowed, CannotArrive> {
        let mut allowed = Allowed { speed: f64::INFINITY, obstacle: None, waits: false };
        if let Some(network) = scene.roads() {
            match self.look_beside(network, own, around, dt) {
                Outlook::Free => {}
                Outlook::Later(hold) => self.put_off(scene, vehicle, own, hold)?,
                Outlook::Waits(speed) => (allowed.speed, allowed.waits) = (speed, speed < 4.0 * STANDING),
            }
            if self.waited_beside() > MISSED {
                self.miss(scene, vehicle, own);
            }
            let (held, why) = self.at_lines(scene, network, own, around, dt);
            if held < allowed.speed {
                allowed.speed = held;
                allowed.waits = why.is_some() && held < 4.0 * STANDING;
            }
            self.mind_the_clock(scene, vehicle, own, why)?;
        }
        let limit =
            self.limits.iter().find(|(end, _)| self.station < *end).map_or(self.open_limit(), |(_, v)| *v);
        let limit = limit.min(top_speed(vehicle.kind));
        let left = polyline::length(&self.path) - self.station;
        // One creeps up to the end, and stands there.
        let last = if left < STOPPED { 0.0 } else { stopping(left - STOPPED, BRAKING).max(0.4) };
        let free = wish.unwrap_or(limit).min(limit).min(last).min(self.bends(own)).min(self.askew(own));
        if free < allowed.speed {
            (allowed.speed, allowed.waits) = (free, false);
        }
        if let Some((speed, obstacle)) =
            self.behind_others(own, around).filter(|(speed, _)| *speed < allowed.speed)
        {
            (allowed.speed, allowed.obstacle) = (speed, Some(obstacle));
            allowed.waits = obstacle.is_mobile && self.waits_at_light(scene, &obstacle);
        }
        Ok(allowed)
    }

    /// The same way with its next change of lanes later.
    fn put_off(
        &mut self,
        scene: &dyn Scene,
        vehicle: &EntityRef<'_>,
        own: &Own<'_>,
        hold: f64,
    ) -> Result<(), CannotArrive> {
        let Some(change) = self.changes.first().copied() else { return Ok(()) };
        let wish = Wish { closed: self.closed.clone(), on: Some((change.from, hold)), ..Wish::to(self.goal) };
        self.renew(scene, vehicle, own, wish)
    }

    /// Takes the way that one's own lane leads, if that is one.
    fn miss(&mut self, scene: &dyn Scene, vehicle: &EntityRef<'_>, own: &Own<'_>) {
        let Some(change) = self.changes.first().copied().filter(|change| change.from != change.to) else {
            return;
        };
        let wish = Wish {
            closed: self.closed.clone(),
            on: Some((change.from, 0.0)),
            lanes: Lanes::Own,
            why: Some("there is no gap to change lanes"),
            ..Wish::to(self.goal)
        };
        // Where there is none one waits on.
        let _ = self.renew(scene, vehicle, own, wish);
    }

    /// Takes other roads when there is no gap for too long.
    fn mind_the_clock(
        &mut self,
        scene: &dyn Scene,
        vehicle: &EntityRef<'_>,
        own: &Own<'_>,
        why: Option<Wait>,
    ) -> Result<(), CannotArrive> {
        let Some(line) = self.lines.iter().find(|line| !line.is_passed) else { return Ok(()) };
        let waited = line.waited;
        if why != Some(Wait::Others) || waited < NO_GAP {
            return Ok(());
        }
        if waited > NEVER {
            return Err(CannotArrive::NoGap { at: own.at, waited });
        }
        // Once in a while; what lies behind this line is left out.
        if (waited / NO_GAP).fract() * NO_GAP < scene.clock().dt()
            && let Some(network) = scene.roads()
        {
            let to = network.connections[line.turn.index()].to;
            let mut closed = self.closed.clone();
            closed.extend(crate::lanes::beside(network, to).first());
            let why = Some("there is no gap at the junction");
            let wish = Wish { closed, why, ..Wish::to(self.goal) };
            self.renew(scene, vehicle, own, wish)?;
        }
        Ok(())
    }

    fn open_limit(&self) -> f64 {
        /// Where no road says how fast, m/s.
        const OPEN_GROUND: f64 = 5.0;
        self.limits.last().map_or(OPEN_GROUND, |(_, limit)| *limit)
    }

    /// By the bends ahead, and by the one that the rear is still in.
    fn bends(&self, own: &Own<'_>) -> f64 {
        const STEP: f64 = 3.0;
        let sight = (own.speed * own.speed / (2.0 * BRAKING) + 10.0).min(SIGHT.1);
        let mut least = f64::INFINITY;
        let first = (self.station - own.half_length).max(0.0);
        let behind = self.station - first;
        let window = polyline::slice(&self.path, first, self.station + sight + 2.0 * STEP);
        let mut along = 0.0;
        while along < behind + sight {
            let [a, b, c] =
                [along, along + STEP, along + 2.0 * STEP].map(|station| polyline::at(&window, station).0);
            let turn = wrap_angle(bearing(c - b) - bearing(b - a)).abs();
            if (c - b).norm() > 0.5 && (b - a).norm() > 0.5 {
                let curvature = turn / STEP;
                let there = if curvature > 1e-3 { (LATERAL / curvature).sqrt() } else { f64::INFINITY };
                least = least.min((there * there + 2.0 * BRAKING * (along - behind).max(0.0)).sqrt());
            }
            along += STEP;
        }
        least.max(2.0)
    }

    /// Slowly while one does not look along the path yet: one needs more room than it has.
    fn askew(&self, own: &Own<'_>) -> f64 {
        /// m/s.
        const SLOWLY: f64 = 2.0;
        let along = direction(polyline::at(&self.path, self.station).1);
        if own.ahead.dot(&along) < TURNED { SLOWLY } else { f64::INFINITY }
    }

    /// By who and what is on the path: the speed, and the first of them that forces one to slow down.
    fn behind_others(&self, own: &Own<'_>, around: &[Seen]) -> Option<(f64, Obstacle)> {
        let sight = (own.speed * own.speed / (2.0 * BRAKING) + SIGHT.0).min(SIGHT.1);
        let path = polyline::slice(&self.path, self.station, self.station + sight + own.half_length);
        // One's nose comes to stand beyond the end of the path, where a berth is free of things but not of who has just come.
        let mut longer = path.clone();
        if let [.., before, last] = path[..]
            && let Some(way) = (last - before).try_normalize(1e-9)
        {
            longer.push(last + way * (own.half_length + BESIDE));
        }
        let near = around
            .iter()
            .filter(|other| (other.at - own.at).norm() < sight + own.half_length + other.half_length);
        let slowed = near
            .filter_map(|other| self.slows(if other.kind.is_mobile() { &longer } else { &path }, own, other));
        slowed.min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// The speed that leaves room and time behind a thing on the path, now or by the time that one foresees.
    fn slows(&self, path: &[Point2], own: &Own<'_>, other: &Seen) -> Option<(f64, Obstacle)> {
        let walks = other.walks();
        // Who stands at the kerb is passed closer than who may step out.
        let room = own.half_width + if walks && !other.stands() { BESIDE * 2.0 } else { BESIDE };
        // Vehicles that will cross the path are left to the gaps at lines; people are not.
        let times = if walks && !other.stands() { &FORESIGHT[..] } else { &FORESIGHT[..1] };
        let (begin, end, (right, left)) =
            times.iter().find_map(|time| footprint_on(path, other, other.velocity * *time, room))?;
        if begin < own.half_length * 0.5 && end < own.half_length {
            return None; // beside or behind
        }
        let heading = polyline::at(path, begin).1;
        let along = other.velocity.dot(&direction(heading)).max(0.0);
        // Before what will not move off one keeps room to pull out.
        let gap = begin - own.half_length - if other.kind.is_mobile() { GAP } else { TO_PASS };
        // What stops in time after the headway, braking as the one ahead does (Gipps 1981).
        let lag = BRAKING * if along > STANDING { HEADWAY } else { 0.0 };
        let speed = (lag * lag + along * along + 2.0 * BRAKING * gap.max(0.0)).sqrt() - lag;
        let speed = if gap < -1.0 { 0.0 } else { speed };
        let (begin, end) = (begin + self.station, end + self.station);
        let (stands, is_mobile) = (other.stands(), other.kind.is_mobile());
        let comes = other.kind.is_vehicle() && other.ahead.dot(&direction(heading)) < AGAINST;
        Some((speed, Obstacle { id: other.id, begin, end, right, left, stands, is_mobile, comes }))
    }
}

/// As fast as somebody goes who may: a cyclist rides at 20 km/h (the mean of studies in towns is 17 to 22).
fn top_speed(kind: EntityKind) -> f64 {
    if kind == EntityKind::Bicycle { 5.6 } else { f64::INFINITY }
}

fn bearing(way: Vector2) -> f64 {
    atan2(way.y, way.x)
}

/// From where to where a thing reaches along the path, and its right and left edge, if it comes within `room` of it.
pub(super) fn footprint_on(
    path: &[Point2],
    other: &Seen,
    moved: Vector2,
    room: f64,
) -> Option<(f64, f64, (f64, f64))> {
    let (mut begin, mut end, mut right, mut left) =
        (f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY);
    let last = polyline::length(path);
    for point in other.corners.iter().chain([&other.at]).map(|point| point + moved) {
        let near = polyline::closest(path, &point)?;
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
    on_path.then_some((begin, end, (right, left)))
}
