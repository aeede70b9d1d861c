//! Manifests of asset folders: any text is refused with its line, or every path of it stays within the folder.

#![no_main]

#[path = "../checks/library.rs"]
mod library;

libfuzzer_sys::fuzz_target!(|data: &[u8]| library::check(data));
