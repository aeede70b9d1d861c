//! What clients start and the server carries on, step after step: ways that are followed, and motions that end in time.
//!
//! It speaks to bodies by commands, as the client could itself: they are recorded, and a replay needs no errands.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use simworld_core::action::Action;
use simworld_core::clock::Tick;
use simworld_core::command::Command;
use simworld_core::control::Driver;
use simworld_core::geometry::{Point2, Pose, Vector2, direction, heading, yaw_of};
use simworld_core::id::EntityId;
use simworld_core::net::DrivingSide;
use simworld_core::ops::{tan, wrap_angle};
use simworld_core::scene::{EntityRef, Scene};

use crate::remote::engine::Served;

/// A point of a way is reached within this distance, m.
const REACHED: f64 = 0.4;
/// Who drives reaches it within this distance, m.
const DRIVEN: f64 = 2.0;
/// Turns smaller than this are not taken, rad.
const STRAIGHT: f64 = 0.03;
/// One who has to turn by more than this stands meanwhile, rad.
const ABOUT: f64 = 0.8;
/// Half circles are driven at this speed, m/s, and by this much wider than the wheels could.
const TURNING: f64 = 3.0;
const WIDER: f64 = 1.3;

/// Errands of everybody.
#[derive(Default)]
pub(super) struct Errands {
    /// Ways that were set and are not followed.
    ways: BTreeMap<EntityId, Vec<Point2>>,
    followed: BTreeMap<EntityId, Following>,
    /// Until when somebody moves.
    until: BTreeMap<EntityId, Tick>,
}

/// Somebody on a way.
struct Following {
    /// Where it began, and the points after that.
    way: Vec<Point2>,
    next: usize,
    speed: f64,
    manner: Manner,
}

/// How somebody follows a way.
enum Manner {
    /// On foot; the speed that was told last, m/s.
    Walking(f64),
    /// By pedals and wheel.
    Driving(Driver),
}

impl Errands {
    /// Keeps a way for somebody.
    pub(super) fn set_way(&mut self, who: EntityId, way: Vec<Point2>) {
        self.ways.insert(who, way);
    }

    /// Bytes that all ways take.
    pub(super) fn bytes(&self) -> usize {
        let followed = self.followed.values().map(|following| &following.way);
        self.ways.values().chain(followed).map(|way| way_bytes(way)).sum()
    }

    /// Sends somebody on the way that was kept; false if there is none.
    pub(super) fn follow(&mut self, body: &EntityRef<'_>, speed: f64) -> bool {
        self.until.remove(&body.id);
        let Some(way) = self.ways.get(&body.id) else { return false };
        self.followed.insert(body.id, Following::new(body, way, speed));
        true
    }

    /// Lets a vehicle turn round in a half circle across the oncoming lanes, and stop behind it.
    pub(super) fn turn_round(&mut self, body: &EntityRef<'_>, side: DrivingSide) {
        self.until.remove(&body.id);
        self.followed.insert(body.id, Following::new(body, &half_circle(body, side), TURNING));
    }

    /// Lets somebody stop at a tick.
    pub(super) fn stop_at(&mut self, who: EntityId, tick: Tick) {
        self.followed.remove(&who);
        self.until.insert(who, tick);
    }

    /// Somebody was told something else.
    pub(super) fn cancel(&mut self, who: EntityId) {
        self.followed.remove(&who);
        self.until.remove(&who);
    }

    /// Tells everybody what the coming step needs.
    pub(super) fn run(&mut self, served: &mut Served<'_>) {
        if self.followed.is_empty() && self.until.is_empty() {
            return;
        }
        let scene = served.stage.scene();
        let tick = scene.clock().tick();
        let mut told = Vec::new();
        self.until.retain(|who, end| {
            let is_over = *end <= tick;
            if is_over {
                told.push((*who, Action::Stop));
            }
            !is_over
        });
        self.followed.retain(|who, following| following.advance(scene, *who, &mut told));
        self.ways.retain(|who, _| scene.entity(*who).is_some());
        for (who, action) in told {
            // Who cannot do it, or is gone, does not; the errand ends with the entity.
            let _ = served.apply(Command::Actuate { who, action });
        }
    }
}

impl Following {
    fn new(body: &EntityRef<'_>, way: &[Point2], speed: f64) -> Self {
        let manner = if body.kind.is_vehicle() {
            Manner::Driving(Driver::of_length(body.info.shape.size().x))
        } else {
            Manner::Walking(-1.0)
        };
        let way = std::iter::once(body.planar()).chain(way.iter().copied()).collect();
        Self { way, next: 1, speed, manner }
    }

    /// Says what is to be done for the next point; false at the end of the way.
    fn advance(&mut self, scene: &dyn Scene, who: EntityId, told: &mut Vec<(EntityId, Action)>) -> bool {
        let Some(body) = scene.entity(who) else { return false };
        let (at, dt) = (body.planar(), scene.clock().dt());
        let near = if matches!(self.manner, Manner::Driving(_)) { DRIVEN } else { REACHED };
        // Whoever is fast reaches a point between two steps.
        let reach = near.max(body.twist.ground_speed() * dt);
        while self.way.get(self.next).is_some_and(|point| (point - at).norm() < reach) {
            self.next += 1;
        }
        let Some(point) = self.way.get(self.next) else {
            told.push((who, Action::Stop));
            return false;
        };
        match &mut self.manner {
            Manner::Walking(last) => walk(body.pose, *point - at, self.speed, last, who, told),
            Manner::Driving(driver) => {
                // Of a way that crosses itself the part around counts; points are passed before one is there.
                let ahead = &self.way[self.next.saturating_sub(2)..(self.next + 3).min(self.way.len())];
                let actions = driver.drive(body.pose, body.twist.ground_speed(), ahead, self.speed, dt);
                told.extend(actions.map(|action| (who, action)));
            }
        }
        true
    }
}

/// What is to be done to walk towards a point.
fn walk(
    pose: &Pose,
    offset: Vector2,
    speed: f64,
    last: &mut f64,
    who: EntityId,
    told: &mut Vec<(EntityId, Action)>,
) {
    let turn = wrap_angle(heading(&offset) - yaw_of(pose));
    if turn.abs() > STRAIGHT {
        told.push((who, Action::Rotate { angle: turn }));
    }
    let speed = if turn.abs() > ABOUT { 0.0 } else { speed };
    if speed != *last {
        *last = speed;
        told.push((who, Action::MoveForward { speed }));
    }
}

/// Bytes that a way takes.
pub(super) fn way_bytes(way: &[Point2]) -> usize {
    size_of_val(way)
}

/// The points of a half circle as narrow as the vehicle can drive, and a straight way behind it.
fn half_circle(body: &EntityRef<'_>, side: DrivingSide) -> Vec<Point2> {
    const POINTS: u32 = 12;
    let length = body.info.shape.size().x;
    let driver = Driver::of_length(length);
    let radius = WIDER * driver.wheelbase / tan(driver.lock);
    let across = match side {
        DrivingSide::Right => 1.0,
        DrivingSide::Left => -1.0,
    };
    let yaw = yaw_of(body.pose);
    let middle = body.planar() + direction(yaw + across * PI / 2.0) * radius;
    let mut way: Vec<Point2> = (1..=POINTS)
        .map(|index| {
            let turned = PI * f64::from(index) / f64::from(POINTS);
            middle + direction(yaw + across * (turned - PI / 2.0)) * radius
        })
        .collect();
    let end = way[way.len() - 1];
    way.push(end - direction(yaw) * (length + DRIVEN));
    way
}
