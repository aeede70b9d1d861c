//! Everything that talks to wgpu.

mod device;
mod globals;
mod pipelines;
mod planes;
mod programs;
mod readback;
mod scenery;
mod shadow_maps;
mod sifter;
mod targets;
mod texels;
mod timing;

pub(crate) use device::Gpu;
pub(crate) use globals::Globals;
pub(crate) use pipelines::{Brush, Features, Layer, Matter, Pipelines, TANGENTS};
pub(crate) use planes::Planes;
pub(crate) use programs::Program;
pub(crate) use readback::{Readback, Readbacks, place};
pub(crate) use scenery::{Scenery, runs};
pub(crate) use shadow_maps::{Casters, MOST_MAPS, Redraw, ShadowMaps};
pub(crate) use sifter::Sifter;
pub(crate) use targets::Targets;
pub(crate) use texels::{LAYER, MOST_LAYERS, ROW, Texels};
pub(crate) use timing::Timing;
