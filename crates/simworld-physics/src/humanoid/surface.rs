//! How a humanoid moves on ground that is not level.
//!
//! The middle of its soles is on the surface, whatever the slope does under the rest of its collider; things on the ground
//! are walked along and stepped on as on level ground.

use rapier3d_f64::math::{Pose as RapierPose, Vector};
use simworld_core::geometry::{Point2, Vector3, pose_facing};
use simworld_core::ground::Ground;

use super::walk::{Company, NEARBY, drop_to_support};
use super::{Humanoid, Stand};
use crate::body::Surroundings;
use crate::convert::{from_vector, to_pose, to_vector};
use crate::ground::height_at;
use crate::shape::body_from;

impl Humanoid {
    /// Goes where it wishes as far as things and the slope let it, and takes in what is under the feet.
    pub(super) fn cross_country(
        &mut self,
        surface: &Ground,
        around: &Surroundings<'_>,
        wish: &Vector3,
        dt: f64,
    ) {
        let was_grounded = self.motion.grounded;
        let moved = self.on_surface(surface, around, wish, dt);
        let at = self.feet() + moved;
        let grip = around.conditions().road.grip(around.config().ground);
        self.plan.stand = Stand { normal: surface.normal(Point2::new(at.x, at.y)), grip };
        self.motion.support = None;
        if was_grounded && self.motion.grounded {
            self.motion.pace.go(moved.xy().norm(), moved.z);
        }
        self.plan.way = moved;
    }

    /// Where it goes in this substep, world frame, m: as it wishes, as far as things and the slope let it.
    fn on_surface(
        &mut self,
        surface: &Ground,
        around: &Surroundings<'_>,
        wish: &Vector3,
        dt: f64,
    ) -> Vector3 {
        let position = self.feet().coords;
        let was_grounded = self.motion.grounded;
        let wish = if was_grounded { along_slope(surface, &position, wish) } else { *wish };
        let (mut moved, support) = self.past_things(around, &wish, dt);
        let target = Point2::new(position.x + moved.x, position.y + moved.y);
        let ground = height_at(surface, target);
        let (steepest, step) = (around.config().max_slope, around.config().step_height);
        let run = moved.xy().norm();
        let climb = simworld_core::ops::tan(steepest) * run;
        if was_grounded && ground.is_some_and(|ground| ground - position.z > climb + 1e-6) && run > 0.0 {
            // Too steep: it stays where it is, on what carries it there.
            moved = Vector3::zeros();
            let here = Point2::new(position.x, position.y);
            return self.settled(moved, height_at(surface, here), support, step);
        }
        self.settled(moved, ground, support, step + climb)
    }

    /// The way with the height at its end: on the higher of ground and support if that is within reach below.
    fn settled(
        &mut self,
        mut moved: Vector3,
        ground: Option<f64>,
        support: Option<f64>,
        reach: f64,
    ) -> Vector3 {
        let position = self.feet().coords;
        let floor = [ground, support].into_iter().flatten().reduce(f64::max);
        let was_grounded = self.motion.grounded;
        self.motion.grounded = match floor {
            Some(floor) if was_grounded && floor >= position.z + moved.z.min(0.0) - reach => true,
            Some(floor) => position.z + moved.z <= floor,
            None => false,
        };
        if let Some(floor) = floor.filter(|_| self.motion.grounded) {
            moved.z = floor - position.z;
        }
        moved
    }

    /// The way past what stands on the ground, and the height of what carries it at the end, if a thing does, m.
    fn past_things(&self, around: &Surroundings<'_>, wish: &Vector3, dt: f64) -> (Vector3, Option<f64>) {
        let Some(collider) = around.collider() else { return (*wish, None) };
        let (solid, body_from_solid) = (collider.shape(), body_from(collider));
        let queries = around.queries_above_ground();
        let position = self.feet().coords;
        let start = to_pose(&pose_facing(position.into(), self.motion.yaw));
        let company = Company::of(solid, &(start * body_from_solid), wish.norm() + NEARBY, &queries);
        if company == Company::Alone {
            return (*wish, None);
        }
        let controller = Self::controller(around);
        let walk = |from: Vector, wish: Vector| {
            let pose = RapierPose::from_translation(from) * start * body_from_solid;
            controller.move_shape(dt, &queries, solid, &pose, wish, |_| {})
        };
        let mut moved = Vector::ZERO;
        if company == Company::Overlapping {
            moved = walk(moved, Vector::ZERO).translation;
        }
        // On the ground its height is the ground's business; in the air it falls on things too.
        let level = if self.motion.grounded { Vector::new(wish.x, wish.y, 0.0) } else { to_vector(wish) };
        moved += walk(moved, level).translation;
        let pose = RapierPose::from_translation(moved) * start * body_from_solid;
        let drop = drop_to_support(solid, &pose, around.config().step_height, &queries);
        let support = drop.map(|(_, drop)| position.z + moved.z - drop);
        (from_vector(moved), support)
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
