//! The environment: a walker with a real body among the things of a block.

use std::f64::consts::TAU;
use std::sync::Arc;

use simworld_citygen::CityError;
use simworld_core::action::Action;
use simworld_core::command::Command;
use simworld_core::geometry::{Point2, Point3, pose_facing, yaw_of};
use simworld_core::id::EntityId;
use simworld_core::ops::wrap_angle;
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World, WorldError};
use simworld_core::seam::{Env, EnvError, Info, Options, Space, SpaceValue, Transition};
use simworld_core::seed::Seed;
use simworld_core::simulation::{RestoreError, Simulation, SimulationSnapshot};
use simworld_physics::{HumanoidConfig, PhysicsConfig, PhysicsDynamics, PhysicsError};
use simworld_traffic::{TrafficConfig, TrafficDynamics, TrafficError};
use thiserror::Error;

use super::Field;
use super::field::SIDE;

/// Headings to choose from.
pub(super) const HEADINGS: usize = 8;
/// Steps of the world, 0.1 s each, in one step of the environment.
const TICKS: u32 = 15;
/// How fast the walker goes, m/s.
const SPEED: f64 = 1.8;
/// So near it has arrived, m.
const NEAR: f64 = 2.0;
/// What arriving, a metre nearer and a step are worth.
const ARRIVED: f64 = 1.0;
const METRE: f64 = 0.01;
const STEP: f64 = -0.02;

/// Why there is no environment.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum WayfindingError {
    /// No city.
    #[error(transparent)]
    City(#[from] CityError),
    /// The world refused an entity.
    #[error(transparent)]
    World(#[from] WorldError),
    /// No traffic.
    #[error(transparent)]
    Traffic(#[from] TrafficError),
    /// No bodies.
    #[error(transparent)]
    Physics(#[from] PhysicsError),
    /// The start cannot be kept.
    #[error(transparent)]
    Restore(#[from] RestoreError),
    /// No square of the city will do.
    #[error(
        "no building of this city has a door within reach of a third of its surroundings: give another seed"
    )]
    NoField,
}

/// Find the door: the observation is the cell one stands in, an action one of eight headings, in which the body walks for 1.5 s
/// unless something is in its way. A metre nearer is worth 0.01, a step costs 0.02, arriving is worth 1.
///
/// Option `cell`: the cell to begin in, one of [`Field::starts`].
pub struct Wayfinding {
    field: Arc<Field>,
    simulation: Simulation,
    begin: SimulationSnapshot,
    walker: EntityId,
    seed: Seed,
    is_over: bool,
}

impl Wayfinding {
    /// The walker alone, or among so many vehicles and as many people.
    ///
    /// # Errors
    /// A part cannot be made.
    pub fn new(field: Arc<Field>, traffic: u32) -> Result<Self, WayfindingError> {
        let mut world = World::new();
        field.city().populate(&mut world)?;
        let start = pose_facing(flat(field.middle(field.starts()[0])), 0.0);
        let shape = Shape::Capsule { radius: 0.25, height: 1.75 };
        let walker = world.spawn(EntityDesc::new(EntityKind::Person, start, shape))?;
        let config = TrafficConfig { vehicles: traffic, pedestrians: traffic, ..TrafficConfig::default() };
        let around = (traffic > 0).then(|| TrafficDynamics::new(&mut world, &config, Seed(1))).transpose()?;
        let mut physics = PhysicsDynamics::new(PhysicsConfig::default())?;
        physics.add_humanoid(&world, walker, HumanoidConfig::default())?;
        let mut simulation = Simulation::new(world);
        simulation.set_trail_interval(0);
        if let Some(around) = around {
            simulation.add_dynamics("traffic", Box::new(around));
        }
        simulation.add_dynamics("physics", Box::new(physics));
        let begin = simulation.save()?;
        Ok(Self { field, simulation, begin, walker, seed: Seed(0), is_over: true })
    }

    /// Where the walker is.
    fn place(&self) -> Result<(Point2, f64), EnvError> {
        let gone = || EnvError::Simulation("the walker is gone".to_owned());
        let walker = self.simulation.world().entity(self.walker).ok_or_else(gone)?;
        Ok((walker.planar(), yaw_of(walker.pose)))
    }

    fn seen(&self, at: Point2) -> SpaceValue {
        SpaceValue::Discrete(self.field.cell(at) as i64)
    }

    fn start_of(&self, options: &Options) -> Result<usize, EnvError> {
        EnvError::refuse_unknown(options, &["cell"])?;
        let starts = self.field.starts();
        let Some(wanted) = options.get("cell") else {
            let mut rng = self.seed.stream("wayfinding/start").rng();
            return Ok(starts[rng.below(starts.len())]);
        };
        let cell = wanted.as_i64().and_then(|cell| usize::try_from(cell).ok());
        cell.filter(|cell| starts.contains(cell)).ok_or_else(|| EnvError::Option {
            name: "cell".to_owned(),
            reason: format!("{wanted} is no cell to begin in: give one of Field::starts"),
        })
    }
}

impl Env for Wayfinding {
    type Observation = SpaceValue;
    type Action = SpaceValue;

    fn reset(&mut self, seed: Option<Seed>, options: &Options) -> Result<(SpaceValue, Info), EnvError> {
        let seed = seed.unwrap_or_else(|| self.seed.stream("gym/next").seed());
        let before = std::mem::replace(&mut self.seed, seed);
        let start = self.start_of(options).inspect_err(|_| self.seed = before)?;
        let failed = |error: &dyn std::error::Error| EnvError::Simulation(error.to_string());
        self.simulation.restore(self.begin.clone()).map_err(|error| failed(&error))?;
        let facing = self.seed.stream("wayfinding/facing").rng().uniform(-TAU * 0.5, TAU * 0.5);
        let pose = pose_facing(flat(self.field.middle(start)), facing);
        self.simulation.apply(&Command::Move { id: self.walker, pose }).map_err(|error| failed(&error))?;
        self.is_over = false;
        Ok((self.seen(self.place()?.0), Info::new()))
    }

    fn step(&mut self, action: &SpaceValue) -> Result<Transition<SpaceValue>, EnvError> {
        if self.is_over {
            return Err(EnvError::NotReset);
        }
        let refused = |source| EnvError::NotInSpace { what: "action", source };
        self.spaces().1.check(action).map_err(refused)?;
        let (before, facing) = self.place()?;
        let wanted = action.as_discrete().unwrap_or(0) as f64 * TAU / HEADINGS as f64;
        let who = self.walker;
        for action in
            [Action::Rotate { angle: wrap_angle(wanted - facing) }, Action::MoveForward { speed: SPEED }]
        {
            self.simulation.submit(Command::Actuate { who, action });
        }
        for _ in 0..TICKS {
            self.simulation.step().map_err(|error| EnvError::Simulation(error.to_string()))?;
        }
        let (at, _) = self.place()?;
        let left = |from: Point2| (self.field.goal() - from).norm();
        self.is_over = left(at) < NEAR;
        let reward = STEP + METRE * (left(before) - left(at)) + if self.is_over { ARRIVED } else { 0.0 };
        let info = Info::from([("x".to_owned(), at.x.into()), ("y".to_owned(), at.y.into())]);
        let (observation, terminated) = (self.seen(at), self.is_over);
        Ok(Transition { observation, reward, terminated, truncated: false, info })
    }

    fn spaces(&self) -> (Space, Space) {
        (Space::discrete((SIDE * SIDE) as u64), Space::discrete(HEADINGS as u64))
    }
}

fn flat(at: Point2) -> Point3 {
    Point3::new(at.x, at.y, 0.0)
}
