//! From streets to lanes: everything a [`RoadNetwork`](super::RoadNetwork) holds follows from centrelines.

mod beside;
mod connections;
mod curve;
mod cycles;
mod ends;
mod extent;
mod hammerhead;
mod kerbs;
mod lanes;
mod legs;
mod mirror;
mod near_side;
mod outside;
mod pieces;
mod roads;
mod shape;
mod signals;
mod trace;
mod walkways;
mod ways;
mod workers;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::{Control, DrivingSide, Few, Intersection, Road, RoadClass, RoadNetwork, Street, StreetPlan};
use crate::geometry::Point2;
use crate::id::{IntersectionId, RoadId};
pub(super) use connections::settle;
pub(super) use curve::curve;
use legs::Leg;
use workers::PART;
pub use workers::{Alone, Workers};

/// Limits and timings by which a network is derived.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct NetworkConfig {
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
    /// Heights that are not one a node.
    #[error("there are {given} heights for {nodes} nodes: give one a node, or none")]
    Elevations {
        /// How many there are.
        given: usize,
        /// How many there should be.
        nodes: usize,
    },
    /// A change that does not lead from the network to the plan.
    #[error("the change is none of this network: {reason}; derive the network anew from its plan")]
    Change {
        /// What is wrong.
        reason: String,
    },
    /// A node at no height.
    #[error("node {node} lies at {height} m: give -10 000 to 10 000 m")]
    Elevation {
        /// Its index in the plan.
        node: usize,
        /// Its height, m.
        height: f64,
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

impl NetworkConfig {
    /// Checks every field against its range.
    ///
    /// # Errors
    /// The first field out of range; NaN always is.
    pub fn validate(&self) -> Result<(), NetworkError> {
        let checks = [
            ("crossing_width", self.crossing_width, 1.0, 10.0, "1 to 10 m"),
            ("local_speed", self.local_speed, 1.0, 70.0, "1 to 70 m/s"),
            ("arterial_speed", self.arterial_speed, 1.0, 70.0, "1 to 70 m/s"),
            ("highway_speed", self.highway_speed, 1.0, 70.0, "1 to 70 m/s"),
            ("green", self.green, 5.0, 300.0, "5 to 300 s"),
            ("yellow", self.yellow, 1.0, 10.0, "1 to 10 s"),
            ("all_red", self.all_red, 0.0, 20.0, "0 to 20 s"),
        ];
        for (field, value, low, high, allowed) in checks {
            if !(low..=high).contains(&value) {
                return Err(NetworkError::Config { field, value, allowed });
            }
        }
        Ok(())
    }

    /// The speed limit of a class, m/s.
    pub fn speed_limit(&self, class: RoadClass) -> f64 {
        match class {
            RoadClass::Local => self.local_speed,
            RoadClass::Arterial => self.arterial_speed,
            RoadClass::Highway => self.highway_speed,
        }
    }
}

impl RoadNetwork {
    /// Derives lanes, intersections, connections, conflicts, sidewalks, crossings and signal plans.
    ///
    /// ```
    /// use simworld_core::geometry::Point2;
    /// use simworld_core::net::{NetworkConfig, RoadNetwork, StreetPlan};
    /// let plan = StreetPlan::crossroads(100.0);
    /// let network = RoadNetwork::derive(&plan, &NetworkConfig::default())?;
    /// assert_eq!((network.roads.len(), network.lanes.len(), network.crossings.len()), (4, 8, 4));
    /// # Ok::<(), simworld_core::net::NetworkError>(())
    /// ```
    ///
    /// # Errors
    /// A setting out of range, or a street or node that cannot be built.
    pub fn derive(plan: &StreetPlan, config: &NetworkConfig) -> Result<Self, NetworkError> {
        Self::derive_with(plan, config, &Alone)
    }

    /// The same, with the help of others: they work on streets and junctions, and nearly all of it falls to them. The network
    /// does not depend on them.
    ///
    /// # Errors
    /// Those of [`derive`](Self::derive).
    pub fn derive_with(
        plan: &StreetPlan,
        config: &NetworkConfig,
        workers: &dyn Workers,
    ) -> Result<Self, NetworkError> {
        config.validate()?;
        plan.validate()?;
        Ok(match plan.driving_side {
            DrivingSide::Right => Self::keeping_right(plan, config, workers),
            DrivingSide::Left => mirror::network(Self::keeping_right(&mirror::plan(plan), config, workers)),
        })
    }

    fn keeping_right(plan: &StreetPlan, config: &NetworkConfig, workers: &dyn Workers) -> Self {
        let legs = legs::of_plan(plan, config, workers);
        let mut network = Self::default();
        network.names.clone_from(&plan.names);
        let place = |node: usize| {
            let legs = &legs[node];
            let control = plan.controls.get(&node).copied();
            let in_ring = legs.iter().any(|leg| plan.streets[leg.street].roundabout);
            let control = control.or(in_ring.then_some(Control::Priority));
            intersection((plan.nodes[node], plan.elevation(node)), legs, control, config)
        };
        network.intersections = workers::each(workers, legs.nodes(), place);
        let ends = roads::add(&mut network, plan, &legs, config, workers);
        walkways::add(&mut network, plan, &legs, config, workers);
        signals::add(&mut network, &legs, config, workers);
        let made = workers::collect(workers, legs.nodes().div_ceil(PART), |part| {
            let nodes = part * PART..legs.nodes().min((part + 1) * PART);
            connections::of_nodes(&network, plan, (&legs, &ends), nodes)
        });
        connections::append(&mut network, made, workers);
        network
    }
}

/// A road as far as it follows from its street alone.
pub(super) fn road(plan: &StreetPlan, street: &Street) -> Road {
    let (left, right) = plan.section(street).kerbs();
    Road {
        class: street.class,
        from: IntersectionId::from_index(street.from),
        to: IntersectionId::from_index(street.to),
        centerline: plan.centerline(street),
        name: street.name,
        width: left + right,
        left_kerb: left,
        right_kerb: right,
        forward: Few::new(),
        backward: Few::new(),
        cycle: Few::new(),
        strips: Vec::new(),
        sidewalks: [None; 2],
        roundabout: street.roundabout,
        level: street.level,
        profile: street.profile.to_vec(),
    }
}

fn intersection(
    (center, height): (Point2, f64),
    legs: &[Leg],
    known: Option<Control>,
    config: &NetworkConfig,
) -> Intersection {
    let control = match (legs.len(), known) {
        (0..=2, _) => Control::None,
        (_, Some(control)) => control,
        (n, None) if config.signals_from_roads > 0 && n >= config.signals_from_roads => Control::Signals,
        _ => Control::Priority,
    };
    let (outline, starts) = kerbs::outline(center, legs);
    Intersection {
        center,
        height,
        outline,
        kerbs: starts,
        turning: kerbs::turning_circle(legs),
        roads: legs.iter().map(|leg| RoadId::from_index(leg.street)).collect(),
        control,
        signals: None,
        connections: Vec::new(),
        crossings: Few::new(),
        corners: Vec::new(),
        hammerhead: hammerhead::head(legs),
    }
}

/// An intersection that no road leads to.
pub(super) fn alone(plan: &StreetPlan, node: usize, config: &NetworkConfig) -> Intersection {
    intersection((plan.nodes[node], plan.elevation(node)), &[], None, config)
}
