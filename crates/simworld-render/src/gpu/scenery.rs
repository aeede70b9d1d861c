//! What every view of a batch is drawn from: its globals, and the instances, which stay on the device.

use super::device::Gpu;
use super::globals::Globals;
use crate::RenderError;
use crate::light::SKY_NODES;
use crate::resident::{Instance, Residents};

/// Changes less than this many instances apart are sent together.
const LEAST_GAP: u32 = 64;
/// More pieces than this are sent as fewer, larger ones.
const MOST_PIECES: usize = 64;
/// Lights are read whole, and the sky before them by itself as a uniform of so many bytes.
const LIGHTS: wgpu::BufferUsages = wgpu::BufferUsages::STORAGE.union(wgpu::BufferUsages::UNIFORM);
const SKY: u64 = (SKY_NODES * size_of::<[f32; 4]>()) as u64;

/// The buffers of group 0.
pub(crate) struct Scenery {
    globals: wgpu::Buffer,
    pub instances: wgpu::Buffer,
    /// Those that are drawn, in their order.
    drawn: wgpu::Buffer,
    copies: Vec<Instance>,
    /// The sky, and the grids of lamps.
    pub lights: wgpu::Buffer,
    group: wgpu::BindGroup,
    layout: wgpu::BindGroupLayout,
    /// Bytes from the globals of one view to those of the next.
    stride: u64,
    epoch: u64,
}

impl Scenery {
    pub(crate) fn new(gpu: &Gpu, layout: &wgpu::BindGroupLayout) -> Self {
        let alignment = u64::from(gpu.device.limits().min_uniform_buffer_offset_alignment);
        let stride = (size_of::<Globals>() as u64).next_multiple_of(alignment);
        let globals = buffer(gpu, "globals", wgpu::BufferUsages::UNIFORM, stride);
        let instances =
            buffer(gpu, "instances", wgpu::BufferUsages::STORAGE, 1024 * size_of::<Instance>() as u64);
        let drawn = buffer(gpu, "drawn", wgpu::BufferUsages::VERTEX, 4096);
        let lights = buffer(gpu, "lights", LIGHTS, 4096);
        let group = bind(gpu, layout, &globals, &lights);
        Self {
            globals,
            instances,
            drawn,
            copies: Vec::new(),
            lights,
            group,
            layout: layout.clone(),
            stride,
            epoch: 0,
        }
    }

    /// Sends the globals of the views, the sky with the lamps behind it, and what changed of the instances.
    pub(crate) fn send(
        &mut self,
        gpu: &Gpu,
        globals: &[Globals],
        lights: [&[[f32; 4]]; 2],
        residents: &mut Residents,
    ) -> Result<(), RenderError> {
        let limits = gpu.device.limits();
        let limit = (limits.max_storage_buffer_binding_size.min(limits.max_buffer_size) as usize)
            / size_of::<Instance>();
        let count = residents.instances.len();
        if count > limit {
            return Err(RenderError::TooMany { count, limit });
        }
        let (wide, long) = (self.stride * globals.len() as u64, (count * size_of::<Instance>()) as u64);
        let is_new = long > self.instances.size();
        let lights = lights.map(bytemuck::cast_slice::<[f32; 4], u8>);
        let lit: u64 = lights.iter().map(|part| part.len() as u64).sum();
        if lit > limits.max_storage_buffer_binding_size.min(limits.max_buffer_size) {
            return Err(RenderError::TooMany { count: (lit / 16) as usize, limit });
        }
        if wide > self.globals.size() || is_new || lit > self.lights.size() {
            if wide > self.globals.size() {
                self.globals = buffer(gpu, "globals", wgpu::BufferUsages::UNIFORM, wide.next_power_of_two());
            }
            if is_new {
                let roomy = (count.next_power_of_two().min(limit) * size_of::<Instance>()) as u64;
                self.instances = buffer(gpu, "instances", wgpu::BufferUsages::STORAGE, roomy);
            }
            if lit > self.lights.size() {
                self.lights = buffer(gpu, "lights", LIGHTS, lit.next_power_of_two());
            }
            self.group = bind(gpu, &self.layout, &self.globals, &self.lights);
            gpu.check()?;
        }
        let mut offset = 0;
        for part in lights {
            gpu.queue.write_buffer(&self.lights, offset, part);
            offset += part.len() as u64;
        }
        let mut bytes = vec![0; wide as usize];
        for (index, one) in globals.iter().enumerate() {
            let start = index * self.stride as usize;
            bytes[start..start + size_of::<Globals>()].copy_from_slice(bytemuck::bytes_of(one));
        }
        gpu.queue.write_buffer(&self.globals, 0, &bytes);
        let everything = is_new || self.epoch != residents.epoch;
        self.epoch = residents.epoch;
        for piece in runs(&mut residents.changed, everything.then_some(count as u32)) {
            let offset = u64::from(piece.start) * size_of::<Instance>() as u64;
            let instances = &residents.instances[piece.start as usize..piece.end as usize];
            gpu.queue.write_buffer(&self.instances, offset, bytemuck::cast_slice(instances));
        }
        Ok(())
    }

    /// Sends the instances that are drawn, by their numbers.
    pub(crate) fn send_picks(
        &mut self,
        gpu: &Gpu,
        picks: &[u32],
        residents: &Residents,
    ) -> Result<(), RenderError> {
        let each = size_of::<Instance>() as u64;
        let long = picks.len() as u64 * each;
        let limit = gpu.device.limits().max_buffer_size;
        if long > limit {
            return Err(RenderError::TooMany { count: picks.len(), limit: (limit / each) as usize });
        }
        if long > self.drawn.size() {
            let roomy = long.next_power_of_two().min(limit);
            self.drawn = buffer(gpu, "drawn", wgpu::BufferUsages::VERTEX, roomy);
            gpu.check()?;
        }
        self.copies.clear();
        self.copies.extend(picks.iter().map(|number| residents.instances[*number as usize]));
        gpu.queue.write_buffer(&self.drawn, 0, bytemuck::cast_slice(&self.copies));
        Ok(())
    }

    /// Binds what the view of that index is drawn from.
    pub(crate) fn bind(&self, pass: &mut wgpu::RenderPass<'_>, view: usize) {
        pass.set_bind_group(0, &self.group, &[(view as u64 * self.stride) as u32]);
        pass.set_vertex_buffer(1, self.drawn.slice(..));
    }
}

/// The changed numbers as few runs; empties the list.
pub(crate) fn runs(changed: &mut Vec<u32>, everything: Option<u32>) -> Vec<std::ops::Range<u32>> {
    if let Some(count) = everything {
        changed.clear();
        return if count == 0 { Vec::new() } else { std::iter::once(0..count).collect() };
    }
    changed.sort_unstable();
    changed.dedup();
    let mut gap = LEAST_GAP;
    loop {
        let mut runs: Vec<std::ops::Range<u32>> = Vec::new();
        for number in changed.iter() {
            match runs.last_mut() {
                Some(run) if *number - run.end < gap => run.end = number + 1,
                _ => runs.push(*number..number + 1),
            }
        }
        if runs.len() <= MOST_PIECES {
            changed.clear();
            return runs;
        }
        gap *= 4;
    }
}

fn buffer(gpu: &Gpu, label: &str, usage: wgpu::BufferUsages, size: u64) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size,
        usage: usage | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

fn bind(
    gpu: &Gpu,
    layout: &wgpu::BindGroupLayout,
    globals: &wgpu::Buffer,
    lights: &wgpu::Buffer,
) -> wgpu::BindGroup {
    let sky = wgpu::BufferBinding { buffer: lights, offset: 0, size: std::num::NonZeroU64::new(SKY) };
    let window = wgpu::BufferBinding {
        buffer: globals,
        offset: 0,
        size: std::num::NonZeroU64::new(size_of::<Globals>() as u64),
    };
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("scenery"),
        layout,
        entries: &[
            wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::Buffer(window) },
            wgpu::BindGroupEntry { binding: 1, resource: lights.as_entire_binding() },
            wgpu::BindGroupEntry { binding: 2, resource: wgpu::BindingResource::Buffer(sky) },
        ],
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changes_are_sent_in_few_pieces_that_cover_them() {
        let mut changed = vec![7, 900, 8, 7, 3];
        assert_eq!(runs(&mut changed, None), [3..9, 900..901]);
        assert!(changed.is_empty());
        let mut scattered: Vec<u32> = (0..5000).map(|k| k * 100).collect();
        let few = runs(&mut scattered.clone(), None);
        assert!(few.len() <= MOST_PIECES);
        assert!(scattered.iter().all(|number| few.iter().any(|run| run.contains(number))));
        assert_eq!(runs(&mut scattered, Some(12)).first(), Some(&(0..12)));
    }
}
