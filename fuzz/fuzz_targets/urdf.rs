//! Robots: any URDF is refused, or is a robot that can be put into a world and steps.

#![no_main]

#[path = "../checks/robots.rs"]
mod robots;
#[path = "../checks/urdf.rs"]
mod urdf;

libfuzzer_sys::fuzz_target!(|data: &[u8]| urdf::check(data));
