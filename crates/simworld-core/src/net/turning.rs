//! Room to turn round at dead ends.

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
    /// Gives every dead end that has room for it a turning circle: one for lorries, or else one for cars. Dead ends
    /// where other streets are too near, and those of streets that are too short, stay as wide as their streets; so do
    /// those off the ground.
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
        let lines: Vec<Vec<Point2>> = self.streets.iter().map(|street| self.centerline(street)).collect();
        let cells = cells(&lines);
        let circles: Vec<(usize, bool, f64)> = (0..self.streets.len())
            .flat_map(|index| [(index, false), (index, true)])
            .filter_map(|(index, at_end)| {
                let street = &self.streets[index];
                let node = if at_end { street.to } else { street.from };
                let is_asked = degrees[node] == 1 && street.level == 0;
                is_asked.then(|| {
                    let others = near(&cells, self.nodes[node]).map(|other| (other, lines[other].as_slice()));
                    let room = self.room_among(index, at_end, &lines[index], others);
                    (index, at_end, room.widest())
                })
            })
            .collect();
        for (index, at_end, radius) in circles {
            self.streets[index].turning[usize::from(at_end)] = radius;
        }
    }

    /// The room for a turning circle at an end of a street, among some other streets: all that lie within 60 m of it.
    ///
    /// ```
    /// use simworld_core::net::StreetPlan;
    /// let plan = StreetPlan::crossroads(120.0);
    /// let room = plan.turning_room(0, true, &[1, 2, 3]);
    /// assert_eq!(room.widest(), 13.5);
    /// assert!(room.has(9.1) && !room.has(50.0));
    /// ```
    pub fn turning_room(&self, street: usize, at_end: bool, others: &[usize]) -> TurningRoom {
        let lines: Vec<Vec<Point2>> =
            others.iter().map(|other| self.centerline(&self.streets[*other])).collect();
        let line = self.centerline(&self.streets[street]);
        let others = others.iter().copied().zip(lines.iter().map(Vec::as_slice));
        self.room_among(street, at_end, &line, others)
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
        let (left, right) = section.kerbs();
        let walk = (section.left_of_reference() - left).max(section.right_of_reference() - right);
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
        TurningRoom { least: (left + right) * 0.5 + 1.5, most: polyline::length(line) * SHARE, walk, gap }
    }
}

/// The room for a turning circle at an end of a street.
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

    fn fits(&self, radius: f64, land: f64) -> bool {
        radius > self.least && radius + self.walk + land <= self.gap && radius + 3.0 <= self.most
    }
}

/// Streets by the cells that they pass, in the order of cells.
type Cells = Vec<((i64, i64), usize)>;

fn cell(point: Point2) -> (i64, i64) {
    ((point.x / CELL).floor() as i64, (point.y / CELL).floor() as i64)
}

fn cells(lines: &[Vec<Point2>]) -> Cells {
    let mut cells = Cells::new();
    for (index, line) in lines.iter().enumerate() {
        for pair in line.windows(2) {
            let steps = ((pair[1] - pair[0]).norm() / (CELL * 0.5)).ceil().max(1.0);
            cells.extend((0..=steps as u64).map(|step| {
                let at = pair[0] + (pair[1] - pair[0]) * (step as f64 / steps);
                (cell(at), index)
            }));
        }
    }
    cells.sort_unstable();
    cells.dedup();
    cells
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
