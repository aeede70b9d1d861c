//! One mesh as rays meet it: triangles in the order of a tree whose nodes hold two boxes a child, one of anchors and one of offsets. With a
//! scale and a unit both give the box of the points, so one tree serves every size. Everything in words, four a piece.

use super::bvh::{Box3, Child, NONE, Tree, WIDTH};
use super::halves::{Rounding, pair};
use super::shape::MOST_PIECES;
use crate::mesh::{Pattern, Vertex};
use crate::models::ModelMesh;

/// Triangles a leaf; and of very large meshes, as many as its code can tell.
const LEAF: usize = 3;
const LARGE_LEAF: usize = 8;
/// Levels of the tree of a mesh at most, as in rays.wgsl.
const LEVELS: u32 = 10;
/// Pieces of four words that a triangle and a node take, as in rays.wgsl.
const TRIANGLE: u32 = 5;
const NODE: u32 = 7;
/// Pieces of a triangle that stand apart: its normals, each with its tangent, and of models also the place of each corner on the picture, the part, and the alphas.
const ASIDE: u32 = 3;
const MODEL_ASIDE: u32 = 5;
/// Bits of an alpha from 0 to 256.
const ALPHA: u32 = 9;
/// Marks a child as a run of triangles; beside it stand their number less one, from bit 28 on, and the first piece.
const IS_LEAF: u32 = 1 << 31;
/// From this bit on, a triangle's word of where its normals are has the pattern of its mesh.
const PATTERN: u32 = 28;
/// Says in that word that the part of the triangle is cut out, or blended, and that it is blended; as in rays.wgsl.
const IS_CUT: u32 = 1 << 27;
const IS_FILM: u32 = 1 << 26;
/// Below these bits there is room for the number of any piece.
const _: () = assert!(MOST_PIECES <= IS_FILM as usize);

/// A mesh among the pieces.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shape {
    /// The piece at which its root begins.
    pub root: u32,
    pub anchors: Box3,
    pub offsets: Box3,
}

/// The triangles of a mesh.
pub(super) struct Soup<'a> {
    corners: Vec<[&'a Vertex; 3]>,
    /// By corner, the place on pictures, the part and its alpha, of models; none of other meshes.
    spots: Vec<[[f32; 4]; 3]>,
    /// Likewise the tangents, packed.
    tangents: Vec<[u32; 3]>,
    /// From this triangle on they are those of parts that are cut out, and from the other on of parts that are blended.
    cut_from: usize,
    film_from: usize,
    pattern: Pattern,
}

impl<'a> Soup<'a> {
    pub(super) fn new(vertices: &'a [Vertex], indices: &[u32], pattern: Pattern) -> Self {
        let corners = by_corner(indices, |index| &vertices[index]);
        let count = corners.len();
        let (spots, tangents) = (Vec::new(), Vec::new());
        Self { corners, spots, tangents, cut_from: count, film_from: count, pattern }
    }

    pub(super) fn of_model(mesh: &'a ModelMesh) -> Self {
        Self {
            spots: by_corner(&mesh.indices, |index| mesh.spots[index]),
            tangents: by_corner(&mesh.indices, |index| mesh.tangents[index]),
            cut_from: mesh.cut_from / 3,
            film_from: mesh.film_from / 3,
            ..Self::new(&mesh.vertices, &mesh.indices, Pattern::Model)
        }
    }

    /// The tree of its triangles.
    pub(super) fn tree(&self) -> Tree {
        let [anchors, offsets] = self.boxes();
        // The tree is laid out for a body of a few metres; it holds for all.
        let nominal = |index: usize| Box3 {
            low: std::array::from_fn(|axis| 3.0 * anchors[index].low[axis] + offsets[index].low[axis]),
            high: std::array::from_fn(|axis| 3.0 * anchors[index].high[axis] + offsets[index].high[axis]),
        };
        let count = self.corners.len();
        let leaf = if count <= LEAF << (2 * LEVELS) { LEAF } else { LARGE_LEAF };
        Tree::build(&(0..count).map(nominal).collect::<Vec<_>>(), leaf, LEVELS)
    }

    /// Adds what stands apart of a triangle.
    fn add_aside(&self, pieces: &mut Vec<[u32; 4]>, number: usize) {
        let tangents = self.tangents.get(number).copied().unwrap_or_default();
        for (vertex, tangent) in self.corners[number].iter().zip(tangents) {
            let [x, y, z] = vertex.normal.map(f32::to_bits);
            pieces.push([x, y, z, tangent]);
        }
        if let Some([[a, b, _, p], [c, d, _, q], [e, f, part, r]]) = self.spots.get(number) {
            pieces.push([a, b, c, d].map(|word| word.to_bits()));
            // Alphas are whole steps of 1/256.
            let alphas = [p, q, r].map(|alpha| (alpha * 256.0) as u32);
            let alphas = alphas[0] | alphas[1] << ALPHA | alphas[2] << (2 * ALPHA);
            pieces.push([e.to_bits(), f.to_bits(), part.to_bits(), alphas]);
        }
    }

    /// The boxes of its triangles: of their anchors, and of their offsets.
    fn boxes(&self) -> [Vec<Box3>; 2] {
        let around = |of: fn(&Vertex) -> [f32; 3]| {
            self.corners.iter().map(|three| Box3::around(three.map(of))).collect()
        };
        [around(|vertex| vertex.anchor), around(|vertex| vertex.offset)]
    }

    /// Its pieces under a tree, which may have been laid out for the same triangles in another pose, when they stand from piece `first` on.
    pub(super) fn coded(&self, tree: &Tree, first: u32) -> (Vec<[u32; 4]>, Shape) {
        let mut pieces = Vec::new();
        let normals = first + self.corners.len() as u32 * TRIANGLE;
        let aside = if self.spots.is_empty() { ASIDE } else { MODEL_ASIDE };
        let pattern = (self.pattern as u32) << PATTERN;
        for (position, number) in (0..).zip(&tree.order) {
            let is_from = |from: usize, bit| if (*number as usize) < from { 0 } else { bit };
            let kind = is_from(self.cut_from, IS_CUT) | is_from(self.film_from, IS_FILM);
            let last = pattern | kind | (normals + aside * position);
            add_triangle(&mut pieces, &self.corners[*number as usize], last);
        }
        for number in &tree.order {
            self.add_aside(&mut pieces, *number as usize);
        }
        let root = first + pieces.len() as u32;
        let [anchors, offsets] = self.boxes().map(|boxes| bound(tree, &in_order(tree, &boxes)));
        for (children, (anchors, offsets)) in tree.nodes.iter().zip(anchors.iter().zip(&offsets)) {
            pieces.push(children.map(|child| match child {
                Child::Node(node) => root + node * NODE,
                Child::Leaf { first: start, count } => {
                    IS_LEAF | (count - 1) << 28 | (first + start * TRIANGLE)
                }
                Child::Nothing => NONE,
            }));
            add_boxes(&mut pieces, [anchors, offsets]);
        }
        let whole = |boxes: &[[Box3; WIDTH]]| Box3::around_all(&boxes[0]);
        (pieces, Shape { root, anchors: whole(&anchors), offsets: whole(&offsets) })
    }
}

fn by_corner<T>(indices: &[u32], of: impl Fn(usize) -> T) -> Vec<[T; 3]> {
    indices.chunks_exact(3).map(|three| [0, 1, 2].map(|corner| of(three[corner] as usize))).collect()
}

/// Anchor and offset of each corner, its material, and where the normals are.
fn add_triangle(pieces: &mut Vec<[u32; 4]>, corners: &[&Vertex; 3], normals: u32) {
    let places = corners.iter().flat_map(|vertex| vertex.anchor.into_iter().chain(vertex.offset));
    let words: Vec<u32> = places.map(f32::to_bits).chain([corners[0].material, normals]).collect();
    pieces.extend(words.chunks_exact(4).map(|four| [four[0], four[1], four[2], four[3]]));
}

/// The boxes of the children of a node in halves of words, rounded outwards, and flat ones with some thickness, so that rays lose nothing to rounding: least anchors of all four along x, then y, z, greatest
/// anchors, and the same of offsets.
fn add_boxes(pieces: &mut Vec<[u32; 4]>, boxes: [&[Box3; WIDTH]; 2]) {
    let mut rows: Vec<[u32; 2]> = Vec::with_capacity(12);
    for kind in boxes {
        for axis in 0..3 {
            let [a, b, c, d] = kind.map(|one| one.low[axis] - slack(&one, axis));
            rows.push([pair(a, b, Rounding::Down), pair(c, d, Rounding::Down)]);
        }
        for axis in 0..3 {
            let [a, b, c, d] = kind.map(|one| one.high[axis] + slack(&one, axis));
            rows.push([pair(a, b, Rounding::Up), pair(c, d, Rounding::Up)]);
        }
    }
    pieces.extend(rows.chunks_exact(2).map(|two| [two[0][0], two[0][1], two[1][0], two[1][1]]));
}

/// By how much a box is made thicker on either side along an axis; the empty one stays inside out.
fn slack(one: &Box3, axis: usize) -> f32 {
    if *one == Box3::EMPTY { 0.0 } else { 1e-5 * (one.low[axis].abs() + one.high[axis].abs()) + 1e-7 }
}

fn in_order(tree: &Tree, boxes: &[Box3]) -> Vec<Box3> {
    tree.order.iter().map(|number| boxes[*number as usize]).collect()
}

/// The boxes of the children of every node; `leaves` are in the order of the tree.
pub(super) fn bound(tree: &Tree, leaves: &[Box3]) -> Vec<[Box3; WIDTH]> {
    let mut boxes = vec![[Box3::EMPTY; WIDTH]; tree.nodes.len()];
    // Children come after their parents.
    for (node, children) in tree.nodes.iter().enumerate().rev() {
        boxes[node] = children.map(|child| match child {
            Child::Node(node) => Box3::around_all(&boxes[node as usize]),
            Child::Leaf { first, count } => {
                Box3::around_all(&leaves[first as usize..(first + count) as usize])
            }
            Child::Nothing => Box3::EMPTY,
        });
    }
    boxes
}
