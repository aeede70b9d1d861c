//! Room for a T across a dead end, where a turning circle has none.

use super::{CAR_TURNING, CrossSection, StreetPlan, polyline};
use crate::geometry::{Point2, Vector2};

/// Width of the head of the T, m: 20 feet, as of the arms of the hammerhead in the International Fire Code 2018, appendix
/// D, figure D103.1.
pub const HAMMERHEAD_WIDTH: f64 = 6.1;
/// Each arm reaches so far beyond the kerb of its street, m: 20 feet (Will County, Illinois, Code of Ordinances, standards
/// of T-turnarounds). On streets from 6.1 m on the head is then no shorter than the 60 feet of the California Code of
/// Regulations, title 14, section 1273.05.
pub const HAMMERHEAD_ARM: f64 = 6.1;
/// Radius of the kerb where the street opens into an arm, m: that of turning circles.
pub(super) const HAMMERHEAD_FLARE: f64 = 5.0;
/// How far the T reaches into its street from the end, m.
pub(super) const HAMMERHEAD_REACH: f64 = HAMMERHEAD_WIDTH + HAMMERHEAD_FLARE;

/// A street that gains less on its end than this share of the way has a bend where the head would lie.
const STRAIGHT: f64 = 0.93;

/// A dead end that wants a hammerhead.
#[derive(Clone, Copy)]
pub(super) struct Wanted<'a> {
    pub(super) street: usize,
    pub(super) at_end: bool,
    /// The centreline of the street, m.
    pub(super) line: &'a [Point2],
}

/// The land of a hammerhead, walkways included.
struct Site {
    /// The end of the street, m.
    at: Point2,
    /// Its corners, the first once more at the end, m.
    ring: [Point2; 5],
    /// The centreline from the end outwards, m.
    outwards: Vec<Point2>,
    /// Direction in which the street leaves its end.
    out: Vector2,
}

impl StreetPlan {
    /// Whether a hammerhead has room at a dead end: its head with its walkways touches no other street's land, stays on
    /// its own side of what lies between it and another dead end, and off the circle there. `is_dead` says of a node
    /// whether it is a dead end. Nobody builds one on a street so wide that a car turns without.
    pub(super) fn has_room_for_head<'a>(
        &self,
        wanted: Wanted<'_>,
        others: impl Iterator<Item = (usize, &'a [Point2])>,
        is_dead: impl Fn(usize) -> bool,
    ) -> bool {
        let own = self.reach_of(wanted.street);
        let Some(site) = self.site(&wanted).filter(|site| site.is_straight(own)) else { return false };
        let mut others = others.filter(|(other, _)| *other != wanted.street);
        others.all(|(other, line)| {
            polyline::distance_between(&site.ring, line) >= self.reach_of(other)
                && self.ends_keep_off(other, &site, &is_dead)
        })
    }

    /// How far the land of a street reaches from its centreline, m.
    fn reach_of(&self, street: usize) -> f64 {
        let section = self.section(&self.streets[street]);
        section.left_of_reference().max(section.right_of_reference())
    }

    /// The land that the head would take; none on a street that is wide enough by itself, or has no direction.
    fn site(&self, wanted: &Wanted<'_>) -> Option<Site> {
        let street = &self.streets[wanted.street];
        let section = self.section(street);
        let ((left, right), walk) = (section.kerbs(), walk_beside(section));
        // Seen leaving the end.
        let (left, right) = if wanted.at_end { (right, left) } else { (left, right) };
        let half = (left + right) * 0.5;
        let outwards = if wanted.at_end { polyline::reversed(wanted.line) } else { wanted.line.to_vec() };
        let [at, next] = outwards.get(..2)? else { return None };
        let out = (next - at).try_normalize(1e-9).filter(|_| half + 1.5 < CAR_TURNING)?;
        let across = Vector2::new(-out.y, out.x);
        let (middle, side) = ((left - right) * 0.5, half + HAMMERHEAD_ARM + walk);
        let corner = |along: f64, beside: f64| at + out * along + across * (middle + beside);
        let (far, near) = (-walk, HAMMERHEAD_REACH);
        let first = corner(far, side);
        let ring = [first, corner(far, -side), corner(near, -side), corner(near, side), first];
        Some(Site { at: *at, ring, out, outwards })
    }

    /// Whether the dead ends of another street, with the circles that they have, leave the land to the head.
    fn ends_keep_off(&self, other: usize, site: &Site, is_dead: impl Fn(usize) -> bool) -> bool {
        let street = &self.streets[other];
        let walk = walk_beside(self.section(street));
        let ends = [(street.from, street.turning[0]), (street.to, street.turning[1])];
        ends.into_iter().filter(|(node, _)| is_dead(*node)).all(|(node, circle)| {
            let there = self.nodes[node];
            let is_ours = |corner: &Point2| (corner - site.at).norm() <= (corner - there).norm();
            let apart = polyline::closest(&site.ring, &there).map_or(f64::INFINITY, |near| near.distance);
            site.ring.iter().all(is_ours) && (circle == 0.0 || apart >= circle + walk)
        })
    }
}

impl Site {
    /// Whether the street, whose land reaches so far from its centreline, goes straight away from the head and does not
    /// come back to it.
    fn is_straight(&self, reach: f64) -> bool {
        let near = 2.0 * HAMMERHEAD_REACH + reach;
        let mut walked = 0.0;
        let approach = polyline::slice(&self.outwards, 0.0, near);
        let goes_away = approach.windows(2).all(|pair| {
            walked += (pair[1] - pair[0]).norm();
            (pair[1] - self.at).dot(&self.out) >= STRAIGHT * walked
        });
        let beyond = polyline::slice(&self.outwards, near, f64::INFINITY);
        let is_short = polyline::length(&self.outwards) <= near;
        goes_away && (is_short || polyline::distance_between(&self.ring, &beyond) >= reach)
    }
}

/// Width of what lies beyond the kerbs of a street, on its wider side, m.
pub(super) fn walk_beside(section: &CrossSection) -> f64 {
    let (left, right) = section.kerbs();
    (section.left_of_reference() - left).max(section.right_of_reference() - right)
}
