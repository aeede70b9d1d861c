//! Commands: the only way by which the outside changes a world.
//!
//! A command takes effect at a step boundary. The log of stamped commands is the spine of recording, replay,
//! undo, scene editing and the network protocol.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::action::Action;
use crate::alteration::Alteration;
use crate::asset::Asset;
use crate::environment::{Environment, EnvironmentError};
use crate::geometry::{Pose, Twist};
use crate::id::EntityId;
use crate::intent::Intent;
use crate::net::{NetworkPatch, PatchError};
use crate::passage::{Passage, PassageError};
use crate::scene::{Attachment, EntityDesc, InteractionError, Scene, World, WorldError};
use crate::traffic::{RoadLeg, TrafficOrder};
use crate::value::Value;

/// One change asked of a world.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Command {
    /// Adds an asset to those that entities are made from. It cannot be taken back: what no entity is made from has no effect.
    AddAsset(Box<Asset>),
    /// Puts a new entity into the world.
    Spawn(Box<EntityDesc>),
    /// Puts a removed entity back under its old id.
    Respawn {
        /// The old id.
        id: EntityId,
        /// What it was.
        desc: Box<EntityDesc>,
        /// What hung on it, with its bonds.
        #[serde(default)]
        load: Vec<(EntityId, Attachment)>,
    },
    /// Takes an entity out.
    Remove {
        /// Which.
        id: EntityId,
    },
    /// Puts an entity elsewhere, at rest.
    Move {
        /// Which.
        id: EntityId,
        /// Where to.
        pose: Pose,
    },
    /// Puts an entity back where it was, with the velocity and the bond it had.
    Reset {
        /// Which.
        id: EntityId,
        /// Where to.
        pose: Pose,
        /// How it moves.
        twist: Twist,
        /// On what it hangs, if on anything.
        bond: Option<Attachment>,
    },
    /// Sets or, with `None`, removes an attribute.
    SetAttribute {
        /// Of which entity.
        id: EntityId,
        /// The attribute.
        key: String,
        /// Its new value.
        value: Option<Value>,
    },
    /// Changes what an entity is made of: shape, colour, name, whether it is seen and met.
    Alter {
        /// Which.
        id: EntityId,
        /// In what.
        alteration: Alteration,
    },
    /// Hangs an entity on a carrier or, with `None`, frees it.
    Attach {
        /// Which.
        child: EntityId,
        /// The new bond.
        bond: Option<Attachment>,
    },
    /// Sets sun and weather.
    SetEnvironment(Environment),
    /// Changes the roads.
    PatchRoads(Box<NetworkPatch>),
    /// Closes one direction of a road to traffic, or opens it.
    SetPassage {
        /// Which.
        leg: RoadLeg,
        /// Whether traffic may enter from now on.
        passage: Passage,
    },
    /// Tells a body to act.
    Actuate {
        /// Which body.
        who: EntityId,
        /// What to do.
        action: Action,
    },
    /// Says what a mind wants.
    Intend {
        /// Whose mind.
        who: EntityId,
        /// What it wants.
        intent: Intent,
    },
    /// Asks something of the traffic.
    Traffic(TrafficOrder),
}

/// Why a command had no effect; the world is as it was.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum CommandError {
    /// The store refused the change.
    #[error(transparent)]
    World(#[from] WorldError),
    /// The condition is out of range.
    #[error(transparent)]
    Environment(#[from] EnvironmentError),
    /// The roads cannot be changed so.
    #[error(transparent)]
    Roads(#[from] PatchError),
    /// The street is not there.
    #[error(transparent)]
    Passage(#[from] PassageError),
    /// The action is impossible.
    #[error(transparent)]
    Interaction(#[from] InteractionError),
}

/// What a command did.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Applied {
    /// The entity it made.
    pub spawned: Option<EntityId>,
    /// The command that takes it back; assets, actions, intents and orders to the traffic cannot be taken back.
    pub undo: Option<Command>,
}

/// What several commands did.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AppliedAll {
    /// The entities they made, in order.
    pub spawned: Vec<EntityId>,
    /// The commands that take them back, in the order in which they are to be carried out; actions and intents cannot be
    /// taken back.
    pub undo: Vec<Command>,
}

impl World {
    /// Carries out a command.
    ///
    /// ```
    /// use simworld_core::command::Command;
    /// use simworld_core::geometry::Pose;
    /// use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
    /// let mut world = World::new();
    /// let car = EntityDesc::new(EntityKind::Car, Pose::identity(), Shape::cuboid(4.5, 1.8, 1.5));
    /// let done = world.apply(&Command::Spawn(Box::new(car)))?;
    /// assert_eq!(world.len(), 1);
    /// world.apply(&done.undo.unwrap())?;
    /// assert!(world.is_empty());
    /// # Ok::<(), simworld_core::command::CommandError>(())
    /// ```
    ///
    /// # Errors
    /// The command is impossible; then nothing has changed.
    pub fn apply(&mut self, command: &Command) -> Result<Applied, CommandError> {
        let undo = match command {
            Command::AddAsset(asset) => {
                self.add_asset((**asset).clone()).map_err(WorldError::from)?;
                None
            }
            Command::Spawn(desc) => {
                let id = self.spawn((**desc).clone())?;
                return Ok(Applied { spawned: Some(id), undo: Some(Command::Remove { id }) });
            }
            Command::Respawn { id, desc, load } => {
                self.respawn_loaded(*id, (**desc).clone(), load)?;
                return Ok(Applied { spawned: Some(*id), undo: Some(Command::Remove { id: *id }) });
            }
            Command::Remove { id } => {
                let load = self.load(*id);
                let desc = Box::new(self.remove(*id)?);
                Some(Command::Respawn { id: *id, desc, load })
            }
            Command::Move { id, pose } => {
                let undo = self.reset_of(*id)?;
                self.set_motion(*id, *pose, Twist::ZERO)?;
                Some(undo)
            }
            Command::Reset { id, pose, twist, bond } => {
                let undo = self.reset_of(*id)?;
                self.reset(*id, *pose, *twist, *bond)?;
                Some(undo)
            }
            Command::SetAttribute { id, key, value } => {
                let old = self.set_attribute(*id, key, value.clone())?;
                Some(Command::SetAttribute { id: *id, key: key.clone(), value: old })
            }
            Command::Alter { id, alteration } => {
                let alteration = self.alter(*id, alteration.clone())?;
                Some(Command::Alter { id: *id, alteration })
            }
            Command::Attach { child, bond } => {
                let undo = self.reset_of(*child)?;
                self.attach(*child, *bond)?;
                Some(undo)
            }
            Command::SetEnvironment(environment) => {
                Some(Command::SetEnvironment(self.set_environment(*environment)?))
            }
            Command::PatchRoads(patch) => {
                Some(Command::PatchRoads(Box::new(self.patch_roads((**patch).clone())?)))
            }
            Command::SetPassage { leg, passage } => {
                Some(Command::SetPassage { leg: *leg, passage: self.set_passage(*leg, *passage)? })
            }
            Command::Actuate { who, action } => {
                self.actuate(*who, action.clone())?;
                None
            }
            Command::Intend { who, intent } => {
                self.intend(*who, intent.clone())?;
                None
            }
            Command::Traffic(order) => {
                self.order(order.clone())?;
                None
            }
        };
        Ok(Applied { spawned: None, undo })
    }

    /// Carries out commands in their order: all of them, or none.
    ///
    /// # Errors
    /// The first command that is impossible; then nothing has changed but what actions and intents before it did.
    pub fn apply_all(&mut self, commands: &[Command]) -> Result<AppliedAll, CommandError> {
        let mut all = AppliedAll::default();
        for command in commands {
            match self.apply(command) {
                Ok(done) => {
                    all.spawned.extend(done.spawned);
                    all.undo.extend(done.undo);
                }
                Err(error) => {
                    for back in all.undo.iter().rev() {
                        // What was just done can be taken back: nothing else changed since.
                        let _ = self.apply(back);
                    }
                    return Err(error);
                }
            }
        }
        all.undo.reverse();
        Ok(all)
    }

    /// The command that brings an entity back to where it is now.
    fn reset_of(&self, id: EntityId) -> Result<Command, WorldError> {
        let entity = self.entity(id).ok_or(WorldError::Missing { id })?;
        let (pose, twist) = (*entity.pose, *entity.twist);
        Ok(Command::Reset { id, pose, twist, bond: entity.attachment.copied() })
    }
}
