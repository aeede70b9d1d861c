//! A scanner's ranges are those of rays against the solids, and its points say whose they are.

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
    BeamTable, Lidar, LidarConfig, LidarWeather, PointCloud, RenderConfig, RenderError, Renderer, classes,
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

#[test]
fn ranges_are_those_of_rays_in_double_precision() {
    let Some(renderer) = renderer(&RenderConfig::default()) else { return };
    let (world, wearer) = place();
    let mut lidar = scanner(&Arc::new(Mutex::new(renderer)), LidarConfig::default())
        .mounted_at(Pose::translation(0.3, 0.1, 1.9));
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
    // At outlines a beam may belong to the other side by half a pixel.
    assert!(other < met / 20, "{other} of {met}");
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
