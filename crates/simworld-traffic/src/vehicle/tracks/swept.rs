//! The ground that bodies sweep over on their ways across an intersection.
//!
//! A body is held to its way near its front and near its rear, so that in a turn its middle swings inwards and its corners swing
//! outwards: two ways that lie farther apart than two vehicles are wide may still be too near to each other for both. How near
//! depends on who goes there, so this is asked for the sizes of vehicles that there are.

use simworld_core::geometry::{Point2, Vector2, direction};
use simworld_core::net::{Connection, RoadNetwork, Zone, polyline};

/// Where a body is held to its lane, as shares of its length from the front: steered front wheels, and a rear that hardly swings
/// out.
pub(crate) const FRONT_AXLE: f64 = 0.1;
pub(crate) const REAR_AXLE: f64 = 0.95;

/// A body is looked at after so much of its way, m.
const STEP: f64 = 1.0;
/// Either body is taken as so much broader on each side, m, and as longer by half a step at each end, so that nothing is missed
/// between two places that are looked at.
const MARGIN: f64 = 0.1;
/// Room before and behind the stretch on which two bodies could touch, m.
const ROOM: f64 = STEP;
/// Bodies that face the same way all along, by the cosine, are on a straight way.
const STRAIGHT: f64 = 0.9995;
/// A vehicle takes no more than this share of its lane, or nobody could use narrow lanes side by side.
const LANE_SHARE: f64 = 0.9;

/// The middle of a body and the way it faces, from the two points at which it is held.
pub(crate) fn held(front: Point2, rear: Point2) -> (Point2, Vector2) {
    let middle = rear + (front - rear) * ((REAR_AXLE - 0.5) / (REAR_AXLE - FRONT_AXLE));
    (middle, front - rear)
}

/// A length and a width, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Size {
    pub(crate) length: f64,
    pub(crate) width: f64,
}

impl Size {
    /// The smallest that is as long and as wide as each of some; `None` if there are none.
    pub(crate) fn around(sizes: impl Iterator<Item = Self>) -> Option<Self> {
        sizes.reduce(|a, b| Self { length: a.length.max(b.length), width: a.width.max(b.width) })
    }
}

/// A body at one place on its way.
#[derive(Clone, Copy, Debug)]
struct Stance {
    /// Where its front is, m along the way.
    front: f64,
    middle: Point2,
    /// To its front and to its left side, m.
    ahead: Vector2,
    left: Vector2,
    /// From its middle to its corners, m.
    radius: f64,
}

impl Stance {
    /// Whether two bodies touch, by the axes that separate rectangles.
    fn touches(&self, other: &Self) -> bool {
        let between = other.middle - self.middle;
        if between.norm() > self.radius + other.radius {
            return false;
        }
        [self.ahead, self.left, other.ahead, other.left].iter().all(|axis| {
            let reach: f64 = [self.ahead, self.left, other.ahead, other.left]
                .iter()
                .map(|half| half.dot(axis).abs())
                .sum();
            between.dot(axis).abs() < reach
        })
    }

    fn corners(&self) -> [Point2; 4] {
        let Self { middle, ahead, left, .. } = self;
        [middle + ahead + left, middle + ahead - left, middle - ahead + left, middle - ahead - left]
    }
}

/// What a body sweeps over from when its front passes the line until its rear is across.
#[derive(Clone, Debug)]
pub(crate) struct Sweep {
    stances: Vec<Stance>,
    length: f64,
    low: Point2,
    high: Point2,
    is_straight: bool,
}

impl Sweep {
    /// That of a body of such a size on a way.
    pub(crate) fn new(network: &RoadNetwork, way: &Connection, size: Size) -> Self {
        let (from, to) = (&network.lanes[way.from.index()], &network.lanes[way.to.index()]);
        let (line, before) = line(way, (&from.path, from.length), &to.path, size.length + 1.0);
        let width = size.width.min(LANE_SHARE * from.width.min(to.width));
        let half = Vector2::new((size.length + STEP) * 0.5, width * 0.5 + MARGIN);
        let steps = ((way.length + size.length) / STEP).ceil() as u32;
        let mut sweep = Self {
            stances: Vec::with_capacity(steps as usize + 1),
            length: size.length,
            low: Point2::new(f64::INFINITY, f64::INFINITY),
            high: Point2::new(f64::NEG_INFINITY, f64::NEG_INFINITY),
            is_straight: true,
        };
        for front in (0..=steps).map(|step| f64::from(step) * STEP) {
            let at = |share: f64| polyline::at(&line, before + front - share * size.length).0;
            let (middle, facing) = held(at(FRONT_AXLE), at(REAR_AXLE));
            // Both are one point only where a path is.
            let Some(facing) = facing.try_normalize(1e-6) else { continue };
            let left = Vector2::new(-facing.y, facing.x) * half.y;
            sweep.add(Stance { front, middle, ahead: facing * half.x, left, radius: half.norm() });
        }
        sweep
    }

    fn add(&mut self, stance: Stance) {
        for corner in stance.corners() {
            (self.low, self.high) = (self.low.inf(&corner), self.high.sup(&corner));
        }
        let first = self.stances.first().unwrap_or(&stance);
        let along = first.ahead.dot(&stance.ahead) / first.ahead.norm_squared();
        self.is_straight &= along > STRAIGHT;
        self.stances.push(stance);
    }

    /// Whether there is any place where the two could touch, at a first look: on two straight ways that nobody said to meet
    /// vehicles go side by side.
    fn is_near(&self, other: &Self) -> bool {
        let gap = (other.low - self.high).sup(&(self.low - other.high));
        gap.max() <= 0.0 && !(self.is_straight && other.is_straight)
    }

    /// The stretches of this way and of another on which bodies on them touch; `None` if they nowhere do.
    pub(crate) fn meets(&self, other: &Self) -> Option<(Zone, Zone)> {
        if !self.is_near(other) {
            return None;
        }
        let mut own: Option<(f64, f64)> = None;
        let mut others: Option<(f64, f64)> = None;
        let widen = |stretch: &mut Option<(f64, f64)>, front: f64| {
            let (low, high) = stretch.unwrap_or((front, front));
            *stretch = Some((low.min(front), high.max(front)));
        };
        for a in &self.stances {
            for b in other.stances.iter().filter(|b| a.touches(b)) {
                widen(&mut own, a.front);
                widen(&mut others, b.front);
            }
        }
        let zone = |(first, last): (f64, f64), length: f64| Zone {
            enter: (first - ROOM).max(0.0) as f32,
            leave: (last - length + ROOM).max(first) as f32,
        };
        Some((zone(own?, self.length), zone(others?, other.length)))
    }

    /// Whether bodies on the two ways touch anywhere.
    pub(crate) fn touches(&self, other: &Self) -> bool {
        self.is_near(other) && self.stances.iter().any(|a| other.stances.iter().any(|b| a.touches(b)))
    }
}

/// The line of a way with so much of the lanes before and behind it, m, straight on where they are shorter; and where the way
/// begins on it, m.
fn line(way: &Connection, (from, end): (&[Point2], f64), to: &[Point2], beyond: f64) -> (Vec<Point2>, f64) {
    let mut line = Vec::with_capacity(way.path.len() + from.len() + to.len() + 1);
    let (start, heading) = polyline::at(from, 0.0);
    if end < beyond {
        line.push(start - direction(heading) * (beyond - end));
    }
    line.extend(polyline::slice(from, end - beyond, end));
    let before = polyline::length(&line);
    line.extend(way.path.iter().skip(1));
    let behind = polyline::slice(to, 0.0, beyond);
    let (last, heading) = polyline::at(&behind, beyond);
    line.extend(behind.into_iter().skip(1));
    // Beyond a short lane as well.
    line.push(last + direction(heading) * beyond);
    (line, before)
}
