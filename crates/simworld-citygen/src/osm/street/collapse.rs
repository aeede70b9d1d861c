//! Pieces too short for a street: joined with a neighbour where only two meet, or else drawn together to one junction.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use simworld_core::geometry::Point2;
use simworld_core::net::{SHORTEST_STREET, polyline};

use super::ends::reaches;
use super::web::{Edge, Web};
use crate::osm::error::{OsmId, Warning};
use crate::osm::place::Place;

/// The shortest street that stays, m; a little more than a plan asks for, against rounding.
pub(super) const SHORTEST: f64 = SHORTEST_STREET + 0.5;
/// Loops shorter than this have no room for the nodes that they need, m.
pub(super) const SHORTEST_LOOP: f64 = 3.0 * SHORTEST + 1.5;

/// Streets longer than this stay, however far their junctions reach, m.
const LONGEST_TIGHT: f64 = 28.0;
/// Junctions that reach so many lengths of the street between them into it are one.
const TIGHT: f64 = 1.15;

/// Draws all short edges together, the shortest first.
pub(super) fn collapse(web: &mut Web, place: &Place, warnings: &mut Vec<Warning>) {
    let key = |web: &Web, edge: u32| (web.length(edge) * 1000.0) as u64;
    let mut pending: BinaryHeap<Reverse<(u64, u32)>> = web
        .living()
        .map(|(edge, _)| edge)
        .filter(|edge| is_short(web, *edge))
        .map(|edge| Reverse((key(web, edge), edge)))
        .collect();
    while let Some(Reverse((length, edge))) = pending.pop() {
        if !web.edge(edge).lives || !is_short(web, edge) {
            continue;
        }
        let now = key(web, edge);
        if now != length {
            pending.push(Reverse((now, edge)));
            continue;
        }
        // What lies round it may be short now.
        for near in collapse_one(web, edge, place, warnings) {
            if web.edge(near).lives && is_short(web, near) {
                pending.push(Reverse((key(web, near), near)));
            }
        }
    }
}

/// Draws junctions together that reach into each other: between them is no room for a street.
pub(super) fn collapse_tight(web: &mut Web) {
    let mut tight: Vec<(f64, u32)> = Vec::new();
    for (index, edge) in web.living() {
        let length = web.length(index);
        let is_inner = edge.ends.iter().all(|node| web.degree(*node) >= 2);
        if length > LONGEST_TIGHT || !is_inner || edge.character.is_roundabout || edge.ends[0] == edge.ends[1]
        {
            continue;
        }
        let reach = |end: usize| {
            let reaches = reaches(web, edge.ends[end]);
            reaches.iter().find(|found| (found.0, found.1) == (index, end)).map_or(0.0, |found| found.2)
        };
        if reach(0) + reach(1) > length * TIGHT {
            tight.push((length, index));
        }
    }
    tight.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    for (_, edge) in tight {
        let ends = web.edge(edge).ends;
        let is_spread = ends.iter().any(|node| web.node(*node).spread > LONGEST_TIGHT);
        if !web.edge(edge).lives || ends[0] == ends[1] || is_spread || web.length(edge) > LONGEST_TIGHT {
            continue;
        }
        // Where only two streets meet they become one; a junction takes the other in.
        let bend = ends.into_iter().find(|node| web.degree(*node) == 2);
        if bend.is_none_or(|node| web.dissolve(node).is_none()) {
            draw_together(web, edge);
        }
    }
}

fn is_short(web: &Web, edge: u32) -> bool {
    let least = if web.edge(edge).ends[0] == web.edge(edge).ends[1] { SHORTEST_LOOP } else { SHORTEST };
    web.length(edge) < least
}

/// Does away with a short edge; gives the edges that changed.
fn collapse_one(web: &mut Web, edge: u32, place: &Place, warnings: &mut Vec<Warning>) -> Vec<u32> {
    let [a, b] = web.edge(edge).ends;
    if a == b {
        warn(web, edge, "a loop too short for a street was left out", place, warnings);
        web.remove(edge);
        return dissolved(web, a);
    }
    let (at_a, at_b) = (web.degree(a), web.degree(b));
    if at_a == 1 || at_b == 1 {
        warn(web, edge, "a dead end too short for a street was left out", place, warnings);
        web.remove(edge);
        return [a, b].into_iter().flat_map(|node| dissolved(web, node)).collect();
    }
    for node in [a, b] {
        if web.degree(node) == 2
            && let Some(joined) = web.dissolve(node)
        {
            return vec![joined];
        }
    }
    draw_together(web, edge);
    web.node(a).edges.clone()
}

/// Joins the two edges that a removal left at a node, if they are one street.
fn dissolved(web: &mut Web, node: u32) -> Vec<u32> {
    let [first, second] = web.node(node).edges[..] else { return Vec::new() };
    let (a, b) = (web.edge(first).character, web.edge(second).character);
    let is_one = a.way == b.way || (a.name == b.name && a.class == b.class);
    if is_one { web.dissolve(node).into_iter().collect() } else { Vec::new() }
}

/// Makes one node of the two ends of an edge.
pub(super) fn draw_together(web: &mut Web, edge: u32) {
    let [a, b] = web.edge(edge).ends;
    let at = meeting_point(web, edge);
    hand_signs_on(web, edge);
    web.remove(edge);
    web.merge(b, a, at);
    let near = web.node(a).spread + 2.0;
    for edge in web.node(a).edges.clone() {
        clear_of(web, edge, a, near);
    }
}

/// What is forbidden at one end of an edge is forbidden to those of its way who come over its other end.
fn hand_signs_on(web: &mut Web, edge: u32) {
    let Edge { ends, turns, character, .. } = *web.edge(edge);
    for end in 0..2 {
        let before = ends[1 - end];
        for other in web.node(before).edges.clone() {
            let found = &mut web.edges[other as usize];
            if other != edge && found.character.way == character.way {
                for (at, own) in found.ends.into_iter().zip(&mut found.turns) {
                    if at == before {
                        own.forbid_as(&turns[end]);
                    }
                }
            }
        }
    }
}

/// Where the ends of an edge become one: on a roundabout on its arc, elsewhere in the middle.
fn meeting_point(web: &Web, edge: u32) -> Point2 {
    let [a, b] = web.edge(edge).ends;
    let on_ring = |node: u32| web.node(node).edges.iter().any(|edge| web.edge(*edge).character.is_roundabout);
    let is_ring = web.edge(edge).character.is_roundabout;
    match (on_ring(a), on_ring(b)) {
        (true, false) if !is_ring => web.node(a).at,
        (false, true) if !is_ring => web.node(b).at,
        _ => {
            let course = web.course(edge);
            polyline::at(&course, polyline::length(&course) * 0.5).0
        }
    }
}

/// Takes the points of a course away that lie nearer to its node than that.
fn clear_of(web: &mut Web, edge: u32, node: u32, near: f64) {
    let at = web.node(node).at;
    let Some(edge) = web.edges.get_mut(edge as usize) else { return };
    let is_far = |point: &Point2| (point - at).norm() >= near;
    if edge.ends[0] == node {
        let first = edge.via.iter().position(is_far).unwrap_or(edge.via.len());
        edge.via.drain(..first);
    }
    if edge.ends[1] == node {
        let last = edge.via.iter().rposition(is_far).map_or(0, |last| last + 1);
        edge.via.truncate(last);
    }
}

pub(super) fn warn(web: &Web, edge: u32, what: &str, place: &Place, warnings: &mut Vec<Warning>) {
    let course = web.course(edge);
    let middle = polyline::at(&course, polyline::length(&course) * 0.5).0;
    let element = Some(OsmId::Way(web.edge(edge).character.way));
    warnings.push(Warning { what: what.to_owned(), element, at: Some(place.geographic(middle)) });
}
