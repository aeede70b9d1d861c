//! The picture: RGB, depth and ids of one camera, in buffers that the caller owns.

use simworld_core::camera::Camera;
use simworld_core::geometry::{Point2, Point3};
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
    /// Outward normals of the surfaces, unit length, world frame, zero where there is nothing; empty unless
    /// [`Channels::NORMALS`](crate::Channels::NORMALS) was asked for.
    pub normals: Vec<[f32; 3]>,
    /// How far the surface on each pixel has come since the picture before, pixels to the right and down; empty unless
    /// [`OpticalFlow`](crate::OpticalFlow) wrote it.
    pub flow: Vec<[f32; 2]>,
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
        self.normals.clear();
        self.flow.clear();
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

    /// The point of the world on the middle of a pixel, as the camera that took the frame sees it, m; `None` for the sky and
    /// outside the picture.
    pub fn point_at(&self, camera: &Camera, x: u32, y: u32) -> Option<Point3> {
        let depth = f64::from(self.depth_at(x, y)?);
        let pixel = Point2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
        Some(camera.world_from_optical * camera.intrinsics.unproject(&pixel, depth))
    }

    /// Euclidean depth, the distance from the eye of the camera that took the frame, m; infinite for the sky.
    ///
    /// # Errors
    /// There is no depth, or the camera is of another size.
    pub fn distances(&self, camera: &Camera) -> Result<Vec<f32>, RenderError> {
        self.check("depth", self.depth.len(), 1)?;
        self.check_camera(camera)?;
        let k = &camera.intrinsics;
        let of = |(index, depth): (usize, &f32)| {
            let across = ((index % self.width as usize) as f64 + 0.5 - k.cx) / k.fx;
            let down = ((index / self.width as usize) as f64 + 0.5 - k.cy) / k.fy;
            (f64::from(*depth) * (1.0 + across * across + down * down).sqrt()) as f32
        };
        Ok(self.depth.iter().enumerate().map(of).collect())
    }

    /// Class and instance of each pixel in one number: the class in the upper 8 bits, [`ids`](Self::ids) in the lower 24.
    ///
    /// # Errors
    /// There are no ids or no classes, or a world of more than 2^24 - 2 slots.
    pub fn labels(&self) -> Result<Vec<u32>, RenderError> {
        self.check("ids", self.ids.len(), 1)?;
        self.check("classes", self.classes.len(), 1)?;
        let both = |(id, class): (&u32, &u8)| {
            if *id < 1 << 24 { Ok(u32::from(*class) << 24 | id) } else { Err(RenderError::Label { id: *id }) }
        };
        self.ids.iter().zip(&self.classes).map(both).collect()
    }

    fn index(&self, x: u32, y: u32) -> Option<usize> {
        (x < self.width && y < self.height).then(|| y as usize * self.width as usize + x as usize)
    }

    /// Checks that the frame has the size of a camera.
    pub(crate) fn check_camera(&self, camera: &Camera) -> Result<(), RenderError> {
        let k = &camera.intrinsics;
        if (k.width, k.height) == (self.width, self.height) {
            return Ok(());
        }
        let (width, height) = (self.width, self.height);
        Err(RenderError::OtherCamera { width, height, camera_width: k.width, camera_height: k.height })
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
