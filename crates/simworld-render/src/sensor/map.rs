//! The view from above: parallel rays, north up, so many metres a pixel.

use std::sync::{Arc, Mutex, PoisonError};

use nalgebra::{Matrix3, Rotation3, UnitQuaternion};
use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::{Point2, Point3, Pose};
use simworld_core::id::EntityId;
use simworld_core::scene::Scene;
use simworld_core::seam::{ObserveError, Observer};

use crate::{Frame, Projection, RenderError, Renderer, ViewOptions, ViewRequest, Views};

/// A picture from straight above; east is right, north is up, and the scale is the same all over.
///
/// ```
/// use simworld_core::geometry::Point2;
/// use simworld_render::MapView;
/// let map = MapView { center: Point2::new(100.0, 50.0), top: 40.0, metres_per_pixel: 0.5, width: 200, height: 100 };
/// assert_eq!(map.place(0.0, 0.0), Point2::new(50.0, 75.0));
/// assert_eq!(map.pixel(&Point2::new(150.0, 25.0)), Point2::new(200.0, 100.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapView {
    /// The point of the world in the middle of the picture, m.
    pub center: Point2,
    /// The height from which it looks down, world frame, m; what is higher is not seen, and depth counts from here.
    pub top: f64,
    /// The side of a pixel on the ground, m.
    pub metres_per_pixel: f64,
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
}

impl MapView {
    /// The point of the world under a place on the picture; pixel (0, 0) has its middle at (0.5, 0.5).
    pub fn place(&self, u: f64, v: f64) -> Point2 {
        let (across, down) = (u - f64::from(self.width) * 0.5, v - f64::from(self.height) * 0.5);
        Point2::new(
            self.center.x + across * self.metres_per_pixel,
            self.center.y - down * self.metres_per_pixel,
        )
    }

    /// The place on the picture that a point of the world falls on.
    pub fn pixel(&self, point: &Point2) -> Point2 {
        let from_center = (point - self.center) / self.metres_per_pixel;
        Point2::new(f64::from(self.width) * 0.5 + from_center.x, f64::from(self.height) * 0.5 - from_center.y)
    }

    /// The point of the world on the middle of a pixel of a frame that it took, m; `None` where there is nothing.
    pub fn point_at(&self, frame: &Frame, x: u32, y: u32) -> Option<Point3> {
        let depth = frame.depth_at(x, y)?;
        let place = self.place(f64::from(x) + 0.5, f64::from(y) + 0.5);
        Some(Point3::new(place.x, place.y, self.top - f64::from(depth)))
    }

    /// What a renderer is asked for.
    pub fn request(&self) -> ViewRequest {
        // The columns are right, down and forward in the world: east, south, down.
        let axes = Matrix3::new(1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, -1.0);
        let rotation = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes));
        let eye = Point3::new(self.center.x, self.center.y, self.top);
        let scale = 1.0 / self.metres_per_pixel;
        let intrinsics = Intrinsics {
            width: self.width,
            height: self.height,
            fx: scale,
            fy: scale,
            cx: f64::from(self.width) * 0.5,
            cy: f64::from(self.height) * 0.5,
        };
        let camera = Camera { world_from_optical: Pose::from_parts(eye.into(), rotation), intrinsics };
        ViewRequest { projection: Projection::Parallel, ..ViewRequest::from(camera) }
    }

    /// Draws it.
    ///
    /// # Errors
    /// As [`Renderer::render_views`].
    pub fn draw(
        &self,
        renderer: &mut Renderer,
        scene: &dyn Scene,
        frame: &mut Frame,
    ) -> Result<(), RenderError> {
        let mut views = Views::new();
        renderer.render_views(scene, &[self.request()], &ViewOptions::default(), &mut views)?;
        views.copy_frame(0, frame);
        Ok(())
    }
}

/// A map around whoever wears it, as core's `Observer`: north up, the wearer in the middle and on the picture.
#[derive(Clone, Debug)]
pub struct MapSensor {
    renderer: Arc<Mutex<Renderer>>,
    size: [u32; 2],
    metres_per_pixel: f64,
    above: f64,
}

impl MapSensor {
    /// A map of so many pixels across and down, as seen from 60 m above the wearer.
    pub fn new(renderer: Arc<Mutex<Renderer>>, size: [u32; 2], metres_per_pixel: f64) -> Self {
        Self { renderer, size, metres_per_pixel, above: 60.0 }
    }

    /// As seen from another height above the wearer, m: a low one looks under roofs and crowns.
    #[must_use]
    pub fn from_above(mut self, above: f64) -> Self {
        self.above = above;
        self
    }

    /// The map around that wearer as it stands now.
    ///
    /// # Errors
    /// Nobody has that id.
    pub fn view(&self, scene: &dyn Scene, who: EntityId) -> Result<MapView, ObserveError> {
        let wearer = scene.entity(who).ok_or(ObserveError::Missing { id: who })?;
        let [width, height] = self.size;
        Ok(MapView {
            center: wearer.planar(),
            top: wearer.position().z + self.above,
            metres_per_pixel: self.metres_per_pixel,
            width,
            height,
        })
    }
}

impl Observer for MapSensor {
    type Observation = Frame;

    fn observe(&mut self, scene: &dyn Scene, who: EntityId, out: &mut Frame) -> Result<(), ObserveError> {
        let view = self.view(scene, who)?;
        let mut renderer = self.renderer.lock().unwrap_or_else(PoisonError::into_inner);
        view.draw(&mut renderer, scene, out).map_err(|error| ObserveError::Sensor(error.to_string()))
    }
}
