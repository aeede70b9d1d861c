//! Models move by their clips while the world runs: where a clip has led a model, it is drawn as if it had been put there, by triangles and by rays.

use std::sync::Arc;

use crate::common::models::{add, ball, board};
use crate::common::{difference, draw, renderer};
use simworld_core::asset::{
    Asset, Bone, Channel, Clip, Curve, Finish, Interpolation, Joint, ModelImage, Path, Rig, RigDesc,
    SkinVertex, Wrap,
};
use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::{Point3, Twist, Vector3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::scene::{CLIP, CLIP_RATE, CLIP_SINCE, Scene, World};
use simworld_render::{Backend, Frame, RenderConfig, Renderer};

/// Where it stands.
const FOOT: [f64; 3] = [9.0, 0.0, -1.0];

fn backends() -> Option<[(&'static str, Renderer); 2]> {
    let with = |backend| renderer(&RenderConfig { backend, ..RenderConfig::default() });
    Some([("raster", with(Backend::Raster)?), ("raycast", with(Backend::Raycast)?)])
}

fn camera() -> Camera {
    let intrinsics = Intrinsics::from_fov(160, 120, 0.9).expect("a size in range");
    Camera::looking_along(&pose_facing(Point3::origin(), 0.0), intrinsics)
}

fn clip(name: &str, path: Path, from: &[f32], to: &[f32]) -> Clip {
    let (times, values) = (vec![0.0, 1.0], [from, to].concat());
    let curve = Curve { interpolation: Interpolation::Linear, times, values };
    Clip { name: name.to_owned(), channels: vec![Channel { joint: 0, path, curve }] }
}

/// The same asset that slides 4 m to the left in a second, or turns half around.
fn moving(asset: Asset) -> Asset {
    let mut model = asset.model.as_deref().cloned().unwrap();
    let vertex = |vertex: &simworld_core::asset::ModelVertex| SkinVertex {
        position: vertex.position,
        normal: vertex.normal,
        ..SkinVertex::default()
    };
    model.rig = Some(
        Rig::new(RigDesc {
            joints: vec![Joint::default()],
            bones: vec![Bone::of(0)],
            vertices: model.vertices.iter().map(vertex).collect(),
            clips: vec![
                clip("slide", Path::Translation, &[0.0; 3], &[0.0, 4.0, 0.0]),
                clip("turn", Path::Rotation, &[0.0, 0.0, 0.0, 1.0], &[0.0, 0.0, 1.0, 0.0]),
            ],
        })
        .unwrap(),
    );
    Asset { model: Some(Arc::new(model)), ..asset }
}

/// A board with a picture, of which the one half is dark.
fn sign() -> Asset {
    let pixels = (0..64_u8).flat_map(|index| [if index % 8 < 4 { 40 } else { 220 }; 3]).collect();
    let image = ModelImage { width: 8, height: 8, pixels, ..ModelImage::default() };
    board(Some(image), [[0.0; 2], [1.0; 2]], [Wrap::Clamp; 2])
}

/// A world with the moving one of an asset, so many seconds into a clip.
fn playing(asset: &Asset, name: &str, seconds: f64) -> (World, EntityId) {
    let mut world = World::new();
    let id = add(&mut world, &moving(asset.clone()), FOOT);
    play(&mut world, id, name, seconds);
    (world, id)
}

fn play(world: &mut World, id: EntityId, name: &str, seconds: f64) {
    world.set_attribute(id, CLIP, Some(name.into())).unwrap();
    let since = world.clock().seconds() - seconds;
    world.set_attribute(id, CLIP_SINCE, Some(since.into())).unwrap();
}

/// A world with the same asset, without clips, put elsewhere.
fn put_there(asset: &Asset, left: f64, yaw: f64) -> World {
    let mut world = World::new();
    let id = add(&mut world, asset, FOOT);
    world.set_motion(id, pose_facing(Point3::new(FOOT[0], left, FOOT[2]), yaw), Twist::ZERO).unwrap();
    world
}

/// The share of pixels on which another entity is seen, or a farther one.
fn others(a: &Frame, b: &Frame) -> f64 {
    let pixels = a.width * a.height;
    let differs = |index: &u32| {
        let (x, y) = (index % a.width, index / a.width);
        let [near, far] = [a, b].map(|frame| frame.depth_at(x, y).map_or(1e9, f64::from));
        a.entity_at(x, y).is_some() != b.entity_at(x, y).is_some()
            || (near - far).abs() > 1e-3 * near.max(far)
    };
    f64::from((0..pixels).filter(differs).count() as u32) / f64::from(pixels)
}

#[test]
fn what_a_clip_has_led_away_is_drawn_there() {
    let Some(renderers) = backends() else { return };
    let half = std::f64::consts::PI;
    for (backend, mut renderer) in renderers {
        let rest = draw(&mut renderer, &put_there(&sign(), 0.0, 0.0), &camera());
        for (name, seconds, left, yaw) in [
            ("slide", 0.25, 1.0, 0.0),
            ("slide", 0.75, 3.0, 0.0),
            ("slide", 0.77, 4.0 * 46.0 / 60.0, 0.0),
            ("turn", 0.25, 0.0, half * 0.25),
            ("turn", 0.76, 0.0, half * 45.0 / 60.0),
            ("turn", 1.25, 0.0, half * 0.25),
        ] {
            let (world, _) = playing(&sign(), name, seconds);
            let moved = draw(&mut renderer, &world, &camera());
            let wanted = draw(&mut renderer, &put_there(&sign(), left, yaw), &camera());
            let off = others(&moved, &wanted);
            assert!(off < 0.002, "{backend}: {name} at {seconds} s differs on {off} of the picture");
            let (mean, many) = difference(&moved.rgb, &wanted.rgb, 8);
            assert!(
                many < 0.005,
                "{backend}: colours of {name} at {seconds} s: {mean} in the mean, {many} by more"
            );
            assert!(others(&moved, &rest) > 0.02, "{backend}: {name} at {seconds} s is seen to have moved");
        }
    }
}

/// Who stands behind the camera's edge is seen once its clip leads it in, and throws no shadow of where it was.
#[test]
fn a_clip_leads_into_the_picture() {
    let Some(renderers) = backends() else { return };
    for (backend, mut renderer) in renderers {
        let (mut world, id) = playing(&sign(), "slide", 0.99);
        let aside = pose_facing(Point3::new(FOOT[0], -8.0, FOOT[2]), 0.0);
        world.set_motion(id, aside, Twist::ZERO).unwrap();
        let pixels = || (0..160 * 120).map(|index| (index % 160, index / 160));
        let seen = |frame: &Frame| pixels().filter(|(x, y)| frame.entity_at(*x, *y) == Some(id)).count();
        let within = draw(&mut renderer, &world, &camera());
        assert!(seen(&within) > 200, "{backend}: {} pixels", seen(&within));
        play(&mut world, id, "slide", 0.0);
        assert_eq!(seen(&draw(&mut renderer, &world, &camera())), 0, "{backend}");
    }
}

/// The world's clock turns what has one clip, and motion chooses between several.
#[test]
fn clips_follow_the_clock_and_the_motion() {
    let Some(renderers) = backends() else { return };
    for (backend, mut renderer) in renderers {
        let mut asset = moving(sign());
        let mut model = asset.model.as_deref().cloned().unwrap();
        let mut desc = model.rig.take().unwrap().desc().clone();
        desc.clips[0].name = "walk".to_owned();
        desc.clips[1].name = "idle".to_owned();
        model.rig = Some(Rig::new(desc).unwrap());
        asset.model = Some(Arc::new(model));
        let mut world = World::new();
        let id = add(&mut world, &asset, FOOT);
        while world.clock().seconds() < 0.5 {
            world.finish_step();
        }
        let shown = |world: &World| (world.clock().seconds() * 60.0 + 1e-6).floor() / 60.0;
        let idle = draw(&mut renderer, &world, &camera());
        let yaw = std::f64::consts::PI * shown(&world);
        let turned = draw(&mut renderer, &put_there(&sign(), 0.0, yaw), &camera());
        assert!(others(&idle, &turned) < 0.002, "{backend}: who stands idles");
        let twist = Twist { linear: Vector3::y() * 1.2, ..Twist::ZERO };
        let pose = *world.entity(id).unwrap().pose;
        world.set_motion(id, pose, twist).unwrap();
        let begins = draw(&mut renderer, &world, &camera());
        assert!(others(&begins, &idle) < 0.002, "{backend}: it begins with the next step");
        // Half of the way in a tenth of a second, and then all of it.
        world.finish_step();
        let between = draw(&mut renderer, &world, &camera());
        let half = draw(&mut renderer, &put_there(&sign(), shown(&world) * 2.0, yaw * 0.5), &camera());
        assert!(others(&between, &half) < 0.002, "{backend}: one goes over into the other");
        world.finish_step();
        let walking = draw(&mut renderer, &world, &camera());
        let aside = draw(&mut renderer, &put_there(&sign(), shown(&world) * 4.0, 0.0), &camera());
        assert!(others(&walking, &aside) < 0.002, "{backend}: who moves walks");
        world.set_attribute(id, CLIP, Some("swim".into())).unwrap();
        (0..2).for_each(|_| world.finish_step());
        let rests = draw(&mut renderer, &world, &camera());
        let rest = draw(&mut renderer, &put_there(&sign(), 0.0, 0.0), &camera());
        assert!(others(&rests, &rest) < 0.002, "{backend}: what it has not is not played");
    }
}

/// Who goes over into a clip without being touched otherwise is drawn anew, and a saved world goes on in the middle of that.
#[test]
fn a_change_is_seen_though_nothing_else_happens() {
    let Some(renderers) = backends() else { return };
    for (backend, mut renderer) in renderers {
        let mut world = World::new();
        let id = add(&mut world, &moving(sign()), FOOT);
        world.set_attribute(id, CLIP, Some("swim".into())).unwrap();
        (0..3).for_each(|_| world.finish_step());
        let rest = draw(&mut renderer, &world, &camera());
        play(&mut world, id, "slide", 0.4);
        assert!(draw(&mut renderer, &world, &camera()).rgb == rest.rgb, "{backend}: not yet");
        for left in [0.5 * 4.0 * 0.5, 0.6 * 4.0, 0.7 * 4.0] {
            world.finish_step();
            let got = draw(&mut renderer, &world, &camera());
            let wanted = draw(&mut renderer, &put_there(&sign(), left, 0.0), &camera());
            assert!(others(&got, &wanted) < 0.002, "{backend}: {left} m to the left");
            let again = World::restore(world.snapshot()).unwrap();
            let again = draw(&mut renderer, &again, &camera());
            assert!(again.rgb == got.rgb && again.depth == got.depth, "{backend}: as it was saved");
        }
    }
}

/// More poses than are kept ready give place to one another, and none is mistaken for another.
#[test]
fn poses_come_again_as_they_were() {
    let Some(renderers) = backends() else { return };
    let asset = ball([0.3, 0.1, 0.1], Finish::default());
    for (backend, mut renderer) in renderers {
        let (mut world, id) = playing(&asset, "slide", 0.0);
        let paused = add(&mut world, &moving(asset.clone()), [FOOT[0] + 4.0, -3.0, FOOT[2]]);
        play(&mut world, paused, "slide", 0.3);
        world.set_attribute(paused, CLIP_RATE, Some(0.0.into())).unwrap();
        let first: Vec<Frame> = (0..30).map(|pose| at_pose(&mut renderer, &mut world, id, pose)).collect();
        for pose in [3, 29, 11] {
            let again = at_pose(&mut renderer, &mut world, id, pose);
            let same = again.rgb == first[pose as usize].rgb && again.depth == first[pose as usize].depth;
            assert!(same, "{backend}: pose {pose} again");
        }
        let mut fresh = renderer_like(backend);
        let anew = at_pose(&mut fresh, &mut world, id, 11);
        assert_eq!(anew.depth, first[11].depth, "{backend}: pose 11 of another renderer");
        assert_eq!(anew.rgb, first[11].rgb, "{backend}: pose 11 of another renderer");
    }
}

fn at_pose(renderer: &mut Renderer, world: &mut World, id: EntityId, pose: u32) -> Frame {
    play(world, id, "slide", (f64::from(pose) + 0.5) / 30.0);
    draw(renderer, world, &camera())
}

fn renderer_like(backend: &str) -> Renderer {
    let backend = if backend == "raster" { Backend::Raster } else { Backend::Raycast };
    renderer(&RenderConfig { backend, ..RenderConfig::default() }).expect("there was one before")
}
