//! When somebody loses the footing.
//!
//! Feet go where they are told at once; the centre of mass follows within about a step, and what that asks of the
//! ground is what friction must give. Somebody recovers from a stumble or a push as long as the extrapolated centre of
//! mass, which leads the centre of mass by its speed over the frequency of the leg as a pendulum, stays within reach of
//! one step (Hof, Gazendam and Sinke, The condition for dynamic stability, Journal of Biomechanics 38, 2005).

use parry3d_f64::query::cast_shapes;
use parry3d_f64::query::details::ShapeCastOptions;
use parry3d_f64::shape::{Cylinder, Shape};
use rapier3d_f64::math::{Pose as RapierPose, Vector};
use rapier3d_f64::prelude::{Collider, ColliderHandle, QueryPipeline, RigidBody};
use serde::{Deserialize, Serialize};
use simworld_core::geometry::{Point2, Vector2, Vector3};

use super::walk::SKIN;
use super::{Humanoid, Posture};
use crate::body::Surroundings;
use crate::convert::{from_vector, to_vector};
use crate::shape::upright;

/// Time in which the centre of mass takes up the speed of the feet, s: people reach their speed by the end of the first
/// step (Brenière and Do, Journal of Biomechanics 19, 1986), and a step takes that long.
const STEP_TIME: f64 = 0.55;
/// How far ahead of the centre of mass one step brings the toes, as a share of the height: half a step of walking and
/// a foot (Winter 2009, figure 4.1).
const REACH: f64 = 0.205 + 0.152;
/// Length of the leg as a pendulum as a share of the height: 1.2 of the height of the hips (Hof 2005).
const PENDULUM: f64 = 1.2 * 0.53;
/// Height of the centre of mass as a share of the body's (Winter 2009, table 4.1).
pub(super) const CENTER: f64 = 0.56;
/// Friction of soles where tyres have the grip of dry asphalt; concrete has 0.95 of it. Soles of rubber on concrete have 1.0
/// dry and 0.7 wet, shoes on ice 0.1 (static; `OpenStax` College Physics, table 5.1).
const SOLES: f64 = 1.05;
/// Somebody careful asks no more than this share of what friction gives.
pub(super) const CARE: f64 = 0.7;
/// Who is shorter keeps its balance like somebody of this height, m.
const SHORTEST: f64 = 0.3;
/// Where there is less weight than that of a tenth of the Earth's, nobody stands by it, m/s².
const WEIGHTLESS: f64 = 1.0;
/// Free way of the trunk over what stops the feet, m: less, and it is a wall.
const OVERHANG: f64 = 0.3;

/// How somebody stands on its feet.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Balance {
    /// Velocity of the centre of mass in the plane, m/s: it follows the feet.
    pub(super) momentum: Vector2,
    /// Acceleration that friction gave at the last look, beyond what a slope takes, m/s².
    pub(super) traction: f64,
    /// Whether it has slipped and goes carefully since.
    pub(super) is_careful: bool,
}

impl Default for super::Stand {
    /// Level ground that nobody slips on.
    fn default() -> Self {
        Self { normal: Vector3::z(), grip: 1.0 }
    }
}

/// The change of speed that somebody so tall recovers from, m/s.
fn recoverable_speed(height: f64, gravity: f64) -> f64 {
    let height = height.max(SHORTEST);
    (gravity / (PENDULUM * height)).sqrt() * REACH * height
}

/// What is slower than this knocks nobody over, m/s.
pub(crate) fn least_blow(gravity: f64) -> f64 {
    recoverable_speed(SHORTEST, gravity)
}

impl Balance {
    /// Holds a wish back to what friction gives, for somebody careful: the velocity that the feet then have.
    pub(super) fn hold_back(&self, velocity: Vector2) -> Vector2 {
        if !self.is_careful {
            return velocity;
        }
        let change = velocity - self.momentum;
        let most = CARE * self.traction * STEP_TIME;
        if change.norm() <= most { velocity } else { self.momentum + change * (most / change.norm()) }
    }

    /// Lets the centre of mass follow the feet for `dt` s; returns the acceleration that it asked for at the beginning.
    pub(super) fn follow(&mut self, velocity: Vector2, dt: f64) -> Vector2 {
        let asked = (velocity - self.momentum) / STEP_TIME;
        self.momentum += (velocity - self.momentum) * (dt / (dt + STEP_TIME));
        asked
    }
}

impl Humanoid {
    /// The change of speed that it recovers from, m/s.
    pub(super) fn recoverable_speed(&self, gravity: f64) -> f64 {
        recoverable_speed(self.height, gravity)
    }

    /// Whether it can fall at all as it is.
    pub(super) fn is_fallible(&self, gravity: f64) -> bool {
        self.config.balance == super::Surefootedness::Human
            && matches!(self.motion.posture, Posture::Standing | Posture::Riding)
            && gravity >= WEIGHTLESS
    }

    /// Lets the centre of mass follow the feet; says whether they asked too much of the ground.
    pub(super) fn slips(&mut self, velocity: Vector2, around: &Surroundings<'_>, dt: f64) -> bool {
        let gravity = around.config().gravity;
        let asked = self.motion.balance.follow(velocity, dt);
        if !self.motion.grounded || !self.is_fallible(gravity) {
            return false;
        }
        let normal = self.plan.stand.normal;
        let friction = SOLES * self.plan.stand.grip * gravity * normal.z;
        // The part of gravity along the slope, which the ground has to hold too.
        let downhill = Vector3::new(0.0, 0.0, -gravity) + normal * (gravity * normal.z);
        let asked = asked + self.plan.effort;
        let asked = Vector3::new(asked.x, asked.y, 0.0) - downhill;
        self.motion.balance.traction = (friction - downhill.norm()).max(0.0);
        asked.norm() > friction
    }

    /// Whether the feet are stopped by something too high for a step that the trunk goes over, while it is too fast to recover.
    /// `missing` is the way that the feet were to go and did not, m.
    pub(super) fn trips(
        &self,
        missing: Vector2,
        at: &RapierPose,
        around: &Surroundings<'_>,
        queries: &QueryPipeline<'_>,
    ) -> bool {
        let gravity = around.config().gravity;
        if !self.motion.grounded || !self.is_fallible(gravity) {
            return false;
        }
        let Some(ahead) = missing.try_normalize(1e-4) else { return false };
        if self.motion.balance.momentum.dot(&ahead) <= self.recoverable_speed(gravity) {
            return false;
        }
        // The controller loses a substep before it takes a step; feet clear it without one.
        let clears = around.config().step_height + SKIN;
        let center = CENTER * self.height;
        let is_free = |span| self.is_free_ahead(ahead, span, at, queries);
        !is_free((clears, center)) && is_free((center, self.stature()))
    }

    /// Whether a part of the upright body, from one height to another, has free way ahead.
    fn is_free_ahead(
        &self,
        ahead: Vector2,
        (from, to): (f64, f64),
        at: &RapierPose,
        queries: &QueryPipeline<'_>,
    ) -> bool {
        let part = Cylinder::new((to - from) * 0.5, self.radius);
        let place = *at * RapierPose::from_parts(Vector::new(0.0, 0.0, (from + to) * 0.5), upright());
        let options = ShapeCastOptions {
            target_distance: SKIN * 0.5,
            stop_at_penetration: true,
            max_time_of_impact: OVERHANG,
            compute_impact_geometry_on_penetration: false,
        };
        queries.cast_shape(&place, Vector::new(ahead.x, ahead.y, 0.0), &part, options).is_none()
    }

    /// Whether something will run into it in this substep so hard that it does not recover: the speed that it would get is
    /// that of a plastic impact.
    pub(super) fn is_struck(
        &self,
        wish: &Vector3,
        at: &RapierPose,
        solid: &dyn Shape,
        around: &Surroundings<'_>,
        dt: f64,
    ) -> bool {
        let gravity = around.config().gravity;
        if !self.is_fallible(gravity) {
            return false;
        }
        let own = to_vector(&(wish / dt));
        let reach = solid.compute_local_bounding_sphere().radius + wish.norm() + SKIN;
        let here = Point2::new(at.translation.x, at.translation.y);
        let bodies = around.movers.near(here, reach).filter(|rigid| *rigid != around.rigid);
        bodies.filter_map(|rigid| around.physics.bodies.get(rigid)).any(|rigid| {
            rigid.colliders().iter().any(|handle| {
                let other = around.physics.colliders.get(*handle);
                other.is_some_and(|other| {
                    self.is_struck_by((*handle, other), rigid, (at, own, solid), gravity, dt)
                })
            })
        })
    }

    /// Whether one collider of a body does it.
    fn is_struck_by(
        &self,
        (handle, other): (ColliderHandle, &Collider),
        rigid: &RigidBody,
        (at, own, solid): (&RapierPose, Vector, &dyn Shape),
        gravity: f64,
        dt: f64,
    ) -> bool {
        let limit = self.recoverable_speed(gravity);
        let theirs = rigid.velocity_at_point(at.translation);
        if theirs.length() <= limit || self.motion.support == Some(handle) {
            return false;
        }
        let options = ShapeCastOptions {
            target_distance: SKIN * 0.5,
            stop_at_penetration: true,
            max_time_of_impact: dt,
            compute_impact_geometry_on_penetration: true,
        };
        let hit = cast_shapes(at, own, solid, other.position(), theirs, other.shape(), options);
        let Ok(Some(hit)) = hit else { return false };
        let normal = at.rotation * hit.normal1;
        let closing = -theirs.dot(normal);
        let mass = self.mass_beside(rigid.is_dynamic().then(|| rigid.mass()), other.user_data);
        closing * mass / (mass + self.laden_mass()) > limit
    }

    /// The mass of what runs into it, kg: what somebody else moves goes on as if it were heavy, unless it is a walker.
    fn mass_beside(&self, mass: Option<f64>, mark: u128) -> f64 {
        match mass {
            Some(mass) => mass,
            None if crate::shape::is_walker(mark) => self.mass,
            None => 1e9,
        }
    }
}

/// Of the way of a substep what feet asked of the ground: no more than they were told, and never backwards, for what solids do to
/// somebody they do by their faces and not by friction.
pub(super) fn own_way(way: Vector2, told: Vector2) -> Vector2 {
    let length = told.norm_squared();
    if length == 0.0 {
        return Vector2::zeros();
    }
    let share = way.dot(&told) / length;
    if (0.0..=1.0).contains(&share) && way.norm_squared() <= length {
        way
    } else {
        told * share.clamp(0.0, 1.0)
    }
}

/// What is under a point.
pub(super) struct Underfoot {
    pub(super) normal: Vector3,
    /// As a share of that of dry asphalt.
    pub(super) grip: f64,
    /// m.
    pub(super) height: f64,
}

/// Looks straight down for what somebody stands on.
pub(super) fn look_down(
    feet: Vector,
    reach: f64,
    around: &Surroundings<'_>,
    queries: &QueryPipeline<'_>,
) -> Option<Underfoot> {
    let ray = parry3d_f64::query::Ray::new(feet + Vector::new(0.0, 0.0, reach), -Vector::Z);
    let (handle, hit) = queries.cast_ray_and_get_normal(&ray, 2.0 * reach, true)?;
    let collider = around.physics.colliders.get(handle)?;
    let normal = from_vector(hit.normal);
    let grip = around.conditions().road.grip(crate::shape::material_of(collider.user_data));
    // From inside there is no normal.
    let height = feet.z + reach - hit.time_of_impact;
    (normal.z > 0.1).then_some(Underfoot { normal, grip, height })
}
