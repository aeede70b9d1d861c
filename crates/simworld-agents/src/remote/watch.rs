//! What a client sees of the world: entities of a region, once or step after step.

use std::ops::ControlFlow;

use serde::{Deserialize, Serialize};
use simworld_core::clock::Tick;
use simworld_core::event::Event;
use simworld_core::geometry::{Aabb, Pose, Twist};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityKind, Scene};

/// More events than that are not kept from one observation to the next.
const MOST_EVENTS: usize = 1000;

/// Which entities are asked for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Query {
    /// Those whose bounds touch this box, world frame, m; it may be unbounded.
    pub region: Aabb,
    /// Those of these kinds; of any, if it is empty.
    pub kinds: Vec<EntityKind>,
    /// At most so many.
    pub most: u32,
}

impl Query {
    /// Everything in a region, as much as the server gives at once.
    pub fn of(region: Aabb) -> Self {
        Self { region, kinds: Vec::new(), most: u32::MAX }
    }
}

/// What is told of an entity.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Seen {
    /// Its handle.
    pub id: EntityId,
    /// What it is.
    pub kind: EntityKind,
    /// World from body.
    pub pose: Pose,
    /// Velocity.
    pub twist: Twist,
}

/// What a query found.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Found {
    /// The entities, in the order in which the scene visits them.
    pub seen: Vec<Seen>,
    /// How many more there are.
    pub more: u64,
}

/// What a client who watches is sent.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Observation {
    /// After which step.
    pub tick: Tick,
    /// Simulated time, s.
    pub seconds: f64,
    /// What it watches.
    pub found: Found,
    /// What happened since the last observation.
    pub events: Vec<Event>,
    /// Events beyond the thousand that are kept.
    pub events_lost: u64,
    /// Observations left out before this one, because the client had not yet taken earlier ones.
    pub missed: u64,
}

/// Looks a query up.
pub(super) fn look(scene: &dyn Scene, query: &Query, most: usize) -> Found {
    let mut found = Found::default();
    let most = most.min(query.most as usize);
    let _ = scene.visit(&query.region, &mut |entity| {
        if query.kinds.is_empty() || query.kinds.contains(&entity.kind) {
            if found.seen.len() < most {
                let (pose, twist) = (*entity.pose, *entity.twist);
                found.seen.push(Seen { id: entity.id, kind: entity.kind, pose, twist });
            } else {
                found.more += 1;
            }
        }
        ControlFlow::Continue(())
    });
    found
}

/// Somebody who watches.
pub(super) struct Watcher {
    query: Query,
    every: u32,
    passed: u32,
    events: Vec<Event>,
    events_lost: u64,
    missed: u64,
}

impl Watcher {
    pub(super) fn new(query: Query, every: u32) -> Self {
        Self { query, every: every.max(1), passed: 0, events: Vec::new(), events_lost: 0, missed: 0 }
    }

    /// Takes note of a step, and gives an observation if one is due and can be taken.
    pub(super) fn after_step(
        &mut self,
        scene: &dyn Scene,
        events: &[Event],
        most: usize,
        can_take: impl FnOnce() -> bool,
    ) -> Option<Observation> {
        let room = MOST_EVENTS.saturating_sub(self.events.len()).min(events.len());
        self.events.extend_from_slice(&events[..room]);
        self.events_lost += (events.len() - room) as u64;
        self.passed += 1;
        if self.passed < self.every {
            return None;
        }
        self.passed = 0;
        if !can_take() {
            self.missed += 1;
            return None;
        }
        let clock = scene.clock();
        Some(Observation {
            tick: clock.tick(),
            seconds: clock.seconds(),
            found: look(scene, &self.query, most),
            events: std::mem::take(&mut self.events),
            events_lost: std::mem::take(&mut self.events_lost),
            missed: std::mem::take(&mut self.missed),
        })
    }
}
