//! Vehicles, facing +x. Their boxes stretch with the solid, wheels stay round. Offsets in metres.

use super::builder::{Builder, Material, P, share, unit};
use super::primitives::{HIGH, LOW};

/// Two wheels on an axle at `x` (share of the length plus metres).
fn axle(mesh: &mut Builder, at: P, radius: f32, width: f32) {
    for side in [-1.0, 1.0] {
        let outer = P { a: [at.a[0], 0.5 * side, 0.0], o: [at.o[0], -0.02 * side, radius] };
        let inner = outer.plus(0.0, -width * side, 0.0);
        let rim = outer.plus(0.0, 0.012 * side, 0.0);
        mesh.tube([inner, outer], [radius, radius], 18, Material::Rubber);
        mesh.tube([outer, rim], [radius * 0.62, radius * 0.5], 12, Material::Metal);
    }
}

/// Lamps at the nose and the tail, at a height in m.
fn lights(mesh: &mut Builder, height: f32, inset: f32) {
    for side in [-1.0, 1.0] {
        let nose = share(0.5, 0.5 * side, 0.0).plus(-0.06, -inset * side, height);
        mesh.cuboid(nose.plus(0.0, -0.17, -0.07), nose.plus(0.075, 0.17, 0.07), Material::HeadLight);
        let tail = share(-0.5, 0.5 * side, 0.0).plus(-0.015, -inset * side, height + 0.08);
        mesh.cuboid(tail.plus(0.0, -0.16, -0.07), tail.plus(0.075, 0.16, 0.07), Material::TailLight);
    }
}

/// The body of a car along its side: (share of length, height share), with the cabin between two stations.
struct Profile {
    /// Stations of the hull from nose to tail: x share and height share of the top.
    hull: [(f32, f32); 5],
    /// Foot and head of the windscreen, then head and foot of the rear window: x shares.
    cabin: [f32; 4],
}

fn car(profile: &Profile) -> Builder {
    let mut mesh = Builder::new([4.5, 1.8, 1.5], 1.0);
    let floor = 0.2;
    let ring = |x: f32, tuck: f32, z: P| {
        let y = 0.5;
        [P { a: [x, -y, z.a[2]], o: [0.0, tuck, z.o[2]] }, P { a: [x, y, z.a[2]], o: [0.0, -tuck, z.o[2]] }]
    };
    let low = unit(0.0, 0.0, floor);
    for pair in profile.hull.windows(2) {
        let ((x0, z0), (x1, z1)) = (pair[0], pair[1]);
        let [b0, b1] = ring(x0, 0.03, low);
        let [b3, b2] = ring(x1, 0.03, low);
        let [t0, t1] = ring(x0, 0.05, share(0.0, 0.0, z0));
        let [t3, t2] = ring(x1, 0.05, share(0.0, 0.0, z1));
        mesh.hexa([b0, b1, b2, b3], [t0, t1, t2, t3], Material::Body);
    }
    // A dark sill and bumpers below the hull.
    mesh.cuboid(
        LOW.plus(0.05, 0.06, floor - 0.05),
        share(0.5, 0.5, 0.0).plus(-0.05, -0.06, floor + 0.02),
        Material::Dark,
    );
    let [a, b, c, d] = profile.cabin;
    let belt = 0.6;
    let foot =
        [[a, -0.5], [a, 0.5], [d, 0.5], [d, -0.5]].map(|[x, y]| share(x, y, belt).plus(0.0, -y * 0.16, 0.0));
    let head =
        [[b, -0.5], [b, 0.5], [c, 0.5], [c, -0.5]].map(|[x, y]| share(x, y, 0.95).plus(0.0, -y * 0.52, 0.0));
    mesh.hexa(foot, head, Material::Glass);
    let roof = [[b, -0.5], [b, 0.5], [c, 0.5], [c, -0.5]]
        .map(|[x, y]| share(x, y, 1.0).plus(-x * 0.3, -y * 0.62, 0.0));
    let brim = head.map(|corner| corner.plus(0.0, corner.a[1] * 0.02, 0.0));
    mesh.hexa(brim, roof, Material::Body);
    pillars(&mut mesh, foot, head);
    for x in [0.31, -0.31] {
        axle(&mut mesh, share(x, 0.0, 0.0), 0.33, 0.22);
    }
    lights(&mut mesh, 0.62, 0.3);
    mesh
}

/// Body-coloured posts at the corners and in the middle of the cabin.
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
            mesh.hexa(ring(low), ring(high), Material::Body);
        }
    }
}

pub(crate) fn sedan() -> Builder {
    car(&Profile {
        hull: [(0.5, 0.48), (0.44, 0.56), (0.2, 0.62), (-0.36, 0.63), (-0.5, 0.6)],
        cabin: [0.23, 0.08, -0.2, -0.38],
    })
}

pub(crate) fn hatchback() -> Builder {
    car(&Profile {
        hull: [(0.5, 0.46), (0.45, 0.56), (0.24, 0.63), (-0.42, 0.64), (-0.5, 0.58)],
        cabin: [0.27, 0.1, -0.34, -0.47],
    })
}

pub(crate) fn bus() -> Builder {
    let mut mesh = Builder::new([11.0, 2.5, 3.0], 1.0);
    mesh.cuboid(LOW.plus(0.0, 0.0, 0.3), HIGH.plus(0.0, 0.0, -0.12), Material::Body);
    mesh.cuboid(
        LOW.plus(0.3, 0.2, 0.0).plus(0.0, 0.0, 0.2),
        share(0.5, 0.5, 0.0).plus(-0.3, -0.2, 0.32),
        Material::Dark,
    );
    mesh.cuboid(share(-0.5, -0.5, 1.0).plus(0.6, 0.3, -0.12), HIGH.plus(-0.8, -0.3, 0.0), Material::White);
    // A band of windows round the hull, and doors on the right.
    mesh.cuboid(
        share(-0.5, -0.5, 0.42).plus(0.3, -0.01, 0.0),
        share(0.5, 0.5, 0.8).plus(0.01, 0.01, 0.0),
        Material::Glass,
    );
    for x in [0.36, -0.05] {
        mesh.cuboid(
            share(x, -0.5, 0.0).plus(-0.6, -0.015, 0.4),
            share(x, -0.5, 0.8).plus(0.6, 0.1, 0.0),
            Material::Glass,
        );
    }
    mesh.cuboid(
        share(0.5, -0.35, 0.84).plus(-0.05, 0.0, 0.0),
        share(0.5, 0.35, 0.92).plus(0.012, 0.0, 0.0),
        Material::Dark,
    );
    for x in [0.3, -0.28] {
        axle(&mut mesh, share(x, 0.0, 0.0), 0.48, 0.3);
    }
    lights(&mut mesh, 0.6, 0.3);
    mesh
}

/// A van or lorry: a cab with a windscreen before a box.
pub(crate) fn truck() -> Builder {
    let mut mesh = Builder::new([5.5, 2.0, 2.4], 1.0);
    let cab = share(0.5, 0.0, 0.0).plus(-1.7, 0.0, 0.0);
    let at = |p: P, y: f32, z: P| P { a: [p.a[0], y, z.a[2]], o: [p.o[0], 0.0, z.o[2]] };
    mesh.cuboid(LOW.plus(0.0, 0.0, 0.28), at(cab.plus(0.02, 0.0, 0.0), 0.5, HIGH), Material::Second);
    mesh.cuboid(at(cab, -0.5, unit(0.0, 0.0, 0.28)), share(0.5, 0.5, 0.5), Material::Body);
    let foot = [
        share(0.5, -0.5, 0.5),
        share(0.5, 0.5, 0.5),
        at(cab, 0.5, share(0.0, 0.0, 0.5)),
        at(cab, -0.5, share(0.0, 0.0, 0.5)),
    ]
    .map(|p| p.plus(0.0, -p.a[1] * 0.06, 0.0));
    let brow = |y: f32, z: f32| share(0.5, y, z).plus(-0.75, -y * 0.2, 0.0);
    let back = |y: f32, z: f32| at(cab, y, share(0.0, 0.0, z)).plus(0.0, -y * 0.2, 0.0);
    let head = [brow(-0.5, 0.86), brow(0.5, 0.86), back(0.5, 0.86), back(-0.5, 0.86)];
    let roof = [brow(-0.5, 0.94), brow(0.5, 0.94), back(0.5, 0.94), back(-0.5, 0.94)];
    mesh.hexa(foot, head, Material::Glass);
    mesh.hexa(head, roof, Material::Body);
    mesh.cuboid(LOW.plus(0.1, 0.12, 0.2), share(0.5, 0.5, 0.0).plus(-0.05, -0.12, 0.32), Material::Dark);
    for x in [0.32, -0.32] {
        axle(&mut mesh, share(x, 0.0, 0.0), 0.37, 0.24);
    }
    lights(&mut mesh, 0.66, 0.28);
    mesh
}

/// A single wheel in the middle plane.
fn wheel(mesh: &mut Builder, center: P, radius: f32, width: f32) {
    let ends = [center.plus(0.0, -width, 0.0), center.plus(0.0, width, 0.0)];
    mesh.tube(ends, [radius, radius], 18, Material::Rubber);
    let hub = [center.plus(0.0, -width - 0.004, 0.0), center.plus(0.0, width + 0.004, 0.0)];
    mesh.tube(hub, [radius * 0.78, radius * 0.78], 14, Material::Metal);
}

pub(crate) fn bicycle() -> Builder {
    let mut mesh = Builder::new([1.75, 0.5, 1.1], 1.0);
    let (front, rear) =
        (share(0.5, 0.0, 0.0).plus(-0.34, 0.0, 0.34), share(-0.5, 0.0, 0.0).plus(0.34, 0.0, 0.34));
    wheel(&mut mesh, front, 0.34, 0.02);
    wheel(&mut mesh, rear, 0.34, 0.02);
    let (crank, seat, head) = (unit(-0.08, 0.0, 0.3), unit(-0.25, 0.0, 0.85), unit(0.4, 0.0, 0.85));
    for ends in [[rear, crank], [rear, seat], [crank, seat], [crank, head], [seat, head], [head, front]] {
        mesh.tube(ends, [0.02, 0.02], 6, Material::Body);
    }
    let bar = unit(0.38, 0.0, 1.02);
    mesh.tube([head, bar], [0.018, 0.018], 6, Material::Metal);
    mesh.tube([bar.plus(0.0, -0.27, 0.0), bar.plus(0.0, 0.27, 0.0)], [0.018, 0.018], 6, Material::Dark);
    mesh.cuboid(seat.plus(-0.14, -0.07, 0.07), seat.plus(0.12, 0.07, 0.12), Material::Dark);
    mesh
}

pub(crate) fn motorcycle() -> Builder {
    let mut mesh = Builder::new([2.1, 0.75, 1.15], 1.0);
    let (front, rear) =
        (share(0.5, 0.0, 0.0).plus(-0.32, 0.0, 0.32), share(-0.5, 0.0, 0.0).plus(0.32, 0.0, 0.32));
    wheel(&mut mesh, front, 0.32, 0.06);
    wheel(&mut mesh, rear, 0.32, 0.08);
    mesh.cuboid(unit(-0.3, -0.14, 0.3), unit(0.3, 0.14, 0.62), Material::Metal);
    mesh.ball([unit(0.18, 0.0, 0.74), unit(0.18, 0.0, 0.74)], [0.3, 0.16, 0.16], 8, 12, Material::Body);
    mesh.cuboid(unit(-0.75, -0.13, 0.68), unit(-0.08, 0.13, 0.78), Material::Dark);
    let bar = unit(0.42, 0.0, 1.05);
    mesh.tube([front, bar], [0.04, 0.035], 8, Material::Metal);
    mesh.tube([bar.plus(0.0, -0.36, 0.0), bar.plus(0.0, 0.36, 0.0)], [0.02, 0.02], 6, Material::Dark);
    mesh.tube([unit(0.5, 0.0, 0.88), unit(0.6, 0.0, 0.88)], [0.11, 0.11], 12, Material::HeadLight);
    mesh
}

/// An electric kick scooter.
pub(crate) fn scooter() -> Builder {
    let mut mesh = Builder::new([1.1, 0.45, 1.1], 1.0);
    let (front, rear) =
        (share(0.5, 0.0, 0.0).plus(-0.12, 0.0, 0.11), share(-0.5, 0.0, 0.0).plus(0.11, 0.0, 0.11));
    wheel(&mut mesh, front, 0.11, 0.025);
    wheel(&mut mesh, rear, 0.11, 0.025);
    mesh.cuboid(
        share(-0.5, 0.0, 0.0).plus(0.2, -0.08, 0.1),
        share(0.5, 0.0, 0.0).plus(-0.3, 0.08, 0.16),
        Material::Body,
    );
    let neck = share(0.5, 0.0, 0.0).plus(-0.2, 0.0, 0.14);
    mesh.tube([neck.plus(-0.12, 0.0, 0.0), front.plus(-0.05, 0.0, 0.14)], [0.03, 0.03], 8, Material::Body);
    let bar = share(0.5, 0.0, 1.0).plus(-0.3, 0.0, -0.04);
    mesh.tube([front, bar], [0.026, 0.022], 8, Material::Body);
    mesh.tube([bar.plus(0.0, -0.21, 0.0), bar.plus(0.0, 0.21, 0.0)], [0.018, 0.018], 6, Material::Dark);
    mesh
}
