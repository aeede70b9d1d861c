//! Places made from a spec: what was counted is so, streets are as wide as they were asked for, and squares lie open.

use std::collections::BTreeMap;

use simworld_citygen::settlement::{Settlement, SettlementError, SettlementRemark};
use simworld_core::geometry::{Aabb, Compass, Point2};
use simworld_core::scene::{EntityKind, Place, Relation, Scene, World};
use simworld_core::seed::Seed;
use simworld_core::spec::{
    Amount, DistrictKind, DistrictWish, Height, Pattern, SceneKind, SceneSpec, SiteWish, Water, Whereabouts,
    Width,
};
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

fn district(kind: DistrictKind, at: Whereabouts) -> DistrictWish {
    DistrictWish { kind, at, by: None }
}

fn site(what: &str, at: Whereabouts, by: Option<&str>) -> SiteWish {
    SiteWish { what: what.to_owned(), at, by: by.map(str::to_owned) }
}

/// Where the houses of a place are: its middle and its farthest house, m.
fn extent(place: &Settlement) -> (Point2, f64) {
    let houses = &place.city.buildings;
    let sum =
        houses.iter().fold(simworld_core::geometry::Vector2::zeros(), |sum, one| sum + one.center.coords);
    let heart = Point2::from(sum / houses.len() as f64);
    let far = houses.iter().map(|one| (one.center - heart).norm()).fold(0.0, f64::max);
    (heart, far)
}

/// Of the houses in and out of a part of the place the share of some uses.
fn shares(place: &Settlement, is_in: impl Fn(Point2) -> bool, uses: &[Place]) -> [f64; 2] {
    [true, false].map(|inside| {
        let there: Vec<_> = place.city.buildings.iter().filter(|one| is_in(one.center) == inside).collect();
        assert!(there.len() > 12, "{} houses, inside {inside}", there.len());
        there.iter().filter(|one| uses.contains(&one.place)).count() as f64 / there.len() as f64
    })
}

/// "An old town in the middle, factories in the east, homes by the river, a business district in the north": what the houses are used
/// for says where one is.
#[test]
fn districts_are_seen_in_what_houses_are_used_for() {
    let mut asked = spec(320);
    asked.features.waters = vec![Water::River];
    asked.features.districts = vec![
        district(DistrictKind::OldTown, Whereabouts::Middle),
        district(DistrictKind::Industrial, Whereabouts::Towards(Compass::East)),
        DistrictWish {
            by: Some("river".to_owned()),
            ..district(DistrictKind::Residential, Whereabouts::Anywhere)
        },
        district(DistrictKind::Business, Whereabouts::Towards(Compass::North)),
    ];
    let mut sums = [[0.0; 2]; 3];
    let seeds = [3, 4, 5];
    for seed in seeds {
        let place = Settlement::build(&asked, Seed(seed)).unwrap();
        assert_eq!(place, Settlement::build(&asked, Seed(seed)).unwrap(), "the same bits");
        assert_eq!(place.city.buildings.len(), 320);
        let (heart, far) = extent(&place);
        let way = |at: Point2| (at - heart) / far;
        // Well inside of what was asked for: a direction, beyond the middle, and not yet at the river in the south.
        let east = |at: Point2| way(at).x > 0.45 && way(at).x > way(at).y.abs() * 1.3 && way(at).y > -0.4;
        let north = |at: Point2| way(at).y > 0.45 && way(at).y > way(at).x.abs() * 1.3;
        let river = |at: Point2| way(at).y < -0.5;
        for (sum, share) in sums.iter_mut().zip([
            shares(&place, east, &[Place::Factory]),
            shares(&place, north, &[Place::Office]),
            shares(&place, river, &[Place::Home]),
        ]) {
            *sum = [sum[0] + share[0], sum[1] + share[1]];
        }
    }
    let [factories, offices, homes] = sums.map(|sum| sum.map(|share| share / seeds.len() as f64));
    assert!(factories[0] > 0.2 && factories[0] > 3.0 * factories[1], "factories in the east: {factories:?}");
    assert!(offices[0] > 0.15 && offices[0] > 1.5 * offices[1], "offices in the north: {offices:?}");
    assert!(homes[0] > 0.5 && homes[0] > 1.25 * homes[1], "homes by the river: {homes:?}");
}

#[test]
fn landmarks_stand_where_they_were_asked_for() {
    let mut asked = spec(80);
    asked.title = Some("Port Blue".to_owned());
    asked.features.waters = vec![Water::Harbour];
    asked.features.places = BTreeMap::from([(Place::Hospital, 1), (Place::Museum, 2)]);
    asked.features.landmarks = BTreeMap::from([
        ("church".to_owned(), 2),
        ("cathedral".to_owned(), 1),
        ("lighthouse".to_owned(), 1),
        ("train_station".to_owned(), 1),
    ]);
    asked.features.squares = vec!["Market Square".to_owned()];
    asked.features.sites = vec![
        site("hospital", Whereabouts::Anywhere, Some("train_station")),
        site("museum", Whereabouts::Towards(Compass::North), None),
        site("museum", Whereabouts::Towards(Compass::South), None),
        site("lighthouse", Whereabouts::Anywhere, Some("harbour")),
        site("church", Whereabouts::Middle, None),
        site("Market Square", Whereabouts::Anywhere, Some("cathedral")),
    ];
    for seed in 0..3 {
        let place = Settlement::build(&asked, Seed(seed)).unwrap();
        assert_eq!(place, Settlement::build(&asked, Seed(seed)).unwrap(), "the same bits");
        assert_eq!(place.city.buildings.len(), 80, "landmarks are none of the houses that are counted");
        let names: Vec<&str> = place.landmarks.iter().map(|landmark| landmark.name.as_str()).collect();
        assert_eq!(names.len(), 5, "{names:?}");
        assert!(names.contains(&"Cathedral") && names.contains(&"Church 2"), "{names:?}");
        let is_told = |name: &str| {
            place.remarks.iter().any(|remark| match remark {
                SettlementRemark::Elsewhere { name: of, .. } | SettlementRemark::Apart { name: of, .. } => {
                    of == name
                }
                _ => false,
            })
        };
        let (heart, far) = extent(&place);
        let landmark = |name: &str| place.landmarks.iter().find(|one| one.name == name).unwrap();
        let of =
            |used_as| place.city.buildings.iter().filter(move |one| one.place == used_as).collect::<Vec<_>>();
        let [hospital] = of(Place::Hospital)[..] else { panic!("{seed}: one hospital") };
        let away = (hospital.center - landmark("Train station").middle).norm();
        assert!(away < 90.0 || is_told(hospital.name.as_deref().unwrap()), "{seed}: {away} m");
        assert_eq!(of(Place::Museum).len(), 2);
        let museums = of(Place::Museum);
        let told = museums.iter().any(|one| is_told(one.name.as_deref().unwrap_or_default()));
        let north = museums.iter().filter(|one| one.center.y > heart.y).count();
        assert!(told || north == 1, "{seed}: one in the north, one in the south");
        let light = landmark("Lighthouse").middle;
        assert!(is_told("Lighthouse") || light.y < heart.y, "{seed}: the harbour lies in the south");
        let church = (landmark("Church").middle - heart).norm();
        assert!(is_told("Church") || church < 0.6 * far, "{seed}: {church} of {far} m");
        let square = place.areas.iter().find(|area| area.name == "Market Square").unwrap();
        let apart = (square.middle - landmark("Cathedral").middle).norm();
        assert!(is_told("Market Square") || apart < 90.0, "{seed}: {apart} m");
        stand_free(&place, &format!("{seed}"));
    }
}

#[test]
fn what_no_block_holds_stands_outside_the_streets_and_is_told() {
    let mut told = 0;
    for (seed, water) in [(1, None), (2, Some(Water::Harbour)), (3, None)] {
        let mut asked = spec(40);
        asked.features.waters.extend(water);
        asked.features.landmarks = BTreeMap::from([("stadium".to_owned(), 1)]);
        let place = Settlement::build(&asked, Seed(seed)).unwrap();
        assert_eq!(place, Settlement::build(&asked, Seed(seed)).unwrap(), "the same bits");
        assert_eq!(place.city.buildings.len(), 40);
        let [stadium] = &place.landmarks[..] else { panic!("{:?}", place.landmarks) };
        assert_eq!((stadium.asset.as_str(), stadium.name.as_str()), ("stadium", "Stadium"));
        let outside = SettlementRemark::Outside { name: "Stadium".to_owned() };
        told += usize::from(place.remarks.contains(&outside));
        assert!(stadium.access.is_some(), "a street leads there");
        stand_free(&place, &format!("{seed}"));

        let mut world = World::new();
        let entities = place.populate(&mut world).unwrap();
        let built = world.entity(*entities.buildings.last().unwrap()).unwrap();
        let grounds: Vec<_> = world.iter().filter(|entity| entity.kind == EntityKind::Ground).collect();
        let water =
            |ground: &simworld_core::scene::EntityRef<'_>| ground.info.attributes.contains_key("area");
        for corner in built.obb().footprint() {
            let is_under = |ground: &simworld_core::scene::EntityRef<'_>| {
                ground.info.shape.planar_distance(ground.pose, &corner) < 1e-6
            };
            assert!(
                grounds.iter().any(|ground| !water(ground) && is_under(ground)),
                "{corner} has no ground"
            );
        }
        let wet = grounds.iter().filter(|ground| water(ground));
        assert!(wet.clone().all(|water| !water.obb().footprints_overlap(&built.obb())), "it stands in water");
        assert!(wet.count() >= asked.features.waters.len());
    }
    assert!(told > 0, "a block held it each time");
}

/// Whether every landmark stands on no street and in no house.
fn stand_free(place: &Settlement, told: &str) {
    let mut world = World::new();
    let entities = place.populate(&mut world).unwrap();
    let built = entities.buildings.iter().map(|id| world.entity(*id).unwrap());
    let boxes: Vec<_> = built.map(|entity| (entity.label().to_owned(), entity.obb())).collect();
    for (index, (name, one)) in boxes.iter().enumerate().skip(place.city.buildings.len()) {
        let others = boxes.iter().enumerate().filter(|(other, _)| *other != index);
        let on_it: Vec<_> = others.filter(|(_, (_, other))| other.footprints_overlap(one)).collect();
        assert!(on_it.is_empty(), "{told}: {name} overlaps {on_it:?}");
        let streets = world.iter().filter(|entity| entity.kind == EntityKind::Road);
        let crossed = streets.filter(|street| street.obb().footprints_overlap(one)).count();
        assert_eq!(crossed, 0, "{told}: {name} stands on a street");
    }
}

#[test]
fn what_cannot_be_is_said() {
    let mut strange = spec(20);
    strange.features.landmarks.insert("atlantis".to_owned(), 1);
    let error = Settlement::build(&strange, Seed(1)).unwrap_err();
    assert!(matches!(&error, SettlementError::Landmark { name } if name == "atlantis"), "{error}");
    let mut large = spec(30);
    large.features.landmarks.insert("cathedral".to_owned(), 1);
    let place = Settlement::build(&large, Seed(1)).unwrap();
    let small = place.landmarks.iter().find(|landmark| landmark.scale < 1.0);
    let told = |remark: &SettlementRemark| matches!(remark, SettlementRemark::Smaller { .. });
    assert_eq!(small.is_some(), place.remarks.iter().any(told), "{:?}", place.remarks);
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
