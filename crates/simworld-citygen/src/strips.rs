//! The land of the roads, as strips along straight pieces of line.

use simworld_core::geometry::{Obb, Point2, Point3, Vector3, heading, pose_facing};
use simworld_core::net::{Road, RoadNetwork};

use crate::occupancy::Occupancy;

/// Height given to flat things so that they are boxes, m.
const FLAT: f64 = 1.0;

/// A flat rectangle along a piece of line, `left` and `right` m to its sides, `extend` m beyond its ends.
pub(crate) fn strip(a: Point2, b: Point2, left: f64, right: f64, extend: f64) -> Obb {
    let along = b - a;
    let yaw = heading(&along);
    let middle = nalgebra::center(&a, &b);
    let normal = nalgebra::Vector2::new(-simworld_core::ops::sin(yaw), simworld_core::ops::cos(yaw));
    let center = middle + normal * ((left - right) * 0.5);
    Obb {
        pose: pose_facing(Point3::new(center.x, center.y, 0.0), yaw),
        half_extents: Vector3::new(along.norm() * 0.5 + extend, (left + right) * 0.5, FLAT),
    }
}

/// The land that roads take, sidewalks and corners included: one strip a straight piece of centreline, each as long
/// again as half its width beyond its ends.
pub(crate) fn road_land(network: &RoadNetwork) -> Occupancy {
    let mut taken = Occupancy::default();
    let walk = network.sidewalks.iter().map(|sidewalk| sidewalk.width).fold(0.0, f64::max);
    for road in &network.roads {
        // The wider side on both covers one-way roads, whose lanes lie on one side of the line.
        let reach = lane_reach(road) + walk;
        for piece in road.centerline.windows(2) {
            taken.add_box(&strip(piece[0], piece[1], reach, reach, reach));
        }
    }
    taken
}

/// How far the carriageway reaches to the wider side of the centreline, m.
pub(crate) fn lane_reach(road: &Road) -> f64 {
    road.left_kerb.max(road.right_kerb)
}
