//! What is written is what happened: detectors count every vehicle once, means agree with trips, files are well formed.

use std::sync::Arc;

use simworld_core::id::RoadId;
use simworld_core::net::{CrossSection, LaneDirection, NetworkConfig, RoadNetwork, StreetPlan};
use simworld_core::seed::Seed;
use simworld_traffic::output::{
    AreaOutput, Fcd, InductionLoop, LaneArea, LoopOutput, MeanOutput, PerWhat, Recorder, Summary, Syntax,
    TripInfo,
};
use simworld_traffic::vehicle::VehicleKind;
use simworld_traffic::{Arrivals, Departing, Flow, Leg, Route, Schedule, Traffic, TrafficConfig};

fn crossroads() -> Arc<RoadNetwork> {
    let mut plan = StreetPlan::crossroads(300.0);
    plan.sections[0] = CrossSection::two_way(1, 1);
    Arc::new(RoadNetwork::derive(&plan, &NetworkConfig::default()).unwrap())
}

fn empty(network: &Arc<RoadNetwork>) -> Traffic {
    let config = TrafficConfig { vehicles: 0, pedestrians: 0, ..TrafficConfig::default() };
    Traffic::new(Arc::clone(network), &config, Seed(5)).unwrap()
}

/// In on the first arm, out on the third.
fn straight() -> Route {
    Route(vec![Leg::new(RoadId(0), LaneDirection::Backward), Leg::new(RoadId(2), LaneDirection::Forward)])
}

fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).unwrap()
}

fn values<'a>(xml: &'a str, element: &'a str, name: &'a str) -> impl Iterator<Item = &'a str> {
    let (start, key) = (format!("<{element} "), format!(" {name}=\""));
    xml.lines().map(str::trim).filter(move |line| line.starts_with(&start)).map(move |line| {
        line.split(&key).nth(1).and_then(|rest| rest.split('"').next()).unwrap_or_else(|| panic!("{line}"))
    })
}

#[test]
fn every_vehicle_is_counted_once_by_every_detector_on_its_way() {
    let network = crossroads();
    let mut traffic = empty(&network);
    let mut recorder = Recorder::of(&traffic);
    let (entry, exit) = (straight().0[0].lanes(&network)[0], straight().0[1].lanes(&network)[0]);
    let length = network.lanes[entry.index()].length;
    // At the very beginning of a lane, in its middle, at the stop line, and behind the junction.
    let loops = [
        ("middle", entry, 150.0),
        ("line", entry, length - 0.2),
        ("behind", exit, 0.1),
        ("out", exit, 200.0),
    ]
    .map(|(name, lane, station)| InductionLoop::new(name, lane, station));
    let loops = recorder.add(LoopOutput::new(loops.to_vec(), 1e6));
    let short = recorder.add(LoopOutput::new(vec![InductionLoop::new("middle", entry, 150.0)], 60.0));
    let trips = recorder.add(TripInfo::new(Vec::new(), Syntax::Xml).unwrap());
    let summary = recorder.add(Summary::new(Vec::new(), Syntax::Csv).unwrap());
    let means = recorder.add(MeanOutput::new(PerWhat::Edge, 1200.0));
    let mut schedule = Schedule::new(Seed(2));
    let flow = Flow {
        arrivals: Arrivals::Uniform,
        kind: Some(VehicleKind::Car),
        until: 600.0,
        ..Flow::new(straight(), 400.0)
    };
    schedule.add_flow("f", flow, 50).unwrap();
    schedule.add(Departing::new("bus <1>", 30.05, straight(), VehicleKind::Bus.into()));
    let (mut counted, mut distance) = (0, 0.0);
    for step in 0..12_000 {
        schedule.feed(&mut traffic).unwrap();
        traffic.step(0.1);
        schedule.name(&traffic, &mut recorder);
        recorder.observe(&traffic).unwrap();
        distance += traffic.ended().iter().map(|trip| trip.distance).sum::<f64>();
        if (step + 1) % 600 == 0 {
            counted += recorder.get(short).readings()[0].passed;
        }
    }
    assert!(schedule.is_over());
    assert_eq!(traffic.counters().arrived, 51);
    assert_eq!(counted, 51, "interval by interval");
    assert!(recorder.get(loops).readings().is_empty(), "its interval is not over");
    let edge = |leg: usize| *recorder.get(means).edge(straight().0[leg]).unwrap();
    assert_eq!((edge(0).departed, edge(0).left, edge(1).entered, edge(1).arrived), (51, 51, 51, 51));
    let ways: f64 = network
        .connections
        .iter()
        .filter(|way| way.from == entry && way.to == exit)
        .map(|way| way.length)
        .sum();
    let driven = edge(0).distance + edge(1).distance + 51.0 * ways;
    assert!((driven / distance - 1.0).abs() < 0.01, "{driven} m on edges, {distance} m of trips");
    recorder.finish().unwrap();
    let xml = text(recorder.get(trips).writer());
    assert!(xml.trim_end().ends_with("</tripinfos>"));
    let names: Vec<&str> = values(xml, "tripinfo", "id").collect();
    assert_eq!(names.len(), 51);
    assert!(names.contains(&"bus &lt;1&gt;") && names.contains(&"f.0") && names.contains(&"f.49"));
    let bus = names.iter().position(|name| name.starts_with("bus")).unwrap();
    let scheduled: f64 = ["depart", "departDelay"]
        .map(|name| values(xml, "tripinfo", name).nth(bus).unwrap().parse::<f64>().unwrap())
        .into_iter()
        .reduce(|depart, delay| depart - delay)
        .unwrap();
    assert!((scheduled - 30.05).abs() < 0.011, "{scheduled}");
    let csv = text(recorder.get(summary).writer());
    let (head, last) = (csv.lines().next().unwrap(), csv.lines().last().unwrap());
    let column = |name: &str| {
        let place = head.split(';').position(|other| other == name).unwrap();
        last.split(';').nth(place).unwrap()
    };
    assert_eq!((column("arrived"), column("running"), column("time")), ("51", "0", "1200.00"));
    assert_eq!(csv.lines().count(), 12_001);
}

#[test]
fn a_loop_measures_flow_speed_and_occupancy_of_free_traffic() {
    let network = crossroads();
    let mut traffic = empty(&network);
    let mut recorder = Recorder::of(&traffic);
    let exit = straight().0[1].lanes(&network)[0];
    let loops = ["a", "b"].map(|name| InductionLoop::new(name, exit, 200.0));
    let id = recorder.add(LoopOutput::new(loops.to_vec(), 900.0));
    let flow =
        Flow { arrivals: Arrivals::Uniform, kind: Some(VehicleKind::Car), ..Flow::new(straight(), 360.0) };
    traffic.add_flow(flow).unwrap();
    for _ in 0..18_000 {
        traffic.step(0.1);
        recorder.observe(&traffic).unwrap();
    }
    let [a, b] = recorder.get(id).readings() else { panic!("two loops have two readings") };
    assert_eq!(a, b);
    assert_eq!((a.begin, a.end), (900.0, 1800.0));
    assert!((a.flow - 360.0).abs() <= 16.0, "{} veh/h", a.flow);
    let limit = network.lanes[exit.index()].speed_limit;
    assert!(a.harmonic_speed > 0.7 * limit && a.harmonic_speed <= a.mean_speed + 1e-9, "{a:?}");
    // The time above the loop is that of a length at the mean slowness (Hall 1996).
    let expected = a.flow / 3600.0 * a.mean_length / a.harmonic_speed;
    assert!((a.occupancy / expected - 1.0).abs() < 0.03, "{} against {expected}", a.occupancy);
}

#[test]
fn an_area_before_a_red_signal_holds_the_queue() {
    let network = crossroads();
    let mut traffic = empty(&network);
    let mut plans = traffic.plans().to_vec();
    // Red for all, all the time but for an instant.
    for plan in &mut plans {
        for phase in &mut plan.phases {
            phase.duration = 1.0;
        }
        let last = plan.phases.len() - 1;
        plan.phases[last].duration = 10_000.0;
        plan.offset = plan.cycle() - 10_000.0;
    }
    traffic.set_plans(plans).unwrap();
    let mut recorder = Recorder::of(&traffic);
    let entry = straight().0[0].lanes(&network)[0];
    let length = network.lanes[entry.index()].length;
    let id = recorder.add(AreaOutput::new(vec![LaneArea::new("queue", entry, 0.0, length)], 60.0));
    for _ in 0..8 {
        traffic.insert(straight(), VehicleKind::Car).unwrap();
    }
    for _ in 0..1800 {
        traffic.step(0.1);
        recorder.observe(&traffic).unwrap();
    }
    let queue = recorder.get(id).readings()[0];
    assert_eq!((queue.max_jam.0, queue.max_vehicles, queue.entered, queue.left), (8, 8, 0, 0));
    let lengths: f64 = traffic.vehicles().map(|_| 4.5 + 2.0).sum();
    assert!((queue.max_jam.1 - lengths).abs() < 6.0, "{} m", queue.max_jam.1);
    assert!((queue.sampled_seconds - 8.0 * 60.0).abs() < 1.0 && queue.mean_speed < 0.05, "{queue:?}");
    assert!((queue.mean_occupancy - 8.0 * 4.5 / length).abs() < 0.01, "{}", queue.mean_occupancy);
}

#[test]
fn trajectories_are_where_vehicles_are() {
    let network = crossroads();
    let config = TrafficConfig { vehicles: 12, pedestrians: 0, ..TrafficConfig::default() };
    let mut traffic = Traffic::new(Arc::clone(&network), &config, Seed(5)).unwrap();
    let mut recorder = Recorder::of(&traffic);
    let id = recorder.add(Fcd::new(Vec::new(), Syntax::Xml, 1.0).unwrap());
    for _ in 0..300 {
        traffic.step(0.1);
        recorder.observe(&traffic).unwrap();
    }
    recorder.finish().unwrap();
    let xml = text(recorder.get(id).writer());
    let times: Vec<f64> =
        values(xml, "timestep", "time").map(|time| time.trim_end_matches('>').parse().unwrap()).collect();
    assert!(
        times.len() >= 30 && times.windows(2).all(|pair| (pair[1] - pair[0] - 1.0).abs() < 1e-6),
        "{times:?}"
    );
    assert_eq!(values(xml, "vehicle", "id").count(), times.len() * 12);
    for (lane, pos) in values(xml, "vehicle", "lane").zip(values(xml, "vehicle", "pos")) {
        assert!(lane.starts_with('r') || lane.starts_with("-r") || lane.starts_with(":j"), "{lane}");
        assert!(pos.parse::<f64>().unwrap() >= 0.0);
    }
    assert_eq!(xml.matches("<timestep").count(), xml.matches("</timestep>").count());
}
