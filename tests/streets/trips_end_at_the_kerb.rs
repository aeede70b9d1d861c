//! Many minds drive through the rush hour of grown cities: all arrive, and nobody is harmed.

use std::ops::Range;

use simworld_tests::driving::{Outcome, Rush, Streets, Wheels};
use simworld_tests::traffic::{each_case, is_whole};

/// The trips of many minds in the rush hour of grown cities.
fn rush(wheels: Wheels, cities: Range<usize>, minds: usize, trips: usize) {
    let outcomes: Vec<(usize, Outcome)> = each_case(cities.len(), |case| {
        let city = cities.start + case;
        let rush =
            Rush { city, segments: 60, density: 10.0, minds, trips, wheels, longest: 900.0 * trips as f64 };
        (city, Streets::new(&rush).drive(&rush))
    });
    let sum = |of: fn(&Outcome) -> usize| outcomes.iter().map(|(_, outcome)| of(outcome)).sum::<usize>();
    let driven: f64 = outcomes.iter().map(|(_, outcome)| outcome.driven).sum();
    println!(
        "{} of {} trips ended at their kerb, {:.1} km, {} lights and {} stop signs passed",
        sum(|outcome| outcome.arrived),
        sum(|outcome| outcome.sent),
        driven / 1000.0,
        sum(|outcome| outcome.signals),
        sum(|outcome| outcome.stops)
    );
    let faults: Vec<String> = outcomes
        .iter()
        .flat_map(|(city, outcome)| {
            outcome.faults.all().into_iter().map(move |fault| format!("city {city}: {fault}"))
        })
        .collect();
    assert!(faults.is_empty(), "{faults:#?}");
    let sent = sum(|outcome| outcome.sent);
    assert!(
        sent * 10 > outcomes.len() * minds * trips * 7,
        "{sent} trips: too few vehicles for so many minds"
    );
    assert_eq!(sum(|outcome| outcome.arrived), sent);
    assert!(sum(|outcome| outcome.signals) > outcomes.len(), "nobody met a light");
    assert!(sum(|outcome| outcome.stops) > 0, "nobody met a stop sign");
}

#[test]
fn trips_through_dense_traffic_end_at_the_kerb_and_harm_nobody() {
    if is_whole() { rush(Wheels::Rolling, 0..200, 4, 2) } else { rush(Wheels::Rolling, 0..1, 4, 1) }
}

#[test]
fn on_tyres_as_well() {
    if is_whole() { rush(Wheels::Tyres, 0..32, 4, 2) } else { rush(Wheels::Tyres, 0..1, 2, 1) }
}

/// Blocks so short that rears stand in the junctions behind them: a bus waited there for room behind a car, and the car for the bus to
/// leave the junction that it went to, and in the end the whole city stood.
#[test]
fn where_blocks_are_short_as_well() {
    rush(Wheels::Rolling, 102..103, 4, 2);
}
