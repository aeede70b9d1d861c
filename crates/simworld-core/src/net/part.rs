//! Parts of plans: some streets with their nodes, numbered by themselves.

use super::StreetPlan;

/// Some streets of a plan as a plan of their own, which knows their numbers in the whole.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanPart {
    /// The streets and their nodes, without names.
    pub plan: StreetPlan,
    /// The number in the whole of each of its streets, ascending.
    pub streets: Vec<usize>,
    /// The number in the whole of each of its nodes, ascending.
    pub nodes: Vec<usize>,
}

impl StreetPlan {
    /// Some streets of a plan, in the order of their numbers, with the nodes at their ends; numbers of streets that are not
    /// there are left out.
    ///
    /// ```
    /// use simworld_core::net::StreetPlan;
    /// let part = StreetPlan::grid(3, 3, 100.0).part([7, 2]);
    /// assert_eq!(part.streets, [2, 7]);
    /// assert_eq!(part.plan.nodes.len(), part.nodes.len());
    /// ```
    pub fn part(&self, streets: impl IntoIterator<Item = usize>) -> PlanPart {
        let mut streets: Vec<usize> =
            streets.into_iter().filter(|street| *street < self.streets.len()).collect();
        streets.sort_unstable();
        streets.dedup();
        let ends = |street: &usize| [self.streets[*street].from, self.streets[*street].to];
        let mut nodes: Vec<usize> =
            streets.iter().flat_map(ends).filter(|node| *node < self.nodes.len()).collect();
        nodes.sort_unstable();
        nodes.dedup();
        let mut plan = Self {
            nodes: nodes.iter().map(|node| self.nodes[*node]).collect(),
            sections: Vec::new(),
            driving_side: self.driving_side,
            ..Self::default()
        };
        if !self.elevations.is_empty() {
            plan.elevations = nodes.iter().map(|node| self.elevation(*node)).collect();
        }
        for (local, node) in nodes.iter().enumerate() {
            plan.controls.extend(self.controls.get(node).map(|control| (local, *control)));
        }
        let mut sections: Vec<u32> = Vec::new();
        for street in &streets {
            let mut street = self.streets[*street].clone();
            let known = sections.iter().position(|known| *known == street.section);
            let section = known.or_else(|| {
                plan.sections.push(self.sections.get(street.section as usize)?.clone());
                sections.push(street.section);
                Some(sections.len() - 1)
            });
            // What is not there stays so: the plan is no better than the whole.
            let local = |node: usize| nodes.binary_search(&node).unwrap_or(usize::MAX);
            (street.from, street.to) = (local(street.from), local(street.to));
            street.section = section.map_or(u32::MAX, |section| section as u32);
            street.name = None;
            plan.streets.push(street);
        }
        PlanPart { plan, streets, nodes }
    }
}

impl PlanPart {
    /// The number that a node of the whole has here.
    pub fn node(&self, whole: usize) -> Option<usize> {
        self.nodes.binary_search(&whole).ok()
    }

    /// The number that a street of the whole has here.
    pub fn street(&self, whole: usize) -> Option<usize> {
        self.streets.binary_search(&whole).ok()
    }
}
