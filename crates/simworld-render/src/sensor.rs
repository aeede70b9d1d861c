//! A camera as a sense: what an entity sees from where it stands.

use std::sync::{Arc, Mutex};

use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::{Point3, Pose};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityKind, EntityRef, Scene};
use simworld_core::seam::{ObserveError, Observer};

use crate::{Frame, Renderer};

/// Where a camera sits on its carrier.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Mount {
    /// At the eyes of a person, the top of anything else, looking ahead.
    #[default]
    Eyes,
    /// At a pose of the carrier's body frame, looking along the pose's x axis.
    Body(Pose),
}

impl Mount {
    fn pose(&self, carrier: &EntityRef<'_>) -> Pose {
        match self {
            Self::Body(body_from_camera) => carrier.pose * body_from_camera,
            Self::Eyes => {
                let size = carrier.info.shape.size();
                let (forward, up) = match carrier.kind {
                    // Before the face, so that the head is not in the picture.
                    EntityKind::Person => (0.25, size.z - 0.12),
                    _ => (0.0, size.z + 0.1),
                };
                let eyes = carrier.pose * Point3::new(forward, 0.0, up);
                Pose::from_parts(eyes.into(), carrier.pose.rotation)
            }
        }
    }
}

/// A camera carried by whoever observes; several may share a renderer.
#[derive(Clone)]
pub struct CameraSensor {
    renderer: Arc<Mutex<Renderer>>,
    intrinsics: Intrinsics,
    mount: Mount,
}

impl CameraSensor {
    /// A camera with these intrinsics.
    pub fn new(renderer: Arc<Mutex<Renderer>>, intrinsics: Intrinsics, mount: Mount) -> Self {
        Self { renderer, intrinsics, mount }
    }
}

impl Observer for CameraSensor {
    type Observation = Frame;

    fn observe(&mut self, scene: &dyn Scene, who: EntityId, out: &mut Frame) -> Result<(), ObserveError> {
        let carrier = scene.entity(who).ok_or(ObserveError::Missing { id: who })?;
        let camera = Camera::looking_along(&self.mount.pose(&carrier), self.intrinsics);
        let mut renderer =
            self.renderer.lock().map_err(|_| ObserveError::Sensor("the renderer failed before".to_owned()))?;
        renderer.render(scene, &camera, out).map_err(|error| ObserveError::Sensor(error.to_string()))
    }
}
