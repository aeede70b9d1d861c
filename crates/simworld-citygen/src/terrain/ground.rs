//! The ground of a city: its streets where they are, the land between them.

use simworld_core::geometry::Point2;
use simworld_core::id::RoadId;
use simworld_core::net::{Road, RoadNetwork};

use super::HeightField;

/// Streets farther than this do not shape the ground, m.
pub(crate) const REACH: f64 = 60.0;
/// Weight of the land beside that of the streets around.
const LAND: f64 = 0.05;
/// On the middle of a street nothing else counts, m.
const ON_STREET: f64 = 1e-6;

/// The ground of a city: at the height of its streets along them, and between them drawn smoothly to the height of the land.
///
/// Heights of streets within reach are weighted by `((reach - distance) / distance)²` (Franke and Nielson 1980), which is
/// continuous and leaves each street its own height; each straight piece of a street counts by itself. A level network has a level ground.
pub struct Ground<'a> {
    land: &'a dyn HeightField,
    /// Straight pieces of the streets; none of a level network.
    pieces: Vec<Piece>,
    /// Pieces by the cells of a grid that they pass, in the order of cells.
    cells: Vec<((i32, i32), u32)>,
    is_level: bool,
}

/// A straight piece of a street with the heights of its ends.
#[derive(Clone, Copy)]
struct Piece {
    a: Point2,
    b: Point2,
    heights: (f64, f64),
}

impl Piece {
    /// Distance to a point, and the height at the nearest place.
    fn nearest(&self, point: Point2) -> (f64, f64) {
        let along = self.b - self.a;
        let share = ((point - self.a).dot(&along) / along.norm_squared().max(1e-12)).clamp(0.0, 1.0);
        let distance = (point - self.a - along * share).norm();
        (distance, self.heights.0 + (self.heights.1 - self.heights.0) * share)
    }
}

impl<'a> Ground<'a> {
    /// The ground of a network on some land.
    pub fn new(network: &RoadNetwork, land: &'a dyn HeightField) -> Self {
        let mut ground = Self { land, pieces: Vec::new(), cells: Vec::new(), is_level: true };
        let is_level = |road: &Road| road.level != 0 || road.profile.iter().all(|(_, height)| *height == 0.0);
        if network.intersections.iter().all(|place| place.height == 0.0) && network.roads.iter().all(is_level)
        {
            return ground;
        }
        // Bridges and tunnels leave the ground as it is.
        for (index, road) in network.roads.iter().enumerate().filter(|(_, road)| road.level == 0) {
            let id = RoadId::from_index(index);
            let mut station = 0.0;
            for pair in road.centerline.windows(2) {
                let end = station + (pair[1] - pair[0]).norm();
                let heights = (network.height(id, station), network.height(id, end));
                ground.add(Piece { a: pair[0], b: pair[1], heights });
                station = end;
            }
        }
        ground.cells.sort_unstable();
        ground.cells.dedup();
        ground.is_level = ground.pieces.is_empty();
        ground
    }

    /// The ground of land into which the streets are cut already.
    pub fn of_land(land: &'a dyn HeightField) -> Self {
        Self { land, pieces: Vec::new(), cells: Vec::new(), is_level: false }
    }

    fn add(&mut self, piece: Piece) {
        let along = piece.b - piece.a;
        let steps = (along.norm() / (REACH * 0.5)).ceil().max(1.0) as u32;
        for step in 0..=steps {
            let at = piece.a + along * (f64::from(step) / f64::from(steps));
            self.cells.push((cell(at), self.pieces.len() as u32));
        }
        self.pieces.push(piece);
    }

    /// Whether all of it is at height zero.
    pub fn is_level(&self) -> bool {
        self.is_level
    }

    /// The height at a point, m.
    pub fn height(&self, point: Point2) -> f64 {
        if self.is_level() {
            return 0.0;
        }
        let (mut sum, mut weights) = (LAND * self.land.height(point), LAND);
        for index in self.near(point) {
            let piece = &self.pieces[index as usize];
            let (distance, height) = piece.nearest(point);
            if distance < ON_STREET {
                return height;
            }
            let weight = (REACH - distance).max(0.0) / distance;
            // Long pieces count for more, so that a bent street counts no more than a straight one.
            let weight = weight * weight * (piece.b - piece.a).norm() / REACH;
            sum += weight * height;
            weights += weight;
        }
        sum / weights
    }

    /// Pieces within reach of a point, and some beyond, each once.
    fn near(&self, point: Point2) -> Vec<u32> {
        let mut near: Vec<u32> = Vec::with_capacity(32);
        let (column, row) = cell(point);
        for column in column - 1..=column + 1 {
            let from = self.cells.partition_point(|entry| entry.0 < (column, row - 1));
            let to = self.cells.partition_point(|entry| entry.0 <= (column, row + 1));
            near.extend(self.cells[from..to].iter().map(|entry| entry.1));
        }
        near.sort_unstable();
        near.dedup();
        near
    }
}

/// The cell of a point; its width is the reach.
fn cell(point: Point2) -> (i32, i32) {
    ((point.x / REACH).floor() as i32, (point.y / REACH).floor() as i32)
}
