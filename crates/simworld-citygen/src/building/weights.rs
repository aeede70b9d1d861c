//! How often each kind of building is tried, ready to be drawn from.

use simworld_core::seed::StreamRng;

use super::{ARCHETYPES, Archetype};
use crate::lot::Lot;
use crate::zoning::Zone;

/// Steps of the density for which weights are known beforehand.
const LEVELS: usize = 16;

/// Cumulative weights of the kinds, by zone and level of density.
pub(super) struct Weights(Vec<[f64; ARCHETYPES.len()]>);

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
        Self(rows)
    }

    /// A kind for a lot.
    pub(super) fn draw(&self, lot: &Lot, rng: &mut StreamRng) -> &'static Archetype {
        let level = ((lot.density * LEVELS as f64) as usize).min(LEVELS - 1);
        let sums = &self.0[lot.zone as usize * LEVELS + level];
        let drawn = rng.unit() * sums[ARCHETYPES.len() - 1];
        // Sums rise, so those that are passed are counted, all at a time.
        let passed = sums.iter().map(|sum| usize::from(*sum <= drawn)).sum::<usize>();
        &ARCHETYPES[passed.min(ARCHETYPES.len() - 1)]
    }
}
