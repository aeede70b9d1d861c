//! Sizes, steps, shares and parts: what is told by measure, by another thing, or by what there is.

use std::f64::consts::TAU;

use crate::city::City;
use simworld_agents::editing::{Edited, SceneEditor};
use simworld_core::geometry::{Point2, Vector2};
use simworld_core::ops::atan2;
use simworld_core::scene::{Scene, World};
use simworld_core::seed::Seed;

/// Says it in a copy of the quarter, and gives what became of it.
fn said(words: &str) -> (City, World, Result<Edited, String>) {
    let city = City::read("quarter");
    let mut world = city.world.clone();
    let outcome = SceneEditor::new(Seed(7)).looking_as(city.me, &world).say(words, &mut world);
    (city, world, outcome.map_err(|error| error.to_string()))
}

/// The height of a thing afterwards, m.
fn height(words: &str, key: &str) -> f64 {
    let (city, world, outcome) = said(words);
    outcome.unwrap_or_else(|error| panic!("{words}: {error}"));
    world.entity(city.ids[key]).expect("it is there").info.shape.size().z
}

/// Where a thing stands afterwards.
fn place(words: &str, key: &str) -> (Point2, Point2) {
    let (city, world, outcome) = said(words);
    outcome.unwrap_or_else(|error| panic!("{words}: {error}"));
    let at = |world: &World| world.entity(city.ids[key]).expect("it is there").planar();
    (at(&city.world), at(&world))
}

#[test]
fn things_are_as_tall_as_they_are_told_to_be() {
    for (words, key, wanted) in [
        ("make the statue six metres tall", "statue", 6.0),
        ("the statue should be 8 m high", "statue", 8.0),
        ("scale the statue to 2 metres", "statue", 2.0),
        ("make the statue two metres taller", "statue", 6.0),
        ("make the statue one metre shorter", "statue", 3.0),
        ("set the height of the statue to 5 metres", "statue", 5.0),
        ("make the statue as tall as the school", "statue", 9.0),
        ("the statue should be half as tall as the museum", "statue", 5.0),
        ("the fountain should be the same height as the statue", "fountain", 4.0),
    ] {
        let got = height(words, key);
        assert!((got - wanted).abs() < 1e-6, "{words}: {got} m for {wanted}");
    }
    let (_, _, outcome) = said("make the statue nine metres shorter");
    assert!(outcome.is_err_and(|why| why.contains("impossible")), "nothing is shorter than nothing");
}

#[test]
fn new_things_are_as_tall_as_they_are_told_to_be() {
    let (_, world, outcome) = said("add a statue three metres tall next to the kiosk");
    let made = outcome.expect("it is understood").made;
    let height = world.entity(made[0]).expect("it was made").info.shape.size().z;
    assert!((height - 3.0).abs() < 1e-6, "{height} m");
}

#[test]
fn new_things_are_as_large_as_others_are() {
    for (words, wanted) in [
        ("put a statue as tall as the museum next to the kiosk", 10.0),
        ("add a flagpole that is twice as tall as the statue in front of the school", 8.0),
        ("plant an oak half as high as the hospital behind the bakery", 7.0),
    ] {
        let (_, world, outcome) = said(words);
        let made = outcome.unwrap_or_else(|error| panic!("{words}: {error}")).made;
        let height = world.entity(made[0]).expect("it was made").info.shape.size().z;
        assert!((height - wanted).abs() < 1e-6, "{words}: {height} m for {wanted}");
    }
}

#[test]
fn new_things_are_spoken_of_as_them() {
    let (_, world, outcome) = said("add two benches in the park and a bin between them");
    let made = outcome.expect("it is understood").made;
    let at = |index: usize| world.entity(made[index]).expect("it was made").planar();
    let (one, other, bin) = (at(0), at(1), at(2));
    let around = (one - bin).norm() + (other - bin).norm();
    assert!(around < 1.5 * (one - other).norm(), "{bin} is not between {one} and {other}");
    let (_, _, outcome) = said("add two students near the statue and turn them towards the museum");
    assert_eq!(outcome.expect("it is understood").edits.len(), 2);
}

#[test]
fn most_of_several_are_more_than_half_of_them() {
    let (city, world, outcome) = said("remove most of the street lamps");
    outcome.expect("two of three are most");
    let left = ["lamp_1", "lamp_2", "lamp_3"].iter().filter(|lamp| world.entity(city.ids[**lamp]).is_some());
    assert_eq!(left.count(), 1);
    let (_, _, outcome) = said("remove most of the cars");
    assert!(outcome.is_err(), "of two there is no most");
}

#[test]
fn steps_lead_towards_a_thing_and_away_from_it() {
    let fountain = Point2::new(150.0, 42.0);
    for (words, key, nearer) in [
        ("move the white car two metres closer to the fountain", "car_white", 2.0),
        ("move Bo 3 metres towards the fountain", "bo", 3.0),
        ("push the white car a metre further away from the fountain", "car_white", -1.0),
    ] {
        let (before, after) = place(words, key);
        let gained = (before - fountain).norm() - (after - fountain).norm();
        assert!((gained - nearer).abs() < 1e-6, "{words}: {gained} m nearer for {nearer}");
    }
}

#[test]
fn every_second_one_begins_where_it_is_told_to() {
    for (words, gone) in [
        ("remove every second lamp, starting with the southernmost one", vec!["lamp_1", "lamp_3"]),
        ("starting with the northernmost, remove every other lamp", vec!["lamp_1", "lamp_3"]),
        ("remove every other street lamp, starting from the second", vec!["lamp_2"]),
        ("remove every other street lamp", vec!["lamp_2"]),
    ] {
        let (city, world, outcome) = said(words);
        outcome.unwrap_or_else(|error| panic!("{words}: {error}"));
        let lamps = ["lamp_1", "lamp_2", "lamp_3"];
        let missing: Vec<&str> =
            lamps.into_iter().filter(|lamp| world.entity(city.ids[*lamp]).is_none()).collect();
        assert_eq!(missing, gone, "{words}");
    }
}

#[test]
fn streets_have_ends_and_areas_have_corners_and_halves() {
    for (words, fits) in [
        ("put a bollard at the east end of Oak Street", (|at| at.x > 170.0) as fn(Point2) -> bool),
        ("a billboard at the northern end of Station Road", |at| at.y > 170.0),
        ("put a bench in the north-east corner of the park", |at| at.x > 62.0 && at.y > 70.0),
        ("a picnic table in the northern half of Rose Park", |at| at.y > 70.0 && at.y < 87.0),
        ("put a tent in the western half of Market Square", |at| at.x < 150.0 && at.x > 125.0),
    ] {
        let (_, world, outcome) = said(words);
        let made = outcome.unwrap_or_else(|error| panic!("{words}: {error}")).made;
        let at = world.entity(made[0]).expect("it was made").planar();
        assert!(fits(at), "{words}: at {at}");
    }
    let (_, _, outcome) = said("put a bollard at the north end of Oak Street");
    assert!(outcome.is_err(), "a street that runs east has no north end");
    let (_, world, outcome) = said("a road blocker at either end of Elm Street");
    let made = outcome.expect("it is understood").made;
    let mut ends: Vec<f64> =
        made.iter().map(|id| world.entity(*id).expect("it was made").planar().x).collect();
    ends.sort_by(f64::total_cmp);
    assert!(matches!(ends[..], [west, east] if west < 30.0 && east > 170.0), "{ends:?}");
}

#[test]
fn shares_and_colours_are_told_off() {
    let (_, _, outcome) = said("remove half of the street lamps");
    assert!(outcome.is_err(), "half of three is no number of lamps");
    let (city, world, outcome) = said("paint half of the cars black");
    outcome.expect("half of two is one");
    let painted = |key: &str| {
        let color = |world: &World| world.entity(city.ids[key]).and_then(|car| car.info.color);
        color(&city.world) != color(&world)
    };
    assert!(painted("car_red") != painted("car_white"), "one of the two is painted");
    let (city, world, outcome) = said("paint the street lamps red, white and blue");
    outcome.expect("three colours for three lamps");
    let mut colors: Vec<[u32; 3]> = ["lamp_1", "lamp_2", "lamp_3"]
        .into_iter()
        .filter_map(|key| Some(world.entity(city.ids[key])?.info.color?.map(f32::to_bits)))
        .collect();
    colors.dedup();
    assert_eq!(colors.len(), 3, "each has its own");
    let (_, _, outcome) = said("as many chairs in Market Square as there are street lamps");
    assert_eq!(outcome.expect("it is understood").made.len(), 3);
}

#[test]
fn what_a_remark_is_about_is_where_new_things_go() {
    for words in
        ["Rose Park feels empty, throw in four deck chairs", "Rose Park is so boring. Add four deck chairs"]
    {
        let (city, world, outcome) = said(words);
        let made = outcome.unwrap_or_else(|error| panic!("{words}: {error}")).made;
        let park = *world.entity(city.ids["park"]).expect("it is there").bounds;
        let inside = |id: &simworld_core::id::EntityId| {
            let at = world.entity(*id).expect("it was made").planar();
            (park.min.x..=park.max.x).contains(&at.x) && (park.min.y..=park.max.y).contains(&at.y)
        };
        assert!(made.len() == 4 && made.iter().all(inside), "{words}");
    }
}

#[test]
fn each_of_those_that_were_spoken_of_gets_one() {
    for words in [
        "The lamps look lonely, put a bucket next to each of them",
        "put a bucket next to each of the street lamps",
    ] {
        let (_, _, outcome) = said(words);
        let made = outcome.unwrap_or_else(|error| panic!("{words}: {error}")).made;
        assert_eq!(made.len(), 3, "{words}");
    }
    let (_, _, outcome) = said("Ada and Bo each need a stool");
    assert_eq!(outcome.expect("it is understood").made.len(), 2);
}

/// The ways from the middle of a ring to those that stand in it, in the order of their angles.
fn ring(words: &str, anchor: &str) -> (Vec<f64>, f64) {
    let (city, world, outcome) = said(words);
    let made = outcome.unwrap_or_else(|error| panic!("{words}: {error}")).made;
    let at = |id| world.entity(id).expect("it is there").planar();
    let ways: Vec<Vector2> = made.iter().map(|id| at(*id) - at(city.ids[anchor])).collect();
    let mut angles: Vec<f64> = ways.iter().map(|way| atan2(way.y, way.x)).collect();
    angles.sort_by(f64::total_cmp);
    (angles, ways[0].norm())
}

#[test]
fn a_ring_is_closed_where_it_begins() {
    for every in [2.3, 2.7, 3.0, 3.3, 4.1] {
        let words = format!("put a cone every {every} m around the statue");
        let (angles, radius) = ring(&words, "statue");
        let step = TAU / (TAU * radius / every).round();
        for (rank, angle) in angles.iter().enumerate() {
            let next = angles[(rank + 1) % angles.len()];
            let steps = (next - angle).rem_euclid(TAU) / step;
            // Each may slide by a tenth of a step to where there is room.
            assert!((steps - steps.round()).abs() < 0.21, "{words}: {steps} steps behind #{rank}");
        }
    }
}

#[test]
fn a_ring_is_no_wider_than_it_has_to_be() {
    // With nothing in the way the ring is the narrowest: the corner of the statue, that of a cone and 0.8 m between them.
    let (_, radius) = ring("put a cone every 2 m around the statue", "statue");
    assert!(radius < 3.5, "{radius} m");
}
