//! Where ways for walkers pass over carriageways, and how high they have to be there.

use super::{FOOTBRIDGE_DECK, FOOTBRIDGE_HEADROOM};
use crate::geometry::{Point2, bounds};
use crate::id::RoadId;
use crate::net::{Footpath, Road, RoadNetwork, Sidewalk, polyline};

/// Distance between the places at which it is looked for what lies below, m: half as wide as a car.
const STEP: f64 = 0.5;
/// A street on the ground that is nearer than this says how high the ground is, m.
const GROUND: f64 = 60.0;

/// Where a way passes over a carriageway.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Passage {
    /// The way above, by its index.
    pub(super) way: usize,
    /// Stations along it where the carriageway begins and ends, m.
    pub(super) from: f64,
    pub(super) to: f64,
    /// The least height of the way there, m above the ground.
    pub(super) need: f64,
}

/// An end that joins leads on to a sidewalk that is no farther off, m, as in the waypoint graph.
const JOINS: f64 = 15.0;

/// All of them, by way; and the ends at sidewalks of bridges, which are to be as high.
pub(super) fn of(network: &RoadNetwork) -> Vec<Passage> {
    let extents: Vec<Option<(Point2, Point2)>> =
        network.roads.iter().map(|road| bounds(&road.centerline)).collect();
    let mut found = Vec::new();
    for (way, footpath) in network.footpaths.iter().enumerate().filter(|(_, way)| way.level > 0) {
        let Some((low, high)) = bounds(&footpath.path) else { continue };
        for (index, (road, extent)) in network.roads.iter().zip(&extents).enumerate() {
            let reach = road.left_kerb.max(road.right_kerb);
            let is_near =
                extent.is_some_and(|extent| (low - extent.1).sup(&(extent.0 - high)).max() <= reach);
            // What lies in a tunnel is below the ground.
            if is_near && (0..footpath.level).contains(&road.level) {
                below(network, (way, footpath), RoadId::from_index(index), &mut found);
            }
        }
        let ends = [(0.0, footpath.path.first()), (super::length(network, way), footpath.path.last())];
        let joins = ends.into_iter().zip(footpath.joins).filter(|(_, joins)| *joins);
        for (station, at) in joins.filter_map(|((station, at), _)| Some((station, *at?))) {
            let need = sidewalk(network, at);
            found.extend((need > 0.0).then_some(Passage { way, from: station, to: station, need }));
        }
    }
    found
}

/// Where a way lies over one street.
fn below(network: &RoadNetwork, (way, footpath): (usize, &Footpath), id: RoadId, found: &mut Vec<Passage>) {
    let length = super::length(network, way);
    let count = (length / STEP).ceil().max(1.0) as u32;
    let road = &network.roads[id.index()];
    let mut open: Option<Passage> = None;
    for rank in 0..=count {
        let station = length * (f64::from(rank) / f64::from(count));
        let at = polyline::at(&footpath.path, station).0;
        match over(road, at) {
            Some(below) => {
                let need = above_ground(network, id, below, at) + FOOTBRIDGE_HEADROOM + FOOTBRIDGE_DECK;
                // Its edge may be anywhere before this place.
                let from = (station - STEP).max(0.0);
                let passage = open.get_or_insert(Passage { way, from, to: station, need });
                (passage.to, passage.need) = ((station + STEP).min(length), passage.need.max(need));
            }
            None => found.extend(open.take()),
        }
    }
    found.extend(open);
}

/// The station of a street on whose carriageway a place is.
fn over(road: &Road, at: Point2) -> Option<f64> {
    let near = polyline::closest(&road.centerline, &at)?;
    let kerb = if near.lateral >= 0.0 { road.left_kerb } else { road.right_kerb };
    (near.distance <= kerb).then_some(near.station)
}

/// How high a street lies above the ground at a place, m.
fn above_ground(network: &RoadNetwork, id: RoadId, station: f64, at: Point2) -> f64 {
    let road = &network.roads[id.index()];
    if road.level <= 0 {
        return 0.0;
    }
    let mut nearest: Option<(f64, f64)> = None;
    for (index, other) in network.roads.iter().enumerate().filter(|(_, other)| other.level == 0) {
        let Some((low, high)) = bounds(&other.centerline) else { continue };
        if (low - at).sup(&(at - high)).max() > GROUND {
            continue;
        }
        let Some(near) = polyline::closest(&other.centerline, &at) else { continue };
        if near.distance <= GROUND && nearest.is_none_or(|(least, _)| near.distance < least) {
            nearest = Some((near.distance, network.height(RoadId::from_index(index), near.station)));
        }
    }
    let ends = [road.from, road.to].map(|end| network.intersections[end.index()].height);
    let ground = nearest.map_or(ends[0].min(ends[1]), |(_, height)| height);
    (network.height(id, station) - ground).max(0.0)
}

/// The height above the ground of the sidewalk that is nearest to an end that joins it, m: those of bridges lie high.
pub(super) fn sidewalk(network: &RoadNetwork, at: Point2) -> f64 {
    let distance = |walk: &Sidewalk| {
        let (low, high) = bounds(&walk.path)?;
        if (low - at).sup(&(at - high)).max() > JOINS {
            return None;
        }
        polyline::closest(&walk.path, &at).map(|near| near.distance).filter(|distance| *distance < JOINS)
    };
    let is_high = |walk: &&Sidewalk| network.roads[walk.road.index()].level > 0;
    // Most are far from all bridges.
    if !network.sidewalks.iter().filter(is_high).any(|walk| distance(walk).is_some()) {
        return 0.0;
    }
    let all = network.sidewalks.iter().filter_map(|walk| Some((distance(walk)?, walk.road)));
    let Some((_, road)) = all.min_by(|a, b| a.0.total_cmp(&b.0)) else { return 0.0 };
    let near = polyline::closest(&network.roads[road.index()].centerline, &at);
    near.map_or(0.0, |near| above_ground(network, road, near.station, at))
}
