//! Scenes by words: edits, whole scenes, and things from the library.
#![allow(clippy::unwrap_used, reason = "what fails in a helper fails the test")]

#[path = "../sentences/sentences_common/city.rs"]
#[allow(dead_code, reason = "sentences use all of it")]
mod city;
mod edits_among_talk;
mod edits_are_ask;
mod edits_are_chatted;
mod edits_are_composed;
mod edits_are_judged;
mod edits_are_measured;
mod edits_are_places;
mod edits_are_put_right;
mod edits_are_remarked_on;
mod edits_are_taken_back;
mod edits_are_told_along;
mod edits_are_verbs;
mod edits_by_policy;
mod edits_by_their_kin;
mod edits_can_be_answered;
mod edits_carry_their_loads;
mod edits_common;
mod edits_in_other_words;
mod edits_keep_land_use;
mod edits_let_things_fall;
mod edits_of_rare_forms;
mod edits_refer_across_sentences;
#[path = "../shared/model_server/mod.rs"]
mod model_server;
mod models_edit_scenes;
mod models_edit_through_llama_cpp;
mod scenes_are_read;
#[path = "../shared/tables.rs"]
mod tables;
mod things_are_found_by_words;
mod things_are_known_by_what_they_are;
mod things_stand_around_turned_houses;
#[path = "../shared/thought_common/mod.rs"]
mod thought_common;
