//! Areas on which only people walk, from closed ways and from multipolygons, and what lies in them.

use std::collections::BTreeSet;

use simworld_core::geometry::{Point2, bounds};

use super::drawn::{Walk, walk_of};
use crate::osm::building::{contains, is_building, rings};
use crate::osm::error::{OsmId, Warning};
use crate::osm::mask::Mask;
use crate::osm::place::Place;
use crate::osm::raw::{MISSING, Relation, Role, Way};
use crate::osm::tags::{Key, Tags};

/// An area with holes.
pub(super) struct Area {
    /// The number of its way or relation.
    pub(super) id: i64,
    /// Closed rows of nodes, as they were drawn: the edge, and the holes.
    pub(super) edge: Vec<u32>,
    pub(super) holes: Vec<Vec<u32>>,
    pub(super) walk: Walk,
}

/// The areas of some ways and of all relations: ways by their number and then relations.
pub(super) fn areas(place: &Place, ways: &[(&Way, Walk)], warnings: &mut Vec<Warning>) -> Vec<Area> {
    let raw = &place.raw;
    let area = |(way, walk): &(&Way, Walk)| Area {
        id: way.id,
        edge: raw.nodes_of(way).to_vec(),
        holes: Vec::new(),
        walk: *walk,
    };
    let mut found: Vec<Area> = ways.iter().map(area).collect();
    // Ways that bound a multipolygon are not areas once more.
    let mut bounding = BTreeSet::new();
    let mut assembled = Vec::new();
    for relation in raw.relations() {
        let tags = raw.relation_tags(relation);
        if !tags.is(Key::Type, "multipolygon") {
            continue;
        }
        if let Some(walk) = walk_of_area(&tags) {
            bounding.extend(outer_ways(place, relation));
            assemble(place, relation, walk, &mut assembled, warnings);
        } else if tags.is_alone(Key::Type) {
            // As they were drawn long ago: what the outer way says holds for all of it.
            let mut outer = outer_ways(place, relation);
            let own = outer.next().filter(|_| outer.next().is_none());
            let own = own.and_then(|id| found[..ways.len()].binary_search_by_key(&id, |area| area.id).ok());
            if let Some(own) = own {
                found[own].holes.extend(rings(place, relation, true, &mut true));
            }
        }
    }
    found.retain(|area| !bounding.contains(&area.id));
    found.extend(assembled);
    put_obstacles(place, &mut found);
    found
}

fn outer_ways<'a>(place: &'a Place, relation: &Relation) -> impl Iterator<Item = i64> + use<'a> {
    let members = place.raw.members_of(relation).iter();
    members.filter(|member| member.role == Role::Outer).map(|member| member.number)
}

/// What an area of a relation is like: that of ways for walkers alone, or a square by name.
fn walk_of_area(tags: &Tags<'_>) -> Option<Walk> {
    if tags.get(Key::Highway).is_none() && tags.is(Key::Place, "square") {
        Walk::of_square(tags)
    } else {
        walk_of(tags)
    }
}

/// Adds the areas of a multipolygon: one for each outer ring, with the holes in it.
fn assemble(
    place: &Place,
    relation: &Relation,
    walk: Walk,
    found: &mut Vec<Area>,
    warnings: &mut Vec<Warning>,
) {
    let mut is_whole = true;
    let outer = rings(place, relation, false, &mut is_whole);
    let inner = rings(place, relation, true, &mut is_whole);
    if !is_whole {
        let first = outer.first().into_iter().flatten().find_map(|node| place.point(*node));
        let what = "a square with an edge that is not closed, or lies partly outside the extract; the rest is left out";
        let at = first.map(|at| place.geographic(at));
        warnings.push(Warning { what: what.to_owned(), element: Some(OsmId::Relation(relation.id)), at });
    }
    for edge in outer {
        let corners = points(place, &edge);
        let lies_within = |hole: &&Vec<u32>| {
            hole.iter().all(|node| {
                edge.contains(node) || place.point(*node).is_some_and(|at| contains(&corners, at))
            })
        };
        let holes = inner.iter().filter(lies_within).cloned().collect();
        found.push(Area { id: relation.id, edge, holes, walk });
    }
}

fn points(place: &Place, nodes: &[u32]) -> Vec<Point2> {
    nodes.iter().filter_map(|node| place.point(*node)).collect()
}

/// Houses, water and fountains in the middle of an area are holes in it, though nobody drew it around them.
fn put_obstacles(place: &Place, areas: &mut [Area]) {
    let mut mask = Mask::new();
    let edges: Vec<Vec<Point2>> = areas.iter().map(|area| points(place, &area.edge)).collect();
    let boxes: Vec<_> = edges.iter().map(bounds).collect();
    for edge in &edges {
        mask.mark(edge, 0.0);
    }
    if areas.is_empty() {
        return;
    }
    for way in place.raw.ways().iter().filter(|way| is_obstacle(&place.raw.way_tags(way))) {
        let nodes = place.raw.nodes_of(way);
        if nodes.len() < 4 || nodes.first() != nodes.last() || nodes.contains(&MISSING) {
            continue;
        }
        let corners = points(place, nodes);
        let Some((low, high)) = bounds(&corners).filter(|(low, high)| mask.touches(&[*low, *high], 0.0))
        else {
            continue;
        };
        for ((area, edge), around) in areas.iter_mut().zip(&edges).zip(&boxes) {
            let Some((from, to)) = around else { continue };
            let is_near = low.x >= from.x && low.y >= from.y && high.x <= to.x && high.y <= to.y;
            let is_known = || area.holes.iter().any(|hole| nodes.iter().any(|node| hole.contains(node)));
            if is_near && corners.iter().all(|corner| contains(edge, *corner)) && !is_known() {
                area.holes.push(nodes.to_vec());
            }
        }
    }
}

/// Whether nobody walks over a closed way of these tags.
fn is_obstacle(tags: &Tags<'_>) -> bool {
    is_building(tags) || tags.is(Key::Natural, "water") || tags.is(Key::Amenity, "fountain")
}
