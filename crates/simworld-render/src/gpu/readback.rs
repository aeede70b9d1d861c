//! From textures to the caller's frame.

use std::sync::mpsc;

use simworld_core::id::EntityId;

use super::device::Gpu;
use super::targets::Targets;
use crate::{Frame, RenderError};

impl Targets {
    /// Records the copies of all three textures into the readback buffer.
    pub(crate) fn copy_back(&self, encoder: &mut wgpu::CommandEncoder) {
        let plane = u64::from(self.row_bytes) * u64::from(self.height);
        for (offset, texture) in [(0, &self.color), (plane, &self.depth), (2 * plane, &self.id)] {
            encoder.copy_texture_to_buffer(
                texture.as_image_copy(),
                wgpu::TexelCopyBufferInfo {
                    buffer: &self.readback,
                    layout: wgpu::TexelCopyBufferLayout {
                        offset,
                        bytes_per_row: Some(self.row_bytes),
                        rows_per_image: Some(self.height),
                    },
                },
                wgpu::Extent3d { width: self.width, height: self.height, depth_or_array_layers: 1 },
            );
        }
    }

    /// Waits for the copies and unpacks them; `entities` are the instances in the order they were drawn.
    pub(crate) fn unpack(
        &self,
        gpu: &Gpu,
        entities: &[(EntityId, u8)],
        frame: &mut Frame,
    ) -> Result<(), RenderError> {
        let (sender, receiver) = mpsc::channel();
        self.readback.map_async(wgpu::MapMode::Read, .., move |outcome| {
            // The receiver waits below; if it gave up, nobody needs the outcome.
            let _ = sender.send(outcome);
        });
        gpu.wait()?;
        let failed = |reason: String| RenderError::Device(reason);
        receiver
            .try_recv()
            .map_err(|error| failed(error.to_string()))?
            .map_err(|error| failed(error.to_string()))?;
        let view = self.readback.get_mapped_range(..).map_err(|error| failed(error.to_string()))?;
        self.unpack_planes(&view, entities, frame);
        drop(view);
        self.readback.unmap();
        Ok(())
    }

    fn unpack_planes(&self, bytes: &[u8], entities: &[(EntityId, u8)], frame: &mut Frame) {
        frame.resize(self.width, self.height);
        frame.drawn.extend(entities.iter().map(|(id, _)| *id));
        frame.drawn.sort_unstable();
        let plane = self.row_bytes as usize * self.height as usize;
        let (color, rest) = bytes.split_at(plane);
        let (depth, id) = rest.split_at(plane);
        let width = self.width as usize;
        for y in 0..self.height as usize {
            let source = y * self.row_bytes as usize..y * self.row_bytes as usize + 4 * width;
            let first = y * width;
            let rgb = &mut frame.rgb[3 * first..3 * (first + width)];
            for (pixel, rgba) in rgb.chunks_exact_mut(3).zip(color[source.clone()].chunks_exact(4)) {
                pixel.copy_from_slice(&rgba[..3]);
            }
            let words = depth[source.clone()].chunks_exact(4).zip(id[source].chunks_exact(4));
            for (index, (depth, number)) in (first..).zip(words) {
                let number = u32::from_le_bytes([number[0], number[1], number[2], number[3]]);
                let Some((entity, class)) = (number as usize).checked_sub(1).and_then(|n| entities.get(n))
                else {
                    continue;
                };
                frame.depth[index] = f32::from_le_bytes([depth[0], depth[1], depth[2], depth[3]]);
                frame.ids[index] = entity.index() as u32 + 1;
                frame.classes[index] = *class;
            }
        }
    }
}
