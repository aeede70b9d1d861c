//! Arrays as NPY files (format 1.0, `NumPy` Enhancement Proposal 1), which `NumPy` and every tool beside it reads.

use bytemuck::Pod;

use crate::{Frame, RenderError};

/// Numbers that have a name in NPY.
pub(crate) trait Number: Pod {
    /// The type as `NumPy` writes it, little-endian.
    const DESCR: &'static str;
}

macro_rules! numbers {
    ($($number:ty = $descr:literal),+) => {
        $(impl Number for $number {
            const DESCR: &'static str = $descr;
        })+
    };
}
numbers!(u8 = "'|u1'", u16 = "'<u2'", u32 = "'<u4'", f32 = "'<f4'");

/// An array in C order.
pub(crate) fn npy<T: Number>(shape: &[usize], values: &[T]) -> Vec<u8> {
    let mut file = header(T::DESCR, shape);
    for value in values {
        let bytes = bytemuck::bytes_of(value);
        if cfg!(target_endian = "big") { file.extend(bytes.iter().rev()) } else { file.extend(bytes) }
    }
    file
}

/// The lead of a file for entries of that type; what follows are the entries, little-endian.
pub(crate) fn header(descr: &str, shape: &[usize]) -> Vec<u8> {
    let lengths: Vec<String> = shape.iter().map(ToString::to_string).collect();
    let lengths = lengths.join(",");
    let mut text = format!("{{'descr': {descr}, 'fortran_order': False, 'shape': ({lengths},), }}");
    // Magic, version and length take 10 bytes; the data begins at a multiple of 64.
    let padded = (10 + text.len() + 1).next_multiple_of(64) - 11;
    text.push_str(&" ".repeat(padded - text.len()));
    text.push('\n');
    let mut file = b"\x93NUMPY\x01\x00".to_vec();
    file.extend((text.len() as u16).to_le_bytes());
    file.extend(text.as_bytes());
    file
}

impl Frame {
    fn array<T: Number>(
        &self,
        name: &'static str,
        values: &[T],
        channels: usize,
    ) -> Result<Vec<u8>, RenderError> {
        self.check(name, values.len(), channels)?;
        let (height, width) = (self.height as usize, self.width as usize);
        Ok(if channels == 1 {
            npy(&[height, width], values)
        } else {
            npy(&[height, width, channels], values)
        })
    }

    /// Colour as NPY: height x width x 3, `u1`, sRGB.
    ///
    /// # Errors
    /// The channel was not drawn, or its buffer was resized by hand.
    pub fn rgb_npy(&self) -> Result<Vec<u8>, RenderError> {
        self.array("rgb", &self.rgb, 3)
    }

    /// Planar depth as NPY: height x width, `f4`, m; infinite for the sky.
    ///
    /// # Errors
    /// As [`rgb_npy`](Self::rgb_npy).
    pub fn depth_npy(&self) -> Result<Vec<u8>, RenderError> {
        self.array("depth", &self.depth, 1)
    }

    /// Instances as NPY: height x width, `u4`, [`EntityId::index`](simworld_core::id::EntityId::index) plus one, 0 for the sky.
    ///
    /// # Errors
    /// As [`rgb_npy`](Self::rgb_npy).
    pub fn ids_npy(&self) -> Result<Vec<u8>, RenderError> {
        self.array("ids", &self.ids, 1)
    }

    /// Classes as NPY: height x width, `u1`.
    ///
    /// # Errors
    /// As [`rgb_npy`](Self::rgb_npy).
    pub fn classes_npy(&self) -> Result<Vec<u8>, RenderError> {
        self.array("classes", &self.classes, 1)
    }

    /// Optical flow as NPY: height x width x 2, `f4`, pixels to the right and down, see [`OpticalFlow`](crate::OpticalFlow).
    ///
    /// # Errors
    /// As [`rgb_npy`](Self::rgb_npy).
    pub fn flow_npy(&self) -> Result<Vec<u8>, RenderError> {
        self.array("flow", self.flow.as_flattened(), 2)
    }

    /// Normals as NPY: height x width x 3, `f4`, world frame.
    ///
    /// # Errors
    /// As [`rgb_npy`](Self::rgb_npy).
    pub fn normals_npy(&self) -> Result<Vec<u8>, RenderError> {
        self.array("normals", self.normals.as_flattened(), 3)
    }

    /// [`labels`](Self::labels) as NPY: height x width, `u4`.
    ///
    /// # Errors
    /// As [`labels`](Self::labels).
    pub fn labels_npy(&self) -> Result<Vec<u8>, RenderError> {
        self.array("labels", &self.labels()?, 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_header_is_as_the_format_says() {
        let file = npy(&[2, 3], &[1.0_f32, 2.0, 3.0, 4.0, 5.0, 6.5]);
        assert_eq!(&file[..8], b"\x93NUMPY\x01\x00");
        let length = usize::from(u16::from_le_bytes([file[8], file[9]]));
        assert_eq!((10 + length) % 64, 0);
        let text = std::str::from_utf8(&file[10..10 + length]).unwrap();
        assert!(text.ends_with('\n') && text.contains("'shape': (2,3,), "), "{text:?}");
        assert!(text.starts_with("{'descr': '<f4', 'fortran_order': False"), "{text:?}");
        assert_eq!(file.len(), 10 + length + 24);
        assert_eq!(&file[file.len() - 4..], &6.5_f32.to_le_bytes());
    }
}
