//! Models of strangers: any bytes are a surface within limits or an error, and what is a surface an asset or an error.

#![no_main]

#[path = "../checks/glb.rs"]
mod glb;

libfuzzer_sys::fuzz_target!(|data: &[u8]| glb::check(data));
