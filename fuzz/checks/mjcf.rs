//! Robots: any MJCF is refused, or is a robot that can be put into a world and steps.

use simworld_physics::robot::{ImportOptions, mjcf};

pub(crate) fn check(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else { return };
    if let Ok(read) = mjcf::from_str(text, &ImportOptions::default()) {
        super::robots::stands(read.description);
    }
}
