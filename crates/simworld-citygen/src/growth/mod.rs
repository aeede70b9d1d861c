//! Streets by growth: a priority queue of street ends that balances depth against breadth.
//!
//! Each end popped from the queue proposes one segment. The proposal is attached to what it nearly meets, cut where
//! it meets a street, and checked against every rule of a junction; what passes becomes a street and proposes its own
//! continuation and branches (after Parish and Müller 2001, in the queue form of the paper's predecessor). The network is connected because every
//! segment begins at a junction that exists.

mod fabric;
mod proposal;

use std::collections::BinaryHeap;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

use simworld_core::geometry::{Point2, Vector2, heading};
use simworld_core::net::{CrossSection, RoadClass, Street, StreetPlan};
use simworld_core::seed::{Seed, StreamRng};

use crate::RoadConfig;
use fabric::Fabric;
use proposal::{Proposal, fit};

/// Attempts to revive growth for each segment asked for, when no end is left in the queue.
const REVIVALS: u32 = 40;

/// An end that waits to grow; the one with the least cost goes first.
#[derive(Clone, Copy, Debug)]
struct End {
    cost: f64,
    /// The cost without what its place adds: what its children inherit.
    steps: f64,
    /// Order of insertion: settles equal costs.
    serial: u64,
    proposal: Proposal,
}

impl PartialEq for End {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for End {}

impl PartialOrd for End {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for End {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        other.cost.total_cmp(&self.cost).then(other.serial.cmp(&self.serial))
    }
}

/// Grows streets from the origin; the configuration is taken as valid.
///
/// It always ends: when the queue runs dry it is revived from existing junctions, a bounded number of times.
pub fn grow(config: &RoadConfig, seed: Seed) -> StreetPlan {
    let mut growth = Growth {
        config,
        fabric: Fabric::new(config),
        queue: BinaryHeap::new(),
        serial: 0,
        rng: seed.stream("citygen/roads").rng(),
    };
    growth.plant();
    growth.run();
    growth.attach_loose_ends();
    growth.plan(seed)
}

struct Growth<'a> {
    config: &'a RoadConfig,
    fabric: Fabric,
    queue: BinaryHeap<End>,
    serial: u64,
    rng: StreamRng,
}

impl Growth<'_> {
    /// Two arterials in opposite directions from the origin.
    fn plant(&mut self) {
        let origin = self.fabric.add_node(Point2::origin());
        let first = self.rng.uniform(0.0, TAU);
        for heading in [first, first + PI] {
            self.push(0.0, origin, heading, RoadClass::Arterial);
        }
    }

    fn run(&mut self) {
        let mut revivals = self.config.count.saturating_mul(REVIVALS);
        while self.fabric.segment_count() < self.config.count as usize {
            let Some(end) = self.queue.pop() else {
                if revivals == 0 {
                    break;
                }
                revivals -= 1;
                self.revive();
                continue;
            };
            if let Some(fitted) = fit(&self.fabric, &end.proposal, self.config) {
                let arrived_new = fitted.is_new();
                let node = self.fabric.build(&fitted);
                if arrived_new {
                    self.branch(end.steps, node, &end.proposal);
                }
            }
        }
    }

    /// Proposes the ways on from a new junction: straight, left and right.
    fn branch(&mut self, steps: f64, node: usize, from: &Proposal) {
        let arterial = from.class == RoadClass::Arterial;
        if self.rng.chance(self.config.continuation) {
            let bend = self.rng.normal_clamped(0.0, self.config.heading_variation, -0.6, 0.6);
            // Depth runs ahead: a continuation costs less than a branch.
            let step = if arterial { 0.6 } else { 1.0 };
            self.push(steps + step / (1.0 + self.config.depth_bias), node, from.heading + bend, from.class);
        }
        for side in [FRAC_PI_2, -FRAC_PI_2] {
            if self.rng.chance(self.config.branching) {
                let bend = self.rng.normal_clamped(0.0, self.config.heading_variation, -0.4, 0.4);
                let class =
                    if arterial && self.rng.chance(0.2) { RoadClass::Arterial } else { RoadClass::Local };
                let cost = self.rng.uniform(0.7, 1.2);
                self.push(steps + cost, node, from.heading + side + bend, class);
            }
        }
    }

    /// Proposes a segment from a random junction into one of its gaps.
    fn revive(&mut self) {
        let node = self.rng.below(self.fabric.node_count());
        let heading = match self.fabric.headings(node).next() {
            Some(present) => {
                let quarter = self.rng.below(4) as f64 * FRAC_PI_2;
                present + quarter + self.rng.normal_clamped(0.0, 0.3, -0.6, 0.6)
            }
            None => self.rng.uniform(0.0, TAU),
        };
        self.push(0.0, node, heading, RoadClass::Local);
    }

    fn push(&mut self, steps: f64, from: usize, heading: f64, class: RoadClass) {
        let variation = self.config.length_variation;
        let length = self.config.length * self.rng.uniform(1.0 - variation, 1.0 + variation);
        self.serial += 1;
        let proposal = Proposal { from, heading, length, class };
        // People live densest in the middle: what is far out waits, so that blocks close before the city spreads.
        let remoteness = self.fabric.node(from).coords.norm() / self.config.length;
        let cost = steps + self.config.compactness * remoteness;
        self.queue.push(End { cost, steps, serial: self.serial, proposal });
    }

    /// Road-end attachment: a dead end that looks at a junction not too far away is joined to it.
    fn attach_loose_ends(&mut self) {
        let reach = self.config.length * 1.4;
        for node in 0..self.fabric.node_count() {
            if self.fabric.degree(node) != 1 {
                continue;
            }
            let Some(only) = self.fabric.headings(node).next() else { continue };
            let ahead = only + PI;
            let here = self.fabric.node(node);
            let mut targets = self.fabric.nodes_near(here, reach);
            targets.retain(|target| *target != node);
            targets.sort_by(|a, b| {
                let distance = |n: &usize| (self.fabric.node(*n) - here).norm_squared();
                distance(a).total_cmp(&distance(b)).then(a.cmp(b))
            });
            for target in targets.into_iter().take(6) {
                let towards: Vector2 = self.fabric.node(target) - here;
                let heading = heading(&towards);
                if simworld_core::ops::wrap_angle(heading - ahead).abs() > 1.3 {
                    continue;
                }
                let proposal =
                    Proposal { from: node, heading, length: towards.norm(), class: RoadClass::Local };
                if let Some(fitted) = fit(&self.fabric, &proposal, self.config).filter(|f| f.reaches(target))
                {
                    self.fabric.build(&fitted);
                    break;
                }
            }
        }
    }

    /// The grown streets as a plan, some of them bent between their ends.
    fn plan(&self, seed: Seed) -> StreetPlan {
        let bends = seed.stream("citygen/bends");
        let nodes: Vec<Point2> = (0..self.fabric.node_count()).map(|node| self.fabric.node(node)).collect();
        let mut plan = StreetPlan { sections: vec![self.section(1)], ..StreetPlan::default() };
        let arterial = plan.add_section(self.section(self.config.arterial_lanes));
        let street = |(index, segment): (usize, &fabric::Segment)| {
            let section = if segment.class == RoadClass::Arterial { arterial } else { 0 };
            let mut rng = bends.indexed(index as u64).rng();
            let (from, to) = (nodes[segment.from], nodes[segment.to]);
            Street {
                via: if rng.chance(self.config.bends) { bend(from, to, &mut rng) } else { Vec::new() },
                class: segment.class,
                section,
                ..Street::simple(segment.from, segment.to)
            }
        };
        plan.streets = self.fabric.segments().iter().enumerate().map(street).collect();
        plan.nodes = nodes;
        plan
    }

    fn section(&self, lanes: u8) -> CrossSection {
        CrossSection::plain(lanes, lanes, self.config.lane_width, self.config.sidewalk_width)
    }
}

/// Points of a shallow bow between two ends; its ends keep their direction almost, so that junctions stay as checked.
fn bend(from: Point2, to: Point2, rng: &mut StreamRng) -> Vec<Point2> {
    let along = to - from;
    let length = along.norm();
    if length < 90.0 {
        return Vec::new();
    }
    let normal = Vector2::new(-along.y, along.x) / length;
    let height = rng.normal_clamped(0.0, 0.015, -0.03, 0.03) * length;
    [0.35, 0.5, 0.65]
        .map(|share: f64| {
            let bow = 1.0 - (2.0 * share - 1.0) * (2.0 * share - 1.0);
            from + along * share + normal * (height * bow)
        })
        .to_vec()
}
