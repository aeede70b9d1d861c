//! Places made from a spec: what was counted is so, streets are as wide as they were asked for, and squares lie open.

use std::collections::BTreeMap;

use simworld_citygen::settlement::{Settlement, SettlementError};
use simworld_core::geometry::{Aabb, Point2};
use simworld_core::scene::{EntityKind, Place, Relation, Scene, World};
use simworld_core::seed::Seed;
use simworld_core::spec::{Amount, Height, Pattern, SceneKind, SceneSpec, Water, Width};
use std::ops::ControlFlow;

fn spec(count: u32) -> SceneSpec {
    let mut spec = SceneSpec::default();
    spec.buildings.count = Some(count);
    spec
}

fn mean_width(place: &Settlement) -> f64 {
    let roads = &place.city.network.roads;
    roads.iter().map(|road| road.width).sum::<f64>() / roads.len() as f64
}

#[test]
fn fifty_buildings_are_fifty_and_narrow_streets_are_narrow() {
    let usual = Settlement::build(&spec(50), Seed(3)).unwrap();
    for (count, seed) in [(1, 1), (12, 2), (50, 3), (137, 4)] {
        let mut narrow = spec(count);
        narrow.streets.width = Width::Narrow;
        let place = Settlement::build(&narrow, Seed(seed)).unwrap();
        assert_eq!(place.city.buildings.len(), count as usize);
        assert!(
            mean_width(&place) < 5.5 && mean_width(&place) < mean_width(&usual) - 2.0,
            "{}",
            mean_width(&place)
        );
        assert_eq!(place, Settlement::build(&narrow, Seed(seed)).unwrap(), "the same bits");
    }
    let mut wide = spec(50);
    wide.streets.width = Width::Wide;
    assert!(mean_width(&Settlement::build(&wide, Seed(3)).unwrap()) > mean_width(&usual) + 0.4);
}

#[test]
fn patterns_trees_and_heights_are_as_asked() {
    let crossroads = |pattern| {
        let mut spec = spec(120);
        spec.streets.pattern = pattern;
        let city = Settlement::build(&spec, Seed(5)).unwrap().city;
        let four = city.network.intersections.iter().filter(|place| place.roads.len() == 4).count();
        four as f64 / city.network.intersections.len() as f64
    };
    assert!(crossroads(Pattern::Grid) > crossroads(Pattern::Winding) + 0.1);

    let mut bare = spec(40);
    bare.streets.trees = Amount::None;
    bare.streets.parked = Amount::None;
    let bare = Settlement::build(&bare, Seed(5)).unwrap();
    let count =
        |place: &Settlement, kind| place.city.elements.iter().filter(|element| element.kind == kind).count();
    assert_eq!((count(&bare, EntityKind::Tree), count(&bare, EntityKind::Car)), (0, 0));
    let usual = Settlement::build(&spec(40), Seed(5)).unwrap();
    assert!(count(&usual, EntityKind::Tree) > 5 && count(&usual, EntityKind::Car) > 5);

    let storeys = |height| {
        let mut spec = spec(40);
        spec.buildings.height = height;
        let place = Settlement::build(&spec, Seed(5)).unwrap();
        place.city.buildings.iter().map(|building| building.storeys).collect::<Vec<_>>()
    };
    assert!(storeys(Height::Low).iter().all(|storeys| *storeys <= 2));
    assert!(storeys(Height::Usual).iter().all(|storeys| *storeys <= 4), "forty houses are no city of towers");
    assert!(storeys(Height::High).iter().filter(|storeys| **storeys >= 6).count() > 5);
}

#[test]
fn what_the_place_is_to_have_it_has() {
    let mut asked = spec(60);
    asked.features.places = BTreeMap::from([(Place::Museum, 2), (Place::Hospital, 1), (Place::School, 0)]);
    asked.features.squares = vec!["Market Square".to_owned(), "Old Square".to_owned()];
    asked.features.parks = vec!["Rose Park".to_owned()];
    asked.features.waters = vec![Water::Harbour, Water::River];
    asked.environment.weather.rain = 2.0;
    let place = Settlement::build(&asked, Seed(11)).unwrap();
    let have = |used_as| place.city.buildings.iter().filter(|building| building.place == used_as).count();
    assert_eq!((have(Place::Museum), have(Place::Hospital), have(Place::School)), (2, 1, 0));
    assert_eq!(place.city.buildings.len(), 60);

    let mut world = World::new();
    place.populate(&mut world).unwrap();
    assert_eq!(world.environment().weather.rain, 2.0);
    for (name, use_of_it) in [
        ("Market Square", "square"),
        ("Old Square", "square"),
        ("Rose Park", "park"),
        ("Harbour", "harbour"),
        ("River", "river"),
    ] {
        let is_it = |entity: &simworld_core::scene::EntityRef<'_>| entity.info.name.as_deref() == Some(name);
        let area = world.iter().find(is_it).unwrap_or_else(|| panic!("no {name}"));
        assert_eq!(area.info.attributes.get("area"), Some(&use_of_it.into()));
        let mut on_it = Vec::new();
        let _ = world.visit(
            &Aabb::column_around(Point2::new(area.planar().x, area.planar().y), 200.0),
            &mut |entity| {
                let solid =
                    entity.kind == EntityKind::Building || (use_of_it == "square" && entity.kind.is_solid());
                if solid && entity.id != area.id && entity.obb().footprints_overlap(&area.obb()) {
                    on_it.push(entity.kind);
                }
                let street = matches!(entity.kind, EntityKind::Road | EntityKind::Sidewalk);
                assert!(!(street && entity.obb().footprints_overlap(&area.obb())), "{name} lies on a street");
                ControlFlow::Continue(())
            },
        );
        assert_eq!(on_it, [], "{name} lies open");
        assert!(!Relation::Inside.holds(&area, &area));
    }
}

#[test]
fn what_cannot_be_is_said() {
    for kind in [SceneKind::Countryside, SceneKind::Wilderness, SceneKind::Island] {
        let error = Settlement::build(&SceneSpec { kind, ..SceneSpec::default() }, Seed(1)).unwrap_err();
        assert!(
            matches!(error, SettlementError::Kind { .. }) && error.to_string().contains(kind.as_str()),
            "{error}"
        );
    }
    let mut crowded = spec(5);
    crowded.streets.count = Some(2);
    crowded.features.squares = (0..16).map(|number| format!("Square {number}")).collect();
    crowded.features.parks = (0..16).map(|number| format!("Park {number}")).collect();
    assert!(matches!(Settlement::build(&crowded, Seed(1)), Err(SettlementError::NoGround { .. })));
    assert!(matches!(Settlement::build(&spec(0), Seed(1)), Err(SettlementError::Spec(_))));
}
