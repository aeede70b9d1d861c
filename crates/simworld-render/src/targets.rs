//! The images that a camera is drawn into, and the buffers through which they come back.

use crate::device::Gpu;
use crate::{Frame, RenderError};

pub(crate) const COLOR: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;
pub(crate) const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::R32Float;
pub(crate) const IDS: wgpu::TextureFormat = wgpu::TextureFormat::Rg32Uint;
pub(crate) const Z: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// One image with its way back.
struct Target {
    texture: wgpu::Texture,
    view: wgpu::TextureView,
    buffer: wgpu::Buffer,
    bytes_per_pixel: u32,
    row: u32,
}

impl Target {
    fn new(gpu: &Gpu, (width, height): (u32, u32), format: wgpu::TextureFormat, bytes_per_pixel: u32) -> Self {
        let texture = texture(gpu, (width, height), format, wgpu::TextureUsages::COPY_SRC);
        let row = (width * bytes_per_pixel).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: u64::from(row) * u64::from(height),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        Self { texture, view, buffer, bytes_per_pixel, row }
    }

    fn copy(&self, encoder: &mut wgpu::CommandEncoder) {
        let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(self.row), rows_per_image: None };
        encoder.copy_texture_to_buffer(
            self.texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo { buffer: &self.buffer, layout },
            self.texture.size(),
        );
    }

    /// Hands each row, without padding, to the reader.
    fn read(&self, mut reader: impl FnMut(&[u8])) -> Result<(), RenderError> {
        let failed = |reason: String| RenderError::Drawing { reason };
        let mapped = self.buffer.get_mapped_range(..).map_err(|error| failed(error.to_string()))?;
        let length = (self.texture.width() * self.bytes_per_pixel) as usize;
        for row in mapped.chunks_exact(self.row as usize) {
            reader(&row[..length]);
        }
        drop(mapped);
        self.buffer.unmap();
        Ok(())
    }
}

fn texture(
    gpu: &Gpu,
    (width, height): (u32, u32),
    format: wgpu::TextureFormat,
    more: wgpu::TextureUsages,
) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | more,
        view_formats: &[],
    })
}

/// A depth image that may be sampled: the shadow map.
pub(crate) fn depth_view(gpu: &Gpu, size: u32) -> wgpu::TextureView {
    texture(gpu, (size, size), Z, wgpu::TextureUsages::TEXTURE_BINDING)
        .create_view(&wgpu::TextureViewDescriptor::default())
}

/// Colour, depth and ids of one size.
pub(crate) struct Targets {
    pub(crate) size: (u32, u32),
    color: Target,
    depth: Target,
    ids: Target,
    z: wgpu::TextureView,
}

impl Targets {
    pub(crate) fn new(gpu: &Gpu, size: (u32, u32)) -> Self {
        let z = texture(gpu, size, Z, wgpu::TextureUsages::empty());
        Self {
            size,
            color: Target::new(gpu, size, COLOR, 4),
            depth: Target::new(gpu, size, DEPTH, 4),
            ids: Target::new(gpu, size, IDS, 8),
            z: z.create_view(&wgpu::TextureViewDescriptor::default()),
        }
    }

    /// Begins the pass that draws all three.
    pub(crate) fn pass<'e>(&self, encoder: &'e mut wgpu::CommandEncoder) -> wgpu::RenderPass<'e> {
        let attach = |view| {
            Some(wgpu::RenderPassColorAttachment {
                view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                    store: wgpu::StoreOp::Store,
                },
            })
        };
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("scene"),
            color_attachments: &[attach(&self.color.view), attach(&self.depth.view), attach(&self.ids.view)],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.z,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Discard }),
                stencil_ops: None,
            }),
            ..wgpu::RenderPassDescriptor::default()
        })
    }

    pub(crate) fn copy(&self, encoder: &mut wgpu::CommandEncoder) {
        for target in [&self.color, &self.depth, &self.ids] {
            target.copy(encoder);
        }
    }

    /// Waits for the pictures and writes them over the frame.
    pub(crate) fn read(&self, gpu: &Gpu, frame: &mut Frame) -> Result<(), RenderError> {
        for target in [&self.color, &self.depth, &self.ids] {
            target.buffer.map_async(wgpu::MapMode::Read, .., |_| {});
        }
        gpu.device
            .poll(wgpu::PollType::Wait { submission_index: None, timeout: None })
            .map_err(|error| RenderError::Drawing { reason: error.to_string() })?;
        gpu.check()?;
        (frame.width, frame.height) = self.size;
        frame.rgb.clear();
        frame.depth.clear();
        frame.instances.clear();
        frame.classes.clear();
        self.color.read(|row| {
            frame.rgb.extend(row.as_chunks::<4>().0.iter().flat_map(|[r, g, b, _]| [*r, *g, *b]));
        })?;
        self.depth.read(|row| frame.depth.extend(row.as_chunks::<4>().0.iter().map(|bytes| f32::from_le_bytes(*bytes))))?;
        self.ids.read(|row| {
            for [a, b, c, d, class, ..] in row.as_chunks::<8>().0 {
                frame.instances.push(u32::from_le_bytes([*a, *b, *c, *d]));
                frame.classes.push(*class);
            }
        })
    }
}
