//! Why the world store refuses a change.

use thiserror::Error;

use crate::alteration::ColorError;
use crate::asset::{AssetError, ModelError};
use crate::id::{AssetId, EntityId};
use crate::scene::ShapeError;

/// Why the store refused a change.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum WorldError {
    /// No such entity.
    #[error("there is no entity {id}: it was removed, or never spawned")]
    Missing {
        /// The unknown id.
        id: EntityId,
    },
    /// The pose is not finite or beyond the limit of a world.
    #[error("a pose at ({x}, {y}, {z}) is out of the world: give finite metres within ±1.3e7")]
    Pose {
        /// East, m.
        x: f64,
        /// North, m.
        y: f64,
        /// Up, m.
        z: f64,
    },
    /// The rotation of a pose is not one.
    #[error("a quaternion of norm {norm} is no rotation: normalise it")]
    Rotation {
        /// Its norm.
        norm: f64,
    },
    /// The velocity is not finite.
    #[error("the velocity of {id} is not finite")]
    Twist {
        /// The entity.
        id: EntityId,
    },
    /// The shape is no solid.
    #[error(transparent)]
    Shape(#[from] ShapeError),
    /// The colour is none.
    #[error(transparent)]
    Color(#[from] ColorError),
    /// The world has no such asset.
    #[error("there is no asset {asset}, for the world has {count}: add it first")]
    Asset {
        /// The unknown id.
        asset: AssetId,
        /// How many assets there are.
        count: usize,
    },
    /// An asset cannot be added.
    #[error(transparent)]
    Catalogue(#[from] AssetError),
    /// An entity cannot hang on itself, directly or through others.
    #[error("{child} cannot hang on {parent}: it would carry itself")]
    Cycle {
        /// The entity to be carried.
        child: EntityId,
        /// The carrier asked for.
        parent: EntityId,
    },
    /// Something that is to be loaded onto a carrier hangs on one already.
    #[error("{child} hangs on something already: free it first")]
    Bonded {
        /// The load.
        child: EntityId,
    },
    /// What a link would be drawn as is no surface.
    #[error("link {link} of {id} cannot be drawn: {error}")]
    LinkModel {
        /// The entity.
        id: EntityId,
        /// Which of its links.
        link: usize,
        /// Why.
        error: ModelError,
    },
    /// Links without a place, or places without a link.
    #[error("{poses} poses for the {forms} links of {id}: give one each")]
    Links {
        /// The entity.
        id: EntityId,
        /// How many links it has.
        forms: usize,
        /// How many poses were given.
        poses: usize,
    },
    /// A slot that should be free is in use.
    #[error("{id} is in use: only a removed entity can be restored")]
    InUse {
        /// The id asked for.
        id: EntityId,
    },
    /// A snapshot that contradicts itself.
    #[error("the snapshot is damaged: {what}")]
    Snapshot {
        /// What is wrong with it.
        what: &'static str,
    },
}
