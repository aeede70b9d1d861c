//! The paved areas of the junctions of real places: every outline is a simple polygon of positive area, by an exact
//! test, and lies where its streets are. A spike, a hole or a bow tie fails.
#![cfg(feature = "osm")]

use crate::osm_common::all_real;
use robust::{Coord, orient2d};
use simworld_citygen::osm::StreetOptions;
use simworld_core::geometry::Point2;
use simworld_core::net::{Intersection, NetworkConfig, RoadNetwork, polyline};

/// Positive if `c` lies to the left of the line from `a` to `b`; the sign is exact.
fn side(a: Point2, b: Point2, c: Point2) -> f64 {
    let coord = |point: Point2| Coord { x: point.x, y: point.y };
    orient2d(coord(a), coord(b), coord(c))
}

/// Whether two segments have a point in common.
fn touch(a: Point2, b: Point2, c: Point2, d: Point2) -> bool {
    let within = |p: Point2, q: Point2, r: Point2| {
        side(p, q, r) == 0.0
            && p.x.min(q.x) <= r.x
            && r.x <= p.x.max(q.x)
            && p.y.min(q.y) <= r.y
            && r.y <= p.y.max(q.y)
    };
    let parts = |p, q, r, s| (side(p, q, r) > 0.0) != (side(p, q, s) > 0.0);
    let is_proper =
        [side(a, b, c), side(a, b, d), side(c, d, a), side(c, d, b)].iter().all(|side| *side != 0.0);
    (is_proper && parts(a, b, c, d) && parts(c, d, a, b))
        || within(a, b, c)
        || within(a, b, d)
        || within(c, d, a)
        || within(c, d, b)
}

/// What is wrong with an outline, if anything.
fn fault(junction: &Intersection, network: &RoadNetwork) -> Option<String> {
    let mut ring = junction.outline.clone();
    ring.dedup_by(|a, b| (*a - *b).norm() < 1e-6);
    while ring.len() > 1 && (ring[0] - ring[ring.len() - 1]).norm() < 1e-6 {
        ring.pop();
    }
    let count = ring.len();
    if count < 3 {
        return Some(format!("{count} corners"));
    }
    let edge = |index: usize| (ring[index], ring[(index + 1) % count]);
    for a in 0..count {
        let last = if a == 0 { count - 1 } else { count };
        for b in a + 2..last {
            let ((p, q), (r, s)) = (edge(a), edge(b));
            if touch(p, q, r, s) {
                return Some(format!("edges {a} and {b} of {count} touch near {p}"));
            }
        }
    }
    let doubled: f64 = (0..count).map(|index| (ring[index] - ring[0]).perp(&(edge(index).1 - ring[0]))).sum();
    if doubled <= 0.0 {
        return Some(format!("area {}", doubled * 0.5));
    }
    // Each corner lies within the streets' widths of the streets themselves: nothing sticks out.
    let near = |corner: &Point2| {
        junction.roads.iter().any(|road| {
            let road = &network.roads[road.index()];
            let away =
                polyline::closest(&road.centerline, corner).map_or(f64::INFINITY, |near| near.distance);
            away <= road.left_kerb.max(road.right_kerb) * 1.5 + 3.0
        })
    };
    ring.iter().find(|corner| !near(corner)).map(|corner| format!("a spike at {corner}"))
}

#[test]
fn no_outline_crosses_itself() {
    for (file, place) in all_real() {
        let (plan, _) = place.plan(&StreetOptions::default());
        let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).unwrap();
        let junctions = network.intersections.iter().filter(|place| place.roads.len() >= 2);
        let faults: Vec<String> = junctions
            .filter_map(|junction| {
                let fault = fault(junction, &network)?;
                Some(format!("{} legs at {:.0}: {fault}", junction.roads.len(), junction.center))
            })
            .collect();
        assert!(
            faults.is_empty(),
            "{file}: {} of {}: {faults:#?}",
            faults.len(),
            network.intersections.len()
        );
    }
}
