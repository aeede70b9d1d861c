//! Buses, vans and lorries, facing +x, without their wheels. Offsets in metres.

use super::builder::{Builder, Material, P, share, unit};
use super::primitives::{HIGH, LOW};
use super::vehicles::{arches, chassis, lights, plates};

fn at(p: P, y: f32, z: P) -> P {
    P { a: [p.a[0], y, z.a[2]], o: [p.o[0], 0.0, z.o[2]] }
}

/// A row of windows on both sides between two x shares, and heights in shares.
fn windows(mesh: &mut Builder, count: u32, [from, to]: [f32; 2], [low, high]: [f32; 2]) {
    let step = (to - from) / count as f32;
    for k in 0..count {
        let x = from + step * k as f32;
        for side in [-0.5, 0.5] {
            let (foot, head) = (share(x, side, low), share(x + step, side, high));
            mesh.cuboid(foot.plus(0.05, -0.012, 0.0), head.plus(-0.05, 0.012, 0.0), Material::Glass);
        }
    }
}

/// Front and rear screens between heights in shares.
fn screens(mesh: &mut Builder, low: f32, high: f32) {
    mesh.cuboid(
        share(0.5, -0.46, low).plus(-0.05, 0.0, 0.0),
        share(0.5, 0.46, high).plus(0.012, 0.0, 0.0),
        Material::Glass,
    );
    mesh.cuboid(
        share(-0.5, -0.42, low + 0.1).plus(-0.012, 0.0, 0.0),
        share(-0.5, 0.42, high).plus(0.05, 0.0, 0.0),
        Material::Glass,
    );
}

fn mirrors(mesh: &mut Builder, height: f32) {
    for side in [-1.0_f32, 1.0] {
        let root = share(0.5, 0.5 * side, height);
        let (low, high) = if side > 0.0 { (0.02, 0.24) } else { (-0.24, -0.02) };
        mesh.cuboid(root.plus(-0.14, low, -0.18), root.plus(-0.04, high, 0.18), Material::Dark);
    }
}

fn coachwork(mesh: &mut Builder) {
    mesh.cuboid(LOW.plus(0.0, 0.0, 0.3), HIGH.plus(0.0, 0.0, -0.1), Material::Paint);
    mesh.tapered(
        share(-0.5, -0.5, 1.0).plus(0.0, 0.0, -0.1),
        HIGH,
        [0.12, 0.12],
        [Material::Paint, Material::White, Material::Paint],
    );
    chassis(mesh, 0.2, 0.34);
    for x in [0.3, -0.28] {
        arches(mesh, share(x, 0.0, 0.0), 0.48);
    }
    lights(mesh, 0.6, 0.34);
    plates(mesh, 0.44);
}

pub(crate) fn bus() -> Builder {
    let mut mesh = Builder::new([11.0, 2.5, 3.0], 1.0);
    coachwork(&mut mesh);
    windows(&mut mesh, 8, [-0.48, 0.4], [0.42, 0.8]);
    screens(&mut mesh, 0.36, 0.84);
    // Doors on the right: two leaves of glass with a frame.
    for x in [0.44, 0.02, -0.4] {
        for leaf in [-0.32, 0.32] {
            let middle = share(x, -0.5, 0.0).plus(leaf, 0.0, 0.0);
            mesh.cuboid(
                middle.plus(-0.29, -0.02, 0.36),
                at(middle.plus(0.29, 0.0, 0.0), -0.5, share(0.0, 0.0, 0.8)).plus(0.0, 0.04, 0.0),
                Material::Glass,
            );
        }
    }
    mesh.cuboid(
        share(0.5, -0.36, 0.85).plus(-0.05, 0.0, 0.0),
        share(0.5, 0.36, 0.94).plus(0.014, 0.0, 0.0),
        Material::LampGlow,
    );
    mesh.cuboid(share(-0.3, -0.3, 1.0), share(0.1, 0.3, 1.0).plus(0.0, 0.0, 0.16), Material::White);
    mirrors(&mut mesh, 0.74);
    mesh
}

pub(crate) fn double_decker() -> Builder {
    let mut mesh = Builder::new([11.0, 2.5, 4.4], 1.0);
    coachwork(&mut mesh);
    windows(&mut mesh, 7, [-0.46, 0.36], [0.26, 0.5]);
    windows(&mut mesh, 9, [-0.48, 0.48], [0.62, 0.86]);
    screens(&mut mesh, 0.26, 0.5);
    screens(&mut mesh, 0.6, 0.86);
    let door = share(0.44, -0.5, 0.0);
    mesh.cuboid(door.plus(-0.55, -0.02, 0.36), share(0.44, -0.5, 0.5).plus(0.55, 0.04, 0.0), Material::Glass);
    mesh.cuboid(
        share(0.5, -0.36, 0.52).plus(-0.05, 0.0, 0.0),
        share(0.5, 0.36, 0.58).plus(0.014, 0.0, 0.0),
        Material::LampGlow,
    );
    mirrors(&mut mesh, 0.46);
    mesh
}

/// A bus of a few pixels, wheels and all.
pub(crate) fn far_bus() -> Builder {
    let mut mesh = Builder::new([11.0, 2.5, 3.0], 1.0);
    mesh.cuboid(LOW.plus(0.0, 0.0, 0.3), HIGH, Material::Paint);
    mesh.cuboid(
        share(-0.49, -0.5, 0.42).plus(0.0, -0.01, 0.0),
        share(0.5, 0.5, 0.8).plus(0.01, 0.01, 0.0),
        Material::Glass,
    );
    for x in [0.3_f32, -0.28] {
        mesh.cuboid(share(x - 0.045, -0.5, 0.0), share(x + 0.045, 0.5, 0.3), Material::Dark);
    }
    lights(&mut mesh, 0.6, 0.34);
    mesh
}

/// A van in one piece: a sloping bonnet and a tall body.
pub(crate) fn van() -> Builder {
    let mut mesh = Builder::new([5.6, 2.0, 2.5], 1.0);
    let floor = unit(0.0, 0.0, 0.26);
    let front = share(0.5, 0.0, 0.0);
    let (cowl, brow) = (front.plus(-0.62, 0.0, 0.0), front.plus(-1.25, 0.0, 0.0));
    let ring =
        |x0: P, x1: P, z0: P, z1: P, y: f32| [at(x1, -y, z1), at(x1, y, z1), at(x0, y, z0), at(x0, -y, z0)];
    let low = |x0: P, x1: P| ring(x0, x1, floor, floor, 0.5);
    let back = share(-0.5, 0.0, 0.0);
    let (hood, nose) = (share(0.0, 0.0, 0.47), share(0.0, 0.0, 0.38));
    mesh.hexa(low(cowl, front), ring(cowl, front, hood, nose, 0.49), Material::Paint);
    mesh.hexa(low(back, cowl), ring(back, cowl, hood, hood, 0.5), Material::Paint);
    let (eave, roof) = (share(0.0, 0.0, 0.9), share(0.0, 0.0, 1.0));
    mesh.hexa(ring(back, cowl, hood, hood, 0.5), ring(back, brow, eave, eave, 0.47), Material::Paint);
    mesh.hexa(
        ring(back, brow, eave, eave, 0.47),
        ring(back.plus(0.08, 0.0, 0.0), brow.plus(-0.15, 0.0, 0.0), roof, roof, 0.42),
        Material::Paint,
    );
    // Windscreen and side windows lie on the slanted faces.
    let screen = |x: P, y: f32, z: P| at(x, y, z).plus(0.015, 0.0, 0.01);
    let (foot, head) = (share(0.0, 0.0, 0.5), share(0.0, 0.0, 0.87));
    let top = front.plus(-1.205, 0.0, 0.0);
    let base = front.plus(-0.66, 0.0, 0.0);
    mesh.quad(
        [
            screen(base, -0.46, foot),
            screen(base, 0.46, foot),
            screen(top, 0.44, head),
            screen(top, -0.44, head),
        ],
        Material::Glass,
    );
    for side in [-1.0_f32, 1.0] {
        let out = 0.012 * side;
        let pane = |x: P, z: P, y: f32| at(x, y * side, z).plus(0.0, out, 0.0);
        let corners = [
            pane(front.plus(-1.9, 0.0, 0.0), foot, 0.5),
            pane(base.plus(-0.15, 0.0, 0.0), foot, 0.5),
            pane(top.plus(-0.1, 0.0, 0.0), head, 0.474),
            pane(front.plus(-1.9, 0.0, 0.0), head, 0.474),
        ];
        let [a, b, c, d] = corners;
        mesh.quad(if side < 0.0 { [a, b, c, d] } else { [b, a, d, c] }, Material::Glass);
    }
    chassis(&mut mesh, 0.18, 0.3);
    for x in [0.32, -0.32] {
        arches(&mut mesh, share(x, 0.0, 0.0), 0.35);
    }
    lights(&mut mesh, 0.7, 0.3);
    plates(&mut mesh, 0.42);
    mirrors(&mut mesh, 0.56);
    mesh
}

/// A cab as long as `length` m before the rest.
fn cab(mesh: &mut Builder, length: f32, top: f32) {
    let front = share(0.5, 0.0, 0.0);
    let back = front.plus(-length, 0.0, 0.0);
    let floor = unit(0.0, 0.0, 0.5);
    let belt = share(0.0, 0.0, 0.5 * top);
    let ring = |x0: P, x1: P, z: P, y: f32| [at(x1, -y, z), at(x1, y, z), at(x0, y, z), at(x0, -y, z)];
    let brow = front.plus(-0.25, 0.0, 0.0);
    let head = share(0.0, 0.0, 0.88 * top);
    let roof = share(0.0, 0.0, top);
    mesh.hexa(ring(back, front, floor, 0.49), ring(back, front, belt, 0.5), Material::Paint);
    mesh.hexa(ring(back, front, belt, 0.49), ring(back, brow, head, 0.47), Material::Glass);
    mesh.hexa(
        ring(back, brow, head, 0.48),
        ring(back, brow.plus(-0.15, 0.0, 0.0), roof, 0.45),
        Material::Paint,
    );
    // Posts behind the doors and at the corners of the screen.
    for side in [-1.0_f32, 1.0] {
        for (x, tilt) in [(back.plus(0.12, 0.0, 0.0), 0.0), (front.plus(-0.1, 0.0, 0.0), -0.25)] {
            let foot = at(x, 0.49 * side, belt);
            let ends = [foot, at(x.plus(tilt, 0.0, 0.0), 0.47 * side, head)];
            mesh.tube(ends, [0.07, 0.07], 4, Material::Paint);
        }
    }
    mesh.cuboid(
        at(front.plus(-0.02, 0.0, 0.0), -0.36, unit(0.0, 0.0, 0.66)),
        at(front.plus(0.015, 0.0, 0.0), 0.36, share(0.0, 0.0, 0.42 * top)),
        Material::Dark,
    );
    mesh.cuboid(
        at(front.plus(-0.2, 0.0, 0.0), -0.5, unit(0.0, 0.0, 0.3)),
        at(front.plus(0.04, 0.0, 0.0), 0.5, unit(0.0, 0.0, 0.52)),
        Material::Dark,
    );
    mirrors(mesh, 0.62 * top);
}

fn frame(mesh: &mut Builder) {
    mesh.cuboid(LOW.plus(0.1, 0.3, 0.55), share(0.5, 0.5, 0.0).plus(-0.3, -0.3, 0.85), Material::Dark);
    for side in [-0.5_f32, 0.5] {
        let (low, high) = (share(-0.12, side, 0.0), share(0.14, side, 0.0));
        let inner = -side.signum() * 0.12;
        let (y0, y1) = (inner.min(inner * 0.4), inner.max(inner * 0.4));
        mesh.cuboid(low.plus(0.0, y0, 0.4), high.plus(0.0, y1, 0.8), Material::Dark);
    }
    for x in [0.36, -0.3] {
        arches(mesh, share(x, 0.0, 0.0), 0.5);
    }
    lights(mesh, 0.74, 0.3);
    plates(mesh, 0.5);
}

/// A cab before a box.
pub(crate) fn truck() -> Builder {
    let mut mesh = Builder::new([8.5, 2.5, 3.4], 1.0);
    frame(&mut mesh);
    cab(&mut mesh, 1.7, 0.8);
    let bulkhead = share(0.5, 0.5, 1.0).plus(-1.85, 0.0, 0.0);
    mesh.cuboid(LOW.plus(0.0, 0.0, 0.85), bulkhead, Material::Second);
    for side in [-0.5, 0.5] {
        for x in [-0.45, -0.28, -0.11, 0.06] {
            let foot = share(x, side, 0.0).plus(0.0, -0.015, 0.87);
            mesh.cuboid(foot, share(x, side, 1.0).plus(0.05, 0.015, -0.02), Material::White);
        }
    }
    mesh
}

/// Lockers with shutters behind a long cab, and a ladder on the roof.
pub(crate) fn fire_engine() -> Builder {
    let mut mesh = Builder::new([8.3, 2.5, 3.3], 1.0);
    frame(&mut mesh);
    cab(&mut mesh, 2.9, 0.86);
    let bulkhead = share(0.5, 0.5, 0.88).plus(-3.0, 0.0, 0.0);
    mesh.cuboid(LOW.plus(0.0, 0.0, 0.55), bulkhead, Material::Paint);
    for side in [-0.5, 0.5] {
        for k in 0..3_u8 {
            let x = -0.47 + 0.19 * f32::from(k);
            let foot = share(x, side, 0.0).plus(0.0, -0.014, 1.0);
            mesh.cuboid(foot, share(x + 0.17, side, 0.82).plus(0.0, 0.014, 0.0), Material::Metal);
        }
        let (low, high) = (share(-0.5, side, 0.0), share(0.5, side, 0.0));
        mesh.cuboid(low.plus(0.0, -0.012, 0.84), high.plus(-0.05, 0.012, 0.97), Material::White);
    }
    for side in [-0.35, 0.35] {
        let rail = |x: f32| share(x, 0.0, 1.0).plus(0.0, side, -0.12);
        mesh.tube([rail(-0.52), rail(0.3)], [0.05, 0.05], 5, Material::Metal);
    }
    for k in 0..9_u8 {
        let rung = share(-0.49 + 0.09 * f32::from(k), 0.0, 1.0).plus(0.0, 0.0, -0.12);
        mesh.tube([rung.plus(0.0, -0.35, 0.0), rung.plus(0.0, 0.35, 0.0)], [0.03, 0.03], 4, Material::Metal);
    }
    mesh
}

/// A cab before a tank.
pub(crate) fn tanker() -> Builder {
    let mut mesh = Builder::new([10.0, 2.5, 3.5], 1.0);
    frame(&mut mesh);
    cab(&mut mesh, 1.9, 0.86);
    let axis = |x: P| P { a: [x.a[0], 0.0, 0.0], o: [x.o[0], 0.0, 2.0] };
    let (tail, head) = (share(-0.5, 0.0, 0.0), share(0.5, 0.0, 0.0).plus(-2.2, 0.0, 0.0));
    mesh.tube(
        [axis(tail.plus(0.3, 0.0, 0.0)), axis(head.plus(-0.3, 0.0, 0.0))],
        [1.16, 1.16],
        18,
        Material::Second,
    );
    mesh.tube(
        [axis(tail.plus(0.02, 0.0, 0.0)), axis(tail.plus(0.3, 0.0, 0.0))],
        [0.8, 1.16],
        18,
        Material::Second,
    );
    mesh.tube([axis(head.plus(-0.3, 0.0, 0.0)), axis(head)], [1.16, 0.8], 18, Material::Second);
    for x in [-0.3, -0.08, 0.14] {
        let lid = share(x, 0.0, 0.0).plus(0.0, 0.0, 3.1);
        mesh.tube([lid, lid.plus(0.0, 0.0, 0.16)], [0.3, 0.26], 10, Material::Metal);
    }
    mesh
}

/// A cab before an open body.
pub(crate) fn tipper() -> Builder {
    let mut mesh = Builder::new([8.0, 2.5, 3.2], 1.0);
    frame(&mut mesh);
    cab(&mut mesh, 1.8, 0.9);
    let floor = LOW.plus(0.0, 0.0, 0.9);
    let head = share(0.5, 0.5, 0.0).plus(-1.95, 0.0, 1.05);
    mesh.cuboid(floor, head, Material::Second);
    for side in [-1.0_f32, 1.0] {
        let (y0, y1) = ((0.46 * side).min(0.5 * side), (0.46 * side).max(0.5 * side));
        mesh.cuboid(
            share(-0.5, y0, 0.0).plus(0.0, 0.0, 1.0),
            share(0.5, y1, 0.72).plus(-1.95, 0.0, 0.0),
            Material::Second,
        );
    }
    mesh.cuboid(
        share(0.5, -0.5, 0.0).plus(-2.1, 0.0, 1.0),
        share(0.5, 0.5, 0.86).plus(-1.95, 0.0, 0.0),
        Material::Second,
    );
    mesh.cuboid(LOW.plus(0.0, 0.0, 1.0), share(-0.5, 0.5, 0.72).plus(0.1, 0.0, 0.0), Material::Second);
    mesh
}

/// A lorry of a few pixels, wheels and all.
pub(crate) fn far_truck() -> Builder {
    let mut mesh = Builder::new([7.0, 2.3, 3.0], 1.0);
    mesh.cuboid(LOW.plus(0.0, 0.0, 0.5), share(0.2, 0.5, 1.0), Material::Second);
    mesh.cuboid(share(0.22, -0.5, 0.12), share(0.5, 0.5, 0.45), Material::Paint);
    mesh.cuboid(share(0.22, -0.48, 0.45), share(0.48, 0.48, 0.78), Material::Glass);
    mesh.cuboid(share(0.22, -0.48, 0.78), share(0.46, 0.48, 0.84), Material::Paint);
    for x in [0.36_f32, -0.3] {
        mesh.cuboid(share(x - 0.06, -0.5, 0.0), share(x + 0.06, 0.5, 0.3), Material::Dark);
    }
    lights(&mut mesh, 0.7, 0.3);
    mesh
}
