//! The road network: one static structure that cities produce and that traffic, pedestrians, planners and
//! maps read.

use serde::{Deserialize, Serialize};
use smallvec::SmallVec;

use super::{DrivingSide, LaneDirection, LaneKind, Plaza, SignalGroup, SignalPlan, polyline};
use crate::geometry::{self, Point2};
use crate::id::{ConnectionId, CrossingId, IntersectionId, LaneId, PlazaId, RoadId, SidewalkId};

/// A list of numbers of which there are few in most places: up to four stand in place, with no memory of their own to go and
/// look for; more of them are a vector. It is as large as a vector, and read, collected and saved like one.
pub type Few<T> = SmallVec<[T; 4]>;

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
    pub forward: Few<LaneId>,
    /// Lanes driven against the centreline, from the middle outwards.
    pub backward: Few<LaneId>,
    /// Lanes for bicycles alone, from left to right; see [`Lane::from`] for the way each goes.
    pub cycle: Few<LaneId>,
    /// What lies beside its lanes up to its sidewalks: parking, medians, cycle lanes, shoulders, verges; from left to
    /// right.
    pub strips: Vec<Strip>,
    /// The sidewalks on its left and on its right.
    pub sidewalks: [Option<SidewalkId>; 2],
    /// Whether it is a part of the ring of a roundabout.
    pub roundabout: bool,
    /// 0 on the ground, above it on bridges, below it in tunnels.
    pub level: i8,
    /// Heights on its way: station along the centreline and height above the ground level of the world, m, ascending; none
    /// where it rises evenly from end to end. See [`RoadNetwork::height`].
    pub profile: Vec<(f64, f64)>,
}

/// A strip of a road that is no lane for motor vehicles and no sidewalk. It ends where the lanes end, before its junctions.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Strip {
    /// What it is for.
    pub kind: LaneKind,
    /// The way traffic moves on it.
    pub direction: LaneDirection,
    /// Its middle lies so far to the left of the centreline, m.
    pub offset: f64,
    /// Width, m.
    pub width: f64,
    /// Stations along the centreline where it begins and ends, m.
    pub stations: (f64, f64),
}

impl Road {
    /// All its lanes: those along the centreline, those against it, and those for bicycles.
    pub fn lanes(&self) -> impl Iterator<Item = LaneId> + '_ {
        self.forward.iter().chain(&self.backward).chain(&self.cycle).copied()
    }

    /// The middle of one of its strips, in the direction of the centreline, m.
    pub fn strip_path(&self, strip: &Strip) -> Vec<Point2> {
        let (from, to) = strip.stations;
        polyline::offset(&polyline::slice(&self.centerline, from, to), strip.offset)
    }

    /// The outline of one of its strips, counter-clockwise, m.
    ///
    /// ```
    /// use simworld_core::net::{CrossSection, NetworkConfig, RoadNetwork, StreetPlan};
    /// let mut plan = StreetPlan::crossroads(100.0);
    /// plan.sections[0] = CrossSection::two_way(1, 1).with_parking(2.0);
    /// let network = RoadNetwork::derive(&plan, &NetworkConfig::default())?;
    /// let road = &network.roads[0];
    /// let bays = road.strip_outline(&road.strips[0]);
    /// assert_eq!((bays.len(), bays[0].y, bays[2].y), (4, 3.5, 5.5));
    /// # Ok::<(), simworld_core::net::NetworkError>(())
    /// ```
    pub fn strip_outline(&self, strip: &Strip) -> Vec<Point2> {
        let (from, to) = strip.stations;
        let middle = polyline::slice(&self.centerline, from, to);
        let mut outline = polyline::offset(&middle, strip.offset - strip.width * 0.5);
        outline.extend(polyline::offset(&middle, strip.offset + strip.width * 0.5).into_iter().rev());
        outline
    }
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
    pub outgoing: Few<ConnectionId>,
}

impl Lane {
    /// Whether motor vehicles drive there; a lane for bicycles is left to them.
    pub const fn is_driven(&self) -> bool {
        self.kind.is_driven()
    }
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
    pub conflicts: Few<ConnectionId>,
    /// Those of the conflicts to which this one gives way while both may go, ascending.
    pub yields_to: Few<ConnectionId>,
    /// Crossings that the path passes over, ascending.
    pub crossings: Few<CrossingId>,
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
    /// Stop signs: the right of way says, and whoever comes by a road of lower class than another stops at its line first;
    /// everybody does where all are of one class.
    Stop,
}

/// The round end of a street in which vehicles turn.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TurningCircle {
    /// Its middle, m.
    pub center: Point2,
    /// Its radius up to the kerb, m.
    pub radius: f64,
}

/// The head of a T across the end of a street, in which vehicles turn where a circle has no room.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Hammerhead {
    /// The middles of the kerbs at the tips of its two arms, m.
    pub tips: [Point2; 2],
    /// Its width, m.
    pub width: f64,
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
    /// Where in the outline the kerb on the left of each road begins, seen from here; see [`Intersection::kerb`].
    pub kerbs: Few<u32>,
    /// The room to turn round, at a dead end that has it.
    pub turning: Option<TurningCircle>,
    /// The roads that meet here, counter-clockwise from east by the direction in which they leave.
    pub roads: Few<RoadId>,
    /// Who may go.
    pub control: Control,
    /// Index of its plan in [`RoadNetwork::signals`], if it has signals.
    pub signals: Option<u32>,
    /// The paths across.
    pub connections: Vec<ConnectionId>,
    /// The crossings on its legs.
    pub crossings: Few<CrossingId>,
    /// The walkways round its corners: the i-th leads from the left sidewalk of `roads[i]`, seen from here, to the
    /// right sidewalk of the next road, ends included; without points where one of the two is missing.
    pub corners: Vec<Vec<Point2>>,
    /// The T in which vehicles turn, at a dead end that has it instead of a circle.
    pub hammerhead: Option<Hammerhead>,
}

impl Intersection {
    /// The kerb that leads from the left of `roads[rank]`, seen from here, round the corner to the right of the next road,
    /// ends included; empty if there is none. All of them one after another are the outline.
    pub fn kerb(&self, rank: usize) -> &[Point2] {
        let Some(start) = self.kerbs.get(rank) else { return &[] };
        let end = self.kerbs.get(rank + 1).map_or(self.outline.len(), |end| *end as usize);
        self.outline.get(*start as usize..end).unwrap_or_default()
    }
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

/// A way for walkers alone, away from streets: a trail, a field path, a lane of steps, a footbridge.
///
/// It has no lanes and no kerb. Ways that share an end meet there, on whatever level they are; an end that joins leads on to
/// a sidewalk near it. Where lines merely cross nobody comes from one to the other. How high it lies above the ground follows
/// from all of them: see [`RoadNetwork::footpath_heights`].
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Footpath {
    /// Its middle, from end to end, at least two points, m.
    pub path: Vec<Point2>,
    /// Width, m.
    pub width: f64,
    /// Whether its beginning and its end lead on to the nearest sidewalk, if one is within 15 m.
    pub joins: [bool; 2],
    /// 0 on the ground, above it on footbridges, below it in subways.
    #[serde(default)]
    pub level: i8,
    /// Whether something is built over it: a passage through a building, an arcade.
    #[serde(default)]
    pub covered: bool,
    /// The plaza that it crosses, if it does: those on it may leave the line, but not the plaza.
    #[serde(default)]
    pub plaza: Option<PlazaId>,
    /// Whether it is a flight of steps; known of ways off the ground alone.
    #[serde(default)]
    pub steps: bool,
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
    /// Ways for walkers alone.
    pub footpaths: Vec<Footpath>,
    /// Indexed by [`PlazaId`].
    pub plazas: Vec<Plaza>,
    /// The side on which traffic keeps.
    pub driving_side: DrivingSide,
}

impl RoadNetwork {
    /// Whether who comes from a lane has a stop sign at its end.
    pub fn stops_at(&self, lane: LaneId) -> bool {
        let place = &self.intersections[self.lanes[lane.index()].to.index()];
        let class = |road: &RoadId| self.roads[road.index()].class;
        let own = class(&self.lanes[lane.index()].road);
        let is_above = |road: &RoadId| class(road) > own;
        let is_other = |road: &RoadId| class(road) != own;
        place.control == Control::Stop
            && (place.roads.iter().any(is_above) || !place.roads.iter().any(is_other))
    }

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

    /// Height of a road at a station along its centreline, m: even between its ends and the heights on its way.
    pub fn height(&self, road: RoadId, station: f64) -> f64 {
        let Some(road) = self.roads.get(road.index()) else { return 0.0 };
        let [from, to] = [road.from, road.to].map(|end| self.intersections[end.index()].height);
        let length = polyline::length(&road.centerline);
        let next = road.profile.partition_point(|(at, _)| *at <= station);
        let before = next.checked_sub(1).map_or((0.0, from), |index| road.profile[index]);
        let after = road.profile.get(next).copied().unwrap_or((length, to));
        let span = after.0 - before.0;
        if span > 0.0 {
            before.1 + (after.1 - before.1) * ((station - before.0) / span).clamp(0.0, 1.0)
        } else {
            before.1
        }
    }

    /// The rectangle around all centrelines, least and greatest corner; `None` without roads.
    pub fn bounds(&self) -> Option<(Point2, Point2)> {
        geometry::bounds(self.roads.iter().flat_map(|road| &road.centerline))
    }
}
