//! What is saved of vehicles: whether it is sound, and what of it is hashed.

use simworld_core::hash::StateHasher;

use super::manager::{EXIT, NONE, VehicleManager};
use super::part::Part;
use super::tracks::Tracks;
use super::tracks::layout::PartLayout;

impl VehicleManager {
    /// Whether a saved state is one of this network.
    pub(crate) fn fits(&self, tracks: &Tracks, types: usize) -> bool {
        let ways = tracks.ways.len();
        let is_way = |way: u32| way >= EXIT || (way as usize) < ways;
        let is_route = |route: u32| route == NONE || (route as usize) < self.routes.len();
        let count = self.numbers();
        let is_part = |(part, layout): (&Part, &PartLayout)| part.fits(layout);
        self.parts.len() == tracks.layout.parts.len()
            && self.parts.iter().zip(&tracks.layout.parts).all(is_part)
            && self.junctions.fits(tracks)
            && self.storage.len() == tracks.lanes
            && self.trails_fit(tracks)
            && self.permits_fit()
            && self.whereabouts.iter().all(|track| track == NONE || (track as usize) < tracks.count())
            && self.routes.iter().all(|route| route.validate(&tracks.network).is_ok())
            && self.off.is_sorted()
            && self.off.last().is_none_or(|route| (*route as usize) < self.routes.len())
            && self.passes.is_sorted()
            && self.closures.fits(tracks)
            && self.halts.fits(tracks, count)
            && self.controls.fits(
                tracks,
                types,
                self.routes.len(),
                &self.whereabouts.iter().collect::<Vec<_>>(),
            )
            && self.rounds.fits(tracks, count)
            && self.delays.fits(tracks)
            && self.detours.fits(count, self.routes.len())
            && self.sirens.fits(count)
            && self.passings.fits(tracks, count)
            && self.free.iter().all(|id| (*id as usize) < count)
            && self.iter(tracks).all(|(track, v, path)| {
                (v.id as usize) < count
                    && usize::from(v.row) < types
                    && v.length > 0.0
                    && v.factor > 0.0
                    && !v.halt.is_nan()
                    && self.whereabouts.get(v.id as usize) == track
                    && is_way(v.next)
                    && is_way(v.holding)
                    && v.s.is_finite()
                    && v.shift.is_finite()
                    && v.v.is_finite()
                    && v.acceleration.is_finite()
                    && (path.before as usize) < tracks.count()
                    && is_route(path.route)
            })
    }

    pub(crate) fn state_hash(&self, tracks: &Tracks, hasher: &mut StateHasher) {
        for (track, vehicle, _) in self.iter(tracks) {
            hasher.u64(u64::from(track));
            hasher.u64(u64::from(vehicle.id)).f64(vehicle.s).f64(vehicle.v).f64(vehicle.stood);
            hasher.u64(u64::from(vehicle.next)).u64(u64::from(vehicle.holding)).f64(f64::from(vehicle.shift));
            hasher.u64(u64::from(vehicle.granted));
        }
        let waiting = self.parts.iter().enumerate().filter(|(_, part)| part.clock.waited() > 0.0);
        waiting.for_each(|(number, part)| _ = hasher.u64(number as u64).f64(part.clock.waited()));
        self.controls.state_hash(hasher);
        self.rounds.state_hash(hasher);
        self.passings.state_hash(hasher);
    }
}
