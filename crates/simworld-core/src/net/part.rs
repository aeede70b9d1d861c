//! Parts of plans: some streets with their nodes, numbered by themselves.

use super::StreetPlan;

/// Some streets of a plan as a plan of their own, which knows their numbers in the whole.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanPart {
    /// The streets and their nodes, with the cross-sections and the names that they have.
    pub plan: StreetPlan,
    /// The number in the whole of each of its cross-sections.
    pub sections: Vec<u32>,
    /// The number in the whole of each of its names.
    pub names: Vec<u32>,
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
        let (mut sections, mut names) = (Vec::new(), Vec::new());
        for street in &streets {
            let mut street = self.streets[*street].clone();
            let section = number(&self.sections, street.section, &mut sections, &mut plan.sections);
            street.name = street.name.and_then(|name| number(&self.names, name, &mut names, &mut plan.names));
            // What is not there stays so: the plan is no better than the whole.
            let local = |node: usize| nodes.binary_search(&node).unwrap_or(usize::MAX);
            (street.from, street.to) = (local(street.from), local(street.to));
            street.section = section.unwrap_or(u32::MAX);
            plan.streets.push(street);
        }
        PlanPart { plan, sections, names, streets, nodes }
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

/// The number in a part of a thing of the whole; it is taken over when it is first asked for.
fn number<T: Clone>(all: &[T], whole: u32, known: &mut Vec<u32>, own: &mut Vec<T>) -> Option<u32> {
    if let Some(present) = known.iter().position(|other| *other == whole) {
        return Some(present as u32);
    }
    own.push(all.get(whole as usize)?.clone());
    known.push(whole);
    Some(known.len() as u32 - 1)
}
