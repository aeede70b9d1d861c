//! Episodes: lockstep, own pace, the Gym's contract, many at once.
#![allow(clippy::unwrap_used, reason = "what fails in a helper fails the test")]

mod episode_common;
mod episodes_are_saved;
mod episodes_as_gym;
mod episodes_end_with_faults;
mod episodes_keep_the_contract;
mod episodes_replay;
mod episodes_run_in_lockstep;
mod episodes_tell_how_plans_go;
#[path = "../shared/fault_server/mod.rs"]
mod fault_server;
mod gym_common;
mod many_environments;
mod minds_at_their_own_pace;
mod minds_plan_and_act_themselves;
mod wrappers_keep_their_laws;
