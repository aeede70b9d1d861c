//! Streets leave their junctions straight: as far as a junction reaches into a street, its course does not bend.
//!
//! The paved area of a junction is bounded by lines along its streets as they leave it. Points that were drawn within
//! it say how somebody's pen moved, not how the street runs.

use std::f64::consts::{PI, TAU};

use simworld_core::geometry::{Point2, heading};
use simworld_core::net::polyline;
use simworld_core::ops;

use super::web::Web;

/// How far a course is straight at least, m.
const LEAST: f64 = 10.0;
/// Share of a street's length that one end may straighten.
const SHARE: f64 = 0.45;
/// How far a straightened end may lie from what was drawn: so much, m, and this share of its length.
const OFF: (f64, f64) = (1.5, 0.15);
/// What a crossing and its stop line add to the reach of a junction, m.
const CROSSING: f64 = 3.0;

/// Straightens the ends of all streets, first a little, and then as far as their junctions reach.
pub(super) fn straighten(web: &mut Web) {
    for edge in 0..web.edges.len() as u32 {
        for end in 0..2 {
            straighten_end(web, edge, end, LEAST);
        }
    }
    for node in 0..web.nodes.len() as u32 {
        for (edge, end, reach) in reaches(web, node) {
            straighten_end(web, edge, end, reach + CROSSING);
        }
    }
}

/// Takes the points within a distance of an end out of a course, if the street stays where it was; or within a shorter
/// one.
fn straighten_end(web: &mut Web, edge: u32, end: usize, distance: f64) {
    let found = web.edge(edge);
    if !found.lives || found.via.is_empty() || web.degree(found.ends[end]) < 2 {
        return;
    }
    let mut course = web.course(edge);
    if end == 1 {
        course.reverse();
    }
    let length = polyline::length(&course);
    for share in [1.0, 0.7, 0.45] {
        let reach = (distance * share).min(length * SHARE);
        if let Some(kept) = straightened(&course, reach) {
            let mut via = kept[1..kept.len() - 1].to_vec();
            if end == 1 {
                via.reverse();
            }
            web.edges[edge as usize].via = via;
            return;
        }
    }
}

/// The course without its points nearer to its beginning than that, or with none left out if it would move too far.
fn straightened(course: &[Point2], reach: f64) -> Option<Vec<Point2>> {
    let mut walked = 0.0;
    let mut first = 1;
    while first + 1 < course.len() {
        walked += (course[first] - course[first - 1]).norm();
        if walked >= reach {
            break;
        }
        first += 1;
    }
    if first == 1 {
        return Some(course.to_vec());
    }
    // The street turns off at the reach itself, where it was drawn there.
    let at = polyline::at(course, reach).0;
    let chord = [course[0], at];
    let off = |point: &Point2| polyline::closest(&chord, point).map_or(0.0, |near| near.distance);
    let most = OFF.0 + OFF.1 * reach;
    if course[1..first].iter().any(|point| off(point) > most) {
        return None;
    }
    let mut kept = vec![course[0]];
    if (course[first] - at).norm() > 2.0 {
        kept.push(at);
    }
    kept.extend_from_slice(&course[first..]);
    Some(kept)
}

/// How far the junction at a node reaches into each of its streets, by their widths and the angles between them.
fn reaches(web: &Web, node: u32) -> Vec<(u32, usize, f64)> {
    let at = web.node(node).at;
    let mut legs: Vec<(f64, u32, usize, f64)> = Vec::new();
    for edge in &web.node(node).edges {
        let found = web.edge(*edge);
        let half = found.character.profile.carriageway() * 0.5 + f64::from(found.character.profile.sidewalk[0].max(found.character.profile.sidewalk[1])) * 0.1;
        for end in (0..2).filter(|end| found.ends[*end] == node) {
            let far = web.node(found.ends[1 - end]).at;
            let next = if end == 0 { found.via.first() } else { found.via.last() };
            let towards = next.copied().unwrap_or(far) - at;
            legs.push((heading(&towards), *edge, end, half));
        }
    }
    legs.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let count = legs.len();
    let reach = |index: usize| {
        let (angle, edge, end, half) = legs[index];
        let beside = [legs[(index + 1) % count], legs[(index + count - 1) % count]];
        let reaches = beside.into_iter().map(|(other, _, _, width)| {
            let between = (other - angle).rem_euclid(TAU);
            let between = between.min(TAU - between);
            if between > PI - 0.05 || between < 1e-3 {
                return 0.0;
            }
            let (sin, cos) = ops::sin_cos(between);
            ((width + half * cos) / sin).max(0.0)
        });
        (edge, end, reaches.fold(0.0, f64::max))
    };
    if count < 2 { Vec::new() } else { (0..count).map(reach).collect() }
}
