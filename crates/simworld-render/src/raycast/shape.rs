//! Meshes as rays meet them: triangles in the order of a tree whose nodes hold two boxes, one of anchors and one of offsets. With a
//! scale and a unit both give the box of the points, so one tree serves every size. Everything in words, four a piece.

use std::collections::BTreeMap;
use std::sync::Arc;

use simworld_core::asset::Model;
use simworld_core::id::AssetId;
use simworld_core::scene::Scene;

use super::bvh::{Box3, Child, NONE, Tree};
use crate::mesh::{Drawn, MeshId, MeshLibrary, Vertex};
use crate::models::{model_of, vertices_of};

/// Triangles a leaf.
const LEAF: usize = 4;
/// Pieces of four words that a triangle and a node take, as in raycast.wgsl.
const TRIANGLE: u32 = 9;
const NODE: u32 = 8;
/// Marks a child as a run of triangles; beside it stand their number less one, from bit 28 on, and the first piece.
const IS_LEAF: u32 = 1 << 31;

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
            let shape = shapes.add(&library.vertices, indices);
            shapes.own.push(shape);
        }
        shapes
    }

    /// The shape of a mesh; `None` for a model that its scene has not.
    pub(super) fn of(&mut self, scene: &dyn Scene, mesh: Drawn) -> Option<Shape> {
        let id = match mesh {
            Drawn::Own(mesh) => return self.own.get(mesh as usize).copied(),
            Drawn::Model(id) => id,
        };
        let (asset, model) = model_of(scene, id)?;
        if let Some((held, shape)) = self.models.get(&id)
            && Arc::ptr_eq(held, model)
        {
            return Some(*shape);
        }
        let shape = self.add(&vertices_of(asset, model), model.triangles.as_flattened());
        self.models.insert(id, (Arc::clone(model), shape));
        Some(shape)
    }

    fn add(&mut self, vertices: &[Vertex], indices: &[u32]) -> Shape {
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
        let tree = Tree::build(&(0..corners.len()).map(nominal).collect::<Vec<_>>(), LEAF);
        let first = self.pieces.len() as u32;
        for number in &tree.order {
            self.add_triangle(&corners[*number as usize]);
        }
        let root = self.pieces.len() as u32;
        let (anchors, offsets) = (in_order(&tree, &anchors), in_order(&tree, &offsets));
        let (anchors, offsets) = (bound(&tree, &anchors), bound(&tree, &offsets));
        for (node, children) in tree.nodes.iter().enumerate() {
            for (side, child) in children.iter().enumerate() {
                let code = match child {
                    Child::Node(node) => root + node * NODE,
                    Child::Leaf { first: start, count } => {
                        IS_LEAF | (count - 1) << 28 | (first + start * TRIANGLE)
                    }
                    Child::Nothing => NONE,
                };
                self.add_boxes(anchors[node][side], offsets[node][side], code);
            }
        }
        let whole = |boxes: &[[Box3; 2]]| boxes[0][0].grown(boxes[0][1]);
        Shape { root, anchors: whole(&anchors), offsets: whole(&offsets) }
    }

    fn add_triangle(&mut self, corners: &[&Vertex; 3]) {
        let piece = |three: [f32; 3], last: u32| {
            let [x, y, z] = three.map(f32::to_bits);
            [x, y, z, last]
        };
        for vertex in corners {
            self.pieces.push(piece(vertex.anchor, vertex.material));
            self.pieces.push(piece(vertex.offset, 0));
        }
        self.pieces.extend(corners.map(|vertex| piece(vertex.normal, 0)));
    }

    fn add_boxes(&mut self, anchors: Box3, offsets: Box3, code: u32) {
        let piece = |three: [f32; 3], last: u32| {
            let [x, y, z] = three.map(f32::to_bits);
            [x, y, z, last]
        };
        self.pieces.push(piece(anchors.low, code));
        self.pieces.push(piece(anchors.high, 0));
        self.pieces.push(piece(offsets.low, 0));
        self.pieces.push(piece(offsets.high, 0));
    }
}

fn in_order(tree: &Tree, boxes: &[Box3]) -> Vec<Box3> {
    tree.order.iter().map(|number| boxes[*number as usize]).collect()
}

/// The boxes of both children of every node; `leaves` are in the order of the tree.
pub(super) fn bound(tree: &Tree, leaves: &[Box3]) -> Vec<[Box3; 2]> {
    let mut boxes = vec![[Box3::EMPTY; 2]; tree.nodes.len()];
    // Children come after their parents.
    for (node, children) in tree.nodes.iter().enumerate().rev() {
        boxes[node] = children.map(|child| match child {
            Child::Node(node) => boxes[node as usize][0].grown(boxes[node as usize][1]),
            Child::Leaf { first, count } => leaves[first as usize..(first + count) as usize]
                .iter()
                .fold(Box3::EMPTY, |all, one| all.grown(*one)),
            Child::Nothing => Box3::EMPTY,
        });
    }
    boxes
}
