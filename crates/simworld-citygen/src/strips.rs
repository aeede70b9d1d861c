//! Flat strips along straight pieces of line.

use simworld_core::geometry::{Obb, Point2, Point3, Vector2, Vector3, heading, pose_facing};
use simworld_core::net::Road;

/// Height given to flat things so that they are boxes, m.
const FLAT: f64 = 1.0;

/// A flat rectangle along a piece of line, `left` and `right` m to its sides, `extend` m beyond its ends.
pub(crate) fn strip(a: Point2, b: Point2, left: f64, right: f64, extend: f64) -> Obb {
    let along = b - a;
    let yaw = heading(&along);
    let middle = nalgebra::center(&a, &b);
    let normal = Vector2::new(-simworld_core::ops::sin(yaw), simworld_core::ops::cos(yaw));
    let center = middle + normal * ((left - right) * 0.5);
    Obb {
        pose: pose_facing(Point3::new(center.x, center.y, 0.0), yaw),
        half_extents: Vector3::new(along.norm() * 0.5 + extend, (left + right) * 0.5, FLAT),
    }
}

/// How far the carriageway reaches to the wider side of the centreline, m.
pub(crate) fn lane_reach(road: &Road) -> f64 {
    road.left_kerb.max(road.right_kerb)
}
