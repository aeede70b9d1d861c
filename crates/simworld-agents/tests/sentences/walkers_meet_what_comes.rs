//! What comes to stand in the way of a walk under way is walked round, and where a way is closed another one is taken.

use std::sync::Arc;

use crate::executor_common::{Walk, at, person, to};
use simworld_agents::executor::RuleExecutor;
use simworld_core::command::Command;
use simworld_core::geometry::{Point2, Twist};
use simworld_core::hash::StateHasher;
use simworld_core::id::EntityId;
use simworld_core::kinematic::{KinematicBody, KinematicDynamics};
use simworld_core::net::{NetworkConfig, RoadNetwork, StreetPlan, WaypointConfig, WaypointGraph};
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
use simworld_core::seam::{Dynamics, DynamicsError, Executor, Plan, Progress};
use simworld_core::simulation::Simulation;

/// Half a body, m.
const BODY: f64 = 0.25;
/// Side of the block of houses round which the streets lead, m.
const BLOCK: f64 = 200.0;

/// A walker without physics whom solid things stop all the same: a step into one is not taken, however often it is tried. Without that nobody
/// is ever stuck, and no way round is looked for.
struct Stopped {
    bodies: KinematicDynamics,
    who: EntityId,
}

impl Dynamics for Stopped {
    fn step(&mut self, world: &mut World, dt: f64) -> Result<(), DynamicsError> {
        let before = world.entity(self.who).map(|me| me.position());
        self.bodies.step(world, dt)?;
        let now = world.entity(self.who).map(|me| (me.planar(), *me.pose));
        let (Some(before), Some((here, mut pose))) = (before, now) else { return Ok(()) };
        let is_in_it = world.iter().any(|thing| {
            let gap = thing.info.shape.planar_distance(thing.pose, &here);
            thing.id != self.who && thing.is_solid() && gap < BODY
        });
        if is_in_it {
            pose.translation.vector = before.coords;
            world.set_motion(self.who, pose, Twist::ZERO)?;
        }
        Ok(())
    }

    fn save(&self) -> Result<Vec<u8>, DynamicsError> {
        self.bodies.save()
    }

    fn restore(&mut self, world: &World, saved: &[u8]) -> Result<(), DynamicsError> {
        self.bodies.restore(world, saved)
    }

    fn state_hash(&self, hasher: &mut StateHasher) {
        self.bodies.state_hash(hasher);
    }
}

fn walk(world: World, me: EntityId, executor: RuleExecutor, plan: Plan) -> Walk {
    let mut bodies = KinematicDynamics::new();
    bodies.insert(me, Box::new(KinematicBody::walker(*world.entity(me).unwrap().pose)));
    let mut simulation = Simulation::new(world);
    simulation.add_dynamics("bodies", Box::new(Stopped { bodies, who: me }));
    let mut walk = Walk { simulation, executor, me, told: Vec::new() };
    walk.executor.start(plan, walk.simulation.world(), me).unwrap();
    walk
}

/// Big things side by side from south to north: what they are, how wide each is, m, and how many.
type Row = (EntityKind, f64, u32);

/// Of things that are walked round one by one, of such that could drive off, and a wall.
const ROWS: [Row; 3] =
    [(EntityKind::Prop, 6.0, 5), (EntityKind::Truck, 8.0, 5), (EntityKind::Building, 30.0, 1)];

/// How far a row reaches to either side, m.
fn reach((_, width, count): Row) -> f64 {
    width * f64::from(count) * 0.5
}

/// Puts a row across the way, so deep along it.
fn put_across(walk: &mut Walk, row: Row, middle: Point2, depth: f64) {
    let (kind, width, count) = row;
    for place in 0..count {
        let y = middle.y - reach(row) + width * (f64::from(place) + 0.5);
        let desc = EntityDesc::new(kind, at(middle.x, y), Shape::cuboid(depth, width, 3.0));
        walk.simulation.submit(Command::Spawn(Box::new(desc)));
    }
}

/// Walks until it is so far east.
fn come_to(walk: &mut Walk, x: f64) {
    for _ in 0..2000 {
        if walk.here().x >= x {
            return;
        }
        assert!(walk.step().goes_on(), "nothing is in the way yet");
    }
    panic!("it never came to {x}: it is at {}", walk.here());
}

/// Ends the walk; how far aside it led from there, m.
fn led_aside(walk: &mut Walk, row: Row) -> f64 {
    let from = walk.here().y;
    let mut aside = 0.0_f64;
    let ended = walk.finish(3000, |walk| aside = aside.max((walk.here().y - from).abs()));
    assert_eq!(ended, Progress::Done, "a row of {}, at {}", row.0, walk.here());
    aside
}

#[test]
fn a_row_that_comes_to_stand_across_open_ground_is_walked_round() {
    for row in ROWS {
        let mut world = World::new();
        let me = person(&mut world, 0.0, 0.0);
        let mut walk = walk(world, me, RuleExecutor::straight(), to(30.0, 0.0));
        come_to(&mut walk, 10.0);
        assert!(walk.here().y.abs() < 0.1, "it went straight on");
        put_across(&mut walk, row, Point2::new(16.0, 0.0), 2.5);
        let aside = led_aside(&mut walk, row);
        assert!(aside > reach(row), "a row of {} was walked through, {aside} m aside", row.0);
        assert!((walk.here() - Point2::new(30.0, 0.0)).norm() <= 0.6, "{}", walk.here());
    }
}

/// The streets round a block, and the ways along them.
fn streets() -> (World, Arc<WaypointGraph>) {
    let plan = StreetPlan::grid(2, 2, BLOCK);
    let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("a sound plan");
    let ways = WaypointGraph::walkable(&network, &WaypointConfig::default()).expect("sound settings");
    let mut world = World::new();
    world.set_roads(Arc::new(network));
    (world, Arc::new(ways))
}

/// The place on a walkway that is nearest to a point: with a point inside the block, on the sidewalk inside.
fn place_near(ways: &WaypointGraph, x: f64, y: f64) -> Point2 {
    ways.waypoint(ways.nearest(Point2::new(x, y)).expect("it has waypoints")).position
}

/// A walk along the southern street, and the two waypoints of it that come next beyond 60 m.
fn along_the_street() -> (Walk, [Point2; 2]) {
    let (mut world, ways) = streets();
    let (from, end) = (place_near(&ways, 30.0, 6.0), place_near(&ways, 150.0, 6.0));
    let me = person(&mut world, from.x, from.y);
    let mut beyond: Vec<Point2> = ways.waypoints().iter().map(|waypoint| waypoint.position).collect();
    beyond.retain(|place| (place.y - from.y).abs() < 0.1 && place.x > 60.0 && place.x < end.x);
    beyond.sort_unstable_by(|a, b| a.x.total_cmp(&b.x));
    let walk = walk(world, me, RuleExecutor::new(ways), to(end.x, end.y));
    (walk, [beyond[0], beyond[1]])
}

#[test]
fn a_row_that_comes_to_stand_across_a_street_is_walked_round() {
    for row in ROWS {
        let (mut walk, [a, b]) = along_the_street();
        let middle = a + (b - a) * 0.5;
        come_to(&mut walk, middle.x - 8.0);
        put_across(&mut walk, row, middle, 2.5);
        let aside = led_aside(&mut walk, row);
        assert!(aside > reach(row), "a row of {} was walked through, {aside} m aside", row.0);
    }
}

#[test]
fn a_waypoint_that_something_comes_to_stand_on_is_left_out() {
    for row in ROWS {
        let (mut walk, [covered, _]) = along_the_street();
        come_to(&mut walk, covered.x - 8.0);
        put_across(&mut walk, row, covered, 4.0);
        let aside = led_aside(&mut walk, row);
        assert!(aside > reach(row), "a row of {} was walked through, {aside} m aside", row.0);
    }
}

#[test]
fn where_the_first_way_is_closed_another_one_is_taken() {
    let (mut world, ways) = streets();
    // Round the western side of the block it is shorter.
    let (from, end) = (place_near(&ways, 90.0, 6.0), place_near(&ways, 90.0, BLOCK - 6.0));
    let me = person(&mut world, from.x, from.y);
    // A wall across the western street, too long to be walked round on the spot.
    let wall = EntityDesc::new(EntityKind::Building, at(0.0, BLOCK * 0.5), Shape::cuboid(140.0, 1.0, 4.0));
    world.spawn(wall).unwrap();
    let mut walk = walk(world, me, RuleExecutor::new(ways), to(end.x, end.y));
    let (mut west, mut east) = (f64::INFINITY, f64::NEG_INFINITY);
    let ended = walk.finish(10_000, |walk| {
        west = west.min(walk.here().x);
        east = east.max(walk.here().x);
    });
    assert_eq!(ended, Progress::Done, "at {}", walk.here());
    assert!(west < 20.0, "it tried the shorter way first, and came to x = {west}");
    assert!(east > BLOCK - 20.0, "it went round the eastern side, and came to x = {east}");
}
