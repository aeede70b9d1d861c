#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

#[cfg(feature = "assets")]
pub mod assets;
pub mod asynchronous;
pub mod delivery;
pub mod editing;
pub mod episode;
pub mod executor;
pub mod generation;
pub mod gym;
#[cfg(feature = "http")]
mod http;
mod lanes;
pub mod language;
#[cfg(feature = "assets")]
pub mod library;
pub mod mind;
pub mod model;
pub mod observer;
mod panics;
#[cfg(feature = "remote")]
pub mod remote;
pub mod retrieval;
pub mod scenes;
#[cfg(feature = "thought")]
pub mod thought;
