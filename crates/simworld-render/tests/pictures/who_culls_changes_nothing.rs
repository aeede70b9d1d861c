//! What the device finds to be seen is what the host does: colour, depth, ids and normals are the same bit for bit.

use crate::common::models::{add, ball, card};
use crate::common::{crossroads, put, renderer, square, square_camera};
use simworld_core::asset::{Asset, Finish, ModelImage, ModelPart, Transparency};
use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::{Point3, Twist, Vector3};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityKind, Scene, Shape, World};
use simworld_core::seed::{Seed, StreamRng};
use simworld_render::{
    AntiAliasing, Backend, Channels, Culling, LevelOfDetail, Projection, RenderConfig, Renderer, ViewOptions,
    ViewRequest, Views,
};

/// Two renderers that differ in who culls.
fn pair(config: &RenderConfig) -> Option<[Renderer; 2]> {
    let with = |culling| renderer(&RenderConfig { backend: Backend::Raster, culling, ..config.clone() });
    let pair = [with(Culling::Host)?, with(Culling::Device)?];
    if pair[1].culling() == Culling::Host {
        let required = std::env::var_os("SIMWORLD_REQUIRE_ADAPTER").is_some_and(|value| value == "1");
        assert!(!required, "{} cannot cull", pair[1].adapter());
        println!("skipped: {} cannot cull", pair[1].adapter());
        return None;
    }
    assert_eq!(pair[0].culling(), Culling::Host);
    Some(pair)
}

/// Draws with both, and compares everything; gives how many pixels are none of the sky.
fn agree(pair: &mut [Renderer; 2], world: &World, requests: &[ViewRequest], what: &str) -> usize {
    let options = ViewOptions { channels: Channels::all(), ..ViewOptions::default() };
    let [host, device] = pair.each_mut().map(|renderer| {
        let mut views = Views::new();
        renderer.render_views(world, requests, &options, &mut views).expect("it is drawn");
        views
    });
    let bits = |depth: &[f32]| depth.iter().map(|depth| depth.to_bits()).collect::<Vec<_>>();
    let differ = |name: &str, same: bool| assert!(same, "{what}: {name} differs");
    differ("who is where", host.ids == device.ids);
    differ("depth", bits(&host.depth) == bits(&device.depth));
    differ("colour", host.rgb == device.rgb);
    differ("what is normal to it", host.normals == device.normals);
    host.ids.iter().filter(|id| **id != 0).count()
}

/// A street of that length, with houses in rows, trees, cars, people, and boxes that lie in one another and have faces in one plane.
fn street(rng: &mut StreamRng, length: f64) -> (World, Vec<EntityId>) {
    let mut world = World::new();
    put(&mut world, EntityKind::Ground, [0.0, 0.0, -1.1], 0.0, Shape::cuboid(length + 200.0, 900.0, 1.0));
    put(&mut world, EntityKind::Road, [0.0, 0.0, -0.1], 0.0, Shape::cuboid(length, 8.0, 0.1));
    put(&mut world, EntityKind::Road, [3.0, 0.0, -0.1], 1.4, Shape::cuboid(300.0, 8.0, 0.1));
    for beside in [-6.0, 6.0] {
        put(&mut world, EntityKind::Sidewalk, [0.0, beside, -0.1], 0.0, Shape::cuboid(length, 4.0, 0.2));
    }
    let mut movers = Vec::new();
    for _ in 0..(length * 1.5) as u32 {
        let sign = if rng.uniform(0.0, 1.0) < 0.5 { 1.0 } else { -1.0 };
        let (kind, beside, shape) = match rng.uniform(0.0, 8.0) as u32 {
            0 => (EntityKind::Building, 16.0, Shape::cuboid(12.0, 14.0, rng.uniform(6.0, 25.0))),
            1 => (EntityKind::Tree, rng.uniform(8.0, 40.0), Shape::Cylinder { radius: 0.15, height: 6.0 }),
            2 => (EntityKind::StreetLamp, 4.6, Shape::Cylinder { radius: 0.09, height: 6.0 }),
            3 | 4 => (EntityKind::Car, 2.0, Shape::cuboid(4.4, 1.8, 1.5)),
            // On whole metres: many have faces where others have theirs.
            5 => (EntityKind::Prop, rng.uniform(9.0, 12.0).round(), Shape::cuboid(2.0, 2.0, 1.0)),
            _ => (EntityKind::Person, rng.uniform(4.8, 7.2), Shape::Capsule { radius: 0.25, height: 1.75 }),
        };
        let along = (rng.uniform(-0.5, 0.5) * length).round();
        let id = put(&mut world, kind, [along, sign * beside, 0.1], 0.0, shape);
        if kind.is_mobile() {
            movers.push(id);
        }
    }
    world.finish_step();
    (world, movers)
}

fn looks(rng: &mut StreamRng, length: f64, count: usize) -> Vec<ViewRequest> {
    let one = |_| {
        let high = if rng.uniform(0.0, 1.0) < 0.2 { rng.uniform(10.0, 60.0) } else { 1.7 };
        let eye = Point3::new(rng.uniform(-0.4, 0.4) * length, rng.uniform(-7.0, 7.0), high);
        let to = eye + Vector3::new(rng.uniform(-30.0, 30.0), rng.uniform(-20.0, 20.0), 1.0 - high * 0.5);
        let intrinsics = Intrinsics::from_fov(120, 90, rng.uniform(0.5, 1.6)).expect("a size in range");
        ViewRequest::from(Camera::looking_at(eye, to, intrinsics))
    };
    (0..count).map(one).collect()
}

/// Short and long streets, in which cars and people move, and of which houses hide the most.
#[test]
fn streets_look_the_same() {
    let Some(mut pair) = pair(&RenderConfig::default()) else { return };
    let mut rng = Seed(21).stream("tests/who_culls").rng();
    let mut pixels = 0;
    for length in [40.0, 300.0, 1500.0] {
        let (mut world, movers) = street(&mut rng, length);
        for step in 0..5 {
            for id in &movers {
                let pose =
                    world.entity(*id).expect("it lives").pose * nalgebra::Translation3::new(0.7, 0.0, 0.0);
                world.set_motion(*id, pose, Twist::ZERO).expect("it lives");
            }
            if step == 3 {
                world.remove(movers[0]).expect("it lives");
            }
            world.finish_step();
            let mut requests = looks(&mut rng, length, if step == 2 { 9 } else { 2 });
            requests[0].hidden = Some(movers[1]);
            pixels += agree(&mut pair, &world, &requests, &format!("{length} m, step {step}"));
            if step == 3 {
                break;
            }
        }
    }
    assert!(pixels > 100_000, "{pixels} pixels of somebody");
}

/// Maps from above, one body alone, smoothed edges, the finest level, and without a map of shadows.
#[test]
fn whatever_is_asked_for() {
    let mut rng = Seed(22).stream("tests/who_culls").rng();
    let (world, movers) = street(&mut rng, 200.0);
    let finest = RenderConfig { level_of_detail: LevelOfDetail::Finest, ..RenderConfig::default() };
    let smooth = RenderConfig { anti_aliasing: AntiAliasing::Msaa4, ..RenderConfig::default() };
    let few = RenderConfig { shadow_resolution: 0, min_pixels: 12.0, far: 60.0, ..RenderConfig::default() };
    for (what, config) in [("finest", finest), ("smooth", smooth), ("few", few)] {
        let Some(mut pair) = pair(&config) else { return };
        let mut requests = looks(&mut rng, 200.0, 3);
        requests[1].only = Some(movers[3]);
        let (down, intrinsics) = (Point3::new(0.5, 0.0, 0.0), requests[2].camera.intrinsics);
        requests[2].camera = Camera::looking_at(Point3::new(0.0, 0.0, 50.0), down, intrinsics);
        requests[2].projection = Projection::Parallel;
        (requests[2].camera.intrinsics.fx, requests[2].camera.intrinsics.fy) = (2.0, 2.0);
        assert!(agree(&mut pair, &world, &requests, what) > 1000);
    }
}

/// Small scenes with all patterns, at the origin and far from it, an empty one, and one after the other.
#[test]
fn one_of_everything() {
    let Some(mut pair) = pair(&RenderConfig::default()) else { return };
    let request = |shift| [ViewRequest::from(square_camera(shift, 160, 120))];
    for round in 0..2 {
        assert!(agree(&mut pair, &square(0.0), &request(0.0), "a square") > 1000);
        assert!(agree(&mut pair, &square(9e6), &request(9e6), "a square far away") > 1000);
        assert_eq!(agree(&mut pair, &World::new(), &request(0.0), "nothing"), 0);
        assert!(agree(&mut pair, &crossroads(), &request(0.0), "crossroads") > 1000, "round {round}");
    }
}

/// Models that rest are found by the device, with what is cut out of them and what of them is blended; while one plays a clip the host culls.
#[test]
fn models_are_found_too() {
    let Some(mut pair) = pair(&RenderConfig::default()) else { return };
    let (mut world, _) = street(&mut Seed(23).stream("tests/who_culls").rng(), 60.0);
    let holes = |part: &mut ModelPart| part.transparency = Transparency::Cutout { cutoff: 0.5 };
    let pixels = vec![200; 3 * 64];
    let alpha = (0..64_u8).map(|index| if index % 3 == 0 { 0 } else { 255 }).collect();
    let image = ModelImage { width: 8, height: 8, pixels, alpha, ..ModelImage::default() };
    let glass = |part: &mut ModelPart| part.transparency = Transparency::Blend;
    let glass = Asset { name: "glass".into(), ..card(image.clone(), [[0.0; 2], [1.0; 2]], glass) };
    let (ball, card) = (ball([0.2, 0.5, 0.3], Finish::default()), card(image, [[0.0; 2], [1.0; 2]], holes));
    let mut last = None;
    for step in 0..4 {
        // Each under an asset of its own, and one of them goes.
        add(&mut world, &ball, [f64::from(step) * 2.0, 1.0, 0.0]);
        add(&mut world, &glass, [f64::from(step) - 3.0, 0.4, 0.7]);
        if let Some(id) = last.replace(add(&mut world, &card, [f64::from(step), -1.0, 0.5])) {
            world.remove(id).expect("it lives");
        }
        world.finish_step();
        let intrinsics = Intrinsics::from_fov(160, 120, 1.2).expect("a size in range");
        let eye = Point3::new(-5.0, f64::from(step) * 0.3, 2.0);
        let requests = [Camera::looking_at(eye, Point3::new(2.0, 0.0, 0.5), intrinsics).into()];
        assert!(agree(&mut pair, &world, &requests, &format!("step {step}")) > 1000);
    }
}
