//! Heights of OpenDRIVE: roads rise and fall between their ends, and those that cross without a junction are bridges.
#![cfg(feature = "opendrive")]

use simworld_citygen::files::opendrive::OpenDrive;
use simworld_citygen::graph::StreetGraph;
use simworld_citygen::terrain::{DECK, HEADROOM};
use simworld_citygen::{City, CityConfig};
use simworld_core::geometry::Point2;
use simworld_core::id::RoadId;
use simworld_core::net::{RoadClass, RoadNetwork, Street, StreetPlan, polyline};
use simworld_core::seed::Seed;

/// A straight road with one lane each way.
fn road(id: u32, (x, y, heading): (f64, f64, f64), length: f64, elevation: &str) -> String {
    let lane = |id: i32| {
        format!("<lane id='{id}' type='driving'><width sOffset='0' a='3.2' b='0' c='0' d='0'/></lane>")
    };
    format!(
        "<road id='{id}' junction='-1' length='{length}'>\
         <planView><geometry s='0' x='{x}' y='{y}' hdg='{heading}' length='{length}'><line/></geometry></planView>\
         <elevationProfile>{elevation}</elevationProfile><lanes><laneSection s='0'><left>{}</left>\
         <center><lane id='0' type='none'/></center><right>{}</right></laneSection></lanes></road>",
        lane(1),
        lane(-1)
    )
}

fn read(roads: &[String]) -> (OpenDrive, Vec<String>) {
    let read = OpenDrive::from_xml(&format!("<OpenDRIVE>{}</OpenDRIVE>", roads.concat())).unwrap();
    let told = read.warnings.iter().map(ToString::to_string).collect();
    // Streets pass over one another or meet at nodes.
    StreetGraph::of(&read.plan).unwrap();
    (read, told)
}

fn built(read: &OpenDrive) -> City {
    let city = City::from_opendrive(read, &CityConfig::default(), Seed(1)).unwrap();
    assert_eq!((city.network.check(), city.report().overlaps), (Ok(()), 0));
    city
}

/// The greatest height over a place.
fn height_over(network: &RoadNetwork, at: Point2) -> f64 {
    let heights = (0..network.roads.len()).filter_map(|index| {
        let near = polyline::closest(&network.roads[index].centerline, &at)?;
        (near.distance < 0.5).then(|| network.height(RoadId::from_index(index), near.station))
    });
    heights.fold(f64::MIN, f64::max)
}

/// A crest of 9 m in the middle of 300 m.
const CREST: &str = "<elevation s='0' a='1' b='0.12' c='-0.0004' d='0'/>";
const NORTH: f64 = std::f64::consts::FRAC_PI_2;

fn lengths(read: &OpenDrive, level: i8) -> Vec<f64> {
    let streets = read.plan.streets.iter().filter(|street| street.level == level);
    streets.map(|street| polyline::length(&read.plan.centerline(street)).round()).collect()
}

#[test]
fn roads_rise_and_fall_between_their_ends() {
    let (read, told) = read(&[road(1, (0.0, 0.0, 0.0), 300.0, CREST)]);
    assert_eq!(told, [""; 0]);
    let city = built(&read);
    let ground = |x: f64| height_over(&city.network, Point2::new(x, 0.0));
    for step in 0..=30 {
        let x = 10.0 * f64::from(step);
        let wanted = 1.0 + 0.12 * x - 0.0004 * x * x;
        assert!((ground(x) - wanted).abs() < 0.06, "{} at {x}, not {wanted}", ground(x));
    }
    // What is built along it is straight from point to point.
    let street = &read.plan.streets[0];
    assert!(street.via.len() >= street.profile.len() && street.profile.len() > 5);
}

#[test]
fn what_passes_over_another_road_is_a_bridge_there() {
    let below = road(2, (150.0, -100.0, NORTH), 200.0, "<elevation s='0' a='2' b='0' c='0' d='0'/>");
    for roads in [
        [road(1, (0.0, 0.0, 0.0), 300.0, CREST), below.clone()],
        [below, road(1, (0.0, 0.0, 0.0), 300.0, CREST)],
    ] {
        let (read, told) = read(&roads);
        assert_eq!(told, [""; 0]);
        // 3.2 m of lane and 6 m on to either side; what is left of the road is on the ground.
        assert_eq!(lengths(&read, 1), [18.0]);
        let mut rest = lengths(&read, 0);
        rest.sort_by(f64::total_cmp);
        assert_eq!(rest, [141.0, 141.0, 200.0]);
        let city = built(&read);
        let height = height_over(&city.network, Point2::new(150.0, 0.0));
        assert!((height - 10.0).abs() < 0.1, "{height}");
    }
}

#[test]
fn bridges_over_bridges_lie_a_level_higher() {
    let level = |height: f64| format!("<elevation s='0' a='{height}' b='0' c='0' d='0'/>");
    let (read, told) = read(&[
        road(1, (-100.0, 0.0, 0.0), 200.0, &level(12.0)),
        road(2, (0.0, -100.0, NORTH), 200.0, &level(6.0)),
        road(3, (-80.0, -80.0, NORTH * 0.5), 226.0, &level(0.0)),
    ]);
    assert_eq!(told, [""; 0]);
    assert_eq!((lengths(&read, 1).len(), lengths(&read, 2).len()), (1, 1));
    assert_eq!(lengths(&read, 2), [18.0 + 3.0]);
}

#[test]
fn roads_that_cross_at_one_height_are_told() {
    let (crossed, told) =
        read(&[road(1, (-200.0, 0.0, 0.0), 400.0, ""), road(2, (0.0, -200.0, NORTH), 400.0, "")]);
    assert_eq!(told, ["road 1: crosses road 2 without a junction at its height; the latter passes over it"]);
    assert_eq!(lengths(&crossed, 1), [18.0]);
    let height = height_over(&built(&crossed).network, Point2::origin());
    assert!((height - HEADROOM - DECK).abs() < 1e-6, "it is raised as every bridge: {height}");
    let touching = [road(1, (-200.0, 0.0, 0.0), 400.0, ""), road(2, (0.0, -2.0, NORTH), 200.0, "")];
    let text = format!("<OpenDRIVE>{}</OpenDRIVE>", touching.concat());
    let touching = OpenDrive::from_xml(&text).unwrap();
    let told: Vec<String> = touching.warnings.iter().map(ToString::to_string).collect();
    assert_eq!(told, ["road 1: touches road 2 without a junction; nothing was joined"]);
    assert_eq!(lengths(&touching, 1), [0.0; 0]);
}

#[test]
fn bridges_of_a_city_come_back() {
    let nodes =
        [(-220.0, 0.0), (220.0, 0.0), (0.0, -90.0), (0.0, 90.0)].map(|(x, y)| Point2::new(x, y)).to_vec();
    let over = Street { level: 1, class: RoadClass::Arterial, ..Street::simple(0, 1) };
    let plan = StreetPlan { nodes, streets: vec![over, Street::simple(2, 3)], ..StreetPlan::default() };
    let city = City::from_plan(plan, &CityConfig::default(), Seed(1)).unwrap();
    let mut text = Vec::new();
    city.write_opendrive(&mut text).unwrap();
    let read = OpenDrive::from_xml(std::str::from_utf8(&text).unwrap()).unwrap();
    assert_eq!(read.warnings, []);
    assert_eq!((lengths(&read, 1).len(), lengths(&read, 0).len()), (1, 3));
    let again = built(&read);
    for step in -40..=40 {
        let at = Point2::new(5.0 * f64::from(step), 0.0);
        let (was, is) = (height_over(&city.network, at), height_over(&again.network, at));
        assert!((was - is).abs() < 0.06, "{was} became {is} at {at}");
    }
}

#[test]
fn damaged_lanes_links_and_heights_are_survived() {
    let lane = |id: i32| {
        format!(
            "<lane id='{id}' type='driving'><link><successor id='{}'/></link>\
                 <width sOffset='0' a='3.2' b='0' c='0' d='0'/></lane>",
            id - 1
        )
    };
    let opens = format!("<laneSection s='60'><right>{}{}</right></laneSection></lanes>", lane(-1), lane(-2));
    let text = [
        road(1, (0.0, 0.0, 0.0), 300.0, CREST).replace("</lanes>", &opens),
        road(2, (150.0, -100.0, NORTH), 200.0, "<elevation s='0' a='2' b='0' c='0' d='0'/>"),
        road(3, (0.0, 40.0, 0.1), 250.0, CREST).replace("junction='-1'", "junction='9'"),
        road(4, (0.0, 60.0, -0.4), 250.0, "").replace("</lanes>", &opens),
        "<junction id='9'><connection id='0' incomingRoad='1' connectingRoad='3' contactPoint='start'>\
         <laneLink from='-1' to='-1'/></connection><connection id='1' incomingRoad='2' connectingRoad='4' \
         contactPoint='end'><laneLink from='1' to='-2'/></connection></junction>"
            .to_owned(),
    ]
    .concat();
    let text = format!("<OpenDRIVE>{text}</OpenDRIVE>");
    let digits: Vec<usize> =
        text.bytes().enumerate().filter(|(_, byte)| byte.is_ascii_digit()).map(|(at, _)| at).collect();
    let mut draws = Seed(6).stream("test/damage").rng();
    let mut bridges = 0;
    for _ in 0..150 {
        let mut damaged = text.clone().into_bytes();
        for _ in 0..5 {
            damaged[digits[draws.below(digits.len())]] = b'0' + draws.below(10) as u8;
        }
        let Ok(read) = OpenDrive::from_xml(&String::from_utf8(damaged).unwrap()) else { continue };
        assert_eq!(read.plan.validate(), Ok(()));
        bridges += lengths(&read, 1).len();
        if !read.plan.streets.is_empty() {
            built(&read);
        }
    }
    assert!(bridges > 100, "{bridges}");
}
