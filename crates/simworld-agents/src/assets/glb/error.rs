//! Why bytes are no GLB file that can be read.

use thiserror::Error;

/// Why a GLB file is refused; nothing of it was kept.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum GlbError {
    /// It is no GLB file, or a damaged one.
    #[error("it is no GLB file: {0}; export it as binary glTF 2.0")]
    Container(String),
    /// The JSON in it is none, or says what a glTF document cannot say.
    #[error("its JSON cannot be read: {0}")]
    Json(String),
    /// Larger than allowed.
    #[error("it has {got} {what}, and {most} are allowed: simplify it, or raise the limit")]
    TooMany {
        /// Of what.
        what: &'static str,
        /// How many.
        got: u64,
        /// The limit.
        most: u64,
    },
    /// Something in it refers to what is not there.
    #[error("{what} {index} is not there, there are {count}: export the file again")]
    Missing {
        /// What is referred to.
        what: &'static str,
        /// The number by which it is referred to.
        index: u64,
        /// How many there are.
        count: u64,
    },
    /// Something reaches beyond the bytes that hold it.
    #[error("{what} {index} reaches to byte {end} of {length}: export the file again")]
    Bounds {
        /// What.
        what: &'static str,
        /// Which.
        index: usize,
        /// Where it ends.
        end: u64,
        /// Where what holds it ends.
        length: u64,
    },
    /// Something stands outside of the file; it is never fetched.
    #[error("{what} {index} stands elsewhere ({uri:?}): export with everything in one GLB file")]
    Elsewhere {
        /// What.
        what: &'static str,
        /// Which.
        index: usize,
        /// The beginning of its address.
        uri: String,
    },
    /// A node is its own child, has two parents, or lies too deep.
    #[error("node {node} {how}: give a tree of at most {deepest} levels")]
    Tree {
        /// Which.
        node: usize,
        /// What is wrong with it.
        how: &'static str,
        /// How many levels a tree may have.
        deepest: usize,
    },
    /// A number is none, or far off.
    #[error("{what} {index} holds a number that is not finite, or too large")]
    Number {
        /// What.
        what: &'static str,
        /// Which.
        index: usize,
    },
    /// What this reader does not read.
    #[error("{what} {index}: {reason}")]
    Unsupported {
        /// What.
        what: &'static str,
        /// Which.
        index: usize,
        /// Why, and how to mend it.
        reason: String,
    },
    /// It cannot be read without an extension of glTF that is not served.
    #[error("it requires the extension {name}: export it without compression and extensions")]
    Extension {
        /// Its name.
        name: String,
    },
    /// A picture in it cannot be decoded.
    #[error("image {index} cannot be decoded: {reason}")]
    Picture {
        /// Which.
        index: usize,
        /// What the decoder says.
        reason: String,
    },
    /// Nothing in it can be seen.
    #[error("it shows no triangle: give a scene with a mesh of triangles")]
    Empty,
}
