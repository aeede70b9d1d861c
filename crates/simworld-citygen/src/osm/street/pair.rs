//! Two carriageways between the same junctions become one street with a median.
//!
//! Drawn apart, they would leave each junction at an angle that they do not have, and each would be a leg of its own
//! among the signals.

use simworld_core::geometry::{Point2, Vector2};
use simworld_core::net::polyline;

use super::profile::Profile;
use super::web::{Character, Web};
use crate::simplify::simplified;

/// Places where two carriageways are compared, between their ends.
const PLACES: u32 = 8;
/// The longer may be so much longer than the shorter.
const LONGER: f64 = 1.25;
/// How far the middle line may be off, m.
const TOLERANCE: f64 = 0.5;

/// Joins every pair of carriageways no farther apart than `reach` m.
pub(super) fn join_carriageways(web: &mut Web, reach: f64) {
    let mut one_way: Vec<([u32; 2], u32)> = web
        .living()
        .filter(|(_, edge)| edge.character.profile.backward == 0 && edge.ends[0] != edge.ends[1])
        .filter(|(_, edge)| !edge.character.is_roundabout)
        .map(|(index, edge)| ([edge.ends[0].min(edge.ends[1]), edge.ends[0].max(edge.ends[1])], index))
        .collect();
    one_way.sort_unstable();
    for same in one_way.chunk_by(|a, b| a.0 == b.0) {
        let [(_, first), (_, second)] = *same else { continue };
        if web.edge(first).ends[0] == web.edge(second).ends[1] {
            join(web, first, second, reach);
        }
    }
}

fn join(web: &mut Web, first: u32, second: u32, reach: f64) {
    let (a, b) = (web.edge(first).character, web.edge(second).character);
    if a.level != b.level || a.is_covered != b.is_covered {
        return;
    }
    let (there, back) = (web.course(first), polyline::reversed(&web.course(second)));
    // Where the ends lay before they were drawn together; courses without a bend know it from there only.
    let asides = [web.edge(first).aside, web.edge(second).aside];
    let drawn = asides.iter().flatten().sum::<f64>() * 0.5;
    let drawn = if a.profile.is_left_hand { -drawn } else { drawn };
    let Some((middle, apart)) = between(&there, &back, a.profile.is_left_hand, reach) else { return };
    let apart = apart.max(drawn);
    // Those who come back are on the left of those who go where people keep right.
    if apart < -1.0 || apart > reach {
        return;
    }
    let ends = web.edge(first).ends;
    // Each is driven to its own end.
    let turns = [web.edge(second).turns[1], web.edge(first).turns[1]];
    let character = Character {
        class: a.class.max(b.class),
        profile: joined(&a.profile, &b.profile, apart),
        speed: a.speed.max(b.speed),
        is_link: a.is_link && b.is_link,
        ..a
    };
    web.remove(first);
    web.remove(second);
    let line = simplified(&middle, TOLERANCE);
    let edge = web.add_edge(ends, line[1..line.len() - 1].to_vec(), character);
    web.edges[edge as usize].turns = turns;
}

/// The line midway between two that run beside each other, and how far they are apart, negative if they lie the wrong
/// way round; `None` if they do not run beside each other.
fn between(there: &[Point2], back: &[Point2], is_left_hand: bool, reach: f64) -> Option<(Vec<Point2>, f64)> {
    let (long, short) = (polyline::length(there), polyline::length(back));
    if long.max(short) > LONGER * long.min(short) {
        return None;
    }
    let mut middle = vec![there[0]];
    let mut apart = Vec::new();
    // More places on long streets, so that bends are kept.
    let places = PLACES.max((long / 12.0) as u32).min(400);
    for index in 1..places {
        let share = f64::from(index) / f64::from(places);
        let (p, q) = (polyline::at(there, long * share).0, polyline::at(back, short * share).0);
        let across: Vector2 = q - p;
        if across.norm() > reach {
            return None;
        }
        let at = nalgebra::center(&p, &q);
        let along = at - middle[middle.len() - 1];
        let side = if (along.perp(&across) >= 0.0) == is_left_hand { -1.0 } else { 1.0 };
        apart.push(side * across.norm());
        middle.push(at);
    }
    middle.push(*there.last()?);
    // The ends were drawn together: what lies between them is wide in the middle.
    apart.sort_by(f64::total_cmp);
    Some((middle, apart[apart.len() / 2]))
}

/// The profile of both: the second is seen against its course.
fn joined(there: &Profile, back: &Profile, apart: f64) -> Profile {
    let lanes = (there.carriageway() + back.carriageway()) * 0.5;
    // The outer side is the right one where people keep right.
    let outer = usize::from(!there.is_left_hand);
    let sides = |own: [u16; 2], other: [u16; 2]| {
        if there.is_left_hand { [own[outer], other[outer]] } else { [other[outer], own[outer]] }
    };
    Profile {
        forward: there.forward,
        backward: back.forward,
        bus: [there.bus[0], back.bus[0]],
        lane: there.lane.max(back.lane),
        median: ((apart - lanes) * 10.0).clamp(0.0, 400.0) as u16,
        cycle: sides(there.cycle, back.cycle),
        parking: sides(there.parking, back.parking),
        sidewalk: sides(there.sidewalk, back.sidewalk),
        shift: 0,
        is_left_hand: there.is_left_hand,
    }
}
