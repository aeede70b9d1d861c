//! Heights of junctions from which no street is too steep.
//!
//! With the steepest grade times the length of each street as its weight, heights are allowed where they differ by no more
//! than the shortest way between any two junctions. The highest such heights nowhere above the land, and the lowest nowhere
//! below it, are known in closed form, `min` and `max` over all junctions of `height ± way` (`McShane` 1934, Whitney 1934),
//! and one run of Dijkstra's algorithm from all junctions at once finds each. Their mean is allowed too, and takes from the
//! hills about what the valleys need. Where the land is gentle all three are the land itself.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use simworld_core::geometry::Point2;
use simworld_core::lists::Lists;
use simworld_core::net::{Street, StreetPlan, polyline};

use super::{HeightField, TerrainConfig};

/// So little is kept from the limit against rounding.
const KEPT: f64 = 1.0 - 1e-9;

/// Heights of the nodes of a plan, m: those of the land, changed where a street would be steeper than its class allows.
///
/// ```
/// use simworld_citygen::terrain::{Raster, TerrainConfig, elevations};
/// use simworld_core::{geometry::Point2, net::StreetPlan};
/// // A bank of 30 m on a street of 100 m: 15 % is all that it may climb.
/// let bank = Raster::new(Point2::origin(), 100.0, 2, vec![0.0, 30.0, 0.0, 30.0])?;
/// let mut plan = StreetPlan::default();
/// plan.nodes = vec![Point2::new(0.0, 0.0), Point2::new(100.0, 0.0)];
/// plan.streets = vec![simworld_core::net::Street::simple(0, 1)];
/// let heights = elevations(&plan, &bank, &TerrainConfig::default());
/// assert!((heights[0] - 7.5).abs() < 1e-6 && (heights[1] - 22.5).abs() < 1e-6);
/// # Ok::<(), simworld_citygen::terrain::RasterError>(())
/// ```
pub fn elevations(plan: &StreetPlan, land: &dyn HeightField, config: &TerrainConfig) -> Vec<f64> {
    let ways = Ways::of(plan, config);
    let heights: Vec<f64> = plan.nodes.iter().map(|node: &Point2| land.height(*node)).collect();
    let highest_below = ways.envelope(heights.clone());
    let lowest_above = ways.envelope(heights.iter().map(|height| -height).collect());
    highest_below.iter().zip(lowest_above).map(|(below, above)| (below - above) * 0.5).collect()
}

/// The streets at every node: the node at the other end of each, and the most that it may lie higher or lower, m.
struct Ways(Lists<(usize, f64)>);

/// A height that waits to be spread; ordered by height, then by node.
#[derive(PartialEq)]
struct Waiting(f64, usize);

impl Eq for Waiting {}

impl Ord for Waiting {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.0.total_cmp(&other.0).then(self.1.cmp(&other.1))
    }
}

impl PartialOrd for Waiting {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ways {
    fn of(plan: &StreetPlan, config: &TerrainConfig) -> Self {
        let rise =
            |street: &Street| config.grade(street.class) * polyline::length(&plan.centerline(street)) * KEPT;
        let rises: Vec<f64> = plan.streets.iter().map(rise).collect();
        let ends = plan.streets.iter().zip(&rises).flat_map(|(street, rise)| {
            [(street.from, (street.to, *rise)), (street.to, (street.from, *rise))]
        });
        Self(Lists::of(plan.nodes.len(), ends))
    }

    /// For every node the least of all heights plus the way from where they are.
    fn envelope(&self, mut heights: Vec<f64>) -> Vec<f64> {
        let mut queue: BinaryHeap<Reverse<Waiting>> =
            heights.iter().enumerate().map(|(node, height)| Reverse(Waiting(*height, node))).collect();
        while let Some(Reverse(Waiting(height, node))) = queue.pop() {
            if height > heights[node] {
                continue;
            }
            for (there, rise) in &self.0[node] {
                if height + rise < heights[*there] {
                    heights[*there] = height + rise;
                    queue.push(Reverse(Waiting(heights[*there], *there)));
                }
            }
        }
        heights
    }
}
