//! Models take light as their finish says: metal and roughness by the equations of the materials, and light of their own.

use crate::common::models::{add, alone, ball, board};
use crate::common::{draw, put, renderer};
use simworld_core::asset::{Finish, Wrap, light_of};
use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::{Point2, Point3, Vector3, pose_facing};
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
use simworld_render::{Backend, Frame, RenderConfig, Renderer};

const COLOR: [f32; 3] = [0.1, 0.06, 0.03];
/// Where the ball stands.
const FOOT: [f64; 3] = [6.0, 0.0, -1.0];

fn backends() -> Option<[Renderer; 2]> {
    let with = |backend| renderer(&RenderConfig { backend, ..RenderConfig::default() });
    Some([with(Backend::Raster)?, with(Backend::Raycast)?])
}

fn camera() -> Camera {
    let intrinsics = Intrinsics::from_fov(120, 90, 0.55).expect("a size in range");
    Camera::looking_along(&pose_facing(Point3::origin(), 0.0), intrinsics)
}

/// Sunlight from behind the camera.
fn lit(mut world: World) -> World {
    let mut environment = *world.environment();
    environment.sun.azimuth = 1.4 * std::f64::consts::PI;
    environment.sun.elevation = 0.5;
    environment.weather.cloud_cover = 0.0;
    world.set_environment(environment).expect("a sun in range");
    world
}

/// Linear light of a pixel.
fn light(frame: &Frame, x: u32, y: u32) -> [f64; 3] {
    frame.rgb_at(x, y).expect("on the picture").map(|value| f64::from(light_of(value)))
}

/// What a surface sends to `view` of the light of a sun that makes a white one as bright as 1: shading.wgsl in double precision.
fn reflected(finish: &Finish, normal: &Vector3, view: &Vector3, sun: &Vector3) -> [f64; 3] {
    let (metallic, roughness) = (f64::from(finish.metallic), f64::from(finish.roughness));
    let (cosine, half) = (normal.dot(sun).max(0.0), (view + sun).normalize());
    let (facing, h) = (normal.dot(view).max(0.05), normal.dot(&half).max(0.0));
    let grazing = 1.0 - view.dot(&half);
    let schlick = grazing * grazing * grazing * grazing * grazing;
    let a = roughness * roughness;
    let below = h * h * (a * a - 1.0) + 1.0;
    let visible = 0.5 / (2.0 * facing * cosine * (1.0 - a) + (facing + cosine) * a);
    let lobe = a * a / (below * below) * visible;
    COLOR.map(|albedo| {
        let albedo = f64::from(albedo);
        let base = 0.04 * (1.0 - metallic) + albedo * metallic;
        (albedo * (1.0 - metallic) + (base + (1.0 - base) * schlick) * lobe) * cosine
    })
}

/// The sun's part of every pixel of a ball: the picture with the sun less that in the shadow of a slab behind the camera.
fn sunlight(renderer: &mut Renderer, finish: Finish) -> Vec<Option<[f64; 3]>> {
    let (world, id) = alone(&ball(COLOR, finish), FOOT);
    let world = lit(world);
    let mut shaded = world.clone();
    let high = world.environment().sun.direction() * 28.0;
    put(&mut shaded, EntityKind::Prop, [6.0 + high.x, high.y, high.z], 0.0, Shape::cuboid(14.0, 14.0, 0.5));
    let [sunny, shady] = [&world, &shaded].map(|world| draw(renderer, world, &camera()));
    let one = |index: u32| {
        let (x, y) = (index % 120, index / 120);
        let (bright, dim) = (light(&sunny, x, y), light(&shady, x, y));
        // From there on light is pressed together to what a display shows.
        let is_true = sunny.entity_at(x, y) == Some(id) && bright.iter().all(|channel| *channel < 0.78);
        is_true.then(|| std::array::from_fn(|channel| bright[channel] - dim[channel]))
    };
    (0..120 * 90).map(one).collect()
}

#[test]
fn metal_and_roughness_are_those_of_the_equations() {
    let Some(renderers) = backends() else { return };
    let dull = Finish::default();
    let metal = Finish { metallic: 1.0, roughness: 0.55, ..dull };
    let smooth = Finish { roughness: 0.55, ..dull };
    let sun = lit(World::new()).environment().sun.direction();
    let center = Vector3::new(FOOT[0], 0.0, 0.0);
    for (name, mut renderer) in ["raster", "raycast"].into_iter().zip(renderers) {
        let [of_dull, of_metal, of_smooth] =
            [dull, metal, smooth].map(|finish| sunlight(&mut renderer, finish));
        let (mut checked, mut highlights) = (0, 0);
        for (index, pixel) in of_dull.iter().enumerate() {
            let at = Point2::new((index % 120) as f64 + 0.5, (index / 120) as f64 + 0.5);
            let ray =
                (camera().world_from_optical * camera().intrinsics.unproject(&at, 1.0)).coords.normalize();
            let along = ray.dot(&center);
            let inside = along * along - center.norm_squared() + 1.0;
            let (Some(pixel), true) = (pixel, inside > 0.1) else { continue };
            let normal = ray * (along - inside.sqrt()) - center;
            if normal.dot(&sun) < 0.25 {
                continue;
            }
            // How bright a white surface is, by the dull ball.
            let expected = reflected(&dull, &normal, &-ray, &sun);
            let white: [f64; 3] = std::array::from_fn(|channel| pixel[channel] / expected[channel]);
            for (finish, pixels) in [(&metal, &of_metal), (&smooth, &of_smooth)] {
                let Some(got) = pixels[index] else { continue };
                let want = reflected(finish, &normal, &-ray, &sun);
                for channel in 0..3 {
                    let want = want[channel] * white[channel];
                    assert!(
                        (got[channel] - want).abs() < 0.012 + 0.05 * want,
                        "{name}, {finish:?}, {at}: {got:?}, and {want} is expected of channel {channel}"
                    );
                }
                checked += 1;
                highlights += usize::from(got[0] > 1.5 * pixel[0]);
            }
        }
        println!("{name}: {checked} pixels, {highlights} of them in highlights");
        assert!(checked > 1200 && highlights > 50, "{name}: {checked} pixels, {highlights} in highlights");
    }
}

/// A smooth ball is lit smoothly: no pixel within it is far from what is around it, wherever its triangles end and its own shadow begins.
#[test]
fn no_pixel_of_a_ball_stands_out() {
    let Some(renderers) = backends() else { return };
    for (name, mut renderer) in ["raster", "raycast"].into_iter().zip(renderers) {
        for azimuth in [0.2, 0.6, 1.0, 1.4, 1.8] {
            let (world, id) = alone(&ball([0.9; 3], Finish::default()), FOOT);
            let mut world = lit(world);
            let mut environment = *world.environment();
            environment.sun.azimuth = azimuth * std::f64::consts::PI;
            world.set_environment(environment).expect("a sun in range");
            let frame = draw(&mut renderer, &world, &camera());
            for (x, y) in (1..119).flat_map(|x| (1..89).map(move |y| (x, y))) {
                let around = [(0, 0), (1, 0), (2, 0), (0, 1), (2, 1), (0, 2), (1, 2), (2, 2)];
                let around = around.map(|(right, down)| (x + right - 1, y + down - 1));
                let within = |(x, y): &(u32, u32)| frame.entity_at(*x, *y) == Some(id);
                if !within(&(x, y)) || !around.iter().all(within) {
                    continue;
                }
                let own = frame.rgb_at(x, y).expect("on the picture")[1];
                let others = around.map(|(x, y)| frame.rgb_at(x, y).expect("on the picture")[1]);
                let (least, most) = (others.iter().min().unwrap(), others.iter().max().unwrap());
                let is_between = own + 12 >= *least && own <= most.saturating_add(12);
                assert!(is_between, "{name}, sun at {azimuth} π: {own} at {x}, {y} among {others:?}");
            }
        }
    }
}

#[test]
fn what_is_dull_looks_as_the_solid_that_it_is() {
    let Some(renderers) = backends() else { return };
    for mut renderer in renderers {
        let (mut world, mut plain) = (World::new(), World::new());
        let white = board(None, [[0.0; 2], [1.0; 2]], [Wrap::Repeat; 2]);
        add(&mut world, &white, [6.0, 0.0, -1.0]);
        let shape = Shape::cuboid(0.2, 2.0, 2.0);
        let pose = pose_facing(Point3::new(6.0, 0.0, -1.0), 0.0);
        plain.spawn(EntityDesc::new(EntityKind::Prop, pose, shape).colored([1.0; 3])).expect("a solid");
        let [model, solid] = [world, plain].map(|world| draw(&mut renderer, &lit(world), &camera()));
        assert!(model.depth == solid.depth && model.classes == solid.classes);
        let (mean, differing) = crate::common::difference(&model.rgb, &solid.rgb, 1);
        assert!(differing == 0.0, "they differ by {mean}, on {differing} by more than one");
    }
}

#[test]
fn light_of_its_own_is_seen_at_night() {
    let Some(renderers) = backends() else { return };
    let glowing = Finish { emission: [0.4, 0.05, 0.0], ..Finish::default() };
    for mut renderer in renderers {
        let mut at_night = |finish| {
            let (mut world, _) = alone(&ball([0.0; 3], finish), FOOT);
            let mut environment = *world.environment();
            environment.sun.elevation = -0.5;
            world.set_environment(environment).expect("a sun in range");
            draw(&mut renderer, &world, &camera())
        };
        let (dark, bright) = (at_night(Finish::default()), at_night(glowing));
        assert!(dark.depth == bright.depth && dark.ids == bright.ids);
        let added: [f64; 3] =
            std::array::from_fn(|channel| light(&bright, 60, 45)[channel] - light(&dark, 60, 45)[channel]);
        // 1.75 of its emission in the dark.
        for (got, emission) in added.into_iter().zip([0.4, 0.05, 0.0]) {
            assert!((got - 1.75 * emission).abs() < 0.02, "{added:?}");
        }
        assert_eq!(bright.rgb_at(2, 2), dark.rgb_at(2, 2), "it lights nothing else");
    }
}
