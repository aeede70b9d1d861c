//! Layout files of the Python release, read as a whole: what was written comes back, what cannot stand is left out.

use simworld_citygen::python::{self, BuildingsFile, ElementsFile, RoadsFile};
use simworld_citygen::{City, CityConfig};
use simworld_core::scene::EntityKind;
use simworld_core::seed::Seed;

fn city() -> City {
    City::generate(&CityConfig::with_roads(24), Seed(4)).expect("defaults are valid")
}

fn read(city: &City) -> (City, usize) {
    let (again, warnings) = City::from_layout(
        &city.roads_file(),
        &city.buildings_file(),
        &city.elements_file(),
        &CityConfig::default(),
        Seed(4),
    )
    .expect("a city's own layout is valid");
    (again, warnings.len())
}

#[test]
fn buildings_come_back_to_their_places() {
    let city = city();
    let (again, _) = read(&city);
    // Wings of their neighbours become whole rectangles, and so some no longer fit.
    assert!(again.buildings.len() * 10 >= city.buildings.len() * 8);
    for building in &again.buildings {
        let own = city.buildings.iter().find(|own| (own.center - building.center).norm() < 1e-3).unwrap();
        assert_eq!(own.archetype.name, building.archetype.name);
        let (mut a, mut b) = ([own.width, own.depth], [building.width, building.depth]);
        a.sort_by(f64::total_cmp);
        b.sort_by(f64::total_cmp);
        assert!((a[0] - b[0]).abs() < 1e-3 && (a[1] - b[1]).abs() < 1e-3);
        assert!((building.access - building.center).norm() < 100.0);
    }
    assert_eq!(again.report().overlaps, 0);
}

#[test]
fn elements_come_back_all() {
    let city = city();
    let (again, _) = read(&city);
    assert_eq!(again.elements.len(), city.elements.len());
    let kinds = |city: &City| city.elements.iter().map(|element| element.kind).collect::<Vec<_>>();
    assert_eq!(kinds(&again), kinds(&city));
}

#[test]
fn a_layout_read_twice_stays_the_same() {
    let (once, _) = read(&city());
    let (twice, _) = read(&once);
    assert_eq!(once.buildings.len(), twice.buildings.len());
    assert_eq!(once.network.roads.len(), twice.network.roads.len());
}

#[test]
fn what_cannot_stand_is_left_out_with_a_warning() {
    let roads: RoadsFile =
        python::read(br#"{"roads": [{"start": {"x": -100, "y": 0}, "end": {"x": 100, "y": 0}}]}"#).unwrap();
    let building = |x: f64, y: f64, size: f64| {
        format!(
            r#"{{"center": {{"x": {x}, "y": {y}}}, "rotation": 0, "type": "BP_Building_1_C",
            "bounds": {{"x": 0, "y": 0, "width": {size}, "height": 12, "rotation": 0}}}}"#
        )
    };
    // One beside the road, one on the road, one on the first, one far away, one without size.
    let all =
        [(0.0, 20.0, 15.0), (30.0, 0.0, 15.0), (2.0, 20.0, 15.0), (0.0, 5000.0, 15.0), (60.0, 20.0, -1.0)];
    let text = format!(r#"{{"buildings": [{}]}}"#, all.map(|(x, y, size)| building(x, y, size)).join(","));
    let buildings: BuildingsFile = python::read(text.as_bytes()).unwrap();
    let elements: ElementsFile = python::read(
        br#"{"elements": [
            {"center": {"x": 1, "y": 8}, "rotation": 0, "type": "BP_Tree1_C",
             "bounds": {"x": 0, "y": 0, "width": 2, "height": 2, "rotation": 0}},
            {"center": {"x": 1e300, "y": 8}, "rotation": 0, "type": "BP_Cone_C",
             "bounds": {"x": 0, "y": 0, "width": 1, "height": 1, "rotation": 0}}]}"#,
    )
    .unwrap();
    let (city, warnings) =
        City::from_layout(&roads, &buildings, &elements, &CityConfig::default(), Seed(1)).unwrap();
    assert_eq!(city.buildings.len(), 1);
    assert_eq!(city.elements.iter().map(|element| element.kind).collect::<Vec<_>>(), [EntityKind::Tree]);
    let named: Vec<String> = warnings.iter().map(ToString::to_string).collect();
    for place in ["buildings[1]", "buildings[2]", "buildings[3]", "buildings[4]", "elements[1]"] {
        assert!(named.iter().any(|warning| warning.contains(place)), "{place}: {named:?}");
    }
}
