//! OSM PBF: any bytes are refused or give a city that holds together. Compression would hide the blocks from the fuzzer,
//! so the input is also taken as the content of one block of elements, and the frame is put round it here.

use simworld_citygen::osm::{Place, PlaceOptions};
use simworld_citygen::{City, CityConfig};
use simworld_core::seed::Seed;

/// A field of bytes of a message.
fn field(number: u8, content: &[u8], into: &mut Vec<u8>) {
    into.push((number << 3) | 2);
    varint(content.len() as u64, into);
    into.extend_from_slice(content);
}

fn varint(mut number: u64, into: &mut Vec<u8>) {
    while number >= 0x80 {
        into.push(number as u8 | 0x80);
        number >>= 7;
    }
    into.push(number as u8);
}

/// A file of one block of elements.
fn framed(content: &[u8]) -> Vec<u8> {
    let mut blob = Vec::new();
    field(1, content, &mut blob);
    let mut header = Vec::new();
    field(1, b"OSMData", &mut header);
    header.push(3 << 3);
    varint(blob.len() as u64, &mut header);
    let mut file = (header.len() as u32).to_be_bytes().to_vec();
    file.append(&mut header);
    file.append(&mut blob);
    file
}

fn look(bytes: &[u8]) {
    let Ok(place) = Place::from_pbf(bytes) else { return };
    let made = City::from_place(&place, &PlaceOptions::default(), &CityConfig::default(), Seed(1));
    if let Ok((city, _)) = made {
        assert_eq!(city.network.check(), Ok(()));
    }
}

pub(crate) fn check(data: &[u8]) {
    look(data);
    look(&framed(data));
}
