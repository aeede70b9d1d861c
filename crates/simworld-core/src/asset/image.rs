//! Pictures on models: pixels, and the same in half the size.

use std::sync::LazyLock;

use serde::{Deserialize, Serialize};

use super::Wrap;
use crate::ops;

/// The longest side of a picture on a model, pixels.
pub const LONGEST_IMAGE: u32 = 4096;

/// The most pixels that the pictures of one model may have together.
pub const MOST_PIXELS: u64 = 4096 * 4096;

/// A picture: three bytes a pixel, row by row from the upper left corner, and how much is there of each.
///
/// ```
/// use simworld_core::asset::ModelImage;
/// let pixels = vec![255, 255, 255, 0, 0, 0];
/// let image = ModelImage { width: 2, height: 1, pixels, ..ModelImage::default() };
/// // Half of the light, which is more than half of the number.
/// assert_eq!(image.halved(), ModelImage { width: 1, height: 1, pixels: vec![188; 3], ..image });
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ModelImage {
    /// Pixels in a row, 1 to [`LONGEST_IMAGE`].
    pub width: u32,
    /// Rows, 1 to [`LONGEST_IMAGE`].
    pub height: u32,
    /// Red, green and blue of each.
    pub pixels: Vec<u8>,
    /// How much is there of each, 255 for all of it; empty where that is so everywhere.
    #[serde(default)]
    pub alpha: Vec<u8>,
    /// What its bytes stand for.
    #[serde(default)]
    pub content: Content,
}

/// What the bytes of a picture stand for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Content {
    /// Colours, as sRGB has them.
    #[default]
    Color,
    /// Numbers, of which 255 is 1.
    Numbers,
}

/// Light of each sRGB value, and of the values between them at which rounding goes to the next.
static LIGHT: LazyLock<([f32; 256], [f32; 255])> = LazyLock::new(|| {
    let light = |value: f64| linear_light(value / 255.0) as f32;
    (std::array::from_fn(|value| light(value as f64)), std::array::from_fn(|value| light(value as f64 + 0.5)))
});

impl ModelImage {
    /// Whether it has a size in range, and a pixel for each place.
    pub fn is_whole(&self) -> bool {
        let sides = 1..=LONGEST_IMAGE;
        let has_size = sides.contains(&self.width) && sides.contains(&self.height);
        let count = u64::from(self.width) * u64::from(self.height);
        let has_alpha = self.alpha.is_empty() || self.alpha.len() as u64 == count;
        has_size && self.pixels.len() as u64 == count * 3 && has_alpha
    }

    /// How much is there of a pixel, 0 to 1.
    pub fn alpha_at(&self, column: u32, row: u32) -> f32 {
        let at = row as usize * self.width as usize + column as usize;
        self.alpha.get(at).map_or(1.0, |alpha| f32::from(*alpha) / 255.0)
    }

    /// A pixel in linear light, or its numbers; black where there is none.
    pub fn light_at(&self, column: u32, row: u32) -> [f32; 3] {
        let first = (row as usize * self.width as usize + column as usize) * 3;
        let pixel = self.pixels.get(first..first + 3).filter(|_| column < self.width);
        let of = |value: u8| match self.content {
            Content::Color => light_of(value),
            Content::Numbers => f32::from(value) / 255.0,
        };
        pixel.map_or([0.0; 3], |pixel| std::array::from_fn(|channel| of(pixel[channel])))
    }

    /// The pixel at a place in shares of its sides, from the upper left corner; black in a picture that is not whole.
    pub fn pixel_at(&self, [right, down]: [f64; 2], wrap: [Wrap; 2]) -> [u8; 3] {
        let column = wrap[0].pixel(right, self.width);
        let row = wrap[1].pixel(down, self.height);
        let first = (row as usize * self.width as usize + column as usize) * 3;
        self.pixels
            .get(first..first + 3)
            .map_or([0; 3], |pixel| std::array::from_fn(|channel| pixel[channel]))
    }

    /// The picture in half its size, rounded down but not below one pixel: each pixel has the mean light, or the mean of the numbers, of what
    /// it covers, by how much is there of that.
    #[must_use]
    pub fn halved(&self) -> Self {
        let [width, height] = [self.width, self.height].map(|side| (side / 2).max(1));
        let columns = covered(self.width, width);
        let mut half = Self { width, height, content: self.content, ..Self::default() };
        half.pixels.reserve(width as usize * height as usize * 3);
        for rows in &covered(self.height, height) {
            for across in &columns {
                self.add_mean(&mut half, rows, across);
            }
        }
        half
    }

    /// Adds the mean of what a pixel of a smaller picture covers to that.
    fn add_mean(&self, half: &mut Self, rows: &[(u32, f32); 3], across: &[(u32, f32); 3]) {
        let (mut plain, mut weighed, mut there) = ([0.0_f32; 3], [0.0_f32; 3], 0.0_f32);
        for (row, share) in rows.iter().filter(|(_, share)| *share > 0.0) {
            for (column, part) in across.iter().filter(|(_, part)| *part > 0.0) {
                let (light, share) = (self.light_at(*column, *row), share * part);
                plain = std::array::from_fn(|channel| plain[channel] + light[channel] * share);
                if !self.alpha.is_empty() {
                    let alpha = self.alpha_at(*column, *row) * share;
                    weighed = std::array::from_fn(|channel| weighed[channel] + light[channel] * alpha);
                    there += alpha;
                }
            }
        }
        // What is not there has no say in the colour, unless nothing is.
        let light = if there > 0.0 { weighed.map(|channel| channel / there) } else { plain };
        half.pixels.extend(light.map(|channel| match self.content {
            Content::Color => value_of(channel),
            Content::Numbers => (channel * 255.0).round() as u8,
        }));
        if !self.alpha.is_empty() {
            half.alpha.push((there * 255.0).round() as u8);
        }
    }
}

impl Wrap {
    /// The pixel of a side that has so many, at a share of that side.
    fn pixel(self, place: f64, count: u32) -> u32 {
        let within = match self {
            Self::Clamp => place,
            Self::Mirror => {
                let turn = place.rem_euclid(2.0);
                if turn > 1.0 { 2.0 - turn } else { turn }
            }
            Self::Repeat => place.rem_euclid(1.0),
        };
        // Rounding may end at the far edge, and what is no number at the near one.
        ((within * f64::from(count)).max(0.0) as u32).min(count.saturating_sub(1))
    }
}

/// Which pixels of a long row each pixel of a shorter one covers, at least a third as long, and which share of it each of them is.
fn covered(long: u32, short: u32) -> Vec<[(u32, f32); 3]> {
    let step = f64::from(long) / f64::from(short);
    let one = |at: u32| {
        let (from, to) = (f64::from(at) * step, f64::from(at + 1) * step);
        let first = from as u32;
        [0, 1, 2].map(|which| {
            let pixel = first + which;
            let overlap = to.min(f64::from(pixel + 1)) - from.max(f64::from(pixel));
            (pixel, (overlap / step).max(0.0) as f32)
        })
    };
    (0..short).map(one).collect()
}

/// Linear light of an sRGB value.
pub fn light_of(value: u8) -> f32 {
    LIGHT.0[usize::from(value)]
}

/// The sRGB value of linear light.
fn value_of(light: f32) -> u8 {
    LIGHT.1.partition_point(|threshold| *threshold <= light) as u8
}

/// Light of an sRGB value (IEC 61966-2-1), both in [0, 1].
fn linear_light(value: f64) -> f64 {
    if value <= 0.040_45 { value / 12.92 } else { ops::pow((value + 0.055) / 1.055, 2.4) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_and_values_are_each_others_inverse() {
        assert!((0..=255).all(|value| value_of(light_of(value)) == value));
        assert_eq!((light_of(0), light_of(255)), (0.0, 1.0));
    }

    #[test]
    fn places_beyond_the_edges_are_those_that_the_wrap_says() {
        let (red, blue) = ([255, 0, 0], [0, 0, 255]);
        let pixels = [red, blue].concat();
        let image = ModelImage { width: 2, height: 1, pixels, ..ModelImage::default() };
        let at = |right, wrap| image.pixel_at([right, 0.5], [wrap, Wrap::Repeat]);
        for (right, repeated, clamped, mirrored) in
            [(0.2, red, red, red), (0.8, blue, blue, blue), (1.2, red, blue, blue), (-0.2, blue, red, red)]
        {
            assert_eq!(at(right, Wrap::Repeat), repeated, "{right} repeated");
            assert_eq!(at(right, Wrap::Clamp), clamped, "{right} clamped");
            assert_eq!(at(right, Wrap::Mirror), mirrored, "{right} mirrored");
        }
        assert_eq!(image.pixel_at([f64::MAX, -f64::MAX], [Wrap::Clamp; 2]), blue);
        assert_eq!(image.pixel_at([f64::NAN; 2], [Wrap::Mirror; 2]), red);
        assert_eq!(ModelImage::default().pixel_at([0.5; 2], [Wrap::Repeat; 2]), [0; 3]);
    }

    /// No light is lost or made, whatever the sides.
    #[test]
    fn half_the_size_has_the_same_light() {
        for (width, height) in [(4, 4), (5, 3), (7, 1), (1, 9), (6, 5)] {
            let count = width * height;
            let pixels = (0..count * 3).map(|k| if k * 7 % 5 < 2 { 220 } else { 40 }).collect();
            let image = ModelImage { width, height, pixels, ..ModelImage::default() };
            let mean = |image: &ModelImage| {
                let sum: f32 = image.pixels.iter().map(|value| light_of(*value)).sum();
                sum / image.pixels.len() as f32
            };
            let half = image.halved();
            assert_eq!((half.width, half.height), ((width / 2).max(1), (height / 2).max(1)));
            assert!(half.is_whole() && (mean(&half) - mean(&image)).abs() < 4e-3, "{width} {height}");
        }
    }

    #[test]
    fn what_is_not_there_has_no_say_in_the_colour() {
        let pixels = [[200, 0, 0], [0, 0, 200]].concat();
        let image = ModelImage { width: 2, height: 1, pixels, alpha: vec![255, 0], ..ModelImage::default() };
        let half = image.halved();
        assert_eq!((half.pixels, half.alpha), (vec![200, 0, 0], vec![128]));
        let gone = ModelImage { alpha: vec![0, 0], ..image.clone() };
        assert_eq!((gone.halved().pixels, gone.halved().alpha), (vec![146, 0, 146], vec![0]));
        assert!(image.is_whole() && !ModelImage { alpha: vec![255], ..image }.is_whole());
    }

    #[test]
    fn numbers_have_the_mean_of_numbers() {
        let pixels = vec![255, 10, 0, 0, 20, 0];
        let image =
            ModelImage { width: 2, height: 1, pixels, content: Content::Numbers, ..ModelImage::default() };
        assert_eq!(image.halved().pixels, [128, 15, 0]);
        assert_eq!(image.halved().content, Content::Numbers);
    }
}
