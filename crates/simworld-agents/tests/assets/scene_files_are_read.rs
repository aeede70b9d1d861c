//! Hand-written scenes: what they say is what is there, they come back from being written, and how their things stand is told.

use std::sync::Arc;

use simworld_agents::scenes::file::{
    Aside, At, Colour, Facing, Fault, Loaded, NoPlaces, Pair, PlaceError, PlaceMaker, Problem, Say,
    SceneFile, SceneFileError, Sky, StreetRow, Thing,
};
use simworld_core::asset::{Asset, Catalogue};
use simworld_core::environment::Environment;
use simworld_core::geometry::{Compass, Point2, Point3, pose_facing, yaw_of};
use simworld_core::ground::{Cover, Ground, GroundData};
use simworld_core::hash::StateHash;
use simworld_core::net::StreetPlan;
use simworld_core::scene::{EntityDesc, EntityKind, EntityRef, Scene, Shape, World};
use simworld_core::seed::Seed;
use simworld_core::spec::SceneSpec;

const SQUARE: &str = r#"version = 1
title = "Square"
seed = 11

[environment]
date = 2026-12-21
hour = 15.5
weather = "Snow"

[[street]]
name = "Quay Road"
points = [[-80, 0], [0, 0], [80, 0]]

[[street]]
points = [[0, 0], [0.0, 70.5]]
lanes = 2
sidewalk = 0

[[thing]]
asset = "wooden_crate"
name = "crate"
on = "desk"
scale = 0.5

[[thing]]
asset = "long_table"
name = "desk"
at = [20, 30]
facing = "north"
colour = "blue"

[[thing]]
asset = "cone"
name = "cone"
at = [-30, 20]
facing = -90
color = [0.1, 0.2, 0.3]
count = 3
step = [2.5, -1]

[[say]]
words = "add a bench next to the desk"
from = [20, 20]

[[say]]
words = "paint the crate green"
"#;

fn load(text: &str) -> Loaded {
    let scene = SceneFile::parse(text).unwrap_or_else(|error| panic!("{error}"));
    scene.load(&Catalogue::library(), &mut NoPlaces).unwrap_or_else(|error| panic!("{error}"))
}

fn thing(loaded: &Loaded, row: usize, rank: usize) -> EntityRef<'_> {
    loaded.world.entity(loaded.things[row][rank]).expect("it was put there")
}

/// A scene of rows of things on empty ground.
fn things(rows: &str) -> Loaded {
    load(&format!("version = 1\n{rows}"))
}

/// The one thing that is wrong.
fn only(loaded: &Loaded) -> &Problem {
    assert_eq!(loaded.problems.count(), 1, "{}", loaded.problems);
    &loaded.problems.list[0]
}

#[test]
fn what_is_written_is_there() {
    let loaded = load(SQUARE);
    assert!(loaded.problems.is_empty(), "{}", loaded.problems);
    let (crate_, desk) = (thing(&loaded, 0, 0), thing(&loaded, 1, 0));
    assert_eq!(desk.position(), Point3::new(20.0, 30.0, 0.0));
    assert!((yaw_of(desk.pose) - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
    assert_eq!(desk.info.name.as_deref(), Some("desk"));
    assert_eq!(desk.info.color, Colour::of("blue").map(Colour::linear));
    assert_eq!(
        crate_.position(),
        Point3::new(20.0, 30.0, desk.info.shape.size().z),
        "in the middle of its top"
    );
    assert_eq!(crate_.info.shape.size().x, 0.3, "half as large as the asset");
    assert!((crate_.info.mass.expect("it has one") - 18.0 / 8.0).abs() < 1e-12, "an eighth of its mass");
    for rank in 0..3 {
        let cone = thing(&loaded, 2, rank);
        let far = rank as f64;
        assert_eq!(cone.position(), Point3::new(-30.0 + 2.5 * far, 20.0 - far, 0.0));
        assert_eq!(cone.info.name, Some(format!("cone {}", rank + 1)));
        assert!((yaw_of(cone.pose) + std::f64::consts::FRAC_PI_2).abs() < 1e-12);
    }
    let roads = loaded.world.roads().expect("there are streets");
    assert_eq!((roads.roads.len(), &roads.names[..]), (3, &["Quay Road".to_owned()][..]));
    assert!(roads.roads.iter().any(|road| road.forward.len() == 2 && road.sidewalks == [None, None]));
    let environment = loaded.world.environment();
    assert!(environment.weather.snow > 0.0 && environment.sun.elevation < 0.2, "a winter's afternoon");
}

#[test]
fn what_is_said_is_done_in_order_and_can_be_taken_back() {
    let mut loaded = load(SQUARE);
    let bench = loaded.said[0].made[0];
    let there = loaded.world.entity(bench).expect("it was made");
    assert_eq!(there.kind, EntityKind::Bench);
    assert!((there.planar() - Point2::new(20.0, 30.0)).norm() < 8.0, "next to the desk");
    assert_eq!(thing(&loaded, 0, 0).info.color, Colour::of("green").map(Colour::linear));
    for _ in 0..2 {
        loaded.editor.undo(&mut loaded.world).expect("nothing else changed").expect("it was said");
    }
    assert!(loaded.world.entity(bench).is_none());
}

#[test]
fn the_same_file_is_the_same_world() {
    let digests = [load(SQUARE), load(SQUARE)].map(|loaded| loaded.world.digest());
    assert_eq!(digests[0], digests[1]);
    let other = load(&SQUARE.replace("at = [20, 30]", "at = [20, 30.01]"));
    assert_ne!(other.world.digest(), digests[0]);
}

#[test]
fn a_file_comes_back_from_being_written() {
    let scene = SceneFile::parse(SQUARE).unwrap();
    let lines: Vec<Option<usize>> = scene.things.iter().map(|thing| thing.line.0).collect();
    assert_eq!(lines, [Some(19), Some(25), Some(32)]);
    let again = SceneFile::parse(&scene.to_toml().unwrap()).unwrap();
    assert_eq!(again, scene);
    assert_eq!(toml::from_str::<SceneFile>(SQUARE).unwrap(), scene, "the reader adds lines and no more");
    let digest = |scene: &SceneFile| scene.load(&Catalogue::library(), &mut NoPlaces).unwrap().world.digest();
    assert_eq!(digest(&again), digest(&scene));

    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("square.scene.toml");
    scene.save(&path).unwrap();
    assert_eq!(SceneFile::read(&path).unwrap(), scene);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "nothing else is left there");
}

#[test]
fn what_a_program_puts_together_comes_back_too() {
    let mut spec = SceneSpec::default();
    spec.buildings.count = Some(20);
    spec.features.squares = vec!["Market \"Square\"".to_owned()];
    spec.features.places.insert(simworld_core::scene::Place::Museum, 1);
    let sky = Sky { exact: Some(Environment::default()), ..Sky::default() };
    let scene = SceneFile {
        title: Some("Ünïcode \\ and \"quotes\"".to_owned()),
        seed: u64::MAX,
        place: Some(spec),
        environment: Some(sky),
        streets: vec![StreetRow::new([Pair::new(0.1, 1e-7), Pair::new(-1.0 / 3.0, 90.0)])],
        things: vec![
            Thing {
                facing: Some(Facing::Compass(Compass::SouthWest)),
                ..Thing::new("bench", At::new(0.1, 0.2))
            },
            Thing {
                facing: Some(Facing::Degrees(1.0 / 3.0)),
                ..Thing::new("bench", At::new(5.0, 0.0).high(-0.7))
            },
            Thing { colour: Some(Colour::Linear([0.1, 0.25, 1.0])), ..Thing::on("parcel", "bench") },
            Thing {
                line: Aside(Some(7)),
                count: Some(2),
                step: Some(Pair::new(1.5, 0.0)),
                ..Thing::on("cup", "x")
            },
        ],
        says: vec![Say { from: Some(Pair::new(3.0, 4.0)), ..Say::new("make it 'rain'") }],
        ..SceneFile::default()
    };
    assert_eq!(SceneFile::parse(&scene.to_toml().unwrap()).unwrap(), scene);
}

#[test]
fn the_least_file_is_empty_ground() {
    let loaded = things("");
    let ground: Vec<EntityRef<'_>> = loaded.world.iter().collect();
    assert_eq!((ground.len(), ground[0].kind), (1, EntityKind::Ground));
    assert_eq!((ground[0].bounds.max, ground[0].info.shape.size().x), (Point3::new(50.0, 50.0, 0.0), 100.0));
    assert_eq!(*loaded.world.environment(), Environment::default());
}

#[test]
fn two_things_in_one_place_stand_there_and_are_told_of_with_both_names_and_how_deep() {
    let rows = "[[thing]]\nasset = \"table\"\nname = \"desk\"\nat = [0, 0]\n\
        [[thing]]\nasset = \"trash_bin\"\nname = \"bin\"\nat = [0.5, 0]\n";
    let loaded = things(rows);
    assert_eq!(thing(&loaded, 1, 0).position().x, 0.5, "what is written is law");
    let problem = only(&loaded);
    assert_eq!((problem.at.line, problem.at.row.as_str()), (Some(6), "[[thing]] 2 (trash_bin \"bin\")"));
    // A bin of 25 cm is 10 cm from the edge of the table.
    let Fault::Penetrates { other, depth } = &problem.fault else { panic!("{problem}") };
    assert_eq!(other, "[[thing]] 1 (table \"desk\") on line 2");
    assert!((depth - 0.15).abs() < 1e-12, "{depth}");
    assert_eq!(
        problem.to_string(),
        "scene:6: [[thing]] 2 (trash_bin \"bin\"): it shares space with [[thing]] 1 (table \"desk\") on line 2, 0.150 m \
         deep: move one of them by as much, or leave one out"
    );
    let refused = loaded.sound().expect_err("something is wrong").to_string();
    assert!(refused.contains("0.150 m deep"), "{refused}");
    assert!(things(&rows.replace("0.5", "0.66")).problems.is_empty(), "it stands beside the table");
}

#[test]
fn what_hangs_sinks_or_has_nothing_under_it_is_told_of() {
    let table = "[[thing]]\nasset = \"table\"\nname = \"desk\"\nat = [0, 0]\n";
    let tree = "[[thing]]\nasset = \"tree\"\nname = \"lime\"\nat = [9, 0]\n";
    for (row, told) in [
        ("at = [5, 5, 2]", "it hangs 2.000 m above the ground: leave out the third number of at"),
        ("at = [0, 0, 1.0]", "it hangs 0.250 m above [[thing]] 1 (table \"desk\") on line 2"),
        ("at = [5, 5, -0.5]", "it is sunk 0.500 m into the ground"),
        (
            "on = \"desk\"\nat = [0.6, 0]",
            "its middle is 0.200 m beside [[thing]] 1 (table \"desk\") on line 2",
        ),
        ("on = \"lime\"", "[[thing]] 2 (tree \"lime\") on line 6, on which it is to stand, has no level top"),
        ("at = [0, 300]", "no ground is below it: move it, or make the ground larger"),
    ] {
        let loaded = things(&format!("{table}{tree}[[thing]]\nasset = \"parcel\"\n{row}\n"));
        let problem = only(&loaded);
        assert_eq!((problem.at.line, problem.at.row.as_str()), (Some(10), "[[thing]] 3 (parcel)"));
        assert!(problem.to_string().contains(told), "{row}: {problem}");
    }
    let sound = format!("{table}{tree}[[thing]]\nasset = \"parcel\"\nat = [0.2, 0.1, 0.76]\n");
    assert!(things(&sound).problems.is_empty(), "a centimetre above the table is none");
}

#[test]
fn things_stand_on_things_that_stand_on_things_in_whatever_order_they_are_written() {
    let loaded = things(
        "[[thing]]\nasset = \"parcel\"\non = \"crate 2\"\n\
         [[thing]]\nasset = \"wooden_crate\"\nname = \"crate\"\non = \"desk\"\nat = [-0.35, 0]\ncount = 2\nstep = [0.7, 0]\n\
         [[thing]]\nasset = \"long_table\"\nname = \"desk\"\nat = [0, 0]\nfacing = \"north\"\n",
    );
    assert!(loaded.problems.is_empty(), "{}", loaded.problems);
    let parcel = thing(&loaded, 0, 0);
    assert!((parcel.position() - Point3::new(0.35, 0.0, 0.75 + 0.6)).norm() < 1e-12, "{}", parcel.position());
}

/// A place by words of our own: a mill, on ground that rises to the north by 2 cm a metre.
struct Hillside;

impl PlaceMaker for Hillside {
    fn wishes(&mut self, _: &SceneSpec, _: Seed, world: &mut World) -> Result<(), PlaceError> {
        let heights = (0..11 * 11).map(|index| (f64::from(index / 11) * 10.0 - 50.0) * 0.02);
        let ground = Ground::new(GroundData {
            origin: Point2::new(-50.0, -50.0),
            spacing: 10.0,
            columns: 11,
            rows: 11,
            heights: heights.map(|height| height as f32).collect(),
            covers: vec![Cover::Grass; 11 * 11],
            water: None,
        })?;
        world.set_ground(Arc::new(ground));
        // The world of a place has assets of its own, one of them with a name that the library has too.
        let bench = Asset::new("bench", EntityKind::Prop, Shape::cuboid(3.0, 3.0, 3.0));
        world.add_asset(bench)?;
        let pose = pose_facing(Point3::origin(), 0.0);
        let mill = EntityDesc::new(EntityKind::Building, pose, Shape::cuboid(10.0, 10.0, 6.0)).named("Mill");
        world.spawn(mill)?;
        Ok(())
    }

    fn streets(&mut self, _: &StreetPlan, _: Seed, _: &mut World) -> Result<(), PlaceError> {
        Err("no streets on a hillside".into())
    }
}

#[test]
fn things_stand_on_the_land_of_a_place_and_what_is_there_already_is_told_of() {
    let text = "version = 1\n[place]\nkind = \"wilderness\"\n\
        [[thing]]\nasset = \"tree\"\nat = [10, 20]\n\
        [[thing]]\nasset = \"bench\"\nat = [20, 20]\n\
        [[thing]]\nasset = \"bench\"\nname = \"seat\"\nat = [4.8, 0, 0]\n";
    let scene = SceneFile::parse(text).unwrap();
    let loaded = scene.load(&Catalogue::library(), &mut Hillside).unwrap();
    let height = |row| thing(&loaded, row, 0).position().z;
    assert!((height(0) - 0.4).abs() < 1e-4, "a tree has its roots where its middle is: {}", height(0));
    assert!((height(1) - 0.02 * 20.9).abs() < 1e-4, "a bench stands on its higher end: {}", height(1));
    let bench = thing(&loaded, 1, 0);
    assert_eq!(
        (bench.kind, bench.info.shape.size().y),
        (EntityKind::Bench, 1.8),
        "it is that of the library"
    );
    let problem = only(&loaded);
    let Fault::Penetrates { other, depth } = &problem.fault else { panic!("{problem}") };
    assert!(other.starts_with("Mill (#") && (depth - 0.5).abs() < 1e-12, "{problem}");
    assert_eq!(problem.at.row, "[[thing]] 3 (bench \"seat\")");
}

#[test]
fn a_place_that_cannot_be_made_is_refused_with_its_line() {
    let place = SceneFile::parse("version = 1\n[place]\nkind = \"island\"").unwrap();
    let error = place.load(&Catalogue::library(), &mut NoPlaces).unwrap_err();
    assert!(matches!(error, SceneFileError::Place { .. }));
    assert!(error.to_string().starts_with("scene:2: [place]: the place cannot be made"), "{error}");
    let street = "version = 1\n[[street]]\nname = \"Way\"\npoints = [[0, 0], [90, 0]]\n";
    let error = SceneFile::parse(street).unwrap().load(&Catalogue::library(), &mut Hillside).unwrap_err();
    assert_eq!(
        error.to_string(),
        "scene:2: [[street]] 1 (\"Way\"): the place cannot be made: no streets on a hillside"
    );
}
