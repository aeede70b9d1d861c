//! A proposed segment, and the rules by which it is attached, cut or refused.

use simworld_core::geometry::{Point2, Vector2};
use simworld_core::net::{RoadClass, polyline};

use super::fabric::Fabric;

/// Nothing shorter than this share of the mean length is built.
const LEAST_SHARE: f64 = 0.45;
/// Streets that do not meet keep this share of the mean length apart.
const CLEARANCE_SHARE: f64 = 0.36;

/// A segment that an end would like to build.
#[derive(Clone, Copy, Debug)]
pub(super) struct Proposal {
    pub(super) from: u32,
    pub(super) along: Vector2,
    pub(super) length: f64,
    pub(super) class: RoadClass,
}

/// Where a segment arrives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Arrival {
    /// In the open.
    New(Point2),
    /// At a junction.
    Node(u32),
    /// On a street, which is split there.
    Interior(u32, Point2),
}

/// A proposal that may be built.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fitted {
    pub(super) from: u32,
    pub(super) class: RoadClass,
    pub(super) arrival: Arrival,
}

impl Fitted {
    /// Whether it arrives in the open.
    pub(super) fn is_open(&self) -> bool {
        matches!(self.arrival, Arrival::New(_))
    }
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
    pub(super) fn new(length: f64, snap: f64, least_angle: f64) -> Self {
        Self {
            snap,
            least_length: length * LEAST_SHARE,
            most_length: length * 2.6,
            clearance: length * CLEARANCE_SHARE,
            cos_least_angle: simworld_core::ops::cos(least_angle),
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
        let start = fabric.at(proposal.from);
        let wanted = start + proposal.along * proposal.length;
        // An end whose street was taken away since hangs on nothing.
        let is_loose = fabric.degree(proposal.from) == 0 && !fabric.segments().is_empty();
        if is_loose || !fabric.has_room(proposal.from) || !fabric.holds(wanted) {
            return None;
        }
        let leaving = proposal.along;
        // Most that fail here would fail for certain: a street already goes that way.
        if fabric.ways(proposal.from).any(|way| way.dot(&leaving) > measures.cos_least_angle + 0.1) {
            return None;
        }
        fabric.segments_near(start, wanted, measures.snap + measures.clearance, &mut self.near);
        let rules = Rules { fabric, measures, near: &self.near, from: proposal.from, start };
        let arrival = rules
            .junction_near(wanted)
            .or_else(|| rules.first_street_met(wanted))
            .or_else(|| rules.street_near(wanted))
            .unwrap_or(Arrival::New(wanted));
        rules.allow(arrival).then_some(Fitted { from: proposal.from, class: proposal.class, arrival })
    }
}

struct Rules<'a> {
    fabric: &'a Fabric,
    measures: &'a Measures,
    /// Segments that may matter.
    near: &'a [u32],
    from: u32,
    start: Point2,
}

impl Rules<'_> {
    /// The junction nearest to the wanted end within the snap distance.
    fn junction_near(&self, wanted: Point2) -> Option<Arrival> {
        let mut best = (self.measures.snap * self.measures.snap, u32::MAX);
        self.fabric.visit_nodes(wanted, self.measures.snap, |node, at| {
            let distance = (at - wanted).norm_squared();
            if node != self.from && (distance, node) < best && self.fabric.degree(node) > 0 {
                best = (distance, node);
            }
        });
        (best.1 != u32::MAX).then_some(Arrival::Node(best.1))
    }

    /// The ends of those near segments that stand and do not touch the start.
    fn others(&self) -> impl Iterator<Item = (u32, Point2, Point2)> {
        self.near.iter().copied().filter_map(|index| {
            let segment = self.fabric.segment(index);
            let own = segment.from == self.from || segment.to == self.from;
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
        if to_start.min(to_end) >= self.measures.least_length {
            Arrival::Interior(index, point)
        } else if to_start <= to_end {
            Arrival::Node(segment.from)
        } else {
            Arrival::Node(segment.to)
        }
    }

    /// Intersection validation: length, angles at both ends, number of streets, distance from everything else.
    fn allow(&self, arrival: Arrival) -> bool {
        let end = match arrival {
            Arrival::New(point) | Arrival::Interior(_, point) => point,
            Arrival::Node(node) => self.fabric.at(node),
        };
        let length = (end - self.start).norm();
        if !(self.measures.least_length..=self.measures.most_length).contains(&length) {
            return false;
        }
        let along = (end - self.start) / length;
        self.angles_allow(self.fabric.ways(self.from), along)
            && self.arrival_allows(arrival, -along)
            && self.is_clear(arrival, end)
    }

    fn arrival_allows(&self, arrival: Arrival, arriving: Vector2) -> bool {
        match arrival {
            Arrival::New(_) => true,
            Arrival::Node(node) => {
                self.fabric.has_room(node)
                    && !self.fabric.are_joined(self.from, node)
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
            let joined_at = |node: u32| node == self.from || arrival == Arrival::Node(node);
            let ends = [segment.from, segment.to].map(|node| self.fabric.at(node));
            if matches!(arrival, Arrival::Interior(split, _) if split == index) {
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
