//! The mesher of core, by the names that the grammar has for it.

pub(super) use simworld_core::asset::sculpt::{Cast, Coating as Finish, Hulls, Sculpt, V};
