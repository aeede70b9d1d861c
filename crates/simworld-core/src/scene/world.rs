//! The world store: entities in parallel arrays, filed in a loose quadtree, changed only by commands and by
//! dynamics.

mod bonds;
mod digests;
mod drawn;
mod error;
mod gestures;
mod journal;
mod read;
mod slots;
mod snapshot;
mod strides;

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use digests::Digests;
pub use error::WorldError;
use journal::Journal;
pub use journal::Mark;
use slots::{Head, check_pose, check_twist, is_called, is_same_motion, nothing};
pub use snapshot::WorldSnapshot;
use strides::Strides;

use super::quadtree::Quadtree;
use super::{ClassIndex, EntityDesc, EntityInfo, EntityRef, NameIndex, Role, SELLS, Scene};
use crate::action::Action;
use crate::asset::{Asset, AssetError, Catalogue};
use crate::clock::{Clock, Tick};
use crate::environment::Environment;
use crate::event::{Event, EventKind};
use crate::geometry::{Pose, Twist};
use crate::ground::Ground;
use crate::hash::{StateDigest, StateHash, StateHasher};
use crate::id::{AssetId, EntityId};
use crate::intent::Intent;
use crate::limbs::JointAngles;
use crate::links::KeptLinks;
use crate::net::{Aspect, NetworkPatch, PatchError, RoadNetwork};
use crate::traffic::{RoadLeg, TrafficOrder};

/// Positions farther out than this are refused, m: a third of the way round the Earth.
const WORLD_LIMIT: f64 = 1.3e7;

/// The state of everything: entities, environment, clock, signals.
///
/// ```
/// use simworld_core::geometry::{Point2, Point3, pose_facing};
/// use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
/// let mut world = World::new();
/// for x in [0.0, 10.0, 25.0] {
///     let pose = pose_facing(Point3::new(x, 0.0, 0.0), 0.0);
///     world.spawn(EntityDesc::new(EntityKind::Bench, pose, Shape::cuboid(0.6, 1.8, 0.8)))?;
/// }
/// let nearest = world.nearest(Point2::new(12.0, 1.0), 100.0, &|e| e.kind == EntityKind::Bench).unwrap();
/// assert_eq!(nearest.position().x, 10.0);
/// # Ok::<(), simworld_core::scene::WorldError>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct World {
    // One entry a slot; what lies in free slots beside their heads means nothing.
    heads: Vec<Head>,
    poses: Vec<Pose>,
    twists: Vec<Twist>,
    infos: Vec<EntityInfo>,
    digests: Digests,
    journal: Journal,
    /// Free slots; the last is taken first.
    free: Vec<u32>,
    /// How people hold their limbs; no part of what is saved.
    joints: BTreeMap<EntityId, JointAngles>,
    /// What moves for itself of those that have such; no part of what is saved either.
    links: BTreeMap<EntityId, KeptLinks>,
    /// Who moves its arms to say something, and in which tick that ends; follows from the attributes.
    gestures: BTreeMap<EntityId, Tick>,
    /// How who has a model with clips has come to what it shows; saved, and no part of digests.
    strides: Strides,
    /// Slots with a bond, ascending.
    bonded: Vec<u32>,
    tree: Quadtree,
    /// Follows from `infos`; shared between copies of a world until one of them changes it.
    names: Arc<NameIndex>,
    /// Likewise.
    classes: Arc<ClassIndex>,
    revision: u64,

    clock: Clock,
    environment: Environment,
    pub(crate) roads: Option<Arc<RoadNetwork>>,
    ground: Option<Arc<Ground>>,
    assets: Arc<Catalogue>,
    signals: Vec<Aspect>,
    /// Directions of roads that are closed to traffic.
    pub(crate) closed: BTreeSet<RoadLeg>,

    // What this step is told and what happened in it; emptied at its end.
    actuations: Vec<(EntityId, Action)>,
    intents: Vec<(EntityId, Intent)>,
    orders: Vec<TrafficOrder>,
    events: Vec<Event>,
}

impl World {
    /// An empty world at tick zero, in clear weather, stepping by 0.1 s.
    pub fn new() -> Self {
        Self::default()
    }

    /// An empty world with that clock.
    pub fn with_clock(clock: Clock) -> Self {
        Self { clock, ..Self::default() }
    }

    /// Gives the world its roads, all of them open; every signal group shows red until traffic says otherwise.
    pub fn set_roads(&mut self, roads: Arc<RoadNetwork>) {
        self.signals = vec![Aspect::Red; roads.signal_groups()];
        self.closed.clear();
        self.roads = Some(roads);
    }

    /// Gives the world a ground that is not flat; what stands somewhere already stays where it is.
    pub fn set_ground(&mut self, ground: Arc<Ground>) {
        self.ground = Some(ground);
        self.revision += 1;
    }

    /// Changes the roads; gives the patch that takes the change back. Signal groups that are new show red. A network that
    /// somebody else holds too is copied first, so that theirs stays as it is.
    ///
    /// # Errors
    /// No roads, a patch that is for other ones, or streets that are closed, for a patch may number them anew; then nothing
    /// has changed.
    pub fn patch_roads(&mut self, patch: NetworkPatch) -> Result<NetworkPatch, PatchError> {
        if !self.closed.is_empty() {
            return Err(PatchError::Closed { count: self.closed.len() });
        }
        let roads = Arc::make_mut(self.roads.as_mut().ok_or(PatchError::NoRoads)?);
        let back = roads.put_checked(patch)?;
        self.signals.resize(roads.signal_groups(), Aspect::Red);
        self.revision += 1;
        Ok(back)
    }

    /// Adds an asset to those that entities are made from; one that is there already keeps its id.
    ///
    /// # Errors
    /// An asset that is none, or another one of the same name.
    pub fn add_asset(&mut self, asset: Asset) -> Result<AssetId, AssetError> {
        Arc::make_mut(&mut self.assets).add(asset)
    }

    // ---- entities ----

    /// The number of living entities.
    pub fn len(&self) -> usize {
        self.heads.len() - self.free.len()
    }

    /// Whether nothing lives here.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Ids stay below this index: the length of an array beside the world.
    pub fn slots(&self) -> usize {
        self.heads.len()
    }

    /// Every living entity, by ascending slot.
    pub fn iter(&self) -> impl Iterator<Item = EntityRef<'_>> {
        (0..self.heads.len()).filter_map(|slot| self.in_slot(slot))
    }

    /// The living entity in a slot: that of the id with this [index](EntityId::index), of whatever generation.
    pub fn slot(&self, index: usize) -> Option<EntityRef<'_>> {
        if index < self.heads.len() { self.in_slot(index) } else { None }
    }

    /// A count that changes whenever an entity is spawned, removed or [altered](Self::alter): what a cache of
    /// static things (colliders, meshes, names) compares.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// Puts an entity into the world.
    ///
    /// # Errors
    /// A pose out of the world, a shape that is no solid, or a carrier or an asset that does not exist.
    pub fn spawn(&mut self, desc: EntityDesc) -> Result<EntityId, WorldError> {
        self.check(self.next_id(), &desc)?;
        let slot = self.free.pop().unwrap_or_else(|| self.new_slot());
        Ok(self.fill(slot, desc))
    }

    /// Puts a removed entity back under its old id; the way an undo brings it back.
    ///
    /// # Errors
    /// As [`spawn`](Self::spawn), and if the slot was taken by somebody else since.
    pub fn respawn(&mut self, id: EntityId, desc: EntityDesc) -> Result<(), WorldError> {
        self.check(id, &desc)?;
        let index = id.index() as u32;
        let Some(position) = self.free.iter().position(|slot| *slot == index) else {
            return Err(WorldError::InUse { id });
        };
        self.free.remove(position);
        self.heads[id.index()].generation = id.generation();
        self.fill(index, desc);
        Ok(())
    }

    /// Takes an entity out of the world and returns its recipe. What hung on it stays where it is.
    ///
    /// # Errors
    /// No such entity.
    pub fn remove(&mut self, id: EntityId) -> Result<EntityDesc, WorldError> {
        let desc = self.entity(id).ok_or(WorldError::Missing { id })?.to_desc();
        let slot = id.index();
        let carried: Vec<u32> = self.bonded.clone();
        for child in carried {
            if self.heads[child as usize].bond.as_ref().is_some_and(|bond| bond.parent == id) {
                self.set_bond(child as usize, None);
            }
        }
        self.set_bond(slot, None);
        self.joints.remove(&id);
        self.links.remove(&id);
        self.strides.remove(&id);
        self.infos[slot] = nothing();
        if is_called(&desc.info) {
            Arc::make_mut(&mut self.names).remove(id, &desc.info);
        }
        Arc::make_mut(&mut self.classes).remove(id, desc.kind, &desc.info);
        let head = &mut self.heads[slot];
        (head.kind, head.generation) = (None, head.generation.wrapping_add(1));
        self.tree.remove(slot as u32);
        self.free.push(slot as u32);
        self.touch(slot);
        self.revision += 1;
        Ok(desc)
    }

    /// Sets where an entity is and how it moves: what dynamics call for every body, every step. Who stays as it was costs next
    /// to nothing, and does not count as changed.
    ///
    /// # Errors
    /// No such entity, or numbers that are not finite.
    pub fn set_motion(&mut self, id: EntityId, pose: Pose, twist: Twist) -> Result<(), WorldError> {
        self.check_alive(id)?;
        let slot = id.index();
        if is_same_motion((&self.poses[slot], &self.twists[slot]), (&pose, &twist)) {
            return Ok(());
        }
        check_pose(&pose)?;
        check_twist(id, &twist)?;
        self.twists[slot] = twist;
        self.place(id, pose);
        Ok(())
    }

    /// Sets an attribute, or removes it with `None`; returns the old value.
    ///
    /// # Errors
    /// No such entity.
    pub fn set_attribute(
        &mut self,
        id: EntityId,
        key: &str,
        value: Option<crate::value::Value>,
    ) -> Result<Option<crate::value::Value>, WorldError> {
        self.check_alive(id)?;
        self.touch(id.index());
        let info = &mut self.infos[id.index()];
        if key == SELLS {
            let names = Arc::make_mut(&mut self.names);
            names.remove_goods(id, info.attributes.get(SELLS));
            names.insert_goods(id, value.as_ref());
        }
        Ok(match value {
            Some(value) => info.attributes.insert(key.to_owned(), value),
            None => info.attributes.remove(key),
        })
    }

    /// Changes what a living entity is made of: those who keep things of it look anew.
    pub(crate) fn change_info<R>(
        &mut self,
        id: EntityId,
        change: impl FnOnce(&mut EntityInfo) -> R,
    ) -> Result<R, WorldError> {
        self.check_alive(id)?;
        let info = &mut self.infos[id.index()];
        let old = info.clone();
        let changed = change(info);
        if info.name != old.name {
            let names = Arc::make_mut(&mut self.names);
            names.remove(id, &old);
            names.insert(id, info);
        }
        self.revision += 1;
        Ok(changed)
    }

    /// Moves a living entity to a checked pose.
    pub(crate) fn place(&mut self, id: EntityId, pose: Pose) {
        let slot = id.index();
        let bounds = self.infos[slot].shape.aabb(&pose);
        self.poses[slot] = pose;
        self.file(slot, bounds);
        self.touch(slot);
    }

    // ---- the step ----

    /// Sets the sun and the weather; returns the old ones.
    ///
    /// # Errors
    /// The first field out of range.
    pub fn set_environment(
        &mut self,
        environment: Environment,
    ) -> Result<Environment, crate::environment::EnvironmentError> {
        environment.validate()?;
        Ok(std::mem::replace(&mut self.environment, environment))
    }

    /// What every signal group shows, for the traffic to write; indexed by
    /// [`SignalGroup`](crate::net::SignalGroup).
    pub fn signals_mut(&mut self) -> &mut [Aspect] {
        &mut self.signals
    }

    /// What bodies are told this step, in the order it was said.
    pub fn actuations(&self) -> &[(EntityId, Action)] {
        &self.actuations
    }

    /// What minds want this step, in the order it was said.
    pub fn intents(&self) -> &[(EntityId, Intent)] {
        &self.intents
    }

    /// What is asked of the traffic this step and was not taken yet, in the order it was said.
    pub fn orders(&self) -> &[TrafficOrder] {
        &self.orders
    }

    /// Takes what is asked of the traffic this step, to carry it out. What nobody takes is refused at the end of the step.
    pub fn take_orders(&mut self) -> Vec<TrafficOrder> {
        std::mem::take(&mut self.orders)
    }

    /// What happened since the step began, in order.
    pub fn events(&self) -> &[Event] {
        &self.events
    }

    /// Reports that something happened.
    pub fn emit(&mut self, kind: EventKind) {
        self.events.push(Event { tick: self.clock.tick(), kind });
    }

    /// Tells a body to act this step: actions on objects take effect at once, all are passed on to the bodies. Pedals and
    /// wheel that somebody moves who sits in a vehicle are those of the vehicle, and so is the order to stop.
    ///
    /// # Errors
    /// The action is impossible, with the reason.
    pub fn actuate(&mut self, who: EntityId, action: Action) -> Result<(), super::InteractionError> {
        self.interact(who, &action)?;
        self.gesticulate(who, &action);
        let body = self.driven_by(who, &action).unwrap_or(who);
        self.actuations.push((body, action));
        Ok(())
    }

    /// The vehicle that the action moves if it is done by who sits in it.
    fn driven_by(&self, who: EntityId, action: &Action) -> Option<EntityId> {
        let drives = matches!(
            action,
            Action::Throttle { .. } | Action::Brake { .. } | Action::Steer { .. } | Action::Stop
        );
        let bond = self.entity(who)?.attachment.filter(|bond| drives && bond.role == Role::Aboard)?;
        Some(bond.parent)
    }

    pub(crate) fn intend(&mut self, who: EntityId, intent: Intent) -> Result<(), WorldError> {
        self.check_alive(who)?;
        self.intents.push((who, intent));
        Ok(())
    }

    pub(crate) fn order(&mut self, order: TrafficOrder) -> Result<(), WorldError> {
        order.who().map_or(Ok(()), |who| self.check_alive(who))?;
        self.orders.push(order);
        Ok(())
    }

    /// Ends the step: carried things follow their carriers, the clock advances.
    pub fn finish_step(&mut self) {
        self.follow_carriers();
        self.end_gestures();
        self.turn_page();
        self.actuations.clear();
        self.intents.clear();
        for order in std::mem::take(&mut self.orders) {
            self.emit(order.refused("this world has no traffic"));
        }
        self.clock.advance();
        if !self.strides.is_empty() {
            self.stride_on();
        }
    }

    /// Forgets the events of the last step; called at the start of the next, so that readers between see them.
    pub fn begin_step(&mut self) {
        self.events.clear();
    }

    /// Begins a new page of what changed.
    fn turn_page(&mut self) {
        self.journal.turn();
        self.digests.note(self.journal.last());
    }

    fn digest_of_slot(&self, slot: usize) -> u64 {
        self.in_slot(slot).map_or(0, |entity| {
            let mut hasher = StateHasher::new();
            entity.state_hash(&mut hasher);
            hasher.finish().0
        })
    }

    // ---- inner workings ----
}

impl StateHash for World {
    /// Covers the state as it is. It costs what has changed since somebody asked last, and nothing while nobody asks.
    fn state_hash(&self, hasher: &mut StateHasher) {
        hasher.u64(self.clock.tick().0);
        self.environment.state_hash(hasher);
        for aspect in &self.signals {
            hasher.u64(*aspect as u64);
        }
        // Only where something is closed, so that it leaves no trace when it is open again.
        for (road, direction) in &self.closed {
            hasher.u64(u64::from(road.0)).u64(*direction as u64);
        }
        // Only where there is one, so that flat worlds are what they were.
        if let Some(ground) = &self.ground {
            ground.state_hash(hasher);
        }
        self.digests.read(
            self.journal.now(),
            |slot| self.digest_of_slot(slot),
            |digests| {
                // Free slots at the end count for nothing: what came and is gone leaves no trace.
                let used = digests.iter().rposition(|digest| *digest != 0).map_or(0, |last| last + 1);
                hasher.u64(used as u64);
                for digest in &digests[..used] {
                    hasher.u64(*digest);
                }
            },
        );
    }

    fn digest(&self) -> StateDigest {
        let mut hasher = StateHasher::new();
        self.state_hash(&mut hasher);
        hasher.finish()
    }
}
