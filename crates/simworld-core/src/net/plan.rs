//! Streets as they are planned: nodes, centrelines and cross-sections. What every source of roads makes.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::{Control, CrossSection, NetworkError, RoadClass, Turn, TurnLanes};
use crate::geometry::Point2;
use crate::rare::Rare;

/// The shortest street that can hold two junctions and a lane between them, m.
pub const SHORTEST_STREET: f64 = 15.0;

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
    /// Index of its cross-section in [`StreetPlan::sections`].
    pub section: u32,
    /// Index of its name in [`StreetPlan::names`], if it has one.
    pub name: Option<u32>,
    /// Its speed limit, m/s; that of its class if there is none.
    pub speed_limit: Option<f64>,
    /// The arrows on its lanes, and where each of them leads, where that is known.
    pub turns: Rare<TurnLanes>,
    /// Whether it is a part of the ring of a roundabout, where those in the ring go first.
    pub roundabout: bool,
    /// 0 on the ground, above it on bridges, below it in tunnels. Streets of different levels pass over one another where
    /// they cross without a node.
    pub level: i8,
    /// Radius of the turning circle at its beginning and at its end, if it is a dead end there, m; 0 without one. What
    /// has no room along the street is left out. See [`StreetPlan::make_turning_room`].
    pub turning: [f64; 2],
    /// Heights on its way, as of a bridge: distance along the centreline from its beginning and height above the ground
    /// level of the world, m, ascending by distance. Between them and its nodes it rises evenly.
    pub profile: Rare<Vec<(f64, f64)>>,
    /// Whether there is a hammerhead at its beginning and at its end, if it is a dead end there and has no turning circle:
    /// a T as wide as [`HAMMERHEAD_WIDTH`](super::HAMMERHEAD_WIDTH), whose far kerb passes the end. What has no room along
    /// the street is left out. See [`StreetPlan::make_turning_room`].
    pub hammerhead: [bool; 2],
}

impl Street {
    /// A straight local street of the first cross-section.
    pub fn simple(from: usize, to: usize) -> Self {
        Self {
            from,
            to,
            via: Vec::new(),
            class: RoadClass::Local,
            section: 0,
            name: None,
            speed_limit: None,
            turns: Rare::default(),
            roundabout: false,
            level: 0,
            turning: [0.0; 2],
            profile: Rare::default(),
            hammerhead: [false; 2],
        }
    }
}

/// The side of the road on which traffic keeps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum DrivingSide {
    /// On the right, as in most countries.
    #[default]
    Right,
    /// On the left, as in Britain, India, Japan or Australia.
    Left,
}

impl DrivingSide {
    /// The turn that crosses oncoming traffic.
    pub const fn turn_across(self) -> Turn {
        match self {
            Self::Right => Turn::Left,
            Self::Left => Turn::Right,
        }
    }
}

/// A plan of streets: nodes where they meet or end, and centrelines between. What every source of roads makes:
/// growth, a file, a hand.
///
/// ```
/// use simworld_core::geometry::Point2;
/// use simworld_core::net::{CrossSection, Street, StreetPlan};
/// let mut plan = StreetPlan::default();
/// plan.nodes = vec![Point2::new(0.0, 0.0), Point2::new(200.0, 0.0)];
/// let avenue = plan.add_section(CrossSection::two_way(2, 2));
/// let name = plan.add_name("Avenue of the Sea");
/// plan.streets.push(Street { section: avenue, name: Some(name), ..Street::simple(0, 1) });
/// assert!(plan.validate().is_ok());
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StreetPlan {
    /// Where streets meet or end, m.
    pub nodes: Vec<Point2>,
    /// The streets; they meet only at nodes.
    pub streets: Vec<Street>,
    /// The cross-sections in use; the first is that of simple streets.
    pub sections: Vec<CrossSection>,
    /// The names in use.
    pub names: Vec<String>,
    /// Who may go, at nodes where that is known; elsewhere the number of streets says.
    pub controls: BTreeMap<usize, Control>,
    /// The side on which traffic keeps. Cross-sections are as they lie, left to right: with traffic on the left, the
    /// lanes along the centreline lie to the left.
    pub driving_side: DrivingSide,
    /// Height of each node above the ground level of the world, m; empty if all is flat.
    pub elevations: Vec<f64>,
}

impl Default for StreetPlan {
    /// No streets yet; one cross-section, of one lane each way between sidewalks.
    fn default() -> Self {
        Self {
            nodes: Vec::new(),
            streets: Vec::new(),
            sections: vec![CrossSection::default()],
            names: Vec::new(),
            controls: BTreeMap::new(),
            driving_side: DrivingSide::Right,
            elevations: Vec::new(),
        }
    }
}

impl StreetPlan {
    /// The index of a cross-section, which is added if it is new.
    pub fn add_section(&mut self, section: CrossSection) -> u32 {
        let index = self.sections.iter().position(|known| *known == section).unwrap_or_else(|| {
            self.sections.push(section);
            self.sections.len() - 1
        });
        index as u32
    }

    /// The index of a new name; the same name twice has two.
    pub fn add_name(&mut self, name: impl Into<String>) -> u32 {
        self.names.push(name.into());
        (self.names.len() - 1) as u32
    }

    /// The cross-section of a street of a valid plan.
    pub fn section(&self, street: &Street) -> &CrossSection {
        &self.sections[street.section as usize]
    }

    /// The name of a street, if it has one.
    pub fn name(&self, street: &Street) -> Option<&str> {
        self.names.get(street.name? as usize).map(String::as_str)
    }

    /// The centreline of a street, ends included.
    pub fn centerline(&self, street: &Street) -> Vec<Point2> {
        let ends = [self.nodes[street.from], self.nodes[street.to]];
        let mut line = Vec::with_capacity(street.via.len() + 2);
        line.push(ends[0]);
        line.extend(&street.via);
        line.push(ends[1]);
        line
    }

    /// The length of a street from node to node, m.
    pub(super) fn length_of(&self, street: &Street) -> f64 {
        let [from, to] = [&self.nodes[street.from], &self.nodes[street.to]];
        let ends = street.via.iter().chain([to]);
        let pieces = [from].into_iter().chain(&street.via).zip(ends);
        pieces.map(|(start, end)| (end - start).norm()).sum()
    }

    /// The height of a node, m.
    pub fn elevation(&self, node: usize) -> f64 {
        self.elevations.get(node).copied().unwrap_or(0.0)
    }

    /// Checks that every node is somewhere and every street can be built.
    ///
    /// # Errors
    /// The first node, cross-section or street at fault.
    pub fn validate(&self) -> Result<(), NetworkError> {
        if let Some(node) = self.nodes.iter().position(|point| !is_near(point)) {
            return Err(NetworkError::Node { node, x: self.nodes[node].x, y: self.nodes[node].y });
        }
        self.check_elevations()?;
        let faults: Vec<Option<String>> = self.sections.iter().map(CrossSection::fault).collect();
        let mut pairs: Vec<u64> = Vec::with_capacity(self.streets.len());
        for (index, street) in self.streets.iter().enumerate() {
            self.check_street(street, &faults)
                .map_err(|reason| NetworkError::Street { street: index, reason })?;
            pairs.push(joined(street));
        }
        pairs.sort_unstable();
        let Some(doubled) = pairs.windows(2).find(|pair| pair[0] == pair[1]) else { return Ok(()) };
        let mut between = (0..).zip(&self.streets).filter(|(_, street)| joined(street) == doubled[0]);
        let [first, street] = [between.next(), between.next()].map(|found| found.map_or(0, |found| found.0));
        let reason = format!("joins the same nodes as street {first}: remove one, or put a node on it");
        Err(NetworkError::Street { street, reason })
    }

    fn check_elevations(&self) -> Result<(), NetworkError> {
        let height = |node: usize| self.elevation(node);
        if !matches!(self.elevations.len(), 0) && self.elevations.len() != self.nodes.len() {
            return Err(NetworkError::Elevations { given: self.elevations.len(), nodes: self.nodes.len() });
        }
        match (0..self.elevations.len()).find(|node| !(-1e4..=1e4).contains(&height(*node))) {
            Some(node) => Err(NetworkError::Elevation { node, height: height(node) }),
            None => Ok(()),
        }
    }

    fn check_street(&self, street: &Street, faults: &[Option<String>]) -> Result<(), String> {
        let count = self.nodes.len();
        if street.from >= count || street.to >= count {
            return Err(format!("joins nodes {} and {}, but there are {count}", street.from, street.to));
        }
        if street.from == street.to {
            return Err(format!("begins and ends at node {}: put a node on the loop", street.from));
        }
        match faults.get(street.section as usize) {
            None => {
                return Err(format!(
                    "has cross-section {}, but there are {}: add it first",
                    street.section,
                    faults.len()
                ));
            }
            Some(Some(fault)) => return Err(fault.clone()),
            Some(None) => {}
        }
        if street.name.is_some_and(|name| name as usize >= self.names.len()) {
            return Err("has a name that is not among the names: add it first".to_owned());
        }
        if let Some(limit) = street.speed_limit.filter(|limit| !(1.0..=70.0).contains(limit)) {
            return Err(format!("has a speed limit of {limit} m/s: give 1 to 70 m/s"));
        }
        if let Some(fault) = street.turns.fault(self.section(street).driven()) {
            return Err(fault);
        }
        let is_possible =
            |(station, height): &(f64, f64)| (0.0..=1e7).contains(station) && (-1e4..=1e4).contains(height);
        if !street.profile.iter().all(is_possible) || !street.profile.is_sorted_by(|a, b| a.0 < b.0) {
            return Err(
                "has impossible heights on its way: give ascending distances and ±10 000 m".to_owned()
            );
        }
        if let Some(radius) = street.turning.iter().find(|radius| !(0.0..=50.0).contains(*radius)) {
            return Err(format!("has a turning circle of {radius} m: give 0 to 50 m"));
        }
        if !street.via.iter().all(is_near) {
            return Err("has a point of its course that is not within ±1e7 m".to_owned());
        }
        let length = self.length_of(street);
        if length < SHORTEST_STREET {
            return Err(format!(
                "is {length:.1} m long: give at least {SHORTEST_STREET} m, or merge its nodes"
            ));
        }
        Ok(())
    }

    /// Four streets of `arm` m that meet at the origin, with one lane each way: the smallest city.
    pub fn crossroads(arm: f64) -> Self {
        let ends = [(arm, 0.0), (0.0, arm), (-arm, 0.0), (0.0, -arm)];
        let nodes = [(0.0, 0.0)].into_iter().chain(ends).map(|(x, y)| Point2::new(x, y)).collect();
        Self { nodes, streets: (1..=4).map(|to| Street::simple(0, to)).collect(), ..Self::default() }
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
        Self { nodes, streets, ..Self::default() }
    }
}

fn is_near(point: &Point2) -> bool {
    point.x.abs() <= 1e7 && point.y.abs() <= 1e7
}

/// The nodes that a street joins, whichever way it runs, as one number: nodes are counted by half its bits, as ids are.
fn joined(street: &Street) -> u64 {
    let (low, high) = (street.from.min(street.to), street.from.max(street.to));
    (low as u64) << 32 | high as u64
}
