#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod apart;
mod bodies;
mod body;
mod cart;
mod cells;
mod claims;
mod config;
mod contact;
pub mod convert;
mod detail;
mod door;
mod dynamics;
mod error;
mod grasp;
mod ground;
mod hands;
mod humanoid;
mod joint;
mod mirror;
mod mounts;
mod movers;
pub mod proving;
mod quadruped;
mod query;
mod rigid;
mod roam;
pub mod robot;
mod roster;
mod shape;
mod slot_set;
mod snapshot;
mod solid;
mod stream;
mod surface;
mod sync;
mod throw;
mod vehicle;

pub use body::{BodyContext, Bonds, Detail, PhysicsBody, Surroundings};
pub use cart::{Cart, CartConfig, Castors};
pub use claims::Claim;
pub use config::PhysicsConfig;
pub use door::{Door, DoorConfig, HingeSide, Latch};
pub use dynamics::PhysicsDynamics;
pub use error::PhysicsError;
pub use grasp::{Grip, Turning};
pub use humanoid::{ColliderForm, Humanoid, HumanoidConfig, Posture, Surefootedness};
pub use joint::{JointCommand, JointReading};
pub use quadruped::{
    Command, GaitParameters, ImuReading, LEGS, Quadruped, QuadrupedConfig, QuadrupedControl, QuadrupedModel,
    QuadrupedState, Readings,
};
/// The physics engine underneath, for bodies of one's own: its types appear in [`PhysicsBody`].
pub use rapier3d_f64 as rapier;
pub use rigid::Rigid;
pub use robot::{Robot, RobotConfig, RobotDescription, RobotError};
pub use shape::{BodyTag, collider_for, shape_from};
pub use simworld_core::asset::Material;
pub use surface::{Conditions, RoadCondition};
pub use vehicle::{
    AxleParameters, BalanceParameters, BrakeParameters, ChassisParameters, Drive, PatchForce, Powertrain,
    SingleTrackInput, SingleTrackParameters, SingleTrackState, SlipControl, SteeringParameters,
    TyreParameters, Vehicle, VehicleClass, VehicleParameters,
};
