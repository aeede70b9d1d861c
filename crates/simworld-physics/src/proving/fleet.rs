//! Many cars at once, for measuring speed.

use simworld_core::action::Action;
use simworld_core::geometry::{Point3, Twist, Vector3, pose_facing};
use simworld_core::scene::{EntityDesc, EntityKind, Shape, World};
use simworld_core::seam::Dynamics;

use super::{ProvingError, STEP};
use crate::{PhysicsConfig, PhysicsDynamics, VehicleClass};

/// Sedans that circle side by side on the proving ground, all in motion.
pub struct Fleet {
    /// The world with the cars.
    pub world: World,
    /// Their physics.
    pub physics: PhysicsDynamics,
}

impl Fleet {
    /// So many cars at 30 m from one another, each on a circle of its own.
    ///
    /// # Errors
    /// The physics refuses a car.
    pub fn new(cars: usize) -> Result<Self, ProvingError> {
        let mut world = World::new();
        let config =
            PhysicsConfig { substeps: 1, parallel_threshold: usize::MAX, ..PhysicsConfig::default() };
        let mut physics = PhysicsDynamics::new(config)?;
        let row = (cars as f64).sqrt().ceil() as usize;
        for car in 0..cars {
            let place = Point3::new((car % row) as f64 * 30.0, (car / row) as f64 * 30.0, 0.0);
            let mut desc =
                EntityDesc::new(EntityKind::Car, pose_facing(place, 0.0), Shape::cuboid(4.3, 1.8, 1.5));
            desc.twist = Twist { linear: Vector3::x() * 6.0, angular: Vector3::zeros() };
            let id = world.spawn(desc)?;
            physics.add_vehicle(&world, id, VehicleClass::Sedan.parameters())?;
            world.actuate(id, Action::Steer { angle: 0.25 })?;
            world.actuate(id, Action::Throttle { level: 0.12 })?;
        }
        Ok(Self { world, physics })
    }

    /// One step of 1/60 s.
    ///
    /// # Errors
    /// The physics cannot go on.
    pub fn step(&mut self) -> Result<(), ProvingError> {
        self.world.begin_step();
        self.physics.step(&mut self.world, STEP)?;
        self.world.finish_step();
        Ok(())
    }

    /// Mean speed, m/s.
    pub fn mean_speed(&self) -> f64 {
        let speeds = self.world.iter().map(|car| car.twist.ground_speed());
        speeds.sum::<f64>() / self.world.len().max(1) as f64
    }
}
