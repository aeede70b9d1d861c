//! What stands wholly behind houses is not drawn: the closed boxes that walls make, in a coarse picture of the nearest of them.
//!
//! Nothing that could be seen is left out. A tile of the picture counts as covered only where one box covers all of it, and then as
//! far as the box is entered at the worst. For that the corners of the tile are enough: the inverse of the depth at which a ray enters
//! a convex body is the least of several functions linear in the pixel, so that over a tile it is least at one of the corners.

use nalgebra::{Matrix3, UnitQuaternion};
use simworld_core::geometry::{Point3, Vector3};

use crate::batch::Projection;
use crate::view::View;

/// Side of a tile, pixels.
const TILE: u32 = 8;
/// What is behind by less than this share of its depth may show, by what floats round off.
const SLACK: f64 = 1.0 + 1e-4;

/// A box that nobody looks through: its walls, its roof and its floor are drawn and closed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Block {
    /// Its middle in the world, m.
    pub center: Point3,
    /// Half its sides along its own axes, m.
    pub half: Vector3,
    /// World from box.
    pub turn: UnitQuaternion<f64>,
}

/// What covers the picture of one view, tile by tile.
#[derive(Default)]
pub(crate) struct Occlusion {
    across: usize,
    down: usize,
    /// By tile, the inverse of the depth from where on nothing is seen, 1/m; 0 where everything is.
    tiles: Vec<f64>,
    /// By corner of the tiles that one block may cover.
    corners: Vec<f64>,
    any: bool,
}

/// A function of a ray (a, b, 1).
type Linear = [f64; 3];

/// Where rays of planar depth one enter and leave a box, as inverse depths: the least of the first, the greatest of the others.
struct Slabs {
    entries: [Linear; 3],
    entry_count: usize,
    exits: [Linear; 6],
    exit_count: usize,
}

impl Slabs {
    /// None for an eye inside, or so near that the near plane may cut into the box.
    fn of(center: &Vector3, axes: &Matrix3<f64>, half: &Vector3, margin: f64) -> Option<Self> {
        let zero = [0.0; 3];
        let mut slabs = Self { entries: [zero; 3], entry_count: 0, exits: [zero; 6], exit_count: 0 };
        let mut outside = false;
        for axis in 0..3 {
            let normal = axes.column(axis);
            let eye = -normal.dot(center);
            let h = half[axis];
            let plane = |side: f64| -> Linear { (normal / (side * h - eye)).into() };
            outside |= eye.abs() > h + margin;
            if eye.abs() > h {
                slabs.entries[slabs.entry_count] = plane(eye.signum());
                slabs.entry_count += 1;
                slabs.exits[slabs.exit_count] = plane(-eye.signum());
                slabs.exit_count += 1;
            } else if eye.abs() < h {
                slabs.exits[slabs.exit_count] = plane(1.0);
                slabs.exits[slabs.exit_count + 1] = plane(-1.0);
                slabs.exit_count += 2;
            } else {
                // On a face: seen edge on.
                return None;
            }
        }
        outside.then_some(slabs)
    }

    /// The inverse depth at which a ray enters; 0 if it does not.
    fn enter(&self, a: f64, b: f64) -> f64 {
        let at = |[x, y, z]: &Linear| x * a + y * b + z;
        let entry = self.entries[..self.entry_count].iter().map(at).fold(f64::INFINITY, f64::min);
        let exit = self.exits[..self.exit_count].iter().map(at).fold(0.0, f64::max);
        if entry > exit { entry } else { 0.0 }
    }
}

impl Occlusion {
    /// Starts anew for a view, of which everything is seen.
    pub(crate) fn begin(&mut self, view: &View) {
        let k = &view.intrinsics;
        (self.across, self.down) = (k.width.div_ceil(TILE) as usize, k.height.div_ceil(TILE) as usize);
        self.tiles.clear();
        self.tiles.resize(self.across * self.down, 0.0);
        self.any = false;
    }

    /// Lets a block that is on the picture cover what is behind it.
    pub(crate) fn cover(&mut self, view: &View, block: &Block) {
        if view.projection != Projection::Pinhole {
            return;
        }
        let k = &view.intrinsics;
        let axes = view.optical_from_world * block.turn.to_rotation_matrix().matrix();
        let center = view.optical_from_world * (block.center - view.eye);
        let widest = Vector3::new(
            k.cx.max(f64::from(k.width) - k.cx) / k.fx,
            k.cy.max(f64::from(k.height) - k.cy) / k.fy,
            1.0,
        );
        let Some(slabs) = Slabs::of(&center, &axes, &block.half, view.near * widest.norm()) else { return };
        let Some([left, top, right, bottom]) = self.window(view, &center, &axes, &block.half) else { return };
        let tile = f64::from(TILE);
        let row_length = right - left + 1;
        self.corners.clear();
        for row in top..=bottom {
            let b = (row as f64 * tile - k.cy) / k.fy;
            for column in left..=right {
                self.corners.push(slabs.enter((column as f64 * tile - k.cx) / k.fx, b));
            }
        }
        for row in top..bottom {
            for column in left..right {
                let at = (row - top) * row_length + column - left;
                let (above, below) =
                    (&self.corners[at..at + 2], &self.corners[at + row_length..at + row_length + 2]);
                let least = above[0].min(above[1]).min(below[0].min(below[1]));
                if least > 0.0 {
                    let known = &mut self.tiles[row * self.across + column];
                    *known = known.max(least);
                    self.any = true;
                }
            }
        }
    }

    /// The corners of tiles between which a box is: left, top, right, bottom; none if it holds no tile.
    fn window(
        &self,
        view: &View,
        center: &Vector3,
        axes: &Matrix3<f64>,
        half: &Vector3,
    ) -> Option<[usize; 4]> {
        let k = &view.intrinsics;
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for corner in 0..8 {
            let sign = |bit: u32| if corner >> bit & 1 == 0 { -1.0 } else { 1.0 };
            let at = center + axes * Vector3::new(sign(0) * half.x, sign(1) * half.y, sign(2) * half.z);
            if at.z <= view.near {
                // It may be anywhere.
                (low, high) = ([f64::NEG_INFINITY; 2], [f64::INFINITY; 2]);
                break;
            }
            let pixel = [k.fx * at.x / at.z + k.cx, k.fy * at.y / at.z + k.cy];
            for axis in 0..2 {
                low[axis] = low[axis].min(pixel[axis]);
                high[axis] = high[axis].max(pixel[axis]);
            }
        }
        let tile = f64::from(TILE);
        let most = [self.across as f64, self.down as f64];
        let first: [usize; 2] =
            std::array::from_fn(|axis| (low[axis] / tile).floor().clamp(0.0, most[axis]) as usize);
        let last: [usize; 2] =
            std::array::from_fn(|axis| (high[axis] / tile).ceil().clamp(0.0, most[axis]) as usize);
        (first[0] < last[0] && first[1] < last[1]).then_some([first[0], first[1], last[0], last[1]])
    }

    /// Whether a ball is behind what covers the picture wherever it is on it; its centre is relative to the eye.
    pub(crate) fn hides(&self, view: &View, center: &Vector3, radius: f64) -> bool {
        if !self.any {
            return false;
        }
        let k = &view.intrinsics;
        let at = view.optical_from_world * center;
        let (near, far) = (at.z - radius, at.z + radius);
        if near <= view.near {
            return false;
        }
        let span = |across: f64, focal: f64, middle: f64, count: usize| {
            let (low, high) = (across - radius, across + radius);
            let low = focal * (low / near).min(low / far) + middle;
            let high = focal * (high / near).max(high / far) + middle;
            let clamped =
                |pixel: f64| (pixel / f64::from(TILE)).floor().clamp(0.0, count as f64 - 1.0) as usize;
            clamped(low - 1.0)..clamped(high + 1.0) + 1
        };
        let (columns, rows) = (span(at.x, k.fx, k.cx, self.across), span(at.y, k.fy, k.cy, self.down));
        let limit = SLACK / near;
        rows.into_iter().all(|row| {
            let start = row * self.across;
            self.tiles[start + columns.start..start + columns.end].iter().all(|inverse| *inverse > limit)
        })
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use simworld_core::camera::{Camera, Intrinsics};
    use simworld_core::geometry::pose_facing;

    use super::*;

    fn view() -> View {
        let intrinsics = Intrinsics { width: 120, height: 90, fx: 70.0, fy: 75.0, cx: 55.0, cy: 40.0 };
        let pose = pose_facing(Point3::new(3.0, -2.0, 1.7), 0.4);
        View::new(&Camera::looking_along(&pose, intrinsics), 0.05, 500.0, 4096).expect("a sound camera")
    }

    /// Where the way to a point comes into a block, as a share of the way.
    fn enter(eye: &Point3, towards: &Vector3, block: &Block) -> Option<f64> {
        let from = block.turn.inverse() * (eye - block.center);
        let along = block.turn.inverse() * towards;
        let (mut first, mut last) = (f64::NEG_INFINITY, f64::INFINITY);
        for axis in 0..3 {
            let [a, b] = [-1.0, 1.0].map(|side| (side * block.half[axis] - from[axis]) / along[axis]);
            (first, last) = (first.max(a.min(b)), last.min(a.max(b)));
        }
        (first <= last && first > 0.0).then_some(first)
    }

    #[test]
    fn a_wall_hides_what_is_behind_it_and_nothing_else() {
        let view = view();
        let ahead = view.forward();
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), 0.4);
        let wall = Block { center: view.eye + ahead * 20.0, half: Vector3::new(0.5, 8.0, 6.0), turn };
        let mut occlusion = Occlusion::default();
        occlusion.begin(&view);
        assert!(!occlusion.hides(&view, &(ahead * 60.0), 1.0), "nothing covers the picture yet");
        occlusion.cover(&view, &wall);
        assert!(occlusion.hides(&view, &(ahead * 60.0), 1.0), "behind the wall");
        assert!(!occlusion.hides(&view, &(ahead * 10.0), 1.0), "before the wall");
        assert!(!occlusion.hides(&view, &(ahead * 20.0), 8.0), "the wall itself");
        assert!(!occlusion.hides(&view, &(ahead * 60.0), 40.0), "larger than the wall looks");
    }

    proptest! {
        /// Whatever a ball's points are that lie on the picture, a block is before each of them.
        #[test]
        fn what_is_hidden_is_behind_a_block(
            blocks in prop::collection::vec((4.0..60.0f64, -20.0..20.0f64, 0.5..9.0f64, 1.0..15.0f64, 0.0..3.0f64), 1..5),
            balls in prop::collection::vec((2.0..120.0f64, -30.0..30.0f64, -6.0..12.0f64, 0.05..4.0f64), 40),
            points in prop::collection::vec((-1.0..1.0f64, -1.0..1.0f64, -1.0..1.0f64), 12),
        ) {
            let view = view();
            let mut occlusion = Occlusion::default();
            occlusion.begin(&view);
            let blocks: Vec<Block> = blocks.into_iter().map(|(x, y, wide, high, yaw)| Block {
                center: Point3::new(x, y, high - 2.0),
                half: Vector3::new(wide * 0.4, wide, high),
                turn: UnitQuaternion::from_axis_angle(&Vector3::z_axis(), yaw),
            }).collect();
            for block in &blocks {
                occlusion.cover(&view, block);
            }
            for (x, y, z, radius) in balls {
                let center = Point3::new(x, y, z) - view.eye;
                if !occlusion.hides(&view, &center, radius) {
                    continue;
                }
                for (dx, dy, dz) in &points {
                    let shift = Vector3::new(*dx, *dy, *dz);
                    let towards = center + shift * (radius / shift.norm().max(1.0));
                    let optical = view.optical_from_world * towards;
                    let Some((pixel, _)) = view.intrinsics.project(&optical.into()) else { continue };
                    if !(0.0..=120.0).contains(&pixel.x) || !(0.0..=90.0).contains(&pixel.y) {
                        continue;
                    }
                    let before = blocks.iter().filter_map(|block| enter(&view.eye, &towards, block));
                    prop_assert!(before.fold(f64::INFINITY, f64::min) < 1.0, "{pixel} of a ball at {center}");
                }
            }
        }
    }
}
