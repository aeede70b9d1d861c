#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

pub mod assignment;
mod closure;
mod conditions;
mod config;
pub mod crowd;
mod demand;
mod dynamics;
pub mod learn;
mod line;
pub mod look;
mod names;
pub mod output;
mod parts;
mod pedestrian;
mod route;
pub mod signal;
#[cfg(feature = "sumo")]
pub mod sumo;
mod takeover;
mod traffic;
#[cfg(feature = "validation")]
pub mod validation;
pub mod vehicle;

pub use closure::{Closed, Closure, NoWay};
pub use conditions::DrivingConditions;
pub use config::{TrafficConfig, TrafficError};
pub use demand::{
    Activity, ActivityChains, Arrivals, DayTimes, Departing, Flow, Kerbs, OdMatrix, Person, Schedule,
    TimeProfile, Trip, TripEnd, VehicleChoice, Zone, commuters,
};
pub use demand::{Drive as PersonDrive, Itinerary, Kerb, PersonFlow, Stage as PersonStage, Whereabouts};
pub use dynamics::TrafficDynamics;
pub use line::{Line, Stop};
pub use names::NetworkNames;
pub use pedestrian::{AtDestination, Pedestrian, People, Sex, Walk};
pub use route::{Leg, Route, Router};
#[cfg(feature = "hierarchy")]
pub use route::{LegHierarchy, LegScratch};
pub use takeover::{Control, ControlError, Drive, LaneWish, Stroll};
pub use traffic::{Body, Counters, Foreign, Interest, Placed, Traffic};
