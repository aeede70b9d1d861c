//! Ways found where the land lets them: least cost over a coarse grid of which no step is steeper than the way may be.
//!
//! Trails keep to 15 %, the most that holds on natural soil without steps (International Mountain Bicycling Association, Trail
//! Solutions, 2004; the target of the US Forest Service for hikers is 3 to 12 %, FSH 2309.18, 23.11). They are found at less, for
//! bends cut off short are a little steeper than what they cut.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};

use simworld_core::geometry::{Point2, Point3, Vector2};
use simworld_core::net::Footpath;

use super::grid::Grid;
use crate::terrain::HeightField;

/// Steepest grade of trails, rise over run.
pub const TRAIL_GRADE: f64 = 0.15;
/// Width of trails, m: two pass one another (the Forest Service's class 3 is 0.6 to 0.9 m, accessible trails 1.5 m).
pub const TRAIL_WIDTH: f64 = 1.5;
/// Side of the squares between which ways are looked for, m.
const STEP: f64 = 10.0;
/// Lowest that a way lies above the water, m.
const BANK: f64 = 0.7;
/// Ways keep so far from the edge of the land, m.
const EDGE: f64 = 12.0;
/// A grade that takes three times as much as level ground.
const EASY: f64 = 0.12;
/// Bends up to this cosine are cut off: 70°, which is all of them but where ways meet.
const SHARP: f64 = 0.34;
/// Between the places at which it is asked whether a way may pass, m.
const ASKED: f64 = 2.5;

/// Steps to sixteen neighbours, by their direction from east, counter-clockwise.
const STEPS: [(i32, i32); 16] = [
    (1, 0),
    (2, 1),
    (1, 1),
    (1, 2),
    (0, 1),
    (-1, 2),
    (-1, 1),
    (-2, 1),
    (-1, 0),
    (-2, -1),
    (-1, -1),
    (-1, -2),
    (0, -1),
    (1, -2),
    (1, -1),
    (2, -1),
];
/// A way turns by at most so many of these directions at once: 67°. Where two legs of a sharper bend lay side by side, their
/// beds would not have room.
const TURN: i32 = 3;

/// Where ways may go on the land as it is.
pub(super) struct Router {
    /// What the step from each node in each direction costs; infinite where none leads.
    costs: Vec<[f64; 16]>,
    side: usize,
    half: f64,
}

impl Router {
    /// Where ways no steeper than `grade` may go: on dry land, and not where `closed` says.
    pub(super) fn new(grid: &Grid, grade: f64, closed: impl Fn(Point2) -> bool) -> Self {
        let half = ((grid.half - EDGE) / STEP).floor() * STEP;
        let side = (2.0 * half / STEP) as usize + 1;
        let mut router = Self { costs: Vec::new(), side, half };
        // Finer than the nodes, so that no step leads through a house between two of them.
        let across = (2.0 * half / ASKED) as usize + 1;
        let point = |index: usize| {
            Point2::new((index % across) as f64 * ASKED - half, (index / across) as f64 * ASKED - half)
        };
        let free: Vec<bool> = (0..across * across)
            .map(|index| grid.height(point(index)) >= BANK && !closed(point(index)))
            .collect();
        let is_free = |at: Point2| {
            let along = |x: f64| ((x + half) / ASKED).round() as usize;
            free[along(at.y) * across + along(at.x)]
        };
        let cost = |node: usize, (dx, dy): (i32, i32)| {
            let (x, y) = ((node % side) as i32 + dx, (node / side) as i32 + dy);
            if !(0..side as i32).contains(&x) || !(0..side as i32).contains(&y) {
                return f64::INFINITY;
            }
            let (from, to) = (router.place(node), router.place(y as usize * side + x as usize));
            let pieces = ((to - from).norm() / ASKED).ceil();
            let is_open =
                (0..=pieces as u32).all(|piece| is_free(from + (to - from) * (f64::from(piece) / pieces)));
            let step = is_open.then(|| step_cost(grid, from, to, grade));
            step.flatten().unwrap_or(f64::INFINITY)
        };
        let costs = (0..side * side).map(|node| STEPS.map(|step| cost(node, step))).collect();
        router.costs = costs;
        router
    }

    /// The node nearest to a place.
    pub(super) fn node(&self, place: Point2) -> usize {
        let along = |x: f64| ((x + self.half) / STEP).round().clamp(0.0, (self.side - 1) as f64) as usize;
        along(place.y) * self.side + along(place.x)
    }

    /// How many nodes there are.
    pub(super) fn count(&self) -> usize {
        self.side * self.side
    }

    /// Where a node is, m.
    pub(super) fn place(&self, node: usize) -> Point2 {
        let (column, row) = (node % self.side, node / self.side);
        Point2::new(column as f64 * STEP - self.half, row as f64 * STEP - self.half)
    }

    /// Which nodes ways from some nodes come to, without sharp bends.
    pub(super) fn reach(&self, from: impl IntoIterator<Item = usize>) -> Vec<bool> {
        let mut seen = vec![false; self.count() * STEPS.len()];
        let mut open: Vec<usize> = Vec::new();
        for state in
            from.into_iter().flat_map(|node| (0..STEPS.len()).map(move |way| node * STEPS.len() + way))
        {
            seen[state] = true;
            open.push(state);
        }
        while let Some(state) = open.pop() {
            let (at, came) = (state / STEPS.len(), (state % STEPS.len()) as i32);
            for turn in -TURN..=TURN {
                let way = (came + turn).rem_euclid(16) as usize;
                let (dx, dy) = STEPS[way];
                if self.costs[at][way].is_finite() {
                    let to = (at as i32 + dy * self.side as i32 + dx) as usize * STEPS.len() + way;
                    if !std::mem::replace(&mut seen[to], true) {
                        open.push(to);
                    }
                }
            }
        }
        seen.chunks(STEPS.len()).map(|ways| ways.contains(&true)).collect()
    }

    /// The cheapest way from a node to any that is a goal, both included, without sharp bends: Dijkstra's algorithm over nodes
    /// with the direction in which they were come to.
    pub(super) fn way(&self, from: usize, is_goal: impl Fn(usize) -> bool) -> Option<Vec<usize>> {
        let states = self.count() * STEPS.len();
        let (mut costs, mut before) = (vec![f64::INFINITY; states], vec![usize::MAX; states]);
        let mut open = BinaryHeap::new();
        for way in 0..STEPS.len() {
            costs[from * STEPS.len() + way] = 0.0;
            open.push(Reverse(Reached(0.0, from * STEPS.len() + way)));
        }
        while let Some(Reverse(Reached(cost, state))) = open.pop() {
            if cost > costs[state] {
                continue;
            }
            let (at, came) = (state / STEPS.len(), (state % STEPS.len()) as i32);
            if is_goal(at) {
                let mut nodes = vec![at];
                let mut state = state;
                while before[state] != usize::MAX {
                    state = before[state];
                    nodes.push(state / STEPS.len());
                }
                nodes.reverse();
                return Some(nodes);
            }
            for turn in -TURN..=TURN {
                let way = (came + turn).rem_euclid(16) as usize;
                let sum = cost + self.costs[at][way];
                if !sum.is_finite() {
                    continue;
                }
                let (dx, dy) = STEPS[way];
                let to = (at as i32 + dy * self.side as i32 + dx) as usize * STEPS.len() + way;
                if sum < costs[to] {
                    costs[to] = sum;
                    before[to] = state;
                    open.push(Reverse(Reached(sum, to)));
                }
            }
        }
        None
    }
}

/// A state that was come to; ordered by cost, then by number.
#[derive(PartialEq)]
struct Reached(f64, usize);

impl Eq for Reached {}

impl Ord for Reached {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.0.total_cmp(&other.0).then(self.1.cmp(&other.1))
    }
}

impl PartialOrd for Reached {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

/// What a straight step costs, m of level ground; none if it is too steep or wet.
fn step_cost(grid: &Grid, from: Point2, to: Point2, grade: f64) -> Option<f64> {
    let length = (to - from).norm();
    let steep = (grid.height(to) - grid.height(from)).abs() / length;
    let middle = from + (to - from) * 0.5;
    if steep > grade {
        return None;
    }
    // Steeper is worse, and so is a slope that has to be cut into.
    let share = steep / EASY;
    Some(length * (1.0 + 2.0 * share * share + 1.5 * grid.slope(middle)))
}

/// Ways that are being found, with the places where they meet.
#[derive(Default)]
pub(super) struct Trails {
    /// From end to end, before bends are cut off.
    ways: Vec<Vec<Point3>>,
}

impl Trails {
    /// Adds a way.
    pub(super) fn add(&mut self, line: Vec<Point3>) {
        if line.len() >= 2 {
            self.ways.push(line);
        }
    }

    /// Whether a way passes a place.
    pub(super) fn passes(&self, place: Point2) -> bool {
        self.ways.iter().flatten().any(|point| point.xy() == place)
    }

    /// The ways from meeting to meeting, with their bends cut off.
    pub(super) fn lines(&self) -> Vec<Vec<Point3>> {
        let mut uses: BTreeMap<[u64; 2], usize> = BTreeMap::new();
        let key = |point: &Point3| [point.x.to_bits(), point.y.to_bits()];
        for way in &self.ways {
            for (rank, point) in way.iter().enumerate() {
                // An end is a meeting of its own.
                let is_end = rank == 0 || rank + 1 == way.len();
                *uses.entry(key(point)).or_default() += if is_end { 2 } else { 1 };
            }
        }
        let mut lines = Vec::new();
        for way in &self.ways {
            let mut line = vec![way[0]];
            for point in &way[1..] {
                line.push(*point);
                if uses[&key(point)] > 1 {
                    lines.push(rounded(&std::mem::replace(&mut line, vec![*point])));
                }
            }
        }
        lines
    }

    /// The ways as a network knows them.
    pub(super) fn footpaths(&self) -> Vec<Footpath> {
        let planar = |line: Vec<Point3>| line.iter().map(Point3::xy).collect();
        let way = |line| Footpath {
            path: planar(line),
            width: TRAIL_WIDTH,
            joins: [true; 2],
            ..Footpath::default()
        };
        self.lines().into_iter().map(way).collect()
    }
}

/// The places of a way with their heights on the land.
pub(super) fn on_land(grid: &Grid, places: impl IntoIterator<Item = Point2>) -> Vec<Point3> {
    places.into_iter().map(|place| Point3::new(place.x, place.y, grid.height(place))).collect()
}

/// The line with its gentle bends cut off (Chaikin 1974), ends as they were. Sharp bends stay: they are switchbacks.
pub(super) fn rounded(line: &[Point3]) -> Vec<Point3> {
    let Some((last, rest)) = line.split_last() else { return Vec::new() };
    let mut points = vec![line[0]];
    for index in 1..rest.len() {
        let (before, at, after) = (line[index - 1], line[index], line[index + 1]);
        let (come, go): (Vector2, Vector2) = ((at - before).xy(), (after - at).xy());
        if come.dot(&go) < SHARP * come.norm() * go.norm() {
            points.push(at);
        } else {
            points.extend([at + (before - at) * 0.25, at + (after - at) * 0.25]);
        }
    }
    points.push(*last);
    points
}
