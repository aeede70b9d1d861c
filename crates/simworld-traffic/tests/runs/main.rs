//! Whole runs: demand, routes, signals, orders from outside, snapshots, and what is written of them.
#![allow(clippy::unwrap_used, reason = "what fails in a helper fails the test")]

mod assignment_finds_equilibria;
mod closed_roads_are_driven_around;
#[path = "../shared/contacts.rs"]
mod contacts;
mod damaged_snapshots;
mod demand_departs_as_asked;
mod hierarchy_is_as_quick;
mod impossible_input_harms_nobody;
mod lent_threads;
mod orders_are_replayed;
mod others_take_over;
mod outputs_add_up;
mod passing_is_the_same_every_time;
mod pictures_tell_the_truth;
mod same_bits_every_time;
mod signals_keep_their_word;
mod signals_learn;
mod slow_streets_are_left;
mod streets_are_closed;
mod threads_do_not_matter;
mod traffic_comes_and_goes;
