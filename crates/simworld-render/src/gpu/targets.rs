//! The textures that pictures are drawn into, one after the other.

use super::device::Gpu;
use super::planes::Planes;
use crate::batch::{Channels, Span};
use crate::config::AntiAliasing;

pub(crate) const COLOR: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;
pub(crate) const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::R32Float;
pub(crate) const ID: wgpu::TextureFormat = wgpu::TextureFormat::R32Uint;
pub(crate) const Z: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// Samples a pixel of smoothed RGB.
pub(crate) const SAMPLES: u32 = 4;

/// The textures of pictures up to one size; smaller ones lie in the upper left corner.
pub(crate) struct Targets {
    pub width: u32,
    pub height: u32,
    pub color: wgpu::Texture,
    pub depth: wgpu::Texture,
    pub id: wgpu::Texture,
    pub color_view: wgpu::TextureView,
    pub depth_view: wgpu::TextureView,
    pub id_view: wgpu::TextureView,
    pub z: wgpu::TextureView,
    /// Colour and z with several samples a pixel, where RGB is smoothed.
    pub smooth: Option<[wgpu::TextureView; 2]>,
}

impl Targets {
    pub(crate) fn new(gpu: &Gpu, width: u32, height: u32, smoothing: AntiAliasing) -> Self {
        let texture = |label, format, samples, usage| {
            gpu.device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count: samples,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT | usage,
                view_formats: &[],
            })
        };
        let (drawn, copied) = (wgpu::TextureUsages::empty(), wgpu::TextureUsages::COPY_SRC);
        let view = |texture: &wgpu::Texture| texture.create_view(&wgpu::TextureViewDescriptor::default());
        let color = texture("color", COLOR, 1, copied);
        let depth = texture("depth", DEPTH, 1, copied);
        let id = texture("id", ID, 1, copied);
        Self {
            width,
            height,
            color_view: view(&color),
            depth_view: view(&depth),
            id_view: view(&id),
            color,
            depth,
            id,
            z: view(&texture("z", Z, 1, drawn)),
            smooth: (smoothing == AntiAliasing::Msaa4).then(|| {
                let color = texture("smooth color", COLOR, SAMPLES, drawn);
                let z = texture("smooth z", Z, SAMPLES, drawn);
                [view(&color), view(&z)]
            }),
        }
    }
}

impl Targets {
    /// Records the copies of what was drawn of a view into the planes.
    pub(crate) fn copy(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        planes: &Planes,
        span: &Span,
        channels: Channels,
    ) {
        let measures = (channels - Channels::NORMALS) != Channels::RGB;
        let wanted = [channels.contains(Channels::RGB), measures, measures];
        let textures = [&self.color, &self.depth, &self.id];
        for ((texture, buffer), _) in
            textures.iter().zip(&planes.raw).zip(wanted).filter(|(_, wanted)| *wanted)
        {
            Self::copy_one(encoder, texture, buffer, span);
        }
    }

    /// Records the copy of a view from a texture into a plane of four bytes a pixel.
    pub(crate) fn copy_one(
        encoder: &mut wgpu::CommandEncoder,
        texture: &wgpu::Texture,
        buffer: &wgpu::Buffer,
        span: &Span,
    ) {
        let layout = wgpu::TexelCopyBufferLayout {
            offset: span.first as u64 * 4,
            bytes_per_row: Some(span.pitch * 4),
            rows_per_image: Some(span.height),
        };
        encoder.copy_texture_to_buffer(
            texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo { buffer, layout },
            wgpu::Extent3d { width: span.width, height: span.height, depth_or_array_layers: 1 },
        );
    }
}
