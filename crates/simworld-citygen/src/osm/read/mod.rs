//! From the bytes of a file to what it holds: XML and PBF.

mod guard;
mod number;
pub(super) mod pbf;
mod wire;
pub(super) mod xml;
