//! Robots: any MJCF is refused, or is a robot that can be put into a world and steps.

#![no_main]

use libfuzzer_sys::fuzz_target;
use simworld_physics::robot::{ImportOptions, mjcf};

mod robots;

fuzz_target!(|data: &[u8]| {
    let Ok(text) = std::str::from_utf8(data) else { return };
    if let Ok(read) = mjcf::from_str(text, &ImportOptions::default()) {
        robots::stands(read.description);
    }
});
