//! Trees of other shapes than the ordinary one. Offsets in heights, so that a tree grows as a whole.

use simworld_core::ops;

use super::builder::{Builder, Material, P, Ring, V3, unit};

fn tree() -> Builder {
    Builder::new([0.5, 0.5, 1.0], 1.0)
}

fn upright([x, y, z]: V3) -> P {
    unit(x, y, z)
}

/// A direction round the trunk, and a length along it.
fn around(turn: f64, length: f32) -> [f32; 2] {
    let (sin, cos) = ops::sin_cos(std::f64::consts::TAU * turn);
    [length * cos as f32, length * sin as f32]
}

/// Tiers of needles round a straight trunk; `slim` of 1 is a spruce, less is slenderer.
pub(crate) fn conifer(slim: f32, sides: u32) -> Builder {
    let mut mesh = tree();
    mesh.tube([unit(0.0, 0.0, 0.0), unit(0.0, 0.0, 0.3)], [0.022, 0.016], 6, Material::Wood);
    for (low, high, radius) in
        [(0.1, 0.42, 0.21), (0.24, 0.56, 0.18), (0.4, 0.7, 0.145), (0.55, 0.83, 0.11), (0.7, 1.0, 0.075)]
    {
        let r = radius * slim;
        let rings: [Ring; 4] = [
            [low + 0.05, 0.0, 0.0, 0.0],
            [low, r, r, 0.0],
            [low + 0.1, r * 0.62, r * 0.62, 0.0],
            [high, 0.0, 0.0, 0.0],
        ];
        mesh.lathe(&rings, sides, Material::Body, &upright);
    }
    mesh
}

/// One tall column of leaves.
pub(crate) fn column(sides: u32) -> Builder {
    let mut mesh = tree();
    mesh.tube([unit(0.0, 0.0, 0.0), unit(0.0, 0.0, 0.15)], [0.02, 0.018], 6, Material::Wood);
    let rings: [Ring; 7] = [
        [0.06, 0.0, 0.0, 0.0],
        [0.1, 0.05, 0.05, 0.0],
        [0.25, 0.095, 0.09, 0.005],
        [0.5, 0.105, 0.1, -0.004],
        [0.75, 0.08, 0.085, 0.004],
        [0.93, 0.035, 0.035, 0.0],
        [1.0, 0.0, 0.0, 0.0],
    ];
    mesh.lathe(&rings, sides, Material::Body, &upright);
    mesh
}

/// A crown whose branches hang down.
pub(crate) fn willow() -> Builder {
    let mut mesh = tree();
    mesh.tube([unit(0.0, 0.0, 0.0), unit(0.0, 0.0, 0.6)], [0.035, 0.02], 8, Material::Wood);
    let rings: [Ring; 5] = [
        [0.5, 0.0, 0.0, 0.0],
        [0.52, 0.2, 0.2, 0.0],
        [0.7, 0.24, 0.24, 0.0],
        [0.9, 0.15, 0.15, 0.0],
        [0.98, 0.0, 0.0, 0.0],
    ];
    mesh.lathe(&rings, 12, Material::Body, &upright);
    for k in 0..11_u8 {
        let [x, y] = around(f64::from(k) / 11.0, 0.22 + 0.03 * f32::from(k % 2));
        let hang = 0.12 + 0.07 * f32::from(k % 3);
        let strand: [Ring; 4] = [
            [hang, 0.0, 0.0, 0.0],
            [hang + 0.06, 0.045, 0.045, 0.0],
            [0.6, 0.07, 0.07, 0.0],
            [0.82, 0.0, 0.0, 0.0],
        ];
        mesh.lathe(&strand, 6, Material::Body, &|[a, b, z]| unit(a + x, b + y, z));
    }
    mesh
}

/// A bent trunk with a tuft of fronds.
pub(crate) fn palm() -> Builder {
    let mut mesh = tree();
    let spine = [[0.0, 0.0], [0.02, 0.3], [0.05, 0.6], [0.09, 0.9]].map(|[x, z]| unit(x, 0.0, z));
    for k in 0..3 {
        let thick = 0.026 - 0.004 * k as f32;
        mesh.tube([spine[k], spine[k + 1]], [thick, thick - 0.004], 7, Material::Wood);
    }
    let top = spine[3];
    for k in 0..11_u8 {
        let turn = f64::from(k) / 11.0;
        let droop = 0.04 * f32::from(k % 3);
        let [x, y] = around(turn, 1.0);
        let [sx, sy] = around(turn + 0.25, 0.035);
        let at =
            |along: f32, up: f32, aside: f32| top.plus(x * along + sx * aside, y * along + sy * aside, up);
        let rib = [at(0.0, 0.0, 0.0), at(0.15, 0.07 - droop, 0.0), at(0.3, -0.03 - 2.0 * droop, 0.0)];
        for side in [-1.0, 1.0] {
            let edge = [
                at(0.02, -0.01, side * 0.5),
                at(0.16, 0.03 - droop, side),
                at(0.27, -0.06 - 2.0 * droop, side * 0.5),
            ];
            for j in 0..2 {
                let leaf = [rib[j], rib[j + 1], edge[j + 1], edge[j]];
                let back = [rib[j], edge[j], edge[j + 1], rib[j + 1]];
                let (upper, lower) = if side < 0.0 { (back, leaf) } else { (leaf, back) };
                mesh.quad(upper, Material::Body);
                mesh.quad(lower.map(|p| p.plus(0.0, 0.0, -0.002)), Material::Body);
            }
        }
    }
    mesh
}

/// Bare twigs: boughs that fork `forks` times.
pub(crate) fn bare(forks: u32) -> Builder {
    let mut mesh = tree();
    mesh.tube([unit(0.0, 0.0, 0.0), unit(0.0, 0.0, 0.42)], [0.028, 0.018], 7, Material::Wood);
    mesh.tube([unit(0.0, 0.0, 0.4), unit(0.01, 0.0, 0.72)], [0.017, 0.006], 5, Material::Wood);
    for k in 0..6_u8 {
        let turn = f64::from(k) * 0.381_966;
        let low = 0.34 + 0.05 * f32::from(k);
        bough(&mut mesh, unit(0.0, 0.0, low), turn, 0.2 - 0.012 * f32::from(k), 0.011, forks);
    }
    mesh
}

/// A bough from a point outward and up, with what grows from it.
fn bough(mesh: &mut Builder, from: P, turn: f64, length: f32, thick: f32, forks: u32) {
    let [x, y] = around(turn, length);
    let tip = from.plus(x * 0.75, y * 0.75, length * 0.75);
    mesh.tube([from, tip], [thick, thick * 0.5], 4, Material::Wood);
    if forks == 0 {
        return;
    }
    let middle = from.plus(x * 0.4, y * 0.4, length * 0.4);
    for (root, aside) in [(middle, 0.13), (tip, 0.06), (tip, -0.1)] {
        bough(mesh, root, turn + aside, length * 0.6, thick * 0.5, forks - 1);
    }
}

/// A crown of a few pixels on a trunk.
pub(crate) fn far_crown(width: f32, low: f32) -> Builder {
    let mut mesh = tree();
    mesh.tube([unit(0.0, 0.0, 0.0), unit(0.0, 0.0, 0.45)], [0.026, 0.02], 4, Material::Wood);
    let center = unit(0.0, 0.0, (1.0 + low) * 0.5);
    mesh.ball([center, center], [width, width, (1.0 - low) * 0.5], 4, 7, Material::Body);
    mesh
}

/// Some triangles of foliage in place of many: the ordinary crown from a little farther away.
pub(crate) fn middle_crown() -> Builder {
    let mut mesh = tree();
    mesh.tube([unit(0.0, 0.0, 0.0), unit(0.0, 0.0, 0.45)], [0.028, 0.018], 6, Material::Wood);
    for ([x, y, z], radius) in [
        ([0.0, 0.0, 0.66], 0.215),
        ([0.115, 0.05, 0.55], 0.15),
        ([-0.1, 0.09, 0.53], 0.155),
        ([0.01, -0.125, 0.56], 0.145),
        ([-0.03, 0.02, 0.83], 0.165),
    ] {
        let center = unit(x, y, z);
        mesh.ball([center, center], [radius, radius, radius * 0.95], 6, 8, Material::Body);
    }
    mesh
}
