//! People who drive by themselves: on foot to where they depart, in a vehicle that is there for them, and on foot to the end.

use std::collections::BTreeMap;
use std::sync::Arc;

use simworld_core::hash::StateHash;
use simworld_core::id::RoadId;
use simworld_core::net::LaneDirection;
use simworld_core::seed::Seed;
use simworld_traffic::output::{Recorder, Syntax, TripInfo};
use simworld_traffic::sumo::{SumoDemand, SumoNet};
use simworld_traffic::vehicle::VehicleKind;
use simworld_traffic::{
    Leg, PersonDrive, Router, Traffic, TrafficConfig, Trip, TripEnd, VehicleChoice, Whereabouts,
};

const GRID: &str = include_str!("data/grid.net.xml");
const MIXED: &str = include_str!("data/mixed.net.xml");

/// What happened while a demand ran.
struct Ran {
    people: Whereabouts,
    trips: Vec<Trip>,
    /// When each who drove got in and out, s.
    riding: Vec<f64>,
    walks: u64,
    warnings: Vec<String>,
    traffic: Traffic,
}

fn run(net: &str, demand: &str, seconds: usize) -> Ran {
    let net = SumoNet::read(net.as_bytes()).unwrap();
    let demand = SumoDemand::read(demand.as_bytes()).unwrap_or_else(|error| panic!("{error}"));
    let (mut schedule, warnings) = demand.schedule(&net, Seed(4)).unwrap_or_else(|error| panic!("{error}"));
    let config = TrafficConfig {
        vehicles: 0,
        pedestrians: 0,
        types: demand.vehicle_types(),
        ..TrafficConfig::default()
    };
    let mut traffic = Traffic::new(Arc::new(net.network), &config, Seed(4)).unwrap();
    let (mut trips, mut riding, mut before) = (Vec::new(), Vec::new(), 0);
    for _ in 0..10 * seconds {
        schedule.feed(&mut traffic).unwrap();
        if schedule.people().riding != before {
            before = schedule.people().riding;
            riding.push(traffic.seconds());
        }
        traffic.step(0.1);
        trips.extend_from_slice(traffic.ended());
    }
    schedule.feed(&mut traffic).unwrap();
    let warnings = demand.warnings.iter().chain(&warnings).map(ToString::to_string).collect();
    let (people, walks) = (schedule.people(), traffic.counters().walkers_entered);
    Ran { people, trips, riding, walks, warnings, traffic }
}

fn persons(types: &str, persons: &[(&str, &str)]) -> String {
    let one = |(id, stages): &(&str, &str)| format!(r#"<person id="{id}" depart="10">{stages}</person>"#);
    format!("<routes>{types}{}</routes>", persons.iter().map(one).collect::<String>())
}

fn arrived(count: u32) -> Whereabouts {
    Whereabouts { arrived: count, ..Whereabouts::default() }
}

#[test]
fn who_drives_departs_at_the_one_place_and_parks_at_the_other() {
    let trip = r#"<personTrip from="A0B0" to="C1C2" arrivalPos="50" modes="car"/>"#;
    let ran = run(GRID, &persons("", &[("p", trip)]), 400);
    assert_eq!((ran.people, ran.warnings.len()), (arrived(1), 0), "{:?}", ran.warnings);
    let [trip] = &ran.trips[..] else { panic!("one vehicle: {:?}", ran.trips) };
    assert_eq!((trip.kind, trip.end), (VehicleKind::Car, TripEnd::Parked));
    let [got_in, got_out] = ran.riding[..] else { panic!("got in and out once: {:?}", ran.riding) };
    assert!(got_in - trip.entered < 0.25 && (got_out - trip.left).abs() < 0.25, "{:?} {trip:?}", ran.riding);
    // The beginning of the leg is 6 m before where a car can stand, which somebody walks; where he parks he is.
    assert!((10.0..20.0).contains(&trip.entered), "{trip:?}");
    assert_eq!(ran.walks, 1);
    // A place at the very end of the leg is farther than a vehicle can park: the last 20 m are walked.
    let far = r#"<personTrip from="A0B0" to="C1C2" modes="car"/>"#;
    let ran = run(GRID, &persons("", &[("p", far)]), 400);
    assert_eq!((ran.people, ran.trips.len(), ran.walks), (arrived(1), 1, 2));
}

#[test]
fn the_vehicle_is_of_the_mode_or_of_the_type() {
    let types = r#"<vType id="lorry" vClass="truck" length="7.1"/><vType id="slow" vClass="bicycle" maxSpeed="3"/>
        <vTypeDistribution id="any" vTypes="lorry" probabilities="1"/>"#;
    let kinds = |modes: &str| {
        let trip = format!(r#"<personTrip from="A0B0" to="C1C2" {modes}/>"#);
        let ran = run(GRID, &persons(types, &[("p", &trip)]), 500);
        assert_eq!((ran.people, ran.warnings.len()), (arrived(1), 0), "{modes}: {:?}", ran.warnings);
        ran.trips
            .iter()
            .map(|trip| (trip.kind, ran.traffic.config().types[trip.vehicle_type].length))
            .collect::<Vec<_>>()
    };
    let standard = |kind| {
        let types = TrafficConfig::default().types;
        vec![(kind, types.iter().find(|row| row.kind == kind).unwrap().length)]
    };
    assert_eq!(kinds(r#"modes="bicycle""#), standard(VehicleKind::Bicycle));
    assert_eq!(kinds(r#"modes="bicycle car""#), standard(VehicleKind::Car), "the quicker of two");
    assert_eq!(kinds(r#"vTypes="lorry""#), [(VehicleKind::Truck, 7.1)]);
    assert_eq!(kinds(r#"vTypes="any""#), [(VehicleKind::Truck, 7.1)]);
    assert_eq!(kinds(r#"vTypes="slow lorry""#), [(VehicleKind::Truck, 7.1)]);
    assert_eq!(kinds(r#"vTypes="slow" modes="bicycle""#), standard(VehicleKind::Bicycle));
    assert_eq!(kinds(r#"modes="walk""#), []);
}

/// A bus that comes every so many seconds from near A0B0 to near C1C2.
fn bus(period: u32) -> String {
    format!(
        r#"<busStop id="west" lane="A0B0_1" startPos="20" endPos="40"/>
        <busStop id="east" lane="C1C2_1" startPos="40" endPos="60"/>
        <vType id="coach" vClass="bus" length="12"/>
        <route id="seven" edges="A0B0 B0C0 C0C1 C1C2"><stop busStop="west" duration="20"/><stop busStop="east" duration="15"/></route>
        <flow id="bus" type="coach" route="seven" line="7" begin="0" end="1200" period="{period}"/>"#
    )
}

#[test]
fn the_mode_is_the_quickest_by_free_travel_times() {
    let by = |types: &str, trip: &str| {
        let ran = run(GRID, &persons(types, &[("p", &format!("<personTrip {trip}/>"))]), 700);
        assert_eq!((ran.people, ran.warnings.len()), (arrived(1), 0), "{trip}: {:?}", ran.warnings);
        let own = ran.trips.iter().filter(|trip| trip.kind != VehicleKind::Bus).count();
        (own, ran.riding.len() / 2)
    };
    // Round two corners with a car; along one leg; by bus, where it comes at once and one's own vehicle is slow. SUMO 1.28.0
    // chooses the same.
    assert_eq!(by("", r#"from="A0B0" to="C1C2" modes="car public""#), (1, 1));
    assert_eq!(by("", r#"from="A0B0" to="A0B0" arrivalPos="80" modes="car""#), (0, 0));
    let slow = format!(r#"{}<vType id="slow" vClass="bicycle" maxSpeed="1.5"/>"#, bus(60));
    assert_eq!(by(&slow, r#"from="A0B0" to="C1C2" vTypes="slow" modes="public""#), (0, 1));
    assert_eq!(by(&slow, r#"from="A0B0" to="C1C2" modes="bicycle public""#), (1, 1));
    // Against the traffic one walks back, since a vehicle would have to go round.
    assert_eq!(by("", r#"from="A0B0" to="B0A0" arrivalPos="75" modes="car""#), (0, 0));
}

#[test]
fn whoever_goes_on_takes_another_vehicle() {
    let stages = r#"<personTrip from="A0B0" to="C1C2" arrivalPos="50" modes="car"/><stop edge="C1C2" endPos="50" duration="30"/>
        <personTrip to="B0A0" arrivalPos="50" modes="bicycle"/><walk to="A0A1"/>"#;
    let demand = persons("", &[("p", stages)]).replace(
        "</routes>",
        r#"<personFlow id="f" begin="0" end="100" number="3"><personTrip from="A1A0" to="C0C1" modes="car"/></personFlow></routes>"#,
    );
    let ran = run(GRID, &demand, 800);
    assert_eq!(ran.people, arrived(4), "{:?}", ran.warnings);
    let mut kinds: BTreeMap<VehicleKind, usize> = BTreeMap::new();
    ran.trips.iter().for_each(|trip| *kinds.entry(trip.kind).or_default() += 1);
    assert_eq!(kinds.into_iter().collect::<Vec<_>>(), [(VehicleKind::Car, 4), (VehicleKind::Bicycle, 1)]);
    assert_eq!(run(GRID, &demand, 200).traffic.digest(), run(GRID, &demand, 200).traffic.digest());
}

#[test]
fn own_vehicles_have_names() {
    let stages = r#"<personTrip from="A0B0" to="C1C2" modes="car"/><personTrip to="A0A1" modes="bicycle"/>"#;
    let demand = persons(r#"<trip id="p_0" depart="0" from="A0A1" to="A1A2"/>"#, &[("p", stages)]);
    let net = SumoNet::read(GRID.as_bytes()).unwrap();
    let (mut schedule, warnings) =
        SumoDemand::read(demand.as_bytes()).unwrap().schedule(&net, Seed(4)).unwrap();
    let warned: Vec<String> = warnings.iter().map(ToString::to_string).collect();
    assert_eq!(warned.len(), 2, "a vehicle has the name: {warned:?}");
    assert!(warned.iter().all(|warning| warning.contains("personTrip `p` does not take vehicle `p_0`")));
    let config = TrafficConfig { vehicles: 0, pedestrians: 0, ..TrafficConfig::default() };
    let mut traffic = Traffic::new(Arc::new(net.network), &config, Seed(4)).unwrap();
    let mut recorder = Recorder::new(&traffic, net.names);
    let output = recorder.add(TripInfo::new(Vec::new(), Syntax::Csv).unwrap());
    for _ in 0..6000 {
        schedule.feed(&mut traffic).unwrap();
        traffic.step(0.1);
        schedule.name(&traffic, &mut recorder);
        recorder.observe(&traffic).unwrap();
    }
    recorder.finish().unwrap();
    assert_eq!(schedule.people(), arrived(1));
    let csv = std::str::from_utf8(recorder.get(output).writer()).unwrap();
    let mut names: Vec<&str> = csv.lines().skip(1).filter_map(|line| line.split(';').next()).collect();
    names.sort_unstable();
    assert_eq!(names, ["p_0", "p_0", "p_b1"], "{csv}");
}

#[test]
fn what_cannot_be_driven_is_walked_and_told_of() {
    // A type that is nowhere.
    let broken = persons("", &[("p", r#"<personTrip from="A0B0" to="C1C2" vTypes="none"/>"#)]);
    let net = SumoNet::read(GRID.as_bytes()).unwrap();
    let error = SumoDemand::read(broken.as_bytes()).unwrap().schedule(&net, Seed(1)).map(|_| ()).unwrap_err();
    assert!(error.to_string().contains("none"), "{error}");
    // An edge for buses alone.
    let buses = ["1", "2"].iter().fold(GRID.to_owned(), |net, lane| {
        let lane = format!(r#"<lane id="A0A1_{lane}" index="{lane}" disallow="pedestrian""#);
        assert!(net.contains(&lane));
        net.replace(&lane, &lane.replace(r#"disallow="pedestrian""#, r#"allow="bus""#))
    });
    let to_buses = r#"<personTrip from="A0B0" to="A0A1" modes="car"/>"#;
    let ran = run(&buses, &persons("", &[("p", to_buses)]), 400);
    assert_eq!((ran.people, ran.trips.len()), (arrived(1), 0));
    assert_eq!(ran.warnings.len(), 1, "{:?}", ran.warnings);
    assert!(ran.warnings[0].contains("personTrip `p` cannot be driven"), "{:?}", ran.warnings);
    let taxi = r#"<personTrip from="A0B0" to="B0B1" modes="car taxi"/>"#;
    let ran = run(GRID, &persons("", &[("p", taxi)]), 400);
    assert_eq!((ran.people, ran.trips.len()), (arrived(1), 1));
    assert!(ran.warnings[0].contains("without counterpart"), "{:?}", ran.warnings);
}

#[test]
fn drives_keep_to_what_is_open_to_them() {
    let net = SumoNet::read(MIXED.as_bytes()).unwrap();
    let router = Router::new(&net.network);
    let types = TrafficConfig::default().types;
    let roads = (0..net.network.roads.len()).map(RoadId::from_index);
    let both =
        |road| [LaneDirection::Forward, LaneDirection::Backward].map(|direction| Leg::new(road, direction));
    let legs: Vec<Leg> = roads.flat_map(both).filter(|leg| !leg.lanes(&net.network).is_empty()).collect();
    let (mut found, mut shut) = (0, 0);
    for from in &legs {
        for to in &legs {
            let car = VehicleChoice::from(VehicleKind::Car);
            let ends = ((*from, 1.0), (*to, 1e9));
            let Some(drive) = PersonDrive::quickest(&net.network, &router, ends, car, &types) else {
                shut += 1;
                continue;
            };
            found += 1;
            let bicycle = VehicleChoice::from(VehicleKind::Bicycle);
            let ridden = PersonDrive::quickest(&net.network, &router, ends, bicycle, &types);
            assert!(ridden.is_none_or(|ridden| ridden.seconds > drive.seconds), "{drive:?}");
            let free = router.time(&drive.route).unwrap();
            assert!(drive.seconds > 0.5 * free && drive.seconds.is_finite(), "{drive:?} {free}");
        }
    }
    assert!(found > 10 && shut > 0, "{found} and {shut}");
}
