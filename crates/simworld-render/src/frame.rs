//! What a camera yields: colour, depth and ids, as plain arrays and as PNG.

use std::io::Cursor;
use std::path::Path;

use simworld_core::id::EntityId;
use simworld_core::scene::Scene;

use crate::RenderError;
use crate::classes::class_color;

/// The depth of the sky.
pub const SKY_DEPTH: f32 = f32::INFINITY;

/// One image: row-major, top row first. The caller owns it and passes it again, so that its memory is reused.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Colour, three bytes a pixel, sRGB.
    pub rgb: Vec<u8>,
    /// Planar depth, m: distance along the optical axis; [`SKY_DEPTH`] where nothing was met.
    pub depth: Vec<f32>,
    /// Slot of the entity plus one; 0 for the sky.
    pub instances: Vec<u32>,
    /// Cityscapes class id.
    pub classes: Vec<u8>,
}

impl Frame {
    /// An empty frame, to be filled.
    pub fn new() -> Self {
        Self::default()
    }

    /// The entity that a pixel shows, in the scene that was rendered.
    pub fn entity_at(&self, scene: &dyn Scene, x: u32, y: u32) -> Option<EntityId> {
        let slot = self.instances.get((y * self.width + x) as usize)?.checked_sub(1)?;
        // A frame holds slots; the generation is the one that lives there now.
        (0..1024).map(|generation| EntityId::new(slot, generation)).find(|id| scene.entity(*id).is_some())
    }

    /// The colour image as PNG.
    ///
    /// # Errors
    /// An empty frame.
    pub fn rgb_png(&self) -> Result<Vec<u8>, RenderError> {
        self.encode(png::ColorType::Rgb, png::BitDepth::Eight, &self.rgb)
    }

    /// The depth image as PNG: 16 bit, mm; 0 for the sky, 65535 for 65.535 m and more.
    ///
    /// # Errors
    /// An empty frame.
    pub fn depth_png(&self) -> Result<Vec<u8>, RenderError> {
        let millimetres = |depth: &f32| if depth.is_finite() { (depth * 1000.0).round() as u16 } else { 0 };
        let bytes: Vec<u8> = self.depth.iter().flat_map(|depth| millimetres(depth).to_be_bytes()).collect();
        self.encode(png::ColorType::Grayscale, png::BitDepth::Sixteen, &bytes)
    }

    /// The classes in the Cityscapes palette as PNG.
    ///
    /// # Errors
    /// An empty frame.
    pub fn classes_png(&self) -> Result<Vec<u8>, RenderError> {
        let bytes: Vec<u8> = self.classes.iter().flat_map(|class| class_color(*class)).collect();
        self.encode(png::ColorType::Rgb, png::BitDepth::Eight, &bytes)
    }

    /// Writes the colour image.
    ///
    /// # Errors
    /// The image is empty, or the file cannot be written.
    pub fn write_png(&self, path: impl AsRef<Path>) -> Result<(), RenderError> {
        let path = path.as_ref();
        std::fs::write(path, self.rgb_png()?)
            .map_err(|source| RenderError::File { path: path.to_owned(), source })
    }

    fn encode(&self, color: png::ColorType, depth: png::BitDepth, bytes: &[u8]) -> Result<Vec<u8>, RenderError> {
        let mut out = Cursor::new(Vec::new());
        let mut encoder = png::Encoder::new(&mut out, self.width, self.height);
        encoder.set_color(color);
        encoder.set_depth(depth);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(bytes)?;
        writer.finish()?;
        Ok(out.into_inner())
    }
}
