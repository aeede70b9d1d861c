//! Fixed solids at city scale: the engine has those near what is of interest and near bodies, the rest wait in a grid.
//!
//! Every body takes its surroundings with it, so nothing moves where its solids are away; points of interest keep more of them in
//! the engine than bodies need. A cell that nobody wants any longer stays for a while: who walks to and fro across its border costs nothing.
//! What is away is met by rays and overlaps as it is in the engine.

use std::collections::BTreeMap;

use parry3d_f64::query::{Ray as RapierRay, intersection_test};
use rapier3d_f64::math::Pose as RapierPose;
use rapier3d_f64::prelude::{ColliderBuilder, ColliderHandle, SharedShape};
use simworld_core::geometry::{Aabb, Point2, Pose, Ray};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityRef, RayHit, Scene, Shape, World};

use crate::convert::{from_vector, to_point, to_pose, to_vector};
use crate::dynamics::PhysicsDynamics;
use crate::shape::{material_of, shape_from};
use crate::surface::Conditions;
use crate::sync::Slot;

/// A square of the grid.
pub(crate) type Cell = (i64, i64);

/// Width of a cell, m.
const WIDTH: f64 = 64.0;
/// Solids of models may stick out of their entity's box by so much, m.
const MARGIN: f64 = 2.0;
/// What touches more cells is always in the engine.
const MOST_CELLS: i64 = 64;
/// A body has the solids within this distance, m, and within its way of the next [`AHEAD`] seconds.
const REACH: f64 = 20.0;
const AHEAD: f64 = 0.5;
/// Rays that are longer end here, m: farther than anything stands.
const FARTHEST: f64 = 1e9;
/// A cell that nobody wants is given up after so many steps.
const PATIENCE: u32 = 50;

/// Where fixed solids stand, while not all of them are in the engine.
#[derive(Default)]
pub(crate) struct Districts {
    /// The slots of what stands in a cell, ascending.
    cells: BTreeMap<Cell, Vec<u32>>,
    /// The cells whose solids are in the engine, ascending, each with the steps since it was wanted.
    pub(crate) loaded: Vec<(Cell, u32)>,
    /// What is met of solids with a model, by slot.
    models: BTreeMap<u32, SharedShape>,
}

impl Districts {
    /// None that are filed, and these that are in the engine.
    pub(crate) fn of(loaded: Vec<(Cell, u32)>) -> Self {
        Self { loaded, ..Self::default() }
    }

    fn is_loaded(&self, cell: Cell) -> bool {
        self.loaded.binary_search_by_key(&cell, |(cell, _)| *cell).is_ok()
    }

    /// Whether a solid belongs in the engine.
    pub(crate) fn holds(&self, bounds: &Aabb) -> bool {
        let span = Span::of(bounds);
        span.is_wide() || span.cells().any(|cell| self.is_loaded(cell))
    }

    /// Files a solid.
    pub(crate) fn file(&mut self, slot: usize, bounds: &Aabb, model: Option<SharedShape>) {
        let (slot, span) = (slot as u32, Span::of(bounds));
        if span.is_wide() {
            return;
        }
        for cell in span.cells() {
            let slots = self.cells.entry(cell).or_default();
            if let Err(place) = slots.binary_search(&slot) {
                slots.insert(place, slot);
            }
        }
        if let Some(model) = model {
            self.models.insert(slot, model);
        }
    }

    /// Forgets a solid.
    pub(crate) fn unfile(&mut self, slot: usize, bounds: &Aabb) {
        let (slot, span) = (slot as u32, Span::of(bounds));
        if span.is_wide() {
            return;
        }
        for cell in span.cells() {
            let Some(slots) = self.cells.get_mut(&cell) else { continue };
            slots.retain(|other| *other != slot);
            if slots.is_empty() {
                self.cells.remove(&cell);
            }
        }
        self.models.remove(&slot);
    }

    /// The slots of cells, ascending and once each.
    fn slots_in(&self, cells: impl Iterator<Item = Cell>) -> Vec<u32> {
        let mut slots: Vec<u32> = cells.filter_map(|cell| self.cells.get(&cell)).flatten().copied().collect();
        slots.sort_unstable();
        slots.dedup();
        slots
    }

    /// Takes up which cells are wanted, ascending; says which were not there before, and which are given up.
    fn turn(&mut self, wanted: &[Cell]) -> (Vec<Cell>, Vec<Cell>) {
        let is_wanted = |cell: &Cell| wanted.binary_search(cell).is_ok();
        let new: Vec<Cell> = wanted.iter().filter(|cell| !self.is_loaded(**cell)).copied().collect();
        let mut given_up = Vec::new();
        self.loaded.retain_mut(|(cell, idle)| {
            *idle = if is_wanted(cell) { 0 } else { *idle + 1 };
            if *idle > PATIENCE {
                given_up.push(*cell);
            }
            *idle <= PATIENCE
        });
        self.loaded.extend(new.iter().map(|cell| (*cell, 0)));
        self.loaded.sort_unstable();
        (new, given_up)
    }
}

/// A rectangle of cells.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Span {
    low: Cell,
    high: Cell,
}

impl Span {
    fn of(bounds: &Aabb) -> Self {
        let cell = |x: f64, y: f64| ((x / WIDTH).floor() as i64, (y / WIDTH).floor() as i64);
        let (low, high) = (bounds.min, bounds.max);
        Self { low: cell(low.x - MARGIN, low.y - MARGIN), high: cell(high.x + MARGIN, high.y + MARGIN) }
    }

    /// All within a distance of a place, and some more.
    fn around(place: Point2, reach: f64) -> Self {
        let cell = |x: f64, y: f64| ((x / WIDTH).floor() as i64, (y / WIDTH).floor() as i64);
        Self { low: cell(place.x - reach, place.y - reach), high: cell(place.x + reach, place.y + reach) }
    }

    fn is_wide(&self) -> bool {
        let side = |low: i64, high: i64| high.saturating_sub(low).saturating_add(1);
        side(self.low.0, self.high.0).saturating_mul(side(self.low.1, self.high.1)) > MOST_CELLS
    }

    fn cells(self) -> impl Iterator<Item = Cell> {
        (self.low.0..=self.high.0).flat_map(move |x| (self.low.1..=self.high.1).map(move |y| (x, y)))
    }
}

/// A collider with the friction that the weather leaves it.
pub(crate) fn weathered(collider: ColliderBuilder, conditions: &Conditions) -> ColliderBuilder {
    let friction = conditions.road.friction(material_of(collider.user_data));
    collider.friction(friction)
}

impl PhysicsDynamics {
    /// How many of the world's fixed solids are in the engine now, and how many there are. All of them are, unless
    /// [`set_interest`](Self::set_interest) names points and [`streaming_radius`](crate::PhysicsConfig::streaming_radius) says how far around them
    /// they are wanted.
    pub fn fixed_solids(&self) -> (usize, usize) {
        let fixed = self.slots.iter().filter_map(|slot| match slot {
            Slot::Fixed { collider, .. } => Some(collider.is_some()),
            _ => None,
        });
        fixed.fold((0, 0), |(inside, all), is_in| (inside + usize::from(is_in), all + 1))
    }

    /// Brings those solids into the engine that are wanted by now, and takes those out that have not been for long.
    pub(crate) fn stream(&mut self, world: &World) {
        let radius = self.config.streaming_radius.filter(|_| !self.interest.is_empty());
        let Some(radius) = radius else {
            if self.districts.take().is_some() {
                for slot in 0..self.slots.len() as u32 {
                    self.bring_in(slot, world);
                }
            }
            return;
        };
        let wanted = self.wanted_cells(radius, world);
        if self.districts.is_none() {
            self.survey(wanted.iter().map(|cell| (*cell, 0)).collect(), world);
        }
        let Some(districts) = &mut self.districts else { return };
        let (new, given_up) = districts.turn(&wanted);
        if new.is_empty() && given_up.is_empty() {
            return;
        }
        let (coming, going) = (districts.slots_in(new.into_iter()), districts.slots_in(given_up.into_iter()));
        for slot in coming {
            self.bring_in(slot, world);
        }
        for slot in going {
            self.take_out(slot);
        }
    }

    /// Files everything that stands fixed; the solids of `loaded` cells are in the engine. Those that are in it already and do not belong there
    /// are taken out.
    pub(crate) fn survey(&mut self, loaded: Vec<(Cell, u32)>, world: &World) {
        let mut districts = Districts::of(loaded);
        for (slot, value) in self.slots.iter().enumerate() {
            let Slot::Fixed { id, shape, pose, .. } = value else { continue };
            let model = world.entity(*id).and_then(|entity| self.solids.of(&entity, world));
            districts.file(slot, &shape.aabb(pose), model);
        }
        self.districts = Some(districts);
        for slot in 0..self.slots.len() as u32 {
            self.take_out(slot);
        }
    }

    /// The cells around points of interest and bodies, ascending.
    fn wanted_cells(&self, radius: f64, world: &World) -> Vec<Cell> {
        let interest = self.interest.iter().map(|point| Span::around(point.xy(), radius));
        let bodies = self.bodies.iter().filter_map(|owned| {
            let entity = world.entity(owned.id)?;
            let size = entity.info.shape.size().xy().norm();
            let reach = REACH + size + AHEAD * owned.body.state().twist.linear.norm().min(1e3);
            Some(Span::around(entity.planar(), reach))
        });
        let mut wanted: Vec<Cell> = interest.chain(bodies).flat_map(Span::cells).collect();
        wanted.sort_unstable();
        wanted.dedup();
        wanted
    }

    /// Puts a fixed solid into the engine, if it is not there.
    fn bring_in(&mut self, slot: u32, world: &World) {
        let Some(Slot::Fixed { id, collider: None, .. }) = self.slots.get(slot as usize) else { return };
        // What is there no longer is about to be looked at.
        let Some(entity) = world.entity(*id) else { return };
        let handle = self.harden(&entity, world);
        if let Slot::Fixed { collider, .. } = &mut self.slots[slot as usize] {
            *collider = Some(handle);
        }
    }

    /// Takes a fixed solid out of the engine, if nothing wants it there.
    fn take_out(&mut self, slot: u32) {
        let Some(Slot::Fixed { shape, pose, collider, .. }) = self.slots.get_mut(slot as usize) else {
            return;
        };
        let Some(districts) = &self.districts else { return };
        if districts.holds(&shape.aabb(pose)) {
            return;
        }
        if let Some(handle) = collider.take() {
            self.physics.remove_collider(handle);
        }
    }

    /// Makes the collider of a fixed solid.
    pub(crate) fn harden(&mut self, entity: &EntityRef<'_>, world: &World) -> ColliderHandle {
        let collider = weathered(self.solids.collider(entity, world), &self.conditions);
        let world_from_solid = to_pose(entity.pose) * collider.position;
        let handle = self.physics.insert_collider(collider.position(world_from_solid), None);
        self.file(handle);
        handle
    }

    /// A solid that is away: whose it is, what is met of it, and where that is.
    fn away(&self, slot: u32) -> Option<(EntityId, SharedShape, RapierPose)> {
        let Slot::Fixed { id, shape, pose, collider: None, .. } = self.slots.get(slot as usize)? else {
            return None;
        };
        let model = self.districts.as_ref().and_then(|districts| districts.models.get(&slot));
        let (solid, place) =
            model.map_or_else(|| shape_from(shape), |model| (model.clone(), RapierPose::IDENTITY));
        Some((*id, solid, to_pose(pose) * place))
    }

    /// The first solid that is away on a ray.
    pub(crate) fn cast_at_away(
        &self,
        ray: &Ray,
        max_distance: f64,
        filter: &dyn Fn(EntityId) -> bool,
    ) -> Option<RayHit> {
        let districts = self.districts.as_ref()?;
        let line = RapierRay::new(to_point(&ray.origin), to_vector(&ray.direction));
        let mut best: Option<RayHit> = None;
        for (cell, entry) in cells_on(ray, max_distance, &districts.cells) {
            if best.is_some_and(|best| best.distance < entry) {
                break;
            }
            for slot in districts.cells.get(&cell).into_iter().flatten() {
                let reach = best.map_or(max_distance, |hit| hit.distance);
                let Some((id, solid, pose)) = self.away(*slot) else { continue };
                if let Some(hit) = solid.cast_ray_and_get_normal(&pose, &line, reach, true)
                    && best.is_none_or(|best| (hit.time_of_impact, id) < (best.distance, best.entity))
                    && filter(id)
                {
                    let (entity, distance) = (id, hit.time_of_impact);
                    best = Some(RayHit { entity, distance, normal: from_vector(hit.normal) });
                }
            }
        }
        best
    }

    /// The solids that are away and share a point with a shape at a pose; at the end of `out`, in no order.
    pub(crate) fn away_overlapping(&self, shape: &Shape, pose: &Pose, out: &mut Vec<EntityId>) {
        let Some(districts) = &self.districts else { return };
        let (solid, place) = shape_from(shape);
        let here = to_pose(pose) * place;
        let span = Span::of(&shape.aabb(pose));
        let slots = if span.is_wide() {
            let is_in = |cell: &Cell| {
                (span.low.0..=span.high.0).contains(&cell.0) && (span.low.1..=span.high.1).contains(&cell.1)
            };
            districts.slots_in(districts.cells.keys().copied().filter(is_in))
        } else {
            districts.slots_in(span.cells())
        };
        for (id, other, there) in slots.into_iter().filter_map(|slot| self.away(slot)) {
            if intersection_test(&here, &*solid, &there, &*other).is_ok_and(|test| test.intersecting) {
                out.push(id);
            }
        }
    }
}

/// The cells with something in them that a ray passes, each with where it enters, by ascending distance.
fn cells_on(ray: &Ray, max_distance: f64, cells: &BTreeMap<Cell, Vec<u32>>) -> Vec<(Cell, f64)> {
    let max_distance = max_distance.min(FARTHEST);
    // Columns of cells side by side: of each, the part of the ray over it, and of that the rows.
    let (Some(first), Some(last)) = (cells.keys().next(), cells.keys().next_back()) else {
        return Vec::new();
    };
    let over = |low: f64, high: f64, from: f64, way: f64| -> Option<(f64, f64)> {
        if way == 0.0 {
            return (low..=high).contains(&from).then_some((0.0, max_distance));
        }
        let (a, b) = ((low - from) / way, (high - from) / way);
        let (enter, leave) = (a.min(b).max(0.0), a.max(b).min(max_distance));
        (enter <= leave).then_some((enter, leave))
    };
    let edge = |index: i64| index as f64 * WIDTH;
    let columns = Span::of(&Aabb::new(ray.origin, ray.at(max_distance)));
    let mut found = Vec::new();
    for column in first.0.max(columns.low.0)..=last.0.min(columns.high.0) {
        let Some((enter, leave)) = over(edge(column), edge(column + 1), ray.origin.x, ray.direction.x) else {
            continue;
        };
        let [a, b] = [enter, leave].map(|distance| ray.origin.y + ray.direction.y * distance);
        let row = |y: f64| (y / WIDTH).floor() as i64;
        for (cell, _) in cells.range((column, row(a.min(b)))..=(column, row(a.max(b)))) {
            if let Some((first_in, _)) = over(edge(cell.1), edge(cell.1 + 1), ray.origin.y, ray.direction.y) {
                found.push((*cell, first_in.max(enter)));
            }
        }
    }
    found.sort_unstable_by(|(a, x), (b, y)| x.total_cmp(y).then(a.cmp(b)));
    found
}
