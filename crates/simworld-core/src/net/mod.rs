//! Roads as data: lanes, intersections, crossings, signals; and the two-level waypoint graph over them.

mod assemble;
mod check;
mod derive;
mod footpath_heights;
mod gaps;
mod hammerhead;
#[cfg(feature = "hierarchy")]
mod hierarchy;
mod near;
mod network;
mod part;
mod plan;
mod plaza;
pub mod polyline;
mod repair;
mod section;
mod signal;
mod turn_lanes;
mod turning;
mod waypoint;
mod zone;

pub use assemble::{NetworkBuilder, NewLane, NewRoad};
pub use check::NetworkFault;
pub use derive::{Alone, NetworkConfig, NetworkError, Workers};
pub use footpath_heights::{
    FOOTBRIDGE_DECK, FOOTBRIDGE_HEADROOM, FOOTBRIDGE_STOREY, FootpathHeights, RAMP_GRADE, STAIRS_GRADE,
};
pub use gaps::{CriticalGaps, time_over};
pub use hammerhead::{HAMMERHEAD_ARM, HAMMERHEAD_WIDTH};
#[cfg(feature = "hierarchy")]
pub use hierarchy::{Hierarchy, HierarchyScratch, ShortestPath, WeightedEdge};
pub use near::Joined;
pub use network::{
    Connection, Control, Crossing, Few, Footpath, Hammerhead, Intersection, Lane, Road, RoadClass,
    RoadNetwork, Side, Sidewalk, Strip, Turn, TurningCircle,
};
pub use part::PlanPart;
pub use plan::{DrivingSide, SHORTEST_STREET, Street, StreetPlan};
pub use plaza::Plaza;
pub use repair::{NetworkPatch, PatchError, PlanChange};
pub use section::{CrossSection, LANE_WIDTH, LaneDirection, LaneKind, LaneSpec, SIDEWALK_WIDTH};
pub use signal::{Aspect, Phase, SignalGroup, SignalPlan};
pub use turn_lanes::{LaneWays, TurnLanes, TurnSet};
pub use turning::{CAR_TURNING, LORRY_TURNING, TurningRoom};
#[cfg(feature = "hierarchy")]
pub use waypoint::RouteHierarchy;
pub use waypoint::{
    Route, RouteScratch, Waypoint, WaypointConfig, WaypointEdge, WaypointGraph, WaypointKind,
};
pub use zone::{Ends, WayTrace, Zone};
