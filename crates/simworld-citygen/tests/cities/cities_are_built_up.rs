//! At any size: most of the frontage is built on, no kind of building dominates, forms and roofs vary, buildings are as
//! large as those of real towns.

use simworld_citygen::building::{Building, FootprintKind};
use simworld_citygen::{City, CityConfig};
use simworld_core::seed::Seed;

fn sizes() -> &'static [(u32, u64)] {
    if std::env::var_os("SIMWORLD_SOAK").is_some() {
        &[(40, 200), (400, 20), (4000, 3), (40_000, 1)]
    } else {
        &[(40, 12), (400, 2), (4000, 1)]
    }
}

#[test]
fn frontage_is_used_and_no_kind_dominates_at_any_size() {
    for (streets, seeds) in sizes() {
        for seed in 0..*seeds {
            let city = City::generate(&CityConfig::with_roads(*streets), Seed(seed)).unwrap();
            let used = city.frontage_used();
            assert!((0.75..=1.0).contains(&used), "{streets} streets, seed {seed}: frontage used {used:.2}");
            let commonest = city.report().commonest_kind;
            assert!(commonest < 0.3, "{streets} streets, seed {seed}: one kind is {commonest:.2} of all");
        }
    }
}

#[test]
fn forms_roofs_and_sizes_are_those_of_a_town() {
    // Courtyards are rare: three to twelve in a town of this size.
    let towns = (1..4).map(|seed| City::generate(&CityConfig::with_roads(400), Seed(seed)).unwrap());
    let buildings: Vec<Building> = towns.flat_map(|city| city.buildings).collect();
    let count = buildings.len() as f64;
    for kind in [
        FootprintKind::Rectangle,
        FootprintKind::L,
        FootprintKind::U,
        FootprintKind::Courtyard,
        FootprintKind::Stepped,
    ] {
        let with = buildings.iter().filter(|building| building.footprint.kind() == kind).count();
        assert!(with > 8, "{with} buildings of the form {kind:?}");
    }
    let roofs: std::collections::BTreeSet<_> = buildings.iter().map(|building| building.roof).collect();
    assert_eq!(roofs.len(), 4);
    // Median footprint of a quarter of Prague: 261 m², of the middle of Helsinki: 801 m²; a cottage has 80.
    let mut areas: Vec<f64> = buildings.iter().map(Building::footprint_area).collect();
    areas.sort_by(f64::total_cmp);
    let median = areas[areas.len() / 2];
    assert!((90.0..400.0).contains(&median), "median footprint {median:.0} m²");
    let storeys = buildings.iter().map(|building| f64::from(building.storeys)).sum::<f64>() / count;
    assert!((1.8..6.0).contains(&storeys), "mean of {storeys:.1} storeys");
    for building in &buildings {
        assert!(building.footprint.fits(building.width, building.depth));
        assert!(building.floor_area() >= building.footprint_area() - 1e-9);
    }
}
