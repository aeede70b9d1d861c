//! Sirens: who has one on, where others make way for it, and how it passes a red light.
//!
//! Those ahead of it leave its lane where another leads on as well, nobody comes into its lane before it, and nobody enters a
//! junction that it is about to enter on a way that meets its own. It passes a red light itself, slowly, when nobody else is
//! on a way that meets its own and nobody is on a crossing; people at the kerb wait. Who turned on no siren pays nothing for it.

use serde::{Deserialize, Serialize};
use simworld_core::id::ConnectionId;
use simworld_core::net::Aspect;

use crate::TrafficConfig;
use crate::vehicle::VehicleKind;
use crate::vehicle::manager::{NONE, Vehicle, VehicleManager};
use crate::vehicle::scene::Scene;
use crate::vehicle::tracks::{Track, Tracks};
use crate::vehicle::types::VehicleType;

/// So far ahead others hear it and make way, m; ours, six seconds at the limit of a street.
const HEARD: f64 = 90.0;
/// It keeps a junction free that it reaches within this time, s, or from this near, m.
const KEEPS_FREE: f64 = 8.0;
const NEAR: f64 = 25.0;
/// Who has stood for so long before a junction waits for something else than those who cross it, s: they need not wait then.
const IN_VAIN: f64 = 8.0;
/// It passes a red light no faster than this, m/s; ours, 20 km/h.
const SLOW: f64 = 20.0 / 3.6;
/// It goes on at red only from so near to the line that it sees the junction, m; from there on it does.
pub(in crate::vehicle) const SEES: f64 = 12.0;

/// A stretch of a lane on which a siren is heard from behind.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Stretch {
    lane: Track,
    from: f64,
    to: f64,
}

/// Who has a siren on, and what that asks of others in this step.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Sirens {
    /// Numbers of the vehicles, ascending.
    on: Vec<u32>,
    #[serde(skip)]
    stretches: Vec<Stretch>,
    /// The ways that they are about to take.
    #[serde(skip)]
    ways: Vec<u32>,
}

impl Sirens {
    /// Turns one on or off.
    pub(crate) fn switch(&mut self, id: u32, is_on: bool) {
        match (self.on.binary_search(&id), is_on) {
            (Ok(place), false) => {
                self.on.remove(place);
            }
            (Err(place), true) => self.on.insert(place, id),
            _ => {}
        }
    }

    /// The share of the limit that a driver with that factor takes: of emergency vehicles without a siren that of others, whose
    /// mean is the limit.
    pub(in crate::vehicle) fn factor(row: &VehicleType, factor: f32, is_on: bool) -> f32 {
        let hurries = row.kind != VehicleKind::Emergency || is_on;
        if hurries { factor } else { factor / row.speed_factor as f32 }
    }

    /// The numbers of those who have one on, ascending.
    pub(crate) fn on(&self) -> &[u32] {
        &self.on
    }

    /// Whether a vehicle has one on.
    #[inline]
    pub(in crate::vehicle) fn is_on(&self, id: u32) -> bool {
        !self.on.is_empty() && self.on.binary_search(&id).is_ok()
    }

    /// Whether one is heard from behind at a place.
    #[inline]
    pub(super) fn is_heard(&self, lane: Track, s: f64) -> bool {
        self.stretches.iter().any(|stretch| stretch.lane == lane && stretch.from < s && s < stretch.to)
    }

    /// Whether others must leave a way free for a siren that is about to cross it.
    #[inline]
    pub(in crate::vehicle) fn keep_free(&self, tracks: &Tracks, way: usize) -> bool {
        !self.ways.is_empty() && {
            let conflicts = &tracks.network.connections[way].conflicts;
            self.ways.iter().any(|other| conflicts.contains(&ConnectionId(*other)))
        }
    }

    /// Whether saved sirens are those of vehicles that there may be.
    pub(in crate::vehicle) fn fits(&self, count: usize) -> bool {
        self.on.is_sorted_by(|a, b| a < b) && self.on.last().is_none_or(|last| (*last as usize) < count)
    }
}

impl VehicleManager {
    /// Turns the siren of an emergency vehicle on or off: its driver hurries, or does not any more. False if there is none of that
    /// number.
    pub(crate) fn switch_siren(
        &mut self,
        tracks: &Tracks,
        config: &TrafficConfig,
        id: u32,
        is_on: bool,
    ) -> bool {
        let Some((track, ..)) = self.find(tracks, id) else { return false };
        if self.sirens.is_on(id) != is_on {
            let (queue, _) = self.both_mut(tracks, track);
            for vehicle in queue.iter_mut().filter(|vehicle| vehicle.id == id) {
                let share = config.vehicle_type(vehicle.row).speed_factor as f32;
                vehicle.factor *= if is_on { share } else { 1.0 / share };
            }
            self.sirens.switch(id, is_on);
        }
        true
    }

    /// Looks where the sirens are, before a step.
    pub(in crate::vehicle) fn hear_sirens(&mut self, tracks: &Tracks) {
        self.sirens.stretches.clear();
        self.sirens.ways.clear();
        if self.sirens.on.is_empty() {
            return;
        }
        let mut sirens = std::mem::take(&mut self.sirens);
        sirens.on.retain(|id| {
            let track = self.whereabouts.get(*id as usize);
            if track == NONE {
                return true; // off the road, where nobody has to make way
            }
            let queue = self.queue(tracks, track);
            let Some(rank) = queue.iter().position(|vehicle| vehicle.id == *id) else { return false };
            let (vehicle, to_end) = (&queue[rank], tracks.length[track as usize] - queue[rank].s);
            let is_lane = tracks.connection(track).is_none();
            if is_lane {
                let (from, to) = (vehicle.s, vehicle.s + HEARD);
                sirens.stretches.push(Stretch { lane: track, from, to });
            }
            let Some(way) = tracks.ways.get(vehicle.next as usize) else { return true };
            if to_end < HEARD {
                sirens.stretches.push(Stretch { lane: way.to, from: -1.0, to: HEARD - to_end });
            }
            // Who stands before it has to go first: then nobody waits for it in vain.
            let is_next = rank == 0 || queue[rank - 1].holding == queue[rank - 1].next;
            let is_about_to = vehicle.stood < IN_VAIN && to_end < (KEEPS_FREE * vehicle.v).max(NEAR);
            if is_lane && is_next && is_about_to {
                sirens.ways.push(vehicle.next);
            }
            true
        });
        self.sirens = sirens;
    }
}

/// Whether a vehicle with its siren on, so far before its stop line, may go on at red.
pub(in crate::vehicle) fn may_pass_red(scene: &Scene<'_>, vehicle: &Vehicle, distance: f64) -> bool {
    let crossed = &scene.tracks.network.connections[vehicle.next as usize].conflicts;
    vehicle.v <= SLOW && distance < SEES && !crossed.iter().any(|other| scene.junctions.is_held(other.0))
}

/// Whether a vehicle that enters a way now passes a red light with its siren on.
pub(in crate::vehicle) fn passes_red(scene: &Scene<'_>, vehicle: &Vehicle, way: u32) -> bool {
    scene.sirens.is_on(vehicle.id)
        && scene
            .tracks
            .ways
            .get(way as usize)
            .is_some_and(|way| way.signal != NONE && scene.sight.aspects[way.signal as usize] == Aspect::Red)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn switches_are_kept_in_order() {
        let mut sirens = Sirens::default();
        for (id, is_on) in [(5, true), (2, true), (9, true), (5, true), (2, false), (7, false)] {
            sirens.switch(id, is_on);
        }
        assert_eq!(sirens.on(), [5, 9]);
        assert!(sirens.is_on(9) && !sirens.is_on(2));
        assert!(sirens.fits(10) && !sirens.fits(9));
    }
}
