//! Throwing: what a hand held flies.
//!
//! An arm gives a throw about the same energy whatever is thrown: that of the thing, the hand and the forearm together (Cross, American
//! Journal of Physics 72, 305, 2004). From 57 g to 3.4 kg, sixty times as much, the speed there falls by a factor of 2.4, which makes the
//! hand and forearm as slow to move as 0.64 kg that is thrown along.

use simworld_core::event::EventKind;
use simworld_core::geometry::{Point3, Pose, Twist, Vector3};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityRef, MOST_THROWN, Role, Scene, World};

use crate::error::check_range;
use crate::rigid::mass_of;
use crate::{Humanoid, HumanoidConfig, PhysicsDynamics, PhysicsError};

/// So far from the thrower's own form the thing leaves the hand, m.
const CLEAR: f64 = 0.05;
/// What is thrown along of hand and forearm, kg.
const ARM: f64 = 0.64;
/// How often the aim is corrected for the way that the target goes meanwhile.
const CORRECTIONS: usize = 4;

/// Somebody with something in hand.
struct Throw<'a> {
    thrower: EntityRef<'a>,
    thing: EntityRef<'a>,
    /// What the arm gives, J.
    energy: f64,
    /// m/s².
    gravity: f64,
}

impl Throw<'_> {
    /// The greatest speed that the arm gives the thing, m/s.
    fn most(&self) -> f64 {
        (2.0 * self.energy / (mass_of(&self.thing) + ARM)).sqrt().min(MOST_THROWN)
    }

    /// Where the thing leaves the hand: at its height, beside the thrower's form, ahead.
    fn release(&self, ahead: &Vector3) -> Point3 {
        let sizes = [self.thrower.info.shape.size(), self.thing.info.shape.size()];
        let clear = CLEAR + 0.5 * (sizes[0].xy().norm() + sizes[1].norm());
        let (middle, place) = (self.thrower.pose.translation.vector, self.thing.pose.translation.vector);
        let out = (place - middle).dot(ahead).max(clear);
        Point3::new(middle.x + ahead.x * out, middle.y + ahead.y * out, place.z)
    }

    /// Whether the thing leaves the hand outside of a target.
    fn is_clear_of(&self, target: &EntityRef<'_>, release: &Point3) -> bool {
        let gap = target.info.shape.planar_distance(target.pose, &release.xy());
        gap > 0.5 * self.thing.info.shape.size().xy().norm()
    }

    /// Level, where a throw goes; ahead of the thrower if it goes straight up.
    fn ahead(&self, way: &Vector3) -> Vector3 {
        let heading = self.thrower.pose.rotation * Vector3::x();
        Vector3::new(way.x, way.y, 0.0).try_normalize(1e-6).unwrap_or(heading)
    }

    /// The velocity relative to the thrower with which the thing comes down on the middle of a target that goes on as it does: the
    /// least that gets there, v² = g (h + √(h² + d²)) for h up and d away, or straight at it where nothing falls. None from so near that the thing
    /// would leave the hand in it or behind it.
    fn aim(&self, target: &EntityRef<'_>) -> Option<Vector3> {
        let middle = |entity: &EntityRef<'_>| entity.bounds.center().coords;
        let lift = Vector3::z() * (middle(&self.thing).z - self.thing.pose.translation.z);
        let mut goal = middle(target);
        let mut velocity = Vector3::zeros();
        for _ in 0..=CORRECTIONS {
            let ahead = self.ahead(&(goal - self.thrower.pose.translation.vector));
            let way = goal - (self.release(&ahead).coords + lift);
            let (away, up) = (way.dot(&ahead), way.z);
            if away <= 0.0 || !self.is_clear_of(target, &self.release(&ahead)) {
                return None;
            }
            let least = self.gravity * (up + (up * up + away * away).sqrt());
            let time = if least > 1e-9 {
                // The steepness of the least throw: tan = v² / (g d).
                let rise = least / (self.gravity * away);
                let level = (least / (1.0 + rise * rise)).sqrt();
                velocity = ahead * level + Vector3::z() * (level * rise);
                away / level
            } else {
                velocity = way.normalize() * self.most();
                way.norm() / self.most().max(1e-9)
            };
            goal = middle(target) + target.twist.linear * time;
        }
        Some(velocity - self.thrower.twist.linear)
    }
}

impl PhysicsDynamics {
    /// Throws what somebody holds in the hand or with both arms, with a velocity relative to the thrower, m/s, world frame, of at
    /// most 60 m/s and what the arm gives ([`HumanoidConfig::throw_energy`]). From then on the thing is a free rigid body, which can be picked up again. It leaves the hand at its
    /// height, beside the thrower's form, in the direction of the throw. `Thrown` tells of it.
    ///
    /// [`Action::Throw`](simworld_core::action::Action::Throw) says the same as a command, which recordings know; of this call they do
    /// not, so who replays a run calls it again, between the same steps.
    ///
    /// # Errors
    /// An unknown entity, one that holds nothing, a velocity out of range, or more than the arm gives.
    pub fn throw(
        &mut self,
        world: &mut World,
        who: EntityId,
        velocity: Vector3,
    ) -> Result<EntityId, PhysicsError> {
        let speed = velocity.norm();
        check_range("throw", "velocity", speed, 0.0..=MOST_THROWN, "at most 60 m/s")?;
        let throw = self.readied(world, who)?;
        let (item, most) = (throw.thing.id, throw.most());
        if speed > most {
            return Err(PhysicsError::Weak { who, item, mass: mass_of(&throw.thing), speed, most });
        }
        let place = throw.release(&throw.ahead(&velocity));
        let pose = Pose::from_parts(place.into(), throw.thing.pose.rotation);
        let twist = Twist { linear: throw.thrower.twist.linear + velocity, angular: Vector3::zeros() };
        world.reset(item, pose, twist, None)?;
        if self.body(item).is_none() {
            self.add_rigid(world, item)?;
            self.mark_adopted(item);
        }
        world.emit(EventKind::Thrown { who, item, velocity: twist.linear });
        Ok(item)
    }

    /// Throws what somebody holds at the middle of something else, with the least velocity that gets there, and ahead of it if it
    /// moves. Nothing in between is looked for, and nobody catches it. As [`throw`](Self::throw) otherwise; the command is
    /// [`Action::ThrowTo`](simworld_core::action::Action::ThrowTo).
    ///
    /// # Errors
    /// As [`throw`](Self::throw), or a target that is too near.
    pub fn throw_to(
        &mut self,
        world: &mut World,
        who: EntityId,
        to: EntityId,
    ) -> Result<EntityId, PhysicsError> {
        let target = world.entity(to).ok_or(PhysicsError::Missing { id: to })?;
        let velocity = self.readied(world, who)?.aim(&target).ok_or(PhysicsError::TooNear { who, to })?;
        self.throw(world, who, velocity)
    }

    /// Who throws what, with which arm.
    fn readied<'a>(&self, world: &'a World, who: EntityId) -> Result<Throw<'a>, PhysicsError> {
        let thrower = world.entity(who).ok_or(PhysicsError::Missing { id: who })?;
        let held = [Role::Held, Role::Carried].into_iter().find_map(|role| world.attached(who, role));
        let id = held.ok_or(PhysicsError::EmptyHanded { id: who })?;
        let thing = world.entity(id).ok_or(PhysicsError::Missing { id })?;
        let own = self.body_as::<Humanoid>(who).map(Humanoid::throw_energy);
        let energy = own.unwrap_or_else(|| HumanoidConfig::default().throw_energy);
        Ok(Throw { thrower, thing, energy, gravity: self.config.gravity })
    }
}
