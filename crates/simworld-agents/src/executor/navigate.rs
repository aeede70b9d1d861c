//! Navigation: from waypoint to waypoint to the goal.

use serde::{Deserialize, Serialize};
use simworld_core::action::Action;
use simworld_core::geometry::{Point2, heading, yaw_of};
use simworld_core::hash::StateHasher;
use simworld_core::id::{CrossingId, WaypointId};
use simworld_core::net::WaypointGraph;
use simworld_core::ops::wrap_angle;
use simworld_core::scene::{EntityRef, Scene};
use simworld_core::seam::Goal;

use super::{RuleExecutor, Stage, avoid, crossing};

/// A waypoint counts as passed within this distance, m.
const PASSED: f64 = 0.7;
/// Heading errors below this are left alone, radians.
const STRAIGHT: f64 = 0.03;
/// With a larger heading error one turns on the spot, radians.
const FACING: f64 = 1.0;
/// Coming nearer by less than this is no progress, m.
const PROGRESS: f64 = 0.25;
/// How long an evasion lasts, s.
const EVASION: f64 = 1.2;
/// How far an evasion turns away from the goal, radians.
const EVASION_ANGLE: f64 = 1.1;

/// A place to pass.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Leg {
    point: Point2,
    /// The crossing on the way to it, if there is one.
    crossing: Option<CrossingId>,
}

/// A way being gone.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Navigation {
    legs: Vec<Leg>,
    next: usize,
    /// Whether the crossing on the leg under way was begun.
    crossing_begun: bool,
    /// The least distance to the next place so far, m, and how long ago that was, s.
    least: f64,
    idle: f64,
    /// How often it was stuck, and what is left of the evasion, s.
    stuck: u32,
    evading: f64,
}

/// How a navigation stands.
pub(super) enum Arrival {
    Underway,
    There,
    Lost(String),
}

impl Navigation {
    fn along(legs: Vec<Leg>) -> Self {
        Self { legs, next: 0, crossing_begun: false, least: f64::INFINITY, idle: 0.0, stuck: 0, evading: 0.0 }
    }

    pub(super) fn state_hash<'a>(&self, hasher: &'a mut StateHasher) -> &'a mut StateHasher {
        hasher.u64(self.legs.len() as u64).u64(self.next as u64).u64(u64::from(self.crossing_begun));
        hasher.f64(self.least).f64(self.idle).u64(u64::from(self.stuck)).f64(self.evading)
    }

    /// Moves on to the next place.
    fn pass(&mut self) {
        self.next += 1;
        self.crossing_begun = false;
        self.least = f64::INFINITY;
        self.idle = 0.0;
    }
}

impl RuleExecutor {
    pub(super) fn navigate(
        &mut self,
        scene: &dyn Scene,
        me: &EntityRef<'_>,
        to: &Goal,
        within: f64,
        speed: f64,
        out: &mut Vec<Action>,
    ) -> Arrival {
        let Some(goal) = place_of(scene, to) else { return Arrival::Lost(format!("{to:?} is gone")) };
        let here = me.planar();
        if (goal - here).norm() <= within {
            return Arrival::There;
        }
        let mut way = match std::mem::take(&mut self.state.stage) {
            Stage::Navigating(way) => way,
            _ => Navigation::along(self.find_way(here, goal)),
        };
        if let Some(last) = way.legs.last_mut() {
            last.point = goal; // the goal may move
        }
        let arrival = self.follow(scene, me, &mut way, speed, out);
        self.state.stage = Stage::Navigating(way);
        arrival
    }

    fn follow(
        &mut self,
        scene: &dyn Scene,
        me: &EntityRef<'_>,
        way: &mut Navigation,
        speed: f64,
        out: &mut Vec<Action>,
    ) -> Arrival {
        let (here, dt) = (me.planar(), scene.clock().dt());
        while way.next + 1 < way.legs.len() && (way.legs[way.next].point - here).norm() < PASSED {
            way.pass();
        }
        let leg = way.legs[way.next];
        if let Some(id) = leg.crossing.filter(|_| !way.crossing_begun) {
            if !crossing::may_begin(scene, me, id, leg.point, speed) {
                face(me, leg.point, 0.0, out);
                self.tell_speed(0.0, out);
                return Arrival::Underway;
            }
            way.crossing_begun = true;
        }
        let distance = (leg.point - here).norm();
        if distance < way.least - PROGRESS {
            way.least = distance;
            way.idle = 0.0;
        } else {
            way.idle += dt;
        }
        if way.idle > self.config.patience
            && let Some(arrival) = self.unstick(way, here)
        {
            return arrival;
        }
        way.evading = (way.evading - dt).max(0.0);
        let aside = if way.evading > 0.0 {
            // Alternate sides from one evasion to the next.
            if way.stuck.is_multiple_of(2) { EVASION_ANGLE } else { -EVASION_ANGLE }
        } else {
            avoid::detour(scene, me, leg.point, self.config.look_ahead)
        };
        let error = face(me, leg.point, aside, out);
        // Turning on the spot beats a wide circle round the waypoint.
        let pace = if error.abs() > FACING { 0.0 } else { speed };
        self.tell_speed(slow_for_arrival(pace, distance, way.next + 1 == way.legs.len()), out);
        Arrival::Underway
    }

    /// Tries something else after standing for too long: first a step aside, then another way.
    fn unstick(&mut self, way: &mut Navigation, here: Point2) -> Option<Arrival> {
        way.stuck += 1;
        way.idle = 0.0;
        way.least = f64::INFINITY;
        if way.stuck > self.config.attempts {
            return Some(Arrival::Lost(format!("stuck at ({:.1}, {:.1})", here.x, here.y)));
        }
        if way.stuck.is_multiple_of(3)
            && !way.crossing_begun
            && let Some(goal) = way.legs.last().map(|leg| leg.point)
        {
            let legs = self.find_way(here, goal);
            *way = Navigation { stuck: way.stuck, ..Navigation::along(legs) };
        }
        way.evading = EVASION;
        None
    }

    /// The places to pass from here to the goal, the goal last.
    fn find_way(&mut self, here: Point2, goal: Point2) -> Vec<Leg> {
        let mut legs = Vec::new();
        if let Some(ways) = &self.ways
            && let (Some(from), Some(to)) = (ways.nearest(here), ways.nearest(goal))
            && ways.route(from, to, &mut self.scratch, &mut self.route)
        {
            let route = trimmed(ways, &self.route.waypoints, here, goal);
            let mut before: Option<WaypointId> = None;
            for waypoint in route {
                let crossing = before.and_then(|b| ways.edge(b, *waypoint)).and_then(|edge| edge.crossing);
                legs.push(Leg { point: ways.waypoint(*waypoint).position, crossing });
                before = Some(*waypoint);
            }
        }
        legs.push(Leg { point: goal, crossing: None });
        legs
    }
}

/// Turns towards a point, `aside` radians to its left; returns the heading error.
fn face(me: &EntityRef<'_>, point: Point2, aside: f64, out: &mut Vec<Action>) -> f64 {
    let error = wrap_angle(heading(&(point - me.planar())) + aside - yaw_of(me.pose));
    if error.abs() > STRAIGHT {
        out.push(Action::Rotate { angle: error });
    }
    error
}

/// The route less a first and a last waypoint that would mean going back; crossings are never cut short.
fn trimmed<'a>(
    ways: &WaypointGraph,
    route: &'a [WaypointId],
    here: Point2,
    goal: Point2,
) -> &'a [WaypointId] {
    let position = |id: WaypointId| ways.waypoint(id).position;
    let is_walkway = |a, b| ways.edge(a, b).is_some_and(|edge| edge.crossing.is_none());
    let mut route = route;
    if let [first, second, ..] = route
        && is_walkway(*first, *second)
        && (position(*second) - here).norm() <= (position(*second) - position(*first)).norm()
    {
        route = &route[1..];
    }
    if let [.., before, last] = route
        && is_walkway(*before, *last)
        && (position(*before) - goal).norm() <= (position(*before) - position(*last)).norm()
    {
        route = &route[..route.len() - 1];
    }
    route
}

fn place_of(scene: &dyn Scene, goal: &Goal) -> Option<Point2> {
    match goal {
        Goal::Point(point) => Some(point.xy()),
        Goal::Entity(id) => scene.entity(*id).map(|entity| entity.access().xy()),
        _ => None,
    }
}

/// Riders brake before the goal; walkers stop at once.
fn slow_for_arrival(speed: f64, distance: f64, is_last: bool) -> f64 {
    /// Comfortable braking, m/s².
    const BRAKING: f64 = 1.5;
    if !is_last {
        return speed;
    }
    let arriving = (2.0 * BRAKING * distance).sqrt();
    // In quarters of a metre a second, so that the body is not told anew every step.
    speed.min(((arriving * 4.0).ceil() * 0.25).max(0.5))
}
