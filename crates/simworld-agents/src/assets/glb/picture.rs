//! Pictures in a file: PNG and JPEG, decoded within a budget of pixels, and looked up by texture coordinates.

use std::io::Cursor;

use png::Transformations;
use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

use super::document::Sampler;

/// A decoded picture, sRGB, rows from its top.
pub(super) struct Picture {
    width: usize,
    height: usize,
    pixels: Vec<[u8; 3]>,
}

/// Why a picture is none.
pub(super) enum Undecoded {
    /// What the decoder says.
    Broken(String),
    /// More pixels than are left.
    Large(u64),
}

impl Picture {
    /// Decodes what begins like a PNG or a JPEG, if it has at most that many pixels.
    pub(super) fn decode(bytes: &[u8], most: u64) -> Result<Self, Undecoded> {
        let picture = if bytes.starts_with(b"\x89PNG") {
            png(bytes, most)
        } else if bytes.starts_with(&[0xFF, 0xD8, 0xFF]) {
            jpeg(bytes, most)
        } else {
            Err(broken("it is neither PNG nor JPEG: export the textures as one of both"))
        }?;
        if picture.pixels.is_empty() || picture.pixels.len() != picture.width * picture.height {
            return Err(broken("it has another number of pixels than it says"));
        }
        Ok(picture)
    }

    /// The number of pixels.
    pub(super) fn len(&self) -> u64 {
        self.pixels.len() as u64
    }

    /// The pixel at texture coordinates, of which (0, 0) is the top left corner.
    pub(super) fn at(&self, [u, v]: [f64; 2], sampler: Sampler) -> [u8; 3] {
        let column = wrapped(u, self.width, sampler.wrap_s);
        let row = wrapped(v, self.height, sampler.wrap_t);
        self.pixels[row * self.width + column]
    }
}

/// The pixel of a coordinate, by the number that glTF has for the way to wrap it.
fn wrapped(coordinate: f64, size: usize, wrap: u32) -> usize {
    const CLAMPED: u32 = 33_071;
    const MIRRORED: u32 = 33_648;
    let within = match wrap {
        CLAMPED => coordinate,
        MIRRORED => {
            let turn = coordinate.rem_euclid(2.0);
            if turn > 1.0 { 2.0 - turn } else { turn }
        }
        _ => coordinate.rem_euclid(1.0),
    };
    ((within * size as f64).max(0.0) as usize).min(size - 1)
}

fn png(bytes: &[u8], most: u64) -> Result<Picture, Undecoded> {
    let limit = usize::try_from(most.saturating_mul(8)).unwrap_or(usize::MAX);
    let mut decoder = png::Decoder::new_with_limits(Cursor::new(bytes), png::Limits { bytes: limit });
    decoder.set_transformations(Transformations::EXPAND | Transformations::STRIP_16);
    let mut reader = decoder.read_info().map_err(|error| broken(&error.to_string()))?;
    let (width, height) = (reader.info().width, reader.info().height);
    affordable(width.into(), height.into(), most)?;
    let size = reader.output_buffer_size().ok_or_else(|| broken("it is too large"))?;
    let mut samples = vec![0; size];
    let frame = reader.next_frame(&mut samples).map_err(|error| broken(&error.to_string()))?;
    let samples = &samples[..frame.buffer_size()];
    let pixels = match frame.color_type {
        png::ColorType::Rgb => samples.as_chunks::<3>().0.to_vec(),
        png::ColorType::Rgba => samples.as_chunks::<4>().0.iter().map(|[r, g, b, _]| [*r, *g, *b]).collect(),
        png::ColorType::Grayscale => samples.iter().map(|grey| [*grey; 3]).collect(),
        png::ColorType::GrayscaleAlpha => {
            samples.as_chunks::<2>().0.iter().map(|[grey, _]| [*grey; 3]).collect()
        }
        png::ColorType::Indexed => return Err(broken("its palette was not expanded")),
    };
    Ok(Picture { width: width as usize, height: height as usize, pixels })
}

fn jpeg(bytes: &[u8], most: u64) -> Result<Picture, Undecoded> {
    const LONGEST_SIDE: usize = 1 << 14;
    let options = DecoderOptions::default()
        .set_max_width(LONGEST_SIDE)
        .set_max_height(LONGEST_SIDE)
        .jpeg_set_out_colorspace(ColorSpace::RGB);
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    decoder.decode_headers().map_err(|error| broken(&error.to_string()))?;
    let (width, height) = decoder.dimensions().ok_or_else(|| broken("it says no size"))?;
    affordable(width as u64, height as u64, most)?;
    let samples = decoder.decode().map_err(|error| broken(&error.to_string()))?;
    Ok(Picture { width, height, pixels: samples.as_chunks::<3>().0.to_vec() })
}

fn affordable(width: u64, height: u64, most: u64) -> Result<(), Undecoded> {
    let pixels = width.saturating_mul(height);
    if pixels > most { Err(Undecoded::Large(pixels)) } else { Ok(()) }
}

fn broken(reason: &str) -> Undecoded {
    Undecoded::Broken(reason.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn png_of(width: u32, height: u32, pixels: &[u8]) -> Vec<u8> {
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, width, height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.write_header().unwrap().write_image_data(pixels).unwrap();
        file
    }

    #[test]
    fn coordinates_wrap_as_the_sampler_says() {
        let file = png_of(2, 1, &[255, 0, 0, 0, 0, 255]);
        let picture = Picture::decode(&file, 10).unwrap_or_else(|_| unreachable!("it is a PNG"));
        let (red, blue) = ([255, 0, 0], [0, 0, 255]);
        let with = |wrap| Sampler { wrap_s: wrap, wrap_t: wrap };
        for (u, repeated, clamped, mirrored) in
            [(0.2, red, red, red), (0.8, blue, blue, blue), (1.2, red, blue, blue), (-0.2, blue, red, red)]
        {
            assert_eq!(picture.at([u, 0.5], with(10_497)), repeated, "{u} repeated");
            assert_eq!(picture.at([u, 0.5], with(33_071)), clamped, "{u} clamped");
            assert_eq!(picture.at([u, 0.5], with(33_648)), mirrored, "{u} mirrored");
        }
        assert_eq!(picture.at([f64::MAX, -f64::MAX], with(33_071)), blue);
    }

    #[test]
    fn pictures_beyond_the_budget_are_not_decoded() {
        let file = png_of(2, 2, &[0; 12]);
        assert!(matches!(Picture::decode(&file, 3), Err(Undecoded::Large(4))));
        assert!(matches!(Picture::decode(b"GIF89a", 3), Err(Undecoded::Broken(_))));
        assert!(matches!(Picture::decode(&file[..40], 4), Err(Undecoded::Broken(_))));
    }
}
