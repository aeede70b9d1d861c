//! The four solids of core, exactly: what every kind without a silhouette of its own looks like.

use super::builder::{Builder, Material, P, share, unit};

/// The least and greatest corner of the body's box.
pub(crate) const LOW: P = share(-0.5, -0.5, 0.0);
pub(crate) const HIGH: P = share(0.5, 0.5, 1.0);
/// The middle of the top.
pub(crate) const TOP: P = share(0.0, 0.0, 1.0);
/// The middle of the bottom, the origin.
pub(crate) const BOTTOM: P = share(0.0, 0.0, 0.0);

pub(crate) fn cuboid() -> Builder {
    let mut mesh = Builder::new([1.0; 3], 1.0);
    mesh.cuboid(LOW, HIGH, Material::Body);
    mesh
}

/// The top of a box alone.
pub(crate) fn top() -> Builder {
    let mut mesh = Builder::new([1.0; 3], 1.0);
    let corners = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]];
    mesh.quad(corners.map(|[x, y]| share(x, y, 1.0)), Material::Body);
    mesh
}

/// Offsets in radii.
pub(crate) fn cylinder() -> Builder {
    let mut mesh = Builder::new([2.0, 2.0, 2.0], 1.0);
    mesh.tube([BOTTOM, TOP], [1.0, 1.0], 24, Material::Body);
    mesh
}

/// Offsets in radii.
pub(crate) fn capsule() -> Builder {
    let mut mesh = Builder::new([2.0, 2.0, 4.0], 1.0);
    let ends = [BOTTOM.plus(0.0, 0.0, 1.0), TOP.plus(0.0, 0.0, -1.0)];
    mesh.ball(ends, [1.0; 3], 12, 24, Material::Body);
    mesh
}

/// Offsets in radii.
pub(crate) fn sphere() -> Builder {
    let mut mesh = Builder::new([2.0; 3], 1.0);
    let middle = unit(0.0, 0.0, 1.0);
    mesh.ball([middle, middle], [1.0; 3], 16, 24, Material::Body);
    mesh
}
