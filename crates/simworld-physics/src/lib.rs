#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod bodies;
mod body;
mod config;
mod contact;
pub mod convert;
mod dynamics;
mod error;
mod humanoid;
mod mirror;
mod query;
mod rigid;
mod shape;
mod snapshot;
mod sync;
mod vehicle;

pub use body::{BodyContext, Bonds, Claim, PhysicsBody, Surroundings};
pub use config::PhysicsConfig;
pub use dynamics::PhysicsDynamics;
pub use error::PhysicsError;
pub use humanoid::{ColliderForm, Humanoid, HumanoidConfig, Posture};
/// The physics engine underneath, for bodies of one's own: its types appear in [`PhysicsBody`].
pub use rapier3d_f64 as rapier;
pub use rigid::Rigid;
pub use shape::{BodyTag, collider_for, shape_from};
pub use vehicle::{Vehicle, VehicleConfig};
