//! Lanes: strips right of the centreline, from stop line to stop line.

use super::NetworkConfig;
use super::legs::Leg;
use crate::geometry::Point2;
use crate::id::{IntersectionId, LaneId, RoadId};
use crate::net::{Lane, RoadNetwork, polyline};

/// Cuts both ends off every centreline and lays the lanes beside what is left.
pub(super) fn add(network: &mut RoadNetwork, legs: &[Vec<Leg>], config: &NetworkConfig) {
    let mut stops = vec![(0.0, 0.0); network.roads.len()];
    let mut counts = vec![(0_usize, 0_usize); network.roads.len()];
    for leg in legs.iter().flatten() {
        let lanes = |width: f64| (width / config.lane_width).round() as usize;
        if leg.at_start {
            stops[leg.street].0 = leg.stop;
            counts[leg.street] = (lanes(leg.right), lanes(leg.left));
        } else {
            stops[leg.street].1 = leg.stop;
        }
    }
    for (index, ((start, end), (forward, backward))) in stops.into_iter().zip(counts).enumerate() {
        let road = &network.roads[index];
        let length = polyline::length(&road.centerline);
        let middle = polyline::slice(&road.centerline, start, length - end);
        let back = polyline::reversed(&middle);
        let (from, to) = (road.from, road.to);
        for rank in 0..forward {
            let id = lay(network, index, &middle, rank, (from, to), config);
            network.roads[index].forward.push(id);
        }
        for rank in 0..backward {
            let id = lay(network, index, &back, rank, (to, from), config);
            network.roads[index].backward.push(id);
        }
    }
}

/// Lays the lane of that rank, counted from the middle, to the right of a directed line.
fn lay(
    network: &mut RoadNetwork,
    road: usize,
    line: &[Point2],
    rank: usize,
    (from, to): (IntersectionId, IntersectionId),
    config: &NetworkConfig,
) -> LaneId {
    let id = LaneId::from_index(network.lanes.len());
    let path = polyline::offset(line, -(rank as f64 + 0.5) * config.lane_width);
    network.lanes.push(Lane {
        road: RoadId::from_index(road),
        length: polyline::length(&path),
        path,
        width: config.lane_width,
        speed_limit: config.speed_limit(network.roads[road].class),
        from,
        to,
        outgoing: Vec::new(),
    });
    id
}
