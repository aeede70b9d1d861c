//! GeoJSON is read by another reader, holds everything, and lies where the city lies.

use std::collections::BTreeMap;

use geojson::{FeatureCollection, GeoJson, GeometryValue};
use simworld_citygen::{City, CityConfig, GeoOrigin};
use simworld_core::seed::Seed;

fn read(city: &City) -> FeatureCollection {
    let mut text = Vec::new();
    city.write_geojson(&mut text).expect("memory takes all");
    let text = String::from_utf8(text).expect("JSON is UTF-8");
    FeatureCollection::try_from(text.parse::<GeoJson>().expect("another reader takes it"))
        .expect("a collection of features")
}

fn city() -> City {
    City::generate(&CityConfig::with_roads(20), Seed(5)).expect("defaults are valid")
}

#[test]
fn everything_is_a_feature() {
    let city = city();
    let mut counts: BTreeMap<String, usize> = BTreeMap::new();
    for feature in read(&city).features {
        let layer = feature.property("layer").unwrap().as_str().unwrap().to_owned();
        *counts.entry(layer).or_default() += 1;
    }
    let network = &city.network;
    for (layer, count) in [
        ("street", network.roads.len()),
        ("lane", network.lanes.len()),
        ("intersection", network.intersections.len()),
        ("sidewalk", network.sidewalks.len()),
        ("crossing", network.crossings.len()),
        ("building", city.buildings.len()),
        ("element", city.elements.len()),
    ] {
        assert_eq!(counts.get(layer).copied().unwrap_or(0), count, "{layer}");
    }
}

#[test]
fn rings_are_closed_and_wound_as_they_should() {
    for feature in read(&city()).features {
        let Some(GeometryValue::Polygon { coordinates }) = feature.geometry.map(|geometry| geometry.value)
        else {
            continue;
        };
        for (rank, ring) in coordinates.iter().enumerate() {
            assert_eq!(ring.first(), ring.last());
            let area: f64 = ring.windows(2).map(|p| p[0][0] * p[1][1] - p[1][0] * p[0][1]).sum();
            assert!(if rank == 0 { area > 0.0 } else { area < 0.0 }, "RFC 7946, section 3.1.6");
        }
    }
}

#[test]
fn a_real_place_is_where_it_is() {
    let mut city = city();
    let origin = GeoOrigin { latitude: 43.7384, longitude: 7.4246 };
    city.provenance.origin = Some(origin);
    let features = read(&city).features;
    let streets = features.iter().filter(|f| f.property("layer").unwrap() == "street");
    for (feature, road) in streets.zip(&city.network.roads) {
        let Some(GeometryValue::LineString { coordinates }) = feature.geometry.as_ref().map(|g| &g.value)
        else {
            panic!("a street is a line");
        };
        for (place, point) in coordinates.iter().zip(&road.centerline) {
            let back = origin.to_local([place[0], place[1]]);
            assert!((back - point).norm() < 2e-3, "{back} {point}");
        }
    }
}
