//! A place as it is from above: its map, and what a scanner on the nearest car makes of it.

use std::sync::{Arc, Mutex};

use simworld_core::camera::Camera;
use simworld_core::geometry::Point2;
use simworld_core::id::EntityId;
use simworld_core::scene::World;
use simworld_core::seam::Observer;
use simworld_render::classes::class_by_id;
use simworld_render::{BeamTable, Lidar, LidarConfig, MapView, PointCloud, RenderConfig, Renderer};

use crate::Outcome;

/// The width of the map, m.
const ACROSS: f64 = 90.0;
/// How far above the eyes the map looks down from, m: over every roof of the city.
const ABOVE: f64 = 150.0;
/// Columns of the scan.
const COLUMNS: u32 = 900;
/// The side of a point on the picture, pixels.
const DOT: i64 = 2;

/// The map around the nearest car to where a camera stands, and that car; `None` without cars.
pub fn map_around(world: &World, camera: &Camera) -> Option<(MapView, EntityId)> {
    let eye = camera.world_from_optical.translation.vector;
    let at = Point2::new(eye.x, eye.y);
    let cars = world.iter().filter(|entity| entity.kind.is_vehicle());
    let away = |at: Point2, other: Point2| (at - other).norm_squared();
    let car = cars.min_by(|a, b| away(a.position().xy(), at).total_cmp(&away(b.position().xy(), at)))?;
    let (width, height) = (camera.intrinsics.width, camera.intrinsics.height);
    let metres_per_pixel = ACROSS / f64::from(width);
    let map = MapView { center: car.position().xy(), top: eye.z + ABOVE, metres_per_pixel, width, height };
    Some((map, car.id))
}

/// The echoes of a scanner of 64 rows on the car, drawn on the map in the colours of their classes: 8-bit RGB.
///
/// # Errors
/// No adapter, or a scene that cannot be scanned.
pub fn scan(world: &World, map: &MapView, car: EntityId) -> Outcome<Vec<u8>> {
    let renderer = Arc::new(Mutex::new(Renderer::new(&RenderConfig::default())?));
    let mut scanner = Lidar::new(renderer, BeamTable::rows_64(COLUMNS)?, LidarConfig::default())?;
    let mut cloud = PointCloud::new();
    scanner.observe(world, car, &mut cloud)?;
    let (width, height) = (i64::from(map.width), i64::from(map.height));
    let mut picture = vec![0; 3 * map.width as usize * map.height as usize];
    for (point, echo) in cloud.in_world().zip(&cloud.points) {
        let place = map.pixel(&point.xy());
        let (left, top) = (place.x.floor() as i64, place.y.floor() as i64);
        let color = class_by_id(echo.class).map_or([255; 3], |class| class.color);
        for dot in 0..DOT * DOT {
            let (x, y) = (left + dot % DOT, top + dot / DOT);
            if (0..width).contains(&x) && (0..height).contains(&y) {
                let at = 3 * (y * width + x) as usize;
                picture[at..at + 3].copy_from_slice(&color);
            }
        }
    }
    Ok(picture)
}
