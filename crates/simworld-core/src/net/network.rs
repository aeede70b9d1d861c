//! The road network: one static structure that cities produce and that traffic, pedestrians, planners and
//! maps read.

use serde::{Deserialize, Serialize};

use super::{DrivingSide, LaneKind, SignalGroup, SignalPlan, polyline};
use crate::geometry::Point2;
use crate::id::{ConnectionId, CrossingId, IntersectionId, LaneId, RoadId, SidewalkId};

/// The rank of a road.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RoadClass {
    /// Serves the houses along it.
    #[default]
    Local,
    /// Collects and crosses the city.
    Arterial,
    /// For through traffic.
    Highway,
}

/// A road between two intersections.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Road {
    /// Its rank.
    pub class: RoadClass,
    /// Where its centreline begins.
    pub from: IntersectionId,
    /// Where its centreline ends.
    pub to: IntersectionId,
    /// The centreline from junction centre to junction centre, at least two points, m.
    pub centerline: Vec<Point2>,
    /// Index of its name in [`RoadNetwork::names`], if it has one.
    pub name: Option<u32>,
    /// Width of the carriageway from kerb to kerb, m.
    pub width: f64,
    /// How far the carriageway reaches to the left of the centreline, m.
    pub left_kerb: f64,
    /// How far it reaches to the right, m.
    pub right_kerb: f64,
    /// Lanes driven along the centreline, from the middle outwards.
    pub forward: Vec<LaneId>,
    /// Lanes driven against the centreline, from the middle outwards.
    pub backward: Vec<LaneId>,
    /// The sidewalks on its left and on its right.
    pub sidewalks: [Option<SidewalkId>; 2],
    /// Whether it is a part of the ring of a roundabout.
    pub roundabout: bool,
    /// 0 on the ground, above it on bridges, below it in tunnels.
    pub level: i8,
}

/// A directed strip of road, for one file of vehicles.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Lane {
    /// The road it belongs to.
    pub road: RoadId,
    /// What it is for.
    pub kind: LaneKind,
    /// Its middle, from the line where it leaves an intersection to its stop line, m.
    pub path: Vec<Point2>,
    /// Length of the path, m.
    pub length: f64,
    /// Width, m.
    pub width: f64,
    /// Speed limit, m/s.
    pub speed_limit: f64,
    /// The intersection it comes from.
    pub from: IntersectionId,
    /// The intersection it leads to.
    pub to: IntersectionId,
    /// The ways on from its end; empty only where the network ends.
    pub outgoing: Vec<ConnectionId>,
}

/// The direction a connection takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Turn {
    /// Straight on.
    Straight,
    /// To the right; across oncoming traffic where that keeps left.
    Right,
    /// To the left; across oncoming traffic where that keeps right.
    Left,
    /// Back where one came from; only at dead ends.
    UTurn,
}

/// The path from one lane to another across an intersection.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Connection {
    /// The lane it leaves.
    pub from: LaneId,
    /// The lane it enters.
    pub to: LaneId,
    /// The intersection it crosses.
    pub intersection: IntersectionId,
    /// The direction it takes.
    pub turn: Turn,
    /// Its middle, from stop line to exit, m.
    pub path: Vec<Point2>,
    /// Length of the path, m.
    pub length: f64,
    /// The signal that governs it, if any.
    pub signal: Option<SignalGroup>,
    /// Connections whose vehicles could touch one on this path, ascending; never itself.
    pub conflicts: Vec<ConnectionId>,
    /// Those of the conflicts to which this one gives way while both may go, ascending.
    pub yields_to: Vec<ConnectionId>,
    /// Crossings that the path passes over, ascending.
    pub crossings: Vec<CrossingId>,
}

/// Who may go at an intersection.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Control {
    /// Signals say.
    Signals,
    /// The right of way says: see [`Connection::yields_to`].
    Priority,
    /// Nothing to say: a bend, or the end of a road.
    None,
}

/// Where roads meet, or where one ends.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Intersection {
    /// The middle, where the centrelines meet, m.
    pub center: Point2,
    /// Height above the ground level of the world, m.
    pub height: f64,
    /// The paved area, counter-clockwise, m.
    pub outline: Vec<Point2>,
    /// The roads that meet here, counter-clockwise from east by the direction in which they leave.
    pub roads: Vec<RoadId>,
    /// Who may go.
    pub control: Control,
    /// Index of its plan in [`RoadNetwork::signals`], if it has signals.
    pub signals: Option<u32>,
    /// The paths across.
    pub connections: Vec<ConnectionId>,
    /// The crossings on its legs.
    pub crossings: Vec<CrossingId>,
    /// The walkways round its corners: the i-th leads from the left sidewalk of `roads[i]`, seen from here, to the
    /// right sidewalk of the next road, ends included; without points where one of the two is missing.
    pub corners: Vec<Vec<Point2>>,
}

/// A side of a road, seen along its centreline.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Side {
    /// On the left.
    Left,
    /// On the right.
    Right,
}

/// A raised walkway along one side of a road.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sidewalk {
    /// The road it follows.
    pub road: RoadId,
    /// On which side of it.
    pub side: Side,
    /// Its middle, in the direction of the centreline, m.
    pub path: Vec<Point2>,
    /// Width, m.
    pub width: f64,
}

/// A marked strip on which pedestrians cross one leg of an intersection.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Crossing {
    /// The intersection it belongs to.
    pub intersection: IntersectionId,
    /// The road it crosses.
    pub road: RoadId,
    /// Kerb on the left of the leg, seen from the intersection, m.
    pub start: Point2,
    /// Kerb on the right, m.
    pub end: Point2,
    /// Width of the strip, m.
    pub width: f64,
    /// The pedestrian signal, if any.
    pub signal: Option<SignalGroup>,
}

/// Roads as data. Build one from a [`StreetPlan`](super::StreetPlan); it is checked, and never changes after.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RoadNetwork {
    /// Indexed by [`RoadId`].
    pub roads: Vec<Road>,
    /// Indexed by [`LaneId`].
    pub lanes: Vec<Lane>,
    /// Indexed by [`ConnectionId`].
    pub connections: Vec<Connection>,
    /// Indexed by [`IntersectionId`].
    pub intersections: Vec<Intersection>,
    /// Indexed by [`SidewalkId`]; at most two a road.
    pub sidewalks: Vec<Sidewalk>,
    /// Indexed by [`CrossingId`].
    pub crossings: Vec<Crossing>,
    /// One a signalised intersection.
    pub signals: Vec<SignalPlan>,
    /// Names of roads.
    pub names: Vec<String>,
    /// The side on which traffic keeps.
    pub driving_side: DrivingSide,
}

impl RoadNetwork {
    /// The number of signal groups, the length of [`Scene::signals`](crate::scene::Scene::signals). After a repair some may
    /// be nobody's.
    pub fn signal_groups(&self) -> usize {
        let last = |plan: &SignalPlan| plan.groups.last().map_or(0, |group| group.index() + 1);
        self.signals.iter().map(last).max().unwrap_or(0)
    }

    /// The sidewalk on one side of a road, if it has one.
    pub fn sidewalk(&self, road: RoadId, side: Side) -> Option<&Sidewalk> {
        let id = self.roads.get(road.index())?.sidewalks[usize::from(side == Side::Right)]?;
        self.sidewalks.get(id.index())
    }

    /// The name of a road, if it has one.
    pub fn road_name(&self, road: RoadId) -> Option<&str> {
        let name = self.roads.get(road.index())?.name?;
        self.names.get(name as usize).map(String::as_str)
    }

    /// Height of a road at a station along its centreline, m: even from one end to the other.
    pub fn height(&self, road: RoadId, station: f64) -> f64 {
        let Some(road) = self.roads.get(road.index()) else { return 0.0 };
        let [from, to] = [road.from, road.to].map(|end| self.intersections[end.index()].height);
        let length = polyline::length(&road.centerline);
        if length > 0.0 { from + (to - from) * (station / length).clamp(0.0, 1.0) } else { from }
    }

    /// The rectangle around all centrelines, least and greatest corner; `None` without roads.
    pub fn bounds(&self) -> Option<(Point2, Point2)> {
        let mut points = self.roads.iter().flat_map(|road| road.centerline.iter());
        let first = *points.next()?;
        Some(points.fold((first, first), |(low, high), point| (low.inf(point), high.sup(point))))
    }
}
