//! A proposed segment, and the rules by which it is attached, cut or refused.

use simworld_core::geometry::{Point2, Vector2};
use simworld_core::net::{RoadClass, polyline};

use super::fabric::Fabric;
use super::fitted::{Arrival, Fitted, Start};
use crate::RoadConfig;

/// Nothing shorter than this share of the mean length is built.
const LEAST_SHARE: f64 = 0.38;
/// Streets that do not meet keep this share of the mean length apart.
const CLEARANCE_SHARE: f64 = 0.36;

/// A segment that an end would like to build.
#[derive(Clone, Copy, Debug)]
pub(super) struct Proposal {
    pub(super) from: Start,
    pub(super) along: Vector2,
    pub(super) length: f64,
    pub(super) class: RoadClass,
    /// How far the land must be empty on both its sides, m: more than nothing if it is to divide a large block.
    pub(super) emptiness: f64,
}

/// The measures by which proposals are judged, m; and the cosine of the least angle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Measures {
    pub(super) snap: f64,
    pub(super) least_length: f64,
    pub(super) most_length: f64,
    pub(super) clearance: f64,
    pub(super) cos_least_angle: f64,
}

impl Measures {
    pub(super) fn new(config: &RoadConfig) -> Self {
        let length = config.length;
        Self {
            snap: config.snap,
            least_length: length * LEAST_SHARE,
            most_length: length * 3.2,
            clearance: length * CLEARANCE_SHARE,
            cos_least_angle: simworld_core::ops::cos(config.least_angle),
        }
    }
}

/// Attaches proposals to what they meet, or refuses them. It keeps its buffer from one to the next.
#[derive(Clone, Debug, Default)]
pub(super) struct Fitter {
    near: Vec<u32>,
}

impl Fitter {
    /// The first way to arrive decides: a proposal that nearly meets something joins it or is not built.
    pub(super) fn fit(
        &mut self,
        fabric: &mut Fabric,
        proposal: &Proposal,
        measures: &Measures,
    ) -> Option<Fitted> {
        let start = fabric.start(proposal.from);
        let wanted = start + proposal.along * proposal.length;
        if !fabric.can_leave(proposal.from) || !fabric.holds(wanted) {
            return None;
        }
        // Most that fail here would fail for certain: a street already goes that way.
        let limit = measures.cos_least_angle + 0.1;
        if fabric.ways_from(proposal.from).any(|way| way.dot(&proposal.along) > limit) {
            return None;
        }
        let margin = (measures.snap + measures.clearance).max(proposal.emptiness);
        fabric.segments_near(start, wanted, margin, &mut self.near);
        let rules = Rules { fabric, measures, near: &self.near, from: proposal.from, start };
        let arrival = rules
            .junction_near(wanted)
            .or_else(|| rules.first_street_met(wanted))
            .or_else(|| rules.street_near(wanted))
            .unwrap_or(Arrival::New(wanted));
        let fits = rules.allow(arrival) && rules.is_empty_beside(arrival, proposal.emptiness);
        fits.then_some(Fitted { from: proposal.from, class: proposal.class, arrival })
    }
}

struct Rules<'a> {
    fabric: &'a Fabric,
    measures: &'a Measures,
    /// Segments that may matter.
    near: &'a [u32],
    from: Start,
    start: Point2,
}

impl Rules<'_> {
    /// The junction nearest to the wanted end within the snap distance.
    fn junction_near(&self, wanted: Point2) -> Option<Arrival> {
        let mut best = (self.measures.snap * self.measures.snap, u32::MAX);
        self.fabric.visit_nodes(wanted, self.measures.snap, |node, at| {
            let distance = (at - wanted).norm_squared();
            if Start::Node(node) != self.from && (distance, node) < best && self.fabric.degree(node) > 0 {
                best = (distance, node);
            }
        });
        (best.1 != u32::MAX).then_some(Arrival::Node(best.1))
    }

    /// The ends of those near segments that stand and do not touch the start.
    fn others(&self) -> impl Iterator<Item = (u32, Point2, Point2)> {
        self.near.iter().copied().filter_map(|index| {
            let segment = self.fabric.segment(index);
            let own = match self.from {
                Start::Node(node) => segment.from == node || segment.to == node,
                Start::Middle(street) => index == street,
            };
            (!own && self.fabric.is_standing(index))
                .then(|| (index, self.fabric.at(segment.from), self.fabric.at(segment.to)))
        })
    }

    /// The first street that the segment would cross.
    fn first_street_met(&self, wanted: Point2) -> Option<Arrival> {
        let crossings = self.others().filter_map(|(index, a, b)| {
            polyline::crossing(self.start, wanted, a, b).map(|(share, _)| (share, index))
        });
        let first = crossings.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))?;
        Some(self.on_street(first.1, self.start + (wanted - self.start) * first.0))
    }

    /// The street nearest to the wanted end within the snap distance.
    fn street_near(&self, wanted: Point2) -> Option<Arrival> {
        let distances = self.others().map(|(index, a, b)| {
            let on = nearest(a, b, wanted);
            ((on - wanted).norm_squared(), index, on)
        });
        let best = distances.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))?;
        (best.0 <= self.measures.snap * self.measures.snap).then(|| self.on_street(best.1, best.2))
    }

    /// Arrives at a point of a street, or at the end of the street if that is too near for a junction of its own.
    fn on_street(&self, index: u32, point: Point2) -> Arrival {
        let segment = self.fabric.segment(index);
        let distance = |node: u32| (self.fabric.at(node) - point).norm();
        let (to_start, to_end) = (distance(segment.from), distance(segment.to));
        if to_start.min(to_end) >= self.measures.least_length && !self.fabric.is_wall(index) {
            Arrival::Interior(index, point)
        } else if to_start <= to_end {
            Arrival::Node(segment.from)
        } else {
            Arrival::Node(segment.to)
        }
    }

    /// Intersection validation: length, angles at both ends, number of streets, distance from everything else.
    fn allow(&self, arrival: Arrival) -> bool {
        let end = self.end(arrival);
        let length = (end - self.start).norm();
        if !(self.measures.least_length..=self.measures.most_length).contains(&length) {
            return false;
        }
        let along = (end - self.start) / length;
        self.stays_inside(arrival, along)
            && self.angles_allow(self.fabric.ways_from(self.from), along)
            && self.arrival_allows(arrival, -along)
            && self.is_clear(arrival, end)
    }

    /// Whether the segment lies within the walls; none crosses them on its way.
    fn stays_inside(&self, arrival: Arrival, along: Vector2) -> bool {
        let leaves = |node: u32, along: Vector2| self.fabric.leads_inside(node, along);
        let start = !matches!(self.from, Start::Node(node) if !leaves(node, along));
        start && !matches!(arrival, Arrival::Node(node) if !leaves(node, -along))
    }

    fn end(&self, arrival: Arrival) -> Point2 {
        match arrival {
            Arrival::New(point) | Arrival::Interior(_, point) => point,
            Arrival::Node(node) => self.fabric.at(node),
        }
    }

    /// Whether the land on both sides of the middle is empty.
    fn is_empty_beside(&self, arrival: Arrival, emptiness: f64) -> bool {
        if emptiness <= 0.0 {
            return true;
        }
        let end = self.end(arrival);
        let middle = nalgebra::center(&self.start, &end);
        let along = (end - self.start).normalize();
        let across = Vector2::new(-along.y, along.x) * emptiness;
        self.near.iter().copied().filter(|index| self.fabric.is_standing(*index)).all(|index| {
            let segment = self.fabric.segment(index);
            let (a, b) = (self.fabric.at(segment.from), self.fabric.at(segment.to));
            polyline::crossing(middle - across, middle + across, a, b).is_none()
        })
    }

    fn arrival_allows(&self, arrival: Arrival, arriving: Vector2) -> bool {
        match arrival {
            Arrival::New(_) => true,
            Arrival::Node(node) => {
                let is_joined = match self.from {
                    Start::Node(from) => self.fabric.are_joined(from, node),
                    Start::Middle(street) => self.fabric.is_end(street, node),
                };
                self.fabric.has_room(node)
                    && !is_joined
                    && self.angles_allow(self.fabric.ways(node), arriving)
            }
            Arrival::Interior(index, _) => {
                let along = self.fabric.segment(index).along;
                self.angles_allow([along, -along].into_iter(), arriving)
            }
        }
    }

    fn angles_allow(&self, mut present: impl Iterator<Item = Vector2>, new: Vector2) -> bool {
        present.all(|way| way.dot(&new) <= self.measures.cos_least_angle)
    }

    /// Whether the segment keeps its distance from all streets that it does not join, and from all their ends.
    fn is_clear(&self, arrival: Arrival, end: Point2) -> bool {
        let clearance = self.measures.clearance * self.measures.clearance;
        let keeps_away =
            |point: Point2| (nearest(self.start, end, point) - point).norm_squared() >= clearance;
        self.near.iter().copied().filter(|index| self.fabric.is_standing(*index)).all(|index| {
            let segment = self.fabric.segment(index);
            let joined_at = |node: u32| Start::Node(node) == self.from || arrival == Arrival::Node(node);
            let ends = [segment.from, segment.to].map(|node| self.fabric.at(node));
            let is_split = matches!(arrival, Arrival::Interior(split, _) if split == index);
            if is_split || self.from == Start::Middle(index) {
                return ends.into_iter().all(keeps_away);
            }
            match (joined_at(segment.from), joined_at(segment.to)) {
                // Two streets of one junction part by the angle rule; the far end must still keep away.
                (true, true) => true,
                (true, false) => keeps_away(ends[1]),
                (false, true) => keeps_away(ends[0]),
                (false, false) => distance_squared([self.start, end], ends) >= clearance,
            }
        })
    }
}

/// The point of a segment that is nearest to another point.
fn nearest(a: Point2, b: Point2, point: Point2) -> Point2 {
    let along = b - a;
    let share = ((point - a).dot(&along) / along.norm_squared().max(1e-12)).clamp(0.0, 1.0);
    a + along * share
}

/// The square of the distance between two segments.
fn distance_squared([a, b]: [Point2; 2], [c, d]: [Point2; 2]) -> f64 {
    if polyline::crossing(a, b, c, d).is_some() {
        return 0.0;
    }
    let to = |p: Point2, q: Point2, x: Point2| (nearest(p, q, x) - x).norm_squared();
    to(a, b, c).min(to(a, b, d)).min(to(c, d, a)).min(to(c, d, b))
}
