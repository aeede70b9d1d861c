//! Pictures in the forms that clients of `UnrealCV` decode: PNG and BMP with four channels, arrays of numpy.

use png::{BitDepth, ColorType, Compression, Encoder};

use super::convert::centimetres;
use crate::remote::Picture;

/// The greatest depth, cm, and that of the sky: the greatest number of Unreal's half-precision buffers.
pub(super) const FARTHEST: f32 = 65_504.0;

/// Red, green, blue and an opaque alpha for every pixel of a colour picture.
pub(super) fn rgba_of_color(picture: &Picture) -> Vec<u8> {
    picture.bytes.chunks_exact(3).flat_map(|rgb| [rgb[0], rgb[1], rgb[2], u8::MAX]).collect()
}

/// The same for a picture of instances, each in its colour; black where there is nothing.
pub(super) fn rgba_of_instances(picture: &Picture, color_of: &dyn Fn(u32) -> [u8; 3]) -> Vec<u8> {
    // Neighbours mostly show the same thing.
    let (mut last, mut color) = (0, [0; 3]);
    let paint = |instance: u32| {
        if instance != last {
            last = instance;
            color = instance.checked_sub(1).map_or([0; 3], color_of);
        }
        [color[0], color[1], color[2], u8::MAX]
    };
    picture.words().flat_map(paint).collect()
}

/// A PNG of four channels, packed quickly.
pub(super) fn png(width: u32, height: u32, rgba: &[u8]) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::with_capacity(rgba.len() / 2);
    let mut encoder = Encoder::new(&mut bytes, width, height);
    encoder.set_color(ColorType::Rgba);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::Fastest);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(rgba)?;
    writer.finish()?;
    Ok(bytes)
}

/// An uncompressed BMP of 32 bits a pixel, rows from the bottom as usual.
pub(super) fn bmp(width: u32, height: u32, rgba: &[u8]) -> Vec<u8> {
    const HEADERS: u32 = 14 + 40;
    let size = rgba.len() as u32;
    let mut bytes = Vec::with_capacity(HEADERS as usize + rgba.len());
    bytes.extend(b"BM");
    for word in [HEADERS + size, 0, HEADERS, 40, width, height] {
        bytes.extend(word.to_le_bytes());
    }
    bytes.extend([1, 0, 32, 0]);
    for word in [0, size, 2835, 2835, 0, 0] {
        bytes.extend(u32::to_le_bytes(word));
    }
    for row in rgba.chunks_exact(width as usize * 4).rev() {
        bytes.extend(row.chunks_exact(4).flat_map(|pixel| [pixel[2], pixel[1], pixel[0], pixel[3]]));
    }
    bytes
}

/// Depth as numpy saves an array of `float32` with a row for each row of pixels, cm; format 1.0.
pub(super) fn depth_npy(picture: &Picture) -> Vec<u8> {
    let (width, height) = (picture.width, picture.height);
    let mut header = format!("{{'descr': '<f4', 'fortran_order': False, 'shape': ({height}, {width}), }}");
    // Magic, version and length take ten bytes; all of it ends in a line feed at a multiple of 64.
    let padded = (10 + header.len() + 1).next_multiple_of(64);
    header.extend(std::iter::repeat_n(' ', padded - 11 - header.len()));
    header.push('\n');
    let mut bytes = Vec::with_capacity(padded + picture.bytes.len());
    bytes.extend(b"\x93NUMPY\x01\x00");
    bytes.extend((header.len() as u16).to_le_bytes());
    bytes.extend(header.as_bytes());
    for depth in picture.depths() {
        let depth = (centimetres(f64::from(depth)) as f32).min(FARTHEST);
        bytes.extend(depth.to_le_bytes());
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::remote::PictureKind;

    #[test]
    fn a_png_reads_back() {
        let rgba: Vec<u8> = (0..5 * 3 * 4).map(|byte| byte as u8).collect();
        let bytes = png(5, 3, &rgba).unwrap();
        let mut reader = ::png::Decoder::new(std::io::Cursor::new(&bytes)).read_info().unwrap();
        let mut back = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut back).unwrap();
        assert_eq!((info.width, info.height, info.color_type), (5, 3, ColorType::Rgba));
        assert_eq!(back, rgba);
    }

    #[test]
    fn a_bmp_has_its_last_row_first_and_blue_before_red() {
        let rgba = [1, 2, 3, 255, 4, 5, 6, 255];
        let bytes = bmp(1, 2, &rgba);
        assert_eq!((&bytes[..2], bytes.len()), (&b"BM"[..], 54 + 8));
        assert_eq!(bytes[54..], [6, 5, 4, 255, 3, 2, 1, 255]);
        assert_eq!(u32::from_le_bytes(bytes[10..14].try_into().unwrap()), 54);
    }

    #[test]
    fn an_array_of_depths_is_as_numpy_saves_it() {
        let bytes: Vec<u8> = [1.5_f32, f32::INFINITY].iter().flat_map(|depth| depth.to_le_bytes()).collect();
        let npy = depth_npy(&Picture { kind: PictureKind::Depth, width: 2, height: 1, bytes });
        assert!(npy.starts_with(
            b"\x93NUMPY\x01\x00\x76\x00{'descr': '<f4', 'fortran_order': False, 'shape': (1, 2), }"
        ));
        assert_eq!((npy.len(), npy[127]), (128 + 8, b'\n'));
        assert_eq!(npy[128..132], 150.0_f32.to_le_bytes());
        assert_eq!(npy[132..], FARTHEST.to_le_bytes());
    }

    #[test]
    fn instances_are_painted_and_nothing_is_black() {
        let bytes: Vec<u8> = [0_u32, 1, 1, 3].iter().flat_map(|word| word.to_le_bytes()).collect();
        let picture = Picture { kind: PictureKind::Instances, width: 4, height: 1, bytes };
        let rgba = rgba_of_instances(&picture, &|slot| [slot as u8 + 10, 0, 0]);
        assert_eq!(rgba, [0, 0, 0, 255, 10, 0, 0, 255, 10, 0, 0, 255, 12, 0, 0, 255]);
    }
}
