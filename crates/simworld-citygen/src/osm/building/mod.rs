//! Buildings of a place: outlines, use, storeys, names.

mod adopt;
mod outline;
mod raise;
mod stand;
mod usage;

pub(super) use adopt::adopt;
pub(super) use outline::{Outline, contains, outlines, rings};
use raise::raise;
pub(super) use stand::{raise_all, stand};
pub(super) use usage::is_building;
