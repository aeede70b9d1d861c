//! What the server of a city does behind its command line: the city with its traffic, bodies for what clients bring, and a
//! renderer for their cameras.

mod bodies;
mod eye;

use std::path::PathBuf;

pub use bodies::BroughtBodies;
pub use eye::RenderEye;
use serde::{Deserialize, Serialize};
use simworld_agents::scenes::file::{SceneFile, SceneFileError};
use simworld_citygen::{City, CityConfig, CityError};
use simworld_core::asset::{AssetError, Catalogue};
use simworld_core::clock::{Clock, ClockError};
use simworld_core::record::{Divergence, Recording};
use simworld_core::scene::{Scene, World, WorldError};
use simworld_core::seed::Seed;
use simworld_core::simulation::{Simulation, SimulationError};
use simworld_physics::PhysicsError;
use simworld_traffic::{TrafficConfig, TrafficDynamics, TrafficError};
use thiserror::Error;

use crate::written::Written;

/// Which city is served.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CitySettings {
    /// Seed of the city and its traffic.
    pub seed: u64,
    /// Roads of the city.
    pub roads: u32,
    /// The text of a scene that is written by hand, in place of a city of so many roads.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scene: Option<String>,
    /// Vehicles of its traffic.
    pub vehicles: u32,
    /// Pedestrians of its traffic.
    pub pedestrians: u32,
    /// Length of a step, µs.
    pub step_microseconds: u64,
}

/// A session as a file: which city, and what clients did in it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Session {
    /// Which city.
    pub settings: CitySettings,
    /// What clients did, and the digest after every step.
    pub recording: Recording,
}

/// Why a city cannot be served, or a session not be replayed.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ServedError {
    /// No city.
    #[error(transparent)]
    City(#[from] CityError),
    /// No scene.
    #[error(transparent)]
    Scene(#[from] SceneFileError),
    /// No step of that length.
    #[error(transparent)]
    Clock(#[from] ClockError),
    /// The world refused something of the city.
    #[error(transparent)]
    World(#[from] WorldError),
    /// An asset that is none.
    #[error(transparent)]
    Asset(#[from] AssetError),
    /// No traffic.
    #[error(transparent)]
    Traffic(#[from] TrafficError),
    /// No physics.
    #[error(transparent)]
    Physics(#[from] PhysicsError),
    /// The world could not go on.
    #[error(transparent)]
    Step(#[from] SimulationError),
    /// The file of a session cannot be read or written.
    #[error("{path}: {source}")]
    File {
        /// Which.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// The file of a session is none.
    #[error("{path} is no session: {source}")]
    Session {
        /// Which.
        path: PathBuf,
        /// Why.
        source: serde_json::Error,
    },
    /// The replay went another way.
    #[error(transparent)]
    Divergence(#[from] Divergence),
}

/// The city as a simulation: traffic on its streets, and a body for whatever clients bring that moves.
///
/// # Errors
/// A setting out of range.
pub fn simulation(settings: &CitySettings) -> Result<Simulation, ServedError> {
    let clock = Clock::new(settings.step_microseconds)?;
    if let Some(text) = &settings.scene {
        let written = Written::of(SceneFile::parse(text)?, clock)?;
        return simulation_of(written.loaded.world, settings);
    }
    let mut world = World::with_clock(clock);
    let seed = Seed(settings.seed).stream("city").seed();
    let city = City::generate(&CityConfig::with_roads(settings.roads), seed)?;
    city.populate(&mut world)?;
    simulation_of(world, settings)
}

/// The same of a world that is there already; without streets it has no traffic.
///
/// # Errors
/// A setting out of range.
pub fn simulation_of(mut world: World, settings: &CitySettings) -> Result<Simulation, ServedError> {
    for (_, asset) in Catalogue::standard().iter() {
        // The city has its own make of some things; those stay.
        let is_there = world.assets().is_some_and(|own| own.find(&asset.name).is_some());
        if !is_there {
            world.add_asset(asset.clone())?;
        }
    }
    let (vehicles, pedestrians) = (settings.vehicles, settings.pedestrians);
    let config = TrafficConfig { vehicles, pedestrians, ..TrafficConfig::default() };
    let seed = Seed(settings.seed).stream("traffic").seed();
    let has_streets = world.roads().is_some();
    let traffic = has_streets.then(|| TrafficDynamics::new(&mut world, &config, seed)).transpose()?;
    let mut simulation = Simulation::new(world);
    if let Some(traffic) = traffic {
        simulation.add_dynamics("traffic", Box::new(traffic));
    }
    simulation.add_dynamics("bodies", Box::new(BroughtBodies::new()?));
    Ok(simulation)
}

/// Runs a session again without its clients, and confirms every digest; gives the number of steps.
///
/// # Errors
/// The city cannot be made or stepped, or the replay goes another way.
pub fn replay(session: &Session) -> Result<u64, ServedError> {
    let mut simulation = simulation(&session.settings)?;
    simulation.set_trail_interval(1);
    let mut steps = 0;
    for (tick, _) in &session.recording.trail {
        for command in session.recording.commands_at(simulation.world().clock().tick()) {
            simulation.submit(command.clone());
        }
        simulation.step()?;
        steps += 1;
        if let Some((_, digest)) = simulation.recording().trail.last() {
            session.recording.confirm(*tick, *digest)?;
        }
    }
    Ok(steps)
}
