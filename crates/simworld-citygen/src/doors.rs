//! The place on a sidewalk before a building that stands anywhere.

use simworld_core::geometry::Point2;
use simworld_core::id::RoadId;
use simworld_core::net::polyline::{self, Measured};
use simworld_core::net::{RoadNetwork, Side, Sidewalk};

/// A building farther than this from every sidewalk has no way in, m.
pub(crate) const FARTHEST_DOOR: f64 = 150.0;

/// A place before a building.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Door {
    pub(crate) at: Point2,
    pub(crate) road: RoadId,
    pub(crate) side: Side,
}

/// Sidewalks by the cells of a grid that they pass, in the order of cells.
pub(crate) struct Doors {
    cells: Vec<((i32, i32), u32)>,
    /// Width of a cell and farthest distance of a door, m.
    reach: f64,
}

impl Doors {
    /// The sidewalks of a network, for buildings no farther from one than `reach` m.
    pub(crate) fn of(network: &RoadNetwork, reach: f64) -> Self {
        Self::of_some(network, reach, |_| true)
    }

    /// Some of the sidewalks of a network.
    pub(crate) fn of_some(network: &RoadNetwork, reach: f64, counts: impl Fn(&Sidewalk) -> bool) -> Self {
        let mut doors = Self { cells: Vec::new(), reach };
        for (index, sidewalk) in network.sidewalks.iter().enumerate().filter(|(_, sidewalk)| counts(sidewalk))
        {
            let path = Measured::new(&sidewalk.path);
            let length = path.length();
            // Twice a cell, so that none is stepped over by more than its corner.
            let steps = (length / (reach * 0.5)).ceil().max(1.0) as u32;
            for step in 0..=steps {
                let at = path.point_at(length * f64::from(step) / f64::from(steps));
                let entry = (doors.cell(at), index as u32);
                if doors.cells.last() != Some(&entry) {
                    doors.cells.push(entry);
                }
            }
        }
        doors.cells.sort_unstable();
        doors.cells.dedup();
        doors
    }

    fn cell(&self, point: Point2) -> (i32, i32) {
        ((point.x / self.reach).floor() as i32, (point.y / self.reach).floor() as i32)
    }

    /// The nearest place on a sidewalk, if one is within reach.
    pub(crate) fn nearest(&self, network: &RoadNetwork, point: Point2) -> Option<Door> {
        let (column, row) = self.cell(point);
        let around = (-1..=1).flat_map(|dx: i32| {
            let column = column.saturating_add(dx);
            let from = self.cells.partition_point(|entry| entry.0 < (column, row.saturating_sub(1)));
            let to = self.cells.partition_point(|entry| entry.0 <= (column, row.saturating_add(1)));
            &self.cells[from..to]
        });
        nearest_of(network, around.map(|(_, index)| *index), point, self.reach)
    }
}

/// The nearest place on some sidewalks, if one is within reach, m.
pub(crate) fn nearest_of(
    network: &RoadNetwork,
    sidewalks: impl Iterator<Item = u32>,
    point: Point2,
    reach: f64,
) -> Option<Door> {
    let candidates = sidewalks.filter_map(|index| {
        let near = polyline::closest(&network.sidewalks[index as usize].path, &point)?;
        Some((near.distance, near.station, index))
    });
    let (distance, station, index) = candidates.min_by(|a, b| a.0.total_cmp(&b.0).then(a.2.cmp(&b.2)))?;
    let sidewalk = &network.sidewalks[index as usize];
    let at = polyline::at(&sidewalk.path, station).0;
    (distance <= reach).then_some(Door { at, road: sidewalk.road, side: sidewalk.side })
}
