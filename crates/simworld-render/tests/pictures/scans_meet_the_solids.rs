//! A scanner's ranges are those of rays against the solids, and its points say whose they are.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

use crate::common::{put, renderer};
use simworld_core::environment::Environment;
use simworld_core::geometry::{Pose, Ray};
use simworld_core::id::EntityId;
use simworld_core::ops;
use simworld_core::scene::{EntityKind, RayCast, Shape, World};
use simworld_core::seam::Observer;
use simworld_core::testing::check_observer;
use simworld_render::{
    BeamTable, Lidar, LidarConfig, LidarMethod, LidarPoint, LidarWeather, PointCloud, RenderConfig,
    RenderError, Renderer, classes,
};

/// Solids all round, and somebody in the middle.
fn place() -> (World, EntityId) {
    let mut world = World::new();
    put(&mut world, EntityKind::Prop, [0.0, 0.0, -1.0], 0.0, Shape::cuboid(300.0, 300.0, 1.0));
    for k in 0..24 {
        let t = f64::from(k);
        let (far, angle) = (7.0 + (t * 5.3) % 40.0, t * 0.55);
        let at = [far * ops::cos(angle), far * ops::sin(angle), (t * 0.3) % 2.0];
        put(&mut world, EntityKind::Prop, at, t, Shape::cuboid(2.0, 1.0 + t * 0.1, 2.5));
    }
    let wearer = put(&mut world, EntityKind::Car, [0.5, -0.3, 0.0], 0.7, Shape::cuboid(4.5, 1.8, 1.5));
    (world, wearer)
}

fn scanner(renderer: &Arc<Mutex<Renderer>>, config: LidarConfig) -> Lidar {
    Lidar::new(Arc::clone(renderer), BeamTable::rows_16(180).expect("sound"), config).expect("in range")
}

fn scanned(
    renderer: &Arc<Mutex<Renderer>>,
    config: LidarConfig,
    world: &World,
    wearer: EntityId,
) -> PointCloud {
    let mut cloud = PointCloud::new();
    scanner(renderer, config).observe(world, wearer, &mut cloud).expect("scanned");
    cloud
}

/// Beams that are cast and beams that read views meet the same, but for outlines.
#[test]
fn both_methods_agree() {
    let Some(renderer) = renderer(&RenderConfig::default()) else { return };
    let renderer = Arc::new(Mutex::new(renderer));
    let (world, wearer) = place();
    let by = |method| scanned(&renderer, LidarConfig { method, ..LidarConfig::default() }, &world, wearer);
    let (views, rays) = (by(LidarMethod::Views), by(LidarMethod::Rays));
    assert_ne!(views, rays, "there is one method alone");
    assert_eq!(rays, by(LidarMethod::Auto));
    let beam = |point: &LidarPoint| (point.azimuth.to_bits(), point.ring);
    let known: BTreeMap<_, _> = views.points.iter().map(|point| (beam(point), point)).collect();
    let (mut same, mut other) = (0, 0);
    for point in &rays.points {
        match known.get(&beam(point)).filter(|known| known.id == point.id) {
            // A face that is seen edgewise is met only as exactly as its depth is told.
            Some(known) if known.intensity > 0.02 => {
                assert!((known.range - point.range).abs() < 2e-4 * point.range, "{known:?} {point:?}");
                assert!((known.intensity - point.intensity).abs() < 2e-3, "{known:?} {point:?}");
                assert_eq!(known.class, point.class);
                same += 1;
            }
            Some(_) => {}
            None => other += 1,
        }
    }
    println!("{same} beams agree, {other} do not");
    assert!(same > 1000 && other < same / 20, "{same} agree, {other} do not");
}

/// Straight up and straight down too: beams that are cast go anywhere.
#[test]
fn steep_beams_meet_floor_and_ceiling() {
    let Some(renderer) = renderer(&RenderConfig::default()) else { return };
    let renderer = Arc::new(Mutex::new(renderer));
    let mut world = World::new();
    let floor = put(&mut world, EntityKind::Prop, [0.0, 0.0, -1.0], 0.0, Shape::cuboid(300.0, 300.0, 1.0));
    let ceiling = put(&mut world, EntityKind::Prop, [0.0, 0.0, 9.0], 0.0, Shape::cuboid(300.0, 300.0, 1.0));
    let wearer = put(&mut world, EntityKind::Prop, [0.0, 0.0, 1.0], 0.0, Shape::cuboid(0.2, 0.2, 0.2));
    let table = || BeamTable::from_csv("0,0,-90\n1,30,-75\n2,77,90\n").expect("sound");
    let by = |method| LidarConfig { method, ..LidarConfig::default() };
    let mut scanner = Lidar::new(Arc::clone(&renderer), table(), by(LidarMethod::Rays))
        .expect("in range")
        .mounted_at(Pose::translation(0.0, 0.0, 1.0));
    let mut cloud = PointCloud::new();
    scanner.observe(&world, wearer, &mut cloud).expect("scanned");
    let met: Vec<(f32, u32)> = cloud.points.iter().map(|point| (point.range, point.id - 1)).collect();
    let slanting = (2.0 / ops::sin(75_f64.to_radians())) as f32;
    for (point, (range, who)) in met.iter().zip([(2.0, floor), (slanting, floor), (7.0, ceiling)]) {
        assert!((point.0 - range).abs() < 1e-4 && point.1 as usize == who.index(), "{met:?}");
    }
    assert_eq!(met.len(), 3);
    assert!(matches!(
        Lidar::new(renderer, table(), by(LidarMethod::Views)),
        Err(RenderError::Beams { reason }) if reason.contains("beam 0")
    ));
}

#[test]
fn ranges_are_those_of_rays_in_double_precision() {
    for method in [LidarMethod::Views, LidarMethod::Rays] {
        ranges_are_right(method);
    }
}

fn ranges_are_right(method: LidarMethod) {
    let Some(renderer) = renderer(&RenderConfig::default()) else { return };
    let (world, wearer) = place();
    let config = LidarConfig { method, ..LidarConfig::default() };
    let mut lidar =
        scanner(&Arc::new(Mutex::new(renderer)), config).mounted_at(Pose::translation(0.3, 0.1, 1.9));
    let mut cloud = PointCloud::new();
    lidar.observe(&world, wearer, &mut cloud).expect("scanned");
    let origin = cloud.world_from_sensor.translation.vector.into();
    let (mut met, mut other) = (0, 0);
    for (point, place) in cloud.points.iter().zip(cloud.in_world()) {
        let beam =
            lidar.beams().iter().find(|beam| beam.ring == point.ring && beam.azimuth as f32 == point.azimuth);
        let direction = cloud.world_from_sensor.rotation * beam.expect("a beam of the table").direction();
        let hit = world.cast_ray(&Ray { origin, direction }, 500.0, &|id| id != wearer);
        let Some(hit) = hit.filter(|hit| hit.entity.index() as u32 + 1 == point.id) else {
            other += 1;
            continue;
        };
        let cosine = hit.normal.dot(&direction).abs();
        // Seen more edgewise than 2°, a face is met only as exactly as its depth is told.
        if cosine > 0.03 {
            let off = (f64::from(point.range) - hit.distance).abs() / hit.distance;
            assert!(off < 1e-4, "{point:?}: {} m", hit.distance);
            assert!((place - (origin + direction * hit.distance)).norm() < 2e-4 * hit.distance);
            assert!((f64::from(point.intensity) - 0.35 * cosine).abs() < 2e-3, "{point:?}: {cosine}");
            met += 1;
        }
    }
    assert!(met > 1000, "only {met}");
    // At outlines a beam that reads views may belong to the other side by half a pixel; one that is cast is on its own.
    let allowed = if method == LidarMethod::Rays { met / 200 } else { met / 20 };
    assert!(other < allowed, "{method:?}: {other} of {met}");
    assert!(cloud.points.iter().all(|point| point.class == classes::class_of(EntityKind::Prop)));
    assert!(
        cloud.points.iter().all(|point| point.id as usize != wearer.index() + 1),
        "it does not see itself"
    );
}

#[test]
fn a_scan_is_an_observation_with_noise_by_tick_and_beam() {
    let Some(renderer) = renderer(&RenderConfig::default()) else { return };
    let renderer = Arc::new(Mutex::new(renderer));
    let (mut world, wearer) = place();
    let noisy = LidarConfig { range_noise: 0.05, seed: 3, ..LidarConfig::default() };
    let make =
        || -> Box<dyn Observer<Observation = PointCloud>> { Box::new(scanner(&renderer, noisy.clone())) };
    check_observer(make, &world, wearer, PointCloud::new);
    let (mut clean, mut first, mut second) = (PointCloud::new(), PointCloud::new(), PointCloud::new());
    scanner(&renderer, LidarConfig::default()).observe(&world, wearer, &mut clean).expect("scanned");
    make().observe(&world, wearer, &mut first).expect("scanned");
    world.begin_step();
    world.finish_step();
    make().observe(&world, wearer, &mut second).expect("scanned");
    assert_ne!(first, second, "every scan has noise of its own");
    let errors: Vec<f64> =
        first.points.iter().zip(&clean.points).map(|(a, b)| f64::from(a.range - b.range)).collect();
    let deviation = (errors.iter().map(|error| error * error).sum::<f64>() / errors.len() as f64).sqrt();
    assert!((deviation - 0.05).abs() < 0.005, "{deviation}");
}

#[test]
fn fog_and_rain_take_the_far_echoes_if_they_are_felt() {
    let Some(renderer) = renderer(&RenderConfig::default()) else { return };
    let renderer = Arc::new(Mutex::new(renderer));
    let (mut world, wearer) = place();
    let mut environment = Environment::default();
    environment.weather.visibility = 60.0;
    world.set_environment(environment).expect("weather in range");
    let felt = LidarConfig { weather: LidarWeather::Felt, ..LidarConfig::default() };
    let farthest = |config: &LidarConfig| {
        let mut cloud = PointCloud::new();
        scanner(&renderer, config.clone()).observe(&world, wearer, &mut cloud).expect("scanned");
        (cloud.points.iter().map(|point| point.range).fold(0.0, f32::max), cloud)
    };
    let (clear, cloud) = farthest(&LidarConfig::default());
    let (foggy, fewer) = farthest(&felt);
    assert!(clear > 60.0 && foggy < 35.0, "{clear} {foggy}");
    // One that is heard: reflectance 0.35 less 3.912 / 60 a metre on both ways.
    assert!(fewer.points.len() < cloud.points.len());
    for point in &fewer.points {
        let range = f64::from(point.range);
        assert!(f64::from(point.intensity) <= 0.35 * ops::exp(-2.0 * 3.912 / 60.0 * range) + 1e-6);
        assert!(f64::from(point.intensity) / (range * range) >= 0.1 / 14_400.0 * 0.999);
    }
}

#[test]
fn drops_and_flakes_are_points_where_that_is_asked_for() {
    let Some(renderer) = renderer(&RenderConfig::default()) else { return };
    let renderer = Arc::new(Mutex::new(renderer));
    let (mut world, wearer) = place();
    let mut environment = Environment::default();
    (environment.weather.rain, environment.weather.temperature) = (25.0, 10.0);
    world.set_environment(environment).expect("weather in range");
    let with = |weather| LidarConfig { weather, seed: 9, ..LidarConfig::default() };
    let felt = scanned(&renderer, with(LidarWeather::Felt), &world, wearer);
    let seen = scanned(&renderer, with(LidarWeather::Seen), &world, wearer);
    assert_eq!(seen, scanned(&renderer, with(LidarWeather::Seen), &world, wearer), "drawn by counters");
    let drops: Vec<&LidarPoint> = seen.points.iter().filter(|point| point.id == 0).collect();
    assert!(drops.len() > 20 && drops.len() < seen.points.len() / 2, "{} drops", drops.len());
    assert!(drops.iter().all(|drop| drop.class == 0 && drop.range < 15.0 && drop.intensity < 0.021));
    assert!(felt.points.iter().all(|point| point.id != 0));
    // What is met is met as without drops, unless a drop is louder.
    let solid: Vec<&LidarPoint> = seen.points.iter().filter(|point| point.id != 0).collect();
    assert!(solid.len() <= felt.points.len() && solid.iter().all(|point| felt.points.contains(point)));
    world.begin_step();
    world.finish_step();
    let next = scanned(&renderer, with(LidarWeather::Seen), &world, wearer);
    assert_ne!(seen, next, "what falls is elsewhere at the next step");
}

#[test]
fn scans_are_written_as_records_and_settings_are_checked() {
    let Some(renderer) = renderer(&RenderConfig::default()) else { return };
    let renderer = Arc::new(Mutex::new(renderer));
    let (world, wearer) = place();
    let mut cloud = PointCloud::new();
    scanner(&renderer, LidarConfig::default()).observe(&world, wearer, &mut cloud).expect("scanned");
    let file = cloud.npy();
    let length = 10 + usize::from(u16::from_le_bytes([file[8], file[9]]));
    assert!(
        std::str::from_utf8(&file[10..length]).expect("text").contains("('ring', '<u2'), ('class', '|u1')]")
    );
    assert_eq!((file.len() - length) % 31, 0);
    assert_eq!((file.len() - length) / 31, cloud.points.len());
    let second = &file[length + 31..];
    assert_eq!(second[..4], cloud.points[1].position[0].to_le_bytes());
    assert_eq!(second[24..28], cloud.points[1].id.to_le_bytes());
    let config = LidarConfig { resolution: 7, ..LidarConfig::default() };
    let outcome = Lidar::new(renderer, BeamTable::rows_16(4).expect("sound"), config);
    assert!(matches!(outcome, Err(RenderError::Config { field: "resolution", .. })));
}
