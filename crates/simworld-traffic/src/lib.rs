#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod config;
pub mod control;
mod dynamics;
mod pedestrian;
pub mod signal;
mod traffic;
pub mod vehicle;

pub use config::{TrafficConfig, TrafficError};
pub use dynamics::TrafficDynamics;
pub use pedestrian::Pedestrian;
pub use traffic::{Body, Counters, Foreign, Placed, Traffic};
