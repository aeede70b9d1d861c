//! What is taken: convex outlines in the plane, and an exact answer to whether another one is free of them.
//!
//! The broad phase is a uniform grid wrapped round a torus: a cell's slot is its column and row modulo a power of two.
//! So the grid needs no bounds, memory follows the number of outlines and not the area, and what lies near in the
//! plane lies near in memory. Cells that share a slot are far apart; their outlines are sorted out by their bounds.
//! The narrow phase is the separating-axis test on the outlines themselves.

mod roads;

use simworld_core::geometry::{Obb, Point2, Vector2};

/// Width of a grid cell, m: about two houses.
const CELL: f64 = 32.0;
/// The end of a chain.
const NONE: u32 = u32::MAX;
/// An outline as large as so many cells, or as long, is kept apart and tested every time.
const MOST_CELLS: f64 = 4096.0;
/// Slots along one side of an empty grid, as a power of two.
const FIRST_BITS: u32 = 5;
/// Slots along one side of the largest grid, as a power of two.
const MOST_BITS: u32 = 14;

/// Convex outlines that must not overlap, indexed for exact tests. Touching edges do not overlap.
///
/// ```
/// use simworld_citygen::occupancy::Occupancy;
/// use simworld_core::geometry::Point2;
/// let square = |x: f64| [(0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0)].map(|(dx, y)| Point2::new(x + dx, y));
/// let mut taken = Occupancy::default();
/// taken.add(&square(0.0));
/// assert!(!taken.is_free(&square(8.9)) && taken.is_free(&square(9.0)));
/// ```
#[derive(Clone, Debug)]
pub struct Occupancy {
    items: Vec<Item>,
    corners: Vec<Point2>,
    /// The newest entry of each slot.
    heads: Vec<u32>,
    entries: Vec<Entry>,
    /// Outlines too large for the grid.
    large: Vec<u32>,
    bits: u32,
}

/// An outline: its bounds and where its corners are.
#[derive(Clone, Copy, Debug)]
struct Item {
    low: Point2,
    high: Point2,
    start: u32,
    count: u32,
}

/// An outline in one cell, and the entry before it in the same slot.
#[derive(Clone, Copy, Debug)]
struct Entry {
    item: u32,
    next: u32,
}

impl Default for Occupancy {
    fn default() -> Self {
        Self::with_capacity(0)
    }
}

impl Occupancy {
    /// Empty, with room for so many outlines.
    pub fn with_capacity(outlines: usize) -> Self {
        let bits = bits_for(outlines);
        Self {
            items: Vec::with_capacity(outlines),
            corners: Vec::with_capacity(4 * outlines),
            heads: vec![NONE; 1 << (2 * bits)],
            entries: Vec::with_capacity(2 * outlines),
            large: Vec::new(),
            bits,
        }
    }

    /// Makes room for so many more outlines at once.
    pub fn reserve(&mut self, outlines: usize) {
        self.items.reserve(outlines);
        self.corners.reserve(4 * outlines);
        self.entries.reserve(2 * outlines);
        let wanted = bits_for(self.items.len() + outlines);
        if wanted > self.bits {
            self.resize(wanted);
        }
    }

    /// The number of outlines.
    pub fn len(&self) -> usize {
        self.items.len()
    }

    /// Whether nothing is taken.
    pub fn is_empty(&self) -> bool {
        self.items.is_empty()
    }

    /// Takes a convex outline, its corners in order, either way round.
    pub fn add(&mut self, outline: &[Point2]) {
        let Some((low, high)) = bounds(outline) else { return };
        let item = Item { low, high, start: self.corners.len() as u32, count: outline.len() as u32 };
        self.corners.extend_from_slice(outline);
        self.items.push(item);
        self.file(self.items.len() as u32 - 1);
        if self.entries.len() > 2 * self.heads.len() && self.bits < MOST_BITS {
            self.resize(self.bits + 1);
        }
    }

    /// Takes the footprint of an upright box.
    pub fn add_box(&mut self, obb: &Obb) {
        self.add(&obb.footprint());
    }

    /// Whether a convex outline shares no interior point with what is taken.
    pub fn is_free(&self, outline: &[Point2]) -> bool {
        let Some((low, high)) = bounds(outline) else { return true };
        if self.large.iter().any(|item| self.collides(*item, low, high, outline)) {
            return false;
        }
        let Some(cells) = Cells::of(low, high) else {
            return (0..self.items.len() as u32).all(|item| !self.collides(item, low, high, outline));
        };
        for row in cells.rows.0..=cells.rows.1 {
            for column in cells.columns.0..=cells.columns.1 {
                let mut next = self.heads[self.slot(column, row)];
                while next != NONE {
                    let entry = self.entries[next as usize];
                    if self.collides(entry.item, low, high, outline) {
                        return false;
                    }
                    next = entry.next;
                }
            }
        }
        true
    }

    /// Whether the footprint of an upright box shares no interior point with what is taken.
    pub fn is_free_box(&self, obb: &Obb) -> bool {
        self.is_free(&obb.footprint())
    }

    /// Takes an outline if it is free; says whether it was.
    pub fn take(&mut self, outline: &[Point2]) -> bool {
        let free = self.is_free(outline);
        if free {
            self.add(outline);
        }
        free
    }

    #[inline]
    fn collides(&self, item: u32, low: Point2, high: Point2, outline: &[Point2]) -> bool {
        let item = self.items[item as usize];
        let apart =
            item.low.x >= high.x || low.x >= item.high.x || item.low.y >= high.y || low.y >= item.high.y;
        if apart {
            return false;
        }
        let start = item.start as usize;
        overlap(&self.corners[start..start + item.count as usize], outline)
    }

    #[inline]
    fn slot(&self, column: i64, row: i64) -> usize {
        let mask = (1_i64 << self.bits) - 1;
        (((row & mask) << self.bits) | (column & mask)) as usize
    }

    fn file(&mut self, index: u32) {
        let item = self.items[index as usize];
        let Some(cells) = Cells::of(item.low, item.high) else {
            self.large.push(index);
            return;
        };
        for row in cells.rows.0..=cells.rows.1 {
            for column in cells.columns.0..=cells.columns.1 {
                let slot = self.slot(column, row);
                self.entries.push(Entry { item: index, next: self.heads[slot] });
                self.heads[slot] = self.entries.len() as u32 - 1;
            }
        }
    }

    /// Another number of slots; every outline is filed anew, in order.
    fn resize(&mut self, bits: u32) {
        self.bits = bits;
        self.heads.clear();
        self.heads.resize(1 << (2 * self.bits), NONE);
        self.entries.clear();
        self.large.clear();
        for index in 0..self.items.len() as u32 {
            self.file(index);
        }
    }
}

/// Slots along one side for so many outlines, as a power of two.
fn bits_for(outlines: usize) -> u32 {
    let mut bits = FIRST_BITS;
    while bits < MOST_BITS && 1_usize << (2 * bits) < outlines {
        bits += 1;
    }
    bits
}

/// The cells that a rectangle touches.
struct Cells {
    columns: (i64, i64),
    rows: (i64, i64),
}

impl Cells {
    /// `None` if they are too many, or nowhere.
    #[inline]
    fn of(low: Point2, high: Point2) -> Option<Self> {
        let (width, height) = (high.x - low.x, high.y - low.y);
        let is_small = width * height <= MOST_CELLS * CELL * CELL && width.max(height) <= MOST_CELLS * CELL;
        if !is_small {
            return None;
        }
        // The floor, without the call into libm that the oldest processors need.
        let index = |x: f64| {
            let cell = x * (1.0 / CELL);
            let towards_zero = cell as i64;
            towards_zero - i64::from(towards_zero as f64 > cell)
        };
        Some(Self { columns: (index(low.x), index(high.x)), rows: (index(low.y), index(high.y)) })
    }
}

/// The least and the greatest corner around some points.
#[inline]
fn bounds(points: &[Point2]) -> Option<(Point2, Point2)> {
    let (first, rest) = points.split_first()?;
    Some(rest.iter().fold((*first, *first), |(low, high), point| {
        (
            Point2::new(low.x.min(point.x), low.y.min(point.y)),
            Point2::new(high.x.max(point.x), high.y.max(point.y)),
        )
    }))
}

/// Whether two convex outlines share interior points, by the separating-axis test (Gottschalk and others 1996).
pub fn overlap(a: &[Point2], b: &[Point2]) -> bool {
    !(has_separating_edge(a, b) || has_separating_edge(b, a))
}

/// Whether the line through some edge of `a` has `a` on one side and `b` on the other.
#[inline]
fn has_separating_edge(a: &[Point2], b: &[Point2]) -> bool {
    let separates = |axis: &Vector2| {
        let ((a_low, a_high), (b_low, b_high)) = (span(a, axis), span(b, axis));
        a_low >= b_high || b_low >= a_high
    };
    if is_rectangle(a) {
        // Each side of a rectangle is a normal of the next: two say all, and say the same as `footprints_overlap`.
        return separates(&(a[0] - a[1])) || separates(&(a[1] - a[2]));
    }
    (0..a.len()).any(|index| {
        let along = a[(index + 1) % a.len()] - a[index];
        separates(&Vector2::new(-along.y, along.x))
    })
}

/// Whether four corners are a rectangle, up to the rounding of coordinates a thousand kilometres out.
#[inline]
fn is_rectangle(outline: &[Point2]) -> bool {
    let [a, b, c, d] = outline else { return false };
    let (side, next) = (b - a, c - b);
    let skew = side - (c - d);
    let dot = side.dot(&next);
    skew.norm_squared() < 1e-18 && dot * dot < 1e-18 * side.norm_squared() * next.norm_squared()
}

#[inline]
fn span(points: &[Point2], axis: &Vector2) -> (f64, f64) {
    points.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), point| {
        let at = point.x * axis.x + point.y * axis.y;
        (if at < low { at } else { low }, if at > high { at } else { high })
    })
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use simworld_core::geometry::{Point3, Vector3, pose_facing};

    use super::*;

    fn rectangle(x: f64, y: f64, yaw: f64, length: f64, width: f64) -> Obb {
        let half_extents = Vector3::new(length * 0.5, width * 0.5, 1.0);
        Obb { pose: pose_facing(Point3::new(x, y, 0.0), yaw), half_extents }
    }

    fn boxes() -> impl Strategy<Value = Vec<Obb>> {
        let one = (-300.0..300.0_f64, -300.0..300.0_f64, -3.2..3.2_f64, 1.0..60.0_f64, 1.0..20.0_f64);
        prop::collection::vec(one.prop_map(|(x, y, yaw, l, w)| rectangle(x, y, yaw, l, w)), 1..120)
    }

    proptest! {
        #[test]
        fn the_index_agrees_with_testing_every_pair(boxes in boxes()) {
            let mut taken = Occupancy::default();
            for (index, obb) in boxes.iter().enumerate() {
                let expected = !boxes[..index].iter().any(|other| other.footprints_overlap(obb));
                prop_assert_eq!(taken.is_free_box(obb), expected, "box {}", index);
                taken.add_box(obb);
            }
        }
    }

    #[test]
    fn far_places_that_share_a_slot_do_not_meet() {
        let mut taken = Occupancy::default();
        let period = CELL * f64::from(1 << FIRST_BITS);
        taken.add_box(&rectangle(0.0, 0.0, 0.3, 10.0, 10.0));
        assert!(taken.is_free_box(&rectangle(period, -period, 0.3, 10.0, 10.0)));
        assert!(!taken.is_free_box(&rectangle(4.0, 4.0, 0.9, 10.0, 10.0)));
    }

    #[test]
    fn it_grows_and_remembers() {
        let mut taken = Occupancy::default();
        for index in 0..9000 {
            let (column, row) = (f64::from(index % 90), f64::from(index / 90));
            assert!(taken.take(&rectangle(column * 12.0, row * 12.0, 0.4, 8.0, 8.0).footprint()));
        }
        assert_eq!(taken.len(), 9000);
        assert!(!taken.is_free_box(&rectangle(0.0, 0.0, 1.0, 1.0, 1.0)));
        assert!(!taken.is_free_box(&rectangle(89.0 * 12.0, 99.0 * 12.0, 1.0, 1.0, 1.0)));
    }

    #[test]
    fn what_is_huge_is_still_seen() {
        let mut taken = Occupancy::default();
        taken.add_box(&rectangle(0.0, 0.0, 0.7, 1e6, 3.0));
        let along = simworld_core::geometry::direction(0.7) * 3e5;
        assert!(!taken.is_free_box(&rectangle(along.x, along.y, 0.0, 1.0, 1.0)));
        assert!(taken.is_free_box(&rectangle(along.x + 10.0, along.y - 10.0, 0.0, 1.0, 1.0)));
        assert!(!taken.is_free_box(&rectangle(0.0, 0.0, 0.0, 1e7, 1e7)));
    }
}
