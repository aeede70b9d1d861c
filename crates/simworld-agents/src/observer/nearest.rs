//! Things in view, handed out nearest first: what matters of most of them is the box around them, which lies with what says
//! where they are; of a handful at once the footprint is looked at, as far as somebody asks.

use simworld_core::geometry::Point2;
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityRef, Scene};

/// So many footprints are looked at together: their memory is waited for but once.
const HANDFUL: usize = 80;
/// A box and the footprint in it are measured by different sums, m.
const SLACK: f64 = 1e-6;

/// What is in view; kept from one look to the next for its memory alone.
#[derive(Clone, Debug, Default)]
pub(super) struct Nearest {
    /// How near each may be, m; those before `closer` were looked at closely.
    glimpses: Vec<(f64, EntityId)>,
    closer: usize,
    /// How near they are, m, sorted from `next` on; those before were handed out.
    seen: Vec<(f64, EntityId)>,
    next: usize,
}

impl Nearest {
    pub(super) fn clear(&mut self) {
        self.glimpses.clear();
        self.seen.clear();
        (self.closer, self.next) = (0, 0);
    }

    /// Adds what is in view from a place.
    pub(super) fn push(&mut self, entity: &EntityRef<'_>, from: Point2) {
        self.glimpses.push((entity.bounds.planar_distance(&from) - SLACK, entity.id));
    }

    /// The next thing within a radius that is there to be seen, with the distance to its footprint, m; of two at the same
    /// distance the lower id comes first.
    pub(super) fn next(&mut self, scene: &dyn Scene, from: Point2, radius: f64) -> Option<(f64, EntityId)> {
        let mut bound = self.bound();
        while self.seen.get(self.next).is_none_or(|(distance, _)| *distance >= bound) && bound < f64::INFINITY
        {
            bound = self.look_closer(scene, from, radius);
        }
        let found = self.seen.get(self.next).copied();
        self.next += usize::from(found.is_some());
        found
    }

    /// Nothing that was not looked at closely is nearer than that, m.
    fn bound(&self) -> f64 {
        self.glimpses.get(self.closer).map_or(f64::INFINITY, |(near, _)| *near)
    }

    /// Looks at the footprints of the next handful; gives the bound for the rest.
    fn look_closer(&mut self, scene: &dyn Scene, from: Point2, radius: f64) -> f64 {
        let rest = &mut self.glimpses[self.closer..];
        let count = rest.len().min(HANDFUL);
        if count < rest.len() {
            // The nearest of the rest comes to stand where the next handful begins.
            rest.select_nth_unstable_by(count, by_distance);
        }
        for (_, id) in &rest[..count] {
            let Some(entity) = scene.entity(*id).filter(EntityRef::is_visible) else { continue };
            let distance = planar_gap(&entity, from);
            if distance <= radius {
                self.seen.push((distance, *id));
            }
        }
        self.closer += count;
        self.seen[self.next..].sort_unstable_by(by_distance);
        self.bound()
    }
}

/// The distance in the plane from a place to the footprint of a thing, m.
pub(super) fn planar_gap(entity: &EntityRef<'_>, from: Point2) -> f64 {
    entity.info.shape.planar_distance(entity.pose, &from)
}

fn by_distance(one: &(f64, EntityId), other: &(f64, EntityId)) -> std::cmp::Ordering {
    one.0.total_cmp(&other.0).then(one.1.cmp(&other.1))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a helper of tests")]
mod tests {
    use std::ops::ControlFlow;

    use proptest::prelude::*;
    use simworld_core::geometry::{Aabb, Point3, pose_facing};
    use simworld_core::scene::{EntityDesc, EntityKind, Shape, World};

    use super::*;

    proptest! {
        /// More things than several handfuls, of any size and turn, also several at one place.
        #[test]
        fn things_come_nearest_first_and_none_is_left_out(
            things in prop::collection::vec((-60..60i32, -60..60i32, 0.0..6.3f64, 0.2..40.0f64, 0.2..20.0f64), 0..300),
            radius in 5.0..80.0f64,
        ) {
            let mut world = World::new();
            for (x, y, yaw, length, width) in things {
                let pose = pose_facing(Point3::new(f64::from(x), f64::from(y), 0.0), yaw);
                world.spawn(EntityDesc::new(EntityKind::Prop, pose, Shape::cuboid(length, width, 1.0))).unwrap();
            }
            let (here, mut nearest, mut all) = (Point2::new(0.3, 0.7), Nearest::default(), Vec::new());
            let _ = world.visit(&Aabb::column_around(here, radius), &mut |entity| {
                nearest.push(&entity, here);
                all.push((planar_gap(&entity, here), entity.id));
                ControlFlow::Continue(())
            });
            all.retain(|(distance, _)| *distance <= radius);
            all.sort_unstable_by(by_distance);
            let handed_out: Vec<_> = std::iter::from_fn(|| nearest.next(&world, here, radius)).collect();
            prop_assert_eq!(handed_out, all);
        }
    }
}
