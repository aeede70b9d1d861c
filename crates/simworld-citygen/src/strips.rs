//! Flat strips along straight pieces of line, and the strips of streets.

use simworld_core::geometry::{Obb, Point2, Point3, Vector2, Vector3, heading, pose_facing};
use simworld_core::net::{LaneKind, Road, Strip, polyline};

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

/// Length of a parking bay along the kerb, m: 20 feet (NACTO Urban Street Design Guide 2013).
const BAY: f64 = 6.0;
/// Narrower medians are paved, m: nothing grows on a barrier.
const PLANTED: f64 = 1.8;

/// Whether grass grows on a strip.
pub(crate) fn is_planted(strip: &Strip) -> bool {
    match strip.kind {
        LaneKind::Verge => true,
        LaneKind::Median => strip.width >= PLANTED,
        _ => false,
    }
}

/// The lines between the bays of a parking strip, each across it.
pub(crate) fn bays(road: &Road, strip: &Strip) -> Vec<[Point2; 2]> {
    let (from, to) = strip.stations;
    let count = ((to - from) / BAY).floor().max(0.0);
    let start = from + (to - from - count * BAY) * 0.5;
    let across = |station: f64| {
        let (point, along) = polyline::at(&road.centerline, station);
        let left = Vector2::new(-simworld_core::ops::sin(along), simworld_core::ops::cos(along));
        [strip.offset - strip.width * 0.5, strip.offset + strip.width * 0.5]
            .map(|offset| point + left * offset)
    };
    (0..=count as u32).map(|bay| across(start + f64::from(bay) * BAY)).collect()
}
