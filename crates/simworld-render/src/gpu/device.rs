//! The adapter and its device; errors of wgpu are kept until somebody asks, instead of ending the program.

use std::sync::{Arc, Mutex, PoisonError};

use super::{Timing, sifter};
use crate::config::{AdapterChoice, Backends};
use crate::{RenderConfig, RenderError};

/// Storage buffers that a stage may use, where the adapter has so many: one more than the web offers, for rays.
const STORAGE_BUFFERS: u32 = crate::raycast::BUFFERS;

/// A device, its queue, and the first error that wgpu reported since it was last asked.
pub(crate) struct Gpu {
    pub device: wgpu::Device,
    pub queue: wgpu::Queue,
    pub info: wgpu::AdapterInfo,
    /// Whether it can cull by itself.
    pub can_sift: bool,
    fault: Arc<Mutex<Option<RenderError>>>,
    /// Why the device is gone, if it is.
    lost: Arc<Mutex<Option<String>>>,
}

impl Gpu {
    pub(crate) fn new(config: &RenderConfig) -> Result<Self, RenderError> {
        let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
        descriptor.backends = backends(config.backends);
        // Without names and lines of sources in shaders, which a debug build would have, and for each of which the whole source is counted through;
        // `WGPU_DEBUG=1` and `WGPU_VALIDATION=1` ask for them, and for the layers of Vulkan that check what wgpu does.
        descriptor.flags = wgpu::InstanceFlags::empty().with_env();
        let instance = wgpu::Instance::new(descriptor);
        let options = wgpu::RequestAdapterOptions {
            power_preference: wgpu::PowerPreference::HighPerformance,
            force_fallback_adapter: config.adapter == AdapterChoice::Software,
            ..Default::default()
        };
        let adapter = pollster::block_on(instance.request_adapter(&options))
            .map_err(|error| RenderError::NoAdapter { reason: error.to_string() })?;
        let info = adapter.get_info();
        let offered = adapter.limits();
        let limits = wgpu::Limits {
            max_buffer_size: offered.max_buffer_size,
            max_storage_buffer_binding_size: offered.max_storage_buffer_binding_size,
            max_storage_buffers_per_shader_stage: offered
                .max_storage_buffers_per_shader_stage
                .min(STORAGE_BUFFERS),
            ..wgpu::Limits::downlevel_defaults().using_resolution(offered)
        };
        let can_sift = sifter::is_offered(&adapter, &limits);
        let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor {
            label: Some("simworld"),
            required_features: Timing::features(&adapter) | sifter::features(&adapter),
            required_limits: limits,
            ..Default::default()
        }))
        .map_err(|error| RenderError::NoDevice { adapter: info.name.clone(), reason: error.to_string() })?;

        let fault = Arc::new(Mutex::new(None));
        let slot = Arc::clone(&fault);
        device.on_uncaptured_error(Arc::new(move |error| {
            slot.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(typed(&error));
        }));
        let lost = Arc::new(Mutex::new(None));
        let slot = Arc::clone(&lost);
        device.set_device_lost_callback(move |reason, text| {
            let why = format!("{reason:?}: {text}");
            slot.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(why);
        });
        Ok(Self { device, queue, info, can_sift, fault, lost })
    }

    /// Why the device is gone, if it is.
    pub(crate) fn lost(&self) -> Option<String> {
        // Callbacks run when somebody polls; what polling says is said again by what follows.
        let _ = self.device.poll(wgpu::PollType::Poll);
        self.lost.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// The first error since the last call, or that the device is gone, or this one.
    pub(crate) fn fault_or(&self, other: RenderError) -> RenderError {
        self.check().err().unwrap_or(other)
    }

    /// The first error since the last call; that the device is gone comes before all others.
    pub(crate) fn check(&self) -> Result<(), RenderError> {
        if let Some(reason) = self.lost.lock().unwrap_or_else(PoisonError::into_inner).clone() {
            return Err(RenderError::Lost { reason });
        }
        match self.fault.lock().unwrap_or_else(PoisonError::into_inner).take() {
            Some(error) => Err(error),
            None => Ok(()),
        }
    }

    /// Waits until everything submitted is done.
    pub(crate) fn wait(&self) -> Result<(), RenderError> {
        self.device
            .poll(wgpu::PollType::wait_indefinitely())
            .map_err(|error| self.fault_or(RenderError::Device(error.to_string())))?;
        self.check()
    }

    /// Waits until what was submitted then is done.
    pub(crate) fn wait_for(&self, submission: wgpu::SubmissionIndex) -> Result<(), RenderError> {
        self.device
            .poll(wgpu::PollType::Wait { submission_index: Some(submission), timeout: None })
            .map_err(|error| self.fault_or(RenderError::Device(error.to_string())))?;
        self.check()
    }

    /// A buffer with these bytes, to be drawn from.
    pub(crate) fn upload(&self, label: &str, usage: wgpu::BufferUsages, bytes: &[u8]) -> wgpu::Buffer {
        let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size: bytes.len() as u64,
            usage: usage | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        self.queue.write_buffer(&buffer, 0, bytes);
        buffer
    }

    /// The largest picture, pixels each way.
    pub(crate) fn largest_picture(&self) -> u32 {
        self.device.limits().max_texture_dimension_2d
    }
}

fn backends(choice: Backends) -> wgpu::Backends {
    match choice {
        Backends::Any => wgpu::Backends::from_env().unwrap_or(wgpu::Backends::PRIMARY),
        Backends::Vulkan => wgpu::Backends::VULKAN,
        Backends::Metal => wgpu::Backends::METAL,
        Backends::Dx12 => wgpu::Backends::DX12,
        Backends::None => wgpu::Backends::empty(),
    }
}

fn typed(error: &wgpu::Error) -> RenderError {
    match error {
        wgpu::Error::OutOfMemory { .. } => RenderError::OutOfMemory,
        other => RenderError::Device(other.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A call that wgpu refuses comes back as an error, once.
    #[test]
    fn refused_calls_are_errors() {
        let Some(gpu) = Gpu::new(&RenderConfig::default()).map_err(|error| println!("skipped: {error}")).ok()
        else {
            let required = std::env::var_os("SIMWORLD_REQUIRE_ADAPTER").is_some_and(|value| value == "1");
            assert!(!required, "an adapter is required here");
            return;
        };
        let _ = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: 16,
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::VERTEX,
            mapped_at_creation: false,
        });
        assert!(matches!(gpu.check(), Err(RenderError::Device(reason)) if !reason.is_empty()));
        assert!(gpu.check().is_ok());
    }
}
