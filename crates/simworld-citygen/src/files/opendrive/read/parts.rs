//! Parts of a road that have the same lanes all along: sections of lanes that are alike, and short ones with a neighbour.

use roxmltree::Node;
use simworld_core::geometry::Point2;
use simworld_core::net::{CrossSection, polyline};

use super::{lanes, section};

/// What is shorter goes with its longer neighbour, m: lanes that open or close beside others, gaps in what is driven on.
const SHORT: f64 = 30.0;

/// A part of a road.
#[derive(Clone, Debug)]
pub(super) struct Part {
    /// Where it begins and ends along the road, m.
    pub(super) from: f64,
    pub(super) to: f64,
    /// The cross-section of the middle of its longest section of lanes.
    pub(super) section: CrossSection,
    longest: f64,
    /// The section of lanes and the number of the lane of each strip, at its beginning and end.
    pub(super) lanes: [(u32, Vec<i32>); 2],
    /// Whether it goes on from the part before.
    pub(super) follows: bool,
}

impl Part {
    fn length(&self) -> f64 {
        self.to - self.from
    }

    /// Takes in the part that follows. What is unlike goes with the longer one, over whose lanes the others lead on.
    fn join(&mut self, next: Self) {
        let is_longer = if self.is_like(&next) {
            self.lanes[1] = next.lanes[1].clone();
            next.longest > self.longest
        } else {
            let is_longer = next.length() > self.length();
            if is_longer {
                self.lanes = next.lanes;
            }
            is_longer
        };
        if is_longer {
            (self.section, self.longest) = (next.section, next.longest);
        }
        self.to = next.to;
    }

    fn is_like(&self, other: &Self) -> bool {
        section::has_same_lanes(&self.section, &other.section)
    }
}

/// The parts of a road of some length, m, in order; none if it is nowhere driven on.
pub(super) fn of(lanes: Node<'_, '_>, length: f64, keeps_left: bool) -> Vec<Part> {
    let sections = lanes::sections(lanes);
    let mut parts: Vec<Part> = Vec::new();
    let mut follows = false;
    for (index, (start, section)) in sections.iter().enumerate() {
        let from = if index == 0 { 0.0 } else { start.clamp(0.0, length) };
        let to = sections.get(index + 1).map_or(length, |(next, _)| next.clamp(from, length));
        // A road without a length has the cross-section of its only place.
        if to <= from && length > 0.0 {
            continue;
        }
        let Some((section, lanes)) = section::at(lanes, (*start, *section), (from + to) * 0.5, keeps_left)
        else {
            match parts.last_mut().filter(|_| to - from < SHORT) {
                Some(before) => before.to = to,
                None => follows = false,
            }
            continue;
        };
        let lanes = [(index as u32, lanes.clone()), (index as u32, lanes)];
        let part = Part { from, to, section, longest: to - from, lanes, follows };
        add(&mut parts, part);
        follows = true;
    }
    // What lies alone between gaps needs a course.
    if length > 0.0 {
        parts.retain(|part| part.length() > 0.1);
    }
    parts
}

/// Adds a part to those before, as one of its own or to the last one.
fn add(parts: &mut Vec<Part>, mut part: Part) {
    while let Some(last) = parts.last_mut().filter(|_| part.follows) {
        let is_short = last.length().min(part.length()) < SHORT;
        if !is_short && !last.is_like(&part) {
            break;
        }
        last.join(part);
        // What was short before may be like the one before it now.
        let Some(joined) = parts.pop() else { return };
        part = joined;
    }
    parts.push(part);
}

/// How long the course of a road is beside the length that it is said to have: points lie on the curve, and chords between
/// them are a little shorter.
pub(super) fn scale(line: &[Point2], length: f64) -> f64 {
    if length > 0.0 { polyline::length(line) / length } else { 1.0 }
}

/// The course of a part: what lies between two places along a road of some length, m.
pub(super) fn slice(line: &[Point2], length: f64, (from, to): (f64, f64)) -> Vec<Point2> {
    if from <= 0.0 && to >= length {
        return line.to_vec();
    }
    let scale = scale(line, length);
    polyline::slice(line, from * scale, to * scale)
}
