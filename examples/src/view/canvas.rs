//! A picture in memory that one draws on: 8-bit sRGB, row by row from the top left, with letters of 8 x 8 pixels.

use font8x8::legacy::BASIC_LEGACY;

/// A colour, sRGB.
pub(super) type Ink = [u8; 3];

/// Side of a letter, pixels.
pub(super) const LETTER: usize = 8;

/// A picture.
#[derive(Clone, Debug, Default)]
pub struct Canvas {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// Three bytes a pixel.
    pub rgb: Vec<u8>,
}

impl Canvas {
    /// Takes over the pixels of a picture.
    pub fn load(&mut self, width: usize, height: usize, rgb: &[u8]) {
        (self.width, self.height) = (width, height);
        self.rgb.clear();
        self.rgb.extend_from_slice(rgb);
        self.rgb.resize(width * height * 3, 0);
    }

    /// Paints one pixel; beside the picture nothing happens. A share of 0 leaves it, 1 covers it.
    pub fn dot(&mut self, x: i64, y: i64, ink: Ink, share: f32) {
        if x < 0 || y < 0 || x >= self.width as i64 || y >= self.height as i64 {
            return;
        }
        let at = 3 * (y as usize * self.width + x as usize);
        for (old, new) in self.rgb[at..at + 3].iter_mut().zip(ink) {
            *old = (f32::from(*old) + (f32::from(new) - f32::from(*old)) * share).round() as u8;
        }
    }

    /// Darkens a rectangle, so that letters on it can be read.
    pub fn shade(&mut self, [left, top]: [i64; 2], width: usize, height: usize) {
        for y in top..top + height as i64 {
            for x in left..left + width as i64 {
                self.dot(x, y, [12, 14, 18], 0.62);
            }
        }
    }

    /// Writes a line of text whose first letter has its top left corner there, on a dark ground; what is not ASCII is written
    /// as a question mark. Letters are `size` times as large as 8 pixels.
    pub fn text(&mut self, [left, top]: [i64; 2], text: &str, ink: Ink, size: usize) {
        let cell = LETTER * size;
        self.shade([left - 2, top - 2], text.chars().count() * cell + 4, cell + 3);
        for (index, letter) in text.chars().enumerate() {
            let glyph = BASIC_LEGACY[if letter.is_ascii() { letter as usize } else { usize::from(b'?') }];
            let first = left + (index * cell) as i64;
            for (pixel_y, pixel_x) in (0..cell).flat_map(|y| (0..cell).map(move |x| (y, x))) {
                if glyph[pixel_y / size] >> (pixel_x / size) & 1 == 1 {
                    self.dot(first + pixel_x as i64, top + pixel_y as i64, ink, 1.0);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_are_written_where_they_belong_and_nothing_beside_the_picture() {
        let mut canvas = Canvas::default();
        canvas.load(24, 12, &[]);
        canvas.text([2, 2], "L\u{e9}", [255, 0, 0], 1);
        canvas.text([-40, -40], "far away", [255; 3], 2);
        // The stem of the L fills the left of its cell, the upper right stays free.
        let red = |x: usize, y: usize| canvas.rgb[3 * (y * 24 + x)] == 255;
        assert!(red(3, 4) && red(4, 4) && !red(8, 3));
        assert!((10..18).any(|x| (2..10).any(|y| red(x, y))), "a question mark stands for what is not ASCII");
    }
}
