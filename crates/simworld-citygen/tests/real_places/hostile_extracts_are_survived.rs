//! Any bytes are refused with an error that says where, or give a place whose city holds together: cut short, damaged,
//! cyclic, huge or absurd.
#![cfg(feature = "osm")]

use std::io::Write;

use crate::osm_common::Sketch;
use proptest::prelude::*;
use simworld_citygen::osm::{OsmError, Place, PlaceOptions};
use simworld_citygen::{City, CityConfig, CityError};
use simworld_core::seed::Seed;

/// A small town with a bit of everything.
fn town() -> Sketch {
    let residential = [("highway", "residential"), ("name", "Elm Street")];
    Sketch::default()
        .node(1, (0.0, 0.0), &[("highway", "traffic_signals")])
        .node(2, (120.0, 0.0), &[])
        .node(3, (120.0, 100.0), &[])
        .node(4, (0.0, 100.0), &[])
        .node(5, (30.0, 30.0), &[])
        .node(6, (50.0, 30.0), &[])
        .node(7, (50.0, 50.0), &[])
        .node(8, (30.0, 50.0), &[])
        .node(9, (-60.0, 0.0), &[])
        .node(10, (70.0, 70.0), &[("natural", "tree")])
        .way(&[1, 2, 3, 4, 1], &residential)
        .way(&[9, 1], &[("highway", "primary"), ("lanes", "4")])
        .way(&[5, 6, 7, 8, 5], &[("building", "school"), ("building:levels", "3")])
}

/// What comes of bytes: nothing, or a city that holds together.
fn check(bytes: &[u8]) {
    let Ok(place) = Place::from_bytes(bytes) else { return };
    let made = City::from_place(&place, &PlaceOptions::default(), &CityConfig::default(), Seed(1));
    match made {
        Ok((city, _)) => {
            assert_eq!(city.plan.validate(), Ok(()));
            assert_eq!(city.network.check(), Ok(()));
        }
        Err(error) => assert_eq!(error, CityError::NoStreets),
    }
}

#[test]
fn the_town_itself_is_a_city() {
    let place = town().place();
    let made = City::from_place(&place, &PlaceOptions::default(), &CityConfig::default(), Seed(1));
    let (city, _) = made.unwrap();
    assert!(city.buildings.iter().any(|building| building.storeys == 3));
    assert_eq!(
        city.plan
            .controls
            .values()
            .filter(|control| **control == simworld_core::net::Control::Signals)
            .count(),
        1
    );
}

#[test]
fn a_text_cut_short_is_refused() {
    let text = town().xml();
    for end in (0..text.len() - 1).step_by(7) {
        let error = Place::from_bytes(&text.as_bytes()[..end]).unwrap_err();
        let is_named = matches!(error, OsmError::Xml { .. } | OsmError::Io(_));
        assert!(is_named, "cut at {end}: {error}");
    }
}

#[test]
fn a_compressed_text_cut_short_is_refused() {
    let mut packed = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    packed.write_all(town().xml().as_bytes()).unwrap();
    let packed = packed.finish().unwrap();
    check(&packed);
    assert!(Place::from_bytes(&packed).is_ok());
    for end in 2..packed.len() - 1 {
        assert!(Place::from_bytes(&packed[..end]).is_err(), "cut at {end}");
    }
}

#[test]
fn other_documents_are_refused() {
    for text in [
        "",
        "hello",
        "<gpx></gpx>",
        "<osm></osm>",
        "<osm>",
        "</osm>",
        "<osm><node></osm>",
        "<osm",
        "\u{0}\u{0}\u{0}\u{1}",
    ] {
        assert!(Place::from_bytes(text.as_bytes()).is_err(), "{text:?}");
    }
    let deep = "<osm>".repeat(100_000);
    assert!(matches!(Place::from_bytes(deep.as_bytes()), Err(OsmError::Xml { .. })));
    let mut endless = b"<osm><node id='1' lat='".to_vec();
    endless.resize(4 << 20, b'1');
    assert!(Place::from_bytes(&endless).is_err());
}

#[test]
fn absurd_places_become_what_they_can() {
    // Every node twice at one place, a way that goes back and forth, loops, a way over nodes that are not there.
    let street = [("highway", "residential")];
    let sketches = [
        Sketch::default().node(1, (0.0, 0.0), &[]).way(&[1, 1, 1], &street),
        Sketch::default().node(1, (0.0, 0.0), &[]).node(2, (0.0, 0.0), &[]).way(&[1, 2, 1, 2], &street),
        Sketch::default().node(1, (0.0, 0.0), &[]).node(2, (90.0, 0.0), &[]).way(&[1, 2, 1, 2, 1], &street),
        Sketch::default()
            .node(1, (0.0, 0.0), &[])
            .node(2, (90.0, 0.0), &[])
            .way(&[7, 8, 9], &street)
            .way(&[1, 2], &street),
        Sketch::default().node(1, (0.0, 0.0), &[]).node(2, (5e6, 5e6), &[]).way(&[1, 2], &street),
        // A building that bounds itself, and one with its courtyard outside.
        town().relation(
            1,
            &[(1003, "outer"), (1003, "inner"), (1, "outer"), (99, "")],
            &[("type", "multipolygon"), ("building", "yes")],
        ),
        town().relation(1, &[(1003, "inner")], &[("type", "multipolygon"), ("building", "yes")]),
    ];
    for sketch in sketches {
        check(sketch.xml().as_bytes());
    }
}

#[test]
fn a_crowd_of_ways_takes_bounded_time() {
    // All ways through one node, and a thousand that cross each other without any.
    let mut star = Sketch::default().node(1, (0.0, 0.0), &[]);
    let mut mesh = Sketch::default();
    for index in 0..400_i64 {
        let at = index as f64;
        let street = [("highway", "residential")];
        star = star.node(index + 2, (at * 3.0 - 600.0, 300.0), &[]).way(&[1, index + 2], &street);
        let (a, b) = (2 * index + 1, 2 * index + 2);
        mesh = if index % 2 == 0 {
            mesh.node(a, (at, -50.0), &[]).node(b, (at + 1.0, 450.0), &[])
        } else {
            mesh.node(a, (-50.0, at), &[]).node(b, (450.0, at + 1.0), &[])
        };
        mesh = mesh.way(&[a, b], &street);
    }
    check(star.xml().as_bytes());
    check(mesh.xml().as_bytes());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(if std::env::var_os("SIMWORLD_SOAK").is_some() { 20_000 } else { 300 }))]

    #[test]
    fn damaged_texts_never_panic(places in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..12)) {
        let mut bytes = town().xml().into_bytes();
        for (index, byte) in places {
            let at = index.index(bytes.len());
            bytes[at] = byte;
        }
        check(&bytes);
    }

    #[test]
    fn scribbles_become_sound_cities(
        points in prop::collection::vec((-400.0..400.0_f64, -400.0..400.0_f64), 2..40),
        ways in prop::collection::vec((prop::collection::vec(any::<prop::sample::Index>(), 2..9), 0..6_usize), 1..20),
    ) {
        const TAGS: [&[(&str, &str)]; 6] = [
            &[("highway", "residential")],
            &[("highway", "primary"), ("oneway", "yes"), ("lanes", "3")],
            &[("highway", "motorway_link"), ("layer", "1"), ("bridge", "yes")],
            &[("highway", "tertiary"), ("junction", "roundabout")],
            &[("highway", "secondary"), ("oneway", "-1")],
            &[("building", "yes")],
        ];
        let mut sketch = Sketch::default();
        for (index, point) in points.iter().enumerate() {
            sketch = sketch.node(index as i64 + 1, *point, &[]);
        }
        for (nodes, kind) in &ways {
            let mut nodes: Vec<i64> = nodes.iter().map(|node| node.index(points.len()) as i64 + 1).collect();
            if *kind == 5 {
                nodes.push(nodes[0]);
            }
            sketch = sketch.way(&nodes, TAGS[*kind]);
        }
        check(sketch.xml().as_bytes());
    }
}
