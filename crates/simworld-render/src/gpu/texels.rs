//! The store of pictures on the device: rows of texels in the layers of one texture, read one by one, so that pictures of any size and their smaller
//! levels lie behind one another, and every backend blends them by the same arithmetic.

use super::device::Gpu;

/// Texels in a row, and rows in a layer; as in shaders/models.wgsl.
pub(crate) const ROW: u32 = 1024;

/// A texel takes so many bytes.
const TEXEL: u32 = 4;

/// The most layers, which every adapter has: 1 GiB.
pub(crate) const MOST_LAYERS: u32 = 256;

/// Bytes of a layer.
pub(crate) const LAYER: u64 = ROW as u64 * ROW as u64 * TEXEL as u64;

/// The texture, and what it is bound by.
pub(crate) struct Texels {
    layout: wgpu::BindGroupLayout,
    texture: wgpu::Texture,
    group: wgpu::BindGroup,
}

impl Texels {
    pub(crate) fn new(gpu: &Gpu) -> Self {
        let layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("pictures"),
            entries: &[wgpu::BindGroupLayoutEntry {
                binding: 0,
                visibility: wgpu::ShaderStages::FRAGMENT | wgpu::ShaderStages::COMPUTE,
                ty: wgpu::BindingType::Texture {
                    sample_type: wgpu::TextureSampleType::Float { filterable: false },
                    view_dimension: wgpu::TextureViewDimension::D2Array,
                    multisampled: false,
                },
                count: None,
            }],
        });
        // Scenes without pictures have one that nobody reads.
        let (texture, group) = made(gpu, &layout, [1, 1, 1]);
        Self { layout, texture, group }
    }

    pub(crate) const fn layout(&self) -> &wgpu::BindGroupLayout {
        &self.layout
    }

    pub(crate) const fn group(&self) -> &wgpu::BindGroup {
        &self.group
    }

    /// Rows that there is room for.
    pub(crate) fn rows(&self) -> u32 {
        let size = self.texture.size();
        if size.width == ROW { size.depth_or_array_layers * ROW } else { 0 }
    }

    /// Makes room for so many rows in place of all that is there.
    pub(crate) fn replace(&mut self, gpu: &Gpu, rows: u32) {
        let layers = rows.div_ceil(ROW).next_power_of_two().min(MOST_LAYERS);
        (self.texture, self.group) = made(gpu, &self.layout, [ROW, ROW, layers]);
    }

    /// Writes whole rows, from one on.
    pub(crate) fn write(&self, gpu: &Gpu, first: u32, texels: &[[u8; 4]]) {
        let mut row = first;
        let mut left = texels;
        while !left.is_empty() {
            // As many as the layer at hand takes.
            let rows = (ROW - row % ROW).min((left.len() as u32).div_ceil(ROW));
            let (now, rest) = left.split_at((rows as usize * ROW as usize).min(left.len()));
            let copy = wgpu::TexelCopyTextureInfo {
                origin: wgpu::Origin3d { x: 0, y: row % ROW, z: row / ROW },
                ..self.texture.as_image_copy()
            };
            let layout = wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(ROW * TEXEL),
                rows_per_image: Some(rows),
            };
            let size = wgpu::Extent3d { width: ROW, height: rows, depth_or_array_layers: 1 };
            gpu.queue.write_texture(copy, bytemuck::cast_slice(now), layout, size);
            (row, left) = (row + rows, rest);
        }
    }
}

fn made(
    gpu: &Gpu,
    layout: &wgpu::BindGroupLayout,
    [width, height, layers]: [u32; 3],
) -> (wgpu::Texture, wgpu::BindGroup) {
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("pictures"),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: layers },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba8UnormSrgb,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    let view = texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2Array),
        ..Default::default()
    });
    let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("pictures"),
        layout,
        entries: &[wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(&view) }],
    });
    (texture, group)
}
