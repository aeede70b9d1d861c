//! Batteries of scooters: drained by the way, its speed and its load; swapped at charging stations for money.

use serde::{Deserialize, Serialize};
use simworld_core::action::Action;
use simworld_core::command::Command;
use simworld_core::geometry::Pose;
use simworld_core::scene::{Attachment, Role};
use simworld_core::seam::TaskError;

use super::body::BESIDE;
use super::config::within;
use super::money::{Account, Cents};
use super::state::{Errand, Ride};
use super::turn::Turn;

/// Standard gravity, m/s².
const GRAVITY: f64 = 9.80665;
/// Density of air at 15 °C and sea level, kg/m³ (ISA).
const AIR: f64 = 1.225;
/// Joules in a watt-hour.
const WATT_HOUR: f64 = 3600.0;

/// What moves scooters.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Power {
    /// Power without end: the paper knows no batteries.
    #[default]
    Unlimited,
    /// A battery that empties and is swapped at charging stations.
    Battery,
}

/// The batteries of scooters. The resistance is that of the textbook: rolling, and air with the square of the speed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct BatteryConfig {
    /// Whether scooters have batteries. Chosen: no, as in the paper.
    pub power: Power,
    /// What a full one holds, Wh, in [0.1, 10⁵]. That of the Xiaomi M365: 280 Wh.
    pub capacity: f64,
    /// The share that it holds when the scooter is bought, in [0.01, 1]. Chosen: 1.
    pub at_purchase: f64,
    /// Mass of scooter and rider, kg, in [1, 1000]. A scooter of 15 kg and a person of 75 kg.
    pub mass: f64,
    /// Coefficient of rolling resistance, in [0, 1]. Small tyres on asphalt: 0.015.
    pub rolling: f64,
    /// Drag coefficient times frontal area, m², in [0, 10]. Who stands upright: 0.6 m².
    pub drag_area: f64,
    /// The share of the battery's energy that reaches the road, in [0.01, 1]. Hub motors: 0.7.
    pub efficiency: f64,
    /// Below this share a courier is told that the battery is low, in [0, 1]. Chosen: 0.2.
    pub low: f64,
    /// Price of a full battery for an empty one, cents, in [0, 10⁷]. Chosen: $2.
    pub swap: Cents,
    /// Greatest speed of who drags an empty scooter, m/s, in [0.1, 50]. Chosen: a slow walk, 0.9.
    pub dragging_speed: f64,
    /// A metre of dragging tires as much as so many metres on foot, in [1, 100]. Pushing 15 kg; chosen: 1.5.
    pub dragging_effort: f64,
}

impl Default for BatteryConfig {
    fn default() -> Self {
        Self {
            power: Power::Unlimited,
            capacity: 280.0,
            at_purchase: 1.0,
            mass: 90.0,
            rolling: 0.015,
            drag_area: 0.6,
            efficiency: 0.7,
            low: 0.2,
            swap: Cents(200),
            dragging_speed: 0.9,
            dragging_effort: 1.5,
        }
    }
}

impl BatteryConfig {
    pub(super) fn validate(&self) -> Result<(), TaskError> {
        within("battery.capacity", self.capacity, 0.1, 1e5)?;
        within("battery.at_purchase", self.at_purchase, 0.01, 1.0)?;
        within("battery.mass", self.mass, 1.0, 1000.0)?;
        within("battery.rolling", self.rolling, 0.0, 1.0)?;
        within("battery.drag_area", self.drag_area, 0.0, 10.0)?;
        within("battery.efficiency", self.efficiency, 0.01, 1.0)?;
        within("battery.low", self.low, 0.0, 1.0)?;
        within("battery.swap", self.swap.0, 0, 10_000_000)?;
        within("battery.dragging_speed", self.dragging_speed, 0.1, 50.0)?;
        within("battery.dragging_effort", self.dragging_effort, 1.0, 100.0)
    }

    /// What a metre takes out of the battery at a speed in m/s with a load in kg, Wh.
    pub fn per_metre(&self, speed: f64, load: f64) -> f64 {
        let mass = self.mass + load;
        let rolling = mass * GRAVITY * self.rolling;
        let air = 0.5 * AIR * self.drag_area * speed * speed;
        (rolling + air) / self.efficiency / WATT_HOUR
    }

    /// What a new scooter's battery holds, Wh.
    pub(super) fn when_bought(&self) -> f64 {
        self.capacity * self.at_purchase
    }
}

impl Turn<'_> {
    /// Takes out of a battery what riding that far took, m; an empty one ends the ride.
    pub(super) fn drain(&mut self, index: usize, moved: f64, speed: f64) {
        let Ride::Riding(scooter) = self.state.couriers[index].ride else { return };
        if self.config.battery.power == Power::Unlimited {
            return;
        }
        let used = moved * self.config.battery.per_metre(speed, self.state.couriers[index].exertion.load);
        let courier = &mut self.state.couriers[index];
        let left = (courier.charge - used).max(0.0);
        courier.tally.power += courier.charge - left;
        courier.charge = left;
        let low = left < self.config.battery.low * self.config.battery.capacity;
        if low && !courier.low_charge {
            courier.low_charge = true;
            courier.notices += 1;
        }
        if left > 0.0 {
            return;
        }
        // From now on the scooter is pushed: off it, and a hand at its bar.
        let who = courier.id;
        courier.ride = Ride::Dragging(scooter);
        self.command(Command::Actuate { who, action: Action::GetOffScooter });
        let bond = Attachment {
            parent: who,
            role: Role::Part,
            parent_from_body: Pose::translation(0.0, BESIDE, 0.0),
        };
        self.command(Command::Attach { child: scooter, bond: Some(bond) });
        self.tell("battery_empty", Some(index), &[("scooter", scooter.into())]);
        self.send(index); // goes on, slowly
    }

    /// Sets out for a charging station.
    pub(super) fn go_swap(&mut self, index: usize) -> Result<(), String> {
        let battery = &self.config.battery;
        if battery.power == Power::Unlimited {
            return Err("scooters have no batteries here".to_owned());
        }
        let courier = &self.state.couriers[index];
        if matches!(courier.ride, Ride::None | Ride::Ordered) {
            return Err("you have no scooter".to_owned());
        }
        if courier.charge >= battery.capacity {
            return Err("your battery is full".to_owned());
        }
        self.set_out(index, Errand::Swap)
    }

    /// At the station: an empty battery and money for a full one.
    pub(super) fn swap(&mut self, index: usize) -> Result<(), String> {
        let price = self.config.battery.swap;
        let payment = self.pay(Account::Courier(index), Account::Shops, price, None);
        payment.map_err(|error| error.to_string())?;
        let courier = &mut self.state.couriers[index];
        courier.charge = self.config.battery.capacity;
        courier.low_charge = false;
        courier.tally.swaps += 1;
        if let Ride::Dragging(scooter) = courier.ride {
            courier.ride = Ride::Beside(scooter);
            self.command(Command::Attach { child: scooter, bond: None });
        }
        self.tell("battery_swapped", Some(index), &[("price", price.dollars().into())]);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_full_battery_lasts_as_far_as_riders_say() {
        let battery = BatteryConfig::default();
        assert_eq!(battery.validate(), Ok(()));
        let range = battery.capacity / battery.per_metre(25.0 / 3.6, 0.0) / 1000.0;
        // The maker says 30 km at 15 km/h; riders get 20 at full speed.
        assert!((18.0..30.0).contains(&range), "{range} km");
        assert!(battery.per_metre(6.0, 6.0) > battery.per_metre(6.0, 0.0));
        assert!(battery.per_metre(6.0, 0.0) > battery.per_metre(3.0, 0.0));
    }
}
