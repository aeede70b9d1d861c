//! Why a file becomes no asset.

use simworld_core::asset::{AssetError, RigError};
use thiserror::Error;

use crate::assets::glb::GlbError;

/// Why a file becomes no asset; nothing was added anywhere.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ImportError {
    /// It cannot be read.
    #[error("the model cannot be read: {0}")]
    Glb(#[from] GlbError),
    /// Its animations move it in a way that cannot be kept.
    #[error(
        "its animations cannot be kept: {0}; or import it at rest, with `clips` off in the configuration of the import"
    )]
    Rig(#[from] RigError),
    /// None of its triangles has an area.
    #[error("none of its {triangles} triangles has an area: export the model again")]
    NoArea {
        /// How many there are.
        triangles: usize,
    },
    /// Too many of its edges are no edges of a surface.
    #[error(
        "{count} of its {edges} edges {what}: mend the surface, or allow more by `{field}` in the configuration of the import"
    )]
    Unsound {
        /// How many.
        count: usize,
        /// Of how many.
        edges: usize,
        /// What is wrong with them.
        what: &'static str,
        /// What allows more.
        field: &'static str,
    },
    /// It is as flat as a sheet of paper.
    #[error("it is {size:?} m long, wide and high, too flat for a solid: give it a thickness")]
    Flat {
        /// m.
        size: [f64; 3],
    },
    /// No class says how large such a thing is, and nobody else does.
    #[error(
        "nothing is known of how large {words:?} is: give a size, or name a class of things such as {example:?}"
    )]
    NoSize {
        /// What it is said to be.
        words: String,
        /// A class that is known, the nearest by name.
        example: String,
    },
    /// It is no power of ten of the size of such things, or not of their shape.
    #[error(
        "it is {got:?} units long, wide and high, and a {class} is about {typical:?} m: give its size, or another class"
    )]
    Size {
        /// As the file has it.
        got: [f64; 3],
        /// The class.
        class: String,
        /// How large things of it are, m.
        typical: [f64; 3],
    },
    /// A size that was asked for is none, or does not go with another one.
    #[error(
        "a {what} of {value} m: give 0.01 to 1000 m, and sizes that go with its shape ({shape:?} m when it is so scaled)"
    )]
    Asked {
        /// Length, width or height.
        what: &'static str,
        /// m.
        value: f64,
        /// Length, width and height that come out, m.
        shape: [f64; 3],
    },
    /// No convex solid holds it.
    #[error("no solid can be made of it: give the model some volume")]
    NoSolid,
    /// Its mass is none.
    #[error("it weighs {mass} kg with {volume} m³: give its size, or another class")]
    Mass {
        /// kg.
        mass: f64,
        /// m³.
        volume: f64,
    },
    /// What comes out is no asset.
    #[error("it is no asset: {0}")]
    Asset(#[from] AssetError),
    /// A configuration that cannot work.
    #[error("the configuration of the import: {0}")]
    Config(String),
}
