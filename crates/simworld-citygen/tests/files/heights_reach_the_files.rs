//! A city on hills is hilly in its files too: GLB stands on the ground, OpenDRIVE roads have elevation profiles.

use simworld_citygen::{City, CityConfig};
use simworld_core::seed::Seed;

fn city(relief: f64) -> City {
    let mut config = CityConfig::with_roads(30);
    config.terrain.relief = relief;
    City::generate(&config, Seed(4)).unwrap()
}

/// Least and greatest height of the vertices of one node of a GLB, m.
fn heights(city: &City, node: &str) -> (f64, f64) {
    let mut glb = Vec::new();
    city.write_glb(&mut glb).unwrap();
    let length = u32::from_le_bytes(glb[12..16].try_into().unwrap()) as usize;
    let json: serde_json::Value = serde_json::from_slice(&glb[20..20 + length]).unwrap();
    let nodes = json["nodes"].as_array().unwrap();
    let mesh = nodes.iter().find(|it| it["name"] == node).unwrap()["mesh"].as_u64().unwrap() as usize;
    let parts = json["meshes"][mesh]["primitives"].as_array().unwrap();
    let bound = |part: &serde_json::Value, which: &str| {
        let accessor = part["attributes"]["POSITION"].as_u64().unwrap() as usize;
        json["accessors"][accessor][which][1].as_f64().unwrap()
    };
    let low = parts.iter().map(|part| bound(part, "min")).fold(f64::INFINITY, f64::min);
    (low, parts.iter().map(|part| bound(part, "max")).fold(f64::NEG_INFINITY, f64::max))
}

#[test]
fn meshes_stand_on_the_ground() {
    let (low, high) = heights(&city(0.0), "roads");
    assert!(low > -0.2 && high < 0.0, "{low} to {high} m on level ground");
    let city = city(40.0);
    let junctions = city.network.intersections.iter().map(|place| place.height);
    let (least, most) =
        junctions.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), at| (low.min(at), high.max(at)));
    assert!(most - least > 8.0, "the hills are too low for this test");
    for node in ["roads", "sidewalks", "markings"] {
        let (low, high) = heights(&city, node);
        assert!((low - least).abs() < 1.5 && (high - most).abs() < 1.5, "{node}: {low} to {high}");
    }
}

#[test]
fn roads_have_elevation_profiles() {
    let city = city(40.0);
    let mut bytes = Vec::new();
    city.write_opendrive(&mut bytes).unwrap();
    let text = String::from_utf8(bytes).unwrap();
    let number = |text: &str, name: &str| -> f64 {
        let start = text.find(&format!(" {name}=\"")).unwrap() + name.len() + 3;
        text[start..].split('"').next().unwrap().parse().unwrap()
    };
    let mut seen = 0;
    for road in text.split("<road name=").skip(1) {
        let (id, length) = (number(road, "id") as usize, number(road, "length"));
        let profile =
            road.split("<elevationProfile>").nth(1).unwrap().split("</elevationProfile>").next().unwrap();
        let first = profile.split("<elevation ").nth(1).unwrap();
        let (a, b) = (number(&format!(" {first}"), "a"), number(&format!(" {first}"), "b"));
        if let Some(road) = city.network.roads.get(id) {
            let ends = [road.from, road.to].map(|end| city.network.intersections[end.index()].height);
            let (low, high) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
            let range = low - 1e-6..=high + 1e-6;
            assert!(range.contains(&a) && range.contains(&(a + b * length)), "road {id}: {a} + {b} s");
            seen += usize::from(high - low > 1.0);
        }
    }
    assert!(seen > 5, "{seen} roads climb");
}
