//! Local avoidance: passing people on the right, and other things on the nearer side.

use std::ops::ControlFlow;

use simworld_core::geometry::{Aabb, Point2, Vector2};
use simworld_core::id::EntityId;
use simworld_core::ops;
use simworld_core::scene::{EntityKind, EntityRef, Scene};

/// Half the width of the way that one wants free, m: half a body and an arm's breadth.
const BERTH: f64 = 0.65;
/// The most that one turns aside, radians.
const MOST: f64 = 1.5;
/// How far before a thing one has to be out of its way, m: half a body and a little.
const GAP: f64 = 0.35;
/// Things longer than this are houses and walls: one slides along them, and the way leads round them, m.
const LONGEST: f64 = 10.0;
/// A person this far to the right is passed on the left, m.
const CLEARLY_RIGHT: f64 = 0.25;

/// Whom one keeps clear of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Whom {
    /// People and things.
    All,
    /// What moves by itself: the way leads round the rest.
    Movers,
}

/// What stands in the way, in the frame of the way: how far ahead it begins, and from where to where it reaches
/// across, m, positive to the left.
struct Obstacle {
    kind: EntityKind,
    ahead: f64,
    right: f64,
    left: f64,
}

/// The angle to the left by which to miss what is ahead on the way to a point; zero if nothing is. The thing that
/// one goes to is no obstacle.
pub(super) fn detour(
    scene: &dyn Scene,
    me: &EntityRef<'_>,
    to: Point2,
    goal: Option<EntityId>,
    (look_ahead, whom): (f64, Whom),
) -> f64 {
    let (here, along) = (me.planar(), to - me.planar());
    let distance = along.norm();
    if distance < 1e-6 {
        return 0.0;
    }
    let way = along / distance;
    let sight = look_ahead.min(distance);
    let mut nearest: Option<Obstacle> = None;
    let _ = scene.visit(&Aabb::column_around(here, sight + BERTH), &mut |other| {
        let is_other = other.id != me.id && Some(other.id) != goal && other.attachment.is_none();
        if is_other
            && other.is_solid()
            && (whom == Whom::All || other.kind.is_mobile())
            && let Some(obstacle) = in_the_way(&other, here, way, sight)
            && nearest.as_ref().is_none_or(|least| obstacle.ahead < least.ahead)
        {
            nearest = Some(obstacle);
        }
        ControlFlow::Continue(())
    });
    nearest.map_or(0.0, |obstacle| {
        // Beside the thing already there is time: one bears away gently.
        let room = if obstacle.ahead > 0.0 { (obstacle.ahead - GAP).max(0.05) } else { 1.0 };
        ops::atan2(obstacle.aside(), room).clamp(-MOST, MOST)
    })
}

/// The thing as an obstacle, if it reaches into the strip that one wants free.
fn in_the_way(other: &EntityRef<'_>, here: Point2, way: Vector2, sight: f64) -> Option<Obstacle> {
    let size = other.info.shape.size();
    if size.x.max(size.y) > LONGEST {
        return None;
    }
    let (mut obstacle, mut end) = (
        Obstacle { kind: other.kind, ahead: f64::INFINITY, right: f64::INFINITY, left: f64::NEG_INFINITY },
        f64::NEG_INFINITY,
    );
    for corner in other.obb().footprint() {
        let offset = corner - here;
        let (forward, aside) = (offset.dot(&way), way.perp(&offset));
        obstacle.ahead = obstacle.ahead.min(forward);
        end = end.max(forward);
        obstacle.right = obstacle.right.min(aside);
        obstacle.left = obstacle.left.max(aside);
    }
    let reaches_in = obstacle.right < BERTH && obstacle.left > -BERTH;
    (reaches_in && end > 0.0 && obstacle.ahead < sight).then_some(obstacle)
}

impl Obstacle {
    /// How far to the left one has to step to pass it, m.
    fn aside(&self) -> f64 {
        let (by_left, by_right) = (self.left + BERTH, self.right - BERTH);
        let middle = (self.left + self.right) * 0.5;
        let keeps_right =
            if self.kind == EntityKind::Person { middle > -CLEARLY_RIGHT } else { -by_right <= by_left };
        if keeps_right { by_right } else { by_left }
    }
}
