//! What is said about a city at work takes effect in it from the next step on: traffic stops for what is put in its way and goes on when it
//! is gone, and bodies meet it.

use std::sync::Arc;

use simworld_agents::editing::SceneEditor;
use simworld_citygen::{City, CityConfig};
use simworld_core::action::Action;
use simworld_core::command::Command;
use simworld_core::geometry::{Point2, Point3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::net::{NetworkConfig, RoadNetwork, StreetPlan, polyline};
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
use simworld_core::seam::Dynamics;
use simworld_core::seed::Seed;
use simworld_core::simulation::Simulation;
use simworld_physics::{HumanoidConfig, PhysicsConfig, PhysicsDynamics};
use simworld_traffic::{TrafficConfig, TrafficDynamics};

/// Half the width of the narrowest vehicle, m.
const HALF: f64 = 0.8;

/// Streets with traffic, and a place in the middle of a lane.
fn streets() -> (Simulation, Point2) {
    let network = RoadNetwork::derive(&StreetPlan::grid(3, 3, 120.0), &NetworkConfig::default());
    let network = Arc::new(network.expect("a grid is sound"));
    let lane = network.lanes.iter().find(|lane| lane.is_driven() && lane.length > 80.0);
    let place = polyline::at(&lane.expect("streets are long").path, 55.0).0;
    // As it is said below.
    let place = Point2::new((place.x * 10.0).round() / 10.0, (place.y * 10.0).round() / 10.0);
    let mut world = World::new();
    world.set_roads(network);
    // What is asked is who stops for what is put there, not who gets round it.
    let config =
        TrafficConfig { vehicles: 40, pedestrians: 0, pass_obstacles: false, ..TrafficConfig::default() };
    let traffic = TrafficDynamics::new(&mut world, &config, Seed(1)).expect("sound settings");
    let mut simulation = Simulation::new(world);
    simulation.add_dynamics("traffic", Box::new(traffic));
    (simulation, place)
}

/// What comes of a sentence in the step in which it is said.
fn say(simulation: &mut Simulation, words: &str) -> Vec<EntityId> {
    let mut editor = SceneEditor::new(Seed(9));
    simulation.begin_step();
    let done = editor.say(words, simulation).unwrap_or_else(|error| panic!("{words}: {error}"));
    simulation.finish_step().expect("nothing fails");
    done.made
}

/// The least gap between a place and a vehicle in so many steps, m, and how many steps somebody stood within 6 m of it.
fn watch(simulation: &mut Simulation, place: Point2, steps: usize) -> (f64, usize) {
    let (mut least, mut stood) = (f64::INFINITY, 0);
    for _ in 0..steps {
        simulation.step().expect("nothing fails");
        let gaps = simulation.world().iter().filter(|entity| entity.kind.is_vehicle()).map(|entity| {
            (entity.info.shape.planar_distance(entity.pose, &place), entity.twist.ground_speed())
        });
        let gaps: Vec<(f64, f64)> = gaps.collect();
        least = gaps.iter().map(|(gap, _)| *gap).fold(least, f64::min);
        stood += usize::from(gaps.iter().any(|(gap, speed)| *gap < 6.0 && *speed < 0.05));
    }
    (least, stood)
}

#[test]
fn a_cone_on_a_lane_is_stopped_for_and_driven_past_when_it_is_put_aside() {
    let (mut simulation, place) = streets();
    let (least, _) = watch(&mut simulation, place, 900);
    assert!(least < HALF, "the lane is driven on: {least} m");
    let cone = say(&mut simulation, &format!("put a cone at ({:.1}, {:.1})", place.x, place.y))[0];
    let radius = simulation.world().entity(cone).expect("it was put there").info.shape.size().x * 0.5;
    let (least, stood) = watch(&mut simulation, place, 1500);
    assert!(least > radius, "somebody drove through it: {least} m of {radius}");
    assert!(stood > 100, "somebody stands before it, {stood} steps");

    say(&mut simulation, "move the cone to (60, 60)");
    let (least, _) = watch(&mut simulation, place, 900);
    assert!(least < HALF, "the lane is free and driven on again: {least} m");

    say(&mut simulation, &format!("move the cone to ({:.1}, {:.1})", place.x, place.y));
    let (least, _) = watch(&mut simulation, place, 900);
    assert!(least > radius, "it is in the way again: {least} m");

    say(&mut simulation, "remove the cone");
    let (least, _) = watch(&mut simulation, place, 900);
    assert!(least < HALF, "and it is gone: {least} m");
}

#[test]
fn what_a_street_is_built_with_is_in_the_way_on_a_lane_as_well() {
    for thing in ["street lamp", "tree", "hydrant", "traffic light"] {
        let (mut simulation, place) = streets();
        let made = say(&mut simulation, &format!("put a {thing} at ({:.1}, {:.1})", place.x, place.y))[0];
        let size = simulation.world().entity(made).expect("it was put there").info.shape.size();
        let (least, stood) = watch(&mut simulation, place, 1500);
        assert!(
            least > size.x * 0.5 && least > size.y * 0.5,
            "{thing}: somebody drove through it: {least} m"
        );
        assert!(stood > 100, "{thing}: somebody stands before it, {stood} steps");
        say(&mut simulation, &format!("remove the {thing}"));
        let (least, _) = watch(&mut simulation, place, 900);
        assert!(least < HALF, "{thing}: the lane is free and driven on again: {least} m");
    }
}

#[test]
fn what_stands_beside_the_lanes_changes_nothing() {
    let trail = |things: &[(f64, f64)]| {
        let (mut simulation, _) = streets();
        for (x, y) in things {
            let pose = pose_facing(Point3::new(*x, *y, 0.0), 0.0);
            let bench = EntityDesc::new(EntityKind::Bench, pose, Shape::cuboid(0.6, 1.8, 0.8));
            simulation.submit(Command::Spawn(Box::new(bench)));
        }
        simulation.step().expect("nothing fails");
        watch(&mut simulation, Point2::origin(), 300);
        let world = simulation.world();
        let vehicles = world.iter().filter(|entity| entity.kind.is_vehicle());
        vehicles.map(|entity| entity.position().coords).collect::<Vec<_>>()
    };
    assert_eq!(trail(&[]), trail(&[(60.0, 6.0), (30.0, 114.0), (180.0, 6.5)]));
}

/// Where the vehicles of a generated city are after a minute.
fn after_a_minute(seed: Seed, furnished: bool) -> Vec<Point3> {
    let city = City::generate(&CityConfig::with_roads(60), seed).expect("any seed makes a city");
    let mut world = World::new();
    city.populate(&mut world).expect("a city fits into a world");
    let is_put = |kind: EntityKind| {
        matches!(
            kind,
            EntityKind::Bench
                | EntityKind::TrashBin
                | EntityKind::Mailbox
                | EntityKind::Cone
                | EntityKind::Prop
                | EntityKind::Tree
                | EntityKind::StreetLamp
                | EntityKind::Sign
                | EntityKind::Hydrant
                | EntityKind::BusStop
                | EntityKind::Building
                | EntityKind::TrafficSignal
        )
    };
    let put: Vec<EntityId> = world.iter().filter(|one| is_put(one.kind)).map(|one| one.id).collect();
    assert!(put.len() > 20, "the streets are furnished: {}", put.len());
    if !furnished {
        for id in put {
            world.remove(id).expect("it is there");
        }
    }
    let config = TrafficConfig { vehicles: 150, pedestrians: 0, ..TrafficConfig::default() };
    let mut traffic = TrafficDynamics::new(&mut world, &config, seed).expect("sound settings");
    for _ in 0..600 {
        world.begin_step();
        traffic.step(&mut world, 0.1).expect("traffic flows");
        world.finish_step();
    }
    traffic.traffic().vehicles().map(|body| Point3::from(body.pose.translation.vector)).collect()
}

#[test]
fn the_furniture_and_the_houses_of_a_city_are_in_nobodys_way() {
    for seed in [Seed(1), Seed(2), Seed(3)] {
        assert_eq!(after_a_minute(seed, true), after_a_minute(seed, false), "{seed:?}");
    }
}

#[test]
fn a_body_meets_what_is_put_before_it() {
    let mut world = World::new();
    let at = |x: f64, z: f64| pose_facing(Point3::new(x, 0.0, z), 0.0);
    world
        .spawn(EntityDesc::new(EntityKind::Ground, at(0.0, -1.0), Shape::cuboid(100.0, 100.0, 1.0)))
        .unwrap();
    let person = Shape::Capsule { radius: 0.25, height: 1.75 };
    let me = world.spawn(EntityDesc::new(EntityKind::Person, at(0.0, 0.0), person)).unwrap();
    let mut physics = PhysicsDynamics::new(PhysicsConfig::default()).unwrap();
    physics.add_humanoid(&world, me, HumanoidConfig::default()).unwrap();
    let mut simulation = Simulation::new(world);
    simulation.add_dynamics("physics", Box::new(physics));
    let walk = |simulation: &mut Simulation, steps: usize| {
        for _ in 0..steps {
            simulation.submit(Command::Actuate { who: me, action: Action::MoveForward { speed: 1.4 } });
            simulation.step().expect("nothing fails");
        }
        simulation.world().entity(me).unwrap().position().x
    };
    let before = walk(&mut simulation, 20);
    assert!(before > 1.0, "it walks: {before}");
    let made = say(&mut simulation, "put a vending machine at (8, 0)")[0];
    let stopped = walk(&mut simulation, 100);
    let edge = simulation.world().entity(made).unwrap().bounds.min.x;
    assert!(stopped < edge && stopped > edge - 1.0, "it stands before it, at {stopped} of {edge}");
}
