//! What clients send: any bytes are frames or an error, and any frame a hello, a call, a line, or an error.

#![no_main]

#[path = "../checks/remote.rs"]
mod remote;

libfuzzer_sys::fuzz_target!(|data: &[u8]| remote::check(data));
