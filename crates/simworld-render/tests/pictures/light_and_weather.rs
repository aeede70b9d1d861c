//! Light and weather change colours, and never depth or ids.

use crate::common::{draw, looking_east, put, renderer, square, square_camera};
use simworld_core::environment::Environment;
use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::net::Aspect;
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
use simworld_render::{Frame, RenderConfig, Renderer};

fn under(renderer: &mut Renderer, change: impl Fn(&mut Environment)) -> Frame {
    let mut world = square(0.0);
    let mut environment = Environment::default();
    change(&mut environment);
    world.set_environment(environment).expect("weather in range");
    draw(renderer, &world, &square_camera(0.0, 120, 90))
}

fn brightness(frame: &Frame) -> f64 {
    frame.rgb.iter().map(|byte| f64::from(*byte)).sum::<f64>() / frame.rgb.len() as f64
}

#[test]
fn fog_and_night_change_colours_alone() {
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    let clear = under(&mut renderer, |_| {});
    let fog = under(&mut renderer, |environment| environment.weather.visibility = 40.0);
    let night = under(&mut renderer, |environment| environment.sun.elevation = -0.5);
    for other in [&fog, &night] {
        assert_eq!((&clear.depth, &clear.ids, &clear.classes), (&other.depth, &other.ids, &other.classes));
        assert_ne!(clear.rgb, other.rgb);
    }
    assert!(brightness(&night) < 0.75 * brightness(&clear), "{} {}", brightness(&night), brightness(&clear));
}

/// Koschmieder: at the visibility, 5 % of the contrast between a dark wall and the haze is left.
#[test]
fn contrast_falls_with_distance_in_fog() {
    let config =
        RenderConfig { shadow_resolution: 0, exposure_compensation: -0.5, ..RenderConfig::default() };
    let Some(mut renderer) = renderer(&config) else { return };
    let mut contrast_at = |distance: f64| {
        let mut world = World::new();
        let mut environment = Environment::default();
        environment.weather.visibility = 200.0;
        environment.weather.cloud_cover = 1.0;
        world.set_environment(environment).expect("weather in range");
        let size = 0.4 * distance;
        let wall = |side: f64, color| {
            let pose = pose_facing(Point3::new(distance + 0.5, side * size * 0.5, -size * 0.5), 0.0);
            EntityDesc::new(EntityKind::Prop, pose, Shape::cuboid(1.0, size, size)).colored(color)
        };
        world.spawn(wall(1.0, [0.0; 3])).expect("a wall");
        world.spawn(wall(-1.0, [1.0; 3])).expect("a wall");
        let frame = draw(&mut renderer, &world, &looking_east(0.0, 65, 65));
        let linear = |x| {
            let srgb = f64::from(frame.rgb_at(x, 33).expect("in the picture")[1]) / 255.0;
            simworld_core::ops::pow((srgb + 0.055) / 1.055, 2.4)
        };
        linear(38) - linear(26)
    };
    let (near, far) = (contrast_at(12.0), contrast_at(50.0));
    // 38 m more of 200: 0.05 to the power 0.19.
    let share = far / near;
    assert!((share - 0.566).abs() < 0.02, "{share}");
}

#[test]
fn a_roof_throws_its_shadow() {
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    let mut world = World::new();
    let mut environment = Environment::default();
    environment.sun.elevation = std::f64::consts::FRAC_PI_2 - 0.01;
    environment.weather.cloud_cover = 0.0;
    world.set_environment(environment).expect("weather in range");
    put(&mut world, EntityKind::Prop, [20.0, 0.0, -0.1], 0.0, Shape::cuboid(200.0, 200.0, 0.1));
    put(&mut world, EntityKind::Prop, [12.0, 0.0, 5.0], 0.0, Shape::cuboid(4.0, 4.0, 0.2));
    let camera = looking_east(2.0, 161, 121);
    let frame = draw(&mut renderer, &world, &camera);
    let green = |point: Point3| {
        let (pixel, _) = camera.project(&point).expect("ahead");
        frame.rgb_at(pixel.x as u32, pixel.y as u32).expect("in the picture")[1]
    };
    let (shaded, lit) = (green(Point3::new(12.0, 0.0, 0.0)), green(Point3::new(12.0, 5.0, 0.0)));
    assert!(f64::from(shaded) < 0.75 * f64::from(lit), "{shaded} in the shade, {lit} in the sun");
}

/// A scene that adds signals to a world.
struct Signalled {
    world: World,
    signals: Vec<Aspect>,
}

impl Scene for Signalled {
    fn entity(&self, id: simworld_core::id::EntityId) -> Option<simworld_core::scene::EntityRef<'_>> {
        self.world.entity(id)
    }
    fn visit(
        &self,
        region: &simworld_core::geometry::Aabb,
        visitor: &mut dyn FnMut(simworld_core::scene::EntityRef<'_>) -> std::ops::ControlFlow<()>,
    ) -> std::ops::ControlFlow<()> {
        self.world.visit(region, visitor)
    }
    fn environment(&self) -> &Environment {
        self.world.environment()
    }
    fn signals(&self) -> &[Aspect] {
        &self.signals
    }
}

#[test]
fn signals_shine_in_the_colour_of_their_group() {
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    let mut world = World::new();
    let pose = pose_facing(Point3::new(3.0, 0.0, 0.0), std::f64::consts::PI);
    let post =
        EntityDesc::new(EntityKind::TrafficSignal, pose, Shape::Cylinder { radius: 0.08, height: 3.5 });
    world.spawn(post.with("signal_group", 1)).expect("a post");
    let camera = looking_east(3.0, 160, 160);
    let mut brightest = |signals: Vec<Aspect>| {
        let mut frame = Frame::new();
        let scene = Signalled { world: world.clone(), signals };
        renderer.render(&scene, &camera, &mut frame).expect("it is drawn");
        let on_post = frame.rgb.chunks_exact(3).zip(&frame.ids).filter(|(_, id)| **id != 0);
        let vivid = |rgb: &[u8]| rgb.iter().max().unwrap() - rgb.iter().min().unwrap();
        on_post.map(|(rgb, _)| [rgb[0], rgb[1], rgb[2]]).max_by_key(|rgb| vivid(rgb)).expect("it is seen")
    };
    let [r, g, b] = brightest(vec![Aspect::Green, Aspect::Red]);
    assert!(r > 180 && g < 120 && b < 120, "red: {r} {g} {b}");
    let [r, g, b] = brightest(vec![Aspect::Red, Aspect::Green]);
    assert!(g > 180 && r < 140 && b < 200, "green: {r} {g} {b}");
    let [r, g, b] = brightest(Vec::new());
    assert!(r.max(g).max(b) - r.min(g).min(b) < 100, "dark: {r} {g} {b}");
}
