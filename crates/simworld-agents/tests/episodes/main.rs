//! Episodes: lockstep, own pace, the Gym's contract, many at once.
#![allow(clippy::unwrap_used, reason = "what fails in a helper fails the test")]

mod episode_common;
mod episodes_are_saved;
mod episodes_as_gym;
mod episodes_end_with_faults;
mod episodes_replay;
mod episodes_run_in_lockstep;
#[path = "../shared/fault_server/mod.rs"]
mod fault_server;
mod gym_common;
mod many_environments;
mod minds_at_their_own_pace;
mod wrappers_keep_their_laws;
