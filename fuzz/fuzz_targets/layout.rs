//! Files of the Python release: any text is refused or gives a city without overlaps.

#![no_main]

#[path = "../checks/layout.rs"]
mod layout;

libfuzzer_sys::fuzz_target!(|data: &[u8]| layout::check(data));
