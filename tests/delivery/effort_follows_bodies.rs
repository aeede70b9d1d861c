//! What couriers spend is what their bodies do: the metabolic energy of the way that each went, with the parcels it had, whether it is
//! a body under physics or a point.

use simworld_agents::delivery::Cents;
use simworld_core::exertion::{Exertion, Terrain};
use simworld_core::geometry::Point3;
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityKind, Scene, World};
use simworld_examples::delivery::RunConfig;
use simworld_tests::{assembled, small};

fn load_of(world: &World, who: EntityId) -> f64 {
    let mut load = 0.0;
    world.visit_attached(who, &mut |thing| {
        load += if thing.kind == EntityKind::Parcel { thing.info.mass.unwrap_or(f64::NAN) } else { 0.0 };
    });
    load
}

/// The share of the steps in which somebody carried something; checks what everybody spent.
fn walked(config: &RunConfig) -> f64 {
    let (_, mut assembly) = assembled(config);
    let couriers = assembly.couriers.clone();
    let dt = 0.1;
    let energy = config.delivery.energy.clone();
    // 333 W are 0.14 a second.
    let per_joule = energy.walking * energy.walking_speed / 333.0;
    let ground =
        if config.environment.weather.snow_depth > 0.0 { Terrain::PackedSnow } else { Terrain::Paved };
    let place = |world: &World, who: &EntityId| world.entity(*who).expect("couriers live").position();
    let mut at: Vec<Point3> =
        couriers.iter().map(|who| place(assembly.episode.simulation().world(), who)).collect();
    let (mut spent, mut laden, mut steps) = (vec![0.0; couriers.len()], 0_u32, 0_u32);
    while !assembly.episode.is_over() {
        let world = assembly.episode.simulation().world();
        for (index, who) in couriers.iter().enumerate() {
            let (from, to) = (at[index], place(world, who));
            at[index] = to;
            if (to - from).xy().norm() < 0.1 * dt {
                continue;
            }
            let load = load_of(world, *who);
            let walker = Exertion { body: 75.0, load, terrain: ground };
            spent[index] += walker.energy(&from, &to, dt) * per_joule;
            (laden, steps) = (laden + u32::from(load > 0.0), steps + 1);
        }
        assembly.episode.step().expect("the run goes on");
    }
    let report = assembly.episode.task().report().expect("the task has begun");
    for (row, spent) in report.couriers.iter().zip(&spent) {
        assert!((row.energy - spent).abs() < 1e-6, "{} of energy, not {spent}", row.energy);
    }
    assert!(spent.iter().sum::<f64>() > 20.0, "{spent:?}");
    f64::from(laden) / f64::from(steps.max(1_u32))
}

#[test]
fn couriers_spend_what_their_bodies_do() {
    let mut config = small(1500);
    // Nobody buys a scooter or a drink.
    config.delivery.initial_money = Cents(0);
    config.delivery.prices.scooter = Cents(1_000_000);
    let laden = walked(&config);
    assert!(laden > 0.05, "{laden} of the steps with something in hand");
    config.physical_within = 50.0;
    config.environment.weather.snow_depth = 0.05;
    let laden = walked(&config);
    assert!(laden > 0.05, "{laden} of the steps with something in hand");
}
