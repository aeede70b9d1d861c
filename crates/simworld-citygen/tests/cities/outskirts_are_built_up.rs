//! On land without an end, too, houses stand on both sides of a bay, along both streets of a corner and right up to where a
//! street turns.

use simworld_citygen::zoning::ZoningConfig;
use simworld_citygen::{City, CityConfig};
use simworld_core::geometry::Point2;
use simworld_core::net::{Street, StreetPlan};
use simworld_core::seed::Seed;

/// Towns without parks along one bent street, over some seeds.
fn towns(nodes: &[(f64, f64)]) -> Vec<City> {
    let plan = StreetPlan {
        nodes: nodes.iter().map(|(x, y)| Point2::new(*x, *y)).collect(),
        streets: (1..nodes.len()).map(|to| Street::simple(to - 1, to)).collect(),
        ..StreetPlan::crossroads(100.0)
    };
    let zoning = ZoningConfig { parks: 0.0, ..ZoningConfig::default() };
    let config = CityConfig { zoning, ..CityConfig::default() };
    (0..20)
        .map(|seed| City::from_plan(plan.clone(), &config, Seed(seed)).expect("a street is sound"))
        .collect()
}

fn frontage_used(towns: &[City]) -> f64 {
    towns.iter().map(City::frontage_used).sum::<f64>() / towns.len() as f64
}

#[test]
fn both_sides_of_a_bay_are_built_on() {
    for width in [45.0, 55.0, 65.0] {
        for city in towns(&[(0.0, 0.0), (190.0, 0.0), (190.0, width), (0.0, width)]) {
            // Between the two long arms, by the street that each house stands at.
            let inside = |road: usize| {
                let along = city.buildings.iter().filter(|house| house.road.index() == road);
                along
                    .filter(|house| (2.0..width - 2.0).contains(&house.center.y))
                    .map(|house| house.frontage)
                    .sum::<f64>()
            };
            for road in [0, 2] {
                let used = inside(road);
                assert!(
                    used > 75.0,
                    "{width} m apart, seed {:?}: {used:.0} m along arm {road}",
                    city.provenance.seed
                );
            }
        }
    }
}

#[test]
fn corner_houses_stand_along_both_streets() {
    let towns = towns(&[(0.0, 0.0), (130.0, 0.0), (130.0, 130.0)]);
    let used = frontage_used(&towns);
    assert!(used > 0.8, "frontage used {used:.3}");
}

#[test]
fn streets_that_turn_a_little_are_built_on_up_to_the_turn() {
    for turn in [0.35, 0.6, 0.9_f64] {
        let (sin, cos) = simworld_core::ops::sin_cos(turn);
        let towns = towns(&[(0.0, 0.0), (110.0, 0.0), (110.0 + 100.0 * cos, 100.0 * sin)]);
        let used = frontage_used(&towns);
        assert!(used > 0.8, "a turn of {turn} rad: frontage used {used:.3}");
    }
}
