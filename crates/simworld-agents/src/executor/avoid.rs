//! Local avoidance: passing people on the right, and other things on the nearer side.

use std::ops::ControlFlow;

use simworld_core::geometry::{Aabb, Point2};
use simworld_core::scene::{EntityKind, EntityRef, Scene};

/// Half the width of the way that one wants free, m.
const BERTH: f64 = 0.65;
/// The most that one turns aside, radians.
const MOST: f64 = 0.9;

/// The angle to the left by which to miss what is ahead on the way to a point; zero if nothing is.
pub(super) fn detour(scene: &dyn Scene, me: &EntityRef<'_>, to: Point2, look_ahead: f64) -> f64 {
    let (here, along) = (me.planar(), to - me.planar());
    let distance = along.norm();
    if distance < 1e-6 {
        return 0.0;
    }
    let ahead = along / distance;
    let sight = look_ahead.min(distance);
    let mut nearest: Option<(f64, f64, EntityKind)> = None;
    let _ = scene.visit(&Aabb::column_around(here, sight + 0.5), &mut |other| {
        if !other.kind.is_solid() || other.id == me.id || other.attachment.is_some() {
            return ControlFlow::Continue(());
        }
        let size = other.info.shape.size();
        let radius = size.x.min(size.y) * 0.5;
        if size.x.max(size.y) > 3.0 {
            return ControlFlow::Continue(()); // walls are slid along, not walked round
        }
        let offset = other.planar() - here;
        let (forward, left) = (offset.dot(&ahead), ahead.perp(&offset));
        let in_the_way = forward > 0.0 && forward - radius < sight && left.abs() < BERTH + radius;
        if in_the_way && nearest.is_none_or(|(least, ..)| forward < least) {
            nearest = Some((forward, left, other.kind));
        }
        ControlFlow::Continue(())
    });
    let Some((forward, left, kind)) = nearest else { return 0.0 };
    let urgency = (1.0 - forward / (sight + 0.5)).clamp(0.2, 1.0);
    // People keep right of each other unless the other is clearly on the right already.
    let pass_right = if kind == EntityKind::Person { left > -0.25 } else { left >= 0.0 };
    if pass_right { -MOST * urgency } else { MOST * urgency }
}
