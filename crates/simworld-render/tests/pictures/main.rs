//! What is drawn: colour, depth, ids, files, and the same pixels every time.
#![allow(clippy::unwrap_used, reason = "what fails in a helper fails the test")]

mod bad_input_is_refused;
mod batches_are_their_views;
mod common;
mod depth_is_exact;
mod files_hold_the_frame;
mod golden;
mod ids_and_classes_name_what_is_there;
mod light_and_weather;
mod models_are_drawn;
mod only_changes_are_sent;
mod pictures_repeat;
mod pixels_follow_the_camera;
mod sensors_conform;
