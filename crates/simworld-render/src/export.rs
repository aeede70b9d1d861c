//! Frames as PNG files: RGB in 8 bits, depth in 16-bit millimetres, classes with their palette, instances in colours.

use std::path::Path;

use png::{BitDepth, ColorType};
use simworld_core::seed::Seed;

use crate::classes::{ClassTable, class_by_id};
use crate::{Frame, RenderError};

/// The greatest depth that a depth PNG holds, m; what is farther reads the same.
pub const PNG_DEPTH_LIMIT: f32 = 65.535;

impl Frame {
    /// RGB as an 8-bit sRGB PNG.
    ///
    /// # Errors
    /// The frame was never drawn, or its buffer was resized by hand.
    pub fn rgb_png(&self) -> Result<Vec<u8>, RenderError> {
        self.check("rgb", self.rgb.len(), 3)?;
        self.encode(ColorType::Rgb, BitDepth::Eight, None, &self.rgb)
    }

    /// As [`rgb_png`](Self::rgb_png), with a text under the keyword `Description`.
    pub(crate) fn rgb_png_described(&self, text: &str) -> Result<Vec<u8>, RenderError> {
        self.check("rgb", self.rgb.len(), 3)?;
        self.encode_described(ColorType::Rgb, BitDepth::Eight, None, &self.rgb, Some(text))
    }

    /// Depth as a 16-bit grey PNG in millimetres: 0 for the sky, 65535 for 65.535 m and beyond.
    ///
    /// # Errors
    /// As [`rgb_png`](Self::rgb_png).
    pub fn depth_png(&self) -> Result<Vec<u8>, RenderError> {
        self.check("depth", self.depth.len(), 1)?;
        let millimetres = |depth: &f32| if depth.is_finite() { (depth * 1000.0).round() as u16 } else { 0 };
        let bytes: Vec<u8> = self.depth.iter().flat_map(|depth| millimetres(depth).to_be_bytes()).collect();
        self.encode(ColorType::Grayscale, BitDepth::Sixteen, None, &bytes)
    }

    /// Classes as an indexed PNG whose indices are the Cityscapes label ids and whose palette is that of Cityscapes.
    ///
    /// # Errors
    /// As [`rgb_png`](Self::rgb_png).
    pub fn classes_png(&self) -> Result<Vec<u8>, RenderError> {
        self.check("classes", self.classes.len(), 1)?;
        let palette: Vec<u8> =
            (0..=u8::MAX).flat_map(|id| class_by_id(id).map_or([0; 3], |class| class.color)).collect();
        self.encode(ColorType::Indexed, BitDepth::Eight, Some(&palette), &self.classes)
    }

    /// As [`classes_png`](Self::classes_png), with the palette of a table of one's own.
    ///
    /// # Errors
    /// As [`rgb_png`](Self::rgb_png).
    pub fn classes_png_by(&self, table: &ClassTable) -> Result<Vec<u8>, RenderError> {
        self.check("classes", self.classes.len(), 1)?;
        self.encode(ColorType::Indexed, BitDepth::Eight, Some(&table.palette()), &self.classes)
    }

    /// Instances as an RGB PNG, for people to look at: every entity has a colour of its own, the sky is black.
    ///
    /// # Errors
    /// As [`rgb_png`](Self::rgb_png).
    pub fn ids_png(&self) -> Result<Vec<u8>, RenderError> {
        self.check("ids", self.ids.len(), 1)?;
        let colors = Seed(0).stream("render/instance-colors");
        let paint = |id: &u32| {
            if *id == 0 {
                return [0; 3];
            }
            let [r, g, b, ..] = colors.indexed(u64::from(*id)).seed().0.to_le_bytes();
            [r | 0x30, g | 0x30, b | 0x30]
        };
        let bytes: Vec<u8> = self.ids.iter().flat_map(paint).collect();
        self.encode(ColorType::Rgb, BitDepth::Eight, None, &bytes)
    }

    /// Writes [`rgb_png`](Self::rgb_png) to a file.
    ///
    /// # Errors
    /// As [`rgb_png`](Self::rgb_png), and a file that cannot be written.
    pub fn write_png(&self, path: impl AsRef<Path>) -> Result<(), RenderError> {
        write(path.as_ref(), &self.rgb_png()?)
    }

    /// Writes [`depth_png`](Self::depth_png) to a file.
    ///
    /// # Errors
    /// As [`write_png`](Self::write_png).
    pub fn write_depth_png(&self, path: impl AsRef<Path>) -> Result<(), RenderError> {
        write(path.as_ref(), &self.depth_png()?)
    }

    /// Writes [`classes_png`](Self::classes_png) to a file.
    ///
    /// # Errors
    /// As [`write_png`](Self::write_png).
    pub fn write_classes_png(&self, path: impl AsRef<Path>) -> Result<(), RenderError> {
        write(path.as_ref(), &self.classes_png()?)
    }

    /// Writes [`ids_png`](Self::ids_png) to a file.
    ///
    /// # Errors
    /// As [`write_png`](Self::write_png).
    pub fn write_ids_png(&self, path: impl AsRef<Path>) -> Result<(), RenderError> {
        write(path.as_ref(), &self.ids_png()?)
    }

    fn encode(
        &self,
        color: ColorType,
        depth: BitDepth,
        palette: Option<&[u8]>,
        bytes: &[u8],
    ) -> Result<Vec<u8>, RenderError> {
        self.encode_described(color, depth, palette, bytes, None)
    }

    fn encode_described(
        &self,
        color: ColorType,
        depth: BitDepth,
        palette: Option<&[u8]>,
        bytes: &[u8],
        text: Option<&str>,
    ) -> Result<Vec<u8>, RenderError> {
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, self.width, self.height);
        encoder.set_color(color);
        encoder.set_depth(depth);
        if let Some(palette) = palette {
            encoder.set_palette(palette);
        }
        if let Some(text) = text {
            encoder.add_text_chunk("Description".into(), text.into())?;
        }
        let mut writer = encoder.write_header()?;
        writer.write_image_data(bytes)?;
        writer.finish()?;
        Ok(file)
    }
}

pub(crate) fn write(path: &Path, bytes: &[u8]) -> Result<(), RenderError> {
    std::fs::write(path, bytes).map_err(|source| RenderError::Write { path: path.to_owned(), source })
}
