//! Bodies that move are dressed at the levels of detail that a batch may show, and in full only when they come: pictures are bit for bit those of a renderer
//! that sees their world for the first time, and so dresses everybody in full.

use crate::common::{put, renderer};
use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::environment::{Environment, Sun};
use simworld_core::geometry::{Point3, Twist, Vector3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityKind, Scene as _, Shape, World};
use simworld_core::seed::{Seed, StreamRng};
use simworld_render::{
    Backend, Channels, Culling, Projection, RenderConfig, Renderer, ViewOptions, ViewRequest, Views,
};

/// By rays, and by triangles that the host or the device culls: a renderer that follows, and one that is shown copies.
fn pairs() -> Vec<(&'static str, [Renderer; 2])> {
    let ways = [
        ("rays", Backend::Raycast, Culling::Auto),
        ("host", Backend::Raster, Culling::Host),
        ("device", Backend::Raster, Culling::Device),
    ];
    let made = ways.into_iter().filter_map(|(name, backend, culling)| {
        let config = RenderConfig { backend, culling, ..RenderConfig::default() };
        Some((name, [renderer(&config)?, renderer(&config)?]))
    });
    made.collect()
}

/// A street of 600 m with people, vehicles and dogs on it, all of whom move, and houses beside it.
fn street(rng: &mut StreamRng) -> (World, Vec<EntityId>) {
    let mut world = World::new();
    put(&mut world, EntityKind::Ground, [0.0, 0.0, -1.1], 0.0, Shape::cuboid(900.0, 400.0, 1.0));
    put(&mut world, EntityKind::Road, [0.0, 0.0, -0.1], 0.0, Shape::cuboid(600.0, 8.0, 0.1));
    let mut movers = Vec::new();
    for number in 0..90 {
        let (kind, shape) = match number % 9 {
            0 => (EntityKind::Building, Shape::cuboid(12.0, 10.0, 9.0)),
            1 => (EntityKind::Car, Shape::cuboid(4.4, 1.8, 1.5)),
            2 => (EntityKind::Bus, Shape::cuboid(17.0, 2.5, 3.1)),
            3 => (EntityKind::Bicycle, Shape::cuboid(1.75, 0.6, 1.6)),
            4 => (EntityKind::Dog, Shape::cuboid(0.8, 0.3, 0.6)),
            5 => (EntityKind::Truck, Shape::cuboid(8.0, 2.5, 3.2)),
            _ => (EntityKind::Person, Shape::Capsule { radius: 0.25, height: 1.75 }),
        };
        let beside = if kind == EntityKind::Building { 16.0 } else { rng.uniform(-7.0, 7.0) };
        let at = [rng.uniform(-300.0, 300.0), beside, 0.0];
        let id = put(&mut world, kind, at, rng.uniform(-0.3, 0.3), shape);
        if kind.is_mobile() {
            movers.push(id);
        }
    }
    world.finish_step();
    (world, movers)
}

fn go_on(world: &mut World, movers: &[EntityId]) {
    for (number, id) in movers.iter().enumerate() {
        let along = if number % 2 == 0 { 0.4 } else { -0.3 };
        let pose = world.entity(*id).expect("it lives").pose * nalgebra::Translation3::new(along, 0.0, 0.0);
        let twist = Twist { linear: pose.rotation * Vector3::x() * 1.2, angular: Vector3::zeros() };
        world.set_motion(*id, pose, twist).expect("it lives");
    }
    world.finish_step();
}

/// So many eyes about a place along the street.
fn looks(rng: &mut StreamRng, along: f64, count: usize) -> Vec<ViewRequest> {
    let one = |_| {
        let eye = Point3::new(along + rng.uniform(-9.0, 9.0), rng.uniform(-6.0, 6.0), rng.uniform(1.0, 4.0));
        let to = eye + Vector3::new(rng.uniform(-20.0, 20.0), rng.uniform(-4.0, 4.0), -0.5);
        let intrinsics = Intrinsics::from_fov(64, 48, rng.uniform(0.5, 1.4)).expect("a size in range");
        ViewRequest::from(Camera::looking_at(eye, to, intrinsics))
    };
    (0..count).map(one).collect()
}

/// From above, on a scale.
fn map_of(along: f64) -> ViewRequest {
    let mut intrinsics = Intrinsics::from_fov(64, 48, 1.0).expect("a size in range");
    (intrinsics.fx, intrinsics.fy) = (3.0, 3.0);
    let (eye, to) = (Point3::new(along, 0.0, 60.0), Point3::new(along + 0.5, 0.0, 0.0));
    let request = ViewRequest::from(Camera::looking_at(eye, to, intrinsics));
    ViewRequest { projection: Projection::Parallel, ..request }
}

fn options() -> ViewOptions {
    ViewOptions { channels: Channels::all(), ..ViewOptions::default() }
}

/// What somebody sees who is shown a copy, and so everything anew.
fn seen_first(fresh: &mut Renderer, world: &World, requests: &[ViewRequest]) -> Views {
    let mut views = Views::new();
    fresh.render_views(&world.clone(), requests, &options(), &mut views).expect("it is drawn");
    views
}

fn compare(followed: &Views, expected: &Views, what: &str) {
    let bits = |depth: &[f32]| depth.iter().map(|depth| depth.to_bits()).collect::<Vec<_>>();
    assert!(followed.ids == expected.ids, "{what}: who is where differs");
    assert!(bits(&followed.depth) == bits(&expected.depth), "{what}: depth differs");
    assert!(followed.rgb == expected.rgb, "{what}: colour differs");
    assert!(followed.normals == expected.normals, "{what}: what is normal to it differs");
}

/// How many of these are on the pictures of a batch.
fn seen_of(movers: &[EntityId], views: &Views) -> usize {
    let mut ids = views.ids.clone();
    ids.sort_unstable();
    ids.dedup();
    ids.iter().filter_map(|id| views.entity(*id)).filter(|id| movers.contains(id)).count()
}

/// Eyes jump from one end of the street to the other and back between steps and within one, few and many of them; maps and depth without colour in between.
#[test]
fn eyes_go_where_they_like() {
    for (name, [mut following, mut fresh]) in pairs() {
        let mut rng = Seed(51).stream("tests/who_is_dressed").rng();
        let (mut world, movers) = street(&mut rng);
        let (mut views, mut seen) = (Views::new(), 0);
        for step in 0..4 {
            // The first sees them where they came.
            if step > 0 {
                go_on(&mut world, &movers);
            }
            let batches = [
                looks(&mut rng, -200.0, 2),
                looks(&mut rng, 200.0, 1),
                looks(&mut rng, f64::from(step) * 60.0, 7),
                vec![map_of(-200.0)],
                looks(&mut rng, -200.0, 1),
            ];
            for (number, requests) in batches.iter().enumerate() {
                let what = format!("{name}, step {step}, batch {number}");
                if number == 1 && step % 2 == 1 {
                    let lean = ViewOptions { channels: Channels::DEPTH | Channels::IDS, ..options() };
                    following.render_views(&world, requests, &lean, &mut views).expect("it is drawn");
                    let expected = seen_first(&mut fresh, &world, requests);
                    assert!(
                        views.ids == expected.ids && views.depth == expected.depth,
                        "{what}, without colour"
                    );
                    continue;
                }
                following.render_views(&world, requests, &options(), &mut views).expect("it is drawn");
                compare(&views, &seen_first(&mut fresh, &world, requests), &what);
                seen += seen_of(&movers, &views);
            }
        }
        assert!(seen > 60, "{name}: {seen} bodies on pictures");
    }
}

/// Two batches at two ends of the street in every step, handed in one after the other, in either order, and taken in the other.
#[test]
fn batches_of_one_step_are_taken_in_any_order() {
    for (name, [mut following, mut fresh]) in pairs() {
        let mut rng = Seed(52).stream("tests/who_is_dressed").rng();
        let (mut world, movers) = street(&mut rng);
        let mut views = Views::new();
        for step in 0..4 {
            go_on(&mut world, &movers);
            let mut batches = [looks(&mut rng, -220.0, 2), looks(&mut rng, 220.0, 6)];
            if step % 2 == 1 {
                batches.reverse();
            }
            let mut handed_in = Vec::new();
            for requests in &batches {
                let ticket = following.submit(&world, requests, &options()).expect("it is handed in");
                handed_in.push((ticket, seen_first(&mut fresh, &world, requests)));
            }
            while let Some((ticket, expected)) = handed_in.pop() {
                following.take(ticket, &mut views).expect("it comes");
                compare(&views, &expected, &format!("{name}, step {step}, {} left", handed_in.len()));
            }
        }
    }
}

/// A bus behind the eye throws its shadow before it, by the level of detail of a map or of the eye, and nobody sees it but by turning round.
#[test]
fn who_is_behind_throws_shadows() {
    for (name, [mut following, mut fresh]) in pairs() {
        let mut world = World::new();
        let sun = Sun { azimuth: 1.5 * std::f64::consts::PI, elevation: 0.2, ..Sun::default() };
        world.set_environment(Environment { sun, ..Environment::default() }).expect("a sun in range");
        put(&mut world, EntityKind::Ground, [0.0, 0.0, -0.1], 0.0, Shape::cuboid(400.0, 400.0, 0.1));
        let bus = put(&mut world, EntityKind::Bus, [-9.0, 0.0, 0.0], 0.3, Shape::cuboid(12.0, 2.5, 3.1));
        let intrinsics = Intrinsics::from_fov(64, 48, 1.2).expect("a size in range");
        let mut ahead = Vec::new();
        let mut views = Views::new();
        for step in 0..6 {
            let pose = pose_facing(Point3::new(-6.0, 6.0 * f64::from(step) - 15.0, 0.0), f64::from(step));
            world.set_motion(bus, pose, Twist::ZERO).expect("it lives");
            world.finish_step();
            for turned in [1.0, -1.0] {
                let (eye, to) = (Point3::new(0.0, 0.0, 2.0), Point3::new(4.0 * turned, 0.0, 0.0));
                let requests = [ViewRequest::from(Camera::looking_at(eye, to, intrinsics))];
                following.render_views(&world, &requests, &options(), &mut views).expect("it is drawn");
                compare(
                    &views,
                    &seen_first(&mut fresh, &world, &requests),
                    &format!("{name}, step {step}, to {turned}"),
                );
                if turned > 0.0 {
                    assert!(!views.ids.contains(&(bus.index() as u32 + 1)), "it is behind the eye");
                    ahead.push(views.rgb.clone());
                }
            }
        }
        ahead.sort_unstable();
        ahead.dedup();
        assert!(ahead.len() > 2, "{name}: {} pictures of its shadow differ", ahead.len());
    }
}
