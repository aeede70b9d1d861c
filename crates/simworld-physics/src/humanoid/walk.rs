//! How a humanoid moves through a physics world.
//!
//! The collider ends one skin above the soles, because the character controller keeps that gap to whatever it
//! stands on or walks along: the soles themselves are on the ground.

use parry3d_f64::query::contact;
use parry3d_f64::query::details::ShapeCastOptions;
use parry3d_f64::shape::Shape;
use rapier3d_f64::control::{CharacterAutostep, CharacterLength, KinematicCharacterController};
use rapier3d_f64::math::{Pose as RapierPose, Vector};
use rapier3d_f64::prelude::{ColliderHandle, QueryPipeline, SharedShape};
use simworld_core::exertion::Exertion;
use simworld_core::geometry::{Point2, Vector2, Vector3, direction, pose_facing};
use simworld_core::ops::wrap_angle;
use simworld_core::scene::{FallCause, Footing};

use super::balance::{look_down, own_way};
use super::{ColliderForm, Humanoid, Posture, Stand, Surefootedness, gap, hold};
use crate::body::{BodyContext, Detail, Surroundings};
use crate::claims::Claim;
use crate::convert::{from_vector, to_pose, to_vector};
use crate::grasp::Hold;
use crate::shape::{BodyTag, body_from, is_walker, upright};

/// How often the range of speeds is halved in which that of who carries something is looked for: to less than a millimetre a second.
const HALVINGS: usize = 14;
/// The gap that people keep to solids, m.
pub(crate) const SKIN: f64 = 0.02;
/// Free width that a person needs on a step to take it, m.
const TREAD: f64 = 0.1;
/// Forms with a smaller radius are slender, m.
const SLENDER: f64 = 0.1;
/// How close something must be for the character controller to be asked, beyond the way of a substep, m.
pub(super) const NEARBY: f64 = 0.1;
/// How far the soles of someone standing on the ground may be off it, m.
const LEVEL: f64 = 1e-3;
/// Height from which the ground is looked for, m.
const RAISE: f64 = 0.05;
/// Who comes down faster than this falls, m/s: those who do so for sport land on their feet from 1.28 m (McNitt-Gray, International
/// Journal of Sport Biomechanics 7, 1991).
const HARDEST_LANDING: f64 = 5.0;
/// A rider slows down so that a turn takes about this long, s.
const TURN_TIME: f64 = 0.5;
/// The speed at which a rider takes the sharpest turns, m/s.
const TURN_SPEED: f64 = 1.0;

impl Humanoid {
    /// The collider and its place in the body frame.
    pub(crate) fn collider(&self) -> (SharedShape, RapierPose) {
        let half_height = (self.stature() - SKIN) * 0.5;
        let middle = Vector::new(0.0, 0.0, SKIN + half_height);
        match self.config.form {
            ColliderForm::Cylinder => {
                let solid = SharedShape::cylinder(half_height, self.radius);
                (solid, RapierPose::from_parts(middle, upright()))
            }
            ColliderForm::Capsule => {
                let solid = SharedShape::capsule_z((half_height - self.radius).max(0.0), self.radius);
                (solid, RapierPose::from_translation(middle))
            }
        }
    }

    pub(super) fn controller(around: &Surroundings<'_>) -> KinematicCharacterController {
        let config = around.config();
        KinematicCharacterController {
            up: Vector::Z,
            offset: CharacterLength::Absolute(SKIN),
            slide: true,
            autostep: Some(CharacterAutostep {
                max_height: CharacterLength::Absolute(config.step_height),
                min_width: CharacterLength::Absolute(TREAD),
                include_dynamic_bodies: true,
            }),
            max_slope_climb_angle: config.max_slope,
            min_slope_slide_angle: config.max_slope,
            // Done by `drop_to_support`, from a little above.
            snap_to_ground: None,
            normal_nudge_factor: 1e-4,
        }
    }

    /// Turns and changes speed within the limits; returns the displacement it would like, world frame, m.
    pub(super) fn intend(&mut self, around: &Surroundings<'_>, dt: f64) -> Vector3 {
        let rises = self.footing() == Footing::Rising;
        let way = if rises { Vector2::zeros() } else { self.intend_to_go(around.holds, dt) };
        let way = self.motion.balance.hold_back(way / dt) * dt;
        if self.motion.grounded {
            self.motion.fall_speed = 0.0;
        } else {
            self.motion.fall_speed += around.config().gravity * dt;
        }
        Vector3::new(way.x, way.y, -self.motion.fall_speed * dt)
    }

    /// The part of that in the plane.
    fn intend_to_go(&mut self, holds: &[Hold], dt: f64) -> Vector2 {
        let riding = self.motion.posture == Posture::Riding;
        let turn_left = self.motion.turn_left;
        let mut rate = self.config.turning_rate;
        if riding {
            let (now, wanted) = (self.motion.speed, self.wanted_on_wheels());
            self.motion.speed = if wanted > now {
                wanted.min(now + self.config.ride_acceleration * dt)
            } else {
                wanted.max(now - self.config.ride_braking * dt)
            };
            rate = rate.min(self.config.ride_lateral / self.motion.speed.max(TURN_SPEED));
        } else {
            self.motion.speed = self.bearable_speed(self.motion.wanted_speed) * self.motion.pace.share();
        }
        if !holds.is_empty() {
            rate = rate.min(hold::TURN);
        }
        let turn = hold::turned_with(holds, turn_left.clamp(-rate * dt, rate * dt));
        self.motion.turn_left = turn_left - turn;
        self.motion.yaw = wrap_angle(self.motion.yaw + turn);

        let heading = direction(self.motion.yaw);
        let mut wish = heading * (self.motion.speed * dt);
        let step_left = self.motion.step_left;
        let length = step_left.norm();
        if length > 0.0 {
            let step = step_left * (self.bearable_speed(self.config.step_speed) * dt / length).min(1.0);
            self.motion.step_left = step_left - step;
            wish += Vector2::new(
                heading.x * step.x - heading.y * step.y,
                heading.y * step.x + heading.x * step.y,
            );
        }
        wish
    }

    /// How fast it goes of a wish: who crouches is slow, and what it carries costs no more than its top speed does with empty hands, m/s.
    fn bearable_speed(&self, wish: f64) -> f64 {
        let (load, wish) = (self.load(), self.speed_under(wish));
        if load <= 0.0 || self.config.balance == Surefootedness::Unfailing {
            return wish;
        }
        let (free, laden) = (
            Exertion { body: self.mass, ..Exertion::default() },
            Exertion { body: self.mass, load, ..Exertion::default() },
        );
        let most = free.power(self.config.top_speed, 0.0);
        if laden.power(wish, 0.0) <= most {
            return wish;
        }
        let (mut low, mut high) = (0.0, wish);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if laden.power(middle, 0.0) <= most { low = middle } else { high = middle }
        }
        low
    }

    /// The speed a rider is after: what it was told, or less for a sharp turn.
    fn wanted_on_wheels(&self) -> f64 {
        let sharpness = self.motion.turn_left.abs();
        let in_turn = self.config.ride_lateral * TURN_TIME / sharpness.max(1e-3);
        self.motion.wanted_speed.min(in_turn.max(TURN_SPEED))
    }

    /// Whether it stands on the ground itself, farther than `reach` from its edge.
    fn is_on_level_ground(&self, half_extent: f64, reach: f64) -> bool {
        let level = self.feet().z.abs() < LEVEL;
        self.motion.grounded && level && self.is_over_ground(half_extent, reach)
    }

    fn is_over_ground(&self, half_extent: f64, reach: f64) -> bool {
        let (at, inside) = (self.feet(), half_extent - reach);
        at.z > -LEVEL && at.x.abs() < inside && at.y.abs() < inside
    }

    fn room(&self, position: &Vector3) -> Claim {
        Claim {
            center: Point2::new(position.x, position.y),
            radius: self.radius,
            bottom: position.z,
            top: position.z + self.stature(),
        }
    }
}

/// How far down it is to what carries a walker within a step's height, m; negative if it is a little up.
///
/// A cast that starts at the very gap it looks for misses now and then, so it starts above.
pub(super) fn drop_to_support(
    solid: &dyn Shape,
    pose: &RapierPose,
    step_height: f64,
    queries: &QueryPipeline<'_>,
) -> Option<(ColliderHandle, f64)> {
    let raised = RapierPose::from_translation(Vector::new(0.0, 0.0, RAISE)) * *pose;
    let options = ShapeCastOptions {
        target_distance: SKIN,
        stop_at_penetration: false,
        max_time_of_impact: RAISE + step_height,
        compute_impact_geometry_on_penetration: true,
    };
    let (handle, hit) = queries.cast_shape(&raised, -Vector::Z, solid, options)?;
    // Walls beside the body are no support, nor is what the raised body is inside of.
    (hit.normal1.z > 0.5 && hit.time_of_impact > 0.0).then_some((handle, hit.time_of_impact - RAISE))
}

/// What is close to a body.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Company {
    /// Nothing but the ground.
    Alone,
    /// Something within reach.
    Near,
    /// Something that shares its room.
    Overlapping,
}

impl Company {
    /// Who is within `reach` m of the box around a solid.
    pub(super) fn of(solid: &dyn Shape, pose: &RapierPose, reach: f64, queries: &QueryPipeline<'_>) -> Self {
        let mut aabb = solid.compute_aabb(pose);
        aabb.mins -= Vector::splat(reach);
        aabb.maxs += Vector::splat(reach);
        let mut company = Self::Alone;
        for (_, other) in queries.intersect_aabb_conservative(aabb) {
            if BodyTag::from_user_data(other.user_data) == BodyTag::Ground {
                continue;
            }
            let overlap = contact(pose, solid, other.position(), other.shape(), 0.0);
            if overlap.is_ok_and(|found| found.is_some_and(|contact| contact.dist < -1e-4)) {
                return Self::Overlapping;
            }
            company = Self::Near;
        }
        company
    }
}

impl Humanoid {
    /// Looks around and makes up its mind where to go in this substep.
    pub(super) fn look_around(&mut self, around: &Surroundings<'_>, dt: f64) {
        self.plan.pushes.clear();
        self.plan.upset = None;
        self.mind_the_head(around);
        self.plan.shifted = Vector3::zeros();
        self.plan.hung = hold::hung(around.holds, around.config().gravity);
        let (was_grounded, sink) = (self.motion.grounded, self.motion.fall_speed);
        let (carried, turned) = self.carry(around, dt);
        self.motion.yaw = wrap_angle(self.motion.yaw + turned);
        let before = self.motion.yaw;
        let wish = self.intend(around, dt) + self.give_way(around, dt);
        let wish = self.lean(wish, wrap_angle(self.motion.yaw - before), around, dt);
        let Some(collider) = around.collider() else { return };
        let (solid, body_from_solid) = (collider.shape(), body_from(collider));
        let start = to_pose(&pose_facing(self.feet(), self.motion.yaw));
        if self.is_struck(&wish, &(start * body_from_solid), solid, around, dt) {
            self.plan.upset = Some(FallCause::Struck);
        }
        if let Some(surface) = around.surface() {
            self.cross_country(surface, around, (&wish, &carried), dt);
        } else {
            let reach = (wish + carried).norm() + NEARBY;
            let company = Company::of(solid, &(start * body_from_solid), reach, &around.queries());
            let half_extent = around.config().ground_half_extent;
            if company == Company::Alone && self.is_on_level_ground(half_extent, reach) {
                // There is nothing to run into: the controller would find out the same at many times the cost.
                self.plan.way = Vector3::new(wish.x, wish.y, -self.feet().z);
                self.stand_on_level_ground(around);
                self.motion.pace.go(wish.xy().norm(), 0.0);
            } else if company == Company::Alone
                && !was_grounded
                && self.radius < SLENDER
                && self.is_over_ground(half_extent, reach)
            {
                // Casts of a slender form against a solid of 200 km find faces that lean, along which it would slide.
                let height = self.feet().z;
                self.motion.grounded = height + wish.z <= 0.0;
                self.plan.way = Vector3::new(wish.x, wish.y, wish.z.max(-height));
                self.stand_on_level_ground(around);
            } else {
                self.find_way(&wish, &carried, company, around, dt);
            }
        }
        let has_landed = !was_grounded && self.motion.grounded;
        let is_hard = sink > HARDEST_LANDING && around.detail() == Detail::Full;
        if has_landed && is_hard && self.is_fallible(around.config().gravity) {
            self.plan.upset = self.plan.upset.or(Some(FallCause::Landed));
        }
        let own = own_way((self.plan.way - self.plan.shifted - carried).xy(), wish.xy());
        let velocity = (own + carried.xy()) / dt;
        if self.slips(velocity, around, dt) {
            self.plan.upset = self.plan.upset.or(Some(FallCause::Slipped));
        }
        self.tread(&carried, around, dt);
    }

    fn stand_on_level_ground(&mut self, around: &Surroundings<'_>) {
        let grip = around.conditions().road.grip(around.config().ground);
        self.plan.stand = Stand { grip, ..Stand::default() };
        self.motion.support = None;
    }

    /// Lets the character controller find the way among solids.
    fn find_way(
        &mut self,
        wish: &Vector3,
        carried: &Vector3,
        company: Company,
        around: &Surroundings<'_>,
        dt: f64,
    ) {
        let Some(collider) = around.collider() else { return };
        let (solid, body_from_solid) = (collider.shape(), body_from(collider));
        let queries = around.queries();
        let start = to_pose(&pose_facing(self.feet(), self.motion.yaw));
        let was_grounded = self.motion.grounded;
        let controller = Self::controller(around);
        let place = |moved: Vector| RapierPose::from_translation(moved) * start * body_from_solid;
        let mut met = Vec::new();
        let mut walk = |from: Vector, wish: Vector| {
            controller.move_shape(dt, &queries, solid, &place(from), wish, |met_now| met.push(met_now.handle))
        };
        // What it stands on takes it along, whatever is in the way of its feet.
        let mut moved = to_vector(carried);
        if company == Company::Overlapping {
            // Without a wish the controller pushes itself out of what has run into it.
            let out = walk(moved, Vector::ZERO).translation;
            self.plan.shifted = from_vector(out);
            moved += out;
        }
        let way = wish.xy().norm();
        let share = if was_grounded { self.motion.pace.told(way) } else { 1.0 };
        let result = walk(moved, Vector::new(wish.x * share, wish.y * share, wish.z));
        moved += gap::kept(solid, &place(moved), result.translation, &queries);
        self.motion.grounded = result.grounded;
        let mut support = None;
        if was_grounded
            && let Some((handle, drop)) =
                drop_to_support(solid, &place(moved), around.config().step_height, &queries)
        {
            moved.z -= drop;
            self.motion.grounded = true;
            support = Some(handle);
        }
        if self.is_over_ground(around.config().ground_half_extent, wish.norm() + NEARBY) {
            moved.z = moved.z.max(-self.feet().z);
        }
        self.stand_on(support, start.translation + moved, around, &queries);
        let own = from_vector(moved) - carried - self.plan.shifted;
        if was_grounded && self.motion.grounded {
            self.motion.pace.keep_up(way, own.xy().norm());
            self.motion.pace.go(own.xy().norm(), own.z);
        }
        let at = RapierPose::from_translation(moved) * start;
        if self.trips(wish.xy() - own.xy(), &at, around, &queries) {
            self.plan.upset = self.plan.upset.or(Some(FallCause::Tripped));
        }
        self.find_pushes(&met, wish, &place(moved), solid, around, dt);
        self.plan.way = from_vector(moved);
    }

    /// Takes in what is under the feet.
    pub(super) fn stand_on(
        &mut self,
        support: Option<ColliderHandle>,
        feet: Vector,
        around: &Surroundings<'_>,
        queries: &QueryPipeline<'_>,
    ) {
        let moves = |handle: &ColliderHandle| {
            let collider = around.physics.colliders.get(*handle);
            // Who steps on somebody's feet is not carried by it.
            collider.is_some_and(|collider| collider.parent().is_some() && !is_walker(collider.user_data))
        };
        self.motion.support = support.filter(moves);
        // The sole is level and the middle of it over the slope.
        let reach = around.config().step_height.max(self.radius);
        self.plan.stand = match look_down(feet, reach, around, queries) {
            Some(under) => Stand { normal: under.normal, grip: under.grip },
            None => Stand::default(),
        };
    }

    /// Goes where the way leads, as far as others leave room; returns how far that is, m.
    pub(super) fn step_on(&mut self, context: &mut BodyContext<'_>) -> Vector3 {
        let position = self.feet().coords;
        let planned = self.plan.way;
        let share = context.free_share(&self.room(&position), &planned, SKIN);
        // Half a step up would end inside the step, so it is not taken at all.
        let displacement = match share {
            1.0 => planned,
            _ if planned.z > 1e-3 => Vector3::zeros(),
            share => planned * share,
        };
        let target = position + displacement;
        context.claim(self.room(&target));
        let pose = pose_facing(target.into(), self.motion.yaw);
        context.rigid_body().set_next_kinematic_position(to_pose(&pose));
        displacement
    }
}
