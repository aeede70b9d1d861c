//! Nodes at which a bridge or a tunnel and a way of another level pass each other without meeting: drawn by mistake, for a
//! bridge shares no node with what lies below it. Ways of different layers that are neither do meet where they share one.

use std::collections::{BTreeMap, BTreeSet};

use super::area::Area;
use super::drawn::{Line, walk_of};
use crate::osm::error::{OsmId, Warning};
use crate::osm::place::Place;
use crate::osm::raw::{MISSING, Way};
use crate::osm::street;
use crate::osm::tags::Key;

/// A way at a node.
#[derive(Clone, Copy)]
struct Touch {
    way: i64,
    level: i8,
    /// Whether it is a bridge or a tunnel that walkers have for themselves.
    is_structure: bool,
}

/// What is known of a node of a bridge or a tunnel.
#[derive(Default)]
struct Node {
    touches: Vec<Touch>,
    /// Whether one comes from level to level there: a way for walkers ends, or there is a lift.
    leads_on: bool,
}

/// The nodes at which bridges and tunnels for walkers pass others of another level, each told: nobody comes from one to the other there.
pub(super) fn of(
    place: &Place,
    lines: &[Line<'_>],
    squares: &[Area],
    warnings: &mut Vec<Warning>,
) -> BTreeSet<u32> {
    let is_structure = |way: &Way| {
        let tags = place.raw.way_tags(way);
        tags.has(Key::Bridge) || tags.has(Key::Tunnel)
    };
    let structures = lines.iter().filter(|(way, walk)| walk.level != 0 && is_structure(way));
    let nodes = structures.flat_map(|(way, _)| place.raw.nodes_of(way)).filter(|node| **node != MISSING);
    let mut nodes: BTreeMap<u32, Node> = nodes.map(|node| (*node, Node::default())).collect();
    if nodes.is_empty() {
        return BTreeSet::new();
    }
    for (node, _) in place.raw.tagged_nodes().filter(|(_, tags)| tags.is(Key::Highway, "elevator")) {
        nodes.entry(node).and_modify(|found| found.leads_on = true);
    }
    let mut touch = |way: i64, all: &[u32], level: i8, is_structure: bool, has_ends: bool| {
        for (index, node) in all.iter().enumerate() {
            let Some(found) = nodes.get_mut(node) else { continue };
            found.touches.push(Touch { way, level, is_structure });
            found.leads_on |= has_ends && (index == 0 || index + 1 == all.len());
        }
    };
    for (way, walk) in lines {
        touch(way.id, place.raw.nodes_of(way), walk.level, walk.level != 0 && is_structure(way), true);
    }
    for square in squares {
        touch(square.id, &square.edge, square.walk.level, false, false);
    }
    for way in place.raw.ways() {
        let tags = place.raw.way_tags(way);
        if tags.get(Key::Highway).is_some() && walk_of(&tags).is_none() {
            touch(way.id, place.raw.nodes_of(way), street::level(&tags), false, false);
        }
    }
    let mut passed = BTreeSet::new();
    for (node, found) in nodes.into_iter().filter(|(_, found)| !found.leads_on) {
        // The way for which the node is looked at is one of them.
        let Some(own) = found.touches.iter().find(|touch| touch.is_structure) else { continue };
        let Some(other) = found.touches.iter().find(|touch| touch.level != own.level) else { continue };
        let what = format!(
            "shares a node with way {} of another level, which it passes; not joined there",
            other.way
        );
        let at = place.point(node).map(|at| place.geographic(at));
        warnings.push(Warning { what, element: Some(OsmId::Way(own.way)), at });
        passed.insert(node);
    }
    passed
}
