//! OpenDRIVE is read: what this crate writes comes back, what others write becomes streets, and nothing stops it.
#![cfg(feature = "opendrive")]

use simworld_citygen::files::opendrive::{OpenDrive, OpenDriveError};
use simworld_citygen::{City, CityConfig, GeoOrigin, Style};
use simworld_core::net::{Control, DrivingSide, LaneKind, StreetPlan, polyline};
use simworld_core::seed::Seed;

fn xml(city: &City) -> String {
    let mut text = Vec::new();
    city.write_opendrive(&mut text).expect("memory takes all");
    String::from_utf8(text).expect("XML is UTF-8")
}

fn degrees(plan: &StreetPlan) -> Vec<usize> {
    let mut degrees = vec![0; plan.nodes.len()];
    for street in &plan.streets {
        degrees[street.from] += 1;
        degrees[street.to] += 1;
    }
    degrees
}

fn junctions(plan: &StreetPlan) -> usize {
    degrees(plan).into_iter().filter(|degree| *degree > 2).count()
}

fn lengths(plan: &StreetPlan) -> f64 {
    plan.streets.iter().map(|street| polyline::length(&plan.centerline(street))).sum()
}

#[test]
fn a_city_comes_back_as_it_was_written() {
    for (seed, style) in (0..).zip(Style::ALL) {
        let config = CityConfig { roads: style.roads(60), ..CityConfig::default() };
        let mut city = City::generate(&config, Seed(seed)).expect("styles are valid");
        city.provenance.origin = Some(GeoOrigin { latitude: 60.17, longitude: 24.94 });
        let read = OpenDrive::from_xml(&xml(&city)).expect("what we write is OpenDRIVE");
        assert_eq!(read.warnings, [], "{style}");
        assert_eq!(read.origin, city.provenance.origin);
        assert_eq!(junctions(&read.plan), junctions(&city.plan), "{style}");
        let (was, is) = (lengths(&city.plan), lengths(&read.plan));
        // Bends were rounded off, which is shorter, and dead ends come back up to their turning circles and hammerheads.
        let circles: f64 = city.plan.streets.iter().flat_map(|street| street.turning).sum();
        let heads =
            city.plan.streets.iter().flat_map(|street| street.hammerhead).filter(|head| *head).count();
        let short = 0.015 * was + 2.0 * circles + 12.0 * heads as f64;
        assert!(is <= was && was - is < short, "{style}: {was} m became {is} m");
        // Every junction lies where it lay, but for bends within it, which are not written.
        let crossing = degrees(&city.plan);
        for (node, at) in city.plan.nodes.iter().enumerate().filter(|(node, _)| crossing[*node] > 2) {
            let nearest = read.plan.nodes.iter().map(|other| (other - at).norm()).fold(f64::MAX, f64::min);
            assert!(nearest < 5.0, "{style}: node {node} came back {nearest} m away");
        }
        let named = |plan: &StreetPlan| {
            let mut names: Vec<String> =
                plan.streets.iter().filter_map(|street| plan.name(street)).map(str::to_owned).collect();
            names.sort_unstable();
            names.dedup();
            names
        };
        assert_eq!(named(&read.plan), named(&city.plan));
        let built = City::from_opendrive(&read, &config, Seed(seed)).expect("it can be built");
        assert_eq!(built.network.check(), Ok(()));
        let lanes = |city: &City| city.network.lanes.iter().map(|lane| lane.length).sum::<f64>();
        assert!((lanes(&city) - lanes(&built)).abs() < 0.03 * lanes(&city), "{style}");
        assert_eq!(built.report().overlaps, 0);
        let signals = |city: &City| city.network.signals.len();
        assert_eq!(signals(&built), signals(&city), "{style}");
    }
}

/// A road with one lane each way and sidewalks, and links.
fn road(id: &str, (x, y, heading): (f64, f64, f64), length: f64, links: &str) -> String {
    let lane = |id: i32, kind: &str, width: f64| {
        format!("<lane id='{id}' type='{kind}'><width sOffset='0' a='{width}' b='0' c='0' d='0'/></lane>")
    };
    format!(
        "<road id='{id}' name='Way {id}' junction='-1' length='{length}'><link>{links}</link>\
         <type s='0' type='town'><speed max='50' unit='km/h'/></type>\
         <planView><geometry s='0' x='{x}' y='{y}' hdg='{heading}' length='{length}'><line/></geometry></planView>\
         <elevationProfile><elevation s='0' a='2' b='0.01' c='0' d='0'/></elevationProfile>\
         <lanes><laneSection s='0'><left>{}{}</left><center><lane id='0' type='none'/></center><right>{}{}</right>\
         </laneSection></lanes></road>",
        lane(2, "sidewalk", 2.0),
        lane(1, "driving", 3.2),
        lane(-1, "driving", 3.2),
        lane(-2, "sidewalk", 2.0),
    )
}

const NORTH: f64 = std::f64::consts::FRAC_PI_2;

/// Three roads that end at a junction about the origin; the fourth goes on from the first.
fn tee() -> String {
    let junction = "<predecessor elementType='junction' elementId='9'/>";
    let on = "<successor elementType='road' elementId='4' contactPoint='start'/>";
    [
        "<OpenDRIVE>".to_owned(),
        road("1", (10.0, 0.0, 0.0), 60.0, &format!("{junction}{on}")),
        road("2", (0.0, 10.0, NORTH), 80.0, junction),
        road("3", (-10.0, 0.0, 2.0 * NORTH), 80.0, junction),
        road(
            "4",
            (70.0, 0.0, 0.0),
            40.0,
            "<predecessor elementType='road' elementId='1' contactPoint='end'/>",
        ),
        "<junction id='9'><controller id='1'/></junction></OpenDRIVE>".to_owned(),
    ]
    .concat()
}

#[test]
fn roads_of_others_become_streets() {
    let read = OpenDrive::from_xml(&tee()).unwrap();
    assert_eq!(read.warnings, []);
    let plan = &read.plan;
    assert_eq!(
        (plan.streets.len(), plan.nodes.len(), junctions(plan)),
        (3, 4, 1),
        "two roads became one street"
    );
    let middle = degrees(plan).iter().position(|degree| *degree == 3).unwrap();
    assert!(plan.nodes[middle].coords.norm() < 0.05, "{}", plan.nodes[middle]);
    assert_eq!(plan.controls.get(&middle), Some(&Control::Signals));
    assert!((lengths(plan) - 290.0).abs() < 0.2);
    let section = plan.section(&plan.streets[0]);
    assert_eq!((section.width(), section.reference, section.driven()), (10.4, 5.2, (1, 1)));
    assert!((plan.streets[0].speed_limit.unwrap() - 50.0 / 3.6).abs() < 1e-9);
    assert_eq!(plan.name(&plan.streets[0]), Some("Way 1"));
    assert!((plan.elevation(middle) - 2.0).abs() < 1e-9);
    assert!(plan.elevations.iter().any(|height| (height - 2.4).abs() < 1e-9));
    assert_eq!(plan.driving_side, DrivingSide::Right);
    let left = OpenDrive::from_xml(&tee().replace("junction='-1'", "junction='-1' rule='LHT'")).unwrap();
    assert_eq!(left.plan.driving_side, DrivingSide::Left);
}

#[test]
fn ends_that_touch_meet_without_a_link() {
    let text = tee().replace("<predecessor elementType='road' elementId='1' contactPoint='end'/>", "");
    let text = text.replace("<successor elementType='road' elementId='4' contactPoint='start'/>", "");
    assert_eq!(OpenDrive::from_xml(&text).unwrap().plan.streets.len(), 3);
}

#[test]
fn what_is_odd_is_told_and_stops_nothing() {
    let with = |from: &str, to: &str| OpenDrive::from_xml(&tee().replacen(from, to, 1)).unwrap();
    let told = |read: &OpenDrive| read.warnings.iter().map(ToString::to_string).collect::<Vec<String>>();
    let read = with("<line/>", "<helix/>");
    assert_eq!(told(&read), ["road 1: has no possible course; left out"]);
    assert_eq!(read.plan.streets.len(), 3);
    assert_eq!(
        told(&with("id='2' name", "id='1' name")),
        ["road 1: the number is used twice; the second was left out"]
    );
    let read = with("length='40'><line/>", "length='4'><line/>");
    assert_eq!(read.plan.streets.len(), 3, "{:?}", told(&read));
    let rails = tee().replace("type='driving'", "type='rail'");
    let read = OpenDrive::from_xml(&rails).unwrap();
    assert_eq!((read.plan.streets.len(), read.warnings.len()), (0, 4));
    assert!(City::from_opendrive(&read, &CityConfig::default(), Seed(1)).is_err());
    for wide in ["1e300", "NaN", "-3", "0.4"] {
        let read = with("a='3.2'", &format!("a='{wide}'"));
        assert_eq!(read.plan.validate(), Ok(()), "{wide}");
    }
}

#[test]
fn what_is_no_opendrive_is_refused() {
    assert!(
        matches!(OpenDrive::from_xml("<osm/>"), Err(OpenDriveError::Foreign { found }) if found == "osm")
    );
    assert!(matches!(OpenDrive::from_xml("<OpenDRIVE>"), Err(OpenDriveError::Xml(_))));
    assert!(OpenDrive::from_xml("<OpenDRIVE/>").unwrap().plan.streets.is_empty());
    assert!(matches!(OpenDrive::read("nowhere.xodr".as_ref()), Err(OpenDriveError::Io(_))));
}

#[test]
fn documents_cut_short_or_damaged_are_survived() {
    let config = CityConfig { roads: Style::Mixed.roads(10), ..CityConfig::default() };
    let text = xml(&City::generate(&config, Seed(3)).unwrap());
    let mut draws = Seed(5).stream("test/damage").rng();
    let mut built = 0;
    let digits: Vec<usize> =
        text.bytes().enumerate().filter(|(_, byte)| byte.is_ascii_digit()).map(|(at, _)| at).collect();
    for _ in 0..300 {
        // A digit becomes another one, somewhere.
        let mut damaged = text.clone().into_bytes();
        for _ in 0..6 {
            let at = digits[draws.below(digits.len())];
            damaged[at] = b'0' + draws.below(10) as u8;
        }
        let read = OpenDrive::from_xml(&String::from_utf8(damaged).unwrap());
        let Ok(read) = read else { continue };
        assert_eq!(read.plan.validate(), Ok(()));
        built += usize::from(!read.plan.streets.is_empty());
    }
    assert!(built > 250, "{built}");
    for cut in (0..text.len()).step_by(997) {
        assert!(OpenDrive::from_xml(&text[..cut]).is_err());
    }
    let median = |section: &simworld_core::net::CrossSection| {
        section.lanes.iter().any(|lane| lane.kind == LaneKind::Median)
    };
    assert!(!OpenDrive::from_xml(&text).unwrap().plan.sections.iter().any(median));
}
