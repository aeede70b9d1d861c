//! Assets with models for tests: balls, and boards with a picture.

use std::sync::Arc;

use simworld_core::asset::{
    Asset, Finish, Hull, Model, ModelImage, ModelPart, ModelTexture, ModelVertex, Wrap,
};
use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::ops;
use simworld_core::scene::{EntityKind, Shape, World};

/// The corners of a box that stands on its origin.
fn corners([length, width, height]: [f32; 3]) -> Vec<[f32; 3]> {
    let half = [length * 0.5, width * 0.5];
    let corner = |k: u32| {
        let side = |axis: usize| if k >> axis & 1 == 0 { -half[axis] } else { half[axis] };
        [side(0), side(1), if k >> 2 == 0 { 0.0 } else { height }]
    };
    (0..8).map(corner).collect()
}

fn asset(name: &str, model: Model, size: [f32; 3]) -> Asset {
    let [length, width, height] = size.map(f64::from);
    let model = Model { hulls: vec![Hull { points: corners(size) }], ..model };
    Asset {
        model: Some(Arc::new(model)),
        ..Asset::new(name, EntityKind::Prop, Shape::cuboid(length, width, height))
    }
}

/// A ball of 1 m that stands on its origin, smooth but for a thousandth.
pub(crate) fn ball(color: [f32; 3], finish: Finish) -> Asset {
    const RINGS: u32 = 64;
    let mut model = Model::default();
    for ring in 0..=RINGS {
        let polar = std::f64::consts::PI * f64::from(ring) / f64::from(RINGS);
        for step in 0..=2 * RINGS {
            let turn = std::f64::consts::PI * f64::from(step) / f64::from(RINGS);
            let ((out, up), (side, ahead)) = (ops::sin_cos(polar), ops::sin_cos(turn));
            let normal = [out * ahead, out * side, up].map(|part| part as f32);
            let position = [normal[0], normal[1], normal[2] + 1.0];
            model.vertices.push(ModelVertex { position, normal, color, ..ModelVertex::default() });
        }
    }
    let at = |ring: u32, step: u32| ring * (2 * RINGS + 1) + step;
    for (ring, step) in (0..RINGS).flat_map(|ring| (0..2 * RINGS).map(move |step| (ring, step))) {
        let [a, b, c, d] = [at(ring, step), at(ring + 1, step), at(ring + 1, step + 1), at(ring, step + 1)];
        model.triangles.extend([[a, b, c], [a, c, d]].into_iter().skip(usize::from(ring == RINGS - 1)));
    }
    let triangles = model.triangles.len() as u32;
    model.parts.push(ModelPart { name: "ball".into(), triangles, finish, ..ModelPart::default() });
    asset("ball", model, [2.0; 3])
}

/// A board of 2 m by 2 m, and 0.2 m thick, that shows a picture to its back: seen from there it reaches from `places[0]` in its upper
/// left corner to `places[1]` in its lower right one. Without a picture it is white.
pub(crate) fn board(image: Option<ModelImage>, places: [[f32; 2]; 2], wrap: [Wrap; 2]) -> Asset {
    let size = [0.2, 2.0, 2.0];
    let points = corners(size);
    let faces: [([usize; 4], [f32; 3]); 6] = [
        ([0, 4, 6, 2], [-1.0, 0.0, 0.0]),
        ([1, 3, 7, 5], [1.0, 0.0, 0.0]),
        ([0, 2, 3, 1], [0.0, 0.0, -1.0]),
        ([4, 5, 7, 6], [0.0, 0.0, 1.0]),
        ([0, 1, 5, 4], [0.0, -1.0, 0.0]),
        ([2, 6, 7, 3], [0.0, 1.0, 0.0]),
    ];
    let mut model = Model::default();
    for (corners, normal) in faces {
        let first = model.vertices.len() as u32;
        model.vertices.extend(corners.map(|corner| {
            let position = points[corner];
            // From behind, left is left of the body.
            let (right, down) = ((1.0 - position[1]) * 0.5, (2.0 - position[2]) * 0.5);
            let between =
                |axis: usize, share: f32| places[0][axis] + (places[1][axis] - places[0][axis]) * share;
            let place = [between(0, right), between(1, down)];
            ModelVertex { position, normal, color: [1.0; 3], place, ..ModelVertex::default() }
        }));
        model.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
    }
    let part = |name: &str, triangles| ModelPart { name: name.into(), triangles, ..ModelPart::default() };
    let texture = image.is_some().then_some(ModelTexture { image: 0, wrap });
    model.parts = vec![ModelPart { texture, ..part("front", 2) }, part("rest", 10)];
    model.images = image.into_iter().collect();
    asset("board", model, size)
}

/// A world with one of an asset, whose foot is there.
pub(crate) fn alone(asset: &Asset, at: [f64; 3]) -> (World, EntityId) {
    let mut world = World::new();
    let id = add(&mut world, asset, at);
    (world, id)
}

/// Puts one of an asset, whose foot is there, into a world.
pub(crate) fn add(world: &mut World, asset: &Asset, at: [f64; 3]) -> EntityId {
    let id = world.add_asset(asset.clone()).expect("it is an asset");
    let pose = pose_facing(Point3::new(at[0], at[1], at[2]), 0.0);
    world.spawn(asset.at(id, pose)).expect("a solid in the world")
}

/// A card of 2 m by 2 m and 2 cm, with the same picture on both of its faces and nothing at its rims; from either side it is seen with its upper
/// left corner at `places[0]` and its lower right one at `places[1]`, mirrored from the front. Faces are of one part, which somebody makes what it is.
pub(crate) fn card(image: ModelImage, places: [[f32; 2]; 2], finish: impl FnOnce(&mut ModelPart)) -> Asset {
    let size = [0.02, 2.0, 2.0];
    let points = corners(size);
    let mut model = Model { images: vec![image], ..Model::default() };
    for (corners, ahead) in [([0, 4, 6, 2], -1.0), ([1, 3, 7, 5], 1.0)] {
        let first = model.vertices.len() as u32;
        model.vertices.extend(corners.map(|corner: usize| {
            let position = points[corner];
            let share = [(1.0 - position[1]) * 0.5, (2.0 - position[2]) * 0.5];
            let place = std::array::from_fn(|axis| {
                places[0][axis] + (places[1][axis] - places[0][axis]) * share[axis]
            });
            ModelVertex {
                position,
                normal: [ahead, 0.0, 0.0],
                color: [1.0; 3],
                place,
                ..ModelVertex::default()
            }
        }));
        model.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
    }
    let texture = Some(ModelTexture { image: 0, wrap: [Wrap::Clamp; 2] });
    let mut part = ModelPart { name: "card".into(), triangles: 4, texture, ..ModelPart::default() };
    finish(&mut part);
    model.parts = vec![part];
    asset("card", model, size)
}

/// A leaf of 2 m by 2 m that leans by a centimetre, and is there from its back alone; of one part, which somebody makes what it is.
pub(crate) fn leaf(image: ModelImage, finish: impl FnOnce(&mut Model)) -> Asset {
    let size = [0.02, 2.0, 2.0];
    let corners = [(-0.01, 1.0, 0.0), (0.01, 1.0, 2.0), (0.01, -1.0, 2.0), (-0.01, -1.0, 0.0)];
    let slope = f64::from(size[0] / size[2]);
    let normal = [-1.0, 0.0, slope].map(|part| (part / (slope * slope + 1.0).sqrt()) as f32);
    let vertex = |(x, y, z): (f32, f32, f32)| ModelVertex {
        position: [x, y, z],
        normal,
        color: [1.0; 3],
        place: [(1.0 - y) * 0.5, (2.0 - z) * 0.5],
        ..ModelVertex::default()
    };
    let texture = Some(ModelTexture { image: 0, wrap: [Wrap::Clamp; 2] });
    let part = ModelPart { name: "leaf".into(), triangles: 2, texture, ..ModelPart::default() };
    let mut model = Model {
        vertices: corners.map(vertex).to_vec(),
        triangles: vec![[0, 2, 1], [0, 3, 2]],
        images: vec![image],
        parts: vec![part],
        ..Model::default()
    };
    finish(&mut model);
    asset("leaf", model, size)
}
