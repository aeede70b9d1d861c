//! What people say, and what becomes of it: the grammar, plans, and language models that plan.
#![allow(clippy::unwrap_used, reason = "what fails in a helper fails the test")]

mod executor_common;
#[path = "../shared/model_server/mod.rs"]
mod model_server;
mod models_answers_are_checked;
mod models_know_what_is_in_view;
mod models_plan_like_the_grammar;
mod models_plan_through_llama_cpp;
mod plans_have_blocks;
mod sentences_are_carried_out;
mod sentences_are_scored;
mod sentences_come_true;
mod sentences_common;
mod sentences_compose;
mod sentences_have_effects;
mod sentences_mean_what_they_say;
mod sentences_take_up_what_was_said;
#[path = "../shared/tables.rs"]
mod tables;
#[path = "../shared/thought_common/mod.rs"]
mod thought_common;
mod walkers_cross_on_walk;
mod walkers_get_round_things;
mod walkers_meet_what_comes;
