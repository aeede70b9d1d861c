//! The streets grown so far: flat arrays, and a uniform grid that knows what is near.
//!
//! The grid is dense over the land of the city. Its lists are chained through arenas, so that growth never moves or
//! allocates one list for itself.

use simworld_core::geometry::{Point2, Vector2};
use simworld_core::net::RoadClass;

use super::fitted::{Arrival, Fitted, Start};

/// More streets than this do not meet at one junction.
pub(super) const MOST_STREETS: usize = 4;
/// The end of a chain.
const END: u32 = u32::MAX;

/// A straight piece between two junctions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Segment {
    pub(super) from: u32,
    pub(super) to: u32,
    pub(super) class: RoadClass,
    /// Unit vector from its beginning to its end.
    pub(super) along: Vector2,
}

/// A junction: the streets that meet there and how many may.
#[derive(Clone, Copy, Debug)]
struct Node {
    at: Point2,
    streets: [u32; MOST_STREETS],
    count: u8,
    limit: u8,
}

/// Junctions and segments; what it holds is planar and connected.
#[derive(Clone, Debug)]
pub(super) struct Fabric {
    nodes: Vec<Node>,
    segments: Vec<Segment>,
    /// The first so many segments and nodes are a wall round the land, counter-clockwise: nothing splits or crosses it.
    walls: u32,
    /// The middle of the land.
    middle: Point2,
    /// Half the width of the land, and the width of a cell, m.
    reach: f64,
    cell: f64,
    columns: usize,
    /// First node and first entry of each cell; each points to the next.
    node_heads: Vec<u32>,
    node_next: Vec<u32>,
    entry_heads: Vec<u32>,
    entries: Vec<(u32, u32)>,
    /// The last question that each segment was an answer to, so that none is told twice.
    asked: Vec<u32>,
    question: u32,
}

impl Fabric {
    /// Empty land within `reach` m of the origin, in cells of `cell` m.
    pub(super) fn new(reach: f64, cell: f64) -> Self {
        Self::around(Point2::origin(), reach, cell)
    }

    /// Empty land within `reach` m of a point, in cells of `cell` m.
    pub(super) fn around(middle: Point2, reach: f64, cell: f64) -> Self {
        let columns = (2.0 * reach / cell).ceil() as usize + 1;
        Self {
            nodes: Vec::new(),
            segments: Vec::new(),
            walls: 0,
            middle,
            reach,
            cell,
            columns,
            node_heads: vec![END; columns * columns],
            node_next: Vec::new(),
            entry_heads: vec![END; columns * columns],
            entries: Vec::new(),
            asked: Vec::new(),
            question: 0,
        }
    }

    pub(super) fn node_count(&self) -> usize {
        self.nodes.len()
    }

    pub(super) fn segments(&self) -> &[Segment] {
        &self.segments
    }

    pub(super) fn segment(&self, segment: u32) -> Segment {
        self.segments[segment as usize]
    }

    pub(super) fn at(&self, node: u32) -> Point2 {
        self.nodes[node as usize].at
    }

    pub(super) fn degree(&self, node: u32) -> usize {
        usize::from(self.nodes[node as usize].count)
    }

    /// Whether one more street may meet there.
    pub(super) fn has_room(&self, node: u32) -> bool {
        let node = &self.nodes[node as usize];
        node.count < node.limit
    }

    /// Whether a point lies within the land, a little inside its edge.
    pub(super) fn holds(&self, point: Point2) -> bool {
        (point - self.middle).norm() < self.reach - self.cell
    }

    /// Builds a wall round the land, counter-clockwise; each corner takes so many streets, the wall's two among them. The
    /// fabric must be empty.
    pub(super) fn wall_in(&mut self, corners: impl Iterator<Item = (Point2, u8)>, class: RoadClass) {
        for (at, limit) in corners {
            self.add_node(at, limit);
        }
        let count = self.nodes.len() as u32;
        for from in 0..count {
            let to = (from + 1) % count;
            let along = (self.at(to) - self.at(from)).normalize();
            self.add_segment(Segment { from, to, class, along });
        }
        self.walls = count;
    }

    /// How many segments and nodes are wall.
    pub(super) fn walls(&self) -> usize {
        self.walls as usize
    }

    /// Whether a segment is a piece of the wall.
    pub(super) fn is_wall(&self, segment: u32) -> bool {
        segment < self.walls
    }

    /// Whether a street that leaves a node in a direction leads into the land; it may lead out of the wall.
    pub(super) fn leads_inside(&self, node: u32, along: Vector2) -> bool {
        if node >= self.walls {
            return true;
        }
        // The land is the sector from the wall that leaves, counter-clockwise, to the wall that arrives.
        let next = self.segments[node as usize].along;
        let before = -self.segments[((node + self.walls - 1) % self.walls) as usize].along;
        if next.perp(&before) >= 0.0 {
            next.perp(&along) > 0.0 && along.perp(&before) > 0.0
        } else {
            next.perp(&along) > 0.0 || along.perp(&before) > 0.0
        }
    }

    pub(super) fn streets(&self, node: u32) -> &[u32] {
        let node = &self.nodes[node as usize];
        &node.streets[..usize::from(node.count)]
    }

    /// The directions in which streets leave a node.
    pub(super) fn ways(&self, node: u32) -> impl Iterator<Item = Vector2> {
        self.streets(node).iter().map(move |segment| {
            let segment = &self.segments[*segment as usize];
            if segment.from == node { segment.along } else { -segment.along }
        })
    }

    /// The point where a segment would begin.
    pub(super) fn start(&self, start: Start) -> Point2 {
        match start {
            Start::Node(node) => self.at(node),
            Start::Middle(segment) => {
                let segment = &self.segments[segment as usize];
                nalgebra::center(&self.at(segment.from), &self.at(segment.to))
            }
        }
    }

    /// Whether one more street may leave from there. A node whose street was taken away since hangs on nothing.
    pub(super) fn can_leave(&self, start: Start) -> bool {
        match start {
            Start::Node(node) => self.has_room(node) && (self.degree(node) > 0 || self.segments.is_empty()),
            Start::Middle(segment) => self.is_standing(segment),
        }
    }

    /// The directions in which streets leave a place.
    pub(super) fn ways_from(&self, start: Start) -> impl Iterator<Item = Vector2> {
        let (node, along) = match start {
            Start::Node(node) => (Some(node), None),
            Start::Middle(segment) => (None, Some(self.segments[segment as usize].along)),
        };
        let at_node = node.into_iter().flat_map(|node| self.ways(node));
        at_node.chain(along.into_iter().flat_map(|along| [along, -along]))
    }

    /// Length of a segment, m.
    pub(super) fn length(&self, segment: u32) -> f64 {
        let segment = &self.segments[segment as usize];
        (self.at(segment.to) - self.at(segment.from)).norm()
    }

    /// Whether a segment begins or ends at a node.
    pub(super) fn is_end(&self, segment: u32, node: u32) -> bool {
        let segment = &self.segments[segment as usize];
        segment.from == node || segment.to == node
    }

    /// The node at the other end of a segment.
    pub(super) fn other_end(&self, segment: u32, node: u32) -> u32 {
        let segment = &self.segments[segment as usize];
        if segment.from == node { segment.to } else { segment.from }
    }

    pub(super) fn are_joined(&self, a: u32, b: u32) -> bool {
        self.streets(a).iter().any(|segment| self.other_end(*segment, a) == b)
    }

    fn column_of(&self, x: f64) -> usize {
        self.cell_of(x - self.middle.x)
    }

    fn row_of(&self, y: f64) -> usize {
        self.cell_of(y - self.middle.y)
    }

    fn cell_of(&self, x: f64) -> usize {
        (((x + self.reach) / self.cell).floor().max(0.0) as usize).min(self.columns - 1)
    }

    /// Calls with every node of the cells within a distance; they may lie somewhat farther off.
    pub(super) fn visit_nodes(&self, point: Point2, distance: f64, mut visit: impl FnMut(u32, Point2)) {
        let rows = self.row_of(point.y - distance)..=self.row_of(point.y + distance);
        for row in rows {
            for column in self.column_of(point.x - distance)..=self.column_of(point.x + distance) {
                let mut node = self.node_heads[row * self.columns + column];
                while node != END {
                    visit(node, self.nodes[node as usize].at);
                    node = self.node_next[node as usize];
                }
            }
        }
    }

    /// Collects every segment whose cells touch the box around two points grown by a margin, each once.
    pub(super) fn segments_near(&mut self, a: Point2, b: Point2, margin: f64, found: &mut Vec<u32>) {
        found.clear();
        self.question = self.question.wrapping_add(1);
        let rows = self.row_of(a.y.min(b.y) - margin)..=self.row_of(a.y.max(b.y) + margin);
        let columns = self.column_of(a.x.min(b.x) - margin)..=self.column_of(a.x.max(b.x) + margin);
        for row in rows {
            for column in columns.clone() {
                let mut entry = self.entry_heads[row * self.columns + column];
                while entry != END {
                    let (segment, next) = self.entries[entry as usize];
                    if self.asked[segment as usize] != self.question {
                        self.asked[segment as usize] = self.question;
                        found.push(segment);
                    }
                    entry = next;
                }
            }
        }
    }

    /// Adds a junction at which at most `limit` streets meet.
    pub(super) fn add_node(&mut self, at: Point2, limit: u8) -> u32 {
        let node = self.nodes.len() as u32;
        self.nodes.push(Node { at, streets: [END; MOST_STREETS], count: 0, limit });
        let cell = self.row_of(at.y) * self.columns + self.column_of(at.x);
        self.node_next.push(self.node_heads[cell]);
        self.node_heads[cell] = node;
        node
    }

    /// Builds a fitted proposal and returns the node where it arrives; a new junction takes at most `limit` streets.
    pub(super) fn build(&mut self, fitted: &Fitted, limit: u8) -> u32 {
        let node = match fitted.arrival {
            Arrival::New(point) => self.add_node(point, limit),
            Arrival::Node(node) => node,
            Arrival::Interior(segment, point) => self.split(segment, point, limit),
        };
        let from = match fitted.from {
            Start::Node(node) => node,
            Start::Middle(segment) => self.split(segment, self.start(fitted.from), limit),
        };
        let along = (self.at(node) - self.at(from)).normalize();
        self.add_segment(Segment { from, to: node, class: fitted.class, along });
        node
    }

    fn attach(&mut self, node: u32, segment: u32) {
        let node = &mut self.nodes[node as usize];
        node.streets[usize::from(node.count)] = segment;
        node.count += 1;
    }

    fn add_segment(&mut self, segment: Segment) {
        let index = self.segments.len() as u32;
        self.segments.push(segment);
        self.asked.push(self.question);
        self.attach(segment.from, index);
        self.attach(segment.to, index);
        self.file(index);
    }

    /// Enters a segment in the cells of its box.
    fn file(&mut self, index: u32) {
        let Segment { from, to, .. } = self.segments[index as usize];
        let (a, b) = (self.at(from), self.at(to));
        for row in self.row_of(a.y.min(b.y))..=self.row_of(a.y.max(b.y)) {
            for column in self.column_of(a.x.min(b.x))..=self.column_of(a.x.max(b.x)) {
                let cell = row * self.columns + column;
                self.entries.push((index, self.entry_heads[cell]));
                self.entry_heads[cell] = self.entries.len() as u32 - 1;
            }
        }
    }

    /// Puts a node on a segment: the first half keeps its index, the second is new.
    fn split(&mut self, index: u32, point: Point2, limit: u8) -> u32 {
        // Two halves and the street that arrives.
        let node = self.add_node(point, limit.max(3));
        let segment = self.segments[index as usize];
        self.segments[index as usize].to = node;
        self.detach(segment.to, index);
        self.attach(node, index);
        self.add_segment(Segment { from: node, ..segment });
        node
    }

    fn detach(&mut self, node: u32, segment: u32) {
        let node = &mut self.nodes[node as usize];
        let count = usize::from(node.count);
        if let Some(place) = node.streets[..count].iter().position(|own| *own == segment) {
            node.streets.copy_within(place + 1..count, place);
            node.count -= 1;
        }
    }

    /// Takes a dead end's street away from the junction it comes from. The segment stays in the arrays as what is no
    /// street any more; [`is_standing`](Self::is_standing) tells.
    pub(super) fn remove_dead_end(&mut self, node: u32) {
        let Some(segment) = self.streets(node).first().copied() else { return };
        let other = self.other_end(segment, node);
        self.detach(node, segment);
        self.detach(other, segment);
    }

    /// Whether a segment is still a street.
    pub(super) fn is_standing(&self, segment: u32) -> bool {
        self.streets(self.segments[segment as usize].from).contains(&segment)
    }
}
