//! Streets leave their junctions straight: as far as a junction reaches into a street, its course does not bend.
//!
//! The paved area of a junction is bounded by lines along its streets as they leave it. Points that were drawn within
//! it say how somebody's pen moved, not how the street runs.

use std::f64::consts::{PI, TAU};

use simworld_core::geometry::{Point2, direction, heading};
use simworld_core::net::polyline;
use simworld_core::ops;

use super::cross::do_cross;
use super::web::Web;

/// How far a course is straight at least, m.
const LEAST: f64 = 10.0;
/// Share of a street's length that one end may straighten.
const SHARE: f64 = 0.45;
/// How far a straightened end may lie from what was drawn: so much, m, and this share of its length.
const OFF: (f64, f64) = (1.5, 0.15);
/// What a crossing and its stop line add to the reach of a junction, m.
const CROSSING: f64 = 3.0;

/// Streets that leave a junction nearer to each other than this are spread to it, radians: a ramp begins beside its road.
const NARROW: f64 = 0.46;
/// How far from the junction they are spread, m.
const SPREAD: f64 = 30.0;
/// Two streets that turn back at a node more sharply than this are one street with a bend, radians.
const HAIRPIN: f64 = 1.1;

/// Straightens the ends of all streets, first a little, and then as far as their junctions reach.
pub(super) fn straighten(web: &mut Web) {
    dissolve_hairpins(web);
    for edge in 0..web.edges.len() as u32 {
        for end in 0..2 {
            straighten_end(web, edge, end, LEAST);
        }
    }
    let nodes = 0..web.nodes.len() as u32;
    for node in nodes.clone() {
        spread(web, node);
    }
    for node in nodes.clone() {
        for (edge, end, reach) in reaches(web, node) {
            straighten_end(web, edge, end, reach + CROSSING);
        }
    }
    // What was straightened may have come near to its neighbour again.
    for node in nodes {
        spread(web, node);
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
    // Rather a shorter end than one that moves the street, but rather that than a junction beyond its street.
    for (share, most) in [(1.0, 1.0), (0.7, 1.0), (1.0, 3.0), (0.45, 2.0)] {
        let reach = (distance * share).min(length * SHARE);
        if let Some(kept) = straightened(&course, reach, most) {
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
fn straightened(course: &[Point2], reach: f64, times: f64) -> Option<Vec<Point2>> {
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
    let most = (OFF.0 + OFF.1 * reach) * times;
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

/// A street as it leaves a node.
#[derive(Clone, Copy)]
struct Leg {
    angle: f64,
    edge: u32,
    end: usize,
    /// Half its width, sidewalks included, m.
    half: f64,
}

/// The streets of a node, counter-clockwise.
fn legs(web: &Web, node: u32) -> Vec<Leg> {
    let at = web.node(node).at;
    let mut legs = Vec::new();
    for edge in &web.node(node).edges {
        let found = web.edge(*edge);
        let profile = &found.character.profile;
        let sidewalk = f64::from(profile.sidewalk[0].max(profile.sidewalk[1])) * 0.1;
        for end in (0..2).filter(|end| found.ends[*end] == node) {
            let far = web.node(found.ends[1 - end]).at;
            let next = if end == 0 { found.via.first() } else { found.via.last() };
            let angle = heading(&(next.copied().unwrap_or(far) - at));
            legs.push(Leg { angle, edge: *edge, end, half: profile.carriageway() * 0.5 + sidewalk });
        }
    }
    legs.sort_by(|a, b| a.angle.total_cmp(&b.angle).then(a.edge.cmp(&b.edge)));
    legs
}

/// The angle from one leg to the next, counter-clockwise, in [0, 2π).
fn between(leg: &Leg, next: &Leg) -> f64 {
    (next.angle - leg.angle).rem_euclid(TAU)
}

/// How far the junction at a node reaches into each of its streets, by their widths and the angles between them.
pub(super) fn reaches(web: &Web, node: u32) -> Vec<(u32, usize, f64)> {
    let legs = legs(web, node);
    let count = legs.len();
    let reach = |index: usize| {
        let leg = legs[index];
        let beside = [legs[(index + 1) % count], legs[(index + count - 1) % count]];
        let reaches = beside.into_iter().map(|other| {
            let angle = between(&leg, &other).min(between(&other, &leg));
            if !(1e-3..=PI - 0.05).contains(&angle) {
                return 0.0;
            }
            let (sin, cos) = ops::sin_cos(angle);
            ((other.half + leg.half * cos) / sin).max(0.0)
        });
        (leg.edge, leg.end, reaches.fold(0.0, f64::max))
    };
    if count < 2 { Vec::new() } else { (0..count).map(reach).collect() }
}

/// Joins streets that turn back at a node where nothing else meets.
fn dissolve_hairpins(web: &mut Web) {
    for node in 0..web.nodes.len() as u32 {
        if let [a, b] = legs(web, node)[..]
            && between(&a, &b).min(between(&b, &a)) < HAIRPIN
        {
            web.dissolve(node);
        }
    }
}

/// Spreads streets that leave a node almost together: the lesser of two gives way, if there is room on its other side, or else the other.
fn spread(web: &mut Web, node: u32) {
    for _ in 0..web.degree(node) {
        let legs = legs(web, node);
        let count = legs.len();
        let at = |index: usize| legs[index % count];
        let gap = |index: usize| between(&at(index), &at(index + 1));
        // The narrowest first, so that what is moved for one pair is seen by the next.
        let narrowest = (0..count).min_by(|a, b| gap(*a).total_cmp(&gap(*b)));
        let Some(index) = narrowest.filter(|index| count >= 3 && gap(*index) < NARROW - 1e-3) else { return };
        let (leg, next) = (at(index), at(index + 1));
        let (before, after) = (gap(index + count - 1), gap(index + 1));
        let rank = |leg: &Leg| {
            let character = web.edge(leg.edge).character;
            (!character.is_link, character.class)
        };
        let room = 2.0 * NARROW;
        let moves_next = match rank(&next).cmp(&rank(&leg)) {
            _ if before.min(after) < room => after > before,
            std::cmp::Ordering::Equal => web.length(next.edge) < web.length(leg.edge),
            order => order.is_lt(),
        };
        if leg.edge == next.edge {
            return;
        }
        let mut choices = [(leg, next.angle - NARROW), (next, leg.angle + NARROW)];
        if moves_next {
            choices.reverse();
        }
        let mut ways = choices.into_iter().flat_map(|choice| [1.0, 0.5].map(|share| (choice, share)));
        if !ways.any(|((moved, turned), share)| is_turned(web, moved, turned, SPREAD * share)) {
            return;
        }
    }
}

/// Lets a street leave its node in another direction for so far, m, unless that would lead it across another street of its junctions.
fn is_turned(web: &mut Web, leg: Leg, angle: f64, reach: f64) -> bool {
    let before = turn_end(web, leg, angle, reach);
    if !crosses_beside(web, leg.edge) {
        return true;
    }
    let turned = std::mem::replace(&mut web.edges[leg.edge as usize].via, before);
    // What crossed before does so still.
    let is_no_worse = crosses_beside(web, leg.edge);
    if is_no_worse {
        web.edges[leg.edge as usize].via = turned;
    }
    is_no_worse
}

/// Whether a street crosses another one of its junctions.
fn crosses_beside(web: &Web, edge: u32) -> bool {
    let beside = web.edge(edge).ends.into_iter().flat_map(|node| &web.node(node).edges);
    beside.filter(|other| **other != edge).any(|other| do_cross(web, edge, *other))
}

/// Lets a street leave its node in another direction, and come back to its course after a while; returns the points that it had.
fn turn_end(web: &mut Web, leg: Leg, angle: f64, reach: f64) -> Vec<Point2> {
    let Leg { edge, end, .. } = leg;
    let mut course = web.course(edge);
    if end == 1 {
        course.reverse();
    }
    let length = polyline::length(&course);
    let reach = reach.min(length * SHARE);
    let turned = course[0] + direction(angle) * reach;
    let mut via = vec![turned];
    let mut walked = 0.0;
    for pair in course.windows(2).take(course.len() - 2) {
        walked += (pair[1] - pair[0]).norm();
        // The other end is another junction's.
        if walked > (reach * 1.3).min(length * 0.5) {
            via.push(pair[1]);
        }
    }
    if end == 1 {
        via.reverse();
    }
    std::mem::replace(&mut web.edges[edge as usize].via, via)
}
