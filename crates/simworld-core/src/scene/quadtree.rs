//! A loose quadtree over the plane: the hierarchy, level-of-detail and streaming structure of a world.
//!
//! Every entry lives in exactly one cell: the level follows from its size alone (the smallest cell at least as
//! wide as the entry), the cell from its centre. A cell is therefore responsible for entries that reach at most
//! half a cell beyond its border ("loose", Thatcher Ulrich 2000), an entry that moves within its cell costs
//! nothing, and the tree's shape, hence the order of every visit, does not depend on the history of insertions.
//! Nodes are never freed: their number is bounded by the area ever occupied. The smallest cells have none: what is in them
//! lies in the node above, cell by cell, for most of them hold one thing or two.

use std::ops::{ControlFlow, Range};

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
    /// Entries of this cell, and behind them those of each quarter that has no node; each part ascends.
    entries: SmallVec<[u32; 6]>,
    /// Where all parts but the last end.
    ends: [u32; 4],
    /// The first of its four quarters, which lie side by side: who looks at one looks at all of them. `NONE` if they have no node.
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
        Self {
            entries: SmallVec::new_const(),
            ends: [0; 4],
            quarters: NONE,
            occupied: 0,
            parent,
            inhabited: 0,
        }
    }

    /// Where the entries of a part lie: those of the cell itself are part zero, those of its quarters the next four.
    fn range(&self, part: usize) -> Range<usize> {
        let end = |part: usize| self.ends.get(part).map_or(self.entries.len(), |end| *end as usize);
        part.checked_sub(1).map_or(0, end)..end(part)
    }

    fn insert(&mut self, entry: u32, part: usize) {
        let range = self.range(part);
        if let Err(position) = self.entries[range.clone()].binary_search(&entry) {
            self.entries.insert(range.start + position, entry);
            self.ends[part.min(4)..].iter_mut().for_each(|end| *end += 1);
            self.mark(part);
        }
    }

    fn remove(&mut self, entry: u32, part: usize) {
        let range = self.range(part);
        if let Ok(position) = self.entries[range.clone()].binary_search(&entry) {
            self.entries.remove(range.start + position);
            self.ends[part.min(4)..].iter_mut().for_each(|end| *end -= 1);
            self.mark(part);
        }
    }

    /// Notes whether there is an entry in a quarter without a node.
    fn mark(&mut self, part: usize) {
        if let Some(quadrant) = part.checked_sub(1) {
            self.set_inhabited(quadrant as u32, !self.range(part).is_empty());
        }
    }

    fn set_inhabited(&mut self, quadrant: u32, is_inhabited: bool) {
        let bit = 1 << quadrant;
        self.inhabited = if is_inhabited { self.inhabited | bit } else { self.inhabited & !bit };
    }
}

/// Where an entry is filed: in which node, and in which part of it.
#[derive(Clone, Copy, Debug)]
struct Home {
    node: u32,
    part: u8,
}

const NOWHERE: Home = Home { node: NONE, part: 0 };

/// The tree over entries numbered by the caller; each entry brings its box.
#[derive(Clone, Debug)]
pub(crate) struct Quadtree {
    nodes: Vec<Node>,
    /// Where each of them is: those who move ask, and visits do not.
    cells: Vec<Cell>,
    /// Where each entry is, `NOWHERE` if absent.
    home: Vec<Home>,
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
            self.home.resize(index + 1, NOWHERE);
        }
        let extent = planar_extent(bounds);
        let center = bounds.center();
        let old = self.home[index];
        if old.node != NONE && self.is_home(old, extent, &center) {
            return;
        }
        self.remove(entry);
        let home = self.find_or_make(extent, &center);
        self.nodes[home.node as usize].insert(entry, usize::from(home.part));
        self.home[index] = home;
        self.count(home.node, 1);
    }

    /// Takes an entry out; nothing happens if it is not in.
    pub(crate) fn remove(&mut self, entry: u32) {
        let Some(home) = self.home.get_mut(entry as usize) else { return };
        let home = std::mem::replace(home, NOWHERE);
        if home.node == NONE {
            return;
        }
        self.nodes[home.node as usize].remove(entry, usize::from(home.part));
        self.count(home.node, -1);
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
        node.entries[node.range(0)].iter().try_for_each(|entry| visitor(*entry))?;
        if node.inhabited == 0 || cell.width * 0.5 < min_extent {
            return ControlFlow::Continue(());
        }
        for quadrant in 0..4 {
            // A quarter that is empty or too far away is not even looked up.
            if node.inhabited & 1 << quadrant == 0 {
                continue;
            }
            let quarter = cell.quarter(quadrant);
            if !quarter.reaches(region) {
                continue;
            }
            if node.quarters == NONE {
                node.entries[node.range(quadrant + 1)].iter().try_for_each(|entry| visitor(*entry))?;
            } else {
                self.visit_node(node.quarters + quadrant as u32, &quarter, region, min_extent, visitor)?;
            }
        }
        ControlFlow::Continue(())
    }

    /// Whether an entry of that extent and centre belongs to this very cell.
    fn is_home(&self, home: Home, extent: f64, center: &Point3) -> bool {
        let above = &self.cells[home.node as usize];
        let cell = usize::from(home.part).checked_sub(1).map_or(*above, |quadrant| above.quarter(quadrant));
        let half = cell.width * 0.5;
        let inside = |offset: f64| -half <= offset && offset < half;
        extent <= cell.width
            && (extent > half || half < SMALLEST_CELL)
            && inside(center.x - cell.center.x)
            && inside(center.y - cell.center.y)
    }

    fn find_or_make(&mut self, extent: f64, center: &Point3) -> Home {
        let mut node = 0;
        loop {
            let cell = self.cells[node as usize];
            let half = cell.width * 0.5;
            if extent > half || half < SMALLEST_CELL {
                return Home { node, part: 0 };
            }
            let quadrant = cell.quadrant(center);
            if half * 0.5 < SMALLEST_CELL {
                return Home { node, part: quadrant as u8 + 1 };
            }
            if self.nodes[node as usize].quarters == NONE {
                let first = u32::try_from(self.nodes.len()).expect("fewer than 2^32 cells fit in memory");
                self.nodes.extend((0..4).map(|_| Node::new(node)));
                self.cells.extend((0..4).map(|quadrant| cell.quarter(quadrant)));
                self.nodes[node as usize].quarters = first;
            }
            node = self.nodes[node as usize].quarters + quadrant as u32;
        }
    }

    fn count(&mut self, mut node: u32, change: i32) {
        while node != NONE {
            let entry = &mut self.nodes[node as usize];
            entry.occupied = entry.occupied.wrapping_add_signed(change);
            let (parent, is_inhabited) = (entry.parent, entry.occupied > 0);
            if parent != NONE {
                let above = &mut self.nodes[parent as usize];
                above.set_inhabited(node - above.quarters, is_inhabited);
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
