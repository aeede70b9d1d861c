//! People on foot, alone and in crowds.
#![allow(clippy::unwrap_used, reason = "what fails in a helper fails the test")]

#[path = "../shared/at_once.rs"]
mod at_once;
mod crowds_walk_as_measured;
mod footbridges_are_above_the_street;
mod people_of_a_city;
mod people_on_plazas;
mod rimea;
mod walkers_mind_the_signals;
