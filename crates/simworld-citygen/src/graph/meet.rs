//! Where the course of a new street meets those that exist.

use simworld_core::geometry::{Point2, Vector2};
use simworld_core::net::{Street, polyline};

use super::edit::{Edit, LEAST_PIECE};
use super::{GraphError, StreetGraph};

/// What is nearer than this is joined, m.
const JOIN: f64 = 1.0;

/// What a course joins.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
enum Target {
    /// A node.
    Node(u32),
    /// A street, at a station of its course.
    Street(u32, f64),
    /// Open land.
    Open,
}

/// A place of a course where it joins something.
#[derive(Clone, Copy, Debug)]
struct Meeting {
    station: f64,
    at: Point2,
    target: Target,
}

impl StreetGraph {
    /// What lies within [`JOIN`] of a point: the nearest node, or else the nearest of some streets.
    fn target_near(&self, point: Point2, is_meant: impl Fn(&Street) -> bool) -> (Target, Point2) {
        let mut node: Option<(f64, u32)> = None;
        let mut street: Option<(f64, u32, f64, Point2)> = None;
        let mut consider = |number: u32| {
            let Some(present) = &self.streets[number as usize] else { return };
            for end in [present.from, present.to] {
                let distance = (self.nodes[end].at - point).norm();
                if distance <= JOIN && node.is_none_or(|best| (distance, end as u32) < best) {
                    node = Some((distance, end as u32));
                }
            }
            let course = self.course(super::HalfEdge(2 * number));
            if let Some(closest) = polyline::closest(&course, &point)
                && is_meant(present)
                && closest.distance <= JOIN
                && street.is_none_or(|best| (closest.distance, number) < (best.0, best.1))
            {
                let at = polyline::at(&course, closest.station).0;
                street = Some((closest.distance, number, closest.station, at));
            }
        };
        // No cell is smaller than the distance, so three lines through the box about the point pass through all its cells.
        for row in [-JOIN, 0.0, JOIN] {
            let middle = point + Vector2::new(0.0, row);
            let across = Vector2::new(JOIN, 0.0);
            self.grid.visit(middle - across, middle + across, |number, _| consider(number));
        }
        match (node, street) {
            (Some((_, number)), _) => (Target::Node(number), self.nodes[number as usize].at),
            (None, Some((_, number, station, at))) => (Target::Street(number, station), at),
            (None, None) => (Target::Open, point),
        }
    }

    /// All places where a course of a level joins something, in its order, its two ends among them.
    fn meetings(&self, course: &[Point2], level: i8) -> Vec<Meeting> {
        let length = polyline::length(course);
        let is_level = |street: &Street| street.level == level;
        let mut found = Vec::new();
        for (station, point) in [(0.0, course[0]), (length, course[course.len() - 1])] {
            let (target, at) = match self.target_near(point, is_level) {
                // An end comes down to whatever street there is.
                (Target::Open, _) => self.target_near(point, |_| true),
                found => found,
            };
            found.push(Meeting { station, at, target });
        }
        let mut before = 0.0;
        for pair in course.windows(2) {
            let span = (pair[1] - pair[0]).norm();
            self.grid.visit(pair[0], pair[1], |number, part| {
                let present = self.streets[number as usize].as_ref();
                let Some(present) = present.filter(|present| is_level(present)) else { return };
                let [c, d] = self.piece(number, present, part).ends;
                if let Some((share, _)) = polyline::crossing(pair[0], pair[1], c, d) {
                    let (target, at) = self.target_near(pair[0] + (pair[1] - pair[0]) * share, is_level);
                    found.push(Meeting { station: before + share * span, at, target });
                }
            });
            before += span;
        }
        found.sort_by(|a, b| {
            a.station
                .total_cmp(&b.station)
                .then_with(|| a.target.partial_cmp(&b.target).unwrap_or(std::cmp::Ordering::Equal))
        });
        // Of meetings at one place the end of the course stays, or else the first; a node is never met twice.
        found.dedup_by(|later, kept| {
            let one = later.station - kept.station <= JOIN
                || (later.target == kept.target && later.target != Target::Open);
            if one && later.station >= length {
                kept.station = later.station;
            }
            one
        });
        found
    }
}

impl Edit<'_> {
    /// Cuts the streets that a course meets and builds its parts between the meetings.
    pub(super) fn build_along(&mut self, course: &[Point2], like: &Street) -> Result<(), GraphError> {
        let meetings = self.graph.meetings(course, like.level);
        // The farthest cut of a street first: what is left of it keeps its number.
        let mut cuts: Vec<(u32, f64, usize)> = Vec::new();
        let mut nodes = vec![0; meetings.len()];
        for (index, meeting) in meetings.iter().enumerate() {
            match meeting.target {
                Target::Node(node) => nodes[index] = node,
                Target::Street(street, station) => cuts.push((street, station, index)),
                Target::Open => nodes[index] = self.add_node(meeting.at),
            }
        }
        cuts.sort_by(|a, b| a.0.cmp(&b.0).then(b.1.total_cmp(&a.1)));
        for (street, station, index) in cuts {
            nodes[index] = self.cut(street, station, meetings[index].at)?;
        }
        for (pair, ends) in meetings.windows(2).zip(nodes.windows(2)) {
            let via = points_between(course, pair[0].station, pair[1].station);
            self.put_in(Street { from: ends[0] as usize, to: ends[1] as usize, via, ..like.clone() }, None)?;
        }
        if meetings.len() < 2 {
            return Err(GraphError::Course { points: course.len() });
        }
        Ok(())
    }
}

/// The points of a course strictly between two stations.
fn points_between(course: &[Point2], from: f64, to: f64) -> Vec<Point2> {
    let mut station = 0.0;
    let mut found = Vec::new();
    for pair in course.windows(2) {
        station += (pair[1] - pair[0]).norm();
        if from + LEAST_PIECE < station && station < to - LEAST_PIECE {
            found.push(pair[1]);
        }
    }
    found
}
