//! A loose quadtree over the plane: the hierarchy, level-of-detail and streaming structure of a world.
//!
//! Every entry lives in exactly one cell: the level follows from its size alone (the smallest cell at least as
//! wide as the entry), the cell from its centre. A cell is therefore responsible for entries that reach at most
//! half a cell beyond its border ("loose", Thatcher Ulrich 2000), an entry that moves within its cell costs
//! nothing, and the tree's shape, hence the order of every visit, does not depend on the history of insertions.
//! Nodes are never freed: their number is bounded by the area ever occupied.

use std::ops::ControlFlow;

use smallvec::SmallVec;

use crate::geometry::{Aabb, Point2, Point3};

const NONE: u32 = u32::MAX;
/// Width of the smallest cell, m: a few people or one car.
const SMALLEST_CELL: f64 = 8.0;
/// Width of the tree at the start, m; it doubles when an entry lies outside.
const FIRST_WIDTH: f64 = 32_768.0;

/// Where a node is.
#[derive(Clone, Copy, Debug)]
struct Cell {
    center: Point2,
    width: f64,
}

impl Cell {
    /// Whether an entry of this cell or below may touch the region.
    fn reaches(&self, region: &Aabb) -> bool {
        let reach = self.width; // half the cell, and half a cell more
        self.center.x - reach <= region.max.x
            && region.min.x <= self.center.x + reach
            && self.center.y - reach <= region.max.y
            && region.min.y <= self.center.y + reach
    }

    /// One of its quarters: south-west, south-east, north-west, north-east.
    fn quarter(&self, quadrant: usize) -> Self {
        let (width, shift) = (self.width * 0.5, self.width * 0.25);
        let toward = |is_upper: bool| if is_upper { shift } else { -shift };
        let (east, north) = (toward(quadrant & 1 == 1), toward(quadrant & 2 == 2));
        Self { center: Point2::new(self.center.x + east, self.center.y + north), width }
    }

    /// The quarter in which a place is.
    fn quadrant(&self, place: &Point3) -> usize {
        usize::from(place.x >= self.center.x) + 2 * usize::from(place.y >= self.center.y)
    }
}

/// What a visit reads of a node; where the node is follows from the way down to it.
#[derive(Clone, Debug)]
#[repr(align(64))]
struct Node {
    /// Entries of this cell, ascending: those of most cells have their place within the node.
    entries: SmallVec<[u32; 8]>,
    /// The first of its four quarters, which lie side by side: who looks at one looks at all of them. `NONE` if it has none.
    quarters: u32,
    /// Entries of this cell and of all below.
    occupied: u32,
    parent: u32,
    /// A bit for each quarter in which there is an entry: the others are not looked up.
    inhabited: u8,
}

const _: () = assert!(size_of::<Node>() == 64, "a node fills one line of memory");

impl Node {
    const fn new(parent: u32) -> Self {
        Self { entries: SmallVec::new_const(), quarters: NONE, occupied: 0, parent, inhabited: 0 }
    }
}

/// The tree over entries numbered by the caller; each entry brings its box.
#[derive(Clone, Debug)]
pub(crate) struct Quadtree {
    nodes: Vec<Node>,
    /// Where each of them is: those who move ask, and visits do not.
    cells: Vec<Cell>,
    /// The node of each entry, `NONE` if absent.
    home: Vec<u32>,
}

impl Default for Quadtree {
    fn default() -> Self {
        Self::with_width(FIRST_WIDTH)
    }
}

impl Quadtree {
    /// An empty tree of that width, m, centred on the origin.
    pub(crate) fn with_width(width: f64) -> Self {
        let cell = Cell { center: Point2::origin(), width };
        Self { nodes: vec![Node::new(NONE)], cells: vec![cell], home: Vec::new() }
    }

    /// The width of the whole tree, m; part of a snapshot, because the order of visits depends on it.
    pub(crate) fn width(&self) -> f64 {
        self.cells[0].width
    }

    /// Whether the box can be filed without growing the tree.
    pub(crate) fn holds(&self, bounds: &Aabb) -> bool {
        let center = bounds.center();
        let half = self.width() * 0.5;
        center.x.abs() <= half && center.y.abs() <= half && planar_extent(bounds) <= self.width()
    }

    /// Files an entry, or files it anew after it moved. The box must be [held](Self::holds).
    pub(crate) fn place(&mut self, entry: u32, bounds: &Aabb) {
        let index = entry as usize;
        if index >= self.home.len() {
            self.home.resize(index + 1, NONE);
        }
        let extent = planar_extent(bounds);
        let center = bounds.center();
        let old = self.home[index];
        if old != NONE && self.is_home(old, extent, &center) {
            return;
        }
        self.remove(entry);
        let node = self.find_or_make(extent, &center);
        let entries = &mut self.nodes[node as usize].entries;
        if let Err(position) = entries.binary_search(&entry) {
            entries.insert(position, entry);
        }
        self.home[index] = node;
        self.count(node, 1);
    }

    /// Takes an entry out; nothing happens if it is not in.
    pub(crate) fn remove(&mut self, entry: u32) {
        let Some(home) = self.home.get_mut(entry as usize) else { return };
        let node = std::mem::replace(home, NONE);
        if node == NONE {
            return;
        }
        let entries = &mut self.nodes[node as usize].entries;
        if let Ok(position) = entries.binary_search(&entry) {
            entries.remove(position);
        }
        self.count(node, -1);
    }

    /// Visits entries whose cell may touch the region and that may be at least `min_extent` wide, parents before
    /// children, quadrants south-west, south-east, north-west, north-east, entries ascending.
    pub(crate) fn visit<F>(&self, region: &Aabb, min_extent: f64, visitor: &mut F) -> ControlFlow<()>
    where
        F: FnMut(u32) -> ControlFlow<()>,
    {
        let root = &self.cells[0];
        let is_there = self.nodes[0].occupied > 0 && root.width >= min_extent && root.reaches(region);
        if is_there {
            self.visit_node(0, root, region, min_extent, visitor)
        } else {
            ControlFlow::Continue(())
        }
    }

    /// Visits a cell that the region reaches, and what is below.
    fn visit_node<F>(
        &self,
        node: u32,
        cell: &Cell,
        region: &Aabb,
        min_extent: f64,
        visitor: &mut F,
    ) -> ControlFlow<()>
    where
        F: FnMut(u32) -> ControlFlow<()>,
    {
        let node = &self.nodes[node as usize];
        for entry in &node.entries {
            visitor(*entry)?;
        }
        if node.inhabited == 0 || cell.width * 0.5 < min_extent {
            return ControlFlow::Continue(());
        }
        for quadrant in 0..4 {
            // A quarter that is empty or too far away is not even looked up.
            if node.inhabited & 1 << quadrant != 0 {
                let quarter = cell.quarter(quadrant);
                if quarter.reaches(region) {
                    self.visit_node(node.quarters + quadrant as u32, &quarter, region, min_extent, visitor)?;
                }
            }
        }
        ControlFlow::Continue(())
    }

    /// Whether an entry of that extent and centre belongs to this very node.
    fn is_home(&self, node: u32, extent: f64, center: &Point3) -> bool {
        let cell = &self.cells[node as usize];
        let half = cell.width * 0.5;
        let inside = |offset: f64| -half <= offset && offset < half;
        extent <= cell.width
            && (extent > half || half < SMALLEST_CELL)
            && inside(center.x - cell.center.x)
            && inside(center.y - cell.center.y)
    }

    fn find_or_make(&mut self, extent: f64, center: &Point3) -> u32 {
        let mut current = 0;
        loop {
            let cell = self.cells[current as usize];
            let half = cell.width * 0.5;
            if extent > half || half < SMALLEST_CELL {
                return current;
            }
            if self.nodes[current as usize].quarters == NONE {
                let first = u32::try_from(self.nodes.len()).expect("fewer than 2^32 cells fit in memory");
                self.nodes.extend((0..4).map(|_| Node::new(current)));
                self.cells.extend((0..4).map(|quadrant| cell.quarter(quadrant)));
                self.nodes[current as usize].quarters = first;
            }
            current = self.nodes[current as usize].quarters + cell.quadrant(center) as u32;
        }
    }

    fn count(&mut self, mut node: u32, change: i32) {
        while node != NONE {
            let entry = &mut self.nodes[node as usize];
            entry.occupied = entry.occupied.wrapping_add_signed(change);
            let (parent, is_inhabited) = (entry.parent, entry.occupied > 0);
            if parent != NONE {
                let above = &mut self.nodes[parent as usize];
                let bit = 1 << (node - above.quarters);
                above.inhabited = if is_inhabited { above.inhabited | bit } else { above.inhabited & !bit };
            }
            node = parent;
        }
    }
}

fn planar_extent(bounds: &Aabb) -> f64 {
    (bounds.max.x - bounds.min.x).max(bounds.max.y - bounds.min.y)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::geometry::Vector3;

    fn bounds(x: f64, y: f64, half: f64) -> Aabb {
        Aabb::around(Point3::new(x, y, 0.0), Vector3::repeat(half))
    }

    fn visited(tree: &Quadtree, region: &Aabb, min_extent: f64) -> Vec<u32> {
        let mut found = Vec::new();
        let _ = tree.visit(region, min_extent, &mut |entry| {
            found.push(entry);
            ControlFlow::Continue(())
        });
        found
    }

    proptest! {
        #[test]
        fn every_entry_that_touches_a_region_is_visited(
            boxes in prop::collection::vec((-9e3..9e3f64, -9e3..9e3f64, 0.1..900.0f64), 1..80),
            region in (-9e3..9e3f64, -9e3..9e3f64, 1.0..4e3f64),
        ) {
            let mut tree = Quadtree::default();
            for (entry, (x, y, half)) in boxes.iter().enumerate() {
                tree.place(entry as u32, &bounds(*x, *y, *half));
            }
            let region = bounds(region.0, region.1, region.2);
            let found = visited(&tree, &region, 0.0);
            for (entry, (x, y, half)) in boxes.iter().enumerate() {
                if bounds(*x, *y, *half).intersects(&region) {
                    prop_assert!(found.contains(&(entry as u32)));
                }
            }
        }

        #[test]
        fn the_order_of_visits_forgets_the_history(
            boxes in prop::collection::vec((-9e3..9e3f64, -9e3..9e3f64, 0.1..90.0f64), 1..40),
        ) {
            let (mut straight, mut wandering) = (Quadtree::default(), Quadtree::default());
            for (entry, (x, y, half)) in boxes.iter().enumerate() {
                straight.place(entry as u32, &bounds(*x, *y, *half));
            }
            for (entry, (x, y, half)) in boxes.iter().enumerate().rev() {
                wandering.place(entry as u32, &bounds(-y, *x, half * 3.0));
                wandering.place(entry as u32, &bounds(*x, *y, *half));
            }
            let everywhere = bounds(0.0, 0.0, 2e4);
            prop_assert_eq!(visited(&straight, &everywhere, 0.0), visited(&wandering, &everywhere, 0.0));
        }
    }

    #[test]
    fn levels_of_detail_skip_the_small() {
        let mut tree = Quadtree::default();
        tree.place(0, &bounds(10.0, 10.0, 0.3)); // a person
        tree.place(1, &bounds(12.0, 10.0, 30.0)); // a building
        assert_eq!(visited(&tree, &bounds(0.0, 0.0, 100.0), 32.0), [1]);
        tree.remove(1);
        assert_eq!(visited(&tree, &bounds(0.0, 0.0, 100.0), 0.0), [0]);
    }
}
