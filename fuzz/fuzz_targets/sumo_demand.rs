//! SUMO demand: any bytes are refused, or can be planned on a network or refused there.

#![no_main]

#[path = "../checks/sumo_demand.rs"]
mod sumo_demand;

libfuzzer_sys::fuzz_target!(|data: &[u8]| sumo_demand::check(data));
