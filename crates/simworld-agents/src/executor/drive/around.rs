//! Who and what is around a driver: looked for once in a step.

use std::ops::ControlFlow;

use nalgebra::UnitQuaternion;
use simworld_core::geometry::{Aabb, Obb, Point2, Vector2, Vector3, direction, yaw_of};
use simworld_core::id::EntityId;
use simworld_core::net::polyline;
use simworld_core::ops::{sin, sin_cos, tan};
use simworld_core::scene::{EntityKind, EntityRef, Scene};

use super::watch::Own;

/// Slower than this counts as standing, m/s.
pub(super) const STANDING: f64 = 0.3;

/// Somebody or something solid near by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Seen {
    pub(super) id: EntityId,
    pub(super) kind: EntityKind,
    pub(super) at: Point2,
    /// Where its front is, of length one.
    pub(super) ahead: Vector2,
    /// m/s.
    pub(super) velocity: Vector2,
    pub(super) half_length: f64,
    pub(super) corners: [Point2; 4],
    pub(super) solid: Obb,
}

impl Seen {
    fn new(entity: &EntityRef<'_>) -> Self {
        Self {
            id: entity.id,
            kind: entity.kind,
            at: entity.planar(),
            ahead: direction(yaw_of(entity.pose)),
            velocity: entity.twist.linear.xy(),
            half_length: entity.info.shape.size().x * 0.5,
            corners: entity.obb().footprint(),
            solid: entity.obb(),
        }
    }

    /// Over ground, m/s.
    pub(super) fn speed(&self) -> f64 {
        self.velocity.norm()
    }

    pub(super) fn stands(&self) -> bool {
        self.speed() <= STANDING
    }

    pub(super) fn walks(&self) -> bool {
        matches!(self.kind, EntityKind::Person | EntityKind::Dog | EntityKind::Robot)
    }

    /// Where its middle is along a path that it goes along, or stands along: the station, m; `None` if it is not on it.
    pub(super) fn along(&self, path: &[Point2], beside: f64) -> Option<f64> {
        let near = polyline::closest(path, &self.at).filter(|near| near.distance < beside)?;
        let way = direction(polyline::at(path, near.station).1);
        (way.dot(&self.ahead) > 0.5).then_some(near.station)
    }
}

/// All who move within some metres, and what stands there; houses and what is carried are left out.
pub(super) fn look(scene: &dyn Scene, own: &Own<'_>, near: f64, far: f64) -> Vec<Seen> {
    let mut seen = Vec::new();
    let _ = scene.visit(&Aabb::column_around(own.at, far), &mut |other| {
        // Streets lead past houses; the box around one that is no box reaches where its walls do not.
        let counts = other.is_solid() && other.kind != EntityKind::Building && other.attachment.is_none();
        if counts && !own.ids.contains(&other.id) {
            let reach = if other.kind.is_mobile() { far } else { near };
            if (other.planar() - own.at).norm() <= reach {
                seen.push(Seen::new(&other));
            }
        }
        ControlFlow::Continue(())
    });
    seen
}

/// Whether a vehicle would touch somebody or something that it does not touch yet, or come nearer to its sides than that room, m,
/// if it went so far ahead, m, negative backwards, with its wheels at an angle, radians, positive to the left.
pub(super) fn would_touch(own: &Own<'_>, around: &[Seen], (ahead, steer): (f64, f64), beside: f64) -> bool {
    let reach = own.half_length + ahead.abs() + 3.0;
    let moved = [0.5, 1.0].map(|share| rolled(own, ahead * share, steer));
    let mut near = around.iter().filter(|other| (other.at - own.at).norm() < reach + other.half_length);
    near.any(|other| {
        let comes = |by: f64| {
            let overlaps = |solid: &Obb| meets(solid, &other.solid, by);
            !overlaps(&own.solid) && moved.iter().any(overlaps)
        };
        // Who goes straight on comes no nearer to what is beside or behind.
        let towards = steer != 0.0 || (other.at - own.at).dot(&own.ahead) * ahead > 0.0;
        towards && (comes(beside) || comes(0.0))
    })
}

/// Whether a solid comes so near to another, seen from above, m.
pub(super) fn meets(one: &Obb, other: &Obb, beside: f64) -> bool {
    let mut grown = *one;
    grown.half_extents += Vector3::new(beside, beside, 0.0);
    grown.footprints_overlap(other)
}

/// The solid of a vehicle that has rolled so far, m, with its front wheels at an angle, radians: the rear axle goes round a circle.
pub(super) fn rolled(own: &Own<'_>, distance: f64, steer: f64) -> Obb {
    let wheelbase = own.wheelbase();
    let turn = distance * tan(steer) / wheelbase;
    let left = Vector2::new(-own.ahead.y, own.ahead.x);
    // The chord of the rear axle's way, and where the middle is before it.
    let half = turn * 0.5;
    let chord = if half == 0.0 { distance } else { distance * sin(half) / half };
    let along = |angle: f64| {
        let (sin, cos) = sin_cos(angle);
        own.ahead * cos + left * sin
    };
    let shift = along(half) * chord + (along(turn) - own.ahead) * (wheelbase * 0.5);
    let mut solid = own.solid;
    solid.pose.translation.vector += Vector3::new(shift.x, shift.y, 0.0);
    solid.pose.rotation = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), turn) * solid.pose.rotation;
    solid
}
