//! The T across a dead end: its kerbs, the walkway round it, and the way of a vehicle in it.
//!
//! Its far kerb passes the end of the street, so that it takes no room beyond; its arms lie on both sides.

use std::f64::consts::FRAC_PI_2;

use super::kerbs::{KERB_STEP, WALK_STEP, arc, way_round};
use super::legs::Leg;
use crate::geometry::Point2;
use crate::net::hammerhead::{HAMMERHEAD_FLARE, HAMMERHEAD_REACH};
use crate::net::{HAMMERHEAD_ARM, HAMMERHEAD_WIDTH, Hammerhead};

/// How far it reaches into its street, m.
pub(super) const REACH: f64 = HAMMERHEAD_REACH;

/// The T about the middle of the carriageway of a street.
struct Head<'a> {
    leg: &'a Leg,
    /// Half the width of the street, m.
    half: f64,
}

impl<'a> Head<'a> {
    fn of(leg: &'a Leg) -> Self {
        Self { leg, half: (leg.left + leg.right) * 0.5 }
    }

    /// The point `along` m into the street and `beside` m to the left of the middle of its carriageway, seen leaving.
    fn point(&self, along: f64, beside: f64) -> Point2 {
        self.leg.point(along, (self.leg.left - self.leg.right) * 0.5 + beside)
    }

    /// Adds the way round at a distance outside of the kerb, counter-clockwise from the left of the street to its right,
    /// both left out.
    fn round(&self, outside: f64, step: f64, points: &mut Vec<Point2>) {
        let outside = outside.min(HAMMERHEAD_FLARE);
        let (tip, flare) = (self.half + HAMMERHEAD_ARM + outside, self.half + HAMMERHEAD_FLARE);
        let (near, far) = (HAMMERHEAD_WIDTH + outside, -outside);
        let beside = self.half + outside;
        let first = points.len();
        arc(self.point(REACH, flare), self.point(REACH, beside), -FRAC_PI_2, step, points);
        points.remove(first);
        points.extend([self.point(near, tip), self.point(far, tip)]);
        points.extend([self.point(far, -tip), self.point(near, -tip)]);
        arc(self.point(REACH, -flare), self.point(near, -flare), -FRAC_PI_2, step, points);
        points.pop();
    }

    /// Radius of the widest circle between its kerbs, m: it touches the far one and both flares.
    fn inscribed(&self) -> f64 {
        let flare = self.half + HAMMERHEAD_FLARE;
        let squares = flare * flare + REACH * REACH - HAMMERHEAD_FLARE * HAMMERHEAD_FLARE;
        squares / (2.0 * (REACH + HAMMERHEAD_FLARE))
    }
}

/// The hammerhead of a dead end that has one.
pub(super) fn head(legs: &[Leg]) -> Option<Hammerhead> {
    let [leg] = legs else { return None };
    let (head, middle) = (Head::of(leg), HAMMERHEAD_WIDTH * 0.5);
    let tip = head.half + HAMMERHEAD_ARM;
    let tips = [head.point(middle, tip), head.point(middle, -tip)];
    leg.hammerhead.then_some(Hammerhead { tips, width: HAMMERHEAD_WIDTH })
}

/// Adds the kerb from the left of the street round the T to its right, both left out.
pub(super) fn kerb(leg: &Leg, outline: &mut Vec<Point2>) {
    Head::of(leg).round(0.0, KERB_STEP, outline);
}

/// Adds the walkway round the T, so far outside of its kerbs, without its ends.
pub(super) fn walk_round(leg: &Leg, outside: f64, walkway: &mut Vec<Point2>) {
    Head::of(leg).round(outside, WALK_STEP, walkway);
}

/// The way of a vehicle that turns in a T between two lanes, as [`way_round`] has them. `keep` is the distance of its
/// middle from the kerb.
///
/// Vehicles go forwards only, where a driver would back into an arm: the way is the widest circle along the far kerb that
/// keeps off the flares and is left in an arc no tighter than itself. At the end of a street of 7 m a small car, whose turning
/// circle is 10.5 m between kerbs, can drive it in one go; a longer vehicle is led on a way that it could not steer.
pub(super) fn turning_path(leg: &Leg, (left, right): (f64, f64), keep: f64) -> Option<Vec<Point2>> {
    let shift = (leg.left - leg.right) * 0.5;
    let room = REACH - keep;
    // As wide as the arcs that lead to it and away: (room - r)² - r² + beside² = 2 r (r - beside).
    let even = |beside: f64| {
        let beside = beside.abs();
        let rest = room - beside;
        ((rest * rest + 2.0 * (room * room + beside * beside)).sqrt() - rest) * 0.5
    };
    let radius = (Head::of(leg).inscribed() - keep).min(even(left - shift)).min(even(right + shift));
    way_round(leg, (radius + keep, radius), (left, right))
}
