//! Pictures on models: where they lie, what lies beyond their edges, how they are blurred with distance; alike by triangles and by rays.

use std::sync::Arc;

use crate::common::models::{add, alone, ball, board};
use crate::common::{difference, draw, renderer};
use simworld_core::asset::{Asset, Finish, ModelImage, Wrap, light_of};
use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::scene::{Scene, World};
use simworld_render::{AntiAliasing, Backend, Frame, RenderConfig, RenderError, Renderer};

const RED: [u8; 3] = [210, 10, 10];
const GREEN: [u8; 3] = [10, 210, 10];
const BLUE: [u8; 3] = [10, 10, 210];
const WHITE: [u8; 3] = [210, 210, 210];
/// Dark enough that in the sun it is not pressed together to what a display shows.
const GREY: u8 = 160;
/// Of the pictures here.
const SIDE: u32 = 120;

fn with(config: &RenderConfig) -> Option<[Renderer; 2]> {
    let with = |backend| renderer(&RenderConfig { backend, ..config.clone() });
    Some([with(Backend::Raster)?, with(Backend::Raycast)?])
}

/// Red, green, blue and white quarters, row by row.
fn quarters(side: u32) -> ModelImage {
    let pixel = |index: u32| match (index / side < side / 2, index % side < side / 2) {
        (true, true) => RED,
        (true, false) => GREEN,
        (false, true) => BLUE,
        (false, false) => WHITE,
    };
    let pixels = (0..side * side).flat_map(pixel).collect();
    ModelImage { width: side, height: side, pixels, ..ModelImage::default() }
}

fn camera() -> Camera {
    let intrinsics = Intrinsics::from_fov(SIDE, SIDE, 0.5).expect("a size in range");
    Camera::looking_along(&pose_facing(Point3::origin(), 0.0), intrinsics)
}

/// The board, so far away that it fills most of the picture, in the sun.
fn shown(asset: &Asset) -> World {
    let (world, _) = alone(asset, [5.0, 0.0, -1.0]);
    sunny(world)
}

fn sunny(mut world: World) -> World {
    let mut environment = *world.environment();
    environment.sun.azimuth = 1.4 * std::f64::consts::PI;
    world.set_environment(environment).expect("a sun in range");
    world
}

/// The pixel in which a point of the board is seen, in shares of its sides from the upper left corner.
fn pixel(right: f64, down: f64) -> (u32, u32) {
    let point = Point3::new(4.9, 1.0 - 2.0 * right, 1.0 - 2.0 * down);
    let optical = camera().world_from_optical.inverse_transform_point(&point);
    let (pixel, _) = camera().intrinsics.project(&optical).expect("it is before the camera");
    (pixel.x as u32, pixel.y as u32)
}

/// Which of the four colours a pixel has, by the light in it.
fn color_at(frame: &Frame, right: f64, down: f64) -> [u8; 3] {
    let (x, y) = pixel(right, down);
    let [r, g, b] = frame.rgb_at(x, y).expect("on the picture").map(light_of);
    let most = r.max(g).max(b);
    assert!(most > 0.2, "nothing bright at {right} {down}: {r} {g} {b}");
    match [r, g, b].map(|channel| channel > 0.5 * most) {
        [true, false, false] => RED,
        [false, true, false] => GREEN,
        [false, false, true] => BLUE,
        [true, true, true] => WHITE,
        _ => panic!("an odd colour at {right} {down}: {r} {g} {b}"),
    }
}

const WHOLE: [[f32; 2]; 2] = [[0.0, 0.0], [1.0, 1.0]];

#[test]
fn a_picture_lies_where_its_places_say() {
    for anti_aliasing in [AntiAliasing::Off, AntiAliasing::Msaa4] {
        let Some(renderers) = with(&RenderConfig { anti_aliasing, ..RenderConfig::default() }) else {
            return;
        };
        let world = shown(&board(Some(quarters(64)), WHOLE, [Wrap::Repeat; 2]));
        let plain = shown(&board(None, WHOLE, [Wrap::Repeat; 2]));
        let mut frames = Vec::new();
        for mut renderer in renderers {
            let frame = draw(&mut renderer, &world, &camera());
            for (right, down, color) in
                [(0.1, 0.1, RED), (0.9, 0.1, GREEN), (0.1, 0.9, BLUE), (0.9, 0.9, WHITE), (0.45, 0.55, BLUE)]
            {
                assert_eq!(color_at(&frame, right, down), color, "at {right} {down}");
            }
            let without = draw(&mut renderer, &plain, &camera());
            assert!(frame.depth == without.depth && frame.ids == without.ids, "it is colour alone");
            frames.push(frame);
        }
        let (mean, differing) = difference(&frames[0].rgb, &frames[1].rgb, 12);
        println!(
            "{anti_aliasing:?}: both differ by {mean:.3}, on {:.3} % by more than 12",
            differing * 100.0
        );
        let edges = if anti_aliasing == AntiAliasing::Off { 0.002 } else { 0.05 };
        assert!(mean < 1.0 && differing < edges, "both differ by {mean}, {differing}");
    }
}

#[test]
fn beyond_its_edges_lies_what_the_wrap_says() {
    let Some(mut renderers) = with(&RenderConfig::default()) else { return };
    let image = quarters(64);
    let wraps = [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp];
    let places = [[-0.8_f32, -1.3], [2.2, 1.7]];
    for wrap in wraps.into_iter().flat_map(|right| wraps.map(|down| [right, down])) {
        let world = shown(&board(Some(image.clone()), places, wrap));
        for renderer in &mut renderers {
            let frame = draw(renderer, &world, &camera());
            for (column, row) in (0..9).flat_map(|column| (0..9).map(move |row| (column, row))) {
                let (right, down) = (0.1 + 0.1 * f64::from(column), 0.1 + 0.1 * f64::from(row));
                let place = [right, down].map(|share| share * 3.0);
                let place = std::array::from_fn(|axis| f64::from(places[0][axis]) + place[axis]);
                // Not where two colours meet.
                let corner = |shift: f64| image.pixel_at(place.map(|part: f64| part + shift), wrap);
                let expected = image.pixel_at(place, wrap);
                if [-0.06, 0.06].map(corner).iter().all(|color| *color == expected) {
                    assert_eq!(color_at(&frame, right, down), expected, "{wrap:?} at {place:?}");
                }
            }
        }
    }
}

/// A board of black and grey squares of one pixel each.
fn chequered(side: u32) -> Asset {
    let pixels =
        (0..side * side).flat_map(|k| [if (k % side + k / side).is_multiple_of(2) { GREY } else { 0 }; 3]);
    let image = ModelImage { width: side, height: side, pixels: pixels.collect(), ..ModelImage::default() };
    board(Some(image), WHOLE, [Wrap::Repeat; 2])
}

#[test]
fn what_is_finer_than_a_pixel_is_its_mean() {
    let Some(mut renderers) = with(&RenderConfig::default()) else { return };
    let spread = |frame: &Frame| {
        let inner = (0..60)
            .flat_map(|x| (0..60).map(move |y| (0.2 + 0.01 * f64::from(x), 0.2 + 0.01 * f64::from(y))));
        let values = inner.map(|(right, down)| {
            let (x, y) = pixel(right, down);
            f64::from(light_of(frame.rgb_at(x, y).expect("on the picture")[1]))
        });
        values.fold((f64::INFINITY, 0.0_f64), |(low, high), value| (low.min(value), high.max(value)))
    };
    let (fine, coarse) = (shown(&chequered(1024)), shown(&chequered(8)));
    let grey = ModelImage { width: 1, height: 1, pixels: vec![GREY; 3], ..ModelImage::default() };
    let grey = shown(&board(Some(grey), WHOLE, [Wrap::Repeat; 2]));
    for renderer in &mut renderers {
        let [fine, coarse, grey] =
            [&fine, &coarse, &grey].map(|world| spread(&draw(renderer, world, &camera())));
        println!("{fine:?} {coarse:?} {grey:?}");
        assert!(fine.1 - fine.0 < 0.05, "no pattern of pixels: {fine:?}");
        assert!(coarse.1 > 3.0 * coarse.0, "squares of twelve pixels are black and white: {coarse:?}");
        assert!(fine.1 < 0.65 * grey.1 && fine.0 > 0.45 * grey.0, "half of the light: {fine:?} of {grey:?}");
    }
}

/// A picture on a ball, seen at every slant, with texels as large as pixels, larger and smaller.
#[test]
fn both_backends_blur_alike() {
    let Some([mut raster, mut raycast]) = with(&RenderConfig::default()) else { return };
    for (side, distance) in [(16, 4.0), (128, 5.0), (512, 7.0), (512, 20.0)] {
        let mut asset = ball([1.0; 3], Finish { metallic: 0.0, roughness: 0.9, emission: [0.0; 3] });
        let model = Arc::make_mut(asset.model.as_mut().expect("it has a model"));
        for vertex in &mut model.vertices {
            vertex.place = [vertex.normal[1], vertex.normal[2]].map(|part| 0.5 - 0.5 * part);
        }
        // Stripes of four pixels in two colours.
        let pixel = |k: u32| if (k % side / 4 + k / side / 8).is_multiple_of(2) { RED } else { BLUE };
        model.images = vec![ModelImage {
            width: side,
            height: side,
            pixels: (0..side * side).flat_map(pixel).collect(),
            ..ModelImage::default()
        }];
        model.parts[0].texture =
            Some(simworld_core::asset::ModelTexture { image: 0, wrap: [Wrap::Clamp; 2] });
        let (world, id) = alone(&asset, [distance, 0.2, -0.9]);
        let world = sunny(world);
        let [drawn, cast] = [&mut raster, &mut raycast].map(|renderer| draw(renderer, &world, &camera()));
        let seen =
            drawn.ids.iter().zip(&cast.ids).filter(|(a, b)| a == b && **a == id.index() as u32 + 1).count();
        let inside: Vec<usize> =
            (0..drawn.ids.len()).filter(|k| drawn.ids[*k] != 0 && cast.ids[*k] != 0).collect();
        let of = |frame: &Frame| -> Vec<u8> {
            inside.iter().flat_map(|k| frame.rgb[3 * k..3 * k + 3].to_vec()).collect()
        };
        let (mean, differing) = difference(&of(&drawn), &of(&cast), 16);
        println!(
            "{side} at {distance} m: {seen} pixels differ by {mean:.3}, {:.2} % by more than 16",
            differing * 100.0
        );
        assert!(mean < 1.5 && differing < 0.02, "{side} at {distance} m: by {mean}, {differing}");
    }
}

#[test]
fn pictures_follow_the_scene_and_nothing_before() {
    let Some(renderers) = with(&RenderConfig::default()) else { return };
    let first = shown(&board(Some(quarters(64)), WHOLE, [Wrap::Repeat; 2]));
    let mut both = first.clone();
    // Another picture under another name, and one that comes and goes.
    let other = Asset { name: "other".into(), ..chequered(256) };
    let guest = add(&mut both, &other, [9.0, 3.0, -1.0]);
    let third = shown(&chequered(32));
    for mut renderer in renderers {
        let alone = draw(&mut renderer, &first, &camera());
        let together = draw(&mut renderer, &both, &camera());
        draw(&mut renderer, &third, &camera());
        let again = draw(&mut renderer, &both, &camera());
        assert!(together.rgb == again.rgb && together.rgb != alone.rgb);
        let mut left = both.clone();
        left.remove(guest).expect("it is there");
        assert!(draw(&mut renderer, &left, &camera()).rgb == alone.rgb, "as before the guest came");
    }
}

#[test]
fn pictures_that_are_too_large_are_shown_smaller() {
    let small = RenderConfig { texture_memory: 4 << 20, ..RenderConfig::default() };
    let Some(renderers) = with(&small) else { return };
    // 16 MiB each with a third more for the levels, and there are four.
    let mut world = shown(&board(Some(quarters(2048)), WHOLE, [Wrap::Clamp; 2]));
    for (number, name) in (0..).zip(["one", "two"]) {
        let asset = Asset { name: name.into(), ..board(Some(quarters(2048)), WHOLE, [Wrap::Clamp; 2]) };
        add(&mut world, &asset, [9.0 + f64::from(number), 4.0, -1.0]);
    }
    for mut renderer in renderers {
        let frame = draw(&mut renderer, &world, &camera());
        for (right, down, color) in [(0.1, 0.1, RED), (0.9, 0.1, GREEN), (0.1, 0.9, BLUE), (0.9, 0.9, WHITE)]
        {
            assert_eq!(color_at(&frame, right, down), color, "at {right} {down}");
        }
    }
}

/// Pictures take a row each, be they of one pixel.
#[test]
fn more_pictures_than_rows_are_refused() {
    let small = RenderConfig { texture_memory: 4 << 20, ..RenderConfig::default() };
    let Some([mut raster, _]) = with(&small) else { return };
    let mut asset = board(Some(quarters(4)), WHOLE, [Wrap::Clamp; 2]);
    let model = Arc::make_mut(asset.model.as_mut().expect("it has a model"));
    model.images = vec![quarters(2); 1025];
    let mut frame = Frame::new();
    let error = raster.render(&shown(&asset), &camera(), &mut frame).expect_err("too many");
    assert!(matches!(error, RenderError::Pictures { count: 1025, limit: 1024 }), "{error}");
    let fine = shown(&board(Some(quarters(4)), WHOLE, [Wrap::Clamp; 2]));
    assert_eq!(color_at(&draw(&mut raster, &fine, &camera()), 0.1, 0.1), RED, "and then it goes on");
}
