//! Assets by words: what people call things is found first, and nothing is taken for what it is not.

use std::collections::BTreeMap;

use proptest::prelude::*;
use simworld_agents::editing::{Difference, EditError, SceneEditor, faults};
use simworld_agents::retrieval::{AssetIndex, Choice, EmbedError, Embedder, Embeddings, Matched};
use simworld_core::asset::{Asset, Catalogue, Season};
use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::scene::{EntityDesc, EntityKind, Place, Scene, Shape, World};
use simworld_core::seed::Seed;

/// `tests/retrieval/queries.toml`, by family: what is said, and the assets that may come first.
fn queries() -> BTreeMap<String, BTreeMap<String, String>> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/retrieval/queries.toml");
    let text = std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{path}: {error}"));
    toml::from_str(&text).unwrap_or_else(|error| panic!("{path}: {error}"))
}

#[test]
fn the_asset_that_is_meant_comes_first() {
    let catalogue = Catalogue::library();
    let index = AssetIndex::of(&catalogue);
    let (mut asked, mut wrong) = (0, Vec::new());
    for (family, queries) in queries() {
        for (words, gold) in queries {
            let hits = index.retrieve(&words, 3);
            let names: Vec<&str> = hits.iter().map(|hit| hit.name.as_str()).collect();
            for name in gold.split('|').filter(|name| !name.is_empty()) {
                assert!(catalogue.find(name).is_some(), "{family}: there is no {name}");
            }
            let is_right = match names.first() {
                Some(first) => gold.split('|').any(|name| name == *first),
                None => gold.is_empty(),
            };
            // Of what is not there something may be near, and must not be taken.
            let is_right = is_right || gold.is_empty() && matches!(index.choose(&words), Choice::Unsure(_));
            asked += 1;
            if !is_right {
                wrong.push(format!("{family}: {words:?} wants {gold}, got {names:?}"));
            }
        }
    }
    assert!(asked >= 80, "{asked} queries");
    assert!(wrong.is_empty(), "{} of {asked} are wrong:\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
fn every_asset_is_found_by_its_name() {
    let catalogue = Catalogue::library();
    let index = AssetIndex::of(&catalogue);
    for (id, asset) in catalogue.iter() {
        let hits = index.retrieve(&asset.name.replace('_', " "), 1);
        assert_eq!(hits.first().map(|hit| hit.asset), Some(id), "{}: {hits:?}", asset.name);
    }
}

#[test]
fn a_hit_says_why() {
    let index = AssetIndex::of(&Catalogue::library());
    let hits = index.retrieve("wooden sofas", 2);
    assert_eq!(hits[0].name, "couch");
    assert_eq!(hits[0].because, [("couch".to_owned(), Matched::Name)]);
    assert!(!hits[0].is_whole, "it is not wooden");
    let Choice::Sure(hit) = index.choose("a settee") else { panic!("a settee is a couch") };
    assert!(hit.is_whole && hit.name == "couch");
}

#[test]
fn of_equals_the_first_comes_first_and_nothing_is_sure() {
    let prop =
        |name: &str| Asset::new(name, EntityKind::Prop, Shape::cuboid(1.0, 1.0, 1.0)).tagged(["gizmo"]);
    let mut catalogue = Catalogue::new();
    for name in ["zeta", "alpha", "beta"] {
        catalogue.add(prop(name)).unwrap();
    }
    let index = AssetIndex::of(&catalogue);
    let hits = index.retrieve("gizmo", 3);
    let names: Vec<&str> = hits.iter().map(|hit| hit.name.as_str()).collect();
    assert_eq!(names, ["zeta", "alpha", "beta"]);
    assert_eq!(index.retrieve("gizmo", 2), hits[..2]);
    assert!(matches!(index.choose("gizmo"), Choice::Unsure(hits) if hits.len() == 3));
    assert!(matches!(index.choose("alpha gizmo"), Choice::Sure(hit) if hit.name == "alpha"));
    assert!(
        index.retrieve("gizmo", 0).is_empty()
            && AssetIndex::of(&Catalogue::new()).retrieve("gizmo", 3).is_empty()
    );
}

/// Knows two meanings: what swims, and what flies.
struct TwoMeanings;

impl Embedder for TwoMeanings {
    fn embed(&mut self, text: &str) -> Result<Vec<f32>, EmbedError> {
        let has = |words: &[&str]| f32::from(u8::from(words.iter().any(|word| text.contains(word))));
        if text.contains("unspeakable") {
            return Err(EmbedError::Failed {
                text: text.to_owned(),
                why: "it has no words for it".to_owned(),
            });
        }
        if text.contains("flat") {
            return Ok(vec![1.0]);
        }
        Ok(vec![has(&["boat", "vessel"]), has(&["airport", "plane"]), 0.01])
    }
}

#[test]
fn meaning_finds_what_words_do_not() {
    let catalogue = Catalogue::library();
    let index = AssetIndex::of(&catalogue);
    assert!(index.retrieve("vessel", 3).is_empty());
    let embeddings = Embeddings::of(&catalogue, &mut TwoMeanings).unwrap_err();
    assert!(
        matches!(embeddings, EmbedError::Vector { .. }),
        "flats have a vector of another length: {embeddings}"
    );
    let mut boats = Catalogue::new();
    for name in ["bench", "rowing_boat", "taxi", "lighthouse"] {
        boats.add(catalogue.get(catalogue.find(name).unwrap()).unwrap().clone()).unwrap();
    }
    let index = AssetIndex::of(&boats);
    let embeddings = Embeddings::of(&boats, &mut TwoMeanings).unwrap();
    let hits = index.retrieve_with("vessel", 2, &embeddings, &mut TwoMeanings).unwrap();
    assert_eq!((hits[0].name.as_str(), hits[0].because[0].1), ("rowing_boat", Matched::Meaning));
    let hits = index.retrieve_with("boat", 2, &embeddings, &mut TwoMeanings).unwrap();
    assert_eq!((hits[0].name.as_str(), hits[0].because[0].1), ("rowing_boat", Matched::Name));
    assert!(hits[0].score > hits[1].score * 1.5, "two rankings agree");
    assert!(index.retrieve_with("unspeakable", 2, &embeddings, &mut TwoMeanings).is_err());
}

/// A museum, a hospital far from it and a bench.
fn town() -> World {
    let mut world = World::new();
    let house = |x: f64, place| {
        EntityDesc::new(
            EntityKind::Building,
            pose_facing(Point3::new(x, 0.0, 0.0), 0.0),
            Shape::cuboid(14.0, 20.0, 9.0),
        )
        .used_as(place)
    };
    for (x, place) in [(0.0, Place::Museum), (120.0, Place::Hospital)] {
        world.spawn(house(x, place)).unwrap();
    }
    let pose = pose_facing(Point3::new(30.0, 30.0, 0.0), 0.0);
    world.spawn(EntityDesc::new(EntityKind::Bench, pose, Shape::cuboid(0.6, 1.8, 0.85))).unwrap();
    world
}

#[test]
fn what_is_called_otherwise_is_made() {
    for (words, name) in [
        ("add a sofa next to the bench", "couch"),
        ("put two settees near the bench", "couch"),
        ("add a fire truck near the museum", "fire_engine"),
        ("add a cash dispenser next to the museum", "cash_machine"),
        ("place a porta potty behind the hospital", "portable_toilet"),
        ("add a hot dog stand near the bench", "food_cart"),
        ("add a small cafe next to the museum", "cafe"),
        ("add a wooden table next to the bench", "table"),
    ] {
        let mut world = town();
        let before = world.clone();
        let done = SceneEditor::new(Seed(3))
            .say(words, &mut world)
            .unwrap_or_else(|error| panic!("{words}: {error}"));
        for made in &done.made {
            let entity = world.entity(*made).unwrap();
            let asset = world.assets().and_then(|assets| assets.get(entity.info.asset?)).unwrap();
            assert_eq!(asset.name, name, "{words}");
            assert_eq!(entity.material(&world), asset.material, "{words}");
            assert_eq!(faults(&world, *made), [], "{words}");
        }
        let changed = Difference::between(&before, &world);
        assert_eq!((changed.added, changed.moved.len(), changed.altered.len()), (done.made, 0, 0), "{words}");
    }
}

#[test]
fn a_building_has_a_door_that_one_can_reach() {
    let mut world = town();
    let done = SceneEditor::new(Seed(3)).say("add a bakery next to the museum", &mut world).unwrap();
    let bakery = world.entity(done.made[0]).unwrap();
    let door = bakery.access_point().unwrap();
    let gap = bakery.info.shape.planar_distance(bakery.pose, &door.xy());
    assert!((gap - 0.5).abs() < 1e-6, "the door is {gap} m before the house");
    let near = world.nearest(door.xy(), 3.0, &|other| {
        other.id != bakery.id && other.info.shape.planar_distance(other.pose, &door.xy()) < 0.8
    });
    assert!(near.is_none(), "somebody built before the door");
    assert_eq!(bakery.info.place, Some(Place::Store));
}

#[test]
fn what_is_not_sure_is_asked_and_changes_nothing() {
    for (words, near) in [
        ("add a dragon next to the bench", "nothing in it"),
        ("add a ball near the bench", "basketball"),
        ("add a monument near the museum", "obelisk"),
        ("add a submarine behind the museum", "nothing in it"),
    ] {
        let mut world = town();
        let before = world.clone();
        let error = SceneEditor::new(Seed(3)).say(words, &mut world).unwrap_err();
        assert!(matches!(error, EditError::UnknownThing { .. }), "{words}: {error}");
        assert!(error.to_string().contains(near), "{words}: {error}");
        assert!(Difference::between(&before, &world).is_empty(), "{words}");
    }
}

#[test]
fn plants_come_in_the_season_that_is_asked_for() {
    let library = Catalogue::library();
    let maple = library.get(library.find("maple").unwrap()).unwrap();
    for (words, season) in [
        ("add an autumn maple near the bench", Season::Autumn),
        ("add a winter maple near the bench", Season::Winter),
    ] {
        let mut world = town();
        let done = SceneEditor::new(Seed(3))
            .say(words, &mut world)
            .unwrap_or_else(|error| panic!("{words}: {error}"));
        assert_eq!(world.entity(done.made[0]).unwrap().info.color, maple.color_in(season), "{words}");
    }
}

/// A season is one of the whole scene; what falls and which hour it is stays as it was.
#[test]
fn a_scene_turns_to_the_season_that_is_asked_for() {
    for (words, season) in [
        ("make it autumn", Season::Autumn),
        ("make it winter", Season::Winter),
        ("make it a spring morning", Season::Spring),
        ("make it summer", Season::Summer),
    ] {
        let mut world = town();
        let before = *world.environment();
        SceneEditor::new(Seed(3)).say(words, &mut world).unwrap_or_else(|error| panic!("{words}: {error}"));
        let now = world.environment();
        assert_eq!((before.season, now.season), (None, Some(season)), "{words}");
        assert_eq!(
            (now.weather.rain, now.weather.snow),
            (before.weather.rain, before.weather.snow),
            "{words}"
        );
    }
}

#[test]
fn another_asset_of_the_name_is_kept_apart() {
    let mut world = town();
    let own = Asset::new("couch", EntityKind::Bench, Shape::cuboid(2.0, 2.0, 2.0));
    let id = world.add_asset(own).unwrap();
    let mut editor = SceneEditor::new(Seed(3));
    let first = editor.say("add a couch next to the bench", &mut world).unwrap().made[0];
    let second = editor.say("add a couch near the museum", &mut world).unwrap().made[0];
    let made_from = |thing| world.entity(thing).unwrap().info.asset.unwrap();
    assert_ne!(made_from(first), id);
    assert_eq!(made_from(first), made_from(second), "one more asset, not two");
    let asset = world.assets().unwrap().get(made_from(first)).unwrap();
    assert!(asset.name.starts_with("couch_") && asset.collider == world.entity(first).unwrap().info.shape);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]
    #[test]
    fn any_words_are_answered_and_always_the_same(words in "\\PC{0,60}", k in 0usize..20) {
        let mut catalogue = Catalogue::standard();
        let index = AssetIndex::of(&catalogue);
        let hits = index.retrieve(&words, k);
        prop_assert!(hits.len() <= k);
        prop_assert!(hits.windows(2).all(|pair| pair[0].score >= pair[1].score));
        prop_assert_eq!(&hits, &AssetIndex::of(&catalogue).retrieve(&words, k));
        // What is added and shares no word changes no order.
        catalogue.add(Asset::new("qqqq", EntityKind::Door, Shape::cuboid(1.0, 1.0, 1.0))).unwrap();
        let names = |hits: Vec<simworld_agents::retrieval::Hit>| hits.into_iter().map(|hit| hit.name).collect::<Vec<_>>();
        let after = names(AssetIndex::of(&catalogue).retrieve(&words, 40));
        prop_assert_eq!(names(index.retrieve(&words, 40)).len(), after.iter().filter(|name| *name != "qqqq").count());
    }
}
