//! What is in the way of walkers on the ground, on bridges and in tunnels, and where they come to sidewalks.

use std::collections::{BTreeMap, BTreeSet};

use simworld_core::geometry::Point2;
use simworld_core::net::{RoadNetwork, polyline};

use super::cut::{Run, open_runs};
use super::drawn::Drawn;
use super::land::Land;
use super::square::Square;
use crate::building::Building;
use crate::doors::{Door, Doors};
use crate::osm::mask::Mask;

/// A way that ends no farther from a sidewalk leads on to it, m, if nothing lies between.
const JOINS: f64 = 10.0;
/// So near to the mouth of a passage no wall is in the way, m: those of the map are drawn less exactly than they are tested.
const MOUTH: f64 = 1.0;

/// A place on a sidewalk to which the end of a way leads on, and its level.
pub(super) type Exit = (Door, i8);

/// An open part of a way, and the levels on which its ends lead on.
pub(super) struct Open {
    pub(super) run: Run,
    levels: [i8; 2],
}

/// The land and the sidewalks by level.
pub(super) struct Levels<'a> {
    network: &'a RoadNetwork,
    ground: Land,
    /// The nearest of all sidewalks, whatever their level.
    doors: Doors,
    others: BTreeMap<i8, Land>,
    /// Of the sidewalks of a level, for ways off the ground.
    other_doors: BTreeMap<i8, Doors>,
}

impl<'a> Levels<'a> {
    pub(super) fn of(
        network: &'a RoadNetwork,
        buildings: &[Building],
        drawn: &[Drawn],
        squares: &[Square],
    ) -> Self {
        let mut mask = Mask::new();
        squares.iter().flat_map(Square::rings).for_each(|ring| mask.mark(ring, 0.0));
        drawn.iter().flat_map(|way| way.path.windows(2)).for_each(|piece| mask.mark(piece, JOINS));
        let off_ground = drawn.iter().filter(|way| way.walk.level != 0);
        let wanted: BTreeSet<i8> = off_ground
            .flat_map(|way| [Some(way.walk.level), Some(0)].into_iter().chain(way.meets))
            .flatten()
            .collect();
        let land = |level: i8| Land::of(network, buildings, &mask, level);
        let doors = |level: Option<i8>| {
            let is_level = |of: i8| level.is_none_or(|level| level == of);
            Doors::of_some(network, JOINS, |walk| {
                is_level(network.roads[walk.road.index()].level) && mask.touches_path(&walk.path, 0.0)
            })
        };
        Self {
            network,
            ground: land(0),
            doors: doors(None),
            others: wanted.iter().filter(|level| **level != 0).map(|level| (*level, land(*level))).collect(),
            other_doors: wanted.iter().map(|level| (*level, doors(Some(*level)))).collect(),
        }
    }

    /// The land of a level on which ways lie.
    pub(super) fn land(&self, level: i8) -> &Land {
        self.others.get(&level).unwrap_or(&self.ground)
    }

    /// The open parts of a way.
    pub(super) fn runs(&self, way: &Drawn) -> Vec<Open> {
        let Some((path, drawn_in)) = self.drawn_in(way) else { return Vec::new() };
        let runs = open_runs(&path, |a, b| self.is_open(way, a, b));
        let ends = runs.into_iter().map(|mut run| {
            let levels = [0, 1].map(|end| {
                let is_at_end = !run.cut[end];
                run.cut[end] |= drawn_in[end];
                if is_at_end { way.meets[end].unwrap_or(0) } else { way.walk.level }
            });
            Open { run, levels }
        });
        ends.collect()
    }

    /// The path of a way off the ground without what of it lies on the land of a street of another level that it meets, and
    /// at which ends that is so; the others are as they were drawn.
    fn drawn_in(&self, way: &Drawn) -> Option<(Vec<Point2>, [bool; 2])> {
        let (mut path, mut is_drawn_in) = (way.path.clone(), [false; 2]);
        for (end, is_drawn_in) in is_drawn_in.iter_mut().enumerate() {
            let Some(level) = way.meets[end].filter(|level| ![0, *level].contains(&way.walk.level)) else {
                continue;
            };
            let land = self.land(level);
            let runs = open_runs(&path, |a, b| land.is_off_roads(a, b));
            let run = if end == 0 { runs.first()? } else { runs.last()? };
            if !run.cut[end] {
                continue;
            }
            let at = if end == 0 { run.path[0] } else { run.path[run.path.len() - 1] };
            let station = polyline::closest(&path, &at)?.station;
            let (from, to) = if end == 0 { (station, polyline::length(&path)) } else { (0.0, station) };
            let mut rest = polyline::slice(&path, from, to);
            // The other end to the bit, for others know it by that.
            let (own, other) =
                if end == 0 { (rest.last_mut(), path.last()) } else { (rest.first_mut(), path.first()) };
            if let (Some(own), Some(other)) = (own, other) {
                *own = *other;
            }
            path = rest;
            *is_drawn_in = true;
        }
        Some((path, is_drawn_in))
    }

    /// Whether a straight piece of a way lies on nobody's land. Who walks through a passage is in the way of no wall.
    fn is_open(&self, way: &Drawn, a: Point2, b: Point2) -> bool {
        let land = self.land(way.walk.level);
        let ends = [way.path.first(), way.path.last()];
        let mut mouths =
            ends.into_iter().zip(way.gates).filter(|(_, is_gate)| *is_gate).filter_map(|(end, _)| end);
        let mut outside = |piece| mouths.try_fold(piece, |piece, mouth| beyond(piece, *mouth));
        land.is_off_roads(a, b)
            && (way.walk.is_covered || outside([a, b]).is_none_or(|[a, b]| land.is_outside(a, b)))
    }

    /// The sidewalks that are near the ends of an open part of a way, if nothing lies between.
    pub(super) fn exits(&self, way: &Drawn, Open { run, levels }: &Open) -> [Option<Exit>; 2] {
        let ends = [run.path[0], run.path[run.path.len() - 1]];
        [0, 1].map(|end| {
            let level = levels[end];
            let is_mouth = !run.cut[end] && way.gates[end];
            if way.walk.level == 0 {
                self.exit(&self.doors, ends[end], 0, is_mouth)
            } else {
                self.exit(self.other_doors.get(&level)?, ends[end], level, is_mouth)
            }
        })
    }

    fn exit(&self, doors: &Doors, at: Point2, level: i8, is_mouth: bool) -> Option<Exit> {
        let door = doors.nearest(self.network, at)?;
        let is_level = self.network.roads[door.road.index()].level == level;
        let land = self.land(level);
        let from_wall = if is_mouth { beyond([at, door.at], at) } else { Some([at, door.at]) };
        let is_free =
            || land.is_clear(at, door.at) && from_wall.is_none_or(|[from, to]| land.is_outside(from, to));
        (is_level && is_free()).then_some((door, level))
    }
}

/// What of a piece of a way that ends at a mouth lies farther from it than walls are minded.
fn beyond([a, b]: [Point2; 2], mouth: Point2) -> Option<[Point2; 2]> {
    let (from_a, from_b) = ((a - mouth).norm(), (b - mouth).norm());
    // Of a straight piece towards the mouth: where it comes so near.
    let cut = |near: f64, far: f64| ((MOUTH - near) / (far - near)).clamp(0.0, 1.0);
    match (from_a >= MOUTH, from_b >= MOUTH) {
        (true, true) => Some([a, b]),
        (true, false) => Some([a, a + (b - a) * (1.0 - cut(from_b, from_a))]),
        (false, true) => Some([b + (a - b) * (1.0 - cut(from_a, from_b)), b]),
        (false, false) => None,
    }
}
