//! Driving: a vehicle's body along the lanes of the road network to the kerb near a goal.
//!
//! The way is found in two levels, legs of roads and then the path along their lanes. In every step the path says where to
//! steer, and the bends, limits, lights, people and vehicles ahead say how fast; pedals and wheel follow by
//! [`simworld_core::control::Driver`]. What stands in the way is waited for, passed where there is room, and in the end
//! driven round by other roads. On ground without lanes the way is the straight line.
//!
//! Who drives is the vehicle itself or the person in it; pedals that a person presses go to the vehicle (see
//! [`World::actuate`](simworld_core::scene::World::actuate)).

mod kerb;
mod pass;
mod route;
mod watch;

use serde::{Deserialize, Serialize};
use simworld_core::action::Action;
use simworld_core::control::Driver;
use simworld_core::geometry::{Point2, Vector2, direction, yaw_of};
use simworld_core::id::{ConnectionId, EntityId, LaneId};
use simworld_core::net::{RoadNetwork, polyline};
use simworld_core::scene::{EntityKind, EntityRef, Role, Scene};
use simworld_core::seam::Goal;

use self::route::{Way, way};
use self::watch::Own;
use super::navigate::{Arrival, Destination, FOLLOWED};
use super::{RuleExecutor, Stage};
use crate::lanes::{OnLane, lane_at, nearest_lane};

/// A goal with a wider reach than this is only passed, and not stopped at, m.
const PASSED: f64 = 5.0;
/// So near to the end of the path, and slower than `STANDING`, one has arrived, m and m/s.
const ARRIVED: f64 = 1.2;
const STANDING: f64 = 0.2;
/// Length over which one pulls in to the kerb, m.
const PULL_IN: f64 = 16.0;
/// Lanes farther away than this are no part of the way, m: one drives over open ground.
const OFF_ROAD: f64 = 60.0;
/// Farther beside the path than this one looks for another, m.
const ASTRAY: f64 = 8.0;
/// Coming on by less than this is no progress, m.
const PROGRESS: f64 = 0.5;
/// Time that one gives a vehicle that stands in the way, s: it may wait itself.
const QUEUE: f64 = 25.0;

/// A stop line on the path.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Line {
    /// m along the path.
    station: f64,
    /// The way across the junction behind it.
    turn: ConnectionId,
    /// How long one has stood at it, s.
    waited: f64,
}

/// A way being driven.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Driving {
    /// Where the goal was when the way was found.
    goal: Point2,
    path: Vec<Point2>,
    lines: Vec<Line>,
    limits: Vec<(f64, f64)>,
    driver: Driver,
    /// How far one is along the path, m.
    station: f64,
    /// The farthest so far, m, and how long ago that was, s.
    best: f64,
    idle: f64,
    /// How often one was stuck, and how far one still backs, m.
    tries: u32,
    backing: f64,
    /// Roads that turned out to be blocked, by the first lane of their leg.
    closed: Vec<LaneId>,
}

/// The vehicle that somebody drives: itself, or what it sits in.
pub(super) fn vehicle_of<'a>(scene: &'a dyn Scene, me: &EntityRef<'a>) -> Option<EntityRef<'a>> {
    let drives = |entity: &EntityRef<'_>| {
        matches!(entity.kind, EntityKind::Car | EntityKind::Truck | EntityKind::Bus | EntityKind::Motorcycle)
    };
    match me.attachment {
        Some(bond) if bond.role == Role::Aboard => scene.entity(bond.parent).filter(drives),
        _ => scene.entity(me.id).filter(drives),
    }
}

impl RuleExecutor {
    pub(super) fn drive(
        &mut self,
        scene: &dyn Scene,
        me: &EntityRef<'_>,
        vehicle: &EntityRef<'_>,
        (to, within): (Goal, f64),
        speed: Option<f64>,
        out: &mut Vec<Action>,
    ) -> Arrival {
        let ids = [me.id, vehicle.id];
        let size = vehicle.info.shape.size();
        let ahead = direction(yaw_of(vehicle.pose));
        let own = Own {
            ids: &ids,
            at: vehicle.planar(),
            speed: vehicle.twist.linear.xy().dot(&ahead),
            half_length: size.x * 0.5,
            half_width: size.y * 0.5,
        };
        let Some(destination) = Destination::of(scene, to, own.at) else {
            return Arrival::Lost(format!("{to:?} is gone"));
        };
        if within > PASSED && destination.distance <= within {
            return Arrival::There;
        }
        let begun = match std::mem::take(&mut self.state.stage) {
            Stage::Driving(way) if (destination.point - way.goal).norm() <= FOLLOWED => Ok(way),
            _ => Driving::new(scene, vehicle, &own, destination.point, Vec::new()),
        };
        let mut way = match begun {
            Ok(way) => way,
            Err(reason) => return Arrival::Lost(reason),
        };
        let arrival = self.follow_lane(scene, vehicle, &own, &mut way, speed, out);
        self.state.stage = Stage::Driving(way);
        arrival
    }

    fn follow_lane(
        &mut self,
        scene: &dyn Scene,
        vehicle: &EntityRef<'_>,
        own: &Own<'_>,
        way: &mut Driving,
        speed: Option<f64>,
        out: &mut Vec<Action>,
    ) -> Arrival {
        let dt = scene.clock().dt();
        if way.backing > 0.0 {
            return way.back(scene, own, dt, out);
        }
        if way.locate(own.at) > ASTRAY {
            let closed = std::mem::take(&mut way.closed);
            match Driving::new(scene, vehicle, own, way.goal, closed) {
                Ok(found) => *way = Driving { tries: way.tries + 1, ..found },
                Err(reason) => return Arrival::Lost(reason),
            }
        }
        let left = polyline::length(&way.path) - way.station;
        if left <= ARRIVED && own.speed.abs() < STANDING {
            return Arrival::There;
        }
        let allowed = way.allowed(scene, own, speed, dt);
        if way.station > way.best + PROGRESS {
            (way.best, way.idle) = (way.station, 0.0);
        } else if !allowed.waits {
            way.idle += dt;
        }
        let patience = match allowed.obstacle {
            Some(obstacle) if scene.entity(obstacle.id).is_some_and(|other| other.kind.is_mobile()) => QUEUE,
            _ => self.config.patience,
        };
        if way.idle > patience {
            way.idle = 0.0;
            way.tries += 1;
            if way.tries > self.config.attempts {
                return Arrival::Lost(stuck(scene, own, allowed.obstacle.map(|obstacle| obstacle.id)));
            }
            if let Some(obstacle) = allowed.obstacle {
                way.get_past(scene, vehicle, own, &obstacle);
            }
        }
        let window = way.window();
        out.extend(way.driver.drive(vehicle.pose, own.speed, &window, allowed.speed, dt));
        self.state.told_speed = None;
        Arrival::Underway
    }
}

impl Driving {
    /// The way from where a vehicle stands to the kerb near a goal.
    fn new(
        scene: &dyn Scene,
        vehicle: &EntityRef<'_>,
        own: &Own<'_>,
        goal: Point2,
        closed: Vec<LaneId>,
    ) -> Result<Self, String> {
        let heading = yaw_of(vehicle.pose);
        let on_roads = scene.roads().and_then(|network| {
            let from =
                lane_at(network, own.at, Some(heading)).or_else(|| nearest_lane(network, own.at, None));
            let to = nearest_lane(network, goal, None);
            let near = from.zip(to).filter(|(from, to)| from.distance.min(to.distance) <= OFF_ROAD);
            near.map(|(from, to)| (network, from, to))
        });
        let way = match on_roads {
            Some((network, from, to)) => {
                Self::by_road(scene, network, own, &from, &to, &closed).ok_or_else(|| {
                    format!(
                        "no lanes lead from ({:.0}, {:.0}) to ({:.0}, {:.0})",
                        own.at.x, own.at.y, goal.x, goal.y
                    )
                })?
            }
            None => Way { path: vec![own.at, goal], ..Way::default() },
        };
        // Axles stand 0.58 of the length apart: a sedan's 2.6 of 4.5 m, a bus's 7 of 12 m.
        let mut driver = Driver::default();
        driver.wheelbase = own.half_length * 2.0 * 0.58;
        Ok(Self {
            goal,
            path: way.path,
            lines: way.lines,
            limits: way.limits,
            driver,
            station: 0.0,
            best: 0.0,
            idle: 0.0,
            tries: 0,
            backing: 0.0,
            closed,
        })
    }

    fn by_road(
        scene: &dyn Scene,
        network: &RoadNetwork,
        own: &Own<'_>,
        from: &OnLane,
        to: &OnLane,
        closed: &[LaneId],
    ) -> Option<Way> {
        let size = (own.half_length * 2.0, own.half_width * 2.0);
        let berth = kerb::berth(scene, network, own.ids, to, size);
        // From beside the lane one joins it some way ahead.
        let join = if from.distance > 0.5 { 6.0 + 2.0 * from.distance } else { 0.0 };
        let length = crate::lanes::lane(network, from.lane).length;
        let entry = OnLane { station: (from.station + join).min(length), ..*from };
        let found = way(network, &entry, &berth.on, closed, own.at);
        let mut found = found.or_else(|| way(network, &entry, &berth.on, &[], own.at))?;
        pull_in(&mut found.path, berth.aside);
        Some(found)
    }

    /// Finds oneself on the path; how far beside it one is, m.
    fn locate(&mut self, at: Point2) -> f64 {
        let from = (self.station - 3.0).max(0.0);
        let window = polyline::slice(&self.path, from, self.station + 25.0);
        let Some(near) = polyline::closest(&window, &at) else { return 0.0 };
        self.station = self.station.max(from + near.station);
        near.distance
    }

    /// The path around, and a little beyond its end, so that one does not turn towards the last point at the last moment.
    fn window(&self) -> Vec<Point2> {
        let mut window = polyline::slice(&self.path, self.station - 5.0, self.station + 40.0);
        window.dedup_by(|a, b| (*a - *b).norm() < 1e-6);
        if let [.., before, last] = window[..]
            && let Some(way) = (last - before).try_normalize(1e-9)
        {
            window.push(last + way * 10.0);
        }
        window
    }

    /// Goes back a little, straight, if nobody is behind.
    fn back(&mut self, scene: &dyn Scene, own: &Own<'_>, dt: f64, out: &mut Vec<Action>) -> Arrival {
        const BACKWARDS: f64 = 0.3;
        self.backing -= (-own.speed * dt).max(0.01);
        if self.backing <= 0.0 || pass::somebody_behind(scene, own, &self.path, self.station) {
            self.backing = 0.0;
            self.station = (self.station - 6.0).max(0.0);
            self.locate(own.at);
            self.best = self.station;
            out.push(Action::Brake { level: 1.0 });
        } else {
            let level = if own.speed < -1.5 { 0.0 } else { -BACKWARDS };
            out.extend([Action::Throttle { level }, Action::Steer { angle: 0.0 }]);
        }
        Arrival::Underway
    }
}

/// Where and behind what nothing goes on.
fn stuck(scene: &dyn Scene, own: &Own<'_>, by: Option<EntityId>) -> String {
    let place = format!("stuck at ({:.1}, {:.1})", own.at.x, own.at.y);
    match by.and_then(|id| scene.entity(id)) {
        Some(other) => format!("{place} behind {} {}", other.label(), other.id),
        None => place,
    }
}

/// Bends the end of a path to the right, by so much, m.
fn pull_in(path: &mut Vec<Point2>, aside: f64) {
    const POINTS: u32 = 16;
    if aside <= 0.0 {
        return;
    }
    let length = polyline::length(path);
    let begin = (length - PULL_IN).max(0.0);
    let mut bent = polyline::slice(path, 0.0, begin);
    for step in 1..=POINTS {
        let share = f64::from(step) / f64::from(POINTS);
        let (point, heading) = polyline::at(path, begin + (length - begin) * share);
        let ahead = direction(heading);
        // One is at the kerb after two thirds of the way, and straightens up on the last.
        let eased = smooth((share * 1.5).min(1.0));
        bent.push(point + Vector2::new(ahead.y, -ahead.x) * (aside * eased));
    }
    *path = bent;
}

/// From 0 to 1 without corners.
fn smooth(share: f64) -> f64 {
    share * share * (3.0 - 2.0 * share)
}
