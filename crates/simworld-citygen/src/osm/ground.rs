//! What is driven on, where something of the map might stand on it.

use simworld_core::geometry::Point2;
use simworld_core::net::RoadNetwork;

use super::mask::Mask;
use crate::occupancy::Occupancy;

/// Half the width that a car needs on its lane, m. What stands beside that stands: maps are not that exact.
const HALF_CAR: f64 = 0.8;
/// The strips that cars drive on at the level of the ground, where the mask says that they matter.
pub(super) fn carriageways(network: &RoadNetwork, off_ground: &[bool], mask: &Mask) -> Occupancy {
    let mut taken = Occupancy::default();
    let mut add = |path: &[Point2]| {
        for pair in path.windows(2) {
            if mask.touches(pair, 2.0 * HALF_CAR) && (pair[1] - pair[0]).norm() > 0.01 {
                taken.add_box(&crate::strips::strip(pair[0], pair[1], HALF_CAR, HALF_CAR, 0.0));
            }
        }
    };
    let on_ground = |lane: usize| !off_ground[network.lanes[lane].road.index()];
    for lane in network.lanes.iter().filter(|lane| !off_ground[lane.road.index()]) {
        add(&lane.path);
    }
    for way in &network.connections {
        if on_ground(way.from.index()) && on_ground(way.to.index()) && mask.touches(&way.path, 2.0 * HALF_CAR)
        {
            add(&way.path);
        }
    }
    taken
}

#[cfg(test)]
mod tests {
    use simworld_core::geometry::Vector2;
    use simworld_core::net::{NetworkConfig, StreetPlan};

    use super::*;

    #[test]
    fn strips_are_missing_only_where_nothing_was_marked() {
        let plan = StreetPlan::grid(4, 4, 130.0);
        let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).unwrap();
        let on_ground = vec![false; plan.streets.len()];
        let square = |at: Point2| {
            [(0.0, 0.0), (3.0, 0.0), (3.0, 3.0), (0.0, 3.0)].map(|(x, y)| at + Vector2::new(x, y))
        };
        let mut everything = Mask::new();
        everything.mark(&[Point2::new(-1e6, 0.0), Point2::new(1e6, 0.0)], 0.0);
        let all = carriageways(&network, &on_ground, &everything);
        let places: Vec<[Point2; 4]> = (0..400)
            .map(|index| square(Point2::new(f64::from(index % 20) * 20.0, f64::from(index / 20) * 20.0)))
            .collect();
        let mut some = Mask::new();
        places.iter().step_by(7).for_each(|place| some.mark(place, 0.0));
        let few = carriageways(&network, &on_ground, &some);
        assert!(few.len() < all.len() && !few.is_empty(), "{} of {}", few.len(), all.len());
        let taken = places.iter().step_by(7).filter(|place| !all.is_free(*place)).count();
        assert!(taken > 5);
        assert!(places.iter().step_by(7).all(|place| all.is_free(place) == few.is_free(place)));
    }
}
