//! Squares: open ground that people cross from one entrance to another.

use simworld_core::geometry::Point2;
use simworld_core::net::polyline;

use crate::osm::building::contains;
use crate::osm::place::Place;
use crate::osm::raw::{MISSING, Way};

/// No way across is longer than the shortest by more than this factor.
const DETOUR: f64 = 1.2;
/// So many entrances and corners of one square are looked at, those at which other ways end first.
const MOST_PLACES: usize = 40;

/// The edge of a square.
pub(super) struct Square<'a> {
    /// Its nodes, one after another.
    pub(super) nodes: &'a [u32],
    corners: Vec<Point2>,
}

impl<'a> Square<'a> {
    /// What a closed way goes round; none if a node of it is missing.
    pub(super) fn of(place: &'a Place, way: &Way) -> Option<Self> {
        let nodes = place.raw.nodes_of(way);
        let (last, ring) = nodes.split_last()?;
        let is_ring = ring.len() >= 3 && ring.first() == Some(last) && !nodes.contains(&MISSING);
        let corners: Option<Vec<Point2>> = ring.iter().map(|node| place.point(*node)).collect();
        corners.filter(|_| is_ring).map(|corners| Self { nodes: ring, corners })
    }

    /// Where a corner lies, m.
    pub(super) fn corner(&self, index: usize) -> Point2 {
        self.corners[index]
    }

    /// The lines on which people cross, as pairs of corners: between the entrances and round what juts into the square. As few
    /// as it takes that no way is much longer than the shortest (greedy spanners: Althöfer, Das, Dobkin, Joseph and Soares,
    /// "On sparse spanners of weighted graphs", 1993).
    pub(super) fn lines(&self, is_entrance: impl Fn(u32) -> bool) -> Vec<[usize; 2]> {
        let (entrances, others): (Vec<usize>, Vec<usize>) =
            (0..self.corners.len()).partition(|index| is_entrance(self.nodes[*index]));
        if entrances.len() < 2 {
            return Vec::new();
        }
        let entrances = &entrances[..entrances.len().min(MOST_PLACES)];
        let area = self.area();
        let jutting = others.into_iter().filter(|index| self.turn(*index) * area < 0.0);
        let places: Vec<usize> = entrances.iter().copied().chain(jutting).take(MOST_PLACES).collect();
        let shortest = self.shortest(&places);
        let ranks = 0..entrances.len();
        let mut pairs: Vec<(usize, usize)> =
            ranks.clone().flat_map(|a| ranks.clone().skip(a + 1).map(move |b| (a, b))).collect();
        pairs.retain(|(a, b)| shortest.length(*a, *b).is_finite());
        pairs.sort_by(|p, q| shortest.length(p.0, p.1).total_cmp(&shortest.length(q.0, q.1)).then(p.cmp(q)));
        let mut chosen = Ways::none(places.len());
        let mut lines = Vec::new();
        for (a, b) in pairs {
            if chosen.length(a, b) <= DETOUR * shortest.length(a, b) {
                continue;
            }
            let mut at = a;
            while at != b {
                let next = shortest.next(at, b);
                if chosen.join(at, next, shortest.length(at, next)) {
                    lines.push([places[at], places[next]]);
                }
                at = next;
            }
        }
        lines
    }

    /// How the edge of the square turns at a corner: where it bends inwards, against the sign of its area.
    fn turn(&self, index: usize) -> f64 {
        let count = self.corners.len();
        let (before, at, after) = (
            self.corners[(index + count - 1) % count],
            self.corners[index],
            self.corners[(index + 1) % count],
        );
        (at - before).perp(&(after - at))
    }

    /// Twice its area, positive if its corners go round counter-clockwise, m².
    fn area(&self) -> f64 {
        let origin = self.corners[0];
        self.corners.windows(2).map(|pair| (pair[0] - origin).perp(&(pair[1] - origin))).sum()
    }

    /// The shortest ways between some corners within the square.
    fn shortest(&self, places: &[usize]) -> Ways {
        let mut ways = Ways::none(places.len());
        for (a, from) in places.iter().enumerate() {
            for (b, to) in places.iter().enumerate().skip(a + 1) {
                if self.sees(*from, *to) {
                    ways.join(a, b, (self.corners[*to] - self.corners[*from]).norm());
                }
            }
        }
        ways
    }

    /// Whether one comes straight from a corner to another.
    fn sees(&self, from: usize, to: usize) -> bool {
        let count = self.corners.len();
        if (from + 1) % count == to || (to + 1) % count == from {
            return true;
        }
        let (a, b) = (self.corners[from], self.corners[to]);
        let is_apart =
            |index: usize| [index, (index + 1) % count].iter().all(|end| *end != from && *end != to);
        let mut sides = (0..count).filter(|index| is_apart(*index));
        let is_crossed = |index: usize| {
            polyline::crossing(a, b, self.corners[index], self.corners[(index + 1) % count]).is_some()
        };
        contains(&self.corners, a + (b - a) * 0.5) && !sides.any(is_crossed)
    }
}

/// Lengths of the shortest ways between places that are joined one after another, and where they go first.
struct Ways {
    count: usize,
    lengths: Vec<f64>,
    next: Vec<usize>,
}

impl Ways {
    fn none(count: usize) -> Self {
        let lengths =
            (0..count * count).map(|index| if index % (count + 1) == 0 { 0.0 } else { f64::INFINITY });
        let next = (0..count * count).map(|index| index % count);
        Self { count, lengths: lengths.collect(), next: next.collect() }
    }

    fn length(&self, from: usize, to: usize) -> f64 {
        self.lengths[from * self.count + to]
    }

    /// The place after `from` on the way to `to`.
    fn next(&self, from: usize, to: usize) -> usize {
        self.next[from * self.count + to]
    }

    /// Joins two places by a straight line of some length; false if there is no longer way between them.
    fn join(&mut self, a: usize, b: usize, length: f64) -> bool {
        if length >= self.length(a, b) {
            return false;
        }
        for from in 0..self.count {
            for (near, far) in [(a, b), (b, a)] {
                let before = self.length(from, near) + length;
                let first = if from == near { far } else { self.next(from, near) };
                for to in 0..self.count {
                    let through = before + self.length(far, to);
                    if through < self.length(from, to) {
                        self.lengths[from * self.count + to] = through;
                        self.next[from * self.count + to] = first;
                    }
                }
            }
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(corners: &[(f64, f64)], nodes: &'static [u32]) -> Square<'static> {
        Square { nodes, corners: corners.iter().map(|(x, y)| Point2::new(*x, *y)).collect() }
    }

    #[test]
    fn entrances_that_see_each_other_are_joined_straight() {
        let open = square(&[(0.0, 0.0), (50.0, 0.0), (50.0, 40.0), (0.0, 40.0)], &[7, 8, 9, 10]);
        assert_eq!(open.lines(|node| node == 7 || node == 9), [[0, 2]]);
        assert!(open.lines(|node| node == 7).is_empty());
        // The diagonals are longer than one detour, so that all four sides and both diagonals are there.
        let mut lines = open.lines(|_| true);
        lines.sort_unstable();
        assert_eq!(lines, [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]]);
    }

    #[test]
    fn ways_lead_round_what_juts_in() {
        // An L, whose ends do not see each other.
        let corners = [(0.0, 0.0), (60.0, 0.0), (60.0, 20.0), (20.0, 20.0), (20.0, 60.0), (0.0, 60.0)];
        for corners in [corners.to_vec(), corners.iter().rev().copied().collect()] {
            let bent = square(&corners, &[0, 1, 2, 3, 4, 5]);
            let at = |index: usize| (bent.corner(index).x, bent.corner(index).y);
            let ends = |node: u32| [(60.0, 20.0), (0.0, 60.0)].contains(&at(node as usize));
            let mut lines = bent.lines(ends);
            lines.sort_unstable();
            let inner = corners.iter().position(|corner| *corner == (20.0, 20.0)).unwrap();
            assert_eq!(lines.len(), 2, "{lines:?}");
            assert!(lines.iter().all(|line| line.contains(&inner)), "{lines:?}");
        }
    }

    #[test]
    fn of_many_entrances_few_are_joined_and_no_way_is_long() {
        let count = 30;
        let corners: Vec<Point2> = (0..count)
            .map(|index| Point2::origin() + simworld_core::geometry::direction(f64::from(index) * 0.2) * 40.0)
            .collect();
        let nodes: Vec<u32> = (0..count).collect();
        let round = Square { nodes: &nodes, corners };
        let lines = round.lines(|_| true);
        assert!(lines.len() < 150, "{} of {} lines", lines.len(), count * (count - 1) / 2);
        let mut ways = Ways::none(count as usize);
        for [a, b] in lines {
            ways.join(a, b, (round.corner(b) - round.corner(a)).norm());
        }
        for a in 0..count as usize {
            for b in 0..count as usize {
                let straight = (round.corner(b) - round.corner(a)).norm();
                assert!(ways.length(a, b) <= DETOUR * straight + 1e-9, "{a} to {b}");
            }
        }
    }
}
