//! Streets bear names: each one of its own, kept as long as it goes on.

use std::collections::BTreeMap;

use simworld_citygen::{RoadSource, Style, name};
use simworld_core::net::{RoadClass, StreetPlan};
use simworld_core::seed::Seed;

#[test]
fn every_street_of_a_city_has_a_name_of_its_own() {
    for style in Style::ALL {
        let plan = style.roads(400).streets(Seed(5)).expect("styles are valid");
        let mut seen: BTreeMap<&str, u32> = BTreeMap::new();
        for street in &plan.streets {
            let name = street.name.expect("every street is named");
            let text = plan.name(street).expect("names are there");
            assert_eq!(*seen.entry(text).or_insert(name), name, "{style}: two streets are called {text}");
        }
        // Streets go on: there are fewer names than segments.
        assert!(seen.len() < plan.streets.len() * 4 / 5, "{style}: {} names", seen.len());
        assert_eq!(seen.len(), plan.names.len(), "no name is left over");
        let again = style.roads(400).streets(Seed(5)).expect("styles are valid");
        assert_eq!(plan, again);
    }
}

#[test]
fn a_street_keeps_its_name_across_a_junction_and_no_other_takes_it() {
    let mut plan = StreetPlan::grid(5, 4, 100.0);
    name::streets(&mut plan, Seed(1));
    let along = |street: &simworld_core::net::Street| {
        let (a, b) = (plan.nodes[street.from], plan.nodes[street.to]);
        if (a.y - b.y).abs() < 1e-9 { (true, a.y as i64) } else { (false, a.x as i64) }
    };
    let mut lines: BTreeMap<u32, (bool, i64)> = BTreeMap::new();
    for street in &plan.streets {
        let name = street.name.expect("every street is named");
        assert_eq!(*lines.entry(name).or_insert(along(street)), along(street), "a name turns a corner");
    }
    assert_eq!(lines.len(), 9);
}

#[test]
fn ranks_show_and_names_that_are_there_stay() {
    let mut plan = StreetPlan::grid(4, 4, 100.0);
    let broadway = plan.add_name("Broadway");
    plan.streets[0].name = Some(broadway);
    plan.streets[1].class = RoadClass::Arterial;
    name::streets(&mut plan, Seed(2));
    assert_eq!(plan.name(&plan.streets[0]), Some("Broadway"));
    let avenue = plan.name(&plan.streets[1]).expect("it is named");
    assert!(["Avenue", "Boulevard", "Parade"].iter().any(|word| avenue.ends_with(word)), "{avenue}");
}
