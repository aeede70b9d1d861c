//! Networks put together lane by lane, for readers of maps that say themselves where lanes lie: nothing is derived from
//! street plans, but what follows from the lanes is worked out and all of it is checked.

mod finish;

use super::derive::curve;
use super::{
    Connection, Control, Crossing, DrivingSide, Few, Intersection, Lane, LaneDirection, LaneKind,
    NetworkFault, Phase, Road, RoadClass, RoadNetwork, Side, Sidewalk, SignalGroup, SignalPlan, Turn,
    polyline,
};
use crate::geometry::{Point2, direction};
use crate::id::{ConnectionId, CrossingId, IntersectionId, LaneId, RoadId, SidewalkId};

/// A road that is to be.
#[derive(Clone, Debug, PartialEq)]
pub struct NewRoad {
    /// Its rank.
    pub class: RoadClass,
    /// Where its centreline begins, and where it ends.
    pub ends: (IntersectionId, IntersectionId),
    /// The centreline from junction centre to junction centre, at least two points, m.
    pub centerline: Vec<Point2>,
    /// Its name, if it has one.
    pub name: Option<String>,
    /// Heights on its way: station along the centreline and height, m, ascending.
    pub profile: Vec<(f64, f64)>,
    /// Whether it is a part of the ring of a roundabout.
    pub roundabout: bool,
}

/// A lane that is to be.
#[derive(Clone, Debug, PartialEq)]
pub struct NewLane {
    /// What it is for: [`Driving`](LaneKind::Driving), [`Bus`](LaneKind::Bus) or [`Cycle`](LaneKind::Cycle).
    pub kind: LaneKind,
    /// Along the centreline of its road or against it.
    pub direction: LaneDirection,
    /// Its middle in the direction of traffic, at least two points, m.
    pub path: Vec<Point2>,
    /// Width, m.
    pub width: f64,
    /// Speed limit, m/s.
    pub speed_limit: f64,
}

/// Puts a [`RoadNetwork`] together from lanes and the ways between them.
///
/// Give first the intersections, then roads with their lanes, then connections. What is not given follows: lengths,
/// kerbs, the order of roads about an intersection, walkways round corners, which crossings a way passes, and, unless
/// [`add_conflict`](Self::add_conflict) says it, which ways touch and who gives way.
///
/// ```
/// use simworld_core::geometry::Point2;
/// use simworld_core::net::{LaneDirection, LaneKind, NetworkBuilder, NewLane, NewRoad, Turn};
/// let mut builder = NetworkBuilder::default();
/// let ends: Vec<_> =
///     [0.0, 100.0, 200.0].map(|x| builder.add_intersection(Point2::new(x, 0.0), 0.0, Vec::new())).into();
/// let mut lane = |from: usize| {
///     let x = from as f64 * 100.0;
///     let road = builder.add_road(NewRoad {
///         class: Default::default(),
///         ends: (ends[from], ends[from + 1]),
///         centerline: vec![Point2::new(x, 0.0), Point2::new(x + 100.0, 0.0)],
///         name: None,
///         profile: Vec::new(),
///         roundabout: false,
///     });
///     let path = vec![Point2::new(x + 5.0, -2.0), Point2::new(x + 95.0, -2.0)];
///     let (kind, direction) = (LaneKind::Driving, LaneDirection::Forward);
///     builder.add_lane(road, NewLane { kind, direction, path, width: 3.5, speed_limit: 13.9 })
/// };
/// let (first, second) = (lane(0), lane(1));
/// builder.add_connection(first, second, Turn::Straight, None);
/// let network = builder.finish()?;
/// assert_eq!(network.connections[0].length, 10.0);
/// assert_eq!(network.roads[0].right_kerb, 3.75);
/// # Ok::<(), simworld_core::net::NetworkFault>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct NetworkBuilder {
    network: RoadNetwork,
    /// Intersections whose right of way is given, ascending once finished.
    settled: Vec<IntersectionId>,
}

impl NetworkBuilder {
    /// Nothing yet, with traffic on that side.
    pub fn new(driving_side: DrivingSide) -> Self {
        Self { network: RoadNetwork { driving_side, ..RoadNetwork::default() }, settled: Vec::new() }
    }

    /// What there is so far; its lists of references are empty until it is finished.
    pub fn network(&self) -> &RoadNetwork {
        &self.network
    }

    /// Adds a place where roads meet: its middle, height and paved area, m. Without signals and conflicts nobody says who
    /// may go there.
    pub fn add_intersection(&mut self, center: Point2, height: f64, outline: Vec<Point2>) -> IntersectionId {
        self.network.intersections.push(Intersection {
            center,
            height,
            outline,
            kerbs: Few::new(),
            turning: None,
            roads: Few::new(),
            control: Control::None,
            signals: None,
            connections: Vec::new(),
            crossings: Few::new(),
            corners: Vec::new(),
            hammerhead: None,
        });
        IntersectionId::from_index(self.network.intersections.len() - 1)
    }

    /// Adds a road without lanes.
    pub fn add_road(&mut self, road: NewRoad) -> RoadId {
        let name = road.name.map(|name| {
            self.network.names.push(name);
            (self.network.names.len() - 1) as u32
        });
        self.network.roads.push(Road {
            class: road.class,
            from: road.ends.0,
            to: road.ends.1,
            centerline: road.centerline,
            name,
            width: 0.0,
            left_kerb: 0.0,
            right_kerb: 0.0,
            forward: Few::new(),
            backward: Few::new(),
            cycle: Few::new(),
            strips: Vec::new(),
            sidewalks: [None; 2],
            roundabout: road.roundabout,
            level: 0,
            profile: road.profile,
        });
        RoadId::from_index(self.network.roads.len() - 1)
    }

    /// Adds a lane beside those that its road has in that direction: from the middle of the road outwards, those for
    /// bicycles from left to right along the centreline.
    pub fn add_lane(&mut self, road: RoadId, lane: NewLane) -> LaneId {
        let id = LaneId::from_index(self.network.lanes.len());
        let backward = lane.direction == LaneDirection::Backward;
        // A road that is not there is found when all is checked.
        let (mut from, mut to) = Default::default();
        if let Some(owner) = self.network.roads.get_mut(road.index()) {
            (from, to) = if backward { (owner.to, owner.from) } else { (owner.from, owner.to) };
            match (lane.kind, backward) {
                (LaneKind::Cycle, _) => owner.cycle.push(id),
                (_, true) => owner.backward.push(id),
                (_, false) => owner.forward.push(id),
            }
        }
        self.network.lanes.push(Lane {
            road,
            kind: lane.kind,
            length: polyline::length(&lane.path),
            path: lane.path,
            width: lane.width,
            speed_limit: lane.speed_limit,
            from,
            to,
            outgoing: Few::new(),
        });
        id
    }

    /// Adds the walkway on a side of a road: its middle in the direction of the centreline, and its width, m.
    pub fn add_sidewalk(&mut self, road: RoadId, side: Side, path: Vec<Point2>, width: f64) -> SidewalkId {
        let id = SidewalkId::from_index(self.network.sidewalks.len());
        if let Some(owner) = self.network.roads.get_mut(road.index()) {
            owner.sidewalks[usize::from(side == Side::Right)] = Some(id);
        }
        self.network.sidewalks.push(Sidewalk { road, side, path, width });
        id
    }

    /// Adds a marked crossing of a road at an intersection, from the kerb on the left, seen from there, to the right.
    pub fn add_crossing(
        &mut self,
        intersection: IntersectionId,
        road: RoadId,
        (start, end): (Point2, Point2),
        width: f64,
    ) -> CrossingId {
        self.network.crossings.push(Crossing { intersection, road, start, end, width, signal: None });
        CrossingId::from_index(self.network.crossings.len() - 1)
    }

    /// Adds a way from a lane to another across the intersection between them; without a path a smooth one is drawn.
    pub fn add_connection(
        &mut self,
        from: LaneId,
        to: LaneId,
        turn: Turn,
        path: Option<Vec<Point2>>,
    ) -> ConnectionId {
        let lanes = [from, to].map(|lane| self.network.lanes.get(lane.index()));
        let drawn = || match lanes {
            [Some(entry), Some(exit)] => {
                let (start, out) = polyline::at(&entry.path, entry.length);
                let (end, back) = polyline::at(&exit.path, 0.0);
                curve(start, direction(out), end, direction(back))
            }
            _ => Vec::new(),
        };
        let intersection = lanes[0].map_or_else(IntersectionId::default, |lane| lane.to);
        let path = path.unwrap_or_else(drawn);
        self.network.connections.push(Connection {
            from,
            to,
            intersection,
            turn,
            length: polyline::length(&path),
            path,
            signal: None,
            conflicts: Few::new(),
            yields_to: Few::new(),
            crossings: Few::new(),
        });
        ConnectionId::from_index(self.network.connections.len() - 1)
    }

    /// Says that the right of way at an intersection is given in full, even where nobody is in anybody's way.
    pub fn settle(&mut self, intersection: IntersectionId) {
        self.settled.push(intersection);
    }

    /// Puts [stop signs](Control::Stop) at an intersection.
    pub fn set_stop(&mut self, intersection: IntersectionId) {
        if let Some(place) = self.network.intersections.get_mut(intersection.index()) {
            place.control = Control::Stop;
        }
    }

    /// Says that two ways touch, and which of them, if any, gives way while both may go.
    pub fn add_conflict(&mut self, a: ConnectionId, b: ConnectionId, gives_way: Option<ConnectionId>) {
        for (own, other) in [(a, b), (b, a)] {
            if let Some(way) = self.network.connections.get_mut(own.index()) {
                way.conflicts.push(other);
                if gives_way == Some(own) {
                    way.yields_to.push(other);
                }
            }
        }
    }

    /// Adds signals to an intersection: `count` groups, counted from zero in the phases, which are given the numbers from
    /// the returned one on.
    pub fn add_signals(
        &mut self,
        intersection: IntersectionId,
        count: u32,
        offset: f64,
        mut phases: Vec<Phase>,
    ) -> SignalGroup {
        let first =
            self.network.signals.last().and_then(|plan| plan.groups.last()).map_or(0, |group| group.0 + 1);
        for group in phases.iter_mut().flat_map(|phase| phase.green.iter_mut().chain(&mut phase.yellow)) {
            group.0 += first;
        }
        if let Some(place) = self.network.intersections.get_mut(intersection.index()) {
            place.control = Control::Signals;
            place.signals = Some(self.network.signals.len() as u32);
        }
        let groups = (first..first + count).map(SignalGroup).collect();
        self.network.signals.push(SignalPlan { intersection, groups, offset, phases });
        SignalGroup(first)
    }

    /// Puts a way under a signal.
    pub fn set_signal(&mut self, connection: ConnectionId, group: SignalGroup) {
        if let Some(way) = self.network.connections.get_mut(connection.index()) {
            way.signal = Some(group);
        }
    }

    /// Puts a crossing under a signal.
    pub fn set_crossing_signal(&mut self, crossing: CrossingId, group: SignalGroup) {
        if let Some(crossing) = self.network.crossings.get_mut(crossing.index()) {
            crossing.signal = Some(group);
        }
    }

    /// Works out what follows, and checks all of it.
    ///
    /// # Errors
    /// The first thing that cannot be; see [`RoadNetwork::check`].
    pub fn finish(self) -> Result<RoadNetwork, NetworkFault> {
        finish::finish(self)
    }
}
