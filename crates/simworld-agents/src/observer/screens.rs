//! What hides things from the eyes: houses and vehicles around, the nearest first, each with the wedge that it may hide.
//!
//! A screen is looked at closely only for what lies in its wedge and not before it, seen from above; of what is left the
//! oriented box decides.

use simworld_core::geometry::{Aabb, Obb, Point2, Point3, Vector2};
use simworld_core::id::EntityId;
use simworld_core::scene::EntityRef;

use crate::executor::crosses;

/// The screens around a pair of eyes; kept from one look to the next for its memory alone.
#[derive(Clone, Debug, Default)]
pub(super) struct Screens {
    all: Vec<Screen>,
}

#[derive(Clone, Debug)]
struct Screen {
    id: EntityId,
    /// From the eyes to the box around it, in the plane, m.
    gap: f64,
    /// Its right and left edge as seen from the eyes; `None` for what stands around or close before them.
    wedge: Option<(Vector2, Vector2)>,
    obb: Obb,
}

impl Screens {
    pub(super) fn clear(&mut self) {
        self.all.clear();
    }

    /// Adds one, as seen from a place.
    pub(super) fn push(&mut self, entity: &EntityRef<'_>, from: Point2) {
        let gap = entity.bounds.planar_distance(&from);
        let wedge = wedge(entity.bounds, from);
        self.all.push(Screen { id: entity.id, gap, wedge, obb: entity.obb() });
    }

    /// Puts the nearest first, once all are there.
    pub(super) fn sort(&mut self) {
        self.all.sort_unstable_by(|a, b| a.gap.total_cmp(&b.gap).then(a.id.cmp(&b.id)));
    }

    /// Whether, seen from the eyes, each of two points one above the other is behind a screen that none of the two are.
    pub(super) fn hide(&self, eye: &Point3, points: [Point3; 2], none_of: [Option<EntityId>; 2]) -> bool {
        let way = points[0].xy() - eye.xy();
        let distance = way.norm();
        let mut hidden = [false; 2];
        for screen in self.all.iter().take_while(|screen| screen.gap <= distance) {
            if !screen.lies_on(&way) || none_of.contains(&Some(screen.id)) {
                continue;
            }
            for (hidden, point) in hidden.iter_mut().zip(&points) {
                *hidden = *hidden || crosses(&screen.obb, eye, point);
            }
            if hidden == [true; 2] {
                return true;
            }
        }
        false
    }
}

impl Screen {
    /// Whether the way may lead through it.
    fn lies_on(&self, way: &Vector2) -> bool {
        /// Ways that just miss an edge are looked at too.
        const SLACK: f64 = -1e-9;
        self.wedge.is_none_or(|(right, left)| right.perp(way) >= SLACK && way.perp(&left) >= SLACK)
    }
}

/// The edges of a box as seen from a place outside of it, if it takes up less than half of what is around.
fn wedge(bounds: &Aabb, from: Point2) -> Option<(Vector2, Vector2)> {
    let (low, high) = (bounds.min.xy() - from, bounds.max.xy() - from);
    let mut corners = [low, Vector2::new(high.x, low.y), high, Vector2::new(low.x, high.y)].into_iter();
    let first = corners.next()?;
    let is_around = low.x <= 0.0 && high.x >= 0.0 && low.y <= 0.0 && high.y >= 0.0;
    let edges = corners.fold((first, first), |(right, left), corner| {
        (
            if right.perp(&corner) < 0.0 { corner } else { right },
            if left.perp(&corner) > 0.0 { corner } else { left },
        )
    });
    (!is_around).then_some(edges)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a helper of tests")]
mod tests {
    use proptest::prelude::*;
    use simworld_core::geometry::pose_facing;
    use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};

    use super::*;

    proptest! {
        /// Houses of any size and turn, also around the eyes: the wedges leave nothing out.
        #[test]
        fn wedges_hide_what_boxes_hide(
            houses in prop::collection::vec((-30.0..30.0f64, -30.0..30.0f64, 0.0..6.3f64, 0.5..40.0f64, 0.5..20.0f64), 1..8),
            points in prop::collection::vec((-50.0..50.0f64, -50.0..50.0f64, 0.0..4.0f64), 1..20),
        ) {
            let mut world = World::new();
            let eye = Point3::new(0.0, 0.0, 1.7);
            let mut screens = Screens::default();
            let mut boxes = Vec::new();
            for (x, y, yaw, length, width) in houses {
                let pose = pose_facing(Point3::new(x, y, 0.0), yaw);
                let house = EntityDesc::new(EntityKind::Building, pose, Shape::cuboid(length, width, 3.0));
                let id = world.spawn(house).unwrap();
                let house = world.entity(id).unwrap();
                screens.push(&house, eye.xy());
                boxes.push((id, house.obb()));
            }
            screens.sort();
            let spared = boxes[0].0;
            for (x, y, z) in points {
                let pair = [Point3::new(x, y, z), Point3::new(x, y, z + 1.0)];
                let behind = |point: &Point3| boxes.iter().any(|(id, obb)| *id != spared && crosses(obb, &eye, point));
                prop_assert_eq!(screens.hide(&eye, pair, [Some(spared), None]), pair.iter().all(behind));
            }
        }
    }
}
