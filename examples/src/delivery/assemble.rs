//! Puts the parts together: a city, its traffic, couriers with physical bodies, and the task.

use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::Arc;

use simworld_agents::delivery::{DeliveryConfig, DeliveryTask};
use simworld_agents::episode::{Agent, Episode, EpisodeError};
use simworld_agents::executor::RuleExecutor;
use simworld_agents::language::GrammarPlanner;
use simworld_agents::mind::{Mind, Silent};
use simworld_citygen::files::save::SaveError;
use simworld_citygen::python::{FormatError, Warning, read_roads};
use simworld_citygen::{AllThreads, City, CityError};
use simworld_core::environment::EnvironmentError;
use simworld_core::geometry::{Aabb, Point2, Point3, direction, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::net::{NetworkError, WaypointConfig, WaypointGraph};
use simworld_core::scene::{EntityDesc, EntityKind, Place, Scene, Shape, World, WorldError};
use simworld_core::seam::{Dynamics, TaskError};
use simworld_core::seed::Seed;
use simworld_core::simulation::Simulation;
use simworld_physics::{HumanoidConfig, PhysicsDynamics, PhysicsError};
use simworld_traffic::{TrafficConfig, TrafficDynamics, TrafficError};
use thiserror::Error;

use super::RunConfig;
use super::bodies::CourierBodies;
use super::config::EVERYWHERE;
use super::players::{Brain, Player, players};
use super::thinkers::{ThinkError, Thinkers};

/// Why the parts do not fit together.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum AssembleError {
    /// The file of roads cannot be opened.
    #[error("{path}: {source}")]
    RoadsFile {
        /// Which file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// The file of roads cannot be read.
    #[error("{path}: {source}")]
    Roads {
        /// Which file.
        path: PathBuf,
        /// Why.
        source: FormatError,
    },
    /// The saved city cannot be loaded.
    #[error("{path} is no city that can be loaded: {source}; the example `city` writes one")]
    Saved {
        /// Which file.
        path: PathBuf,
        /// Why.
        source: SaveError,
    },
    /// No city.
    #[error(transparent)]
    City(#[from] CityError),
    /// No traffic.
    #[error(transparent)]
    Traffic(#[from] TrafficError),
    /// No physics.
    #[error(transparent)]
    Physics(#[from] PhysicsError),
    /// No walkways.
    #[error(transparent)]
    Network(#[from] NetworkError),
    /// Sun or weather out of range.
    #[error("environment.{0}")]
    Environment(#[from] EnvironmentError),
    /// Couriers cannot think.
    #[error(transparent)]
    Thinking(#[from] ThinkError),
    /// The world refused an entity.
    #[error(transparent)]
    World(#[from] WorldError),
    /// The task refused its settings.
    #[error(transparent)]
    Task(#[from] TaskError),
    /// The episode could not begin.
    #[error(transparent)]
    Episode(#[from] EpisodeError),
    /// Couriers have nowhere to stand.
    #[error("the city has no place where couriers could begin: give it more roads (city.roads.count)")]
    NoPlace,
}

/// A run ready to be stepped.
pub struct Assembly {
    /// The episode.
    pub episode: Episode<DeliveryTask>,
    /// The couriers' bodies.
    pub couriers: Vec<EntityId>,
    /// What thinks for those that think with a model, if it does.
    pub thinkers: Option<Thinkers>,
    /// How many of them are under physics at the start.
    pub physical: u32,
    /// The vehicles and pedestrians of the traffic at the start.
    pub traffic: Passers,
}

/// Who passes by.
#[derive(Clone, Debug, Default)]
pub struct Passers {
    /// The vehicles.
    pub vehicles: Vec<EntityId>,
    /// The pedestrians.
    pub pedestrians: Vec<EntityId>,
}

/// The city of a configuration, the same for all its seeds; and what was mended in its file of roads.
///
/// # Errors
/// The file of roads cannot be used, or a setting is out of range.
pub fn make_city(config: &RunConfig) -> Result<(City, Vec<Warning>), AssembleError> {
    if let Some(path) = &config.city_file {
        let city = City::load(path).map_err(|source| AssembleError::Saved { path: path.clone(), source })?;
        return Ok((city, Vec::new()));
    }
    let seed = Seed(config.seed).stream("city").seed();
    let Some(path) = &config.roads else { return Ok((City::generate(&config.city, seed)?, Vec::new())) };
    let bytes =
        std::fs::read(path).map_err(|source| AssembleError::RoadsFile { path: path.clone(), source })?;
    let (plan, warnings) =
        read_roads(&bytes).map_err(|source| AssembleError::Roads { path: path.clone(), source })?;
    Ok((City::from_plan(plan, &config.city, seed)?, warnings))
}

/// The run of one seed in that city; a model is that of the settings.
///
/// # Errors
/// A part that cannot be made.
pub fn assemble(config: &RunConfig, city: &City, seed: Seed) -> Result<Assembly, AssembleError> {
    let think = players(config, seed).iter().any(|player| player.policy == Brain::Model);
    let thinkers = think.then(|| Thinkers::new(&config.model, seed)).transpose()?;
    assemble_with(config, city, seed, thinkers)
}

/// The same with what thinks for those that think with a model; without it they are silent, as in a replay.
///
/// # Errors
/// A part that cannot be made.
pub fn assemble_with(
    config: &RunConfig,
    city: &City,
    seed: Seed,
    mut thinkers: Option<Thinkers>,
) -> Result<Assembly, AssembleError> {
    let mut world = World::new();
    city.populate(&mut world)?;
    world.set_environment(config.environment)?;
    let traffic_config = TrafficConfig {
        vehicles: config.vehicles,
        pedestrians: config.pedestrians,
        ..config.traffic.clone()
    };
    let mut traffic = TrafficDynamics::new(&mut world, &traffic_config, seed)?;
    if config.seeds == 1 {
        // Several seeds share the threads among them; one alone has them all, to the same bits.
        traffic.traffic_mut().set_workers(Box::new(AllThreads));
    }
    let passers =
        Passers { vehicles: traffic.vehicles().to_vec(), pedestrians: traffic.pedestrians().to_vec() };
    let couriers = spawn_couriers(&mut world, city, config.agents, seed)?;
    let (bodies, physical) = courier_bodies(config, &world, &couriers)?;
    let mut simulation = Simulation::new(world);
    simulation.add_dynamics("traffic", Box::new(traffic));
    simulation.add_dynamics("physics", bodies);
    simulation.set_trail_interval(0); // the episode keeps the trail, task and executors included
    let delivery = DeliveryConfig { steps: config.steps, ..config.delivery.clone() };
    let task = DeliveryTask::new(delivery)?;
    let agents = make_agents(config, city, &couriers, seed, thinkers.as_mut())?;
    let mut episode = Episode::new(simulation, task, agents, seed.stream("delivery").seed())?;
    episode.set_trail_interval(config.digest_interval);
    Ok(Assembly { episode, couriers, thinkers, physical, traffic: passers })
}

/// Bodies under physics, or where only some are, those that change with the place; and how many are under physics.
fn courier_bodies(
    config: &RunConfig,
    world: &World,
    couriers: &[EntityId],
) -> Result<(Box<dyn Dynamics>, u32), AssembleError> {
    if config.physical_within < EVERYWHERE {
        let (physics, radius) = (config.physics.clone(), config.physical_within);
        let bodies = CourierBodies::new(world, couriers, physics, radius)?;
        let physical = bodies.physical();
        return Ok((Box::new(bodies), physical));
    }
    let mut physics = PhysicsDynamics::new(config.physics.clone())?;
    for courier in couriers {
        physics.add_humanoid(world, *courier, HumanoidConfig::default())?;
    }
    Ok((Box::new(physics), couriers.len() as u32))
}

/// Half the width of a courier, and how much room it wants beside that where it begins, m.
const COURIER: (f64, f64) = (0.25, 0.05);
/// From one place of a row to the next, m.
const PLACE: f64 = 0.8;
/// So many places of a row are tried.
const MOST_PLACES: usize = 1000;

/// Couriers begin before restaurants, stores and offices, one at each door in turn, where nobody and nothing stands: shops in
/// one house may share a door.
fn spawn_couriers(
    world: &mut World,
    city: &City,
    count: u32,
    seed: Seed,
) -> Result<Vec<EntityId>, AssembleError> {
    let mut doors: Vec<_> = city
        .buildings
        .iter()
        .filter(|building| matches!(building.place, Place::Restaurant | Place::Store | Place::Office))
        .collect();
    let mut rng = seed.stream("couriers").rng();
    rng.shuffle(&mut doors);
    if doors.is_empty() {
        return Err(AssembleError::NoPlace);
    }
    let mut couriers = Vec::with_capacity(count as usize);
    for index in 0..count as usize {
        let door = doors[index % doors.len()];
        // Those who share a door stand in a row along the sidewalk.
        let along = direction(door.facing + std::f64::consts::FRAC_PI_2);
        let first = index / doors.len();
        let mut row = (first..first + MOST_PLACES).map(|place| door.access + along * (PLACE * place as f64));
        let spot = row.find(|spot| is_free(world, *spot)).ok_or(AssembleError::NoPlace)?;
        let feet = world.ground().map_or(Point3::new(spot.x, spot.y, 0.0), |ground| ground.point(spot));
        let pose = pose_facing(feet, door.facing);
        let height = rng.normal_clamped(1.74, 0.08, 1.55, 1.95);
        let shape = Shape::Capsule { radius: COURIER.0, height };
        let desc = EntityDesc::new(EntityKind::Person, pose, shape)
            .named(format!("courier {index}"))
            .colored([0.85, 0.35, 0.05]);
        couriers.push(world.spawn(desc)?);
    }
    Ok(couriers)
}

/// Whether a courier can begin there.
fn is_free(world: &World, spot: Point2) -> bool {
    let room = COURIER.0 + COURIER.1;
    let taken = world.visit(&Aabb::column_around(spot, room), &mut |entity| {
        let is_near = entity.info.shape.planar_distance(entity.pose, &spot) < room;
        if entity.is_solid() && is_near { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    taken.is_continue()
}

fn make_agents(
    config: &RunConfig,
    city: &City,
    couriers: &[EntityId],
    seed: Seed,
    mut thinkers: Option<&mut Thinkers>,
) -> Result<Vec<Agent<DeliveryTask>>, AssembleError> {
    let ways = Arc::new(WaypointGraph::walkable(&city.network, &WaypointConfig::default())?);
    let minds = seed.stream("minds");
    let players = players(config, seed);
    let mut mind = |index: usize, player: &Player| -> Result<Box<dyn Mind<DeliveryTask>>, ThinkError> {
        Ok(match (player.policy, &mut thinkers) {
            (Brain::Policy(policy), _) => policy.mind(player.persona, minds.indexed(index as u64)),
            (Brain::Model, Some(thinkers)) => Box::new(thinkers.mind(index, player.persona)?),
            (Brain::Model, None) => Box::new(Silent),
        })
    };
    let mut agents = Vec::with_capacity(couriers.len());
    for (index, (id, player)) in couriers.iter().zip(&players).enumerate() {
        agents.push(Agent {
            id: *id,
            mind: mind(index, player)?,
            planner: Box::new(GrammarPlanner::default()),
            executor: Box::new(RuleExecutor::new(Arc::clone(&ways))),
        });
    }
    Ok(agents)
}
