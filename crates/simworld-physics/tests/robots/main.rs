//! Robots: the dog on its legs, and robots from files.

#[path = "../common/mod.rs"]
mod common;
mod quadruped;
mod quadruped_falls;
mod quadruped_land;
mod robot_files;
mod robots;
