//! Many cameras of one scene: what is asked for, and what comes back.

mod copies;
mod layout;
mod views;

use bitflags::bitflags;
pub(crate) use layout::Layout;
pub use layout::Span;
use simworld_core::camera::Camera;
use simworld_core::id::EntityId;
pub use views::Views;

bitflags! {
    /// What is measured; what is not asked for is neither shaded nor copied.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
    pub struct Channels: u32 {
        /// Colour, sRGB, 8 bit.
        const RGB = 1;
        /// Planar depth.
        const DEPTH = 2;
        /// Instances: the slot of the entity plus one.
        const IDS = 4;
        /// Classes: Cityscapes label ids.
        const CLASSES = 8;
        /// Normals of surfaces, outward, world frame. On the device, and before [`Views`] unpacks them: 0 for the sky, 0x80008000 straight up, else octahedral
        /// coordinates (Cigolle et al., A Survey of Efficient Representations for Independent Unit Vectors, 2014) as two 16-bit
        /// snorm numbers, the first in the lower half.
        const NORMALS = 16;
    }
}

/// How points come to pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Projection {
    /// As core's [`Camera`] says: rays meet in the eye, `fx` and `fy` are focal lengths in pixels.
    #[default]
    Pinhole,
    /// Rays are parallel to the optical axis, and `fx` and `fy` are pixels per metre, wherever something is. There is no sun's shadow.
    Parallel,
}

/// How the numbers of the channels are stored.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PixelFormat {
    /// Depth as `f32` in metres, classes in a byte: 12 bytes a pixel with all channels.
    #[default]
    Full,
    /// Depth as `u16` in millimetres (0 for the sky, 65535 from 65.535 m on), classes as `u16`: 7 bytes a pixel without ids, which
    /// have no shorter form.
    Compact,
}

/// One camera of a batch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewRequest {
    /// From where, and how large.
    pub camera: Camera,
    /// Whom it does not see: the one behind whose eyes it sits. It still throws its shadow.
    pub hidden: Option<EntityId>,
    /// Whom alone it sees; everybody by default.
    pub only: Option<EntityId>,
    /// How points come to pixels.
    pub projection: Projection,
}

impl From<Camera> for ViewRequest {
    fn from(camera: Camera) -> Self {
        Self { camera, hidden: None, only: None, projection: Projection::Pinhole }
    }
}

/// What the views of a batch measure, and how that is stored.
///
/// ```
/// use simworld_render::{Channels, PixelFormat, ViewOptions};
/// let lean = ViewOptions { channels: Channels::DEPTH | Channels::CLASSES, format: PixelFormat::Compact };
/// assert_eq!(lean.bytes_per_pixel(), 4);
/// assert_eq!(ViewOptions::default().bytes_per_pixel(), 12);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ViewOptions {
    /// What is measured; colour, depth, ids and classes by default.
    pub channels: Channels,
    /// How it is stored.
    pub format: PixelFormat,
}

impl Default for ViewOptions {
    fn default() -> Self {
        let channels = Channels::all().difference(Channels::NORMALS);
        Self { channels, format: PixelFormat::Full }
    }
}

impl ViewOptions {
    /// Colour, depth in millimetres and classes: 7 bytes a pixel.
    pub const fn compact() -> Self {
        let channels = Channels::RGB.union(Channels::DEPTH).union(Channels::CLASSES);
        Self { channels, format: PixelFormat::Compact }
    }

    /// Bytes that one pixel takes in all channels that are asked for.
    pub fn bytes_per_pixel(&self) -> usize {
        Channels::all().iter().map(|channel| self.bytes_of(channel)).sum()
    }

    /// Bytes that one pixel takes in one channel; 0 if it is not asked for.
    pub(crate) fn bytes_of(self, channel: Channels) -> usize {
        if !self.channels.contains(channel) {
            return 0;
        }
        match (channel, self.format) {
            (Channels::RGB, _) => 3,
            (Channels::CLASSES, PixelFormat::Full) => 1,
            (Channels::DEPTH | Channels::CLASSES, PixelFormat::Compact) => 2,
            _ => 4,
        }
    }
}
