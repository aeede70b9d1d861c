//! The experiments by name.

use std::fmt;
use std::str::FromStr;

use simworld_agents::delivery::{Cents, DeliveryConfig, Persona, PolicyKind};
use thiserror::Error;

use crate::delivery::{Brain, RunConfig};

/// An experiment of the paper's case study.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Preset {
    /// Twenty couriers, 5000 steps.
    Main,
    /// Twelve minds, two couriers each, 1000 steps, one order a courier, hunger 0.9, fixed prices.
    Competition,
    /// More and fewer orders.
    Orders,
    /// More and less money to begin with.
    Money,
    /// Ten personas, two couriers each, one way of bidding.
    Persona,
    /// Ten thousand couriers and the orders of a million people.
    Scale,
}

impl Preset {
    /// Every preset.
    pub const ALL: [Self; 6] =
        [Self::Main, Self::Competition, Self::Orders, Self::Money, Self::Persona, Self::Scale];

    /// Its name on the command line.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Main => "main",
            Self::Competition => "competition",
            Self::Orders => "orders",
            Self::Money => "money",
            Self::Persona => "persona",
            Self::Scale => "scale",
        }
    }

    /// What it asks, in one line.
    pub fn question(self) -> &'static str {
        match self {
            Self::Main => "How do twenty couriers fare in a living city?",
            Self::Competition => "Which way of bidding wins orders, and at what price?",
            Self::Orders => "What do couriers do when there is more to deliver?",
            Self::Money => "What do couriers do when they begin with more money?",
            Self::Persona => "What does character change in how a courier works?",
            Self::Scale => "How do ten thousand couriers serve a million people?",
        }
    }

    /// The settings that are compared; what the preset does not fix is that of `base`.
    pub fn arms(self, base: &RunConfig) -> Vec<Arm> {
        match self {
            Self::Main => vec![Arm::new("main", 0.0, base.clone())],
            Self::Competition => vec![Arm::new("competition", 0.0, competition(base))],
            Self::Orders => {
                VOLUMES.map(|volume| Arm::new("orders", volume, with_volume(base, volume))).into()
            }
            Self::Money => PURSES.map(|purse| Arm::new("money", purse, with_purse(base, purse))).into(),
            Self::Persona => vec![Arm::new("persona", 0.0, personas(base))],
            Self::Scale => vec![Arm::new("scale", 0.0, at_scale(base, 10_000))],
        }
    }
}

/// Order volumes, as multiples of the usual one.
const VOLUMES: [f64; 5] = [0.25, 0.5, 1.0, 2.0, 4.0];
/// Purses at the start, $: on both sides of the price of a scooter.
const PURSES: [f64; 5] = [10.0, 50.0, 100.0, 200.0, 400.0];
/// How far from the average the traits of the personas are.
const MARKED: f64 = 0.8;

/// One setting of an experiment.
#[derive(Clone, Debug, PartialEq)]
pub struct Arm {
    /// Its name in files.
    pub name: String,
    /// The quantity that is varied; zero if none is.
    pub level: f64,
    /// What to run.
    pub config: RunConfig,
}

impl Arm {
    fn new(name: &str, level: f64, config: RunConfig) -> Self {
        let name = if level > 0.0 { format!("{name}-{level}") } else { name.to_owned() };
        let mut config = config;
        // Each arm asks its models other things.
        config.model.tape = config.model.tape.map(|folder| folder.join(&name));
        Self { name, level, config }
    }
}

fn competition(base: &RunConfig) -> RunConfig {
    let rules = DeliveryConfig::competition();
    RunConfig { agents: 24, steps: rules.steps, delivery: rules, ..base.clone() }
}

fn with_volume(base: &RunConfig, volume: f64) -> RunConfig {
    let mut config = base.clone();
    let orders = &mut config.delivery.orders;
    orders.per_customer_hour *= volume;
    orders.initial = (f64::from(orders.initial) * volume).round() as u32;
    config
}

fn with_purse(base: &RunConfig, dollars: f64) -> RunConfig {
    let mut config = base.clone();
    config.delivery.initial_money = Cents((dollars * 100.0).round() as i64);
    config
}

/// Ten personas: each trait marked one way and the other, all others average. All bid at what it costs and a third more,
/// so that only character differs.
fn personas(base: &RunConfig) -> RunConfig {
    let average = Persona::default();
    let marked = |by: f64| {
        [
            Persona { openness: by, ..average },
            Persona { conscientiousness: by, ..average },
            Persona { extraversion: by, ..average },
            Persona { agreeableness: by, ..average },
            Persona { neuroticism: by, ..average },
        ]
    };
    let personas = [marked(MARKED), marked(-MARKED)].concat();
    let policies = match base.policies.as_slice() {
        [Brain::Model] => vec![Brain::Model],
        _ => vec![Brain::Policy(PolicyKind::CostPlusMedium)],
    };
    RunConfig { agents: 20, policies, personas, ..base.clone() }
}

/// Couriers for each street of a large city. Chosen: as dense as gives each some restaurants within its reach.
const COURIERS_PER_STREET: f64 = 2.0;
/// People for each courier: a million for ten thousand.
const PEOPLE_PER_COURIER: u32 = 100;
/// Orders of a hungry person in an hour: twice what the couriers of the paper deliver, at half hunger as much as they do.
const ORDERS_PER_HOUR: f64 = 0.2;
/// How far couriers of a large city are told of orders, m.
const TOLD_WITHIN: f64 = 600.0;
/// Within this distance of the middle of a large city couriers have bodies under physics, m.
const PHYSICAL_WITHIN: f64 = 300.0;

/// So many couriers in a city that is as dense whatever their number, with a person in traffic for every four and a vehicle
/// for every ten.
pub fn at_scale(base: &RunConfig, couriers: u32) -> RunConfig {
    let mut config = RunConfig {
        seeds: 1,
        agents: couriers,
        steps: 600,
        vehicles: couriers / 10,
        pedestrians: couriers / 4,
        frames: 0,
        digest_interval: 100,
        physical_within: PHYSICAL_WITHIN,
        ..base.clone()
    };
    config.city.roads.count = ((f64::from(couriers) / COURIERS_PER_STREET) as u32).max(12);
    let orders = &mut config.delivery.orders;
    orders.customers = couriers * PEOPLE_PER_COURIER;
    (orders.per_customer_hour, orders.initial) = (ORDERS_PER_HOUR, couriers / 2);
    orders.told_within = TOLD_WITHIN;
    config
}

/// No preset of that name.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("there is no preset {name}: give main, competition, orders, money, persona or scale")]
pub struct PresetError {
    name: String,
}

impl FromStr for Preset {
    type Err = PresetError;

    fn from_str(name: &str) -> Result<Self, PresetError> {
        let found = Self::ALL.into_iter().find(|preset| preset.as_str() == name);
        found.ok_or_else(|| PresetError { name: name.to_owned() })
    }
}

impl fmt::Display for Preset {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.as_str())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_arm_can_be_run_and_has_a_name_of_its_own() {
        for preset in Preset::ALL {
            let arms = preset.arms(&RunConfig::default());
            for (index, arm) in arms.iter().enumerate() {
                arm.config.validate().unwrap();
                assert!(arms[..index].iter().all(|other| other.name != arm.name), "{}", arm.name);
            }
            assert_eq!(preset.as_str().parse(), Ok(preset));
        }
    }

    #[test]
    fn the_competition_is_that_of_the_paper() {
        let arms = Preset::Competition.arms(&RunConfig::default());
        let config = &arms[0].config;
        assert_eq!((config.agents, config.steps, config.delivery.capacity), (24, 1000, 1));
        assert!((config.delivery.orders.hunger_rate - 0.9).abs() < 1e-12 && !config.delivery.prices.drift);
        assert_eq!(config.policies.len() * 2, config.agents as usize);
    }
}
