//! The strips of a road side by side, as its lanes and strips lie.

use simworld_core::geometry::Point2;
use simworld_core::id::{LaneId, RoadId};
use simworld_core::net::{Control, Lane, LaneDirection, LaneKind, RoadNetwork, Turn, polyline};

/// A strip of a road.
#[derive(Clone, Copy, Debug)]
pub(super) struct Strip {
    pub kind: LaneKind,
    /// Its middle, to the left of the centreline, m.
    pub offset: f64,
    pub width: f64,
    /// Stations where it begins and ends, ascending, m.
    pub stations: (f64, f64),
    /// Whether it is driven along the centreline.
    pub forward: bool,
    pub lane: Option<LaneId>,
}

impl Strip {
    pub(super) fn left(&self) -> f64 {
        self.offset + self.width * 0.5
    }

    pub(super) fn right(&self) -> f64 {
        self.offset - self.width * 0.5
    }

    /// Where whoever drives on it comes to its end.
    pub(super) fn end(&self) -> f64 {
        if self.forward { self.stations.1 } else { self.stations.0 }
    }
}

/// The strips of a road from left to right.
pub(super) fn strips_of(network: &RoadNetwork, road: RoadId) -> Vec<Strip> {
    let road = &network.roads[road.index()];
    let lanes = road.lanes().map(|id| of_lane(&network.lanes[id.index()], id, &road.centerline));
    let others = road.strips.iter().filter(|strip| strip.kind != LaneKind::Cycle).map(|strip| Strip {
        kind: strip.kind,
        offset: strip.offset,
        width: strip.width,
        stations: strip.stations,
        forward: strip.direction != LaneDirection::Backward,
        lane: None,
    });
    let mut strips: Vec<Strip> = lanes.flatten().chain(others).collect();
    strips.sort_by(|a, b| b.offset.total_cmp(&a.offset));
    strips
}

fn of_lane(lane: &Lane, id: LaneId, centerline: &[Point2]) -> Option<Strip> {
    let at = |station: f64| polyline::closest(centerline, &polyline::at(&lane.path, station).0);
    let (first, last, middle) = (at(0.0)?, at(lane.length)?, at(lane.length * 0.5)?);
    let forward = first.station <= last.station;
    let stations = (first.station.min(last.station), first.station.max(last.station));
    Some(Strip {
        kind: lane.kind,
        offset: middle.lateral,
        width: lane.width,
        stations,
        forward,
        lane: Some(id),
    })
}

/// What is painted where a lane ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum End {
    Nothing,
    /// A line before which one stops.
    Stop,
    /// A broken line before which one gives way.
    GiveWay,
}

/// What is painted where a lane ends: the line of a signal or a stop sign, or of who gives way though it goes straight on or
/// turns to the side on which traffic keeps.
pub(super) fn end_of(network: &RoadNetwork, lane: LaneId) -> End {
    let data = &network.lanes[lane.index()];
    let place = &network.intersections[data.to.index()];
    if place.roads.len() < 3 {
        return End::Nothing;
    }
    let away = match network.driving_side {
        simworld_core::net::DrivingSide::Right => Turn::Left,
        simworld_core::net::DrivingSide::Left => Turn::Right,
    };
    let gives_way = || {
        let ways = data.outgoing.iter().map(|id| &network.connections[id.index()]);
        let mut own = ways.filter(|way| way.turn != away && way.turn != Turn::UTurn);
        own.any(|way| !way.yields_to.is_empty())
    };
    match place.control {
        Control::Signals => End::Stop,
        Control::Stop if network.stops_at(lane) => End::Stop,
        Control::Priority | Control::Stop if gives_way() => End::GiveWay,
        _ => End::Nothing,
    }
}

/// The directions in which one may leave a lane: 1 left, 2 straight on, 4 right; 0 where no arrow is needed.
pub(super) fn ways_of(network: &RoadNetwork, lane: LaneId) -> u32 {
    let data = &network.lanes[lane.index()];
    if network.intersections[data.to.index()].roads.len() < 3 {
        return 0;
    }
    let bit = |turn: Turn| match turn {
        Turn::Left => 1,
        Turn::Straight => 2,
        Turn::Right => 4,
        Turn::UTurn => 0,
    };
    data.outgoing.iter().fold(0, |bits, id| bits | bit(network.connections[id.index()].turn))
}
