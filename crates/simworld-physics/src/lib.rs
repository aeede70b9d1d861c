#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod bodies;
mod body;
mod cells;
mod claims;
mod config;
mod contact;
pub mod convert;
mod detail;
mod dynamics;
mod error;
mod ground;
mod humanoid;
mod mirror;
pub mod proving;
mod quadruped;
mod query;
mod rigid;
mod shape;
mod snapshot;
mod solid;
mod surface;
mod sync;
mod vehicle;

pub use body::{BodyContext, Bonds, Detail, PhysicsBody, Surroundings};
pub use claims::Claim;
pub use config::PhysicsConfig;
pub use dynamics::PhysicsDynamics;
pub use error::PhysicsError;
pub use humanoid::{ColliderForm, Humanoid, HumanoidConfig, Posture, Surefootedness};
pub use quadruped::{
    Command, GaitParameters, ImuReading, JointCommand, JointReading, LEGS, Quadruped, QuadrupedConfig,
    QuadrupedModel, Readings,
};
/// The physics engine underneath, for bodies of one's own: its types appear in [`PhysicsBody`].
pub use rapier3d_f64 as rapier;
pub use rigid::Rigid;
pub use shape::{BodyTag, collider_for, shape_from};
pub use simworld_core::asset::Material;
pub use surface::{Conditions, RoadCondition};
pub use vehicle::{
    AxleParameters, BalanceParameters, BrakeParameters, ChassisParameters, Drive, PatchForce, Powertrain,
    SingleTrackInput, SingleTrackParameters, SingleTrackState, SlipControl, SteeringParameters,
    TyreParameters, Vehicle, VehicleClass, VehicleParameters,
};
