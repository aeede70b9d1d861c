//! Why there is no picture.

use std::path::PathBuf;

use simworld_core::camera::CameraError;
use thiserror::Error;

/// Why there is no picture.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RenderError {
    /// No graphics adapter.
    #[error(
        "no graphics adapter: install a driver for the GPU, or software Vulkan (Debian: apt-get install \
         mesa-vulkan-drivers libvulkan1); everything but pictures works without ({reason})"
    )]
    NoAdapter {
        /// What the graphics interface says.
        reason: String,
    },
    /// The adapter refused to work.
    #[error("the graphics adapter refused a device: {reason}")]
    Device {
        /// What it says.
        reason: String,
    },
    /// The camera cannot exist, or its image is too large for the adapter.
    #[error(transparent)]
    Camera(#[from] CameraError),
    /// An image larger than the adapter's limit.
    #[error("an image of {width} x {height} pixels is more than this adapter's {limit} a side")]
    TooLarge {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// The adapter's limit.
        limit: u32,
    },
    /// A setting out of range.
    #[error("{field} = {value} is out of range: give {allowed}")]
    Config {
        /// The setting.
        field: &'static str,
        /// Its value.
        value: f64,
        /// What is allowed, in words.
        allowed: &'static str,
    },
    /// The adapter failed while drawing.
    #[error("drawing failed: {reason}")]
    Drawing {
        /// What it says.
        reason: String,
    },
    /// The image cannot be encoded.
    #[error("the image cannot be encoded: {0}")]
    Encoding(#[from] png::EncodingError),
    /// The image cannot be written.
    #[error("{path}: {source}")]
    File {
        /// Which file.
        path: PathBuf,
        /// Why not.
        source: std::io::Error,
    },
}
