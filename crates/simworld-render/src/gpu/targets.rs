//! The textures that a picture is drawn into, and the buffer through which it comes back.

use super::device::Gpu;
use crate::config::AntiAliasing;

pub(crate) const COLOR: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;
pub(crate) const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::R32Float;
pub(crate) const ID: wgpu::TextureFormat = wgpu::TextureFormat::R32Uint;
pub(crate) const Z: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// Samples a pixel of smoothed RGB.
pub(crate) const SAMPLES: u32 = 4;

/// The textures of one picture size.
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
    pub readback: wgpu::Buffer,
    /// Bytes of a row in the readback buffer, padded as copies want it.
    pub row_bytes: u32,
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
        let row_bytes = (width * 4).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let readback = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("readback"),
            size: 3 * u64::from(row_bytes) * u64::from(height),
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
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
            readback,
            row_bytes,
        }
    }
}
