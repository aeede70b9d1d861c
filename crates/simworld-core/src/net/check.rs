//! Whether a network that came from outside holds together: every reference leads somewhere, every list is in its
//! order, every number is one. Whoever reads a network may then rely on it as on a derived one.

use thiserror::Error;

use super::{Hammerhead, Phase, RoadNetwork, SignalGroup};
use crate::geometry::Point2;
use crate::id::ConnectionId;

/// Farthest coordinate, m.
const FARTHEST: f64 = 1e7;
/// Widest strip and longest way, m.
const WIDEST: f64 = 1000.0;
const LONGEST: f64 = 1e7;
/// Fastest speed, m/s.
const FASTEST: f64 = 200.0;

/// Something in a network that cannot be.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{what} {index} {fault}: derive the network anew from its plan")]
pub struct NetworkFault {
    /// What it is.
    pub what: &'static str,
    /// Its index.
    pub index: usize,
    /// What is wrong with it.
    pub fault: &'static str,
}

/// The first thing of a list at fault.
fn all<T>(
    what: &'static str,
    things: &[T],
    fault: impl Fn(usize, &T) -> Option<&'static str>,
) -> Result<(), NetworkFault> {
    let found = things.iter().enumerate().find_map(|(index, thing)| Some((index, fault(index, thing)?)));
    found.map_or(Ok(()), |(index, fault)| Err(NetworkFault { what, index, fault }))
}

fn is_near(point: &Point2) -> bool {
    point.x.abs() <= FARTHEST && point.y.abs() <= FARTHEST
}

fn is_line(points: &[Point2]) -> bool {
    points.len() >= 2 && points.iter().all(is_near)
}

fn is_within(x: f64, most: f64) -> bool {
    x >= 0.0 && x <= most
}

fn is_ascending<T: Ord>(list: &[T]) -> bool {
    list.is_sorted_by(|a, b| a < b)
}

const LOST: Option<&str> = Some("refers to something that is not there");
const SHAPELESS: Option<&str> = Some("has no possible course");
const SIZELESS: Option<&str> = Some("has no possible size or speed");
const DISORDERED: Option<&str> = Some("has a list out of order");

impl RoadNetwork {
    /// Checks a network that was read from somewhere. Derived networks hold together by themselves.
    ///
    /// ```
    /// use simworld_core::net::{NetworkConfig, RoadNetwork, StreetPlan};
    /// let mut network = RoadNetwork::derive(&StreetPlan::crossroads(100.0), &NetworkConfig::default())?;
    /// assert_eq!(network.check(), Ok(()));
    /// network.lanes.truncate(3);
    /// assert_eq!(network.check().unwrap_err().what, "road");
    /// # Ok::<(), simworld_core::net::NetworkError>(())
    /// ```
    ///
    /// # Errors
    /// The first thing at fault.
    pub fn check(&self) -> Result<(), NetworkFault> {
        self.check_roads()?;
        self.check_lanes()?;
        self.check_connections()?;
        self.check_intersections()?;
        self.check_walkways()?;
        self.check_signals()
    }

    fn check_roads(&self) -> Result<(), NetworkFault> {
        all("road", &self.roads, |_, road| {
            let ends = [road.from, road.to].iter().all(|end| end.index() < self.intersections.len());
            let mut lanes = road.forward.iter().chain(&road.backward).chain(&road.cycle);
            let lanes = lanes.all(|lane| lane.index() < self.lanes.len());
            let strips = road.strips.iter().all(|strip| {
                let (from, to) = strip.stations;
                let is_along = is_within(from, LONGEST) && is_within(to, LONGEST);
                is_along && strip.offset.abs() <= WIDEST && is_within(strip.width, WIDEST)
            });
            let walks = road.sidewalks.iter().flatten().all(|walk| walk.index() < self.sidewalks.len());
            let is_height =
                |(station, height): &(f64, f64)| is_within(*station, LONGEST) && height.abs() <= FARTHEST;
            let profile = road.profile.iter().all(is_height) && road.profile.is_sorted_by(|a, b| a.0 < b.0);
            let name = road.name.is_none_or(|name| (name as usize) < self.names.len());
            let kerbs = [road.left_kerb, road.right_kerb].iter().all(|kerb| kerb.abs() <= WIDEST);
            match () {
                () if !(ends && lanes && walks && name) => LOST,
                () if !(is_line(&road.centerline) && profile) => SHAPELESS,
                () if !(kerbs && strips && is_within(road.width, WIDEST)) => SIZELESS,
                () => None,
            }
        })
    }

    fn check_lanes(&self) -> Result<(), NetworkFault> {
        all("lane", &self.lanes, |_, lane| {
            let ends = [lane.from, lane.to].iter().all(|end| end.index() < self.intersections.len());
            let ways = lane.outgoing.iter().all(|way| way.index() < self.connections.len());
            let speed = lane.speed_limit > 0.0 && lane.speed_limit <= FASTEST;
            match () {
                () if !(ends && ways && lane.road.index() < self.roads.len()) => LOST,
                () if !is_line(&lane.path) => SHAPELESS,
                () if !(speed && is_within(lane.width, WIDEST) && is_within(lane.length, LONGEST)) => {
                    SIZELESS
                }
                () => None,
            }
        })
    }

    fn check_connections(&self) -> Result<(), NetworkFault> {
        let groups = self.signal_groups();
        all("connection", &self.connections, |index, way| {
            let own = ConnectionId::from_index(index);
            let lanes = [way.from, way.to].iter().all(|lane| lane.index() < self.lanes.len());
            let rivals =
                way.conflicts.iter().all(|rival| rival.index() < self.connections.len() && *rival != own);
            let yields = way.yields_to.iter().all(|rival| way.conflicts.binary_search(rival).is_ok());
            let walks = way.crossings.iter().all(|crossing| crossing.index() < self.crossings.len());
            let signal = way.signal.is_none_or(|group| group.index() < groups);
            let place = way.intersection.index() < self.intersections.len();
            match () {
                () if !(lanes && rivals && walks && signal && place) => LOST,
                () if !is_line(&way.path) => SHAPELESS,
                () if !is_within(way.length, LONGEST) => SIZELESS,
                () if !(is_ascending(&way.conflicts) && is_ascending(&way.yields_to) && yields) => DISORDERED,
                () if !is_ascending(&way.crossings) => DISORDERED,
                () => None,
            }
        })
    }

    fn check_intersections(&self) -> Result<(), NetworkFault> {
        all("intersection", &self.intersections, |index, place| {
            let roads = place.roads.iter().all(|road| road.index() < self.roads.len());
            let ways = place.connections.iter().all(|way| way.index() < self.connections.len());
            let walks = place.crossings.iter().all(|crossing| crossing.index() < self.crossings.len());
            let corners = place.corners.len() <= place.roads.len();
            let own = |plan: u32| {
                let plan = self.signals.get(plan as usize);
                plan.is_some_and(|plan| plan.intersection.index() == index)
            };
            let signals = place.signals.is_none_or(own);
            let kerbs = is_ascending(&place.kerbs)
                && place.kerbs.iter().all(|kerb| (*kerb as usize) < place.outline.len());
            let points = place.outline.iter().chain(place.corners.iter().flatten());
            let circle = place.turning.is_none_or(|it| is_near(&it.center) && is_within(it.radius, WIDEST));
            let is_head = |it: Hammerhead| it.tips.iter().all(is_near) && is_within(it.width, WIDEST);
            let head = place.hammerhead.is_none_or(is_head);
            match () {
                () if !(roads && ways && walks && corners && signals) => LOST,
                () if !(circle && head) => SIZELESS,
                () if !kerbs || place.kerbs.len() > place.roads.len() => DISORDERED,
                () if place.height.is_nan() || place.height.abs() > FARTHEST => SHAPELESS,
                () if !(is_near(&place.center) && points.into_iter().all(is_near)) => SHAPELESS,
                () => None,
            }
        })
    }

    fn check_walkways(&self) -> Result<(), NetworkFault> {
        all("sidewalk", &self.sidewalks, |_, walk| match () {
            () if walk.road.index() >= self.roads.len() => LOST,
            () if !is_line(&walk.path) => SHAPELESS,
            () if !is_within(walk.width, WIDEST) => SIZELESS,
            () => None,
        })?;
        all("footpath", &self.footpaths, |_, way| match () {
            () if !is_line(&way.path) => SHAPELESS,
            () if !is_within(way.width, WIDEST) => SIZELESS,
            () if way.plaza.is_some_and(|plaza| plaza.index() >= self.plazas.len()) => LOST,
            () => None,
        })?;
        let is_ring = |ring: &[Point2]| ring.len() >= 3 && ring.iter().all(is_near);
        all("plaza", &self.plazas, |_, plaza| if plaza.rings().all(is_ring) { None } else { SHAPELESS })?;
        let groups = self.signal_groups();
        all("crossing", &self.crossings, |_, crossing| {
            let signal = crossing.signal.is_none_or(|group| group.index() < groups);
            let place = crossing.intersection.index() < self.intersections.len();
            match () {
                () if !(signal && place && crossing.road.index() < self.roads.len()) => LOST,
                () if !is_line(&[crossing.start, crossing.end]) => SHAPELESS,
                () if !is_within(crossing.width, WIDEST) => SIZELESS,
                () => None,
            }
        })
    }

    fn check_signals(&self) -> Result<(), NetworkFault> {
        let groups = self.signal_groups();
        let known = |list: &[SignalGroup]| list.iter().all(|group| group.index() < groups);
        let is_timed = |phase: &Phase| phase.duration > 0.0 && phase.duration <= 86_400.0;
        all("signal plan", &self.signals, |_, plan| {
            let lists = plan.phases.iter().flat_map(|phase| [&phase.green[..], &phase.yellow]);
            let mut all_lists = lists.chain([&plan.groups[..]]);
            match () {
                () if plan.intersection.index() >= self.intersections.len() => LOST,
                () if !all_lists.clone().all(known) => LOST,
                () if !all_lists.all(is_ascending) => DISORDERED,
                () if !(plan.offset.is_finite() && plan.phases.iter().all(is_timed)) => SIZELESS,
                () => None,
            }
        })
    }
}
