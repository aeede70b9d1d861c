//! Robots from files at work: an arm that reaches for places, and one on wheels that drives an eight.

mod picture;
mod portrait;
mod reach;
mod roll;

use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityDesc, EntityKind, Shape, World, WorldError};
use simworld_core::seam::{Dynamics, DynamicsError};
use simworld_physics::{PhysicsConfig, PhysicsDynamics, PhysicsError, Robot, RobotConfig, RobotError};
use thiserror::Error;

pub use picture::picture;
pub use reach::{ARM, Reach, reach};
pub use roll::{ROVER, Roll, roll};

/// Why a robot does not work.
#[derive(Debug, Error)]
pub enum RobotRunError {
    /// It is none.
    #[error(transparent)]
    Robot(#[from] RobotError),
    /// The physics refuses it.
    #[error(transparent)]
    Physics(#[from] PhysicsError),
    /// The world refuses it.
    #[error(transparent)]
    World(#[from] WorldError),
    /// It could not be stepped.
    #[error(transparent)]
    Step(#[from] DynamicsError),
    /// Something that the run needs and the robot has not.
    #[error("the robot has no {what} {name:?}: this run needs it")]
    Lacks {
        /// Joint or link.
        what: &'static str,
        /// Its name.
        name: &'static str,
    },
}

/// A robot alone on a plane.
pub struct Bench {
    world: World,
    physics: PhysicsDynamics,
    id: EntityId,
}

impl Bench {
    /// A robot at a place.
    ///
    /// # Errors
    /// It is no robot.
    pub fn new(config: RobotConfig, place: Point3) -> Result<Self, RobotRunError> {
        let mut world = World::new();
        let desc = EntityDesc::new(EntityKind::Robot, pose_facing(place, 0.0), Shape::cuboid(0.4, 0.4, 0.4));
        let id = world.spawn(desc)?;
        let mut physics = PhysicsDynamics::new(PhysicsConfig::default())?;
        physics.add_robot(&world, id, config)?;
        Ok(Self { world, physics, id })
    }

    /// The robot.
    ///
    /// # Panics
    /// Never: the entity was given the body of a robot.
    pub fn robot(&self) -> &Robot {
        self.physics.body_as(self.id).expect("the entity was given the body of a robot")
    }

    /// The robot, to be told something.
    ///
    /// # Panics
    /// Never: the entity was given the body of a robot.
    pub fn robot_mut(&mut self) -> &mut Robot {
        self.physics.body_as_mut(self.id).expect("the entity was given the body of a robot")
    }

    /// One step of `dt` s.
    ///
    /// # Errors
    /// The motion is no longer finite.
    pub fn step(&mut self, dt: f64) -> Result<(), RobotRunError> {
        self.world.begin_step();
        self.physics.step(&mut self.world, dt)?;
        self.world.finish_step();
        Ok(())
    }
}
