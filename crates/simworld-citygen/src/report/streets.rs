//! Street statistics after Boeing (2019, 2021): what tells a grid from a village.

use std::f64::consts::TAU;

use petgraph::unionfind::UnionFind;
use serde::{Deserialize, Serialize};
use simworld_core::geometry::{Point2, heading};
use simworld_core::net::{StreetPlan, polyline};
use simworld_core::ops;

/// Statistics of a street network. Junctions are nodes at which other than two streets meet; segments run between those.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct StreetStatistics {
    /// Streets of the plan.
    pub streets: usize,
    /// Connected parts; 1 for a sound city.
    pub components: usize,
    /// Junctions, dead ends included.
    pub junctions: usize,
    /// Streets a junction, dead ends included.
    pub mean_degree: f64,
    /// Share of dead ends among the junctions.
    pub dead_ends: f64,
    /// Share of junctions of three streets.
    pub three_way: f64,
    /// Share of junctions of four streets or more.
    pub four_way: f64,
    /// Median length of a segment, m.
    pub median_length: f64,
    /// Mean length of a segment, m.
    pub mean_length: f64,
    /// Length of all segments over the sum of the straight distances between their ends.
    pub circuity: f64,
    /// Orientation order: 1 for a perfect grid, 0 where streets run every way alike.
    ///
    /// `φ = 1 - ((H - 1.386) / (3.584 - 1.386))²` with the entropy `H` of the segments' bearings in 36 bins (Boeing 2019,
    /// Urban spatial order): a grid has its bearings in four bins, ln 4 = 1.386.
    pub orientation_order: f64,
    /// Junctions of three streets and more on a square kilometre of the convex hull.
    pub intersection_density: f64,
    /// Area of the convex hull, m².
    pub area: f64,
}

/// A chain of streets between two junctions.
#[derive(Clone, Copy, Debug)]
struct Segment {
    length: f64,
    straight: f64,
    bearing: f64,
}

impl StreetStatistics {
    /// The statistics of a plan.
    ///
    /// ```
    /// use simworld_citygen::StreetStatistics;
    /// use simworld_core::net::StreetPlan;
    /// let grid = StreetStatistics::of(&StreetPlan::grid(12, 12, 100.0));
    /// assert_eq!(grid.median_length, 100.0);
    /// assert!(grid.orientation_order > 0.95); // only its corners run askew
    /// assert!((grid.circuity - 1.0).abs() < 1e-2); // only the corners of the grid are bends
    /// ```
    pub fn of(plan: &StreetPlan) -> Self {
        let mut incident = vec![Vec::new(); plan.nodes.len()];
        let mut parts = UnionFind::<usize>::new(plan.nodes.len());
        for (index, street) in plan.streets.iter().enumerate() {
            incident[street.from].push(index);
            incident[street.to].push(index);
            parts.union(street.from, street.to);
        }
        let is_junction = |node: usize| incident[node].len() != 2 && !incident[node].is_empty();
        let degrees: Vec<usize> =
            (0..incident.len()).filter(|node| is_junction(*node)).map(|node| incident[node].len()).collect();
        let share = |wanted: &dyn Fn(usize) -> bool| {
            degrees.iter().filter(|degree| wanted(**degree)).count() as f64 / degrees.len().max(1) as f64
        };
        let segments = segments(plan, &incident);
        let mut lengths: Vec<f64> = segments.iter().map(|segment| segment.length).collect();
        lengths.sort_by(f64::total_cmp);
        // A chain that comes back to its beginning has no straight distance to compare with.
        let open = segments.iter().filter(|segment| segment.straight > 1.0);
        let (long, straight) =
            open.fold((0.0, 0.0), |(l, s), segment| (l + segment.length, s + segment.straight));
        let mut labels: Vec<usize> = (0..incident.len())
            .filter(|node| !incident[*node].is_empty())
            .map(|node| parts.find(node))
            .collect();
        labels.sort_unstable();
        labels.dedup();
        let area = hull_area(plan.nodes.clone());
        let crossings = degrees.iter().filter(|degree| **degree >= 3).count() as f64;
        Self {
            streets: plan.streets.len(),
            components: labels.len(),
            junctions: degrees.len(),
            mean_degree: degrees.iter().sum::<usize>() as f64 / degrees.len().max(1) as f64,
            dead_ends: share(&|degree| degree == 1),
            three_way: share(&|degree| degree == 3),
            four_way: share(&|degree| degree >= 4),
            median_length: lengths.get(lengths.len() / 2).copied().unwrap_or(0.0),
            mean_length: lengths.iter().sum::<f64>() / lengths.len().max(1) as f64,
            circuity: if straight > 0.0 { long / straight } else { 1.0 },
            orientation_order: orientation_order(&segments),
            intersection_density: if area > 0.0 { crossings / area * 1e6 } else { 0.0 },
            area,
        }
    }
}

/// Every chain of streets between junctions, once. Rings without a junction are no segments.
fn segments(plan: &StreetPlan, incident: &[Vec<usize>]) -> Vec<Segment> {
    let mut seen = vec![false; plan.streets.len()];
    let mut found = Vec::new();
    for start in (0..incident.len()).filter(|node| incident[*node].len() != 2) {
        for first in &incident[start] {
            if seen[*first] {
                continue;
            }
            let (mut street, mut node, mut length) = (*first, start, 0.0);
            loop {
                seen[street] = true;
                length += polyline::length(&plan.centerline(&plan.streets[street]));
                node = if plan.streets[street].from == node {
                    plan.streets[street].to
                } else {
                    plan.streets[street].from
                };
                let next = incident[node].iter().copied().find(|next| *next != street);
                match next.filter(|next| incident[node].len() == 2 && !seen[*next]) {
                    Some(next) => street = next,
                    None => break,
                }
            }
            let across = plan.nodes[node] - plan.nodes[start];
            found.push(Segment { length, straight: across.norm(), bearing: heading(&across) });
        }
    }
    found
}

fn orientation_order(segments: &[Segment]) -> f64 {
    const BINS: usize = 36;
    let mut counts = [0_usize; BINS];
    for segment in segments.iter().filter(|segment| segment.straight > 1.0) {
        // Both ways; bins are centred on multiples of ten degrees.
        for bearing in [segment.bearing, segment.bearing + TAU * 0.5] {
            let bin = (bearing / TAU * BINS as f64 + 0.5).floor().rem_euclid(BINS as f64);
            counts[bin as usize % BINS] += 1;
        }
    }
    let total = counts.iter().sum::<usize>() as f64;
    if total == 0.0 {
        return 0.0;
    }
    let entropy: f64 = counts
        .iter()
        .filter(|count| **count > 0)
        .map(|count| {
            let share = *count as f64 / total;
            -share * ops::ln(share)
        })
        .sum();
    let disorder = (entropy - 1.386) / (3.584 - 1.386);
    (1.0 - disorder * disorder.abs()).clamp(0.0, 1.0)
}

/// Area of the convex hull by Andrew's monotone chain (1979), m².
fn hull_area(mut points: Vec<Point2>) -> f64 {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let half = |points: &mut dyn Iterator<Item = Point2>| {
        let mut chain: Vec<Point2> = Vec::new();
        for point in points {
            while let [.., a, b] = chain[..] {
                if (b - a).perp(&(point - b)) > 0.0 {
                    break;
                }
                chain.pop();
            }
            chain.push(point);
        }
        chain
    };
    let mut hull = half(&mut points.iter().copied());
    let upper = half(&mut points.iter().rev().copied());
    hull.pop();
    hull.extend(upper);
    hull.windows(2).map(|pair| pair[0].coords.perp(&pair[1].coords)).sum::<f64>() * 0.5
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hull_has_the_area_of_its_corners() {
        let mut points: Vec<Point2> =
            [(0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (0.0, 3.0)].map(|(x, y)| Point2::new(x, y)).to_vec();
        points.push(Point2::new(2.0, 1.0));
        assert!((hull_area(points) - 12.0).abs() < 1e-12);
    }

    #[test]
    fn bends_are_no_junctions() {
        let mut plan = StreetPlan::crossroads(100.0);
        // The eastern arm goes on to the north: one segment with a bend.
        plan.nodes.push(Point2::new(100.0, 100.0));
        plan.streets.push(simworld_core::net::Street::simple(1, 5));
        let found = StreetStatistics::of(&plan);
        assert_eq!((found.junctions, found.streets, found.components), (5, 5, 1));
        assert_eq!((found.dead_ends, found.four_way), (0.8, 0.2));
        // Three arms of 100 m, one of 200 m whose ends are 141.4 m apart.
        assert!((found.mean_length - 125.0).abs() < 1e-9);
        assert!((found.circuity - 500.0 / (300.0 + 141.421_356)).abs() < 1e-6);
    }
}
