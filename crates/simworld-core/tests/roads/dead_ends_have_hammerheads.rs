//! Dead ends where no turning circle has room have a T in which vehicles turn, if that has room.

use simworld_core::geometry::Point2;
use simworld_core::net::*;

/// A dead end of 100 m towards east, and a street across at `ahead` m.
fn before_a_street(ahead: f64) -> StreetPlan {
    let nodes = [(0.0, 0.0), (100.0, 0.0), (0.0, 90.0), (0.0, -90.0), (ahead, -120.0), (ahead, 120.0)];
    let streets = [(0, 1), (0, 2), (0, 3), (4, 5)].map(|(a, b)| Street::simple(a, b)).to_vec();
    let nodes = nodes.map(|(x, y)| Point2::new(x, y)).to_vec();
    StreetPlan { nodes, streets, ..StreetPlan::default() }
}

/// What the dead end got.
fn given(mut plan: StreetPlan) -> (f64, bool) {
    plan.make_turning_room();
    assert!(plan.validate().is_ok());
    (plan.streets[0].turning[1], plan.streets[0].hammerhead[1])
}

fn derived(plan: &StreetPlan) -> RoadNetwork {
    let network = RoadNetwork::derive(plan, &NetworkConfig::default()).unwrap();
    network.check().unwrap();
    network
}

/// A T as it was derived, with an outline closed.
fn built(plan: &StreetPlan) -> (RoadNetwork, Hammerhead, Vec<Point2>) {
    let network = derived(plan);
    let place = &network.intersections[1];
    let head = place.hammerhead.expect("the dead end has a hammerhead");
    let mut ring = place.outline.clone();
    ring.extend(place.outline.first());
    (network, head, ring)
}

fn distance(path: &[Point2], point: &Point2) -> f64 {
    polyline::closest(path, point).map_or(f64::INFINITY, |near| near.distance)
}

/// By the crossings of a ray to the east with a closed ring.
fn is_inside(ring: &[Point2], point: &Point2) -> bool {
    let crosses = |a: &Point2, b: &Point2| {
        (a.y > point.y) != (b.y > point.y) && point.x < (b.x - a.x) * (point.y - a.y) / (b.y - a.y) + a.x
    };
    ring.windows(2).filter(|pair| crosses(&pair[0], &pair[1])).count() % 2 == 1
}

#[test]
fn a_head_is_where_no_circle_has_room() {
    // Walkways of 3 m beyond the end, and 6.5 m from the middle of the other street to its edge.
    assert_eq!(given(before_a_street(200.0)), (LORRY_TURNING, false), "circles stay");
    assert_eq!(given(before_a_street(120.0)), (CAR_TURNING, false), "circles stay");
    assert_eq!(given(before_a_street(112.0)), (0.0, true));
    assert_eq!(given(before_a_street(109.6)), (0.0, true), "its land ends 0.1 m before the other's");
    assert_eq!(given(before_a_street(109.4)), (0.0, false), "its walkway would lie on the other street's");
}

#[test]
fn arms_keep_off_streets_beside() {
    // Half a street, an arm and a walkway reach 12.6 m to either side.
    let beside = |y: f64| {
        let mut plan = before_a_street(112.0);
        plan.nodes.extend([Point2::new(30.0, y), Point2::new(105.0, y)]);
        plan.streets.push(Street::simple(6, 7));
        given(plan)
    };
    assert_eq!(beside(40.0), (0.0, true));
    assert_eq!(beside(12.6 + 6.4), (0.0, false));
    assert_eq!(beside(-12.6 - 6.4), (0.0, false));
}

#[test]
fn dead_ends_share_the_land_between_them() {
    // Two that look at each other.
    let facing = |gap: f64| {
        let mut plan = before_a_street(400.0);
        plan.nodes.extend([100.0 + gap, 190.0 + gap].map(|x| Point2::new(x, 0.0)));
        plan.streets.push(Street::simple(6, 7));
        plan.make_turning_room();
        [
            (plan.streets[0].turning[1], plan.streets[0].hammerhead[1]),
            (plan.streets[4].turning[0], plan.streets[4].hammerhead[0]),
        ]
    };
    assert_eq!(facing(20.0), [(0.0, true); 2], "either circle would want more than its half");
    assert_eq!(facing(9.4), [(0.0, false); 2], "a walkway of 3 m would lie on the other's land");
    // Two side by side.
    let beside = |apart: f64| {
        let mut plan = before_a_street(112.0);
        plan.nodes.extend([10.0, 100.0].map(|x| Point2::new(x, apart)));
        plan.streets.push(Street::simple(6, 7));
        plan.make_turning_room();
        [plan.streets[0].hammerhead[1], plan.streets[4].hammerhead[1]]
    };
    assert_eq!(beside(26.0), [true; 2]);
    assert_eq!(beside(24.0), [false; 2], "arms and walkways of 12.6 m each would meet");
}

#[test]
fn short_bent_and_wide_streets_have_none() {
    let mut short = before_a_street(112.0);
    for node in [0, 2, 3] {
        short.nodes[node].x = 74.0;
    }
    assert_eq!(given(short), (0.0, false), "26 m are too few");
    let mut bent = before_a_street(112.0);
    bent.streets[0].via = vec![Point2::new(88.0, 30.0), Point2::new(94.0, 0.0)];
    assert_eq!(given(bent), (0.0, false), "the street bends where an arm would lie");
    let mut wide = before_a_street(112.0);
    wide.streets[0].section = wide.add_section(CrossSection::two_way(2, 3));
    assert_eq!(given(wide), (0.0, false), "a car turns within the street");
}

#[test]
fn the_head_lies_before_the_end_and_reaches_to_both_sides() {
    for side in [DrivingSide::Right, DrivingSide::Left] {
        let mut plan = before_a_street(112.0);
        plan.driving_side = side;
        plan.make_turning_room();
        let (network, head, ring) = built(&plan);
        let place = &network.intersections[1];
        assert_eq!(place.turning, None);
        let reach = 3.5 + HAMMERHEAD_ARM;
        let mut tips = head.tips;
        tips.sort_by(|a, b| a.y.total_cmp(&b.y));
        for (tip, y) in tips.iter().zip([-reach, reach]) {
            assert!((tip - Point2::new(100.0 - HAMMERHEAD_WIDTH * 0.5, y)).norm() < 1e-9, "{tip}");
        }
        assert!(ring.iter().all(|point| point.x < 100.0 + 1e-9 && point.y.abs() < reach + 1e-9));
        let area: f64 = ring.windows(2).map(|pair| pair[0].coords.perp(&pair[1].coords)).sum::<f64>() * 0.5;
        // Its head, the street up to it, and what two quarters of a circle leave of their squares.
        let flares = 2.0 * 25.0 * (1.0 - std::f64::consts::FRAC_PI_4);
        let whole = 2.0 * reach * HAMMERHEAD_WIDTH + 7.0 * 5.0 + flares;
        assert!((area - whole).abs() < 0.8, "{area} m² for {whole}");
        // People walk round it, in the middle of a sidewalk of 3 m.
        let corner = &place.corners[0];
        assert!(corner.iter().any(|point| point.y > reach) && corner.iter().any(|point| point.y < -reach));
        for point in corner {
            let to_kerb = distance(&ring, point);
            assert!(to_kerb > 1.1 && !is_inside(&ring, point), "{point} is {to_kerb} m from the kerb");
        }
    }
}

#[test]
fn vehicles_turn_in_it_and_stay_on_the_pavement() {
    for side in [DrivingSide::Right, DrivingSide::Left] {
        for parking in [0.0, 2.2] {
            let mut plan = before_a_street(112.0);
            plan.driving_side = side;
            plan.sections[0] = plan.sections[0].clone().with_parking(parking);
            plan.streets[0].hammerhead[1] = true;
            let (network, _, ring) = built(&plan);
            let [way] = network.intersections[1].connections.as_slice() else { panic!("one way back") };
            let way = &network.connections[way.index()];
            assert_eq!(way.turn, Turn::UTurn);
            // The outline is no kerb where the street opens into it.
            let inner = way.path.iter().filter(|point| (point.x - ring[0].x).abs() > 1.3);
            for point in inner {
                let to_kerb = distance(&ring, point);
                // A vehicle 2.55 m wide.
                assert!(is_inside(&ring, point) && to_kerb > 1.275, "{point} is {to_kerb} m from the kerb");
            }
            // Half a circle between two lanes 3.5 m apart would have a radius of 1.75 m.
            let widest = way.path.iter().map(|point| point.y.abs()).fold(0.0, f64::max);
            assert!(widest > 2.8, "it turns on {widest} m");
        }
    }
}

#[test]
fn a_street_too_short_for_its_head_is_built_without() {
    let mut plan = before_a_street(400.0);
    plan.nodes[1].x = 25.0;
    plan.streets[0].hammerhead[1] = true;
    let network = derived(&plan);
    let place = &network.intersections[1];
    assert_eq!(place.hammerhead, None);
    assert!(place.outline.iter().all(|point| point.y.abs() < 3.6), "{:?}", place.outline);
    // Nor is there one where streets meet, or beside a circle.
    plan.nodes[1].x = 100.0;
    plan.streets[0] =
        Street { turning: [0.0, CAR_TURNING], hammerhead: [true; 2], ..plan.streets[0].clone() };
    let network = derived(&plan);
    assert!(network.intersections.iter().all(|place| place.hammerhead.is_none()));
    assert!(network.intersections[1].turning.is_some());
}
