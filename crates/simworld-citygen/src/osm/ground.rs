//! What is driven on, where something of the map might stand on it.

use simworld_core::geometry::{Point2, bounds};
use simworld_core::net::RoadNetwork;

use crate::occupancy::Occupancy;

/// Half the width that a car needs on its lane, m. What stands beside that stands: maps are not that exact.
const HALF_CAR: f64 = 0.8;
/// Width of a cell of the mask, m.
const CELL: f64 = 16.0;
/// Cells along one side of the mask; it is wrapped round, so that far places share cells.
const SIDE: i64 = 1024;
/// What covers more cells than this along one side is taken to touch anything.
const MOST_CELLS: i64 = 64;

/// Places that matter: a set of cells, which may say yes where the truth is no, but never the other way round.
pub(super) struct Mask {
    bits: Vec<u64>,
    is_full: bool,
}

impl Mask {
    pub(super) fn new() -> Self {
        Self { bits: vec![0; (SIDE * SIDE / 64) as usize], is_full: false }
    }

    /// Marks the box round some points, and so much round it, m.
    pub(super) fn mark(&mut self, points: &[Point2], beside: f64) {
        match cells(points, beside) {
            Some(cells) => cells.for_each(|(word, bit)| self.bits[word] |= bit),
            None => self.is_full = true,
        }
    }

    /// Whether the box round some points, and so much round it, touches a place that matters.
    fn touches(&self, points: &[Point2], beside: f64) -> bool {
        let Some(mut cells) = cells(points, beside) else { return true };
        self.is_full || cells.any(|(word, bit)| self.bits[word] & bit != 0)
    }
}

/// The words and bits of the cells of a box; `None` if they are too many.
fn cells(points: &[Point2], beside: f64) -> Option<impl Iterator<Item = (usize, u64)>> {
    let (low, high) = bounds(points).unwrap_or_default();
    let cell = |x: f64| (x / CELL).floor() as i64;
    let columns = cell(low.x - beside)..=cell(high.x + beside);
    let rows = cell(low.y - beside)..=cell(high.y + beside);
    let is_small = [&columns, &rows].iter().all(|range| range.end() - range.start() < MOST_CELLS);
    is_small.then(|| {
        rows.flat_map(move |row| {
            columns.clone().map(move |column| {
                let index = row.rem_euclid(SIDE) * SIDE + column.rem_euclid(SIDE);
                ((index / 64) as usize, 1 << (index % 64))
            })
        })
    })
}

/// The strips that cars drive on at the level of the ground, where the mask says that they matter.
pub(super) fn carriageways(network: &RoadNetwork, off_ground: &[bool], mask: &Mask) -> Occupancy {
    let mut taken = Occupancy::default();
    let mut add = |path: &[Point2]| {
        for pair in path.windows(2) {
            if mask.touches(pair, 2.0 * HALF_CAR) && (pair[1] - pair[0]).norm() > 0.01 {
                taken.add_box(&crate::strips::strip(pair[0], pair[1], HALF_CAR, HALF_CAR, 0.0));
            }
        }
    };
    let on_ground = |lane: usize| !off_ground[network.lanes[lane].road.index()];
    for lane in network.lanes.iter().filter(|lane| !off_ground[lane.road.index()]) {
        add(&lane.path);
    }
    for way in &network.connections {
        if on_ground(way.from.index()) && on_ground(way.to.index()) && mask.touches(&way.path, 2.0 * HALF_CAR)
        {
            add(&way.path);
        }
    }
    taken
}

#[cfg(test)]
mod tests {
    use simworld_core::geometry::Vector2;
    use simworld_core::net::{NetworkConfig, StreetPlan};

    use super::*;

    #[test]
    fn strips_are_missing_only_where_nothing_was_marked() {
        let plan = StreetPlan::grid(4, 4, 130.0);
        let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).unwrap();
        let on_ground = vec![false; plan.streets.len()];
        let square = |at: Point2| {
            [(0.0, 0.0), (3.0, 0.0), (3.0, 3.0), (0.0, 3.0)].map(|(x, y)| at + Vector2::new(x, y))
        };
        let mut everything = Mask::new();
        everything.mark(&[Point2::new(-1e6, 0.0), Point2::new(1e6, 0.0)], 0.0);
        let all = carriageways(&network, &on_ground, &everything);
        let places: Vec<[Point2; 4]> = (0..400)
            .map(|index| square(Point2::new(f64::from(index % 20) * 20.0, f64::from(index / 20) * 20.0)))
            .collect();
        let mut some = Mask::new();
        places.iter().step_by(7).for_each(|place| some.mark(place, 0.0));
        let few = carriageways(&network, &on_ground, &some);
        assert!(few.len() < all.len() && !few.is_empty(), "{} of {}", few.len(), all.len());
        let taken = places.iter().step_by(7).filter(|place| !all.is_free(*place)).count();
        assert!(taken > 5);
        assert!(places.iter().step_by(7).all(|place| all.is_free(place) == few.is_free(place)));
    }
}
