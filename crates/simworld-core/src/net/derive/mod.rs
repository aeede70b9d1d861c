//! From streets to lanes: everything a [`RoadNetwork`](super::RoadNetwork) holds follows from centrelines.

mod connections;
mod lanes;
mod legs;
mod signals;
mod walkways;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::polyline;
use super::{Control, Intersection, Road, RoadClass, RoadNetwork};
use crate::geometry::Point2;
use crate::id::{IntersectionId, RoadId};
use legs::Leg;

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

/// The shortest street that can hold two junctions and a lane between them, m.
pub(super) const SHORTEST_STREET: f64 = 15.0;

impl NetworkConfig {
    /// Checks every field against its range.
    ///
    /// # Errors
    /// The first field out of range; NaN always is.
    pub fn validate(&self) -> Result<(), NetworkError> {
        let checks = [
            ("lane_width", self.lane_width, 2.0, 6.0, "2 to 6 m"),
            ("sidewalk_width", self.sidewalk_width, 0.0, 20.0, "0 to 20 m"),
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

impl StreetPlan {
    /// The centreline of a street, ends included.
    pub fn centerline(&self, street: &Street) -> Vec<Point2> {
        let ends = [self.nodes[street.from], self.nodes[street.to]];
        let mut line = vec![ends[0]];
        line.extend(&street.via);
        line.push(ends[1]);
        line
    }

    /// Checks that every node is somewhere and every street can be built.
    ///
    /// # Errors
    /// The first node or street at fault.
    pub fn validate(&self) -> Result<(), NetworkError> {
        let is_near = |point: &Point2| point.x.abs() <= 1e7 && point.y.abs() <= 1e7;
        if let Some(node) = self.nodes.iter().position(|point| !is_near(point)) {
            return Err(NetworkError::Node { node, x: self.nodes[node].x, y: self.nodes[node].y });
        }
        let mut pairs: Vec<(usize, usize, usize)> = Vec::with_capacity(self.streets.len());
        for (index, street) in self.streets.iter().enumerate() {
            self.check_street(street).map_err(|reason| NetworkError::Street { street: index, reason })?;
            if !street.via.iter().all(is_near) {
                let reason = "a point of its course is not within ±1e7 m".to_owned();
                return Err(NetworkError::Street { street: index, reason });
            }
            pairs.push((street.from.min(street.to), street.from.max(street.to), index));
        }
        pairs.sort_unstable();
        match pairs.windows(2).find(|pair| (pair[0].0, pair[0].1) == (pair[1].0, pair[1].1)) {
            Some(pair) => Err(NetworkError::Street {
                street: pair[1].2,
                reason: format!(
                    "joins the same nodes as street {}: remove one, or put a node on it",
                    pair[0].2
                ),
            }),
            None => Ok(()),
        }
    }

    fn check_street(&self, street: &Street) -> Result<(), String> {
        let count = self.nodes.len();
        if street.from >= count || street.to >= count {
            return Err(format!("joins nodes {} and {}, but there are {count}", street.from, street.to));
        }
        if street.from == street.to {
            return Err(format!("begins and ends at node {}: put a node on the loop", street.from));
        }
        let (forward, backward) = (street.forward_lanes, street.backward_lanes);
        if forward > 8 || backward > 8 || forward + backward == 0 {
            return Err(format!("has {forward} + {backward} lanes: give 1 to 8 in at least one direction"));
        }
        let length = polyline::length(&self.centerline(street));
        if length < SHORTEST_STREET {
            return Err(format!(
                "is {length:.1} m long: give at least {SHORTEST_STREET} m, or merge its nodes"
            ));
        }
        Ok(())
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
        config.validate()?;
        plan.validate()?;
        let legs = legs::of_plan(plan, config);
        let mut network = Self::default();
        for (index, street) in plan.streets.iter().enumerate() {
            network.add_road(index, street, plan.centerline(street), config);
        }
        for (node, legs) in legs.iter().enumerate() {
            network.intersections.push(intersection(plan.nodes[node], legs, config));
        }
        lanes::add(&mut network, &legs, config);
        walkways::add(&mut network, &legs, config);
        for (node, legs) in legs.iter().enumerate() {
            let id = IntersectionId::from_index(node);
            signals::add(&mut network, id, legs, config);
            connections::add(&mut network, id, legs);
        }
        Ok(network)
    }

    fn add_road(&mut self, index: usize, street: &Street, centerline: Vec<Point2>, config: &NetworkConfig) {
        debug_assert_eq!(index, self.roads.len(), "roads are indexed as the streets of the plan");
        self.roads.push(Road {
            class: street.class,
            from: IntersectionId::from_index(street.from),
            to: IntersectionId::from_index(street.to),
            centerline,
            width: f64::from(street.forward_lanes + street.backward_lanes) * config.lane_width,
            forward: Vec::new(),
            backward: Vec::new(),
        });
    }
}

fn intersection(center: Point2, legs: &[Leg], config: &NetworkConfig) -> Intersection {
    let control = match legs.len() {
        0..=2 => Control::None,
        n if config.signals_from_roads > 0 && n >= config.signals_from_roads => Control::Signals,
        _ => Control::Priority,
    };
    Intersection {
        center,
        outline: legs::outline(center, legs),
        roads: legs.iter().map(|leg| RoadId::from_index(leg.street)).collect(),
        control,
        connections: Vec::new(),
        crossings: Vec::new(),
        corners: Vec::new(),
    }
}

impl StreetPlan {
    /// Four streets of `arm` m that meet at the origin, with one lane each way: the smallest city.
    pub fn crossroads(arm: f64) -> Self {
        let ends = [(arm, 0.0), (0.0, arm), (-arm, 0.0), (0.0, -arm)];
        let nodes = [(0.0, 0.0)].into_iter().chain(ends).map(|(x, y)| Point2::new(x, y)).collect();
        Self { nodes, streets: (1..=4).map(|to| Street::simple(0, to)).collect() }
    }

    /// A rectangular grid of `columns` x `rows` nodes, `spacing` m apart, with one lane each way.
    pub fn grid(columns: usize, rows: usize, spacing: f64) -> Self {
        let position =
            |index: usize| ((index % columns) as f64 * spacing, (index / columns) as f64 * spacing);
        let nodes = (0..columns * rows).map(position).map(|(x, y)| Point2::new(x, y)).collect();
        let mut streets = Vec::new();
        for index in 0..columns * rows {
            if (index + 1) % columns != 0 {
                streets.push(Street::simple(index, index + 1));
            }
            if index + columns < columns * rows {
                streets.push(Street::simple(index, index + columns));
            }
        }
        Self { nodes, streets }
    }
}

impl Street {
    /// A straight local street with one lane each way.
    pub fn simple(from: usize, to: usize) -> Self {
        Self { from, to, via: Vec::new(), class: RoadClass::Local, forward_lanes: 1, backward_lanes: 1 }
    }
}
