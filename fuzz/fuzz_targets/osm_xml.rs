//! OSM XML: any text is refused or gives a city that holds together.

#![no_main]

#[path = "../checks/osm_xml.rs"]
mod osm_xml;

libfuzzer_sys::fuzz_target!(|data: &[u8]| osm_xml::check(data));
