#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

pub mod delivery;
pub mod episode;
pub mod executor;
mod lanes;
pub mod language;
pub mod mind;
pub mod model;
pub mod observer;
#[cfg(feature = "remote")]
pub mod remote;
#[cfg(feature = "thought")]
pub mod thought;
