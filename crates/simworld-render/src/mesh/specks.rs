//! What stands for things that are a few pixels high: their silhouette and colours in some dozen triangles. In the frames and units of
//! those that they stand for.

use super::MeshId;
use super::builder::{Builder, Material, P, share, unit};
use super::primitives::{BOTTOM, HIGH, LOW, TOP};
use super::street::LAMP_REACH;

impl MeshId {
    /// The mesh of few triangles that is drawn instead where the ball around its entity is fewer pixels across than this, if there is one.
    ///
    /// Balls reach far beyond their things: a person is half as high as its ball is wide, a tree a quarter.
    pub(crate) const fn speck(self) -> Option<(f64, Self)> {
        Some(match self {
            Self::Standing
            | Self::Walking
            | Self::WalkingLeft
            | Self::WalkingRight
            | Self::WalkingFarRight => (16.0, Self::SpeckPerson),
            Self::Lamp => (60.0, Self::SpeckLamp),
            Self::FarCar => (15.0, Self::SpeckCar),
            Self::FarCrown => (44.0, Self::SpeckCrown),
            Self::FarBare => (44.0, Self::SpeckBare),
            Self::CoarseWheel => (55.0, Self::SpeckWheel),
            Self::TrashBin => (22.0, Self::SpeckBin),
            Self::Bench => (16.0, Self::SpeckBench),
            Self::RoofUnit => (220.0, Self::SpeckUnit),
            _ => return None,
        })
    }
}

/// Somebody upright.
pub(crate) fn person() -> Builder {
    let mut mesh = Builder::new([1.0; 3], 1.0);
    mesh.cuboid(share(-0.06, -0.085, 0.0), share(0.06, 0.085, 0.53), Material::Second);
    mesh.cuboid(share(-0.06, -0.13, 0.53), share(0.06, 0.13, 0.84), Material::Body);
    mesh.cuboid(share(-0.055, -0.045, 0.86), share(0.06, 0.045, 1.0), Material::Skin);
    mesh
}

pub(crate) fn lamp() -> Builder {
    let mut mesh = Builder::new([0.2, 0.2, 6.0], 1.0);
    let bar = |mesh: &mut Builder, low: P, high: P| mesh.cuboid(low, high, Material::Body);
    bar(&mut mesh, BOTTOM.plus(-0.055, -0.055, 0.0), TOP.plus(0.055, 0.055, -0.2));
    bar(&mut mesh, TOP.plus(0.055, -0.035, -0.13), TOP.plus(1.0, 0.035, -0.03));
    bar(&mut mesh, TOP.plus(1.0, -0.13, -0.05), TOP.plus(LAMP_REACH, 0.13, 0.04));
    let glow = |x: f32, y: f32| TOP.plus(x, y, -0.07);
    let (near, far) = (1.08, LAMP_REACH - 0.06);
    mesh.quad([glow(near, 0.1), glow(far, 0.1), glow(far, -0.1), glow(near, -0.1)], Material::LampGlow);
    mesh
}

pub(crate) fn car() -> Builder {
    let mut mesh = Builder::new([4.5, 1.8, 1.5], 1.0);
    let ring = |x0: f32, x1: f32, y: f32, z: f32| {
        [[x1, -y], [x1, y], [x0, y], [x0, -y]].map(|[x, y]| share(x, y, z))
    };
    mesh.cuboid(share(-0.4, -0.48, 0.0), share(0.4, 0.48, 0.16), Material::Dark);
    mesh.hexa(ring(-0.5, 0.5, 0.49, 0.16), ring(-0.49, 0.46, 0.5, 0.6), Material::Paint);
    mesh.hexa(ring(-0.44, 0.24, 0.46, 0.6), ring(-0.32, 0.08, 0.4, 0.96), Material::Glass);
    mesh.quad(ring(-0.32, 0.08, 0.4, 0.97), Material::Paint);
    for (x, material) in [(0.5, Material::HeadLight), (-0.5, Material::TailLight)] {
        for y in [-0.34, 0.34] {
            let (low, high) = (share(x, y, 0.42), share(x, y, 0.5));
            mesh.cuboid(low.plus(-0.06, -0.18, 0.0), high.plus(0.02, 0.18, 0.0), material);
        }
    }
    mesh
}

pub(crate) fn crown() -> Builder {
    let mut mesh = Builder::new([0.5, 0.5, 1.0], 1.0);
    mesh.cuboid(unit(-0.022, -0.022, 0.0), unit(0.022, 0.022, 0.4), Material::Wood);
    let middle = unit(0.0, 0.0, 0.66);
    mesh.ball([middle, middle], [0.25, 0.25, 0.34], 4, 5, Material::Body);
    mesh
}

/// A trunk and three boughs.
pub(crate) fn bare() -> Builder {
    let mut mesh = Builder::new([0.5, 0.5, 1.0], 1.0);
    mesh.cuboid(unit(-0.02, -0.02, 0.0), unit(0.02, 0.02, 0.72), Material::Wood);
    for [x, y] in [[0.15, 0.05], [-0.12, 0.1], [-0.02, -0.16]] {
        mesh.tube([unit(0.0, 0.0, 0.38), unit(x, y, 0.66)], [0.012, 0.006], 3, Material::Wood);
    }
    mesh
}

/// Offsets in radii, round y.
pub(crate) fn wheel() -> Builder {
    let mut mesh = Builder::new([1.0; 3], 1.0);
    mesh.tube([unit(0.0, -0.33, 0.0), unit(0.0, 0.33, 0.0)], [1.0; 2], 8, Material::Rubber);
    for y in [-0.34_f32, 0.34] {
        let disc = |x: f32, z: f32| unit(0.5 * x * y.signum(), y, 0.5 * z);
        mesh.quad([disc(1.0, 1.0), disc(-1.0, 1.0), disc(-1.0, -1.0), disc(1.0, -1.0)], Material::Metal);
    }
    mesh
}

/// Offsets in radii.
pub(crate) fn bin() -> Builder {
    let mut mesh = Builder::new([2.0, 2.0, 3.6], 1.0);
    mesh.tube([BOTTOM, share(0.0, 0.0, 0.86)], [0.82, 0.95], 6, Material::Body);
    mesh.tube([share(0.0, 0.0, 0.86), TOP], [0.95, 0.5], 6, Material::Second);
    mesh
}

pub(crate) fn bench() -> Builder {
    let mut mesh = Builder::new([0.6, 1.8, 0.85], 1.0);
    mesh.cuboid(share(-0.42, -0.5, 0.46), share(0.46, 0.5, 0.5), Material::Body);
    mesh.cuboid(share(-0.5, -0.5, 0.62), share(-0.42, 0.5, 0.98), Material::Body);
    mesh
}

pub(crate) fn roof_unit() -> Builder {
    let mut mesh = Builder::new([1.0; 3], 1.0);
    mesh.cuboid(LOW.plus(0.0, 0.0, 0.12), HIGH.plus(0.0, 0.0, 0.04), Material::White);
    mesh
}
