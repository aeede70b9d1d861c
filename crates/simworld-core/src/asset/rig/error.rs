//! Why a rig is none.

use thiserror::Error;

use super::{MOST_WORK, POSE_RATE};
use crate::asset::LARGEST_MODEL;

/// Why a rig is none.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum RigError {
    /// There are none, or too many.
    #[error("it has {got} {what}: give 1 to {most}")]
    Count {
        /// Of what.
        what: &'static str,
        /// How many it has.
        got: usize,
        /// The most there may be.
        most: usize,
    },
    /// Something names what is not there.
    #[error(
        "{what} {index} names {named} {other}, and there are {count}: count from 0, parents before their children"
    )]
    Index {
        /// What names it.
        what: &'static str,
        /// Which.
        index: usize,
        /// What is named.
        named: &'static str,
        /// Which is named.
        other: usize,
        /// How many there are.
        count: usize,
    },
    /// Something has numbers that are none.
    #[error("{what} {index} has numbers that are none, or far off")]
    Number {
        /// What.
        what: &'static str,
        /// Which.
        index: usize,
    },
    /// The shares of a vertex are none.
    #[error("the weights of vertex {index} are {weights:?}: give shares that are 1 together")]
    Weights {
        /// Which vertex.
        index: usize,
        /// What was given.
        weights: [f32; 4],
    },
    /// A clip has no name of its own.
    #[error(
        "clip {index} is called {name:?}: give each a name of its own, of 1 to {LONGEST_CLIP_NAME} characters"
    )]
    Name {
        /// Which clip.
        index: usize,
        /// Its name.
        name: String,
    },
    /// A curve is none, or moves what cannot be moved.
    #[error("channel {channel} of clip {clip:?} {fault}")]
    Curve {
        /// Of which clip.
        clip: String,
        /// Which channel.
        channel: usize,
        /// What is wrong with it.
        fault: &'static str,
    },
    /// A clip leads somewhere else.
    #[error(
        "clip {clip:?} leads {metres:e} m away in {seconds} s: a model stays within {LARGEST_MODEL} m of its origin"
    )]
    Far {
        /// Which clip.
        clip: String,
        /// When, s.
        seconds: f64,
        /// How far, m.
        metres: f32,
    },
    /// Its clips are too long for so many joints.
    #[error(
        "its clips have {poses} poses of {joints} joints and bones at {POSE_RATE} a second, and {MOST_WORK} are the most together: leave \
         out clips or shorten them"
    )]
    Work {
        /// Poses of all clips.
        poses: u64,
        /// Joints and bones of each.
        joints: usize,
    },
}

/// The longest name of a clip, characters.
pub const LONGEST_CLIP_NAME: usize = 64;
