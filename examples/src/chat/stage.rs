//! The stage: a city with traffic, the one who is spoken to, and some things to speak of beside it.

use std::sync::Arc;

use simworld_agents::executor::RuleExecutor;
use simworld_citygen::City;
use simworld_core::command::Command;
use simworld_core::event::EventKind;
use simworld_core::geometry::{Point2, Point3, direction, pose_facing, yaw_of};
use simworld_core::ground::Ground;
use simworld_core::id::EntityId;
use simworld_core::net::{NetworkError, RoadNetwork, WaypointConfig, WaypointGraph, polyline};
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World, WorldError};
use simworld_core::seam::{Executor, ExecutorError, Plan, PlanStep, Progress};
use simworld_core::seed::Seed;
use simworld_core::simulation::{Simulation, SimulationError};
use simworld_physics::{HumanoidConfig, PhysicsConfig, PhysicsDynamics, PhysicsError, VehicleClass};
use simworld_traffic::{TrafficConfig, TrafficDynamics, TrafficError};
use thiserror::Error;

/// Why there is no stage, or why it cannot go on.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum StageError {
    /// Streets without a sidewalk to stand on.
    #[error(
        "there is no street with a sidewalk to stand on: give a city more roads, and a scene such a street"
    )]
    NoPlace,
    /// The world refused an entity.
    #[error(transparent)]
    World(#[from] WorldError),
    /// No traffic.
    #[error(transparent)]
    Traffic(#[from] TrafficError),
    /// No physics.
    #[error(transparent)]
    Physics(#[from] PhysicsError),
    /// No walkways.
    #[error(transparent)]
    Network(#[from] NetworkError),
    /// A step failed.
    #[error(transparent)]
    Simulation(#[from] SimulationError),
    /// The executor cannot work.
    #[error(transparent)]
    Executor(#[from] ExecutorError),
}

/// A city in which somebody carries out plans.
pub struct Stage {
    simulation: Simulation,
    executor: RuleExecutor,
    me: EntityId,
    /// Where it has been, a point a second, m.
    pub trail: Vec<Point2>,
}

impl Stage {
    /// The one who is spoken to stands on the sidewalk of the longest street, with a person, a dog, a scooter, a parcel and
    /// a red car near by; `traffic` says how many drive and walk besides.
    ///
    /// # Errors
    /// A city without sidewalks, or a setting of the traffic out of range.
    pub fn new(city: &City, traffic: &TrafficConfig, seed: Seed) -> Result<Self, StageError> {
        let mut world = World::new();
        city.populate(&mut world)?;
        Self::in_world(world, traffic, seed)
    }

    /// The same in a world that is there already, such as that of a scene that is written by hand.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn in_world(mut world: World, traffic: &TrafficConfig, seed: Seed) -> Result<Self, StageError> {
        let network = Arc::clone(world.roads().ok_or(StageError::NoPlace)?);
        let traffic = TrafficDynamics::new(&mut world, traffic, seed)?;
        let cast = Cast::on(&network, &mut world)?;
        let mut physics = PhysicsDynamics::new(PhysicsConfig::default())?;
        for person in [cast.me, cast.other] {
            physics.add_humanoid(&world, person, HumanoidConfig::default())?;
        }
        physics.add_vehicle(&world, cast.car, VehicleClass::Sedan.parameters())?;
        let mut simulation = Simulation::new(world);
        simulation.add_dynamics("traffic", Box::new(traffic));
        simulation.add_dynamics("physics", Box::new(physics));
        simulation.set_trail_interval(0);
        let ways = Arc::new(WaypointGraph::walkable(&network, &WaypointConfig::default())?);
        Ok(Self { simulation, executor: RuleExecutor::new(ways), me: cast.me, trail: Vec::new() })
    }

    /// The world as it stands.
    pub fn world(&self) -> &World {
        self.simulation.world()
    }

    /// The one who is spoken to.
    pub fn me(&self) -> EntityId {
        self.me
    }

    /// Where it is, m.
    pub fn here(&self) -> Point2 {
        self.world().entity(self.me).map_or_else(Point2::origin, |me| me.planar())
    }

    /// Takes up a plan in place of the one under way.
    ///
    /// # Errors
    /// A plan that the executor does not know.
    pub fn start(&mut self, plan: Plan) -> Result<(), StageError> {
        Ok(self.executor.start(plan, self.simulation.world(), self.me)?)
    }

    /// The step of the plan under way.
    pub fn under_way(&self) -> Option<&PlanStep> {
        self.executor.under_way()
    }

    /// Drops the plan and comes to rest.
    pub fn interrupt(&mut self) {
        let mut actions = Vec::new();
        self.executor.cancel(&mut actions);
        self.submit(actions);
    }

    fn submit(&mut self, actions: Vec<simworld_core::action::Action>) {
        for action in actions {
            self.simulation.submit(Command::Actuate { who: self.me, action });
        }
    }

    /// One step of the world; how the plan stands, and what happened to the one who carries it out.
    ///
    /// # Errors
    /// A part of the simulation failed.
    pub fn step(&mut self) -> Result<(Progress, Vec<EventKind>), StageError> {
        let mut actions = Vec::new();
        let progress = self.executor.advance(self.simulation.world(), self.me, &mut actions)?;
        self.submit(actions);
        self.simulation.step()?;
        let tick = self.world().clock().tick().0;
        if tick.is_multiple_of(10) {
            self.trail.push(self.here());
        }
        let mine = |kind: &&EventKind| match kind {
            EventKind::ActionFailed { who, .. }
            | EventKind::Bought { who, .. }
            | EventKind::Gesture { who, .. } => *who == self.me,
            EventKind::Said { who, to, .. } => [*who, *to].contains(&self.me),
            _ => false,
        };
        let events = self.world().events().iter().map(|event| &event.kind).filter(mine).cloned().collect();
        Ok((progress, events))
    }
}

/// Those who are on the stage with bodies of their own.
struct Cast {
    me: EntityId,
    other: EntityId,
    car: EntityId,
}

impl Cast {
    fn on(network: &RoadNetwork, world: &mut World) -> Result<Self, StageError> {
        let length = |path: &[Point2]| polyline::length(path);
        let walks = network.sidewalks.iter();
        let walk =
            walks.max_by(|a, b| length(&a.path).total_cmp(&length(&b.path))).ok_or(StageError::NoPlace)?;
        let (middle, heading) = polyline::at(&walk.path, length(&walk.path) * 0.5);
        let body = Shape::Capsule { radius: 0.25, height: 1.75 };
        let land = world.ground().cloned();
        let at = |point: Point2, yaw: f64| pose_facing(on_ground(land.as_deref(), point), yaw);
        let along = |metres: f64| middle + direction(heading) * metres;
        let me = world.spawn(
            EntityDesc::new(EntityKind::Person, at(middle, heading), body)
                .named("Robin")
                .colored([0.05, 0.3, 0.6]),
        )?;
        let other = at(along(9.0), heading + std::f64::consts::PI);
        let other = world.spawn(
            EntityDesc::new(EntityKind::Person, other, body).named("Anna").colored([0.6, 0.3, 0.05]),
        )?;
        for (kind, metres, shape, name) in [
            (EntityKind::Dog, -7.0, Shape::cuboid(0.8, 0.3, 0.6), Some("Rex")),
            (EntityKind::Scooter, 4.0, Shape::cuboid(1.1, 0.45, 1.1), None),
            (EntityKind::Parcel, -4.0, Shape::cuboid(0.3, 0.3, 0.3), None),
        ] {
            let mut desc = EntityDesc::new(kind, at(along(metres), heading), shape);
            if let Some(name) = name {
                desc = desc.named(name);
            }
            world.spawn(desc)?;
        }
        let car = Self::park(network, world, along(-14.0))?;
        Ok(Self { me, other, car })
    }

    /// A red car at the right edge of the lane nearest to a place.
    fn park(network: &RoadNetwork, world: &mut World, near: Point2) -> Result<EntityId, StageError> {
        let lanes = network.lanes.iter().filter(|lane| lane.is_driven() && lane.length > 30.0);
        let places = lanes.filter_map(|lane| Some((polyline::closest(&lane.path, &near)?, lane)));
        let (place, lane) =
            places.min_by(|a, b| a.0.distance.total_cmp(&b.0.distance)).ok_or(StageError::NoPlace)?;
        let (middle, heading) = polyline::at(&lane.path, place.station.clamp(10.0, lane.length - 10.0));
        let right = direction(heading - std::f64::consts::FRAC_PI_2) * (lane.width * 0.5 - 1.0);
        let spot = middle + right;
        let pose = pose_facing(on_ground(world.ground().map(|land| &**land), spot), heading);
        let car =
            EntityDesc::new(EntityKind::Car, pose, Shape::cuboid(4.3, 1.8, 1.5)).colored([0.55, 0.03, 0.02]);
        Ok(world.spawn(car)?)
    }
}

/// A place on the ground, which is level at 0 where the world has no land.
fn on_ground(land: Option<&Ground>, point: Point2) -> Point3 {
    Point3::new(point.x, point.y, land.map_or(0.0, |land| land.height(point)))
}

/// Which way somebody looks, radians from east.
pub(super) fn heading_of(world: &World, who: EntityId) -> Option<f64> {
    world.entity(who).map(|entity| yaw_of(entity.pose))
}
