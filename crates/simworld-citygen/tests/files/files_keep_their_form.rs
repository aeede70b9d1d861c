//! A small city saved once and for all: later versions read it, and write of it what others read in the same form. It
//! holds its roads, so that nothing here depends on how roads are derived or cities grown. `SIMWORLD_BLESS=1` writes the
//! files anew; a saved city that can no longer be read wants a new version of the format first.

use std::fs;
use std::path::PathBuf;

use simworld_citygen::{City, CityConfig, GeoOrigin};
use simworld_core::net::{CrossSection, RoadClass, StreetPlan};
use simworld_core::seed::Seed;

/// Four streets, one way and two, named and not, straight and bent, and a signalised crossroads; no houses.
fn made() -> City {
    let mut plan = StreetPlan::crossroads(120.0);
    let one_way = plan.add_section(CrossSection::two_way(2, 0));
    let name = plan.add_name("Rue de l'Église");
    plan.streets[0].name = Some(name);
    plan.streets[0].class = RoadClass::Arterial;
    plan.streets[1].section = one_way;
    plan.streets[2].via = vec![simworld_core::geometry::Point2::new(-60.0, 12.0)];
    let mut config = CityConfig::default();
    config.buildings.density = 0.0;
    let mut city = City::from_plan(plan, &config, Seed(1)).expect("a plain crossroads");
    city.buildings.clear();
    city.elements.clear();
    city.provenance.title = Some("Crossroads".to_owned());
    city.provenance.origin = Some(GeoOrigin { latitude: 48.85, longitude: 2.35 });
    city
}

fn path(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/golden").join(name)
}

fn blesses() -> bool {
    std::env::var_os("SIMWORLD_BLESS").is_some_and(|value| value == "1")
}

/// The city as it was saved long ago.
fn saved() -> City {
    let path = path("crossroads.simcity");
    // Only where it is missing: an old file is the point.
    if blesses() && !path.exists() {
        made().save(&path).expect("the folder of the tests can be written");
    }
    City::load(&path).unwrap_or_else(|error| panic!("crossroads.simcity: {error}"))
}

/// Compares with the file of that name, or writes it.
fn check(name: &str, fill: impl Fn(&City, &mut Vec<u8>)) {
    let (path, mut bytes) = (path(name), Vec::new());
    fill(&saved(), &mut bytes);
    if blesses() {
        fs::write(&path, &bytes).expect("the folder of the tests can be written");
    }
    let golden =
        fs::read(&path).unwrap_or_else(|error| panic!("{name}: {error}; SIMWORLD_BLESS=1 writes it"));
    assert!(
        golden == bytes,
        "{name} has another form than before: look at it, then SIMWORLD_BLESS=1 keeps it"
    );
}

#[test]
fn a_city_saved_long_ago_is_still_read() {
    let (saved, made) = (saved(), made());
    assert_eq!((saved.plan, saved.provenance), (made.plan, made.provenance));
    // Defaults may have changed since; what was set has not.
    assert_eq!(saved.config.buildings.density, 0.0);
    assert_eq!(saved.network.check(), Ok(()));
    assert_eq!(saved.network.roads.len(), 4);
}

#[test]
fn sumo_networks_keep_their_form() {
    check("crossroads.net.xml", |city, out| city.write_sumo(out).expect("memory takes all"));
}

#[test]
fn opendrive_keeps_its_form() {
    check("crossroads.xodr", |city, out| city.write_opendrive(out).expect("memory takes all"));
}

#[test]
fn geojson_keeps_its_form() {
    check("crossroads.geojson", |city, out| city.write_geojson(out).expect("memory takes all"));
}
