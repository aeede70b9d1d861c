//! Things of streets, parks and building sites, fitted to their boxes. Offsets in metres; what faces somebody faces +x.

use simworld_core::ops;

use super::builder::{Builder, Material, P, Ring, V3, share};
use super::primitives::{BOTTOM, HIGH, LOW, TOP};

pub(super) fn metric() -> Builder {
    Builder::new([1.0; 3], 1.0)
}

/// A turned thing whose rings are shares of its box: height and radius, and the material from each ring on.
pub(super) fn turned(rings: &[(f32, f32, Material)]) -> Builder {
    let mut mesh = metric();
    for pair in rings.windows(2) {
        let ((low, r0, material), (high, r1, _)) = (pair[0], pair[1]);
        let place = |[x, y, z]: V3| share(x, y, z);
        mesh.lathe(&[[low, r0, r0, 0.0], [high, r1, r1, 0.0]], 14, material, &place);
    }
    mesh
}

/// A wall of posts and rails along y.
fn rails(mesh: &mut Builder, posts: u8, heights: &[f32], thick: f32, material: Material) {
    for k in 0..posts {
        let y = -0.5 + f32::from(k) / f32::from(posts - 1);
        let inset = -thick * y * 2.0;
        let foot = share(0.0, y, 0.0).plus(0.0, inset, 0.0);
        mesh.cuboid(
            foot.plus(-thick, -thick, 0.0),
            share(0.0, y, 1.0).plus(thick, inset + thick, 0.0),
            material,
        );
    }
    for z in heights {
        mesh.cuboid(
            share(0.0, -0.5, *z).plus(-thick * 0.8, 0.0, -thick),
            share(0.0, 0.5, *z).plus(thick * 0.8, 0.0, thick),
            material,
        );
    }
}

pub(crate) fn bollard() -> Builder {
    turned(&[
        (0.0, 0.0, Material::Body),
        (0.0, 0.5, Material::Body),
        (0.08, 0.5, Material::Body),
        (0.1, 0.4, Material::Body),
        (0.78, 0.4, Material::White),
        (0.86, 0.4, Material::Body),
        (0.95, 0.4, Material::Body),
        (1.0, 0.2, Material::Body),
        (1.0, 0.0, Material::Body),
    ])
}

pub(crate) fn barrel() -> Builder {
    turned(&[
        (0.0, 0.0, Material::Body),
        (0.0, 0.46, Material::Body),
        (0.3, 0.49, Material::Metal),
        (0.34, 0.5, Material::Body),
        (0.64, 0.5, Material::Metal),
        (0.68, 0.49, Material::Body),
        (0.98, 0.46, Material::Dark),
        (1.0, 0.44, Material::Dark),
        (1.0, 0.0, Material::Dark),
    ])
}

pub(crate) fn planter() -> Builder {
    let mut mesh = metric();
    mesh.tapered(LOW, share(0.5, 0.5, 0.72), [-0.03, -0.03], [Material::Body; 3]);
    for (x, y, r) in [(0.0, -0.3, 0.2), (0.05, 0.0, 0.23), (-0.04, 0.3, 0.2)] {
        let at = share(x, y, 0.78);
        mesh.ball([at, at], [r, r, r * 0.9], 5, 8, Material::Leaf);
    }
    mesh
}

pub(crate) fn picket_fence() -> Builder {
    let mut mesh = metric();
    rails(&mut mesh, 3, &[0.3, 0.75], 0.03, Material::Body);
    for k in 0..16_u8 {
        let y = -0.48 + 0.064 * f32::from(k);
        mesh.cuboid(share(0.3, y - 0.018, 0.05), share(0.5, y + 0.018, 0.95), Material::Body);
    }
    mesh
}

pub(crate) fn railing() -> Builder {
    let mut mesh = metric();
    rails(&mut mesh, 2, &[0.08, 0.97], 0.025, Material::Body);
    for k in 0..15_u8 {
        let y = -0.45 + 0.0643 * f32::from(k);
        mesh.tube([share(0.0, y, 0.08), share(0.0, y, 0.97)], [0.012, 0.012], 4, Material::Body);
    }
    mesh
}

/// Mesh between posts on feet, for building sites and crowds.
pub(crate) fn site_fence() -> Builder {
    let mut mesh = metric();
    rails(&mut mesh, 2, &[0.12, 0.98], 0.02, Material::Body);
    for k in 0..12_u8 {
        let y = -0.46 + 0.0836 * f32::from(k);
        mesh.tube([share(0.0, y, 0.12), share(0.0, y, 0.98)], [0.008, 0.008], 4, Material::Body);
    }
    for z in [0.33, 0.54, 0.76] {
        mesh.tube([share(0.0, -0.5, z), share(0.0, 0.5, z)], [0.008, 0.008], 4, Material::Body);
    }
    for y in [-0.42, 0.42] {
        mesh.cuboid(
            share(-0.5, y, 0.0).plus(0.0, -0.06, 0.0),
            share(0.5, y, 0.0).plus(0.0, 0.06, 0.08),
            Material::Dark,
        );
    }
    mesh
}

/// Red and white boards on two legs.
pub(crate) fn barricade() -> Builder {
    let mut mesh = metric();
    for z in [0.45, 0.78] {
        for k in 0..6_u8 {
            let y = -0.5 + f32::from(k) / 6.0;
            let material = if k % 2 == 0 { Material::Body } else { Material::White };
            mesh.cuboid(share(-0.06, y, z), share(0.06, y + 1.0 / 6.0, z + 0.2), material);
        }
    }
    for y in [-0.4, 0.4] {
        for x in [-0.5, 0.5] {
            mesh.tube([share(x, y, 0.0), share(0.0, y, 1.0)], [0.025, 0.025], 4, Material::Dark);
        }
    }
    mesh
}

/// The profile of a concrete barrier.
pub(crate) fn jersey() -> Builder {
    let mut mesh = metric();
    let ring = |x: f32, z: f32| [[x, -0.5], [x, 0.5], [-x, 0.5], [-x, -0.5]].map(|[x, y]| share(x, y, z));
    for [(x0, z0), (x1, z1)] in
        [[(0.5, 0.0), (0.5, 0.1)], [(0.5, 0.1), (0.2, 0.4)], [(0.2, 0.4), (0.13, 1.0)]]
    {
        mesh.hexa(ring(x0, z0), ring(x1, z1), Material::Body);
    }
    mesh
}

/// A stand with a counter, a roof and goods.
pub(crate) fn kiosk() -> Builder {
    let mut mesh = metric();
    mesh.cuboid(share(-0.5, -0.46, 0.0), share(0.3, 0.46, 0.38), Material::Body);
    mesh.cuboid(share(-0.5, -0.46, 0.38), share(-0.42, 0.46, 0.9), Material::Body);
    for side in [-0.46_f32, 0.42] {
        mesh.cuboid(share(-0.5, side, 0.38), share(0.26, side + 0.04, 0.9), Material::Body);
    }
    mesh.cuboid(share(-0.1, -0.46, 0.38), share(0.38, 0.46, 0.42), Material::White);
    mesh.cuboid(share(-0.5, -0.5, 0.9), share(0.5, 0.5, 1.0), Material::Body);
    mesh.cuboid(
        share(0.5, -0.46, 0.915).plus(0.0, 0.0, 0.0),
        share(0.5, 0.46, 0.985).plus(0.02, 0.0, 0.0),
        Material::White,
    );
    for k in 0..6_u8 {
        let y = -0.4 + 0.15 * f32::from(k);
        let material = [Material::Second, Material::White, Material::Wood][usize::from(k % 3)];
        mesh.cuboid(share(0.02, y, 0.42), share(0.24, y + 0.11, 0.5), material);
        mesh.cuboid(share(-0.42, y, 0.56), share(-0.36, y + 0.11, 0.78), material);
    }
    mesh
}

/// A market stall: trestles under a striped roof.
pub(crate) fn stall() -> Builder {
    let mut mesh = metric();
    for [x, y] in [[0.42, 0.46], [0.42, -0.46], [-0.42, 0.46], [-0.42, -0.46]] {
        mesh.tube([share(x, y, 0.0), share(x, y, 0.84)], [0.03, 0.03], 5, Material::Wood);
    }
    mesh.cuboid(share(-0.3, -0.46, 0.3), share(0.42, 0.46, 0.35), Material::Wood);
    for k in 0..8_u8 {
        let (y0, y1) = (-0.5 + 0.125 * f32::from(k), -0.375 + 0.125 * f32::from(k));
        let material = if k % 2 == 0 { Material::Body } else { Material::White };
        let ring = [share(0.5, y0, 0.8), share(0.5, y1, 0.8), share(-0.5, y1, 0.8), share(-0.5, y0, 0.8)];
        let top = [share(0.04, y0, 1.0), share(0.04, y1, 1.0), share(-0.04, y1, 1.0), share(-0.04, y0, 1.0)];
        mesh.hexa(ring, top, material);
        let heap = share(0.05, (y0 + y1) * 0.5, 0.35);
        let goods = [Material::Leaf, Material::Second, Material::Wood][usize::from(k % 3)];
        mesh.ball([heap, heap], [0.22, 0.14, 0.14], 4, 8, goods);
    }
    mesh
}

/// A parasol on a foot.
pub(crate) fn parasol() -> Builder {
    let mut mesh = metric();
    mesh.tube([BOTTOM, TOP.plus(0.0, 0.0, -0.05)], [0.03, 0.025], 6, Material::Wood);
    mesh.tube([BOTTOM, BOTTOM.plus(0.0, 0.0, 0.1)], [0.3, 0.28], 12, Material::Dark);
    let place = |[x, y, z]: V3| share(x, y, z);
    mesh.lathe(
        &[[0.8, 0.5, 0.5, 0.0], [0.96, 0.12, 0.12, 0.0], [1.0, 0.0, 0.0, 0.0]],
        12,
        Material::Body,
        &place,
    );
    mesh.lathe(&[[0.79, 0.0, 0.0, 0.0], [0.795, 0.5, 0.5, 0.0]], 12, Material::White, &place);
    mesh
}

/// A cabinet with doors: utility boxes, lockers, machines, toilets.
pub(crate) fn cabinet() -> Builder {
    let mut mesh = metric();
    mesh.cuboid(LOW.plus(0.03, 0.03, 0.0), share(0.5, 0.5, 0.06).plus(-0.03, -0.03, 0.0), Material::Dark);
    mesh.cuboid(share(-0.5, -0.5, 0.06), share(0.5, 0.5, 0.96), Material::Body);
    mesh.cuboid(share(-0.5, -0.5, 0.96).plus(-0.02, -0.02, 0.0), HIGH.plus(0.02, 0.02, 0.0), Material::Body);
    mesh.cuboid(share(0.5, -0.008, 0.1), share(0.5, 0.008, 0.93).plus(0.006, 0.0, 0.0), Material::Dark);
    for z in [0.7, 0.76, 0.82] {
        mesh.cuboid(share(0.5, 0.12, z), share(0.5, 0.4, z + 0.03).plus(0.006, 0.0, 0.0), Material::Dark);
    }
    mesh.cuboid(share(0.5, 0.04, 0.45), share(0.5, 0.08, 0.55).plus(0.02, 0.0, 0.0), Material::Metal);
    mesh
}

/// A machine with a lit front and a slot.
pub(crate) fn machine() -> Builder {
    let mut mesh = metric();
    mesh.cuboid(LOW, HIGH, Material::Body);
    mesh.cuboid(share(0.5, -0.42, 0.4), share(0.5, 0.18, 0.92).plus(0.012, 0.0, 0.0), Material::LampGlow);
    for z in [0.5, 0.63, 0.76] {
        mesh.cuboid(share(0.5, -0.42, z), share(0.5, 0.18, z + 0.03).plus(0.02, 0.0, 0.0), Material::Dark);
    }
    mesh.cuboid(share(0.5, 0.24, 0.5), share(0.5, 0.42, 0.85).plus(0.012, 0.0, 0.0), Material::Dark);
    mesh.cuboid(share(0.5, -0.35, 0.12), share(0.5, 0.12, 0.26).plus(0.012, 0.0, 0.0), Material::Dark);
    mesh
}

/// A glazed booth.
pub(crate) fn booth() -> Builder {
    let mut mesh = metric();
    mesh.cuboid(LOW, share(0.5, 0.5, 0.05), Material::Body);
    mesh.cuboid(share(-0.5, -0.5, 0.86), HIGH, Material::Body);
    mesh.cuboid(share(-0.44, -0.44, 0.05), share(0.44, 0.44, 0.86), Material::Glass);
    for [x, y] in [[0.5_f32, 0.5_f32], [0.5, -0.5], [-0.5, 0.5], [-0.5, -0.5]] {
        let (dx, dy) = (-x.signum() * 0.1, -y.signum() * 0.1);
        let (low, high) = (share(x, y, 0.05), share(x, y, 0.86));
        mesh.cuboid(
            low.plus(dx.min(0.0), dy.min(0.0), 0.0),
            high.plus(dx.max(0.0), dy.max(0.0), 0.0),
            Material::Body,
        );
    }
    for z in [0.28, 0.5, 0.7] {
        mesh.cuboid(share(-0.47, -0.47, z), share(0.47, 0.47, z).plus(0.0, 0.0, 0.04), Material::Body);
    }
    mesh
}

/// Hoops to lock bicycles to.
pub(crate) fn rack() -> Builder {
    let mut mesh = metric();
    for k in 0..4_u8 {
        let y = -0.42 + 0.28 * f32::from(k);
        let (a, b) = (share(-0.42, y, 0.0), share(0.42, y, 0.0));
        let (c, d) = (share(-0.42, y, 0.96), share(0.42, y, 0.96));
        for ends in [[a, c], [b, d], [c, d]] {
            mesh.tube(ends, [0.025, 0.025], 6, Material::Metal);
        }
    }
    mesh
}

/// A basin with a column and water.
pub(crate) fn fountain() -> Builder {
    let mut mesh = turned(&[
        (0.0, 0.0, Material::Body),
        (0.0, 0.5, Material::Body),
        (0.2, 0.5, Material::Body),
        (0.22, 0.44, Material::Body),
        (0.14, 0.43, Material::Glass),
    ]);
    let place = |[x, y, z]: V3| share(x, y, z);
    mesh.lathe(&[[0.14, 0.43, 0.43, 0.0], [0.145, 0.0, 0.0, 0.0]], 18, Material::Glass, &place);
    mesh.lathe(
        &[
            [0.1, 0.1, 0.1, 0.0],
            [0.5, 0.06, 0.06, 0.0],
            [0.55, 0.2, 0.2, 0.0],
            [0.6, 0.2, 0.2, 0.0],
            [0.6, 0.05, 0.05, 0.0],
            [0.85, 0.03, 0.03, 0.0],
            [1.0, 0.0, 0.0, 0.0],
        ],
        14,
        Material::Body,
        &place,
    );
    mesh
}

/// Somebody of stone on a pedestal.
pub(crate) fn statue() -> Builder {
    let mut mesh = metric();
    mesh.cuboid(LOW, share(0.5, 0.5, 0.08), Material::Body);
    mesh.tapered(share(-0.36, -0.36, 0.08), share(0.36, 0.36, 0.44), [0.04, 0.04], [Material::Body; 3]);
    mesh.cuboid(share(-0.4, -0.4, 0.44), share(0.4, 0.4, 0.48), Material::Body);
    let place = |[x, y, z]: V3| share(x, y, z);
    mesh.lathe(
        &[
            [0.48, 0.16, 0.2, 0.0],
            [0.62, 0.12, 0.15, 0.0],
            [0.74, 0.12, 0.17, 0.0],
            [0.86, 0.12, 0.2, 0.0],
            [0.9, 0.05, 0.06, 0.0],
            [0.91, 0.0, 0.0, 0.0],
        ],
        10,
        Material::Body,
        &place,
    );
    let head = share(0.0, 0.0, 0.955);
    mesh.ball([head, head], [0.12, 0.1, 0.15], 6, 8, Material::Body);
    mesh.tube([share(0.0, -0.18, 0.85), share(0.25, -0.22, 0.72)], [0.07, 0.05], 6, Material::Body);
    mesh.tube([share(0.0, 0.18, 0.85), share(0.1, 0.24, 0.64)], [0.07, 0.05], 6, Material::Body);
    mesh
}

/// A box of ribbed steel with doors.
pub(crate) fn container() -> Builder {
    let mut mesh = metric();
    mesh.cuboid(LOW, HIGH, Material::Body);
    for k in 0..18_u8 {
        let x = -0.48 + 0.0565 * f32::from(k);
        for side in [-0.5, 0.5] {
            mesh.cuboid(
                share(x, side, 0.05).plus(0.0, -0.025, 0.0),
                share(x + 0.028, side, 0.95).plus(0.0, 0.025, 0.0),
                Material::Body,
            );
        }
    }
    for y in [-0.3, -0.12, 0.12, 0.3] {
        mesh.tube(
            [share(0.5, y, 0.03).plus(0.03, 0.0, 0.0), share(0.5, y, 0.97).plus(0.03, 0.0, 0.0)],
            [0.02, 0.02],
            5,
            Material::Metal,
        );
    }
    mesh
}

/// A crate of boards, and pallets.
pub(crate) fn crate_of_boards() -> Builder {
    let mut mesh = metric();
    for k in 0..4_u8 {
        let z = 0.25 * f32::from(k);
        mesh.cuboid(share(-0.5, -0.5, z + 0.015), share(0.5, 0.5, z + 0.235), Material::Body);
    }
    mesh.cuboid(share(-0.46, -0.46, 0.0), share(0.46, 0.46, 0.97), Material::Dark);
    for [x, y] in [[0.45, 0.45], [0.45, -0.45], [-0.45, 0.45], [-0.45, -0.45]] {
        mesh.cuboid(share(x - 0.06, y - 0.06, 0.0), share(x + 0.06, y + 0.06, 1.0), Material::Body);
    }
    mesh
}

/// A heap of sand, gravel or rubbish.
pub(crate) fn heap() -> Builder {
    let mut mesh = metric();
    let place = |[x, y, z]: V3| share(x, y, z);
    mesh.lathe(
        &[[0.0, 0.5, 0.5, 0.0], [0.35, 0.36, 0.34, 0.02], [0.75, 0.14, 0.16, -0.02], [1.0, 0.0, 0.0, 0.0]],
        13,
        Material::Body,
        &place,
    );
    mesh
}

/// A tent with two slopes and dark ends.
pub(crate) fn tent() -> Builder {
    let mut mesh = metric();
    let foot = |x: f32, y: f32| share(0.5 * x, 0.5 * y, 0.0);
    let ridge = |x: f32| share(0.5 * x, 0.0, 1.0);
    mesh.quad([foot(-1.0, -1.0), foot(1.0, -1.0), ridge(1.0), ridge(-1.0)], Material::Body);
    mesh.quad([foot(1.0, 1.0), foot(-1.0, 1.0), ridge(-1.0), ridge(1.0)], Material::Body);
    mesh.quad([foot(1.0, -1.0), foot(1.0, 1.0), ridge(1.0), ridge(1.0)], Material::Dark);
    mesh.quad([foot(-1.0, 1.0), foot(-1.0, -1.0), ridge(-1.0), ridge(-1.0)], Material::Body);
    mesh
}

/// A roof on posts: pavilions, bandstands, stages with a roof.
pub(crate) fn pavilion() -> Builder {
    let mut mesh = metric();
    mesh.cuboid(LOW, share(0.5, 0.5, 0.05), Material::Body);
    for [x, y] in [[0.44, 0.44], [0.44, -0.44], [-0.44, 0.44], [-0.44, -0.44]] {
        mesh.tube([share(x, y, 0.05), share(x, y, 0.72)], [0.07, 0.07], 8, Material::Body);
    }
    let corners = [[0.5, -0.5], [0.5, 0.5], [-0.5, 0.5], [-0.5, -0.5]];
    let ring = corners.map(|[x, y]| share(x, y, 0.72));
    let top = corners.map(|[x, y]| share(x * 0.02, y * 0.02, 1.0));
    mesh.hexa(ring, top, Material::Second);
    mesh
}

/// Bars of a frame: goals, swings, climbing frames, scaffolds.
pub(crate) fn frame() -> Builder {
    let mut mesh = metric();
    let corners = [[0.47, 0.47], [0.47, -0.47], [-0.47, -0.47], [-0.47, 0.47]];
    for k in 0..4 {
        let ([x, y], [u, v]) = (corners[k], corners[(k + 1) % 4]);
        mesh.tube([share(x, y, 0.0), share(x, y, 1.0)], [0.035, 0.035], 6, Material::Body);
        for z in [0.5, 0.98] {
            mesh.tube([share(x, y, z), share(u, v, z)], [0.03, 0.03], 6, Material::Body);
        }
    }
    mesh.tube([share(-0.47, -0.47, 0.0), share(-0.47, 0.47, 0.98)], [0.02, 0.02], 5, Material::Body);
    mesh
}

/// An open boat.
pub(crate) fn boat() -> Builder {
    let mut mesh = metric();
    let ring = |z: f32, k: f32| {
        [[0.3, -0.5], [0.3, 0.5], [-0.46, 0.42], [-0.46, -0.42]].map(|[x, y]| share(x * k, y * k, z))
    };
    mesh.hexa(ring(0.0, 0.6), ring(0.9, 1.0), Material::Body);
    let bow = [share(0.18, -0.3, 0.0), share(0.3, 0.0, 0.0), share(0.18, 0.3, 0.0), share(0.15, 0.0, 0.0)];
    let stem = [share(0.3, -0.5, 0.9), share(0.5, 0.0, 1.0), share(0.3, 0.5, 0.9), share(0.28, 0.0, 0.9)];
    mesh.hexa(bow, stem, Material::Body);
    for x in [-0.25, 0.05] {
        mesh.cuboid(share(x, -0.45, 0.9), share(x + 0.08, 0.45, 0.96), Material::Wood);
    }
    mesh
}

/// A ball with seams round its middle and from pole to pole.
pub(crate) fn ball() -> Builder {
    let mut mesh = metric();
    let place = |[x, y, z]: V3| share(x, y, z);
    let standing = |[x, y, z]: V3| share(z - 0.5, x, y + 0.5);
    let ring = |k: u8| -> Ring {
        let (sin, cos) = ops::sin_cos(std::f64::consts::PI * f64::from(k) / 12.0);
        let radius = if k == 0 || k == 12 { 0.0 } else { 0.494 * sin as f32 };
        [0.5 - 0.494 * cos as f32, radius, radius, 0.0]
    };
    let rings: Vec<Ring> = (0..=12).map(ring).collect();
    mesh.lathe(&rings, 16, Material::Body, &place);
    // The seams are bands that stand out of it by a hair.
    for seam in [&place as &dyn Fn(V3) -> P, &standing] {
        let band =
            [[0.488, 0.0, 0.0, 0.0], [0.488, 0.5, 0.5, 0.0], [0.512, 0.5, 0.5, 0.0], [0.512, 0.0, 0.0, 0.0]];
        mesh.lathe(&band, 16, Material::Dark, seam);
    }
    mesh
}
