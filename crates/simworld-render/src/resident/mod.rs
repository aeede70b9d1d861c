//! What of a scene lies ready for the device: dressed once, and anew only where the scene says that something changed.
//!
//! An entity may be several instances (a body and its limbs); each has a number, under which it lies in the buffer on the device
//! and in the grid. Numbers depend on what came before; what reaches a picture is ordered by entity and part instead.

mod bounds;
mod dressed;
mod grid;
mod instance;
mod layers;
mod numbers;
mod wardrobe;

use std::collections::{BTreeMap, BTreeSet};
use std::ops::ControlFlow;
use std::sync::Arc;

pub(crate) use dressed::Part;
use dressed::{Body, Dressed, Tailor};
pub(crate) use grid::{Ball, Grid};
pub(crate) use instance::{Instance, MOST_SLOTS, split};
use simworld_core::asset::Season;
use simworld_core::clock::Tick;
use simworld_core::geometry::{Aabb, Point3, Vector3};
use simworld_core::id::EntityId;
use simworld_core::net::Aspect;
use simworld_core::scene::{EntityKind, Mark, Scene};

use crate::demand::Demand;
use crate::look::Looks;
use crate::mesh::{Drawn, ModelId};
use crate::occlusion::Block;
use crate::sieve::Grain;
use crate::sources::Sources;
use crate::threads;
use wardrobe::Wardrobe;

const NONE: u32 = u32::MAX;
/// Entities that are worth a thread.
const SHARE: usize = 128;

/// What is known of an instance beside what the shaders read.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Card {
    pub mesh: Drawn,
    /// Slot of the entity.
    pub slot: u32,
    /// Which of the entity's instances it is.
    pub part: u32,
    /// Whether it throws a shadow that one would miss.
    pub casts: bool,
    /// Whether its kind moves about.
    pub mobile: bool,
    /// At which levels of detail it is drawn, as [`crate::look::Detail::bit`]s: an entity has instances for each of them. None of what only
    /// keeps a number for a body that nobody sees.
    pub details: u8,
    /// Whether its number is one of those that only bodies have that are dressed as they are seen.
    pub nimble: bool,
    /// The next instance of the entity, or of the free ones.
    next: u32,
}

/// The instances of a scene.
#[derive(Default)]
pub(crate) struct Residents {
    pub instances: Vec<Instance>,
    pub cards: Vec<Card>,
    /// By number, the ball around its entity.
    pub grains: Vec<Grain>,
    pub grid: Grid,
    /// Of these, those that nobody looks through.
    pub walls: Grid,
    /// Who is in each slot.
    pub names: Arc<Vec<EntityId>>,
    /// Numbers whose instances changed since the device had them; some may come twice.
    pub changed: Vec<u32>,
    /// Numbers whose cards or balls changed since a device that culls had them; some may come twice, and instances alone may have changed.
    pub recarded: Vec<u32>,
    /// Grows with every instance that comes or goes.
    pub arrangement: u64,
    /// Grows whenever everything was dressed anew.
    pub epoch: u64,
    /// Grows with every change.
    pub version: u64,
    /// By number, the version at which the instance last changed.
    pub stamps: Vec<u64>,
    /// By slot, the first instance of who is there.
    heads: Vec<u32>,
    /// The first number that is free, of those of everybody and of those of who is dressed as it is seen.
    free: [u32; 2],
    /// Who is dressed as it is seen.
    wardrobe: Wardrobe,
    /// How far from the origin along an axis anybody ever was, m.
    pub widest: f64,
    mark: Option<Mark>,
    season: Option<Season>,
    signals: Vec<Aspect>,
    /// Slots of those that show signals.
    signalling: BTreeSet<u32>,
    /// Slots of those whose arms or models move with the clock, whatever else changes.
    restless: BTreeSet<u32>,
    tick: Tick,
    /// Those that are dressed anew, with who is there.
    slots: Vec<(u32, Option<EntityId>)>,
    looks: Looks,
    /// By slot, in which layer its surface lies; see [`layers`].
    layers: BTreeMap<u32, u8>,
    /// Whether a surface came, went or moved since its layers were found.
    resurfaced: bool,
    /// Whether every view draws the finest level, however small it is.
    pub finest: bool,
    /// Models that are drawn, in which poses, and by how many instances.
    pub models: BTreeMap<ModelId, u32>,
}

impl Residents {
    /// Follows the scene; `region` is what is looked at of scenes that keep no account of what changes, and `demand` says what a batch may show of
    /// bodies that move.
    pub(crate) fn follow(&mut self, scene: &dyn Scene, region: &Aabb, demand: &Demand) {
        self.wardrobe.begin();
        let repainted = self.looks.follow(scene);
        let season = scene.environment().season;
        if std::mem::replace(&mut self.season, season) != season {
            // Whatever grows looks otherwise.
            self.forget();
        }
        let mark = scene.mark();
        let mut slots = std::mem::take(&mut self.slots);
        slots.clear();
        let known = match self.mark {
            Some(since) => scene.visit_changes(since, &mut |slot, entity| {
                slots.push((slot as u32, entity.map(|entity| entity.id)));
            }),
            None => false,
        };
        if !known {
            self.restart();
            slots.clear();
            let everywhere = Aabb::around(Point3::origin(), Vector3::repeat(1e9));
            let region = if mark.is_some() { &everywhere } else { region };
            let _ = scene.visit(region, &mut |entity| {
                slots.push((entity.id.index() as u32, Some(entity.id)));
                ControlFlow::Continue(())
            });
        }
        self.mark = mark;
        self.look_at(scene, &slots, demand, false);
        slots.clear();
        let named = |slot: &u32| (*slot, Some(self.names[*slot as usize]));
        if known && repainted {
            // What is painted on a surface depends on roads elsewhere too.
            slots.extend(self.layers.keys().map(named));
        }
        if self.tick != scene.clock().tick() {
            self.tick = scene.clock().tick();
            slots.extend(self.restless.iter().map(named));
        }
        if self.signals != scene.signals() {
            self.signals = scene.signals().to_vec();
            slots.extend(self.signalling.iter().map(named));
        }
        self.look_at(scene, &slots, demand, false);
        slots.clear();
        self.wardrobe.lacking(demand, &mut |slot| slots.push((slot, Some(self.names[slot as usize]))));
        self.look_at(scene, &slots, demand, true);
        self.slots = slots;
        if std::mem::take(&mut self.resurfaced) {
            self.lay_out_surfaces();
        }
    }

    /// Finds the layers of all surfaces anew.
    fn lay_out_surfaces(&mut self) {
        let numbers: Vec<u32> = self.layers.keys().map(|slot| self.heads[*slot as usize]).collect();
        let surface = |number: &u32| {
            let mesh = self.cards[*number as usize].mesh;
            layers::Surface { mesh, solid: self.instances[*number as usize].solid() }
        };
        let layers = layers::layers_of(&numbers.iter().map(surface).collect::<Vec<_>>());
        for ((known, layer), number) in self.layers.values_mut().zip(layers).zip(numbers) {
            if std::mem::replace(known, layer) != layer {
                self.instances[number as usize].put_in_layer(layer);
                self.changed.push(number);
            }
        }
    }

    /// What the models that are drawn are looked up in.
    pub(crate) fn sources<'a>(&'a self, scene: &'a dyn Scene) -> Sources<'a> {
        Sources { scene, links: self.looks.links() }
    }

    /// Everything is dressed anew at the next look.
    pub(crate) fn forget(&mut self) {
        self.mark = None;
    }

    fn restart(&mut self) {
        self.instances.clear();
        self.stamps.clear();
        self.version += 1;
        self.cards.clear();
        self.grains.clear();
        self.recarded.clear();
        self.arrangement += 1;
        self.grid.clear();
        self.walls.clear();
        self.heads.clear();
        self.changed.clear();
        self.signalling.clear();
        self.restless.clear();
        self.layers.clear();
        self.models.clear();
        self.names = Arc::default();
        self.wardrobe.clear();
        self.free = [NONE; 2];
        self.epoch += 1;
    }

    /// Dresses who is in these slots now, by as many threads as that is worth; `again` says that nothing changed there, so that what is up to date of
    /// whom stays.
    fn look_at(
        &mut self,
        scene: &dyn Scene,
        slots: &[(u32, Option<EntityId>)],
        demand: &Demand,
        again: bool,
    ) {
        if slots.is_empty() {
            return;
        }
        self.looks.learn(scene, slots.iter().filter_map(|(_, id)| *id));
        let count = threads::worth(slots.len(), SHARE);
        let wide = slots.len().div_ceil(count);
        let (looks, heads, names, wardrobe) = (&self.looks, &self.heads[..], &self.names[..], &self.wardrobe);
        let tailor = Tailor { looks, scene, demand, heads, names, wardrobe, again };
        let dressed = threads::each(slots.chunks(wide).collect(), |share| {
            let mut dressed = Dressed::default();
            for (slot, id) in share {
                dressed.add(&tailor, *slot, *id);
            }
            dressed
        });
        for Dressed { parts, bodies, .. } in dressed {
            let mut parts = &parts[..];
            for body in bodies {
                let (own, rest) = parts.split_at(body.parts);
                self.settle(&body, own);
                parts = rest;
            }
        }
    }

    /// Takes in how an entity was dressed.
    fn settle(&mut self, body: &Body, parts: &[(Part, Instance)]) {
        let slot = body.slot as usize;
        if slot >= self.heads.len() {
            self.heads.resize(slot + 1, NONE);
        }
        if slot >= self.names.len() {
            Arc::make_mut(&mut self.names).resize(slot + 1, EntityId::default());
        }
        let Some(there) = &body.there else {
            self.file_surface(body.slot, None);
            self.signalling.remove(&body.slot);
            self.restless.remove(&body.slot);
            self.wardrobe.remove(body.slot);
            return self.cut(slot, NONE);
        };
        if self.names[slot] != there.id {
            Arc::make_mut(&mut self.names)[slot] = there.id;
        }
        let file = |set: &mut BTreeSet<u32>, is_in: bool| {
            if is_in {
                set.insert(body.slot)
            } else {
                set.remove(&body.slot)
            };
        };
        file(&mut self.signalling, there.kind == EntityKind::TrafficSignal);
        file(&mut self.restless, there.is_restless);
        self.file_surface(body.slot, parts.first().map(|(part, _)| part));
        self.widest = self.widest.max(there.ball.center.coords.amax());
        if self.wardrobe.holds(body.slot) != body.levels.is_some() {
            // Its numbers are of the other sort.
            self.cut(slot, NONE);
        }
        match body.levels {
            Some(levels) => self.wardrobe.put(body.slot, there.ball, levels),
            None => self.wardrobe.remove(body.slot),
        }
        if body.levels.is_some() && parts.is_empty() {
            return self.keep_place(slot, there);
        }
        self.fill(slot, there, parts);
    }

    /// Notes whether the first part of who is in a slot is a surface that may lie over another.
    fn file_surface(&mut self, slot: u32, first: Option<&Part>) {
        if first.is_some_and(|part| part.mesh.pattern().is_flat()) {
            if let std::collections::btree_map::Entry::Vacant(place) = self.layers.entry(slot) {
                place.insert(0);
                self.resurfaced = true;
            }
        } else if self.layers.remove(&slot).is_some() {
            self.resurfaced = true;
        }
    }

    /// The numbers of the instances of a slot, in their order.
    pub(crate) fn numbers_of(&self, slot: u32) -> impl Iterator<Item = u32> + '_ {
        let there = |number: u32| (number != NONE).then_some(number);
        let first = self.heads.get(slot as usize).copied().and_then(there);
        std::iter::successors(first, move |number| there(self.cards[*number as usize].next))
    }

    /// The closed block that an instance is, if it hides what is behind it from an eye.
    pub(crate) fn block(&self, number: u32, eye: &Point3) -> Option<Block> {
        let Drawn::Own(mesh) = self.cards[number as usize].mesh else { return None };
        let (drop, from_above) = mesh.closed()?;
        let instance = &self.instances[number as usize];
        let (scale, unit) = instance.measure();
        let [x, y, z] = scale.map(f64::from);
        let half = Vector3::new(x, y, z - f64::from(drop * unit)) * 0.5;
        let turn = instance.turn();
        let from_foot = turn.inverse() * (eye.coords - instance.place());
        let fits = half.z > 0.0 && (from_above || from_foot.z < 2.0 * half.z);
        fits.then(|| Block { center: instance.at(&Vector3::new(0.0, 0.0, half.z)).into(), half, turn })
    }

    /// The numbers of all instances, by slots and their parts.
    pub(crate) fn ordered(&self) -> impl Iterator<Item = u32> + '_ {
        (0..self.heads.len() as u32).flat_map(|slot| self.numbers_of(slot))
    }
}

impl Card {
    /// One that is drawn at every level of detail.
    #[cfg(test)]
    pub(crate) const fn of(mesh: Drawn) -> Self {
        let details = crate::look::Detail::EVERY;
        Self { mesh, slot: 0, part: 0, casts: true, mobile: false, details, nimble: false, next: NONE }
    }

    /// The slot of who has this number now, if anybody does.
    pub(crate) const fn slot_there(&self) -> Option<u32> {
        if self.slot == NONE { None } else { Some(self.slot) }
    }
}

#[cfg(test)]
mod tests;
