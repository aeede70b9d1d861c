//! Networks of SUMO: what the file says of lanes, ways, right of way and signals is what the network has; whatever is
//! broken is refused with its id, and nothing panics.

use std::sync::Arc;

use proptest::prelude::*;
use simworld_core::id::{ConnectionId, IntersectionId, RoadId};
use simworld_core::net::{
    Aspect, Control, DrivingSide, LaneDirection, LaneKind, RoadNetwork, Turn, polyline,
};
use simworld_core::seed::Seed;
use simworld_traffic::sumo::{SumoError, SumoNet};
use simworld_traffic::vehicle::VehicleKind;
use simworld_traffic::{Leg, Router, Traffic, TrafficConfig};

/// 3 by 3 junctions with signals, two lanes a direction, sidewalks and crossings, by netgenerate 1.28.
const GRID: &str = include_str!("data/grid.net.xml");
/// A random network with priority junctions, by netgenerate 1.28.
const COUNTRY: &str = include_str!("data/country.net.xml");
/// Traffic on the left, a roundabout, lanes for buses, bicycles and trams, heights; made by hand.
const MIXED: &str = include_str!("data/mixed.net.xml");

fn read(xml: &str) -> SumoNet {
    SumoNet::read(xml.as_bytes()).unwrap_or_else(|error| panic!("{error}"))
}

/// The tags of a file by name, as roxmltree would have them, but without it: one tag a line.
fn tags<'a>(xml: &'a str, name: &str) -> impl Iterator<Item = &'a str> {
    let start = format!("<{name} ");
    xml.lines().map(str::trim).filter(move |line| line.starts_with(&start))
}

fn attribute<'a>(tag: &'a str, name: &str) -> Option<&'a str> {
    let start = tag.find(&format!(" {name}=\""))? + name.len() + 3;
    tag[start..].split('"').next()
}

fn is_own(tag: &&str) -> bool {
    attribute(tag, "from").is_some_and(|from| !from.starts_with(':'))
        && attribute(tag, "to").is_some_and(|to| !to.starts_with(':'))
}

#[test]
fn everything_in_the_file_is_in_the_network() {
    // In the country each direction of a street has its own junctions, where its turning lanes begin.
    for (name, xml, directions) in [("grid", GRID, 2), ("country", COUNTRY, 1)] {
        let SumoNet { network, names, warnings, .. } = read(xml);
        assert_eq!(network.check(), Ok(()));
        assert!(warnings.is_empty(), "{name}: {}", warnings[0]);
        let edges: Vec<&str> = tags(xml, "edge").filter(is_own).collect();
        assert_eq!(network.roads.len() * directions, edges.len(), "{name}");
        for edge in &edges {
            let leg = names.leg(attribute(edge, "id").unwrap()).unwrap();
            assert!(!leg.lanes(&network).is_empty(), "{edge}");
        }
        for tag in tags(xml, "lane").filter(|tag| !attribute(tag, "id").unwrap().starts_with(':')) {
            let id = attribute(tag, "id").unwrap();
            let number = |name: &str| attribute(tag, name).unwrap().parse::<f64>().unwrap();
            let Some(lane) = names.lane_id(id) else {
                assert_eq!(attribute(tag, "allow"), Some("pedestrian"), "{id} is missing");
                continue;
            };
            let lane = &network.lanes[lane.index()];
            assert!((lane.length - number("length")).abs() < 0.1, "{id}: {} m", lane.length);
            assert_eq!(lane.speed_limit, number("speed"), "{id}");
            assert_eq!(lane.kind, LaneKind::Driving);
        }
        let ways = tags(xml, "connection").filter(is_own).count();
        assert_eq!(network.connections.len(), ways, "{name}");
        for (index, way) in network.connections.iter().enumerate() {
            let (entry, exit) = (&network.lanes[way.from.index()], &network.lanes[way.to.index()]);
            assert_eq!(way.path.first(), entry.path.last());
            assert_eq!(way.path.last(), exit.path.first());
            let via = names.connection(ConnectionId::from_index(index));
            assert!(via.starts_with(':'), "{via}");
        }
        let turned = network.connections.iter().filter(|way| way.turn == Turn::Left).count();
        let left = tags(xml, "connection")
            .filter(is_own)
            .filter(|tag| matches!(attribute(tag, "dir"), Some("l" | "L")));
        assert_eq!(turned, left.count());
    }
}

#[test]
fn lanes_of_a_road_lie_beside_one_another_from_the_middle_outwards() {
    for xml in [GRID, COUNTRY, MIXED] {
        let network = read(xml).network;
        let outwards = if network.driving_side == DrivingSide::Right { -1.0 } else { 1.0 };
        for lanes in network.roads.iter().flat_map(|road| [&road.forward, &road.backward]) {
            for pair in lanes.windows(2) {
                let (inner, outer) = (&network.lanes[pair[0].index()], &network.lanes[pair[1].index()]);
                let middle = polyline::at(&outer.path, outer.length * 0.5).0;
                let lateral = polyline::closest(&inner.path, &middle).unwrap().lateral * outwards;
                assert!((1.0..8.0).contains(&lateral), "{lateral} m apart");
            }
        }
    }
}

#[test]
fn who_gives_way_is_what_the_requests_say() {
    let network = read(COUNTRY).network;
    let mut yields = 0;
    for (index, way) in network.connections.iter().enumerate() {
        let id = ConnectionId::from_index(index);
        for rival in &way.conflicts {
            let rival = &network.connections[rival.index()];
            assert!(rival.conflicts.contains(&id), "conflicts are mutual");
            assert_ne!(rival.from, way.from, "one file of vehicles");
            assert!(!(way.yields_to.contains(rival_id(&network, rival)) && rival.yields_to.contains(&id)));
        }
        yields += way.yields_to.len();
        // A turn across the oncoming traffic gives way to it.
        if way.turn == Turn::Straight {
            assert!(way.yields_to.iter().all(|to| network.connections[to.index()].from != way.from));
        }
    }
    // Every digit of the responses between vehicles, but for those from one lane, which are none.
    let digits: usize = tags(COUNTRY, "request")
        .map(|tag| attribute(tag, "response").unwrap().bytes().filter(|digit| *digit == b'1').count())
        .sum();
    assert_eq!(yields, digits);
    assert!(network.intersections.iter().all(|place| place.control != Control::Signals));
}

fn rival_id<'a>(network: &'a RoadNetwork, way: &simworld_core::net::Connection) -> &'a ConnectionId {
    let place = &network.intersections[way.intersection.index()];
    place.connections.iter().find(|id| network.connections[id.index()] == *way).unwrap()
}

#[test]
fn signals_show_what_the_states_say() {
    let SumoNet { network, names, .. } = read(GRID);
    assert_eq!(network.signals.len(), 9);
    let mut phases: Vec<(f64, String)> = Vec::new();
    let mut programs: Vec<(&str, Vec<(f64, String)>)> = Vec::new();
    for line in GRID.lines().map(str::trim) {
        if line.starts_with("<tlLogic ") {
            programs.push((attribute(line, "id").unwrap(), Vec::new()));
        } else if line.starts_with("<phase ") {
            let duration = attribute(line, "duration").unwrap().parse().unwrap();
            phases.push((duration, attribute(line, "state").unwrap().to_owned()));
            programs.last_mut().unwrap().1.push(phases.last().unwrap().clone());
        }
    }
    for (index, place) in network.intersections.iter().enumerate() {
        let plan = &network.signals[place.signals.unwrap() as usize];
        let name = names.junction(IntersectionId::from_index(index));
        let (_, program) = programs.iter().find(|(id, _)| *id == name).unwrap();
        assert_eq!(plan.phases.len(), program.len());
        let links = tags(GRID, "connection").filter(|tag| attribute(tag, "tl") == Some(name));
        for tag in links.filter(is_own) {
            let lane = |edge: &str, lane: &str| {
                let name = format!("{}_{}", attribute(tag, edge).unwrap(), attribute(tag, lane).unwrap());
                names.lane_id(&name).unwrap()
            };
            let (from, to) = (lane("from", "fromLane"), lane("to", "toLane"));
            let way = network.connections.iter().find(|way| (way.from, way.to) == (from, to)).unwrap();
            let link: usize = attribute(tag, "linkIndex").unwrap().parse().unwrap();
            for (phase, (duration, state)) in plan.phases.iter().zip(program) {
                let aspect = match state.as_bytes()[link] {
                    b'G' | b'g' => Aspect::Green,
                    b'y' => Aspect::Yellow,
                    _ => Aspect::Red,
                };
                assert_eq!((phase.duration, phase.aspect(way.signal.unwrap())), (*duration, aspect));
            }
        }
    }
    assert!(network.crossings.iter().all(|crossing| crossing.signal.is_some()));
    assert_eq!(
        network.crossings.len(),
        tags(GRID, "edge").filter(|tag| tag.contains("crossingEdges")).count()
    );
}

#[test]
fn an_offset_delays_the_program() {
    let later = GRID.replace(
        r#"<tlLogic id="B1" type="static" programID="0" offset="0">"#,
        r#"<tlLogic id="B1" type="static" programID="0" offset="12">"#,
    );
    assert_ne!(later, GRID);
    let SumoNet { network, names, .. } = read(&later);
    let at = |plan: &simworld_core::net::SignalPlan| names.junction(plan.intersection).to_owned();
    for plan in &network.signals {
        let expected = if at(plan) == "B1" { plan.cycle() - 12.0 } else { 0.0 };
        assert_eq!(plan.offset, expected, "{}", at(plan));
    }
}

#[test]
fn people_and_vehicles_move_on_it() {
    let network = Arc::new(read(GRID).network);
    let config = TrafficConfig { vehicles: 60, pedestrians: 40, ..TrafficConfig::default() };
    let mut traffic = Traffic::new(Arc::clone(&network), &config, Seed(3)).unwrap();
    assert_eq!((traffic.placed().vehicles, traffic.placed().pedestrians), (60, 40));
    let mut crossed = 0;
    for _ in 0..3000 {
        traffic.step(0.1);
        crossed += traffic.pedestrians().iter().filter(|walker| walker.crossing().is_some()).count();
    }
    assert_eq!(traffic.vehicles().count(), 60);
    assert!(traffic.counters().crossings > 300, "{:?}", traffic.counters());
    assert_eq!(traffic.counters().forced_stops, 0);
    assert!(crossed > 0, "somebody crosses in five minutes");
}

#[test]
fn nobody_stands_for_good_where_junctions_are_a_car_length_apart() {
    // Streets of the country end nowhere: whoever has no route stops there. Its turning lanes are 2 to 5 m long.
    let network = Arc::new(read(COUNTRY).network);
    let config = TrafficConfig { vehicles: 0, pedestrians: 0, ..TrafficConfig::default() };
    let mut traffic = Traffic::new(Arc::clone(&network), &config, Seed(3)).unwrap();
    let router = Router::new(&network);
    let legs: Vec<Leg> =
        (0..network.roads.len()).map(|road| Leg::new(RoadId(road as u32), LaneDirection::Forward)).collect();
    let mut sent = 0;
    for (index, from) in legs.iter().enumerate() {
        let to = legs[(index * 7 + 11) % legs.len()];
        let is_long = from.lanes(&network).iter().all(|lane| network.lanes[lane.index()].length > 20.0);
        let route = router.quickest(*from, to).filter(|route| is_long && route.0.len() > 2);
        if let Some(route) = route {
            traffic.insert(route, VehicleKind::Car).unwrap();
            sent += 1;
        }
    }
    assert!(sent > 15, "{sent} pairs of edges have a way between them");
    for _ in 0..6000 {
        traffic.step(0.1);
    }
    // Some took another way, for there was no room to change lanes; they may still look for theirs.
    let counters = traffic.counters();
    assert_eq!((counters.entered, counters.long_waits), (sent, 0), "{counters:?}");
    assert!(counters.arrived * 2 > sent, "{counters:?}");
}

#[test]
fn lanes_of_every_kind_keep_to_the_left_round_a_roundabout() {
    let SumoNet { network, names, warnings, offset, programs, .. } = read(MIXED);
    assert_eq!(network.driving_side, DrivingSide::Left);
    assert_eq!(offset, (-500.0, -700.0));
    let kind = |name: &str| names.lane_id(name).map(|lane| network.lanes[lane.index()].kind);
    assert_eq!(kind("in_2"), Some(LaneKind::Driving));
    assert_eq!(kind("in_1"), Some(LaneKind::Bus));
    assert_eq!(kind("in_0"), Some(LaneKind::Cycle));
    assert_eq!(kind("rail_0"), None);
    assert!(warnings.iter().any(|warning| warning.id == "rail_0"), "{warnings:?}");
    assert_eq!(programs.actuated(), 1);
    let road = |edge: &str| &network.roads[names.leg(edge).unwrap().road().index()];
    assert!(road("ring1").roundabout && !road("in").roundabout);
    assert_eq!(road("in").profile, [(50.0, 3.5)]);
    assert_eq!(road("in").cycle.len(), 1);
    // Two ways into one lane meet, even where the requests forgot it.
    let into = network.connections.iter().filter(|way| Some(way.to) == names.lane_id("ring1_0"));
    assert!(into.clone().count() == 2 && into.clone().all(|way| way.conflicts.len() == 1));
}

#[test]
fn what_is_broken_is_named() {
    let refused = |from: &str, to: &str| {
        let broken = GRID.replacen(from, to, 1);
        assert_ne!(broken, GRID, "{from} is in the file");
        SumoNet::read(broken.as_bytes()).map(|_| ()).expect_err(to)
    };
    let is = |error: SumoError, words: &[&str]| {
        let text = error.to_string();
        assert!(words.iter().all(|word| text.contains(word)), "{text}");
    };
    is(refused(r#"from="A0" to="A1""#, r#"from="A0" to="Z9""#), &["edge `A0A1`", "junction `Z9`"]);
    is(refused(r#"from="A0A1" to="A1B1""#, r#"from="A0A1" to="Q""#), &["connection", "edge `Q`"]);
    is(refused(r#"fromLane="1" toLane="1""#, r#"fromLane="7" toLane="1""#), &["lane `A0A1_7`"]);
    is(refused(r#"via=":A1_6_0""#, r#"via=":A1_66_0""#), &["internal lane `:A1_66_0`"]);
    is(refused(r#"tl="A1" linkIndex="6""#, r#"tl="XX" linkIndex="6""#), &["signal `XX`"]);
    is(refused(r#"tl="A1" linkIndex="6""#, r#"tl="A1" linkIndex="600""#), &["tlLogic `A1`", "link 600"]);
    is(refused(r#"speed="13.89""#, r#"speed="fast""#), &["`fast` is no number"]);
    is(refused(r#"shape="8.40,-4.80"#, r#"shape="1e300,-4.80"#), &["`1e300,-4.80`"]);
    is(refused(r#"duration="42""#, r#"duration="-1""#), &["duration"]);
    is(refused(r#"<edge id="A0B0""#, r#"<edge id="A0A1""#), &["`A0A1` is there twice"]);
    is(refused("<net ", "<routes "), &["byte", "routes"]);
    // A turn in two pieces whose second leads back to the first.
    let circle = refused(
        r#"<connection from=":A1_9" to="A1B1" fromLane="0" toLane="2""#,
        r#"<connection from=":A1_9" to="A1B1" fromLane="0" toLane="2" via=":A1_2_0""#,
    );
    assert!(matches!(circle, SumoError::Circle { .. }), "{circle}");
    is(SumoNet::read("<net/>".as_bytes()).unwrap_err(), &["no edge with lanes"]);
}

#[test]
fn a_file_that_ends_too_early_is_refused() {
    let end = GRID.rfind("</net>").unwrap();
    for cut in (0..end).step_by(997).chain([end - 1, end]) {
        let read = SumoNet::read(&GRID.as_bytes()[..cut]);
        assert!(matches!(read, Err(SumoError::Xml { .. })), "cut at {cut}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(if std::env::var_os("SIMWORLD_SOAK").is_some() { 20_000 } else { 150 }))]

    /// Digits, names and quotes replaced at random: refused, or a network that holds together.
    #[test]
    fn hostile_files_are_refused_or_hold_together(
        places in prop::collection::vec((0.0..1.0_f64, "[0-9a-z:_,.<>\"&e-]{1,6}"), 1..6)
    ) {
        let mut xml = COUNTRY.as_bytes().to_vec();
        for (share, text) in places {
            let at = ((xml.len() - 8) as f64 * share) as usize;
            xml[at..at + text.len()].copy_from_slice(text.as_bytes());
        }
        if let Ok(read) = SumoNet::read(xml.as_slice()) {
            prop_assert_eq!(read.network.check(), Ok(()));
        }
    }

    /// Whole tags left out, doubled or put elsewhere.
    #[test]
    fn shuffled_files_are_refused_or_hold_together(
        moves in prop::collection::vec((0.0..1.0_f64, 0.0..1.0_f64, 0..3_u8), 1..8)
    ) {
        let mut lines: Vec<&str> = COUNTRY.lines().collect();
        for (from, to, how) in moves {
            let place = |share: f64, len: usize| (share * len as f64) as usize;
            let from = place(from, lines.len());
            let line = if how == 0 { lines[from] } else { lines.remove(from) };
            if how < 2 {
                lines.insert(place(to, lines.len()), line);
            }
        }
        if let Ok(read) = SumoNet::read(lines.join("\n").as_bytes()) {
            prop_assert_eq!(read.network.check(), Ok(()));
        }
    }
}
