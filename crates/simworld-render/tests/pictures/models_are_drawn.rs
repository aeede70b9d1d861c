//! Assets with a model are drawn as it: colour, depth, ids and shadows; stretched where the entity is larger.

use std::sync::Arc;

use simworld_core::asset::{Asset, Hull, Model, ModelPart, ModelVertex, Paint};
use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityKind, Scene, Shape, World};
use simworld_render::RenderConfig;

/// Two posts of 0.5 m with 1 m between them, 2 m high; the left one keeps
/// its blue, the right one has the colour of the entity.
fn posts() -> Asset {
    let mut model = Model::default();
    for (low, high, name, paint, color) in [
        (0.5_f32, 1.0_f32, "left", Paint::Own, [0.02, 0.02, 0.6]),
        (-1.0, -0.5, "right", Paint::Entity, [1.0; 3]),
    ] {
        let (low, high) = ([-0.25, low, 0.0], [0.25, high, 2.0]);
        let corner =
            |k: u32| std::array::from_fn(|axis| if k >> axis & 1 == 0 { low[axis] } else { high[axis] });
        let points: Vec<[f32; 3]> = (0..8).map(corner).collect();
        let faces = [
            ([0, 2, 3, 1], [0.0, 0.0, -1.0]),
            ([4, 5, 7, 6], [0.0, 0.0, 1.0]),
            ([0, 1, 5, 4], [0.0, -1.0, 0.0]),
            ([2, 6, 7, 3], [0.0, 1.0, 0.0]),
            ([0, 4, 6, 2], [-1.0, 0.0, 0.0]),
            ([1, 3, 7, 5], [1.0, 0.0, 0.0]),
        ];
        for (corners, normal) in faces {
            let first = model.vertices.len() as u32;
            model.vertices.extend(corners.map(|k: usize| ModelVertex {
                position: points[k],
                normal,
                color,
                ..ModelVertex::default()
            }));
            model.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
        }
        model.parts.push(ModelPart { name: name.to_owned(), triangles: 12, paint, ..ModelPart::default() });
        model.hulls.push(Hull { points });
    }
    Asset {
        model: Some(Arc::new(model)),
        ..Asset::new("posts", EntityKind::Prop, Shape::cuboid(0.5, 2.0, 2.0))
    }
}

/// Posts 10 m before a camera that looks east, with ground under them.
fn scene(stretch: f64) -> (World, EntityId) {
    let mut world = World::new();
    let ground = Shape::cuboid(200.0, 200.0, 0.05);
    crate::common::put(&mut world, EntityKind::Ground, [0.0, 0.0, -0.05], 0.0, ground);
    let asset = posts();
    let id = world.add_asset(asset.clone()).expect("posts are an asset");
    let mut desc = asset.at(id, pose_facing(Point3::new(10.0, 0.0, 0.0), 0.0)).colored([0.6, 0.02, 0.02]);
    desc.info.shape = Shape::cuboid(0.5, 2.0 * stretch, 2.0 * stretch);
    let id = world.spawn(desc).expect("a solid in the world");
    (world, id)
}

fn camera() -> Camera {
    let intrinsics = Intrinsics::from_fov(160, 120, 0.6).expect("a size in range");
    Camera::looking_along(&pose_facing(Point3::new(0.0, 0.0, 1.0), 0.0), intrinsics)
}

fn pixel(y: f64, z: f64) -> (u32, u32) {
    let point = Point3::new(9.75, y, z);
    let camera = camera();
    let optical = camera.world_from_optical.inverse_transform_point(&point);
    let (pixel, _) = camera.intrinsics.project(&optical).expect("it is before the camera");
    (pixel.x as u32, pixel.y as u32)
}

#[test]
fn colour_depth_and_ids_are_those_of_the_model() {
    let Some(mut renderer) = crate::common::renderer(&RenderConfig::default()) else { return };
    let (world, id) = scene(1.0);
    let frame = crate::common::draw(&mut renderer, &world, &camera());
    let at = |y: f64| {
        let (u, v) = pixel(y, 0.5);
        let look = (frame.entity_at(u, v), frame.depth_at(u, v), frame.rgb_at(u, v));
        (look.0, look.1.expect("on the picture"), look.2.expect("on the picture"))
    };
    let (left, depth, [r, _, b]) = at(0.75);
    assert_eq!(left, Some(id));
    assert!((depth - 9.75).abs() < 1e-3, "{depth}");
    assert!(b > r.saturating_add(60), "it keeps its blue: {r} {b}");
    let (right, depth, [r, _, b]) = at(-0.75);
    assert_eq!(right, Some(id));
    assert!((depth - 9.75).abs() < 1e-3, "{depth}");
    assert!(r > b.saturating_add(60), "it has the red of the entity: {r} {b}");
    let (between, depth, _) = at(0.0);
    assert!(between != Some(id) && depth > 12.0, "one looks through between the posts: {depth}");
}

#[test]
fn a_larger_entity_has_a_larger_model() {
    let Some(mut renderer) = crate::common::renderer(&RenderConfig::default()) else { return };
    let (world, id) = scene(1.5);
    let frame = crate::common::draw(&mut renderer, &world, &camera());
    let at = |y: f64, z: f64| {
        let (u, v) = pixel(y, z);
        frame.entity_at(u, v)
    };
    assert_eq!(
        (at(1.3, 2.7), at(-1.3, 2.7)),
        (Some(id), Some(id)),
        "the posts stand farther apart, and higher"
    );
    assert_ne!(at(0.6, 1.0), Some(id));
}

#[test]
fn models_throw_the_shadow_of_their_shape() {
    let Some(mut renderer) = crate::common::renderer(&RenderConfig::default()) else { return };
    let (world, _) = scene(1.0);
    // Low in the west the sun lays the shadows of the posts on the ground behind them.
    let mut lit = world.clone();
    let mut environment = *lit.environment();
    environment.sun.azimuth = 1.5 * std::f64::consts::PI;
    environment.sun.elevation = 0.6;
    lit.set_environment(environment).expect("a sun in range");
    let eye = Point3::new(11.6, 0.0, 12.0);
    let above = Camera::looking_at(eye, Point3::new(11.7, 0.0, 0.0), camera().intrinsics);
    let frame = crate::common::draw(&mut renderer, &lit, &above);
    let brightness = |y: f64| {
        let optical = above.world_from_optical.inverse_transform_point(&Point3::new(11.7, y, 0.0));
        let (pixel, _) = above.intrinsics.project(&optical).expect("before the camera");
        let [r, g, b] = frame.rgb_at(pixel.x as u32, pixel.y as u32).expect("on the picture");
        u32::from(r) + u32::from(g) + u32::from(b)
    };
    let (shade, light) = (brightness(0.75), brightness(0.0));
    assert!(shade * 4 < light * 3, "behind a post {shade}, between them {light}");
}

#[test]
fn another_scene_has_models_of_its_own() {
    let Some(mut renderer) = crate::common::renderer(&RenderConfig::default()) else { return };
    let (world, _) = scene(1.0);
    let first = crate::common::draw(&mut renderer, &world, &camera());
    let (other, _) = scene(1.5);
    crate::common::draw(&mut renderer, &other, &camera());
    let again = crate::common::draw(&mut renderer, &world, &camera());
    assert!(
        first.rgb == again.rgb && first.ids == again.ids,
        "what was drawn between has changed the picture"
    );
}
