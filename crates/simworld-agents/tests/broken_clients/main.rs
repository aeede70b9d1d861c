//! A thousand broken clients: a process of its own, since its threads, sockets and memory are counted.
#![allow(clippy::unwrap_used, reason = "what fails in a helper fails the test")]

#[path = "../shared/car_common/mod.rs"]
mod car_common;
mod counting;
#[path = "../shared/remote_common/mod.rs"]
mod remote_common;
mod remote_withstands_clients;
