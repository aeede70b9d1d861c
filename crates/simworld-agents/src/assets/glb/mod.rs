//! GLB files (binary glTF 2.0): read as surfaces, and written from models.
//!
//! Files come from strangers. Everything must stand in the one file: no address is followed, and no other file is opened.
//! Lengths, counts, indices and depths are checked before memory is taken for them. What is read: the triangles of one scene,
//! where its nodes put them, or its skins' joints, at rest or at a moment of an animation, and how its animations move them; with normals, and colours from
//! materials and vertices, alpha where a material says what is to become of it, and whether it has two sides; tangents where there is a picture of normals and nothing turns it; PNG or JPEG textures of all five kinds, as far as those of one primitive lie alike:
//! of metal, roughness and light of its own that lie otherwise the mean is read, and such of occlusion and normals are passed over; and the extensions `KHR_texture_transform`, `KHR_mesh_quantization`, `KHR_materials_unlit` and
//! `KHR_materials_emissive_strength`. Sparse accessors, morph targets, compressed meshes, other extensions that a file requires, and
//! everything but separate triangles are refused; cameras and lights are passed over.

mod accessor;
mod container;
mod document;
mod error;
mod finish;
mod limits;
mod paint;
mod picture;
mod pose;
mod rig;
mod scene;
mod write;
mod write_rig;

pub use error::GlbError;
pub use limits::GlbLimits;
pub use pose::Moment;
pub use write::export_glb;

use super::surface::Surface;

/// Reads what a file shows: body axes (x forward, y left, z up), the file's own unit and origin.
///
/// # Errors
/// The bytes are no such file, hold more than the limits allow, refer to what is not there or stands elsewhere, or use what is
/// not read; see [`GlbError`].
pub fn read_glb(bytes: &[u8], limits: &GlbLimits) -> Result<Surface, GlbError> {
    read_glb_at(bytes, limits, None)
}

/// As [`read_glb`], at a moment of one of the file's animations; at rest without one.
///
/// # Errors
/// As there; also an animation that is not there, or is damaged.
pub fn read_glb_at(bytes: &[u8], limits: &GlbLimits, moment: Option<Moment>) -> Result<Surface, GlbError> {
    let (document, bytes) = container::open(bytes, limits)?;
    scene::surface(accessor::Data { document: &document, bytes }, limits, moment, false)
}

/// As [`read_glb_at`], with the rig by which the file's animations move it, if they move something that is seen.
///
/// # Errors
/// As there; also any animation that is damaged.
pub fn read_rigged_glb(
    bytes: &[u8],
    limits: &GlbLimits,
    moment: Option<Moment>,
) -> Result<Surface, GlbError> {
    let (document, bytes) = container::open(bytes, limits)?;
    scene::surface(accessor::Data { document: &document, bytes }, limits, moment, true)
}
