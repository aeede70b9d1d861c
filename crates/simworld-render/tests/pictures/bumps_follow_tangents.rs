//! Bumps stand in the frame that tangents of vertices say, where there are some, and else in that of each triangle; alike by triangles and by rays.

use std::sync::Arc;

use crate::common::models::{alone, ball, board, leaf};
use crate::common::{difference, draw, renderer};
use simworld_core::asset::{Asset, Content, Finish, Model, ModelImage, ModelTexture, Wrap};
use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::ops;
use simworld_core::scene::{Scene, World};
use simworld_render::{Backend, Frame, RenderConfig, Renderer};

/// Numbers of normals that lean by 30 degrees to the right, to the left, or to the top of a picture.
const RIGHT: [u8; 3] = [191, 128, 238];
const LEFT: [u8; 3] = [64, 128, 238];
const TOP: [u8; 3] = [128, 191, 238];

fn backends() -> Option<[Renderer; 2]> {
    let with = |backend| renderer(&RenderConfig { backend, ..RenderConfig::default() });
    Some([with(Backend::Raster)?, with(Backend::Raycast)?])
}

/// From the origin to the east, or from beyond what stands there back.
fn camera(from_beyond: bool) -> Camera {
    let intrinsics = Intrinsics::from_fov(120, 120, 0.5).expect("a size in range");
    let (x, yaw) = if from_beyond { (10.0, std::f64::consts::PI) } else { (0.0, 0.0) };
    Camera::looking_along(&pose_facing(Point3::new(x, 0.0, 0.0), yaw), intrinsics)
}

/// Under a low sun in the south-west, behind the camera at the origin.
fn sunny(asset: &Asset, at: [f64; 3]) -> World {
    let (mut world, _) = alone(asset, at);
    let mut environment = *world.environment();
    (environment.sun.azimuth, environment.sun.elevation) = (1.2 * std::f64::consts::PI, 0.25);
    environment.weather.cloud_cover = 0.0;
    world.set_environment(environment).expect("a sun in range");
    world
}

/// The same asset with bumps of one lean all over its first part.
fn bumpy(mut asset: Asset, lean: [u8; 3], change: impl FnOnce(&mut Model)) -> Asset {
    let model = Arc::make_mut(asset.model.as_mut().expect("it has a model"));
    let image = ModelImage {
        width: 1,
        height: 1,
        pixels: lean.to_vec(),
        content: Content::Numbers,
        ..ModelImage::default()
    };
    let texture = ModelTexture { image: model.images.len() as u32, wrap: [Wrap::Repeat; 2] };
    model.images.push(image);
    model.parts[0].pictures.bumps = Some(texture);
    change(model);
    asset
}

/// A grey board, whose back is seen from the origin: right on its pictures is to the south, -y, and their top is up.
fn plain() -> Asset {
    let mut asset = board(None, [[0.0; 2], [1.0; 2]], [Wrap::Repeat; 2]);
    let model = Arc::make_mut(asset.model.as_mut().expect("it has a model"));
    model.vertices.iter_mut().for_each(|vertex| vertex.color = [0.2; 3]);
    asset
}

fn alike(name: &str, a: &Frame, b: &Frame) {
    let (mean, many) = difference(&a.rgb, &b.rgb, 3);
    assert!(many < 1e-3, "{name}: {mean} in the mean, on {many} by more than three");
}

/// How bright the middle of a picture is.
fn middle(frame: &Frame) -> f64 {
    f64::from(frame.rgb_at(60, 60).expect("on the picture")[1])
}

#[test]
fn tangents_say_which_way_is_right() {
    let Some(renderers) = backends() else { return };
    for mut renderer in renderers {
        let mut seen = |lean, tangent: Option<[f32; 4]>| {
            let asset = bumpy(plain(), lean, |model| {
                model.tangents = tangent.map_or_else(Vec::new, |one| vec![one; model.vertices.len()]);
            });
            draw(&mut renderer, &sunny(&asset, [5.0, 0.0, -1.0]), &camera(false))
        };
        let [right, left, top] = [RIGHT, LEFT, TOP].map(|lean| seen(lean, None));
        for (a, b) in [(&right, &left), (&right, &top), (&left, &top)] {
            assert!((middle(a) - middle(b)).abs() > 6.0, "{} and {}", middle(a), middle(b));
        }
        // Those that the triangles have, too.
        alike("south", &seen(RIGHT, Some([0.0, -1.0, 0.0, 1.0])), &right);
        alike("south, to the top", &seen(TOP, Some([0.0, -1.0, 0.0, 1.0])), &top);
        // Up is right: then the top is to the left, or, of pictures that are mirrored, to the right.
        alike("up", &seen(RIGHT, Some([0.0, 0.0, 1.0, 1.0])), &top);
        alike("up, to the top", &seen(TOP, Some([0.0, 0.0, 1.0, 1.0])), &left);
        alike("up, mirrored", &seen(TOP, Some([0.0, 0.0, 1.0, -1.0])), &right);
        // A tangent that leans out of the surface is laid down on it, and none is none.
        alike("aslant", &seen(RIGHT, Some([-0.6, -0.8, 0.0, 1.0])), &right);
        alike("none", &seen(TOP, Some([0.0; 4])), &top);
    }
}

/// Of a leaf with two sides bumps stand out on both, with tangents as without.
#[test]
fn both_sides_have_the_frame_of_the_picture() {
    let Some(renderers) = backends() else { return };
    for mut renderer in renderers {
        for lean in [RIGHT, TOP] {
            let of = |tangents: bool| {
                let image = ModelImage { width: 1, height: 1, pixels: vec![160; 3], ..ModelImage::default() };
                bumpy(leaf(image, |model| model.parts[0].two_sided = true), lean, |model| {
                    if tangents {
                        model.tangents = vec![[0.0, -1.0, 0.0, 1.0]; model.vertices.len()];
                    }
                })
            };
            for from_beyond in [false, true] {
                let [with, without] = [true, false].map(|tangents| {
                    draw(&mut renderer, &sunny(&of(tangents), [5.0, 0.0, -1.0]), &camera(from_beyond))
                });
                alike(if from_beyond { "from beyond" } else { "from here" }, &with, &without);
            }
        }
    }
}

/// A ball with waves on it, whose right is where its circles of latitude go; the frames of its many triangles are the same but for a hair.
fn wavy(tangents: bool) -> Asset {
    let rings = 64_u32;
    let mut asset = ball([0.5; 3], Finish { roughness: 0.5, ..Finish::default() });
    let model = Arc::make_mut(asset.model.as_mut().expect("it has a model"));
    for (index, vertex) in (0..).zip(&mut model.vertices) {
        let (ring, step) = (index / (2 * rings + 1), index % (2 * rings + 1));
        vertex.place = [step as f32 / (2 * rings) as f32, ring as f32 / rings as f32];
        if tangents {
            let turn = std::f64::consts::PI * f64::from(step) / f64::from(rings);
            let (sine, cosine) = ops::sin_cos(turn);
            model.tangents.push([-sine as f32, cosine as f32, 0.0, 1.0]);
        }
    }
    let wave = |k: u32| {
        let across = 0.5 * ops::sin(std::f64::consts::TAU * f64::from(k) / 16.0);
        let out = (1.0 - across * across).sqrt();
        [across, 0.0, out].map(|part| ((part * 0.5 + 0.5) * 255.0).round() as u8)
    };
    let pixels = (0..128 * 4).flat_map(|k| wave(k % 128)).collect();
    let image =
        ModelImage { width: 128, height: 4, pixels, content: Content::Numbers, ..ModelImage::default() };
    model.parts[0].pictures.bumps = Some(ModelTexture { image: 0, wrap: [Wrap::Repeat, Wrap::Clamp] });
    model.images = vec![image];
    asset
}

#[test]
fn both_backends_tilt_alike_and_fine_triangles_as_tangents_do() {
    let Some(mut renderers) = backends() else { return };
    let [with, without] = [true, false].map(|tangents| sunny(&wavy(tangents), [5.0, 0.3, -0.9]));
    let even = sunny(&ball([0.5; 3], Finish { roughness: 0.5, ..Finish::default() }), [5.0, 0.3, -0.9]);
    let frames = renderers.each_mut().map(|renderer| {
        let [told, found, even] = [&with, &without, &even].map(|world| draw(renderer, world, &camera(false)));
        assert!(told.depth == found.depth && told.ids == found.ids, "it is colour alone");
        let (mean, many) = difference(&told.rgb, &found.rgb, 12);
        println!("told and found differ by {mean:.3}, on {:.2} % by more than 12", many * 100.0);
        assert!(mean < 1.5 && many < 0.02, "told and found differ by {mean}, {many}");
        let (mean, _) = difference(&told.rgb, &even.rgb, 12);
        assert!(mean > 2.0, "waves are seen: {mean}");
        told
    });
    let (mean, many) = difference(&frames[0].rgb, &frames[1].rgb, 16);
    println!("both differ by {mean:.3}, on {:.2} % by more than 16", many * 100.0);
    assert!(mean < 1.5 && many < 0.02, "both differ by {mean}, {many}");
}
