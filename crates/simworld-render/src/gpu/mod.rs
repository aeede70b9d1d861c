//! Everything that talks to wgpu.

mod device;
mod globals;
mod pipelines;
mod readback;
mod targets;

pub(crate) use device::Gpu;
pub(crate) use globals::Globals;
pub(crate) use pipelines::Pipelines;
pub(crate) use targets::Targets;
