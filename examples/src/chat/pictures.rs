//! What one sees while it is done: the map with the way so far, and the view from the eyes.

use std::path::{Path, PathBuf};

use simworld_citygen::City;
use simworld_citygen::map::MapDrawing;
use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::{Point3, direction};
use simworld_core::scene::Scene;
use simworld_core::seam::{Goal, PlanStep};
use simworld_render::{Frame, RenderConfig, RenderError, Renderer};

use super::Stage;
use super::stage::heading_of;

/// Writes the pictures of a stage to a folder.
pub struct Pictures {
    folder: PathBuf,
    eyes: Option<(Renderer, Intrinsics, Frame)>,
}

impl Pictures {
    /// Pictures in that folder; without a graphics adapter there is the map alone, and the reason is returned beside.
    pub fn new(folder: &Path) -> (Self, Option<RenderError>) {
        let made = Renderer::new(&RenderConfig::default()).and_then(|renderer| {
            Ok((renderer, Intrinsics::from_fov(960, 540, 1.4).map_err(RenderError::from)?, Frame::new()))
        });
        let (eyes, missing) = match made {
            Ok(eyes) => (Some(eyes), None),
            Err(reason) => (None, Some(reason)),
        };
        (Self { folder: folder.to_owned(), eyes }, missing)
    }

    /// Writes `map.svg`: the city, the way so far and where it leads now.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn map(&self, city: &City, stage: &Stage, title: &str) -> std::io::Result<()> {
        let mut trail = stage.trail.clone();
        trail.push(stage.here());
        let mut drawing = MapDrawing::of(city).title(shortened(title)).trail(&trail, "#b3261e", "Robin");
        if let Some(PlanStep::Navigate { to, .. }) = stage.under_way() {
            let place = match to {
                Goal::Point(point) => Some(point.xy()),
                Goal::Entity(id) => stage.world().entity(*id).map(|entity| entity.access().xy()),
                _ => None,
            };
            if let Some(place) = place {
                drawing = drawing.marker(&place, "#1f4e9c", "goal");
            }
        }
        std::fs::write(self.folder.join("map.svg"), drawing.to_string())
    }

    /// Writes what the eyes see as `eye-TICK.png` and `eye.png`, if there is an adapter.
    ///
    /// # Errors
    /// The adapter failed, or a file cannot be written.
    pub fn eye(&mut self, stage: &Stage) -> Result<(), RenderError> {
        let Some((renderer, intrinsics, frame)) = &mut self.eyes else { return Ok(()) };
        let world = stage.world();
        let Some(yaw) = heading_of(world, stage.me()) else { return Ok(()) };
        // From between the eyes; in a car from above the dashboard.
        let ahead = direction(yaw);
        let is_aboard = world.entity(stage.me()).is_some_and(|me| me.attachment.is_some());
        let (height, forward) = if is_aboard { (1.7, 1.2) } else { (1.62, 0.35) };
        let here = stage.here() + ahead * forward;
        let target = here + ahead * 20.0;
        let camera = Camera::looking_at(
            Point3::new(here.x, here.y, height),
            Point3::new(target.x, target.y, 1.2),
            *intrinsics,
        );
        renderer.render(world, &camera, frame)?;
        frame.write_png(self.folder.join(format!("eye-{:06}.png", world.clock().tick().0)))?;
        frame.write_png(self.folder.join("eye.png"))?;
        Ok(())
    }
}

/// What of a sentence finds room beside the legend.
fn shortened(sentence: &str) -> String {
    const ROOM: usize = 42;
    match sentence.char_indices().nth(ROOM) {
        Some((end, _)) => format!("{} …", sentence[..end].trim_end()),
        None => sentence.to_owned(),
    }
}
