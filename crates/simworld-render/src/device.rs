//! The graphics device, without any window.

use std::sync::{Arc, Mutex};

use crate::RenderError;

/// An adapter with its device, and the first fault that it reported.
pub(crate) struct Gpu {
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
    pub(crate) name: String,
    fault: Arc<Mutex<Option<String>>>,
}

impl Gpu {
    pub(crate) fn open(backends: wgpu::Backends) -> Result<Self, RenderError> {
        let descriptor =
            wgpu::InstanceDescriptor { backends, ..wgpu::InstanceDescriptor::new_without_display_handle() };
        let instance = wgpu::Instance::new(descriptor);
        let options = wgpu::RequestAdapterOptions {
            power_preference: wgpu::PowerPreference::HighPerformance,
            ..wgpu::RequestAdapterOptions::default()
        };
        let adapter = pollster::block_on(instance.request_adapter(&options))
            .map_err(|error| RenderError::NoAdapter { reason: error.to_string() })?;
        let limits = wgpu::Limits::default().using_resolution(adapter.limits());
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("simworld"),
            required_limits: limits,
            ..wgpu::DeviceDescriptor::default()
        };
        let (device, queue) = pollster::block_on(adapter.request_device(&descriptor))
            .map_err(|error| RenderError::Device { reason: error.to_string() })?;
        let fault = Arc::new(Mutex::new(None));
        let reported = Arc::clone(&fault);
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            if let Ok(mut fault) = reported.lock() {
                fault.get_or_insert(error.to_string());
            }
        }));
        Ok(Self { device, queue, name: adapter.get_info().name, fault })
    }

    /// The fault reported since the last call, if there was one.
    pub(crate) fn check(&self) -> Result<(), RenderError> {
        match self.fault.lock().ok().and_then(|mut fault| fault.take()) {
            Some(reason) => Err(RenderError::Drawing { reason }),
            None => Ok(()),
        }
    }
}
