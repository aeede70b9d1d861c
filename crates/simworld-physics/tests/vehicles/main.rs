//! Vehicles: on tyres, reduced, and from one to the other.
#![allow(clippy::unwrap_used, reason = "what fails in a helper fails the test")]

#[path = "../common/mod.rs"]
mod common;
mod driving;
mod hand_over;
mod single_track;
mod vehicles;
