//! On streets of one lane each way drivers pass what stands on their lane over the oncoming one: when nobody comes, one at a time or a few
//! together, and nobody touches anybody.

use std::collections::BTreeMap;
use std::sync::Arc;

use simworld_core::geometry::Point2;
use simworld_core::id::{LaneId, RoadId};
use simworld_core::net::{
    CrossSection, DrivingSide, LaneDirection, NetworkConfig, RoadNetwork, Street, StreetPlan, polyline,
};
use simworld_core::seed::Seed;
use simworld_traffic::vehicle::VehicleKind;
use simworld_traffic::{
    Arrivals, Closed, Closure, Drive, Flow, Foreign, Interest, Leg, Route, Traffic, TrafficConfig,
};

use crate::at_once::at_once;
use crate::contacts::assert_apart;

/// Length of the street, and where something stands on it, m along the lane.
const STREET: f64 = 300.0;
const PLACE: f64 = 140.0;
/// How far a cone reaches, m.
const CONE: f64 = 0.2;

/// A street of one lane each way.
fn street(side: DrivingSide) -> Arc<RoadNetwork> {
    let mut section = CrossSection::two_way(1, 1);
    if side == DrivingSide::Left {
        section.lanes.reverse();
    }
    let plan = StreetPlan {
        nodes: vec![Point2::new(0.0, 0.0), Point2::new(STREET, 0.0)],
        streets: vec![Street::simple(0, 1)],
        sections: vec![section],
        driving_side: side,
        ..StreetPlan::default()
    };
    Arc::new(RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("a street is a network"))
}

/// The way along the street, and the other way, as routes that end with it.
fn ways() -> [Route; 2] {
    [LaneDirection::Forward, LaneDirection::Backward]
        .map(|direction| Route(vec![Leg::new(RoadId(0), direction)]))
}

/// The lanes of the two ways.
fn lanes(network: &RoadNetwork) -> [LaneId; 2] {
    [network.roads[0].forward[0], network.roads[0].backward[0]]
}

/// The street without anybody.
fn empty(side: DrivingSide, seed: u64) -> Traffic {
    let config = TrafficConfig { vehicles: 0, pedestrians: 0, ..TrafficConfig::default() };
    Traffic::new(street(side), &config, Seed(seed)).expect("the settings are in range")
}

/// A cone in the middle of a lane.
fn cone(network: &RoadNetwork, lane: LaneId, station: f64) -> Foreign {
    Foreign::standing(polyline::at(&network.lanes[lane.index()].path, station).0, CONE)
}

/// Cars along the street until a time, and others that come.
fn send(traffic: &mut Traffic, per_hour: [f64; 2], until: f64) {
    for (route, per_hour) in ways().into_iter().zip(per_hour) {
        traffic.add_flow(Flow { until, ..Flow::new(route, per_hour) }).expect("the routes can be driven");
    }
}

/// What was seen of some steps.
#[derive(Default)]
struct Seen {
    /// How long somebody stood at most, along the street and coming, s.
    stood: [f64; 2],
    /// How many drove off the end of the street, each way.
    left: [usize; 2],
    /// The farthest that anybody was moved aside in a step, m.
    jump: f64,
}

/// Watches traffic among bodies: nobody touches anybody, or a body, and nobody jumps.
fn watch(traffic: &mut Traffic, bodies: &[Foreign], steps: usize) -> Seen {
    let lanes = lanes(traffic.network());
    let (mut seen, mut standing) = (Seen::default(), BTreeMap::new());
    let mut lateral: BTreeMap<u32, f64> = BTreeMap::new();
    let mut ways: BTreeMap<u32, usize> = BTreeMap::new();
    for step in 0..steps {
        traffic.step_among(bodies, 0.1);
        assert_apart(traffic, step);
        for vehicle in traffic.vehicles() {
            let y = vehicle.pose.translation.y;
            if let Some(before) = lateral.insert(vehicle.id, y) {
                seen.jump = seen.jump.max((y - before).abs());
            }
            for body in bodies {
                let gap = vehicle.shape.planar_distance(&vehicle.pose, &body.position);
                assert!(gap > body.radius, "step {step}: {vehicle:?} drove into {body:?}");
            }
        }
        for (id, track, _, v) in traffic.stations() {
            let Some(way) = lanes.iter().position(|lane| lane.0 == track) else { continue };
            ways.insert(id, way);
            let time: &mut f64 = standing.entry(id).or_default();
            *time = if v < 0.1 { *time + 0.1 } else { 0.0 };
            seen.stood[way] = seen.stood[way].max(*time);
        }
        for trip in traffic.ended() {
            if let Some(way) = ways.get(&trip.id) {
                seen.left[*way] += 1;
            }
            // Another may have its number next.
            standing.remove(&trip.id);
            lateral.remove(&trip.id);
            ways.remove(&trip.id);
        }
    }
    seen
}

#[test]
fn a_cone_is_passed_by_all_and_those_who_come_are_held_up_little() {
    let sides = [DrivingSide::Right, DrivingSide::Left];
    at_once(sides, |side| {
        let mut traffic = empty(side, 2);
        let network = Arc::clone(traffic.network());
        send(&mut traffic, [150.0, 200.0], 240.0);
        let cone = cone(&network, lanes(&network)[0], PLACE);
        let seen = watch(&mut traffic, &[cone], 6000);
        let counters = traffic.counters();
        // All of them within ten minutes, of which they came for four.
        assert_eq!((counters.arrived, traffic.outside()), (counters.entered, 0), "{counters:?}");
        assert_eq!(counters.obstacles_passed, seen.left[0] as u64, "{side:?}: each passes it once");
        assert!(seen.left[0] > 3 && seen.left[1] > 5, "{side:?}: {:?} came through", seen.left);
        // As long as three in a row are out, at most.
        assert!(seen.stood[1] < 30.0, "{side:?}: those who come stood for {} s", seen.stood[1]);
        // As quickly as in a change of lanes.
        assert!(seen.jump < 0.13, "{side:?}: somebody was moved aside by {} m in a step", seen.jump);
        assert_eq!(counters.forced_stops, 0, "{side:?}");
    });
}

#[test]
fn without_the_setting_everybody_waits() {
    let config =
        TrafficConfig { vehicles: 0, pedestrians: 0, pass_obstacles: false, ..TrafficConfig::default() };
    let mut traffic =
        Traffic::new(street(DrivingSide::Right), &config, Seed(2)).expect("the settings are in range");
    let network = Arc::clone(traffic.network());
    send(&mut traffic, [150.0, 200.0], 200.0);
    let seen = watch(&mut traffic, &[cone(&network, lanes(&network)[0], PLACE)], 2000);
    assert_eq!((seen.left[0], traffic.counters().obstacles_passed), (0, 0));
    assert!(seen.left[1] > 2 && seen.stood[0] > 30.0, "{:?} {:?}", seen.left, seen.stood);
}

#[test]
fn nobody_goes_out_before_there_is_a_gap() {
    let mut traffic = empty(DrivingSide::Right, 3);
    let network = Arc::clone(traffic.network());
    let [own, other] = lanes(&network);
    let [along, back] = ways();
    traffic.insert(along, VehicleKind::Car).expect("it can be driven");
    // A car every two seconds, for less than the time after which somebody would be asked to wait.
    let stream = Flow {
        arrivals: Arrivals::Uniform,
        kind: Some(VehicleKind::Car),
        until: 40.0,
        ..Flow::new(back, 1800.0)
    };
    traffic.add_flow(stream).expect("it can be driven");
    let cone = cone(&network, own, PLACE);
    let beside = network.lanes[other.index()].length - PLACE;
    let mut waited: f64 = 0.0;
    while traffic.counters().obstacles_passed == 0 {
        watch(&mut traffic, &[cone], 1);
        let waits = traffic.stations().any(|at| at.1 == own.0 && at.3 < 0.1);
        waited = if waits { waited + 0.1 } else { waited };
        assert!(traffic.seconds() < 110.0, "it waits for good");
    }
    assert!(waited > 10.0 && traffic.seconds() > 40.0, "it went out into the stream after {waited} s");
    let comes = traffic.stations().find(|at| at.1 == other.0 && at.2 < beside);
    assert_eq!(comes, None, "somebody comes at {} s", traffic.seconds());
    watch(&mut traffic, &[cone], 600);
    let counters = traffic.counters();
    assert_eq!(counters.arrived, counters.entered, "{counters:?}");
}

#[test]
fn neither_way_starves_in_a_stream_without_gaps() {
    let mut traffic = empty(DrivingSide::Right, 4);
    let network = Arc::clone(traffic.network());
    let [along, back] = ways();
    let flow = |route, per_hour| Flow {
        arrivals: Arrivals::Uniform,
        kind: Some(VehicleKind::Car),
        until: 480.0,
        ..Flow::new(route, per_hour)
    };
    traffic.add_flow(flow(along, 120.0)).expect("it can be driven");
    traffic.add_flow(flow(back, 900.0)).expect("it can be driven");
    let cone = cone(&network, lanes(&network)[0], PLACE);
    let seen = watch(&mut traffic, &[cone], 4800);
    // A car every four seconds leaves no gap of ten. Somebody is let out every minute and a half at the latest, and two with him.
    assert!(seen.left[0] >= 5, "{:?} came through", seen.left);
    assert!(seen.left[1] >= 80 && seen.stood[1] < 60.0, "{:?}, stood {:?} s", seen.left, seen.stood);
}

#[test]
fn nobody_passes_what_stands_on_both_lanes() {
    let mut traffic = empty(DrivingSide::Right, 5);
    let network = Arc::clone(traffic.network());
    let [own, other] = lanes(&network);
    send(&mut traffic, [200.0, 200.0], 120.0);
    let beside = network.lanes[other.index()].length - PLACE;
    let cones = [cone(&network, own, PLACE), cone(&network, other, beside)];
    let seen = watch(&mut traffic, &cones, 2400);
    assert_eq!((seen.left, traffic.counters().obstacles_passed), ([0, 0], 0));
    for lane in [own, other] {
        let waiting = traffic.stations().filter(|at| at.1 == lane.0 && at.3 < 0.1).count();
        assert!(waiting > 1, "{waiting} wait on {lane:?}");
    }
    // When one is taken away, they get by on that lane, and then on the other.
    let seen = watch(&mut traffic, &cones[..1], 6000);
    let counters = traffic.counters();
    assert_eq!((counters.arrived, traffic.outside()), (counters.entered, 0), "{counters:?} {:?}", seen.left);
}

#[test]
fn who_is_too_near_to_the_junction_for_it_waits() {
    let arm = |station_from_end: f64| {
        let network = RoadNetwork::derive(&StreetPlan::crossroads(200.0), &NetworkConfig::default());
        let network = Arc::new(network.expect("a crossroads is a network"));
        let config = TrafficConfig { vehicles: 0, pedestrians: 0, ..TrafficConfig::default() };
        let mut traffic = Traffic::new(Arc::clone(&network), &config, Seed(6)).expect("sound settings");
        let [into, out] = [(0, LaneDirection::Backward), (2, LaneDirection::Forward)]
            .map(|(road, direction)| Leg::new(RoadId(road), direction));
        let route = Route(vec![into, out]);
        for _ in 0..4 {
            traffic.insert(route.clone(), VehicleKind::Car).expect("it can be driven");
        }
        let lane = into.lanes(&network)[0];
        let cone = cone(&network, lane, network.lanes[lane.index()].length - station_from_end);
        for step in 0..2500 {
            traffic.step_among(&[cone], 0.1);
            assert_apart(&traffic, step);
        }
        traffic.counters()
    };
    let near = arm(20.0);
    assert_eq!((near.arrived, near.obstacles_passed), (0, 0), "{near:?}");
    let far = arm(80.0);
    assert_eq!((far.arrived, far.obstacles_passed), (4, 4), "{far:?}");
}

#[test]
fn breakdowns_and_works_and_who_is_stopped_from_outside_are_passed() {
    at_once(["breakdown", "works", "driven"], |what| {
        let mut traffic = empty(DrivingSide::Right, 7);
        let network = Arc::clone(traffic.network());
        let own = lanes(&network)[0];
        send(&mut traffic, [200.0, 100.0], 200.0);
        let on_the_way =
            |traffic: &Traffic| traffic.stations().find(|at| at.1 == own.0 && at.2 > 60.0).map(|at| at.0);
        while on_the_way(&traffic).is_none() {
            watch(&mut traffic, &[], 1);
        }
        let first = on_the_way(&traffic).expect("it was seen");
        match what {
            "breakdown" => assert!(traffic.halt(first, f64::INFINITY).expect("a time")),
            "driven" => {
                let stop = Drive { acceleration: -3.0, ..Drive::default() };
                traffic.drive(first, stop).expect("it is on its lane");
            }
            _ => {
                let works = Closed::Stretch(own, PLACE, PLACE + 15.0);
                traffic.close(Closure::new(works)).expect("a stretch of a lane");
            }
        }
        let seen = watch(&mut traffic, &[], 6500);
        let counters = traffic.counters();
        let stays = u64::from(what != "works");
        assert_eq!(
            (counters.arrived + stays, traffic.outside()),
            (counters.entered, 0),
            "{what}: {counters:?}"
        );
        assert!(counters.obstacles_passed > 2 && seen.left[1] > 0, "{what}: {counters:?} {:?}", seen.left);
        if what != "works" {
            let (_, track, s, v) =
                traffic.stations().find(|at| at.0 == first).expect("it stands where it stood");
            assert!(track == own.0 && s < 150.0 && v == 0.0, "{what} at {s} m, {v} m/s");
        }
    });
}

#[test]
fn they_are_passed_far_from_all_interest_too() {
    let mut traffic = empty(DrivingSide::Right, 8);
    let network = Arc::clone(traffic.network());
    let elsewhere = Interest { center: Point2::new(0.0, 5000.0), radius: 50.0 };
    traffic.set_interest(Some(vec![elsewhere])).expect("a sound place");
    send(&mut traffic, [150.0, 150.0], 200.0);
    let cone = cone(&network, lanes(&network)[0], PLACE);
    for step in 0..5000 {
        traffic.step_among(&[cone], 0.1);
        assert_apart(&traffic, step);
    }
    let counters = traffic.counters();
    assert_eq!((counters.arrived, traffic.outside()), (counters.entered, 0), "{counters:?}");
    assert!(counters.obstacles_passed > 2, "{counters:?}");
}
