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
                is_asked.then(|| (index, at_end, self.turning_room(index, node, &lines, &cells)))
            })
            .collect();
        for (index, at_end, radius) in circles {
            self.streets[index].turning[usize::from(at_end)] = radius;
        }
    }

    /// The widest circle that has room at the dead end of a street.
    fn turning_room(&self, street: usize, node: usize, lines: &[Vec<Point2>], cells: &Cells) -> f64 {
        let section = self.section(&self.streets[street]);
        let (left, right) = section.kerbs();
        let walk = (section.left_of_reference() - left).max(section.right_of_reference() - right);
        let at = self.nodes[node];
        let mut gap = f64::INFINITY;
        for other in near(cells, at).filter(|other| *other != street) {
            let section = self.section(&self.streets[other]);
            let reach = section.left_of_reference().max(section.right_of_reference());
            let distance = polyline::closest(&lines[other], &at).map_or(f64::INFINITY, |near| near.distance);
            // Of two dead ends that look at each other either may take its half of the land between.
            let ends = [self.streets[other].from, self.streets[other].to];
            let shared = ends.iter().any(|end| (self.nodes[*end] - at).norm() <= distance + 1e-9);
            gap = gap.min(if shared { distance * 0.5 } else { distance - reach });
        }
        let length = polyline::length(&lines[street]);
        let fits = |(radius, land): &(f64, f64)| {
            let is_wider = *radius > (left + right) * 0.5 + 1.5;
            is_wider && radius + walk + land <= gap && radius + 3.0 <= length * SHARE
        };
        LAND.iter().find(|circle| fits(circle)).map_or(0.0, |(radius, _)| *radius)
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
