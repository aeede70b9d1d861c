//! Drivers of other car-following models among one another: nobody touches anybody, and traffic flows.

use simworld_core::hash::StateHash;
use simworld_traffic::vehicle::{CarFollowing, Perception, VehicleType};
use simworld_traffic::{Traffic, TrafficConfig};

/// As many by each of the models.
fn mixed(vehicles: u32) -> TrafficConfig {
    let models =
        [CarFollowing::Idm, CarFollowing::Krauss { sigma: 0.5 }, CarFollowing::Acc { coolness: 0.99 }];
    let types = models.map(|model| VehicleType { model, ..VehicleType::default() }).to_vec();
    TrafficConfig { vehicles, pedestrians: 100, types, ..TrafficConfig::default() }
}

#[test]
fn models_share_the_streets_without_touching() {
    let mut traffic = crate::watching::on_grid(4, &mixed(110), 31);
    let counters = crate::watching::drive(&mut traffic, 6000, |_| false);
    assert_eq!((counters.dilemmas, counters.forced_stops), (0, 0), "{counters:?}");
    // On average everybody crosses an intersection every minute.
    assert!(counters.crossings > 110 * 600 / 60, "traffic flows: {counters:?}");
}

#[test]
fn each_model_alone_keeps_traffic_moving() {
    for row in 0..3 {
        let config = mixed(110);
        let config = TrafficConfig { types: vec![config.types[row].clone()], ..config };
        let mut traffic = crate::watching::on_grid(4, &config, 32);
        let counters = crate::watching::drive(&mut traffic, 3000, |_| false);
        assert_eq!((counters.dilemmas, counters.forced_stops), (0, 0), "{row}: {counters:?}");
        assert!(counters.crossings > 110 * 300 / 60, "{row}: {counters:?}");
    }
}

/// Imperfection is drawn from the seed: the same seed gives the same bits, another seed others.
#[test]
fn imperfection_follows_the_seed() {
    let run = |seed| {
        let config = TrafficConfig { pedestrians: 0, ..mixed(40) };
        let krauss = TrafficConfig { types: vec![config.types[1].clone()], ..config };
        let mut traffic: Traffic = crate::watching::on_grid(3, &krauss, seed);
        (0..600).for_each(|_| traffic.step(0.1));
        traffic.digest()
    };
    assert_eq!(run(1), run(1));
    assert_ne!(run(1), run(2));
}

/// The same table with drivers who are not perfect.
fn human(config: TrafficConfig, perception: Perception) -> TrafficConfig {
    let types = config.types.into_iter().map(|row| VehicleType { perception: Some(perception), ..row });
    TrafficConfig { types: types.collect(), ..config }
}

#[test]
fn who_errs_by_nothing_and_decides_at_once_is_perfect_to_the_bit() {
    let zero = Perception { reaction_time: 0.0, gap_error: 0.0, speed_error: 0.0, ..Perception::default() };
    let run = |config: &TrafficConfig| {
        let mut traffic: Traffic = crate::watching::on_grid(4, config, 33);
        (0..1500).for_each(|_| traffic.step(0.1));
        traffic.digest()
    };
    let perfect = run(&mixed(100));
    assert_eq!(run(&human(mixed(100), zero)), perfect);
    assert_ne!(run(&human(mixed(100), Perception { reaction_time: 0.3, ..zero })), perfect);
    assert_ne!(run(&human(mixed(100), Perception { gap_error: 0.02, ..zero })), perfect);
    assert_ne!(run(&human(mixed(100), Perception { speed_error: 0.01, ..zero })), perfect);
}

#[test]
fn drivers_who_are_not_perfect_touch_nobody_either() {
    let worst = Perception { reaction_time: 1.0, gap_error: 0.1, speed_error: 0.03, persistence: 10.0 };
    for (perception, seed) in [(Perception::default(), 34), (worst, 35)] {
        let mut traffic = crate::watching::on_grid(4, &human(mixed(110), perception), seed);
        let counters = crate::watching::drive(&mut traffic, 5000, |_| false);
        assert_eq!((counters.dilemmas, counters.forced_stops), (0, 0), "{perception:?}: {counters:?}");
        assert!(counters.crossings > 110 * 500 / 60, "traffic flows: {counters:?}");
    }
}

#[test]
fn perceptions_out_of_range_are_refused() {
    let good = Perception::default();
    for (bad, named) in [
        (Perception { reaction_time: -0.1, ..good }, "perception.reaction_time"),
        (Perception { gap_error: 0.5, ..good }, "perception.gap_error"),
        (Perception { speed_error: f64::NAN, ..good }, "perception.speed_error"),
        (Perception { persistence: 0.0, ..good }, "perception.persistence"),
    ] {
        let refused = human(mixed(1), bad).validate().expect_err("it is out of range");
        assert!(refused.to_string().contains(named), "{refused}");
    }
    // A driver by Krauss leaves himself one headway to react.
    let late = human(mixed(1), Perception { reaction_time: 1.2, ..good });
    assert!(late.validate().expect_err("the second row is Krauss'").to_string().contains("types[1]"));
    TrafficConfig { types: vec![late.types[0].clone(), late.types[2].clone()], ..late }.validate().unwrap();
}
