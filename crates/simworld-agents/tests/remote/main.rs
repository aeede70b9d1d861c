//! The remote interface: both protocols, its limits, and its recordings.
#![allow(clippy::unwrap_used, reason = "what fails in a helper fails the test")]

#[path = "../shared/car_common/mod.rs"]
mod car_common;
#[path = "../shared/remote_common/mod.rs"]
mod remote_common;
mod remote_keeps_its_limits;
mod remote_sessions_replay;
mod remote_speaks_its_types;
mod remote_speaks_unrealcv;
