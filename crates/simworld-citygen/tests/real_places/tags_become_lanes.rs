//! What tags say of a street is what is built: lanes, directions, sidewalks, widths, speeds, sides of the road.
#![cfg(feature = "osm")]

use crate::osm_common::Sketch;
use simworld_citygen::osm::{Place, StreetOptions};
use simworld_core::geometry::Point2;
use simworld_core::net::{CrossSection, LaneDirection, LaneKind, RoadClass, Street, StreetPlan};

/// The only street of a way of 200 m to the east with these tags.
fn street(tags: &[(&str, &str)]) -> (StreetPlan, Street) {
    let sketch = Sketch::default().node(1, (-100.0, 0.0), &[]).node(2, (100.0, 0.0), &[]).way(&[1, 2], tags);
    let (plan, warnings) = sketch.place().plan(&StreetOptions::default());
    assert_eq!(warnings, [], "{tags:?}");
    assert_eq!(plan.streets.len(), 1, "{tags:?}");
    let street = plan.streets[0].clone();
    (plan, street)
}

fn section(tags: &[(&str, &str)]) -> CrossSection {
    let (plan, street) = street(tags);
    plan.section(&street).clone()
}

/// Kinds from left to right: upper case along, lower case against, a dot for neither.
fn strips(section: &CrossSection) -> String {
    let letter = |kind| match kind {
        LaneKind::Driving => 'D',
        LaneKind::Bus => 'B',
        LaneKind::Cycle => 'C',
        LaneKind::Parking => 'P',
        LaneKind::Sidewalk => 'S',
        _ => 'X',
    };
    let strip = |kind, direction| match direction {
        LaneDirection::Backward => letter(kind).to_ascii_lowercase(),
        _ => letter(kind),
    };
    section.lanes.iter().map(|lane| strip(lane.kind, lane.direction)).collect()
}

#[test]
fn lanes_are_counted_as_tagged() {
    let cases: [(&[(&str, &str)], &str); 12] = [
        (&[("highway", "residential")], "SdDS"),
        (&[("highway", "primary"), ("lanes", "4")], "SddDDS"),
        (&[("highway", "primary"), ("lanes", "3"), ("lanes:forward", "1")], "SddDS"),
        (&[("highway", "primary"), ("lanes", "3"), ("lanes:backward", "1")], "SdDDS"),
        (
            &[
                ("highway", "primary"),
                ("turn:lanes:forward", "left||right"),
                ("turn:lanes:backward", "left|"),
            ],
            "SddDDDS",
        ),
        (&[("highway", "secondary"), ("oneway", "yes"), ("turn:lanes", "left|through|right")], "SDDDS"),
        (&[("highway", "motorway")], "DD"),
        (&[("highway", "tertiary"), ("sidewalk", "right")], "dDS"),
        (&[("highway", "tertiary"), ("sidewalk:left", "separate"), ("sidewalk:right", "no")], "SdD"),
        (&[("highway", "residential"), ("cycleway:right", "lane"), ("parking:left", "lane")], "SpdDCS"),
        (&[("highway", "residential"), ("oneway", "yes"), ("parking:lane:both", "parallel")], "SPDPS"),
        (&[("highway", "primary"), ("oneway", "yes"), ("lanes", "3"), ("lanes:bus", "1")], "SDDBS"),
    ];
    for (tags, expected) in cases {
        assert_eq!(strips(&section(tags)), expected, "{tags:?}");
    }
}

#[test]
fn a_street_against_its_way_runs_the_way_it_is_driven() {
    let (plan, street) = street(&[("highway", "residential"), ("oneway", "-1"), ("sidewalk", "left")]);
    let (from, to) = (plan.nodes[street.from], plan.nodes[street.to]);
    assert!(from.x > to.x, "it is driven to the west");
    // The left of the way, drawn to the east, is in the north: on the right of those who drive west.
    assert_eq!(strips(plan.section(&street)), "DS");
}

#[test]
fn speeds_and_classes_are_read() {
    let speed = |tags| street(tags).1.speed_limit;
    let near = |found: Option<f64>, expected: f64| (found.unwrap() - expected).abs() < 1e-9;
    assert!(near(speed(&[("highway", "primary"), ("maxspeed", "30 mph")]), 13.4112));
    assert!(near(speed(&[("highway", "primary"), ("maxspeed", "50")]), 50.0 / 3.6));
    assert!(near(speed(&[("highway", "living_street")]), 10.0 / 3.6));
    assert_eq!(speed(&[("highway", "primary"), ("maxspeed", "signals")]), None);
    let class = |highway| street(&[("highway", highway)]).1.class;
    assert_eq!(class("motorway"), RoadClass::Highway);
    assert_eq!(class("tertiary_link"), RoadClass::Arterial);
    assert_eq!(class("unclassified"), RoadClass::Local);
}

#[test]
fn what_cars_may_not_use_is_no_street() {
    for tags in [
        &[("highway", "footway")][..],
        &[("highway", "construction")],
        &[("highway", "residential"), ("access", "private")],
        &[("highway", "residential"), ("motor_vehicle", "no")],
        &[("highway", "residential"), ("area", "yes")],
        &[("highway", "service"), ("service", "driveway")],
        &[("building", "yes")],
    ] {
        let sketch =
            Sketch::default().node(1, (-100.0, 0.0), &[]).node(2, (100.0, 0.0), &[]).way(&[1, 2], tags);
        let (plan, _) = sketch.place().plan(&StreetOptions::default());
        assert!(plan.streets.is_empty(), "{tags:?}");
    }
    let open = [("highway", "residential"), ("access", "private"), ("motor_vehicle", "permissive")];
    assert_eq!(strips(&section(&open)), "SdDS");
}

#[test]
fn where_people_keep_left_lanes_lie_on_the_left() {
    let left = section(&[("highway", "residential"), ("driving_side", "left")]);
    assert_eq!(strips(&left), "SDdS");
    // Leeds, by where it lies.
    let leeds = "<osm><node id='1' lat='53.80' lon='-1.54'/><node id='2' lat='53.802' lon='-1.54'/>\
                 <way id='1'><nd ref='1'/><nd ref='2'/><tag k='highway' v='primary'/></way></osm>";
    let (plan, _) = Place::from_xml(leeds.as_bytes()).unwrap().plan(&StreetOptions::default());
    assert_eq!(strips(plan.section(&plan.streets[0])), "SDdS");
}

#[test]
fn a_metre_on_the_map_is_a_metre() {
    let (plan, street) = street(&[("highway", "residential"), ("name", "Long Lane &amp; Co")]);
    let line = plan.centerline(&street);
    assert!(((line[1] - line[0]).norm() - 200.0).abs() < 0.05, "{line:?}");
    assert!((plan.nodes[street.from] - Point2::new(-100.0, 0.0)).norm() < 0.1, "the middle is the origin");
    assert_eq!(plan.name(&street), Some("Long Lane & Co"));
}
