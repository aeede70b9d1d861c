//! Signals: stages that follow one another safely, policies that choose among them, and what detectors see.
//!
//! A policy says which stage comes next; the controller alone lets it come, through the pedestrian clearance, the
//! yellow and the all-red of the plan. No policy can therefore show two conflicting greens or a green cut short.

mod actuated;
mod by_hand;
mod controller;
mod detect;
mod fixed;
mod losses;
mod max_pressure;
mod self_organizing;
mod stage;

pub use actuated::Actuated;
pub(crate) use by_hand::{ByHand, check as check_timing};
pub use controller::StageShown;
pub(crate) use controller::{Controllers, IntersectionManager};
pub(crate) use detect::Detectors;
pub use fixed::{FixedTime, Webster, green_wave};
pub use max_pressure::MaxPressure;
pub use self_organizing::SelfOrganizing;
use simworld_core::net::SignalPlan;
#[cfg(feature = "sumo")]
pub(crate) use stage::branching;
pub use stage::{Branches, Exit, Stage};

/// What detectors tell, by signal group: index with [`SignalGroup::index`](simworld_core::net::SignalGroup::index).
#[derive(Clone, Copy, Debug)]
pub struct Demand<'a> {
    /// Vehicles that stand or approach within 50 m of the stop line.
    pub approaching: &'a [u32],
    /// Those of them that stand.
    pub queued: &'a [u32],
    /// Time since a vehicle passed the advance detector, two seconds before the stop line, s; zero while one is over it.
    pub gap: &'a [f64],
    /// Vehicles that want to pass, less those that stand in their way behind the junction, each as a share of the lane.
    pub pressure: &'a [f64],
    /// Pedestrians at the kerbs that the group governs.
    pub waiting: &'a [u32],
    /// Time that vehicles have approached or stood since the group last showed green, summed over them, s.
    pub waited: &'a [f64],
    /// Time that pedestrians have stood at its kerbs since then, summed over them, s.
    pub kerb: &'a [f64],
    /// Time since the group last showed green, s; zero while it does.
    pub since_green: &'a [f64],
    /// How soon a vehicle that has lost time could be at the stop line at the speed limit, s, the nearest of them; infinite without
    /// one, and where the policy [looks for none](SignalPolicy::delays).
    pub delayed: &'a [f64],
    /// Vehicles within the range in which it looks for them.
    pub in_range: &'a [u32],
}

/// Looks for vehicles that have lost time before the stop lines of a signal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DelayDetector {
    /// It sees so far from the stop line on the lane that ends there, m.
    pub range: f64,
    /// Who has lost more than this within its range has lost time, s: driving at a share of the speed limit loses the rest.
    pub least: f64,
}

/// One signalised intersection at the moment of a decision.
#[derive(Clone, Copy, Debug)]
pub struct JunctionView<'a> {
    /// Its plan, with the phases beside it that the policy brings.
    pub plan: &'a SignalPlan,
    /// Its stages, at least one.
    pub stages: &'a [Stage],
    /// The stage that shows green.
    pub current: usize,
    /// How long it has shown green, s: at least its least green.
    pub elapsed: f64,
    /// Time since the start of the simulation, s.
    pub seconds: f64,
    /// What detectors tell of the whole network.
    pub demand: Demand<'a>,
}

impl JunctionView<'_> {
    /// The stage that usually follows the current one: the next in the order of the plan, or by the first of its ways on.
    pub fn successor(&self) -> usize {
        stage::successor(self.stages, self.current)
    }

    /// Vehicles and people who want a stage.
    pub fn demand_of(&self, stage: usize) -> u32 {
        let groups = &self.stages[stage].green;
        groups
            .iter()
            .map(|group| {
                let index = group.index();
                self.demand.approaching[index] + self.demand.waiting[index]
            })
            .sum()
    }
}

/// Chooses the stages of signalised intersections.
///
/// # Implementing it
///
/// A policy is asked at every step at which the current stage may end, and answers with the stage to show next; the
/// current one goes on. One that always serves those who are most:
///
/// ```
/// use std::sync::Arc;
/// use simworld_core::net::{NetworkConfig, RoadNetwork, StreetPlan};
/// use simworld_core::seed::Seed;
/// use simworld_traffic::{Traffic, TrafficConfig};
/// use simworld_traffic::signal::{JunctionView, SignalPolicy};
///
/// struct Most;
///
/// impl SignalPolicy for Most {
///     fn next_stage(&mut self, junction: &JunctionView<'_>) -> usize {
///         let most = (0..junction.stages.len()).max_by_key(|stage| junction.demand_of(*stage));
///         most.filter(|_| junction.elapsed >= 10.0).unwrap_or(junction.current)
///     }
/// }
///
/// let network = Arc::new(RoadNetwork::derive(&StreetPlan::crossroads(100.0), &NetworkConfig::default())?);
/// let mut traffic = Traffic::new(network, &TrafficConfig::default(), Seed(1))?;
/// traffic.set_policy(Box::new(Most));
/// for _ in 0..600 { traffic.step(0.1); }
/// assert!(traffic.counters().crossings > 5);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait SignalPolicy {
    /// The stage to show next, an index into [`JunctionView::stages`]; one out of range counts as the current one.
    ///
    /// A policy without memory survives a snapshot as it is: what it sees of time and demand is saved.
    fn next_stage(&mut self, junction: &JunctionView<'_>) -> usize;

    /// Whether it looks at [`JunctionView::demand`], as most do. Detectors rest under a policy that does not: they tell it of
    /// nobody.
    fn watches(&self) -> bool {
        true
    }

    /// Ways on from the phases of a plan that do not merely follow one another; none, unless the policy brings some. It is asked once for
    /// every plan, when the policy or the plans are set, and then answers with stages to which the current one has an
    /// [exit](Stage::exits) or ways lead from there.
    fn branches(&self, _plan: &SignalPlan) -> Option<Branches> {
        None
    }

    /// The detector by which it looks for vehicles that have lost time; none, unless it wants one. It is asked once for every plan,
    /// when the policy or the plans are set.
    fn delays(&self, _plan: &SignalPlan) -> Option<DelayDetector> {
        None
    }

    /// For how long it would surely answer with the current stage again, s: so long it is not asked. None, unless it knows better.
    fn keeps(&self, _junction: &JunctionView<'_>) -> f64 {
        0.0
    }
}
