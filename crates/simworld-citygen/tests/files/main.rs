//! Files of cities: saved, drawn, and in the formats of others.
#![allow(clippy::unwrap_used, reason = "what fails in a helper fails the test")]

mod cities_are_saved_whole;
mod files_keep_their_form;
mod geojson_is_valid;
mod glb_is_valid;
mod heights_reach_the_files;
mod maps_are_sheets;
mod opendrive_comes_back;
mod opendrive_has_heights;
mod opendrive_is_valid;
mod opendrive_lanes_lead_on;
mod python_layouts_come_back;
mod python_worlds_come_back;
mod sumo_reads_the_roads;
