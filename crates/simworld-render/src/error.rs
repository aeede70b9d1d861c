//! What can go wrong between a scene and its picture, in words that say how to mend it.

use std::path::PathBuf;

use thiserror::Error;

/// Why there is no picture.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RenderError {
    /// No graphics adapter answers. Everything of simworld but pictures works without one.
    #[error(
        "no graphics adapter was found ({reason}): install a GPU driver, or software Vulkan with `apt-get install \
         mesa-vulkan-drivers libvulkan1`; everything but pictures works without"
    )]
    NoAdapter {
        /// What the graphics interface said.
        reason: String,
    },
    /// An adapter is there but gives no device.
    #[error("the adapter {adapter} gives no device: {reason}")]
    NoDevice {
        /// Name of the adapter.
        adapter: String,
        /// What it said.
        reason: String,
    },
    /// A setting out of range.
    #[error("{field} = {value} is out of range: give {allowed}")]
    Config {
        /// The field of [`RenderConfig`](crate::RenderConfig).
        field: &'static str,
        /// The refused value.
        value: f64,
        /// The allowed range, in words.
        allowed: &'static str,
    },
    /// A camera whose picture the adapter cannot hold.
    #[error(
        "a picture of {width} x {height} pixels is out of range: this adapter draws 1 to {limit} each way"
    )]
    Size {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// The most each way.
        limit: u32,
    },
    /// A camera that cannot exist.
    #[error("the camera's {field} = {value} is out of range: give {allowed}")]
    Camera {
        /// The field.
        field: &'static str,
        /// The refused value.
        value: f64,
        /// The allowed range, in words.
        allowed: &'static str,
    },
    /// Intrinsics that core refuses.
    #[error(transparent)]
    Intrinsics(#[from] simworld_core::camera::CameraError),
    /// A batch without views.
    #[error("there is no view to draw: give at least one camera")]
    NoViews,
    /// A batch without channels.
    #[error("no channel is asked for: give at least one of `Channels`")]
    NoChannels,
    /// A batch with more pixels than the adapter's buffers hold.
    #[error(
        "the views have {pixels} pixels, with rows padded to 64, and this adapter holds {limit}: draw them in several batches"
    )]
    Batch {
        /// Pixels of all views.
        pixels: usize,
        /// The most.
        limit: usize,
    },
    /// A ticket whose views were taken already, or that is another renderer's.
    #[error("no views wait for this ticket: they were taken, or another renderer draws them")]
    Ticket,
    /// The device went away, and what was under way with it.
    #[error(
        "the graphics device was lost ({reason}), and the renderer has a new one from the next call on: draw again"
    )]
    Lost {
        /// What the graphics interface said.
        reason: String,
    },
    /// More to draw than the adapter's buffers hold.
    #[error("{count} things to draw exceed the {limit} that this adapter holds: draw a part of the scene")]
    TooMany {
        /// How many.
        count: usize,
        /// The most.
        limit: usize,
    },
    /// A model that the adapter's buffers do not hold.
    #[error(
        "the model of asset {name:?} takes {bytes} bytes, and this adapter holds {limit}: give it fewer triangles"
    )]
    Model {
        /// Of which asset.
        name: String,
        /// How many it takes.
        bytes: u64,
        /// The most.
        limit: u64,
    },
    /// More pictures on models than there is memory for, be they of one pixel each.
    #[error(
        "the models of the scene have {count} pictures, and there is room for {limit}: raise `texture_memory`"
    )]
    Pictures {
        /// How many.
        count: usize,
        /// The most.
        limit: usize,
    },
    /// The adapter ran out of memory.
    #[error("the adapter ran out of memory: draw a smaller picture or a smaller shadow map")]
    OutOfMemory,
    /// The graphics interface refused a call.
    #[error("the graphics device failed: {0}")]
    Device(String),
    /// The frame has not been drawn, or its buffers were resized by hand.
    #[error(
        "the frame's {buffer} buffer has {found} entries where {width} x {height} pixels need {expected}"
    )]
    Frame {
        /// The buffer.
        buffer: &'static str,
        /// Its length.
        found: usize,
        /// The length that belongs to the size.
        expected: usize,
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
    },
    /// A frame is read with another camera than the one that took it.
    #[error(
        "a frame of {width} x {height} pixels was not taken by a camera of {camera_width} x {camera_height}: give that camera"
    )]
    OtherCamera {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// Those of the camera.
        camera_width: u32,
        /// Those of the camera.
        camera_height: u32,
    },
    /// An instance has no place in 24 bits.
    #[error("instance {id} has no place beside a class in one number of 32 bits: take ids and classes apart")]
    Label {
        /// The instance.
        id: u32,
    },
    /// A table of classes that contradicts itself.
    #[error("the table of classes: {reason}")]
    Classes {
        /// What is wrong with it, and how to mend it.
        reason: String,
    },
    /// A table of beams that no scanner has.
    #[error("the table of beams: {reason}")]
    Beams {
        /// What is wrong with it, and how to mend it.
        reason: String,
    },
    /// The PNG encoder refused.
    #[error("the picture cannot be encoded as PNG: {0}")]
    Png(#[from] png::EncodingError),
    /// A file cannot be written.
    #[error("{} cannot be written: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
}
