//! What the map draws in pieces is built whole: dual carriageways, bridges, roundabouts, crossings without a node; and a
//! city of surveyed buildings is saved and written like any other.
#![cfg(feature = "osm")]

use crate::osm_common::Sketch;
use simworld_citygen::building::FootprintKind;
use simworld_citygen::osm::{OsmId, Place, PlaceOptions, StreetOptions};
use simworld_citygen::{City, CityConfig, StreetStatistics};
use simworld_core::geometry::Point2;
use simworld_core::net::{Control, LaneKind, StreetPlan};
use simworld_core::seed::Seed;

fn plan(sketch: &Sketch) -> StreetPlan {
    let (plan, _) = sketch.place().plan(&StreetOptions::default());
    assert_eq!(plan.validate(), Ok(()));
    assert_eq!(StreetStatistics::of(&plan).components, 1);
    plan
}

/// The node nearest to a point, and the number of streets there.
fn junction(plan: &StreetPlan, x: f64, y: f64) -> (Point2, usize, Option<Control>) {
    let away = |node: usize| (plan.nodes[node] - Point2::new(x, y)).norm();
    let node = (0..plan.nodes.len()).min_by(|a, b| away(*a).total_cmp(&away(*b))).expect("a plan has nodes");
    let streets = plan.streets.iter().filter(|street| street.from == node || street.to == node).count();
    (plan.nodes[node], streets, plan.controls.get(&node).copied())
}

const WAY: [(&str, &str); 2] = [("highway", "primary"), ("oneway", "yes")];
const SIDE: [(&str, &str); 1] = [("highway", "residential")];

#[test]
fn two_dual_carriageways_cross_at_one_junction() {
    // 18 m apart each; traffic keeps right, so that the eastbound carriageway is the southern one.
    let sketch = Sketch::default()
        .node(1, (-300.0, -9.0), &[])
        .node(2, (-9.0, -9.0), &[("highway", "traffic_signals")])
        .node(3, (9.0, -9.0), &[("highway", "traffic_signals")])
        .node(4, (300.0, -9.0), &[])
        .node(5, (300.0, 9.0), &[])
        .node(6, (9.0, 9.0), &[("highway", "traffic_signals")])
        .node(7, (-9.0, 9.0), &[("highway", "traffic_signals")])
        .node(8, (-300.0, 9.0), &[])
        .node(11, (9.0, -300.0), &[])
        .node(12, (9.0, 300.0), &[])
        .node(13, (-9.0, 300.0), &[])
        .node(14, (-9.0, -300.0), &[])
        .way(&[1, 2, 3, 4], &WAY)
        .way(&[5, 6, 7, 8], &WAY)
        .way(&[11, 3, 6, 12], &WAY)
        .way(&[13, 7, 2, 14], &WAY);
    let plan = plan(&sketch);
    let (at, streets, control) = junction(&plan, 0.0, 0.0);
    assert!((at - Point2::origin()).norm() < 2.0, "{at}");
    assert_eq!((streets, control), (8, Some(Control::Signals)), "the carriageways end apart, as drawn");
}

#[test]
fn carriageways_between_two_junctions_are_one_street_with_a_median() {
    let crossing = |sketch: Sketch, first: i64, x: f64| {
        sketch
            .node(first, (x, -150.0), &[])
            .node(first + 1, (x, -8.0), &[])
            .node(first + 2, (x, 8.0), &[])
            .node(first + 3, (x, 150.0), &[])
            .way(&[first, first + 1, first + 2, first + 3], &SIDE)
    };
    let sketch =
        crossing(crossing(Sketch::default(), 1, 0.0), 11, 200.0).way(&[2, 12], &WAY).way(&[13, 3], &WAY);
    let plan = plan(&sketch);
    assert_eq!(plan.streets.len(), 5);
    let (west, east) = (junction(&plan, -100.0, 0.0), junction(&plan, 100.0, 0.0));
    assert_eq!((west.1, east.1), (3, 3));
    let section = plan
        .streets
        .iter()
        .map(|street| plan.section(street))
        .find(|section| section.lanes.iter().any(|lane| lane.kind == LaneKind::Median));
    let section = section.expect("the road between them has a median");
    assert_eq!(section.driven(), (1, 1));
    let median = section.lanes.iter().find(|lane| lane.kind == LaneKind::Median).unwrap();
    // 16 m from middle to middle, less a lane of 3.4 m.
    assert!((median.width - 12.6).abs() < 0.5, "{}", median.width);
}

#[test]
fn a_bridge_passes_and_a_mistake_is_mended() {
    let cross = |tags: &[(&str, &str)], detour: &[(&str, &str)]| {
        Sketch::default()
            .node(1, (-100.0, 0.0), &[])
            .node(2, (100.0, 0.0), &[])
            .node(3, (0.0, -100.0), &[])
            .node(4, (0.0, 100.0), &[])
            .node(5, (100.0, 100.0), &[])
            .way(&[1, 2], &SIDE)
            .way(&[3, 4], tags)
            .way(&[4, 5, 2], detour)
            .place()
    };
    let (bridge, _) =
        cross(&[("highway", "residential"), ("bridge", "yes")], &SIDE).plan(&StreetOptions::default());
    assert!(bridge.nodes.iter().all(|node| node.coords.norm() > 50.0), "nothing joins the bridge");
    let (own, _) = cross(&SIDE, &SIDE).plan(&StreetOptions::default());
    assert_eq!(junction(&own, 0.0, 0.0).1, 4, "a street that crosses itself");
    let named = [("highway", "residential"), ("name", "Long Way Round")];
    let (level, warnings) = cross(&SIDE, &named).plan(&StreetOptions::default());
    assert_eq!(junction(&level, 0.0, 0.0).1, 4);
    let told = warnings.iter().find(|warning| warning.element == Some(OsmId::Way(1001)));
    assert!(
        told.is_some_and(|warning| warning.what.contains("way 1002") && warning.at.is_some()),
        "{warnings:?}"
    );
}

#[test]
fn a_roundabout_is_a_ring_of_one_way_streets() {
    let mut sketch = Sketch::default();
    for index in 0..24_i64 {
        let angle = index as f64 * std::f64::consts::TAU / 24.0;
        let (sin, cos) = simworld_core::ops::sin_cos(angle);
        sketch = sketch.node(index + 1, (30.0 * cos, 30.0 * sin), &[]);
        if index % 6 == 0 {
            sketch = sketch
                .node(100 + index, (150.0 * cos, 150.0 * sin), &[])
                .way(&[100 + index, index + 1], &SIDE);
        }
    }
    let ring: Vec<i64> = (1..=24).chain([1]).collect();
    let sketch = sketch.way(&ring, &[("highway", "tertiary"), ("junction", "roundabout")]);
    let plan = plan(&sketch);
    let arcs: Vec<_> = plan.streets.iter().filter(|street| plan.section(street).driven() == (1, 0)).collect();
    assert_eq!((plan.streets.len(), arcs.len()), (8, 4));
    // Counter-clockwise, for people keep right there.
    assert!(arcs.iter().all(|arc| plan.nodes[arc.from].coords.perp(&plan.nodes[arc.to].coords) > 0.0));
}

#[test]
fn a_city_of_surveyed_buildings_is_saved_and_written() {
    let corners = [(20.0, 12.0), (50.0, 12.0), (50.0, 40.0), (35.0, 40.0), (35.0, 60.0), (20.0, 60.0)];
    let court = [(40.0, 20.0), (46.0, 20.0), (46.0, 30.0), (40.0, 30.0)];
    let mut sketch =
        Sketch::default().node(1, (-100.0, 0.0), &[]).node(2, (100.0, 0.0), &[]).way(&[1, 2], &SIDE);
    for (index, corner) in corners.iter().chain(&court).enumerate() {
        sketch = sketch.node(index as i64 + 10, *corner, &[]);
    }
    let tags =
        [("type", "multipolygon"), ("building", "hospital"), ("building:levels", "5"), ("name", "St Ann")];
    let sketch = sketch
        .way(&[10, 11, 12, 13, 14, 15, 10], &[])
        .way(&[16, 17, 18, 19, 16], &[])
        .relation(7, &[(1002, "outer"), (1003, "inner")], &tags)
        .node(30, (43.0, 25.0), &[("natural", "tree")]);
    let place: Place = sketch.place();
    let (city, warnings) =
        City::from_place(&place, &PlaceOptions::default(), &CityConfig::default(), Seed(1)).unwrap();
    assert_eq!(warnings, []);
    let hospital = city.buildings.iter().find(|building| building.name.as_deref() == Some("St Ann")).unwrap();
    assert_eq!((hospital.storeys, hospital.footprint.kind()), (5, FootprintKind::Surveyed));
    assert!((hospital.footprint_area() - (30.0 * 28.0 + 15.0 * 20.0 - 60.0)).abs() < 1.0);
    assert_eq!((hospital.outline().len(), hospital.courtyards().len()), (6, 1));
    let boxes: f64 = hospital.solids().map(|solid| 4.0 * solid.half_extents.x * solid.half_extents.y).sum();
    assert!((boxes - hospital.footprint_area()).abs() < 1.0);
    let mut bytes = Vec::new();
    city.write_to(&mut bytes).unwrap();
    assert_eq!(City::from_bytes(&bytes).unwrap(), city);
    let mut glb = Vec::new();
    city.write_glb(&mut glb).unwrap();
    gltf::Glb::from_slice(&glb).unwrap();
    assert!(city.svg().contains("OpenStreetMap contributors"));
}

#[test]
fn a_real_place_stands_on_the_hills_that_it_is_given() {
    let sketch = Sketch::default()
        .node(1, (-400.0, 0.0), &[])
        .node(2, (0.0, 0.0), &[])
        .node(3, (400.0, 0.0), &[])
        .node(4, (0.0, 300.0), &[])
        .way(&[1, 2, 3], &SIDE)
        .way(&[2, 4], &SIDE);
    let mut config = CityConfig::default();
    config.terrain.relief = 30.0;
    let (city, _) = City::from_place(&sketch.place(), &PlaceOptions::default(), &config, Seed(3))
        .expect("it has streets");
    let heights: Vec<f64> = city.network.intersections.iter().map(|place| place.height).collect();
    let (low, high) = heights.iter().fold((f64::MAX, f64::MIN), |(low, high), h| (low.min(*h), high.max(*h)));
    assert!(low >= 0.0 && high <= 30.0 && high - low > 1.0, "{heights:?}");
    for road in &city.network.roads {
        let rise = city.network.intersections[road.to.index()].height
            - city.network.intersections[road.from.index()].height;
        let length = simworld_core::net::polyline::length(&road.centerline);
        assert!(rise.abs() <= config.terrain.local_grade * length + 1e-9, "{rise} m in {length} m");
    }
}
