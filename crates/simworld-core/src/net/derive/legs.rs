//! The legs of a junction: where each street leaves it, how wide it is there, and how far the junction reaches into it.

use std::f64::consts::{PI, TAU};
use std::ops::Index;

use super::workers::{self, PART, Workers};
use super::{NetworkConfig, StreetPlan, hammerhead, kerbs};
use crate::geometry::{Point2, Vector2, direction, heading};
use crate::lists::Lists;
use crate::net::{CrossSection, RoadClass, polyline};

/// Gap between the stop line and the crossing, m.
const STOP_GAP: f64 = 1.0;
/// How far a junction reaches into a leg where nothing asks for more, m.
const LEAST_REACH: f64 = 2.0;
/// Room to turn round at a dead end without a turning circle, m.
const DEAD_END_REACH: f64 = 5.0;
/// Corners more acute than this are rounded only as far as the junction reaches anyway, radians.
const SHARPEST: f64 = 0.8;
/// The lane that must remain of a street between its two junctions, m.
const LEAST_LANE: f64 = 4.0;

/// One street as it leaves one of its two nodes.
#[derive(Clone, Debug)]
pub(super) struct Leg {
    pub(super) street: usize,
    /// Whether the street's centreline begins here.
    pub(super) at_start: bool,
    /// Direction in which it leaves, radians, and the same as a vector.
    pub(super) heading: f64,
    ahead: Vector2,
    /// Carriageway to the left of the centreline, seen leaving, m.
    pub(super) left: f64,
    /// Carriageway to the right, m.
    pub(super) right: f64,
    /// Width of all that lies beyond the left kerb, m.
    pub(super) left_walk: f64,
    /// Width of all that lies beyond the right kerb, m.
    pub(super) right_walk: f64,
    /// How far the paved junction reaches into the leg, m.
    pub(super) reach: f64,
    /// Where lanes end and begin, m from the node.
    pub(super) stop: f64,
    /// Where sidewalks end, m from the node; the middle of the crossing if there is one.
    pub(super) walk: f64,
    /// Radius of the kerb where it turns into another street of its class, m.
    pub(super) rounding: f64,
    /// How far the junction reaches beyond `reach` if there is room, for the rounding, m.
    pub(super) wanted: f64,
    /// Radius of the turning circle at a dead end, m; 0 without one.
    pub(super) turning: f64,
    /// Whether a dead end has a hammerhead.
    pub(super) hammerhead: bool,
    /// The centre of the junction.
    pub(super) node: Point2,
}

/// Radius of the kerb at a corner, m: 10 to 15 feet in streets, more where lorries turn at speed (NACTO Urban Street
/// Design Guide 2013, "Corner radii").
const fn rounding(class: RoadClass) -> f64 {
    match class {
        RoadClass::Local => 3.0,
        RoadClass::Arterial => 4.5,
        RoadClass::Highway => 6.0,
    }
}

impl Leg {
    /// The end of a street, which the junction does not reach into yet; by the widths of all cross-sections.
    fn of(plan: &StreetPlan, (index, at_start): End, widths: &[[(f64, f64); 2]]) -> Self {
        let street = &plan.streets[index];
        let [mut left, mut right] = widths[street.section as usize];
        let [mut node, mut towards] = [plan.nodes[street.from], plan.nodes[street.to]];
        let mut next = street.via.first();
        if !at_start {
            (left, right, node, towards) = (right, left, towards, node);
            next = street.via.last();
        }
        let heading = heading(&(next.copied().unwrap_or(towards) - node));
        Self {
            street: index,
            at_start,
            heading,
            ahead: direction(heading),
            left: left.0,
            right: right.0,
            left_walk: left.1,
            right_walk: right.1,
            reach: 0.0,
            stop: 0.0,
            walk: 0.0,
            rounding: rounding(street.class),
            wanted: 0.0,
            turning: street.turning[usize::from(!at_start)],
            hammerhead: street.hammerhead[usize::from(!at_start)],
            node,
        }
    }

    /// Goes over to what the junction takes of a street with so much room for its ends, m, of which so much is asked.
    fn fit(&mut self, room: f64, asked: Asked) {
        if asked.stop <= room {
            let more = self.wanted * ((room - asked.stop) / asked.wanted.max(1e-9)).min(1.0);
            self.reach += more;
            self.stop += more;
            self.walk += more;
            return;
        }
        let scale = (room / asked.reach).min(1.0);
        let beyond = ((room - asked.reach) / (asked.stop - asked.reach).max(1e-9)).clamp(0.0, 1.0);
        let (own, walk, stop) = (self.reach, self.walk - self.reach, self.stop - self.reach);
        if scale < 1.0 {
            (self.turning, self.hammerhead) = (0.0, false);
        }
        self.reach = own * scale;
        self.stop = self.reach + stop * beyond;
        // At a dead end sidewalks go on to the end.
        self.walk = (self.reach + walk * if walk < 0.0 { scale } else { beyond }).max(0.0);
    }

    pub(super) fn direction(&self) -> Vector2 {
        self.ahead
    }

    /// The point `along` m out and `left` m to the left of the centreline, taken as straight near the junction.
    pub(super) fn point(&self, along: f64, left: f64) -> Point2 {
        let ahead = self.ahead;
        self.node + ahead * along + Vector2::new(-ahead.y, ahead.x) * left
    }
}

/// The legs of every node, counter-clockwise by heading; those of one node after those of another.
pub(super) struct Legs {
    /// Those of the nodes of each part of the work.
    parts: Vec<Vec<Leg>>,
    /// Where those of each node begin among all of them, and where the last ones end.
    starts: Vec<u32>,
}

impl Legs {
    /// How many nodes there are.
    pub(super) fn nodes(&self) -> usize {
        self.starts.len() - 1
    }

    /// Those of all nodes.
    pub(super) fn all(&self) -> impl Iterator<Item = &Leg> {
        self.parts.iter().flatten()
    }

    /// Those of each node.
    pub(super) fn by_node(&self) -> impl Iterator<Item = &[Leg]> {
        (0..self.nodes()).map(|node| &self[node])
    }
}

impl Index<usize> for Legs {
    type Output = [Leg];

    /// Those of a node.
    fn index(&self, node: usize) -> &[Leg] {
        let [before, from, to] = [node - node % PART, node, node + 1].map(|node| self.starts[node] as usize);
        &self.parts[node / PART][from - before..to - before]
    }
}

/// The end of a street: which street it is, and whether it begins there.
type End = (usize, bool);

/// The ends of all streets by their nodes.
fn ends_by_node(plan: &StreetPlan) -> Lists<End> {
    let ends = plan.streets.iter().enumerate();
    let ends = ends.flat_map(|(index, street)| [(street.from, (index, true)), (street.to, (index, false))]);
    Lists::of(plan.nodes.len(), ends)
}

/// The legs of a plan.
pub(super) fn of_plan(plan: &StreetPlan, config: &NetworkConfig, workers: &dyn Workers) -> Legs {
    let widths: Vec<[(f64, f64); 2]> = plan.sections.iter().map(widths).collect();
    let lengths = workers::each(workers, plan.streets.len(), |street| plan.length_of(&plan.streets[street]));
    let ends = ends_by_node(plan);
    let nodes = plan.nodes.len();
    let parts = workers::collect(workers, nodes.div_ceil(PART), |part| {
        let (from, to) = (part * PART, nodes.min((part + 1) * PART));
        let mut legs = Vec::with_capacity(ends.run(from..=to - 1).len());
        for node in from..to {
            let first = legs.len();
            legs.extend(ends[node].iter().map(|end| Leg::of(plan, *end, &widths)));
            let legs = &mut legs[first..];
            legs.sort_unstable_by(|a, b| a.heading.total_cmp(&b.heading).then(a.street.cmp(&b.street)));
            set_reaches(legs, config);
            fit_dead_end(legs, &lengths);
        }
        legs
    });
    let mut legs = Legs { parts, starts: ends.into_starts() };
    fit_into_streets(&mut legs, &lengths, workers);
    legs
}

/// The width of the carriageway, and of what lies beyond its kerb, to the left and to the right of the centreline, m.
fn widths(section: &CrossSection) -> [(f64, f64); 2] {
    let (left, right) = section.kerbs();
    [(left, section.left_of_reference() - left), (right, section.right_of_reference() - right)]
}

/// The corner between a leg and the next one.
#[derive(Clone, Copy)]
struct Corner {
    /// The angle by which one turns left from the one to the other, in (0, 2π].
    angle: f64,
    sin: f64,
    cos: f64,
}

impl Corner {
    fn between(leg: &Leg, next: &Leg) -> Self {
        let angle = (next.heading - leg.heading).rem_euclid(TAU);
        let angle = if angle == 0.0 { TAU } else { angle };
        let (sin, cos) = crate::ops::sin_cos(angle);
        Self { angle, sin, cos }
    }

    /// How far out the rounding of a corner between two kerbs begins, m; nothing where they diverge or the corner is so
    /// acute that it would begin far away.
    fn rounded_reach(&self, own: f64, other: f64, radius: f64) -> f64 {
        if !(SHARPEST..PI - 0.05).contains(&self.angle) {
            return 0.0;
        }
        self.edge_meeting(own, other) + radius * (1.0 + self.cos) / self.sin
    }

    /// How far out two neighbouring edges meet, measured along the leg with half width `own`; zero where they diverge.
    ///
    /// Edges of different width that are nearly one line would meet tens of metres away, where the streets may long have
    /// turned; the one goes over into the other within the larger of the two widths instead.
    fn edge_meeting(&self, own: f64, other: f64) -> f64 {
        if self.angle >= PI - 0.05 {
            return 0.0;
        }
        let met = ((other + own * self.cos) / self.sin).max(0.0);
        if self.cos < 0.0 { met.min(own.max(other)) } else { met }
    }
}

fn set_reaches(legs: &mut [Leg], config: &NetworkConfig) {
    let count = legs.len();
    let corner = |index: usize, legs: &[Leg]| Corner::between(&legs[index], &legs[(index + 1) % count]);
    // What comes before the first one lies between the last one and the first.
    let Some(last) = count.checked_sub(1).map(|last| corner(last, legs)) else { return };
    let mut before_it = last;
    for index in 0..count {
        let (before, after) = (&legs[(index + count - 1) % count], &legs[(index + 1) % count]);
        let leg = &legs[index];
        let corners = (if index + 1 == count { last } else { corner(index, legs) }, before_it);
        before_it = corners.0;
        let (left, right) = (leg.left + leg.left_walk, leg.right + leg.right_walk);
        let on_left = corners.0.edge_meeting(left, after.right + after.right_walk);
        let on_right = corners.1.edge_meeting(right, before.left + before.left_walk);
        let reach = if count == 1 { DEAD_END_REACH } else { LEAST_REACH.max(on_left).max(on_right) };
        let rounded = (corners.0.rounded_reach(leg.left, after.right, leg.rounding.min(after.rounding)))
            .max(corners.1.rounded_reach(leg.right, before.left, leg.rounding.min(before.rounding)));
        let leg = &mut legs[index];
        leg.reach = reach;
        leg.wanted = if count == 1 { 0.0 } else { (rounded - reach).max(0.0) };
        (leg.stop, leg.walk) = match count {
            1 => (reach, 0.0),
            2 => (reach, reach),
            _ => (reach + config.crossing_width + STOP_GAP, reach + config.crossing_width * 0.5),
        };
        let circle = kerbs::bulb_reach(leg).filter(|_| count == 1);
        if circle.is_none() {
            leg.turning = 0.0;
        }
        leg.hammerhead &= count == 1 && circle.is_none();
        if let Some(reach) = circle.or(leg.hammerhead.then_some(hammerhead::REACH)) {
            (leg.reach, leg.stop, leg.walk) = (reach, reach, reach);
        }
    }
}

/// Takes the room to turn from a dead end whose street is not much longer than that.
fn fit_dead_end(legs: &mut [Leg], lengths: &[f64]) {
    let [leg] = legs else { return };
    let has_room = leg.turning > 0.0 || leg.hammerhead;
    if has_room && lengths[leg.street] < 2.0 * leg.reach + LEAST_LANE {
        (leg.turning, leg.hammerhead) = (0.0, false);
        (leg.reach, leg.stop, leg.walk) = (DEAD_END_REACH, DEAD_END_REACH, 0.0);
    }
}

/// What both ends of a street ask of it together, m.
#[derive(Clone, Copy, Default)]
struct Asked {
    reach: f64,
    stop: f64,
    wanted: f64,
}

/// Shortens what both ends take of a street that is too short for it: first roundings, then the room for crossings and stop
/// lines, then the reaches, for an area cut short of where kerbs meet would fold over itself.
fn fit_into_streets(legs: &mut Legs, lengths: &[f64], workers: &dyn Workers) {
    let mut asked = vec![Asked::default(); lengths.len()];
    for leg in legs.all() {
        let asked = &mut asked[leg.street];
        asked.reach += leg.reach;
        asked.stop += leg.stop;
        asked.wanted += leg.wanted;
    }
    workers::hand_out(workers, legs.parts.iter_mut(), |part| {
        for leg in part {
            leg.fit(lengths[leg.street] - LEAST_LANE, asked[leg.street]);
        }
    });
}

/// Where the left kerb of `leg` meets the right kerb of the next one, each moved outwards by its margin, m; `None`
/// where the two run nearly parallel or meet far away.
pub(super) fn corner(leg: &Leg, next: &Leg, margins: (f64, f64)) -> Option<Point2> {
    let met = polyline::meet(
        leg.point(0.0, leg.left + margins.0),
        leg.direction(),
        next.point(0.0, -next.right - margins.1),
        next.direction(),
    )?;
    let farthest = leg.reach.max(next.reach) + leg.left + next.right + margins.0.max(margins.1);
    ((met - leg.node).norm() <= farthest).then_some(met)
}
