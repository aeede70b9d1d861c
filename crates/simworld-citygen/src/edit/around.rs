//! What follows from a change of streets in the plan round it: room to turn at dead ends, and the heights of bridges.

use std::collections::{BTreeMap, BTreeSet};

use simworld_core::geometry::{Point2, bounds};
use simworld_core::net::{LORRY_TURNING, PlanChange, Street, StreetPlan, TurningRoom};

use super::EditError;
use super::cells::{Bounds, Cells, inflated};
use super::patch::PlanPatch;
use crate::terrain::{TerrainConfig, raise_bridges};

/// Streets farther than this from the end of another do not touch the room to turn there, m: the widest circle, the depth
/// of a lot and the two widest streets.
const TURNING: f64 = LORRY_TURNING + 60.0;
/// Ramps of a bridge and the streets that it leads on to, m.
const RAMPS: f64 = 250.0;
/// Bridges of bridges are looked for so often.
const ROUNDS: usize = 4;

/// What there is to turn round at an end of a street.
#[derive(Clone, Copy, PartialEq)]
enum Turning {
    None,
    /// A circle of that radius, m.
    Circle(f64),
    Hammerhead,
}

impl Turning {
    fn at(street: &Street, at_end: bool) -> Self {
        let end = usize::from(at_end);
        match (street.turning[end], street.hammerhead[end]) {
            (radius, _) if radius > 0.0 => Self::Circle(radius),
            (_, true) => Self::Hammerhead,
            _ => Self::None,
        }
    }

    fn set(self, street: &mut Street, at_end: bool) {
        let end = usize::from(at_end);
        street.turning[end] = if let Self::Circle(radius) = self { radius } else { 0.0 };
        street.hammerhead[end] = self == Self::Hammerhead;
    }

    /// The best that has room.
    fn widest(room: &TurningRoom) -> Self {
        match room.widest() {
            radius if radius > 0.0 => Self::Circle(radius),
            _ if room.has_hammerhead() => Self::Hammerhead,
            _ => Self::None,
        }
    }

    /// What is left where something may have come near: the same as long as it has room, or else the best that has, but
    /// nothing wider.
    fn left_by(self, room: impl FnOnce() -> TurningRoom) -> Self {
        match self {
            Self::None => self,
            Self::Circle(before) => {
                let room = room();
                match Self::widest(&room) {
                    _ if room.has(before) => self,
                    Self::Circle(radius) => Self::Circle(radius.min(before)),
                    other => other,
                }
            }
            Self::Hammerhead => {
                if room().has_hammerhead() {
                    self
                } else {
                    Self::None
                }
            }
        }
    }
}

/// A plan that was changed, and what changed of it.
pub(super) struct Around<'a> {
    pub(super) plan: &'a mut StreetPlan,
    /// Takes the change back.
    pub(super) patch: &'a mut PlanPatch,
    pub(super) change: &'a mut PlanChange,
    /// Where streets lay before.
    pub(super) roads: &'a Cells,
    /// Nodes that moved, are new or have other streets.
    pub(super) nodes: BTreeSet<usize>,
    /// Round all streets that changed, as they were and as they are.
    pub(super) area: Bounds,
}

impl Around<'_> {
    /// Streets that are new or other ones than before.
    fn touched(&self) -> BTreeSet<usize> {
        let changed = self.change.streets_changed.iter().copied();
        changed.chain(self.old_count()..self.plan.streets.len()).collect()
    }

    /// How many streets are left of those that were there.
    fn old_count(&self) -> usize {
        (self.patch.streets.len as usize).saturating_sub(self.change.streets_removed.len())
    }

    /// The streets that may touch a rectangle, and some others.
    fn near(&self, bounds: Bounds) -> BTreeSet<usize> {
        let mut near = self.roads.near(bounds);
        near.extend(self.touched());
        // The last ones got the numbers of those that are gone.
        near.extend(&self.change.streets_removed);
        near.split_off(&self.plan.streets.len());
        near
    }

    fn street_mut(&mut self, street: usize) -> Option<&mut Street> {
        if street < self.old_count() && !self.change.streets_changed.contains(&street) {
            self.change.streets_changed.push(street);
        }
        self.patch.streets.amend(&mut self.plan.streets, street)
    }

    /// Gives dead ends that the change made, or touched, the turning circle or hammerhead that has room; others near it
    /// lose theirs where it has no room any more.
    pub(super) fn set_turning(&mut self) {
        let area = inflated(self.area, TURNING);
        let near = self.near(inflated(area, TURNING));
        let mut degrees: BTreeMap<usize, u32> = BTreeMap::new();
        for street in &near {
            let Street { from, to, .. } = self.plan.streets[*street];
            for node in [from, to] {
                *degrees.entry(node).or_default() += 1;
            }
        }
        let others: Vec<usize> = near.iter().copied().collect();
        for (index, at_end) in near.into_iter().flat_map(|street| [(street, false), (street, true)]) {
            let street = &self.plan.streets[index];
            let node = if at_end { street.to } else { street.from };
            if !is_within(&self.plan.nodes[node], area) {
                continue;
            }
            let before = Turning::at(street, at_end);
            let is_dead = degrees.get(&node) == Some(&1) && street.level == 0;
            let room = || self.plan.turning_room(index, at_end, &others);
            let now = match (is_dead, self.nodes.contains(&node)) {
                (false, true) => Turning::None,
                (true, true) => Turning::widest(&room()),
                (true, false) => before.left_by(room),
                (false, false) => before,
            };
            if now != before
                && let Some(street) = self.street_mut(index)
            {
                now.set(street, at_end);
            }
        }
    }

    /// Raises bridges over what came below them, and those that moved. Nothing sinks: what was raised for a street that is
    /// gone stays as it was built.
    ///
    /// # Errors
    /// A street that changed has not enough room below a bridge, or as one.
    pub(super) fn raise(&mut self, config: &TerrainConfig) -> Result<(), EditError> {
        let near = self.near(inflated(self.area, 20.0));
        let is_bridge = |plan: &StreetPlan, street: &usize| plan.streets[*street].level > 0;
        let mut bridges: BTreeSet<usize> =
            near.into_iter().filter(|street| is_bridge(self.plan, street)).collect();
        if bridges.is_empty() {
            return Ok(());
        }
        // Heights on the way of a street that moved are at other places now.
        let moved: BTreeSet<usize> = self.change.nodes_changed.iter().copied().collect();
        for bridge in &bridges {
            let Street { from, to, profile, .. } = &self.plan.streets[*bridge];
            if !profile.is_empty() && (moved.contains(from) || moved.contains(to)) {
                self.street_mut(*bridge).into_iter().for_each(|street| street.profile.clear());
            }
        }
        // All that a bridge passes over has to be there.
        let mut streets = BTreeSet::new();
        for _ in 0..ROUNDS {
            for bridge in &bridges {
                let line = self.plan.centerline(&self.plan.streets[*bridge]);
                streets.extend(
                    bounds(&line).map(|around| self.near(inflated(around, RAMPS))).into_iter().flatten(),
                );
            }
            let found: BTreeSet<usize> =
                streets.iter().copied().filter(|street| is_bridge(self.plan, street)).collect();
            if found == bridges {
                break;
            }
            bridges = found;
        }
        self.raise_among(&streets, config)
    }

    fn raise_among(&mut self, streets: &BTreeSet<usize>, config: &TerrainConfig) -> Result<(), EditError> {
        let mut part = self.plan.part(streets.iter().copied());
        let touched = self.touched();
        let is_touched =
            |street: usize| part.streets.get(street).is_some_and(|whole| touched.contains(whole));
        let low = raise_bridges(&mut part.plan, config);
        if let Some(mut low) = low.into_iter().find(|low| is_touched(low.upper) || is_touched(low.lower)) {
            (low.upper, low.lower) = (part.streets[low.upper], part.streets[low.lower]);
            return Err(EditError::Bridge(low));
        }
        if self.plan.elevations.is_empty() && !part.plan.elevations.is_empty() {
            self.plan.elevations = vec![0.0; self.plan.nodes.len()];
        }
        for (node, height) in part.nodes.iter().zip(&part.plan.elevations) {
            if *height == self.plan.elevations[*node] {
                continue;
            }
            if let Some(entry) = self.patch.elevations.amend(&mut self.plan.elevations, *node) {
                *entry = *height;
            }
            let left = (self.patch.nodes.len as usize).saturating_sub(self.change.nodes_removed.len());
            if *node < left && !self.change.nodes_changed.contains(node) {
                self.change.nodes_changed.push(*node);
            }
        }
        for (street, raised) in part.streets.iter().zip(&part.plan.streets) {
            if raised.profile != self.plan.streets[*street].profile
                && let Some(street) = self.street_mut(*street)
            {
                street.profile.clone_from(&raised.profile);
            }
        }
        Ok(())
    }
}

fn is_within(point: &Point2, (low, high): Bounds) -> bool {
    (low.x..=high.x).contains(&point.x) && (low.y..=high.y).contains(&point.y)
}
