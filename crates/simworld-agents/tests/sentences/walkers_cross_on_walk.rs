//! On the sidewalks of a crossroads: nobody begins to cross but on walk, and who began comes to the other side.

use std::sync::Arc;

use crate::executor_common::{Walk, person};
use simworld_agents::executor::{ExecutorConfig, RuleExecutor};
use simworld_core::geometry::{Point2, Point3, Twist, Vector3, pose_facing};
use simworld_core::id::CrossingId;
use simworld_core::net::{
    Aspect, NetworkConfig, RoadNetwork, StreetPlan, WaypointConfig, WaypointGraph, WaypointKind,
};
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
use simworld_core::seam::{Goal, Plan, Progress};

/// A walker at one kerb of a crossing, on the way to the other.
fn at_kerb(config: ExecutorConfig, signalised: bool) -> (Walk, CrossingId, Point2, Point2) {
    let mut network =
        RoadNetwork::derive(&StreetPlan::crossroads(100.0), &NetworkConfig::default()).expect("a sound plan");
    if !signalised {
        network.crossings.iter_mut().for_each(|crossing| crossing.signal = None);
    }
    let ways = WaypointGraph::walkable(&network, &WaypointConfig::default()).expect("sound settings");
    let id = CrossingId(0);
    let kerbs: Vec<Point2> = ways
        .waypoints()
        .iter()
        .filter(|waypoint| waypoint.kind == WaypointKind::Kerb(id))
        .map(|waypoint| waypoint.position)
        .collect();
    let [from, to] = kerbs[..] else { panic!("a crossing has two kerbs") };
    let mut world = World::new();
    world.set_roads(network.into());
    let me = person(&mut world, from.x, from.y);
    let executor = RuleExecutor::with_config(Some(Arc::new(ways)), config).expect("settings in range");
    let plan = Plan::navigate(Goal::Point(Point3::new(to.x, to.y, 0.0)), 0.5);
    (Walk::new(world, me, executor, plan), id, from, to)
}

/// Shows an aspect at a crossing and red everywhere else.
fn show(walk: &mut Walk, id: CrossingId, aspect: Aspect) {
    let world = walk.simulation.world();
    let roads = Arc::clone(world.roads().expect("it has roads"));
    let group = roads.crossings[id.index()].signal.expect("it has a signal");
    // Signals are the traffic's to write: through the snapshot, as nothing else runs here.
    let mut changed = world.clone();
    changed.signals_mut()[group.index()] = aspect;
    replace_world(walk, changed);
}

fn replace_world(walk: &mut Walk, world: World) {
    let me = walk.me;
    let speed = walk.simulation.world().entity(me).expect("it lives").twist.ground_speed();
    let mut body = simworld_core::kinematic::KinematicBody::walker(*world.entity(me).expect("it lives").pose);
    let go_on = simworld_core::action::Action::MoveForward { speed };
    simworld_core::seam::Embodiment::apply(&mut body, &go_on).expect("a speed it had");
    let mut bodies = simworld_core::kinematic::KinematicDynamics::new();
    bodies.insert(me, Box::new(body));
    let mut simulation = simworld_core::simulation::Simulation::new(world);
    simulation.add_dynamics("bodies", Box::new(bodies));
    walk.simulation = simulation;
}

fn steps(walk: &mut Walk, count: usize) -> Progress {
    (0..count).fold(Progress::Running, |_, _| walk.step())
}

#[test]
fn red_and_yellow_hold_and_green_lets_go() {
    let (mut walk, id, from, to) = at_kerb(ExecutorConfig::default(), true);
    for aspect in [Aspect::Red, Aspect::Yellow] {
        show(&mut walk, id, aspect);
        assert!(steps(&mut walk, 200).goes_on());
        assert!((walk.here() - from).norm() < 0.8, "it left the kerb on {aspect:?}");
    }
    show(&mut walk, id, Aspect::Green);
    assert_eq!(walk.finish(300, |_| ()), Progress::Done);
    assert!((walk.here() - to).norm() < 0.8);
}

#[test]
fn who_began_finishes_on_red() {
    let (mut walk, id, from, to) = at_kerb(ExecutorConfig::default(), true);
    show(&mut walk, id, Aspect::Green);
    steps(&mut walk, 25);
    let halfway = walk.here();
    assert!((halfway - from).norm() > 2.0 && (halfway - to).norm() > 2.0, "on the strip: {halfway}");
    show(&mut walk, id, Aspect::Red);
    let mut before = (walk.here() - to).norm();
    let done = walk.finish(300, |walk| {
        let now = (walk.here() - to).norm();
        assert!(now < before + 1e-9, "it turned round or stood on the road");
        before = now;
    });
    assert_eq!(done, Progress::Done);
}

#[test]
fn without_signals_one_waits_for_a_gap() {
    let (mut walk, _, from, to) = at_kerb(ExecutorConfig::default(), false);
    // A car comes along the road, 40 m off at 10 m/s, and passes over the middle of the strip in four seconds.
    let middle = middle_of(from, to);
    let across = (to - from).normalize();
    let along = Vector3::new(-across.y, across.x, 0.0);
    let yaw = simworld_core::geometry::heading(&along.xy());
    let start = Point3::new(middle.x, middle.y, 0.0) - along * 40.0;
    let twist = Twist { linear: along * 10.0, angular: Vector3::zeros() };
    let mut car = EntityDesc::new(EntityKind::Car, pose_facing(start, yaw), Shape::cuboid(4.5, 1.8, 1.5));
    car.twist = twist;
    let mut world = walk.simulation.world().clone();
    let car = world.spawn(car).expect("a sound car");
    replace_world(&mut walk, world);
    let (mut left_kerb_at, mut least) = (None, f64::INFINITY);
    for step in 0..300_u32 {
        let pose = pose_facing(start + along * f64::from(step), yaw);
        let reset = simworld_core::command::Command::Reset { id: car, pose, twist, bond: None };
        walk.simulation.submit(reset);
        let progress = walk.step();
        least = least.min(walk.gap(car));
        if left_kerb_at.is_none() && (walk.here() - from).norm() > 1.0 {
            left_kerb_at = Some(step);
        }
        if progress == Progress::Done {
            break;
        }
    }
    let left = left_kerb_at.expect("it crossed in the end");
    assert!((35..120).contains(&left), "it left the kerb after {left} steps; the car passed after 40");
    assert!(least > 1.0, "the car passed at {least} m");
}

fn middle_of(a: Point2, b: Point2) -> Point2 {
    a + (b - a) * 0.5
}

#[test]
fn a_crossing_that_never_clears_is_given_up() {
    let config = ExecutorConfig { kerb_patience: 20.0, ..ExecutorConfig::default() };
    let (mut walk, id, from, _) = at_kerb(config, true);
    show(&mut walk, id, Aspect::Red);
    match walk.finish(250, |_| ()) {
        Progress::Failed { reason } => assert!(reason.contains("could not cross"), "{reason}"),
        other => panic!("{other:?}"),
    }
    assert!((walk.here() - from).norm() < 0.8);
}

#[test]
fn roads_are_crossed_only_at_crossings() {
    let network =
        RoadNetwork::derive(&StreetPlan::grid(3, 3, 80.0), &NetworkConfig::default()).expect("a sound plan");
    let ways = WaypointGraph::walkable(&network, &WaypointConfig::default()).expect("sound settings");
    let roads = Arc::new(network);
    let mut world = World::new();
    world.set_roads(Arc::clone(&roads));
    world.signals_mut().fill(Aspect::Green);
    let pick = |point| ways.waypoint(ways.nearest(point).expect("it has waypoints")).position;
    let (from, to) = (pick(Point2::new(40.0, 6.0)), pick(Point2::new(120.0, 154.0)));
    let me = person(&mut world, from.x, from.y);
    let plan = Plan::navigate(Goal::Point(Point3::new(to.x, to.y, 0.0)), 0.5);
    let on_crossing = |point: Point2| {
        roads.crossings.iter().any(|crossing| {
            let along = crossing.end - crossing.start;
            let share = (point - crossing.start).dot(&along) / along.norm_squared();
            (crossing.start + along * share.clamp(0.0, 1.0) - point).norm() < crossing.width * 0.5 + 0.5
        })
    };
    let carriageway = |point: Point2| {
        roads.roads.iter().any(|road| {
            road.centerline.windows(2).any(|ends| {
                let along = ends[1] - ends[0];
                let share = (point - ends[0]).dot(&along) / along.norm_squared();
                (ends[0] + along * share.clamp(0.0, 1.0) - point).norm() < 2.0
            })
        })
    };
    let mut walk = Walk::new(world, me, RuleExecutor::new(Arc::new(ways)), plan);
    let mut crossed = 0;
    let done = walk.finish(3000, |walk| {
        if carriageway(walk.here()) {
            crossed += 1;
            assert!(on_crossing(walk.here()), "walks on the road at {}", walk.here());
        }
    });
    assert_eq!(done, Progress::Done);
    assert!(crossed > 10, "the way leads over roads");
}
