//! What moves through whole cities: traffic by the day, drivers of the agents', edits of a city at work, and files through SUMO; and
//! scenes that are written by hand.
#![allow(clippy::unwrap_used, reason = "what fails in a helper fails the test")]

mod a_running_city_is_edited_by_words;
mod bridges_bear_traffic;
mod cities_go_through_sumo;
mod drivers_drive;
mod edits_keep_to_the_land;
mod edits_take_effect;
mod scenes_by_hand;
mod town;
mod traffic_is_safe;
mod traffic_keeps_flowing;
mod trips_end_at_the_kerb;
