//! The order of streets around nodes, kept in the links from half-edge to half-edge.
//!
//! Around a node, the half-edge that comes into it is followed by the first one that leaves clockwise of where it came
//! from: so the face stays on the left.

use simworld_core::geometry::Point2;

use super::piece::by_direction;
use super::{HalfEdge, NONE, StreetGraph};

impl StreetGraph {
    /// The next half-edge counterclockwise around the node where one begins.
    pub(super) fn left_of(&self, half: u32) -> u32 {
        self.prev[half as usize] ^ 1
    }

    /// The point towards which a half-edge sets out.
    fn aim(&self, half: u32) -> Point2 {
        let half = HalfEdge(half);
        let Some(street) = &self.streets[half.street().index()] else { return Point2::origin() };
        let last = street.via.len() as u32;
        self.point(street, if half.is_along() { 1 } else { last })
    }

    /// Links half-edge `out` to follow the one that comes in against `left`, its neighbour counterclockwise.
    fn link(&mut self, left: u32, out: u32) {
        self.next[left as usize ^ 1] = out;
        self.prev[out as usize] = left ^ 1;
    }

    /// Links all the half-edges that leave a node; they are put in order.
    pub(super) fn link_all(&mut self, node: u32, leaving: &mut [u32]) {
        let centre = self.nodes[node as usize].at;
        leaving.sort_unstable_by(|a, b| by_direction(centre, self.aim(*a), self.aim(*b)).then(a.cmp(b)));
        for index in 0..leaving.len() {
            self.link(leaving[(index + 1) % leaving.len()], leaving[index]);
        }
        self.nodes[node as usize].out = leaving.first().copied().unwrap_or(NONE);
    }

    /// Puts a half-edge among those that leave a node. The half-edges whose next one changed are told.
    pub(super) fn splice_in(&mut self, half: u32, node: u32, changed: &mut Vec<u32>) {
        let first = self.nodes[node as usize].out;
        if first == NONE {
            self.link(half, half);
            self.nodes[node as usize].out = half;
            changed.push(half ^ 1);
            return;
        }
        let right = self.right_neighbour(half, node, first);
        let left = self.left_of(right);
        self.link(half, right);
        self.link(left, half);
        changed.extend([half ^ 1, left ^ 1]);
    }

    /// The last half-edge before one, counterclockwise around its node, of those that are linked.
    fn right_neighbour(&self, half: u32, node: u32, first: u32) -> u32 {
        let centre = self.nodes[node as usize].at;
        let aim = self.aim(half);
        let order = |a: u32, b: u32| by_direction(centre, self.aim(a), self.aim(b));
        let (mut before, mut highest) = (None, first);
        let mut at = first;
        loop {
            if by_direction(centre, self.aim(at), aim).is_lt()
                && before.is_none_or(|best| order(best, at).is_lt())
            {
                before = Some(at);
            }
            if order(highest, at).is_lt() {
                highest = at;
            }
            at = self.left_of(at);
            if at == first {
                break;
            }
        }
        before.unwrap_or(highest)
    }

    /// Takes a half-edge from among those that leave a node. The half-edge whose next one changed is told.
    pub(super) fn splice_out(&mut self, half: u32, node: u32, changed: &mut Vec<u32>) {
        let right = self.next[half as usize ^ 1];
        if right == half {
            self.nodes[node as usize].out = NONE;
            return;
        }
        let left = self.left_of(half);
        self.link(left, right);
        self.nodes[node as usize].out = right;
        changed.push(left ^ 1);
    }
}
