//! What everybody sees in a step: the frozen state of all, and what they may ask of it.

use simworld_core::net::Aspect;
use simworld_core::seed::Stream;

use super::clock::Moment;
use super::driving::idm::Driver;
use super::driving::passing::Passings;
use super::driving::sirens::Sirens;
use super::foreign::controls::Controls;
use super::junctions::clusters::Permit;
use super::junctions::junction::Junctions;
use super::junctions::trailing::Trail;
use super::manager::{NONE, Vehicle};
use super::part::Transfer;
use super::queues::path::Path;
use super::queues::storage::Storage;
use super::queues::tail::Tail;
use super::queues::tally::Tally;
use super::tracks::closures::Closures;
use super::tracks::layout::Place;
use super::tracks::{Obstacle, Track, Tracks};
use super::trips::entry::route_way;
use super::trips::halts::Halts;
use crate::{Route, TrafficConfig};

/// What drivers see of people and signals.
#[derive(Clone, Copy)]
pub(crate) struct Sight<'a> {
    pub(crate) aspects: &'a [Aspect],
    /// How long each group has shown its aspect, s.
    pub(crate) shown: &'a [f64],
    /// People on each crossing.
    pub(crate) walkers: &'a [u32],
    /// People at the kerb of each crossing who may walk.
    pub(crate) waiting: &'a [u32],
    /// Bodies on tracks that are not the traffic's own, by track and near side.
    pub(crate) obstacles: &'a [Obstacle],
}

/// What every part sees in a phase.
#[derive(Clone, Copy)]
pub(crate) struct Scene<'a> {
    pub(crate) tracks: &'a Tracks,
    pub(crate) config: &'a TrafficConfig,
    pub(crate) sight: Sight<'a>,
    pub(crate) streams: Stream,
    pub(crate) at: Moment,
    pub(crate) routes: &'a [Route],
    /// Those of them that lead off the map, ascending.
    pub(crate) off: &'a [u32],
    pub(crate) junctions: &'a Junctions,
    pub(crate) storage: &'a Storage,
    /// Those whose rear is on a way that they hold beside another.
    pub(crate) trails: &'a [Trail],
    /// Who may enter short lanes between junctions.
    pub(crate) permits: &'a [Permit],
    pub(crate) whereabouts: &'a Tally,
    /// The last vehicle of each lane, by part and number in the part.
    pub(crate) tails: &'a [Vec<Tail>],
    /// Those in a lock who may enter their junction without room behind it, ascending.
    pub(crate) passes: &'a [u32],
    /// What is closed, and where vehicles are to halt.
    pub(crate) closures: &'a Closures,
    pub(crate) halts: &'a Halts,
    /// Who is driven by somebody else, and the settings that bind them.
    pub(crate) controls: &'a Controls,
    pub(crate) hasty: &'a TrafficConfig,
    /// The drivers of each type, and those whom somebody else drives.
    pub(crate) drivers: &'a [Driver],
    pub(crate) hasty_drivers: &'a [Driver],
    /// Where drivers hear a siren.
    pub(crate) sirens: &'a Sirens,
    /// Who passes what stands on a lane.
    pub(crate) passings: &'a Passings,
    /// Who was handed over, by the part that they left and the part that they enter.
    pub(crate) handed: &'a [Vec<Vec<Transfer>>],
}

impl Scene<'_> {
    /// The last vehicle of a lane, anywhere.
    #[inline]
    pub(crate) fn tail(&self, lane: Track) -> &Tail {
        self.tail_at(self.tracks.layout.place(lane))
    }

    /// The same by where the lane is kept.
    #[inline]
    pub(super) fn tail_at(&self, place: Place) -> &Tail {
        &self.tails[place.part as usize][place.local as usize]
    }

    /// A number that is random in [0, 1) for each vehicle and step, of a purpose.
    pub(super) fn draw(&self, purpose: &str, id: u32) -> f64 {
        let stream = self.streams.named(purpose).indexed(u64::from(id)).indexed(self.at.step);
        // The key of a stream is a hash of its path: as good a draw as the first of its generator, and cheaper.
        (stream.seed().0 >> 11) as f64 * (1.0 / (1_u64 << 53) as f64)
    }

    /// What a signal group shows; green where there is none.
    #[inline]
    pub(crate) fn aspect(&self, group: u32) -> Aspect {
        if group == NONE { Aspect::Green } else { self.sight.aspects[group as usize] }
    }

    /// The way on from a lane: that of the route, or one drawn at random.
    pub(crate) fn choose(
        &self,
        weights: &mut Vec<f64>,
        vehicle: &Vehicle,
        path: &mut Path,
        lane: Track,
    ) -> u32 {
        let kind = self.config.vehicle_type(vehicle.row).kind;
        if let Some(route) = self.routes.get(path.route as usize) {
            return route_way(self.tracks, self.closures, route, path, lane, kind);
        }
        path.decisions += 1;
        let mut rng = self.streams.indexed(u64::from(vehicle.id)).indexed(u64::from(path.decisions)).rng();
        let ways = self.tracks.weighted_ways(lane, (kind, vehicle.length()), &self.config.turns, weights);
        let is_shut = |way: usize| self.closures.bars(self.tracks, ways[way].index());
        for (way, weight) in weights.iter_mut().enumerate().filter(|_| !self.closures.is_empty()) {
            *weight *= f64::from(u8::from(!is_shut(way)));
        }
        // If every way has weight zero, the first that is open is as good as any.
        let open = || (0..ways.len()).find(|way| !is_shut(*way));
        rng.weighted(weights).or_else(open).map_or(NONE, |way| ways[way].0)
    }
}
