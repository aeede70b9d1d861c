//! What has two wheels, facing +x, and wheels of all sorts. Offsets in metres; those of wheels in radii.

use super::builder::{Builder, Material, P, V3, share, unit};

/// Where a bicycle has its crank and its saddle: ahead and up, m.
pub(crate) const BICYCLE_CRANK: [f64; 2] = [-0.08, 0.3];
pub(crate) const BICYCLE_SADDLE: [f64; 2] = [-0.25, 0.96];
/// How high one stands on a kick scooter, m.
pub(crate) const SCOOTER_DECK: f64 = 0.16;
/// Radii of the wheels of bicycles, motorcycles and scooters, m.
pub(crate) const CYCLE_WHEELS: [f64; 3] = [0.34, 0.31, 0.11];

/// Turned round the y axis.
fn axle([x, y, z]: V3) -> P {
    unit(y, z, x)
}

/// The wheel of a car or lorry, on its axle at the origin: a tyre, and a rim with five holes on both sides.
pub(crate) fn wheel(sides: u32) -> Builder {
    let mut mesh = Builder::new([1.0; 3], 1.0);
    let tyre = [
        [-0.33, 0.66, 0.66, 0.0],
        [-0.33, 0.93, 0.93, 0.0],
        [-0.24, 1.0, 1.0, 0.0],
        [0.24, 1.0, 1.0, 0.0],
        [0.33, 0.93, 0.93, 0.0],
        [0.33, 0.66, 0.66, 0.0],
    ];
    mesh.lathe(&tyre, sides, Material::Rubber, &axle);
    for (side, rings) in [
        (
            1.0_f32,
            [[0.27, 0.68, 0.68, 0.0], [0.3, 0.3, 0.3, 0.0], [0.33, 0.12, 0.12, 0.0], [0.33, 0.0, 0.0, 0.0]],
        ),
        (
            -1.0,
            [
                [-0.33, 0.0, 0.0, 0.0],
                [-0.33, 0.12, 0.12, 0.0],
                [-0.3, 0.3, 0.3, 0.0],
                [-0.27, 0.68, 0.68, 0.0],
            ],
        ),
    ] {
        mesh.lathe(&rings, sides, Material::Metal, &axle);
        if sides > 10 {
            holes(&mut mesh, side);
        }
    }
    mesh
}

/// Dark holes in a rim, by which one sees it turn.
fn holes(mesh: &mut Builder, side: f32) {
    for k in 0..5_u8 {
        let angle = std::f64::consts::TAU * f64::from(k) / 5.0;
        let corner = |turn: f64, radius: f32| {
            let (sin, cos) = simworld_core::ops::sin_cos(angle + turn);
            unit(radius * cos as f32, 0.31 * side, radius * sin as f32)
        };
        let ring = [corner(-0.3, 0.32), corner(-0.42, 0.6), corner(0.42, 0.6), corner(0.3, 0.32)];
        let [a, b, c, d] = ring;
        mesh.quad(if side < 0.0 { [a, b, c, d] } else { [d, c, b, a] }, Material::Dark);
    }
}

/// The wheel of something with two of them: a tyre of that thickness (in radii) on a rim with four pairs of spokes.
pub(crate) fn spoked(thickness: f32) -> Builder {
    let mut mesh = Builder::new([1.0; 3], 1.0);
    let t = thickness;
    let rings = |low: f32, high: f32, half: f32| {
        [
            [-half, low, low, 0.0],
            [-half, high - half, high - half, 0.0],
            [0.0, high, high, 0.0],
            [half, high - half, high - half, 0.0],
            [half, low, low, 0.0],
        ]
    };
    mesh.lathe(&rings(1.0 - 2.0 * t, 1.0, t), 18, Material::Rubber, &axle);
    // The inner face of the tyre and rim, seen from the axle.
    mesh.lathe(
        &[[t, 1.0 - 2.0 * t, 1.0 - 2.0 * t, 0.0], [-t, 1.0 - 2.0 * t, 1.0 - 2.0 * t, 0.0]],
        18,
        Material::Metal,
        &axle,
    );
    for k in 0..4_u8 {
        let (sin, cos) = simworld_core::ops::sin_cos(std::f64::consts::PI * f64::from(k) / 4.0);
        let end = |sign: f32| unit(sign * 0.9 * cos as f32, 0.0, sign * 0.9 * sin as f32);
        mesh.tube([end(-1.0), end(1.0)], [0.02 + t * 0.3; 2], 4, Material::Metal);
    }
    let hub = [unit(0.0, -t * 1.6 - 0.04, 0.0), unit(0.0, t * 1.6 + 0.04, 0.0)];
    mesh.tube(hub, [0.1 + t; 2], 8, Material::Metal);
    mesh
}

pub(crate) fn bicycle() -> Builder {
    let mut mesh = Builder::new([1.75, 0.5, 1.1], 1.0);
    let (front, rear) =
        (share(0.5, 0.0, 0.0).plus(-0.34, 0.0, 0.34), share(-0.5, 0.0, 0.0).plus(0.34, 0.0, 0.34));
    let (crank, seat, head) = (unit(-0.08, 0.0, 0.3), unit(-0.25, 0.0, 0.85), unit(0.4, 0.0, 0.85));
    for ends in [[rear, crank], [rear, seat], [crank, seat], [crank, head], [seat, head], [head, front]] {
        mesh.tube(ends, [0.02, 0.02], 6, Material::Paint);
    }
    let bar = unit(0.38, 0.0, 1.02);
    mesh.tube([head, bar], [0.018, 0.018], 6, Material::Metal);
    mesh.tube([bar.plus(0.0, -0.27, 0.0), bar.plus(0.0, 0.27, 0.0)], [0.018, 0.018], 6, Material::Dark);
    mesh.cuboid(seat.plus(-0.14, -0.07, 0.07), seat.plus(0.12, 0.07, 0.12), Material::Dark);
    mesh.tube([crank.plus(0.0, -0.05, 0.0), crank.plus(0.0, -0.035, 0.0)], [0.1, 0.1], 12, Material::Metal);
    mesh.tube([bar.plus(0.04, 0.0, -0.08), bar.plus(0.09, 0.0, -0.08)], [0.03, 0.04], 8, Material::HeadLight);
    mesh
}

pub(crate) fn motorcycle() -> Builder {
    let mut mesh = Builder::new([2.1, 0.75, 1.15], 1.0);
    let front = share(0.5, 0.0, 0.0).plus(-0.31, 0.0, 0.31);
    let rear = share(-0.5, 0.0, 0.0).plus(0.31, 0.0, 0.31);
    // Engine, tank, seat, tail.
    mesh.cuboid(unit(-0.28, -0.15, 0.24), unit(0.24, 0.15, 0.5), Material::Dark);
    for z in [0.5, 0.56, 0.62] {
        mesh.cuboid(unit(-0.18, -0.13, z), unit(0.16, 0.13, z + 0.035), Material::Metal);
    }
    mesh.ball([unit(0.12, 0.0, 0.74), unit(0.12, 0.0, 0.74)], [0.32, 0.17, 0.16], 8, 12, Material::Paint);
    mesh.tapered(unit(-0.72, -0.14, 0.7), unit(-0.08, 0.14, 0.82), [0.05, 0.03], [Material::Dark; 3]);
    mesh.tapered(unit(-0.86, -0.1, 0.66), unit(-0.5, 0.1, 0.76), [0.06, 0.02], [Material::Paint; 3]);
    mesh.cuboid(unit(-0.89, -0.08, 0.68), unit(-0.85, 0.08, 0.75), Material::TailLight);
    let bar = unit(0.42, 0.0, 1.05);
    for side in [-0.1, 0.1] {
        mesh.tube(
            [front.plus(0.0, side, 0.0), bar.plus(0.0, side, -0.05)],
            [0.035, 0.03],
            6,
            Material::Metal,
        );
        mesh.tube([rear.plus(0.0, side, 0.0), unit(-0.2, side, 0.4)], [0.035, 0.04], 6, Material::Metal);
    }
    mesh.tube([bar.plus(0.0, -0.36, 0.0), bar.plus(0.0, 0.36, 0.0)], [0.02, 0.02], 6, Material::Dark);
    mesh.tube([unit(0.5, 0.0, 0.9), unit(0.6, 0.0, 0.9)], [0.12, 0.1], 12, Material::HeadLight);
    mesh.tapered(unit(0.42, -0.16, 0.92), unit(0.6, 0.16, 1.2), [0.06, 0.04], [Material::Paint; 3]);
    mesh.tube([unit(-0.1, -0.2, 0.3), unit(-0.8, -0.2, 0.36)], [0.04, 0.06], 8, Material::Metal);
    mesh
}

/// An electric kick scooter.
pub(crate) fn scooter() -> Builder {
    let mut mesh = Builder::new([1.1, 0.45, 1.1], 1.0);
    let front = share(0.5, 0.0, 0.0).plus(-0.12, 0.0, 0.11);
    mesh.cuboid(
        share(-0.5, 0.0, 0.0).plus(0.2, -0.08, 0.1),
        share(0.5, 0.0, 0.0).plus(-0.3, 0.08, 0.16),
        Material::Paint,
    );
    mesh.cuboid(
        share(-0.5, 0.0, 0.0).plus(0.22, -0.07, 0.16),
        share(0.5, 0.0, 0.0).plus(-0.34, 0.07, 0.165),
        Material::Dark,
    );
    mesh.cuboid(
        share(-0.5, 0.0, 0.0).plus(0.02, -0.035, 0.2),
        share(-0.5, 0.0, 0.0).plus(0.24, 0.035, 0.23),
        Material::Dark,
    );
    let neck = share(0.5, 0.0, 0.0).plus(-0.2, 0.0, 0.14);
    mesh.tube([neck.plus(-0.12, 0.0, 0.0), front.plus(-0.05, 0.0, 0.14)], [0.03, 0.03], 8, Material::Paint);
    let bar = share(0.5, 0.0, 1.0).plus(-0.3, 0.0, -0.04);
    mesh.tube([front, bar], [0.03, 0.024], 8, Material::Paint);
    mesh.tube([bar.plus(0.0, -0.21, 0.0), bar.plus(0.0, 0.21, 0.0)], [0.02, 0.02], 6, Material::Dark);
    mesh.cuboid(bar.plus(-0.01, -0.04, -0.01), bar.plus(0.05, 0.04, 0.05), Material::Dark);
    mesh.tube([bar.plus(0.02, 0.0, -0.1), bar.plus(0.07, 0.0, -0.1)], [0.025, 0.03], 8, Material::HeadLight);
    mesh
}

/// Something with two wheels of a few pixels, wheels and all.
pub(crate) fn far_cycle() -> Builder {
    let mut mesh = Builder::new([1.75, 0.5, 1.1], 1.0);
    for (x, back) in [(0.5, -0.3), (-0.5, 0.3)] {
        let middle = share(x, 0.0, 0.0).plus(back, 0.0, 0.3);
        mesh.tube(
            [middle.plus(0.0, -0.03, 0.0), middle.plus(0.0, 0.03, 0.0)],
            [0.3, 0.3],
            6,
            Material::Rubber,
        );
    }
    mesh.cuboid(share(-0.3, -0.05, 0.35), share(0.2, 0.05, 0.6), Material::Paint);
    mesh.cuboid(share(0.18, -0.5, 0.85), share(0.24, 0.5, 0.92), Material::Dark);
    mesh
}
