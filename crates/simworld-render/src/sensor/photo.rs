//! Photos: what somebody who takes one gets, as a frame and as a file that says how it was taken.

use std::path::{Path, PathBuf};

use simworld_core::action::ActionKind;
use simworld_core::camera::Camera;
use simworld_core::event::{Event, EventKind};
use simworld_core::id::EntityId;
use simworld_core::scene::Scene;
use simworld_core::seam::{ObserveError, Observer};

use super::CameraSensor;
use crate::export::write;
use crate::{Frame, RenderError};

/// A picture that somebody took, with the camera and the moment.
#[derive(Clone, Debug, PartialEq)]
pub struct Photo {
    /// Who took it.
    pub who: EntityId,
    /// The step after which it was taken.
    pub tick: u64,
    /// Where it was taken from, and how.
    pub camera: Camera,
    /// What is on it.
    pub frame: Frame,
}

impl Photo {
    /// Its colours as a PNG, with [`description`](Self::description) under the keyword `Description`.
    ///
    /// # Errors
    /// As [`Frame::rgb_png`].
    pub fn png(&self) -> Result<Vec<u8>, RenderError> {
        self.frame.rgb_png_described(&self.description())
    }

    /// Who, when and from where, as one JSON object: `who`, `tick`, `width`, `height`, `fx`, `fy`, `cx`, `cy` (pixels), `position`
    /// (world frame, m) and `rotation` (world from optical, quaternion x, y, z, w).
    pub fn description(&self) -> String {
        let (k, pose) = (&self.camera.intrinsics, &self.camera.world_from_optical);
        let ([x, y, z], [i, j, l, w]): ([f64; 3], [f64; 4]) =
            (pose.translation.vector.into(), pose.rotation.coords.into());
        format!(
            "{{\"who\":{},\"tick\":{},\"width\":{},\"height\":{},\"fx\":{:?},\"fy\":{:?},\"cx\":{:?},\"cy\":{:?},\
             \"position\":[{x:?},{y:?},{z:?}],\"rotation\":[{i:?},{j:?},{l:?},{w:?}]}}",
            u64::from(self.who),
            self.tick,
            k.width,
            k.height,
            k.fx,
            k.fy,
            k.cx,
            k.cy
        )
    }

    /// Writes [`png`](Self::png) to a file.
    ///
    /// # Errors
    /// As [`png`](Self::png), and a file that cannot be written.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), RenderError> {
        write(path.as_ref(), &self.png()?)
    }
}

impl CameraSensor {
    /// Takes a photo of what the wearer has before it, by its gaze and the field of view that it focuses on.
    ///
    /// # Errors
    /// As [`observe`](Observer::observe).
    pub fn take_photo(&mut self, scene: &dyn Scene, who: EntityId) -> Result<Photo, ObserveError> {
        let mut frame = Frame::new();
        self.observe(scene, who, &mut frame)?;
        let camera = self.camera(scene, who)?;
        Ok(Photo { who, tick: scene.clock().tick().0, camera, frame })
    }
}

/// Takes a photo whenever somebody does the action `take_photo`, and files it in a folder.
#[derive(Clone, Debug)]
pub struct PhotoRoll {
    camera: CameraSensor,
    folder: PathBuf,
}

impl PhotoRoll {
    /// A roll that is filed in a folder, which must be there.
    pub fn new(camera: CameraSensor, folder: impl Into<PathBuf>) -> Self {
        Self { camera, folder: folder.into() }
    }

    /// Takes the photos of a finished step, whose events these are: `photo-TICK-SLOT.png` each; returns photos and files.
    /// Who took one and is gone has taken none.
    ///
    /// # Errors
    /// The camera failed, or a file cannot be written.
    pub fn develop(
        &mut self,
        scene: &dyn Scene,
        events: &[Event],
    ) -> Result<Vec<(Photo, PathBuf)>, RenderError> {
        let mut photos = Vec::new();
        for event in events {
            let EventKind::Gesture { who, gesture: ActionKind::TakePhoto, .. } = event.kind else { continue };
            let photo = match self.camera.take_photo(scene, who) {
                Err(ObserveError::Missing { .. }) => continue,
                taken => taken.map_err(|error| RenderError::Device(error.to_string()))?,
            };
            let path = self.folder.join(format!("photo-{:06}-{}.png", event.tick.0, who.index()));
            photo.write(&path)?;
            photos.push((photo, path));
        }
        Ok(photos)
    }
}
