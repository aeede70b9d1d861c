//! Worlds: commands, interactions, replays, and the seams' own checks.
#![allow(clippy::unwrap_used, reason = "what fails in a helper fails the test")]

mod broken_environments_are_caught;
mod commands_keep_their_promises;
mod common;
mod interactions_have_preconditions;
mod people_deal_with_doors_and_each_other;
mod relations_are_between_walls;
mod replays_take_the_same_way;
mod seams_conform;
mod snapshots_go_on;
