//! Squares: open ground that people cross from one entrance to another, round what stands in it.

use std::ops::Range;

use simworld_core::geometry::{Point2, Vector2};
use simworld_core::net::polyline;

use super::area::Area;
use crate::osm::building::contains;
use crate::osm::place::Place;
use crate::osm::raw::MISSING;
use crate::simplify::simplified;

/// No way across is longer than the shortest by more than this factor.
const DETOUR: f64 = 1.2;
/// So many entrances and corners of one square are looked at, those at which other ways end first.
const MOST_PLACES: usize = 40;
/// So many corners round which people go about holes are looked at besides, if one hole after another is drawn more
/// roughly, m, until there are no more.
const MOST_ROUND_HOLES: usize = 60;
const ROUGH: [f64; 4] = [0.5, 1.0, 2.0, 4.0];
/// People go round holes so far beside what is drawn of them, m: half of a way, and what the drawing may be wrong.
const ASIDE: f64 = 1.0;
/// Nor do they come nearer to a corner of one than this, m.
const NEAREST: f64 = 0.5;
/// Round a sharp corner no farther out than so many times as far.
const SHARPEST: f64 = 2.0;

/// The edge of a square, and the holes in it.
pub(super) struct Square {
    /// The nodes of its edge and of its holes, ring after ring, and [`MISSING`] for the corners round which people go about
    /// the holes.
    pub(super) nodes: Vec<u32>,
    corners: Vec<Point2>,
    /// Which of them are a ring: the edge first.
    rings: Vec<Range<usize>>,
}

impl Square {
    /// An area as far as it is one; none if a node of its edge is missing.
    pub(super) fn of(place: &Place, area: &Area) -> Option<Self> {
        let mut square = Self { nodes: Vec::new(), corners: Vec::new(), rings: Vec::new() };
        square.put_ring(place, &area.edge).then_some(())?;
        for hole in &area.holes {
            square.put_ring(place, hole);
        }
        square.put_corners_round_holes();
        Some(square)
    }

    /// Adds what a closed row of nodes goes round; false if a node of it is missing.
    fn put_ring(&mut self, place: &Place, nodes: &[u32]) -> bool {
        let Some((last, ring)) = nodes.split_last() else { return false };
        let is_ring = ring.len() >= 3 && ring.first() == Some(last) && !nodes.contains(&MISSING);
        let corners: Option<Vec<Point2>> = ring.iter().map(|node| place.point(*node)).collect();
        let Some(corners) = corners.filter(|_| is_ring) else { return false };
        self.rings.push(self.corners.len()..self.corners.len() + corners.len());
        self.corners.extend(corners);
        self.nodes.extend(ring);
        true
    }

    /// Adds the corners round which people go about holes, from roughly drawn holes if they are too many.
    fn put_corners_round_holes(&mut self) {
        let holes = &self.rings[1..];
        let round = |rough: f64| {
            let corners = holes.iter().flat_map(|hole| corners_round(&self.corners[hole.clone()], rough));
            corners.filter(|at| self.is_open(*at)).collect::<Vec<Point2>>()
        };
        let found = ROUGH.into_iter().map(round).find(|corners| corners.len() <= MOST_ROUND_HOLES);
        let found = found.unwrap_or_default();
        self.nodes.extend(found.iter().map(|_| MISSING));
        self.corners.extend(found);
    }

    /// Whether a point lies within the square and in none of its holes.
    fn is_open(&self, at: Point2) -> bool {
        let mut rings = self.rings.iter().map(|ring| contains(&self.corners[ring.clone()], at));
        rings.next() == Some(true) && !rings.any(|is_within| is_within)
    }

    /// The corners of its edge, and of each of its holes, m.
    pub(super) fn rings(&self) -> impl Iterator<Item = &[Point2]> {
        self.rings.iter().map(|ring| &self.corners[ring.clone()])
    }

    /// Where a corner lies, m.
    pub(super) fn corner(&self, index: usize) -> Point2 {
        self.corners[index]
    }

    /// The lines on which people cross, as pairs of corners: between the entrances and round what juts into the square. As few
    /// as it takes that no way is much longer than the shortest (greedy spanners: Althöfer, Das, Dobkin, Joseph and Soares,
    /// "On sparse spanners of weighted graphs", 1993).
    pub(super) fn lines(&self, is_entrance: impl Fn(u32) -> bool) -> Vec<[usize; 2]> {
        let is_entrance = |index: &usize| self.nodes[*index] != MISSING && is_entrance(self.nodes[*index]);
        let (entrances, others): (Vec<usize>, Vec<usize>) = (0..self.corners.len()).partition(is_entrance);
        if entrances.len() < 2 {
            return Vec::new();
        }
        let entrances = &entrances[..entrances.len().min(MOST_PLACES)];
        let (area, edge) = (self.area(), self.edge());
        let jutting =
            others.into_iter().filter(|index| edge.contains(index) && self.turn(*index) * area < 0.0);
        let round_holes = (0..self.corners.len()).filter(|index| self.nodes[*index] == MISSING);
        let places = entrances.iter().copied().chain(jutting).take(MOST_PLACES);
        let places: Vec<usize> = places.chain(round_holes).collect();
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

    /// The corners of its edge.
    fn edge(&self) -> Range<usize> {
        self.rings[0].clone()
    }

    /// How the edge of the square turns at a corner: where it bends inwards, against the sign of its area.
    fn turn(&self, index: usize) -> f64 {
        let count = self.edge().len();
        let (before, at, after) = (
            self.corners[(index + count - 1) % count],
            self.corners[index],
            self.corners[(index + 1) % count],
        );
        (at - before).perp(&(after - at))
    }

    /// Twice its area, positive if its corners go round counter-clockwise, m².
    fn area(&self) -> f64 {
        area(&self.corners[self.edge()])
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
        let (a, b) = (self.corners[from], self.corners[to]);
        let mut sides = self.rings.iter().flat_map(sides_of);
        if sides.clone().any(|side| side == [from, to] || side == [to, from]) {
            return true;
        }
        let is_crossed = |[start, end]: [usize; 2]| {
            let is_apart = [start, end].iter().all(|end| *end != from && *end != to);
            is_apart && polyline::crossing(a, b, self.corners[start], self.corners[end]).is_some()
        };
        let line = [a, b];
        let is_grazed = |corner: &Point2| {
            let is_apart = [a, b].iter().all(|end| (corner - end).norm() >= NEAREST);
            is_apart && polyline::closest(&line, corner).is_some_and(|near| near.distance < NEAREST)
        };
        let mut holes = self.rings[1..].iter().flat_map(|hole| &self.corners[hole.clone()]);
        self.is_open(a + (b - a) * 0.5) && !sides.any(is_crossed) && !holes.any(is_grazed)
    }
}

/// The sides of a ring, as pairs of corners.
fn sides_of(ring: &Range<usize>) -> impl Iterator<Item = [usize; 2]> + Clone + use<> {
    let ring = ring.clone();
    ring.clone().map(move |index| [index, if index + 1 < ring.end { index + 1 } else { ring.start }])
}

/// Twice the area of a ring, positive if its corners go round counter-clockwise, m².
pub(super) fn area(ring: &[Point2]) -> f64 {
    let origin = ring[0];
    ring.windows(2).map(|pair| (pair[0] - origin).perp(&(pair[1] - origin))).sum()
}

/// The corners round which people go about a hole, from one that is drawn so roughly, m.
fn corners_round(hole: &[Point2], rough: f64) -> Vec<Point2> {
    // In two halves, for a closed line has no chord.
    let far = |index: &usize| (hole[*index] - hole[0]).norm_squared();
    let middle = (0..hole.len()).max_by(|a, b| far(a).total_cmp(&far(b))).unwrap_or(0);
    let back: Vec<Point2> = hole[middle..].iter().chain(&hole[..1]).copied().collect();
    let mut ring = simplified(&hole[..=middle], rough);
    ring.pop();
    ring.extend(simplified(&back, rough));
    ring.pop();
    if ring.len() < 3 {
        return box_round(hole, rough + ASIDE);
    }
    let (sign, count) = (area(&ring).signum(), ring.len());
    let corner = |index: usize| {
        let (before, at, after) = (ring[(index + count - 1) % count], ring[index], ring[(index + 1) % count]);
        let normals = [at - before, after - at].map(|along| {
            Vector2::new(along.y, -along.x).try_normalize(1e-9).unwrap_or_else(Vector2::zeros) * sign
        });
        let juts = normals[0].perp(&normals[1]) * sign > 0.0;
        let out = (normals[0] + normals[1]).try_normalize(1e-6).filter(|_| juts)?;
        Some(at + out * ((rough + ASIDE) / out.dot(&normals[0]).max(1.0 / SHARPEST)))
    };
    (0..count).filter_map(corner).collect()
}

/// The corners of a box about a hole of which hardly anything is left.
fn box_round(hole: &[Point2], aside: f64) -> Vec<Point2> {
    let Some((low, high)) = simworld_core::geometry::bounds(hole) else { return Vec::new() };
    let (low, high) = (low - Vector2::new(aside, aside), high + Vector2::new(aside, aside));
    vec![low, Point2::new(high.x, low.y), high, Point2::new(low.x, high.y)]
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

    fn square(corners: &[(f64, f64)], nodes: &[u32]) -> Square {
        let corners: Vec<Point2> = corners.iter().map(|(x, y)| Point2::new(*x, *y)).collect();
        Square { nodes: nodes.to_vec(), rings: std::iter::once(0..corners.len()).collect(), corners }
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

    /// Entrances in the middle of the sides of a square of 60 m, and a hole in its middle.
    fn holed(hole: &[Point2]) -> Square {
        let edge = [
            (0.0, 0.0),
            (30.0, 0.0),
            (60.0, 0.0),
            (60.0, 30.0),
            (60.0, 60.0),
            (30.0, 60.0),
            (0.0, 60.0),
            (0.0, 30.0),
        ];
        let mut holed = square(&edge, &[0, 1, 2, 3, 4, 5, 6, 7]);
        holed.rings.push(8..8 + hole.len());
        holed.corners.extend(hole);
        holed.nodes.extend(hole.iter().map(|_| 8));
        holed.put_corners_round_holes();
        holed
    }

    #[test]
    fn ways_lead_round_holes() {
        let corners =
            [(20.0, 22.0), (40.0, 22.0), (40.0, 38.0), (20.0, 38.0)].map(|(x, y)| Point2::new(x, y));
        let round = (0..48).map(|index| simworld_core::geometry::direction(f64::from(index) * 0.13) * 12.0);
        let round: Vec<Point2> = round.map(|out| Point2::new(30.0, 30.0) + out).collect();
        let mut back = corners.to_vec();
        back.reverse();
        for hole in [corners.to_vec(), back, round] {
            let holed = holed(&hole);
            let lines = holed.lines(|node| [1, 3, 5, 7].contains(&node));
            let mut ways = Ways::none(holed.corners.len());
            for line in &lines {
                let [a, b] = line.map(|end| holed.corner(end));
                ways.join(line[0], line[1], (b - a).norm());
                for step in 0..=50 {
                    let at = a + (b - a) * (f64::from(step) / 50.0);
                    let ring: Vec<Point2> = hole.iter().chain(&hole[..1]).copied().collect();
                    let beside = polyline::closest(&ring, &at).unwrap().distance;
                    assert!(!contains(&hole, at) && beside > 0.49, "{at} is {beside} m beside the hole");
                }
            }
            for (a, b, straight) in [(1, 5, 60.0), (3, 7, 60.0), (1, 3, 42.4)] {
                let length = ways.length(a, b);
                assert!((straight - 0.1..straight * 1.4).contains(&length), "{a} to {b}: {length} m");
            }
        }
    }

    #[test]
    fn what_is_drawn_too_finely_is_gone_round_on_fewer_corners() {
        // A star of 400 corners.
        let ray = |index: u32| {
            simworld_core::geometry::direction(f64::from(index) * 0.0157)
                * (10.0 + f64::from(index % 2) * 6.0)
        };
        let star: Vec<Point2> = (0..400).map(|index| Point2::new(30.0, 30.0) + ray(index)).collect();
        let holed = holed(&star);
        assert!(holed.corners.len() <= 408 + MOST_ROUND_HOLES);
        assert!(holed.lines(|node| [1, 5].contains(&node)).len() < 60);
    }

    #[test]
    fn of_many_entrances_few_are_joined_and_no_way_is_long() {
        let count = 30;
        let corners: Vec<Point2> = (0..count)
            .map(|index| Point2::origin() + simworld_core::geometry::direction(f64::from(index) * 0.2) * 40.0)
            .collect();
        let nodes: Vec<u32> = (0..count).collect();
        let round = Square { nodes, rings: std::iter::once(0..corners.len()).collect(), corners };
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
