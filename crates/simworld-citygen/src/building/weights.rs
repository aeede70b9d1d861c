//! How often each kind of building is tried, ready to be drawn from.

use simworld_core::scene::Place;
use simworld_core::seed::StreamRng;

use super::{ARCHETYPES, Archetype};
use crate::lot::Lot;
use crate::zoning::Zone;

/// Steps of the density for which weights are known beforehand.
const LEVELS: usize = 16;
/// Steps of sizes for which kinds are known beforehand, 1/m and how many.
const PER_METRE: f64 = 2.0;
const SIZES: usize = 64;

/// What kinds are drawn by.
pub(super) struct Weights {
    /// Cumulative weights of the kinds, by zone and level of density.
    sums: Vec<[f64; ARCHETYPES.len()]>,
    /// The kinds that fill gaps in each zone, a bit each.
    fillers: Vec<u32>,
    /// The kinds that may be as narrow as a room, and as shallow, by steps of its size; those of its own step among them.
    narrow: [u32; SIZES],
    shallow: [u32; SIZES],
}

impl Weights {
    pub(super) fn new() -> Self {
        let mut rows = Vec::with_capacity(Zone::ALL.len() * LEVELS);
        for zone in Zone::ALL {
            for level in 0..LEVELS {
                let density = (level as f64 + 0.5) / LEVELS as f64;
                let mut sum = 0.0;
                rows.push(std::array::from_fn(|kind| {
                    sum += ARCHETYPES[kind].weight(zone, density);
                    sum
                }));
            }
        }
        let is_filler = |zone: Zone, kind: &Archetype| {
            is_filler(kind.place) && (kind.weight(zone, 0.0) > 0.0 || kind.weight(zone, 1.0) > 0.0)
        };
        let fillers = Zone::ALL.iter().map(|zone| those(|kind| is_filler(*zone, kind)));
        let below = |size: usize| (size + 1) as f64 / PER_METRE;
        Self {
            sums: rows,
            fillers: fillers.collect(),
            narrow: std::array::from_fn(|size| those(|kind| size == SIZES - 1 || kind.width.0 < below(size))),
            shallow: std::array::from_fn(|size| {
                those(|kind| size == SIZES - 1 || kind.depth.0 < below(size))
            }),
        }
    }

    /// The kinds that may fill gaps on a lot in a room of that width and depth, beginning with one of a number or the next
    /// such; some of them may still be a little too large, or of no weight there.
    pub(super) fn fillers(
        &self,
        lot: &Lot,
        (width, depth): (f64, f64),
        first: usize,
    ) -> impl Iterator<Item = &'static Archetype> + use<> {
        let step = |size: f64| ((size * PER_METRE) as u32 as usize).min(SIZES - 1);
        let all = self.fillers[lot.zone as usize] & self.narrow[step(width)] & self.shallow[step(depth)];
        let behind = all & (u32::MAX << first);
        // Those before the first come after the last.
        let mut left = u64::from(behind) | u64::from(all ^ behind) << u32::BITS;
        std::iter::from_fn(move || {
            let bit = left.trailing_zeros();
            left &= left.wrapping_sub(1);
            ARCHETYPES.get((bit % u32::BITS) as usize).filter(|_| bit < u64::BITS)
        })
    }

    /// A kind for a lot.
    pub(super) fn draw(&self, lot: &Lot, rng: &mut StreamRng) -> &'static Archetype {
        let level = ((lot.density * LEVELS as f64) as u32 as usize).min(LEVELS - 1);
        let sums = &self.sums[lot.zone as usize * LEVELS + level];
        let drawn = rng.unit() * sums[ARCHETYPES.len() - 1];
        let passed = sums.partition_point(|sum| *sum <= drawn);
        &ARCHETYPES[passed.min(ARCHETYPES.len() - 1)]
    }
}

/// The kinds of which something holds, a bit each.
fn those(holds: impl Fn(&Archetype) -> bool) -> u32 {
    let kinds = ARCHETYPES.iter().enumerate().filter(|(_, kind)| holds(kind));
    kinds.fold(0, |all, (index, _)| all | 1 << index)
}

/// Whether a gap may be filled with such a place; large institutions are sampled, never fillers.
const fn is_filler(place: Place) -> bool {
    matches!(
        place,
        Place::Home | Place::Store | Place::Restaurant | Place::Office | Place::RestArea | Place::Factory
    )
}
