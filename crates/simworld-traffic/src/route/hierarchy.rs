//! Quickest routes by a contraction hierarchy (Geisberger and others 2008), for those who ask for many.

use fast_paths::{FastGraph, InputGraph, PathCalculator};

use simworld_core::geometry::Point2;
use simworld_core::id::RoadId;
use simworld_core::net::{LaneDirection, RoadNetwork, polyline};

use super::{Leg, Route, Router, dissection};

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
    /// How many legs there are; the last ones are unknown to the hierarchy if nothing leads to or from them.
    legs: usize,
    graph: FastGraph,
}

/// The memory of searches in a hierarchy, kept by the caller.
#[derive(Default)]
pub struct LegScratch {
    /// With the number of legs for which it was made.
    calculator: Option<(usize, PathCalculator)>,
}

impl std::fmt::Debug for LegScratch {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let legs = self.calculator.as_ref().map(|(legs, _)| legs);
        f.debug_struct("LegScratch").field("legs", &legs).finish_non_exhaustive()
    }
}

impl LegScratch {
    fn calculator(&mut self, legs: usize) -> &mut PathCalculator {
        let known = self.calculator.take().filter(|(made_for, _)| *made_for == legs);
        &mut self.calculator.insert(known.unwrap_or_else(|| (legs, PathCalculator::new(legs)))).1
    }
}

impl LegHierarchy {
    /// Prepares a network. The same network gives the same hierarchy; 10 000 legs take a second or two.
    pub fn new(network: &RoadNetwork) -> Self {
        let router = Router::new(network);
        let mut input = InputGraph::new();
        // A leg that leads to itself is on no quickest route.
        for (from, to, time) in router.edges().filter(|(from, to, _)| from != to) {
            let weight = ((time * UNITS).round() as usize).max(1);
            input.add_edge(from.0 as usize, to.0 as usize, weight);
        }
        input.freeze();
        let places: Vec<Point2> = (0..network.roads.len()).flat_map(|road| middles(network, road)).collect();
        let mut order = dissection::order(&router.graph, &places);
        order.retain(|leg| *leg < input.get_num_nodes());
        let graph = fast_paths::prepare_with_order(&input, &order).expect("the order has every leg once");
        Self { legs: places.len(), graph }
    }

    /// The quickest route from one leg to another, both included; `None` if there is none.
    pub fn quickest(&self, from: Leg, to: Leg, scratch: &mut LegScratch) -> Option<Route> {
        let ends = [from, to].map(|leg| leg.0 as usize);
        if ends.into_iter().any(|end| end >= self.legs) {
            return None;
        }
        if from == to {
            return Some(Route(vec![from]));
        }
        let known = self.graph.get_num_nodes();
        if ends.into_iter().any(|end| end >= known) {
            return None;
        }
        let path = scratch.calculator(known).calc_path(&self.graph, ends[0], ends[1])?;
        Some(Route(path.get_nodes().iter().map(|leg| Leg(*leg as u32)).collect()))
    }
}

/// The middle of each of a road's legs; of one without lanes, the origin.
fn middles(network: &RoadNetwork, road: usize) -> [Point2; 2] {
    [LaneDirection::Forward, LaneDirection::Backward].map(|direction| {
        let lanes = Leg::new(RoadId::from_index(road), direction).lanes(network);
        let lane = lanes.first().map(|lane| &network.lanes[lane.index()]);
        lane.map_or_else(Point2::origin, |lane| polyline::at(&lane.path, lane.length * 0.5).0)
    })
}
