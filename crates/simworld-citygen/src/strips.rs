//! What is taken: oriented rectangles in a uniform grid, for exact overlap tests.

use std::collections::BTreeMap;

use simworld_core::geometry::{Obb, Point2, Point3, Vector3, heading, pose_facing};
use simworld_core::net::{Road, RoadNetwork};

/// Width of a grid cell, m.
const CELL: f64 = 40.0;
/// Height given to flat things so that they are boxes, m.
const FLAT: f64 = 1.0;

/// Oriented rectangles that must not overlap.
#[derive(Clone, Debug, Default)]
pub(crate) struct Taken {
    boxes: Vec<Obb>,
    cells: BTreeMap<(i32, i32), Vec<u32>>,
}

impl Taken {
    pub(crate) fn add(&mut self, obb: Obb) {
        let index = self.boxes.len() as u32;
        for cell in cells(&obb) {
            self.cells.entry(cell).or_default().push(index);
        }
        self.boxes.push(obb);
    }

    pub(crate) fn overlaps(&self, obb: &Obb) -> bool {
        cells(obb).any(|cell| {
            let entries = self.cells.get(&cell).into_iter().flatten();
            entries.into_iter().any(|index| self.boxes[*index as usize].footprints_overlap(obb))
        })
    }
}

fn cells(obb: &Obb) -> impl Iterator<Item = (i32, i32)> + use<> {
    let bounds = obb.aabb();
    let index = |x: f64| (x / CELL).floor() as i32;
    let rows = (index(bounds.min.y), index(bounds.max.y));
    (index(bounds.min.x)..=index(bounds.max.x)).flat_map(move |x| (rows.0..=rows.1).map(move |y| (x, y)))
}

/// A flat rectangle along a piece of line, `left` and `right` m to its sides, `extend` m beyond its ends.
pub(crate) fn strip(a: Point2, b: Point2, left: f64, right: f64, extend: f64) -> Obb {
    let along = b - a;
    let yaw = heading(&along);
    let middle = nalgebra::center(&a, &b);
    let normal = nalgebra::Vector2::new(-simworld_core::ops::sin(yaw), simworld_core::ops::cos(yaw));
    let center = middle + normal * ((left - right) * 0.5);
    Obb {
        pose: pose_facing(Point3::new(center.x, center.y, 0.0), yaw),
        half_extents: Vector3::new(along.norm() * 0.5 + extend, (left + right) * 0.5, FLAT),
    }
}

/// The land that roads take, sidewalks and corners included: one strip a straight piece of centreline, each as long
/// again as half its width beyond its ends.
pub(crate) fn road_land(network: &RoadNetwork) -> Taken {
    let mut taken = Taken::default();
    let walk = network.sidewalks.iter().map(|sidewalk| sidewalk.width).fold(0.0, f64::max);
    for road in &network.roads {
        // The wider side on both covers one-way roads, whose lanes lie on one side of the line.
        let reach = lane_reach(road) + walk;
        for piece in road.centerline.windows(2) {
            taken.add(strip(piece[0], piece[1], reach, reach, reach));
        }
    }
    taken
}

/// How far the carriageway reaches to the wider side of the centreline, m.
pub(crate) fn lane_reach(road: &Road) -> f64 {
    road.left_kerb.max(road.right_kerb)
}
