//! All meshes among the pieces that rays meet: those of this crate, and the models of assets in the poses in which they are drawn.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

use simworld_core::asset::{Model, RigPose};

use super::bvh::Tree;
use super::soup::{Shape, Soup};
use crate::mesh::{Drawn, MeshId, MeshLibrary, ModelId};
use crate::models::ModelMesh;
use crate::poses::Poses;
use crate::sources::{Modelled, Source, Sources};
use crate::threads;

/// Pieces that the codes of the nodes of all meshes can tell, as in rays.wgsl; at eight a triangle they are no more than the tree of one mesh has room for.
pub(super) const MOST_PIECES: usize = 1 << 26;

/// All meshes that were met so far.
pub(super) struct Shapes {
    pub pieces: Vec<[u32; 4]>,
    /// Runs of pieces that are others than before.
    pub rewritten: Vec<Range<usize>>,
    own: Vec<Shape>,
    models: BTreeMap<Source, Held>,
    /// Grows with every look.
    now: u64,
}

/// A model among the pieces.
struct Held {
    model: Arc<Model>,
    /// Laid out for it at rest, and good for every pose.
    tree: Arc<Tree>,
    /// How many pieces it takes.
    length: usize,
    /// At rest.
    shape: Shape,
    /// In other poses, with where each begins.
    poses: Poses<(usize, Shape)>,
}

impl Shapes {
    pub(super) fn new() -> Self {
        let library = MeshLibrary::build();
        let (pieces, rewritten, own, models) = (Vec::new(), Vec::new(), Vec::new(), BTreeMap::new());
        let mut shapes = Self { pieces, rewritten, own, models, now: 0 };
        for mesh in MeshId::ALL {
            let range = &library.ranges[*mesh as usize];
            let indices = &library.indices[range.start as usize..range.end as usize];
            let soup = Soup::new(&library.vertices, indices, mesh.pattern());
            let shape = shapes.add(&soup, &soup.tree());
            shapes.own.push(shape);
        }
        shapes
    }

    /// The shape of a mesh; `None` for a model that was not [learnt](Self::learn).
    pub(super) fn of(&self, mesh: Drawn) -> Option<Shape> {
        match mesh {
            Drawn::Own(mesh) => self.own.get(mesh as usize).copied(),
            Drawn::Model(ModelId { source, pose }) => {
                let held = self.models.get(&source)?;
                pose.map_or(Some(held.shape), |pose| held.poses.get(pose).map(|(_, shape)| *shape))
            }
        }
    }

    /// Looks up the models that are drawn as their scene has them now, each in the poses in which it is drawn.
    pub(super) fn learn<'a>(&mut self, sources: Sources<'_>, drawn: impl Iterator<Item = &'a ModelId>) {
        self.now += 1;
        let mut missing = Vec::new();
        for id in drawn {
            let Some(modelled) = sources.find(id.source) else {
                self.models.remove(&id.source);
                continue;
            };
            if !self.models.get(&id.source).is_some_and(|held| Arc::ptr_eq(&held.model, &modelled.model)) {
                self.add_model(id.source, &modelled);
            }
            if let (Some(pose), Some(held)) = (id.pose, self.models.get_mut(&id.source))
                && !held.poses.want(pose, self.now)
            {
                missing.push((*id, pose, modelled));
            }
        }
        self.add_poses(missing);
    }

    fn add_model(&mut self, id: Source, modelled: &Modelled<'_>) {
        let mesh = ModelMesh::of(modelled.size, &modelled.model, None);
        let soup = Soup::of_model(&mesh);
        let (tree, start) = (soup.tree(), self.pieces.len());
        let shape = self.add(&soup, &tree);
        let length = self.pieces.len() - start;
        let poses = Poses::of_bytes(length as u64 * 16);
        self.models.insert(
            id,
            Held { model: Arc::clone(&modelled.model), tree: Arc::new(tree), length, shape, poses },
        );
    }

    /// Adds poses in place of others, or behind everything, by as many threads as there are.
    fn add_poses(&mut self, missing: Vec<(ModelId, RigPose, Modelled<'_>)>) {
        let mut jobs = Vec::with_capacity(missing.len());
        for (id, pose, modelled) in missing {
            let Some(held) = self.models.get_mut(&id.source) else { continue };
            let spare = held.poses.spare(self.now);
            let start = spare.map_or(self.pieces.len(), |(start, _)| start);
            // Every pose of a model has as many pieces.
            let end = start + held.length;
            self.pieces.resize(self.pieces.len().max(end), [0; 4]);
            if spare.is_some() {
                self.rewritten.push(start..end);
            }
            // Its place is its own from now on.
            held.poses.keep(pose, (start, held.shape), self.now);
            jobs.push((id.source, pose, start, modelled, Arc::clone(&held.tree)));
        }
        let coded = threads::each(jobs, |(id, pose, start, modelled, tree)| {
            let mesh = ModelMesh::of(modelled.size, &modelled.model, Some(pose));
            (id, pose, start, Soup::of_model(&mesh).coded(&tree, start as u32))
        });
        for (id, pose, start, (pieces, shape)) in coded {
            self.pieces[start..start + pieces.len()].copy_from_slice(&pieces);
            if let Some(held) = self.models.get_mut(&id) {
                held.poses.keep(pose, (start, shape), self.now);
            }
        }
    }

    fn add(&mut self, soup: &Soup<'_>, tree: &Tree) -> Shape {
        let (mut pieces, shape) = soup.coded(tree, self.pieces.len() as u32);
        self.pieces.append(&mut pieces);
        shape
    }
}
