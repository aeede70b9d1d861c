//! A map is a well-formed drawing that shows everything, takes any name, stays small and is always the same.

use roxmltree::Document;
use simworld_citygen::map::MapDrawing;
use simworld_citygen::{City, CityConfig};
use simworld_core::geometry::Point2;
use simworld_core::net::{Street, StreetPlan};
use simworld_core::seed::Seed;

fn city(roads: u32) -> City {
    City::generate(&CityConfig::with_roads(roads), Seed(11)).expect("defaults are valid")
}

fn has_group(document: &Document<'_>, id: &str) -> bool {
    document.descendants().any(|node| node.attribute("id") == Some(id))
}

#[test]
fn layers_are_groups_with_names() {
    let svg = city(30).svg();
    let document = Document::parse(&svg).unwrap();
    for id in [
        "paper",
        "map",
        "land",
        "streets",
        "buildings",
        "labels",
        "frame",
        "title",
        "scale",
        "legend",
        "figures",
    ] {
        assert!(has_group(&document, id), "{id} is missing");
    }
}

#[test]
fn every_building_is_drawn_once() {
    let city = city(30);
    let svg = city.svg();
    let document = Document::parse(&svg).unwrap();
    let shapes = document
        .descendants()
        .filter(|node| node.attribute("id").is_some_and(|id| id.starts_with("shape-")))
        .map(|node| node.attribute("d").unwrap().matches('z').count());
    let courts = city.buildings.iter().filter(|building| building.courtyard().is_some()).count();
    assert_eq!(shapes.sum::<usize>(), city.buildings.len() + courts);
}

#[test]
fn tunnels_lie_below_the_streets_and_bridges_above() {
    let mut plan = StreetPlan::grid(2, 2, 200.0);
    let across = [(0.0, 100.0), (200.0, 100.0), (100.0, 0.0), (100.0, 200.0)];
    plan.nodes.extend(across.map(|(x, y)| Point2::new(x, y)));
    plan.streets.push(Street { level: -1, ..Street::simple(4, 5) });
    plan.streets.push(Street { level: 1, ..Street::simple(6, 7) });
    let city = City::from_plan(plan, &CityConfig::default(), Seed(1)).unwrap();
    let svg = city.svg();
    let document = Document::parse(&svg).unwrap();
    let place = |id: &str| document.descendants().position(|node| node.attribute("id") == Some(id));
    let order = ["tunnels-1", "sidewalks", "streets", "bridges-1"].map(|id| place(id).expect(id));
    assert!(order.is_sorted(), "{order:?}");
    let tunnel = document.descendants().find(|node| node.attribute("id") == Some("tunnels-1")).unwrap();
    let lines: Vec<_> = tunnel.children().filter(roxmltree::Node::is_element).collect();
    let dashed = lines.iter().filter(|line| line.attribute("stroke-dasharray").is_some()).count();
    assert_eq!((lines.len(), dashed), (2, 1), "an edge and a carriageway");
}

#[test]
fn no_name_breaks_the_sheet() {
    let mut city = city(8);
    city.provenance.title = Some("<&\"'> \u{0} 東京 ]]>".to_owned());
    for building in &mut city.buildings {
        building.name = Some("Smith & <Sons>\u{1}".to_owned());
    }
    let svg = MapDrawing::of(&city)
        .subtitle("a < b")
        .trail(&[Point2::origin(), Point2::new(50.0, 5.0)], "\"red", "A&B")
        .marker(&Point2::new(f64::NAN, 0.0), "#000", "nowhere")
        .to_string();
    assert!(Document::parse(&svg).is_ok());
}

#[test]
fn a_map_stays_small() {
    let city = city(400);
    let svg = city.svg();
    let drawn = city.buildings.len() + city.elements.len() + city.network.roads.len();
    assert!(svg.len() < 60 * drawn, "{} bytes for {drawn} things", svg.len());
}

#[test]
fn the_same_city_gives_the_same_map() {
    assert_eq!(city(30).svg(), city(30).svg());
}

#[cfg(feature = "png")]
#[test]
fn a_picture_has_the_size_asked_for_and_ink_on_it() {
    let png = simworld_citygen::map::render_png(&city(8).svg(), 300).unwrap();
    assert_eq!(u32::from_be_bytes(png[16..20].try_into().unwrap()), 300);
    assert_eq!(png, simworld_citygen::map::render_png(&city(8).svg(), 300).unwrap());
    // An empty sheet of that size takes about a kilobyte.
    assert!(png.len() > 10_000, "{} bytes", png.len());
    assert!(simworld_citygen::map::render_png("<svg", 300).is_err());
    assert!(simworld_citygen::map::render_png(&city(8).svg(), 0).is_err());
}
