//! What asks the heap for nothing, counted by an allocator of its own.
#![allow(clippy::unwrap_used, reason = "what fails in a helper fails the test")]

mod counting;
mod crowds_allocate_nothing;
mod steps_allocate_nothing;
