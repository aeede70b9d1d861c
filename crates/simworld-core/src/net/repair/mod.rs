//! Repair: after a change of a plan only what it touches of a network is derived anew.
//!
//! What is derived at a junction follows from the streets that meet there and from those that meet at their other ends.
//! So a small plan of the streets round the change is derived, and what it says of the junctions and streets that changed
//! is put in the place of what was there. Numbers stay as they are but for those that come last, which take the numbers of
//! what is gone: every array stays without gaps. The result is, but for the numbers of lanes, connections, sidewalks,
//! crossings and signals, what [`RoadNetwork::derive`] makes of the whole plan.

mod books;
mod patch;
mod put;
mod work;

pub use patch::{NetworkPatch, PatchError};

use super::{NetworkConfig, NetworkError, RoadNetwork, StreetPlan};
use work::Repair;

/// How a plan differs from the one that a network was derived from. Streets and nodes beyond those that the network has are
/// new.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PlanChange {
    /// Streets that were taken out, one after another: each time the last one got the number.
    pub streets_removed: Vec<usize>,
    /// Nodes that were taken out after them, likewise.
    pub nodes_removed: Vec<usize>,
    /// Streets that are other ones than before under their new numbers: another course, other ends, another cross-section.
    pub streets_changed: Vec<usize>,
    /// Nodes that moved, or are controlled otherwise, under their new numbers.
    pub nodes_changed: Vec<usize>,
}

impl RoadNetwork {
    /// Follows a change of the plan that the network was derived from. The time grows with the change, not with the network.
    ///
    /// Gives the patch that takes the change back.
    ///
    /// ```
    /// use simworld_core::net::{NetworkConfig, PlanChange, RoadNetwork, StreetPlan};
    /// let mut plan = StreetPlan::crossroads(100.0);
    /// let config = NetworkConfig::default();
    /// let mut network = RoadNetwork::derive(&plan, &config)?;
    /// let before = network.clone();
    /// // The western arm goes, with its outer node; the last of both get their numbers.
    /// plan.streets.swap_remove(2);
    /// plan.nodes.swap_remove(3);
    /// plan.streets[2].to = 3;
    /// let change = PlanChange { streets_removed: vec![2], nodes_removed: vec![3], ..PlanChange::default() };
    /// let back = network.repair(&plan, &config, &change)?;
    /// assert_eq!(network.crossings.len(), 3);
    /// network.put(back)?;
    /// assert_eq!(network, before);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// A setting out of range, a street that cannot be built, or a change that is not one of this network; then the network
    /// is as it was.
    pub fn repair(
        &mut self,
        plan: &StreetPlan,
        config: &NetworkConfig,
        change: &PlanChange,
    ) -> Result<NetworkPatch, NetworkError> {
        config.validate()?;
        change.check(self, plan)?;
        let groups = self.signal_groups();
        let mut repair = Repair::open(self, plan, config);
        let done = repair.carry_out(change, groups);
        let back = repair.books.close();
        match done {
            Ok(()) => Ok(back),
            Err(error) => {
                // What was just written down fits what it was written down from.
                self.put(back).expect("a patch fits the network that it was made from");
                Err(error)
            }
        }
    }
}

impl PlanChange {
    /// Whether it leads from a network to a plan.
    fn check(&self, network: &RoadNetwork, plan: &StreetPlan) -> Result<(), NetworkError> {
        let fault = |reason: String| Err(NetworkError::Change { reason });
        let streets = network.roads.len().saturating_sub(self.streets_removed.len());
        let nodes = network.intersections.len().saturating_sub(self.nodes_removed.len());
        if plan.streets.len() < streets || plan.nodes.len() < nodes {
            return fault(format!(
                "{streets} streets and {nodes} nodes are left, but the plan has {} and {}",
                plan.streets.len(),
                plan.nodes.len()
            ));
        }
        let removals = [
            (&self.streets_removed, network.roads.len()),
            (&self.nodes_removed, network.intersections.len()),
        ];
        for (removed, count) in removals {
            if let Some((_, gone)) = (0..).zip(removed).find(|(step, gone)| **gone + step >= count) {
                return fault(format!("{gone} of {count} is taken out, and there is none"));
            }
        }
        let changed = [(&self.streets_changed, streets), (&self.nodes_changed, nodes)];
        if let Some(index) =
            changed.iter().find_map(|(list, count)| list.iter().find(|index| *index >= count))
        {
            return fault(format!("{index} changed, and there is none before the new ones"));
        }
        let joined = self.streets_changed.iter().copied().chain(streets..plan.streets.len());
        let lost = |index: &usize| {
            let street = &plan.streets[*index];
            street.from.max(street.to) >= plan.nodes.len()
        };
        match joined.into_iter().find(lost) {
            Some(street) => fault(format!("street {street} joins nodes that are not there")),
            None => Ok(()),
        }
    }
}
