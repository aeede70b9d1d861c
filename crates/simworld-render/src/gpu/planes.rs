//! The pixels of a batch on the device: as they are drawn, four bytes a pixel and channel, and as they were asked for.

use bytemuck::{Pod, Zeroable};

use super::Timing;
use super::device::Gpu;
use crate::RenderError;
use crate::batch::{Channels, Layout, PixelFormat, ViewOptions};

const PACK: &str = include_str!("../shaders/pack.wgsl");
/// Groups of four pixels that one workgroup packs, as in pack.wgsl.
const GROUP: u32 = 64;

/// The twin of `Packing` in pack.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Packing {
    quads: u32,
    row: u32,
    wanted: u32,
    compact: u32,
}

/// The buffers of a batch; they grow as batches do.
pub(crate) struct Planes {
    /// Colour, depth, and who it is, as drawn.
    pub raw: [wgpu::Buffer; 3],
    /// By bit of [`Channels`].
    packed: [wgpu::Buffer; 4],
    /// Normals need no packing: they are drawn as they are asked for.
    pub normals: wgpu::Buffer,
    packing: wgpu::Buffer,
    pipeline: wgpu::ComputePipeline,
    group: wgpu::BindGroup,
}

impl Planes {
    pub(crate) fn new(gpu: &Gpu) -> Self {
        let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("pack"),
            source: wgpu::ShaderSource::Wgsl(PACK.into()),
        });
        let pipeline = gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("pack"),
            layout: None,
            module: &module,
            entry_point: Some("pack"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        let raw = std::array::from_fn(|_| plane(gpu, 256));
        let packed = std::array::from_fn(|_| plane(gpu, 256));
        let normals = plane(gpu, 256);
        let packing =
            gpu.upload("packing", wgpu::BufferUsages::UNIFORM, bytemuck::bytes_of(&Packing::zeroed()));
        let group = bind(gpu, &pipeline, &packing, &raw, &packed);
        Self { raw, packed, normals, packing, pipeline, group }
    }

    /// Pixels that a batch may have on this device, padding and all.
    pub(crate) fn limit(gpu: &Gpu) -> usize {
        let limits = gpu.device.limits();
        (limits.max_storage_buffer_binding_size.min(limits.max_buffer_size) / 4) as usize
    }

    /// Makes room for a batch.
    pub(crate) fn hold(
        &mut self,
        gpu: &Gpu,
        layout: &Layout,
        options: ViewOptions,
    ) -> Result<(), RenderError> {
        let (pixels, limit) = (layout.pixels, Self::limit(gpu));
        if pixels > limit {
            return Err(RenderError::Batch { pixels, limit });
        }
        let mut grown = false;
        let mut ensure = |buffer: &mut wgpu::Buffer, size: usize| {
            if size as u64 > buffer.size() {
                *buffer = plane(gpu, size as u64);
                grown = true;
            }
        };
        self.raw.iter_mut().for_each(|buffer| ensure(buffer, pixels * 4));
        for (channel, buffer) in Channels::all().iter().zip(&mut self.packed) {
            ensure(buffer, pixels * options.bytes_of(channel));
        }
        let normals = (pixels * options.bytes_of(Channels::NORMALS)) as u64;
        if normals > self.normals.size() {
            self.normals = plane(gpu, normals);
            gpu.check()?;
        }
        if grown {
            self.group = bind(gpu, &self.pipeline, &self.packing, &self.raw, &self.packed);
            gpu.check()?;
        }
        let quads = pixels as u32 / 4;
        let packing = Packing {
            quads,
            row: row_of(quads) * GROUP,
            wanted: options.channels.bits(),
            compact: u32::from(options.format == PixelFormat::Compact),
        };
        gpu.queue.write_buffer(&self.packing, 0, bytemuck::bytes_of(&packing));
        Ok(())
    }

    /// Records the step from pixels as drawn to pixels as asked for.
    pub(crate) fn pack(&self, encoder: &mut wgpu::CommandEncoder, timing: &mut Timing, layout: &Layout) {
        let quads = layout.pixels as u32 / 4;
        let row = row_of(quads);
        let mut pass = encoder.begin_compute_pass(&timing.pass("pack"));
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.group, &[]);
        pass.dispatch_workgroups(row, quads.div_ceil(row * GROUP), 1);
    }

    /// The buffer of a channel as it was asked for.
    pub(crate) fn packed(&self, channel: Channels) -> &wgpu::Buffer {
        if channel == Channels::NORMALS {
            return &self.normals;
        }
        &self.packed[channel.bits().trailing_zeros() as usize % 4]
    }
}

/// Workgroups in a row of the dispatch.
fn row_of(quads: u32) -> u32 {
    quads.div_ceil(GROUP).clamp(1, 32_768)
}

fn plane(gpu: &Gpu, size: u64) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("plane"),
        size,
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

fn bind(
    gpu: &Gpu,
    pipeline: &wgpu::ComputePipeline,
    packing: &wgpu::Buffer,
    raw: &[wgpu::Buffer; 3],
    packed: &[wgpu::Buffer; 4],
) -> wgpu::BindGroup {
    let buffers = std::iter::once(packing).chain(raw).chain(packed);
    let entries: Vec<wgpu::BindGroupEntry<'_>> = (0..)
        .zip(buffers)
        .map(|(binding, buffer)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() })
        .collect();
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("pack"),
        layout: &pipeline.get_bind_group_layout(0),
        entries: &entries,
    })
}
