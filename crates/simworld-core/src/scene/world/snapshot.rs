//! A world as data, and back.

use std::collections::BTreeSet;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::{Quadtree, World, WorldError};
use crate::action::Action;
use crate::asset::Catalogue;
use crate::clock::Clock;
use crate::environment::Environment;
use crate::event::Event;
use crate::ground::Ground;
use crate::id::EntityId;
use crate::intent::Intent;
use crate::net::{Aspect, RoadNetwork};
use crate::passage::is_leg;
use crate::scene::{EntityDesc, Stride};
use crate::traffic::{RoadLeg, TrafficOrder};

/// A [`World`] as data: serialise it, and [restore](World::restore) goes on bit for bit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WorldSnapshot {
    clock: Clock,
    environment: Environment,
    signals: Vec<Aspect>,
    closed: BTreeSet<RoadLeg>,
    roads: Option<Arc<RoadNetwork>>,
    ground: Option<Arc<Ground>>,
    assets: Arc<Catalogue>,
    generations: Vec<u32>,
    entities: Vec<Option<EntityDesc>>,
    free: Vec<u32>,
    tree_width: f64,
    revision: u64,
    actuations: Vec<(EntityId, Action)>,
    intents: Vec<(EntityId, Intent)>,
    orders: Vec<TrafficOrder>,
    events: Vec<Event>,
    strides: Vec<(EntityId, Stride)>,
}

impl World {
    /// The whole state as data.
    pub fn snapshot(&self) -> WorldSnapshot {
        WorldSnapshot {
            clock: self.clock,
            environment: self.environment,
            signals: self.signals.clone(),
            closed: self.closed.clone(),
            roads: self.roads.clone(),
            ground: self.ground.clone(),
            assets: Arc::clone(&self.assets),
            generations: self.heads.iter().map(|head| head.generation).collect(),
            entities: (0..self.heads.len()).map(|slot| self.in_slot(slot).map(|e| e.to_desc())).collect(),
            free: self.free.clone(),
            tree_width: self.tree.width(),
            revision: self.revision,
            actuations: self.actuations.clone(),
            intents: self.intents.clone(),
            orders: self.orders.clone(),
            events: self.events.clone(),
            strides: self.saved_strides(),
        }
    }

    /// The world of a snapshot; it goes on bit for bit as the one the snapshot was taken of.
    ///
    /// # Errors
    /// A snapshot that contradicts itself, or holds an impossible entity.
    pub fn restore(snapshot: WorldSnapshot) -> Result<Self, WorldError> {
        let damaged = |what| WorldError::Snapshot { what };
        if snapshot.generations.len() != snapshot.entities.len() {
            return Err(damaged("generations and entities differ in number"));
        }
        if !(snapshot.tree_width.is_finite() && snapshot.tree_width >= 8.0) {
            return Err(damaged("the width of its quadtree is no size"));
        }
        let vacant = snapshot.entities.iter().filter(|entity| entity.is_none()).count();
        let is_vacant = |slot: &u32| snapshot.entities.get(*slot as usize).is_some_and(Option::is_none);
        let mut distinct = snapshot.free.clone();
        distinct.sort_unstable();
        distinct.dedup();
        if distinct.len() != vacant || snapshot.free.len() != vacant || !distinct.iter().all(is_vacant) {
            return Err(damaged("the list of free slots does not fit the entities"));
        }
        if snapshot.environment.validate().is_err() {
            return Err(damaged("its sun or weather is out of range"));
        }
        let groups = snapshot.roads.as_ref().map_or(0, |roads| roads.signal_groups());
        if snapshot.signals.len() != groups {
            return Err(damaged("its signals do not fit its roads"));
        }
        if !snapshot.closed.iter().all(|leg| is_leg(snapshot.roads.as_deref(), *leg)) {
            return Err(damaged("a road is closed that is not there"));
        }
        let mut world = Self {
            clock: snapshot.clock,
            environment: snapshot.environment,
            roads: snapshot.roads,
            ground: snapshot.ground,
            assets: snapshot.assets,
            signals: snapshot.signals,
            closed: snapshot.closed,
            actuations: snapshot.actuations,
            intents: snapshot.intents,
            orders: snapshot.orders,
            events: snapshot.events,
            tree: Quadtree::with_width(snapshot.tree_width),
            ..Self::default()
        };
        for generation in snapshot.generations {
            let slot = world.new_slot();
            world.heads[slot as usize].generation = generation;
        }
        world.free = snapshot.free;
        let mut bonds = Vec::new();
        for (slot, desc) in snapshot.entities.into_iter().enumerate() {
            if let Some(mut desc) = desc {
                bonds.push((slot, desc.attachment.take()));
                world.check(EntityId::new(slot as u32, world.heads[slot].generation), &desc)?;
                world.fill(slot as u32, desc);
            }
        }
        for (slot, bond) in bonds {
            let child = EntityId::new(slot as u32, world.heads[slot].generation);
            let pose = world.poses[slot];
            if bond.is_some() {
                world.attach(child, bond)?;
                world.place(child, pose);
            }
        }
        world.resume_gestures();
        world.resume_strides(&snapshot.strides);
        world.turn_page();
        world.revision = snapshot.revision;
        Ok(world)
    }
}
