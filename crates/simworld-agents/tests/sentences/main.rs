//! What people say, and what becomes of it: the grammar, plans, and language models that plan.
#![allow(clippy::unwrap_used, reason = "what fails in a helper fails the test")]

mod executor_common;
mod models_answers_are_checked;
mod models_plan_like_the_grammar;
mod plans_have_blocks;
mod sentences_are_carried_out;
mod sentences_are_scored;
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
