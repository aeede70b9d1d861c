//! Who sees what: the field of view, and what stands in between.

use std::f64::consts::PI;
use std::ops::ControlFlow;

use simworld_core::geometry::{Aabb, Obb, Point2, Point3, heading, yaw_of};
use simworld_core::id::EntityId;
use simworld_core::ops::wrap_angle;
use simworld_core::scene::{EntityKind, EntityRef, Scene};

/// The horizontal field of view of a person, radians: 180°, within which things are noticed.
const FIELD_OF_VIEW: f64 = PI;
/// Eye height as a share of a body's height.
const EYES: f64 = 0.93;

/// Whether somebody sees a thing: within the field of view and the range, and nothing large in between.
pub(crate) fn sees(scene: &dyn Scene, me: &EntityRef<'_>, other: &EntityRef<'_>, range: f64) -> bool {
    let offset = other.bounds.center().xy() - me.planar();
    if offset.norm() < 1e-9 {
        return true;
    }
    let distance = other.info.shape.planar_distance(other.pose, &me.planar());
    let bearing = wrap_angle(heading(&offset) - yaw_of(me.pose));
    let is_ahead = distance <= range && bearing.abs() <= FIELD_OF_VIEW * 0.5;
    is_ahead && other.is_visible() && is_in_sight(scene, me, other)
}

/// The eyes of a body, world frame.
pub(crate) fn eyes(me: &EntityRef<'_>) -> Point3 {
    let here = me.planar();
    Point3::new(here.x, here.y, me.bounds.min.z + (me.bounds.max.z - me.bounds.min.z) * EYES)
}

/// Whether the middle or the top of a thing is in a clear line of sight.
fn is_in_sight(scene: &dyn Scene, me: &EntityRef<'_>, other: &EntityRef<'_>) -> bool {
    let eye = eyes(me);
    let (middle, top) = looked_at(other, eye.xy());
    [middle, top].iter().any(|point| clear_between(scene, &eye, point, me.id, other.id))
}

/// The points of a thing that one looks at: its middle and just below its top, on the side towards the eye, since the
/// middle of a house is behind its own front.
pub(crate) fn looked_at(other: &EntityRef<'_>, from: Point2) -> (Point3, Point3) {
    let center = other.bounds.center();
    let half = other.bounds.half_extents();
    let near = Point2::new(
        from.x.clamp(center.x - half.x, center.x + half.x),
        from.y.clamp(center.y - half.y, center.y + half.y),
    );
    let top = other.bounds.max.z - (other.bounds.max.z - other.bounds.min.z) * 0.1;
    (Point3::new(near.x, near.y, center.z), Point3::new(near.x, near.y, top))
}

/// Whether no solid larger than a post crosses the line between two points, by oriented boxes.
pub(crate) fn clear_between(
    scene: &dyn Scene,
    from: &Point3,
    to: &Point3,
    me: EntityId,
    other: EntityId,
) -> bool {
    let mut clear = true;
    let _ = scene.visit(&Aabb::new(*from, *to), &mut |between| {
        let may_hide = between.id != me && between.id != other && between.is_visible();
        if may_hide && hides(&between) && crosses(&between.obb(), from, to) {
            clear = false;
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    });
    clear
}

/// Things that one does not look past: houses, vehicles but two-wheelers, shelters.
pub(crate) const fn hides(entity: &EntityRef<'_>) -> bool {
    matches!(
        entity.kind,
        EntityKind::Building | EntityKind::Car | EntityKind::Truck | EntityKind::Bus | EntityKind::BusStop
    )
}

/// Whether the segment passes through the box, by slabs.
pub(crate) fn crosses(obb: &Obb, from: &Point3, to: &Point3) -> bool {
    let (a, b) = (obb.pose.inverse_transform_point(from), obb.pose.inverse_transform_point(to));
    let way = b - a;
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for axis in 0..3 {
        let half = obb.half_extents[axis];
        if way[axis].abs() < 1e-12 {
            if a[axis].abs() > half {
                return false;
            }
            continue;
        }
        let (one, two) = ((-half - a[axis]) / way[axis], (half - a[axis]) / way[axis]);
        enter = enter.max(one.min(two));
        leave = leave.min(one.max(two));
    }
    enter < leave
}
