//! Assets from files (feature `assets`): GLB read within limits, mended, measured and taken apart.
//!
//! [`import_glb`] makes an asset of a file of anybody's; [`read_glb`] gives its bare surface, and [`read_glb_at`] that of a moment of an animation; [`export_glb`] writes a model as a file.

mod glb;
mod import;
mod prior;
mod surface;

pub use glb::{GlbError, GlbLimits, Moment, export_glb, read_glb, read_glb_at, read_rigged_glb};
pub use import::{
    Facing, ImportConfig, ImportError, ImportReport, Imported, Repair, Thing, Unit, import_glb,
};
pub use prior::SizePrior;
pub use surface::Surface;
