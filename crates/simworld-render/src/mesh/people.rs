//! The rigid parts of a person, each with its joint at the origin. Anchors in heights, so that the box of an instance
//! says how tall and how broad it is: trunks and heads reach up from their joint, limbs hang down, feet point along +x.
//!
//! Lengths are shares of the height by Winter (Biomechanics and Motor Control of Human Movement, 2009, fig. 4.1).

use super::builder::{Builder, Material, P, Ring, V3, share};

/// Of the height: hips over the ground, the waist over the hips, shoulders and neck over the waist.
pub(crate) const HIP: f64 = 0.53;
pub(crate) const WAIST: f64 = 0.09;
pub(crate) const SHOULDER: f64 = 0.198;
pub(crate) const NECK: f64 = 0.225;
/// Half the distance between the hips and between the shoulders.
pub(crate) const HIP_WIDTH: f64 = 0.047;
pub(crate) const SHOULDER_WIDTH: f64 = 0.112;
/// Thigh, shank, and the ankle over the sole.
pub(crate) const THIGH: f64 = 0.245;
pub(crate) const SHANK: f64 = 0.246;
pub(crate) const ANKLE: f64 = 0.039;
/// Upper arm, and elbow to the middle of the hand.
pub(crate) const UPPER_ARM: f64 = 0.186;
pub(crate) const FOREARM: f64 = 0.19;

/// How finely round parts are divided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Grain {
    Fine,
    Coarse,
    /// A few corners, for who is a few pixels high.
    Rough,
}

impl Grain {
    const fn sides(self, fine: u32) -> u32 {
        match self {
            Self::Fine => fine,
            Self::Coarse => fine.div_ceil(2),
            Self::Rough => 4,
        }
    }

    /// The rings that are left at this grain: the ends, and every other one between.
    fn thin(self, rings: &[Ring]) -> Vec<Ring> {
        let last = rings.len() - 1;
        let keep = |index: usize| match self {
            Self::Fine => true,
            Self::Coarse | Self::Rough => index == 0 || index == last || index % 2 == 1,
        };
        rings.iter().enumerate().filter(|(index, _)| keep(*index)).map(|(_, ring)| *ring).collect()
    }
}

fn part() -> Builder {
    Builder::new([1.0; 3], 1.0)
}

fn upright([x, y, z]: V3) -> P {
    share(x, y, z)
}

/// Along +x in place of +z.
fn forward([x, y, z]: V3) -> P {
    share(z, y, -x)
}

fn turned(mesh: &mut Builder, grain: Grain, sides: u32, material: Material, rings: &[Ring]) {
    mesh.lathe(&grain.thin(rings), grain.sides(sides), material, &upright);
}

pub(crate) fn pelvis(grain: Grain) -> Builder {
    let mut mesh = part();
    turned(
        &mut mesh,
        grain,
        10,
        Material::Body,
        &[
            [-0.06, 0.0, 0.0, 0.0],
            [-0.05, 0.042, 0.062, 0.0],
            [0.0, 0.062, 0.09, -0.004],
            [0.05, 0.057, 0.082, 0.0],
            [0.1, 0.05, 0.073, 0.0],
            [0.11, 0.0, 0.0, 0.0],
        ],
    );
    mesh
}

/// Waist to neck; the second colour is the collar.
pub(crate) fn chest(grain: Grain) -> Builder {
    let mut mesh = part();
    turned(
        &mut mesh,
        grain,
        12,
        Material::Body,
        &[
            [-0.03, 0.0, 0.0, 0.0],
            [-0.025, 0.056, 0.081, 0.0],
            [0.06, 0.058, 0.083, 0.002],
            [0.13, 0.066, 0.098, 0.004],
            [0.185, 0.058, 0.112, 0.0],
            [0.213, 0.042, 0.088, -0.006],
            [0.232, 0.03, 0.042, -0.006],
            [0.236, 0.0, 0.0, -0.004],
        ],
    );
    mesh
}

/// How the hair is worn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Hair {
    Short,
    Long,
    Bun,
    None,
}

/// Neck and head in the first colour, hair in the second.
pub(crate) fn head(grain: Grain, hair: Hair) -> Builder {
    let mut mesh = part();
    if grain == Grain::Fine {
        turned(
            &mut mesh,
            grain,
            8,
            Material::Body,
            &[[-0.01, 0.03, 0.03, -0.006], [0.025, 0.026, 0.026, -0.002], [0.06, 0.028, 0.027, 0.0]],
        );
    }
    turned(
        &mut mesh,
        grain,
        10,
        Material::Body,
        &[
            [0.022, 0.0, 0.0, 0.018],
            [0.03, 0.022, 0.021, 0.02],
            [0.055, 0.041, 0.033, 0.013],
            [0.092, 0.051, 0.041, 0.006],
            [0.125, 0.046, 0.038, 0.0],
            [0.146, 0.026, 0.022, -0.002],
            [0.152, 0.0, 0.0, -0.002],
        ],
    );
    if grain == Grain::Fine {
        face(&mut mesh);
    }
    match hair {
        Hair::None => {}
        Hair::Short => scalp(&mut mesh, grain, 0.078),
        Hair::Long => {
            scalp(&mut mesh, grain, 0.07);
            turned(
                &mut mesh,
                grain,
                8,
                Material::Second,
                &[
                    [-0.05, 0.0, 0.0, -0.04],
                    [-0.045, 0.012, 0.035, -0.04],
                    [0.01, 0.026, 0.048, -0.03],
                    [0.07, 0.036, 0.049, -0.02],
                    [0.12, 0.03, 0.04, -0.015],
                    [0.13, 0.0, 0.0, -0.01],
                ],
            );
        }
        Hair::Bun => {
            scalp(&mut mesh, grain, 0.075);
            let knot = share(-0.05, 0.0, 0.125);
            mesh.ball([knot, knot], [0.026; 3], 4, grain.sides(8), Material::Second);
        }
    }
    mesh
}

/// Eyes, brows and a nose.
fn face(mesh: &mut Builder) {
    for side in [-1.0, 1.0] {
        let eye = share(0.049, 0.0165 * side, 0.094);
        mesh.cuboid(eye.plus(-0.01, -0.006, -0.003), eye.plus(0.003, 0.006, 0.003), Material::Dark);
        let brow = eye.plus(0.0, 0.0, 0.011);
        mesh.cuboid(brow.plus(-0.01, -0.01, -0.0015), brow.plus(0.003, 0.01, 0.002), Material::Second);
        // Ears.
        let ear = share(-0.002, 0.039 * side, 0.088);
        mesh.cuboid(ear.plus(-0.008, -0.005, -0.014), ear.plus(0.007, 0.006, 0.014), Material::Body);
    }
    let tip = share(0.063, 0.0, 0.074);
    let bridge = share(0.05, 0.0, 0.094);
    let wings = [share(0.048, -0.009, 0.07), share(0.048, 0.009, 0.07)];
    mesh.quad([wings[0], tip, bridge, bridge], Material::Body);
    mesh.quad([tip, wings[1], bridge, bridge], Material::Body);
    mesh.quad([wings[0], wings[1], tip, tip], Material::Body);
    let mouth = share(0.044, 0.0, 0.05);
    mesh.cuboid(mouth.plus(-0.01, -0.012, -0.002), mouth.plus(0.006, 0.012, 0.002), Material::Wood);
}

fn scalp(mesh: &mut Builder, grain: Grain, nape: f32) {
    turned(
        mesh,
        grain,
        10,
        Material::Second,
        &[
            [nape - 0.03, 0.012, 0.028, -0.032],
            [nape, 0.03, 0.041, -0.022],
            [0.108, 0.048, 0.0445, -0.008],
            [0.132, 0.049, 0.0425, -0.003],
            [0.155, 0.03, 0.027, -0.005],
            [0.161, 0.0, 0.0, -0.006],
        ],
    );
}

pub(crate) fn cap() -> Builder {
    let mut mesh = part();
    turned(
        &mut mesh,
        Grain::Fine,
        10,
        Material::Body,
        &[
            [0.112, 0.054, 0.046, -0.002],
            [0.14, 0.05, 0.043, -0.003],
            [0.163, 0.03, 0.027, -0.005],
            [0.168, 0.0, 0.0, -0.006],
        ],
    );
    mesh.cuboid(share(0.035, -0.033, 0.112), share(0.088, 0.033, 0.118), Material::Body);
    mesh
}

pub(crate) fn hat() -> Builder {
    let mut mesh = part();
    turned(
        &mut mesh,
        Grain::Fine,
        12,
        Material::Body,
        &[
            [0.118, 0.0, 0.0, 0.0],
            [0.12, 0.09, 0.08, 0.0],
            [0.126, 0.056, 0.048, -0.002],
            [0.17, 0.045, 0.04, -0.003],
            [0.175, 0.0, 0.0, -0.004],
        ],
    );
    turned(
        &mut mesh,
        Grain::Fine,
        12,
        Material::Dark,
        &[[0.126, 0.058, 0.05, -0.002], [0.138, 0.056, 0.048, -0.002]],
    );
    mesh
}

pub(crate) fn helmet() -> Builder {
    let mut mesh = part();
    turned(
        &mut mesh,
        Grain::Fine,
        12,
        Material::Body,
        &[
            [0.1, 0.0, 0.0, 0.0],
            [0.102, 0.072, 0.056, 0.002],
            [0.112, 0.061, 0.053, -0.002],
            [0.14, 0.056, 0.05, -0.004],
            [0.172, 0.032, 0.03, -0.005],
            [0.18, 0.0, 0.0, -0.006],
        ],
    );
    mesh
}

pub(crate) fn upper_arm(grain: Grain) -> Builder {
    let mut mesh = part();
    turned(
        &mut mesh,
        grain,
        8,
        Material::Body,
        &[
            [-0.2, 0.0, 0.0, 0.0],
            [-0.19, 0.021, 0.021, 0.0],
            [-0.1, 0.027, 0.027, 0.0],
            [-0.02, 0.033, 0.031, 0.0],
            [0.015, 0.028, 0.026, 0.0],
            [0.03, 0.0, 0.0, 0.0],
        ],
    );
    mesh
}

/// A sleeve in the first colour, a hand in the second.
pub(crate) fn forearm(grain: Grain) -> Builder {
    let mut mesh = part();
    turned(
        &mut mesh,
        grain,
        8,
        Material::Body,
        &[
            [-0.152, 0.0, 0.0, 0.0],
            [-0.15, 0.019, 0.019, 0.0],
            [-0.07, 0.024, 0.023, 0.0],
            [0.0, 0.023, 0.022, 0.0],
            [0.018, 0.0, 0.0, 0.0],
        ],
    );
    turned(
        &mut mesh,
        grain,
        7,
        Material::Second,
        &[
            [-0.228, 0.0, 0.0, 0.006],
            [-0.22, 0.012, 0.01, 0.005],
            [-0.185, 0.023, 0.012, 0.0],
            [-0.15, 0.015, 0.012, 0.0],
            [-0.14, 0.0, 0.0, 0.0],
        ],
    );
    mesh
}

pub(crate) fn thigh(grain: Grain) -> Builder {
    let mut mesh = part();
    turned(
        &mut mesh,
        grain,
        8,
        Material::Body,
        &[
            [-0.268, 0.0, 0.0, 0.002],
            [-0.25, 0.033, 0.031, 0.002],
            [-0.12, 0.042, 0.041, 0.002],
            [-0.02, 0.053, 0.048, 0.0],
            [0.03, 0.034, 0.03, 0.0],
            [0.045, 0.0, 0.0, 0.0],
        ],
    );
    mesh
}

pub(crate) fn shank(grain: Grain) -> Builder {
    let mut mesh = part();
    turned(
        &mut mesh,
        grain,
        8,
        Material::Body,
        &[
            [-0.255, 0.0, 0.0, 0.0],
            [-0.25, 0.023, 0.022, 0.0],
            [-0.19, 0.025, 0.024, -0.002],
            [-0.1, 0.035, 0.031, -0.006],
            [-0.02, 0.034, 0.031, 0.0],
            [0.025, 0.0, 0.0, 0.0],
        ],
    );
    mesh
}

/// A shoe, the sole in the second colour.
pub(crate) fn foot(grain: Grain) -> Builder {
    let mut mesh = part();
    let rings = [
        [-0.045, 0.0, 0.0, 0.02],
        [-0.04, 0.018, 0.02, 0.02],
        [0.0, 0.033, 0.024, 0.005],
        [0.045, 0.021, 0.027, 0.017],
        [0.085, 0.013, 0.026, 0.025],
        [0.105, 0.008, 0.018, 0.029],
        [0.109, 0.0, 0.0, 0.03],
    ];
    mesh.lathe(&grain.thin(&rings), grain.sides(8), Material::Body, &forward);
    if grain == Grain::Fine {
        mesh.cuboid(share(-0.046, -0.024, -0.039), share(0.108, 0.024, -0.031), Material::Second);
    }
    mesh
}

/// The tails of a coat, on the pelvis.
pub(crate) fn coat() -> Builder {
    let mut mesh = part();
    turned(
        &mut mesh,
        Grain::Fine,
        12,
        Material::Body,
        &[
            [-0.21, 0.0, 0.0, 0.0],
            [-0.212, 0.085, 0.108, 0.0],
            [-0.08, 0.078, 0.106, 0.0],
            [0.05, 0.062, 0.09, 0.0],
            [0.11, 0.058, 0.084, 0.0],
        ],
    );
    mesh
}

/// A skirt to the knees, on the pelvis.
pub(crate) fn skirt() -> Builder {
    let mut mesh = part();
    turned(
        &mut mesh,
        Grain::Fine,
        12,
        Material::Body,
        &[
            [-0.2, 0.0, 0.0, 0.0],
            [-0.205, 0.115, 0.128, 0.0],
            [-0.08, 0.086, 0.108, 0.0],
            [0.04, 0.062, 0.088, 0.0],
            [0.1, 0.053, 0.076, 0.0],
            [0.105, 0.0, 0.0, 0.0],
        ],
    );
    mesh
}

/// On the back, in the frame of the chest.
pub(crate) fn backpack() -> Builder {
    let mut mesh = part();
    let body = [Material::Body; 3];
    mesh.tapered(share(-0.135, -0.075, 0.0), share(-0.05, 0.075, 0.2), [0.02, 0.015], body);
    mesh.cuboid(share(-0.155, -0.055, 0.02), share(-0.13, 0.055, 0.1), Material::Second);
    for side in [-1.0, 1.0] {
        let (inner, outer) = (0.05 * side, 0.072 * side);
        let (low, high) = if side > 0.0 { (inner, outer) } else { (outer, inner) };
        mesh.cuboid(share(0.03, low, 0.05), share(0.071, high, 0.19), Material::Second);
        mesh.cuboid(share(-0.06, low, 0.19), share(0.066, high, 0.222), Material::Second);
    }
    mesh
}

/// At the right hip with its strap, in the frame of the chest.
pub(crate) fn shoulder_bag() -> Builder {
    let mut mesh = part();
    mesh.cuboid(share(-0.065, -0.135, -0.11), share(0.06, -0.1, 0.0), Material::Body);
    let strap = [[-0.066, -0.09, 0.0], [0.05, 0.06, 0.21], [0.062, 0.066, 0.218], [-0.054, -0.104, -0.01]];
    for x in [0.064_f32, -0.06] {
        let band = |[_, y, z]: V3, dy: f32| share(x + 0.004 * x.signum(), y + dy, z);
        let (a, b) = (band(strap[0], 0.0), band(strap[1], 0.0));
        let (c, d) = (band(strap[1], 0.02), band(strap[0], 0.02));
        mesh.quad(if x > 0.0 { [a, d, c, b] } else { [a, b, c, d] }, Material::Second);
    }
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Together the parts are as tall as they say.
    #[test]
    fn the_parts_add_up_to_a_height() {
        let reach = |mesh: &Builder, least: bool| {
            let heights = mesh.vertices.iter().map(|vertex| f64::from(vertex.anchor[2]));
            if least { heights.fold(f64::MAX, f64::min) } else { heights.fold(f64::MIN, f64::max) }
        };
        let crown = HIP + WAIST + NECK + reach(&head(Grain::Fine, Hair::None), false);
        assert!((crown - 1.0).abs() < 0.01, "{crown}");
        assert!((HIP - THIGH - SHANK - ANKLE).abs() < 0.01);
        assert!((reach(&foot(Grain::Fine), true) + ANKLE).abs() < 0.002);
    }

    #[test]
    fn coarse_parts_have_fewer_triangles() {
        for make in [pelvis, chest, upper_arm, forearm, thigh, shank, foot] {
            let count = |grain| make(grain).indices.len() / 3;
            assert!(count(Grain::Coarse) * 2 < count(Grain::Fine), "{}", count(Grain::Fine));
            assert!(count(Grain::Rough) <= count(Grain::Coarse));
        }
    }
}
