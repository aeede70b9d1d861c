//! A quadruped on twelve motors: what it is, what it is told and what it tells.
//!
//! `articulation` is its body in the engine, `control` leads it, by `gait`, `balance` and `kinematics`, and `recovery` brings
//! it back on its feet. `elsewhere` lends that control to bodies in other engines.

mod articulation;
mod balance;
mod control;
mod description;
mod elsewhere;
mod gait;
mod kinematics;
mod meeting;
mod model;
mod physics_body;
mod readings;
mod recovery;
mod stride;

use std::sync::Arc;

use serde::{Deserialize, Serialize};
use simworld_core::action::{Action, ActionSet};
use simworld_core::geometry::{Pose, Vector3};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityRef, FallCause, Footing};
use simworld_core::seam::{BodyState, Embodiment, EmbodimentError};

use articulation::Links;
use control::Walk;
pub use elsewhere::QuadrupedControl;
pub use model::QuadrupedModel;
pub use readings::{Command, ImuReading, QuadrupedState, Readings};
use recovery::Task;
use stride::Stride;

use crate::apart::Apart;
use crate::body::Detail;
use crate::error::{PhysicsError, check_range};
use crate::humanoid::{Humanoid, HumanoidConfig};
use crate::joint::JointCommand;

/// The legs of a quadruped in the order in which they are counted everywhere.
pub const LEGS: [&str; 4] = ["front left", "front right", "rear left", "rear right"];

/// The rhythm of a trot.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct GaitParameters {
    /// Cycles of two steps in a second, Hz, 1 to 5. Robots of this size trot with 2 to 3.
    pub frequency: f64,
    /// Share of the cycle in which a foot stands, 0.5 to 0.8.
    pub duty: f64,
    /// How high a foot swings over the higher end of its way, m, 0.02 to 0.2.
    pub apex: f64,
}

impl Default for GaitParameters {
    fn default() -> Self {
        Self { frequency: 2.5, duty: 0.55, apex: 0.08 }
    }
}

/// How a quadruped is built and moves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct QuadrupedConfig {
    /// Lengths, masses and motors.
    pub model: QuadrupedModel,
    /// The trot.
    pub gait: GaitParameters,
    /// The greatest speeds on its legs, forward and aside, m/s, and of turning, rad/s, 0 to 3 each; faster orders are carried
    /// out at these.
    pub speeds: [f64; 3],
    /// How it moves in reduced detail, as a cylinder that is led over the ground.
    pub reduced: HumanoidConfig,
}

impl Default for QuadrupedConfig {
    fn default() -> Self {
        Self {
            model: QuadrupedModel::default(),
            gait: GaitParameters::default(),
            speeds: [1.0, 0.4, 1.2],
            reduced: HumanoidConfig::dog(),
        }
    }
}

impl QuadrupedConfig {
    /// Checks every field.
    ///
    /// # Errors
    /// The first field out of range, with what is allowed.
    pub fn validate(&self) -> Result<(), PhysicsError> {
        let check =
            |field, value, range, allowed| check_range("QuadrupedConfig", field, value, range, allowed);
        self.model.validate()?;
        check("gait.frequency", self.gait.frequency, 1.0..=5.0, "1 to 5 Hz")?;
        check("gait.duty", self.gait.duty, 0.5..=0.8, "0.5 to 0.8")?;
        check("gait.apex", self.gait.apex, 0.02..=0.2, "0.02 to 0.2 m")?;
        for speed in self.speeds {
            check("speeds", speed, 0.0..=3.0, "0 to 3 m/s and rad/s")?;
        }
        self.reduced.validate()
    }
}

/// A robot dog on legs: a trunk and twelve links on hinges with motors of limited torque, under the laws of mechanics.
///
/// In full detail it stands, trots, looks up and down, lies down, falls, turns over and stands up by torques alone. In reduced
/// detail it is the cylinder that [`add_dog`](crate::PhysicsDynamics::add_dog) makes. The physics chooses by the distance from
/// what is of interest ([`PhysicsDynamics::set_interest`](crate::PhysicsDynamics::set_interest)).
///
/// Beside the actions of dogs it takes a [`Command`], and its joints can be led one by one
/// ([`control_joints`](Self::control_joints)); [`PhysicsDynamics::body_as_mut`](crate::PhysicsDynamics::body_as_mut) gives it
/// out. The frame of the entity is where its soles are when it stands, and moves with the trunk.
#[derive(Clone, Debug)]
pub struct Quadruped {
    config: QuadrupedConfig,
    /// Its reduced form, which also keeps what is left of its orders.
    cheap: Humanoid,
    id: Option<EntityId>,
    state: BodyState,
    motion: Motion,
}

/// Everything about a quadruped that changes and is not in its [`BodyState`].
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Motion {
    /// Its legs in the engine; none in reduced detail.
    links: Option<Links>,
    /// The detail that was asked for last.
    detail: Detail,
    task: Task,
    walk: Walk,
    /// Whether the legs are new.
    is_fresh: bool,
    /// A command that stands until another one.
    command: Option<Command>,
    /// Orders for the joints, as long as they are led one by one.
    joints: Option<[[JointCommand; 3]; 4]>,
    /// How far it looks up, radians.
    look: f64,
    /// Whether it is to lie.
    lies: bool,
    /// Whether it has not stood since it fell.
    is_down: bool,
    readings: Readings,
    /// Velocity of the trunk at the start of the last substep, m/s.
    before: Vector3,
    /// How its legs swing while it is led over the ground.
    stride: Stride,
    /// For how long it still remembers a blow, s.
    shaken: f64,
    news: News,
}

/// What it has to tell at the end of the step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
struct News {
    fell: Option<FallCause>,
    got_up: bool,
}

impl Quadruped {
    /// A quadruped that stands at a pose; its tilt is ignored.
    ///
    /// # Errors
    /// A setting out of range.
    pub fn new(pose: Pose, config: QuadrupedConfig) -> Result<Self, PhysicsError> {
        config.validate()?;
        let cheap = Humanoid::new(pose, config.reduced.clone())?;
        let state = cheap.state();
        Ok(Self { config, cheap, id: None, state, motion: Motion::default() })
    }

    /// A quadruped at the pose of an entity, which is as wide and as high in reduced detail as the entity's shape.
    ///
    /// # Errors
    /// A setting out of range, or a shape that is no upright body.
    pub fn of(entity: &EntityRef<'_>, config: QuadrupedConfig) -> Result<Self, PhysicsError> {
        config.validate()?;
        let cheap = Humanoid::of(entity, config.reduced.clone())?;
        let state = BodyState { pose: cheap.state().pose, twist: *entity.twist };
        Ok(Self { config, cheap, id: Some(entity.id), state, motion: Motion::default() })
    }

    /// Its data.
    pub fn config(&self) -> &QuadrupedConfig {
        &self.config
    }

    /// Whether it is on its legs: in full detail, and neither carried nor just put somewhere.
    pub fn is_on_legs(&self) -> bool {
        self.motion.links.is_some()
    }

    /// Goes as commanded from now on, until another command or an action that moves it; values beyond what it can do are
    /// carried out as far as it can.
    pub fn command(&mut self, command: Command) {
        self.motion.command = Some(command);
        self.motion.lies = false;
    }

    /// Lies down on folded legs, and stays so until [`stand_up`](Self::stand_up) or an order to move.
    pub fn lie_down(&mut self) {
        self.motion.lies = true;
        self.motion.command = None;
    }

    /// Stands up if it lies.
    pub fn stand_up(&mut self) {
        self.motion.lies = false;
    }

    /// Leads the joints one by one from now on, legs as in [`LEGS`]; balance, orders and getting up rest meanwhile.
    ///
    /// # Errors
    /// A number that is not finite.
    pub fn control_joints(&mut self, joints: [[JointCommand; 3]; 4]) -> Result<(), PhysicsError> {
        for joint in joints.as_flattened() {
            if !joint.is_finite() {
                let value = f64::NAN;
                let allowed = "finite numbers";
                return Err(PhysicsError::Config { config: "JointCommand", field: "joint", value, allowed });
            }
        }
        self.motion.joints = Some(joints);
        Ok(())
    }

    /// Gives the joints back to its own control: it stands, or gets up first.
    pub fn release_joints(&mut self) {
        if self.motion.joints.take().is_some() {
            self.motion.is_fresh = true;
        }
    }

    /// Joints, feet and inertial measuring unit; at rest at the origin while it is not on its legs.
    pub fn readings(&self) -> &Readings {
        &self.motion.readings
    }

    /// Which of its solids meet, if the engine has to ask.
    pub(crate) fn apart(&self) -> Option<Arc<Apart>> {
        self.config.model.apart()
    }

    /// How it fares on its feet.
    pub fn footing(&self) -> Footing {
        if self.is_on_legs() { self.footing_of_task() } else { self.cheap.footing() }
    }

    /// Height of the trunk over the plane under its feet, m.
    pub fn trunk_height(&self) -> f64 {
        let height = self.config.model.standing_height();
        let trunk = (self.state.pose * nalgebra::Point3::new(0.0, 0.0, height)).coords;
        trunk.z - self.motion.walk.gait.height_below(&trunk) + self.config.model.foot_radius
    }
}

impl Embodiment for Quadruped {
    fn supports(&self) -> ActionSet {
        ActionSet::dog()
    }

    fn apply(&mut self, action: &Action) -> Result<(), EmbodimentError> {
        if !self.supports().contains(action.kind()) {
            return Err(EmbodimentError::unsupported(action.kind(), self.supports()));
        }
        self.cheap.apply(action)?;
        match action {
            Action::LookUp { angle } => self.motion.look = (self.motion.look + angle).clamp(-0.4, 0.4),
            Action::LookDown { angle } => self.motion.look = (self.motion.look - angle).clamp(-0.4, 0.4),
            Action::TakePhoto | Action::Focus { .. } => {}
            _ => {
                self.motion.command = None;
                self.motion.lies = false;
            }
        }
        Ok(())
    }

    fn state(&self) -> BodyState {
        self.state
    }

    fn save(&self) -> Vec<u8> {
        let Self { config, cheap, id, motion, .. } = self;
        postcard::to_allocvec(&("quadruped", config, cheap.save(), id, motion))
            .expect("plain numbers always serialise")
    }

    fn restore(&mut self, state: &BodyState, saved: &[u8]) -> bool {
        type Saved<'a> = (&'a str, QuadrupedConfig, Vec<u8>, Option<EntityId>, Motion);
        match postcard::from_bytes::<Saved<'_>>(saved) {
            Ok(("quadruped", config, cheap, id, motion))
                if config.validate().is_ok() && self.cheap.restore(state, &cheap) =>
            {
                (self.config, self.id, self.state, self.motion) = (config, id, *state, motion);
                true
            }
            _ => false,
        }
    }
}
