//! The paved areas of the junctions of real places: every outline is a simple polygon of positive area, by an exact
//! test, and lies where its streets are. A spike, a hole or a bow tie fails. And streets of one level meet at junctions alone.
#![cfg(feature = "osm")]

use crate::osm_common::{Sketch, all_real};
use robust::{Coord, orient2d};
use simworld_citygen::osm::StreetOptions;
use simworld_core::geometry::{Point2, bounds};
use simworld_core::net::{Intersection, NetworkConfig, RoadNetwork, StreetPlan, polyline};

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

/// Pairs of streets of one level that cross elsewhere than at a node of both.
fn crossings(plan: &StreetPlan) -> Vec<(usize, usize)> {
    let mut courses: Vec<(usize, Vec<Point2>, (Point2, Point2))> = Vec::new();
    for (index, street) in plan.streets.iter().enumerate() {
        let course = plan.centerline(street);
        let box_of = bounds(&course).expect("a course has points");
        courses.push((index, course, box_of));
    }
    courses.sort_by(|a, b| a.2.0.x.total_cmp(&b.2.0.x));
    let mut found = Vec::new();
    for (rank, (index, course, (low, high))) in courses.iter().enumerate() {
        let street = &plan.streets[*index];
        let ahead = courses[rank + 1..].iter().take_while(|other| other.2.0.x <= high.x);
        let near = ahead.filter(|other| other.2.0.y <= high.y && other.2.1.y >= low.y);
        for (other, theirs, _) in near.filter(|other| plan.streets[other.0].level == street.level) {
            let ends = [street.from, street.to].into_iter();
            let (from, to) = (plan.streets[*other].from, plan.streets[*other].to);
            let common: Vec<Point2> =
                ends.filter(|node| [from, to].contains(node)).map(|node| plan.nodes[node]).collect();
            let crosses = |a: &[Point2], b: &[Point2]| {
                let met = polyline::crossing(a[0], a[1], b[0], b[1]);
                let at = met.map(|(along, _)| a[0] + (a[1] - a[0]) * along);
                at.is_some_and(|at| common.iter().all(|node| (node - at).norm() > 0.5))
            };
            if course.windows(2).any(|a| theirs.windows(2).any(|b| crosses(a, b))) {
                found.push((*index, *other));
            }
        }
    }
    found
}

#[test]
fn streets_cross_at_junctions_alone() {
    for (file, place) in all_real() {
        let (plan, _) = place.plan(&StreetOptions::default());
        let found = crossings(&plan);
        assert!(found.is_empty(), "{file}: {found:?} of {} streets cross", plan.streets.len());
    }
}

#[test]
fn a_street_is_not_spread_across_its_neighbour() {
    const ROAD: [(&str, &str); 1] = [("highway", "residential")];
    // Two streets leave 1 to the south, nearly side by side; the straight one meets a third in 2, again nearly side by side, and
    // gives way there to the side on which the other lies.
    let sketch = Sketch::default()
        .node(1, (0.0, 0.0), &[])
        .node(2, (1.0, -50.0), &[])
        .node(3, (-3.5, -20.0), &[])
        .node(4, (-4.0, -42.0), &[])
        .node(5, (-30.0, -120.0), &[])
        .node(6, (0.0, 80.0), &[])
        .node(7, (6.0, -25.0), &[])
        .node(8, (60.0, 40.0), &[])
        .node(9, (1.0, -130.0), &[])
        .way(&[1, 2], &ROAD)
        .way(&[1, 3, 4, 5], &ROAD)
        .way(&[6, 1], &ROAD)
        .way(&[2, 7, 8], &ROAD)
        .way(&[2, 9], &ROAD)
        .way(&[5, 9], &ROAD)
        .way(&[6, 8], &ROAD);
    let (plan, _) = sketch.place().plan(&StreetOptions::default());
    assert_eq!(crossings(&plan), []);
}
