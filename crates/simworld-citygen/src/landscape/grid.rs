//! The land while it is being shaped: heights on a grid into which ways are cut and pads are laid.

use rayon::prelude::*;
use simworld_core::geometry::{Point2, Point3, Vector2};
use simworld_core::ground::{Cover, Ground, GroundData, GroundError};

use crate::terrain::HeightField;

/// Between grid points, m.
pub(super) const SPACING: f64 = 2.5;
/// How far from a way or a pad the land comes back to what it was, m.
const BLEND: f64 = 7.0;

/// Heights and covers of a square of land around the origin; the water stands at 0.
#[derive(Clone, Debug)]
pub(super) struct Grid {
    /// From the middle to the edge, m.
    pub(super) half: f64,
    /// Points along a side.
    pub(super) side: usize,
    pub(super) heights: Vec<f64>,
    pub(super) covers: Vec<Cover>,
    /// What ways and pads have given its height; nothing changes it any more.
    pub(super) made: Vec<bool>,
}

impl Grid {
    /// Land of these heights; which thread reckons which row does not matter.
    pub(super) fn shaped(half: f64, height: impl Fn(Point2) -> f64 + Sync) -> Self {
        let side = (2.0 * half / SPACING).ceil() as usize + 1;
        let half = (side - 1) as f64 * SPACING * 0.5;
        let place = |index: usize| {
            Point2::new((index % side) as f64 * SPACING - half, (index / side) as f64 * SPACING - half)
        };
        let heights: Vec<f64> = (0..side * side).into_par_iter().map(|index| height(place(index))).collect();
        let covers = vec![Cover::Grass; heights.len()];
        let made = vec![false; heights.len()];
        Self { half, side, heights, covers, made }
    }

    /// Where a grid point is, m.
    pub(super) fn place(&self, index: usize) -> Point2 {
        let (column, row) = (index % self.side, index / self.side);
        Point2::new(column as f64 * SPACING - self.half, row as f64 * SPACING - self.half)
    }

    /// The grid point nearest to a place.
    pub(super) fn nearest(&self, place: Point2) -> usize {
        let along = |x: f64| ((x + self.half) / SPACING).round().clamp(0.0, (self.side - 1) as f64) as usize;
        along(place.y) * self.side + along(place.x)
    }

    /// Whether a place is on the land, farther than `margin` m from its edge.
    pub(super) fn holds(&self, place: Point2, margin: f64) -> bool {
        place.x.abs() <= self.half - margin && place.y.abs() <= self.half - margin
    }

    /// How steep it is at a place, rise over run.
    pub(super) fn slope(&self, place: Point2) -> f64 {
        let rise = |way: Vector2| self.height(place + way) - self.height(place - way);
        let (east, north) = (rise(Vector2::new(SPACING, 0.0)), rise(Vector2::new(0.0, SPACING)));
        (east * east + north * north).sqrt() / (2.0 * SPACING)
    }

    /// Whether a way or a pad is within so many metres of a place.
    pub(super) fn is_made_near(&self, place: Point2, reach: f64) -> bool {
        // Never so near that there is no grid point to ask.
        let reach = reach.max(SPACING * std::f64::consts::FRAC_1_SQRT_2 + 1e-6);
        self.around(place, place, reach)
            .any(|index| self.made[index] && (self.place(index) - place).norm() <= reach)
    }

    /// Grid points of a rectangle with a margin, row by row.
    fn around(&self, a: Point2, b: Point2, margin: f64) -> impl Iterator<Item = usize> + use<> {
        let (side, half, last) = (self.side, self.half, (self.side - 1) as f64);
        let along = move |x: f64| ((x + half) / SPACING).clamp(0.0, last);
        let (low, high) = (a.inf(&b), a.sup(&b));
        let columns = along(low.x - margin).ceil() as usize..=along(high.x + margin).floor() as usize;
        let rows = along(low.y - margin).ceil() as usize..=along(high.y + margin).floor() as usize;
        rows.flat_map(move |row| columns.clone().map(move |column| row * side + column))
    }

    /// Cuts ways into the land: level across for `reach` m to both sides and a cell more, so that every triangle under a way
    /// lies in it; then back to the land.
    pub(super) fn lay(&mut self, lines: &[Vec<Point3>], reach: f64, cover: Cover) {
        let wide = reach + SPACING * std::f64::consts::SQRT_2;
        let mut nearest: Vec<(f64, f64)> = vec![(f64::INFINITY, 0.0); self.heights.len()];
        for piece in lines.iter().flat_map(|line| line.windows(2)) {
            let (a, way) = (piece[0].xy(), piece[1].xy() - piece[0].xy());
            for index in self.around(a, piece[1].xy(), wide + BLEND) {
                let place = self.place(index);
                let share = ((place - a).dot(&way) / way.norm_squared().max(1e-12)).clamp(0.0, 1.0);
                let distance = (place - (a + way * share)).norm();
                if distance < nearest[index].0 {
                    nearest[index] = (distance, piece[0].z + (piece[1].z - piece[0].z) * share);
                }
            }
        }
        self.form(&nearest, (reach, wide), cover);
    }

    /// Lays a level pad: an oriented rectangle by its middle, its half sides and its first direction.
    pub(super) fn pad(&mut self, middle: Point3, half: Vector2, along: Vector2, cover: Cover) {
        let across = Vector2::new(-along.y, along.x);
        let reach = half.norm() + BLEND + 2.0 * SPACING;
        let mut nearest: Vec<(f64, f64)> = vec![(f64::INFINITY, 0.0); self.heights.len()];
        for index in self.around(middle.xy(), middle.xy(), reach) {
            let off = self.place(index) - middle.xy();
            let out = Vector2::new(off.dot(&along).abs(), off.dot(&across).abs()) - half;
            nearest[index] = (out.sup(&Vector2::zeros()).norm(), middle.z);
        }
        self.form(&nearest, (0.5, SPACING * std::f64::consts::SQRT_2), cover);
    }

    /// Gives points the heights that something near wants, by the distance to it and that height.
    fn form(&mut self, nearest: &[(f64, f64)], (painted, wide): (f64, f64), cover: Cover) {
        for (index, (distance, height)) in nearest.iter().enumerate() {
            if self.made[index] || *distance > wide + BLEND {
                continue;
            }
            let share = ((distance - wide) / BLEND).clamp(0.0, 1.0);
            let share = share * share * (3.0 - 2.0 * share);
            self.heights[index] = height + (self.heights[index] - height) * share;
            self.made[index] = *distance <= wide;
            // A narrow way is seen where the next point is.
            if *distance <= painted.max(SPACING * 0.6) {
                self.covers[index] = cover;
            }
        }
    }

    /// Parts of the grid whose points are all wet, or all dry, from their lowest index on: the number of each point's part
    /// and how many points each has.
    pub(super) fn parts(&self) -> (Vec<u32>, Vec<usize>) {
        let mut part = vec![u32::MAX; self.heights.len()];
        let mut sizes = Vec::new();
        let mut open = Vec::new();
        for first in 0..part.len() {
            if part[first] != u32::MAX {
                continue;
            }
            let (number, wet) = (sizes.len() as u32, self.heights[first] < 0.0);
            part[first] = number;
            open.push(first);
            let mut size = 0;
            while let Some(at) = open.pop() {
                size += 1;
                let (column, row) = (at % self.side, at / self.side);
                let beside = [
                    (column > 0).then(|| at - 1),
                    (column + 1 < self.side).then(|| at + 1),
                    (row > 0).then(|| at - self.side),
                    (row + 1 < self.side).then(|| at + self.side),
                ];
                for next in beside.into_iter().flatten() {
                    if part[next] == u32::MAX && (self.heights[next] < 0.0) == wet {
                        part[next] = number;
                        open.push(next);
                    }
                }
            }
            sizes.push(size);
        }
        (part, sizes)
    }

    /// Leaves water only where it hangs together with one of some places, and land only where it hangs together with the
    /// largest: puddles are filled, islets drowned.
    pub(super) fn settle_water(&mut self, waters: &[Point2]) {
        let (part, _) = self.parts();
        let kept: Vec<u32> = waters.iter().map(|place| part[self.nearest(*place)]).collect();
        for (height, part) in self.heights.iter_mut().zip(&part) {
            if *height < 0.0 && !kept.contains(part) {
                *height = 0.3;
            }
        }
        let (part, sizes_now) = self.parts();
        let dry = |number: usize| part.iter().position(|own| *own as usize == number);
        let is_dry: Vec<bool> = (0..sizes_now.len())
            .map(|number| dry(number).is_some_and(|at| self.heights[at] >= 0.0))
            .collect();
        let largest = (0..sizes_now.len())
            .filter(|number| is_dry[*number])
            .max_by_key(|number| (sizes_now[*number], std::cmp::Reverse(*number)));
        for (height, part) in self.heights.iter_mut().zip(&part) {
            if *height >= 0.0 && largest != Some(*part as usize) {
                *height = -0.8;
            }
        }
    }

    /// The finished ground.
    pub(super) fn ground(&self) -> Result<Ground, GroundError> {
        Ground::new(GroundData {
            origin: Point2::new(-self.half, -self.half),
            spacing: SPACING,
            columns: self.side as u32,
            rows: self.side as u32,
            heights: self.heights.iter().map(|height| *height as f32).collect(),
            covers: self.covers.clone(),
            water: Some(0.0),
        })
    }
}

/// By the same two triangles a cell as the finished ground.
impl HeightField for Grid {
    fn height(&self, place: Point2) -> f64 {
        let most = (self.side - 2) as f64;
        let local = (place - Point2::new(-self.half, -self.half)) / SPACING;
        let (west, south) = (local.x.clamp(0.0, most).floor(), local.y.clamp(0.0, most).floor());
        let (along, up) = ((local.x - west).clamp(0.0, 1.0), (local.y - south).clamp(0.0, 1.0));
        let at = |column: usize, row: usize| {
            self.heights[(south as usize + row) * self.side + west as usize + column]
        };
        let (a, c) = (at(0, 0), at(1, 1));
        if along >= up {
            a + (at(1, 0) - a) * along + (c - at(1, 0)) * up
        } else {
            a + (at(0, 1) - a) * up + (c - at(0, 1)) * along
        }
    }
}
