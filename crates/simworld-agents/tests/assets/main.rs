//! Assets from folders, files, servers and words, and scenes from files.
#![allow(clippy::unwrap_used, reason = "what fails in a helper fails the test")]

mod assets_common;
#[path = "../shared/fault_server/mod.rs"]
mod fault_server;
mod folders_of_assets_are_read;
mod generators_survive_servers;
mod hostile_models_are_refused;
mod hostile_scene_files_are_refused;
mod loaders_survive_mutations;
mod materials_are_read;
mod models_are_imported;
mod models_are_posed;
mod models_move;
mod scene_files_are_read;
mod tangents_are_read;
mod things_are_made_from_words;
