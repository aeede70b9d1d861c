//! How long the steps of a batch take on the device, by its own clock.

use super::device::Gpu;
use crate::RenderError;

/// Steps that one batch may have.
const MOST: u32 = 10;

/// Times the compute passes of one batch after the other; does nothing where the adapter has no clock for that.
pub(crate) struct Timing {
    clock: Option<Clock>,
    /// The steps of the batch at hand.
    steps: Vec<&'static str>,
}

struct Clock {
    marks: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    read: wgpu::Buffer,
}

impl Timing {
    /// What a device must have for it, of what the adapter has.
    pub(crate) fn features(adapter: &wgpu::Adapter) -> wgpu::Features {
        adapter.features() & wgpu::Features::TIMESTAMP_QUERY
    }

    pub(crate) fn new(gpu: &Gpu) -> Self {
        let buffer = |usage| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("times"),
                size: u64::from(2 * MOST) * 8,
                usage,
                mapped_at_creation: false,
            })
        };
        let has_clock = gpu.device.features().contains(wgpu::Features::TIMESTAMP_QUERY);
        let clock = has_clock.then(|| Clock {
            marks: gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("times"),
                ty: wgpu::QueryType::Timestamp,
                count: 2 * MOST,
            }),
            resolved: buffer(wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC),
            read: buffer(wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST),
        });
        Self { clock, steps: Vec::new() }
    }

    /// A new batch begins.
    pub(crate) fn begin(&mut self) {
        self.steps.clear();
    }

    /// What the pass of a step is recorded with.
    pub(crate) fn pass(&mut self, step: &'static str) -> wgpu::ComputePassDescriptor<'_> {
        let first = 2 * self.steps.len() as u32;
        let writes = self.clock.as_ref().filter(|_| first < 2 * MOST).map(|clock| {
            self.steps.push(step);
            wgpu::ComputePassTimestampWrites {
                query_set: &clock.marks,
                beginning_of_pass_write_index: Some(first),
                end_of_pass_write_index: Some(first + 1),
            }
        });
        wgpu::ComputePassDescriptor { label: Some(step), timestamp_writes: writes }
    }

    /// Seconds that each step of the last batch took, when that is done; nothing without a clock.
    pub(crate) fn read(&self, gpu: &Gpu) -> Result<Vec<(&'static str, f64)>, RenderError> {
        let Some(clock) = self.clock.as_ref().filter(|_| !self.steps.is_empty()) else {
            return Ok(Vec::new());
        };
        let size = 16 * self.steps.len() as u64;
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.resolve_query_set(&clock.marks, 0..2 * self.steps.len() as u32, &clock.resolved, 0);
        encoder.copy_buffer_to_buffer(&clock.resolved, 0, &clock.read, 0, size);
        gpu.queue.submit([encoder.finish()]);
        clock.read.map_async(wgpu::MapMode::Read, 0..size, |_| ());
        gpu.wait()?;
        let range =
            clock.read.get_mapped_range(0..size).map_err(|error| RenderError::Device(error.to_string()))?;
        let marks: Vec<u64> = bytemuck::pod_collect_to_vec(&range);
        drop(range);
        clock.read.unmap();
        let tick = f64::from(gpu.queue.get_timestamp_period()) * 1e-9;
        let spans = marks.chunks_exact(2).map(|pair| pair[1].saturating_sub(pair[0]) as f64 * tick);
        Ok(self.steps.iter().copied().zip(spans).collect())
    }
}
