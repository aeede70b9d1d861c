//! From streets to lanes: everything a [`RoadNetwork`](super::RoadNetwork) holds follows from centrelines.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::{RoadClass, RoadNetwork};
use crate::geometry::Point2;

/// A street of a plan: a centreline between two nodes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Street {
    /// Index of the node where it begins.
    pub from: usize,
    /// Index of the node where it ends.
    pub to: usize,
    /// Points between the two, for bends; m.
    pub via: Vec<Point2>,
    /// Its rank.
    pub class: RoadClass,
    /// Lanes along the centreline.
    pub forward_lanes: u8,
    /// Lanes against it.
    pub backward_lanes: u8,
}

/// A plan of streets: nodes where they meet or end, and centrelines between. What every source of roads makes:
/// growth, a file, a hand.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct StreetPlan {
    /// Where streets meet or end, m.
    pub nodes: Vec<Point2>,
    /// The streets; they meet only at nodes.
    pub streets: Vec<Street>,
}

/// Widths, limits and timings from which a network is derived.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct NetworkConfig {
    /// Width of a lane, m, in [2, 6].
    pub lane_width: f64,
    /// Width of a sidewalk, m, in [0.5, 20]; zero for none.
    pub sidewalk_width: f64,
    /// Width of a crossing, m, in [1, 10].
    pub crossing_width: f64,
    /// Speed limit of local roads, m/s.
    pub local_speed: f64,
    /// Speed limit of arterials, m/s.
    pub arterial_speed: f64,
    /// Speed limit of highways, m/s.
    pub highway_speed: f64,
    /// Least number of roads at a signalised intersection; 0 turns signals off.
    pub signals_from_roads: usize,
    /// Green time of a phase, s.
    pub green: f64,
    /// Yellow time, s.
    pub yellow: f64,
    /// All-red time between phases, s.
    pub all_red: f64,
}

impl Default for NetworkConfig {
    fn default() -> Self {
        Self {
            lane_width: 3.5,
            sidewalk_width: 3.0,
            crossing_width: 3.5,
            local_speed: 50.0 / 3.6,
            arterial_speed: 50.0 / 3.6,
            highway_speed: 80.0 / 3.6,
            signals_from_roads: 3,
            green: 20.0,
            yellow: 3.0,
            all_red: 2.0,
        }
    }
}

/// Why no network can be derived.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum NetworkError {
    /// A setting out of range.
    #[error("{field} = {value} is out of range: give {allowed}")]
    Config {
        /// The setting.
        field: &'static str,
        /// Its value.
        value: f64,
        /// What is allowed, in words.
        allowed: &'static str,
    },
    /// A street that cannot be built.
    #[error("street {street}: {reason}")]
    Street {
        /// Its index in the plan.
        street: usize,
        /// What is wrong, and how to mend it.
        reason: String,
    },
    /// A node that is nowhere.
    #[error("node {node} is at ({x}, {y}): give finite metres within ±1e7")]
    Node {
        /// Its index in the plan.
        node: usize,
        /// East, m.
        x: f64,
        /// North, m.
        y: f64,
    },
}

impl RoadNetwork {
    /// Derives lanes, intersections, connections, conflicts, sidewalks, crossings and signal plans.
    ///
    /// # Errors
    /// A setting out of range, or a street or node that cannot be built.
    pub fn derive(_plan: &StreetPlan, _config: &NetworkConfig) -> Result<Self, NetworkError> {
        todo!("in work")
    }
}
