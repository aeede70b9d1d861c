#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

pub mod action;
pub mod asset;
pub mod camera;
pub mod clock;
pub mod command;
pub mod environment;
pub mod evaluation;
pub mod event;
pub mod geometry;
pub mod hash;
pub mod id;
pub mod intent;
pub mod kinematic;
pub mod net;
pub mod ops;
pub mod patch;
pub mod record;
pub mod scene;
pub mod seam;
pub mod seed;
pub mod simulation;
#[cfg(feature = "testing")]
pub mod testing;
pub mod traffic;
pub mod value;
