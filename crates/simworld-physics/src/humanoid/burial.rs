//! Who is pressed through the ground comes up again.
//!
//! A height field is a skin without a thickness: what heavy things press through it would fall for good, where level ground, which is
//! solid, lets it out again.

use rapier3d_f64::math::Vector;
use rapier3d_f64::prelude::{PhysicsWorld, RigidBodyHandle};
use simworld_core::geometry::Point2;

use super::Humanoid;
use crate::body::Surroundings;
use crate::ground::height_at;

/// How far above the ground the lowest limb then is, by its middle, m.
const CLEAR: f64 = 0.1;

impl Humanoid {
    /// Notes how far all of it has to be lifted, if the middle of its trunk is under the ground.
    pub(super) fn look_for_ground(&mut self, around: &Surroundings<'_>) {
        let (Some(surface), Some(limbs)) = (around.surface(), self.motion.recovery.limbs()) else { return };
        let depth = |handle: RigidBodyHandle| {
            let middle = around.physics.bodies.get(handle)?.center_of_mass();
            Some(height_at(surface, Point2::new(middle.x, middle.y))? - middle.z)
        };
        if depth(around.rigid).is_some_and(|depth| depth > 0.0) {
            let depths = std::iter::once(&around.rigid).chain(limbs.limbs()).filter_map(|limb| depth(*limb));
            self.plan.lift = depths.reduce(f64::max).map(|deepest| deepest + CLEAR);
        }
    }

    /// Lifts all of it out of the ground, where it then lies still.
    pub(super) fn come_up(&mut self, physics: &mut PhysicsWorld, trunk: RigidBodyHandle) {
        let (Some(lift), Some(limbs)) = (self.plan.lift.take(), self.motion.recovery.limbs()) else { return };
        for handle in std::iter::once(&trunk).chain(limbs.limbs()) {
            if let Some(rigid) = physics.bodies.get_mut(*handle) {
                rigid.set_translation(rigid.translation() + Vector::new(0.0, 0.0, lift), true);
                rigid.set_linvel(Vector::ZERO, true);
                rigid.set_angvel(Vector::ZERO, true);
            }
        }
    }
}
