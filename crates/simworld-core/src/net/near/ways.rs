//! The ways across joined junctions: those of the single ones, one after another.

use super::find::Compound;
use crate::geometry::{Point2, direction};
use crate::id::LaneId;
use crate::net::{Connection, Crossing, Lane, RoadNetwork, SignalGroup, Turn, derive, polyline};
use crate::ops::wrap_angle;

/// A change of heading below this counts as straight on, radians.
const STRAIGHT: f64 = 0.7;
/// Points of a path nearer to one another than this are one, m.
const SAME: f64 = 1e-3;

/// A way from a lane that leads in to one that leads out.
#[derive(Clone, Debug)]
pub(super) struct Composed {
    pub(super) from: LaneId,
    pub(super) to: LaneId,
    pub(super) turn: Turn,
    pub(super) path: Vec<Point2>,
    /// The first light on it.
    pub(super) signal: Option<SignalGroup>,
    /// The lanes inside over which it leads.
    pub(super) through: Vec<LaneId>,
    /// How often it changes lanes inside.
    changes: usize,
    length: f64,
}

/// All ways across, ascending by the lanes that they join; between two lanes the shortest. `None` if from one of the lanes that lead
/// in none leads on, or to one of those that lead out none leads that was led to before.
///
/// Where single ways lead from one road to another, but over different lanes inside, one way changes lanes there.
pub(super) fn composed(network: &RoadNetwork, compound: &Compound) -> Option<Vec<Composed>> {
    let is_in =
        |lane: &Lane| compound.has(lane.to) && !compound.is_inside(lane.road) && !lane.outgoing.is_empty();
    let lanes = network.lanes.iter().enumerate().filter(|(_, lane)| is_in(lane));
    let lanes: Vec<LaneId> = lanes.map(|(index, _)| LaneId::from_index(index)).collect();
    let mut all = search(network, compound, &lanes, false);
    all.sort_by(|a, b| (a.from, a.to).cmp(&(b.from, b.to)).then(a.length.total_cmp(&b.length)));
    all.dedup_by_key(|way| (way.from, way.to));
    add_changing(network, search(network, compound, &lanes, true), &mut all);
    let ways = compound.nodes.iter().flat_map(|node| &network.intersections[node.index()].connections);
    let mut out = ways.map(|way| network.connections[way.index()].to);
    let leads_out = |lane: &LaneId| !compound.is_inside(network.lanes[lane.index()].road);
    let are_all = lanes.iter().all(|lane| all.iter().any(|way| way.from == *lane))
        && out.all(|lane| !leads_out(&lane) || all.iter().any(|way| way.to == lane));
    are_all.then_some(all)
}

/// Adds ways that change lanes between roads between which there are no others: one for two roads, with the fewest changes.
fn add_changing(network: &RoadNetwork, mut changing: Vec<Composed>, all: &mut Vec<Composed>) {
    let road = |lane: LaneId| {
        let lane = &network.lanes[lane.index()];
        (lane.road, lane.from, lane.is_driven())
    };
    let ends = |way: &Composed| (road(way.from), road(way.to));
    let known: Vec<_> = all.iter().map(ends).collect();
    changing.retain(|way| !known.contains(&ends(way)));
    changing.sort_by(|a, b| {
        let by_ends = ends(a).cmp(&ends(b));
        by_ends.then(a.changes.cmp(&b.changes)).then(a.length.total_cmp(&b.length)).then(a.from.cmp(&b.from))
    });
    changing.dedup_by_key(|way| ends(way));
    all.append(&mut changing);
    all.sort_by_key(|way| (way.from, way.to));
}

fn search(network: &RoadNetwork, compound: &Compound, lanes: &[LaneId], may_change: bool) -> Vec<Composed> {
    let mut search = Search { network, compound, may_change, ways: Vec::new(), found: Vec::new() };
    for lane in lanes {
        search.go_on(*lane);
    }
    search.found
}

struct Search<'a> {
    network: &'a RoadNetwork,
    compound: &'a Compound,
    /// Whether one may change to another lane of a road inside.
    may_change: bool,
    /// The ways up to here, and the lane on which one goes on after each.
    ways: Vec<(&'a Connection, LaneId)>,
    found: Vec<Composed>,
}

impl Search<'_> {
    /// Follows all ways from the end of a lane; no node is crossed twice.
    fn go_on(&mut self, lane: LaneId) {
        let network = self.network;
        let at = network.lanes[lane.index()].to;
        if self.ways.iter().any(|(way, _)| way.intersection == at) {
            return;
        }
        for id in &network.lanes[lane.index()].outgoing {
            let way = &network.connections[id.index()];
            if !self.compound.is_inside(network.lanes[way.to.index()].road) {
                self.ways.push((way, way.to));
                // Nobody drives in a circle.
                if way.to != self.ways[0].0.from {
                    self.found.push(self.compose());
                }
                self.ways.pop();
                continue;
            }
            for on in self.lanes_after(way) {
                self.ways.push((way, on));
                self.go_on(on);
                self.ways.pop();
            }
        }
    }

    /// The lane to which a way leads, and those beside to which one may change.
    fn lanes_after(&self, way: &Connection) -> Vec<LaneId> {
        let road = &self.network.roads[self.network.lanes[way.to.index()].road.index()];
        let mut lanes = vec![way.to];
        for list in [&road.forward, &road.backward] {
            if self.may_change && list.contains(&way.to) {
                lanes.extend(list.iter().filter(|lane| **lane != way.to));
            }
        }
        lanes
    }

    fn compose(&self) -> Composed {
        let lane = |id: LaneId| &self.network.lanes[id.index()];
        let (first, last) = (self.ways[0].0, self.ways[self.ways.len() - 1].0);
        let mut path: Vec<Point2> = Vec::new();
        let (mut through, mut changes) = (Vec::new(), 0);
        for (way, on) in &self.ways {
            extend(&mut path, &way.path);
            if way.to != *on {
                let (end, leaving) = polyline::at(&path, polyline::length(&path));
                let (start, along) = polyline::at(&lane(*on).path, lane(*on).length);
                extend(&mut path, &derive::curve(end, direction(leaving), start, direction(along)));
                changes += 1;
            } else if way.to != last.to {
                extend(&mut path, &lane(*on).path);
            }
            if way.to != last.to {
                through.push(*on);
            }
        }
        let signal = self.ways.iter().find_map(|(way, _)| way.signal);
        let turn = turn(self.ways.iter().map(|(way, _)| way.turn), &path);
        let length = polyline::length(&path);
        Composed { from: first.from, to: last.to, turn, signal, through, changes, length, path }
    }
}

/// Goes on along a path; where the two meet there is one point.
fn extend(path: &mut Vec<Point2>, on: &[Point2]) {
    for point in on {
        if path.last().is_none_or(|last| (point - last).norm() > SAME) {
            path.push(*point);
        }
    }
}

/// The turn that some turns make together.
fn turn(turns: impl Iterator<Item = Turn>, path: &[Point2]) -> Turn {
    let mut bends = turns.filter(|turn| *turn != Turn::Straight);
    match (bends.next(), bends.next()) {
        (None, _) => Turn::Straight,
        (Some(turn), None) => turn,
        _ => {
            let heading = |station| polyline::at(path, station).1;
            match wrap_angle(heading(polyline::length(path)) - heading(0.0)) {
                change if change.abs() <= STRAIGHT => Turn::Straight,
                change if change > 0.0 => Turn::Left,
                _ => Turn::Right,
            }
        }
    }
}

/// Whether a path leads over a crossing.
pub(super) fn leads_over(path: &[Point2], crossing: &Crossing) -> bool {
    path.windows(2)
        .any(|piece| polyline::crossing(piece[0], piece[1], crossing.start, crossing.end).is_some())
}
