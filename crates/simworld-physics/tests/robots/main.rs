//! Robots: the dog on its legs, and robots from files.
#![allow(clippy::unwrap_used, reason = "what fails in a helper fails the test")]

mod colors;
#[path = "../common/mod.rs"]
mod common;
mod damaged_files;
mod drawn;
mod meeting;
mod quadruped;
mod quadruped_falls;
mod quadruped_land;
mod robot_files;
mod robot_written;
mod robots;
mod seen;
