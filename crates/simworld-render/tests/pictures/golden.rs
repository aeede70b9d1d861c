//! Pictures look as they did: committed images of 160 x 120 pixels, drawn on llvmpipe.
//!
//! Tolerance, because adapters round differently: RGB may differ by 2.0 of 255 on average and by more than 24 in
//! 2 % of the bytes; 1 % of the class pixels may differ. `SIMWORLD_BLESS=1` writes the images anew; look at them.

use std::path::PathBuf;

use crate::common::{crossroads, difference, draw, renderer, square, square_camera};
use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::environment::Preset;
use simworld_core::geometry::Point3;
use simworld_render::{AntiAliasing, Frame, RenderConfig};

const MEAN: f64 = 2.0;
const DIFFERING: f64 = 0.02;
const CLASSES: f64 = 0.01;

fn path(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/golden").join(name)
}

fn pixels(name: &str) -> Vec<u8> {
    let file = std::fs::File::open(path(name))
        .unwrap_or_else(|error| panic!("{name}: {error}; SIMWORLD_BLESS=1 writes it"));
    let mut reader = png::Decoder::new(std::io::BufReader::new(file)).read_info().expect("a PNG");
    let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
    reader.next_frame(&mut pixels).expect("an image");
    pixels
}

fn check(name: &str, frame: &Frame) {
    let (rgb, classes) = (format!("{name}.png"), format!("{name}-classes.png"));
    if std::env::var_os("SIMWORLD_BLESS").is_some_and(|value| value == "1") {
        frame.write_png(path(&rgb)).expect("the golden folder can be written");
        frame.write_classes_png(path(&classes)).expect("the golden folder can be written");
        return;
    }
    let (mean, differing) = difference(&pixels(&rgb), &frame.rgb, 24);
    let (_, other_class) = difference(&pixels(&classes), &frame.classes, 0);
    let fits = mean <= MEAN && differing <= DIFFERING && other_class <= CLASSES;
    if !fits {
        let folder = std::env::temp_dir();
        frame.write_png(folder.join(&rgb)).expect("the temporary folder can be written");
        panic!(
            "{name} looks different: mean {mean:.2} (at most {MEAN}), share {differing:.4} (at most {DIFFERING}), \
             classes {other_class:.4} (at most {CLASSES}); see {}",
            folder.join(&rgb).display()
        );
    }
}

/// Six lights and weathers of one place.
#[test]
fn a_square_in_six_lights_and_weathers() {
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    let mut world = square(0.0);
    let camera = square_camera(0.0, 160, 120);
    for (name, preset) in [
        ("noon", "ClearNoon"),
        ("dusk", "CloudySunset"),
        ("night", "WetNight"),
        ("fog", "FogNoon"),
        ("rain", "HardRainNoon"),
        ("snow", "SnowNoon"),
    ] {
        let preset: Preset = preset.parse().expect("a preset");
        world.set_environment(preset.environment()).expect("weather in range");
        check(name, &draw(&mut renderer, &world, &camera));
    }
}

#[test]
fn a_square_from_above_with_smooth_edges() {
    let config = RenderConfig { anti_aliasing: AntiAliasing::Msaa4, ..RenderConfig::default() };
    let Some(mut renderer) = renderer(&config) else { return };
    let intrinsics = Intrinsics::from_fov(160, 120, 1.0).expect("a size in range");
    let camera = Camera::looking_at(Point3::new(-14.0, -26.0, 30.0), Point3::new(18.0, 0.0, 0.0), intrinsics);
    check("above", &draw(&mut renderer, &square(0.0), &camera));
}

/// Lanes, stop lines, arrows, cycle lanes, crossings and kerbs, from over the street and from the height of eyes.
#[test]
fn a_crossroads_with_all_that_is_painted_on_it() {
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    let intrinsics = Intrinsics::from_fov(320, 240, 1.2).expect("a size in range");
    for (name, eye, target) in [
        ("crossroads-above", Point3::new(-38.0, -20.0, 22.0), Point3::new(-8.0, 0.0, 0.0)),
        ("crossroads", Point3::new(-36.0, -4.0, 1.7), Point3::new(0.0, 0.0, 0.6)),
        ("kerb", Point3::new(-17.0, -7.0, 1.6), Point3::new(-11.5, -10.5, 0.0)),
    ] {
        check(name, &draw(&mut renderer, &crossroads(), &Camera::looking_at(eye, target, intrinsics)));
    }
}

/// The tolerance notices a missing thing: a picture without the bus is another one.
#[test]
fn the_tolerance_notices_what_is_missing() {
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    let camera = square_camera(0.0, 160, 120);
    let whole = draw(&mut renderer, &square(0.0), &camera);
    let mut world = square(0.0);
    let bus =
        world.iter().find(|entity| entity.kind == simworld_core::scene::EntityKind::Bus).expect("a bus").id;
    world.remove(bus).expect("it lives");
    let without = draw(&mut renderer, &world, &camera);
    let (_, differing) = difference(&whole.rgb, &without.rgb, 24);
    let (_, other_class) = difference(&whole.classes, &without.classes, 0);
    assert!(differing > DIFFERING || other_class > CLASSES, "share {differing}, classes {other_class}");
}
