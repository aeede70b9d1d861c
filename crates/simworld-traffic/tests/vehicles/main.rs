//! Vehicles on their lanes: following, changing, stopping, parking.
#![allow(clippy::unwrap_used, reason = "what fails in a helper fails the test")]

#[path = "../shared/at_once.rs"]
mod at_once;
mod buses_keep_their_stops;
mod busy_network_is_safe;
mod car_following;
#[path = "../shared/contacts.rs"]
mod contacts;
mod cycle_lanes_are_left_to_bicycles;
mod drivers_change_lanes;
mod drivers_of_all_kinds;
mod drivers_stop_for_others;
mod engineers_figures;
mod everybody_keeps_to_their_lanes;
mod far_from_interest;
mod houses_on_lanes;
mod kerb_to_kerb;
mod locks_are_undone;
mod near_junctions_are_one;
mod near_junctions_are_passed;
mod nobody_leaves_the_map;
mod obstacles_are_passed;
mod sirens_are_heard;
mod watching;
mod weather_slows_traffic;
