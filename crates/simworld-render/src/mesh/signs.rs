//! What stands on posts: signs, boards, lanterns, signals for walkers, flags. Offsets in metres; what faces somebody faces +x.

use simworld_core::ops;

use super::builder::{Builder, Material, P, V3, share};
use super::primitives::{BOTTOM, TOP};
use super::things::{metric, turned};

/// A plate on a post: `corners` of 8 is a stop sign, of 3 one to give way.
pub(crate) fn plate(corners: u32, radius: f32) -> Builder {
    let mut mesh = metric();
    mesh.tube([BOTTOM, TOP], [0.035, 0.035], 8, Material::Metal);
    let middle = TOP.plus(0.05, 0.0, -radius);
    // A triangle stands on its point, an octagon on its side.
    let turn = if corners == 3 { 0.0 } else { std::f64::consts::PI / f64::from(corners) };
    let (sin, cos) = ops::sin_cos(turn);
    let (sin, cos) = (sin as f32, cos as f32);
    let disc = |mesh: &mut Builder, r: f32, dx: f32, material| {
        let place = move |[x, y, z]: V3| middle.plus(z + dx, x * sin + y * cos, y * sin - x * cos);
        let rings = [[0.0, 0.0, 0.0, 0.0], [0.001, r, r, 0.0], [0.016, r, r, 0.0], [0.017, 0.0, 0.0, 0.0]];
        mesh.lathe(&rings, corners, material, &place);
    };
    if corners == 3 {
        disc(&mut mesh, radius, 0.0, Material::Body);
        disc(&mut mesh, radius * 0.6, 0.004, Material::White);
        return mesh;
    }
    disc(&mut mesh, radius, 0.0, Material::White);
    disc(&mut mesh, radius * 0.92, 0.004, Material::Body);
    mesh.cuboid(
        middle.plus(0.018, -radius * 0.6, -0.06),
        middle.plus(0.026, radius * 0.6, 0.06),
        Material::White,
    );
    mesh
}

/// A long plate with lettering, on a post.
pub(crate) fn name_plate() -> Builder {
    let mut mesh = metric();
    mesh.tube([BOTTOM, TOP], [0.035, 0.03], 8, Material::Metal);
    mesh.cuboid(TOP.plus(-0.05, -0.48, -0.32), TOP.plus(0.05, 0.48, -0.06), Material::Body);
    for side in [-1.0_f32, 1.0] {
        let (low, high) = if side > 0.0 { (0.05, 0.056) } else { (-0.056, -0.05) };
        for (y0, y1) in [(-0.4, -0.16), (-0.1, 0.22), (0.28, 0.4)] {
            mesh.cuboid(TOP.plus(low, y0, -0.23), TOP.plus(high, y1, -0.15), Material::White);
        }
    }
    mesh
}

/// A board on two posts.
pub(crate) fn board() -> Builder {
    let mut mesh = metric();
    for y in [-0.4, 0.4] {
        mesh.tube([share(0.0, y, 0.0), share(0.0, y, 0.96)], [0.05, 0.05], 6, Material::Metal);
    }
    mesh.cuboid(share(-0.3, -0.5, 0.42), share(0.5, 0.5, 1.0), Material::Body);
    mesh.cuboid(share(0.5, -0.46, 0.46), share(0.5, 0.46, 0.96).plus(0.01, 0.0, 0.0), Material::White);
    for (y0, y1, z0, z1) in
        [(-0.4, 0.1, 0.7, 0.9), (-0.4, 0.4, 0.6, 0.64), (-0.4, 0.3, 0.52, 0.56), (0.16, 0.4, 0.7, 0.9)]
    {
        mesh.cuboid(share(0.5, y0, z0), share(0.5, y1, z1).plus(0.016, 0.0, 0.0), Material::Second);
    }
    mesh
}

/// A column for posters.
pub(crate) fn column() -> Builder {
    let mut mesh = turned(&[
        (0.0, 0.0, Material::Body),
        (0.0, 0.5, Material::Body),
        (0.1, 0.5, Material::Body),
        (0.11, 0.45, Material::White),
        (0.45, 0.45, Material::Second),
        (0.62, 0.45, Material::White),
        (0.82, 0.45, Material::Body),
        (0.83, 0.53, Material::Body),
        (0.88, 0.5, Material::Body),
        (1.0, 0.0, Material::Body),
    ]);
    mesh.tube([TOP, TOP.plus(0.0, 0.0, 0.1)], [0.04, 0.04], 6, Material::Metal);
    mesh
}

/// A lantern on a post.
pub(crate) fn lantern() -> Builder {
    // Reckoned at its usual height, where its shaft is longer than its foot and its head.
    let mut mesh = Builder::new([0.2, 0.2, 4.0], 1.0);
    mesh.tube([BOTTOM, BOTTOM.plus(0.0, 0.0, 0.6)], [0.1, 0.07], 8, Material::Body);
    mesh.tube([BOTTOM.plus(0.0, 0.0, 0.6), TOP.plus(0.0, 0.0, -0.55)], [0.05, 0.04], 8, Material::Body);
    mesh.tube([TOP.plus(0.0, 0.0, -0.55), TOP.plus(0.0, 0.0, -0.15)], [0.12, 0.2], 8, Material::LampGlow);
    mesh.tube([TOP.plus(0.0, 0.0, -0.15), TOP], [0.24, 0.04], 8, Material::Body);
    mesh
}

/// Two lamps on one post.
pub(crate) fn double_lamp() -> Builder {
    let mut mesh = metric();
    mesh.tube([BOTTOM, TOP.plus(0.0, 0.0, -0.2)], [0.1, 0.06], 10, Material::Body);
    for side in [-1.0_f32, 1.0] {
        mesh.tube(
            [TOP.plus(0.0, 0.0, -0.3), TOP.plus(1.3 * side, 0.0, -0.02)],
            [0.045, 0.035],
            6,
            Material::Body,
        );
        let (low, high) = if side > 0.0 { (0.9, 1.6) } else { (-1.6, -0.9) };
        mesh.cuboid(TOP.plus(low, -0.13, -0.06), TOP.plus(high, 0.13, 0.05), Material::Body);
        mesh.cuboid(
            TOP.plus(low + 0.05, -0.1, -0.075),
            TOP.plus(high - 0.05, 0.1, -0.058),
            Material::LampGlow,
        );
    }
    mesh
}

/// A signal for walkers: red over green.
pub(crate) fn walk_signal() -> Builder {
    let mut mesh = metric();
    mesh.tube([BOTTOM, TOP], [0.06, 0.05], 8, Material::Metal);
    let low = TOP.plus(0.05, -0.15, -0.68);
    mesh.cuboid(low, low.plus(0.16, 0.3, 0.62), Material::Dark);
    for (height, material) in [(0.46, Material::SignalRed), (0.17, Material::SignalGreen)] {
        let middle = low.plus(0.16, 0.15, height);
        mesh.cuboid(middle.plus(0.0, -0.03, -0.09), middle.plus(0.012, 0.03, 0.03), material);
        mesh.tube([middle.plus(0.0, 0.0, 0.06), middle.plus(0.012, 0.0, 0.06)], [0.028, 0.028], 8, material);
    }
    mesh
}

/// A mast with a light crossarm: poles for wires, cameras, flags.
pub(crate) fn mast() -> Builder {
    let mut mesh = metric();
    mesh.tube([BOTTOM, TOP], [0.09, 0.06], 8, Material::Body);
    mesh.cuboid(TOP.plus(-0.06, -0.8, -0.5), TOP.plus(0.06, 0.8, -0.38), Material::Body);
    for y in [-0.7, 0.0, 0.7] {
        mesh.tube([TOP.plus(0.0, y, -0.38), TOP.plus(0.0, y, -0.24)], [0.05, 0.04], 6, Material::White);
    }
    mesh
}

pub(crate) fn flag() -> Builder {
    let mut mesh = metric();
    mesh.tube([BOTTOM, TOP], [0.05, 0.03], 8, Material::White);
    for k in 0..6_u8 {
        let (y0, y1) = (0.28 * f32::from(k), 0.28 * f32::from(k + 1));
        let wave = |k: u8| if k.is_multiple_of(2) { 0.05 } else { -0.05 };
        let (a, b) = (TOP.plus(wave(k), 0.05 + y0, 0.0), TOP.plus(wave(k + 1), 0.05 + y1, 0.0));
        let down = |p: P| p.plus(0.0, 0.0, -1.1);
        mesh.quad([down(a), down(b), b, a], Material::Second);
        mesh.quad([down(b), down(a), a, b].map(|p| p.plus(-0.01, 0.0, 0.0)), Material::Second);
    }
    mesh
}
