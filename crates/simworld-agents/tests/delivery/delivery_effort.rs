//! What couriers spend: metabolic energy by speed, slope, load and ground, in units of the task.

use crate::delivery_books::{busy, minds, play};
use crate::delivery_common::{Town, quiet, world};
use crate::delivery_life::{ORDER, speed, win};
use simworld_agents::delivery::{BatteryConfig, Cents, CourierAction, DeliveryConfig, Power};
use simworld_core::command::Command;
use simworld_core::environment::Environment;
use simworld_core::event::EventKind;
use simworld_core::exertion::Exertion;
use simworld_core::geometry::{Point2, Point3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::intent::Intent;
use simworld_core::scene::{EntityDesc, EntityKind, Scene, World};

#[test]
fn rain_and_snow_slow_and_tire() {
    // Pandolf's factor of the ground counts for what moving costs beyond standing.
    let power = |pace: f64, ground: f64| 112.5 + ground * 112.5 * (1.4 * pace) * (1.4 * pace);
    let weathers = [
        (0.0, 0.0, 0.0, 1.0, power(1.0, 1.0)),
        (10.0, 0.0, 0.0, 0.9, 1.1 * power(0.9, 1.0)),
        // At -5 °C it lies at once, and is trodden.
        (0.0, 5.0, 0.0, 0.7, power(0.7, 1.6)),
        (0.0, 0.0, 0.4, 1.0, power(1.0, 2.5)),
    ];
    for (rain, snow, depth, pace, watts) in weathers {
        let mut town = Town::new(quiet(), 1, 1);
        win(&mut town);
        town.act(0, CourierAction::PickUpOrder { order: ORDER }).unwrap();
        town.step(&[]);
        assert!((speed(&town) - 1.4).abs() < 1e-9);
        // It comes on while the courier is under way.
        let mut sky = Environment::default();
        (sky.weather.rain, sky.weather.snow, sky.weather.snow_depth) = (rain, snow, depth);
        sky.weather.temperature = if snow > 0.0 { -5.0 } else { 10.0 };
        town.simulation.submit(Command::SetEnvironment(sky));
        town.step(&[]);
        town.step(&[]);
        assert!((speed(&town) - 1.4 * pace).abs() < 1e-9, "{} m/s at {rain}, {snow}", speed(&town));
        let before = town.task.report().unwrap().couriers[0].energy;
        for _ in 0..30 {
            town.step(&[]);
        }
        let spent = town.task.report().unwrap().couriers[0].energy - before;
        let expected = 3.0 * 0.14 * watts / 333.0;
        assert!((spent - expected).abs() < 1e-9, "{spent}, not {expected}, at {rain}, {snow}, {depth}");
    }
}

/// What an unladen courier of the mass that people have pays for a metre at a comfortable walk, whatever a joule is.
#[test]
fn a_metre_costs_what_the_settings_say() {
    let energy = DeliveryConfig::default().energy;
    assert!((energy.joules() - 2378.57).abs() < 0.01, "{} J", energy.joules());
    let courier = Exertion { body: 75.0, ..Exertion::default() };
    assert!((energy.per_metre(&courier, 1.4) - 0.1).abs() < 1e-12);
    let mut town = Town::new(quiet(), 1, 1);
    win(&mut town);
    town.act(0, CourierAction::PickUpOrder { order: ORDER }).unwrap();
    for _ in 0..100 {
        town.step(&[]);
    }
    let row = &town.task.report().unwrap().couriers[0];
    assert!(row.distance > 10.0 && (row.energy / row.distance - 0.1).abs() < 1e-9, "{row:?}");
}

/// The share of its energy that somebody of a mass spends who is led over a slope for three seconds at 1.4 m/s.
fn led(mass: Option<f64>, grade: f64) -> f64 {
    let (mut world, ids) = world(1);
    if let Some(mass) = mass {
        let old = world.entity(ids[0]).unwrap();
        let desc = EntityDesc::new(old.kind, *old.pose, old.info.shape).weighing(mass);
        world.remove(ids[0]).unwrap();
        let id = world.spawn(desc).unwrap();
        return led_there(world, id, grade);
    }
    led_there(world, ids[0], grade)
}

fn led_there(world: World, who: EntityId, grade: f64) -> f64 {
    let mut town = Town::within(world, vec![who], quiet(), 1);
    for step in 1..=30 {
        let way = 0.14 * f64::from(step);
        let pose = pose_facing(Point3::new(way, 0.0, way * grade), 0.0);
        town.simulation.submit(Command::Move { id: who, pose });
        town.step(&[]);
    }
    town.step(&[]);
    town.task.report().unwrap().couriers[0].energy
}

#[test]
fn climbs_and_heavier_bodies_cost_more() {
    let level = led(None, 0.0);
    assert!((level - 0.42).abs() < 1e-9, "{level}");
    // 75 kg · 0.35 · 1.4 m/s · 10 % are 367.5 W beside 333.
    let uphill = led(None, 0.1);
    assert!((uphill / level - (333.0 + 367.5) / 333.0).abs() < 1e-9, "{}", uphill / level);
    let steep = led(None, -0.5);
    assert!(
        (steep / level - 112.5 / 333.0).abs() < 1e-9,
        "downhill no less than standing: {}",
        steep / level
    );
    assert!((led(Some(90.0), 0.0) / level - 90.0 / 75.0).abs() < 1e-9);
    assert!((led(Some(f64::NAN), 0.0) - level).abs() < 1e-9, "a mass that is none is passed over");
}

/// What the energy of a courier must be, reckoned beside the task from positions, parcels and events alone.
struct Reckoned {
    energy: f64,
    at: Point2,
    /// Of the parcels that it had with it before the step, kg.
    load: f64,
    riding: bool,
    dragging: bool,
}

/// Metabolic power of somebody of 75 kg on level ground, W: Pandolf 1977, and the ACSM's equation from 2.136 m/s on.
fn metabolic_power(speed: f64, load: f64, ground: f64) -> f64 {
    let (body, whole) = (75.0, 75.0 + load);
    if speed > (0.5 * 9.81 * 0.93_f64).sqrt() {
        return (3.5 + ground * 0.2 * 60.0 * speed) * 20.1 / 60.0 * whole;
    }
    1.5 * body + 2.0 * whole * (load / body) * (load / body) + ground * whole * 1.5 * speed * speed
}

fn load_of(town: &Town, who: EntityId) -> f64 {
    let mut load = 0.0;
    town.simulation.world().visit_attached(who, &mut |thing| {
        load += if thing.kind == EntityKind::Parcel { thing.info.mass.unwrap() } else { 0.0 };
    });
    load
}

impl Reckoned {
    fn step(&mut self, town: &Town, who: EntityId, config: &DeliveryConfig) {
        let happened = |name: &str| {
            town.simulation.world().events().iter().any(|event| {
                matches!(&event.kind, EventKind::Task { name: other, who: Some(actor), .. } if other == name && *actor == who)
            })
        };
        if happened("scooter_mounted") {
            (self.riding, self.dragging) = (true, false);
        }
        if happened("scooter_lost") {
            (self.riding, self.dragging) = (false, false);
        }
        let now = town.task.view(who).unwrap().position();
        let (moved, dt) = ((now - self.at).norm(), 0.1);
        self.at = now;
        let speed = moved / dt;
        let energy = &config.energy;
        if speed < 0.1 {
            self.energy = (self.energy + energy.rest * dt).min(energy.capacity);
        } else {
            let weather = &town.simulation.world().environment().weather;
            let ground = match weather.snow_depth {
                0.0 => 1.0,
                depth if depth < 0.15 => 1.6,
                _ => 2.5,
            };
            // 0.5 a metre, and so 0.7 a second, is what 333 W are.
            let afoot = 0.7 * metabolic_power(speed, self.load, ground) / 333.0 * dt;
            let cost = match (self.riding, self.dragging) {
                (true, _) => energy.riding * moved,
                (_, true) => afoot * config.battery.dragging_effort,
                _ => afoot,
            };
            let rain = (weather.rain / 10.0).min(1.0);
            self.energy = (self.energy - cost * (1.0 + 0.1 * rain)).max(0.0);
        }
        if happened("battery_empty") {
            (self.riding, self.dragging) = (false, true);
        }
        if happened("battery_swapped") {
            self.dragging = false;
        }
        if happened("drink_bought") {
            self.energy = (self.energy + config.prices.drink_energy).min(energy.capacity);
        }
        self.load = load_of(town, who);
    }
}

#[test]
fn energy_is_the_integral_of_the_metabolic_power() {
    let mut config = busy();
    config.initial_money = Cents(30_000);
    config.prices.scooter = Cents(500);
    config.battery = BatteryConfig { power: Power::Battery, capacity: 3.0, ..BatteryConfig::default() };
    config.orders.parcel = 6.0;
    let mut town = Town::new(config.clone(), 6, 7);
    let mut players = minds(6);
    let mut reckoned: Vec<Reckoned> = town
        .couriers
        .iter()
        .map(|who| {
            let view = town.task.view(*who).unwrap();
            let (energy, at) = (view.energy(), view.position());
            Reckoned { energy, at, load: 0.0, riding: false, dragging: false }
        })
        .collect();
    let (mut loads, mut laden_on_foot) = ([0.0_f64; 6], 0);
    for step in 0..4000 {
        if step % 500 == 0 {
            let mut sky = Environment::default();
            sky.weather.rain = f64::from(step / 500 % 3) * 6.0;
            sky.weather.snow_depth = [0.0, 0.0, 0.05, 0.3][step as usize / 500 % 4];
            town.simulation.submit(Command::SetEnvironment(sky));
        }
        if step % 100 == 99 {
            let thirst: Vec<(usize, Intent)> =
                (0..6).map(|index| (index, CourierAction::PurchaseDrinks.into())).collect();
            town.step(&thirst);
        } else {
            play(&mut town, &mut players, 1);
        }
        for (index, who) in town.couriers.clone().into_iter().enumerate() {
            let reckoned = &mut reckoned[index];
            laden_on_foot += usize::from(reckoned.load > 0.0 && !reckoned.riding);
            reckoned.step(&town, who, &config);
            loads[index] = loads[index].max(reckoned.load);
            let energy = town.task.view(who).unwrap().energy();
            assert!(
                (energy - reckoned.energy).abs() < 1e-9,
                "step {step}: {energy}, not {}",
                reckoned.energy
            );
        }
    }
    let seen =
        ["scooter_mounted", "battery_empty", "battery_swapped", "drink_bought"].map(|name| town.count(name));
    assert!(seen.iter().all(|count| *count > 0), "{seen:?}");
    assert!(loads.iter().any(|load| *load > 6.0) && laden_on_foot > 100, "{loads:?}, {laden_on_foot} steps");
}
