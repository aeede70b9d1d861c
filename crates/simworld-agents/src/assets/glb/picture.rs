//! Pictures in a file: PNG and JPEG, decoded within a budget of pixels, and looked up by texture coordinates.

use std::io::Cursor;

use png::Transformations;
use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

use simworld_core::asset::{Content, LONGEST_IMAGE, ModelImage, Wrap};

/// Why a picture is none.
pub(super) enum Undecoded {
    /// What the decoder says.
    Broken(String),
    /// More pixels than are left.
    Large(u64),
}

/// Decodes what begins like a PNG or a JPEG, if it has at most that many pixels and no side is longer than pictures of models may be.
pub(super) fn decode(bytes: &[u8], most: u64) -> Result<ModelImage, Undecoded> {
    let image = if bytes.starts_with(b"\x89PNG") {
        png(bytes, most)
    } else if bytes.starts_with(&[0xFF, 0xD8, 0xFF]) {
        jpeg(bytes, most)
    } else {
        Err(broken("it is neither PNG nor JPEG: export the textures as one of both"))
    }?;
    if image.is_whole() { Ok(image) } else { Err(broken("it has another number of pixels than it says")) }
}

/// The way to wrap that glTF has under a number; it repeats under any other.
pub(super) const fn wrap_of(number: u32) -> Wrap {
    match number {
        33_071 => Wrap::Clamp,
        33_648 => Wrap::Mirror,
        _ => Wrap::Repeat,
    }
}

fn png(bytes: &[u8], most: u64) -> Result<ModelImage, Undecoded> {
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
    let mut alpha: Vec<u8> = match frame.color_type {
        png::ColorType::Rgba => samples.as_chunks::<4>().0.iter().map(|[.., alpha]| *alpha).collect(),
        png::ColorType::GrayscaleAlpha => {
            samples.as_chunks::<2>().0.iter().map(|[_, alpha]| *alpha).collect()
        }
        _ => Vec::new(),
    };
    if alpha.iter().all(|alpha| *alpha == u8::MAX) {
        alpha.clear();
    }
    let pixels = match frame.color_type {
        png::ColorType::Rgb => samples.to_vec(),
        png::ColorType::Rgba => {
            samples.as_chunks::<4>().0.iter().flat_map(|[r, g, b, _]| [*r, *g, *b]).collect()
        }
        png::ColorType::Grayscale => samples.iter().flat_map(|grey| [*grey; 3]).collect(),
        png::ColorType::GrayscaleAlpha => {
            samples.as_chunks::<2>().0.iter().flat_map(|[grey, _]| [*grey; 3]).collect()
        }
        png::ColorType::Indexed => return Err(broken("its palette was not expanded")),
    };
    Ok(ModelImage { width, height, pixels, alpha, content: Content::Color })
}

fn jpeg(bytes: &[u8], most: u64) -> Result<ModelImage, Undecoded> {
    // A little beyond what is afforded, so that the answer is the same as for a PNG.
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
    Ok(ModelImage { width: width as u32, height: height as u32, pixels: samples, ..ModelImage::default() })
}

fn affordable(width: u64, height: u64, most: u64) -> Result<(), Undecoded> {
    let pixels = width.saturating_mul(height);
    if pixels > most {
        return Err(Undecoded::Large(pixels));
    }
    let longest = u64::from(LONGEST_IMAGE);
    if width.max(height) > longest {
        return Err(Undecoded::Broken(format!(
            "it is {width} x {height} pixels, and {longest} each way are the most: shrink it"
        )));
    }
    Ok(())
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
    fn what_is_decoded_is_what_was_encoded() {
        let file = png_of(2, 1, &[255, 0, 0, 0, 0, 255]);
        let picture = decode(&file, 10).unwrap_or_else(|_| unreachable!("it is a PNG"));
        let pixels = vec![255, 0, 0, 0, 0, 255];
        assert_eq!(picture, ModelImage { width: 2, height: 1, pixels, ..ModelImage::default() });
        assert_eq!(
            [10_497, 33_071, 33_648, 7].map(wrap_of),
            [Wrap::Repeat, Wrap::Clamp, Wrap::Mirror, Wrap::Repeat]
        );
    }

    #[test]
    fn pictures_beyond_the_budget_are_not_decoded() {
        let file = png_of(2, 2, &[0; 12]);
        assert!(matches!(decode(&file, 3), Err(Undecoded::Large(4))));
        assert!(matches!(decode(b"GIF89a", 3), Err(Undecoded::Broken(_))));
        assert!(matches!(decode(&file[..40], 4), Err(Undecoded::Broken(_))));
        let long = png_of(LONGEST_IMAGE + 1, 1, &vec![0; 3 * (LONGEST_IMAGE as usize + 1)]);
        assert!(matches!(decode(&long, 1 << 20), Err(Undecoded::Broken(_))));
    }
}
