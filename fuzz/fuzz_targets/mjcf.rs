//! Robots: any MJCF is refused, or is a robot that can be put into a world and steps.

#![no_main]

#[path = "../checks/mjcf.rs"]
mod mjcf;
#[path = "../checks/robots.rs"]
mod robots;

libfuzzer_sys::fuzz_target!(|data: &[u8]| mjcf::check(data));
