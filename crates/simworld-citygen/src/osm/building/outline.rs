//! Outlines of buildings, from closed ways and from multipolygons.

use simworld_core::geometry::Point2;

use super::usage::{Usage, is_building};
use crate::block::Ring;
use crate::osm::error::{OsmId, Warning};
use crate::osm::place::Place;
use crate::osm::raw::{MISSING, Relation, Role};
use crate::osm::tags::Key;

/// Corners of one outline at most; the work to look for crossings grows with the square of it.
const MOST_CORNERS: usize = 600;
/// Corners that lie within this of a straight wall are none, m.
const STRAIGHT: f64 = 0.08;
/// Least and greatest area, m²: a kiosk, a trade fair.
const AREA: (f64, f64) = (6.0, 400_000.0);
/// A courtyard smaller than this is a shaft, m².
const LEAST_COURT: f64 = 4.0;

/// What stands on the ground, as it was drawn.
#[derive(Clone, Debug)]
pub(in crate::osm) struct Outline {
    pub(in crate::osm) element: OsmId,
    /// Counter-clockwise, m.
    pub(in crate::osm) corners: Vec<Point2>,
    /// Counter-clockwise, m.
    pub(in crate::osm) courts: Vec<Vec<Point2>>,
    pub(in crate::osm) area: f64,
    pub(in crate::osm) usage: Usage,
}

/// All buildings of a place, ways by their number and then relations.
pub(in crate::osm) fn outlines(place: &Place, warnings: &mut Vec<Warning>) -> Vec<Outline> {
    let raw = &place.raw;
    let buildings = || {
        raw.relations().iter().filter(|relation| {
            let tags = raw.relation_tags(relation);
            tags.is(Key::Type, "multipolygon") && is_building(&tags)
        })
    };
    // Ways that bound a multipolygon are not buildings once more.
    let mut bounding: Vec<i64> =
        buildings().flat_map(|relation| raw.members_of(relation)).map(|member| member.number).collect();
    bounding.sort_unstable();
    let mut found = Vec::new();
    for way in raw.ways() {
        let tags = raw.way_tags(way);
        if !is_building(&tags) || bounding.binary_search(&way.id).is_ok() {
            continue;
        }
        let element = OsmId::Way(way.id);
        match closed(place, raw.nodes_of(way)).and_then(|corners| cleaned(&corners)) {
            Ok((corners, area)) => {
                let usage = Usage::of(&tags, area);
                found.push(Outline { element, corners, courts: Vec::new(), area, usage });
            }
            Err(what) => warnings.push(left_out(place, element, raw.nodes_of(way), what)),
        }
    }
    for relation in buildings() {
        assemble(place, relation, &mut found, warnings);
    }
    found
}

fn left_out(place: &Place, element: OsmId, nodes: &[u32], what: &str) -> Warning {
    let at = nodes.iter().find_map(|node| place.point(*node)).map(|point| place.geographic(point));
    Warning { what: format!("a building {what}; left out"), element: Some(element), at }
}

/// The points of a closed row of nodes, the first not repeated.
fn closed(place: &Place, nodes: &[u32]) -> Result<Vec<Point2>, &'static str> {
    let [first, .., last] = nodes else { return Err("has no outline") };
    if first != last {
        return Err("has an outline that is not closed");
    }
    if nodes.len() > 8 * MOST_CORNERS {
        return Err("has too many corners");
    }
    let points = nodes[1..].iter().map(|node| place.point(*node)).collect::<Option<Vec<Point2>>>();
    points.ok_or("lies partly outside the extract")
}

/// An outline without corners that say nothing, counter-clockwise, and its area.
fn cleaned(points: &[Point2]) -> Result<(Vec<Point2>, f64), &'static str> {
    let mut ring = Ring::default();
    for point in points {
        ring.push(*point, crate::block::Border::LAND);
    }
    if ring.area() < 0.0 {
        ring.corners.reverse();
    }
    // Each round takes out corners that are not neighbours, so that a bow does not vanish.
    loop {
        let count = ring.len();
        let mut kept = Vec::with_capacity(count);
        let mut is_kept = true;
        for index in 0..count {
            let (before, at, after) =
                (ring.corners[(index + count - 1) % count], ring.corners[index], ring.next(index));
            let says_nothing = is_kept && lies_between(before, at, after);
            is_kept = !says_nothing;
            if is_kept {
                kept.push(at);
            }
        }
        let is_done = kept.len() == count;
        ring.corners = kept.into();
        if is_done || ring.len() < 3 {
            break;
        }
    }
    ring.borders.truncate(ring.len());
    let area = ring.area();
    if ring.len() < 3 || area < AREA.0 {
        Err("has no room inside")
    } else if area > AREA.1 {
        Err("is larger than any building")
    } else if ring.len() > MOST_CORNERS {
        Err("has too many corners")
    } else if !ring.is_simple() {
        Err("has an outline that crosses itself")
    } else {
        Ok((ring.corners.into_vec(), area))
    }
}

fn lies_between(before: Point2, at: Point2, after: Point2) -> bool {
    let along = after - before;
    let length = along.norm();
    if (at - before).norm() < 0.02 {
        return true;
    }
    length > 0.02
        && (along.perp(&(at - before)) / length).abs() < STRAIGHT
        && along.dot(&(at - before)) > 0.0
        && along.dot(&(after - at)) > 0.0
}

/// Adds the buildings of a multipolygon: one for each outer ring.
fn assemble(place: &Place, relation: &Relation, found: &mut Vec<Outline>, warnings: &mut Vec<Warning>) {
    let element = OsmId::Relation(relation.id);
    let mut outer = Vec::new();
    let mut inner = Vec::new();
    let (mut is_whole, mut first) = (true, Vec::new());
    for wants_inner in [false, true] {
        let rings = rings(place, relation, wants_inner, &mut is_whole);
        if first.is_empty() {
            first = rings.first().cloned().unwrap_or_default();
        }
        for nodes in rings {
            match closed(place, &nodes).and_then(|corners| cleaned(&corners)) {
                Ok(ring) if wants_inner => inner.push(ring),
                Ok(ring) => outer.push(ring),
                Err("has no room inside") if wants_inner => {}
                Err(what) => warnings.push(left_out(place, element, &nodes, what)),
            }
        }
    }
    if !is_whole {
        warnings.push(left_out(place, element, &first, "lies partly outside the extract"));
    }
    let tags = place.raw.relation_tags(relation);
    for (corners, whole) in outer {
        let mut courts = Vec::new();
        let mut area = whole;
        for (court, open) in &inner {
            let lies_within = court.iter().all(|corner| contains(&corners, *corner));
            if lies_within && *open >= LEAST_COURT && area - open > AREA.0 {
                area -= open;
                courts.push(court.clone());
            }
        }
        found.push(Outline { element, corners, courts, area, usage: Usage::of(&tags, area) });
    }
}

/// The closed rows of nodes that the ways of one role make; ways are joined end to end.
pub(in crate::osm) fn rings(
    place: &Place,
    relation: &Relation,
    wants_inner: bool,
    is_whole: &mut bool,
) -> Vec<Vec<u32>> {
    /// Ways in one role that are joined at most; each is looked for among the rest.
    const MOST_WAYS: usize = 500;
    let raw = &place.raw;
    let members =
        raw.members_of(relation).iter().filter(|member| (member.role == Role::Inner) == wants_inner);
    let mut pieces: Vec<Vec<u32>> = Vec::new();
    for member in members.take(MOST_WAYS) {
        match raw.way(member.number).map(|way| raw.nodes_of(way)) {
            Some(nodes) if nodes.len() >= 2 && !nodes.contains(&MISSING) => pieces.push(nodes.to_vec()),
            _ => *is_whole = false,
        }
    }
    let mut rings = Vec::new();
    while let Some(mut ring) = pieces.pop() {
        while ring.first() != ring.last() {
            let end = ring.last().copied();
            let next =
                pieces.iter().position(|piece| piece.first().copied() == end || piece.last().copied() == end);
            let Some(next) = next else { break };
            let mut piece = pieces.swap_remove(next);
            if piece.first().copied() != end {
                piece.reverse();
            }
            ring.extend_from_slice(&piece[1..]);
        }
        if ring.first() == ring.last() { rings.push(ring) } else { *is_whole = false }
    }
    rings
}

/// Whether a point lies within a polygon.
pub(in crate::osm) fn contains(corners: &[Point2], point: Point2) -> bool {
    let next = corners.iter().cycle().skip(1);
    let crossed = corners.iter().zip(next).filter(|(a, b)| {
        (a.y > point.y) != (b.y > point.y) && point.x < a.x + (b.x - a.x) * ((point.y - a.y) / (b.y - a.y))
    });
    crossed.count() % 2 == 1
}
