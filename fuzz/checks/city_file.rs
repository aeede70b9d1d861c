//! Saved cities: any bytes are refused or give a city that can be used. Checksums would stop every mutation at the door,
//! so the input is the sections' contents, and the frame is put round them here.

use simworld_citygen::City;
use simworld_citygen::files::save::{MAGIC, VERSION};
use simworld_core::hash::StateHasher;

/// Frames pieces that are separated by four bytes of 0xf5 as the sections of a file.
fn framed(data: &[u8]) -> Vec<u8> {
    let mut file = MAGIC.to_vec();
    file.extend(VERSION.to_le_bytes());
    let mut rest = data;
    for tag in 1_u32.. {
        let cut = rest.windows(4).position(|window| window == [0xf5; 4]);
        let content = cut.map_or(rest, |cut| &rest[..cut]);
        file.extend(tag.to_le_bytes());
        file.extend((content.len() as u64).to_le_bytes());
        file.extend(StateHasher::new().bytes(content).finish().0.to_le_bytes());
        file.extend(content);
        match cut {
            Some(cut) => rest = &rest[cut + 4..],
            None => break,
        }
    }
    file
}

pub(crate) fn check(data: &[u8]) {
    let _ = City::from_bytes(data);
    if let Ok(city) = City::from_bytes(&framed(data)) {
        let _ = (city.report(), city.svg());
        city.write_glb(&mut std::io::sink()).expect("a sink takes all");
        city.write_sumo(&mut std::io::sink()).expect("a sink takes all");
        city.write_opendrive(&mut std::io::sink()).expect("a sink takes all");
    }
}
