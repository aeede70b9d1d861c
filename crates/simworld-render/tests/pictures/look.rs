//! What light and weather promise: Koschmieder's law, colours of lamps, and that depth and ids never notice.

use crate::common::{draw, looking_east, put, renderer, square, square_camera};
use simworld_core::asset::Season;
use simworld_core::environment::{Environment, Preset};
use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::scene::{EntityDesc, EntityKind, Shape, World};
use simworld_render::{Frame, RenderConfig, Renderer};

fn linear(byte: u8) -> f64 {
    let srgb = f64::from(byte) / 255.0;
    if srgb <= 0.04045 { srgb / 12.92 } else { simworld_core::ops::pow((srgb + 0.055) / 1.055, 2.4) }
}

fn under(renderer: &mut Renderer, name: &str) -> Frame {
    let mut world = square(0.0);
    world.set_environment(name.parse::<Preset>().expect("a preset").environment()).expect("in range");
    draw(renderer, &world, &square_camera(0.0, 128, 96))
}

/// How much darker than the haze behind it a black wall is, by the distance at which that falls to 5 %.
fn distance_of_least_contrast(renderer: &mut Renderer, visibility: f64) -> f64 {
    let mut contrast = |distance: f64| {
        let mut world = World::new();
        let mut environment = Environment::default();
        environment.weather.visibility = visibility;
        environment.weather.cloud_cover = 1.0;
        world.set_environment(environment).expect("weather in range");
        let size = 0.3 * distance;
        for (side, color) in [(1.0, [0.0; 3]), (-1.0, [0.9; 3])] {
            let pose = pose_facing(Point3::new(distance + 0.5, side * size * 0.5, -size * 0.5), 0.0);
            let wall = EntityDesc::new(EntityKind::Prop, pose, Shape::cuboid(1.0, size, size));
            world.spawn(wall.colored(color)).expect("a wall");
        }
        let frame = draw(renderer, &world, &looking_east(0.0, 65, 65));
        let at = |x| linear(frame.rgb_at(x, 33).expect("in the picture")[1]);
        at(37) - at(27)
    };
    let near = contrast(0.02 * visibility);
    // What 2 % of the visibility has taken already.
    let whole = near / simworld_core::ops::pow(0.05, 0.02);
    let (mut low, mut high) = (0.02 * visibility, 3.0 * visibility);
    for _ in 0..14 {
        let middle = 0.5 * (low + high);
        if contrast(middle) > 0.05 * whole { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// Koschmieder: contrast falls to 5 % at the visibility, so half the visibility halves that distance.
#[test]
fn halving_visibility_halves_the_distance_of_least_contrast() {
    let config =
        RenderConfig { shadow_resolution: 0, exposure_compensation: -1.5, ..RenderConfig::default() };
    let Some(mut renderer) = renderer(&config) else { return };
    let (far, near) =
        (distance_of_least_contrast(&mut renderer, 240.0), distance_of_least_contrast(&mut renderer, 120.0));
    assert!((far / near - 2.0).abs() < 0.12, "{far} and {near}");
    // Eight bits of colour leave a few percent.
    assert!((far / 240.0 - 1.0).abs() < 0.1, "{far}");
}

/// A white wall in the light of one lamp, at night: what colour it has, as CIE 1976 u' v'.
fn chromaticity(renderer: &mut Renderer, kelvin: f64) -> [f64; 2] {
    let mut world = World::new();
    let mut environment = Environment::default();
    environment.sun.elevation = -0.6;
    environment.weather.cloud_cover = 0.0;
    world.set_environment(environment).expect("a sun in range");
    let wall = pose_facing(Point3::new(6.0, 0.0, -4.0), 0.0);
    world
        .spawn(EntityDesc::new(EntityKind::Prop, wall, Shape::cuboid(0.5, 12.0, 12.0)).colored([0.8; 3]))
        .expect("a wall");
    let lamp = EntityDesc::new(
        EntityKind::Prop,
        pose_facing(Point3::new(2.0, 0.0, -1.5), 0.0),
        Shape::cuboid(0.1, 0.1, 0.1),
    );
    world.spawn(lamp.with("light_lumen", 2500.0).with("light_kelvin", kelvin)).expect("a lamp");
    let frame = draw(renderer, &world, &looking_east(0.5, 65, 65));
    let [r, g, b] = frame.rgb_at(32, 30).expect("in the picture").map(linear);
    assert!(g > 0.02 && r < 0.8, "lit and not blown out: {r} {g} {b}");
    let x = 0.4124 * r + 0.3576 * g + 0.1805 * b;
    let y = 0.2126 * r + 0.7152 * g + 0.0722 * b;
    let z = 0.0193 * r + 0.1192 * g + 0.9505 * b;
    let below = x + 15.0 * y + 3.0 * z;
    [4.0 * x / below, 9.0 * y / below]
}

/// Within 0.01 of D65 for 6500 K, and of the Planckian locus for 2700 K (u' 0.263, v' 0.527).
#[test]
fn lamps_have_the_colour_of_their_temperature() {
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    for (kelvin, [u, v]) in [(6500.0, [0.1978, 0.4683]), (2700.0, [0.2625, 0.5268])] {
        let [a, b] = chromaticity(&mut renderer, kelvin);
        let off = ((a - u) * (a - u) + (b - v) * (b - v)).sqrt();
        assert!(off < 0.012, "{kelvin} K: {a} {b}, {off} off");
    }
}

#[test]
fn depth_and_ids_do_not_notice_the_weather() {
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    let clear = under(&mut renderer, "ClearNoon");
    for name in ["HardRainNoon", "SnowNoon", "FogSunset", "WetNight", "HardRainNight"] {
        let other = under(&mut renderer, name);
        assert_eq!(
            (&clear.depth, &clear.ids, &clear.classes),
            (&other.depth, &other.ids, &other.classes),
            "{name}"
        );
        assert_ne!(clear.rgb, other.rgb, "{name}");
    }
}

/// Rain and snow fall by the clock: another moment is another picture, the same one the same.
#[test]
fn what_falls_falls_by_the_clock() {
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    let mut world = square(0.0);
    world
        .set_environment("HardRainNoon".parse::<Preset>().expect("a preset").environment())
        .expect("in range");
    let camera = square_camera(0.0, 128, 96);
    let first = draw(&mut renderer, &world, &camera);
    assert_eq!(first.rgb, draw(&mut renderer, &world, &camera).rgb);
    world.begin_step();
    world.finish_step();
    assert_ne!(first.rgb, draw(&mut renderer, &world, &camera).rgb, "a tenth of a second later");
}

/// Trees turn with the season of their scene, also where the renderer has drawn them before, and turn back.
#[test]
fn trees_turn_with_the_season() {
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    let mut world = World::new();
    for k in 0..6_u8 {
        // Some are conifers by chance.
        let at = [14.0, 4.0 * (f64::from(k) - 2.5), 0.0];
        put(&mut world, EntityKind::Tree, at, 0.0, Shape::Cylinder { radius: 0.15, height: 6.0 });
    }
    let camera = looking_east(2.5, 129, 97);
    let mut in_season = |season| {
        let environment = Environment { season, ..Environment::default() };
        world.set_environment(environment).expect("in range");
        draw(&mut renderer, &world, &camera)
    };
    let before = in_season(None);
    let autumn = in_season(Some(Season::Autumn));
    assert_ne!(before.rgb, autumn.rgb, "leaves turn");
    assert_eq!((&before.depth, &before.ids), (&autumn.depth, &autumn.ids), "and keep their shape");
    let seen = |frame: &Frame| frame.ids.iter().filter(|id| **id != 0).count();
    let winter = in_season(Some(Season::Winter));
    assert!(seen(&winter) < seen(&autumn), "one looks through twigs");
    assert_eq!(before.rgb, in_season(None).rgb);
}

/// Under a street lamp it is brighter than between two.
#[test]
fn street_lamps_light_the_street() {
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    let mut world = World::new();
    let mut environment = Environment::default();
    environment.sun.elevation = -0.6;
    world.set_environment(environment).expect("a sun in range");
    put(&mut world, EntityKind::Prop, [20.0, 0.0, -0.1], 0.0, Shape::cuboid(120.0, 60.0, 0.1));
    put(
        &mut world,
        EntityKind::StreetLamp,
        [12.0, -1.3, 0.0],
        std::f64::consts::FRAC_PI_2,
        Shape::Cylinder { radius: 0.09, height: 6.0 },
    );
    let camera = looking_east(3.0, 129, 97);
    let frame = draw(&mut renderer, &world, &camera);
    let green = |x: f64, y: f64| {
        let (pixel, _) = camera.project(&Point3::new(x, y, 0.0)).expect("ahead");
        linear(frame.rgb_at(pixel.x as u32, pixel.y as u32).expect("in the picture")[1])
    };
    let (under, far) = (green(12.0, 0.0), green(34.0, 8.0));
    assert!(under > 4.0 * far, "{under} under the lamp, {far} far from it");
}
