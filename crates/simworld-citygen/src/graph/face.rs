//! Faces: closed walks along the sides of streets.

use simworld_core::geometry::Point2;

use super::{Face, FaceId, HalfEdge, NONE, StreetGraph};

/// A face of a graph.
#[derive(Clone, Copy, Debug)]
pub struct FaceRef<'a> {
    pub(super) graph: &'a StreetGraph,
    pub(super) id: FaceId,
    pub(super) face: Face,
}

impl FaceRef<'_> {
    /// Its handle.
    pub const fn id(&self) -> FaceId {
        self.id
    }

    /// The area that its walk encloses counterclockwise, m²: positive for a block, not so for an outer face. Parts of the
    /// streets that lie within a block unconnected to it are not taken off.
    pub const fn area(&self) -> f64 {
        self.face.area
    }

    /// Whether it is what lies around a connected part of the streets.
    pub fn is_outer(&self) -> bool {
        self.face.area <= 0.0
    }

    /// Number of half-edges of its walk.
    pub const fn len(&self) -> usize {
        self.face.count as usize
    }

    /// Never: a walk has at least two half-edges.
    pub const fn is_empty(&self) -> bool {
        self.face.count == 0
    }

    /// Its walk, with the face on the left, from the half-edge with the least number.
    pub fn ring(&self) -> impl Iterator<Item = HalfEdge> {
        let mut at = self.face.first;
        (0..self.face.count).map(move |_| {
            let here = at;
            at = self.graph.next[here as usize];
            HalfEdge(here)
        })
    }

    /// The corners of its walk, each once where it is passed; the last is joined to the first. A dead end within is
    /// walked there and back.
    pub fn polygon(&self) -> Vec<Point2> {
        let mut corners = Vec::with_capacity(self.len());
        for half in self.ring() {
            let mut course = self.graph.course(half);
            course.pop();
            corners.extend(course);
        }
        corners
    }
}

impl StreetGraph {
    /// Walks the face of a half-edge and gives it a number. Its area is to be measured when all faces are walked.
    pub(super) fn walk(&mut self, start: u32) -> FaceId {
        let id = self.free_faces.pop().unwrap_or_else(|| {
            self.faces.push(Face { first: NONE, area: 0.0, count: 0 });
            self.faces.len() as u32 - 1
        });
        let (mut at, mut first, mut count) = (start, start, 0);
        loop {
            self.face[at as usize] = id;
            first = first.min(at);
            count += 1;
            at = self.next[at as usize];
            if at == start {
                break;
            }
        }
        self.faces[id as usize] = Face { first, area: 0.0, count };
        FaceId(id)
    }

    /// Measures the area of a face; the walks of all faces are known.
    pub(super) fn measure(&mut self, face: FaceId) {
        let Face { first, count, .. } = self.faces[face.index()];
        self.faces[face.index()].area = self.area_of_walk(face.0, first, count);
    }

    /// Half the sum of cross products about a point of the walk. Streets that are walked there and back add nothing, not
    /// even a rounding error, so that a tree of streets has no area at all.
    fn area_of_walk(&self, id: u32, first: u32, count: u32) -> f64 {
        let mut at = first;
        let mut twice = 0.0;
        let mut centre = None;
        for _ in 0..count {
            let half = HalfEdge(at);
            if self.face[half.twin().index()] != id
                && let Some(street) = &self.streets[half.street().index()]
            {
                let mut before = self.point(street, 0);
                let centre = *centre.get_or_insert(before);
                let mut along = 0.0;
                for index in 1..street.via.len() as u32 + 2 {
                    let point = self.point(street, index);
                    along += (before - centre).perp(&(point - centre));
                    before = point;
                }
                twice += if half.is_along() { along } else { -along };
            }
            at = self.next[at as usize];
        }
        twice * 0.5
    }
}
