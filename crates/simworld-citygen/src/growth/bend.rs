//! Bows and bends of streets between their ends, which keep their direction there, so that junctions stay as checked.

use std::f64::consts::{PI, TAU};

use simworld_core::geometry::{Point2, Vector2};
use simworld_core::net::RoadClass;
use simworld_core::ops;
use simworld_core::seed::StreamRng;

/// Shorter streets stay straight, m.
const SHORTEST: f64 = 60.0;
/// So much at either end stays straight, m: there are crossings and stop lines.
const STRAIGHT: f64 = 17.0;
/// Only longer ones bend both ways, m.
const DOUBLED: f64 = 120.0;
/// Pieces of a bent street.
const PIECES: u32 = 16;
/// From one piece to the next it turns by no more than this, radians: over one corner a bus swings inwards by a quarter of its wheelbase
/// times as much, which is more than on an arc.
const CORNER: f64 = 0.22;

/// The least radius of a bend of a street of a class, m: what its speed asks for without banking, v²/(g f) with a side friction f
/// of 0.31 at 30 km/h, to which one slows down in local streets, and 0.21 at 50 km/h (AASHTO, A Policy on Geometric Design of
/// Highways and Streets, 2011, section 3.3, streets of low speed): 23 and 92 m. It is also room for two buses of 11.5 m that meet,
/// whose bodies need 18/R m beside their widths: 0.9 m on a radius of 20 m, and lanes of 3.5 m leave 1.
pub(super) const fn least_radius(class: RoadClass) -> f64 {
    match class {
        RoadClass::Local => 25.0,
        RoadClass::Arterial | RoadClass::Highway => 92.0,
    }
}

/// Points of a bent course between two ends: a bow `sin²` or a double bend `sin · sin²`, both level at the ends, of a
/// height about `bow` times the length, at most `most` m and nowhere tighter than a radius of `least_radius` m.
///
/// A bow of height h on a chord c is longer than it by about (π h / 2 c)², a double bend by three times as much.
pub(super) fn course(
    curves: &Curves,
    from: Point2,
    to: Point2,
    bow: f64,
    most: f64,
    least_radius: f64,
    rng: &mut StreamRng,
) -> Vec<Point2> {
    let along = to - from;
    let length = along.norm();
    let doubled = rng.chance(0.5) && length > DOUBLED;
    let side = if rng.chance(0.5) { 1.0 } else { -1.0 };
    // The second derivative of sin² is 2 π² at most, that of the double bend 2.74 times as much.
    let bent = length - 2.0 * STRAIGHT;
    let tightest = 2.0 * PI * PI * if doubled { 2.74 } else { 1.0 };
    let least_radius = least_radius.max(bent / (f64::from(PIECES) * CORNER));
    let most = most.min(bent * bent / (tightest * least_radius));
    let height = side * (rng.uniform(0.5, 1.5) * bow * length).min(most);
    if length < SHORTEST || height.abs() < 0.5 {
        return Vec::new();
    }
    let normal = Vector2::new(-along.y, along.x) / length;
    let (from, along) = (from + along * (STRAIGHT / length), along * (1.0 - 2.0 * STRAIGHT / length));
    let waves = if doubled { &curves.doubled } else { &curves.single };
    (0..=PIECES)
        .zip(waves)
        .map(|(piece, wave)| from + along * (f64::from(piece) / f64::from(PIECES)) + normal * (height * wave))
        .collect()
}

/// The heights of a bow and of a double bend at the ends of their pieces, over the greatest height of the bow.
#[derive(Clone, Debug)]
pub(super) struct Curves {
    single: [f64; PIECES as usize + 1],
    doubled: [f64; PIECES as usize + 1],
}

impl Curves {
    pub(super) fn new() -> Self {
        let share = |piece: usize| piece as f64 / f64::from(PIECES);
        let bow = |piece: usize| {
            let window = ops::sin(PI * share(piece));
            window * window
        };
        Self {
            single: std::array::from_fn(bow),
            doubled: std::array::from_fn(|piece| bow(piece) * ops::sin(TAU * share(piece))),
        }
    }
}
