//! Many robot dogs at once, for measuring speed, and one for looking at its gait.

use simworld_core::action::Action;
use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityDesc, EntityKind, Shape, World};
use simworld_core::seam::Dynamics;

use super::ProvingError;
use crate::{PhysicsConfig, PhysicsDynamics, Quadruped, QuadrupedConfig};

/// The step in which the gait is looked at, s: a substep of a robot dog on its legs.
const LOOK: f64 = 1.0 / 200.0;

/// Robot dogs on their legs that trot side by side on asphalt.
pub struct Pack {
    /// The world with the dogs.
    pub world: World,
    /// Their physics.
    pub physics: PhysicsDynamics,
    /// The dogs.
    pub dogs: Vec<EntityId>,
}

/// A moment of a gait.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stance {
    /// Since the beginning, s.
    pub time: f64,
    /// Force of the ground on each foot, N, as [`LEGS`](crate::LEGS) has them.
    pub feet: [f64; 4],
    /// Height of the trunk over the ground under its feet, m.
    pub height: f64,
}

impl Pack {
    /// So many dogs at 2 m from one another that were told to trot at a speed, m/s.
    ///
    /// # Errors
    /// The physics refuses a dog.
    pub fn new(dogs: usize, speed: f64) -> Result<Self, ProvingError> {
        let mut world = World::new();
        let mut physics = PhysicsDynamics::new(PhysicsConfig { substeps: 1, ..PhysicsConfig::default() })?;
        let mut all = Vec::with_capacity(dogs);
        for dog in 0..dogs {
            let pose = pose_facing(Point3::new(0.0, 2.0 * dog as f64, 0.0), 0.0);
            let id = world.spawn(EntityDesc::new(EntityKind::Dog, pose, Shape::cuboid(0.7, 0.35, 0.5)))?;
            physics.add_quadruped(&world, id, QuadrupedConfig::default())?;
            world.actuate(id, Action::MoveForward { speed })?;
            all.push(id);
        }
        Ok(Self { world, physics, dogs: all })
    }

    /// One step of `dt` s.
    ///
    /// # Errors
    /// The physics cannot go on.
    pub fn step(&mut self, dt: f64) -> Result<(), ProvingError> {
        self.world.begin_step();
        self.physics.step(&mut self.world, dt)?;
        self.world.finish_step();
        Ok(())
    }

    /// How the first dog moves for some time from now on, s, in every substep.
    ///
    /// # Errors
    /// The physics cannot go on.
    pub fn watch(&mut self, seconds: f64) -> Result<Vec<Stance>, ProvingError> {
        let looks = (seconds / LOOK).round().max(0.0) as usize;
        let mut seen = Vec::with_capacity(looks);
        for look in 0..looks {
            self.step(LOOK)?;
            let body = self.dogs.first().and_then(|dog| self.physics.body_as::<Quadruped>(*dog));
            let Some(body) = body else { break };
            let (feet, height) = (body.readings().feet, body.trunk_height());
            seen.push(Stance { time: look as f64 * LOOK, feet, height });
        }
        Ok(seen)
    }
}
