//! Quickest routes by a contraction hierarchy (Geisberger and others 2008), for those who ask for many.

use simworld_core::net::{Hierarchy, HierarchyScratch, RoadNetwork, WeightedEdge};

use super::{Leg, Route, Router};

/// Weights are whole numbers, so that sums do not depend on their order: microseconds.
const UNITS: f64 = 1e6;

/// A network prepared for many routes. They are as quick as those of [`Router::quickest`], to within a microsecond a leg;
/// of several that are equally quick it may take another.
///
/// ```
/// use simworld_core::id::RoadId;
/// use simworld_core::net::{LaneDirection, NetworkConfig, RoadNetwork, StreetPlan};
/// use simworld_traffic::{Leg, LegHierarchy, LegScratch};
/// let network = RoadNetwork::derive(&StreetPlan::crossroads(100.0), &NetworkConfig::default())?;
/// let hierarchy = LegHierarchy::new(&network);
/// let (from, to) = (Leg::new(RoadId(0), LaneDirection::Backward), Leg::new(RoadId(2), LaneDirection::Forward));
/// let route = hierarchy.quickest(from, to, &mut LegScratch::default()).expect("the arms meet");
/// assert_eq!(route.0, [from, to]);
/// # Ok::<(), simworld_core::net::NetworkError>(())
/// ```
#[derive(Clone, Debug)]
pub struct LegHierarchy {
    /// Every pair of legs that follow one another.
    edges: Vec<WeightedEdge>,
    hierarchy: Hierarchy,
}

/// The memory of searches in a hierarchy, kept by the caller.
pub type LegScratch = HierarchyScratch;

impl LegHierarchy {
    /// Prepares a network. The same network gives the same hierarchy; 10 000 legs take a second or two.
    pub fn new(network: &RoadNetwork) -> Self {
        let router = Router::new(network);
        let weighed = |(from, to, time): (Leg, Leg, f64)| WeightedEdge {
            from: from.0,
            to: to.0,
            weight: ((time * UNITS).round() as u64).max(1),
        };
        let edges: Vec<WeightedEdge> = router.pairs().map(weighed).collect();
        let hierarchy = Hierarchy::new(network.roads.len() * 2, &edges);
        Self { edges, hierarchy }
    }

    /// The quickest route from one leg to another, both included; `None` if there is none.
    pub fn quickest(&self, from: Leg, to: Leg, scratch: &mut LegScratch) -> Option<Route> {
        self.hierarchy.shortest(&[(from.0, 0)], &[(to.0, 0)], scratch)?;
        let path = scratch.edges();
        let mut legs = Vec::with_capacity(path.len() + 1);
        legs.push(from);
        legs.extend(path.iter().map(|edge| Leg(self.edges[*edge as usize].to)));
        Some(Route(legs))
    }
}
