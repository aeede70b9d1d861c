//! A saved city comes back as it was, to the bit; anything else is an error that says what is wrong.

use proptest::prelude::*;
use simworld_citygen::files::save::{MAGIC, SaveError};
use simworld_citygen::{City, CityConfig, GeoOrigin};
use simworld_core::seed::Seed;

fn city(roads: u32, seed: u64) -> City {
    City::generate(&CityConfig::with_roads(roads), Seed(seed)).expect("defaults are valid")
}

fn bytes(city: &City) -> Vec<u8> {
    let mut bytes = Vec::new();
    city.write_to(&mut bytes).expect("memory takes all");
    bytes
}

#[test]
fn what_is_loaded_is_what_was_saved() {
    for seed in 0..4 {
        let mut city = city(30, seed);
        city.provenance.title = Some("Näyttämö".to_owned());
        city.provenance.origin = Some(GeoOrigin { latitude: 60.17, longitude: 24.94 });
        let saved = bytes(&city);
        let loaded = City::from_bytes(&saved).unwrap();
        assert_eq!(loaded, city);
        assert_eq!(loaded.report(), city.report());
        assert_eq!(bytes(&loaded), saved);
    }
}

#[test]
fn a_file_is_whole_or_absent() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("made/on/the/way/a.simcity");
    let city = city(8, 1);
    city.save(&path).unwrap();
    assert_eq!(City::load(&path).unwrap(), city);
    let failed = simworld_citygen::files::atomic::write(&path, |_| Err(std::io::Error::other("interrupted")));
    assert!(failed.is_err());
    assert_eq!(City::load(&path).unwrap(), city, "what was there stays");
    assert_eq!(std::fs::read_dir(path.parent().unwrap()).unwrap().count(), 1, "nothing else is left behind");
}

#[test]
fn every_truncation_is_named() {
    let saved = bytes(&city(6, 2));
    let mut length = 1;
    while length < saved.len() {
        let error = City::from_bytes(&saved[..length]).unwrap_err();
        assert!(matches!(error, SaveError::Truncated { .. }), "{length}: {error}");
        length += 1 + length / 40;
    }
    assert!(matches!(City::from_bytes(&[]), Err(SaveError::Foreign)));
}

#[test]
fn a_file_is_judged_like_its_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.simcity");
    let saved = bytes(&city(6, 2));
    let judge = |bytes: &[u8]| {
        std::fs::write(&path, bytes).unwrap();
        let error = |result: Result<City, SaveError>| result.err().map(|error| error.to_string());
        assert_eq!(error(City::load(&path)), error(City::from_bytes(bytes)), "{} bytes", bytes.len());
    };
    judge(&saved);
    for length in [0, 5, 9, 15, saved.len() / 2, saved.len() - 1] {
        judge(&saved[..length]);
    }
    for place in [0, 10, 20, 40, saved.len() / 2, saved.len() - 3] {
        let mut damaged = saved.clone();
        damaged[place] ^= 4;
        judge(&damaged);
    }
    judge(&[saved, vec![7]].concat());
}

#[test]
fn foreign_and_newer_files_are_told_apart() {
    assert!(matches!(City::from_bytes(b"{\"roads\": []}"), Err(SaveError::Foreign)));
    let mut saved = bytes(&city(6, 2));
    saved[MAGIC.len()] = 77;
    assert!(matches!(City::from_bytes(&saved), Err(SaveError::Version { found: 77 })));
}

#[test]
fn more_after_the_end_is_refused() {
    let mut saved = bytes(&city(6, 2));
    saved.push(0);
    assert!(matches!(City::from_bytes(&saved), Err(SaveError::Section { .. })));
}

/// Puts `change` into the content of the section with that tag and mends its checksum, as somebody would who means it.
fn forge(saved: &[u8], tag: u32, change: impl Fn(&mut [u8])) -> Vec<u8> {
    let mut forged = saved.to_vec();
    let mut at = 12;
    while at < forged.len() {
        let number = u32::from_le_bytes(forged[at..at + 4].try_into().expect("four or eight bytes"));
        let length =
            u64::from_le_bytes(forged[at + 4..at + 12].try_into().expect("four or eight bytes")) as usize;
        if number == tag {
            let content = at + 20..at + 20 + length;
            change(&mut forged[content.clone()]);
            let sum = simworld_core::hash::StateHasher::new().bytes(&forged[content]).finish().0;
            forged[at + 12..at + 20].copy_from_slice(&sum.to_le_bytes());
        }
        at += 20 + length;
    }
    forged
}

#[test]
fn forged_numbers_are_caught() {
    let saved = bytes(&city(6, 2));
    // Somewhere among the buildings eight bytes of 0xff make a NaN.
    let forged = forge(&saved, 3, |content| content[20..60].fill(0xff));
    assert!(City::from_bytes(&forged).is_err());
    // A list that claims to hold 2^60 items.
    for tag in 2..=11 {
        let forged = forge(&saved, tag, |content| {
            content[..9].copy_from_slice(&[0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x0f]);
        });
        assert!(matches!(City::from_bytes(&forged), Err(SaveError::Content { .. })), "section {tag}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 256, ..ProptestConfig::default() })]

    #[test]
    fn any_bytes_are_safe(tail in prop::collection::vec(any::<u8>(), 0..300), begin in 0_usize..3) {
        let mut bytes = if begin > 0 { MAGIC.to_vec() } else { Vec::new() };
        if begin > 1 {
            bytes.extend([1, 0, 0, 0]);
        }
        bytes.extend(tail);
        prop_assert!(City::from_bytes(&bytes).is_err());
    }

    #[test]
    fn damage_is_noticed(at in 0.0..1.0_f64, mask in 1_u8..) {
        let mut saved = bytes(&city(3, 5));
        let index = (at * saved.len() as f64) as usize;
        saved[index] ^= mask;
        prop_assert!(City::from_bytes(&saved).is_err());
    }

    #[test]
    fn forgeries_are_refused_or_sound(tag in 1_u32..15, at in 0.0..1.0_f64, value in any::<u8>()) {
        let saved = bytes(&city(3, 5));
        let forged = forge(&saved, tag, |content| {
            // A section may be empty.
            let index = (at * content.len() as f64) as usize;
            content.iter_mut().skip(index).take(1).for_each(|byte| *byte = value);
        });
        // Whatever is accepted can be used: reported, drawn and saved again.
        if let Ok(city) = City::from_bytes(&forged) {
            let _ = city.report();
            let _ = city.svg();
            prop_assert!(City::from_bytes(&bytes(&city)).is_ok());
        }
    }
}
