//! A picture of the world from above and to the side, where there is a graphics adapter.

use std::ops::ControlFlow;
use std::path::Path;

use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::{Aabb, Point2, Point3, Vector3, direction};
use simworld_core::scene::{Scene, World};
use simworld_render::{Frame, RenderConfig, RenderError, Renderer};

/// Draws a world as somebody on a ladder sees it.
pub struct View {
    renderer: Renderer,
    intrinsics: Intrinsics,
    frame: Frame,
}

impl View {
    /// A view of 960 by 540.
    ///
    /// # Errors
    /// No graphics adapter.
    pub fn new() -> Result<Self, RenderError> {
        let renderer = Renderer::new(&RenderConfig { far: 6000.0, ..RenderConfig::default() })?;
        let intrinsics = Intrinsics::from_fov(960, 540, 1.1).map_err(RenderError::from)?;
        Ok(Self { renderer, intrinsics, frame: Frame::new() })
    }

    /// Writes what stands around a point as a PNG file, seen from so far off, m, and from where least stands between.
    ///
    /// # Errors
    /// The adapter failed, or the file cannot be written.
    pub fn write(&mut self, world: &World, at: Point2, away: f64, path: &Path) -> Result<(), RenderError> {
        let target = Point3::new(at.x, at.y, 1.0 + world.ground().map_or(0.0, |land| land.height(at)));
        let eye = clearest(world, target, away);
        let camera = Camera::looking_at(eye, target, self.intrinsics);
        self.renderer.render(world, &camera, &mut self.frame)?;
        self.frame.write_png(path)?;
        Ok(())
    }
}

/// Of sixteen places around a target that from which least hides it; of several as good the first, from the south on.
fn clearest(world: &World, target: Point3, away: f64) -> Point3 {
    let eyes = (0..16).map(|turn| {
        let way = direction(-1.9 + f64::from(turn) * std::f64::consts::FRAC_PI_8);
        target + Vector3::new(way.x, way.y, 0.8) * away
    });
    let hidden = |eye: &Point3| {
        let line = eye - target;
        // From a little off the target on, so that it does not hide itself.
        (2..=20).filter(|step| is_solid(world, target + line * (f64::from(*step) * 0.05))).count()
    };
    eyes.min_by_key(hidden).unwrap_or(target)
}

fn is_solid(world: &World, point: Point3) -> bool {
    let hit = world.visit(&Aabb::around(point, Vector3::repeat(0.1)), &mut |entity| {
        let local = entity.obb().pose.inverse_transform_point(&point);
        let half = entity.obb().half_extents;
        let inside = local.coords.iter().zip(half.iter()).all(|(at, half)| at.abs() <= *half);
        if inside && entity.kind.is_solid() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    hit.is_break()
}
