//! Real places, from extracts of OpenStreetMap.
#![allow(clippy::unwrap_used, reason = "what fails in a helper fails the test")]

mod bridges_clear_what_they_cross;
mod drawn_streets_become_junctions;
mod footbridges_and_subways;
mod footbridges_are_built;
mod hostile_extracts_are_survived;
mod junctions_of_real_places_are_sound;
mod lanes_come_back_from_opendrive;
#[cfg(feature = "osm")]
mod osm_common;
mod real_places_become_cities;
mod squares_with_holes;
mod tags_become_lanes;
mod turns_are_those_of_the_map;
mod ways_for_walkers;
