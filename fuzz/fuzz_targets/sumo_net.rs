//! SUMO networks: any bytes are refused or give a network that holds together.

#![no_main]

#[path = "../checks/sumo_net.rs"]
mod sumo_net;

libfuzzer_sys::fuzz_target!(|data: &[u8]| sumo_net::check(data));
