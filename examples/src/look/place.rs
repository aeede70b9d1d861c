//! Where to stand in a city that one wants to show: on the liveliest street, and before the densest crowd.

use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::{Point2, Point3, direction};
use simworld_core::net::{RoadNetwork, polyline};
use simworld_core::scene::{EntityKind, World};

/// How far what is counted may stand from where the camera looks, m.
const NEAR: f64 = 35.0;
/// The height of eyes, m.
const EYES: f64 = 1.7;

/// What stands near a point: people count three times, vehicles twice, buildings and trees once.
fn life(world: &World, at: Point2) -> f64 {
    world
        .iter()
        .filter(|entity| (entity.position().xy() - at).norm() < NEAR)
        .map(|entity| match entity.kind {
            EntityKind::Person => 3.0,
            kind if kind.is_vehicle() => 2.0,
            EntityKind::Building | EntityKind::Tree => 1.0,
            _ => 0.0,
        })
        .sum()
}

/// A view along the liveliest street, from its right kerb at a little over the height of eyes; `None` without roads.
pub fn street(world: &World, roads: &RoadNetwork, intrinsics: Intrinsics) -> Option<Camera> {
    let mut best: Option<(f64, Camera)> = None;
    for road in &roads.roads {
        let length = polyline::length(&road.centerline);
        if length < 70.0 {
            continue;
        }
        let (start, heading) = polyline::at(&road.centerline, 18.0);
        let (ahead, _) = polyline::at(&road.centerline, 18.0 + NEAR * 0.8);
        let right = direction(heading - std::f64::consts::FRAC_PI_2);
        let eye = start + right * (road.right_kerb - 1.2);
        let lively = life(world, ahead);
        if best.as_ref().is_none_or(|(most, _)| lively > *most) {
            let target = Point3::new(ahead.x, ahead.y, 2.2);
            best = Some((lively, Camera::looking_at(Point3::new(eye.x, eye.y, 2.1), target, intrinsics)));
        }
    }
    best.map(|(_, camera)| camera)
}

/// A view of the most people that stand together, from the height of eyes and from the side from which fewest things stand
/// in between; `None` without people.
pub fn crowd(world: &World, intrinsics: Intrinsics) -> Option<Camera> {
    let people: Vec<Point2> = world
        .iter()
        .filter(|entity| entity.kind == EntityKind::Person)
        .map(|entity| entity.position().xy())
        .collect();
    let company = |at: &Point2| people.iter().filter(|other| (*other - at).norm() < 7.0).count();
    // Of equals the first, so that the picture stays what it was.
    let middle = people.iter().enumerate().max_by_key(|(index, at)| (company(at), usize::MAX - index))?.1;
    let blocked = |eye: &Point2| {
        let way = middle - eye;
        world
            .iter()
            .filter(|entity| !matches!(entity.kind, EntityKind::Person) && entity.bounds.max.z > 0.4)
            .filter(|entity| {
                let share = ((entity.position().xy() - eye).dot(&way) / way.norm_squared()).clamp(0.0, 1.0);
                let nearest = eye + way * share;
                let size = entity.bounds.half_extents().xy().norm().min(20.0);
                (entity.position().xy() - nearest).norm() < size + 0.6
            })
            .count()
    };
    let eyes =
        (0..16_u8).map(|side| middle + direction(f64::from(side) * std::f64::consts::TAU / 16.0) * 8.0);
    let eye = eyes.enumerate().min_by_key(|(index, eye)| (blocked(eye), *index))?.1;
    let target = Point3::new(middle.x, middle.y, 1.15);
    Some(Camera::looking_at(Point3::new(eye.x, eye.y, EYES), target, intrinsics))
}
