//! Driving: a vehicle's body along the lanes of the road network to the kerb near a goal.
//!
//! The way is found in two levels, legs of roads and then the path along their lanes. In every step the path says where to
//! steer, and the bends, limits, lights, gaps, people and vehicles ahead say how fast; pedals and wheel follow by
//! [`simworld_core::control::Driver`]. Lanes are changed where there is a gap. What stands in the way is waited for, passed where
//! there is room, and in the end driven round by other roads, turning in the street if need be. On ground without lanes the
//! way is the straight line.
//!
//! Who drives is the vehicle itself or the person in it; pedals that a person presses go to the vehicle (see
//! [`World::actuate`](simworld_core::scene::World::actuate)).

mod around;
mod back;
mod bend;
mod change;
mod guard;
mod junction;
mod kerb;
mod pass;
mod people;
mod plan;
mod route;
mod trouble;
mod turn_round;
mod watch;

use serde::{Deserialize, Serialize};
use simworld_core::action::Action;
use simworld_core::control::Driver;
use simworld_core::geometry::Point2;
use simworld_core::id::LaneId;
use simworld_core::net::polyline;
use simworld_core::scene::{EntityKind, EntityRef, Role, Scene};
use simworld_core::seam::Goal;

use self::around::Seen;
use self::change::Change;
use self::junction::Line;
use self::kerb::Berth;
use self::plan::Wish;
pub use self::trouble::CannotArrive;
use self::turn_round::Turning;
use self::watch::{Allowed, Own};
use super::navigate::{Arrival, Destination, FOLLOWED};
use super::{RuleExecutor, Stage};

/// A goal with a wider reach than this is only passed, and not stopped at, m.
const PASSED: f64 = 5.0;
/// So near to the end of the path, and slower than `STANDING`, one has arrived, m and m/s.
const ARRIVED: f64 = 1.2;
const STANDING: f64 = 0.2;
/// Who is kept from the last piece of its way, no longer than this, by somebody who stands there, has arrived too, m, when it has stood for
/// so long, s.
const NEARLY: f64 = 3.0;
const LOOKS_ON: f64 = 1.0;
/// Farther beside the path than this one looks for another, m.
const ASTRAY: f64 = 8.0;
/// Coming on by less than this is no progress, m.
const PROGRESS: f64 = 0.5;
/// After so much progress earlier jams are forgotten, m.
const FORGOTTEN: f64 = 150.0;
/// Time that one gives a vehicle that stands in the way, and one in a queue, s.
const STANDS: f64 = 12.0;
const QUEUE: f64 = 60.0;
/// One who has looked for a gap beside for so long goes where the own lane leads, s.
const MISSED: f64 = 30.0;
/// One who has stood at a line for so long, and not at red, takes other roads, s; and gives up after this.
const NO_GAP: f64 = 150.0;
const NEVER: f64 = 900.0;

/// A way being driven.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Driving {
    /// Where the goal was when the way was found.
    goal: Point2,
    /// The place at the kerb where it ends.
    berth: Option<Berth>,
    path: Vec<Point2>,
    lines: Vec<Line>,
    limits: Vec<(f64, f64)>,
    changes: Vec<Change>,
    driver: Driver,
    /// How far one is along the path, m.
    station: f64,
    /// The farthest so far, m, and how long ago that was, s.
    best: f64,
    idle: f64,
    /// How often one was stuck, where that was, m, and how far one still backs, m.
    tries: u32,
    stuck_at: f64,
    backing: f64,
    turning: Option<Turning>,
    /// Whether the last look found no room.
    is_held: bool,
    /// Roads that turned out to be blocked, by the first lane of their leg.
    closed: Vec<LaneId>,
    /// Why it drives otherwise than before, until that is told.
    #[serde(skip)]
    news: Option<&'static str>,
}

/// The vehicle that somebody drives: itself, or what it sits in.
pub(super) fn vehicle_of<'a>(scene: &'a dyn Scene, me: &EntityRef<'a>) -> Option<EntityRef<'a>> {
    let drives = |entity: &EntityRef<'_>| {
        matches!(
            entity.kind,
            EntityKind::Car
                | EntityKind::Truck
                | EntityKind::Bus
                | EntityKind::Motorcycle
                | EntityKind::Bicycle
        )
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
        let own = Own::new(vehicle, &ids);
        let lost = |state: &mut super::State, error: CannotArrive| {
            let reason = error.to_string();
            state.trouble = Some(error);
            Arrival::Lost(reason)
        };
        let Some(destination) = Destination::of(scene, to, own.at) else {
            return lost(&mut self.state, CannotArrive::GoalGone { goal: to });
        };
        if within > PASSED && destination.distance <= within {
            return Arrival::There;
        }
        let begun = match std::mem::take(&mut self.state.stage) {
            Stage::Driving(way) if (destination.point - way.goal).norm() <= FOLLOWED => Ok(way),
            _ => Driving::new(scene, vehicle, &own, Wish::to(destination.point)).map(Box::new),
        };
        let arrival = begun.and_then(|mut way| {
            let there = self.follow_lane(scene, vehicle, &own, &mut way, speed, out)?;
            self.rerouted = way.news.take();
            self.state.stage = Stage::Driving(way);
            Ok(there)
        });
        arrival.unwrap_or_else(|error| lost(&mut self.state, error))
    }

    fn follow_lane(
        &mut self,
        scene: &dyn Scene,
        vehicle: &EntityRef<'_>,
        own: &Own<'_>,
        way: &mut Driving,
        speed: Option<f64>,
        out: &mut Vec<Action>,
    ) -> Result<Arrival, CannotArrive> {
        let dt = scene.clock().dt();
        self.state.told_speed = None;
        let around = around::look(scene, own, watch::SIGHT.1, junction::SIGHT + 40.0);
        if way.turning.is_some() {
            way.turn_round(scene, vehicle, own, &around, dt, out)?;
            return Ok(Arrival::Underway);
        }
        if way.backing > 0.0 {
            way.back(scene, own, &around, dt, out);
            return Ok(Arrival::Underway);
        }
        if way.locate(own.at) > ASTRAY {
            way.tries += 1;
            let why = Some("it has come off its way");
            way.renew(scene, vehicle, own, Wish { closed: way.closed.clone(), why, ..Wish::to(way.goal) })?;
        }
        way.mind_closures(scene, vehicle, own)?;
        way.mind_berth(scene, vehicle, own)?;
        let left = polyline::length(&way.path) - way.station;
        if left <= ARRIVED && own.speed.abs() < STANDING {
            return Ok(Arrival::There);
        }
        let allowed = way.allowed(scene, vehicle, own, &around, speed, dt)?;
        let is_barred = way.is_held || allowed.obstacle.is_some_and(|obstacle| obstacle.stands);
        if left <= NEARLY && own.speed.abs() < STANDING && is_barred && way.idle > LOOKS_ON {
            return Ok(Arrival::There);
        }
        self.mind_progress(scene, vehicle, own, way, (&allowed, &around))?;
        let window = way.window();
        let mut actions = way.driver.drive(vehicle.pose, own.speed, &window, allowed.speed, dt);
        way.last_look(own, &around, &mut actions);
        out.extend(actions);
        Ok(Arrival::Underway)
    }

    /// Does something about it when nothing goes on.
    fn mind_progress(
        &self,
        scene: &dyn Scene,
        vehicle: &EntityRef<'_>,
        own: &Own<'_>,
        way: &mut Driving,
        (allowed, around): (&Allowed, &[Seen]),
    ) -> Result<(), CannotArrive> {
        if way.station > way.best + PROGRESS {
            (way.best, way.idle) = (way.station, 0.0);
            if way.station > way.stuck_at + FORGOTTEN {
                way.tries = 0;
            }
        } else if !allowed.waits {
            way.idle += scene.clock().dt();
        }
        let obstacle = allowed.obstacle;
        let patience = match obstacle {
            Some(other) if way.dodged(own, &other).is_some() => pass::DODGES,
            Some(other) if other.is_mobile && way.is_queue(&other, around) => QUEUE,
            Some(other) if other.is_mobile => STANDS,
            _ => self.config.patience,
        };
        if way.idle <= patience {
            return Ok(());
        }
        way.idle = 0.0;
        way.tries += 1;
        way.stuck_at = way.station;
        if way.tries > self.config.attempts {
            return Err(CannotArrive::stuck(scene, own.at, obstacle.map(|obstacle| obstacle.id)));
        }
        if let Some(obstacle) = obstacle {
            way.get_past(scene, vehicle, own, around, &obstacle);
        } else if way.is_held {
            way.back_off(own, around);
        }
        Ok(())
    }
}

impl Driving {
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
}
