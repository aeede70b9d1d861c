//! The delivery economy as its example plays it: the same bits, by bodies, from prompts, resumed, reported.
#![allow(clippy::unwrap_used, reason = "what fails in a helper fails the test")]

mod delivery_is_deterministic;
mod delivery_is_physical;
mod delivery_reads_its_prompt;
mod delivery_takes_bad_input;
mod effort_follows_bodies;
mod experiments_resume;
mod reports_open;
