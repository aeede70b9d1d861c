//! Models of assets on the device: uploaded once, drawn as often as entities are made from them.

use std::collections::BTreeMap;
use std::sync::Arc;

use simworld_core::asset::{Asset, Model, Paint};
use simworld_core::id::AssetId;
use simworld_core::scene::Scene;

use crate::RenderError;
use crate::draw_list::Batch;
use crate::gpu::Gpu;
use crate::mesh::{Drawn, Vertex};

/// Says that a material is a colour of its own: 10 bits a channel, as square roots.
const OWN_COLOR: u32 = 1 << 31;
/// Says that the colour is a factor of that of the entity.
const ENTITY_COLOR: u32 = 1 << 30;

/// Those that were drawn so far and still belong to a world.
#[derive(Default)]
pub(crate) struct Models {
    held: BTreeMap<AssetId, Held>,
}

/// One on the device.
struct Held {
    /// Another scene may have another one under the same id.
    model: Arc<Model>,
    vertices: wgpu::Buffer,
    indices: wgpu::Buffer,
    count: u32,
}

impl Models {
    /// Whether there are none.
    pub(crate) fn is_empty(&self) -> bool {
        self.held.is_empty()
    }

    /// Uploads the models of a list that are not on the device yet, and lets go of those that no scene has any more. True if there
    /// were any of the first.
    pub(crate) fn hold(
        &mut self,
        gpu: &Gpu,
        scene: &dyn Scene,
        batches: &[&[Batch]],
    ) -> Result<bool, RenderError> {
        let mut is_new = false;
        self.held.retain(|_, held| Arc::strong_count(&held.model) > 1);
        for batch in batches.iter().copied().flatten() {
            let Drawn::Model(id) = batch.mesh else { continue };
            let Some((asset, model)) = model_of(scene, id) else { continue };
            if self.held.get(&id).is_some_and(|held| Arc::ptr_eq(&held.model, model)) {
                continue;
            }
            let held = Held::upload(gpu, asset, model)?;
            self.held.insert(id, held);
            is_new = true;
        }
        Ok(is_new)
    }

    /// Draws a batch of a model.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, id: AssetId, instances: std::ops::Range<u32>) {
        let Some(held) = self.held.get(&id) else { return };
        pass.set_vertex_buffer(0, held.vertices.slice(..));
        pass.set_index_buffer(held.indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..held.count, 0, instances);
    }
}

/// The asset of an id, if it has a model.
pub(crate) fn model_of(scene: &dyn Scene, id: AssetId) -> Option<(&Asset, &Arc<Model>)> {
    let asset = scene.assets()?.get(id)?;
    Some((asset, asset.model.as_ref()?))
}

impl Held {
    fn upload(gpu: &Gpu, asset: &Asset, model: &Arc<Model>) -> Result<Self, RenderError> {
        let vertices = vertices_of(asset, model);
        let indices: &[u32] = model.triangles.as_flattened();
        let largest = size_of_val(&vertices[..]).max(size_of_val(indices)) as u64;
        let limit = gpu.device.limits().max_buffer_size;
        if largest > limit {
            return Err(RenderError::Model { name: asset.name.clone(), bytes: largest, limit });
        }
        let buffer = |usage, bytes: &[u8]| gpu.upload("model", usage, bytes);
        Ok(Self {
            model: Arc::clone(model),
            vertices: buffer(wgpu::BufferUsages::VERTEX, bytemuck::cast_slice(&vertices)),
            indices: buffer(wgpu::BufferUsages::INDEX, bytemuck::cast_slice(indices)),
            count: indices.len() as u32,
        })
    }
}

/// Points in shares of the collider's box, so that an entity of another size stretches the model; normals as they stand on
/// the surface in that unit box.
pub(crate) fn vertices_of(asset: &Asset, model: &Model) -> Vec<Vertex> {
    let size = asset.collider.size();
    let size: [f32; 3] = [size.x as f32, size.y as f32, size.z as f32];
    let mut paints = vec![Paint::Own; model.vertices.len()];
    for (part, triangles) in model.runs() {
        // Who shares a vertex between parts of unlike paint gives it the later one's.
        for vertex in triangles.as_flattened() {
            paints[*vertex as usize] = part.paint;
        }
    }
    let vertex = |(vertex, paint): (&simworld_core::asset::ModelVertex, &Paint)| Vertex {
        anchor: std::array::from_fn(|axis| vertex.position[axis] / size[axis]),
        offset: [0.0; 3],
        normal: std::array::from_fn(|axis| vertex.normal[axis] * size[axis]),
        material: packed(vertex.color) | if *paint == Paint::Entity { ENTITY_COLOR } else { 0 },
    };
    model.vertices.iter().zip(&paints).map(vertex).collect()
}

fn packed(color: [f32; 3]) -> u32 {
    let [r, g, b] = color.map(|channel| (channel.clamp(0.0, 1.0).sqrt() * 1023.0).round() as u32);
    OWN_COLOR | r << 20 | g << 10 | b
}

#[cfg(test)]
mod tests {
    use super::*;

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
