//! Networks that do not hold together, more traffic than there is road, and numbers that are none: typed errors or a queue
//! outside, never a panic, never a number that is none among what is shown.

use std::sync::Arc;

use proptest::prelude::*;
use simworld_core::control::{Driver, Pid};
use simworld_core::geometry::{Point2, Point3, Twist, Vector2, Vector3, pose_facing};
use simworld_core::hash::StateHash;
use simworld_core::id::LaneId;
use simworld_core::net::{CrossSection, NetworkConfig, RoadNetwork, StreetPlan};
use simworld_core::seed::Seed;
use simworld_traffic::crowd::{AnticipationVelocity, Crowd, Person, Walls, Wish};
use simworld_traffic::vehicle::VehicleKind;
use simworld_traffic::{
    AtDestination, Closed, Closure, Drive, DrivingConditions, Flow, Foreign, Interest, LaneWish, Leg, Line,
    Route, Router, Stop, Stroll, Traffic, TrafficConfig, TrafficError,
};

fn grid(lanes: u8) -> RoadNetwork {
    let mut plan = StreetPlan::grid(3, 3, 90.0);
    plan.sections[0] = CrossSection::two_way(lanes, lanes);
    RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("a grid is a network")
}

/// What may have happened to a network on its way here.
#[derive(Clone, Copy, Debug)]
enum Damage {
    /// A lane leads nowhere.
    Dangling(usize),
    /// A lane has no length.
    Point(usize),
    /// Nobody comes to a lane.
    Unreachable(usize),
    /// A way across has no length.
    Jump(usize),
    /// A lane has a speed, a width or a place that is no number.
    NoNumber(usize, u8),
    /// Something refers to what is not there.
    Lost(usize),
}

fn any_damage() -> impl Strategy<Value = Damage> {
    let index = 0..400_usize;
    prop_oneof![
        3 => index.clone().prop_map(Damage::Dangling),
        3 => index.clone().prop_map(Damage::Point),
        3 => index.clone().prop_map(Damage::Unreachable),
        3 => index.clone().prop_map(Damage::Jump),
        1 => (index.clone(), 0..5_u8).prop_map(|(index, what)| Damage::NoNumber(index, what)),
        1 => index.prop_map(Damage::Lost),
    ]
}

/// Does the damage, and says whether the network must be refused.
fn damage(network: &mut RoadNetwork, damage: Damage) -> bool {
    let (lanes, ways) = (network.lanes.len(), network.connections.len());
    match damage {
        Damage::Dangling(index) => network.lanes[index % lanes].outgoing.clear(),
        Damage::Point(index) => {
            let lane = &mut network.lanes[index % lanes];
            lane.path = vec![lane.path[0]; 2];
            // What is no number stays so.
            lane.length = if lane.length.is_finite() { 0.0 } else { lane.length };
        }
        Damage::Unreachable(index) => {
            let to = LaneId::from_index(index % lanes);
            let connections = &network.connections;
            for lane in &mut network.lanes {
                lane.outgoing.retain(|way| connections[way.index()].to != to);
            }
        }
        Damage::Jump(index) => {
            let way = &mut network.connections[index % ways];
            way.path = vec![way.path[0]; 2];
            way.length = 0.0;
        }
        Damage::NoNumber(index, what) => {
            let lane = &mut network.lanes[index % lanes];
            match what {
                0 => lane.speed_limit = f64::NAN,
                1 => lane.width = f64::NAN,
                2 => lane.length = f64::INFINITY,
                3 => lane.speed_limit = 0.0,
                _ => lane.path[0].x = f64::NAN,
            }
            return true;
        }
        Damage::Lost(index) => {
            network.connections[index % ways].to = LaneId(9_999);
            return true;
        }
    }
    false
}

/// Nothing that is shown is no number, and nobody is lost.
fn is_sound(traffic: &Traffic) -> Result<(), TestCaseError> {
    for body in traffic.vehicles() {
        let place = body.pose.translation.vector;
        prop_assert!(
            place.iter().chain(body.twist.linear.iter()).all(|number| number.is_finite()),
            "{body:?}"
        );
    }
    for walker in traffic.pedestrians() {
        prop_assert!(walker.position.x.is_finite() && walker.position.y.is_finite(), "{walker:?}");
    }
    let (counters, placed) = (traffic.counters(), traffic.placed());
    let came = u64::from(placed.vehicles) + counters.entered;
    prop_assert_eq!(traffic.vehicles().count() as u64 + counters.arrived + counters.removed, came);
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn damaged_networks_are_refused_or_driven_on(
        damages in prop::collection::vec(any_damage(), 1..6), lanes in 1..3_u8, seed in any::<u64>(), no_way in any::<bool>(),
    ) {
        let mut network = grid(lanes);
        let mut must_refuse = false;
        for one in damages {
            must_refuse |= damage(&mut network, one);
        }
        let leave = if no_way { simworld_traffic::NoWay::Leave } else { simworld_traffic::NoWay::Wait };
        let config = TrafficConfig { vehicles: 40, pedestrians: 20, no_way: leave, ..TrafficConfig::default() };
        let made = Traffic::new(Arc::new(network.clone()), &config, Seed(seed));
        let Ok(mut traffic) = made else { return Ok(()) };
        prop_assert!(!must_refuse, "what cannot be is refused");
        let router = Router::new(&network);
        let legs: Vec<Leg> = (0..network.lanes.len()).step_by(5).map(|lane| Leg::of(&network, LaneId::from_index(lane))).collect();
        for (from, to) in legs.iter().zip(legs.iter().rev()) {
            if let Some(route) = router.quickest(*from, *to) {
                // A way that its lane does not lead to is found and then refused.
                let sent = traffic.add_flow(Flow::new(route, 600.0));
                prop_assert!(matches!(sent, Ok(()) | Err(TrafficError::Route { .. })), "{sent:?}");
            }
        }
        for _ in 0..400 {
            traffic.step(0.1);
        }
        is_sound(&traffic)?;
    }

    #[test]
    fn numbers_that_are_none_are_refused(
        number in prop_oneof![Just(f64::NAN), Just(f64::INFINITY), Just(f64::NEG_INFINITY), Just(-1e300), any::<f64>()],
        what in 0..19_usize,
    ) {
        let network = Arc::new(grid(2));
        let config = TrafficConfig { vehicles: 20, pedestrians: 20, ..TrafficConfig::default() };
        let mut traffic = Traffic::new(Arc::clone(&network), &config, Seed(5)).expect("the settings are in range");
        for _ in 0..20 {
            traffic.step(0.1);
        }
        let before = traffic.digest();
        let leg = Leg::of(&network, LaneId(0));
        let route = Route(vec![leg]);
        let at = Point2::new(number, 3.0);
        let twist = Twist { linear: Vector3::new(number, 0.0, 0.0), ..Twist::ZERO };
        let is_finite = number.is_finite();
        let is_bad = match what {
            0 => traffic.drive(1, Drive { acceleration: number, lane: LaneWish::Left, next: None }).is_err(),
            1 => traffic.guide_walker(1, Stroll { speed: number, keep_right: 0.0, dares: true }).is_err(),
            2 => traffic.guide_walker(1, Stroll { speed: 1.0, keep_right: number, dares: true }).is_err(),
            3 => traffic.halt(1, number).is_err(),
            4 => traffic.park(1, leg, number, 10.0).is_err(),
            5 => traffic.park(1, leg, 20.0, number).is_err(),
            6 => traffic.close(Closure { from: number, ..Closure::new(Closed::Leg(leg)) }).is_err(),
            7 => traffic.close(Closure::new(Closed::Stretch(LaneId(1), number, 30.0))).is_err(),
            8 => traffic.set_interest(Some(vec![Interest { center: at, radius: number }])).is_err(),
            9 => traffic.set_conditions(DrivingConditions { visibility: number, ..DrivingConditions::default() }).is_err(),
            10 => traffic.add_flow(Flow::new(route, number)).is_err(),
            11 => traffic.add_flow(Line::new(route, vec![Stop::new(leg, 20.0, number)], 60.0).flow()).is_err(),
            12 => traffic.add_flow(Line::new(route, vec![], number).flow()).is_err(),
            13 => traffic.insert_scheduled(route, VehicleKind::Car.into(), number).is_err(),
            14 => traffic.add_walker(at, None).is_err(),
            15 => traffic.send_walker(1, at, AtDestination::Leave).is_err(),
            16 => {
                traffic.free(1).expect("it is there");
                let refused = traffic.place(1, pose_facing(Point3::new(number, 0.0, 0.0), 0.0), Twist::ZERO).is_err()
                    && traffic.place(1, pose_facing(Point3::origin(), 0.0), twist).is_err();
                prop_assert_eq!(refused, !is_finite);
                return Ok(());
            }
            17 => {
                traffic.free_walker(1).expect("it is there");
                let refused = traffic.place_walker(1, at, Vector2::x(), Vector2::zeros()).is_err();
                prop_assert_eq!(refused, !is_finite);
                return Ok(());
            }
            _ => {
                let mut plans = traffic.plans().to_vec();
                let Some(phase) = plans.first_mut().and_then(|plan| plan.phases.first_mut()) else { return Ok(()) };
                phase.duration = number;
                traffic.set_plans(plans).is_err()
            }
        };
        prop_assert!(is_bad || is_finite || matches!((what, number), (3, f64::INFINITY)), "{what} took {number}");
        if is_bad {
            prop_assert_eq!(traffic.digest(), before, "nothing is changed");
        }
        for _ in 0..50 {
            traffic.step(0.1);
        }
        is_sound(&traffic)?;
    }

    #[test]
    fn bodies_and_steps_of_any_size_harm_nobody(
        numbers in prop::array::uniform8(prop_oneof![Just(f64::NAN), Just(f64::INFINITY), any::<f64>(), -50.0..200.0_f64]),
        dt in prop_oneof![Just(f64::NAN), Just(0.0), Just(-1.0), Just(f64::INFINITY), 0.01..0.5_f64],
    ) {
        let config = TrafficConfig { vehicles: 20, pedestrians: 40, ..TrafficConfig::default() };
        let mut traffic = Traffic::new(Arc::new(grid(2)), &config, Seed(6)).expect("the settings are in range");
        let [x, y, radius, half_width, ahead, aside, vx, vy] = numbers;
        let (direction, velocity) = (Vector2::new(ahead, aside), Vector2::new(vx, vy));
        let body = Foreign { position: Point2::new(x, y), radius, half_width, direction, velocity, height: vx };
        traffic.set_obstacles(&[body]);
        for _ in 0..20 {
            traffic.step_among(&[body, Foreign::standing(Point2::new(20.0, 0.0), radius)], dt);
        }
        is_sound(&traffic)?;
        let (mut pid, mut driver) = (Pid::new(0.5, 0.1, 0.2, 1.0), Driver::default());
        let path = [Point2::new(0.0, 0.0), Point2::new(50.0, 0.0)];
        for number in numbers {
            pid.update(number, dt);
            let actions = driver.drive(&pose_facing(Point3::new(number, 0.0, 0.0), 0.1), number, &path, number, 0.1);
            prop_assert!(!format!("{actions:?}").contains("NaN"), "{actions:?}");
        }
        prop_assert!(pid.update(1.0, 0.1).is_finite());
        let (model, mut crowd) = (AnticipationVelocity::default(), Crowd::default());
        let mut people = [Person::standing(Point2::new(x, y), Vector2::x()), Person::standing(Point2::new(2.0, 0.0), Vector2::x())];
        let wishes = [Wish { direction: Vector2::new(ahead, aside), speed: vx }, Wish { direction: Vector2::x(), speed: 1.3 }];
        let walls = Walls::new(vec![(Point2::new(x, y), Point2::new(vx, vy)), (Point2::new(0.0, -1.0), Point2::new(9.0, -1.0))]);
        for _ in 0..5 {
            crowd.step(&model, &mut people, &wishes, &[], &walls, 0.1);
        }
        prop_assert!(people[1].position.x.is_finite() && people[1].position.y.is_finite(), "{people:?}");
    }
}

#[test]
fn more_cars_than_road_wait_outside_and_are_told() {
    let network = Arc::new(grid(1));
    let config = TrafficConfig { vehicles: 5_000, pedestrians: 20_000, ..TrafficConfig::default() };
    let mut traffic =
        Traffic::new(Arc::clone(&network), &config, Seed(7)).expect("the settings are in range");
    let placed = traffic.placed();
    assert!(placed.vehicles < 1_000 && placed.pedestrians < 20_000, "{placed:?}");
    let router = Router::new(&network);
    let legs: Vec<Leg> =
        (0..network.lanes.len()).map(|lane| Leg::of(&network, LaneId::from_index(lane))).collect();
    let mut flows = 0;
    for (from, to) in legs.iter().zip(legs.iter().skip(7)) {
        if let Some(route) = router.quickest(*from, *to) {
            traffic.add_flow(Flow::new(route, 5_000.0)).expect("it can be driven");
            flows += 1;
        }
    }
    for _ in 0..300 {
        traffic.step(0.1);
    }
    let counters = traffic.counters();
    let asked = f64::from(flows) * 5_000.0 / 120.0;
    let known = traffic.outside() as f64 + counters.entered as f64;
    // Arrivals are random: four deviations of a Poisson number.
    assert!((known - asked).abs() < 4.0 * asked.sqrt(), "{known} of {asked}");
    assert!(traffic.outside() > 500, "{} wait outside", traffic.outside());
}

#[test]
fn an_empty_network_and_one_without_roads_are_no_trouble() {
    let config = TrafficConfig { vehicles: 10, pedestrians: 10, ..TrafficConfig::default() };
    let mut traffic = match Traffic::new(Arc::new(RoadNetwork::default()), &config, Seed(1)) {
        Ok(traffic) => traffic,
        Err(error) => {
            assert!(matches!(error, TrafficError::Network(_) | TrafficError::Damaged(_)), "{error}");
            return;
        }
    };
    for _ in 0..10 {
        traffic.step(0.1);
    }
    assert_eq!((traffic.placed().vehicles, traffic.placed().pedestrians), (0, 0));
    assert!(
        traffic.drive(0, Drive::default()).is_err() && traffic.add_walker(Point2::origin(), None).is_err()
    );
}
