//! OpenDRIVE: any text is refused or gives a plan that can be built.

#![no_main]

#[path = "../checks/opendrive.rs"]
mod opendrive;

libfuzzer_sys::fuzz_target!(|data: &[u8]| opendrive::check(data));
