//! Actuated control: why greens end.

use std::sync::{Arc, Mutex, PoisonError};

use simworld_core::net::{RoadNetwork, StreetPlan};
use simworld_core::seed::Seed;

use super::streets::{derive, empty};
use super::{Effort, Figure, Figures};
use crate::signal::{Actuated, JunctionView, SignalPolicy};
use crate::{Traffic, TrafficConfig};

const DT: f64 = 0.1;

/// What was seen of the greens.
#[derive(Clone, Copy, Debug, Default)]
struct Seen {
    ended: u32,
    /// Ended before the least green, or while vehicles kept coming before the longest.
    early: u32,
    /// Steps in which a green went on beyond the longest, or beyond the gap, though others waited.
    late: u32,
    by_gap: u32,
}

/// Watches what a policy decides.
struct Watched(Actuated, Arc<Mutex<Seen>>);

impl SignalPolicy for Watched {
    fn next_stage(&mut self, junction: &JunctionView<'_>) -> usize {
        let Self(policy, seen) = self;
        let next = policy.next_stage(junction);
        let groups = &junction.stages[junction.current].green;
        let gap = groups.iter().map(|group| junction.demand.gap[group.index()]).fold(f64::INFINITY, f64::min);
        let has_gap = gap > policy.longest_gap;
        let others = (0..junction.stages.len()).filter(|stage| *stage != junction.current);
        let is_wanted = others.into_iter().any(|stage| junction.demand_of(stage) > 0);
        let at_most = junction.elapsed + 1e-6 >= policy.longest_green;
        let mut seen = seen.lock().unwrap_or_else(PoisonError::into_inner);
        if next == junction.current {
            let over = junction.elapsed >= policy.longest_green + DT
                || (junction.elapsed >= policy.least_green + DT && has_gap);
            seen.late += u32::from(over && is_wanted);
        } else {
            seen.ended += 1;
            seen.by_gap += u32::from(!at_most);
            let is_early =
                junction.elapsed + 1e-6 < policy.least_green || (!has_gap && !at_most) || !is_wanted;
            seen.early += u32::from(is_early);
        }
        next
    }
}

fn grid() -> Result<Arc<RoadNetwork>, super::ValidationError> {
    Ok(Arc::new(derive(&StreetPlan::grid(3, 3, 120.0))?))
}

pub(super) fn measure(effort: Effort) -> Figures {
    let seen = Arc::new(Mutex::new(Seen::default()));
    let config = TrafficConfig { vehicles: 50, pedestrians: 40, ..empty() };
    let mut traffic = Traffic::new(grid()?, &config, Seed(2))?;
    traffic.set_policy(Box::new(Watched(Actuated::default(), Arc::clone(&seen))));
    for _ in 0..effort.pick(6_000, 36_000) {
        traffic.step(DT);
    }
    let seen = *seen.lock().unwrap_or_else(PoisonError::into_inner);
    let source = "SUMO's documented example: least green 5 s, longest 45 s, max-gap 3 s";
    Ok(vec![
        Figure::within("greens that ended", f64::from(seen.ended), (100.0, f64::INFINITY), ""),
        Figure::within(
            "share of them that ended on a gap",
            f64::from(seen.by_gap) / f64::from(seen.ended),
            (0.5, 1.0),
            "",
        ),
        Figure::within("greens that ended too early", f64::from(seen.early), (0.0, 0.0), "")
            .cited(source)
            .stated(),
        Figure::within("steps of green beyond gap or longest", f64::from(seen.late), (0.0, 0.0), "")
            .cited(source)
            .stated(),
    ])
}
