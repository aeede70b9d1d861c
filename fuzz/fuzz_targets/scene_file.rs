//! Hand-written scenes: any text is refused with its line, or comes back from being written.

#![no_main]

#[path = "../checks/scene_file.rs"]
mod scene_file;

libfuzzer_sys::fuzz_target!(|data: &[u8]| scene_file::check(data));
