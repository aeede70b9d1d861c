//! Pictures of a camera, as a vision model gets them. Any observer that yields them serves; this crate renders none.

use serde::{Deserialize, Serialize};
use simworld_core::seam::SpaceValue;

use super::Describe;

/// A picture: rows from the top, pixels from the left, three bytes each (red, green, blue; sRGB).
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Frame {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// `3 * width * height` bytes.
    pub rgb: Vec<u8>,
}

impl Frame {
    /// A black picture.
    pub fn black(width: u32, height: u32) -> Self {
        Self { width, height, rgb: vec![0; width as usize * height as usize * 3] }
    }

    /// Whether the bytes are as many as its size says, and some.
    pub fn is_sound(&self) -> bool {
        let bytes = u64::from(self.width) * u64::from(self.height) * 3;
        bytes > 0 && self.rgb.len() as u64 == bytes
    }

    /// The picture as a PNG file.
    ///
    /// # Errors
    /// It has no pixels, or not as many bytes as its size says.
    #[cfg(feature = "thought")]
    pub fn to_png(&self) -> Result<Vec<u8>, png::EncodingError> {
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, self.width, self.height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&self.rgb)?;
        writer.finish()?;
        Ok(file)
    }
}

impl Describe for Frame {
    fn describe(&self, _: usize) -> String {
        String::new()
    }

    /// Bytes as numbers from 0 to 255, row by row.
    fn value(&self) -> Option<SpaceValue> {
        Some(SpaceValue::Box(self.rgb.iter().map(|byte| f64::from(*byte)).collect()))
    }
}

#[cfg(all(test, feature = "thought"))]
mod tests {
    use super::*;

    #[test]
    fn a_picture_survives_its_file() {
        let mut frame = Frame::black(5, 3);
        frame.rgb[7] = 200;
        let file = frame.to_png().unwrap();
        let mut reader = png::Decoder::new(std::io::Cursor::new(file)).read_info().unwrap();
        let mut rgb = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut rgb).unwrap();
        assert_eq!((info.width, info.height, rgb), (5, 3, frame.rgb.clone()));
        frame.rgb.pop();
        assert!(!frame.is_sound() && frame.to_png().is_err());
        assert!(!Frame::default().is_sound() && Frame::default().to_png().is_err());
    }
}
