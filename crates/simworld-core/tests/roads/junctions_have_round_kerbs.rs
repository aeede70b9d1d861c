//! Kerbs at corners are round, dead ends have room to turn, and the paved areas are simple polygons.

use proptest::prelude::*;
use simworld_core::geometry::{Point2, direction};
use simworld_core::id::IntersectionId;
use simworld_core::net::*;
use simworld_core::ops;

fn derived(plan: &StreetPlan) -> RoadNetwork {
    let network = RoadNetwork::derive(plan, &NetworkConfig::default()).unwrap();
    network.check().unwrap();
    network
}

/// A fault of a ring, in words; `None` if it is simple and goes counter-clockwise.
fn fault(ring: &[Point2]) -> Option<String> {
    let mut ring = ring.to_vec();
    ring.dedup_by(|a, b| (*a - *b).norm() < 1e-9);
    let count = ring.len();
    let edge = |index: usize| (ring[index % count], ring[(index + 1) % count]);
    for a in 0..count {
        for b in a + 2..count - usize::from(a == 0) {
            let ((p, q), (r, s)) = (edge(a), edge(b));
            if polyline::crossing(p, q, r, s).is_some() {
                return Some(format!("edges {a} and {b} of {count} cross: {ring:?}"));
            }
        }
    }
    let area: f64 = (0..count).map(|index| edge(index).0.coords.perp(&edge(index).1.coords)).sum();
    (area <= 0.0).then(|| format!("area {}", area * 0.5))
}

/// The least radius of a circle through three successive points, m.
fn tightest(path: &[Point2]) -> f64 {
    let turns = path.windows(3).map(|three| {
        let (before, after) = (three[1] - three[0], three[2] - three[1]);
        let angle = ops::atan2(before.perp(&after), before.dot(&after)).abs();
        (before.norm() + after.norm()) * 0.5 / angle.max(1e-12)
    });
    turns.fold(f64::INFINITY, f64::min)
}

#[test]
fn the_corner_of_two_streets_is_an_arc() {
    let network = derived(&StreetPlan::crossroads(100.0));
    let place = &network.intersections[0];
    for rank in 0..4 {
        let kerb = place.kerb(rank);
        assert!(tightest(kerb) > 2.8, "radius {}", tightest(kerb));
        // A sharp corner would lie 3.5 m from either centreline.
        let nearest = kerb.iter().map(|point| (point - place.center).norm()).fold(f64::INFINITY, f64::min);
        let expected = (6.5 * std::f64::consts::SQRT_2) - 3.0;
        assert!((nearest - expected).abs() < 0.1, "{nearest} for {expected}");
    }
    let whole: usize = (0..4).map(|rank| place.kerb(rank).len()).sum();
    assert_eq!(whole, place.outline.len());
    assert_eq!(fault(&place.outline), None);
}

#[test]
fn greater_streets_have_greater_radii() {
    let radius = |class: RoadClass| {
        let mut plan = StreetPlan::crossroads(100.0);
        plan.streets.iter_mut().for_each(|street| street.class = class);
        tightest(derived(&plan).intersections[0].kerb(0))
    };
    let [local, arterial, highway] = [RoadClass::Local, RoadClass::Arterial, RoadClass::Highway].map(radius);
    assert!((local - 3.0).abs() < 0.1 && (arterial - 4.5).abs() < 0.1 && (highway - 6.0).abs() < 0.1);
}

#[test]
fn a_kerb_turns_where_there_are_no_sidewalks() {
    let mut plan = StreetPlan::crossroads(100.0);
    plan.sections[0] = CrossSection::plain(1, 1, 3.5, 0.0);
    let network = derived(&plan);
    assert!((tightest(network.intersections[0].kerb(2)) - 3.0).abs() < 0.1);
}

/// A dead-end street of that length with a turning circle.
fn dead_end(length: f64, radius: f64, section: CrossSection) -> RoadNetwork {
    let mut plan = StreetPlan::crossroads(150.0);
    plan.streets[0].section = plan.add_section(section);
    plan.nodes[1] = Point2::new(length, 0.0);
    plan.streets[0].turning = [0.0, radius];
    derived(&plan)
}

#[test]
fn a_vehicle_turns_within_the_circle_of_a_dead_end() {
    for (radius, least) in [(CAR_TURNING, 6.4), (LORRY_TURNING, 10.0)] {
        let network = dead_end(100.0, radius, CrossSection::two_way(1, 1));
        let place = &network.intersections[1];
        assert_eq!(fault(&place.outline), None);
        let [way] = place.connections.as_slice() else { panic!("{:?}", place.connections) };
        let way = &network.connections[way.index()];
        assert_eq!(way.turn, Turn::UTurn);
        let round: Vec<Point2> =
            way.path.iter().copied().filter(|point| point.x > 100.0 - radius * 0.5).collect();
        assert!(tightest(&round) > least, "the way turns at {} m", tightest(&round));
        assert!(tightest(&way.path) > 4.0, "the way swings out at {} m", tightest(&way.path));
        // A vehicle 2.55 m wide stays on the pavement.
        for point in &way.path {
            let to_kerb = polyline::closest(&place.outline, point).unwrap().distance;
            let at_end = (point.x - place.outline[0].x).abs() < 0.5;
            assert!(at_end || to_kerb > 1.275, "{point} is {to_kerb} m from the kerb");
        }
        // People walk round it.
        let corner = &place.corners[0];
        let clear = corner.iter().all(|point| (point - place.center).norm() > radius + 1.0);
        assert!(corner.len() > 6 && clear, "{corner:?}");
    }
}

#[test]
fn a_short_street_has_no_turning_circle() {
    let network = dead_end(24.0, CAR_TURNING, CrossSection::two_way(1, 1));
    let place = &network.intersections[1];
    assert_eq!(fault(&place.outline), None);
    assert!(place.outline.iter().all(|point| (point.y).abs() < 3.6), "{:?}", place.outline);
}

#[test]
fn circles_are_given_only_where_they_have_room() {
    // Two dead ends 22 m apart, and one far away from all.
    let nodes = [(0.0, 0.0), (100.0, 0.0), (122.0, 0.0), (250.0, 0.0), (250.0, 90.0), (250.0, -90.0)]
        .map(|(x, y)| Point2::new(x, y))
        .to_vec();
    let streets = [(0, 1), (2, 3), (3, 4), (3, 5)].map(|(a, b)| Street::simple(a, b)).to_vec();
    let mut plan = StreetPlan { nodes, streets, ..StreetPlan::default() };
    plan.make_turning_room();
    let turning: Vec<[f64; 2]> = plan.streets.iter().map(|street| street.turning).collect();
    assert_eq!(turning[0], [LORRY_TURNING, 0.0]);
    assert_eq!(turning[1], [0.0, 0.0], "22 m are too few for two");
    assert_eq!(turning[2], [0.0, LORRY_TURNING]);
    plan.nodes[2].x = 127.0;
    plan.make_turning_room();
    assert_eq!(plan.streets[1].turning, [CAR_TURNING, 0.0]);
    assert_eq!(plan.streets[0].turning, [LORRY_TURNING, CAR_TURNING]);
}

/// Stars of all classes and widths, with dead ends of all radii; hammerheads where a circle would be no wider than its street.
fn star() -> impl Strategy<Value = StreetPlan> {
    let arm = (0.6..1.4_f64, 60.0..160.0_f64, 0_u8..3, 0_u8..3, 0.0..5.0_f64, 0.0..20.0_f64, 0..3_u8);
    (prop::collection::vec(arm, 1..7), any::<bool>()).prop_map(|(arms, left)| {
        let mut plan = StreetPlan { nodes: vec![Point2::origin()], ..StreetPlan::default() };
        let mut heading = 0.0;
        for (gap, length, forward, backward, walk, turning, class) in arms {
            heading += gap;
            if heading > 5.7 {
                break;
            }
            plan.nodes.push(Point2::origin() + direction(heading) * length);
            let to = plan.nodes.len() - 1;
            let backward = if forward == 0 { backward.max(1) } else { backward };
            let section = plan.add_section(CrossSection::plain(forward, backward, 3.2, walk));
            let class = [RoadClass::Local, RoadClass::Arterial, RoadClass::Highway][usize::from(class)];
            let (turning, hammerhead) = ([0.0, turning], [true; 2]);
            plan.streets.push(Street { section, class, turning, hammerhead, ..Street::simple(0, to) });
        }
        plan.driving_side = if left { DrivingSide::Left } else { DrivingSide::Right };
        plan
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn paved_areas_are_simple(plan in star()) {
        let Ok(network) = RoadNetwork::derive(&plan, &NetworkConfig::default()) else { return Ok(()) };
        network.check().unwrap();
        for (index, place) in network.intersections.iter().enumerate() {
            prop_assert_eq!(fault(&place.outline), None, "junction {}", index);
            let kerbs: Vec<Point2> =
                (0..place.roads.len()).flat_map(|rank| place.kerb(rank).to_vec()).collect();
            prop_assert_eq!(&kerbs, &place.outline);
            // Each kerb begins on the left of its road, seen from the junction.
            for (rank, road) in place.roads.iter().enumerate() {
                let road = &network.roads[road.index()];
                let leaves = road.from == IntersectionId::from_index(index);
                let near = polyline::closest(&road.centerline, &place.kerb(rank)[0]).unwrap();
                let (left, sign) = if leaves { (road.left_kerb, 1.0) } else { (road.right_kerb, -1.0) };
                prop_assert!((near.lateral * sign - left).abs() < 1e-6, "{} for {}", near.lateral, left);
            }
        }
    }
}
