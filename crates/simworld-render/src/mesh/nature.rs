//! Trees and shrubs. Offsets in heights, so that a tree grows as a whole.

use simworld_core::ops;

use super::builder::{Builder, Material, V3, unit};

/// Radius of a crown, in heights.
pub(crate) const CROWN_RADIUS: f32 = 0.27;

/// A bumpy surface: waves across the ball, as foliage has.
fn foliage(phase: f64) -> impl Fn(V3) -> f32 {
    move |[x, y, z]| {
        let wave = |a: f32, k: f64, p: f64| ops::sin(f64::from(a) * k + phase + p) as f32;
        1.0 + 0.09 * wave(x + z, 5.0, 0.3) * wave(y - z, 6.0, 1.1)
            + 0.06 * wave(x - y, 9.0, 2.0) * wave(z, 8.0, 0.0)
    }
}

fn trunk(mesh: &mut Builder, top: f32) {
    mesh.tube([unit(0.0, 0.0, 0.0), unit(0.0, 0.0, top)], [0.028, 0.016], 8, Material::Wood);
    for [x, y] in [[0.12, 0.05], [-0.1, 0.08], [0.0, -0.13]] {
        mesh.tube([unit(0.0, 0.0, top * 0.72), unit(x, y, top + 0.1)], [0.013, 0.006], 6, Material::Wood);
    }
}

/// A broad-leaved tree: several crowns into one another.
pub(crate) fn broadleaf() -> Builder {
    let mut mesh = Builder::new([0.5, 0.5, 1.0], 1.0);
    trunk(&mut mesh, 0.45);
    let crowns = [
        ([0.0, 0.0, 0.66], 0.215, 0.0),
        ([0.115, 0.05, 0.55], 0.15, 1.7),
        ([-0.1, 0.09, 0.53], 0.155, 3.1),
        ([0.01, -0.125, 0.56], 0.145, 4.4),
        ([-0.03, 0.02, 0.83], 0.165, 5.9),
    ];
    for ([x, y, z], radius, phase) in crowns {
        let center = unit(x, y, z);
        let radii = [radius, radius, radius * 0.95];
        mesh.blob([center, center], radii, [10, 14], Material::Body, &foliage(phase));
    }
    mesh
}

/// A slender tree with one tall crown.
pub(crate) fn slender() -> Builder {
    let mut mesh = Builder::new([0.5, 0.5, 1.0], 1.0);
    trunk(&mut mesh, 0.36);
    let (low, high) = (unit(0.0, 0.0, 0.45), unit(0.0, 0.0, 0.62));
    mesh.blob([low, high], [0.17, 0.17, 0.25], [14, 16], Material::Body, &foliage(0.7));
    let side = unit(0.05, -0.07, 0.5);
    mesh.blob([side, side], [0.14, 0.14, 0.17], [10, 14], Material::Body, &foliage(2.9));
    mesh
}

/// A shrub that fills its box.
pub(crate) fn shrub() -> Builder {
    let mut mesh = Builder::new([1.0; 3], 1.0);
    for ([x, y, z], radius, phase) in
        [([0.0, 0.05, 0.52], 0.45, 0.0), ([0.22, -0.15, 0.34], 0.3, 2.0), ([-0.24, -0.1, 0.36], 0.29, 4.0)]
    {
        let center = unit(x, y, z);
        mesh.blob([center, center], [radius; 3], [10, 14], Material::Body, &foliage(phase));
    }
    mesh
}
