//! OpenDRIVE is read by another reader without a warning, with every lane where it is, and by SUMO's netconvert where
//! it is installed.

use std::process::Command;

use simworld_citygen::{City, CityConfig, GeoOrigin, Style};
use simworld_core::geometry::Point2;
use simworld_core::net::polyline;
use simworld_core::seed::Seed;

/// Cities of all styles in turn; from four on large enough for highways.
fn city(seed: u64) -> City {
    let style = Style::ALL[seed as usize % 4];
    let roads = style.roads(if seed < 4 { 24 } else { 420 });
    City::generate(&CityConfig { roads, ..CityConfig::default() }, Seed(seed)).expect("styles are valid")
}

fn xml(city: &City) -> String {
    let mut text = Vec::new();
    city.write_opendrive(&mut text).expect("memory takes all");
    String::from_utf8(text).expect("XML is UTF-8")
}

#[test]
fn another_reader_takes_it_without_a_warning() {
    for seed in 0..7 {
        let mut city = city(seed);
        city.provenance.origin = Some(GeoOrigin { latitude: 60.17, longitude: 24.94 });
        let (network, provenance) = xodr::load_str_with_provenance(&xml(&city)).unwrap();
        assert!(provenance.warnings.is_empty(), "seed {seed}: {:#?}", provenance.warnings);
        let roads = city.network.roads.len() + city.network.connections.len();
        assert_eq!(network.roads().len(), roads);
    }
}

#[test]
fn lanes_lie_where_they_lie() {
    let city = city(2);
    let network = xodr::load_str(&xml(&city)).unwrap();
    let lines: Vec<Vec<Point2>> = network
        .driving_lanes()
        .map(|lane| {
            lane.center.points().iter().map(|p| Point2::new(f64::from(p.x), f64::from(p.y))).collect()
        })
        .collect();
    let mut own: Vec<&Vec<Point2>> = city.network.lanes.iter().map(|lane| &lane.path).collect();
    own.extend(city.network.connections.iter().map(|connection| &connection.path));
    assert_eq!(lines.len(), own.len());
    for path in own {
        // Rounded corners and cubics leave the path by less than a tyre's width.
        let middle = polyline::at(path, polyline::length(path) * 0.5).0;
        let ends = [path[0], middle, path[path.len() - 1]];
        let away = |line: &Vec<Point2>| {
            let far = |point: &Point2| polyline::closest(line, point).map_or(f64::MAX, |near| near.distance);
            ends.iter().map(far).fold(0.0, f64::max)
        };
        let least = lines.iter().map(away).fold(f64::MAX, f64::min);
        assert!(least < 0.2, "{least} m away: {path:?}");
    }
}

#[test]
fn ways_on_are_the_same() {
    let city = city(2);
    let network = xodr::load_str(&xml(&city)).unwrap();
    let ways: usize = network.driving_lanes().map(|lane| lane.successors.len()).sum();
    // Each connection is entered by one lane and left for one.
    assert_eq!(ways, 2 * city.network.connections.len());
    assert_eq!(network.signals().len(), network.controllers().iter().map(|c| c.signals.len()).sum::<usize>());
}

#[test]
fn netconvert_takes_it() {
    let folder = tempfile::tempdir().unwrap();
    // What netconvert is to make of each type of lane; distributions do not always bring its own table along.
    let types: String = ["driving", "sidewalk", "parking", "biking", "bus", "median", "shoulder", "none"]
        .iter()
        .map(|kind| match *kind {
            "driving" | "bus" => format!(r#"<type id="{kind}" numLanes="1" speed="13.9"/>"#),
            _ => format!(r#"<type id="{kind}" numLanes="1" speed="2.8" discard="true"/>"#),
        })
        .collect();
    std::fs::write(folder.path().join("types.typ.xml"), format!("<types>{types}</types>")).unwrap();
    for seed in [0, 2, 3, 5] {
        let city = city(seed);
        std::fs::write(folder.path().join("city.xodr"), xml(&city)).unwrap();
        let arguments = ["--opendrive", "city.xodr", "-t", "types.typ.xml", "-o", "city.net.xml"];
        let Ok(output) = Command::new("netconvert").args(arguments).current_dir(folder.path()).output()
        else {
            eprintln!("skipped: netconvert is not installed");
            return;
        };
        let text = String::from_utf8_lossy(&output.stderr);
        // Where SUMO's own files lie is no matter of ours, and streets may bend, at junctions and between.
        let is_fair = |line: &&str| {
            !["SUMO_HOME", "Speed of straight connection", "Found sharp turn"]
                .iter()
                .any(|fair| line.contains(fair))
        };
        let complaints: Vec<&str> = text.lines().filter(is_fair).collect();
        assert!(output.status.success() && complaints.is_empty(), "seed {seed}: {complaints:#?}");
        let converted = std::fs::read_to_string(folder.path().join("city.net.xml")).unwrap();
        let signals = converted.matches("<tlLogic").count();
        assert_eq!(signals, city.network.signals.len(), "every signal plan arrives, seed {seed}");
    }
}
