//! Ways for walkers alone: footways, paths, steps and pedestrian streets of the map, cut off where roads lie and buildings
//! stand, and joined to the sidewalks where they meet them.
//!
//! Sidewalks and crossings that are drawn as ways of their own are those of the streets, so that they are left out, and so
//! is what follows a sidewalk without saying so. Squares, bridges, tunnels and what nobody may enter are no ways here.

mod cut;
mod drawn;
mod land;
mod square;

use std::collections::{BTreeMap, BTreeSet};

use simworld_core::geometry::Point2;
use simworld_core::net::{Footpath, RoadNetwork, polyline};

use super::mask::Mask;
use super::place::Place;
use crate::building::Building;
use crate::doors::{Door, Doors};
use crate::occupancy::Occupancy;
use cut::Run;
use drawn::Drawn;
use land::Land;

/// A way that ends no farther from a sidewalk leads on to it, m, if nothing lies between.
const JOINS: f64 = 10.0;
/// What is shorter once it is cut off is left out, m.
const SHORTEST: f64 = 2.0;
/// Points nearer than this are one, m.
const SAME: f64 = 1e-6;

/// The ways for walkers of a place, between its roads and its buildings; those from which no sidewalk is reached are left
/// out.
pub(super) fn paths(place: &Place, network: &RoadNetwork, buildings: &[Building]) -> Vec<Footpath> {
    let drawn = drawn::of(place);
    if drawn.is_empty() {
        return Vec::new();
    }
    let mut mask = Mask::new();
    drawn.iter().flat_map(|way| way.path.windows(2)).for_each(|piece| mask.mark(piece, JOINS));
    let land = Land::of(network, buildings, &mask);
    let doors = Doors::of_some(network, JOINS, |walk| mask.touches_path(&walk.path, 0.0));
    let door = |at: &Point2| {
        let door = doors.nearest(network, *at)?;
        let is_level = network.roads[door.road.index()].level == 0;
        (is_level && land.is_clear(*at, door.at)).then_some(door)
    };
    let mut given_up: BTreeSet<u32> = BTreeSet::new();
    let mut kept = Vec::new();
    for way in &drawn {
        for run in cut::open_runs(&way.path, |a, b| land.is_open(a, b)) {
            let ends = [run.path[0], run.path[run.path.len() - 1]];
            let piece = Piece { way, doors: [door(&ends[0]), door(&ends[1])], run };
            if piece.is_worth_it(&land) {
                kept.push(piece);
            } else {
                // What met it there goes on to the sidewalk instead.
                let ends = way.ends.into_iter().zip(piece.run.cut);
                given_up.extend(ends.filter(|(_, is_cut)| !is_cut).map(|(node, _)| node));
            }
        }
    }
    let mut laid = Laid::default();
    for piece in kept {
        laid.add(piece, &given_up);
    }
    reached(laid.paths)
}

/// Takes the land of ways for walkers, so that nothing generated stands on them.
pub(super) fn take(paths: &[Footpath], taken: &mut Occupancy) {
    for way in paths {
        taken.add_path(&way.path, (way.width * 0.5, way.width * 0.5));
    }
}

/// An open part of a way, and the sidewalks that are near its ends.
struct Piece<'a> {
    way: &'a Drawn,
    run: Run,
    doors: [Option<Door>; 2],
}

impl Piece<'_> {
    /// Whether it leads anywhere: a stub does not, nor what only follows a sidewalk, unless it leads from one road to
    /// another.
    fn is_worth_it(&self, land: &Land) -> bool {
        let is_cut = self.run.cut != [false; 2];
        if is_cut && polyline::length(&self.run.path) < SHORTEST {
            return false;
        }
        let is_link = matches!(self.doors, [Some(a), Some(b)] if a.road != b.road);
        let places = cut::places(&self.run.path);
        is_link || !places.windows(2).all(|pair| land.is_beside_road(pair[0], pair[1]))
    }
}

/// The ways that are laid.
#[derive(Default)]
struct Laid {
    paths: Vec<Footpath>,
    /// Nodes from which a way leads on to a sidewalk.
    linked: BTreeSet<u32>,
}

impl Laid {
    fn add(&mut self, Piece { way, run, doors }: Piece<'_>, given_up: &BTreeSet<u32>) {
        let Run { mut path, cut } = run;
        let ends = [path[0], path[path.len() - 1]];
        let mut joins = [false; 2];
        for (end, door) in doors.into_iter().enumerate() {
            let node = way.ends[end];
            let is_met = cut[end] || way.meets[end] || given_up.contains(&node);
            let Some(door) = door.filter(|_| is_met) else { continue };
            let is_there = (door.at - ends[end]).norm() <= SAME;
            if is_there {
                joins[end] = true;
            } else if cut[end] {
                joins[end] = true;
                path.insert(if end == 0 { 0 } else { path.len() }, door.at);
            } else if self.linked.insert(node) {
                // Others may end there, and share the end as it is.
                let path = vec![ends[end], door.at];
                self.paths.push(Footpath { path, width: way.width, joins: [false, true] });
            }
        }
        self.paths.push(Footpath { path, width: way.width, joins });
    }
}

/// The ways from which one comes to a sidewalk.
fn reached(mut paths: Vec<Footpath>) -> Vec<Footpath> {
    let ends = |way: &Footpath| {
        [way.path.first(), way.path.last()].map(|end| end.map(|end| [end.x.to_bits(), end.y.to_bits()]))
    };
    let mut met: BTreeMap<Option<[u64; 2]>, Vec<usize>> = BTreeMap::new();
    for (index, way) in paths.iter().enumerate() {
        for end in ends(way) {
            met.entry(end).or_default().push(index);
        }
    }
    let mut is_reached: Vec<bool> = paths.iter().map(|way| way.joins != [false; 2]).collect();
    let mut open: Vec<usize> = (0..paths.len()).filter(|index| is_reached[*index]).collect();
    while let Some(index) = open.pop() {
        for other in ends(&paths[index]).iter().filter_map(|end| met.get(end)).flatten() {
            if !std::mem::replace(&mut is_reached[*other], true) {
                open.push(*other);
            }
        }
    }
    let mut is_reached = is_reached.into_iter();
    paths.retain(|_| is_reached.next().unwrap_or(false));
    paths
}
