//! Scenes that are written by hand, with the city generator behind them: the sample has what it says, and the page about them tells
//! what is so.

use std::path::Path;

use simworld_agents::scenes::file::{Colour, Loaded, SceneFile, SceneFileError};
use simworld_core::asset::Catalogue;
use simworld_core::geometry::{Point2, Point3, yaw_of};
use simworld_core::hash::StateHash;
use simworld_core::net::RoadClass;
use simworld_core::scene::{EntityKind, EntityRef, Scene};
use simworld_core::value::Value;
use simworld_examples::places::Generated;

const PAGE: &str = include_str!("../../docs/scenes.md");

fn load(scene: &SceneFile) -> Result<Loaded, SceneFileError> {
    scene.load(&Catalogue::library(), &mut Generated)
}

fn sample() -> SceneFile {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/assets/scenes/harbour.scene.toml");
    SceneFile::read(&path).unwrap_or_else(|error| panic!("{error}"))
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
