//! Assets of one's own, in a folder with a manifest (feature `assets`).
//!
//! A folder holds `library.toml`, the GLB files that it names, and perhaps `library.lock`, the content addresses of all of them:
//!
//! ```toml
//! name = "harbour"
//! licence = "CC0-1.0"             # of every asset that has none of its own
//! source = "drawn by the harbour office"
//!
//! [[asset]]
//! name = "mooring_post"           # lower-case letters, digits and underscores
//! words = "an iron mooring post"  # what it is: by it, it is measured and found
//! model = "mooring_post.glb"      # within the folder
//! tags = ["bollard", "quay"]
//!
//! [[asset]]
//! name = "net_rack"               # without a model it is a box, or a cylinder
//! kind = "prop"
//! size = [0.8, 2.5, 1.8]          # length, width, height, m
//! mass = 40.0                     # kg; fixed to the ground without one, unless it has a model
//! material = "wood"
//! affords = ["carry"]
//! ```
//!
//! Nothing outside the folder is read: paths are relative, go down only, and no link is followed. What is wrong is said with its
//! file, its line and how to mend it, and then nothing of the folder is taken.

mod error;
mod folder;
mod manifest;

pub use error::LibraryError;
pub use folder::{LOCK, Library, LibraryLimits, MANIFEST};
pub use manifest::{Form, Manifest, Row};
