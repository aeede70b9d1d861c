//! The delivery economy: its books, its couriers, and how they think.
#![allow(clippy::unwrap_used, reason = "what fails in a helper fails the test")]

mod couriers_think;
mod delivery_books;
mod delivery_common;
mod delivery_effort;
mod delivery_life;
#[path = "../shared/thought_common/mod.rs"]
mod thought_common;
