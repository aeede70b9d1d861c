//! People: walking, pushing, falling, in crowds.
#![allow(clippy::unwrap_used, reason = "what fails in a helper fails the test")]

mod blows;
#[path = "../common/mod.rs"]
mod common;
mod country;
mod crowds;
mod drawn;
mod falls;
mod far;
mod mishaps;
mod obstacles;
mod pushing;
mod slopes;
mod strides;
mod walking;
