//! Models of assets on the device: uploaded once, drawn as often as entities are made from them.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::sync::Arc;

use simworld_core::asset::{Asset, Model, ModelPart, Paint, PosedModel, RigPose, Transparency};
use simworld_core::geometry::Vector3;
use simworld_core::id::AssetId;
use simworld_core::scene::{EntityRef, Scene};

use crate::RenderError;
use crate::gpu::{Gpu, Matter, TANGENTS};
use crate::mesh::{ModelId, Vertex};
use crate::poses::Poses;
use crate::sources::{Modelled, Source, Sources};
use crate::tangent::packed_tangent;
use crate::threads;

/// Says that a material is a colour of its own: 10 bits a channel, as square roots.
const OWN_COLOR: u32 = 1 << 31;
/// Says that the colour is a factor of that of the entity.
const ENTITY_COLOR: u32 = 1 << 30;

/// Those that were drawn so far and still belong to a world.
#[derive(Default)]
pub(crate) struct Models {
    held: BTreeMap<Source, Held>,
    /// Grows with every look.
    now: u64,
}

/// One on the device.
struct Held {
    /// Another scene may have another one under the same id.
    model: Arc<Model>,
    /// At rest; behind them, from this byte on, their tangents.
    vertices: wgpu::Buffer,
    tangents: u64,
    indices: wgpu::Buffer,
    /// Of the corners, those of what is cut out come behind those of what is whole, and those of what is blended last.
    count: u32,
    cut_from: u32,
    film_from: u32,
    /// Its vertices in other poses.
    poses: Poses<wgpu::Buffer>,
}

impl Models {
    /// Whether there are none.
    pub(crate) fn is_empty(&self) -> bool {
        self.held.is_empty()
    }

    /// Uploads the models of a list that are not on the device yet, in their poses, and lets go of those that no scene has any more. True
    /// if there were any of the first.
    pub(crate) fn hold(
        &mut self,
        gpu: &Gpu,
        sources: Sources<'_>,
        drawn: impl IntoIterator<Item = ModelId>,
    ) -> Result<bool, RenderError> {
        self.held.retain(|_, held| Arc::strong_count(&held.model) > 1);
        self.now += 1;
        let wanted: BTreeSet<ModelId> = drawn.into_iter().collect();
        let mut is_new = false;
        let mut missing = Vec::new();
        for ModelId { source: id, pose } in wanted {
            let Some(modelled) = sources.find(id) else { continue };
            if !self.held.get(&id).is_some_and(|held| Arc::ptr_eq(&held.model, &modelled.model)) {
                self.held.insert(id, Held::upload(gpu, &modelled)?);
                is_new = true;
            }
            if let (Some(pose), Some(held)) = (pose, self.held.get_mut(&id))
                && !held.poses.want(pose, self.now)
            {
                missing.push((id, modelled, pose));
            }
        }
        is_new |= !missing.is_empty();
        let posed = threads::each(missing, |(id, modelled, pose)| {
            (id, pose, ModelMesh::of(modelled.size, &modelled.model, Some(pose)).in_triangles())
        });
        for (id, pose, bytes) in posed {
            let Some(held) = self.held.get_mut(&id) else { continue };
            let buffer = match held.poses.spare(self.now) {
                Some(spare) => {
                    gpu.queue.write_buffer(&spare, 0, &bytes);
                    spare
                }
                None => gpu.upload("pose", wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_DST, &bytes),
            };
            held.poses.keep(pose, buffer, self.now);
        }
        Ok(is_new)
    }

    /// The corners of a model that are of that matter; `None` where it has none of these.
    pub(crate) fn corners(&self, id: ModelId, matter: Matter) -> Option<Range<u32>> {
        let held = self.held.get(&id.source)?;
        let corners = match matter {
            Matter::Whole => 0..held.cut_from,
            Matter::Cut => held.cut_from..held.film_from,
            Matter::Film => held.film_from..held.count,
        };
        (!corners.is_empty()).then_some(corners)
    }

    /// Makes a model, in its pose, what the next draws of a pass read.
    pub(crate) fn bind(&self, pass: &mut wgpu::RenderPass<'_>, id: ModelId) {
        let Some(held) = self.held.get(&id.source) else { return };
        let vertices = id.pose.and_then(|pose| held.poses.get(pose)).unwrap_or(&held.vertices);
        pass.set_vertex_buffer(0, vertices.slice(..held.tangents));
        pass.set_vertex_buffer(TANGENTS, vertices.slice(held.tangents..));
        pass.set_index_buffer(held.indices.slice(..), wgpu::IndexFormat::Uint32);
    }
}

impl ModelId {
    /// The model of an asset as an entity that has it plays it now.
    pub(crate) fn of(
        entity: &EntityRef<'_>,
        id: AssetId,
        (asset, model): (&Asset, &Arc<Model>),
        scene: &dyn Scene,
    ) -> Self {
        let pose = model.rig.as_ref().map(|rig| entity.rig_pose(asset, rig, scene));
        Self { source: Source::Asset(id), pose: pose.filter(|pose| !pose.is_rest()) }
    }
}

impl Held {
    fn upload(gpu: &Gpu, modelled: &Modelled<'_>) -> Result<Self, RenderError> {
        let mesh = ModelMesh::of(modelled.size, &modelled.model, None);
        let (cut_from, film_from) = (mesh.cut_from as u32, mesh.film_from as u32);
        let indices = mesh.indices.clone();
        let tangents = size_of_val(&mesh.vertices[..]) as u64;
        let vertices = mesh.in_triangles();
        let largest = vertices.len().max(size_of_val(&indices[..])) as u64;
        let limit = gpu.device.limits().max_buffer_size;
        if largest > limit {
            return Err(RenderError::Model { name: modelled.name.to_owned(), bytes: largest, limit });
        }
        let buffer = |usage, bytes: &[u8]| gpu.upload("model", usage, bytes);
        Ok(Self {
            model: Arc::clone(&modelled.model),
            vertices: buffer(wgpu::BufferUsages::VERTEX, &vertices),
            tangents,
            indices: buffer(wgpu::BufferUsages::INDEX, bytemuck::cast_slice(&indices)),
            count: indices.len() as u32,
            cut_from,
            film_from,
            poses: Poses::of_bytes(vertices.len() as u64),
        })
    }
}

/// A model as both backends read it.
pub(crate) struct ModelMesh {
    /// Points in shares of the collider's box, so that an entity of another size stretches the model; normals as they stand on the
    /// surface in that unit box.
    pub vertices: Vec<Vertex>,
    /// By vertex, the place on the pictures of its part, which part that is, and how much is there of it. In triangles these stand where other
    /// meshes have their offsets, whose unit is zero in instances of models.
    pub spots: Vec<[f32; 4]>,
    /// By vertex, its tangent in the unit box, [packed](packed_tangent).
    pub tangents: Vec<u32>,
    pub indices: Vec<u32>,
    /// From this index on, corners are those of parts that are cut out, and from the other on those of parts that are blended.
    pub cut_from: usize,
    pub film_from: usize,
}

/// What the triangles of a part are.
pub(crate) const fn matter_of(part: &ModelPart) -> Matter {
    match part.transparency {
        Transparency::Opaque => Matter::Whole,
        Transparency::Cutout { .. } => Matter::Cut,
        Transparency::Blend => Matter::Film,
    }
}

/// How much has to be there of a part so that it counts: that it is seen, and of what is blended that it has depth and is who is met, of which it is a half. None of what is opaque.
pub(crate) fn cutoff_of(part: &ModelPart) -> Option<f32> {
    match part.transparency {
        Transparency::Opaque => None,
        Transparency::Cutout { cutoff } => Some(cutoff),
        Transparency::Blend => Some(0.5),
    }
}

fn is_cut(part: &ModelPart) -> bool {
    cutoff_of(part).is_some()
}

/// Where the corners of a model are, at rest or in a pose.
struct Corners<'a> {
    model: &'a Model,
    posed: Option<PosedModel>,
    tangents: Cow<'a, [[f32; 4]]>,
}

impl<'a> Corners<'a> {
    fn new(model: &'a Model, pose: Option<RigPose>) -> Self {
        let rest = &model.tangents[..];
        let Some((pose, rig)) = pose.zip(model.rig.as_ref()) else {
            return Self { model, posed: None, tangents: Cow::Borrowed(rest) };
        };
        let tangents = if rest.is_empty() { Vec::new() } else { rig.tangents(rest, pose) };
        Self { model, posed: Some(rig.posed(pose)), tangents: Cow::Owned(tangents) }
    }

    /// Where a corner is, m, and its normal.
    fn at(&self, corner: usize) -> ([f32; 3], [f32; 3]) {
        let own = &self.model.vertices[corner];
        let Some(posed) = &self.posed else { return (own.position, own.normal) };
        let turned = posed.normals[corner];
        (posed.positions[corner], if turned == [0.0; 3] { own.normal } else { turned })
    }

    /// The tangent of a corner in a box of that size. Seen from the back the top of pictures is to the other side of their right.
    fn tangent(&self, corner: usize, size: [f32; 3], is_back: bool) -> u32 {
        let [x, y, z, side] = self.tangents.get(corner).copied().unwrap_or_default();
        packed_tangent([x / size[0], y / size[1], z / size[2]], if is_back { -side } else { side })
    }
}

impl ModelMesh {
    /// A model in a box of that size (m) at rest, or in a pose; vertices and triangles are the same ones in all of them. What has two sides has a back: the same
    /// triangles the other way round, whose normals point back, so that whoever looks, lights or throws shadows knows of one side alone.
    pub(crate) fn of(size: Vector3, model: &Model, pose: Option<RigPose>) -> Self {
        const NOBODY: ((u32, bool), u32) = ((u32::MAX, false), 0);
        let size: [f32; 3] = [size.x as f32, size.y as f32, size.z as f32];
        let corners = Corners::new(model, pose);
        let mut mesh = Self {
            vertices: Vec::with_capacity(model.vertices.len()),
            spots: Vec::with_capacity(model.vertices.len()),
            tangents: Vec::with_capacity(model.vertices.len()),
            indices: Vec::with_capacity(model.triangles.len() * 3),
            cut_from: 0,
            film_from: 0,
        };
        // By vertex of the model, the part that had it last, and which it is there: parts that share one have one each.
        let mut homes = vec![NOBODY; model.vertices.len()];
        let runs = || (0..).zip(model.runs());
        let of = |matter: Matter| runs().filter(move |(_, (part, _))| matter_of(part) == matter);
        let ordered = Matter::ALL.into_iter().flat_map(of);
        for (number, (part, triangles), is_back) in ordered.flat_map(|(number, run)| {
            let sides = if run.0.two_sided { &[false, true][..] } else { &[false] };
            sides.iter().map(move |is_back| (number, run, *is_back))
        }) {
            let matter = matter_of(part);
            mesh.cut_from += if matter == Matter::Whole { triangles.len() * 3 } else { 0 };
            mesh.film_from += if matter == Matter::Film { 0 } else { triangles.len() * 3 };
            for corner in triangles.iter().flat_map(|[a, b, c]| if is_back { [a, c, b] } else { [a, b, c] }) {
                let home = &mut homes[*corner as usize];
                if home.0 != (number, is_back) {
                    *home = ((number, is_back), mesh.vertices.len() as u32);
                    mesh.add(&corners, *corner as usize, size, (number, part, is_back));
                }
                mesh.indices.push(home.1);
            }
        }
        mesh
    }

    /// Adds a corner of a model in a box of that size, of a part that has that number, or of its back.
    fn add(
        &mut self,
        corners: &Corners<'_>,
        corner: usize,
        size: [f32; 3],
        (number, part, is_back): (u32, &ModelPart, bool),
    ) {
        let vertex = &corners.model.vertices[corner];
        let (position, normal) = corners.at(corner);
        let outward = if is_back { -1.0 } else { 1.0 };
        let factor = if part.paint == Paint::Entity { ENTITY_COLOR } else { 0 };
        self.vertices.push(Vertex {
            anchor: std::array::from_fn(|axis| position[axis] / size[axis]),
            offset: [0.0; 3],
            normal: std::array::from_fn(|axis| outward * normal[axis] * size[axis]),
            material: packed(vertex.color) | factor,
        });
        let [right, down] = vertex.place;
        // In steps that triangles have too; rounded up, so that what is just enough stays enough.
        let alpha = if is_cut(part) { (vertex.alpha * 256.0).ceil() / 256.0 } else { 1.0 };
        self.spots.push([right, down, number as f32, alpha]);
        self.tangents.push(corners.tangent(corner, size, is_back));
    }

    /// Its vertices with the places on pictures and the parts where other meshes have their offsets, as shaders/store.wgsl reads them; and behind them their
    /// tangents, as shaders/models.wgsl does.
    fn in_triangles(mut self) -> Vec<u8> {
        for (vertex, [right, down, part, alpha]) in self.vertices.iter_mut().zip(self.spots) {
            vertex.offset = [right, down, part + (1.0 - alpha) * 0.5];
        }
        let (vertices, tangents): (&[u8], &[u8]) =
            (bytemuck::cast_slice(&self.vertices), bytemuck::cast_slice(&self.tangents));
        [vertices, tangents].concat()
    }
}

fn packed(color: [f32; 3]) -> u32 {
    let [r, g, b] = color.map(|channel| (channel.clamp(0.0, 1.0).sqrt() * 1023.0).round() as u32);
    OWN_COLOR | r << 20 | g << 10 | b
}

#[cfg(test)]
mod tests {
    use simworld_core::asset::{ModelPart, ModelVertex};

    use super::*;

    #[test]
    fn parts_that_share_a_vertex_have_one_each() {
        let part = |paint| ModelPart { triangles: 1, paint, ..ModelPart::default() };
        let model = Model {
            vertices: vec![ModelVertex::default(); 4],
            triangles: vec![[0, 1, 2], [2, 1, 3]],
            parts: vec![part(Paint::Own), part(Paint::Entity)],
            ..Model::default()
        };
        let ModelMesh { vertices, spots, indices, .. } = ModelMesh::of(Vector3::repeat(1.0), &model, None);
        assert_eq!(indices, [0, 1, 2, 3, 4, 5]);
        assert_eq!(spots.iter().map(|spot| spot[2]).collect::<Vec<_>>(), [0.0, 0.0, 0.0, 1.0, 1.0, 1.0]);
        let of_entity: Vec<bool> =
            vertices.iter().map(|vertex| vertex.material & ENTITY_COLOR != 0).collect();
        assert_eq!(of_entity, [false, false, false, true, true, true]);
    }

    #[test]
    fn two_sides_are_two_surfaces() {
        let part = |two_sided| ModelPart {
            triangles: 1,
            two_sided,
            transparency: Transparency::Blend,
            ..ModelPart::default()
        };
        let vertex = |x: f32, y: f32| ModelVertex {
            position: [x, y, 0.0],
            normal: [0.0, 0.0, 1.0],
            ..ModelVertex::default()
        };
        let model = Model {
            vertices: vec![vertex(0.0, 0.0), vertex(1.0, 0.0), vertex(0.0, 1.0)],
            triangles: vec![[0, 1, 2]; 2],
            parts: vec![part(true), ModelPart { transparency: Transparency::Opaque, ..part(false) }],
            ..Model::default()
        };
        let mesh = ModelMesh::of(Vector3::repeat(1.0), &model, None);
        assert_eq!((mesh.cut_from, mesh.film_from), (3, 3));
        assert_eq!(mesh.indices, [0, 1, 2, 3, 4, 5, 6, 7, 8]);
        assert_eq!(
            mesh.spots.iter().map(|spot| spot[2]).collect::<Vec<_>>(),
            [[1.0; 3], [0.0; 3], [0.0; 3]].concat()
        );
        for (triangle, up) in mesh.vertices.chunks(3).zip([1.0, 1.0, -1.0]) {
            let [a, b, c] = [0, 1, 2].map(|corner| Vector3::from(triangle[corner].anchor.map(f64::from)));
            assert_eq!((b - a).cross(&(c - a)).z, up);
            assert!(triangle.iter().all(|vertex| f64::from(vertex.normal[2]) == up));
        }
    }

    #[test]
    fn what_is_whole_comes_first_and_what_is_blended_last() {
        let part = |transparency| ModelPart { triangles: 1, transparency, ..ModelPart::default() };
        let cut = Transparency::Cutout { cutoff: 0.5 };
        let model = Model {
            vertices: vec![ModelVertex::default(); 3],
            triangles: vec![[0, 1, 2]; 5],
            parts: [Transparency::Blend, cut, Transparency::Opaque, cut, Transparency::Blend]
                .map(part)
                .to_vec(),
            ..Model::default()
        };
        let mesh = ModelMesh::of(Vector3::repeat(1.0), &model, None);
        assert_eq!((mesh.cut_from, mesh.film_from, mesh.indices.len()), (3, 9, 15));
        let numbers: Vec<f32> = mesh.spots.iter().step_by(3).map(|spot| spot[2]).collect();
        assert_eq!(numbers, [2.0, 1.0, 3.0, 0.0, 4.0]);
    }

    #[test]
    fn a_colour_survives_packing() {
        for channel in [0.0, 0.003, 0.05, 0.2, 0.77, 1.0] {
            let bits = packed([0.0, channel, 0.0]);
            assert_eq!(bits & OWN_COLOR, OWN_COLOR);
            let back = f64::from(bits >> 10 & 1023) / 1023.0;
            assert!((back * back - f64::from(channel)).abs() < 1e-3, "{channel}: {}", back * back);
        }
    }
}
