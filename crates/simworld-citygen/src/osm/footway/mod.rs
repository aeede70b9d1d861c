//! Ways for walkers alone: footways, paths, steps and pedestrian streets of the map, cut off where roads lie and buildings
//! stand, and joined to the sidewalks where they meet them.
//!
//! Footbridges and subways pass what lies on other levels, passages the buildings that stand over them; all of them meet
//! others at their ends. Sidewalks and crossings that are drawn as ways of their own are those of the streets, so that they
//! are left out, and so is what follows a sidewalk without saying so, and what nobody may enter.

mod area;
mod cut;
mod drawn;
mod land;
mod levels;
mod passed;
mod plaza;
mod square;

use std::collections::{BTreeMap, BTreeSet};

use simworld_core::net::{Footpath, Plaza, RoadNetwork, polyline};

use super::error::{OsmId, Warning};
use super::place::Place;
use super::raw::MISSING;
use crate::building::{Building, Surveyed};
use crate::occupancy::Occupancy;
use cut::Run;
use drawn::{Drawn, Walk};
use land::Land;
use levels::{Exit, Levels};

/// What is shorter once it is cut off is left out, m.
const SHORTEST: f64 = 2.0;
/// Points nearer than this are one, m.
const SAME: f64 = 1e-6;

/// What of a place is for walkers alone.
#[derive(Default)]
pub(super) struct Footways {
    pub(super) paths: Vec<Footpath>,
    pub(super) plazas: Vec<Plaza>,
}

/// The ways for walkers of a place and its squares, between its roads and its buildings; those from which no sidewalk is
/// reached are left out.
pub(super) fn lay(
    place: &Place,
    network: &RoadNetwork,
    buildings: &[Building],
    warnings: &mut Vec<Warning>,
) -> Footways {
    let (drawn, squares) = drawn::of(place, warnings);
    if drawn.is_empty() {
        return Footways::default();
    }
    let levels = Levels::of(network, buildings, &drawn, &squares);
    let mut given_up: BTreeSet<u32> = BTreeSet::new();
    let mut kept = Vec::new();
    for way in &drawn {
        for open in levels.runs(way) {
            let piece = Piece { way, exits: levels.exits(way, &open), run: open.run };
            if piece.is_worth_it(levels.land(way.walk.level)) {
                kept.push(piece);
            } else {
                // What met it there goes on to the sidewalk instead.
                let ends = way.ends.into_iter().zip(piece.run.cut);
                let ends = ends.filter(|(node, is_cut)| !is_cut && *node != MISSING);
                given_up.extend(ends.map(|(node, _)| node));
            }
        }
    }
    let mut laid = Laid::default();
    for piece in kept {
        laid.add(piece, &given_up);
    }
    let (mut paths, across) = reached(place, laid, warnings);
    let plazas = plaza::open(&squares, levels.land(0), &mut paths, &across);
    Footways { paths, plazas }
}

impl Footways {
    /// Takes their land, so that nothing generated stands on them. What lies below others may stand on the ground above.
    pub(super) fn take(&self, taken: &mut Occupancy) {
        for way in self.paths.iter().filter(|way| way.level == 0) {
            taken.add_path(&way.path, (way.width * 0.5, way.width * 0.5));
        }
        for Plaza { edge, holes } in &self.plazas {
            let open = Surveyed { outline: edge.clone(), courts: holes.clone() };
            open.triangles().iter().for_each(|triangle| taken.add(triangle));
        }
    }
}

/// Of generated buildings those that rise through no footbridge.
pub(super) fn below_none(paths: &[Footpath], mut buildings: Vec<Building>) -> Vec<Building> {
    let mut decks = Occupancy::default();
    for way in paths.iter().filter(|way| way.level > 0) {
        decks.add_path(&way.path, (way.width * 0.5, way.width * 0.5));
    }
    if !decks.is_empty() {
        buildings.retain(|building| building.ground().iter().all(|piece| decks.is_free(piece)));
    }
    buildings
}

/// An open part of a way, and the sidewalks that are near its ends.
struct Piece<'a> {
    way: &'a Drawn,
    run: Run,
    exits: [Option<Exit>; 2],
}

impl Piece<'_> {
    /// Whether it leads anywhere: a stub does not, nor what only follows a sidewalk, unless it leads from one road to
    /// another.
    fn is_worth_it(&self, land: &Land) -> bool {
        let is_cut = self.run.cut != [false; 2];
        if is_cut && polyline::length(&self.run.path) < SHORTEST {
            return false;
        }
        let is_link = matches!(self.exits, [Some((a, _)), Some((b, _))] if a.road != b.road);
        let places = cut::places(&self.run.path);
        is_link || !places.windows(2).all(|pair| land.is_beside_road(pair[0], pair[1]))
    }
}

/// The ways that are laid.
#[derive(Default)]
struct Laid {
    paths: Vec<Footpath>,
    /// The numbers of the ways of which they are parts.
    ways: Vec<i64>,
    /// The numbers of the squares that they cross.
    across: Vec<Option<usize>>,
    /// Nodes from which a way leads on to a sidewalk.
    linked: BTreeSet<u32>,
}

impl Laid {
    fn add(&mut self, Piece { way, run, exits }: Piece<'_>, given_up: &BTreeSet<u32>) {
        let Run { mut path, cut } = run;
        let Walk { width, level, is_covered: covered, is_steps } = way.walk;
        let ends = [path[0], path[path.len() - 1]];
        let mut joins = [false; 2];
        for (end, exit) in exits.into_iter().enumerate() {
            let node = way.ends[end];
            let is_met = cut[end] || way.meets[end].is_some() || given_up.contains(&node);
            let Some((door, exit_level)) = exit.filter(|_| is_met) else { continue };
            let is_there = (door.at - ends[end]).norm() <= SAME;
            if is_there {
                joins[end] = true;
            } else if cut[end] && way.square.is_none() {
                joins[end] = true;
                path.insert(if end == 0 { 0 } else { path.len() }, door.at);
            } else if cut[end] || self.linked.insert(node) {
                // Others may end there, and share the end as it is; and what lies beyond a square is no part of it.
                let path = vec![ends[end], door.at];
                let joins = [false, true];
                let link = Footpath { path, width, joins, level: exit_level, ..Footpath::default() };
                self.put(link, way.way, None);
            }
        }
        // Of steps on the ground nothing depends.
        let steps = is_steps && level != 0;
        let path = Footpath { path, width, joins, level, covered, steps, plaza: None };
        self.put(path, way.way, way.square);
    }

    fn put(&mut self, path: Footpath, way: i64, across: Option<usize>) {
        self.paths.push(path);
        self.ways.push(way);
        self.across.push(across);
    }
}

/// The ways from which one comes to a sidewalk, and the squares that they cross; bridges, subways and passages from which
/// none does are told.
fn reached(
    place: &Place,
    Laid { paths, ways, across, .. }: Laid,
    warnings: &mut Vec<Warning>,
) -> (Vec<Footpath>, Vec<Option<usize>>) {
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
    let mut told = BTreeSet::new();
    for ((path, way), _) in paths.iter().zip(ways).zip(&is_reached).filter(|(_, is_reached)| !**is_reached) {
        let kind = match (path.level, path.covered) {
            (1.., _) => "footbridge",
            (..=-1, _) => "subway",
            (0, true) => "passage",
            (0, false) => continue,
        };
        if told.insert(way) {
            let what = format!("a {kind} from which no sidewalk is reached; left out");
            let at = path.path.first().map(|at| place.geographic(*at));
            warnings.push(Warning { what, element: Some(OsmId::Way(way)), at });
        }
    }
    let all = paths.into_iter().zip(across).zip(is_reached);
    all.filter_map(|(way, is_reached)| is_reached.then_some(way)).unzip()
}
