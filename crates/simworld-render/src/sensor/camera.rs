//! A camera worn by an entity, as core's `Observer`.

use std::sync::{Arc, Mutex, PoisonError};

use nalgebra::UnitQuaternion;
use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::{Point3, Pose, Vector3};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityKind, EntityRef, Scene};
use simworld_core::seam::{ObserveError, Observer};
use simworld_core::seed::Seed;

use super::drops::fall_before;
use crate::classes::ClassTable;
use crate::{Channels, Frame, RenderConfig, RenderError, Renderer, ViewOptions, ViewRequest, Views};

/// Eye height of a person 1.75 m tall, m.
const EYE_HEIGHT: f64 = 1.6;

/// A camera mounted on whoever is observed: it looks along the body's forward axis, as far up as the wearer's gaze, with the
/// field of view that the wearer focuses on, and does not see the wearer.
///
/// Many sensors may share one renderer.
///
/// ```no_run
/// use simworld_core::camera::Intrinsics;
/// use simworld_core::geometry::{Point3, pose_facing};
/// use simworld_core::scene::{EntityDesc, EntityKind, Shape, World};
/// use simworld_core::seam::Observer;
/// use simworld_render::{CameraSensor, Frame, RenderConfig};
///
/// let mut world = World::new();
/// let shape = Shape::Capsule { radius: 0.25, height: 1.75 };
/// let walker = world.spawn(EntityDesc::new(EntityKind::Person, pose_facing(Point3::origin(), 0.0), shape))?;
/// let mut eyes = CameraSensor::new(Intrinsics::from_fov(640, 480, 1.5)?, &RenderConfig::default())?;
/// let mut frame = Frame::default();
/// eyes.observe(&world, walker, &mut frame)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct CameraSensor {
    renderer: Arc<Mutex<Renderer>>,
    intrinsics: Intrinsics,
    mount: Option<Pose>,
    classes: Option<Arc<ClassTable>>,
    channels: Channels,
    /// Seed of what falls before it in depth, where that is asked for.
    falling: Option<Seed>,
    views: Views,
}

impl CameraSensor {
    /// A camera with a renderer of its own.
    ///
    /// # Errors
    /// As [`Renderer::new`].
    pub fn new(intrinsics: Intrinsics, config: &RenderConfig) -> Result<Self, RenderError> {
        Ok(Self::sharing(Arc::new(Mutex::new(Renderer::new(config)?)), intrinsics))
    }

    /// A camera that shares a renderer with others.
    pub fn sharing(renderer: Arc<Mutex<Renderer>>, intrinsics: Intrinsics) -> Self {
        let channels = ViewOptions::default().channels;
        Self {
            renderer,
            intrinsics,
            mount: None,
            classes: None,
            channels,
            falling: None,
            views: Views::new(),
        }
    }

    /// Mounted at a pose in the wearer's body frame (x forward, y left, z up), instead of at
    /// [`default_mount`](Self::default_mount).
    #[must_use]
    pub fn mounted_at(mut self, body_from_mount: Pose) -> Self {
        self.mount = Some(body_from_mount);
        self
    }

    /// With classes by a table of one's own, in place of those of Cityscapes.
    #[must_use]
    pub fn classed_by(mut self, table: Arc<ClassTable>) -> Self {
        self.classes = Some(table);
        self
    }

    /// Measures these channels, in place of colour, depth, ids and classes; buffers of others are as [`Frame::resize`] leaves them.
    #[must_use]
    pub fn measuring(mut self, channels: Channels) -> Self {
        self.channels = channels;
        self
    }

    /// With rain and snow in depth, which is exact otherwise: where a drop or a flake covers the middle of a pixel and is at least a
    /// pixel wide, depth is that of the drop; ids, classes and colour stay. Sizes are those of Marshall and Palmer for rain, of Gunn and
    /// Marshall for snow; places are drawn by this seed, tick and wearer.
    ///
    /// ```no_run
    /// # use simworld_core::camera::Intrinsics;
    /// # use simworld_core::seed::Seed;
    /// # use simworld_render::{CameraSensor, RenderConfig};
    /// let eyes = CameraSensor::new(Intrinsics::from_fov(640, 480, 1.5)?, &RenderConfig::default())?;
    /// let eyes = eyes.with_precipitation_in_depth(Seed(3));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn with_precipitation_in_depth(mut self, seed: Seed) -> Self {
        self.falling = Some(seed);
        self
    }

    /// Where the camera sits if nothing else is said: at the eyes of a person (1.6 m of 1.75 m), above the windscreen
    /// of a vehicle, and otherwise at nine tenths of the height, in the middle.
    pub fn default_mount(wearer: &EntityRef<'_>) -> Pose {
        let size = wearer.info.shape.size();
        match wearer.kind {
            EntityKind::Person => Pose::translation(0.0, 0.0, EYE_HEIGHT.min(size.z * EYE_HEIGHT / 1.75)),
            kind if kind.is_vehicle() => Pose::translation(size.x * 0.2, 0.0, size.z * 0.9),
            _ => Pose::translation(0.0, 0.0, size.z * 0.9),
        }
    }

    /// The camera on that wearer, as it stands now.
    ///
    /// # Errors
    /// Nobody has that id.
    pub fn camera(&self, scene: &dyn Scene, who: EntityId) -> Result<Camera, ObserveError> {
        let wearer = scene.entity(who).ok_or(ObserveError::Missing { id: who })?;
        let body_from_mount = self.mount.unwrap_or_else(|| Self::default_mount(&wearer));
        // Upwards is against the turn about the axis to the left.
        let gaze = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), -wearer.gaze());
        let intrinsics = match wearer.field_of_view() {
            Some(angle) => Intrinsics::from_fov(self.intrinsics.width, self.intrinsics.height, angle)
                .map_err(|error| ObserveError::Sensor(error.to_string()))?,
            None => self.intrinsics,
        };
        Ok(Camera::looking_along(&(wearer.pose * body_from_mount * gaze), intrinsics))
    }

    /// The renderer that it shares.
    pub fn renderer(&self) -> Arc<Mutex<Renderer>> {
        Arc::clone(&self.renderer)
    }

    /// The point from which it sees in the body frame of that wearer, m.
    pub fn eye_in_body(&self, wearer: &EntityRef<'_>) -> Point3 {
        self.mount.unwrap_or_else(|| Self::default_mount(wearer)).translation.vector.into()
    }
}

impl Observer for CameraSensor {
    type Observation = Frame;

    fn observe(&mut self, scene: &dyn Scene, who: EntityId, out: &mut Frame) -> Result<(), ObserveError> {
        let camera = self.camera(scene, who)?;
        let mut renderer = self.renderer.lock().unwrap_or_else(PoisonError::into_inner);
        let request = ViewRequest { hidden: Some(who), ..ViewRequest::from(camera) };
        let options = ViewOptions { channels: self.channels, ..ViewOptions::default() };
        renderer
            .render_views(scene, &[request], &options, &mut self.views)
            .map_err(|error| ObserveError::Sensor(error.to_string()))?;
        drop(renderer);
        self.views.copy_frame(0, out);
        if let Some(seed) = self.falling {
            let stream = seed.stream("camera/drops").indexed(scene.clock().tick().0).indexed(who.into());
            fall_before(out, &camera, &scene.environment().weather, stream);
        }
        if let Some(table) = &self.classes {
            table.relabel(scene, out);
        }
        Ok(())
    }
}
