//! The land as something to look at: an asset whose model has the very triangles of the ground.

use std::sync::Arc;

use simworld_core::asset::{Asset, Hull, Material, Model, ModelPart, ModelVertex};
use simworld_core::geometry::{Point3, Pose, pose_facing};
use simworld_core::ground::{Cover, Ground, GroundData};
use simworld_core::hash::StateHash;
use simworld_core::scene::{EntityKind, Shape};

/// Colours of covers, linear-light sRGB: reflectances of natural surfaces (USGS Spectral Library 7: grass, soil, sand, rock).
const fn color(cover: Cover) -> [f32; 3] {
    match cover {
        Cover::Meadow => [0.14, 0.17, 0.06],
        Cover::Wood => [0.055, 0.085, 0.03],
        Cover::Crop => [0.3, 0.26, 0.08],
        Cover::Soil => [0.15, 0.1, 0.065],
        Cover::Sand => [0.46, 0.39, 0.27],
        Cover::Rock => [0.2, 0.19, 0.175],
        Cover::Path => [0.32, 0.26, 0.18],
        Cover::Built => [0.16, 0.16, 0.12],
        _ => [0.095, 0.155, 0.045],
    }
}

/// The land as an asset, and where it stands.
pub(super) fn asset(ground: &Ground) -> (Asset, Pose) {
    let GroundData { spacing, columns, rows, heights, covers, .. } = ground.data();
    let (columns, rows) = (*columns as usize, *rows as usize);
    let low = heights.iter().copied().fold(f32::INFINITY, f32::min);
    let high = heights.iter().copied().fold(f32::NEG_INFINITY, f32::max);
    let (from, to) = ground.extent();
    let size = to - from;
    // A model without any height would be no solid.
    let tall = f64::from(high - low).max(0.01);
    let at = |column: usize, row: usize| heights[row * columns + column];
    let vertex = |index: usize| {
        let (column, row) = (index % columns, index / columns);
        let (west, east) = (at(column.saturating_sub(1), row), at((column + 1).min(columns - 1), row));
        let (south, north) = (at(column, row.saturating_sub(1)), at(column, (row + 1).min(rows - 1)));
        let run = 2.0 * *spacing as f32;
        let normal = nalgebra::Vector3::new((west - east) / run, (south - north) / run, 1.0_f32).normalize();
        // A little lighter and darker from place to place, so that large covers are no flat paint.
        let shade = 0.9 + 0.2 * speckle(index);
        ModelVertex {
            position: [
                (column as f64 * spacing - size.x * 0.5) as f32,
                (row as f64 * spacing - size.y * 0.5) as f32,
                heights[index] - low,
            ],
            normal: normal.into(),
            color: color(covers[index]).map(|channel| (channel * shade).min(1.0)),
            ..ModelVertex::default()
        }
    };
    let triangles: Vec<[u32; 3]> = (0..(columns - 1) * (rows - 1))
        .flat_map(|cell| {
            let corner = cell / (columns - 1) * columns + cell % (columns - 1);
            let [a, b, c, d] = [corner, corner + 1, corner + columns + 1, corner + columns].map(|i| i as u32);
            [[a, b, c], [a, c, d]]
        })
        .collect();
    let half = [size.x as f32 * 0.5, size.y as f32 * 0.5];
    let corners = |z: f32| {
        [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| [x * half[0], y * half[1], z])
    };
    let model = Model {
        vertices: (0..heights.len()).map(vertex).collect(),
        parts: vec![ModelPart {
            name: "land".to_owned(),
            triangles: triangles.len() as u32,
            ..ModelPart::default()
        }],
        triangles,
        // What bodies meet is the ground itself; a model has to have a hull all the same.
        hulls: vec![Hull { points: [corners(0.0), corners(tall as f32)].concat() }],
        ..Model::default()
    };
    let collider = Shape::cuboid(size.x, size.y, tall);
    let asset = Asset {
        material: Some(Material::Soil),
        source: "simworld, procedural".to_owned(),
        model: Some(Arc::new(model)),
        ..Asset::new(format!("land_{}", ground.digest()), EntityKind::Ground, collider)
    };
    let middle = nalgebra::center(&from, &to);
    (asset, pose_facing(Point3::new(middle.x, middle.y, f64::from(low)), 0.0))
}

/// A number in [0, 1) that neighbours do not share.
fn speckle(index: usize) -> f32 {
    // Knuth's multiplicative hash.
    ((index as u32).wrapping_mul(2_654_435_761) >> 8) as f32 / (1_u32 << 24) as f32
}
