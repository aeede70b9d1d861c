//! What is taken: convex outlines in the plane, and an exact answer to whether another one is free of them.
//!
//! The broad phase is a uniform grid wrapped round a torus. So the grid needs no bounds, memory follows the number of
//! outlines and not the area, and what lies near in the plane lies near in memory. Cells that share a slot are far apart;
//! their outlines are sorted out by their bounds. The narrow phase is the separating-axis test on the outlines themselves.

mod outlines;
mod roads;
pub(crate) use roads::intersection_walk;
mod slots;

use outlines::{Outline, Outlines};
use simworld_core::geometry::{Obb, Point2, Vector2};
use slots::{Bounds, Cells, Slots};

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
    outlines: Outlines,
    slots: Slots,
}

impl Default for Occupancy {
    fn default() -> Self {
        Self::with_capacity(0)
    }
}

impl Occupancy {
    /// Empty, with room for so many outlines.
    pub fn with_capacity(outlines: usize) -> Self {
        Self { outlines: Outlines::with_capacity(outlines), slots: Slots::with_capacity(outlines) }
    }

    /// Empty, for the land of some roads that is so many outlines, and with room for what will stand along them: to move all
    /// of them to where there is more room takes long.
    fn with_land(outlines: usize) -> Self {
        let more = outlines / 4 * 3;
        Self { outlines: Outlines::with_capacity(outlines + more), slots: Slots::with_capacity(outlines) }
    }

    /// Makes room for so many more outlines at once. What more of them do to the slots is seen when they come: many lie in
    /// cells that are in use already.
    pub fn reserve(&mut self, outlines: usize) {
        self.outlines.reserve(outlines);
    }

    /// The number of outlines.
    pub fn len(&self) -> usize {
        self.outlines.len()
    }

    /// Whether nothing is taken.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Takes a convex outline, its corners in order, either way round.
    pub fn add(&mut self, outline: &[Point2]) {
        if let Some(bounds) = bounds(outline) {
            self.put(&Outline::of(outline), Cells::of(bounds).as_ref());
        }
    }

    /// Takes an outline that touches some cells, or too many.
    fn put(&mut self, outline: &Outline<'_>, cells: Option<&Cells>) {
        let number = self.outlines.push(outline);
        self.slots.file(number, cells);
        if self.slots.is_full() {
            // Four times the slots.
            self.refile(4 * self.slots.len());
        }
    }

    /// Files every outline anew, in slots enough for so many.
    fn refile(&mut self, outlines: usize) {
        self.slots = Slots::with_capacity(outlines);
        for number in self.outlines.numbers() {
            if let Some(bounds) = bounds(self.outlines.get(number).corners()) {
                self.slots.file(number, Cells::of(bounds).as_ref());
            }
        }
    }

    /// Takes the footprint of an upright box.
    pub fn add_box(&mut self, obb: &Obb) {
        self.add(&obb.footprint());
    }

    /// Whether a convex outline shares no interior point with what is taken.
    pub fn is_free(&self, outline: &[Point2]) -> bool {
        bounds(outline).is_none_or(|bounds| {
            self.is_free_within(&Outline::of(outline), bounds, Cells::of(bounds).as_ref())
        })
    }

    #[inline]
    fn is_free_within(&self, outline: &Outline<'_>, bounds: Bounds, cells: Option<&Cells>) -> bool {
        let collides = |number| match (self.outlines.get(number), outline) {
            (Outline::Rectangle(taken), Outline::Rectangle(outline)) => {
                // What is in cells beside it is mostly near it: cells that share a slot are told apart last.
                rectangles_overlap(taken, outline) && are_near(taken, bounds)
            }
            (taken, outline) => {
                let taken = taken.corners();
                are_near(taken, bounds) && overlap(taken, outline.corners())
            }
        };
        !self.slots.any_near(cells, || self.outlines.numbers(), collides)
    }

    /// The outlines that may touch a box, each once, in the order in which they were taken but for rectangles, which come first.
    #[cfg(feature = "osm")]
    pub(crate) fn near(&self, low: Point2, high: Point2) -> Vec<&[Point2]> {
        let found = std::cell::RefCell::new(Vec::new());
        let note = |number| {
            found.borrow_mut().push(number);
            false
        };
        self.slots.any_near(Cells::of((low, high)).as_ref(), || self.outlines.numbers(), note);
        let mut numbers = found.into_inner();
        numbers.sort_unstable();
        numbers.dedup();
        let outlines = numbers.into_iter().map(|number| self.outlines.get(number).corners());
        outlines.filter(|outline| are_near(outline, (low, high))).collect()
    }

    /// Whether the footprint of an upright box shares no interior point with what is taken.
    pub fn is_free_box(&self, obb: &Obb) -> bool {
        self.is_free(&obb.footprint())
    }

    /// Takes an outline if it is free; says whether it was.
    pub fn take(&mut self, outline: &[Point2]) -> bool {
        let Some(bounds) = bounds(outline) else { return true };
        let (outline, cells) = (Outline::of(outline), Cells::of(bounds));
        let free = self.is_free_within(&outline, bounds, cells.as_ref());
        if free {
            self.put(&outline, cells.as_ref());
        }
        free
    }
}

/// Whether the bounds of an outline share interior points with others.
#[inline]
fn are_near(taken: &[Point2], (low, high): Bounds) -> bool {
    let Some((taken_low, taken_high)) = bounds(taken) else { return false };
    !(taken_low.x >= high.x || low.x >= taken_high.x || taken_low.y >= high.y || low.y >= taken_high.y)
}

/// The lesser of two numbers, without the look for NaN of [`f64::min`].
#[inline]
pub(crate) fn least(a: f64, b: f64) -> f64 {
    if b < a { b } else { a }
}

/// The greater of two numbers, without the look for NaN of [`f64::max`].
#[inline]
pub(crate) fn most(a: f64, b: f64) -> f64 {
    if b > a { b } else { a }
}

/// The least and the greatest corner around some points.
#[inline]
fn bounds(points: &[Point2]) -> Option<Bounds> {
    let (first, rest) = points.split_first()?;
    Some(rest.iter().fold((*first, *first), |(low, high), point| {
        (
            Point2::new(least(low.x, point.x), least(low.y, point.y)),
            Point2::new(most(high.x, point.x), most(high.y, point.y)),
        )
    }))
}

/// Whether two convex outlines share interior points, by the separating-axis test (Gottschalk and others 1996).
pub fn overlap(a: &[Point2], b: &[Point2]) -> bool {
    !(has_separating_edge(a, b) || has_separating_edge(b, a))
}

/// The same of two rectangles.
#[inline]
fn rectangles_overlap(a: &[Point2; 4], b: &[Point2; 4]) -> bool {
    !(has_separating_side(a, b) || has_separating_side(b, a))
}

/// Whether the line through some edge of `a` has `a` on one side and `b` on the other.
fn has_separating_edge(a: &[Point2], b: &[Point2]) -> bool {
    if let Outline::Rectangle(a) = Outline::of(a) {
        return has_separating_side(a, b);
    }
    (0..a.len()).any(|index| {
        let along = a[(index + 1) % a.len()] - a[index];
        separates(&Vector2::new(-along.y, along.x), a, b)
    })
}

/// The same of a rectangle. Each of its sides is a normal of the next: two say all, and say the same as
/// `footprints_overlap`.
#[inline]
fn has_separating_side(a: &[Point2; 4], b: &(impl AsRef<[Point2]> + ?Sized)) -> bool {
    separates(&(a[0] - a[1]), a, b.as_ref()) || separates(&(a[1] - a[2]), a, b.as_ref())
}

/// Whether two outlines lie apart along an axis.
#[inline]
fn separates(axis: &Vector2, a: &[Point2], b: &[Point2]) -> bool {
    let ((a_low, a_high), (b_low, b_high)) = (span(a, axis), span(b, axis));
    a_low >= b_high || b_low >= a_high
}

#[inline]
fn span(points: &[Point2], axis: &Vector2) -> (f64, f64) {
    let at = |point: &Point2| point.x * axis.x + point.y * axis.y;
    if let [a, b, c, d] = points {
        // In pairs: no comparison waits for all those before.
        let [a, b, c, d] = [a, b, c, d].map(at);
        return (least(least(a, b), least(c, d)), most(most(a, b), most(c, d)));
    }
    points
        .iter()
        .map(at)
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), at| (least(low, at), most(high, at)))
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
        let period = slots::least_period();
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
