//! No configuration and no file makes the crate panic; what is wrong is named with its place.

use proptest::prelude::*;
use simworld_citygen::python::{self, BuildingsFile, FormatError, RoadsFile};
use simworld_citygen::{City, CityConfig, CityError};
use simworld_core::net::{NetworkConfig, RoadNetwork};
use simworld_core::seed::Seed;

#[test]
fn a_setting_out_of_range_is_named() {
    let mut config = CityConfig::default();
    config.roads.length = f64::NAN;
    let error = City::generate(&config, Seed(1)).unwrap_err();
    assert!(matches!(error, CityError::Config { field: "roads.length", .. }), "{error}");
    assert!(error.to_string().contains("60 to 1000 m"), "{error}");
}

#[test]
fn a_fault_in_a_file_is_named_with_its_path() {
    let error =
        python::read_roads(br#"{"roads":[{"start":{"x":1,"y":2},"end":{"x":"far","y":2}}]}"#).unwrap_err();
    assert!(error.to_string().starts_with("at roads[0].end.x"), "{error}");
    let error =
        python::read_roads(br#"{"roads":[{"start":{"x":1,"y":2},"end":{"x":1e300,"y":2}}]}"#).unwrap_err();
    assert!(matches!(&error, FormatError::Coordinate { path, .. } if path == "roads[0].end.x"), "{error}");
    assert!(matches!(python::read_roads(br#"{"roads":[]}"#), Err(FormatError::Empty { .. })));
    assert!(python::read_roads(br#"{"roads":[{"start":{"x":1"#).is_err(), "a truncated file is no file");
}

#[test]
fn a_city_survives_its_files() {
    let city = City::generate(&CityConfig::default(), Seed(2)).unwrap();
    let text = python::write(&city.roads_file());
    let read: RoadsFile = python::read(text.as_bytes()).unwrap();
    assert_eq!(read, city.roads_file());
    let (plan, _) = python::read_roads(text.as_bytes()).unwrap();
    let again = City::from_plan(plan, &CityConfig::default(), Seed(2)).unwrap();
    assert!(again.network.roads.len() >= city.network.roads.len(), "bends become nodes, no road is lost");
    let text = python::write(&city.buildings_file());
    assert_eq!(python::read::<BuildingsFile>(text.as_bytes()).unwrap(), city.buildings_file());
}

#[test]
fn crossing_roads_become_a_junction() {
    let file = br#"{"roads":[
        {"start":{"x":-100,"y":0},"end":{"x":100,"y":0},"is_highway":true},
        {"start":{"x":0,"y":-100},"end":{"x":0,"y":100},"is_highway":false},
        {"start":{"x":5000,"y":0},"end":{"x":5100,"y":0},"is_highway":false},
        {"start":{"x":3,"y":0},"end":{"x":3,"y":1},"is_highway":false}]}"#;
    let (plan, warnings) = python::read_roads(file).unwrap();
    assert_eq!((plan.nodes.len(), plan.streets.len()), (5, 4));
    assert_eq!(warnings.len(), 4, "two splits, one lost part, one stub: {warnings:?}");
}

#[test]
fn more_road_than_can_be_checked_is_refused_at_once() {
    let xy = |x, y| python::Xy { x, y };
    let record = |a, b| python::RoadRecord { start: a, end: b, is_highway: false };
    let across = |index: usize| record(xy(-9e5, index as f64 * 30.0), xy(9e5, index as f64 * 30.0));
    let long = RoadsFile { roads: (0..1000).map(across).collect() };
    assert!(matches!(python::plan_from_roads(&long), Err(FormatError::TooMuch { .. })));
    let copies = RoadsFile { roads: vec![record(xy(0.0, 0.0), xy(90.0, 0.0)); 100_000] };
    let (plan, warnings) = python::plan_from_roads(&copies).unwrap();
    assert_eq!((plan.streets.len(), warnings.len()), (1, 99_999));
}

#[test]
fn routes_survive_their_file() {
    let text =
        br#"{"routes":[{"start":{"x":0,"y":1},"end":{"x":2,"y":3},"points":[{"x":0,"y":1},{"x":2,"y":3}]}]}"#;
    let routes: python::RoutesFile = python::read(text).unwrap();
    assert_eq!(python::read::<python::RoutesFile>(python::write(&routes).as_bytes()).unwrap(), routes);
    assert_eq!(routes.routes[0].points.len(), 2);
}

/// A sound file to be damaged.
fn sound_file() -> Vec<u8> {
    let city = City::generate(&CityConfig::with_roads(4), Seed(1)).expect("the settings are in range");
    python::write(&city.roads_file()).into_bytes()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]

    #[test]
    fn arbitrary_bytes_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        let _ = python::read_roads(&bytes);
    }

    #[test]
    fn damaged_files_are_read_or_refused(at in any::<prop::sample::Index>(), byte in any::<u8>(), cut in any::<bool>()) {
        let mut bytes = sound_file();
        let at = at.index(bytes.len());
        if cut {
            bytes.truncate(at);
            prop_assert!(python::read_roads(&bytes).is_err(), "a truncated file is no file");
        } else {
            bytes[at] = byte;
            if let Ok((plan, _)) = python::read_roads(&bytes) {
                RoadNetwork::derive(&plan, &NetworkConfig::default())
                    .map_err(|error| TestCaseError::fail(error.to_string()))?;
            }
        }
    }

    #[test]
    fn arbitrary_roads_are_built_or_refused(
        ends in prop::collection::vec((-400.0..400.0_f64, -400.0..400.0_f64, -400.0..400.0_f64, -400.0..400.0_f64), 1..12),
    ) {
        let xy = |x, y| python::Xy { x, y };
        let record = |(a, b, c, d)| python::RoadRecord { start: xy(a, b), end: xy(c, d), is_highway: false };
        let file = RoadsFile { roads: ends.into_iter().map(record).collect() };
        if let Ok((plan, _)) = python::plan_from_roads(&file) {
            RoadNetwork::derive(&plan, &NetworkConfig::default())
                .map_err(|error| TestCaseError::fail(error.to_string()))?;
        }
    }

    #[test]
    fn arbitrary_settings_are_used_or_refused(
        count in 0_u32..30, length in any::<f64>(), snap in any::<f64>(), setback in any::<f64>(), trees in any::<f64>(),
    ) {
        let mut config = CityConfig::with_roads(count);
        config.roads.length = length;
        config.roads.snap = snap;
        config.buildings.setback = setback;
        config.elements.trees = trees;
        let _ = City::generate(&config, Seed(1));
    }
}
