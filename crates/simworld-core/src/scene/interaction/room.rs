//! Room beside a thing: where somebody who leaves it comes to stand, and where what was carried is put down.

use std::f64::consts::TAU;
use std::ops::ControlFlow;

use crate::geometry::{Aabb, Obb, Point2, Point3, Pose, Ray, direction, heading};
use crate::id::EntityId;
use crate::scene::ray::meet_box;
use crate::scene::{EntityKind, EntityRef, Scene};

/// Gap that is kept to whatever is solid, m: more than the 0.02 m that walkers under physics keep.
const GAP: f64 = 0.05;
/// So much farther than beside the thing nobody steps, m.
const FARTHEST: f64 = 2.0;
/// Distance of the rings round the thing on which room is looked for, m.
const RING: f64 = 0.25;
/// Directions in which it is looked for.
const DIRECTIONS: i32 = 16;
/// What ends lower than this above the ground is stepped over, m.
const SILL: f64 = 0.05;
/// Height at which walls are looked for between the thing and a place, m.
const WAIST: f64 = 1.0;

/// The place nearest to the wished one, round a carrier, where `who` finds room and no wall lies between; the wished one
/// itself if there is none.
pub(super) fn beside(scene: &dyn Scene, who: EntityId, carrier: &EntityRef<'_>, wished: Point3) -> Point3 {
    let Some(body) = scene.entity(who) else { return wished };
    let size = body.info.shape.size();
    let radius = size.x.max(size.y) * 0.5;
    let place = Place::around(scene, who, carrier, wished, (radius, size.z));
    if place.is_free(wished.xy()) {
        return wished;
    }
    let local = carrier.pose.inverse_transform_point(&wished);
    let towards = heading(&local.coords.xy());
    let half = carrier.info.shape.size() * 0.5;
    let rings = (0..=(FARTHEST / RING) as i32).map(|ring| f64::from(ring) * RING);
    let spots = rings.flat_map(|beyond| {
        let margin = radius + 2.0 * GAP + beyond;
        (0..DIRECTIONS).map(move |index| {
            // 0, 1, -1, 2, -2 and so on: first where it was wished.
            let turn = if index % 2 == 0 { -(index / 2) } else { index / 2 + 1 };
            let out = direction(towards + f64::from(turn) * TAU / f64::from(DIRECTIONS));
            let reach = |half: f64, along: f64| (half + margin) / along.abs().max(1e-9);
            let spot = out * reach(half.x, out.x).min(reach(half.y, out.y));
            Point3::new(spot.x, spot.y, 0.0)
        })
    });
    let free = spots.map(|spot| (carrier.pose * spot).xy()).find(|spot| place.is_free(*spot));
    free.map_or(wished, |spot| Point3::new(spot.x, spot.y, wished.z))
}

/// The surroundings of a carrier.
struct Place {
    /// From where one comes.
    origin: Point3,
    radius: f64,
    solids: Vec<Solid>,
}

struct Solid {
    obb: Obb,
    is_wall: bool,
}

impl Place {
    fn around(
        scene: &dyn Scene,
        who: EntityId,
        carrier: &EntityRef<'_>,
        wished: Point3,
        (radius, height): (f64, f64),
    ) -> Self {
        let middle = carrier.planar();
        let extent = carrier.info.shape.size().xy().norm() * 0.5;
        let reach = (extent + radius + FARTHEST + 1.0).max((wished.xy() - middle).norm() + radius);
        let mut solids = Vec::new();
        let _ = scene.visit(&Aabb::column_around(middle, reach), &mut |other| {
            let stands = other.bounds.max.z > wished.z + SILL && other.bounds.min.z < wished.z + height;
            if other.id != who && other.attachment.is_none() && other.is_solid() && stands {
                let is_wall = matches!(other.kind, EntityKind::Building | EntityKind::Door);
                solids.push(Solid { obb: other.obb(), is_wall });
            }
            ControlFlow::Continue(())
        });
        Self { origin: Point3::new(middle.x, middle.y, wished.z + WAIST), radius, solids }
    }

    /// Whether a disc fits here, and no wall lies between here and the carrier.
    fn is_free(&self, spot: Point2) -> bool {
        let fits = self.solids.iter().all(|solid| distance(&solid.obb, spot) >= self.radius + GAP);
        let target = Point3::new(spot.x, spot.y, self.origin.z);
        let way = (target - self.origin).norm();
        fits && Ray::towards(self.origin, target).is_none_or(|ray| {
            let walls = self.solids.iter().filter(|solid| solid.is_wall);
            walls.filter_map(|wall| meet_box(&ray, &wall.obb)).all(|(distance, _)| distance > way)
        })
    }
}

/// Distance in the plane between the footprint of an upright box and a point, m.
fn distance(obb: &Obb, spot: Point2) -> f64 {
    let pose: &Pose = &obb.pose;
    let local = pose.inverse_transform_point(&Point3::new(spot.x, spot.y, pose.translation.z));
    let beyond = |axis: usize| (local[axis].abs() - obb.half_extents[axis]).max(0.0);
    let (x, y) = (beyond(0), beyond(1));
    (x * x + y * y).sqrt()
}
