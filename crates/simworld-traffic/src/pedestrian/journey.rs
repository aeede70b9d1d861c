//! Walkers who go somewhere: where to, by which way, and that they came.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use simworld_core::geometry::Vector2;
use simworld_core::id::WaypointId;

use super::{Pedestrian, PedestrianManager, Stage};
use crate::{Counters, TripEnd};

/// What a walker does where its journey ends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum AtDestination {
    /// It goes in, and is there no more.
    #[default]
    Leave,
    /// It walks on, wherever its way leads.
    Wander,
}

/// The end of a walk: somebody came to their destination, or was taken out.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Walk {
    /// The walker's number, which another may have next if it left.
    pub id: u32,
    /// Why it ended.
    pub end: TripEnd,
    /// Where it led, of [`Traffic::walkways`](crate::Traffic::walkways); none for who wandered.
    pub to: Option<WaypointId>,
    /// When it began, s after the start; none for who was there from the start.
    pub began: Option<f64>,
    /// When it ended, s.
    pub ended: f64,
    /// Whether the walker is there no more.
    pub left: bool,
}

/// A way to a destination.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Journey {
    /// Waypoint by waypoint; who has decided n times since it set out heads for the n-th, from zero.
    pub(super) path: Vec<WaypointId>,
    pub(super) then: AtDestination,
    pub(super) began: f64,
}

/// Where somebody goes on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Next {
    /// Wherever the way leads: they have no journey.
    Anywhere,
    /// To the next waypoint of their journey.
    To(WaypointId),
    /// Nowhere: their journey ends here.
    Arrived,
}

/// The ways of those who have one, by the number of the walker.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Journeys(pub(super) BTreeMap<u32, Journey>);

impl Journeys {
    /// Where a walker heads after so many decisions.
    pub(super) fn next(&self, index: u32, decisions: u32) -> Next {
        let Some(journey) = self.0.get(&index) else { return Next::Anywhere };
        journey.path.get(decisions as usize).map_or(Next::Arrived, |next| Next::To(*next))
    }

    /// Bytes that they take; what the tree takes beside its entries is not counted.
    pub(super) fn bytes(&self) -> usize {
        let of = |journey: &Journey| {
            size_of::<(u32, Journey)>() + journey.path.capacity() * size_of::<WaypointId>()
        };
        self.0.values().map(of).sum()
    }

    pub(super) fn fit(&self, walkers: usize, waypoints: usize) -> bool {
        let is_known = |waypoint: &WaypointId| waypoint.index() < waypoints;
        self.0.iter().all(|(index, journey)| {
            (*index as usize) < walkers && !journey.path.is_empty() && journey.path.iter().all(is_known)
        })
    }
}

impl PedestrianManager {
    /// Sends a walker on a way, which begins at the waypoint it heads for and ends at its destination.
    pub(crate) fn send(&mut self, index: u32, path: Vec<WaypointId>, then: AtDestination, now: f64) {
        let walker = &mut self.walkers[index as usize];
        walker.decisions = 0;
        walker.party = index;
        walker.companions = 0;
        self.journeys.0.insert(index, Journey { path, then, began: now });
    }

    /// Takes a walker out, wherever it is; false if there is none of that number.
    pub(crate) fn remove(&mut self, index: u32, now: f64) -> bool {
        let is_there = self.walkers.get(index as usize).is_some_and(Pedestrian::is_present);
        if is_there {
            self.end(index, TripEnd::Removed, true, now);
        }
        is_there
    }

    /// A walker is where its journey ends.
    pub(super) fn arrive(&mut self, index: u32, now: f64, counters: &mut Counters) {
        let then = self.journeys.0.get(&index).map(|journey| journey.then);
        counters.walkers_arrived += 1;
        self.end(index, TripEnd::Arrived, then == Some(AtDestination::Leave), now);
        counters.walkers_left += u64::from(then == Some(AtDestination::Leave));
    }

    fn end(&mut self, id: u32, end: TripEnd, left: bool, now: f64) {
        let journey = self.journeys.0.remove(&id);
        let to = journey.as_ref().and_then(|journey| journey.path.last().copied());
        let began = journey.map(|journey| journey.began);
        self.ended.push(Walk { id, end, to, began, ended: now, left });
        if left {
            self.take_from_crossing(id);
            self.walkers[id as usize].stage = Stage::Gone;
            self.walkers[id as usize].velocity = Vector2::zeros();
            self.free.push(id);
            self.guides.forget(id);
            self.forget_subset();
        }
    }
}
