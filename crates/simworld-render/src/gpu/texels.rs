//! The store of pictures on the device: rows of texels in the layers of one texture, read one by one, so that pictures of any size and their smaller
//! levels lie behind one another, and every backend blends them by the same arithmetic; and the table that says what of it belongs to whom.
//!
//! Colours are read through a view that makes linear light of them, and numbers through one that leaves them as they are. The table is a texture too,
//! since all storage buffers that every adapter has are taken.

use super::device::Gpu;

/// Texels in a row, and rows in a layer; as in shaders/models.wgsl.
pub(crate) const ROW: u32 = 1024;

/// What makes linear light of the texels, and what leaves them as they are.
const COLORS: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;
const NUMBERS: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// A texel takes so many bytes.
const TEXEL: u32 = 4;

/// The most layers, which every adapter has: 1 GiB.
pub(crate) const MOST_LAYERS: u32 = 256;

/// Bytes of a layer.
pub(crate) const LAYER: u64 = ROW as u64 * ROW as u64 * TEXEL as u64;

/// The textures, and what they are bound by.
pub(crate) struct Texels {
    layout: wgpu::BindGroupLayout,
    texture: wgpu::Texture,
    table: wgpu::Texture,
    group: wgpu::BindGroup,
}

impl Texels {
    pub(crate) fn new(gpu: &Gpu) -> Self {
        let entry = |binding, view_dimension| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::VERTEX_FRAGMENT | wgpu::ShaderStages::COMPUTE,
            ty: wgpu::BindingType::Texture {
                sample_type: wgpu::TextureSampleType::Float { filterable: false },
                view_dimension,
                multisampled: false,
            },
            count: None,
        };
        let layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("pictures"),
            entries: &[
                entry(0, wgpu::TextureViewDimension::D2Array),
                entry(1, wgpu::TextureViewDimension::D2Array),
                entry(2, wgpu::TextureViewDimension::D2),
            ],
        });
        // Scenes without pictures have those that nobody reads.
        let (texture, table) = (stored(gpu, [1, 1, 1]), tabled(gpu, 1));
        let group = bound(gpu, &layout, &texture, &table);
        Self { layout, texture, table, group }
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
        self.texture = stored(gpu, [ROW, ROW, layers]);
        self.group = bound(gpu, &self.layout, &self.texture, &self.table);
    }

    /// Writes the table in place of what it was.
    pub(crate) fn tell(&mut self, gpu: &Gpu, table: &[[f32; 4]]) {
        let rows = (table.len() as u32).div_ceil(ROW);
        if rows > self.table.height() {
            self.table = tabled(gpu, rows.next_power_of_two());
            self.group = bound(gpu, &self.layout, &self.texture, &self.table);
        }
        let mut whole = table.to_vec();
        whole.resize((rows * ROW) as usize, [0.0; 4]);
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(ROW * size_of::<[f32; 4]>() as u32),
            rows_per_image: Some(rows),
        };
        let size = wgpu::Extent3d { width: ROW, height: rows, depth_or_array_layers: 1 };
        gpu.queue.write_texture(self.table.as_image_copy(), bytemuck::cast_slice(&whole), layout, size);
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

fn texture(
    gpu: &Gpu,
    [width, height, layers]: [u32; 3],
    format: wgpu::TextureFormat,
    views: &[wgpu::TextureFormat],
) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("pictures"),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: layers },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: views,
    })
}

fn stored(gpu: &Gpu, size: [u32; 3]) -> wgpu::Texture {
    texture(gpu, size, COLORS, &[NUMBERS])
}

fn tabled(gpu: &Gpu, rows: u32) -> wgpu::Texture {
    texture(gpu, [ROW, rows, 1], wgpu::TextureFormat::Rgba32Float, &[])
}

fn bound(
    gpu: &Gpu,
    layout: &wgpu::BindGroupLayout,
    texture: &wgpu::Texture,
    table: &wgpu::Texture,
) -> wgpu::BindGroup {
    let seen = |format| {
        texture.create_view(&wgpu::TextureViewDescriptor {
            format: Some(format),
            dimension: Some(wgpu::TextureViewDimension::D2Array),
            ..Default::default()
        })
    };
    let (colors, numbers) = (seen(COLORS), seen(NUMBERS));
    let table = table.create_view(&wgpu::TextureViewDescriptor::default());
    let views = [&colors, &numbers, &table];
    let entry = |(binding, view)| wgpu::BindGroupEntry {
        binding,
        resource: wgpu::BindingResource::TextureView(view),
    };
    let entries: Vec<wgpu::BindGroupEntry<'_>> = (0..).zip(views).map(entry).collect();
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("pictures"),
        layout,
        entries: &entries,
    })
}
