//! Triangles and rays show the same: ids, depth, and nearly the same colours; both agree with rays reckoned in double precision.

use crate::common::{difference, put, square, square_camera};
use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::{Point2, Point3, Twist, Vector3, pose_facing};
use simworld_core::scene::{EntityKind, Scene, Shape, World};
use simworld_core::seed::Seed;
use simworld_render::{Backend, Frame, RenderConfig, Renderer, ViewOptions, ViewRequest, Views};

fn backends() -> Option<[Renderer; 2]> {
    let with = |backend| crate::common::renderer(&RenderConfig { backend, ..RenderConfig::default() });
    Some([with(Backend::Raster)?, with(Backend::Raycast)?])
}

/// The share of pixels on which ids differ, and of those on which they agree and depth differs by more than a thousandth: at edges
/// within one body.
fn apart(a: &Views, b: &Views) -> (f64, f64) {
    let (mut ids, mut depths) = (0, 0);
    for (index, (x, y)) in a.depth.iter().zip(&b.depth).enumerate() {
        if a.ids[index] != b.ids[index] {
            ids += 1;
        } else if a.ids[index] != 0 && (x - y).abs() > 1e-3 * x {
            depths += 1;
        }
    }
    (f64::from(ids) / a.ids.len() as f64, f64::from(depths) / a.ids.len() as f64)
}

/// Boxes that lie anywhere, as solids without a silhouette of their own.
fn boxes(seed: u64, count: u32) -> World {
    let mut rng = Seed(seed).stream("tests/boxes").rng();
    let mut world = World::new();
    for _ in 0..count {
        let at = [rng.uniform(4.0, 90.0), rng.uniform(-40.0, 40.0), rng.uniform(-3.0, 6.0)];
        let size = Shape::cuboid(rng.uniform(0.3, 6.0), rng.uniform(0.3, 6.0), rng.uniform(0.3, 6.0));
        put(&mut world, EntityKind::Prop, at, rng.uniform(0.0, 6.0), size);
    }
    world
}

fn camera(width: u32, height: u32) -> Camera {
    let intrinsics = Intrinsics { width, height, fx: 80.0, fy: 85.0, cx: 50.0, cy: 30.0 };
    Camera::looking_at(Point3::new(-2.0, 1.0, 3.0), Point3::new(40.0, 0.0, 1.0), intrinsics)
}

#[test]
fn triangles_and_rays_show_the_same() {
    let Some([mut raster, mut raycast]) = backends() else { return };
    let square_views: Vec<ViewRequest> =
        [0.0, -6.0, 3.0].map(|shift| square_camera(shift, 128, 96).into()).to_vec();
    let scenes = [
        (square(0.0), square_views),
        (boxes(1, 300), vec![camera(128, 96).into()]),
        (boxes(2, 300), vec![camera(128, 96).into(), camera(33, 47).into()]),
    ];
    let (mut drawn, mut cast) = (Views::new(), Views::new());
    for (number, (world, requests)) in scenes.iter().enumerate() {
        raster.render_views(world, requests, &ViewOptions::default(), &mut drawn).expect("it is drawn");
        raycast.render_views(world, requests, &ViewOptions::default(), &mut cast).expect("it is cast");
        let (ids, depths) = apart(&drawn, &cast);
        println!("scene {number}: ids differ on {:.3} %, depth on {:.3} %", ids * 100.0, depths * 100.0);
        assert!(ids <= 5e-4 && depths <= 5e-4, "scene {number}: ids differ on {ids}, depth on {depths}");
        let (mean, differing) = difference(&drawn.rgb, &cast.rgb, 24);
        println!("    colours differ by {mean:.2}, on {:.2} % by more than 24", differing * 100.0);
        assert!(mean < 1.5 && differing < 0.02, "scene {number}: colours differ by {mean}, {differing}");
    }
}

/// Where a ray enters an upright box, by slabs in double precision.
fn enter(origin: &Point3, ray: &Vector3, world: &World) -> Option<(f64, u32)> {
    let mut best: Option<(f64, u32)> = None;
    for entity in world.iter() {
        let size = entity.info.shape.size();
        let from = entity.pose.inverse_transform_point(origin);
        let along = entity.pose.rotation.inverse() * ray;
        let low = Vector3::new(-size.x * 0.5, -size.y * 0.5, 0.0);
        let high = Vector3::new(size.x * 0.5, size.y * 0.5, size.z);
        let (mut first, mut last) = (f64::NEG_INFINITY, f64::INFINITY);
        for axis in 0..3 {
            let (a, b) = ((low[axis] - from[axis]) / along[axis], (high[axis] - from[axis]) / along[axis]);
            (first, last) = (first.max(a.min(b)), last.min(a.max(b)));
        }
        if first <= last && first > 0.05 && best.is_none_or(|(t, _)| first < t) {
            best = Some((first, entity.id.index() as u32 + 1));
        }
    }
    best
}

#[test]
fn both_agree_with_double_precision() {
    let Some(renderers) = backends() else { return };
    for (name, mut renderer) in ["raster", "raycast"].into_iter().zip(renderers) {
        for seed in 3..6 {
            let (world, camera) = (boxes(seed, 120), camera(96, 64));
            let mut frame = Frame::new();
            renderer.render(&world, &camera, &mut frame).expect("it is drawn");
            let eye: Point3 = camera.world_from_optical.translation.vector.into();
            let (mut other, mut checked) = (0, 0);
            let meet = |x: f64, y: f64| {
                let ray =
                    camera.world_from_optical * camera.intrinsics.unproject(&Point2::new(x, y), 1.0) - eye;
                enter(&eye, &ray, &world)
            };
            for (y, x) in (0..64).flat_map(|y| (0..96).map(move |x| (y, x))) {
                let (u, v) = (f64::from(x) + 0.5, f64::from(y) + 0.5);
                let truth = meet(u, v);
                let id = frame.ids[(y * 96 + x) as usize];
                if truth.map_or(0, |(_, id)| id) != id {
                    other += 1;
                } else if let Some((depth, _)) = truth {
                    // Rasterisers place corners on a grid of 1/256 of a pixel, which one sees where surfaces are seen edge on.
                    let shifts = if name == "raster" { 1.0 / 256.0 } else { 0.0 };
                    let near = [(u - shifts, v), (u + shifts, v), (u, v - shifts), (u, v + shifts)];
                    let slack = near.map(|(u, v)| meet(u, v).map_or(0.0, |(other, _)| (other - depth).abs()));
                    let off = (f64::from(frame.depth_at(x, y).expect("it is seen")) - depth).abs();
                    let allowed = 1e-4 * depth + slack.into_iter().fold(0.0, f64::max);
                    assert!(off < allowed, "{name}, seed {seed}, ({x}, {y}): off by {off} of {depth}");
                    checked += 1;
                }
            }
            // Small things are left out, and edges fall to one side or the other.
            assert!(other <= 6 && checked > 2000, "{name}, seed {seed}: {other} ids differ of {checked}");
        }
    }
}

/// Houses hide most of what stands behind them, and triangles that are left out for that are missed nowhere.
#[test]
fn behind_houses_nothing_is_missed() {
    let Some([mut raster, mut raycast]) = backends() else { return };
    let mut rng = Seed(5).stream("tests/houses").rng();
    let mut world = World::new();
    put(&mut world, EntityKind::Ground, [60.0, 0.0, -0.1], 0.0, Shape::cuboid(400.0, 400.0, 0.1));
    for _ in 0..40 {
        let at = [rng.uniform(8.0, 110.0), rng.uniform(-60.0, 60.0), 0.0];
        let shape = Shape::cuboid(rng.uniform(6.0, 12.0), rng.uniform(6.0, 15.0), rng.uniform(4.0, 16.0));
        put(&mut world, EntityKind::Building, at, rng.uniform(0.0, 6.0), shape);
    }
    for _ in 0..250 {
        let at = [rng.uniform(4.0, 160.0), rng.uniform(-70.0, 70.0), 0.0];
        let size = Shape::cuboid(rng.uniform(0.5, 3.0), rng.uniform(0.5, 3.0), rng.uniform(0.5, 6.0));
        put(&mut world, EntityKind::Prop, at, rng.uniform(0.0, 6.0), size);
    }
    let requests = [1.7, 6.0, 25.0].map(|height| {
        let eye = Point3::new(0.0, 0.0, height);
        let intrinsics = Intrinsics::from_fov(160, 112, 1.3).expect("a size in range");
        ViewRequest::from(Camera::looking_at(eye, Point3::new(60.0, 4.0, 2.0), intrinsics))
    });
    let (mut drawn, mut cast) = (Views::new(), Views::new());
    raster.render_views(&world, &requests, &ViewOptions::default(), &mut drawn).expect("it is drawn");
    raycast.render_views(&world, &requests, &ViewOptions::default(), &mut cast).expect("it is cast");
    let (ids, depths) = apart(&drawn, &cast);
    println!("ids differ on {:.3} %, depth on {:.3} %", ids * 100.0, depths * 100.0);
    assert!(ids <= 5e-4 && depths <= 1e-3, "ids differ on {ids}, depth on {depths}");
}

/// What moves is refitted, what stood still and is moved leaves its tree, newcomers come: always as if seen for the first time.
#[test]
fn trees_follow_what_happens() {
    let Some([mut raster, mut raycast]) = backends() else { return };
    let mut world = boxes(7, 150);
    let car = put(&mut world, EntityKind::Car, [12.0, -3.0, 0.0], 0.0, Shape::cuboid(4.4, 1.8, 1.5));
    let wall = put(&mut world, EntityKind::Building, [30.0, 8.0, 0.0], 0.3, Shape::cuboid(9.0, 7.0, 12.0));
    let requests = [ViewRequest::from(camera(96, 64))];
    let (mut drawn, mut cast) = (Views::new(), Views::new());
    for step in 0..8 {
        let along = f64::from(step);
        world
            .set_motion(
                car,
                pose_facing(Point3::new(12.0 + along, -3.0 + along, 0.0), 0.2 * along),
                Twist::ZERO,
            )
            .expect("it lives");
        match step {
            2 => world
                .set_motion(wall, pose_facing(Point3::new(30.0, -8.0, 0.0), 1.0), Twist::ZERO)
                .expect("it lives"),
            4 => drop(put(&mut world, EntityKind::Prop, [14.0, 3.0, 0.0], 0.5, Shape::cuboid(2.0, 2.0, 2.0))),
            6 => drop(world.remove(wall).expect("it lives")),
            _ => {}
        }
        world.finish_step();
        raster.render_views(&world, &requests, &ViewOptions::default(), &mut drawn).expect("it is drawn");
        raycast.render_views(&world, &requests, &ViewOptions::default(), &mut cast).expect("it is cast");
        let (ids, depths) = apart(&drawn, &cast);
        assert!(ids <= 1e-3 && depths <= 2e-3, "step {step}: ids differ on {ids}, depth on {depths}");
    }
}

/// What falls is the same before triangles and before rays: the same drops, as long, as wide and as bright, hidden by the same things. Before a wall,
/// on which both agree without them, and with a post that hides some.
#[test]
fn rain_and_snow_fall_before_both() {
    let Some([mut raster, mut raycast]) = backends() else { return };
    let mut world = World::new();
    put(&mut world, EntityKind::Prop, [20.0, 0.0, -30.0], 0.0, Shape::cuboid(1.0, 90.0, 60.0));
    put(&mut world, EntityKind::Prop, [2.0, 0.3, -3.0], 0.0, Shape::cuboid(0.4, 0.4, 9.0));
    // Wind moves flakes in time.
    for _ in 0..10 {
        world.finish_step();
    }
    let intrinsics = Intrinsics::from_fov(150, 90, 1.0).expect("a size in range");
    let eye = Point3::new(0.0, 0.0, 2.0);
    let requests = [ViewRequest::from(Camera::looking_at(eye, eye + Vector3::x(), intrinsics))];
    let mut look = |rain: f64, snow: f64, wind: f64| {
        let mut environment = *world.environment();
        (environment.weather.rain, environment.weather.snow) = (rain, snow);
        environment.weather.temperature = if snow > 0.0 { -3.0 } else { 12.0 };
        environment.weather.wind = [0.0, wind].into();
        world.set_environment(environment).expect("a weather in range");
        [&mut raster, &mut raycast].map(|renderer| {
            let mut views = Views::new();
            renderer
                .render_views(&world, &requests, &ViewOptions::default(), &mut views)
                .expect("it is drawn");
            views
        })
    };
    for (name, rain, snow) in [("rain", 12.0, 0.0), ("snow", 0.0, 2.5)] {
        let [drawn, cast] = look(rain, snow, 0.0);
        let (mean, differing) = difference(&drawn.rgb, &cast.rgb, 8);
        // With wind they are other pixels, by rays alone.
        let (_, slanting) = difference(&look(rain, snow, 9.0)[1].rgb, &cast.rgb, 8);
        let (differs, slants) = (differing * 100.0, slanting * 100.0);
        println!(
            "{name}: colours differ by {mean:.2}, on {differs:.2} % by more than 8; slanting on {slants:.2} %"
        );
        assert!(differing < 0.01 && slanting > 10.0 * differing, "{name}: {differing} and {slanting}");
        assert!(slanting > 0.003, "{name}: hardly anything falls");
        if let Some(folder) = std::env::var_os("SIMWORLD_LOOK") {
            for (side, views) in [("drawn", &drawn), ("cast", &cast)] {
                let mut frame = Frame::new();
                views.copy_frame(0, &mut frame);
                let file = std::path::Path::new(&folder).join(format!("{name}-{side}.png"));
                std::fs::write(file, frame.rgb_png().expect("a picture")).expect("the folder is there");
            }
        }
    }
}

#[test]
fn rays_give_the_same_bits_every_time() {
    let (Some([_, mut first]), Some([_, mut second])) = (backends(), backends()) else { return };
    let (world, request) = (square(0.0), ViewRequest::from(square_camera(0.0, 96, 64)));
    let (mut a, mut b) = (Views::new(), Views::new());
    first.render_views(&world, &[request], &ViewOptions::default(), &mut a).expect("it is cast");
    second.render_views(&boxes(9, 20), &[request], &ViewOptions::default(), &mut b).expect("it is cast");
    second.render_views(&world, &[request, request], &ViewOptions::default(), &mut b).expect("it is cast");
    for view in 0..2 {
        assert!(a.ids == b.ids[b.pixels(view)] && a.depth == b.depth[b.pixels(view)], "view {view}");
        let bytes = b.pixels(view);
        assert!(a.rgb == b.rgb[3 * bytes.start..3 * bytes.end], "view {view}");
    }
}
