//! Drivers of other car-following models among one another: nobody touches anybody, and traffic flows.

mod watching;

use simworld_core::hash::StateHash;
use simworld_traffic::vehicle::{CarFollowing, VehicleType};
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
    let mut traffic = watching::on_grid(4, &mixed(110), 31);
    let counters = watching::drive(&mut traffic, 6000, |_| false);
    assert_eq!((counters.dilemmas, counters.forced_stops), (0, 0), "{counters:?}");
    // On average everybody crosses an intersection every minute.
    assert!(counters.crossings > 110 * 600 / 60, "traffic flows: {counters:?}");
}

#[test]
fn each_model_alone_keeps_traffic_moving() {
    for row in 0..3 {
        let config = mixed(110);
        let config = TrafficConfig { types: vec![config.types[row].clone()], ..config };
        let mut traffic = watching::on_grid(4, &config, 32);
        let counters = watching::drive(&mut traffic, 3000, |_| false);
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
        let mut traffic: Traffic = watching::on_grid(3, &krauss, seed);
        (0..600).for_each(|_| traffic.step(0.1));
        traffic.digest()
    };
    assert_eq!(run(1), run(1));
    assert_ne!(run(1), run(2));
}
