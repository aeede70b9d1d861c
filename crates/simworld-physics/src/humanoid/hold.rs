//! Walking with something in the hands that is pushed or pulled.
//!
//! Feet go where they are told at once, but arms ask no more of a thing than the strength of who walks: the feet then go only as
//! fast as that strength moves the thing, and are drawn along by what is stronger.

use nalgebra::UnitQuaternion;
use rapier3d_f64::prelude::RigidBodyHandle;
use simworld_core::geometry::{Vector2, Vector3};

use super::Humanoid;
use super::balance::CARE;
use crate::body::Surroundings;
use crate::grasp::Hold;

/// Who holds something turns no faster than this, rad/s: it goes round with it on the arc of a slow step.
pub(super) const TURN: f64 = 0.8;
/// Who turns a thing with both hands turns no farther ahead of it, radians.
const LEAD: f64 = 0.1;

/// How far it turns, radians, of what it wishes: no farther ahead of what its hands turn than they give way in the middle.
pub(super) fn turned_with(holds: &[Hold], wish: f64) -> f64 {
    let within = |wish: f64, hold: &Hold| {
        // It never turns back for that.
        let (back, ahead) = ((-LEAD - hold.twist).min(0.0), (LEAD - hold.twist).max(0.0));
        wish.clamp(back, ahead)
    };
    holds.iter().filter(|hold| hold.turns).fold(wish, within)
}

/// What hangs on hands of what they hold, as a mass, kg, where things are this heavy, m/s²: by how far the springs have given way.
pub(super) fn hung(holds: &[Hold], gravity: f64) -> f64 {
    let force: f64 = holds.iter().map(|hold| hold.stiffness * hold.gap.z.max(0.0)).sum();
    if gravity > 0.0 { force / gravity } else { 0.0 }
}

impl Humanoid {
    /// Whether it holds a body, and so does not push it as something in the way.
    pub(super) fn has_hold_of(rigid: Option<RigidBodyHandle>, around: &Surroundings<'_>) -> bool {
        around.holds.iter().any(|hold| Some(hold.held) == rigid)
    }

    /// Holds a wish back, world frame, m, to what its strength allows; it has turned by `turned` radians. Notes what that asks of
    /// the ground.
    pub(super) fn lean(&mut self, wish: Vector3, turned: f64, around: &Surroundings<'_>, dt: f64) -> Vector3 {
        self.plan.effort = Vector2::zeros();
        let mut strength = self.config.push_force;
        if self.motion.balance.is_careful {
            strength = strength.min(CARE * self.motion.balance.traction * self.laden_mass());
        }
        let mut wish = wish;
        for hold in around.holds {
            let (given, force) = self.lead(hold, wish.xy() / dt, turned, strength, dt);
            wish = Vector3::new(given.x * dt, given.y * dt, wish.z);
            self.plan.effort += force / self.laden_mass();
        }
        wish
    }

    /// The velocity of the feet nearest to the wish at which one thing asks no more than `strength`, m/s, and what it then asks, N.
    fn lead(&self, hold: &Hold, wish: Vector2, turned: f64, strength: f64, dt: f64) -> (Vector2, Vector2) {
        let arm = hold.hand - self.feet().coords;
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), turned);
        let swing = (turn * arm - arm).xy() / dt;
        // The thing goes on as it did, within what the hands can have done to it.
        let most = strength / hold.mass * dt;
        let change = hold.change.xy();
        let change = change * (most / change.norm().max(most.max(1e-12)));
        let held = hold.velocity.xy() + change * hold.middle;
        let spring = hold.gap.xy() * hold.stiffness;
        let firmness = hold.stiffness * dt * hold.middle + hold.damping;
        let force = spring + (wish + swing - held) * firmness;
        let asked = force.norm();
        if asked <= strength {
            return (wish, force);
        }
        let force = force * (strength / asked);
        let feet = held + (force - spring) / firmness - swing;
        let top = self.config.top_speed.max(wish.norm());
        (feet * (top / feet.norm().max(top)), force)
    }
}
