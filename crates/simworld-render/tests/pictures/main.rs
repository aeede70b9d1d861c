//! What is drawn: colour, depth, ids, files, and the same pixels every time.
#![allow(clippy::unwrap_used, reason = "what fails in a helper fails the test")]

mod arrays_and_photos_say_what_was_seen;
mod backends_agree;
mod bad_input_is_refused;
mod batches_are_their_views;
mod bodies_are_drawn_where_they_are;
mod boxes_hold_what_is_seen;
mod bumps_follow_tangents;
mod common;
mod cutouts;
mod depth_is_exact;
mod files_hold_the_frame;
mod films;
mod flow_is_the_motion_that_is_known;
mod golden;
mod ids_and_classes_name_what_is_there;
mod levels_change_little;
mod light_and_weather;
mod light_in_pictures;
mod look;
mod maps_have_one_scale;
mod memory_runs_out;
mod models_are_drawn;
mod models_move;
mod models_take_light;
mod normals_are_those_of_the_solids;
mod only_changes_are_sent;
mod pictures_on_models;
mod pictures_repeat;
mod pixels_follow_the_camera;
mod scans_meet_the_solids;
mod sensors_conform;
mod streets_are_painted_by_their_lanes;
mod two_sides;
mod who_culls_changes_nothing;
mod who_is_dressed_changes_nothing;
