//! Every real extract becomes a city: one connected part, a network that holds together, real buildings that stand
//! apart, and statistics near those measured on the same extract with another program.
#![cfg(feature = "osm")]

use crate::osm_common::{all_real, real};
use simworld_citygen::osm::{PlaceOptions, StreetOptions};
use simworld_citygen::{City, CityConfig, StreetStatistics};
use simworld_core::seed::Seed;

#[test]
fn every_extract_becomes_a_city() {
    for (file, place) in all_real() {
        let (city, _) = City::from_place(&place, &PlaceOptions::default(), &CityConfig::default(), Seed(1))
            .unwrap_or_else(|error| panic!("{file}: {error}"));
        let report = city.report();
        assert_eq!(report.streets.components, 1, "{file}");
        assert_eq!(city.network.check(), Ok(()), "{file}");
        assert_eq!(report.overlaps, 0, "{file}");
        assert!(report.streets.streets >= 4, "{file}: {} streets", report.streets.streets);
    }
}

/// Streets a junction, shares of dead ends and of three-way junctions, median and mean length of a segment, circuity and
/// orientation order.
const MEASURED: [(&str, [f64; 7]); 3] = [
    ("campo-grande.osm.gz", [3.24, 0.059, 0.585, 80.0, 113.0, 1.025, 0.183]),
    ("helsinki.osm.pbf", [2.75, 0.278, 0.420, 72.0, 91.0, 1.085, 0.425]),
    ("monaco.osm.gz", [2.75, 0.175, 0.729, 63.0, 116.0, 1.158, 0.057]),
];

#[test]
fn statistics_are_those_of_the_place() {
    for (file, expected) in MEASURED {
        let Some(place) = real(file) else { continue };
        // They were measured on the map as it is drawn, every carriageway for itself.
        let (plan, _) = place.plan(&StreetOptions { merge: 0.0, ..StreetOptions::default() });
        let found = StreetStatistics::of(&plan);
        let [degree, dead, three, median, mean, circuity, order] = expected;
        let near = |what: &str, found: f64, expected: f64, tolerance: f64| {
            assert!((found - expected).abs() <= tolerance, "{file}: {what} {found:.3}, measured {expected}");
        };
        near("streets a junction", found.mean_degree, degree, 0.2);
        near("dead ends", found.dead_ends, dead, 0.06);
        near("three-way junctions", found.three_way, three, 0.12);
        // What is too short for a street is a part of a junction here, so that segments are longer, the more the more
        // crooked a place is.
        let longer = |what: &str, found: f64, expected: f64, most: f64| {
            let times = found / expected;
            assert!((0.95..most).contains(&times), "{file}: {what} {found:.1}, measured {expected}");
        };
        longer("median length", found.median_length, median, 1.5);
        longer("mean length", found.mean_length, mean, 1.35);
        near("circuity", found.circuity, circuity, 0.04);
        near("orientation order", found.orientation_order, order, 0.05);
    }
}
