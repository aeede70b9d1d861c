//! Where on the road network somebody drives, and what lies ahead there.

use serde::{Deserialize, Serialize};
use simworld_core::geometry::{Point2, direction};
use simworld_core::id::LaneId;
use simworld_core::net::{Connection, Lane, LaneDirection, RoadNetwork, Turn, polyline};
use simworld_core::traffic::RoadLeg;

/// Farther than this beside a lane one is not on it, m: a parking lane and a verge.
const BESIDE: f64 = 15.0;
/// Lanes whose direction differs by more than 60° are those of others; the cosine of it.
const ALONG: f64 = 0.5;

/// A place on a lane.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct OnLane {
    pub(crate) lane: LaneId,
    /// m along the lane.
    pub(crate) station: f64,
    /// m beside it.
    pub(crate) distance: f64,
}

/// The driven lane nearest to a point that leads the way one looks, or any way without a heading; of two as near the
/// lower id.
pub(crate) fn lane_at(network: &RoadNetwork, point: Point2, heading: Option<f64>) -> Option<OnLane> {
    nearest_lane(network, point, heading).filter(|found| found.distance <= BESIDE)
}

/// As [`lane_at`], however far away.
pub(crate) fn nearest_lane(network: &RoadNetwork, point: Point2, heading: Option<f64>) -> Option<OnLane> {
    nearest_lane_where(network, point, heading, &|_| true)
}

/// As [`nearest_lane`], of those that pass a test.
pub(crate) fn nearest_lane_where(
    network: &RoadNetwork,
    point: Point2,
    heading: Option<f64>,
    suits: &dyn Fn(LaneId) -> bool,
) -> Option<OnLane> {
    let mut best: Option<OnLane> = None;
    let driven = |(index, lane): &(usize, &Lane)| lane.is_driven() && suits(LaneId::from_index(*index));
    for (index, lane) in network.lanes.iter().enumerate().filter(driven) {
        let Some(near) = polyline::closest(&lane.path, &point) else { continue };
        if best.is_some_and(|best| near.distance >= best.distance) {
            continue;
        }
        let along = direction(polyline::at(&lane.path, near.station).1);
        if heading.is_none_or(|heading| along.dot(&direction(heading)) >= ALONG) {
            let lane = LaneId::from_index(index);
            best = Some(OnLane { lane, station: near.station, distance: near.distance });
        }
    }
    best
}

/// The lane of that id.
pub(crate) fn lane(network: &RoadNetwork, id: LaneId) -> &Lane {
    &network.lanes[id.index()]
}

/// The driven lanes of the same road that go the same way, this one among them, from the middle outwards.
pub(crate) fn beside(network: &RoadNetwork, id: LaneId) -> Vec<LaneId> {
    let road = &network.roads[lane(network, id).road.index()];
    let same = if road.forward.contains(&id) { &road.forward } else { &road.backward };
    same.iter().copied().filter(|id| lane(network, *id).is_driven()).collect()
}

/// The direction of a road that a lane is part of.
pub(crate) fn leg_of(network: &RoadNetwork, id: LaneId) -> RoadLeg {
    let road = lane(network, id).road;
    let is_forward = network.roads[road.index()].forward.contains(&id);
    (road, if is_forward { LaneDirection::Forward } else { LaneDirection::Backward })
}

/// The ways on from the end of a lane and of those beside it, those of the lane itself first.
pub(crate) fn ways_on(network: &RoadNetwork, id: LaneId) -> Vec<&Connection> {
    let mut lanes = beside(network, id);
    lanes.sort_by_key(|other| *other != id);
    let ways =
        lanes.iter().flat_map(|id| &lane(network, *id).outgoing).map(|way| &network.connections[way.index()]);
    ways.filter(|way| lane(network, way.to).is_driven()).collect()
}

/// The way on that takes a turn, if there is one.
pub(crate) fn way_that(network: &RoadNetwork, id: LaneId, turn: Turn) -> Option<&Connection> {
    ways_on(network, id).into_iter().find(|way| way.turn == turn)
}

/// The way on where there is but one, as in a bend.
pub(crate) fn only_way(network: &RoadNetwork, id: LaneId) -> Option<&Connection> {
    let ways = ways_on(network, id);
    ways.first().copied().filter(|first| ways.iter().all(|way| way.turn == first.turn))
}

/// The way on of who goes where the road leads: straight on, or else the only way.
pub(crate) fn straight_on(network: &RoadNetwork, id: LaneId) -> Option<&Connection> {
    way_that(network, id, Turn::Straight).or_else(|| only_way(network, id))
}

/// The middle of a lane, and its heading there.
pub(crate) fn middle(network: &RoadNetwork, id: LaneId) -> (Point2, f64) {
    let lane = lane(network, id);
    polyline::at(&lane.path, lane.length * 0.5)
}
