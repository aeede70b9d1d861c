//! Vehicles: on tyres, reduced, and from one to the other.

#[path = "../common/mod.rs"]
mod common;
mod driving;
mod hand_over;
mod single_track;
mod vehicles;
