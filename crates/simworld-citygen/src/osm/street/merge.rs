//! Junctions that the map draws as several: where the carriageways of a road are drawn apart, a crossroads has two or
//! four nodes, and all of them are one junction with one set of signals.

use simworld_core::geometry::{Point2, Vector2};

use super::collapse::draw_together;
use super::web::{Edge, Web};
use crate::osm::place::Place;
use crate::osm::tags::Key;

/// Edges at one node that are looked at; a junction of more is a mistake.
const MOST_EDGES: usize = 24;
/// A signal this near to a node stands at it, m.
const AT_NODE: f64 = 12.0;
/// Cosine of the angle within which one street goes on as another.
const GOES_ON: f64 = 0.75;
/// Cosine of the angle within which two carriageways run against each other.
const OPPOSITE: f64 = 0.8;
/// Sine of the angle at which a crossover meets its carriageways, at least.
const ACROSS: f64 = 0.75;

/// Draws the nodes of one junction together, up to `reach` m apart, and takes away turning lanes within it.
pub(super) fn merge_junctions(web: &mut Web, place: &Place, reach: f64) {
    let signals = Signals::of(place);
    let mut short: Vec<(f64, u32)> = web
        .living()
        .map(|(edge, _)| (web.length(edge), edge))
        .filter(|(length, _)| *length <= reach)
        .collect();
    short.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    for (_, edge) in short {
        let Edge { ends: [a, b], lives, character, .. } = *web.edge(edge);
        if !lives || a == b || character.is_roundabout || web.length(edge) > reach {
            continue;
        }
        let [from, to] = [web.node(a).at, web.node(b).at];
        let is_junction = web.degree(a) >= 3 && web.degree(b) >= 3;
        let is_spread = web.node(a).spread.max(web.node(b).spread) > reach;
        let is_one = is_crossover(web, edge) || (signals.is_at(from) && signals.is_at(to));
        if is_junction && !is_spread && is_one {
            draw_together(web, edge);
            drop_inner(web, a, reach);
        }
    }
    drop_turning_lanes(web, reach);
}

/// Edges that begin and end at one junction went round within it.
fn drop_inner(web: &mut Web, node: u32, reach: f64) {
    for edge in web.node(node).edges.clone() {
        let Edge { ends, lives, .. } = *web.edge(edge);
        if lives && ends == [node, node] && web.length(edge) <= 2.0 * reach {
            web.remove(edge);
        }
    }
}

/// Whether an edge joins two carriageways that run against each other, across them.
fn is_crossover(web: &Web, edge: u32) -> bool {
    let [a, b] = web.edge(edge).ends;
    let Some(across) = (web.node(b).at - web.node(a).at).try_normalize(1e-6) else { return false };
    let (at_a, at_b) = (passing(web, a, edge), passing(web, b, edge));
    at_a.iter().any(|(first, passes, name)| {
        at_b.iter().any(|(second, passes_too, other)| {
            let is_one_road = (*passes && *passes_too) || name == other;
            is_one_road
                && first.dot(second) < -OPPOSITE
                && across.perp(first).abs() > ACROSS
                && across.perp(second).abs() > ACROSS
        })
    })
}

/// The directions of one-way traffic at a node, one edge apart, whether it passes the node, and the name of its road;
/// a carriageway that ends there has the direction of its end.
fn passing(web: &Web, node: u32, except: u32) -> Vec<(Vector2, bool, u32)> {
    let edges = &web.node(node).edges;
    if edges.len() > MOST_EDGES {
        return Vec::new();
    }
    let one_way = |leaves: bool| {
        edges.iter().filter_map(move |edge| {
            let found = web.edge(*edge);
            let is_one_way = found.character.profile.backward == 0 && !found.character.is_roundabout;
            let goes = found.ends[usize::from(!leaves)] == node && found.ends[0] != found.ends[1];
            let counts = *edge != except && is_one_way && goes;
            counts.then(|| heading(web, found, leaves)).flatten().map(|along| (along, found.character.name))
        })
    };
    let leaving: Vec<(Vector2, u32)> = one_way(true).collect();
    let mut found: Vec<(Vector2, bool, u32)> =
        leaving.iter().map(|(along, name)| (*along, false, *name)).collect();
    for (arriving, name) in one_way(false) {
        let goes_on = leaving.iter().find(|(leaving, _)| leaving.dot(&arriving) > GOES_ON);
        let along = goes_on.and_then(|(leaving, _)| (leaving + arriving).try_normalize(1e-6));
        found.push((along.unwrap_or(arriving), along.is_some(), name));
    }
    found
}

/// The direction of an edge where it leaves its first node, or arrives at its last.
fn heading(web: &Web, edge: &Edge, leaves: bool) -> Option<Vector2> {
    let [start, end] = edge.ends.map(|node| web.node(node).at);
    let step = if leaves {
        edge.via.first().unwrap_or(&end) - start
    } else {
        end - edge.via.last().unwrap_or(&start)
    };
    step.try_normalize(1e-6)
}

/// Where signals stand, by the cells of a grid.
struct Signals {
    cells: Vec<((i64, i64), Point2)>,
}

fn cell(point: Point2) -> (i64, i64) {
    ((point.x / AT_NODE).floor() as i64, (point.y / AT_NODE).floor() as i64)
}

impl Signals {
    fn of(place: &Place) -> Self {
        let signals = place.raw.tagged_nodes().filter(|(_, tags)| tags.is(Key::Highway, "traffic_signals"));
        let points = signals.filter_map(|(node, _)| place.point(node));
        let mut cells: Vec<((i64, i64), Point2)> = points.map(|point| (cell(point), point)).collect();
        cells.sort_by_key(|(cell, _)| *cell);
        Self { cells }
    }

    fn is_at(&self, point: Point2) -> bool {
        let (column, row) = cell(point);
        (column - 1..=column + 1).any(|column| {
            let from = self.cells.partition_point(|entry| entry.0 < (column, row - 1));
            let near = self.cells[from..].iter().take_while(|entry| entry.0 <= (column, row + 1));
            near.into_iter().any(|(_, signal)| (signal - point).norm() <= AT_NODE)
        })
    }
}

/// Takes away lanes that cut a corner no larger than a junction: their turn is one of the junction.
fn drop_turning_lanes(web: &mut Web, reach: f64) {
    for edge in 0..web.edges.len() as u32 {
        let Edge { ends: [a, b], lives, character, .. } = *web.edge(edge);
        let is_short = lives && character.is_link && a != b && web.length(edge) <= reach * 1.5;
        if is_short && has_corner(web, edge, a, b, reach) {
            web.remove(edge);
            for node in [a, b] {
                join_if_one(web, node);
            }
        }
    }
}

/// Whether one also comes from one node to the other over the corner between them.
fn has_corner(web: &Web, edge: u32, a: u32, b: u32, reach: f64) -> bool {
    let near = |node: u32| {
        let edges = web.node(node).edges.iter().take(MOST_EDGES).copied();
        edges.filter(move |other| *other != edge && web.length(*other) <= reach)
    };
    near(a).any(|first| {
        let corner = web.edge(first).other(a);
        corner != b && near(b).any(|second| web.edge(second).other(b) == corner)
    })
}

/// Joins the two streets that are left at a node, if they are one way or one name.
fn join_if_one(web: &mut Web, node: u32) {
    let [first, second] = web.node(node).edges[..] else { return };
    let (a, b) = (web.edge(first).character, web.edge(second).character);
    if a.way == b.way || (a.name == b.name && a.class == b.class) {
        web.dissolve(node);
    }
}
