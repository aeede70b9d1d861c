//! OSM PBF: any bytes are refused or give a city that holds together. Compression would hide the blocks from the fuzzer,
//! so the input is also taken as the content of one block of elements, and the frame is put round it here.

#![no_main]

#[path = "../checks/osm_pbf.rs"]
mod osm_pbf;

libfuzzer_sys::fuzz_target!(|data: &[u8]| osm_pbf::check(data));
