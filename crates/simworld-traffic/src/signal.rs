//! The intersection manager: it deploys signals, and policies say what they show.

use simworld_core::net::{Aspect, RoadNetwork, SignalPlan};
use std::sync::Arc;

/// What a policy may look at: vehicles and people who want to cross.
#[derive(Clone, Copy, Debug)]
pub struct Demand<'a> {
    /// Vehicles that stand or approach within 50 m, by signal group.
    pub approaching: &'a [u32],
    /// Pedestrians at the kerb of each crossing, by crossing.
    pub waiting: &'a [u32],
}

/// Decides what the signals of one intersection show.
///
/// # Implementing it
///
/// A policy that keeps everybody waiting at night, and follows the plan by day:
///
/// ```
/// use std::sync::Arc;
/// use simworld_core::net::{Aspect, NetworkConfig, RoadNetwork, SignalPlan, StreetPlan};
/// use simworld_core::seed::Seed;
/// use simworld_traffic::{Demand, FixedTime, SignalPolicy, Traffic, TrafficConfig};
///
/// struct Curfew;
///
/// impl SignalPolicy for Curfew {
///     fn decide(&mut self, plan: &SignalPlan, seconds: f64, demand: &Demand<'_>, aspects: &mut [Aspect]) {
///         if seconds < 60.0 {
///             aspects.fill(Aspect::Red);
///         } else {
///             FixedTime.decide(plan, seconds, demand, aspects);
///         }
///     }
/// }
///
/// let network = Arc::new(RoadNetwork::derive(&StreetPlan::crossroads(100.0), &NetworkConfig::default())?);
/// let mut traffic = Traffic::new(network, &TrafficConfig::default(), Seed(1))?;
/// traffic.set_policy(Box::new(Curfew));
/// for _ in 0..100 { traffic.step(0.1); }
/// assert!(traffic.signals().iter().all(|aspect| *aspect == Aspect::Red));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait SignalPolicy {
    /// Writes the aspects of the plan's groups, in the order of [`SignalPlan::groups`], `seconds` after the start.
    ///
    /// A policy without memory survives a snapshot as it is; one with memory keeps its own.
    fn decide(&mut self, plan: &SignalPlan, seconds: f64, demand: &Demand<'_>, aspects: &mut [Aspect]);
}

/// The plan's own phases, one after the other.
#[derive(Clone, Copy, Debug, Default)]
pub struct FixedTime;

impl SignalPolicy for FixedTime {
    fn decide(&mut self, plan: &SignalPlan, seconds: f64, _: &Demand<'_>, aspects: &mut [Aspect]) {
        let cycle = plan.cycle();
        let mut into = (seconds + plan.offset).rem_euclid(cycle);
        let current = plan.phases.iter().find(|phase| {
            let current = into < phase.duration;
            into -= phase.duration;
            current
        });
        // Rounding may leave nothing of the cycle: then the first phase begins again.
        let Some(phase) = current.or(plan.phases.first()) else { return };
        for (aspect, group) in aspects.iter_mut().zip(&plan.groups) {
            *aspect = phase.aspect(*group);
        }
    }
}

/// All signals of a network.
pub(crate) struct IntersectionManager {
    network: Arc<RoadNetwork>,
    policy: Box<dyn SignalPolicy + Send>,
    pub(crate) aspects: Vec<Aspect>,
}

impl IntersectionManager {
    pub(crate) fn new(network: Arc<RoadNetwork>) -> Self {
        let aspects = vec![Aspect::Red; network.signal_groups()];
        Self { network, policy: Box::new(FixedTime), aspects }
    }

    pub(crate) fn set_policy(&mut self, policy: Box<dyn SignalPolicy + Send>) {
        self.policy = policy;
    }

    pub(crate) fn step(&mut self, seconds: f64, demand: &Demand<'_>) {
        for plan in &self.network.signals {
            // Groups of a plan are numbered without gaps.
            let (Some(first), count) = (plan.groups.first(), plan.groups.len()) else { continue };
            let own = &mut self.aspects[first.index()..first.index() + count];
            self.policy.decide(plan, seconds, demand, own);
        }
    }
}
