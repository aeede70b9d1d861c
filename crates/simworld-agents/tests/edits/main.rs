//! Scenes by words: edits, whole scenes, and things from the library.

#[path = "../sentences/sentences_common/city.rs"]
mod city;
mod edits_are_composed;
mod edits_are_judged;
mod edits_are_taken_back;
mod edits_common;
#[path = "../shared/model_server/mod.rs"]
mod model_server;
mod models_edit_scenes;
mod scenes_are_read;
mod things_are_found_by_words;
#[path = "../shared/thought_common/mod.rs"]
mod thought_common;
