//! Meshes as rays meet them: triangles in the order of a tree whose nodes hold two boxes a child, one of anchors and one of offsets. With a
//! scale and a unit both give the box of the points, so one tree serves every size. Everything in words, four a piece.

use std::collections::BTreeMap;
use std::sync::Arc;

use simworld_core::asset::Model;
use simworld_core::id::AssetId;
use simworld_core::scene::Scene;

use super::bvh::{Box3, Child, NONE, Tree, WIDTH};
use super::halves::{Rounding, pair};
use crate::mesh::{Drawn, MeshId, MeshLibrary, Vertex};
use crate::models::{ModelMesh, model_of};

/// Triangles a leaf; and of very large meshes, as many as its code can tell.
const LEAF: usize = 3;
const LARGE_LEAF: usize = 8;
/// Pieces that the codes of the nodes of all meshes can tell, as in rays.wgsl; at eight a triangle they are no more than the tree of one mesh has room for.
pub(super) const MOST_PIECES: usize = 1 << 26;
/// Levels of the tree of a mesh at most, as in rays.wgsl.
const LEVELS: u32 = 10;
/// Pieces of four words that a triangle and a node take, as in rays.wgsl.
const TRIANGLE: u32 = 5;
const NODE: u32 = 7;
/// Pieces of a triangle that stand apart: its normals, and of models also the place of each corner on the picture, and the part.
const ASIDE: u32 = 3;
const MODEL_ASIDE: u32 = 5;
/// Marks a child as a run of triangles; beside it stand their number less one, from bit 28 on, and the first piece.
const IS_LEAF: u32 = 1 << 31;
/// From this bit on, a triangle's word of where its normals are has the pattern of its mesh.
const PATTERN: u32 = 28;

/// A mesh among the pieces.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shape {
    /// The piece at which its root begins.
    pub root: u32,
    pub anchors: Box3,
    pub offsets: Box3,
}

/// All meshes that were met so far.
pub(super) struct Shapes {
    pub pieces: Vec<[u32; 4]>,
    own: Vec<Shape>,
    models: BTreeMap<AssetId, (Arc<Model>, Shape)>,
}

impl Shapes {
    pub(super) fn new() -> Self {
        let library = MeshLibrary::build();
        let mut shapes = Self { pieces: Vec::new(), own: Vec::new(), models: BTreeMap::new() };
        for mesh in MeshId::ALL {
            let range = &library.ranges[*mesh as usize];
            let indices = &library.indices[range.start as usize..range.end as usize];
            let shape = shapes.add(&library.vertices, &[], indices, mesh.pattern() as u32);
            shapes.own.push(shape);
        }
        shapes
    }

    /// The shape of a mesh; `None` for a model that was not [learnt](Self::learn).
    pub(super) fn of(&self, mesh: Drawn) -> Option<Shape> {
        match mesh {
            Drawn::Own(mesh) => self.own.get(mesh as usize).copied(),
            Drawn::Model(id) => self.models.get(&id).map(|(_, shape)| *shape),
        }
    }

    /// Looks up a model as its scene has it now; does nothing about other meshes.
    pub(super) fn learn(&mut self, scene: &dyn Scene, mesh: Drawn) {
        let Drawn::Model(id) = mesh else { return };
        let Some((asset, model)) = model_of(scene, id) else {
            self.models.remove(&id);
            return;
        };
        if self.models.get(&id).is_some_and(|(held, _)| Arc::ptr_eq(held, model)) {
            return;
        }
        let own = ModelMesh::of(asset, model);
        let shape = self.add(&own.vertices, &own.spots, &own.indices, mesh.pattern() as u32);
        self.models.insert(id, (Arc::clone(model), shape));
    }

    /// Adds a mesh; `spots` are those of a [`ModelMesh`], and none of other meshes.
    fn add(&mut self, vertices: &[Vertex], spots: &[[f32; 3]], indices: &[u32], pattern: u32) -> Shape {
        let corners: Vec<[&Vertex; 3]> = indices
            .chunks_exact(3)
            .map(|triangle| [0, 1, 2].map(|corner| &vertices[triangle[corner] as usize]))
            .collect();
        let anchors: Vec<Box3> =
            corners.iter().map(|three| Box3::around(three.map(|vertex| vertex.anchor))).collect();
        let offsets: Vec<Box3> =
            corners.iter().map(|three| Box3::around(three.map(|vertex| vertex.offset))).collect();
        // The tree is laid out for a body of a few metres; it holds for all.
        let nominal = |index: usize| Box3 {
            low: std::array::from_fn(|axis| 3.0 * anchors[index].low[axis] + offsets[index].low[axis]),
            high: std::array::from_fn(|axis| 3.0 * anchors[index].high[axis] + offsets[index].high[axis]),
        };
        let leaf = if corners.len() <= LEAF << (2 * LEVELS) { LEAF } else { LARGE_LEAF };
        let tree = Tree::build(&(0..corners.len()).map(nominal).collect::<Vec<_>>(), leaf, LEVELS);
        let first = self.pieces.len() as u32;
        let normals = first + corners.len() as u32 * TRIANGLE;
        let aside = if spots.is_empty() { ASIDE } else { MODEL_ASIDE };
        for (position, number) in (0..).zip(&tree.order) {
            self.add_triangle(&corners[*number as usize], pattern << PATTERN | (normals + aside * position));
        }
        for number in &tree.order {
            let three = corners[*number as usize].map(|vertex| vertex.normal.map(f32::to_bits));
            self.pieces.extend(three.map(|[x, y, z]| [x, y, z, 0]));
            if aside == MODEL_ASIDE {
                let corner = |which: usize| spots[indices[*number as usize * 3 + which] as usize];
                let [[a, b, _], [c, d, _], [e, f, part]] = [0, 1, 2].map(corner);
                self.pieces.extend([[a, b, c, d], [e, f, part, 0.0]].map(|four| four.map(f32::to_bits)));
            }
        }
        let root = self.pieces.len() as u32;
        let (anchors, offsets) = (in_order(&tree, &anchors), in_order(&tree, &offsets));
        let (anchors, offsets) = (bound(&tree, &anchors), bound(&tree, &offsets));
        for (children, (anchors, offsets)) in tree.nodes.iter().zip(anchors.iter().zip(&offsets)) {
            self.pieces.push(children.map(|child| match child {
                Child::Node(node) => root + node * NODE,
                Child::Leaf { first: start, count } => {
                    IS_LEAF | (count - 1) << 28 | (first + start * TRIANGLE)
                }
                Child::Nothing => NONE,
            }));
            self.add_boxes([anchors, offsets]);
        }
        let whole = |boxes: &[[Box3; WIDTH]]| Box3::around_all(&boxes[0]);
        Shape { root, anchors: whole(&anchors), offsets: whole(&offsets) }
    }

    /// Anchor and offset of each corner, its material, and where the normals are.
    fn add_triangle(&mut self, corners: &[&Vertex; 3], normals: u32) {
        let places = corners.iter().flat_map(|vertex| vertex.anchor.into_iter().chain(vertex.offset));
        let words: Vec<u32> = places.map(f32::to_bits).chain([corners[0].material, normals]).collect();
        self.pieces.extend(words.chunks_exact(4).map(|four| [four[0], four[1], four[2], four[3]]));
    }

    /// The boxes of the children of a node in halves of words, rounded outwards, and flat ones with some thickness, so that rays lose nothing to rounding: least anchors of all four along x, then y, z, greatest
    /// anchors, and the same of offsets.
    fn add_boxes(&mut self, boxes: [&[Box3; WIDTH]; 2]) {
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
        self.pieces.extend(rows.chunks_exact(2).map(|two| [two[0][0], two[0][1], two[1][0], two[1][1]]));
    }
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
