//! Bodies that are not walkers, as walkers see them: rows of people along their outlines, and threats at crossings.

use simworld_core::geometry::{Point2, Vector2};
use simworld_core::net::{RoadNetwork, WaypointGraph, polyline};

use super::Foreign;
use super::foreign::Finder;
use crate::crowd::Person;
use crate::pedestrian::on_storey;

/// Braking that one trusts a driver with, m/s².
const TRUSTED: f64 = 3.0;
/// Room to spare before a crossing, m.
const SPARE: f64 = 2.0;
/// Who is slower than this is no threat, m/s; people and what moves like them are none below the other.
const SLOW: f64 = 0.5;
const RUNNING: f64 = 3.0;
/// Who reaches no farther than this to all sides moves like people, m.
const SMALL: f64 = 0.8;

/// Adds people along the outline of a body, so close that nobody passes between them.
pub(super) fn outline(body: &Foreign, radius: f64, ways: &WaypointGraph, people: &mut Vec<Person>) {
    let speed = body.velocity.norm();
    let direction = if speed > 0.0 { body.velocity / speed } else { Vector2::zeros() };
    let mut add = |position: Point2| {
        people.push(on_storey(Person { position, direction, speed }, body.height, ways));
    };
    // The outermost touch the outline from within.
    let (length, width) = ((body.radius - radius).max(0.0), (body.half_width - radius).max(0.0));
    if length.max(width) < 0.2 * radius {
        add(body.position);
        return;
    }
    let ahead = body.direction.try_normalize(1e-9).unwrap_or_else(Vector2::x);
    let left = Vector2::new(-ahead.y, ahead.x);
    let corners = [(length, width), (-length, width), (-length, -width), (length, -width)];
    for (index, (x, y)) in corners.iter().enumerate() {
        let (to_x, to_y) = corners[(index + 1) % corners.len()];
        let count = ((to_x - x).abs().max((to_y - y).abs()) / (1.9 * radius)).ceil();
        for step in 0..count as u32 {
            let share = f64::from(step) / count;
            let (x, y) = (x + (to_x - x) * share, y + (to_y - y) * share);
            add(body.position + ahead * x + left * y);
        }
    }
}

/// When somebody comes to each crossing who could not stop before it without more braking than one trusts them with, s.
pub(super) fn threats(network: &RoadNetwork, finder: &Finder, foreign: &[Foreign], found: &mut Vec<f64>) {
    found.clear();
    found.resize(network.crossings.len(), f64::INFINITY);
    for body in foreign {
        let speed = body.velocity.norm();
        if speed < SLOW || (speed < RUNNING && body.radius.max(body.half_width) < SMALL) {
            continue;
        }
        let stopping = speed * speed / (2.0 * TRUSTED) + SPARE;
        let reach = stopping + body.radius;
        let end = body.position + body.velocity * (reach / speed);
        finder.crossings_along(body.position, end, &mut |index| {
            let crossing = &network.crossings[index as usize];
            if body.is_clear_of(network, crossing.road, crossing.start) {
                return;
            }
            let strip = [crossing.start, crossing.end];
            let half = crossing.width * 0.5 + body.radius;
            let is_on = polyline::closest(&strip, &body.position).is_some_and(|near| near.distance <= half);
            let ahead = polyline::crossing(body.position, end, crossing.start, crossing.end);
            let distance = match ahead {
                _ if is_on => 0.0,
                Some((share, _)) => (share * reach - half).max(0.0),
                None => return,
            };
            let time = &mut found[index as usize];
            *time = time.min(distance / speed);
        });
    }
}
