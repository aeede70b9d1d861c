//! Streets that cross without a node: bridges do, and mistakes.

use simworld_core::geometry::Point2;
use simworld_core::net::polyline;

use super::web::Web;
use crate::osm::error::{OsmId, Warning};
use crate::osm::mask::Mask;
use crate::osm::place::Place;

/// Width of a cell of the search grid, m.
const CELL: f64 = 60.0;
/// Pieces that are compared with each other at most, a piece and in all; towns need about ten.
const MOST_PAIRS: (u64, u64) = (400, 10_000_000);
/// Cells that one piece may lie in.
const MOST_CELLS: u64 = 20_000;
/// A crossing this near to the end of a street is where it was meant to end, m.
const NEAR_END: f64 = 0.5;

/// Where two streets cross without a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Crossing {
    pub(super) edges: [u32; 2],
    /// Stations on the two, m.
    pub(super) stations: [f64; 2],
    pub(super) at: Point2,
}

/// How long all edges are, m: whatever is drawn elsewhere is of another length.
pub(super) fn lengths(web: &Web) -> Vec<f64> {
    (0..web.edges.len() as u32).map(|edge| web.length(edge)).collect()
}

/// Where streets lie that were drawn elsewhere since then, or not at all.
fn drawn_anew(web: &Web, before: &[f64]) -> Mask {
    let mut mask = Mask::new();
    for (edge, _) in web.living().filter(|(edge, _)| before.get(*edge as usize) != Some(&web.length(*edge))) {
        web.course(edge).windows(2).for_each(|piece| mask.mark(piece, 0.0));
    }
    mask
}

/// Puts a node where streets of one level cross without one, beside whatever was drawn anew since its [`lengths`] were taken, if there are
/// any. Bridges and tunnels pass without. Says whether any did.
pub(super) fn cut_crossings(
    web: &mut Web,
    before: Option<&[f64]>,
    place: &Place,
    warnings: &mut Vec<Warning>,
) -> bool {
    let (crossings, is_complete) = crossings(web, before);
    if !is_complete {
        let what = "the streets lie too densely; crossings without a node were not all found".to_owned();
        warnings.push(Warning { what, element: None, at: None });
    }
    let mut cuts: Vec<(u32, f64, u32)> = Vec::new();
    let mut places = Vec::new();
    for crossing in crossings {
        let [first, second] = crossing.edges.map(|edge| web.edge(edge).character);
        if first.level != second.level {
            continue;
        }
        let what = format!("crosses way {} without a node; a junction was put there", second.way);
        let at = Some(place.geographic(crossing.at));
        warnings.push(Warning { what, element: Some(OsmId::Way(first.way)), at });
        for side in 0..2 {
            cuts.push((crossing.edges[side], crossing.stations[side], places.len() as u32));
        }
        places.push(crossing.at);
    }
    // From the end of each street, so that what is left of it keeps its number.
    cuts.sort_by(|a, b| a.0.cmp(&b.0).then(b.1.total_cmp(&a.1)).then(a.2.cmp(&b.2)));
    let mut nodes: Vec<Option<u32>> = vec![None; places.len()];
    for (edge, station, place) in cuts {
        let (node, _) = web.cut(edge, station);
        match nodes[place as usize] {
            None => nodes[place as usize] = Some(node),
            Some(known) => web.merge(node, known, places[place as usize]),
        }
    }
    !places.is_empty()
}

/// A straight piece of an edge.
#[derive(Clone, Copy)]
struct Piece {
    edge: u32,
    ends: [Point2; 2],
    /// Where it begins on the edge, m.
    station: f64,
}

/// All crossings of edges away from common nodes, or those beside what was drawn anew, in the order of their edges; whether all were looked
/// for.
fn crossings(web: &Web, before: Option<&[f64]>) -> (Vec<Crossing>, bool) {
    let mut pieces = Vec::new();
    for (edge, _) in web.living() {
        put_pieces(web, edge, &mut pieces);
    }
    if let Some(anew) = before.map(|before| drawn_anew(web, before)) {
        pieces.retain(|piece| anew.touches(&piece.ends, 0.0));
    }
    let mut cells: Vec<(u64, u32)> = Vec::with_capacity(pieces.len() * 2);
    let mut is_complete = true;
    for (index, piece) in pieces.iter().enumerate() {
        is_complete &= file(piece, index as u32, &mut cells);
    }
    cells.sort_unstable();
    let mut found = Vec::new();
    let mut left = MOST_PAIRS.0 * pieces.len() as u64 + MOST_PAIRS.1;
    for cell in cells.chunk_by(|a, b| a.0 == b.0) {
        let pairs = (cell.len() * (cell.len() - 1) / 2) as u64;
        if pairs > left {
            is_complete = false;
            continue;
        }
        left -= pairs;
        for (rank, (_, a)) in cell.iter().enumerate() {
            for (_, b) in &cell[rank + 1..] {
                found.extend(meeting(web, &pieces[*a as usize], &pieces[*b as usize]));
            }
        }
    }
    found.sort_by(|a, b| {
        a.edges
            .cmp(&b.edges)
            .then(a.stations[0].total_cmp(&b.stations[0]))
            .then(a.stations[1].total_cmp(&b.stations[1]))
    });
    // Two pieces may share several cells.
    found.dedup_by(|a, b| a.edges == b.edges && (a.stations[0] - b.stations[0]).abs() < 1e-6);
    (found, is_complete)
}

/// Whether two streets cross away from common nodes.
pub(super) fn do_cross(web: &Web, a: u32, b: u32) -> bool {
    let [mut own, mut theirs] = [Vec::new(), Vec::new()];
    put_pieces(web, a, &mut own);
    put_pieces(web, b, &mut theirs);
    own.iter().any(|piece| theirs.iter().any(|other| meeting(web, piece, other).is_some()))
}

/// The pieces of an edge, in order.
fn put_pieces(web: &Web, edge: u32, pieces: &mut Vec<Piece>) {
    let mut station = 0.0;
    for pair in web.course(edge).windows(2) {
        pieces.push(Piece { edge, ends: [pair[0], pair[1]], station });
        station += (pair[1] - pair[0]).norm();
    }
}

/// Files a piece under the cells that its box covers; says whether it is small enough.
fn file(piece: &Piece, index: u32, cells: &mut Vec<(u64, u32)>) -> bool {
    let [a, b] = piece.ends;
    // Long pieces are walked in steps, so that a diagonal does not fill its whole box.
    let steps = ((b - a).norm() / CELL).ceil().max(1.0);
    if steps > MOST_CELLS as f64 {
        return false;
    }
    let cell = |x: f64| (x / CELL).floor() as i64;
    let at = |step: u32| a + (b - a) * (f64::from(step) / steps);
    let first = cells.len();
    for step in 0..steps as u32 {
        let (p, q) = (at(step), at(step + 1));
        for column in cell(p.x.min(q.x))..=cell(p.x.max(q.x)) {
            for row in cell(p.y.min(q.y))..=cell(p.y.max(q.y)) {
                cells.push(((column as u64) << 32 | (row as u64 & 0xffff_ffff), index));
            }
        }
    }
    cells[first..].sort_unstable();
    let mut kept = first;
    for index in first..cells.len() {
        if index == first || cells[index] != cells[kept - 1] {
            cells[kept] = cells[index];
            kept += 1;
        }
    }
    cells.truncate(kept);
    true
}

/// Where two pieces cross, unless they do at a common node.
fn meeting(web: &Web, a: &Piece, b: &Piece) -> Option<Crossing> {
    let (a, b) = if (a.edge, a.station) <= (b.edge, b.station) { (a, b) } else { (b, a) };
    let (share, other) = polyline::crossing(a.ends[0], a.ends[1], b.ends[0], b.ends[1])?;
    let at = a.ends[0] + (a.ends[1] - a.ends[0]) * share;
    let (first, second) = (web.edge(a.edge), web.edge(b.edge));
    let is_common = |node: &u32| second.ends.contains(node) && (web.node(*node).at - at).norm() < NEAR_END;
    if first.ends.iter().any(is_common) {
        return None;
    }
    let station = |piece: &Piece, share: f64| piece.station + (piece.ends[1] - piece.ends[0]).norm() * share;
    let stations = [station(a, share), station(b, other)];
    // The pieces of one course meet where they follow each other.
    let follows = a.edge == b.edge && stations[1] - stations[0] < NEAR_END;
    (!follows).then_some(Crossing { edges: [a.edge, b.edge], stations, at })
}
