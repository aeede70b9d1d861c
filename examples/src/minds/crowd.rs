//! A city full of people with plans.

use std::cell::Cell;
use std::rc::Rc;
use std::sync::Arc;
use std::time::{Duration, Instant};

use simworld_agents::episode::{Agent, Episode, EpisodeError};
use simworld_agents::executor::RuleExecutor;
use simworld_agents::language::GrammarPlanner;
use simworld_agents::mind::Mind;
use simworld_citygen::{City, CityConfig, CityError};
use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::hash::StateHasher;
use simworld_core::id::EntityId;
use simworld_core::net::{NetworkError, WaypointConfig, WaypointGraph};
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World, WorldError};
use simworld_core::seam::{
    Dynamics, DynamicsError, Metric, Outcome, Task, TaskContext, TaskError, TaskOutput,
};
use simworld_core::seed::Seed;
use simworld_core::simulation::Simulation;
use simworld_physics::{HumanoidConfig, PhysicsConfig, PhysicsDynamics, PhysicsError};
use thiserror::Error;

/// Why there is no crowd.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum CrowdError {
    /// No city.
    #[error(transparent)]
    City(#[from] CityError),
    /// No walkways.
    #[error(transparent)]
    Network(#[from] NetworkError),
    /// The world refused an entity.
    #[error(transparent)]
    World(#[from] WorldError),
    /// No bodies.
    #[error(transparent)]
    Physics(#[from] PhysicsError),
    /// The episode could not begin.
    #[error(transparent)]
    Episode(#[from] EpisodeError),
}

/// A task that asks for nothing: people do what they want, as long as they want.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Promenade;

impl Task for Promenade {
    fn reset(&mut self, _: &dyn Scene, _: &[EntityId], _: Seed, _: &mut TaskOutput) -> Result<(), TaskError> {
        Ok(())
    }

    fn step(&mut self, _: &TaskContext<'_>, _: &mut TaskOutput, _: &mut Outcome) -> Result<(), TaskError> {
        Ok(())
    }

    fn metrics(&self) -> Vec<Metric> {
        Vec::new()
    }
}

/// What moves people.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bodies {
    /// Physics, each with a body of its own.
    Physical,
    /// Nothing.
    None,
}

/// Time that was spent in a part, shared with whoever reads it.
pub type Spent = Rc<Cell<Duration>>;

/// People on the walkways of a city, out of one another's way.
pub struct Crowd {
    /// The world with all of them, and what moves them.
    pub simulation: Simulation,
    /// The people.
    pub people: Vec<EntityId>,
    /// The walkways.
    pub ways: Arc<WaypointGraph>,
    /// What the bodies took so far.
    pub bodies: Spent,
}

impl Crowd {
    /// So many people in a city of so many streets.
    ///
    /// # Errors
    /// A part cannot be made.
    pub fn new(people: usize, streets: u32, bodies: Bodies, seed: Seed) -> Result<Self, CrowdError> {
        let city = City::generate(&CityConfig::with_roads(streets), seed)?;
        let mut world = World::new();
        city.populate(&mut world)?;
        let ways = Arc::new(WaypointGraph::walkable(&city.network, &WaypointConfig::default())?);
        let spots = spots(&ways, people, seed);
        let mut ids = Vec::with_capacity(people);
        for (index, spot) in spots.into_iter().enumerate() {
            let pose = pose_facing(spot, index as f64);
            let shape = Shape::Capsule { radius: 0.25, height: 1.75 };
            ids.push(world.spawn(EntityDesc::new(EntityKind::Person, pose, shape))?);
        }
        let spent = Spent::default();
        let physics = (bodies == Bodies::Physical).then(|| physics_of(&world, &ids)).transpose()?;
        let mut simulation = Simulation::new(world);
        if let Some(inner) = physics {
            simulation.add_dynamics("physics", Box::new(Timed { inner, spent: Rc::clone(&spent) }));
        }
        simulation.set_trail_interval(0);
        Ok(Self { simulation, people: ids, ways, bodies: spent })
    }

    /// The episode in which each has the mind that `mind` makes for its index.
    ///
    /// # Errors
    /// The episode cannot begin.
    pub fn episode<M: Mind<Promenade> + 'static>(
        self,
        mind: impl Fn(usize) -> M,
    ) -> Result<Episode<Promenade>, CrowdError> {
        let agent = |(index, id): (usize, &EntityId)| Agent {
            id: *id,
            mind: Box::new(mind(index)) as Box<dyn Mind<Promenade>>,
            planner: Box::new(GrammarPlanner::default()),
            executor: Box::new(RuleExecutor::new(Arc::clone(&self.ways))),
        };
        let agents = self.people.iter().enumerate().map(agent).collect();
        let mut episode = Episode::new(self.simulation, Promenade, agents, Seed(1))?;
        episode.set_trail_interval(0);
        Ok(episode)
    }
}

/// A body for each.
fn physics_of(world: &World, people: &[EntityId]) -> Result<PhysicsDynamics, PhysicsError> {
    let mut physics = PhysicsDynamics::new(PhysicsConfig::default())?;
    for id in people {
        physics.add_humanoid(world, *id, HumanoidConfig::default())?;
    }
    Ok(physics)
}

/// Places on the walkways, drawn without putting one back; when all are taken, beside those that are.
fn spots(ways: &WaypointGraph, people: usize, seed: Seed) -> Vec<Point3> {
    let mut all: Vec<_> = (0..ways.waypoints().len()).collect();
    seed.stream("crowd/spots").rng().shuffle(&mut all);
    let count = all.len().max(1);
    let spot = |index: usize| {
        let id = simworld_core::id::WaypointId(all[index % count] as u32);
        let at = ways.waypoint(id).position;
        Point3::new(at.x + 0.7 * (index / count) as f64, at.y, 0.0)
    };
    (0..people).map(spot).collect()
}

/// Dynamics whose time is taken.
struct Timed<D> {
    inner: D,
    spent: Spent,
}

impl<D: Dynamics> Dynamics for Timed<D> {
    #[expect(clippy::disallowed_methods, reason = "measuring is what this is for")]
    fn step(&mut self, world: &mut World, dt: f64) -> Result<(), DynamicsError> {
        let start = Instant::now();
        let stepped = self.inner.step(world, dt);
        self.spent.set(self.spent.get() + start.elapsed());
        stepped
    }

    fn save(&self) -> Result<Vec<u8>, DynamicsError> {
        self.inner.save()
    }

    fn restore(&mut self, world: &World, saved: &[u8]) -> Result<(), DynamicsError> {
        self.inner.restore(world, saved)
    }

    fn state_hash(&self, hasher: &mut StateHasher) {
        self.inner.state_hash(hasher);
    }
}
