//! A proposed segment, and the rules by which it is attached, cut or refused.

use simworld_core::geometry::{Point2, direction, heading};
use simworld_core::net::{RoadClass, polyline};
use simworld_core::ops::wrap_angle;

use super::fabric::Fabric;
use crate::RoadConfig;

/// More streets than this do not meet at one junction.
const MOST_STREETS: usize = 4;
/// Nothing shorter than this share of the mean length is built.
const LEAST_SHARE: f64 = 0.5;
/// Streets that do not meet keep this share of the mean length apart.
const CLEARANCE_SHARE: f64 = 0.36;

/// A segment that an end would like to build.
#[derive(Clone, Copy, Debug)]
pub(super) struct Proposal {
    pub(super) from: usize,
    pub(super) heading: f64,
    pub(super) length: f64,
    pub(super) class: RoadClass,
}

/// Where a segment arrives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Arrival {
    /// In the open.
    New(Point2),
    /// At a junction.
    Node(usize),
    /// On a street, which is split there.
    Interior(usize, Point2),
}

/// A proposal that may be built.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fitted {
    pub(super) from: usize,
    pub(super) class: RoadClass,
    pub(super) arrival: Arrival,
}

impl Fitted {
    pub(super) fn is_new(&self) -> bool {
        matches!(self.arrival, Arrival::New(_))
    }

    pub(super) fn reaches(&self, node: usize) -> bool {
        self.arrival == Arrival::Node(node)
    }
}

/// Attaches a proposal to what it meets, or refuses it.
pub(super) fn fit(fabric: &Fabric, proposal: &Proposal, config: &RoadConfig) -> Option<Fitted> {
    let start = fabric.node(proposal.from);
    if fabric.degree(proposal.from) >= MOST_STREETS {
        return None;
    }
    let wanted = start + direction(proposal.heading) * proposal.length;
    let rules = Rules { fabric, config, from: proposal.from, start };
    let arrivals = [
        rules.junction_near(wanted),
        rules.first_street_met(wanted),
        rules.street_near(wanted),
        Some(Arrival::New(wanted)),
    ];
    // The first way to arrive decides: a proposal that nearly meets something joins it or is not built.
    let arrival = arrivals.into_iter().flatten().next()?;
    rules.allow(arrival).then_some(Fitted { from: proposal.from, class: proposal.class, arrival })
}

struct Rules<'a> {
    fabric: &'a Fabric,
    config: &'a RoadConfig,
    from: usize,
    start: Point2,
}

impl Rules<'_> {
    fn least_length(&self) -> f64 {
        self.config.length * LEAST_SHARE
    }

    /// The junction nearest to the wanted end within the snap distance.
    fn junction_near(&self, wanted: Point2) -> Option<Arrival> {
        let distance = |node: &usize| (self.fabric.node(*node) - wanted).norm();
        let near =
            self.fabric.nodes_near(wanted, self.config.snap).into_iter().filter(|node| *node != self.from);
        near.min_by(|a, b| distance(a).total_cmp(&distance(b)).then(a.cmp(b))).map(Arrival::Node)
    }

    /// The first street that the segment would cross.
    fn first_street_met(&self, wanted: Point2) -> Option<Arrival> {
        let mut first: Option<(f64, usize)> = None;
        for index in self.fabric.segments_near(self.start, wanted, 0.0) {
            let segment = self.fabric.segment(index);
            if segment.from == self.from || segment.to == self.from {
                continue;
            }
            let (a, b) = (self.fabric.node(segment.from), self.fabric.node(segment.to));
            if let Some((share, _)) = polyline::crossing(self.start, wanted, a, b)
                && first.is_none_or(|best| (share, index) < best)
            {
                first = Some((share, index));
            }
        }
        first.map(|(share, index)| self.on_street(index, self.start + (wanted - self.start) * share))
    }

    /// The street nearest to the wanted end within the snap distance.
    fn street_near(&self, wanted: Point2) -> Option<Arrival> {
        let mut nearest: Option<(f64, usize, Point2)> = None;
        for index in self.fabric.segments_near(wanted, wanted, self.config.snap) {
            let segment = self.fabric.segment(index);
            if segment.from == self.from || segment.to == self.from {
                continue;
            }
            let ends = [self.fabric.node(segment.from), self.fabric.node(segment.to)];
            let Some(closest) = polyline::closest(&ends, &wanted) else { continue };
            if closest.distance <= self.config.snap && nearest.is_none_or(|best| closest.distance < best.0) {
                nearest = Some((closest.distance, index, polyline::at(&ends, closest.station).0));
            }
        }
        nearest.map(|(_, index, point)| self.on_street(index, point))
    }

    /// Arrives at a point of a street, or at the end of the street if that is too near for a junction of its own.
    fn on_street(&self, index: usize, point: Point2) -> Arrival {
        let segment = self.fabric.segment(index);
        let distance = |node: usize| (self.fabric.node(node) - point).norm();
        let (to_start, to_end) = (distance(segment.from), distance(segment.to));
        if to_start.min(to_end) >= self.least_length() {
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
            Arrival::Node(node) => self.fabric.node(node),
        };
        let along = end - self.start;
        if along.norm() < self.least_length() || along.norm() > self.config.length * 2.0 {
            return false;
        }
        let leaving = heading(&along);
        let arriving = heading(&-along);
        self.angles_allow(self.fabric.headings(self.from), leaving)
            && self.arrival_allows(arrival, arriving)
            && self.is_clear(arrival, end)
    }

    fn arrival_allows(&self, arrival: Arrival, arriving: f64) -> bool {
        match arrival {
            Arrival::New(_) => true,
            Arrival::Node(node) => {
                self.fabric.degree(node) < MOST_STREETS
                    && !self.fabric.are_joined(self.from, node)
                    && self.angles_allow(self.fabric.headings(node), arriving)
            }
            Arrival::Interior(index, point) => {
                let segment = self.fabric.segment(index);
                let ways = [segment.from, segment.to].map(|node| heading(&(self.fabric.node(node) - point)));
                self.angles_allow(ways.into_iter(), arriving)
            }
        }
    }

    fn angles_allow(&self, mut present: impl Iterator<Item = f64>, new: f64) -> bool {
        present.all(|heading| wrap_angle(heading - new).abs() >= self.config.least_angle)
    }

    /// Whether the segment keeps its distance from all streets that it does not join, and from all their ends.
    fn is_clear(&self, arrival: Arrival, end: Point2) -> bool {
        let clearance = self.config.length * CLEARANCE_SHARE;
        let own = [self.start, end];
        self.fabric.segments_near(self.start, end, clearance).into_iter().all(|index| {
            let segment = self.fabric.segment(index);
            let joined_at = |node: usize| node == self.from || arrival == Arrival::Node(node);
            let ends = [self.fabric.node(segment.from), self.fabric.node(segment.to)];
            if let Arrival::Interior(split, _) = arrival
                && split == index
            {
                return ends.iter().all(|point| {
                    polyline::closest(&own, point).is_some_and(|closest| closest.distance >= clearance)
                });
            }
            let shares_an_end = joined_at(segment.from) || joined_at(segment.to);
            if shares_an_end {
                // Two streets of one junction part by the angle rule; the far end must still keep away.
                return [segment.from, segment.to].iter().zip(ends).all(|(node, point)| {
                    joined_at(*node)
                        || polyline::closest(&own, &point)
                            .is_some_and(|closest| closest.distance >= clearance)
                });
            }
            polyline::distance_between(&own, &ends) >= clearance
        })
    }
}
