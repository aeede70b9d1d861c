//! The projection of a solid: the rectangle around it, before anything hides it.

use simworld_core::camera::Camera;
use simworld_core::geometry::{Obb, Point3, Vector3};
use simworld_core::ops;
use simworld_core::scene::{EntityRef, Shape};

/// Points round a rim, and along a meridian of a half ball.
const ROUND: u32 = 48;
const RISE: u32 = 8;

/// A rectangle on the picture's plane, pixels: left, top, right, bottom.
pub(super) type Extent = [f64; 4];

/// The rectangle around the projection of an entity's solid, not clipped to the picture; what reaches behind `near` m of the
/// camera is cut off there. `None` if all of it lies behind.
pub(super) fn extent_of(entity: &EntityRef<'_>, camera: &Camera, near: f64) -> Option<Extent> {
    let optical = |point: &Point3| camera.world_from_optical.inverse_transform_point(&(entity.pose * point));
    let round: Vec<Point3> = surface(&entity.info.shape).iter().map(optical).collect();
    if !round.is_empty() && round.iter().all(|point| point.z >= near) {
        return around(&round, camera);
    }
    extent_of_box(&entity.obb(), camera, near)
}

/// The same of an oriented box in the world.
pub(super) fn extent_of_box(obb: &Obb, camera: &Camera, near: f64) -> Option<Extent> {
    let optical_from_box = camera.world_from_optical.inverse() * obb.pose;
    let corner = |index: usize| {
        let side = |bit: usize, half: f64| if index >> bit & 1 == 0 { -half } else { half };
        let h = &obb.half_extents;
        optical_from_box * Point3::new(side(0, h.x), side(1, h.y), side(2, h.z))
    };
    let corners: [Point3; 8] = std::array::from_fn(corner);
    let mut shown: Vec<Point3> = corners.iter().filter(|corner| corner.z >= near).copied().collect();
    // Where an edge goes through the plane of the near end, it ends there.
    for (index, from) in corners.iter().enumerate() {
        for to in (0..3).map(|bit| corners[index ^ 1 << bit]) {
            if from.z < near && to.z > near {
                shown.push(from + (to - from) * ((near - from.z) / (to.z - from.z)));
            }
        }
    }
    around(&shown, camera)
}

fn around(points: &[Point3], camera: &Camera) -> Option<Extent> {
    points.iter().filter_map(|point| camera.intrinsics.project(point)).map(|(pixel, _)| pixel).fold(
        None,
        |extent: Option<Extent>, pixel| {
            let [left, top, right, bottom] = extent.unwrap_or([pixel.x, pixel.y, pixel.x, pixel.y]);
            Some([left.min(pixel.x), top.min(pixel.y), right.max(pixel.x), bottom.max(pixel.y)])
        },
    )
}

/// Points all over a round solid in its body frame; none for a box, whose corners say all.
fn surface(shape: &Shape) -> Vec<Point3> {
    let ring = |radius: f64, height: f64| {
        (0..ROUND).map(move |k| {
            let (sin, cos) = ops::sin_cos(std::f64::consts::TAU * f64::from(k) / f64::from(ROUND));
            Point3::new(radius * cos, radius * sin, height)
        })
    };
    let half_ball = |radius: f64, center: f64, up: f64| {
        (0..=RISE).flat_map(move |k| {
            let angle = std::f64::consts::FRAC_PI_2 * f64::from(k) / f64::from(RISE);
            let (sin, cos) = ops::sin_cos(angle);
            ring(radius * cos, center + up * radius * sin)
        })
    };
    match *shape {
        Shape::Cylinder { radius, height } => ring(radius, 0.0).chain(ring(radius, height)).collect(),
        Shape::Capsule { radius, height } => {
            half_ball(radius, radius, -1.0).chain(half_ball(radius, height - radius, 1.0)).collect()
        }
        Shape::Sphere { radius } => {
            half_ball(radius, radius, -1.0).chain(half_ball(radius, radius, 1.0)).collect()
        }
        _ => Vec::new(),
    }
}

/// The box grown by a margin on all sides, m.
pub(super) fn grown(obb: &Obb, margin: f64) -> Obb {
    Obb { pose: obb.pose, half_extents: obb.half_extents + Vector3::repeat(margin) }
}
