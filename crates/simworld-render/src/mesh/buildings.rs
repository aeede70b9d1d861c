//! Buildings: walls flush with the solid, so that depth and collisions agree; roofs inside it. Offsets in metres.

use super::builder::{Builder, Material, share};
use super::primitives::{BOTTOM, HIGH, LOW, TOP};

/// Height and width of a parapet, m.
const PARAPET: [f32; 2] = [0.7, 0.3];

fn walls(mesh: &mut Builder, drop: f32) {
    let ring = |z: f32, dz: f32| {
        [[0.5, -0.5], [0.5, 0.5], [-0.5, 0.5], [-0.5, -0.5]].map(|[x, y]| share(x, y, z).plus(0.0, 0.0, dz))
    };
    let (low, high) = (ring(0.0, 0.0), ring(1.0, -drop));
    for k in 0..4 {
        let next = (k + 1) % 4;
        mesh.quad([low[k], low[next], high[next], high[k]], Material::Body);
    }
    mesh.quad([low[3], low[2], low[1], low[0]], Material::Dark);
}

/// A flat roof behind a parapet, with a lift house.
pub(crate) fn block() -> Builder {
    let mut mesh = Builder::new([12.0, 16.0, 20.0], 1.0);
    let [drop, width] = PARAPET;
    walls(&mut mesh, 0.0);
    let signs = [[1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0]];
    let outer = signs.map(|[x, y]| share(0.5 * x, 0.5 * y, 1.0));
    let inner = signs.map(|[x, y]| share(0.5 * x, 0.5 * y, 1.0).plus(-x * width, -y * width, 0.0));
    let floor = inner.map(|corner| corner.plus(0.0, 0.0, -drop));
    for k in 0..4 {
        let next = (k + 1) % 4;
        mesh.quad([outer[k], outer[next], inner[next], inner[k]], Material::White);
        mesh.quad([inner[next], floor[next], floor[k], inner[k]], Material::White);
    }
    mesh.quad(floor, Material::Second);
    let corner = share(-0.28, 0.1, 1.0).plus(0.0, 0.0, -drop);
    mesh.cuboid(corner, share(-0.05, 0.32, 1.0).plus(0.0, 0.0, -0.05), Material::Metal);
    mesh
}

/// A pitched roof whose ridge follows the street, with gables and a chimney.
pub(crate) fn house() -> Builder {
    let mut mesh = Builder::new([10.0, 12.0, 7.0], 1.0);
    let drop = 2.2;
    walls(&mut mesh, drop);
    let eave = |x: f32, y: f32| share(0.5 * x, 0.5 * y, 1.0).plus(0.0, 0.0, -drop);
    let ridge = |y: f32| share(0.0, 0.5 * y, 1.0);
    mesh.quad([eave(1.0, -1.0), eave(1.0, 1.0), ridge(1.0), ridge(-1.0)], Material::Second);
    mesh.quad([eave(-1.0, 1.0), eave(-1.0, -1.0), ridge(-1.0), ridge(1.0)], Material::Second);
    for side in [1.0, -1.0] {
        // A gable is a triangle: the ridge stands twice.
        mesh.quad([eave(-side, side), ridge(side), ridge(side), eave(side, side)], Material::White);
    }
    let foot = share(-0.2, 0.25, 1.0);
    mesh.cuboid(foot.plus(-0.3, -0.3, -1.4), foot.plus(0.3, 0.3, 0.0), Material::Dark);
    mesh
}

/// A shelter at a bus stop, open towards +x.
pub(crate) fn bus_stop() -> Builder {
    let mut mesh = Builder::new([1.4, 4.0, 2.5], 1.0);
    mesh.cuboid(LOW.plus(0.0, 0.0, 0.0), share(-0.5, 0.5, 0.0).plus(0.05, 0.0, 0.15), Material::Metal);
    mesh.cuboid(share(-0.5, -0.5, 1.0).plus(0.0, 0.0, -0.12), HIGH, Material::Body);
    mesh.cuboid(
        share(-0.5, -0.5, 0.0).plus(0.0, 0.06, 0.15),
        share(-0.5, 0.5, 1.0).plus(0.04, -0.06, -0.12),
        Material::Glass,
    );
    for (x, y) in [(0.5, 0.5), (0.5, -0.5), (-0.5, 0.5), (-0.5, -0.5)] {
        let foot = share(x, y, 0.0).plus(-x * 0.12, -y * 0.12, 0.0);
        mesh.tube(
            [foot, share(x, y, 1.0).plus(-x * 0.12, -y * 0.12, -0.12)],
            [0.04, 0.04],
            8,
            Material::Metal,
        );
    }
    mesh.cuboid(
        share(-0.5, -0.35, 0.0).plus(0.12, 0.0, 0.4),
        share(-0.5, 0.35, 0.0).plus(0.5, 0.0, 0.46),
        Material::Wood,
    );
    mesh
}

/// A post with a round plate at its head that looks along +x. Offsets in metres.
pub(crate) fn sign() -> Builder {
    let mut mesh = Builder::new([0.1, 0.1, 2.4], 1.0);
    mesh.tube([BOTTOM, TOP], [0.035, 0.035], 8, Material::Metal);
    let middle = TOP.plus(0.05, 0.0, -0.32);
    mesh.tube([middle, middle.plus(0.02, 0.0, 0.0)], [0.32, 0.32], 20, Material::Body);
    mesh.tube([middle.plus(0.02, 0.0, 0.0), middle.plus(0.026, 0.0, 0.0)], [0.22, 0.22], 20, Material::White);
    mesh
}
