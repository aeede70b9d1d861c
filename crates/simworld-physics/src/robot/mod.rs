//! Robots of any build: links on joints with motors of limited torque, described by hand or read from files.
//!
//! [`RobotDescription`] is the data, [`PhysicsDynamics::add_robot`](crate::PhysicsDynamics::add_robot) makes a body of it, and
//! [`Robot`] is where its joints are led and read. Files are read by the modules `urdf` and `mjcf` (features of these names); `mjcf` writes them
//! as well.

mod articulation;
mod description;
mod error;
#[cfg(any(feature = "urdf", feature = "mjcf"))]
mod import;
mod looks;
mod meeting;
#[cfg(feature = "mjcf")]
mod mjcf_write;
mod motor;
mod physics_body;
mod solids;
mod surface;
mod tree;
mod visual;

use std::collections::BTreeMap;
use std::sync::Arc;

use serde::{Deserialize, Serialize};
use simworld_core::action::{Action, ActionSet};
use simworld_core::geometry::Pose;
use simworld_core::hash::StateHasher;
use simworld_core::id::EntityId;
use simworld_core::seam::{BodyState, Embodiment, EmbodimentError};

use articulation::{Links, Sensed, lowest};
pub use description::{
    Base, Form, JointDescription, JointKind, LinkDescription, LinkSolid, MOST_CORNERS, MOST_JOINTS,
    MOST_LINKS, MOST_SOLIDS, RobotDescription,
};
pub use error::RobotError;
#[cfg(feature = "mjcf")]
pub use import::mjcf;
#[cfg(feature = "urdf")]
pub use import::urdf;
#[cfg(any(feature = "urdf", feature = "mjcf"))]
pub use import::{ImportLimits, ImportOptions, Imported, Note};
use looks::Looks;
use meeting::Meeting;
use motor::Motor;
pub use surface::Surface;
use tree::Tree;
pub use visual::{LinkVisual, VisualForm};

use crate::apart::Apart;
pub use crate::apart::Kinds;
use crate::error::{PhysicsError, check_range};
use crate::joint::{JointCommand, JointReading};

/// A robot and how it starts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RobotConfig {
    /// Its links and joints.
    pub description: RobotDescription,
    /// Where joints are at the start, by name, rad or m; others are at 0, or at the end of their way that is nearest to it.
    pub positions: BTreeMap<String, f64>,
    /// How high the frame of its first link is above the place of the entity, m, -1e4 to 1e4; by default it stands on its
    /// lowest point if it moves freely, and at 0 if it is fixed.
    pub height: Option<f64>,
    /// The longest substep, s, 1e-4 to 0.0051: for all bodies of the world while it is among them.
    pub substep: f64,
    /// Whether its motors carry its weight beside what they are told.
    pub weight: Weight,
}

/// Who carries what hangs on the joints.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Weight {
    /// Nobody but what the motors are told.
    #[default]
    Felt,
    /// The motors, as far as they can, as if the first link were held: for arms on a fixed base.
    Carried,
}

impl Default for RobotConfig {
    fn default() -> Self {
        Self {
            description: RobotDescription::default(),
            positions: BTreeMap::new(),
            height: None,
            substep: 1.0 / 500.0,
            weight: Weight::Felt,
        }
    }
}

impl From<RobotDescription> for RobotConfig {
    fn from(description: RobotDescription) -> Self {
        Self { description, ..Self::default() }
    }
}

/// A robot under the laws of mechanics.
///
/// Its joints do what they are told one by one ([`command`](Self::command)), within what their motors give; a joint that was
/// told nothing is limp. What can be read is as of the end of the last substep.
/// [`PhysicsDynamics::body_as_mut`](crate::PhysicsDynamics::body_as_mut) gives it out. Joints are counted as
/// [`joint_names`](Self::joint_names) has them: those that move, each after those that it hangs on.
///
/// The entity's frame is `height` below that of the first link, and moves with it. Links meet one another but for those on one
/// joint, and others that the [description](RobotDescription::apart) sets apart.
#[derive(Clone, Debug)]
pub struct Robot {
    config: RobotConfig,
    tree: Tree,
    meeting: Meeting,
    /// What the engine asks about its solids, if it has to.
    apart: Option<Arc<Apart>>,
    motors: Vec<Motor>,
    /// Of the configuration: a saved state is taken up by the same robot alone.
    digest: u64,
    root_from_entity: Pose,
    id: Option<EntityId>,
    state: BodyState,
    motion: Motion,
    looks: Looks,
}

/// Everything about a robot that changes and is not in its [`BodyState`].
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Motion {
    /// Its parts in the engine; none while it is carried, or was just put somewhere.
    links: Option<Links>,
    sensed: Sensed,
    /// What the joints are told.
    commands: Vec<JointCommand>,
    torques: Vec<f64>,
    /// Where the frames of its parts stand in the world.
    poses: Vec<Pose>,
}

impl Robot {
    /// A robot in a state, which is that of its entity.
    ///
    /// # Errors
    /// A description that is no robot, a setting out of range, or a position of a joint that is not there.
    pub fn new(state: BodyState, config: RobotConfig) -> Result<Self, PhysicsError> {
        let tree = Tree::of(&config.description)?;
        let meeting = Meeting::of(&config.description, &tree)?;
        let apart = meeting.is_asked.then(|| Arc::new(meeting.apart.clone()));
        check_range("RobotConfig", "substep", config.substep, 1e-4..=0.0051, "1e-4 to 0.0051 s")?;
        let positions = start_positions(&config, &tree)?;
        let height = match (config.height, config.description.base) {
            (Some(height), _) => height,
            (None, Base::Fixed) => 0.0,
            (None, Base::Free) => -lowest(&config.description, &tree, &positions).unwrap_or(0.0),
        };
        check_range("RobotConfig", "height", height, -1e4..=1e4, "-1e4 to 1e4 m")?;
        let motors: Vec<Motor> =
            tree.hinges().map(|(_, hinge)| Motor::of(&config.description.joints[hinge.joint])).collect();
        let saved = postcard::to_allocvec(&config).expect("plain numbers always serialise");
        let digest = StateHasher::new().bytes(&saved).finish().0;
        let lift = Pose::translation(0.0, 0.0, height);
        let count = positions.len();
        let sensed = Sensed {
            positions,
            speeds: vec![0.0; count],
            inertias: vec![0.0; count],
            loads: vec![0.0; count],
        };
        let (commands, torques) = (vec![JointCommand::default(); count], vec![0.0; count]);
        let poses = tree.poses(&sensed.positions);
        let poses = poses.into_iter().map(|pose| state.pose * lift * pose).collect();
        let motion = Motion { links: None, sensed, commands, torques, poses };
        let root_from_entity = lift.inverse();
        let looks = Looks::of(&config.description, &tree);
        Ok(Self {
            config,
            tree,
            meeting,
            apart,
            motors,
            digest,
            root_from_entity,
            id: None,
            state,
            motion,
            looks,
        })
    }

    /// Its data.
    pub fn config(&self) -> &RobotConfig {
        &self.config
    }

    /// The joints that move, by name, in the order in which they are counted.
    pub fn joint_names(&self) -> impl Iterator<Item = &str> {
        self.tree.hinges().map(|(_, hinge)| self.config.description.joints[hinge.joint].name.as_str())
    }

    /// The number of a joint.
    pub fn joint(&self, name: &str) -> Option<usize> {
        self.joint_names().position(|known| known == name)
    }

    /// The joints as they are.
    pub fn readings(&self) -> impl Iterator<Item = JointReading> {
        let Sensed { positions, speeds, .. } = &self.motion.sensed;
        let joints = positions.iter().zip(speeds).zip(&self.motion.torques);
        joints.map(|((angle, speed), torque)| JointReading { angle: *angle, speed: *speed, torque: *torque })
    }

    /// One joint as it is.
    pub fn reading(&self, joint: usize) -> Option<JointReading> {
        self.readings().nth(joint)
    }

    /// The inertia that a joint feels with all others free, kg m² or kg; 0 before the first step.
    pub fn inertia(&self, joint: usize) -> Option<f64> {
        self.motion.sensed.inertias.get(joint).copied()
    }

    /// The torque or force that holds up what a joint carries, N m or N, as if the first link were held.
    pub fn load(&self, joint: usize) -> Option<f64> {
        self.motion.sensed.loads.get(joint).copied()
    }

    /// Tells the motor of a joint what to do from now on.
    ///
    /// # Errors
    /// No such joint, or a number that is not finite.
    pub fn command(&mut self, joint: usize, command: JointCommand) -> Result<(), RobotError> {
        let count = self.motion.commands.len();
        let unknown = RobotError::Unknown {
            place: format!("a command to a robot of {count} joints"),
            kind: "joint",
            name: joint.to_string(),
        };
        let told = self.motion.commands.get_mut(joint).ok_or(unknown)?;
        if !command.is_finite() {
            let (place, value) = (format!("a command to joint {joint}"), f64::NAN);
            return Err(RobotError::Value { place, field: "part of it", value, allowed: "finite numbers" });
        }
        *told = command;
        Ok(())
    }

    /// A command that brings a joint to a position and holds it there without swinging over, so stiffly that alone it would
    /// swing so many times a second, Hz.
    pub fn servo(&self, joint: usize, position: f64, hertz: f64) -> JointCommand {
        let pace = std::f64::consts::TAU * hertz;
        let inertia = self.inertia(joint).unwrap_or(0.0);
        let (stiffness, damping) = (inertia * pace * pace, 2.0 * inertia * pace);
        JointCommand { angle: position, stiffness, damping, ..JointCommand::default() }
    }

    /// Where the frame of a link stands in the world.
    pub fn link_pose(&self, link: &str) -> Option<Pose> {
        let (part, part_from_link) = self.place_of(link)?;
        Some(self.motion.poses.get(part)? * part_from_link)
    }

    /// Where the frame of a link would stand in that of the first link, with the joints at such positions.
    pub fn link_pose_at(&self, link: &str, positions: &[f64]) -> Option<Pose> {
        let (part, part_from_link) = self.place_of(link)?;
        Some(self.tree.poses(positions).get(part)? * part_from_link)
    }

    /// Which of its solids meet, if the engine has to ask.
    pub(crate) fn apart(&self) -> Option<&Arc<Apart>> {
        self.apart.as_ref()
    }

    fn place_of(&self, link: &str) -> Option<(usize, Pose)> {
        let place = self.config.description.links.iter().position(|known| known.name == link)?;
        self.tree.links.get(place).copied()
    }
}

fn start_positions(config: &RobotConfig, tree: &Tree) -> Result<Vec<f64>, PhysicsError> {
    let joints = &config.description.joints;
    for (name, position) in &config.positions {
        let moves = |joint: &JointDescription| joint.name == *name && joint.kind != JointKind::Fixed;
        if !joints.iter().any(moves) {
            let place = "RobotConfig.positions".to_owned();
            return Err(RobotError::Unknown { place, kind: "joint that moves", name: name.clone() }.into());
        }
        check_range("RobotConfig", "positions", *position, -1e4..=1e4, "-1e4 to 1e4 rad or m")?;
    }
    let wished = |joint: &JointDescription| config.positions.get(&joint.name).copied().unwrap_or(0.0);
    Ok(tree.positions(&config.description, wished))
}

impl Embodiment for Robot {
    fn supports(&self) -> ActionSet {
        ActionSet::NONE
    }

    fn apply(&mut self, action: &Action) -> Result<(), EmbodimentError> {
        let supported = "be led joint by joint".to_owned();
        Err(EmbodimentError::Unsupported { action: action.kind(), supported })
    }

    fn state(&self) -> BodyState {
        self.state
    }

    fn save(&self) -> Vec<u8> {
        postcard::to_allocvec(&("robot", self.digest, self.id, &self.motion))
            .expect("plain numbers always serialise")
    }

    fn restore(&mut self, state: &BodyState, saved: &[u8]) -> bool {
        match postcard::from_bytes::<(&str, u64, Option<EntityId>, Motion)>(saved) {
            Ok(("robot", digest, id, motion)) if digest == self.digest => {
                (self.id, self.state, self.motion) = (id, *state, motion);
                true
            }
            _ => false,
        }
    }
}
