//! Street furniture. Offsets in metres; what faces somebody faces +x.

use super::builder::{Builder, Material, P, share};
use super::primitives::{BOTTOM, HIGH, LOW, TOP};

/// How far the head of a lamp reaches over the road, m.
pub(crate) const LAMP_REACH: f32 = 1.6;

pub(crate) fn lamp() -> Builder {
    let mut mesh = Builder::new([0.2, 0.2, 6.0], 1.0);
    mesh.tube([BOTTOM, BOTTOM.plus(0.0, 0.0, 0.9)], [0.11, 0.09], 10, Material::Body);
    mesh.tube([BOTTOM.plus(0.0, 0.0, 0.9), TOP.plus(0.0, 0.0, -0.35)], [0.065, 0.045], 10, Material::Body);
    let knee = TOP.plus(0.35, 0.0, -0.07);
    mesh.limb([TOP.plus(0.0, 0.0, -0.35), knee], [0.045, 0.04], Material::Body);
    mesh.tube([knee, TOP.plus(1.1, 0.0, -0.01)], [0.04, 0.035], 8, Material::Body);
    let head = TOP.plus(1.0, -0.13, -0.06);
    mesh.tapered(head, TOP.plus(LAMP_REACH, 0.13, 0.04), [0.06, 0.04], [Material::Body; 3]);
    mesh.cuboid(TOP.plus(1.08, -0.1, -0.075), TOP.plus(LAMP_REACH - 0.06, 0.1, -0.058), Material::LampGlow);
    mesh
}

pub(crate) fn signal() -> Builder {
    let mut mesh = Builder::new([0.16, 0.16, 3.5], 1.0);
    mesh.tube([BOTTOM, TOP], [0.07, 0.06], 10, Material::Metal);
    let low = TOP.plus(0.05, -0.17, -1.02);
    mesh.cuboid(low, low.plus(0.2, 0.34, 1.02), Material::Dark);
    let lamps = [(0.83, Material::SignalRed), (0.51, Material::SignalYellow), (0.19, Material::SignalGreen)];
    for (height, material) in lamps {
        let middle = low.plus(0.2, 0.17, height);
        mesh.tube([middle, middle.plus(0.015, 0.0, 0.0)], [0.115, 0.105], 16, material);
        // A visor over the lamp.
        mesh.cuboid(middle.plus(0.0, -0.12, 0.115), middle.plus(0.14, 0.12, 0.13), Material::Dark);
    }
    mesh
}

/// A leg between the bottom and a height below the top, at a corner inset by `inset` m.
fn leg(mesh: &mut Builder, [x, y]: [f32; 2], [inset, radius]: [f32; 2], top: P) {
    let foot = share(x, y, 0.0).plus(-x * 2.0 * inset, -y * 2.0 * inset, 0.0);
    let head = P { a: [x, y, top.a[2]], o: [foot.o[0], foot.o[1], top.o[2]] };
    mesh.tube([foot, head], [radius, radius], 6, Material::Metal);
}

const CORNERS: [[f32; 2]; 4] = [[0.5, 0.5], [0.5, -0.5], [-0.5, 0.5], [-0.5, -0.5]];

pub(crate) fn bench() -> Builder {
    let mut mesh = Builder::new([0.6, 1.8, 0.85], 1.0);
    for slat in 0..4_u8 {
        let x = -0.42 + 0.23 * f32::from(slat);
        mesh.cuboid(share(x, -0.5, 0.5).plus(0.0, 0.0, -0.04), share(x + 0.19, 0.5, 0.5), Material::Body);
    }
    for slat in 0..2_u8 {
        let z = 0.62 + 0.2 * f32::from(slat);
        mesh.cuboid(share(-0.5, -0.5, z), share(-0.5, 0.5, z + 0.16).plus(0.05, 0.0, 0.0), Material::Body);
    }
    for y in [-0.4, 0.4] {
        mesh.cuboid(
            share(-0.5, y, 0.0).plus(0.0, -0.03, 0.0),
            share(-0.5, y, 1.0).plus(0.06, 0.03, 0.0),
            Material::Metal,
        );
        mesh.cuboid(
            share(0.4, y, 0.0).plus(-0.03, -0.03, 0.0),
            share(0.4, y, 0.5).plus(0.03, 0.03, -0.04),
            Material::Metal,
        );
    }
    mesh
}

pub(crate) fn chair() -> Builder {
    let mut mesh = Builder::new([0.5, 0.5, 0.9], 1.0);
    mesh.cuboid(share(-0.5, -0.5, 0.5).plus(0.0, 0.0, -0.04), share(0.5, 0.5, 0.5), Material::Body);
    mesh.cuboid(share(-0.5, -0.5, 0.62), share(-0.5, 0.5, 1.0).plus(0.04, 0.0, 0.0), Material::Body);
    for corner in CORNERS {
        leg(&mut mesh, corner, [0.03, 0.02], share(0.0, 0.0, if corner[0] < 0.0 { 1.0 } else { 0.5 }));
    }
    mesh
}

pub(crate) fn table() -> Builder {
    let mut mesh = Builder::new([0.8, 0.8, 0.75], 1.0);
    mesh.cuboid(share(-0.5, -0.5, 1.0).plus(0.0, 0.0, -0.04), HIGH, Material::Body);
    for corner in CORNERS {
        leg(&mut mesh, corner, [0.06, 0.025], TOP.plus(0.0, 0.0, -0.04));
    }
    mesh
}

/// Offsets in radii.
pub(crate) fn trash_bin() -> Builder {
    let mut mesh = Builder::new([2.0, 2.0, 3.6], 1.0);
    mesh.tube([BOTTOM, share(0.0, 0.0, 0.86)], [0.82, 0.95], 16, Material::Body);
    mesh.tube([share(0.0, 0.0, 0.86), share(0.0, 0.0, 0.93)], [1.0, 1.0], 16, Material::Second);
    mesh.tube([share(0.0, 0.0, 0.93), TOP], [0.9, 0.45], 16, Material::Second);
    mesh
}

pub(crate) fn mailbox() -> Builder {
    let mut mesh = Builder::new([0.4, 0.5, 1.2], 1.0);
    mesh.cuboid(share(-0.3, -0.3, 0.0), share(0.3, 0.3, 0.45), Material::Metal);
    mesh.tapered(share(-0.5, -0.5, 0.45), HIGH, [0.05, 0.04], [Material::Body; 3]);
    mesh.cuboid(
        share(0.5, -0.3, 0.8).plus(-0.06, 0.0, 0.0),
        share(0.5, 0.3, 0.84).plus(-0.02, 0.0, 0.0),
        Material::Dark,
    );
    mesh
}

/// Offsets in radii.
pub(crate) fn hydrant() -> Builder {
    let mut mesh = Builder::new([2.0, 2.0, 5.3], 1.0);
    mesh.tube([BOTTOM, share(0.0, 0.0, 0.07)], [0.9, 0.9], 14, Material::Metal);
    mesh.tube([share(0.0, 0.0, 0.07), share(0.0, 0.0, 0.78)], [0.6, 0.56], 14, Material::Body);
    let dome = share(0.0, 0.0, 0.78);
    mesh.ball([dome, dome], [0.68, 0.68, 0.9], 8, 14, Material::Second);
    for side in [-1.0, 1.0] {
        let middle = share(0.0, 0.0, 0.58);
        mesh.tube([middle, middle.plus(0.0, side, 0.0)], [0.3, 0.3], 10, Material::Second);
    }
    mesh
}

/// Offsets in radii.
pub(crate) fn cone() -> Builder {
    let mut mesh = Builder::new([2.0, 2.0, 3.9], 1.0);
    mesh.cuboid(LOW, share(0.5, 0.5, 0.06), Material::Dark);
    let ring = |z: f32| 0.8 - 0.68 * (z - 0.06) / 0.94;
    for (low, high, material) in [
        (0.06, 0.4, Material::Body),
        (0.4, 0.58, Material::White),
        (0.58, 0.72, Material::Body),
        (0.72, 0.82, Material::White),
        (0.82, 1.0, Material::Body),
    ] {
        let ends = [share(0.0, 0.0, low), share(0.0, 0.0, high)];
        mesh.tube(ends, [ring(low), ring(high)], 16, material);
    }
    mesh
}

/// A cardboard box with a strip of tape.
pub(crate) fn parcel() -> Builder {
    let mut mesh = Builder::new([0.3, 0.3, 0.2], 1.0);
    mesh.cuboid(LOW, HIGH, Material::Body);
    mesh.quad(
        [
            share(0.5, -0.09, 1.0).plus(0.0, 0.0, 0.001),
            share(0.5, 0.09, 1.0).plus(0.0, 0.0, 0.001),
            share(-0.5, 0.09, 1.0).plus(0.0, 0.0, 0.001),
            share(-0.5, -0.09, 1.0).plus(0.0, 0.0, 0.001),
        ],
        Material::Second,
    );
    mesh
}
