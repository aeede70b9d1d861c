//! The course of a repair.

use std::collections::BTreeSet;

use super::PlanChange;
use super::books::Books;
use crate::id::{IntersectionId, RoadId};
use crate::net::{NetworkConfig, NetworkError, PlanPart, RoadNetwork, StreetPlan, derive};

/// A repair under way.
pub(super) struct Repair<'a> {
    pub(super) books: Books<'a>,
    pub(super) plan: &'a StreetPlan,
    pub(super) config: &'a NetworkConfig,
    /// Nodes that have other streets than before, or lie elsewhere.
    pub(super) stirred: BTreeSet<usize>,
}

/// What surrounds the change, derived.
pub(super) struct Surroundings {
    pub(super) part: PlanPart,
    pub(super) network: RoadNetwork,
}

impl<'a> Repair<'a> {
    pub(super) fn open(
        network: &'a mut RoadNetwork,
        plan: &'a StreetPlan,
        config: &'a NetworkConfig,
    ) -> Self {
        Self { books: Books::open(network), plan, config, stirred: BTreeSet::new() }
    }

    /// `groups` is the number of signal groups before.
    pub(super) fn carry_out(&mut self, change: &PlanChange, groups: usize) -> Result<(), NetworkError> {
        self.take_apart(change)?;
        self.attach(change);
        let derived = self.derive()?;
        self.put_in(&derived, groups);
        self.books.close_gaps();
        Ok(())
    }

    /// Takes apart what is gone or will be derived anew.
    fn take_apart(&mut self, change: &PlanChange) -> Result<(), NetworkError> {
        for street in &change.streets_removed {
            self.clear(*street);
            let road = self.books.roads.get(*street);
            self.stirred.extend([road.from.index(), road.to.index()]);
            self.books.detach_road(*street);
            self.books.remove_road(*street);
        }
        // Streets have the numbers of the plan now, nodes not yet.
        for street in &change.streets_changed {
            self.clear(*street);
            let road = self.books.roads.get(*street);
            self.stirred.extend([road.from.index(), road.to.index()]);
            self.books.detach_road(*street);
        }
        for node in &change.nodes_removed {
            let last = self.books.intersections.len() - 1;
            if !self.books.intersections.get(*node).roads.is_empty() {
                return Err(NetworkError::Change {
                    reason: format!("node {node} is taken out, but has streets"),
                });
            }
            self.books.clear_intersection(*node);
            self.books.remove_intersection(*node);
            self.stirred.remove(node);
            if self.stirred.remove(&last) {
                self.stirred.insert(*node);
            }
        }
        self.stirred.extend(&change.nodes_changed);
        Ok(())
    }

    /// Clears a road and the intersections at its ends.
    fn clear(&mut self, street: usize) {
        let road = self.books.roads.get(street);
        for end in [road.from.index(), road.to.index()] {
            self.books.clear_intersection(end);
        }
        self.books.clear_road(street);
    }

    /// Joins new and changed streets to their nodes, and clears the surroundings of all nodes that were stirred.
    fn attach(&mut self, change: &PlanChange) {
        let plan = self.plan;
        let nodes = self.books.intersections.len();
        for node in nodes..plan.nodes.len() {
            self.books.intersections.push(derive::alone(plan, node, self.config));
            self.stirred.insert(node);
        }
        let roads = self.books.roads.len();
        for street in &plan.streets[roads..] {
            self.books.roads.push(derive::road(plan, street));
        }
        for index in change.streets_changed.iter().copied().chain(roads..plan.streets.len()) {
            let street = &plan.streets[index];
            for end in [street.from, street.to] {
                self.books.intersections.edit(end).roads.push(RoadId::from_index(index));
                self.stirred.insert(end);
            }
            let road = self.books.roads.edit(index);
            (road.from, road.to) =
                (IntersectionId::from_index(street.from), IntersectionId::from_index(street.to));
        }
        for name in &plan.names[self.books.names.len().min(plan.names.len())..] {
            self.books.names.push(name.clone());
        }
        // The streets of a node that moved leave their other ends in another direction.
        let moved: BTreeSet<usize> = change.nodes_changed.iter().copied().collect();
        self.stirred.extend(self.ends_of(&self.streets_at(&moved)));
        for node in self.touched() {
            self.books.clear_intersection(node);
        }
        for street in self.streets_at(&self.stirred) {
            self.books.clear_road(street);
        }
    }

    /// The streets that meet at some nodes.
    pub(super) fn streets_at(&self, nodes: &BTreeSet<usize>) -> BTreeSet<usize> {
        let roads = nodes.iter().flat_map(|node| &self.books.intersections.get(*node).roads);
        roads.map(|road| road.index()).collect()
    }

    /// The nodes at the ends of some streets.
    fn ends_of(&self, streets: &BTreeSet<usize>) -> BTreeSet<usize> {
        let ends = streets.iter().flat_map(|street| {
            let road = self.books.roads.get(*street);
            [road.from.index(), road.to.index()]
        });
        ends.collect()
    }

    /// The nodes that were stirred and their neighbours: how far a junction reaches into a street depends on the other end.
    pub(super) fn touched(&self) -> BTreeSet<usize> {
        let mut touched = self.ends_of(&self.streets_at(&self.stirred));
        touched.extend(&self.stirred);
        touched
    }

    /// Derives the surroundings of what was stirred, so far out that its own junctions come out as in the whole.
    fn derive(&self) -> Result<Surroundings, NetworkError> {
        let mut nodes = self.touched();
        nodes.extend(self.ends_of(&self.streets_at(&nodes)));
        let part = self.plan.part(self.streets_at(&nodes));
        let (streets, nodes) = (&part.streets, &part.nodes);
        let network = RoadNetwork::derive(&part.plan, self.config).map_err(|error| match error {
            NetworkError::Street { street, reason } => {
                NetworkError::Street { street: streets[street], reason }
            }
            NetworkError::Node { node, x, y } => NetworkError::Node { node: nodes[node], x, y },
            NetworkError::Elevation { node, height } => NetworkError::Elevation { node: nodes[node], height },
            other => other,
        })?;
        Ok(Surroundings { part, network })
    }
}
