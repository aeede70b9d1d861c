//! Cars, facing +x, without their wheels, which are instances of their own. Their boxes stretch with the solid, what is
//! as large on every car stays so. Offsets in metres.

use super::builder::{Builder, Material, P, share};
use super::primitives::{LOW, TOP};

/// Lamps at the nose and the tail, at a height in m.
pub(super) fn lights(mesh: &mut Builder, height: f32, inset: f32) {
    for side in [-1.0, 1.0] {
        let nose = share(0.5, 0.5 * side, 0.0).plus(-0.06, -inset * side, height);
        mesh.cuboid(nose.plus(-0.06, -0.18, -0.06), nose.plus(0.062, 0.18, 0.06), Material::HeadLight);
        let tail = share(-0.5, 0.5 * side, 0.0).plus(-0.012, -inset * side, height + 0.1);
        mesh.cuboid(tail.plus(0.0, -0.17, -0.07), tail.plus(0.13, 0.17, 0.07), Material::TailLight);
    }
}

/// Number plates, at a height in m.
pub(super) fn plates(mesh: &mut Builder, height: f32) {
    for (x, side) in [(0.5, 1.0), (-0.5, -1.0)] {
        let middle = share(x, 0.0, 0.0).plus(0.012 * side, 0.0, height);
        mesh.cuboid(middle.plus(-0.02, -0.26, -0.055), middle.plus(0.002, 0.26, 0.055), Material::White);
    }
}

/// Dark arches round the wheels of an axle.
pub(super) fn arches(mesh: &mut Builder, at: P, radius: f32) {
    for side in [-1.0, 1.0] {
        let middle = P { a: [at.a[0], 0.5 * side, 0.0], o: [at.o[0], 0.0, radius] };
        let ends = [middle.plus(0.0, -0.1 * side, 0.0), middle.plus(0.0, 0.006 * side, 0.0)];
        mesh.tube(ends, [radius * 1.17; 2], 14, Material::Dark);
    }
}

/// Mirrors at the foot of the windscreen.
fn mirrors(mesh: &mut Builder, at: P) {
    for side in [-1.0, 1.0] {
        let root = P { a: [at.a[0], 0.5 * side, at.a[2]], o: [at.o[0], 0.0, at.o[2]] };
        let (low, high) = if side > 0.0 { (-0.03, 0.1) } else { (-0.1, 0.03) };
        mesh.cuboid(root.plus(-0.05, low, 0.0), root.plus(0.06, high, 0.13), Material::Paint);
    }
}

/// One cross-section of a hull: share of the length, share of the height at its top, share of the width.
pub(super) type Station = [f32; 3];

/// A car along its side: hull and cabin.
struct Profile {
    /// From nose to tail.
    hull: &'static [Station],
    /// Foot and head of the windscreen, then head and foot of the rear window: x shares.
    cabin: [f32; 4],
    /// Where the windows begin: share of the height.
    belt: f32,
    /// How high the floor is, m.
    floor: f32,
    /// How far the roof is drawn in on each side, share of the width.
    draw: f32,
    wheel: f32,
}

/// The corners of a cross-section: floor, sill, shoulder and top, the right side upwards, then the left side downwards.
fn section([x, top, width]: Station, floor: f32) -> [P; 8] {
    let y = 0.5 * width;
    let right = [
        share(x, -y, 0.0).plus(0.0, 0.05, floor),
        share(x, -y, 0.0).plus(0.0, 0.0, floor + 0.14),
        share(x, -y, top).plus(0.0, 0.0, -0.1),
        share(x, -y, top).plus(0.0, 0.1, 0.0),
    ];
    let mirrored = |p: P| P { a: [p.a[0], -p.a[1], p.a[2]], o: [p.o[0], -p.o[1], p.o[2]] };
    let [a, b, c, d] = right;
    [a, b, c, d, mirrored(d), mirrored(c), mirrored(b), mirrored(a)]
}

/// A hull through cross-sections from nose to tail, with a dark sill.
pub(super) fn hull(mesh: &mut Builder, stations: &[Station], floor: f32) {
    for pair in stations.windows(2) {
        let (front, back) = (section(pair[0], floor), section(pair[1], floor));
        for k in 0..8 {
            let next = (k + 1) % 8;
            let material = if matches!(k, 0 | 6 | 7) { Material::Dark } else { Material::Paint };
            mesh.quad([front[k], front[next], back[next], back[k]], material);
        }
    }
    for (station, forward) in [(stations[0], true), (stations[stations.len() - 1], false)] {
        let ring = section(station, floor);
        for (k, material) in [(0, Material::Dark), (1, Material::Paint), (2, Material::Paint)] {
            let corners = [ring[k], ring[7 - k], ring[6 - k], ring[k + 1]];
            let [a, b, c, d] = corners;
            mesh.quad(if forward { [a, b, c, d] } else { [b, a, d, c] }, material);
        }
    }
}

fn car(profile: &Profile) -> Builder {
    let mut mesh = Builder::new([4.5, 1.8, 1.5], 1.0);
    hull(&mut mesh, profile.hull, profile.floor);
    cabin(&mut mesh, profile);
    let nose = profile.hull[0][1];
    mesh.cuboid(
        share(0.5, -0.28, 0.0).plus(-0.03, 0.0, profile.floor + 0.18),
        share(0.5, 0.28, nose).plus(0.012, 0.0, -0.16),
        Material::Dark,
    );
    // The seams of the doors.
    for x in [0.16, -0.06, -0.24] {
        for side in [-0.5, 0.5] {
            let foot = share(x, side, 0.0).plus(0.0, 0.0, profile.floor + 0.16);
            let head = share(x, side, profile.belt).plus(0.0, 0.0, -0.08);
            mesh.cuboid(foot.plus(-0.006, -0.003, 0.0), head.plus(0.006, 0.003, 0.0), Material::Dark);
        }
    }
    for x in [0.31, -0.31] {
        arches(&mut mesh, share(x, 0.0, 0.0), profile.wheel);
    }
    mirrors(&mut mesh, share(profile.cabin[0] - 0.05, 0.0, profile.belt));
    lights(&mut mesh, profile.floor + 0.44, 0.34);
    plates(&mut mesh, profile.floor + 0.22);
    mesh
}

fn cabin(mesh: &mut Builder, profile: &Profile) {
    let [a, b, c, d] = profile.cabin;
    let draw = profile.draw;
    let foot = [[a, -0.5], [a, 0.5], [d, 0.5], [d, -0.5]]
        .map(|[x, y]| share(x, y, profile.belt).plus(0.0, -y * 0.2, -0.02));
    let head =
        [[b, -0.5], [b, 0.5], [c, 0.5], [c, -0.5]].map(|[x, y]| share(x, y * (1.0 - 2.0 * draw), 0.95));
    mesh.hexa(foot, head, Material::Glass);
    let roof = [[b, -0.5], [b, 0.5], [c, 0.5], [c, -0.5]]
        .map(|[x, y]| share(x, y * (1.0 - 2.0 * draw), 1.0).plus(-x.signum() * 0.1, -y * 0.16, 0.0));
    let brim = head.map(|corner| corner.plus(0.0, corner.a[1] * 0.03, 0.0));
    mesh.hexa(brim, roof, Material::Paint);
    pillars(mesh, foot, head);
}

/// Body-coloured posts at the corners and in the middle of a cabin.
fn pillars(mesh: &mut Builder, foot: [P; 4], head: [P; 4]) {
    let half = 0.035;
    let outside = |p: P, grow: f32| p.plus(0.0, p.a[1] * grow, 0.0);
    let blend = |p: P, q: P, t: f32| P {
        a: std::array::from_fn(|i| p.a[i] + (q.a[i] - p.a[i]) * t),
        o: std::array::from_fn(|i| p.o[i] + (q.o[i] - p.o[i]) * t),
    };
    for (front, back) in [(0, 3), (1, 2)] {
        for t in [0.0, 0.52, 1.0] {
            let low = outside(blend(foot[front], foot[back], t), 0.03);
            let high = outside(blend(head[front], head[back], t), 0.03);
            let inwards = -low.a[1].signum() * 0.05;
            let ring = |p: P| {
                let (y0, y1) = if inwards > 0.0 { (0.0, inwards) } else { (inwards, 0.0) };
                [p.plus(half, y0, 0.0), p.plus(half, y1, 0.0), p.plus(-half, y1, 0.0), p.plus(-half, y0, 0.0)]
            };
            mesh.hexa(ring(low), ring(high), Material::Paint);
        }
    }
}

pub(crate) fn sedan() -> Builder {
    car(&Profile {
        hull: &[
            [0.5, 0.42, 0.84],
            [0.47, 0.5, 0.96],
            [0.42, 0.55, 1.0],
            [0.2, 0.62, 1.0],
            [-0.3, 0.64, 1.0],
            [-0.46, 0.63, 0.98],
            [-0.5, 0.56, 0.9],
        ],
        cabin: [0.23, 0.07, -0.2, -0.37],
        belt: 0.62,
        floor: 0.18,
        draw: 0.11,
        wheel: 0.33,
    })
}

pub(crate) fn hatchback() -> Builder {
    car(&Profile {
        hull: &[
            [0.5, 0.42, 0.84],
            [0.46, 0.52, 0.97],
            [0.4, 0.58, 1.0],
            [0.25, 0.63, 1.0],
            [-0.42, 0.65, 1.0],
            [-0.5, 0.58, 0.92],
        ],
        cabin: [0.27, 0.09, -0.36, -0.48],
        belt: 0.63,
        floor: 0.18,
        draw: 0.1,
        wheel: 0.31,
    })
}

pub(crate) fn suv() -> Builder {
    let mut mesh = car(&Profile {
        hull: &[
            [0.5, 0.44, 0.9],
            [0.47, 0.54, 0.98],
            [0.4, 0.6, 1.0],
            [0.24, 0.63, 1.0],
            [-0.46, 0.65, 1.0],
            [-0.5, 0.6, 0.95],
        ],
        cabin: [0.25, 0.13, -0.42, -0.49],
        belt: 0.63,
        floor: 0.26,
        draw: 0.07,
        wheel: 0.37,
    });
    for side in [-1.0, 1.0] {
        let rail = TOP.plus(0.0, 0.0, 0.02);
        let end = |x: f32| P { a: [x, 0.36 * side, 1.0], o: rail.o };
        mesh.tube([end(-0.36), end(0.06)], [0.02, 0.02], 5, Material::Metal);
    }
    mesh
}

pub(crate) fn estate() -> Builder {
    car(&Profile {
        hull: &[
            [0.5, 0.42, 0.84],
            [0.47, 0.51, 0.96],
            [0.41, 0.56, 1.0],
            [0.22, 0.62, 1.0],
            [-0.46, 0.64, 1.0],
            [-0.5, 0.58, 0.94],
        ],
        cabin: [0.24, 0.08, -0.43, -0.49],
        belt: 0.62,
        floor: 0.18,
        draw: 0.1,
        wheel: 0.33,
    })
}

pub(crate) fn sports() -> Builder {
    let mut mesh = car(&Profile {
        hull: &[
            [0.5, 0.34, 0.8],
            [0.46, 0.44, 0.96],
            [0.36, 0.55, 1.0],
            [0.16, 0.62, 1.0],
            [-0.2, 0.66, 1.0],
            [-0.44, 0.7, 1.0],
            [-0.5, 0.62, 0.93],
        ],
        cabin: [0.16, -0.04, -0.18, -0.38],
        belt: 0.63,
        floor: 0.12,
        draw: 0.13,
        wheel: 0.34,
    });
    let wing = share(-0.5, 0.0, 0.7);
    mesh.cuboid(wing.plus(0.0, -0.7, 0.13), wing.plus(0.28, 0.7, 0.16), Material::Paint);
    for side in [-1.0, 1.0] {
        let post = wing.plus(0.15, 0.5 * side, 0.0);
        mesh.cuboid(post.plus(-0.04, -0.02, -0.05), post.plus(0.04, 0.02, 0.14), Material::Dark);
    }
    mesh
}

/// A cab for two rows before an open bed.
pub(crate) fn pickup() -> Builder {
    let mut mesh = car(&Profile {
        hull: &[
            [0.5, 0.44, 0.92],
            [0.47, 0.55, 1.0],
            [0.25, 0.6, 1.0],
            [-0.12, 0.61, 1.0],
            [-0.14, 0.46, 1.0],
            [-0.5, 0.46, 1.0],
        ],
        cabin: [0.24, 0.14, -0.08, -0.13],
        belt: 0.6,
        floor: 0.3,
        draw: 0.08,
        wheel: 0.38,
    });
    let wall = |mesh: &mut Builder, low: P, high: P| mesh.cuboid(low, high, Material::Paint);
    for side in [-1.0_f32, 1.0] {
        let (inner, outer) = (0.44 * side, 0.5 * side);
        let (y0, y1) = (inner.min(outer), inner.max(outer));
        wall(&mut mesh, share(-0.5, y0, 0.4), share(-0.14, y1, 0.6));
    }
    wall(&mut mesh, share(-0.5, -0.44, 0.4), share(-0.485, 0.44, 0.6));
    mesh.cuboid(share(-0.484, -0.44, 0.45), share(-0.145, 0.44, 0.468), Material::Dark);
    mesh
}

/// A car of a few pixels, wheels and all.
pub(crate) fn far_car() -> Builder {
    let mut mesh = Builder::new([4.5, 1.8, 1.5], 1.0);
    let ring = |x0: f32, x1: f32, y: f32, z: f32| {
        [[x1, -y], [x1, y], [x0, y], [x0, -y]].map(|[x, y]| share(x, y, z))
    };
    mesh.hexa(ring(-0.5, 0.5, 0.48, 0.16), ring(-0.49, 0.46, 0.5, 0.6), Material::Paint);
    mesh.hexa(ring(-0.44, 0.24, 0.46, 0.6), ring(-0.32, 0.08, 0.4, 0.96), Material::Glass);
    mesh.quad(ring(-0.32, 0.08, 0.4, 0.97), Material::Paint);
    for x in [0.31_f32, -0.31] {
        mesh.cuboid(share(x - 0.07, -0.5, 0.0), share(x + 0.07, 0.5, 0.42), Material::Dark);
    }
    lights(&mut mesh, 0.62, 0.34);
    mesh
}

/// The lit sign on a taxi.
pub(crate) fn taxi_sign() -> Builder {
    let mut mesh = Builder::new([4.5, 1.8, 1.5], 1.0);
    mesh.tapered(
        TOP.plus(-0.2, -0.28, -0.02),
        TOP.plus(-0.05, 0.28, 0.14),
        [0.03, 0.03],
        [Material::LampGlow; 3],
    );
    mesh
}

/// A bar of blue lamps on the roof.
pub(crate) fn light_bar() -> Builder {
    let mut mesh = Builder::new([4.5, 1.8, 1.5], 1.0);
    mesh.cuboid(TOP.plus(-0.15, -0.12, -0.02), TOP.plus(0.1, 0.12, 0.1), Material::Dark);
    for side in [-1.0_f32, 1.0] {
        let (low, high) = if side > 0.0 { (0.12, 0.6) } else { (-0.6, -0.12) };
        mesh.tapered(
            TOP.plus(-0.15, low, -0.02),
            TOP.plus(0.1, high, 0.12),
            [0.03, 0.03],
            [Material::Paint; 3],
        );
    }
    mesh
}

/// A band of the second colour along both sides.
pub(crate) fn stripe() -> Builder {
    let mut mesh = Builder::new([5.0, 2.0, 2.0], 1.0);
    for side in [-0.5, 0.5] {
        let (low, high) = (share(-0.48, side, 0.36), share(0.44, side, 0.46));
        mesh.cuboid(low.plus(0.0, -0.008, 0.0), high.plus(0.0, 0.008, 0.0), Material::Paint);
    }
    mesh
}

/// What stands below a hull of any length, dark.
pub(super) fn chassis(mesh: &mut Builder, low: f32, high: f32) {
    mesh.cuboid(LOW.plus(0.1, 0.14, low), share(0.5, 0.5, 0.0).plus(-0.1, -0.14, high), Material::Dark);
}
