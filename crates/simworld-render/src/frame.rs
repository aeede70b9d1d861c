//! The picture: RGB, depth and ids of one camera, in buffers that the caller owns.

use simworld_core::id::EntityId;

use crate::RenderError;
use crate::classes::SKY;

/// The depth of a pixel on which there is nothing.
pub const SKY_DEPTH: f32 = f32::INFINITY;

/// What a camera saw. Buffers are row by row from the top left; make one frame and pass it every time.
///
/// ```
/// let mut frame = simworld_render::Frame::new();
/// frame.resize(4, 3);
/// assert_eq!((frame.rgb.len(), frame.depth.len()), (36, 12));
/// assert!(frame.depth_at(0, 0).is_none(), "an empty frame is all sky");
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Colour, sRGB, three bytes a pixel.
    pub rgb: Vec<u8>,
    /// Planar depth, the distance along the optical axis, m; [`SKY_DEPTH`] (infinity) where there is nothing.
    pub depth: Vec<f32>,
    /// Instance: [`EntityId::index`] plus one; 0 where there is nothing.
    pub ids: Vec<u32>,
    /// Class: a Cityscapes label id, see [`classes`](crate::classes); 23 (sky) where there is nothing.
    pub classes: Vec<u8>,
    /// Who is on the picture, ascending; who is wholly hidden behind others is not.
    pub drawn: Vec<EntityId>,
}

impl Frame {
    /// An empty frame, to be drawn into.
    pub fn new() -> Self {
        Self::default()
    }

    /// Gives every buffer the length of that size, empties what it held, and keeps the memory.
    pub fn resize(&mut self, width: u32, height: u32) {
        let pixels = width as usize * height as usize;
        (self.width, self.height) = (width, height);
        refill(&mut self.rgb, pixels * 3, 0);
        refill(&mut self.depth, pixels, SKY_DEPTH);
        refill(&mut self.ids, pixels, 0);
        refill(&mut self.classes, pixels, SKY.id);
        self.drawn.clear();
    }

    /// The depth of a pixel, m; `None` for the sky and outside the picture.
    pub fn depth_at(&self, x: u32, y: u32) -> Option<f32> {
        self.index(x, y).and_then(|index| self.depth.get(index).copied()).filter(|depth| depth.is_finite())
    }

    /// The entity on a pixel; `None` for the sky and outside the picture.
    pub fn entity_at(&self, x: u32, y: u32) -> Option<EntityId> {
        let instance = *self.ids.get(self.index(x, y)?)?;
        let slot = (instance as usize).checked_sub(1)?;
        let position = self.drawn.binary_search_by_key(&slot, |id| id.index()).ok()?;
        self.drawn.get(position).copied()
    }

    /// The class of a pixel, a Cityscapes label id; `None` outside the picture.
    pub fn class_at(&self, x: u32, y: u32) -> Option<u8> {
        self.classes.get(self.index(x, y)?).copied()
    }

    /// The sRGB colour of a pixel; `None` outside the picture.
    pub fn rgb_at(&self, x: u32, y: u32) -> Option<[u8; 3]> {
        let index = self.index(x, y)? * 3;
        self.rgb.get(index..index + 3).and_then(|bytes| bytes.try_into().ok())
    }

    fn index(&self, x: u32, y: u32) -> Option<usize> {
        (x < self.width && y < self.height).then(|| y as usize * self.width as usize + x as usize)
    }

    /// Checks that a buffer has the length of the size.
    pub(crate) fn check(
        &self,
        buffer: &'static str,
        found: usize,
        channels: usize,
    ) -> Result<(), RenderError> {
        let (width, height) = (self.width, self.height);
        let expected = width as usize * height as usize * channels;
        if found == expected && expected > 0 {
            Ok(())
        } else {
            Err(RenderError::Frame { buffer, found, expected, width, height })
        }
    }
}

fn refill<T: Clone>(buffer: &mut Vec<T>, length: usize, value: T) {
    buffer.clear();
    buffer.resize(length, value);
}
