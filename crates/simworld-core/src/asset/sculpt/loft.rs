//! Lofts: a skin over rings of points, closed at its ends or joined to a wreath.

use super::V;

/// Which edges look sharp.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shade {
    /// All.
    Flat,
    /// Those between rings; around, it is round.
    Round,
    /// None.
    Smooth,
}

/// What bodies meet of a solid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hulls {
    /// It is convex.
    Whole,
    /// The solid between two rings is convex.
    Segments,
}

/// How the row of rings ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Ends {
    /// With a flat face at both; a ring that is one point needs none.
    Closed,
    /// As [`Ends::Closed`], where the first half of a ring lies along the second.
    Strips,
    /// The last ring is joined to the first.
    Joined,
}

/// Rings with the same number of points each, around the way from the first to the last.
#[derive(Clone, Debug)]
pub(super) struct Loft {
    pub(super) rings: Vec<Vec<V>>,
    pub(super) ends: Ends,
    pub(super) shade: Shade,
}

/// Twice the area below which a triangle is none, m².
const FLAT: f64 = 1e-12;

impl Loft {
    /// The triangles, each corner with its normal, counter-clockwise from outside whichever way the rings run.
    pub(super) fn triangles(&self) -> Vec<[(V, V); 3]> {
        let mut all = Vec::new();
        let sides = self.rings.first().map_or(0, Vec::len);
        for segment in 0..self.segments() {
            for side in 0..sides {
                let corners = [(0, 0), (0, 1), (1, 1), (1, 0)];
                let corner = |(ahead, across): (usize, usize)| {
                    let (ring, index) = (segment + ahead, (side + across) % sides);
                    (self.point(ring, index), self.normal([segment, side], [ahead, across]))
                };
                let [a, b, c, d] = corners.map(corner);
                all.extend([[a, b, c], [a, c, d]]);
            }
        }
        let (first, last) = (&self.rings[0], &self.rings[self.rings.len() - 1]);
        match self.ends {
            Ends::Closed => {
                all.extend(cap(first.iter().rev().copied()));
                all.extend(cap(last.iter().copied()));
            }
            Ends::Strips => {
                for k in 1..sides / 2 {
                    let corners = [k - 1, k, sides - 1 - k, sides - k];
                    all.extend(cap(corners.iter().rev().map(|corner| first[*corner])));
                    all.extend(cap(corners.iter().map(|corner| last[*corner])));
                }
            }
            Ends::Joined => {}
        }
        all.retain(|[a, b, c]| (b.0 - a.0).cross(&(c.0 - a.0)).norm() > FLAT);
        if volume(&all) < 0.0 {
            for triangle in &mut all {
                triangle.swap(1, 2);
                for (_, normal) in triangle {
                    *normal = -*normal;
                }
            }
        }
        all
    }

    /// The points of the convex solids.
    pub(super) fn hulls(&self, hulls: Hulls) -> Vec<Vec<V>> {
        match hulls {
            Hulls::Whole => vec![distinct(self.rings.iter().flatten())],
            Hulls::Segments => (0..self.segments())
                .map(|segment| {
                    let next = (segment + 1) % self.rings.len();
                    distinct(self.rings[segment].iter().chain(&self.rings[next]))
                })
                .collect(),
        }
    }

    fn segments(&self) -> usize {
        match self.ends {
            Ends::Closed | Ends::Strips => self.rings.len().saturating_sub(1),
            Ends::Joined => self.rings.len(),
        }
    }

    fn point(&self, ring: usize, index: usize) -> V {
        self.rings[ring % self.rings.len()][index]
    }

    /// The normal of a face, of no length where it has no area.
    fn face(&self, segment: usize, side: usize) -> V {
        let next = (side + 1) % self.rings[0].len();
        let [a, b] = [side, next].map(|index| self.point(segment, index));
        let [d, c] = [side, next].map(|index| self.point(segment + 1, index));
        (c - a).cross(&(d - b))
    }

    /// The normal at a corner of a face: of all faces there that it goes over into without an edge.
    fn normal(&self, [segment, side]: [usize; 2], [ahead, across]: [usize; 2]) -> V {
        let (segments, sides) = (self.segments(), self.rings[0].len());
        let beside = (side + if across == 0 { sides - 1 } else { 1 }) % sides;
        let own = [side].into_iter().chain((self.shade != Shade::Flat).then_some(beside));
        let mut sum: V = own.clone().map(|side| self.face(segment, side)).sum();
        if self.shade == Shade::Smooth {
            let beyond = match (ahead, self.ends) {
                (0, Ends::Closed | Ends::Strips) => segment.checked_sub(1),
                (_, Ends::Closed | Ends::Strips) => Some(segment + 1).filter(|next| *next < segments),
                (0, Ends::Joined) => Some((segment + segments - 1) % segments),
                (_, Ends::Joined) => Some((segment + 1) % segments),
            };
            if let Some(beyond) = beyond {
                sum += own.map(|side| self.face(beyond, side)).sum::<V>();
            }
        }
        sum.try_normalize(1e-12).unwrap_or_else(V::z)
    }
}

/// A flat face, from its first corner.
fn cap(ring: impl Iterator<Item = V>) -> Vec<[(V, V); 3]> {
    let ring: Vec<V> = ring.collect();
    let middle = ring.iter().sum::<V>() / ring.len() as f64;
    let area: V = (0..ring.len())
        .map(|index| (ring[index] - middle).cross(&(ring[(index + 1) % ring.len()] - middle)))
        .sum();
    let Some(normal) = area.try_normalize(1e-12) else { return Vec::new() };
    (1..ring.len() - 1).map(|index| [0, index, index + 1].map(|corner| (ring[corner], normal))).collect()
}

/// The room within closed triangles, m³; negative if they look inwards.
pub(super) fn volume(triangles: &[[(V, V); 3]]) -> f64 {
    triangles.iter().map(|[a, b, c]| a.0.dot(&b.0.cross(&c.0))).sum::<f64>() / 6.0
}

/// The points without those that stand twice.
fn distinct<'a>(points: impl Iterator<Item = &'a V>) -> Vec<V> {
    let mut all: Vec<V> = points.copied().collect();
    all.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)).then(a.z.total_cmp(&b.z)));
    all.dedup();
    all
}
