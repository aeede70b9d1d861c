//! Room to turn round at dead ends.

use std::collections::BTreeMap;

use super::hammerhead::{HAMMERHEAD_REACH, Wanted, walk_beside};
use super::{StreetPlan, polyline};
use crate::geometry::Point2;

/// Radius of a turning circle in which a refuse vehicle turns in one go, m. A 9 m lorry (SU-9) needs 12.7 m, a car
/// (P) 7.3 m (AASHTO, A Policy on Geometric Design of Highways and Streets, 2011, table 2-2b); each with room beside.
pub const LORRY_TURNING: f64 = 13.5;
/// Radius of a turning circle in which a car turns in one go, m: 30 feet, as for residential streets there.
pub const CAR_TURNING: f64 = 9.1;

/// Land that stays between a turning circle with its walkway and the next street, m: for a car none is asked; the
/// wider circle must leave the depth of a lot.
const LAND: [(f64, f64); 2] = [(LORRY_TURNING, 24.0), (CAR_TURNING, 0.0)];
/// A turning circle takes at most this share of its street's length, from the end to where the flare begins.
const SHARE: f64 = 0.4;
/// Cells in which streets are looked for, m.
const CELL: f64 = 50.0;

impl StreetPlan {
    /// Gives every dead end that has room for it a turning circle: one for lorries, or else one for cars; and a hammerhead
    /// where no circle has room. Dead ends where other streets are too near, and those of streets that are too short, stay
    /// as wide as their streets; so do those off the ground.
    ///
    /// ```
    /// use simworld_core::net::StreetPlan;
    /// let mut plan = StreetPlan::crossroads(120.0);
    /// plan.make_turning_room();
    /// assert!(plan.streets.iter().all(|street| street.turning == [0.0, 13.5]));
    /// ```
    pub fn make_turning_room(&mut self) {
        let mut degrees = vec![0_u32; self.nodes.len()];
        for street in &self.streets {
            degrees[street.from] += 1;
            degrees[street.to] += 1;
        }
        let dead: Vec<usize> = (0..degrees.len()).filter(|node| degrees[*node] == 1).collect();
        if dead.is_empty() {
            return;
        }
        let (cells, lines) = self.lines_about(&dead);
        let rooms: Vec<(usize, bool, TurningRoom)> = (0..self.streets.len())
            .flat_map(|index| [(index, false), (index, true)])
            .filter_map(|(index, at_end)| {
                let street = &self.streets[index];
                let node = if at_end { street.to } else { street.from };
                let is_asked = degrees[node] == 1 && street.level == 0;
                is_asked.then(|| {
                    let others = lines_near(&cells, &lines, self.nodes[node]);
                    (index, at_end, self.room_among(index, at_end, &lines[index], others))
                })
            })
            .collect();
        for (index, at_end, room) in &rooms {
            self.streets[*index].turning[usize::from(*at_end)] = room.widest();
        }
        // Heads keep off the circles, which are known now.
        let has_head = |(index, at_end, room): &(usize, bool, TurningRoom)| {
            let street = &self.streets[*index];
            let node = if *at_end { street.to } else { street.from };
            let wanted = Wanted { street: *index, at_end: *at_end, line: &lines[*index] };
            let others = lines_near(&cells, &lines, self.nodes[node]);
            room.asks_for_head() && self.has_room_for_head(wanted, others, |node| degrees[node] == 1)
        };
        let heads: Vec<bool> = rooms.iter().map(has_head).collect();
        for ((index, at_end, _), has_head) in rooms.into_iter().zip(heads) {
            self.streets[index].hammerhead[usize::from(at_end)] = has_head;
        }
    }

    /// The room for a turning circle or a hammerhead at an end of a street, among some other streets with the circles that
    /// they have: all that lie within 60 m of it.
    ///
    /// ```
    /// use simworld_core::net::StreetPlan;
    /// let plan = StreetPlan::crossroads(120.0);
    /// let room = plan.turning_room(0, true, &[1, 2, 3]);
    /// assert_eq!(room.widest(), 13.5);
    /// assert!(room.has(9.1) && !room.has(50.0) && room.has_hammerhead());
    /// ```
    pub fn turning_room(&self, street: usize, at_end: bool, others: &[usize]) -> TurningRoom {
        let mut degrees: BTreeMap<usize, u32> = BTreeMap::new();
        for known in others.iter().filter(|other| **other != street).chain([&street]) {
            for end in [self.streets[*known].from, self.streets[*known].to] {
                *degrees.entry(end).or_default() += 1;
            }
        }
        let lines: Vec<Vec<Point2>> =
            others.iter().map(|other| self.centerline(&self.streets[*other])).collect();
        let line = self.centerline(&self.streets[street]);
        let others = || others.iter().copied().zip(lines.iter().map(Vec::as_slice));
        let mut room = self.room_among(street, at_end, &line, others());
        let wanted = Wanted { street, at_end, line: &line };
        room.head = room.is_long_enough()
            && self.has_room_for_head(wanted, others(), |node| degrees.get(&node) == Some(&1));
        room
    }

    /// The streets in the cells about some nodes, and the centreline of each: those of no other street.
    fn lines_about(&self, nodes: &[usize]) -> (Cells, Vec<Vec<Point2>>) {
        let about = About::of(nodes.iter().map(|node| self.nodes[*node]));
        let (mut cells, mut line) = (Cells::new(), Vec::new());
        let lines = self.streets.iter().enumerate().map(|(index, street)| {
            line.clear();
            line.push(self.nodes[street.from]);
            line.extend(&street.via);
            line.push(self.nodes[street.to]);
            let before = cells.len();
            about.enter(index, &line, &mut cells);
            if cells.len() > before { line.clone() } else { Vec::new() }
        });
        let lines = lines.collect();
        cells.sort_unstable();
        cells.dedup();
        (cells, lines)
    }

    fn room_among<'a>(
        &self,
        street: usize,
        at_end: bool,
        line: &[Point2],
        others: impl Iterator<Item = (usize, &'a [Point2])>,
    ) -> TurningRoom {
        let own = &self.streets[street];
        let section = self.section(own);
        let ((left, right), walk) = (section.kerbs(), walk_beside(section));
        let at = self.nodes[if at_end { own.to } else { own.from }];
        let mut gap = f64::INFINITY;
        for (other, line) in others.filter(|(other, _)| *other != street) {
            let section = self.section(&self.streets[other]);
            let reach = section.left_of_reference().max(section.right_of_reference());
            let distance = polyline::closest(line, &at).map_or(f64::INFINITY, |near| near.distance);
            // Of two dead ends that look at each other either may take its half of the land between.
            let ends = [self.streets[other].from, self.streets[other].to];
            let shared = ends.iter().any(|end| (self.nodes[*end] - at).norm() <= distance + 1e-9);
            gap = gap.min(if shared { distance * 0.5 } else { distance - reach });
        }
        let (least, most) = ((left + right) * 0.5 + 1.5, polyline::length(line) * SHARE);
        TurningRoom { least, most, walk, gap, head: false }
    }
}

/// The room for a turning circle, or for a hammerhead, at an end of a street.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TurningRoom {
    /// A circle that is no wider is no wider than the street, m.
    least: f64,
    /// What the length of the street allows a circle with its flare, m.
    most: f64,
    /// Width of the walkway round the circle, m.
    walk: f64,
    /// Land between the end and the nearest street, m.
    gap: f64,
    /// Whether a hammerhead has room.
    head: bool,
}

impl TurningRoom {
    /// Radius of the widest circle that is built there, m: one for lorries, or else one for cars; 0 for none.
    pub fn widest(&self) -> f64 {
        LAND.iter().find(|(radius, land)| self.fits(*radius, *land)).map_or(0.0, |(radius, _)| *radius)
    }

    /// Whether a circle of a radius, m, has room.
    pub fn has(&self, radius: f64) -> bool {
        self.fits(radius, 0.0)
    }

    /// Whether a hammerhead has room; what a circle asks for is another matter.
    pub fn has_hammerhead(&self) -> bool {
        self.head
    }

    /// Whether the street is not too short for a hammerhead with its flares.
    fn is_long_enough(&self) -> bool {
        HAMMERHEAD_REACH <= self.most
    }

    /// Whether no circle has room, and the street is long enough for a head.
    fn asks_for_head(&self) -> bool {
        self.widest() == 0.0 && self.is_long_enough()
    }

    fn fits(&self, radius: f64, land: f64) -> bool {
        radius > self.least && radius + self.walk + land <= self.gap && radius + 3.0 <= self.most
    }
}

/// Streets by the cells that they pass, in the order of cells.
type Cells = Vec<((i64, i64), usize)>;

fn cell(point: Point2) -> (i64, i64) {
    // The floor, without a call and without a division: most points are looked at for nothing.
    let along = |metres: f64| {
        let cells = metres * (1.0 / CELL);
        cells as i64 - i64::from((cells as i64) as f64 > cells)
    };
    (along(point.x), along(point.y))
}

/// The cells about some points: most streets are far from all dead ends.
struct About {
    /// A mark for each cell, by the lowest bits of its key; some are marked that lie elsewhere.
    marks: Vec<bool>,
}

impl About {
    fn of(points: impl ExactSizeIterator<Item = Point2>) -> Self {
        let mut marks = vec![false; (64 * points.len()).next_power_of_two()];
        let mask = marks.len() - 1;
        for (column, row) in points.map(cell) {
            for column in column - 1..=column + 1 {
                for row in row - 1..=row + 1 {
                    marks[Self::key((column, row)) & mask] = true;
                }
            }
        }
        Self { marks }
    }

    /// Cells that lie together have keys of their own: so many to a row.
    const fn key((column, row): (i64, i64)) -> usize {
        row.wrapping_mul(509).wrapping_add(column) as usize
    }

    /// Enters a street in those of the cells that its centreline passes.
    fn enter(&self, street: usize, line: &[Point2], cells: &mut Cells) {
        for (index, pair) in line.windows(2).enumerate() {
            let way = pair[1] - pair[0];
            let steps = (way.norm() * (2.0 / CELL)) as u32 + 1;
            let stride = way / f64::from(steps);
            // Where a piece begins the one before ends.
            for step in u32::from(index > 0)..=steps {
                let cell = cell(pair[0] + stride * f64::from(step));
                if !self.marks[Self::key(cell) & (self.marks.len() - 1)] {
                    continue;
                }
                // A cell holds many points one after the other, of bends above all.
                if cells.last() != Some(&(cell, street)) {
                    cells.push((cell, street));
                }
            }
        }
    }
}

/// The streets in the cells about a point with their centrelines, some of them more than once.
fn lines_near<'a>(
    cells: &'a Cells,
    lines: &'a [Vec<Point2>],
    at: Point2,
) -> impl Iterator<Item = (usize, &'a [Point2])> + 'a {
    near(cells, at).map(move |other| (other, lines[other].as_slice()))
}

/// Streets in the cells about a point, some of them more than once.
fn near(cells: &Cells, at: Point2) -> impl Iterator<Item = usize> + '_ {
    let (column, row) = cell(at);
    (column - 1..=column + 1).flat_map(move |column| {
        let from = cells.partition_point(|entry| entry.0 < (column, row - 1));
        let to = cells.partition_point(|entry| entry.0 <= (column, row + 1));
        cells[from..to].iter().map(|entry| entry.1)
    })
}
