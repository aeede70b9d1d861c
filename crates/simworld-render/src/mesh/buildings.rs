//! Buildings: walls flush with the solid, so that depth and collisions agree; roofs inside it. Offsets in metres.

use super::builder::{Builder, Material, P, share};
use super::primitives::{BOTTOM, HIGH, LOW, TOP};

/// Height and width of a parapet, m.
pub(super) const PARAPET: [f32; 2] = [0.7, 0.3];

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

/// How far below the top the walls of a pitched roof end, and how far its eaves reach out, m.
pub(super) const RISE: f32 = 2.2;
const EAVES: f32 = 0.35;

/// Where a ridge runs.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Ridge {
    /// Along the street, which is y.
    Across,
    /// Away from the street, along x.
    Along,
}

impl Ridge {
    /// A point whose first share is across the ridge and whose second is along it.
    fn at(self, across: f32, along: f32, z: f32) -> P {
        match self {
            Self::Across => share(across, along, z),
            Self::Along => share(-along, across, z),
        }
    }

    fn plus(self, p: P, across: f32, along: f32, up: f32) -> P {
        match self {
            Self::Across => p.plus(across, along, up),
            Self::Along => p.plus(-along, across, up),
        }
    }
}

/// A pitched roof with gables, or with four slopes where the ridge is shorter than the house by `hip` at both ends.
pub(crate) fn house(run: Ridge, hip: f32) -> Builder {
    let mut mesh = Builder::new([10.0, 12.0, 7.0], 1.0);
    walls(&mut mesh, RISE);
    // The eaves are as much lower as they reach out.
    let eave = |x: f32, y: f32| {
        let wall = run.at(0.5 * x, 0.5 * y, 1.0);
        run.plus(wall, EAVES * x, EAVES * y, -RISE - 0.15)
    };
    let verge = |x: f32, y: f32| {
        let wall = run.at(0.5 * x, 0.5 * y, 1.0);
        run.plus(wall, EAVES * x, 0.2 * y, -RISE - 0.15)
    };
    let gabled = hip == 0.0;
    let foot = |x: f32, y: f32| if gabled { verge(x, y) } else { eave(x, y) };
    let ridge = |y: f32| {
        let top = run.at(0.0, (0.5 - hip) * y, 1.0);
        if gabled { run.plus(top, 0.0, 0.2 * y, 0.0) } else { top }
    };
    for side in [1.0, -1.0] {
        mesh.quad([foot(side, -side), foot(side, side), ridge(side), ridge(-side)], Material::Second);
        // What one sees of the roof from below.
        let under = [ridge(-side), ridge(side), foot(side, side), foot(side, -side)];
        mesh.quad(under.map(|p| p.plus(0.0, 0.0, -0.12)), Material::Wood);
        let hem = |p: P| p.plus(0.0, 0.0, -0.12);
        let [a, b] = [foot(side, -side), foot(side, side)];
        mesh.quad([hem(a), hem(b), b, a], Material::White);
    }
    for side in [1.0, -1.0] {
        if gabled {
            // A gable is a triangle: the ridge stands twice. The wall goes on to it.
            let wall = |x: f32| run.plus(run.at(0.5 * x, 0.5 * side, 1.0), 0.0, 0.0, -RISE);
            let top = run.plus(run.at(0.0, 0.5 * side, 1.0), 0.0, 0.0, -0.1);
            mesh.quad([wall(-side), top, top, wall(side)], Material::Body);
            // The edges of the slopes.
            for x in [side, -side] {
                let (low, high) = (foot(x, side), ridge(side));
                let hem = |p: P| p.plus(0.0, 0.0, -0.14);
                let band = [hem(low), hem(high), high, low];
                let [a, b, c, d] = band;
                mesh.quad(if x * side > 0.0 { [b, a, d, c] } else { [a, b, c, d] }, Material::White);
            }
        } else {
            mesh.quad([foot(side, side), foot(-side, side), ridge(side), ridge(side)], Material::Second);
            let [a, b] = [foot(side, side), foot(-side, side)];
            let hem = |p: P| p.plus(0.0, 0.0, -0.12);
            mesh.quad([hem(a), hem(b), b, a], Material::White);
            mesh.quad([ridge(side), ridge(side), b, a].map(hem), Material::Wood);
        }
    }
    mesh
}

/// One slope, up from the street.
pub(crate) fn shed() -> Builder {
    let mut mesh = Builder::new([10.0, 12.0, 7.0], 1.0);
    walls(&mut mesh, RISE);
    let low = |y: f32| share(0.5, 0.5 * y, 1.0).plus(0.0, 0.0, -RISE);
    let high = |y: f32| share(-0.5, 0.5 * y, 1.0);
    let sill = |y: f32| high(y).plus(0.0, 0.0, -RISE);
    mesh.quad([low(-1.0), low(1.0), high(1.0), high(-1.0)], Material::Second);
    mesh.quad([sill(1.0), sill(-1.0), high(-1.0), high(1.0)], Material::Body);
    mesh.quad([low(1.0), sill(1.0), high(1.0), high(1.0)], Material::Body);
    mesh.quad([sill(-1.0), low(-1.0), high(-1.0), high(-1.0)], Material::Body);
    mesh
}

/// A block of a few pixels.
pub(crate) fn far_block() -> Builder {
    let mut mesh = Builder::new([12.0, 16.0, 20.0], 1.0);
    walls(&mut mesh, 0.0);
    mesh.quad(
        [share(0.5, -0.5, 1.0), share(0.5, 0.5, 1.0), share(-0.5, 0.5, 1.0), share(-0.5, -0.5, 1.0)],
        Material::Second,
    );
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
