//! Saved cities: any bytes are refused or give a city that can be used. Checksums would stop every mutation at the door,
//! so the input is the sections' contents, and the frame is put round them here.

#![no_main]

#[path = "../checks/city_file.rs"]
mod city_file;

libfuzzer_sys::fuzz_target!(|data: &[u8]| city_file::check(data));
