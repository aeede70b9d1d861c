//! The cameras of a server. They are no part of the world: moving one changes nothing in it, and is not recorded.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use simworld_core::camera::{Camera, CameraError, Intrinsics};
use simworld_core::geometry::{Point3, Pose, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityKind, EntityRef, Scene};

use super::{Limits, RemoteError, View};

/// What a camera is fixed to.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Mount {
    /// Nothing: world from camera, which looks along x with z up.
    Free(Pose),
    /// An entity that it goes with and does not see: body from camera.
    Worn(EntityId, Pose),
}

/// A camera: where it is and how it looks.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CameraPlace {
    /// What it is fixed to.
    pub mount: Mount,
    /// Horizontal field of view, rad, in (0, π).
    pub horizontal_fov: f64,
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
}

impl Default for CameraPlace {
    /// 640 by 480 pixels over 90°, 1.7 m above the origin, towards the east.
    fn default() -> Self {
        Self {
            mount: Mount::Free(pose_facing(Point3::new(0.0, 0.0, 1.7), 0.0)),
            horizontal_fov: std::f64::consts::FRAC_PI_2,
            width: 640,
            height: 480,
        }
    }
}

impl CameraPlace {
    /// Checks the size and the field of view.
    ///
    /// # Errors
    /// More pixels than allowed, none, or no usable angle.
    pub fn validate(&self, limits: &Limits) -> Result<(), RemoteError> {
        let pixels = u64::from(self.width) * u64::from(self.height);
        if pixels > u64::from(limits.pixels) {
            let allowed = "at most as many as limits.pixels";
            return Err(RemoteError::Setting { field: "camera pixels", value: pixels as f64, allowed });
        }
        match Intrinsics::from_fov(self.width, self.height, self.horizontal_fov) {
            Ok(_) => Ok(()),
            Err(CameraError::FieldOfView { radians }) => {
                let allowed = "an angle between 0 and π";
                Err(RemoteError::Setting { field: "camera field of view", value: radians, allowed })
            }
            Err(_) => {
                let allowed = "1 to 16384 pixels each way";
                Err(RemoteError::Setting { field: "camera size", value: pixels as f64, allowed })
            }
        }
    }

    /// World from camera; none if its wearer is gone.
    pub fn pose(&self, scene: &dyn Scene) -> Option<Pose> {
        match self.mount {
            Mount::Free(pose) => Some(pose),
            Mount::Worn(who, body_from_camera) => scene.entity(who).map(|body| body.pose * body_from_camera),
        }
    }

    /// Puts it at a pose of the world; one that is worn goes with its wearer from there.
    pub fn put(&mut self, scene: &dyn Scene, world_from_camera: Pose) {
        self.mount = match self.mount {
            Mount::Worn(who, old) => match scene.entity(who) {
                Some(body) => Mount::Worn(who, body.pose.inverse() * world_from_camera),
                None => Mount::Worn(who, old),
            },
            Mount::Free(_) => Mount::Free(world_from_camera),
        };
    }

    /// What it looks from; none if its wearer is gone, or it cannot exist.
    pub fn view(&self, scene: &dyn Scene) -> Option<View> {
        let intrinsics = Intrinsics::from_fov(self.width, self.height, self.horizontal_fov).ok()?;
        let hidden = match self.mount {
            Mount::Worn(who, _) => Some(who),
            Mount::Free(_) => None,
        };
        Some(View { camera: Camera::looking_along(&self.pose(scene)?, intrinsics), hidden })
    }

    /// Where a camera sits on somebody: at the eyes of a person 1.75 m tall (1.6 m), above the windscreen of a vehicle, and
    /// otherwise at nine tenths of the height.
    pub fn eyes_of(wearer: &EntityRef<'_>) -> Pose {
        let size = wearer.info.shape.size();
        match wearer.kind {
            EntityKind::Person => Pose::translation(0.0, 0.0, size.z * (1.6 / 1.75)),
            kind if kind.is_vehicle() => Pose::translation(size.x * 0.2, 0.0, size.z * 0.9),
            _ => Pose::translation(0.0, 0.0, size.z * 0.9),
        }
    }
}

/// The cameras by number.
pub(super) struct Cameras {
    places: BTreeMap<u32, CameraPlace>,
    next: u32,
    most: usize,
}

impl Cameras {
    pub(super) fn new(first: CameraPlace, most: usize) -> Self {
        Self { places: BTreeMap::from([(0, first)]), next: 1, most }
    }

    /// Adds a camera and gives its number; none if there are too many.
    pub(super) fn add(&mut self, place: CameraPlace) -> Option<u32> {
        if self.places.len() >= self.most {
            return None;
        }
        let number = self.next;
        self.next = number.checked_add(1)?;
        self.places.insert(number, place);
        Some(number)
    }

    /// A camera of the size of the first, at somebody's eyes.
    pub(super) fn wear(&mut self, wearer: &EntityRef<'_>) -> Option<u32> {
        let first = self.places.get(&0).copied().unwrap_or_default();
        self.add(CameraPlace { mount: Mount::Worn(wearer.id, CameraPlace::eyes_of(wearer)), ..first })
    }

    pub(super) fn get(&self, number: u32) -> Option<&CameraPlace> {
        self.places.get(&number)
    }

    pub(super) fn get_mut(&mut self, number: u32) -> Option<&mut CameraPlace> {
        self.places.get_mut(&number)
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = (u32, &CameraPlace)> {
        self.places.iter().map(|(number, place)| (*number, place))
    }

    pub(super) fn iter_mut(&mut self) -> impl Iterator<Item = &mut CameraPlace> {
        self.places.values_mut()
    }

    /// Takes away the cameras of those who are gone.
    pub(super) fn forget_gone(&mut self, scene: &dyn Scene) {
        self.places.retain(|_, place| match place.mount {
            Mount::Worn(who, _) => scene.entity(who).is_some(),
            Mount::Free(_) => true,
        });
    }
}
