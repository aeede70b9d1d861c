//! Cities that are grown, whatever the seed, and what is changed in them.
#![allow(clippy::unwrap_used, reason = "what fails in a helper fails the test")]

mod a_city_becomes_a_world;
mod bad_input_is_named;
mod blocks_are_divided_into_lots;
mod buses_pass_in_bends;
mod cities_are_built_up;
mod dead_ends_have_hammerheads;
mod edits_equal_regeneration;
mod elements_leave_the_way_free;
mod every_place_can_be_walked_to;
mod every_seed_gives_a_sound_city;
mod graph_edits_equal_rebuilds;
mod graphs_are_planar;
mod odd_streets_are_built_along;
mod outskirts_are_built_up;
mod same_seed_same_city;
mod streets_are_graded;
mod streets_have_names;
mod styles_lie_in_their_bands;
mod threads_do_not_matter;
mod turns_keep_to_the_carriageway;
mod worlds_follow_edits;
