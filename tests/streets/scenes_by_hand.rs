//! Scenes that are written by hand, with the city generator behind them: the sample has what it says, and the page about them tells
//! what is so.

use std::path::{Path, PathBuf};

use simworld_agents::scenes::file::{Colour, Loaded, SceneFile, SceneFileError};
use simworld_core::asset::Catalogue;
use simworld_core::clock::Clock;
use simworld_core::geometry::{Point2, Point3, yaw_of};
use simworld_core::hash::StateHash;
use simworld_core::id::EntityId;
use simworld_core::net::{RoadClass, Sidewalk, polyline};
use simworld_core::scene::{EntityKind, EntityRef, Scene, World};
use simworld_core::seed::Seed;
use simworld_core::value::Value;
use simworld_examples::places::Generated;
use simworld_examples::served::{CitySettings, Session, replay, simulation};
use simworld_examples::written::Written;
use simworld_examples::{chat, view};
use simworld_traffic::TrafficConfig;

const PAGE: &str = include_str!("../../docs/scenes.md");

fn load(scene: &SceneFile) -> Result<Loaded, SceneFileError> {
    scene.load(&Catalogue::library(), &mut Generated)
}

fn sample_path() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/assets/scenes/harbour.scene.toml")
}

fn sample() -> SceneFile {
    SceneFile::read(&sample_path()).unwrap_or_else(|error| panic!("{error}"))
}

/// The things of the rows of an asset.
fn of<'a>(scene: &SceneFile, loaded: &'a Loaded, asset: &str) -> Vec<EntityRef<'a>> {
    let rows = scene.things.iter().zip(&loaded.things).filter(|(thing, _)| thing.asset == asset);
    rows.flat_map(|(_, ids)| ids).map(|id| loaded.world.entity(*id).expect("it was put there")).collect()
}

#[test]
fn the_sample_has_what_it_says() {
    let scene = sample();
    let loaded = load(&scene).unwrap_or_else(|error| panic!("{error}"));
    assert!(loaded.problems.is_empty(), "{}", loaded.problems);
    let of = |asset| of(&scene, &loaded, asset);

    let roads = loaded.world.roads().expect("there are streets");
    let named = |name: &str| {
        let is_of = |index: &u32| roads.names[*index as usize] == name;
        roads.roads.iter().filter(|road| road.name.as_ref().is_some_and(is_of)).count()
    };
    assert_eq!((named("Quay Road"), named("Chapel Lane")), (2, 1));
    assert!(roads.roads.iter().all(|road| road.class == RoadClass::Local && road.width == 7.0));
    for kind in [EntityKind::Ground, EntityKind::Road, EntityKind::Sidewalk] {
        assert!(loaded.world.iter().any(|entity| entity.kind == kind), "{kind}: streets are seen");
    }

    let museum = of("museum")[0];
    assert_eq!(
        (museum.planar(), museum.info.name.as_deref()),
        (Point2::new(-42.0, 26.0), Some("Maritime Museum"))
    );
    assert!(museum.access().y < 13.5, "its entrance is to the south: {}", museum.access());
    let lamps = of("street_lamp");
    assert_eq!((lamps.len(), lamps[7].planar()), (8, Point2::new(70.0, 5.8)));
    assert!(lamps.iter().all(|lamp| (yaw_of(lamp.pose)).abs() < 1e-12));
    let heights = ["long_table", "wooden_crate", "parcel"].map(|asset| of(asset)[0].position());
    let above = |height: f64| Point3::new(40.0, 24.0, height);
    assert_eq!(heights[..2], [above(0.0), above(0.75)]);
    assert!((heights[2] - above(0.75 + 0.42)).norm() < 1e-12, "{}", heights[2]);
    assert_eq!(of("tree")[0].info.shape.size().z, 7.0 * 1.2);

    let bench = loaded.world.entity(loaded.said[0].made[0]).expect("it was made");
    assert_eq!(bench.kind, EntityKind::Bench);
    assert!((bench.planar() - of("fountain")[0].planar()).norm() < 7.0, "it stands next to the fountain");
    assert_eq!(of("anchor")[0].info.color, Colour::of("white").map(Colour::linear));
    let sky = loaded.world.environment();
    assert_eq!(sky.weather.cloud_cover, 0.8);
    assert!((0.0..0.4).contains(&sky.sun.elevation), "half past five on a September day in the north");
}

#[test]
fn the_sample_is_the_same_world_each_time_also_when_it_was_written_again() {
    let scene = sample();
    let again = SceneFile::parse(&scene.to_toml().expect("it can be written")).expect("it can be read");
    assert_eq!(again, scene);
    let digests = [&scene, &scene, &again].map(|scene| load(scene).expect("it is sound").world.digest());
    assert!(digests.iter().all(|digest| *digest == digests[0]));
}

/// Who drives and walks in the sample beside what is written there.
fn few() -> TrafficConfig {
    TrafficConfig { vehicles: 4, pedestrians: 4, ..TrafficConfig::default() }
}

/// Everything that was written stands in a world where it was put, but for what moves.
fn assert_stands(world: &World, loaded: &Loaded) {
    let same = |id: &EntityId| {
        let (was, is) = (loaded.world.entity(*id).expect("it was put there"), world.entity(*id));
        is.is_some_and(|is| is.kind == was.kind && (was.kind.is_mobile() || is.pose == was.pose))
    };
    let gone: Vec<&EntityId> = loaded.things.iter().flatten().filter(|id| !same(id)).collect();
    assert!(gone.is_empty() && loaded.things.len() > 5, "{gone:?}");
}

#[test]
fn the_sample_is_talked_in_looked_at_and_served_as_it_is_loaded() {
    let loaded = load(&sample()).expect("it is sound");
    let written = Written::read(&sample_path(), Clock::default()).expect("it is sound");
    assert_eq!(written.loaded.world.digest(), loaded.world.digest());
    assert_eq!(written.loaded.said, loaded.said);

    let stage = chat::Stage::in_world(written.loaded.world, &few(), Seed(1)).expect("there is a sidewalk");
    assert_stands(stage.world(), &loaded);
    let network = stage.world().roads().expect("there are streets").clone();
    let here = stage.here();
    let on_it =
        |walk: &Sidewalk| polyline::closest(&walk.path, &here).is_some_and(|near| near.distance < 1.5);
    assert!(network.sidewalks.iter().any(on_it), "{here} is on no sidewalk");

    let stage = view::Stage::of_scene(&sample_path(), 4, 4, Seed(1)).expect("it is sound");
    assert_stands(stage.world(), &loaded);
    assert!(stage.world().len() > loaded.world.len(), "there is traffic on its streets");

    let scene = Some(sample().to_toml().expect("it can be written"));
    let settings =
        CitySettings { seed: 1, roads: 40, scene, vehicles: 4, pedestrians: 4, step_microseconds: 50_000 };
    let mut served = simulation(&settings).expect("it is sound");
    assert_stands(served.world(), &loaded);
    served.set_trail_interval(1);
    for _ in 0..20 {
        served.step().expect("nothing fails");
    }
    let recording = served.recording().clone();
    assert_eq!(replay(&Session { settings, recording }).expect("it goes the same way"), 20);
}

#[test]
fn a_scene_without_streets_is_looked_at_and_served_and_nobody_can_stand_on_its_sidewalks() {
    let text = "version = 1\n[[thing]]\nasset = \"table\"\nname = \"desk\"\nat = [4, -2]";
    let written = Written::of(SceneFile::parse(text).unwrap(), Clock::default()).expect("it is sound");
    let refused = chat::Stage::in_world(written.loaded.world, &few(), Seed(1)).map(|_| ()).unwrap_err();
    assert!(matches!(refused, chat::StageError::NoPlace), "{refused}");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("desk.scene.toml");
    std::fs::write(&path, text).unwrap();
    let mut stage = view::Stage::of_scene(&path, 4, 4, Seed(1)).expect("it is sound");
    let before = stage.world().len();
    stage.step().expect("nobody moves");
    assert_eq!((before, stage.world().len()), (2, 2), "the ground and the table");
    let scene = Some(text.to_owned());
    let settings =
        CitySettings { seed: 1, roads: 40, scene, vehicles: 4, pedestrians: 4, step_microseconds: 50_000 };
    simulation(&settings).expect("it is sound").step().expect("nobody moves");
}

#[test]
fn a_scene_that_cannot_be_is_refused_alike_by_all() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("wrong.scene.toml");
    std::fs::write(&path, "version = 1\n\n[[thing]]\nasset = \"bnch\"\nat = [0, 0]").unwrap();
    let told = load(&SceneFile::read(&path).unwrap()).map(|_| ()).unwrap_err().to_string();
    assert!(told.contains("wrong.scene.toml:3") && told.contains("bench"), "{told}");
    let written = Written::read(&path, Clock::default()).map(|_| ()).unwrap_err().to_string();
    let viewed = view::Stage::of_scene(&path, 1, 1, Seed(1)).map(|_| ()).unwrap_err().to_string();
    assert_eq!((written.as_str(), viewed.as_str()), (told.as_str(), told.as_str()));
    let missing = folder.path().join("none.scene.toml");
    let written = Written::read(&missing, Clock::default()).map(|_| ()).unwrap_err().to_string();
    assert!(written.contains("none.scene.toml"), "{written}");
}

/// The blocks of TOML of the page.
fn blocks() -> Vec<&'static str> {
    let blocks = PAGE.split("```toml\n").skip(1);
    blocks.map(|block| block.split("```").next().unwrap_or_default()).collect()
}

#[test]
fn every_file_of_the_page_loads_with_nothing_wrong() {
    let blocks = blocks();
    assert!(blocks.len() >= 3, "the page shows several");
    for block in blocks {
        let scene = SceneFile::parse(block).unwrap_or_else(|error| panic!("{block}\n{error}"));
        let loaded = load(&scene).unwrap_or_else(|error| panic!("{block}\n{error}"));
        assert!(loaded.problems.is_empty(), "{block}\n{}", loaded.problems);
        assert_eq!(loaded.said.len(), scene.says.len());
        if let Some(place) = &scene.place {
            let houses = loaded.world.iter().filter(|entity| entity.info.access.is_some());
            assert!(houses.count() >= place.buildings.count.unwrap_or(0) as usize, "{block}");
            let is_square = |entity: &EntityRef<'_>| {
                entity.info.attributes.get("area") == Some(&Value::Text("square".to_owned()))
            };
            assert!(loaded.world.iter().any(|entity| is_square(&entity)), "{block}");
            assert!(loaded.world.environment().weather.rain > 0.0, "it was said to rain");
        }
    }
}

/// The keys of a table, as the reader lists them when one is unknown.
fn keys(table: &str) -> Vec<String> {
    let error =
        SceneFile::parse(&format!("version = 1\n{table}\nzzz = 1")).expect_err("that is no key").to_string();
    let (_, known) = error.split_once("expected ").unwrap_or_else(|| panic!("{error}"));
    known.split('`').skip(1).step_by(2).map(str::to_owned).collect()
}

#[test]
fn every_key_is_on_the_page_in_the_section_of_its_table() {
    for (heading, table) in [
        ("## The file", ""),
        ("### `[ground]`", "[ground]"),
        ("### `[environment]`", "[environment]"),
        ("### `[[street]]`", "[[street]]\npoints = []"),
        ("### `[[thing]]`", "[[thing]]\nasset = \"cone\""),
        ("### `[[say]]`", "[[say]]\nwords = \"make it rain\""),
    ] {
        let section = PAGE.split_once(&format!("\n{heading}\n")).unwrap_or_else(|| panic!("{heading}")).1;
        let section = section.split("\n#").next().unwrap_or_default();
        let keys = keys(table);
        assert!(!keys.is_empty(), "{heading}");
        for key in keys {
            let told = [format!("`{key}`"), format!("`[{key}]`"), format!("`[[{key}]]`")];
            assert!(told.iter().any(|told| section.contains(told.as_str())), "{heading}: {key}");
        }
    }
}
