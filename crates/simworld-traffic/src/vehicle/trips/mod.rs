//! Trips: how vehicles come into the network, where they stop, which way they take, and how they leave it.
//!
//! They [enter](entry) by a road or from the [kerb], [stop](halts) on their way, and their drivers [think it over](detours) where the streets
//! are [slow](delays), or are [sent](reroute) another way.

pub(super) mod delays;
pub(super) mod detours;
pub(super) mod entry;
pub(super) mod halts;
pub(super) mod kerb;
pub(super) mod reroute;
pub(super) mod spawn;
