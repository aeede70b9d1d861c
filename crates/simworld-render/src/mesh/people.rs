//! People, dogs and robots, facing +x. People grow as a whole: offsets in heights.

use super::builder::{Builder, Material, P, share, unit};
use super::primitives::{BOTTOM, HIGH, LOW, TOP};

/// How the limbs of a person are held.
#[derive(Clone, Copy)]
pub(crate) enum Stance {
    Standing,
    /// In the middle of a stride.
    Walking,
    /// Legs bent; the origin is on the seat.
    Sitting,
}

pub(crate) fn person(stance: Stance) -> Builder {
    let mut mesh = Builder::new([0.28, 0.28, 1.0], 1.0);
    let (hip, stride) = match stance {
        Stance::Standing => (0.5, 0.0),
        Stance::Walking => (0.49, 0.13),
        Stance::Sitting => (0.03, 0.0),
    };
    let up = |x: f32, y: f32, z: f32| unit(x, y, hip + z);
    for side in [-1.0_f32, 1.0] {
        legs(&mut mesh, stance, side, hip, stride);
        let swing = -stride * side;
        let (shoulder, hand) = match stance {
            Stance::Sitting => (up(0.0, 0.088 * side, 0.29), up(0.18, 0.09 * side, 0.07)),
            _ => (up(0.0, 0.088 * side, 0.29), up(swing + 0.03, 0.115 * side, 0.0)),
        };
        let elbow = up((shoulder.o[0] + hand.o[0]) * 0.5 - 0.025, 0.115 * side, 0.15);
        mesh.limb([shoulder, elbow], [0.029, 0.025], Material::Body);
        mesh.limb([elbow, hand], [0.024, 0.018], Material::Skin);
    }
    // The torso, from the hips to the shoulders, wider than deep.
    let (waist, chest) = (up(0.0, 0.0, 0.05), up(0.0, 0.0, 0.24));
    mesh.ball([waist, chest], [0.06, 0.093, 0.085], 12, 16, Material::Body);
    let seat = up(0.0, 0.0, 0.015);
    mesh.ball([seat, seat], [0.064, 0.088, 0.06], 8, 12, Material::Second);
    mesh.tube([up(0.0, 0.0, 0.3), up(0.008, 0.0, 0.36)], [0.032, 0.028], 8, Material::Skin);
    let head = up(0.012, 0.0, 0.415);
    mesh.ball([head, head], [0.053, 0.045, 0.063], 10, 12, Material::Skin);
    let scalp = up(0.002, 0.0, 0.43);
    mesh.ball([scalp, scalp], [0.056, 0.05, 0.062], 10, 12, Material::Hair);
    mesh
}

fn legs(mesh: &mut Builder, stance: Stance, side: f32, hip: f32, stride: f32) {
    let y = 0.05 * side;
    let joint = unit(0.0, y, hip);
    let (knee, ankle) = if let Stance::Sitting = stance {
        (unit(0.24, y, hip), unit(0.25, y, -0.215))
    } else {
        let bend = if side * stride < 0.0 { 0.02 } else { 0.035 };
        (unit(stride * side * 0.55 + bend, y, hip * 0.54), unit(stride * side - bend, y, 0.035))
    };
    mesh.limb([joint, knee], [0.045, 0.034], Material::Second);
    mesh.limb([knee, ankle], [0.033, 0.023], Material::Second);
    let toe = ankle.plus(0.035, 0.0, -0.018);
    mesh.ball([toe, toe], [0.065, 0.026, 0.02], 6, 8, Material::Dark);
}

/// A dog, fitted to its box.
pub(crate) fn dog() -> Builder {
    let mut mesh = Builder::new([0.9, 0.3, 0.6], 1.0);
    let (chest, rump) = (share(0.18, 0.0, 0.62), share(-0.3, 0.0, 0.62));
    mesh.limb([rump, chest], [0.1, 0.12], Material::Body);
    let head = share(0.4, 0.0, 0.86);
    mesh.limb([chest.plus(0.05, 0.0, 0.02), head], [0.08, 0.075], Material::Body);
    mesh.limb([head, head.plus(0.12, 0.0, -0.03)], [0.06, 0.035], Material::Body);
    for (x, y) in [(0.2, 0.3), (0.2, -0.3), (-0.34, 0.3), (-0.34, -0.3)] {
        mesh.limb([share(x, y, 0.6), share(x, y, 0.0).plus(0.0, 0.0, 0.03)], [0.05, 0.03], Material::Body);
    }
    mesh.limb([rump.plus(-0.06, 0.0, 0.05), share(-0.5, 0.0, 0.9)], [0.03, 0.015], Material::Body);
    for side in [-1.0, 1.0] {
        mesh.limb(
            [head.plus(-0.03, 0.05 * side, 0.05), head.plus(-0.06, 0.065 * side, 0.0)],
            [0.025, 0.02],
            Material::Second,
        );
    }
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
