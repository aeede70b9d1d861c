//! The streets grown so far: junctions and segments in flat arrays, and squares that know what is near.

use simworld_core::geometry::{Point2, Vector2};
use simworld_core::net::RoadClass;

use super::cells::{Asked, Bounds, Cells};
use super::fitted::{Arrival, Fitted, Start};

/// More streets than this do not meet at one junction.
pub(super) const MOST_STREETS: usize = 4;
/// No street.
const NONE: u32 = u32::MAX;

/// A straight piece between two junctions: all that questions about what is near want to know, in one line of the cache.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub(super) struct Segment {
    /// Where it begins and ends.
    pub(super) a: Point2,
    pub(super) b: Point2,
    /// Unit vector from its beginning to its end.
    pub(super) along: Vector2,
    /// The junctions where it begins and ends.
    pub(super) from: u32,
    pub(super) to: u32,
    pub(super) class: RoadClass,
    /// Whether it is still a street.
    stands: bool,
}

/// What is read where there is no street.
const NOWHERE: Segment = Segment {
    a: Point2::new(0.0, 0.0),
    b: Point2::new(0.0, 0.0),
    along: Vector2::new(0.0, 0.0),
    from: NONE,
    to: NONE,
    class: RoadClass::Local,
    stands: false,
};

/// The directions in which streets leave a place, as unit vectors, and zeros where there are no more.
pub(super) type Ways = [Vector2; MOST_STREETS];

/// A segment that stands near a place that was asked for.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Near {
    pub(super) a: Point2,
    pub(super) b: Point2,
    pub(super) index: u32,
    pub(super) from: u32,
    pub(super) to: u32,
}

/// What questions about what is near are answered in; kept from one to the next.
#[derive(Clone, Debug, Default)]
pub(super) struct Scratch {
    asked: Asked,
    near: Vec<Near>,
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
    /// Points farther from the middle are beyond the land, m.
    reach: f64,
    cells: Cells,
}

impl Fabric {
    /// Empty land within `reach` m of a point, in cells of `cell` m, with room for so many segments.
    pub(super) fn around(middle: Point2, reach: f64, cell: f64, room: usize) -> Self {
        Self {
            nodes: Vec::with_capacity(room),
            // Some are taken away again, and to move them all where there is more room takes long.
            segments: Vec::with_capacity(room + room / 4),
            walls: 0,
            middle,
            // A little inside the edge of the cells.
            reach: reach - cell,
            cells: Cells::around(middle, reach, cell),
        }
    }

    pub(super) fn node_count(&self) -> usize {
        self.nodes.len()
    }

    pub(super) fn segments(&self) -> &[Segment] {
        &self.segments
    }

    pub(super) fn segment(&self, segment: u32) -> &Segment {
        &self.segments[segment as usize]
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

    /// Whether a point lies within the land.
    pub(super) fn holds(&self, point: Point2) -> bool {
        (point - self.middle).norm_squared() < self.reach * self.reach
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
            self.join(from, to, class);
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

    /// The directions in which streets leave a node; behind the last one nothing.
    pub(super) fn ways(&self, node: u32) -> Ways {
        // All places are read, taken or not: how many streets there are cannot be foretold.
        self.nodes[node as usize].streets.map(|street| {
            let segment = self.segments.get(street as usize).unwrap_or(&NOWHERE);
            if segment.from == node { segment.along } else { -segment.along }
        })
    }

    /// The point where a segment would begin.
    pub(super) fn start(&self, start: Start) -> Point2 {
        match start {
            Start::Node(node) => self.at(node),
            Start::Middle(segment) => {
                let segment = &self.segments[segment as usize];
                nalgebra::center(&segment.a, &segment.b)
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

    /// The directions in which streets leave a place; behind the last one nothing.
    pub(super) fn ways_from(&self, start: Start) -> Ways {
        match start {
            Start::Node(node) => self.ways(node),
            Start::Middle(segment) => self.ways_along(segment),
        }
    }

    /// The directions in which a segment is left from between its ends; behind them nothing.
    pub(super) fn ways_along(&self, segment: u32) -> Ways {
        let along = self.segment(segment).along;
        [along, -along, Vector2::zeros(), Vector2::zeros()]
    }

    /// Length of a segment, m.
    pub(super) fn length(&self, segment: u32) -> f64 {
        let segment = &self.segments[segment as usize];
        (segment.b - segment.a).norm()
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

    /// Every segment that stands and whose box touches another one; seldom one is told twice.
    pub(super) fn gather<'a>(&self, bounds: &Bounds, scratch: &'a mut Scratch) -> &'a [Near] {
        let Scratch { asked, near } = scratch;
        let (numbers, mut told) = asked.ask(&self.cells, bounds);
        if near.len() < numbers.len() {
            near.resize(numbers.len(), Near::default());
        }
        let mut count = 0;
        // All are read, and those that are none are written over: no read waits for what was found in one before.
        for index in numbers {
            let Segment { a, b, from, to, stands, .. } = self.segments[*index as usize];
            near[count] = Near { a, b, index: *index, from, to };
            count += usize::from(told.is_new(*index) & stands & bounds.touches(a, b));
        }
        &near[..count]
    }

    /// Gives back the memory of what questions about what is near need, once there are no more of them.
    pub(super) fn forget_what_is_near(&mut self) {
        self.cells = Cells::around(self.middle, 0.0, 1.0);
    }

    /// Whether a test holds of the ends of every segment that stands and that a line may meet.
    pub(super) fn all_along(&self, a: Point2, b: Point2, test: impl Fn(Point2, Point2) -> bool) -> bool {
        self.cells.all_along(a, b, |index| {
            let segment = &self.segments[index as usize];
            !segment.stands || test(segment.a, segment.b)
        })
    }

    /// Adds a junction at which at most `limit` streets meet.
    pub(super) fn add_node(&mut self, at: Point2, limit: u8) -> u32 {
        let node = self.nodes.len() as u32;
        self.nodes.push(Node { at, streets: [NONE; MOST_STREETS], count: 0, limit });
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
        self.join(from, node, fitted.class);
        node
    }

    fn attach(&mut self, node: u32, segment: u32) {
        let node = &mut self.nodes[node as usize];
        node.streets[usize::from(node.count)] = segment;
        node.count += 1;
    }

    /// Builds a segment between two junctions.
    fn join(&mut self, from: u32, to: u32, class: RoadClass) {
        let (a, b) = (self.at(from), self.at(to));
        self.add_segment(Segment { a, b, along: (b - a).normalize(), from, to, class, stands: true });
    }

    fn add_segment(&mut self, segment: Segment) {
        let index = self.segments.len() as u32;
        self.segments.push(segment);
        self.attach(segment.from, index);
        self.attach(segment.to, index);
        self.cells.file(index, segment.a, segment.b);
    }

    /// Puts a node on a segment: the first half keeps its index, the second is new.
    fn split(&mut self, index: u32, point: Point2, limit: u8) -> u32 {
        // Two halves and the street that arrives.
        let node = self.add_node(point, limit.max(3));
        let first = &mut self.segments[index as usize];
        let second = Segment { from: node, a: point, ..*first };
        (first.to, first.b) = (node, point);
        self.detach(second.to, index);
        self.attach(node, index);
        self.add_segment(second);
        node
    }

    fn detach(&mut self, node: u32, segment: u32) {
        let node = &mut self.nodes[node as usize];
        let count = usize::from(node.count);
        if let Some(place) = node.streets[..count].iter().position(|own| *own == segment) {
            node.streets.copy_within(place + 1..count, place);
            node.streets[count - 1] = NONE;
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
        self.segments[segment as usize].stands = false;
    }

    /// Whether a segment is still a street.
    pub(super) fn is_standing(&self, segment: u32) -> bool {
        self.segments[segment as usize].stands
    }
}
