//! What a plan does not allow: loops, two streets between the same nodes, parts that are not connected.

use petgraph::unionfind::UnionFind;
use simworld_core::net::polyline;

use super::collapse::{self, SHORTEST, SHORTEST_LOOP, warn};
use super::web::Web;
use crate::osm::error::Warning;
use crate::osm::place::Place;

/// Two streets between the same nodes that stay nearer to each other than this are one, m.
const TOGETHER: f64 = 12.0;

/// Puts nodes on loops and on all but one of the streets between the same nodes; what is too short for that goes.
pub(super) fn part_doubles(web: &mut Web, place: &Place, warnings: &mut Vec<Warning>) {
    let count = web.edges.len() as u32;
    for edge in 0..count {
        let Some([a, b]) = Some(web.edge(edge)).filter(|edge| edge.lives).map(|edge| edge.ends) else {
            continue;
        };
        if a == b {
            part_loop(web, edge, place, warnings);
        }
    }
    let mut pairs: Vec<([u32; 2], u32)> = web
        .living()
        .map(|(edge, found)| ([found.ends[0].min(found.ends[1]), found.ends[0].max(found.ends[1])], edge))
        .collect();
    pairs.sort_unstable();
    for same in pairs.chunk_by(|a, b| a.0 == b.0).filter(|same| same.len() > 1) {
        let mut edges: Vec<u32> = same.iter().map(|(_, edge)| *edge).collect();
        // The most important keeps its course, the shortest of equals.
        edges.sort_by(|a, b| {
            let (first, second) = (web.edge(*a).character, web.edge(*b).character);
            second.class.cmp(&first.class).then(web.length(*a).total_cmp(&web.length(*b))).then(a.cmp(b))
        });
        for index in 1..edges.len() {
            part(web, edges[0], edges[index], place, warnings);
        }
    }
    // What was taken away may leave stubs; they are rare, and a round is cheap.
    collapse::collapse(web, place, warnings);
}

fn part_loop(web: &mut Web, edge: u32, place: &Place, warnings: &mut Vec<Warning>) {
    let length = web.length(edge);
    if length < SHORTEST_LOOP {
        warn(web, edge, "a loop too short for a street was left out", place, warnings);
        web.remove(edge);
        return;
    }
    let (_, rest) = web.cut(edge, length / 3.0);
    web.cut(rest, length / 3.0);
}

/// Puts a node on the second of two streets between the same nodes, or takes it away.
fn part(web: &mut Web, kept: u32, other: u32, place: &Place, warnings: &mut Vec<Warning>) {
    let (line, length) = (web.course(other), web.length(other));
    let middle = polyline::at(&line, length * 0.5).0;
    let away = polyline::closest(&web.course(kept), &middle).map_or(0.0, |near| near.distance);
    if length < 2.0 * SHORTEST || away < TOGETHER.min(length * 0.2) {
        let what =
            format!("runs beside way {} between the same junctions; left out", web.edge(kept).character.way);
        warn(web, other, &what, place, warnings);
        web.remove(other);
    } else {
        web.cut(other, length * 0.5);
    }
}

/// Keeps the part of which most metres are connected.
pub(super) fn keep_largest(web: &mut Web, place: &Place, warnings: &mut Vec<Warning>) {
    let mut parts = UnionFind::<u32>::new(web.nodes.len());
    for (_, edge) in web.living() {
        parts.union(edge.ends[0], edge.ends[1]);
    }
    let mut lengths = vec![0.0; web.nodes.len()];
    let edges: Vec<u32> = web.living().map(|(edge, _)| edge).collect();
    for edge in &edges {
        lengths[parts.find(web.edge(*edge).ends[0]) as usize] += web.length(*edge);
    }
    // Of equal parts the first.
    let Some(largest) = (0..lengths.len()).rev().max_by(|a, b| lengths[*a].total_cmp(&lengths[*b])) else {
        return;
    };
    let apart: Vec<u32> =
        edges.into_iter().filter(|edge| parts.find(web.edge(*edge).ends[0]) as usize != largest).collect();
    let mut told = Vec::new();
    for edge in apart {
        let way = web.edge(edge).character.way;
        if !told.contains(&way) {
            warn(web, edge, "not connected with the other streets; left out", place, warnings);
            // Parts are small; what matters is that long ways are told once.
            told.truncate(64);
            told.push(way);
        }
        web.remove(edge);
    }
}
