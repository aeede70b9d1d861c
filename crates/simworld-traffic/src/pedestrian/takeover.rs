//! Walkers that somebody else guides on their way, or moves as free bodies.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use simworld_core::geometry::{Point2, Vector2};
use simworld_core::hash::StateHasher;
use simworld_core::id::WaypointId;
use simworld_core::net::{WaypointEdge, WaypointGraph};

use super::{Habit, Pedestrian, PedestrianManager, Plazas, Stage};
use crate::takeover::{Control, ControlError, Stroll};

/// Who is guided or moved by somebody else.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Guides {
    /// What they were, by number.
    guided: BTreeMap<u32, Nature>,
    /// How high each stands, m.
    pub(super) free: BTreeMap<u32, f64>,
}

/// What is a walker's own.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Nature {
    free_speed: f32,
    keep_right: f32,
    habit: Habit,
}

impl Guides {
    /// Somebody has left.
    pub(super) fn forget(&mut self, index: u32) {
        self.guided.remove(&index);
        self.free.remove(&index);
    }

    pub(super) fn fit(&self, walkers: &[Pedestrian]) -> bool {
        let free = walkers.iter().filter(|walker| walker.stage == Stage::Free).count();
        let is_free =
            |index: &u32| walkers.get(*index as usize).is_some_and(|walker| walker.stage == Stage::Free);
        free == self.free.len()
            && self.free.iter().all(|(index, height)| is_free(index) && height.is_finite())
            && self.guided.iter().all(|(index, nature)| {
                (*index as usize) < walkers.len()
                    && nature.free_speed.is_finite()
                    && nature.keep_right.is_finite()
            })
    }

    pub(super) fn state_hash(&self, hasher: &mut StateHasher) {
        for (index, nature) in &self.guided {
            hasher.u64(u64::from(*index)).f64(f64::from(nature.free_speed)).f64(f64::from(nature.keep_right));
        }
        for (index, height) in self.free.iter().filter(|(_, height)| **height != 0.0) {
            hasher.u64(u64::from(*index)).f64(*height);
        }
    }
}

impl PedestrianManager {
    fn present(&mut self, id: u32) -> Result<&mut Pedestrian, ControlError> {
        let walker = self.walkers.get_mut(id as usize).filter(|walker| walker.is_present());
        walker.ok_or(ControlError::Nobody { what: "walker", id })
    }

    /// Lets a walker go as somebody else wants.
    pub(crate) fn guide(&mut self, id: u32, stroll: &Stroll) -> Result<(), ControlError> {
        stroll.validate()?;
        let walker = self.present(id)?;
        if walker.stage == Stage::Free {
            let (wanted, mend) = ("on its way", "give it back first");
            return Err(ControlError::NotSo { what: "walker", id, wanted, mend });
        }
        let Pedestrian { free_speed, keep_right, habit, .. } = *walker;
        walker.free_speed = stroll.speed as f32;
        (walker.keep_right, walker.left) = (stroll.keep_right as f32, 0.0);
        walker.habit = if stroll.dares { Habit::Dares } else { Habit::Waits };
        walker.leave_party(id);
        self.guides.guided.entry(id).or_insert(Nature { free_speed, keep_right, habit });
        Ok(())
    }

    /// Lifts a walker off its way, at the height that it has there, m.
    pub(crate) fn lift(&mut self, id: u32, height: f64) -> Result<(), ControlError> {
        if self.present(id)?.stage == Stage::Free {
            let (wanted, mend) = ("on its way", "it is a free body already");
            return Err(ControlError::NotSo { what: "walker", id, wanted, mend });
        }
        self.restore(id);
        self.take_from_crossing(id);
        let walker = self.present(id)?;
        walker.stage = Stage::Free;
        walker.leave_party(id);
        self.guides.free.insert(id, height);
        self.forget_subset();
        Ok(())
    }

    /// Puts a free walker somewhere, facing a direction of length one.
    pub(crate) fn place(
        &mut self,
        id: u32,
        at: Point2,
        facing: Vector2,
        velocity: Vector2,
    ) -> Result<(), ControlError> {
        let walker = self.present(id)?;
        if walker.stage != Stage::Free {
            let (wanted, mend) = ("a free body", "take it over by Traffic::free_walker first");
            return Err(ControlError::NotSo { what: "walker", id, wanted, mend });
        }
        (walker.position, walker.velocity) = (at, velocity);
        walker.facing = [facing.x as f32, facing.y as f32];
        Ok(())
    }

    /// Says how high a free walker stands, m.
    pub(crate) fn place_at_height(&mut self, id: u32, height: f64) -> Result<(), ControlError> {
        let (wanted, mend) = ("a free body", "take it over by Traffic::free_walker first");
        let own = self.guides.free.get_mut(&id);
        *own.ok_or(ControlError::NotSo { what: "walker", id, wanted, mend })? = height;
        Ok(())
    }

    /// How high a free walker stands, m.
    pub(crate) fn free_height(&self, id: u32) -> Option<f64> {
        self.guides.free.get(&id).copied()
    }

    /// Gives a walker that is guided its own ways back; false if it is not.
    pub(crate) fn restore(&mut self, id: u32) -> bool {
        let Some(nature) = self.guides.guided.remove(&id) else { return false };
        if let Some(walker) = self.walkers.get_mut(id as usize) {
            let Nature { free_speed, keep_right, habit } = nature;
            (walker.free_speed, walker.keep_right, walker.habit) = (free_speed, keep_right, habit);
            walker.left = 0.0;
        }
        true
    }

    /// Puts a free walker back on the walkway under it, from which its journey, if it has one, goes on.
    pub(crate) fn put_back(
        &mut self,
        (ways, plazas): (&WaypointGraph, &Plazas),
        id: u32,
        path: impl Fn(WaypointId, WaypointId) -> Option<Vec<WaypointId>>,
    ) -> Result<(), ControlError> {
        let walker = *self.present(id)?;
        let at = walker.position;
        let refused = |reason| ControlError::NoPlace { what: "walker", id, at, reason };
        let (from, to) = walkway_at(ways, plazas, &walker)
            .ok_or(refused("no walkway passes under it: bring it to a sidewalk, off the road"))?;
        if let Some(journey) = self.journeys.0.get_mut(&id)
            && let Some(goal) = journey.path.last()
        {
            journey.path = path(to, *goal)
                .ok_or(refused("no way leads from its walkway to its destination: bring it to another"))?;
        }
        let walker = self.present(id)?;
        (walker.from, walker.to, walker.left) = (from, to, 0.0);
        (walker.stage, walker.decisions) = (Stage::Walking, 0);
        self.guides.free.remove(&id);
        self.forget_subset();
        Ok(())
    }

    /// Who says where a walker goes.
    pub(crate) fn control(&self, id: u32) -> Option<Control<Stroll>> {
        let walker = self.walkers.get(id as usize).filter(|walker| walker.is_present())?;
        Some(match walker.stage {
            Stage::Free => Control::Free,
            _ if self.guides.guided.contains_key(&id) => Control::Guided(Stroll {
                speed: f64::from(walker.free_speed),
                keep_right: f64::from(walker.keep_right),
                dares: walker.habit == Habit::Dares,
            }),
            _ => Control::Own,
        })
    }

    /// The walkers that are free bodies, by number, and how high each stands, m.
    pub(crate) fn free_bodies(&self) -> impl Iterator<Item = (&Pedestrian, f64)> {
        self.guides.free.iter().filter_map(|(id, height)| Some((self.walkers.get(*id as usize)?, *height)))
    }
}

impl Pedestrian {
    fn leave_party(&mut self, own: u32) {
        (self.party, self.companions) = (own, 0);
    }
}

/// The walkway under somebody that leads where they look: of those that begin or end near the nearest waypoint, the one whose
/// middle is nearest.
fn walkway_at(
    ways: &WaypointGraph,
    plazas: &Plazas,
    walker: &Pedestrian,
) -> Option<(WaypointId, WaypointId)> {
    let at = walker.position;
    let nearest = ways.nearest(at)?;
    let starts = std::iter::once(nearest).chain(ways.edges(nearest).iter().map(|edge| edge.to));
    let mut best: Option<(f64, WaypointId, WaypointId)> = None;
    for (from, edge) in starts.flat_map(|from| ways.edges(from).iter().map(move |edge| (from, edge))) {
        let Some(aside) = aside(ways, plazas, (from, edge), walker) else { continue };
        if best.is_none_or(|best| aside < best.0) {
            best = Some((aside, from, edge.to));
        }
    }
    best.map(|(_, from, to)| (from, to))
}

/// How far somebody is beside the middle of a walkway; none if they are not on it, or look the other way.
fn aside(
    ways: &WaypointGraph,
    plazas: &Plazas,
    (from, edge): (WaypointId, &WaypointEdge),
    walker: &Pedestrian,
) -> Option<f64> {
    let (a, b) = (ways.waypoint(from).position, ways.waypoint(edge.to).position);
    let along = (b - a).try_normalize(1e-9)?;
    let offset = walker.position - a;
    let (station, aside) = (offset.dot(&along), offset.perp(&along).abs());
    let half = f64::from(edge.width) * 0.5;
    let is_wide = || {
        let plaza = plazas.between(ways, from, edge.to);
        plaza.is_some_and(|plaza| plazas.contains(plaza, walker.position))
    };
    let is_on = edge.crossing.is_none()
        && (-half..=(b - a).norm() + half).contains(&station)
        && (aside <= half || is_wide());
    (is_on && walker.direction().dot(&along) >= 0.0).then_some(aside)
}
