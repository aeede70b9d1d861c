//! An edited city is what the whole city would be on its new streets, edits reach no farther than the blocks that they
//! touch, and each is taken back to the bit.

use std::collections::BTreeSet;

use simworld_citygen::block::Border;
use simworld_citygen::building::Building;
use simworld_citygen::edit::{CityEdit, CityEditor, EditError, NewStreet};
use simworld_citygen::element::Element;
use simworld_citygen::terrain::{DECK, HEADROOM};
use simworld_citygen::{City, CityConfig, Style};
use simworld_core::geometry::{Point2, Vector2};
use simworld_core::id::{IntersectionId, RoadId};
use simworld_core::net::{CAR_TURNING, LORRY_TURNING, RoadNetwork, StreetPlan, polyline};
use simworld_core::scene::{EntityKind, Place, Shape};
use simworld_core::seed::{Seed, StreamRng};
use simworld_core::testing::numbered_in_order;

fn city(style: Style, roads: u32, seed: u64) -> City {
    let config = CityConfig { roads: style.roads(roads), ..CityConfig::default() };
    City::generate(&config, Seed(seed)).expect("presets are valid")
}

/// An edit of the streets by chance.
fn any_edit(city: &City, rng: &mut StreamRng) -> CityEdit {
    let roads = &city.network.roads;
    let middle = |road: usize| nalgebra::center(&roads[road].centerline[0], &roads[road].centerline[1]);
    match rng.below(4) {
        0 => CityEdit::RemoveStreet(RoadId::from_index(rng.below(roads.len()))),
        1 => {
            let node = rng.below(city.network.intersections.len());
            let shift = Vector2::new(rng.uniform(-9.0, 9.0), rng.uniform(-9.0, 9.0));
            let to = city.network.intersections[node].center + shift;
            CityEdit::MoveIntersection { intersection: IntersectionId::from_index(node), to }
        }
        2 => {
            // Out into the open, from anywhere.
            let from = middle(rng.below(roads.len()));
            let away = simworld_core::geometry::direction(rng.uniform(0.0, std::f64::consts::TAU))
                * rng.uniform(40.0, 160.0);
            CityEdit::AddStreet(NewStreet::local([from, from + away]))
        }
        _ => {
            let (a, b) = (rng.below(roads.len()), rng.below(roads.len()));
            CityEdit::AddStreet(NewStreet {
                name: Some("New Way".to_owned()),
                ..NewStreet::local([middle(a), middle(b)])
            })
        }
    }
}

/// What may differ between a building that stayed and one that is built anew: its use, its name, and where its road stands in
/// the list.
fn forms(buildings: &[Building]) -> Vec<Building> {
    let mut forms: Vec<Building> = buildings
        .iter()
        .map(|building| Building { place: Place::Home, name: None, ..building.clone() })
        .collect();
    forms.sort_by(|a, b| a.center.x.total_cmp(&b.center.x).then(a.center.y.total_cmp(&b.center.y)));
    forms
}

/// Terraces follow the use of the building behind, which stays.
fn is_terrace(element: &Element) -> bool {
    matches!(element.kind, EntityKind::Table | EntityKind::Chair)
}

/// Elements, but for terraces, of which there is none like them at their place among others.
fn strays<'a>(elements: &'a [Element], others: &[Element]) -> impl Iterator<Item = &'a Element> {
    let key = |element: &Element| (element.kind, [element.position.x, element.position.y].map(f64::to_bits));
    let there: BTreeSet<_> = others.iter().map(key).collect();
    elements.iter().filter(move |element| !is_terrace(element) && !there.contains(&key(element)))
}

/// Those that stand in one of two cities alone, and not because of a terrace: what stands on one leaves no room for a thing behind the
/// sidewalk, and where that is not there is room for the next.
fn unexplained(ours: &[Element], theirs: &[Element]) -> Vec<(EntityKind, Point2)> {
    let place = |element: &Element| (element.kind, element.position);
    let mut left: Vec<_> = strays(ours, theirs).chain(strays(theirs, ours)).map(place).collect();
    let all = ours.iter().chain(theirs);
    let mut causes: Vec<Point2> = all.filter(|one| is_terrace(one)).map(|one| one.position).collect();
    while let Some(next) =
        left.iter().position(|(_, at)| causes.iter().any(|cause| (at - cause).norm() < 3.0))
    {
        causes.push(left.swap_remove(next).1);
    }
    left
}

fn assert_like_the_whole(city: &City, after: &str) {
    let whole = City::from_plan(city.plan.clone(), &city.config, city.provenance.seed).expect("it was built");
    assert_eq!(city.network.check(), Ok(()), "{after}");
    let derived = RoadNetwork::derive(&city.plan, &city.config.network).expect("it was derived");
    assert!(numbered_in_order(&city.network) == numbered_in_order(&derived), "{after}: other roads");
    let (ours, theirs) = (forms(&city.buildings), forms(&whole.buildings));
    let stray = ours.iter().zip(&theirs).find(|(a, b)| a != b);
    assert!(ours == theirs, "{after}: {} buildings for {}, first {stray:#?}", ours.len(), theirs.len());
    let stray = unexplained(&city.elements, &whole.elements);
    assert!(stray.is_empty(), "{after}: in one city alone {stray:?}");
    assert!((city.frontage_used() - whole.frontage_used()).abs() < 1e-9, "{after}: other frontage");
}

#[test]
fn edits_of_streets_give_the_city_of_the_new_streets() {
    let whole = std::env::var_os("SIMWORLD_SOAK").is_some();
    for seed in if whole { 0..200 } else { 0..2 } {
        for style in Style::ALL {
            edit_by_chance(style, seed);
        }
    }
}

/// A street that alone joined two parts of a town was taken away, and the far part lost its houses; the land of parts near one another was
/// made as if the other was not there; a shrub stood where another use of a house sets tables.
#[test]
fn pieces_of_a_town_are_built_on_together() {
    edit_by_chance(Style::Mixed, 14);
    edit_by_chance(Style::Organic, 20);
    edit_by_chance(Style::Grid, 29);
}

fn edit_by_chance(style: Style, seed: u64) {
    let mut editor = CityEditor::new(city(style, 60, seed));
    let mut rng = Seed(seed).stream("edits").rng();
    // Many of these are refused: they would leave a piece of a street too short to be one.
    let (mut step, mut done) = (0, 0);
    while done < 6 {
        step += 1;
        assert!(step < 100, "{style:?} {seed}: only {done} edits were possible");
        let before = editor.city().clone();
        let edit = any_edit(&before, &mut rng);
        let after = format!("{style:?} {seed}, step {step}, {edit:?}");
        let Ok(undo) = editor.apply(&edit) else {
            assert!(*editor.city() == before, "{after}: a refused edit changed something");
            continue;
        };
        done += 1;
        assert_like_the_whole(editor.city(), &after);
        let edited = editor.city().clone();
        let redo = editor.put(undo).expect("an undo fits");
        assert!(*editor.city() == before, "{after}: not taken back");
        editor.put(redo).expect("a redo fits");
        assert!(*editor.city() == edited, "{after}: not done again");
    }
}

/// Where open land is large only the part of it is made anew that a change reaches.
#[test]
fn edits_at_the_edge_give_the_city_of_the_new_streets() {
    let whole = std::env::var_os("SIMWORLD_SOAK").is_some();
    for seed in 0..if whole { 40 } else { 1 } {
        for style in Style::ALL {
            edit_at_the_edge(style, seed);
        }
    }
}

/// The outermost streets of a town go, and others lead out of it.
fn edit_at_the_edge(style: Style, seed: u64) {
    let mut editor = CityEditor::new(city(style, 500, seed));
    let mut rng = Seed(seed).stream("edges").rng();
    for step in 0..8 {
        let roads = &editor.city().network.roads;
        let middle = |road: usize| nalgebra::center(&roads[road].centerline[0], &roads[road].centerline[1]);
        let away = simworld_core::geometry::direction(rng.uniform(0.0, std::f64::consts::TAU));
        let beyond = |road: usize| middle(road).coords.dot(&away);
        let outermost = (0..roads.len()).max_by(|a, b| beyond(*a).total_cmp(&beyond(*b)));
        let road = outermost.expect("a town has streets");
        let edit = if step % 2 == 0 {
            CityEdit::RemoveStreet(RoadId::from_index(road))
        } else {
            CityEdit::AddStreet(NewStreet::local([middle(road), middle(road) + away * 90.0]))
        };
        if editor.apply(&edit).is_ok() {
            assert_like_the_whole(editor.city(), &format!("{style:?} {seed}, step {step}, {edit:?}"));
        }
    }
}

/// Buildings away from an edit keep their names, their uses and their numbers.
#[test]
fn what_an_edit_does_not_touch_stays() {
    let before = city(Style::Mixed, 400, 3);
    let mut editor = CityEditor::new(before.clone());
    let road = before.network.roads.len() / 2;
    let undo = editor.apply(&CityEdit::RemoveStreet(RoadId::from_index(road))).expect("a street can go");
    let touched = undo.buildings.set.len();
    assert!(touched > 0 && touched * 5 < before.buildings.len(), "{touched} of {}", before.buildings.len());
    let at = before.network.intersections[before.network.roads[road].from.index()].center;
    let far = |building: &&Building| (building.center - at).norm() > 800.0;
    let after = editor.city();
    let mut kept = 0;
    for building in before.buildings.iter().filter(far) {
        let same = after.buildings.iter().find(|other| other.center == building.center);
        kept += usize::from(
            same.is_some_and(|same| (&same.name, same.place) == (&building.name, building.place)),
        );
    }
    let all = before.buildings.iter().filter(far).count();
    assert!(all > 100 && kept == all, "{kept} of {all}");
}

#[test]
fn buildings_and_elements_come_move_and_go() {
    let before = city(Style::Grid, 80, 1);
    let mut editor = CityEditor::new(before.clone());
    let mut undos = Vec::new();
    // The lot of a house that is taken away has room for another one.
    let old = before.buildings[7].clone();
    undos.push(editor.apply(&CityEdit::RemoveBuilding(7)).expect("a house can go"));
    assert_eq!(editor.city().buildings.len(), before.buildings.len() - 1);
    let new = Building { place: Place::Museum, name: None, storeys: 3, ..old.clone() };
    undos.push(editor.apply(&CityEdit::AddBuilding(Box::new(new))).expect("its lot is free"));
    let number = editor.city().buildings.len() - 1;
    let museum = editor.city().buildings[number].clone();
    assert!(museum.given && museum.name.is_some());
    // Where one stands there is no room for a second one.
    let error = editor.apply(&CityEdit::AddBuilding(Box::new(old))).expect_err("it is taken");
    assert!(matches!(error, EditError::Taken { .. }), "{error}");
    let road = museum.access;
    let moved = CityEdit::MoveBuilding { building: number, to: road, facing: 0.0 };
    assert!(matches!(editor.apply(&moved), Err(EditError::Taken { .. })));
    let lane = editor.city().network.lanes[3].path[0];
    let bench = |position: Point2| Element {
        kind: EntityKind::Bench,
        position,
        facing: 0.0,
        shape: Shape::cuboid(0.6, 1.8, 0.8),
        along: Border::LAND,
    };
    assert!(matches!(editor.apply(&CityEdit::AddElement(bench(lane))), Err(EditError::Taken { .. })));
    let walk = &editor.city().network.sidewalks[5];
    let free = (0..40)
        .map(|step| simworld_core::net::polyline::at(&walk.path, 2.0 * f64::from(step)).0)
        .collect::<Vec<_>>();
    let set = free.into_iter().find_map(|at| editor.apply(&CityEdit::AddElement(bench(at))).ok());
    undos.push(set.expect("a sidewalk has room for a bench"));
    let number = editor.city().elements.len() - 1;
    undos.push(editor.apply(&CityEdit::RemoveElement(number)).expect("a bench can go"));
    for error in [
        editor.apply(&CityEdit::RemoveBuilding(1 << 40)).unwrap_err(),
        editor.apply(&CityEdit::RemoveStreet(RoadId(u32::MAX))).unwrap_err(),
    ] {
        assert!(matches!(error, EditError::Missing { .. }), "{error}");
    }
    let nowhere = CityEdit::MoveElement { element: 0, to: Point2::new(f64::NAN, 0.0), facing: 0.0 };
    assert!(matches!(editor.apply(&nowhere), Err(EditError::Size { .. })));
    for undo in undos.into_iter().rev() {
        editor.put(undo).expect("an undo fits");
    }
    assert!(editor.into_city() == before);
}

/// What a hand put there stands when the street before it is moved, and goes when a street runs through it.
#[test]
fn what_was_given_stays_as_long_as_it_has_room() {
    let before = city(Style::Grid, 80, 2);
    let mut editor = CityEditor::new(before.clone());
    let old = before.buildings[11].clone();
    editor.apply(&CityEdit::RemoveBuilding(11)).expect("a house can go");
    editor
        .apply(&CityEdit::AddBuilding(Box::new(Building { storeys: 2, ..old.clone() })))
        .expect("its lot is free");
    let stands = |editor: &CityEditor| {
        editor.city().buildings.iter().any(|building| building.given && building.center == old.center)
    };
    // The next street to the house, but not its own, goes.
    let network = &editor.city().network;
    let own = network.roads[old.road.index()].clone();
    let neighbour = network.intersections[own.to.index()].roads.iter().find(|road| **road != old.road);
    let neighbour = *neighbour.expect("streets of a grid meet");
    editor.apply(&CityEdit::RemoveStreet(neighbour)).expect("a street can go");
    assert!(stands(&editor), "it had room");
    let building = editor.city().buildings.iter().find(|building| building.given).expect("it stands").clone();
    assert!(editor.city().network.sidewalk(building.road, building.side).is_some());
    // A street from its own one straight through it.
    let length = simworld_core::net::polyline::length(&own.centerline);
    let from = simworld_core::net::polyline::at(&own.centerline, length * 0.5).0;
    let away = (old.center - from).normalize();
    let through = [15.0, 25.0, 40.0, 60.0].map(|beyond| old.center + away * beyond);
    let done = through
        .into_iter()
        .any(|to| editor.apply(&CityEdit::AddStreet(NewStreet::local([from, to]))).is_ok());
    assert!(done, "there is room for a street");
    assert!(!stands(&editor), "a street runs through it");
}

/// The turning circles of a city, by radius.
fn circles(city: &City) -> Vec<f64> {
    let places = city.network.intersections.iter();
    places.filter_map(|place| place.turning).map(|circle| circle.radius).collect()
}

/// The number of its hammerheads.
fn heads(city: &City) -> usize {
    city.network.intersections.iter().filter(|place| place.hammerhead.is_some()).count()
}

#[test]
fn a_street_end_gets_its_turning_circle_and_loses_it_to_a_street_beside() {
    let plan = StreetPlan::grid(2, 2, 400.0);
    let before = City::from_plan(plan, &CityConfig::default(), Seed(3)).expect("a square can be built");
    assert!(circles(&before).is_empty());
    let mut editor = CityEditor::new(before.clone());
    let lane = |from: (f64, f64), to: (f64, f64)| {
        let ends = [from, to].map(|(x, y)| Point2::new(x, y));
        CityEdit::AddStreet(NewStreet::local(ends))
    };
    let mut undos = vec![editor.apply(&lane((200.0, 0.0), (200.0, 150.0))).expect("there is room")];
    assert_eq!(circles(editor.city()), [LORRY_TURNING]);
    assert_like_the_whole(editor.city(), "a dead end");
    // A street close by leaves no room for lorries, and one right before it room for a hammerhead alone.
    undos.push(editor.apply(&lane((220.0, 0.0), (220.0, 400.0))).expect("there is room"));
    assert_eq!(circles(editor.city()), [CAR_TURNING]);
    assert_like_the_whole(editor.city(), "a street beside a dead end");
    undos.push(editor.apply(&lane((0.0, 165.0), (220.0, 165.0))).expect("there is room"));
    assert!(circles(editor.city()).is_empty());
    assert_eq!(heads(editor.city()), 1);
    assert_like_the_whole(editor.city(), "a street before a dead end");
    // An end that is none any more has no room to turn, and one that a removal leaves has a circle.
    undos.push(editor.apply(&lane((200.0, 150.0), (200.0, 165.0))).expect("a street of 15 m can be built"));
    assert_eq!(heads(editor.city()), 0);
    assert_eq!(editor.city().network.check(), Ok(()));
    let last = |editor: &CityEditor, at: (f64, f64)| {
        let at = Point2::new(at.0, at.1);
        let ends = |road: &simworld_core::net::Road| {
            [road.centerline[0], road.centerline[road.centerline.len() - 1]]
        };
        editor
            .city()
            .network
            .roads
            .iter()
            .position(|road| ends(road).iter().any(|end| (end - at).norm() < 0.1))
    };
    let road = last(&editor, (0.0, 400.0)).expect("the corner has streets");
    undos.push(editor.apply(&CityEdit::RemoveStreet(RoadId::from_index(road))).expect("a street can go"));
    assert_eq!(circles(editor.city()), [LORRY_TURNING], "the end of the street that is left");
    assert_like_the_whole(editor.city(), "a street gone");
    for undo in undos.into_iter().rev() {
        editor.put(undo).expect("an undo fits");
    }
    assert!(editor.into_city() == before);
}

#[test]
fn bridges_are_built_and_raised_over_what_comes_below_them() {
    let before =
        City::from_plan(StreetPlan::grid(3, 2, 300.0), &CityConfig::default(), Seed(3)).expect("it fits");
    let mut editor = CityEditor::new(before.clone());
    let street = |from: (f64, f64), to: (f64, f64), level: i8| {
        let ends = [from, to].map(|(x, y)| Point2::new(x, y));
        CityEdit::AddStreet(NewStreet { level, ..NewStreet::local(ends) })
    };
    // From one street to the other, over the one between.
    let bridge = street((0.0, 150.0), (600.0, 150.0), 1);
    let mut undos = vec![editor.apply(&bridge).expect("there is room to rise")];
    let deck = |editor: &CityEditor| {
        let (road, found) =
            (0..).zip(&editor.city().network.roads).find(|(_, road)| road.level == 1).expect("it stands");
        let at = |x: f64| {
            let near = polyline::closest(&found.centerline, &Point2::new(x, 150.0)).expect("it has a course");
            editor.city().network.height(RoadId(road), near.station)
        };
        [at(300.0), at(150.0), at(1.0)]
    };
    let [over, beside, end] = deck(&editor);
    assert!(over >= HEADROOM + DECK - 1e-6 && beside < 1.0 && end < 0.2, "{over} {beside} {end}");
    assert_eq!(editor.city().network.intersections.len(), before.network.intersections.len() + 2);
    assert_like_the_whole(editor.city(), "a bridge");
    // A street below it where it is still low: it rises there too.
    undos.push(editor.apply(&street((150.0, 0.0), (150.0, 300.0), 0)).expect("the bridge can rise"));
    let [over, beside, _] = deck(&editor);
    assert!(over >= HEADROOM + DECK - 1e-6 && beside >= HEADROOM + DECK - 1e-6, "{over} {beside}");
    assert_like_the_whole(editor.city(), "a street below a bridge");
    for undo in undos.into_iter().rev() {
        editor.put(undo).expect("an undo fits");
    }
    assert!(*editor.city() == before);
}
