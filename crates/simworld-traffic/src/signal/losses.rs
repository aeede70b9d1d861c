//! Time lost before stop lines: who has lost how much within the range of a detector.

use serde::{Deserialize, Serialize};
use simworld_core::hash::StateHasher;

use super::DelayDetector;
use crate::vehicle::Vehicle;

/// The time that vehicles have lost within the range of detectors, s.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Losses {
    /// By number of the vehicle, ascending; of those alone that are within range.
    lost: Vec<(u32, f64)>,
    /// Those of this step, as they are seen.
    #[serde(skip)]
    seen: Vec<(u32, f64)>,
    /// By group the detector, where the policy looks for them; empty if it does so nowhere.
    #[serde(skip)]
    detectors: Vec<Option<DelayDetector>>,
    #[serde(skip)]
    pub(super) delayed: Vec<f64>,
    #[serde(skip)]
    pub(super) in_range: Vec<u32>,
}

impl Losses {
    /// Looks with these detectors, by group.
    pub(crate) fn set_detectors(&mut self, detectors: Vec<Option<DelayDetector>>) {
        self.detectors = if detectors.iter().all(Option::is_none) { Vec::new() } else { detectors };
    }

    /// Tells of nobody.
    pub(super) fn rest(&mut self, groups: usize) {
        self.delayed.clear();
        self.delayed.resize(groups, f64::INFINITY);
        self.in_range.clear();
        self.in_range.resize(groups, 0);
    }

    pub(super) fn begin(&mut self) {
        self.seen.clear();
    }

    /// Takes note of a vehicle that heads for a group on a lane of that length, m, and speed limit, m/s.
    #[inline]
    pub(super) fn see(&mut self, group: usize, vehicle: &Vehicle, (end, limit): (f64, f64), dt: f64) {
        let Some(DelayDetector { range, least }) = self.detectors.get(group).copied().flatten() else {
            return;
        };
        let ahead = end - vehicle.s;
        if ahead > range {
            return;
        }
        let known = self.lost.binary_search_by_key(&vehicle.id, |lost| lost.0);
        let before = known.map_or(0.0, |place| self.lost[place].1);
        let lost = before + (1.0 - vehicle.v / limit).max(0.0) * dt;
        self.seen.push((vehicle.id, lost));
        self.in_range[group] += 1;
        if lost > least {
            self.delayed[group] = self.delayed[group].min(ahead.max(0.0) / limit);
        }
    }

    /// Who has not been seen has left.
    pub(super) fn end(&mut self) {
        self.seen.sort_unstable_by_key(|lost| lost.0);
        std::mem::swap(&mut self.lost, &mut self.seen);
    }

    pub(super) fn state_hash(&self, hasher: &mut StateHasher) {
        for (id, lost) in &self.lost {
            hasher.u64(u64::from(*id)).f64(*lost);
        }
    }

    /// Whether a saved state can be one.
    pub(super) fn is_sound(&self) -> bool {
        self.lost.is_sorted_by(|a, b| a.0 < b.0) && self.lost.iter().all(|lost| lost.1.is_finite())
    }
}
