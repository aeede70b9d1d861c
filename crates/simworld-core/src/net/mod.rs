//! Roads as data: lanes, intersections, crossings, signals; and the two-level waypoint graph over them.

mod derive;
mod network;
pub mod polyline;
mod signal;
mod waypoint;

pub use derive::{NetworkConfig, NetworkError, Street, StreetPlan};
pub use network::{
    Connection, Control, Crossing, Intersection, Lane, Road, RoadClass, RoadNetwork, Side, Sidewalk, Turn,
};
pub use signal::{Aspect, Phase, SignalGroup, SignalPlan};
pub use waypoint::{
    Route, RouteScratch, Waypoint, WaypointConfig, WaypointEdge, WaypointGraph, WaypointKind,
};
