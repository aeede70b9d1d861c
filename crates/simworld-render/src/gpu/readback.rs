//! From the device to the host: each batch that is under way has a buffer of its own.

use std::ops::Range;
use std::sync::mpsc::{Receiver, TryRecvError, channel};

use super::device::Gpu;
use super::planes::Planes;
use crate::RenderError;
use crate::batch::{Channels, Layout, ViewOptions};

/// Buffers that wait for a next batch; more are given back to the device.
const MOST_IDLE: usize = 4;

/// A batch on its way to the host.
pub(crate) struct Readback {
    buffer: wgpu::Buffer,
    outcome: Receiver<Result<(), wgpu::BufferAsyncError>>,
    submission: wgpu::SubmissionIndex,
}

/// Buffers to read back through.
#[derive(Default)]
pub(crate) struct Readbacks {
    idle: Vec<wgpu::Buffer>,
}

impl Readbacks {
    /// Records the copies of what was asked for into a buffer of its own.
    pub(crate) fn copy(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        planes: &Planes,
        layout: &Layout,
        options: ViewOptions,
    ) -> Result<wgpu::Buffer, RenderError> {
        let size = place(layout, options, Channels::empty()).end as u64;
        let fits = |buffer: &wgpu::Buffer| (size..=4 * size).contains(&buffer.size());
        let buffer = match self.idle.iter().position(fits) {
            Some(index) => self.idle.swap_remove(index),
            None => gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("readback"),
                size,
                usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            }),
        };
        gpu.check()?;
        for channel in options.channels.iter() {
            let Range { start, end } = place(layout, options, channel);
            let length = (end - start) as u64;
            encoder.copy_buffer_to_buffer(planes.packed(channel), 0, &buffer, start as u64, length);
        }
        Ok(buffer)
    }

    /// Takes a buffer back whose contents were read.
    pub(crate) fn give_back(&mut self, buffer: wgpu::Buffer) {
        if self.idle.len() < MOST_IDLE {
            self.idle.push(buffer);
        }
    }
}

impl Readback {
    /// Asks for the contents of a buffer as soon as a submission is done.
    pub(crate) fn begin(buffer: wgpu::Buffer, submission: wgpu::SubmissionIndex) -> Self {
        let (sender, outcome) = channel();
        buffer.map_async(wgpu::MapMode::Read, .., move |mapped| {
            // If nobody waits any more, nobody needs the outcome.
            let _ = sender.send(mapped);
        });
        Self { buffer, outcome, submission }
    }

    /// Waits until it is there, lets somebody read it, and gives the buffer back.
    pub(crate) fn read(self, gpu: &Gpu, reader: impl FnOnce(&[u8])) -> Result<wgpu::Buffer, RenderError> {
        let failed = |reason: String| RenderError::Device(reason);
        let submission_index = Some(self.submission);
        gpu.device
            .poll(wgpu::PollType::Wait { submission_index, timeout: None })
            .map_err(|error| gpu.fault_or(failed(error.to_string())))?;
        gpu.check()?;
        match self.outcome.try_recv() {
            Ok(Ok(())) => {}
            Ok(Err(error)) => return Err(gpu.fault_or(failed(error.to_string()))),
            Err(TryRecvError::Empty | TryRecvError::Disconnected) => {
                return Err(gpu.fault_or(failed("a buffer was not mapped".to_owned())));
            }
        }
        let view = self.buffer.get_mapped_range(..).map_err(|error| failed(error.to_string()))?;
        reader(&view);
        drop(view);
        self.buffer.unmap();
        Ok(self.buffer)
    }
}

/// Where a channel lies in the buffer, bytes; no channel stands for the end.
pub(crate) fn place(layout: &Layout, options: ViewOptions, wanted: Channels) -> Range<usize> {
    let mut start = 0;
    for channel in options.channels.iter() {
        let length = layout.pixels * options.bytes_of(channel);
        if channel == wanted {
            return start..start + length;
        }
        start += length;
    }
    start..start
}
