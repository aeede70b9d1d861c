//! How a humanoid moves on ground that is not level.
//!
//! The middle of its soles is on the surface, whatever the slope does under the rest of its collider; things on the ground
//! are walked along and stepped on as on level ground.

use rapier3d_f64::math::{Pose as RapierPose, Vector};
use rapier3d_f64::prelude::ColliderHandle;
use simworld_core::geometry::{Point2, Vector3, pose_facing};
use simworld_core::ground::Ground;
use simworld_core::scene::FallCause;

use super::walk::{Company, NEARBY, drop_to_support};
use super::{Humanoid, Stand};
use crate::body::Surroundings;
use crate::convert::{from_vector, to_pose, to_vector};
use crate::ground::height_at;
use crate::shape::body_from;

/// How somebody gets past the things that stand on the ground.
struct Past {
    /// World frame, m.
    way: Vector3,
    /// What it met on it.
    met: Vec<ColliderHandle>,
    /// The thing that carries it at the end, and the height of that, m.
    support: Option<(ColliderHandle, f64)>,
    /// Whether it came down on a thing.
    landed: bool,
}

impl Humanoid {
    /// Goes where it wishes as far as things and the slope let it, on what carries it, and takes in what is under the feet.
    pub(super) fn cross_country(
        &mut self,
        surface: &Ground,
        around: &Surroundings<'_>,
        (wish, carried): (&Vector3, &Vector3),
        dt: f64,
    ) {
        let was_grounded = self.motion.grounded;
        let position = self.feet().coords;
        let wish = if was_grounded { along_slope(surface, &position, wish) } else { *wish };
        let past = self.past_things(around, &wish, carried, dt);
        let (moved, support) = self.on_surface(surface, around, &past);
        let at = position + moved;
        if support.is_some() {
            self.stand_on(support, to_vector(&at), around, &around.queries_above_ground());
        } else {
            let grip = around.conditions().road.grip(around.config().ground);
            self.plan.stand = Stand { normal: surface.normal(Point2::new(at.x, at.y)), grip };
            self.motion.support = None;
        }
        self.plan.way = moved;
        let own = moved - carried - self.plan.shifted;
        if was_grounded && self.motion.grounded {
            self.motion.pace.keep_up(wish.xy().norm(), own.xy().norm());
            self.motion.pace.go(own.xy().norm(), own.z);
        }
        if !past.met.is_empty() {
            self.run_against(&past.met, &wish, &own, around, dt);
        }
    }

    /// Trips over what it met on its way, or pushes that.
    fn run_against(
        &mut self,
        met: &[ColliderHandle],
        wish: &Vector3,
        own: &Vector3,
        around: &Surroundings<'_>,
        dt: f64,
    ) {
        let Some(collider) = around.collider() else { return };
        let (solid, body_from_solid) = (collider.shape(), body_from(collider));
        let end = to_pose(&pose_facing(self.feet() + self.plan.way, self.motion.yaw));
        if self.trips(wish.xy() - own.xy(), &end, around, &around.queries_above_ground()) {
            self.plan.upset = self.plan.upset.or(Some(FallCause::Tripped));
        }
        self.find_pushes(met, wish, &(end * body_from_solid), solid, around, dt);
    }

    /// Where it goes in this substep, world frame, m: past things as far as the slope lets it; and the thing that carries it there.
    fn on_surface(
        &mut self,
        surface: &Ground,
        around: &Surroundings<'_>,
        past: &Past,
    ) -> (Vector3, Option<ColliderHandle>) {
        let position = self.feet().coords;
        let moved = past.way;
        let target = Point2::new(position.x + moved.x, position.y + moved.y);
        let ground = height_at(surface, target);
        let (steepest, step) = (around.config().max_slope, around.config().step_height);
        let run = moved.xy().norm();
        let climb = simworld_core::ops::tan(steepest) * run;
        let is_steep = ground.is_some_and(|ground| ground - position.z > climb + 1e-6);
        if self.motion.grounded && is_steep && run > 0.0 {
            // It stays where it is, on what carries it there.
            let here = Point2::new(position.x, position.y);
            return self.settled(Vector3::zeros(), height_at(surface, here), past, step);
        }
        self.settled(moved, ground, past, step + climb)
    }

    /// The way with the height at its end: on the higher of ground and support if that is within reach below; and the support, if that
    /// is the higher one.
    fn settled(
        &mut self,
        mut moved: Vector3,
        ground: Option<f64>,
        past: &Past,
        reach: f64,
    ) -> (Vector3, Option<ColliderHandle>) {
        let position = self.feet().coords;
        let support = past.support.filter(|(_, top)| ground.is_none_or(|ground| *top > ground));
        let floor = support.map(|(_, top)| top).or(ground);
        let was_grounded = self.motion.grounded;
        self.motion.grounded = match floor {
            Some(floor) if was_grounded && floor >= position.z + moved.z.min(0.0) - reach => true,
            Some(floor) => position.z + moved.z <= floor || (past.landed && support.is_some()),
            None => false,
        };
        if let Some(floor) = floor.filter(|_| self.motion.grounded) {
            moved.z = floor - position.z;
        }
        (moved, support.filter(|_| self.motion.grounded).map(|(handle, _)| handle))
    }

    /// The way past what stands on the ground.
    fn past_things(&mut self, around: &Surroundings<'_>, wish: &Vector3, carried: &Vector3, dt: f64) -> Past {
        let mut past = Past { way: wish + carried, met: Vec::new(), support: None, landed: false };
        let Some(collider) = around.collider() else { return past };
        let (solid, body_from_solid) = (collider.shape(), body_from(collider));
        let queries = around.queries_above_ground();
        let position = self.feet().coords;
        let start = to_pose(&pose_facing(position.into(), self.motion.yaw));
        let reach = past.way.norm() + NEARBY;
        let company = Company::of(solid, &(start * body_from_solid), reach, &queries);
        if company == Company::Alone {
            return past;
        }
        let controller = Self::controller(around);
        let mut walk = |from: Vector, wish: Vector| {
            let pose = RapierPose::from_translation(from) * start * body_from_solid;
            controller.move_shape(dt, &queries, solid, &pose, wish, |now| past.met.push(now.handle))
        };
        // What it stands on takes it along, whatever is in the way of its feet.
        let mut moved = to_vector(carried);
        if company == Company::Overlapping {
            let out = walk(moved, Vector::ZERO).translation;
            self.plan.shifted = from_vector(out);
            moved += out;
        }
        // On the ground its height is the ground's business; in the air it falls on things too.
        let level = if self.motion.grounded {
            Vector::new(wish.x, wish.y, 0.0) * self.motion.pace.catching_up(wish.xy().norm())
        } else {
            to_vector(wish)
        };
        let walked = walk(moved, level);
        moved += walked.translation;
        past.landed = walked.grounded;
        let pose = RapierPose::from_translation(moved) * start * body_from_solid;
        past.support = drop_to_support(solid, &pose, around.config().step_height, &queries)
            .map(|(handle, drop)| (handle, position.z + moved.z - drop));
        past.way = from_vector(moved);
        past
    }
}

/// The wish as a way along the slope: as long as on level ground, and so less far in the plane.
fn along_slope(surface: &Ground, position: &Vector3, wish: &Vector3) -> Vector3 {
    let run = wish.xy().norm();
    if run == 0.0 {
        return *wish;
    }
    let normal = surface.normal(Point2::new(position.x, position.y));
    let grade = -normal.xy().dot(&wish.xy()) / (run * normal.z);
    wish / (1.0 + grade * grade).sqrt()
}
