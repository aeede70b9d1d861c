//! Pictures of metal, light, shade and bumps say place by place what factors say of a whole part; alike by triangles and by rays.

use std::sync::Arc;

use crate::common::models::{add, alone, ball, board};
use crate::common::{difference, draw, put, renderer};
use simworld_core::asset::{
    Asset, Content, Finish, Model, ModelImage, ModelTexture, Pictures, Wrap, light_of,
};
use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::ops;
use simworld_core::scene::{EntityKind, Scene, Shape, World};
use simworld_render::{Backend, Frame, RenderConfig, Renderer};

/// Of the pictures here.
const SIDE: u32 = 120;
const WHOLE: [[f32; 2]; 2] = [[0.0, 0.0], [1.0, 1.0]];

fn backends() -> Option<[Renderer; 2]> {
    let with = |backend| renderer(&RenderConfig { backend, ..RenderConfig::default() });
    Some([with(Backend::Raster)?, with(Backend::Raycast)?])
}

fn camera() -> Camera {
    let intrinsics = Intrinsics::from_fov(SIDE, SIDE, 0.5).expect("a size in range");
    Camera::looking_along(&pose_facing(Point3::origin(), 0.0), intrinsics)
}

/// A picture of two colours, side by side.
fn halves(content: Content, left: [u8; 3], right: [u8; 3]) -> ModelImage {
    let pixel = |k: u32| if k % 32 < 16 { left } else { right };
    let pixels = (0..32 * 32).flat_map(pixel).collect();
    ModelImage { width: 32, height: 32, pixels, content, ..ModelImage::default() }
}

fn of_model(mut asset: Asset, change: impl FnOnce(&mut Model)) -> Asset {
    change(Arc::make_mut(asset.model.as_mut().expect("it has a model")));
    asset
}

/// The board of a colour and finish, with a picture that somebody makes something of.
fn with(image: ModelImage, finish: Finish, color: f32, use_as: fn(&mut Pictures, ModelTexture)) -> Asset {
    of_model(plain(finish, color), |model| {
        model.images = vec![image];
        let part = &mut model.parts[0];
        use_as(&mut part.pictures, ModelTexture { image: 0, wrap: [Wrap::Clamp; 2] });
    })
}

/// The same without.
fn plain(finish: Finish, color: f32) -> Asset {
    of_model(board(None, WHOLE, [Wrap::Clamp; 2]), |model| {
        model.vertices.iter_mut().for_each(|vertex| vertex.color = [color; 3]);
        model.parts[0].finish = finish;
    })
}

/// It, with a sun so high behind the camera, from a bit aside.
fn shown(asset: &Asset, elevation: f64) -> World {
    let (mut world, _) = alone(asset, [5.0, 0.0, -1.0]);
    let mut environment = *world.environment();
    (environment.sun.azimuth, environment.sun.elevation) = (1.4 * std::f64::consts::PI, elevation);
    environment.weather.cloud_cover = 0.0;
    world.set_environment(environment).expect("a sun in range");
    world
}

/// Two pixels within its left half, and two within its right one.
const PIXELS: [[(u32, u32); 2]; 2] = [[(30, 40), (45, 90)], [(78, 40), (90, 90)]];

/// Each half of the first is as the whole of one of the others.
fn assert_halves(both: &Asset, left: &Asset, right: &Asset, elevation: f64, least_apart: u8) {
    let Some(renderers) = backends() else { return };
    for mut renderer in renderers {
        let mut frame = |asset: &Asset| draw(&mut renderer, &shown(asset, elevation), &camera());
        let (both, wholes) = (frame(both), [frame(left), frame(right)]);
        for (pixels, whole) in PIXELS.iter().zip(&wholes) {
            for (x, y) in pixels {
                let (got, wanted) = (both.rgb_at(*x, *y).unwrap(), whole.rgb_at(*x, *y).unwrap());
                let apart = got.iter().zip(&wanted).map(|(a, b)| a.abs_diff(*b)).max();
                assert!(apart <= Some(1), "{got:?} at {x} {y}, not {wanted:?}");
            }
        }
        let (x, y) = PIXELS[0][0];
        let [one, other] = wholes.map(|frame| frame.rgb_at(x, y).unwrap());
        let apart = one.iter().zip(&other).map(|(a, b)| a.abs_diff(*b)).max();
        assert!(apart >= Some(least_apart), "and they are nearly the same: {one:?} {other:?}");
    }
}

#[test]
fn half_of_metal_mirrors_the_sky_and_the_other_half_does_not() {
    let image = halves(Content::Numbers, [0, 51, 255], [0, 255, 0]);
    let finish = Finish { metallic: 1.0, roughness: 1.0, ..Finish::default() };
    let both = with(image, finish, 0.8, |pictures, texture| pictures.metal = Some(texture));
    let metal = plain(Finish { roughness: 0.2, ..finish }, 0.8);
    let dull = plain(Finish { metallic: 0.0, ..finish }, 0.8);
    assert_halves(&both, &metal, &dull, 0.5, 20);
}

#[test]
fn half_of_light_shines_at_night() {
    // 188 is half of the light of 255.
    let image = halves(Content::Color, [255, 0, 188], [0, 0, 0]);
    let finish = Finish { emission: [0.4; 3], ..Finish::default() };
    let both = with(image, finish, 0.3, |pictures, texture| pictures.emission = Some(texture));
    let light = plain(Finish { emission: [0.4, 0.0, 0.4 * light_of(188)], ..finish }, 0.3);
    assert_halves(&both, &light, &plain(Finish::default(), 0.3), -0.6, 60);
}

#[test]
fn shade_takes_the_light_of_the_sky_alone() {
    let Some(renderers) = backends() else { return };
    let image = || halves(Content::Numbers, [51, 0, 0], [255, 0, 0]);
    let finish = Finish { roughness: 1.0, ..Finish::default() };
    let shaded = |strength| {
        of_model(with(image(), finish, 0.2, |pictures, texture| pictures.shade = Some(texture)), |model| {
            model.parts[0].pictures.shade_strength = strength;
        })
    };
    for mut renderer in renderers {
        // The board faces away from the sun.
        let mut light = |asset: &Asset, azimuth: f64, (x, y): (u32, u32)| {
            let mut world = shown(asset, 0.6);
            let mut environment = *world.environment();
            environment.sun.azimuth = azimuth;
            world.set_environment(environment).expect("a sun in range");
            let frame = draw(&mut renderer, &world, &camera());
            frame.rgb_at(x, y).unwrap().map(|value| f64::from(light_of(value)))
        };
        let behind = std::f64::consts::FRAC_PI_2;
        for (strength, wanted) in [(1.0, 0.2), (0.5, 0.6), (0.0, 1.0)] {
            let asset = shaded(strength);
            for (which, wanted) in [(PIXELS[0][0], wanted), (PIXELS[1][0], 1.0)] {
                let (got, full) = (light(&asset, behind, which), light(&plain(finish, 0.2), behind, which));
                for (got, full) in got.iter().zip(full) {
                    assert!(
                        (got / full - wanted).abs() < 0.04,
                        "{got} of {full} is not {wanted}: {strength}"
                    );
                }
            }
        }
        // Most of what a surface in the sun has is the sun's, of which nothing is taken.
        let sunny = 1.4 * std::f64::consts::PI;
        let [got, full] =
            [&shaded(1.0), &plain(finish, 0.2)].map(|asset| light(asset, sunny, PIXELS[0][0])[1]);
        assert!((0.5..0.98).contains(&(got / full)), "{got} of {full}");
    }
}

/// The number of a picture of normals for one part of a normal.
fn number(part: f64) -> u8 {
    ((part * 0.5 + 0.5) * 255.0).round() as u8
}

/// A board whose picture says that its normal leans by so much to the right and to the top of the picture.
fn leaning(right: f64, up: f64) -> Asset {
    let out = (1.0 - right * right - up * up).sqrt();
    let pixel = [right, up, out].map(number);
    let image = halves(Content::Numbers, pixel, pixel);
    with(image, MATTE, 0.25, |pictures, texture| pictures.bumps = Some(texture))
}

const MATTE: Finish = Finish { metallic: 0.0, roughness: 0.9, emission: [0.0; 3] };

#[test]
fn bumps_tilt_the_light_as_a_tilted_plane_does() {
    let Some(renderers) = backends() else { return };
    let angle = 0.35;
    let (sin, cos) = ops::sin_cos(angle);
    for mut renderer in renderers {
        let mut middle = |world: &World| {
            let frame = draw(&mut renderer, world, &camera());
            frame.rgb_at(SIDE / 2, SIDE / 2).unwrap().map(|value| f64::from(light_of(value)))
        };
        let flat = middle(&shown(&plain(MATTE, 0.25), 0.5));
        let mut seen = Vec::new();
        for side in [1.0, -1.0] {
            // The board shows its back: to the right of the picture is to the right of its body.
            let bumps = middle(&shown(&leaning(side * sin, 0.0), 0.5));
            let normals = middle(&shown(
                &of_model(plain(MATTE, 0.25), |model| {
                    let normal = [-cos, -side * sin, 0.0].map(|part| part as f32);
                    model.vertices[..4].iter_mut().for_each(|vertex| vertex.normal = normal);
                }),
                0.5,
            ));
            // The same board, turned about its upright axis until it faces there.
            let mut turned = shown(&plain(MATTE, 0.25), 0.5);
            let (id, asset) = (turned.iter().next().expect("it is there").id, plain(MATTE, 0.25));
            let number = turned.assets().and_then(|all| all.find("board")).expect("one");
            turned.remove(id).expect("it is there");
            let pose = pose_facing(Point3::new(5.0, 0.0, -1.0), side * angle);
            turned.spawn(asset.at(number, pose)).expect("a solid");
            let plane = middle(&turned);
            for channel in 0..3 {
                let (got, wanted) = (bumps[channel], normals[channel]);
                assert!((got - wanted).abs() < 0.012 * wanted + 0.004, "{bumps:?}, not {normals:?}");
                assert!((got - plane[channel]).abs() < 0.05 * got, "{bumps:?}, not {plane:?}");
            }
            seen.push(bumps[1]);
        }
        // The sun stands to one side.
        assert!((seen[0] - seen[1]).abs() > 0.1 * flat[1], "{seen:?} of {flat:?}");
        let [up, down] = [sin, -sin].map(|up| middle(&shown(&leaning(0.0, up), 0.5))[1]);
        assert!(up > 1.1 * down, "what leans up sees more of the sun: {up} {down}");
    }
}

/// Mirrored pictures, and such as are turned by a quarter, keep their directions: the frame is that of the picture.
#[test]
fn bumps_lean_as_the_picture_lies() {
    let Some(renderers) = backends() else { return };
    let (sin, _) = ops::sin_cos(0.35);
    let upright = shown(&leaning(sin, 0.0), 0.5);
    let lying = |change: fn([f32; 2]) -> [f32; 2], right: f64, up: f64| {
        let asset = of_model(leaning(right, up), |model| {
            model.vertices.iter_mut().for_each(|vertex| vertex.place = change(vertex.place));
        });
        shown(&asset, 0.5)
    };
    let worlds = [
        // The picture's right is to the left.
        lying(|[right, down]| [1.0 - right, down], -sin, 0.0),
        // Its top is to the right.
        lying(|[right, down]| [down, 1.0 - right], 0.0, sin),
        // Its top is to the left, and its right below.
        lying(|[right, down]| [down, right], 0.0, -sin),
    ];
    for mut renderer in renderers {
        let wanted = draw(&mut renderer, &upright, &camera());
        for world in &worlds {
            let got = draw(&mut renderer, world, &camera());
            let (a, b) = (wanted.rgb_at(60, 60).unwrap(), got.rgb_at(60, 60).unwrap());
            assert!(a.iter().zip(b).all(|(a, b)| a.abs_diff(b) <= 2), "{a:?} {b:?}");
        }
    }
}

/// A ball that is chequered, bumpy, metal here and dull there, shines in places and lies in its own shade.
fn everything(side: u32) -> Asset {
    of_model(ball([0.9; 3], Finish { metallic: 1.0, roughness: 1.0, emission: [0.3; 3] }), |model| {
        for vertex in &mut model.vertices {
            vertex.place = [vertex.normal[1], vertex.normal[2]].map(|part| 0.5 - 0.5 * part);
        }
        let image = |content, of: &dyn Fn(f64, f64) -> [u8; 3]| {
            let at = |k: u32| [k % side, k / side].map(|at| (f64::from(at) + 0.5) / f64::from(side) * 8.0);
            let pixels = (0..side * side).flat_map(|k| of(at(k)[0], at(k)[1])).collect();
            ModelImage { width: side, height: side, pixels, content, ..ModelImage::default() }
        };
        let wave = |at: f64| ops::sin(at * std::f64::consts::TAU);
        let is_odd = |x: f64, y: f64| (x as u32 + y as u32) % 2 == 1;
        let bump = |x: f64, y: f64| {
            let (right, up) = (-0.5 * wave(x + 0.25), 0.5 * wave(y + 0.25));
            let length = (1.0 + right * right + up * up).sqrt();
            [right / length, up / length, 1.0 / length].map(number)
        };
        model.images = vec![
            image(Content::Color, &|x, y| if is_odd(x, y) { [200, 180, 90] } else { [70, 90, 160] }),
            image(Content::Numbers, &|x, y| if is_odd(x, y) { [0, 70, 255] } else { [0, 220, 0] }),
            image(Content::Color, &|x, _| if x < 1.5 { [255, 60, 0] } else { [0; 3] }),
            image(Content::Numbers, &|x, y| [(150.0 + 100.0 * wave(x) * wave(y)) as u8, 0, 0]),
            image(Content::Numbers, &bump),
        ];
        let on = |image| Some(ModelTexture { image, wrap: [Wrap::Clamp; 2] });
        let part = &mut model.parts[0];
        part.texture = on(0);
        let rest = Pictures { shade_strength: 0.8, bump_scale: 0.9, ..Pictures::default() };
        part.pictures = Pictures { metal: on(1), emission: on(2), shade: on(3), bumps: on(4), ..rest };
    })
}

#[test]
fn both_backends_light_alike() {
    let Some([mut raster, mut raycast]) = backends() else { return };
    for (side, distance) in [(64, 4.0), (256, 5.0), (512, 12.0)] {
        let asset = everything(side);
        let (mut world, id) = alone(&asset, [distance, 0.2, -0.9]);
        put(&mut world, EntityKind::Prop, [12.0, 0.0, -2.0], 0.0, Shape::cuboid(30.0, 30.0, 0.8));
        add(&mut world, &asset, [distance + 2.0, -1.8, -0.9]);
        let [drawn, cast] = [&mut raster, &mut raycast].map(|renderer| draw(renderer, &world, &camera()));
        let on = |frame: &Frame, at: u32| frame.entity_at(at % SIDE, at / SIDE) == Some(id);
        // Not at outlines, where each sees another side of the ball.
        let pixels = (0..SIDE * SIDE).filter(|at| on(&drawn, *at) && on(&cast, *at));
        let of = |frame: &Frame| -> Vec<u8> {
            pixels.clone().flat_map(|at| frame.rgb_at(at % SIDE, at / SIDE).expect("there")).collect()
        };
        let (mean, differing) = difference(&of(&drawn), &of(&cast), 12);
        println!("{side} at {distance} m: {mean:.3}, on {:.2} % by more than 12", differing * 100.0);
        assert!(mean < 1.5 && differing < 0.02, "{mean}, {differing}");
        let Some([mut again, mut anew]) = backends() else { return };
        for (renderer, known) in [(&mut again, &drawn), (&mut anew, &cast)] {
            assert!(draw(renderer, &world, &camera()).rgb == known.rgb, "other bytes from a new renderer");
        }
    }
}
