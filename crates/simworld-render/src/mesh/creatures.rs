//! Animals and robots, facing +x.

use super::builder::{Builder, Material, P, Ring, V3, share, unit};
use super::primitives::{BOTTOM, HIGH, LOW, TOP};

/// The way of a paw of a dog of a few pixels from under its hip, at most, in heights of the dog.
pub(crate) const FAR_STRIDE: f64 = 0.26;

/// A dog of a few pixels, fitted to its box: the left fore paw and the right hind paw ahead by that share of a stride, the others as far
/// behind.
pub(crate) fn dog(ahead: f32) -> Builder {
    let mut mesh = Builder::new([0.9, 0.3, 0.6], 1.0);
    mesh.cuboid(share(-0.36, -0.28, 0.5), share(0.3, 0.28, 0.8), Material::Body);
    mesh.cuboid(share(0.26, -0.22, 0.7), share(0.5, 0.22, 1.0), Material::Body);
    for (x, y, sign) in [(0.24, 0.2, 1.0), (0.24, -0.2, -1.0), (-0.3, 0.2, -1.0), (-0.3, -0.2, 1.0)] {
        // Lengths are shares of the length of the box, and a stride is one of its height.
        let paw = 0.6 * FAR_STRIDE as f32 * sign * ahead;
        let ring = |x: f32, z: f32| {
            [[0.05, -0.1], [0.05, 0.1], [-0.05, 0.1], [-0.05, -0.1]].map(|[dx, dy]| share(x + dx, y + dy, z))
        };
        mesh.hexa(ring(x + paw, 0.0), ring(x, 0.5), Material::Body);
    }
    mesh
}

/// Trunk, head and tail of a dog; the origin is between the hips. Lengths are shares of its box, the rest in heights.
pub(crate) fn dog_trunk() -> Builder {
    let mut mesh = Builder::new([0.9, 0.3, 0.6], 0.6);
    let along = |[x, y, z]: V3| P { a: [z, 0.0, 0.0], o: [0.0, y, 0.03 - x] };
    mesh.lathe(
        &[
            [-0.4, 0.0, 0.0, 0.0],
            [-0.38, 0.1, 0.09, -0.02],
            [-0.28, 0.15, 0.13, -0.01],
            [-0.05, 0.14, 0.12, -0.01],
            [0.2, 0.19, 0.15, 0.0],
            [0.32, 0.16, 0.12, -0.04],
            [0.38, 0.0, 0.0, -0.08],
        ],
        10,
        Material::Body,
        &along,
    );
    let neck = P { a: [0.28, 0.0, 0.0], o: [0.0, 0.0, 0.1] };
    let head = P { a: [0.4, 0.0, 0.0], o: [0.02, 0.0, 0.34] };
    mesh.tube([neck, head], [0.13, 0.1], 8, Material::Body);
    mesh.ball([head, head], [0.13, 0.11, 0.12], 6, 10, Material::Body);
    mesh.tube([head.plus(0.06, 0.0, -0.02), head.plus(0.24, 0.0, -0.06)], [0.085, 0.05], 8, Material::Body);
    let nose = head.plus(0.24, 0.0, -0.045);
    mesh.ball([nose, nose], [0.03, 0.035, 0.03], 4, 6, Material::Dark);
    for side in [-1.0_f32, 1.0] {
        let ear = head.plus(-0.03, 0.09 * side, 0.08);
        mesh.tube([ear, ear.plus(-0.02, 0.05 * side, -0.14)], [0.05, 0.03], 5, Material::Second);
        let eye = head.plus(0.1, 0.05 * side, 0.04);
        mesh.ball([eye, eye], [0.022; 3], 4, 6, Material::Dark);
    }
    let rump = P { a: [-0.37, 0.0, 0.0], o: [0.0, 0.0, 0.1] };
    mesh.tube([rump, rump.plus(-0.2, 0.0, 0.2)], [0.05, 0.02], 6, Material::Body);
    mesh
}

fn hanging(rings: &[Ring], material: Material) -> Builder {
    let mut mesh = Builder::new([0.9, 0.3, 0.6], 0.6);
    mesh.lathe(rings, 7, material, &|[x, y, z]| unit(x, y, z));
    mesh
}

pub(crate) fn dog_thigh() -> Builder {
    hanging(
        &[[-0.35, 0.0, 0.0, 0.0], [-0.34, 0.05, 0.04, 0.0], [0.0, 0.11, 0.07, 0.0], [0.1, 0.0, 0.0, 0.0]],
        Material::Body,
    )
}

pub(crate) fn dog_shank() -> Builder {
    let mut mesh = hanging(
        &[[-0.36, 0.0, 0.0, 0.0], [-0.35, 0.035, 0.035, 0.0], [0.0, 0.045, 0.04, 0.0], [0.05, 0.0, 0.0, 0.0]],
        Material::Body,
    );
    let paw = unit(0.03, 0.0, -0.345);
    mesh.ball([paw, paw], [0.075, 0.05, 0.035], 4, 7, Material::Body);
    mesh
}

/// The trunk of a robot dog: a body with shoulders, a sensor head and lamps.
pub(crate) fn robot_trunk() -> Builder {
    let mut mesh = Builder::new([0.7, 0.35, 0.5], 0.5);
    let at = |x: f32, y: f32, z: f32| P { a: [x, y, 0.0], o: [0.0, 0.0, z] };
    mesh.tapered(
        at(-0.44, -0.28, -0.1),
        at(0.42, 0.28, 0.2),
        [0.05, 0.04],
        [Material::Body, Material::Body, Material::Body],
    );
    for x in [-0.32, 0.3] {
        mesh.cuboid(at(x - 0.1, -0.4, -0.1), at(x + 0.1, 0.4, 0.1), Material::Second);
    }
    mesh.tapered(at(0.4, -0.24, -0.04), at(0.5, 0.24, 0.2), [0.02, 0.03], [Material::Dark; 3]);
    for side in [-0.12, 0.12] {
        let eye = at(0.5, side, 0.1);
        mesh.tube(
            [eye.plus(-0.02, 0.0, 0.0), eye.plus(0.02, 0.0, 0.0)],
            [0.05, 0.05],
            8,
            Material::HeadLight,
        );
    }
    let dome = at(0.2, 0.0, 0.2);
    mesh.tube([dome, dome.plus(0.0, 0.0, 0.14)], [0.13, 0.12], 12, Material::Dark);
    mesh.cuboid(at(-0.36, -0.16, 0.2), at(0.02, 0.16, 0.23), Material::Dark);
    mesh
}

pub(crate) fn robot_thigh() -> Builder {
    let mut mesh = hanging(
        &[
            [-0.37, 0.0, 0.0, 0.0],
            [-0.36, 0.06, 0.05, 0.0],
            [-0.1, 0.08, 0.06, 0.0],
            [0.06, 0.1, 0.08, 0.0],
            [0.1, 0.0, 0.0, 0.0],
        ],
        Material::Body,
    );
    let joint = [unit(0.0, -0.08, 0.0), unit(0.0, 0.08, 0.0)];
    mesh.tube(joint, [0.12, 0.12], 10, Material::Second);
    mesh
}

pub(crate) fn robot_shank() -> Builder {
    let mut mesh = hanging(
        &[[-0.35, 0.0, 0.0, 0.0], [-0.34, 0.03, 0.03, 0.0], [0.0, 0.05, 0.045, 0.0], [0.05, 0.0, 0.0, 0.0]],
        Material::Second,
    );
    let foot = unit(0.0, 0.0, -0.335);
    mesh.ball([foot, foot], [0.045; 3], 4, 8, Material::Rubber);
    mesh
}

/// A wheeled robot: a box on four wheels with a mast and eyes.
pub(crate) fn robot() -> Builder {
    let mut mesh = Builder::new([0.7, 0.5, 0.9], 1.0);
    mesh.tapered(
        LOW.plus(0.0, 0.03, 0.1),
        share(0.5, 0.5, 0.62).plus(0.0, -0.03, 0.0),
        [0.04, 0.03],
        [Material::Body; 3],
    );
    mesh.cuboid(share(-0.4, -0.4, 0.62), share(0.35, 0.4, 0.67), Material::Second);
    for (x, y) in [(0.3, 0.5), (0.3, -0.5), (-0.3, 0.5), (-0.3, -0.5)] {
        let side = f32::signum(y);
        let outer = P { a: [x, y, 0.0], o: [0.0, 0.0, 0.1] };
        mesh.tube([outer.plus(0.0, -0.07 * side, 0.0), outer], [0.1, 0.1], 14, Material::Rubber);
    }
    mesh.tube([share(-0.2, 0.0, 0.6), TOP.plus(-0.14, 0.0, -0.16)], [0.025, 0.02], 8, Material::Metal);
    mesh.cuboid(TOP.plus(-0.22, -0.12, -0.17), TOP.plus(-0.06, 0.12, 0.0), Material::Dark);
    for side in [-1.0, 1.0] {
        let eye = TOP.plus(-0.06, 0.06 * side, -0.085);
        mesh.tube([eye, eye.plus(0.008, 0.0, 0.0)], [0.035, 0.035], 12, Material::HeadLight);
    }
    let front = BOTTOM.plus(0.0, 0.0, 0.3);
    mesh.cuboid(
        P { a: [0.5, -0.3, front.a[2]], o: [-0.02, 0.0, front.o[2]] },
        P { a: [0.5, 0.3, HIGH.a[2] * 0.5], o: [0.0, 0.0, 0.0] },
        Material::Dark,
    );
    mesh
}
