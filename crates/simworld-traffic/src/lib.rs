#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod conditions;
mod config;
pub mod control;
pub mod crowd;
mod demand;
mod dynamics;
mod pedestrian;
mod route;
pub mod signal;
mod traffic;
pub mod vehicle;

pub use conditions::DrivingConditions;
pub use config::{TrafficConfig, TrafficError};
pub use demand::{Arrivals, Flow, Trip, TripEnd};
pub use dynamics::TrafficDynamics;
pub use pedestrian::Pedestrian;
pub use route::{Leg, Route, Router};
#[cfg(feature = "hierarchy")]
pub use route::{LegHierarchy, LegScratch};
pub use traffic::{Body, Counters, Foreign, Interest, Placed, Traffic};
