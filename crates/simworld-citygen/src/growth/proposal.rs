//! A proposed segment, and the rules by which it is attached, cut or refused.

use std::hint::select_unpredictable;

use simworld_core::geometry::{Point2, Vector2};
use simworld_core::net::RoadClass;

use super::cells::Bounds;
use super::course::{Course, all, may_be_near, nearest};
use super::fabric::{Fabric, Near, Scratch, Ways};
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
    scratch: Scratch,
}

impl Fitter {
    /// The first way to arrive decides: a proposal that nearly meets something joins it or is not built.
    pub(super) fn fit(
        &mut self,
        fabric: &Fabric,
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
        let ways = fabric.ways_from(proposal.from);
        if !all_turn_from(&ways, proposal.along, limit) {
            return None;
        }
        // What decides where it arrives, and what it has to keep away from if that is on its way.
        let margin = measures.snap.max(measures.clearance);
        let near = fabric.gather(&Bounds::around(start, wanted, margin), &mut self.scratch);
        let rules = Rules { fabric, measures, near, from: proposal.from, start, ways };
        let arrival = rules.arrival(wanted);
        let end = rules.end(arrival);
        if !rules.turns_well(arrival, end) || !rules.is_empty_beside(end, proposal.emptiness) {
            return None;
        }
        let is_clear = if Bounds::around(start, wanted, margin - measures.clearance).holds(end) {
            rules.is_clear(arrival, end)
        } else {
            // It is led aside, to where nothing was looked at yet.
            let bounds = Bounds::around(start, end, measures.clearance);
            let near = fabric.gather(&bounds, &mut self.scratch);
            Rules { fabric, measures, near, from: proposal.from, start, ways }.is_clear(arrival, end)
        };
        is_clear.then_some(Fitted { from: proposal.from, class: proposal.class, arrival })
    }
}

/// Whether a way turns away from all that are there by at least the angle of a cosine, which is above zero.
fn all_turn_from(present: &Ways, new: Vector2, cos_least: f64) -> bool {
    // All are reckoned and nothing decided before the end; what is no way is at right angles to all.
    all(present.map(|way| way.dot(&new) <= cos_least))
}

/// The nearest node so far: the square of its distance by its bits, which are ordered as numbers are that are not
/// negative, and its number.
type Nearest = (u64, u32);

/// The nearer one of a node and the nearest so far; of those as near, the one of the lesser number. One node does not count.
fn nearer((least, best): Nearest, node: u32, at: Point2, from: Point2, not: u32) -> Nearest {
    let distance = (from - at).norm_squared().to_bits();
    let (is_nearer, is_tied) = (distance < least, all([distance == least, node < best]));
    let is_nearer = all([node != not, is_nearer | is_tied]);
    (select_unpredictable(is_nearer, distance, least), select_unpredictable(is_nearer, node, best))
}

struct Rules<'a> {
    fabric: &'a Fabric,
    measures: &'a Measures,
    /// Segments that may matter.
    near: &'a [Near],
    from: Start,
    start: Point2,
    /// The ways that leave there.
    ways: Ways,
}

impl Rules<'_> {
    /// Where a segment that wants to end there arrives: at the junction nearest to its end within the snap distance, else
    /// on the first street that it would cross, else on the street nearest to its end within the snap distance.
    fn arrival(&self, wanted: Point2) -> Arrival {
        let snap = self.measures.snap * self.measures.snap;
        let course = Course::new(self.start, wanted);
        let (from, _) = self.touched();
        let (mut nearest, mut is_beside) = ((u64::MAX, u32::MAX), false);
        // Where the first and the last one stand that it would cross.
        let mut met = (usize::MAX, 0);
        // One look at each, in which nothing is decided before the end: what is where cannot be foretold.
        for (place, near) in self.near.iter().enumerate() {
            nearest = nearer(nearest, near.from, near.a, wanted, from);
            nearest = nearer(nearest, near.to, near.b, wanted, from);
            let is_other = self.is_other(near);
            let is_met = is_other & course.crosses(near.a, near.b);
            met.1 = select_unpredictable(is_met, place, met.1);
            met.0 = met.0.min(select_unpredictable(is_met, place, usize::MAX));
            is_beside |= is_other & may_be_near(near.a, near.b, wanted, snap);
        }
        if nearest.0 <= snap.to_bits() {
            return Arrival::Node(nearest.1);
        }
        if let Some(met) = self.near.get(met.0..=met.1) {
            return self.first_street_met(met, wanted);
        }
        let street = if is_beside { self.street_near(wanted) } else { None };
        street.unwrap_or(Arrival::New(wanted))
    }

    /// The node and the street that it begins at: one of them is none.
    fn touched(&self) -> (u32, u32) {
        match self.from {
            Start::Node(node) => (node, u32::MAX),
            Start::Middle(street) => (u32::MAX, street),
        }
    }

    /// Whether a segment does not touch the start.
    fn is_other(&self, near: &Near) -> bool {
        let (from, beginning) = self.touched();
        all([near.from != from, near.to != from, near.index != beginning])
    }

    /// The first street that the segment would cross, of some that it may.
    fn first_street_met(&self, met: &[Near], wanted: Point2) -> Arrival {
        let course = Course::new(self.start, wanted);
        let mut first = (f64::INFINITY, u32::MAX);
        for near in met.iter().filter(|near| self.is_other(near)) {
            if let Some(share) = course.crossing(near.a, near.b)
                && (share, near.index) < first
            {
                first = (share, near.index);
            }
        }
        self.on_street(first.1, self.start + (wanted - self.start) * first.0)
    }

    /// The street nearest to the wanted end within the snap distance.
    fn street_near(&self, wanted: Point2) -> Option<Arrival> {
        let bounds = Bounds::around(wanted, wanted, self.measures.snap);
        let mut best = (self.measures.snap * self.measures.snap, u32::MAX, wanted);
        let may_be = |near: &&Near| self.is_other(near) & bounds.touches(near.a, near.b);
        for near in self.near.iter().filter(may_be) {
            let on = nearest(near.a, near.b, wanted);
            let distance = (on - wanted).norm_squared();
            if (distance, near.index) < (best.0, best.1) {
                best = (distance, near.index, on);
            }
        }
        (best.1 != u32::MAX).then(|| self.on_street(best.1, best.2))
    }

    /// Arrives at a point of a street, or at the end of the street if that is too near for a junction of its own.
    fn on_street(&self, index: u32, point: Point2) -> Arrival {
        let segment = self.fabric.segment(index);
        let (to_start, to_end) = ((segment.a - point).norm(), (segment.b - point).norm());
        if to_start.min(to_end) >= self.measures.least_length && !self.fabric.is_wall(index) {
            Arrival::Interior(index, point)
        } else if to_start <= to_end {
            Arrival::Node(segment.from)
        } else {
            Arrival::Node(segment.to)
        }
    }

    /// Intersection validation at both ends: length, angles, number of streets.
    fn turns_well(&self, arrival: Arrival, end: Point2) -> bool {
        let length = (end - self.start).norm();
        if !(self.measures.least_length..=self.measures.most_length).contains(&length) {
            return false;
        }
        let along = (end - self.start) / length;
        self.stays_inside(arrival, along)
            && self.angles_allow(&self.ways, along)
            && self.arrival_allows(arrival, -along)
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
    fn is_empty_beside(&self, end: Point2, emptiness: f64) -> bool {
        if emptiness <= 0.0 {
            return true;
        }
        let middle = nalgebra::center(&self.start, &end);
        let along = (end - self.start).normalize();
        let across = Vector2::new(-along.y, along.x) * emptiness;
        let (left, right) = (middle + across, middle - across);
        let course = Course::new(right, left);
        // What is at hand first: most that fail, fail by it.
        self.near.iter().all(|near| !course.crosses(near.a, near.b))
            && self.fabric.all_along(right, left, |a, b| !course.crosses(a, b))
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
                    && self.angles_allow(&self.fabric.ways(node), arriving)
            }
            Arrival::Interior(index, _) => self.angles_allow(&self.fabric.ways_along(index), arriving),
        }
    }

    fn angles_allow(&self, present: &Ways, new: Vector2) -> bool {
        all_turn_from(present, new, self.measures.cos_least_angle)
    }

    /// Whether the segment keeps its distance from all streets that it does not join, and from all their ends.
    fn is_clear(&self, arrival: Arrival, end: Point2) -> bool {
        let course = Course::new(self.start, end);
        let clearance = self.measures.clearance * self.measures.clearance;
        let keeps_away = |point: Point2| course.distance_squared(point) >= clearance;
        let bounds = Bounds::around(self.start, end, self.measures.clearance);
        self.near.iter().filter(|near| bounds.touches(near.a, near.b)).all(|near| {
            let joined_at = |node: u32| Start::Node(node) == self.from || arrival == Arrival::Node(node);
            let is_split = matches!(arrival, Arrival::Interior(split, _) if split == near.index);
            if is_split || self.from == Start::Middle(near.index) {
                return keeps_away(near.a) && keeps_away(near.b);
            }
            match (joined_at(near.from), joined_at(near.to)) {
                // Two streets of one junction part by the angle rule; the far end must still keep away.
                (true, true) => true,
                (true, false) => keeps_away(near.b),
                (false, true) => keeps_away(near.a),
                (false, false) => course.keeps_from(near.a, near.b, clearance),
            }
        })
    }
}
