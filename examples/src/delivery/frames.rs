//! A few pictures of a run, where there is an adapter.

use std::path::Path;

use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::{Point3, direction, yaw_of};
use simworld_core::scene::{Scene, World};
use simworld_render::{Frame, RenderConfig, RenderError, Renderer};
use thiserror::Error;

use super::Assembly;

/// Why a frame could not be taken.
#[derive(Debug, Error)]
#[error("a frame could not be taken: {0}")]
pub struct FrameError(#[from] RenderError);

/// Takes frames at even intervals: each follows another courier.
pub struct FrameTaker {
    renderer: Renderer,
    intrinsics: Intrinsics,
    interval: u64,
    frame: Frame,
}

impl FrameTaker {
    /// A taker of that many frames over that many steps.
    ///
    /// # Errors
    /// No adapter: the message says what to install.
    pub fn new(steps: u64, frames: u32) -> Result<Self, FrameError> {
        let renderer = Renderer::new(&RenderConfig::default())?;
        let intrinsics = Intrinsics::from_fov(960, 540, 1.2).map_err(RenderError::from)?;
        let interval = (steps / (u64::from(frames) + 1)).max(1);
        Ok(Self { renderer, intrinsics, interval, frame: Frame::new() })
    }

    /// Takes a frame if one is due at this step, and writes it as `frame-TICK.png`.
    ///
    /// # Errors
    /// The adapter failed, or the file cannot be written.
    pub fn take_if_due(&mut self, assembly: &Assembly, folder: &Path) -> Result<(), FrameError> {
        let world = assembly.episode.simulation().world();
        let tick = world.clock().tick().0;
        if !tick.is_multiple_of(self.interval) {
            return Ok(());
        }
        let courier = assembly
            .couriers
            .get((tick / self.interval).saturating_sub(1) as usize % assembly.couriers.len().max(1));
        let Some(camera) = courier.and_then(|courier| behind(world, *courier, self.intrinsics)) else {
            return Ok(());
        };
        self.renderer.render(world, &camera, &mut self.frame)?;
        self.frame.write_png(folder.join(format!("frame-{tick:06}.png")))?;
        Ok(())
    }
}

/// A camera behind and above somebody, looking where they look.
fn behind(world: &World, who: simworld_core::id::EntityId, intrinsics: Intrinsics) -> Option<Camera> {
    let person = world.entity(who)?;
    let here = person.planar();
    let ahead = direction(yaw_of(person.pose));
    let (eye, target) = (here - ahead * 6.0, here + ahead * 12.0);
    Some(Camera::looking_at(Point3::new(eye.x, eye.y, 4.2), Point3::new(target.x, target.y, 0.8), intrinsics))
}
