//! Where the crates meet: the delivery run, assembled from citygen, traffic, physics, render and agents; and what the
//! city and traffic examples and the comparison with SUMO do behind their command lines.
//!
//! The crates know only simworld-core; this package is unpublished and exists so that the examples and the
//! workspace's tests put the parts together in the same way.

#![forbid(unsafe_code)]

pub mod beside_sumo;
pub mod bodies;
pub mod chat;
pub mod city;
pub mod delivery;
pub mod edit;
mod ending;
pub mod experiment;
pub mod folder;
pub mod look;
pub mod minds;
pub mod model;
pub mod places;
pub mod processor;
pub mod report;
pub mod robot;
pub mod served;
pub mod timing;
pub mod traffic;
pub mod view;
pub mod wayfinding;
pub mod written;

pub use ending::{Outcome, exit_code};

/// Of all examples and tests that use this package: cities are many small lists, and what was given back is soon asked for again.
#[cfg(feature = "mimalloc")]
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// The page about one's own task, so that its code is run.
#[cfg(doctest)]
#[doc = include_str!("../../docs/your-own-task.md")]
pub struct YourOwnTask;

/// The page about scenes that are written by hand, likewise.
#[cfg(doctest)]
#[doc = include_str!("../../docs/scenes.md")]
pub struct Scenes;
