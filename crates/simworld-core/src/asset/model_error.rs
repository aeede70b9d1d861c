//! Why a model is none.

use thiserror::Error;

use super::finish::{BRIGHTEST, Finish, MOST_CUTOFF, Pictures, STEEPEST, Transparency};
use super::image::{Content, LONGEST_IMAGE, MOST_PIXELS};
use super::model::LARGEST_MODEL;

/// Why a model is none.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ModelError {
    /// It has no triangle or no hull.
    #[error("it has no {what}: give at least one")]
    Empty {
        /// What lacks.
        what: &'static str,
    },
    /// A number is none, or far off.
    #[error("{what} {index} is {value:?}: give finite numbers within {LARGEST_MODEL} m of the origin")]
    Number {
        /// Of what.
        what: &'static str,
        /// Which.
        index: usize,
        /// What was given.
        value: [f32; 3],
    },
    /// A triangle names a vertex that is not there.
    #[error("triangle {index} has vertex {vertex}, and there are {count}: count from 0")]
    Vertex {
        /// Which triangle.
        index: usize,
        /// Which vertex.
        vertex: u32,
        /// How many there are.
        count: usize,
    },
    /// The parts do not share out the triangles.
    #[error("its parts have {parts} triangles together, and it has {triangles}: each belongs to one part")]
    Parts {
        /// How many the parts have.
        parts: u64,
        /// How many there are.
        triangles: usize,
    },
    /// A hull has no room inside.
    #[error("hull {index} has {points} points: a solid has at least four")]
    Hull {
        /// Which.
        index: usize,
        /// How many points it has.
        points: usize,
    },
    /// How a part takes light is out of range.
    #[error(
        "part {part} is {finish:?}: give metal and roughness from 0 to 1, and light of its own from 0 to {BRIGHTEST}"
    )]
    Finish {
        /// Which part.
        part: usize,
        /// What was given.
        finish: Finish,
    },
    /// What becomes of a part where its alpha is below 1 is out of range.
    #[error("part {part} is {transparency:?}: give a cutoff from 0 to {MOST_CUTOFF}")]
    Transparency {
        /// Which part.
        part: usize,
        /// What was given.
        transparency: Transparency,
    },
    /// How far pictures of a part count is out of range.
    #[error(
        "part {part} has {pictures:?}: give shade a strength from 0 to 1, and bumps a scale from -{STEEPEST} to {STEEPEST}"
    )]
    Pictures {
        /// Which part.
        part: usize,
        /// What was given.
        pictures: Pictures,
    },
    /// A picture of a part holds something else than it is used for.
    #[error("part {part} uses image {image} as {wanted:?}, and it holds {content:?}: give one of each kind")]
    Content {
        /// Which part.
        part: usize,
        /// Which picture.
        image: u32,
        /// What it is used for.
        wanted: Content,
        /// What it holds.
        content: Content,
    },
    /// A part names a picture that is not there.
    #[error("part {part} has image {image}, and there are {count}: count from 0")]
    Image {
        /// Which part.
        part: usize,
        /// Which picture.
        image: u32,
        /// How many there are.
        count: usize,
    },
    /// A picture is none.
    #[error(
        "image {index} is {width} x {height} with {bytes} bytes: give 1 to {LONGEST_IMAGE} pixels each way, three bytes each"
    )]
    Picture {
        /// Which.
        index: usize,
        /// Pixels in a row.
        width: u32,
        /// Rows.
        height: u32,
        /// Bytes of its pixels.
        bytes: usize,
    },
    /// The pictures are too large together.
    #[error("its images have {pixels} pixels together, and {MOST_PIXELS} are the most: halve them")]
    Pixels {
        /// How many they have.
        pixels: u64,
    },
    /// Its rig carries other vertices.
    #[error("its rig carries {rig} vertices, and it has {vertices}: give as many, in the same order")]
    Rig {
        /// How many the rig carries.
        rig: usize,
        /// How many there are.
        vertices: usize,
    },
    /// It has tangents for some of its vertices alone.
    #[error("it has {tangents} tangents, and {vertices} vertices: give one each, in the same order, or none")]
    Tangents {
        /// How many there are.
        tangents: usize,
        /// How many vertices there are.
        vertices: usize,
    },
    /// It does not fit its collider.
    #[error(
        "it is {model:?} m long, wide and high, and its collider {collider:?}: give a collider that is as large, and stand \
         the model on its origin"
    )]
    Size {
        /// The box around the model, m.
        model: [f64; 3],
        /// The box around the collider, m.
        collider: [f64; 3],
    },
}
