//! What is recorded and drawn of a run: figures agree with a count by hand, pictures are sound XML that show what was seen.

use std::sync::Arc;

use simworld_core::id::{IntersectionId, RoadId};
use simworld_core::net::{LaneDirection, NetworkConfig, RoadNetwork, StreetPlan};
use simworld_core::seed::Seed;
use simworld_traffic::look::{
    Film, LevelOfService, Quantity, Recorder, Street, Trajectories, fundamental_diagram, junction_film,
    network_map, service_chart, time_space_diagram,
};
use simworld_traffic::vehicle::{Idm, VehicleKind};
use simworld_traffic::{Leg, Route, Traffic, TrafficConfig};

const DT: f64 = 0.1;

fn grid(vehicles: u32) -> Traffic {
    let network = RoadNetwork::derive(&StreetPlan::grid(4, 3, 130.0), &NetworkConfig::default());
    let config = TrafficConfig { vehicles, pedestrians: 40, ..TrafficConfig::default() };
    Traffic::new(Arc::new(network.expect("a grid is a network")), &config, Seed(3)).expect("in range")
}

#[test]
fn the_record_agrees_with_a_count_by_hand() {
    let mut traffic = grid(50);
    let lanes = traffic.network().lanes.len();
    let mut recorder = Recorder::new(&traffic);
    let (mut time, mut distance, mut on_lane) = (0.0, 0.0, 0.0);
    for _ in 0..3000 {
        traffic.step(DT);
        recorder.look(&traffic, DT);
        for (_, track, _, v) in traffic.stations() {
            time += DT;
            distance += v * DT;
            on_lane += if track == 5 { DT } else { 0.0 };
        }
    }
    let totals = recorder.totals();
    assert!((totals.time - time).abs() < 1e-6 && (totals.distance - distance).abs() < 1e-6);
    assert!((totals.seconds - 300.0).abs() < 1e-6 && totals.stops > 20);
    let length = traffic.network().lanes[5].length;
    let used = recorder.lane(5);
    assert!((used.density(length, 300.0) * length * 300.0 - on_lane).abs() < 1e-6);
    // By Edie, flow is density times speed.
    assert!((used.flow(length, 300.0) - used.density(length, 300.0) * used.speed()).abs() < 1e-9);
    let crossed: u32 = recorder.junctions().iter().map(|junction| junction.vehicles).sum();
    let leaves = traffic.counters().crossings;
    assert!(u64::from(crossed) <= leaves && u64::from(crossed) + 100 > leaves, "{crossed} of {leaves}");
    assert_eq!(recorder.network_minutes().len(), 5);
    assert!(recorder.lane_minutes().len() <= 5 * lanes);
}

#[test]
fn a_car_alone_at_green_lights_has_no_delay_and_one_at_red_has_what_it_stood() {
    let delay = |red_first: bool| {
        let network = RoadNetwork::derive(&StreetPlan::crossroads(200.0), &NetworkConfig::default());
        let config = TrafficConfig { vehicles: 0, pedestrians: 0, ..TrafficConfig::default() };
        let mut traffic =
            Traffic::new(Arc::new(network.expect("a crossroads is a network")), &config, Seed(1))
                .expect("in range");
        let lane = traffic.network().roads[0].backward[0];
        let way = traffic.network().lanes[lane.index()].outgoing[0];
        let group = traffic.network().connections[way.index()].signal.expect("it has signals");
        let mut plans = traffic.plans().to_vec();
        let ours = plans[0].phases.iter().position(|p| p.green.contains(&group) && p.yellow.is_empty());
        let ours = ours.expect("it has a green");
        plans[0].phases[ours].duration = 200.0;
        let before: f64 = plans[0].phases[..ours].iter().map(|phase| phase.duration).sum();
        // Either the green has just begun, or sixty seconds of something else come first.
        plans[0].offset = if red_first { before - 40.0 } else { before };
        traffic.set_plans(plans).expect("the plan is for the same groups");
        let leg = |road, direction| Leg::new(RoadId(road), direction);
        let route = Route(vec![leg(0, LaneDirection::Backward), leg(2, LaneDirection::Forward)]);
        traffic.insert(route, VehicleKind::Car).expect("the route is sound");
        let mut recorder = Recorder::new(&traffic);
        while traffic.seconds() < 120.0 {
            traffic.step(DT);
            recorder.look(&traffic, DT);
        }
        let junction = recorder.junctions()[0];
        assert_eq!(junction.vehicles, 1);
        junction.mean()
    };
    let (green, red) = (delay(false), delay(true));
    assert!(green < 2.0, "{green} s at green");
    assert!((15.0..45.0).contains(&red), "{red} s at red");
}

#[test]
fn classes_of_service_rise_with_delay() {
    for signals in [true, false] {
        let classes: Vec<LevelOfService> =
            (0..120).map(|delay| LevelOfService::of(f64::from(delay), signals)).collect();
        assert!(classes.is_sorted());
        assert_eq!((classes[0], classes[119]), (LevelOfService::A, LevelOfService::F));
    }
}

#[test]
fn pictures_are_sound_and_show_what_was_seen() {
    let mut traffic = grid(60);
    let network = Arc::clone(traffic.network());
    let street = Street::busiest(&network, 2000.0).expect("a grid has streets");
    assert!(street.signals.len() >= 2 && street.length() > 250.0, "{street:?}");
    let (mut recorder, mut lines) = (Recorder::new(&traffic), Trajectories::new(street));
    let mut film = Film::new(&network, IntersectionId(5), 40.0);
    for _ in 0..2400 {
        traffic.step(DT);
        recorder.look(&traffic, DT);
        lines.look(&traffic);
        film.look(&traffic);
    }
    let pictures = [
        network_map(&recorder, &network, Quantity::Density),
        network_map(&recorder, &network, Quantity::Speed),
        fundamental_diagram(&recorder, &Idm::default(), "A <title> & more"),
        time_space_diagram(&lines, "time"),
        service_chart(&recorder, &network, "service"),
        junction_film(&film, &network, "film"),
    ];
    let mut elements = Vec::new();
    for svg in &pictures {
        let document = roxmltree::Document::parse(svg).expect("it is sound XML");
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "a place that is nowhere");
        elements.push(document.descendants().filter(roxmltree::Node::is_element).count());
    }
    // Dots of the diagram, lines of vehicles, bodies of the film.
    assert!(elements[2] > 100 && elements[3] > 40 && elements[5] > 40, "{elements:?}");
    assert!(pictures[2].contains("A &lt;title&gt; &amp; more"));
}

#[test]
fn pictures_of_nothing_are_sound_too() {
    let traffic = grid(0);
    let network = traffic.network();
    let recorder = Recorder::new(&traffic);
    let street = Street::busiest(network, 500.0).expect("a grid has streets");
    for svg in [
        network_map(&recorder, network, Quantity::Speed),
        fundamental_diagram(&recorder, &Idm::default(), "nothing"),
        service_chart(&recorder, network, "nothing"),
        time_space_diagram(&Trajectories::new(street), "nothing"),
        junction_film(&Film::new(network, IntersectionId(0), 30.0), network, "nothing"),
    ] {
        roxmltree::Document::parse(&svg).expect("it is sound XML");
        assert!(!svg.contains("NaN"), "{svg}");
    }
}
