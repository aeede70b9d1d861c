//! OpenDRIVE says which lane leads where: so it is in the city, and what we write leads the same ways when it is read.
#![cfg(feature = "opendrive")]

use std::collections::{BTreeMap, BTreeSet};

use simworld_citygen::files::opendrive::OpenDrive;
use simworld_citygen::{City, CityConfig, Style};
use simworld_core::id::LaneId;
use simworld_core::net::{NetworkConfig, RoadNetwork};
use simworld_core::seed::Seed;

/// A lane: its road, its list (along, against, bicycles), and its rank there.
type Place = (usize, usize, usize);

fn places(network: &RoadNetwork) -> BTreeMap<LaneId, Place> {
    let roads = network.roads.iter().enumerate();
    let lanes = roads.flat_map(|(index, road)| {
        let lists = [&road.forward, &road.backward, &road.cycle].into_iter().enumerate();
        lists.flat_map(move |(list, lanes)| {
            lanes.iter().enumerate().map(move |(rank, lane)| (*lane, (index, list, rank)))
        })
    });
    lanes.collect()
}

/// Which lane leads to which.
fn ways(network: &RoadNetwork) -> BTreeSet<(Place, Place)> {
    let places = places(network);
    network.connections.iter().map(|way| (places[&way.from], places[&way.to])).collect()
}

fn xml(city: &City) -> String {
    let mut text = Vec::new();
    city.write_opendrive(&mut text).expect("memory takes all");
    String::from_utf8(text).expect("XML is UTF-8")
}

#[test]
fn every_lane_of_a_town_leads_where_it_did() {
    let mut count = 0;
    for (seed, style) in (10..).zip(Style::ALL) {
        let config = CityConfig { roads: style.roads(150), ..CityConfig::default() };
        let city = City::generate(&config, Seed(seed)).expect("styles are valid");
        let read = OpenDrive::from_xml(&xml(&city)).expect("what we write is OpenDRIVE");
        assert_eq!(read.warnings, [], "{style}");
        let built = City::from_opendrive(&read, &config, Seed(seed)).expect("it can be built");
        assert_eq!(built.network.roads.len(), city.network.roads.len(), "{style}");
        let (was, is) = (ways(&city.network), ways(&built.network));
        count += was.len();
        let differ: Vec<_> = was.symmetric_difference(&is).take(5).collect();
        assert_eq!(differ, [] as [&(Place, Place); 0], "{style}");
        assert_eq!(built.network.connections.len(), city.network.connections.len(), "{style}");
    }
    assert!(count > 2000, "{count}");
}

/// Ways that no rule makes come back too: every lane of a crossroads leads elsewhere than it would.
#[test]
fn ways_against_all_rules_come_back() {
    let read = OpenDrive::from_xml(&crossroads(&TURNS, false)).unwrap();
    let config = CityConfig::default();
    let city = City::from_opendrive(&read, &config, Seed(1)).unwrap();
    let again = OpenDrive::from_xml(&xml(&city)).unwrap();
    let again = City::from_opendrive(&again, &config, Seed(1)).unwrap();
    assert_eq!(ways(&again.network), ways(&city.network));
    // And they are saved.
    let mut bytes = Vec::new();
    city.write_to(&mut bytes).unwrap();
    let loaded = City::from_bytes(&bytes).unwrap();
    assert!(loaded == city && loaded.plan.streets.iter().any(|street| !street.turns.is_empty()));
}

const NORTH: f64 = std::f64::consts::FRAC_PI_2;

fn lane(id: i32, links: &str) -> String {
    format!(
        "<lane id='{id}' type='driving'><link>{links}</link><width sOffset='0' a='3.2' b='0' c='0' d='0'/></lane>"
    )
}

/// A straight road; its sections of lanes are given.
fn road(
    (id, junction): (u32, i32),
    (x, y, heading): (f64, f64, f64),
    length: f64,
    links: &str,
    lanes: &str,
) -> String {
    format!(
        "<road id='{id}' junction='{junction}' length='{length}'><link>{links}</link>\
         <planView><geometry s='0' x='{x}' y='{y}' hdg='{heading}' length='{length}'><line/></geometry></planView>\
         <lanes>{lanes}</lanes></road>"
    )
}

/// A section with some lanes to the left and some to the right.
fn section(s: f64, left: &[(i32, &str)], right: &[(i32, &str)]) -> String {
    let side = |lanes: &[(i32, &str)]| lanes.iter().map(|(id, links)| lane(*id, links)).collect::<String>();
    format!(
        "<laneSection s='{s}'><left>{}</left><center><lane id='0' type='none'/></center><right>{}</right></laneSection>",
        side(left),
        side(right)
    )
}

/// From an arm and its lane into another arm and its lane, counted from the middle outwards.
type Turning = (u32, i32, u32, i32);

/// From the east both lanes lead straight on and crosswise, and the outer one left; from the north the inner one leads
/// right; from the west and the south all lead into one lane.
const TURNS: [Turning; 8] = [
    (1, 1, 3, 2),
    (1, 2, 3, 1),
    (1, 2, 4, 2),
    (2, 1, 3, 1),
    (2, 2, 4, 1),
    (3, 1, 1, 2),
    (3, 2, 1, 2),
    (4, 1, 2, 2),
];

/// Arms to the east, north, west and south of a junction, 1 to 4, with two lanes each way.
fn crossroads(turns: &[Turning], keeps_left: bool) -> String {
    let rule = if keeps_left { "LHT" } else { "RHT" };
    let mut text = "<OpenDRIVE>".to_owned();
    let lanes = section(0.0, &[(2, ""), (1, "")], &[(-1, ""), (-2, "")]);
    let junction = "<predecessor elementType='junction' elementId='9'/>";
    for (arm, (x, y)) in (0..).zip([(20.0, 0.0), (0.0, 20.0), (-20.0, 0.0), (0.0, -20.0)]) {
        text += &road((arm + 1, -1), (x, y, f64::from(arm) * NORTH), 100.0, junction, &lanes);
    }
    // Who arrives does so on the left of an arm that leads away, where traffic keeps right.
    let (arrives, leaves) = if keeps_left { (-1, 1) } else { (1, -1) };
    let mut junction = "<junction id='9'>".to_owned();
    for (number, (from, lane, to, other)) in (100..).zip(turns) {
        let links = format!(
            "<predecessor elementType='road' elementId='{from}' contactPoint='start'/>\
             <successor elementType='road' elementId='{to}' contactPoint='start'/>"
        );
        let own = format!("<predecessor id='{}'/><successor id='{}'/>", arrives * lane, leaves * other);
        let lanes =
            if keeps_left { section(0.0, &[(1, &own)], &[]) } else { section(0.0, &[], &[(-1, &own)]) };
        text += &road((number, 9), (0.0, 0.0, 0.0), 10.0, &links, &lanes);
        let connection = format!(
            "<connection id='{number}' incomingRoad='{from}' connectingRoad='{number}' contactPoint='start'>\
             <laneLink from='{}' to='{leaves}'/></connection>",
            arrives * lane
        );
        junction += &connection;
    }
    text += &junction;
    text += "</junction></OpenDRIVE>";
    text.replace("<road ", &format!("<road rule='{rule}' "))
}

/// The ways of a plan from lanes that arrive by streets that lead away from their junction: the numbers of the streets, and
/// the ranks of the lanes, from 1 on.
fn turns(read: &OpenDrive) -> BTreeSet<Turning> {
    let network = RoadNetwork::derive(&read.plan, &NetworkConfig::default()).unwrap();
    network.check().unwrap();
    let numbered = |(road, _, rank): Place| (road as u32 + 1, rank as i32 + 1);
    let ways = ways(&network).into_iter().filter(|(from, to)| from.0 != to.0);
    ways.map(|(from, to)| (numbered(from).0, numbered(from).1, numbered(to).0, numbered(to).1)).collect()
}

#[test]
fn junctions_lead_as_the_file_links_their_lanes() {
    for keeps_left in [false, true] {
        let read = OpenDrive::from_xml(&crossroads(&TURNS, keeps_left)).unwrap();
        let told: Vec<String> = read.warnings.iter().map(ToString::to_string).collect();
        assert_eq!(told, ["road 4: a lane leads nowhere by the file; it leads where the one beside it does"]);
        let mut wanted: BTreeSet<Turning> = TURNS.into();
        wanted.insert((4, 2, 2, 2));
        assert_eq!(turns(&read), wanted, "{keeps_left}");
    }
}

#[test]
fn a_direct_junction_and_one_with_lanes_of_the_same_numbers_lead_on() {
    let junction = |end: &str| format!("<{end} elementType='junction' elementId='9'/>");
    let lanes = section(0.0, &[], &[(-1, ""), (-2, "")]);
    let begin = [
        "<OpenDRIVE>".to_owned(),
        road((1, -1), (0.0, 0.0, 0.0), 100.0, &junction("successor"), &lanes),
        road((2, -1), (100.0, 0.0, 0.0), 100.0, &junction("predecessor"), &lanes),
        road((3, -1), (100.0, -3.2, -0.3), 100.0, &junction("predecessor"), &section(0.0, &[], &[(-1, "")])),
    ]
    .concat();
    let direct = |links: &str| {
        let end = format!("<junction id='9' type='direct'>{links}</junction></OpenDRIVE>");
        OpenDrive::from_xml(&format!("{begin}{end}")).unwrap()
    };
    let ramp = "<connection id='1' incomingRoad='1' linkedRoad='3' contactPoint='start'><laneLink from='-2' to='-1'/></connection>";
    let on = "<connection id='0' incomingRoad='1' linkedRoad='2' contactPoint='start'/>";
    let read = direct(&format!("{on}{ramp}"));
    assert_eq!(read.warnings, []);
    assert_eq!(turns(&read), BTreeSet::from([(1, 1, 2, 1), (1, 2, 2, 2), (1, 2, 3, 1)]));
    // Without links the rules say: the ramp leaves nearly straight ahead.
    assert_ne!(turns(&direct("")), turns(&read));
}

#[test]
fn lanes_that_begin_and_end_along_a_road_make_streets_of_their_own() {
    // Two lanes; then a third one opens along the middle, and ends again.
    let same = [1, 2, 3].map(|id| format!("<predecessor id='-{id}'/>"));
    let lanes = [
        section(0.0, &[], &[(-1, "<successor id='-2'/>"), (-2, "<successor id='-3'/>")]),
        section(80.0, &[], &[(-1, ""), (-2, "<predecessor id='-1'/>"), (-3, "<predecessor id='-2'/>")]),
        // The same lanes go on: no street of its own.
        section(120.0, &[], &[-1, -2, -3].map(|id| (id, same[(-id) as usize - 1].as_str()))),
        section(200.0, &[], &[(-1, "<predecessor id='-2'/>"), (-2, "<predecessor id='-3'/>")]),
        // Too short for a street of its own.
        section(260.0, &[], &[(-1, "<predecessor id='-1'/>")]),
    ]
    .concat();
    let text = format!("<OpenDRIVE>{}</OpenDRIVE>", road((7, -1), (0.0, 0.0, 0.3), 280.0, "", &lanes));
    let read = OpenDrive::from_xml(&text).unwrap();
    assert_eq!(read.warnings, []);
    let driven: Vec<usize> =
        read.plan.streets.iter().map(|street| read.plan.section(street).driven().0).collect();
    assert_eq!(driven, [2, 3, 2]);
    let lengths = read.plan.streets.iter().map(|street| {
        let line = read.plan.centerline(street);
        simworld_core::net::polyline::length(&line).round()
    });
    assert_eq!(lengths.collect::<Vec<f64>>(), [80.0, 120.0, 80.0]);
    let wanted = [
        // The new lane is entered from the one beside it, and leads where that one does.
        (1, 1, 2, 1),
        (1, 1, 2, 2),
        (1, 2, 2, 3),
        (2, 1, 3, 1),
        (2, 2, 3, 1),
        (2, 3, 3, 2),
    ];
    assert_eq!(turns(&read), BTreeSet::from(wanted));
    // Seen from the other end they are the same.
    let turned = text.replace("junction='-1'", "junction='-1' rule='LHT'");
    let read = OpenDrive::from_xml(&turned).unwrap();
    let driven: Vec<(usize, usize)> =
        read.plan.streets.iter().map(|street| read.plan.section(street).driven()).collect();
    assert_eq!((driven, read.warnings.len()), (vec![(0, 2), (0, 3), (0, 2)], 0));
}

#[test]
fn lanes_lead_over_roads_that_are_too_short_for_a_street() {
    let junction = "<predecessor elementType='junction' elementId='9'/>";
    let on = |road: u32| format!("<successor elementType='road' elementId='{road}' contactPoint='start'/>");
    let from = |road: u32| format!("<predecessor elementType='road' elementId='{road}' contactPoint='end'/>");
    let through = "<predecessor id='-1'/><successor id='-1'/>";
    let cross = "<predecessor id='-2'/><successor id='-1'/>";
    // Road 2 is 9 m long, and two lanes go over into one there.
    let text = [
        "<OpenDRIVE>".to_owned(),
        road((1, -1), (0.0, 0.0, 0.0), 60.0, &on(2), &section(0.0, &[], &[(-1, ""), (-2, "")])),
        road(
            (2, -1),
            (60.0, 0.0, 0.0),
            9.0,
            &format!("{}{}", from(1), on(3)),
            &section(0.0, &[], &[(-1, through), (-2, cross)]),
        ),
        road((3, -1), (69.0, 0.0, 0.0), 60.0, &from(2), &section(0.0, &[], &[(-1, "")])),
        road((4, -1), (64.0, 5.0, NORTH), 60.0, junction, &section(0.0, &[(1, "")], &[(-1, "")])),
        "</OpenDRIVE>".to_owned(),
    ]
    .concat();
    let read = OpenDrive::from_xml(&text).unwrap();
    assert_eq!(turns(&read), BTreeSet::from([(1, 1, 2, 1), (1, 2, 2, 1)]), "{:?}", read.warnings);
}

#[test]
fn odd_links_are_told_and_left_out() {
    let text = crossroads(&TURNS, false);
    let told = |text: &str| {
        let read = OpenDrive::from_xml(text).unwrap();
        assert_eq!(read.plan.validate(), Ok(()));
        read.warnings.iter().map(ToString::to_string).collect::<Vec<String>>()
    };
    let has = |text: &str, wanted: &str| {
        let told = told(text);
        assert!(told.iter().any(|told| told == wanted), "{told:?}");
    };
    let one = |from: &str, to: &str| {
        assert!(text.contains(from), "{from}");
        text.replacen(from, to, 1)
    };
    has(
        &one("incomingRoad='2'", "incomingRoad='77'"),
        "road 77: a connection of junction 9 has a road that is not there; left out",
    );
    has(
        &one("<laneLink from='1'", "<laneLink from='6'"),
        "road 1: a connection of junction 9 links lanes that are not there; left out",
    );
    has(
        &one("<successor id='-2'/>", "<successor id='-5'/>"),
        "road 100: a lane is linked with one that is not there; that link was left out",
    );
    has(
        &one("<successor id='-2'/>", "<successor id='2'/>"),
        "road 3: a lane is linked with one of the other direction; that link was left out",
    );
    let back = [&TURNS[..], &[(2, 1, 2, 1)]].concat();
    has(&crossroads(&back, false), "road 2: turns back within a junction; that way was left out");
    let none = &TURNS[..5];
    has(
        &crossroads(none, false),
        "road 3: leads into no other road by the lanes of the file; its turns are derived",
    );
}
