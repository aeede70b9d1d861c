//! Buildings of a place: outlines, use, storeys, names.

mod adopt;
mod outline;
mod raise;
mod usage;

pub(super) use adopt::adopt;
pub(super) use outline::{Outline, outlines};
pub(super) use raise::raise;
