//! What is blended is laid over what is behind it by its alpha, the nearest surface of each of two layers; depth, ids and normals are those of what counts: alike by triangles and by rays.

use crate::common::models::{add, card};
use crate::common::{difference, put, renderer};
use simworld_core::asset::{Asset, ModelImage, Transparency, light_of};
use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::scene::{EntityKind, Scene, Shape, World};
use simworld_render::{
    AntiAliasing, Backend, Channels, RenderConfig, Renderer, ViewOptions, ViewRequest, Views,
};

const SIDE: u32 = 120;
const GREEN: [u8; 3] = [10, 150, 10];
const RED: [u8; 3] = [150, 10, 10];
const BLUE: [u8; 3] = [10, 10, 150];

/// Without shadows, so that what is behind a card is lit as if it were not there.
fn backends() -> Option<[Renderer; 2]> {
    let with = |backend| renderer(&RenderConfig { backend, shadow_resolution: 0, ..RenderConfig::default() });
    Some([with(Backend::Raster)?, with(Backend::Raycast)?])
}

/// A card of one colour under a name, all over of one alpha, of 255.
fn pane(name: &str, color: [u8; 3], alpha: u8, transparency: Transparency) -> Asset {
    let (pixels, alpha) = (color.repeat(16), vec![alpha; 16]);
    let image = ModelImage { width: 4, height: 4, pixels, alpha, ..ModelImage::default() };
    let asset = card(image, [[0.0; 2], [1.0; 2]], |part| part.transparency = transparency);
    Asset { name: name.into(), ..asset }
}

/// Cards at distances before a wall, under a sun behind the camera.
fn scene(cards: &[(&Asset, f64)]) -> World {
    let mut world = World::new();
    put(&mut world, EntityKind::Prop, [9.0, 0.0, -4.0], 0.0, Shape::cuboid(1.0, 12.0, 8.0));
    for (asset, distance) in cards {
        add(&mut world, asset, [*distance, 0.0, -1.0]);
    }
    let mut environment = *world.environment();
    (environment.sun.azimuth, environment.sun.elevation) = (1.4 * std::f64::consts::PI, 0.5);
    environment.weather.cloud_cover = 0.0;
    world.set_environment(environment).expect("a sun in range");
    world
}

fn camera() -> Camera {
    let intrinsics = Intrinsics::from_fov(SIDE, SIDE, 0.5).expect("a size in range");
    Camera::looking_along(&pose_facing(Point3::origin(), 0.0), intrinsics)
}

fn some(renderer: &mut Renderer, world: &World, channels: Channels) -> Views {
    let options = ViewOptions { channels, ..ViewOptions::default() };
    let mut views = Views::new();
    renderer.render_views(world, &[ViewRequest::from(camera())], &options, &mut views).expect("it is drawn");
    views
}

fn all(renderer: &mut Renderer, world: &World) -> Views {
    some(renderer, world, Channels::all())
}

/// Linear light of some pixels on which all cards are seen.
fn lights(views: &Views) -> Vec<[f32; 3]> {
    let pixels = [(60, 60), (45, 52), (70, 75), (52, 70)];
    let light = |(x, y): (u32, u32)| {
        let first = (y * SIDE + x) as usize * 3;
        [0, 1, 2].map(|channel| light_of(views.rgb[first + channel]))
    };
    pixels.map(light).to_vec()
}

/// One colour over another, by its share.
fn over(above: &[[f32; 3]], below: &[[f32; 3]], share: f32) -> Vec<[f32; 3]> {
    let mix = |(a, b): (&[f32; 3], &[f32; 3])| {
        std::array::from_fn(|channel| a[channel] * share + b[channel] * (1.0 - share))
    };
    above.iter().zip(below).map(mix).collect()
}

fn is_near(what: &str, got: &[[f32; 3]], wanted: &[[f32; 3]]) {
    for (got, wanted) in got.iter().zip(wanted) {
        let near = got.iter().zip(wanted).all(|(got, wanted)| (got - wanted).abs() < 0.012 + 0.01 * *wanted);
        assert!(near, "{what}: {got:?}, not {wanted:?}");
    }
}

#[test]
fn a_pane_is_seen_by_its_alpha() {
    let Some(renderers) = backends() else { return };
    for mut renderer in renderers {
        let wall = lights(&all(&mut renderer, &scene(&[])));
        let whole = pane("whole", GREEN, 255, Transparency::Opaque);
        let whole = lights(&all(&mut renderer, &scene(&[(&whole, 5.0)])));
        assert!(whole[0][0] < 0.5 * wall[0][0], "the wall is seen to be lighter: {whole:?} {wall:?}");
        for alpha in [255, 204, 128, 102, 51, 10, 0] {
            let pane = pane("pane", GREEN, alpha, Transparency::Blend);
            let got = lights(&all(&mut renderer, &scene(&[(&pane, 5.0)])));
            is_near(&format!("alpha {alpha}"), &got, &over(&whole, &wall, f32::from(alpha) / 255.0));
        }
    }
}

/// A half or more of it has depth, is who is seen, and is faced; less of it changes colour alone; whatever else is asked for.
#[test]
fn what_counts_is_told_by_a_half() {
    let Some(renderers) = backends() else { return };
    for mut renderer in renderers {
        let bare = all(&mut renderer, &scene(&[]));
        for (alpha, counts) in [(255, true), (128, true), (127, false), (40, false)] {
            let pane = pane("pane", GREEN, alpha, Transparency::Blend);
            let cut = self::pane("cut", GREEN, 255, Transparency::Cutout { cutoff: 0.5 });
            let world = scene(&[(&pane, 5.0)]);
            let got = all(&mut renderer, &world);
            let cut = all(&mut renderer, &scene(&[(&cut, 5.0)]));
            let wanted = if counts { &cut } else { &bare };
            assert!(got.ids == wanted.ids && got.depth == wanted.depth, "alpha {alpha}");
            assert!(got.normals == wanted.normals, "alpha {alpha}");
            assert!(got.rgb != bare.rgb, "alpha {alpha} is seen");
            let measures = some(&mut renderer, &world, Channels::DEPTH | Channels::IDS);
            assert!(measures.ids == got.ids && measures.depth == got.depth, "alpha {alpha}, without colour");
            assert!(some(&mut renderer, &world, Channels::RGB).rgb == got.rgb, "alpha {alpha}, colour alone");
        }
    }
}

/// What is thin lies over what counts, and of either the nearest is seen.
#[test]
fn two_layers_lie_over_one_another() {
    let Some(renderers) = backends() else { return };
    let blended = |name, color, alpha| pane(name, color, alpha, Transparency::Blend);
    for mut renderer in renderers {
        let wall = lights(&all(&mut renderer, &scene(&[])));
        let mut whole = |color, distance| {
            lights(&all(
                &mut renderer,
                &scene(&[(&pane("whole", color, 255, Transparency::Opaque), distance)]),
            ))
        };
        let (red, green) = (whole(RED, 4.0), whole(GREEN, 5.0));
        let (thin, thick) = (51.0 / 255.0, 178.0 / 255.0);
        for (what, layers, wanted) in [
            (
                "thin before thick",
                [("a", RED, 51, 4.0), ("b", GREEN, 178, 5.0)],
                over(&red, &over(&green, &wall, thick), thin),
            ),
            ("thin behind thick", [("a", RED, 178, 4.0), ("b", GREEN, 51, 5.0)], over(&red, &wall, thick)),
            ("two thin ones", [("a", GREEN, 51, 5.0), ("b", BLUE, 51, 6.0)], over(&green, &wall, thin)),
            ("two thick ones", [("a", BLUE, 178, 6.0), ("b", RED, 178, 4.0)], over(&red, &wall, thick)),
        ] {
            let assets = layers.map(|(name, color, alpha, _)| blended(name, color, alpha));
            let world = scene(&[(&assets[0], layers[0].3), (&assets[1], layers[1].3)]);
            is_near(what, &lights(&all(&mut renderer, &world)), &wanted);
        }
        // What is whole hides whatever is behind it, and is seen through what is before it.
        let solid = pane("solid", GREEN, 255, Transparency::Opaque);
        let behind = blended("a", BLUE, 178);
        let got = lights(&all(&mut renderer, &scene(&[(&solid, 5.0), (&behind, 6.0)])));
        is_near("behind what is whole", &got, &green);
        let before = blended("a", RED, 178);
        let got = lights(&all(&mut renderer, &scene(&[(&solid, 5.0), (&before, 4.0)])));
        is_near("before what is whole", &got, &over(&red, &green, thick));
    }
}

/// Glass that grows denser from left to right, two of them and a slanting one, in rain too: both backends show the same, and the same again.
#[test]
fn both_backends_lay_alike() {
    let Some([mut raster, mut raycast]) = backends() else { return };
    let pixels = [40, 90, 160].repeat(64 * 64);
    let alpha = (0..64 * 64_u32).map(|k| (k % 64 * 4) as u8).collect();
    let image = ModelImage { width: 64, height: 64, pixels, alpha, ..ModelImage::default() };
    let asset = card(image, [[0.0; 2], [1.0; 2]], |part| part.transparency = Transparency::Blend);
    for rain in [0.0, 8.0] {
        let mut world = scene(&[(&asset, 5.0), (&asset, 6.5)]);
        let id = world.add_asset(asset.clone()).expect("it is an asset");
        let pose = pose_facing(Point3::new(4.0, 0.5, -0.8), 0.8);
        world.spawn(asset.at(id, pose)).expect("a solid in the world");
        let mut environment = *world.environment();
        environment.weather.rain = rain;
        world.set_environment(environment).expect("weather in range");
        let [drawn, cast] = [&mut raster, &mut raycast].map(|renderer| all(renderer, &world));
        let differing = drawn.ids.iter().zip(&cast.ids).filter(|(a, b)| a != b).count();
        assert!(differing as f64 <= 2e-3 * drawn.ids.len() as f64, "{differing} ids differ");
        let (mean, many) = difference(&drawn.rgb, &cast.rgb, 12);
        println!("rain {rain}: both differ by {mean:.3}, on {:.2} % by more than 12", many * 100.0);
        let most = if rain > 0.0 { 0.05 } else { 0.01 };
        assert!(mean < 1.5 && many < most, "rain {rain}: both differ by {mean}, {many}");
        let Some([mut again, mut anew]) = backends() else { return };
        assert!(all(&mut again, &world).rgb == drawn.rgb && all(&mut anew, &world).rgb == cast.rgb);
    }
}

#[test]
fn smoothed_pictures_have_the_panes_as_well() {
    let with = |anti_aliasing| {
        let config =
            RenderConfig { backend: Backend::Raster, shadow_resolution: 0, ..RenderConfig::default() };
        renderer(&RenderConfig { anti_aliasing, ..config })
    };
    let (Some(mut smooth), Some(mut plain)) = (with(AntiAliasing::Msaa4), with(AntiAliasing::Off)) else {
        return;
    };
    let (thin, thick) =
        (pane("thin", RED, 60, Transparency::Blend), pane("thick", BLUE, 200, Transparency::Blend));
    let world = scene(&[(&thin, 4.0), (&thick, 6.0)]);
    let [smooth, plain] = [&mut smooth, &mut plain].map(|renderer| all(renderer, &world));
    assert!(smooth.ids == plain.ids && smooth.depth == plain.depth && smooth.normals == plain.normals);
    let (mean, _) = difference(&smooth.rgb, &plain.rgb, 24);
    assert!(mean < 1.0, "colours differ by {mean}");
    is_near("smoothed", &lights(&smooth), &lights(&plain));
}
