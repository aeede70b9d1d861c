//! People: walking, pushing, falling, in crowds.

mod blows;
#[path = "../common/mod.rs"]
mod common;
mod crowds;
mod falls;
mod obstacles;
mod pushing;
mod slopes;
mod strides;
mod walking;
