//! A film of the course as a GIF: everybody from behind and above, side by side.

use std::fs::File;
use std::io::BufWriter;
use std::path::Path;

use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::{Point3, Vector3};
use simworld_core::id::EntityId;
use simworld_core::scene::{Scene, World};
use simworld_render::{Frame, RenderConfig, RenderError, Renderer};
use thiserror::Error;

/// A view and how many stand side by side, pixels.
const VIEW: (u16, u16) = (240, 150);
const ACROSS: usize = 3;
/// How long a picture stays, hundredths of a second.
const DELAY: u16 = 10;

/// Why there is no film.
#[derive(Debug, Error)]
pub enum FilmError {
    /// No adapter, or it failed.
    #[error("the course could not be filmed: {0}")]
    Render(#[from] RenderError),
    /// The file cannot be written.
    #[error("the film could not be written: {0}")]
    Encoding(#[from] gif::EncodingError),
    /// The file cannot be made.
    #[error("the film could not be written to {path}: {source}")]
    File {
        /// Which.
        path: String,
        /// Why.
        source: std::io::Error,
    },
}

/// A film in the making.
pub struct Film {
    renderer: Renderer,
    intrinsics: Intrinsics,
    frame: Frame,
    encoder: gif::Encoder<BufWriter<File>>,
    picture: Vec<u8>,
    size: (u16, u16),
}

impl Film {
    /// A film of so many at once.
    ///
    /// # Errors
    /// No adapter: the message says what to install; or the file cannot be made.
    pub fn new(path: &Path, views: usize) -> Result<Self, FilmError> {
        let renderer = Renderer::new(&RenderConfig::default())?;
        let intrinsics =
            Intrinsics::from_fov(u32::from(VIEW.0), u32::from(VIEW.1), 1.0).map_err(RenderError::from)?;
        let (columns, rows) = (views.clamp(1, ACROSS), views.max(1).div_ceil(ACROSS));
        let size = (VIEW.0 * columns as u16, VIEW.1 * rows as u16);
        let named = |source| FilmError::File { path: path.display().to_string(), source };
        let file = File::create(path).map_err(named)?;
        let mut encoder = gif::Encoder::new(BufWriter::new(file), size.0, size.1, &[])?;
        encoder.set_repeat(gif::Repeat::Infinite)?;
        let picture = vec![255; 3 * usize::from(size.0) * usize::from(size.1)];
        Ok(Self { renderer, intrinsics, frame: Frame::new(), encoder, picture, size })
    }

    /// Takes a picture of where everybody is.
    ///
    /// # Errors
    /// The adapter failed, or the file cannot be written.
    pub fn take(&mut self, world: &World, who: impl Iterator<Item = EntityId>) -> Result<(), FilmError> {
        for (rank, id) in who.enumerate() {
            let Some(camera) = behind(world, id, self.intrinsics) else { continue };
            self.renderer.render(world, &camera, &mut self.frame)?;
            self.paste(rank);
        }
        let mut frame = gif::Frame::from_rgb_speed(self.size.0, self.size.1, &self.picture, 10);
        frame.delay = DELAY;
        self.encoder.write_frame(&frame)?;
        Ok(())
    }

    /// Copies the view that was drawn to its place.
    fn paste(&mut self, rank: usize) {
        let (left, top) = (rank % ACROSS * usize::from(VIEW.0), rank / ACROSS * usize::from(VIEW.1));
        let (row, whole) = (3 * usize::from(VIEW.0), 3 * usize::from(self.size.0));
        for (line, pixels) in self.frame.rgb.chunks_exact(row).enumerate() {
            let at = (top + line) * whole + 3 * left;
            self.picture[at..at + row].copy_from_slice(pixels);
        }
    }
}

/// A camera behind and above somebody, as far off as it is large.
fn behind(world: &World, id: EntityId, intrinsics: Intrinsics) -> Option<Camera> {
    let runner = world.entity(id)?;
    let (at, size) = (runner.position(), runner.info.shape.size());
    let far = 3.0 + 1.1 * size.x;
    let eye = at + Vector3::new(-far, -0.55 * far, 1.2 + 0.45 * far);
    Some(Camera::looking_at(eye, Point3::new(at.x + 1.0, at.y, at.z + size.z * 0.4), intrinsics))
}
