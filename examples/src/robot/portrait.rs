//! A picture of a robot alone on a plane.

use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::{Point3, Vector3, pose_facing};
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape};
use simworld_render::{Frame, RenderError, Renderer};

use super::Bench;

/// Half of the paved square that it stands on, m.
const PLACE: f64 = 200.0;
/// How far the eye is from the middle of the robot, in its radii.
const AWAY: f64 = 2.6;
/// The field of view, across, rad.
const FIELD: f64 = 0.8;

impl Bench {
    /// The robot as it stands, from before it on the left, a little from above.
    ///
    /// # Errors
    /// The renderer fails.
    pub fn portrait(&self, renderer: &mut Renderer, [width, height]: [u32; 2]) -> Result<Frame, RenderError> {
        let mut world = self.world.clone();
        let slab = Shape::cuboid(2.0 * PLACE, 2.0 * PLACE, 0.1);
        let pose = pose_facing(Point3::new(0.0, 0.0, -0.1), 0.0);
        // Where the world refuses a slab the robot is in the air.
        let _ = world.spawn(EntityDesc::new(EntityKind::Sidewalk, pose, slab));
        let place = world.entity(self.id).map_or_else(Point3::origin, |entity| entity.position());
        let radius = world.links(self.id).map_or(0.3, |links| links.radius()).max(0.05);
        let target = place + Vector3::new(0.0, 0.0, 0.45 * radius);
        let eye = target + Vector3::new(0.75, 0.55, 0.4).normalize() * (AWAY * radius);
        let intrinsics = Intrinsics::from_fov(width, height, FIELD)?;
        let mut frame = Frame::new();
        renderer.render(&world, &Camera::looking_at(eye, target, intrinsics), &mut frame)?;
        Ok(frame)
    }
}
