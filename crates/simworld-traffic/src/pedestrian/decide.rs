//! What a walker decides at its waypoints: where to go on, and whether to cross.

use simworld_core::id::CrossingId;
use simworld_core::net::{Aspect, RoadNetwork, WaypointGraph};
use simworld_core::seed::Stream;

use super::journey::{Journeys, Next};
use super::{Habit, Pedestrian, Plazas, Stage};
use crate::TrafficConfig;

/// Nobody crosses a road more slowly, m/s: signals leave time for 1.0.
pub(super) const CROSSING_SPEED: f64 = 1.25;

/// What walkers see of vehicles and signals.
pub(crate) struct Sight<'a> {
    pub(crate) network: &'a RoadNetwork,
    pub(crate) ways: &'a WaypointGraph,
    pub(crate) plazas: &'a Plazas,
    pub(crate) aspects: &'a [Aspect],
    /// Vehicles about to pass each crossing.
    pub(crate) claims: &'a (dyn Fn(CrossingId) -> u32 + Sync),
    /// When the next vehicle comes to a crossing that has no leave to pass it yet, s.
    pub(crate) gap: &'a (dyn Fn(CrossingId) -> f64 + Sync),
    /// When the next of those comes to each crossing who are not the traffic's own and may not stop, s.
    pub(crate) threats: &'a [f64],
}

impl Sight<'_> {
    /// Whether the signal, if there is one, lets people begin to cross.
    pub(super) fn shows_walk(&self, crossing: CrossingId) -> bool {
        match self.network.crossings[crossing.index()].signal {
            Some(group) => self.aspects[group.index()] == Aspect::Green,
            None => true,
        }
    }
}

/// What changed for others by what a walker decided.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Event {
    /// It came to the kerb of a crossing.
    Waits(CrossingId),
    /// It began to cross, at red or not.
    Crosses(CrossingId, bool),
    /// It left the crossing.
    Leaves(CrossingId),
    /// The walker of this number is where its journey ends.
    Arrives(u32),
}

/// A walker's number, its draws, and what it goes by.
pub(super) struct Deciding<'a> {
    pub(super) index: u32,
    pub(super) sight: &'a Sight<'a>,
    pub(super) config: &'a TrafficConfig,
    pub(super) streams: Stream,
    pub(super) journeys: &'a Journeys,
}

impl Pedestrian {
    /// At a waypoint: where to go on, and whether one may.
    pub(super) fn decide(&mut self, by: &Deciding<'_>, weights: &mut Vec<f64>, events: &mut Vec<Event>) {
        if self.stage != Stage::Waiting {
            if self.stage == Stage::Crossing {
                events.push(Event::Leaves(self.crossing));
                self.stage = Stage::Walking;
            }
            let here = self.to;
            let edges = by.sight.ways.edges(here);
            self.decisions += 1;
            let edge = match by.journeys.next(by.index, self.decisions) {
                Next::To(next) => edges.iter().find(|edge| edge.to == next),
                Next::Arrived => {
                    // Until the others are told it stays where it is.
                    self.decisions -= 1;
                    events.push(Event::Arrives(by.index));
                    return;
                }
                Next::Anywhere => edges.get(self.choose(by, weights)),
            };
            let Some(edge) = edge else { return };
            (self.from, self.to, self.left) = (here, edge.to, 0.0);
            if let Some(crossing) = edge.crossing {
                (self.stage, self.crossing) = (Stage::Waiting, crossing);
                events.push(Event::Waits(crossing));
            }
        }
        if self.stage == Stage::Waiting
            && let Some(dares) = self.may_cross(by)
        {
            self.stage = Stage::Crossing;
            events.push(Event::Crosses(self.crossing, dares));
        }
    }

    /// One of the ways on, drawn at random; those of a party draw the same.
    fn choose(&self, by: &Deciding<'_>, weights: &mut Vec<f64>) -> usize {
        let edges = by.sight.ways.edges(self.to);
        weights.clear();
        weights.extend(edges.iter().map(|edge| match edge.crossing {
            // One turns back only where there is no other way.
            _ if edge.to == self.from && edges.len() > 1 => 0.0,
            Some(_) => by.config.crossing_weight,
            None => 1.0,
        }));
        let mut rng = by.streams.indexed(u64::from(self.party)).indexed(u64::from(self.decisions)).rng();
        rng.weighted(weights).unwrap_or(0)
    }

    /// Whether one may begin to cross, and if so, whether at red.
    fn may_cross(&self, by: &Deciding<'_>) -> Option<bool> {
        let sight = by.sight;
        let crossing = &sight.network.crossings[self.crossing.index()];
        if (sight.claims)(self.crossing) > 0 {
            return None;
        }
        // The critical gap of the Highway Capacity Manual: the way across at one's speed, and a margin.
        let speed = self.free_speed().max(CROSSING_SPEED);
        let needed = (crossing.end - crossing.start).norm() / speed + by.config.people.gap_margin;
        if sight.threats[self.crossing.index()] < needed {
            return None;
        }
        if sight.shows_walk(self.crossing) {
            return Some(false);
        }
        (self.habit == Habit::Dares && (sight.gap)(self.crossing) >= needed).then_some(true)
    }
}
