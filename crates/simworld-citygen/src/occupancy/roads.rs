//! The land of the roads.

use std::collections::BTreeSet;
use std::f64::consts::FRAC_PI_4;

use simworld_core::geometry::{Point2, Vector2, direction};
use simworld_core::id::{IntersectionId, RoadId};
use simworld_core::net::{Intersection, RoadNetwork, Side};

use super::Occupancy;

/// Longest strip of road land, m: shorter ones touch fewer cells in vain.
const LONGEST_STRIP: f64 = 40.0;

impl Occupancy {
    /// The land that roads take: carriageways, sidewalks and the walkways round corners.
    pub fn of_roads(network: &RoadNetwork) -> Self {
        Self::of_roads_where(network, |_| true)
    }

    /// The land that some of the roads take: those on the ground, and the junctions at their ends.
    pub(crate) fn of_roads_where(network: &RoadNetwork, counts: impl Fn(RoadId) -> bool) -> Self {
        let meets =
            |id: IntersectionId| network.intersections[id.index()].roads.iter().any(|road| counts(*road));
        Self::of_parts(network, &counts, meets)
    }

    /// The land that some of the roads and some of the junctions take.
    pub(crate) fn of_parts(
        network: &RoadNetwork,
        roads: impl Fn(RoadId) -> bool,
        junctions: impl Fn(IntersectionId) -> bool,
    ) -> Self {
        let wanted: Vec<RoadId> =
            (0..network.roads.len()).map(RoadId::from_index).filter(|road| roads(*road)).collect();
        // A bent street is some twenty strips.
        let mut taken = Self::with_land(wanted.len() * 16);
        for road in wanted {
            taken.add_road(network, road);
        }
        for (index, intersection) in network.intersections.iter().enumerate() {
            if junctions(IntersectionId::from_index(index)) {
                taken.add_junction(network, intersection);
            }
        }
        taken
    }

    /// The land that a few roads of a large network take, with the junctions at their ends.
    pub(crate) fn of_few_roads(network: &RoadNetwork, roads: &BTreeSet<usize>) -> Self {
        let mut taken = Self::default();
        let mut junctions = BTreeSet::new();
        for road in roads {
            taken.add_road(network, RoadId::from_index(*road));
            junctions.extend([network.roads[*road].from, network.roads[*road].to]);
        }
        for junction in junctions {
            taken.add_junction(network, &network.intersections[junction.index()]);
        }
        taken
    }

    /// Takes the land of a road: from the outer edge of a sidewalk to the centreline, or from kerb to kerb.
    fn add_road(&mut self, network: &RoadNetwork, id: RoadId) {
        let road = &network.roads[id.index()];
        let (left, right) = (network.sidewalk(id, Side::Left), network.sidewalk(id, Side::Right));
        for (sidewalk, kerb, sign) in [(left, road.left_kerb, 1.0), (right, road.right_kerb, -1.0)] {
            if let Some(sidewalk) = sidewalk {
                let (out, into) = (sidewalk.width * 0.5, sidewalk.width * 0.5 + kerb.max(0.0));
                let sides = if sign > 0.0 { (out, into) } else { (into, out) };
                self.add_path(&sidewalk.path, sides);
            } else {
                let sides = if sign > 0.0 { (kerb, 0.0) } else { (0.0, kerb) };
                self.add_path(&road.centerline, sides);
            }
        }
    }

    /// Takes the turning circle or hammerhead and the walkways round the corners of an intersection.
    fn add_junction(&mut self, network: &RoadNetwork, intersection: &Intersection) {
        if let Some(circle) = intersection.turning {
            let corner =
                |eighth: u32| circle.center + direction(f64::from(eighth) * FRAC_PI_4) * circle.radius;
            self.add(&[0, 1, 2, 3, 4, 5, 6, 7].map(corner));
        }
        if let Some(head) = intersection.hammerhead {
            self.add_path(&head.tips, (head.width * 0.5, head.width * 0.5));
        }
        for corner in &intersection.corners {
            let half = intersection_walk(network, &intersection.roads) * 0.5;
            self.add_path(corner, (half, half));
        }
    }

    /// Takes a strip along a path, so far to its left and to its right.
    pub(crate) fn add_path(&mut self, path: &[Point2], (left, right): (f64, f64)) {
        for pair in path.windows(2) {
            let along = pair[1] - pair[0];
            let length = along.norm();
            if length < 1e-3 || left + right <= 1e-3 {
                continue;
            }
            let across = Vector2::new(-along.y, along.x) / length;
            let count = if length > LONGEST_STRIP { (length / LONGEST_STRIP).ceil() } else { 1.0 };
            for step in 0..count as u32 {
                let at = |share: f64| pair[0] + along * (share / count);
                let (start, end) = (at(f64::from(step)), at(f64::from(step) + 1.0));
                // Across the street first: by that side most of what is near turns out to be beside it.
                self.add(&[
                    end - across * right,
                    end + across * left,
                    start + across * left,
                    start - across * right,
                ]);
            }
        }
    }
}

/// Width of the walkways round the corners of an intersection, m: that of the narrowest sidewalk that meets there.
pub(crate) fn intersection_walk(network: &RoadNetwork, roads: &[RoadId]) -> f64 {
    let sides =
        roads.iter().flat_map(|road| [Side::Left, Side::Right].map(|side| network.sidewalk(*road, side)));
    let least = sides.flatten().map(|sidewalk| sidewalk.width).fold(f64::INFINITY, f64::min);
    if least.is_finite() { least } else { 0.0 }
}
