//! World files of the Python release: written as it writes them, and read back to the same streets.

use simworld_citygen::python::{self, WorldFile, read_roads, read_world};
use simworld_citygen::{City, CityConfig};
use simworld_core::net::polyline;
use simworld_core::seed::Seed;

/// Two roads and a building as the release writes them, shortened.
const RELEASED: &str = r#"{
  "base_map": {"name": "map_1", "env_bin": "citynav.exe", "width": 1000, "height": 1000},
  "nodes": [
    {"id": "GEN_Road_0", "instance_name": "BP_Road1_C", "properties": {
      "location": {"x": 10000.0, "y": 0.0, "z": 0},
      "orientation": {"pitch": 0, "yaw": 0.0, "roll": 0},
      "scale": {"x": 0.95, "y": 0.9, "z": 1.0}}},
    {"id": "GEN_Road_1", "instance_name": "BP_Road1_C", "properties": {
      "location": {"x": 20000.0, "y": 10000.0, "z": 0},
      "orientation": {"pitch": 0, "yaw": 90.0, "roll": 0},
      "scale": {"x": 0.95, "y": 0.9, "z": 1.0}}},
    {"id": "GEN_BP_Building_12_C_2", "instance_name": "BP_Building_12_C", "properties": {
      "location": {"x": 5000.0, "y": 2500.0, "z": 0},
      "orientation": {"pitch": 0, "yaw": 180.0, "roll": 0},
      "scale": {"x": 1.0, "y": 1.0, "z": 1.0}},
     "segment_assignment": {"start": {"x": 0, "y": 0}, "end": {"x": 200, "y": 0}, "angle": 0}}
  ]
}"#;

#[test]
fn a_released_world_gives_its_streets() {
    let (plan, warnings) = read_world(RELEASED.as_bytes()).unwrap();
    assert!(warnings.is_empty());
    assert_eq!((plan.nodes.len(), plan.streets.len()), (3, 2));
    let ends: Vec<(f64, f64)> = plan.nodes.iter().map(|node| (node.x.round(), node.y.round())).collect();
    assert_eq!(ends, [(0.0, 0.0), (200.0, 0.0), (200.0, 200.0)]);
}

#[test]
fn a_written_world_comes_back() {
    let city = City::generate(&CityConfig::with_roads(20), Seed(3)).unwrap();
    let text = python::write(&city.world_file());
    let world: WorldFile = python::read(text.as_bytes()).unwrap();
    assert_eq!(world, city.world_file());
    let things = city.roads_file().roads.len() + city.buildings.len() + city.elements.len();
    assert_eq!(world.nodes.len(), things);
    // The layout and the world tell of the same streets.
    let (from_layout, _) = read_roads(python::write(&city.roads_file()).as_bytes()).unwrap();
    let (from_world, _) = read_world(text.as_bytes()).unwrap();
    assert_eq!(from_layout.streets.len(), from_world.streets.len());
    let length = |plan: &simworld_core::net::StreetPlan| -> f64 {
        plan.streets.iter().map(|street| polyline::length(&plan.centerline(street))).sum()
    };
    assert!((length(&from_layout) - length(&from_world)).abs() < 0.02 * things as f64);
}

#[test]
fn a_broken_world_is_named() {
    let wrong = RELEASED.replace("\"yaw\": 90.0", "\"yaw\": \"north\"");
    let error = read_world(wrong.as_bytes()).unwrap_err().to_string();
    assert!(error.contains("nodes[1].properties.orientation.yaw"), "{error}");
    let far = RELEASED.replace("20000.0", "1e300");
    assert!(read_world(far.as_bytes()).is_err());
    assert!(read_world(br#"{"base_map": {}, "nodes": []}"#).is_err());
}
