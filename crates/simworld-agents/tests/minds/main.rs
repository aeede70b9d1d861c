//! Minds and the models behind them: what they see, remember and say.
#![allow(clippy::unwrap_used, reason = "what fails in a helper fails the test")]

mod agents_see_what_is_in_sight;
#[path = "../shared/car_common/mod.rs"]
mod car_common;
mod eyes_steer;
#[path = "../shared/fault_server/mod.rs"]
mod fault_server;
mod injections_change_nothing;
mod memories_come_to_mind;
mod minds_think_and_act;
mod minds_think_through_llama_cpp;
mod model_keys_stay_secret;
#[path = "../shared/model_server/mod.rs"]
mod model_server;
mod models_speak_over_tls;
mod models_speak_through_llama_cpp;
mod models_survive_faults;
mod recordings_replay;
mod senses_keep_budgets;
#[path = "../shared/thought_common/mod.rs"]
mod thought_common;
