//! From outlines to buildings: the rectangle round each, the way it looks, its door.

use simworld_core::geometry::{Point2, Vector2, bounds, heading};
use simworld_core::ops::{sin_cos, wrap_angle};

use super::Outline;
use super::usage::{archetype_of, zone_of};
use crate::building::{Building, Footprint, Surveyed};
use crate::doors::Door;

/// An outline that fills this share of the rectangle round it is one.
const RECTANGLE: f64 = 0.985;

/// A rectangle round an outline.
struct Round {
    middle: Point2,
    /// Along the first side.
    angle: f64,
    length: f64,
    width: f64,
}

/// Raises a building on an outline with the door that is found for its middle; `None` without one.
pub(in crate::osm) fn raise(outline: &Outline, door: impl Fn(Point2) -> Option<Door>) -> Option<Building> {
    let round = round(&outline.corners);
    let door = door(round.middle)?;
    // Of the four sides the one that looks to the sidewalk has the entrance.
    let to_street = heading(&(door.at - round.middle));
    let quarter = std::f64::consts::FRAC_PI_2;
    let turns = (wrap_angle(to_street - round.angle) / quarter).round();
    let facing = wrap_angle(round.angle + turns * quarter);
    let is_turned = turns as i64 % 2 != 0;
    let (depth, width) = if is_turned { (round.width, round.length) } else { (round.length, round.width) };
    let fills = outline.area / (depth * width);
    let footprint = if outline.courts.is_empty() && outline.corners.len() == 4 && fills > RECTANGLE {
        Footprint::Rectangle
    } else {
        let local = |corners: &Vec<Point2>| to_body(corners, round.middle, facing);
        let courts = outline.courts.iter().map(local).collect();
        Footprint::Surveyed(Box::new(Surveyed { outline: local(&outline.corners), courts }))
    };
    let usage = &outline.usage;
    Some(Building {
        archetype: archetype_of(usage.place, width, depth, usage.storeys),
        place: usage.place,
        name: usage.name.clone(),
        center: round.middle,
        facing,
        width,
        depth,
        footprint,
        storeys: usage.storeys,
        roof: usage.roof,
        zone: zone_of(usage.place),
        access: door.at,
        road: door.road,
        side: door.side,
        frontage: width,
        given: true,
    })
}

/// Points in the frame of a body.
fn to_body(corners: &[Point2], middle: Point2, facing: f64) -> Vec<Point2> {
    let (sin, cos) = sin_cos(facing);
    let ahead = Vector2::new(cos, sin);
    let left = Vector2::new(-sin, cos);
    corners
        .iter()
        .map(|corner| Point2::new((corner - middle).dot(&ahead), (corner - middle).dot(&left)))
        .collect()
}

/// The smallest rectangle round an outline with a side along one of its walls.
fn round(corners: &[Point2]) -> Round {
    let mut best: Option<(f64, Round)> = None;
    let count = corners.len();
    for index in 0..count {
        let Some(ahead) = (corners[(index + 1) % count] - corners[index]).try_normalize(0.5) else {
            continue;
        };
        let left = Vector2::new(-ahead.y, ahead.x);
        let span = |axis: Vector2| {
            corners
                .iter()
                .map(|corner| (corner - corners[index]).dot(&axis))
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
        };
        let ((back, front), (right, far)) = (span(ahead), span(left));
        let area = (front - back) * (far - right);
        if best.as_ref().is_none_or(|(least, _)| area < *least) {
            let middle = corners[index] + ahead * ((back + front) * 0.5) + left * ((right + far) * 0.5);
            let round = Round { middle, angle: heading(&ahead), length: front - back, width: far - right };
            best = Some((area, round));
        }
    }
    // An outline of very short walls only: the box along the axes.
    best.map_or_else(|| along_axes(corners), |(_, round)| round)
}

fn along_axes(corners: &[Point2]) -> Round {
    let (low, high) = bounds(corners).unwrap_or_default();
    let size = high - low;
    Round { middle: nalgebra::center(&low, &high), angle: 0.0, length: size.x, width: size.y }
}
