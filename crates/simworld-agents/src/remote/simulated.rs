//! A simulation as a stage, with the record of what its clients did.

use simworld_core::clock::Tick;
use simworld_core::command::{Applied, Command};
use simworld_core::event::Event;
use simworld_core::hash::StateDigest;
use simworld_core::record::{Recording, Stamped};
use simworld_core::scene::Scene;
use simworld_core::simulation::Simulation;

use super::{Picture, PictureKind, Stage, StageError, View};

/// What draws pictures of a scene.
pub trait Eye {
    /// Draws what a camera sees.
    ///
    /// # Errors
    /// It cannot be drawn.
    fn picture(&mut self, scene: &dyn Scene, view: &View, kind: PictureKind) -> Result<Picture, StageError>;
}

/// A [`Simulation`] to be served.
///
/// A command opens the next step and takes effect in it at once; the rest of that step runs when the world steps. Replaying
/// the recording on the simulation as it was at the start goes through the same states.
pub struct SimulationStage {
    simulation: Simulation,
    eye: Option<Box<dyn Eye>>,
    commands: Vec<Stamped>,
    /// Whether the next step has begun, because a command took effect in it.
    is_open: bool,
}

impl SimulationStage {
    /// A stage without pictures. From now on the simulation records its digest after every step.
    pub fn new(mut simulation: Simulation) -> Self {
        simulation.set_trail_interval(1);
        Self { simulation, eye: None, commands: Vec::new(), is_open: false }
    }

    /// With something that draws its pictures.
    #[must_use]
    pub fn seen_by(mut self, eye: Box<dyn Eye>) -> Self {
        self.eye = Some(eye);
        self
    }

    /// The simulation.
    pub fn simulation(&self) -> &Simulation {
        &self.simulation
    }

    /// What clients did, and the digest after every step.
    pub fn recording(&self) -> Recording {
        Recording { commands: self.commands.clone(), trail: self.simulation.recording().trail.clone() }
    }

    /// Begins the next step, unless it has begun.
    fn open(&mut self) {
        if !self.is_open {
            self.simulation.begin_step();
            self.is_open = true;
        }
    }
}

impl Stage for SimulationStage {
    fn scene(&self) -> &dyn Scene {
        self.simulation.world()
    }

    fn revision(&self) -> u64 {
        self.simulation.world().revision()
    }

    fn apply(&mut self, command: Command) -> Result<Applied, StageError> {
        self.open();
        let tick = self.simulation.world().clock().tick();
        let applied = self.simulation.apply(&command)?;
        self.commands.push(Stamped { tick, command });
        Ok(applied)
    }

    fn step(&mut self) -> Result<(), StageError> {
        self.open();
        self.is_open = false;
        self.simulation.finish_step().map_err(|error| StageError::Step(error.to_string()))
    }

    fn events(&self) -> &[Event] {
        self.simulation.world().events()
    }

    fn digest(&self) -> Option<(Tick, StateDigest)> {
        self.simulation.recording().trail.last().copied()
    }

    fn picture(&mut self, view: &View, kind: PictureKind) -> Result<Picture, StageError> {
        let eye = self.eye.as_mut().ok_or(StageError::Blind)?;
        eye.picture(self.simulation.world(), view, kind)
    }
}
