//! The step: commands in, dynamics, digest out.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::clock::Tick;
use crate::command::{Applied, Command, CommandError};
use crate::event::EventKind;
use crate::hash::{StateDigest, StateHash, StateHasher};
use crate::record::{Recording, Stamped};
use crate::scene::{Scene, World, WorldError, WorldSnapshot};
use crate::seam::{Dynamics, DynamicsError};

/// A world with the dynamics that move it and the record of what was done to it.
///
/// ```
/// use simworld_core::action::Action;
/// use simworld_core::command::Command;
/// use simworld_core::geometry::Pose;
/// use simworld_core::kinematic::{KinematicBody, KinematicDynamics};
/// use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
/// use simworld_core::simulation::Simulation;
///
/// let mut world = World::new();
/// let shape = Shape::Capsule { radius: 0.25, height: 1.8 };
/// let walker = world.spawn(EntityDesc::new(EntityKind::Person, Pose::identity(), shape))?;
/// let mut bodies = KinematicDynamics::new();
/// bodies.insert(walker, Box::new(KinematicBody::walker(Pose::identity())));
///
/// let mut simulation = Simulation::new(world);
/// simulation.add_dynamics("bodies", Box::new(bodies));
/// simulation.submit(Command::Actuate { who: walker, action: Action::MoveForward { speed: 1.4 } });
/// for _ in 0..10 { simulation.step()?; }
/// let walked = simulation.world().entity(walker).unwrap().position().x;
/// assert!((walked - 1.4).abs() < 1e-9); // one second east
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Simulation {
    world: World,
    dynamics: Vec<(String, Box<dyn Dynamics>)>,
    queue: Vec<Command>,
    recording: Recording,
    trail_interval: u64,
}

/// A step that could not be finished. The world keeps the state it had when the fault occurred.
#[derive(Debug, Error)]
#[error("{part} failed at tick {tick}: {source}")]
pub struct SimulationError {
    /// Which dynamics.
    pub part: String,
    /// In which step.
    pub tick: Tick,
    /// Why.
    pub source: DynamicsError,
}

/// A [`Simulation`] as data. Restore it onto the same list of dynamics, freshly made.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SimulationSnapshot {
    world: WorldSnapshot,
    queue: Vec<Command>,
    dynamics: Vec<(String, Vec<u8>)>,
}

/// A snapshot that does not fit.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RestoreError {
    /// The world itself is damaged.
    #[error(transparent)]
    World(#[from] WorldError),
    /// The snapshot was taken with other dynamics.
    #[error(
        "the snapshot holds the dynamics [{saved}], this simulation has [{present}]: build it with the same ones"
    )]
    Parts {
        /// Names in the snapshot.
        saved: String,
        /// Names here.
        present: String,
    },
    /// The dynamics refused their part.
    #[error("{part} cannot be restored: {source}")]
    Dynamics {
        /// Which.
        part: String,
        /// Why.
        source: DynamicsError,
    },
}

impl Simulation {
    /// A simulation of that world without any dynamics, which records a digest every ten steps.
    pub fn new(world: World) -> Self {
        Self {
            world,
            dynamics: Vec::new(),
            queue: Vec::new(),
            recording: Recording::default(),
            trail_interval: 10,
        }
    }

    /// Adds a part that moves the world; parts run in the order they were added.
    pub fn add_dynamics(&mut self, name: &str, dynamics: Box<dyn Dynamics>) -> &mut Self {
        self.dynamics.push((name.to_owned(), dynamics));
        self
    }

    /// Records a digest every that many steps; 1 records all, 0 none.
    pub fn set_trail_interval(&mut self, steps: u64) -> &mut Self {
        self.trail_interval = steps;
        self
    }

    /// The world as of the last finished step.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// What the outside did so far.
    pub fn recording(&self) -> &Recording {
        &self.recording
    }

    /// Asks for a change from outside: it is recorded, and takes effect at the start of the next step.
    pub fn submit(&mut self, command: Command) {
        self.queue.push(command);
    }

    /// First half of a step: forgets the last step's events and applies what was submitted. A command that is
    /// impossible becomes an event, because the one who sent it is no longer there to be told.
    pub fn begin_step(&mut self) {
        self.world.begin_step();
        let tick = self.world.clock().tick();
        for command in std::mem::take(&mut self.queue) {
            if let Err(error) = self.world.apply(&command) {
                self.world.emit(refusal(&command, &error));
            }
            self.recording.commands.push(Stamped { tick, command });
        }
    }

    /// Changes the world from inside the step, between its halves: for drivers and tasks, whose commands follow
    /// from the recorded ones and are therefore not recorded themselves.
    ///
    /// # Errors
    /// The command is impossible; then nothing has changed.
    pub fn apply(&mut self, command: &Command) -> Result<Applied, CommandError> {
        self.world.apply(command)
    }

    /// Changes the world from outside between the halves of a step, and says at once what it did: for editors, who build on
    /// what they made. The command is recorded, and a replay carries it out at the same place.
    ///
    /// # Errors
    /// The command is impossible; then nothing has changed, and nothing is recorded.
    pub fn apply_from_outside(&mut self, command: &Command) -> Result<Applied, CommandError> {
        let applied = self.world.apply(command)?;
        self.recording.commands.push(Stamped { tick: self.world.clock().tick(), command: command.clone() });
        Ok(applied)
    }

    /// Reports, from inside the step, that something happened.
    pub fn emit(&mut self, kind: EventKind) {
        self.world.emit(kind);
    }

    /// Second half of a step: runs the dynamics, advances the clock, and takes the digest if one is due.
    ///
    /// # Errors
    /// The first dynamics that failed.
    pub fn finish_step(&mut self) -> Result<(), SimulationError> {
        let tick = self.world.clock().tick();
        let dt = self.world.clock().dt();
        for (part, dynamics) in &mut self.dynamics {
            dynamics.step(&mut self.world, dt).map_err(|source| SimulationError {
                part: part.clone(),
                tick,
                source,
            })?;
        }
        self.world.finish_step();
        let now = self.world.clock().tick();
        if self.trail_interval > 0 && now.0.is_multiple_of(self.trail_interval) {
            let digest = self.digest();
            self.recording.trail.push((now, digest));
        }
        Ok(())
    }

    /// One whole step.
    ///
    /// # Errors
    /// The first dynamics that failed.
    pub fn step(&mut self) -> Result<(), SimulationError> {
        self.begin_step();
        self.finish_step()
    }

    /// The whole state as data.
    ///
    /// # Errors
    /// Dynamics that cannot be saved.
    pub fn save(&self) -> Result<SimulationSnapshot, RestoreError> {
        let part = |(name, dynamics): &(String, Box<dyn Dynamics>)| match dynamics.save() {
            Ok(bytes) => Ok((name.clone(), bytes)),
            Err(source) => Err(RestoreError::Dynamics { part: name.clone(), source }),
        };
        Ok(SimulationSnapshot {
            world: self.world.snapshot(),
            queue: self.queue.clone(),
            dynamics: self.dynamics.iter().map(part).collect::<Result<_, _>>()?,
        })
    }

    /// Goes back to a saved state; the recording starts anew.
    ///
    /// # Errors
    /// A damaged snapshot, or one of other dynamics; then the simulation must not be stepped any further.
    pub fn restore(&mut self, snapshot: SimulationSnapshot) -> Result<(), RestoreError> {
        let saved: Vec<&str> = snapshot.dynamics.iter().map(|(name, _)| name.as_str()).collect();
        let present: Vec<&str> = self.dynamics.iter().map(|(name, _)| name.as_str()).collect();
        if saved != present {
            return Err(RestoreError::Parts { saved: saved.join(", "), present: present.join(", ") });
        }
        self.world = World::restore(snapshot.world)?;
        for ((name, dynamics), (_, bytes)) in self.dynamics.iter_mut().zip(&snapshot.dynamics) {
            dynamics
                .restore(&self.world, bytes)
                .map_err(|source| RestoreError::Dynamics { part: name.clone(), source })?;
        }
        self.queue = snapshot.queue;
        self.recording = Recording::default();
        Ok(())
    }
}

impl StateHash for Simulation {
    /// The world and every dynamics' inner state.
    fn state_hash(&self, hasher: &mut StateHasher) {
        self.world.state_hash(hasher);
        for (_, dynamics) in &self.dynamics {
            dynamics.state_hash(hasher);
        }
    }

    fn digest(&self) -> StateDigest {
        let mut hasher = StateHasher::new();
        self.state_hash(&mut hasher);
        hasher.finish()
    }
}

impl std::fmt::Debug for Simulation {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let parts: Vec<&str> = self.dynamics.iter().map(|(name, _)| name.as_str()).collect();
        f.debug_struct("Simulation")
            .field("tick", &self.world.clock().tick())
            .field("entities", &self.world.len())
            .field("dynamics", &parts)
            .finish_non_exhaustive()
    }
}

fn refusal(command: &Command, error: &CommandError) -> EventKind {
    let reason = error.to_string();
    match command {
        Command::Actuate { who, action } => {
            EventKind::ActionFailed { who: *who, action: action.kind(), reason }
        }
        Command::Intend { who, .. } => EventKind::IntentRefused { who: *who, reason },
        _ => EventKind::task("command_refused", None).with("reason", reason),
    }
}
