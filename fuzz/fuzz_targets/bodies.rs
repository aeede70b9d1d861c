//! Bodies of every kind with hostile settings, shapes, masses and models: refused with a reason, or finite as long as the physics says
//! that all is well.

#![no_main]

use libfuzzer_sys::fuzz_target;

#[path = "../../crates/simworld-physics/tests/common/hostile.rs"]
mod hostile;

fuzz_target!(|data: &[u8]| {
    let Ok(case) = postcard::from_bytes::<hostile::Hostile>(data) else { return };
    let _ = hostile::survives(&case);
});
