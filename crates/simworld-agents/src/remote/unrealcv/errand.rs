//! What clients start and the server carries on, step after step: ways that are followed, and motions that end in time.
//!
//! It speaks to bodies by commands, as the client could itself: they are recorded, and a replay needs no errands.

use std::collections::BTreeMap;

use simworld_core::action::Action;
use simworld_core::clock::Tick;
use simworld_core::command::Command;
use simworld_core::geometry::{Point2, heading, yaw_of};
use simworld_core::id::EntityId;
use simworld_core::ops::wrap_angle;
use simworld_core::scene::Scene;

use crate::remote::engine::Served;

/// A point of a way is reached within this distance, m.
const REACHED: f64 = 0.4;
/// Turns smaller than this are not taken, rad.
const STRAIGHT: f64 = 0.03;
/// One who has to turn by more than this stands meanwhile, rad.
const ABOUT: f64 = 0.8;

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
    way: Vec<Point2>,
    next: usize,
    speed: f64,
    /// The speed it was told last.
    told: f64,
}

impl Errands {
    /// Keeps a way for somebody.
    pub(super) fn set_way(&mut self, who: EntityId, way: Vec<Point2>) {
        self.ways.insert(who, way);
    }

    /// Sends somebody on the way that was kept; false if there is none.
    pub(super) fn follow(&mut self, who: EntityId, speed: f64) -> bool {
        self.until.remove(&who);
        let way = self.ways.get(&who).cloned();
        if let Some(way) = way {
            self.followed.insert(who, Following { way, next: 0, speed, told: -1.0 });
            return true;
        }
        false
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
    /// Says what is to be done for the next point; false at the end of the way.
    fn advance(&mut self, scene: &dyn Scene, who: EntityId, told: &mut Vec<(EntityId, Action)>) -> bool {
        let Some(body) = scene.entity(who) else { return false };
        let at = body.planar();
        // Whoever is fast reaches a point between two steps.
        let reach = REACHED.max(body.twist.ground_speed() * scene.clock().dt());
        while self.way.get(self.next).is_some_and(|point| (point - at).norm() < reach) {
            self.next += 1;
        }
        let Some(point) = self.way.get(self.next) else {
            told.push((who, Action::Stop));
            return false;
        };
        let turn = wrap_angle(heading(&(point - at)) - yaw_of(body.pose));
        if turn.abs() > STRAIGHT {
            told.push((who, Action::Rotate { angle: turn }));
        }
        let speed = if turn.abs() > ABOUT { 0.0 } else { self.speed };
        if speed != self.told {
            self.told = speed;
            told.push((who, Action::MoveForward { speed }));
        }
        true
    }
}
