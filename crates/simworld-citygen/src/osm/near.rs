//! Roads and junctions near the places that matter.

use simworld_core::geometry::Vector2;
use simworld_core::id::RoadId;
use simworld_core::net::{Intersection, Road, RoadNetwork, Sidewalk};

use super::mask::Mask;
use crate::occupancy::{Occupancy, intersection_walk};

/// For each road and junction, whether it matters.
pub(super) struct Near {
    pub(super) roads: Vec<bool>,
    pub(super) junctions: Vec<bool>,
}

impl Near {
    /// Of the roads that count, and of the junctions at which one of them ends, those whose land, and so much round it, m,
    /// touches a place that matters; some others may be among them.
    pub(super) fn of(
        network: &RoadNetwork,
        counts: impl Fn(RoadId) -> bool,
        mask: &Mask,
        beside: f64,
    ) -> Self {
        let is_near_road = |(index, road): (usize, &Road)| {
            counts(RoadId::from_index(index)) && touches_road(network, road, mask, beside)
        };
        let is_near_junction = |junction: &Intersection| {
            junction.roads.iter().any(|road| counts(*road))
                && touches_junction(network, junction, mask, beside)
        };
        Self {
            roads: network.roads.iter().enumerate().map(is_near_road).collect(),
            junctions: network.intersections.iter().map(is_near_junction).collect(),
        }
    }

    /// The land that they take.
    pub(super) fn land(&self, network: &RoadNetwork) -> Occupancy {
        Occupancy::of_parts(
            network,
            |road| self.roads[road.index()],
            |junction| self.junctions[junction.index()],
        )
    }
}

fn touches_road(network: &RoadNetwork, road: &Road, mask: &Mask, beside: f64) -> bool {
    // Round the outside of a bend the kerb is at most twice as far from the middle.
    let kerbs = 2.0 * road.left_kerb.max(road.right_kerb).max(0.0) + beside;
    let mut sidewalks = road.sidewalks.iter().flatten().map(|sidewalk| &network.sidewalks[sidewalk.index()]);
    mask.touches_path(&road.centerline, kerbs) || sidewalks.any(|walk| touches_walk(road, walk, mask, beside))
}

/// From the outer edge of a sidewalk to the middle of the road.
fn touches_walk(road: &Road, walk: &Sidewalk, mask: &Mask, beside: f64) -> bool {
    mask.touches_path(&walk.path, walk.width * 0.5 + road.left_kerb.max(road.right_kerb).max(0.0) + beside)
}

fn touches_junction(network: &RoadNetwork, junction: &Intersection, mask: &Mask, beside: f64) -> bool {
    let walk = intersection_walk(network, &junction.roads) * 0.5;
    let circle = junction.turning.map(|circle| {
        let out = Vector2::new(circle.radius, circle.radius);
        [circle.center - out, circle.center + out]
    });
    mask.touches(&junction.outline, beside)
        || junction.corners.iter().any(|corner| mask.touches_path(corner, walk + beside))
        || circle.is_some_and(|corners| mask.touches(&corners, beside))
        || junction.hammerhead.is_some_and(|head| mask.touches(&head.tips, head.width * 0.5 + beside))
}

#[cfg(test)]
mod tests {
    use simworld_core::geometry::Point2;
    use simworld_core::net::NetworkConfig;
    use simworld_core::seed::Seed;

    use super::*;
    use crate::Style;

    #[test]
    fn what_is_marked_meets_the_same_land_as_among_all_roads() {
        let mut plan = crate::growth::grow(&Style::Organic.roads(60), Seed(4));
        plan.make_turning_room();
        let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).unwrap();
        let everywhere = Occupancy::of_roads(&network);
        let mut rng = Seed(8).stream("near").rng();
        let middles: Vec<Point2> = network.intersections.iter().map(|junction| junction.center).collect();
        let (mut free, mut taken) = (0, 0);
        for _ in 0..60 {
            let at = middles[rng.below(middles.len())]
                + Vector2::new(rng.uniform(-40.0, 40.0), rng.uniform(-40.0, 40.0));
            let square =
                [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)].map(|(x, y)| at + Vector2::new(x, y));
            let mut mask = Mask::new();
            mask.mark(&square, 0.0);
            let near = Near::of(&network, |_| true, &mask, 0.0);
            assert!(near.roads.iter().filter(|is_near| **is_near).count() < network.roads.len() / 2);
            let is_free = near.land(&network).is_free(&square);
            assert_eq!(is_free, everywhere.is_free(&square), "at {at}");
            *(if is_free { &mut free } else { &mut taken }) += 1;
        }
        assert!(free > 10 && taken > 10, "{free} free, {taken} taken");
    }
}
