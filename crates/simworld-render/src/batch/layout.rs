//! Where the pixels of each view lie.

use std::ops::Range;

use simworld_core::camera::Intrinsics;

/// Rows on the device are padded to this many pixels, which is what copies of textures want.
const PITCH: u32 = 64;

/// Where one view lies on the device: in every channel, pixel (x, y) is number `first + y * pitch + x`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Span {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Pixels from row to row.
    pub pitch: u32,
    /// The number of the first pixel.
    pub first: usize,
}

/// The views of a batch, one behind the other.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Layout {
    pub spans: Vec<Span>,
    /// Pixels in all, padding and all; a multiple of [`PITCH`].
    pub pixels: usize,
    /// The largest width and height.
    pub largest: [u32; 2],
}

impl Layout {
    pub(crate) fn of<'a>(sizes: impl IntoIterator<Item = &'a Intrinsics>) -> Self {
        let mut layout = Self::default();
        for Intrinsics { width, height, .. } in sizes {
            let pitch = width.next_multiple_of(PITCH);
            layout.spans.push(Span { width: *width, height: *height, pitch, first: layout.pixels });
            layout.pixels += pitch as usize * *height as usize;
            layout.largest = [layout.largest[0].max(*width), layout.largest[1].max(*height)];
        }
        layout
    }

    /// Whether no row is padded, so that everything may be copied at once.
    pub(crate) fn is_tight(&self) -> bool {
        self.spans.iter().all(|span| span.width == span.pitch)
    }

    /// The rows of all views as ranges of padded pixels.
    pub(crate) fn rows(&self) -> impl Iterator<Item = Range<usize>> + '_ {
        self.spans.iter().flat_map(|span| {
            (0..span.height as usize).map(move |y| {
                let start = span.first + y * span.pitch as usize;
                start..start + span.width as usize
            })
        })
    }
}
