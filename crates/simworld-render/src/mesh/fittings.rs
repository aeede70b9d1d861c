//! What stands on roofs and before walls. The frame of each part is said with it; offsets in metres.

use super::builder::{Builder, Material, P, share};
use super::primitives::{BOTTOM, HIGH, LOW, TOP};

fn metric() -> Builder {
    Builder::new([1.0; 3], 1.0)
}

/// A chimney on the ridge, as high as its box.
pub(crate) fn chimney() -> Builder {
    let mut mesh = metric();
    mesh.cuboid(LOW, HIGH, Material::Body);
    mesh.cuboid(
        share(-0.5, -0.5, 1.0).plus(-0.05, -0.05, -0.12),
        HIGH.plus(0.05, 0.05, -0.04),
        Material::Second,
    );
    for y in [-0.2, 0.2] {
        let foot = share(0.0, y, 1.0);
        mesh.tube([foot, foot.plus(0.0, 0.0, 0.25)], [0.1, 0.08], 8, Material::Dark);
    }
    mesh
}

/// A cooling unit with its fan.
pub(crate) fn roof_unit() -> Builder {
    let mut mesh = metric();
    mesh.cuboid(LOW.plus(0.0, 0.0, 0.12), HIGH, Material::White);
    for x in [-0.3, 0.3] {
        mesh.cuboid(
            share(x, -0.5, 0.0).plus(-0.06, 0.0, 0.0),
            share(x, 0.5, 0.0).plus(0.06, 0.0, 0.14),
            Material::Dark,
        );
    }
    mesh.tube([TOP, TOP.plus(0.0, 0.0, 0.1)], [0.42, 0.42], 14, Material::Metal);
    mesh.tube([TOP.plus(0.0, 0.0, 0.1), TOP.plus(0.0, 0.0, 0.105)], [0.34, 0.34], 14, Material::Dark);
    for z in [0.3, 0.45, 0.6, 0.75] {
        mesh.cuboid(
            share(0.5, -0.42, z).plus(-0.01, 0.0, 0.0),
            share(0.5, 0.42, z + 0.06).plus(0.01, 0.0, 0.0),
            Material::Dark,
        );
    }
    mesh
}

/// A wooden water tank on legs.
pub(crate) fn tank() -> Builder {
    let mut mesh = metric();
    for [x, y] in [[0.34, 0.34], [0.34, -0.34], [-0.34, 0.34], [-0.34, -0.34]] {
        mesh.tube([share(x, y, 0.0), share(x, y, 0.4)], [0.06, 0.06], 4, Material::Dark);
    }
    mesh.tube([share(0.0, 0.0, 0.38), share(0.0, 0.0, 0.82)], [1.0, 1.0], 16, Material::Wood);
    mesh.tube([share(0.0, 0.0, 0.82), TOP], [1.08, 0.1], 16, Material::Dark);
    mesh
}

/// An aerial.
pub(crate) fn antenna() -> Builder {
    let mut mesh = metric();
    mesh.tube([BOTTOM, TOP], [0.06, 0.03], 5, Material::Metal);
    for z in [0.55, 0.7, 0.85] {
        let middle = share(0.0, 0.0, z);
        mesh.tube(
            [middle.plus(0.0, -0.5, 0.0), middle.plus(0.0, 0.5, 0.0)],
            [0.025, 0.025],
            4,
            Material::Metal,
        );
    }
    let dish = share(0.0, 0.0, 0.4);
    mesh.tube([dish.plus(0.05, 0.0, 0.0), dish.plus(0.2, 0.0, 0.0)], [0.12, 0.4], 12, Material::White);
    mesh
}

/// An awning over a shop front: the wall is its back, the box says how far it comes out and how wide it is.
pub(crate) fn awning() -> Builder {
    let mut mesh = metric();
    let stripes = 12_u8;
    for k in 0..stripes {
        let material = if k % 2 == 0 { Material::Body } else { Material::White };
        let y = |k: u8| f32::from(k) / f32::from(stripes) - 0.5;
        let (y0, y1) = (y(k), y(k + 1));
        let (back, front) = (share(-0.5, 0.0, 1.0), share(0.5, 0.0, 0.35));
        let at = |p: P, y: f32| P { a: [p.a[0], y, p.a[2]], o: p.o };
        mesh.quad([at(back, y0), at(front, y0), at(front, y1), at(back, y1)], material);
        let hem = |p: P| p.plus(0.0, 0.0, -0.2);
        mesh.quad([hem(at(front, y0)), hem(at(front, y1)), at(front, y1), at(front, y0)], material);
        mesh.quad(
            [at(back, y1), at(front, y1), at(front, y0), at(back, y0)].map(|p| p.plus(0.0, 0.0, -0.02)),
            material,
        );
        mesh.quad(
            [at(front, y0), at(front, y1), hem(at(front, y1)), hem(at(front, y0))]
                .map(|p| p.plus(-0.01, 0.0, 0.0)),
            material,
        );
    }
    for y in [-0.49, 0.49] {
        mesh.tube([share(-0.5, y, 0.35), share(0.5, y, 0.33)], [0.02, 0.02], 4, Material::Dark);
    }
    mesh
}

/// A sign that hangs out from a wall, in the middle of its box.
pub(crate) fn blade_sign() -> Builder {
    let mut mesh = metric();
    mesh.cuboid(share(-0.3, -0.5, 0.0), share(0.5, 0.5, 0.9), Material::Body);
    mesh.cuboid(
        share(-0.2, -0.5, 0.12).plus(0.0, -0.01, 0.0),
        share(0.4, 0.5, 0.78).plus(0.0, 0.01, 0.0),
        Material::White,
    );
    mesh.cuboid(
        share(-0.1, -0.5, 0.3).plus(0.0, -0.015, 0.0),
        share(0.3, 0.5, 0.6).plus(0.0, 0.015, 0.0),
        Material::Body,
    );
    mesh.tube([share(-0.5, 0.0, 0.94), share(0.5, 0.0, 0.94)], [0.025, 0.025], 5, Material::Dark);
    mesh
}

/// A balcony: a slab, and rails on its three free sides.
pub(crate) fn balcony() -> Builder {
    let mut mesh = metric();
    mesh.cuboid(LOW.plus(0.0, 0.0, -0.16), share(0.5, 0.5, 0.0), Material::White);
    mesh.cuboid(share(0.5, -0.5, 0.08).plus(-0.04, 0.0, 0.0), share(0.5, 0.5, 0.9), Material::Body);
    for side in [-0.5_f32, 0.5] {
        let inner = -side.signum() * 0.04;
        let (y0, y1) = (inner.min(0.0), inner.max(0.0));
        mesh.cuboid(
            share(-0.5, side, 0.08).plus(0.0, y0, 0.0),
            share(0.5, side, 0.9).plus(0.0, y1, 0.0),
            Material::Body,
        );
    }
    mesh.cuboid(share(0.5, -0.5, 1.0).plus(-0.06, 0.0, -0.06), share(0.5, 0.5, 1.0), Material::Metal);
    mesh
}

/// A flat roof over an entrance on two posts, with steps under it.
pub(crate) fn canopy() -> Builder {
    let mut mesh = metric();
    mesh.cuboid(share(-0.5, -0.5, 1.0).plus(0.0, 0.0, -0.22), HIGH, Material::Body);
    for y in [-0.42, 0.42] {
        mesh.tube(
            [share(0.42, y, 0.0), share(0.42, y, 1.0).plus(0.0, 0.0, -0.22)],
            [0.07, 0.07],
            8,
            Material::Metal,
        );
    }
    mesh.cuboid(share(-0.5, -0.4, 0.0), share(0.2, 0.4, 0.0).plus(0.0, 0.0, 0.12), Material::White);
    mesh
}

/// Six columns with a pediment before a front.
pub(crate) fn portico() -> Builder {
    let mut mesh = metric();
    mesh.cuboid(LOW, share(0.5, 0.5, 0.0).plus(0.0, 0.0, 0.35), Material::White);
    for k in 0..6_u8 {
        let y = -0.44 + 0.176 * f32::from(k);
        let foot = share(0.2, y, 0.0).plus(0.0, 0.0, 0.35);
        mesh.tube([foot, share(0.2, y, 0.74)], [0.36, 0.3], 12, Material::White);
        mesh.cuboid(
            share(0.2, y, 0.74).plus(-0.42, -0.42, 0.0),
            share(0.2, y, 0.74).plus(0.42, 0.42, 0.16),
            Material::White,
        );
    }
    mesh.cuboid(share(-0.5, -0.5, 0.76), share(0.42, 0.5, 0.84), Material::White);
    let eave = |x: f32, y: f32| share(x, y, 0.84);
    let ridge = |x: f32| share(x, 0.0, 1.0);
    mesh.quad([eave(0.46, -0.52), eave(0.46, 0.52), ridge(0.46), ridge(0.46)], Material::White);
    mesh.quad([eave(-0.5, -0.52), eave(0.46, -0.52), ridge(0.46), ridge(-0.5)], Material::Second);
    mesh.quad([eave(0.46, 0.52), eave(-0.5, 0.52), ridge(-0.5), ridge(0.46)], Material::Second);
    mesh
}

/// A red cross on white, flat before a wall.
pub(crate) fn cross() -> Builder {
    let mut mesh = metric();
    mesh.cuboid(LOW, share(0.3, 0.5, 1.0), Material::White);
    mesh.cuboid(share(0.3, -0.12, 0.15), share(0.5, 0.12, 0.85), Material::Body);
    mesh.cuboid(share(0.3, -0.35, 0.38), share(0.5, 0.35, 0.62), Material::Body);
    mesh
}

/// A gate of slats with a frame, flat before a wall.
pub(crate) fn gate() -> Builder {
    let mut mesh = metric();
    mesh.cuboid(LOW, share(0.1, 0.5, 1.0), Material::Dark);
    for k in 0..8_u8 {
        let z = f32::from(k) * 0.12 + 0.01;
        mesh.cuboid(share(0.1, -0.46, z), share(0.5, 0.46, z + 0.105), Material::Body);
    }
    mesh
}

/// A tower with a clock and a spire, as high as its box.
pub(crate) fn spire() -> Builder {
    let mut mesh = metric();
    mesh.cuboid(LOW, share(0.5, 0.5, 0.58), Material::Body);
    mesh.cuboid(share(-0.54, -0.54, 0.56), share(0.54, 0.54, 0.6), Material::White);
    let corners = [[0.5, -0.5], [0.5, 0.5], [-0.5, 0.5], [-0.5, -0.5]];
    for k in 0..4 {
        let ([x0, y0], [x1, y1]) = (corners[k], corners[(k + 1) % 4]);
        mesh.quad([share(x0, y0, 0.6), share(x1, y1, 0.6), TOP, TOP], Material::Second);
        let [nx, ny] = [(x0 + x1) * 0.5, (y0 + y1) * 0.5];
        let at = |across: f32, z: f32| {
            share(nx + (x1 - x0) * across, ny + (y1 - y0) * across, z).plus(nx * 0.04, ny * 0.04, 0.0)
        };
        // Louvres and a clock.
        mesh.quad([at(-0.18, 0.36), at(0.18, 0.36), at(0.18, 0.5), at(-0.18, 0.5)], Material::Dark);
        mesh.quad([at(-0.14, 0.24), at(0.14, 0.24), at(0.14, 0.31), at(-0.14, 0.31)], Material::White);
    }
    mesh.tube([TOP.plus(0.0, 0.0, -0.1), TOP.plus(0.0, 0.0, 1.2)], [0.05, 0.05], 5, Material::Metal);
    mesh.tube([TOP.plus(0.0, -0.35, 0.8), TOP.plus(0.0, 0.35, 0.8)], [0.05, 0.05], 5, Material::Metal);
    mesh
}

/// A glazed ridge on a hall's roof.
pub(crate) fn skylight() -> Builder {
    let mut mesh = metric();
    let eave = |x: f32, y: f32| share(x, y, 0.0);
    let ridge = |y: f32| share(0.0, y, 1.0);
    mesh.quad([eave(0.5, -0.5), eave(0.5, 0.5), ridge(0.5), ridge(-0.5)], Material::Glass);
    mesh.quad([eave(-0.5, 0.5), eave(-0.5, -0.5), ridge(-0.5), ridge(0.5)], Material::Glass);
    mesh.quad([eave(-0.5, -0.5), eave(0.5, -0.5), ridge(-0.5), ridge(-0.5)], Material::White);
    mesh.quad([eave(0.5, 0.5), eave(-0.5, 0.5), ridge(0.5), ridge(0.5)], Material::White);
    for k in 0..7_u8 {
        let y = -0.5 + f32::from(k) / 6.0;
        for x in [-0.5, 0.5] {
            mesh.tube([eave(x, y), ridge(y).plus(0.0, 0.0, 0.02)], [0.04, 0.04], 4, Material::White);
        }
    }
    mesh
}

/// A tall stone that ends in a point.
pub(crate) fn obelisk() -> Builder {
    let mut mesh = metric();
    mesh.cuboid(LOW, share(0.5, 0.5, 0.06), Material::Body);
    let ring = |k: f32, z: f32| [[k, -k], [k, k], [-k, k], [-k, -k]].map(|[x, y]| share(x, y, z));
    mesh.hexa(ring(0.36, 0.06), ring(0.24, 0.9), Material::Body);
    mesh.hexa(ring(0.24, 0.9), ring(0.01, 1.0), Material::Body);
    mesh
}

/// A leaf of a door with panels and a handle.
pub(crate) fn door() -> Builder {
    let mut mesh = metric();
    mesh.cuboid(LOW, HIGH, Material::Body);
    for (low, high) in [(0.08, 0.42), (0.5, 0.92)] {
        for y in [-0.4, 0.06] {
            for x in [-0.5, 0.5] {
                let (from, to) = (share(x, y, low), share(x, y + 0.34, high));
                mesh.cuboid(from.plus(-0.008, 0.0, 0.0), to.plus(0.008, 0.0, 0.0), Material::Second);
            }
        }
    }
    let handle = share(0.0, 0.42, 0.48);
    mesh.cuboid(handle.plus(-0.07, -0.1, -0.012), handle.plus(0.07, 0.02, 0.012), Material::Metal);
    mesh
}
