//! Bad input gives an error that helps, and the renderer goes on.

use crate::common::{draw, looking_east, renderer, square};
use simworld_core::camera::Intrinsics;
use simworld_core::scene::World;
use simworld_render::{Backends, Frame, RenderConfig, RenderError, Renderer};

#[test]
fn without_an_adapter_the_error_says_what_to_install() {
    let config = RenderConfig { backends: Backends::None, ..RenderConfig::default() };
    let error = Renderer::new(&config).expect_err("there are no graphics without an interface");
    assert!(matches!(error, RenderError::NoAdapter { .. }), "{error:?}");
    let text = error.to_string();
    assert!(text.contains("mesa-vulkan-drivers libvulkan1") && text.contains("GPU driver"), "{text}");
    assert!(text.contains("everything but pictures works"), "{text}");
}

#[test]
fn a_setting_out_of_range_is_named() {
    let config = RenderConfig { near: 0.0, ..RenderConfig::default() };
    let error = Renderer::new(&config).expect_err("near must be positive");
    assert!(error.to_string().starts_with("near = 0 is out of range"), "{error}");
}

#[test]
fn impossible_cameras_are_refused_and_the_next_picture_is_drawn() {
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    let good = looking_east(1.6, 32, 24);
    let with = |change: &dyn Fn(&mut Intrinsics)| {
        let mut camera = good;
        change(&mut camera.intrinsics);
        camera
    };
    let mut astray = good;
    astray.world_from_optical.translation.x = f64::NAN;
    let world = square(0.0);
    let mut frame = Frame::new();
    for size in [(0, 24), (32, 0), (1_000_000, 24), (32, u32::MAX)] {
        let camera = with(&|k| (k.width, k.height) = size);
        let error = renderer.render(&world, &camera, &mut frame).expect_err("an impossible size");
        assert!(matches!(error, RenderError::Size { .. }), "{size:?}: {error}");
    }
    let cameras = [
        (with(&|k| k.fx = 0.0), "fx"),
        (with(&|k| k.fy = f64::NAN), "fy"),
        (with(&|k| k.cx = f64::INFINITY), "cx"),
        (with(&|k| k.cy = -1e7), "cy"),
        (astray, "position x"),
    ];
    for (camera, field) in cameras {
        let error = renderer.render(&world, &camera, &mut frame).expect_err("an impossible camera");
        assert!(
            matches!(error, RenderError::Camera { field: named, .. } if named == field),
            "{field}: {error}"
        );
    }
    let frame = draw(&mut renderer, &world, &good);
    assert!(frame.ids.iter().any(|id| *id != 0));
}

#[test]
fn a_camera_inside_a_wall_or_upside_down_is_no_fault() {
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    let mut camera = looking_east(0.4, 40, 30);
    camera.world_from_optical.translation.x = 24.0;
    camera.world_from_optical.translation.y = 11.0;
    draw(&mut renderer, &square(0.0), &camera);
    camera.world_from_optical.rotation *= nalgebra::UnitQuaternion::from_euler_angles(0.0, 0.0, 3.1);
    let frame = draw(&mut renderer, &square(0.0), &camera);
    assert!(frame.depth.iter().all(|depth| !depth.is_nan()));
    draw(&mut renderer, &World::new(), &camera);
}

#[test]
fn empty_frames_and_bad_paths_are_errors() {
    let empty = Frame::new();
    assert!(matches!(empty.rgb_png(), Err(RenderError::Frame { buffer: "rgb", .. })));
    let mut frame = Frame::new();
    frame.resize(4, 3);
    frame.depth.pop();
    let error = frame.depth_png().expect_err("a depth is missing").to_string();
    assert!(error.contains("depth buffer has 11 entries where 4 x 3 pixels need 12"), "{error}");
    let folder = tempfile::tempdir().expect("a folder");
    let missing = folder.path().join("no/such/folder.png");
    let error = frame.write_png(&missing).expect_err("no such folder");
    assert!(matches!(&error, RenderError::Write { path, .. } if *path == missing), "{error}");
}
