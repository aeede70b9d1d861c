//! A proving ground: drives a vehicle through the standard manoeuvres and measures it.
//!
//! The ground is a level plane of asphalt without end. [`measure`] puts the figures of a class of vehicles beside the
//! bands that data sheets, regulations and road tests give; a vehicle of your own is measured by the same manoeuvres.
//! [`Pack`] lets robot dogs trot there.

mod bands;
mod fleet;
mod manoeuvre;
mod pack;

pub use bands::{Figure, measure};
pub use fleet::Fleet;
pub use manoeuvre::{
    LaneChange, SteadyTurn, acceleration_time, braking_distance, lane_change, lateral_limit, steady_turn,
    top_speed,
};
pub use pack::{Pack, Stance};

use simworld_core::action::Action;
use simworld_core::environment::Environment;
use simworld_core::geometry::{Point3, Twist, Vector3, pose_facing, yaw_of};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityDesc, EntityKind, Shape, World};
use simworld_core::seam::Dynamics;

use crate::{PhysicsConfig, PhysicsDynamics, RoadCondition, VehicleParameters};

/// Why a run came to nothing.
pub type ProvingError = Box<dyn std::error::Error + Send + Sync>;

/// The step of all manoeuvres, s.
pub const STEP: f64 = 1.0 / 60.0;

/// A vehicle alone on the proving ground, driven eastward from the origin.
pub struct Run {
    /// The world with the vehicle.
    pub world: World,
    /// Its physics.
    pub physics: PhysicsDynamics,
    /// The vehicle.
    pub vehicle: EntityId,
}

impl Run {
    /// A vehicle that rolls at a speed, m/s, on a road in a condition.
    ///
    /// # Errors
    /// A setting of the vehicle out of range.
    pub fn new(
        parameters: &VehicleParameters,
        road: RoadCondition,
        speed: f64,
    ) -> Result<Self, ProvingError> {
        let mut world = World::new();
        world.set_environment(weather(road))?;
        let chassis = &parameters.chassis;
        let shape = Shape::cuboid(chassis.length, chassis.width, chassis.height);
        let mut desc = EntityDesc::new(EntityKind::Car, pose_facing(Point3::origin(), 0.0), shape);
        desc.twist = Twist { linear: Vector3::x() * speed, angular: Vector3::zeros() };
        let vehicle = world.spawn(desc)?;
        let mut physics = PhysicsDynamics::new(PhysicsConfig { substeps: 1, ..PhysicsConfig::default() })?;
        physics.add_vehicle(&world, vehicle, parameters.clone())?;
        Ok(Self { world, physics, vehicle })
    }

    /// Tells the driver something.
    ///
    /// # Errors
    /// The world refuses the command.
    pub fn tell(&mut self, action: Action) -> Result<(), ProvingError> {
        Ok(self.world.actuate(self.vehicle, action)?)
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

    /// Steps for a time, s.
    ///
    /// # Errors
    /// The physics cannot go on.
    pub fn coast(&mut self, time: f64) -> Result<(), ProvingError> {
        (0..(time / STEP).round() as usize).try_for_each(|_| self.step())
    }

    fn state(&self) -> simworld_core::seam::BodyState {
        self.physics.state(self.vehicle).expect("the vehicle has had its body since the run began")
    }

    /// Where the vehicle is, m.
    pub fn position(&self) -> Point3 {
        self.state().pose.translation.vector.into()
    }

    /// Speed over ground, m/s.
    pub fn speed(&self) -> f64 {
        self.state().twist.ground_speed()
    }

    /// rad/s, positive to the left.
    pub fn yaw_rate(&self) -> f64 {
        self.state().twist.angular.z
    }

    /// Radians counter-clockwise from east.
    pub fn yaw(&self) -> f64 {
        yaw_of(&self.state().pose)
    }

    /// Angle between the vehicle's up and the vertical, radians.
    pub fn tilt(&self) -> f64 {
        let up = self.state().pose.rotation * Vector3::z();
        simworld_core::ops::acos(up.z.clamp(-1.0, 1.0))
    }

    /// Holds a speed with throttle and brake.
    ///
    /// # Errors
    /// The world refuses the command.
    pub fn hold_speed(&mut self, speed: f64) -> Result<(), ProvingError> {
        let short = speed - self.speed();
        if short < -1.0 {
            return self.tell(Action::Brake { level: (-0.1 * short).clamp(0.0, 0.3) });
        }
        self.tell(Action::Throttle { level: (0.2 + 0.5 * short).clamp(0.0, 1.0) })
    }
}

/// A weather that brings about a condition of the road.
fn weather(road: RoadCondition) -> Environment {
    let mut environment = Environment::default();
    let weather = &mut environment.weather;
    (weather.rain, weather.snow, weather.temperature) = match road {
        RoadCondition::Dry => (0.0, 0.0, 15.0),
        RoadCondition::Wet => (5.0, 0.0, 10.0),
        RoadCondition::Snow => (0.0, 2.0, -5.0),
        RoadCondition::Ice => (1.0, 0.0, -3.0),
    };
    environment
}
