//! The physics of a world: the laws, contacts, solids, doors, and what changes.
#![allow(clippy::unwrap_used, reason = "what fails in a helper fails the test")]

mod carts;
mod changes_are_enough;
#[path = "../common/mod.rs"]
mod common;
mod conformance;
mod contacts;
mod doors;
mod errors;
mod falling;
mod golden;
mod grasps;
mod hands;
#[path = "../common/hostile.rs"]
mod hostile;
mod hostile_settings;
mod laws;
mod models;
mod rays;
mod standing_on_ground;
mod streaming;
mod throwing;
mod world_changes;
