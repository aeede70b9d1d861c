//! Buildings take over what points inside them say: a restaurant is often a point in a house.

use simworld_core::geometry::{Point2, bounds};

use super::outline::{Outline, contains};
use super::usage::use_of;
use crate::osm::place::Place;
use crate::osm::tags::Key;

/// Width of a cell of the search grid, m.
const CELL: f64 = 40.0;
/// Cells that one building may cover.
const MOST_CELLS: i64 = 4096;

fn cell(point: Point2) -> (i64, i64) {
    ((point.x / CELL).floor() as i64, (point.y / CELL).floor() as i64)
}

/// Gives each building of unknown use that of the first point inside it, and its name to one that has none.
pub(in crate::osm) fn adopt(place: &Place, outlines: &mut [Outline]) {
    let mut cells: Vec<((i64, i64), u32)> = Vec::new();
    for (index, outline) in outlines.iter().enumerate() {
        let Some((low, high)) = bounds(&outline.corners) else { continue };
        let (low, high) = (cell(low), cell(high));
        if (high.0 - low.0 + 1) * (high.1 - low.1 + 1) <= MOST_CELLS {
            let covered = (low.0..=high.0).flat_map(|x| (low.1..=high.1).map(move |y| (x, y)));
            cells.extend(covered.map(|cell| (cell, index as u32)));
        }
    }
    cells.sort_unstable();
    for (node, tags) in place.raw.tagged_nodes() {
        let (Some(found), Some(point)) = (use_of(&tags), place.point(node)) else { continue };
        let here = cell(point);
        let from = cells.partition_point(|entry| entry.0 < here);
        let near = cells[from..].iter().take_while(|entry| entry.0 == here).map(|(_, index)| *index as usize);
        let Some(index) = near.into_iter().find(|index| contains(&outlines[*index].corners, point)) else {
            continue;
        };
        let usage = &mut outlines[index].usage;
        if !usage.is_known {
            usage.place = found;
            usage.is_known = true;
            usage.name = usage.name.take().or_else(|| tags.get(Key::Name).map(str::to_owned));
        }
    }
}
