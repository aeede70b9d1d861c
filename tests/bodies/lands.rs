//! Places beyond the city as a whole: what the map, the bodies and the pictures know of the land is one and the same, sentences
//! are carried out on its slopes, and what an edit puts down stands on it.

use simworld_agents::editing::{SceneEditor, faults};
use simworld_agents::executor::RuleExecutor;
use simworld_agents::language::GrammarPlanner;
use simworld_agents::scenes::{GrammarSceneReader, SceneReader};
use simworld_citygen::landscape::Landscape;
use simworld_core::asset::Catalogue;
use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::command::Command;
use simworld_core::geometry::{Point2, Point3, Ray, Vector3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::intent::Intent;
use simworld_core::net::{WaypointConfig, WaypointGraph};
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
use simworld_core::seam::{Executor, Planner, Progress};
use simworld_core::seed::Seed;
use simworld_core::simulation::Simulation;
use simworld_physics::{HumanoidConfig, PhysicsConfig, PhysicsDynamics};
use simworld_render::{Frame, RenderConfig, RenderError, Renderer};

const WORDS: [&str; 3] = [
    "a wooded island with a fishing village and a lighthouse",
    "countryside with rolling hills, a hamlet and a windmill",
    "a wilderness with mountains, a lake and a hut",
];

fn place(words: &str, seed: u64) -> (Landscape, World) {
    let reading = GrammarSceneReader.read_scene(words).unwrap_or_else(|error| panic!("{words}: {error}"));
    assert!(reading.unread.is_empty(), "{words}: {:?}", reading.unread);
    let place =
        Landscape::build(&reading.spec, Seed(seed)).unwrap_or_else(|error| panic!("{words}: {error}"));
    let mut world = World::new();
    place.populate(&mut world).expect("the world takes it");
    (place, world)
}

fn named(world: &World, name: &str) -> EntityId {
    let found = world.iter().find(|entity| entity.info.name.as_deref() == Some(name));
    found.unwrap_or_else(|| panic!("no {name}")).id
}

/// A person who stands on the land.
fn person(world: &mut World, at: Point2) -> EntityId {
    let stand = world.ground().expect("there is land").point(at);
    let shape = Shape::Capsule { radius: 0.25, height: 1.75 };
    world.spawn(EntityDesc::new(EntityKind::Person, pose_facing(stand, 0.0), shape)).expect("a sound entity")
}

#[test]
fn words_of_all_three_kinds_become_places() {
    for (words, landmark) in WORDS.into_iter().zip(["Lighthouse", "Windmill", "Hut"]) {
        let (place, world) = place(words, 2);
        assert!(place.buildings().count() > 0);
        named(&world, landmark);
    }
}

/// Carries a sentence out and returns how far from the goal it ended, m.
fn walked(world: World, who: EntityId, said: &str, longest: f64) -> (Simulation, String) {
    let roads = world.roads().expect("there are ways").clone();
    let ways = WaypointGraph::walkable(&roads, &WaypointConfig::default()).expect("sound settings");
    let mut executor = RuleExecutor::new(ways.into());
    let plan = GrammarPlanner::default()
        .plan(&Intent::Words(said.to_owned()), &world, who)
        .unwrap_or_else(|error| panic!("{said}: {error}"));
    let mut physics = PhysicsDynamics::new(PhysicsConfig::default()).expect("sound settings");
    physics.add_humanoid(&world, who, HumanoidConfig::default()).expect("an upright body");
    let mut simulation = Simulation::new(world);
    simulation.add_dynamics("physics", Box::new(physics));
    simulation.set_trail_interval(0);
    executor.start(plan, simulation.world(), who).expect("a plan to follow");
    let mut actions = Vec::new();
    loop {
        let progress = executor.advance(simulation.world(), who, &mut actions).expect("it goes on");
        for action in actions.drain(..) {
            simulation.submit(Command::Actuate { who, action });
        }
        simulation.step().expect("the world goes on");
        let world = simulation.world();
        let (entity, land) = (world.entity(who).expect("it lives"), world.ground().expect("land"));
        let off = entity.position().z - land.height(entity.planar());
        assert!((-0.01..0.6).contains(&off), "{said}: {off} m off the ground at {}", entity.position());
        assert!(!land.is_wet(entity.planar()), "{said}: in the water at {}", entity.position());
        match progress {
            Progress::Done => return (simulation, String::new()),
            Progress::Failed { reason } => return (simulation, reason),
            _ if world.clock().seconds() > longest => return (simulation, "it took too long".to_owned()),
            _ => {}
        }
    }
}

#[test]
fn sentences_are_carried_out_on_the_slopes() {
    let cases = [
        (2, "go to the hut", "Hut", 3.0),
        (2, "walk to the lake", "Lake", 3.0),
        (0, "go to the lighthouse", "Lighthouse", 3.0),
    ];
    for (which, said, goal, near) in cases {
        let (place, mut world) = place(WORDS[which], 3);
        let start = match goal {
            "Hut" => place.areas.iter().find(|area| area.name == "Lake").and_then(|area| area.access),
            _ => place.things.iter().find(|thing| thing.name.is_some()).and_then(|thing| thing.access),
        };
        let start = start.expect("a place to begin at");
        let goal = named(&world, goal);
        let target = world.entity(goal).expect("it is there").access();
        // The lighthouse is gone to from the village.
        let from = if which == 0 { place.network.sidewalks[0].path[0] } else { start.xy() };
        let who = person(&mut world, from);
        let (simulation, fault) = walked(world, who, said, 1800.0);
        assert_eq!(fault, "", "{said}");
        let end = simulation.world().entity(who).expect("it lives").planar();
        assert!((end - target.xy()).norm() < near, "{said}: {end}, not {target}");
    }
}

#[test]
fn the_nearest_tree_is_gone_to_over_open_ground() {
    let (place, mut world) = place(WORDS[2], 3);
    let hut = place.things.iter().find(|thing| thing.name.as_deref() == Some("Hut")).expect("a hut");
    let who = person(&mut world, hut.access.expect("a way in").xy());
    let (simulation, fault) = walked(world, who, "go to the nearest tree", 600.0);
    assert_eq!(fault, "");
    let world = simulation.world();
    let end = world.entity(who).expect("it lives").planar();
    let tree = world.nearest(end, 5.0, &|entity| entity.kind == EntityKind::Tree);
    assert!(tree.is_some_and(|tree| (tree.planar() - end).norm() < 2.5), "no tree at {end}");
}

#[test]
fn what_is_added_stands_on_the_land() {
    for (words, said) in [
        (WORDS[2], "add a bench next to the hut"),
        (WORDS[0], "add a bench next to the lighthouse"),
        (WORDS[1], "put a table near the windmill"),
    ] {
        let (_, mut world) = place(words, 4);
        let before: Vec<EntityId> = world.iter().map(|entity| entity.id).collect();
        let mut editor = SceneEditor::new(Seed(1)).with_catalogue(Catalogue::library());
        editor.say(said, &mut world).unwrap_or_else(|error| panic!("{said}: {error}"));
        let new: Vec<EntityId> =
            world.iter().map(|entity| entity.id).filter(|id| !before.contains(id)).collect();
        assert_eq!(new.len(), 1, "{said}");
        let thing = world.entity(new[0]).expect("it is there");
        let off = thing.position().z - world.ground().expect("land").height(thing.planar());
        assert!(off.abs() < 0.05, "{said}: {off} m off the ground");
        assert_eq!(faults(&world, new[0]), [], "{said}");
        // The judge would see it if it floated.
        let mut lifted = world.clone();
        let mut pose = *thing.pose;
        pose.translation.z += 0.3;
        let twist = *thing.twist;
        lifted.set_motion(new[0], pose, twist).expect("it moves");
        assert_ne!(faults(&lifted, new[0]), [], "{said}");
    }
}

#[test]
fn map_bodies_and_pictures_know_the_same_land() {
    let mut renderer = match Renderer::new(&RenderConfig { far: 3000.0, ..RenderConfig::default() }) {
        Ok(renderer) => Some(renderer),
        Err(RenderError::NoAdapter { .. }) if std::env::var_os("SIMWORLD_REQUIRE_ADAPTER").is_none() => None,
        Err(error) => panic!("{error}"),
    };
    for words in WORDS {
        let (place, mut world) = place(words, 2);
        let mut physics = PhysicsDynamics::new(PhysicsConfig::default()).expect("sound settings");
        let mut simulation_world = world.clone();
        simulation_world.begin_step();
        simworld_core::seam::Dynamics::step(&mut physics, &mut simulation_world, 0.1).expect("a step");
        let mut rng = Seed(9).stream("places").rng();
        let (_, high) = place.ground.extent();
        for _ in 0..500 {
            let at = Point2::new(rng.uniform(-high.x, high.x), rng.uniform(-high.y, high.y));
            let ray = Ray { origin: Point3::new(at.x, at.y, 500.0), direction: -Vector3::z() };
            let met = 500.0 - physics.cast_at_ground(&ray, 1000.0).expect("there is land");
            assert!((met - place.ground.height(at)).abs() < 1e-6, "{words}: {at}");
        }
        let Some(renderer) = &mut renderer else { continue };
        // Only the land and its waters, so that every pixel is one of them.
        let solids: Vec<EntityId> =
            world.iter().filter(|entity| entity.kind != EntityKind::Ground).map(|entity| entity.id).collect();
        for id in solids {
            world.remove(id).expect("it was there");
        }
        let land = world.iter().find(|entity| entity.info.name.is_none()).expect("the land").id;
        let intrinsics = Intrinsics::from_fov(96, 72, 1.0).expect("a size in range");
        let eye = Point3::new(0.0, -high.y * 0.7, 260.0);
        let camera = Camera::looking_at(eye, Point3::new(0.0, 0.0, 10.0), intrinsics);
        let mut frame = Frame::new();
        renderer.render(&world, &camera, &mut frame).expect("drawn");
        let (mut seen, mut wet) = (0, 0);
        for (x, y) in (0..72).flat_map(|y| (0..96).map(move |x| (x, y))) {
            let (Some(depth), Some(id)) = (frame.depth_at(x, y), frame.entity_at(x, y)) else { continue };
            let pixel = Point2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
            let point = camera.world_from_optical * intrinsics.unproject(&pixel, f64::from(depth));
            if id == land {
                let off = point.z - place.ground.height(point.xy());
                assert!(off.abs() < 0.02, "{words}: {off} m at {point}");
                assert!(point.z > -0.02, "{words}: the bed of the water is seen at {point}");
                seen += 1;
            } else if world.entity(id).is_some_and(|entity| entity.info.attributes.contains_key("area")) {
                let area = world.entity(id).and_then(|entity| entity.info.name.clone()).unwrap_or_default();
                if ["Sea", "Lake", "River"].contains(&area.as_str()) {
                    assert!(
                        point.z.abs() < 0.02
                            && (place.ground.height(point.xy()) < 0.02 || !place.ground.holds(point.xy())),
                        "{words}: {area} at {point}"
                    );
                    wet += 1;
                }
            }
        }
        assert!(seen > 1000, "{words}: {seen} pixels of land");
        assert!(wet > 20, "{words}: {wet} pixels of water");
    }
}
