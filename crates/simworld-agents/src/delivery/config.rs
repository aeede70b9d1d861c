//! Every constant of the delivery task in one structure, each with its unit, range and source.
//!
//! "Paper" is the case study of the `SimWorld` paper. What the paper leaves open is chosen here and said to be: the
//! "ancestor" is an early public version of the task without bidding, the "sibling" a later benchmark of the same
//! group.

use std::fmt::Display;

use serde::{Deserialize, Serialize};
use simworld_core::seam::TaskError;

use super::auction::AuctionRule;
use super::battery::BatteryConfig;
use super::board::EVERYWHERE;
use super::money::Cents;
use super::weather::WeatherConfig;

/// The settings of a [`DeliveryTask`](super::DeliveryTask). The default is the paper's main setting.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct DeliveryConfig {
    /// Steps after which the episode is truncated, in [1, 10⁹]. Paper: 5000; at 0.1 s they are 500 s.
    pub steps: u64,
    /// Most orders a courier holds at once, in [1, 100]. Paper: 1 in the competition; else open, 3 is chosen.
    pub capacity: u32,
    /// What a courier owns at the start, cents, in [0, 10⁹]. Open in the paper, which sweeps it; $100 is what a
    /// scooter costs, so the sweep straddles the choice to buy one.
    pub initial_money: Cents,
    /// How far ahead couriers plan, s, in [1, 10⁶]: nobody knows when an episode ends. Chosen: 500 s, the length of the
    /// paper's main run.
    pub horizon: f64,
    /// Who orders, how often, and what is offered.
    pub orders: OrderConfig,
    /// How orders find their courier.
    pub auction: AuctionConfig,
    /// What moving costs and rest gives.
    pub energy: EnergyConfig,
    /// How fast couriers move.
    pub speed: SpeedConfig,
    /// What is sold, and how prices move.
    pub prices: PriceConfig,
    /// What moves scooters.
    pub battery: BatteryConfig,
    /// What the weather does.
    pub weather: WeatherConfig,
    /// How couriers work together.
    pub sharing: SharingConfig,
    /// When one has arrived.
    pub reach: ReachConfig,
}

impl Default for DeliveryConfig {
    fn default() -> Self {
        Self {
            steps: 5000,
            capacity: 3,
            initial_money: Cents(10_000),
            horizon: 500.0,
            orders: OrderConfig::default(),
            auction: AuctionConfig::default(),
            energy: EnergyConfig::default(),
            speed: SpeedConfig::default(),
            prices: PriceConfig::default(),
            battery: BatteryConfig::default(),
            weather: WeatherConfig::default(),
            sharing: SharingConfig::default(),
            reach: ReachConfig::default(),
        }
    }
}

/// Who orders, how often, and what is offered.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct OrderConfig {
    /// Customers, each living in a home drawn at reset, in [1, 10⁷]. Chosen so that some sixty orders come in
    /// the main setting, half again what twenty couriers deliver by the paper's success counts.
    pub customers: u32,
    /// Orders a customer places in an hour when hungry all the time, in [0, 10 000]. Chosen as `customers`.
    pub per_customer_hour: f64,
    /// The share of that rate which is in force, in [0, 1]. Paper: 0.9 in the competition; else open, 0.5 chosen.
    pub hunger_rate: f64,
    /// Orders that are open at the start, in [0, 100 000]. Chosen as many as there are couriers, so that nobody begins idle.
    pub initial: u32,
    /// Ceiling price before distance, cents, in [0, 10⁷]. Ancestor: prices uniform in $15 to $25.
    pub base: Cents,
    /// Ceiling price for each kilometre of route, cents, in [0, 10⁷]. Sibling: $10.
    pub per_kilometre: Cents,
    /// Least factor on the ceiling, in [0.01, 100]. Sibling: 0.75.
    pub least_factor: f64,
    /// Greatest factor on the ceiling, in [`least_factor`, 100]. Sibling: 1.35.
    pub greatest_factor: f64,
    /// A customer orders from a restaurant within this distance if there is one, and else from the nearest, m, in
    /// [1, 10⁶]. Chosen so that an order is a walk of about 500 m, the way to the restaurant included, as the paper's
    /// counts imply.
    pub radius: f64,
    /// Couriers are told of orders whose restaurant is within this distance of them, and of offers to share that meet there,
    /// m, in [100, 10⁶]; from 10⁶ on of all. Chosen: of all, as in the paper; in a large city platforms tell those who are near.
    pub told_within: f64,
    /// Time allowed for an order over that of walking from where it was won through the restaurant to the home by the shortest
    /// way along sidewalks, in [0.1, 100]. Ancestor: 1.25. The paper says nothing of how deadlines are set; by the ways that
    /// there are is how a dispatcher reckons.
    pub allowance: f64,
    /// The walking speed on which the allowance is reckoned, m/s, in [0.1, 50]. Ancestor: 1.6.
    pub allowance_speed: f64,
    /// Mass of a parcel, kg, in [0.01, 1000]. Chosen: a meal for two, 2 kg.
    pub parcel: f64,
    /// Deduction for each second late, cents, in [0, 10⁶]. Ancestor: $0.30.
    pub late_per_second: Cents,
    /// Share of the price that is paid however late, in [0, 1]. Ancestor: 0.5.
    pub late_floor: f64,
}

impl Default for OrderConfig {
    fn default() -> Self {
        Self {
            customers: 120,
            per_customer_hour: 7.0,
            hunger_rate: 0.5,
            initial: 20,
            base: Cents(1000),
            per_kilometre: Cents(1000),
            least_factor: 0.75,
            greatest_factor: 1.35,
            radius: 400.0,
            told_within: EVERYWHERE,
            allowance: 1.25,
            allowance_speed: 1.6,
            parcel: 2.0,
            late_per_second: Cents(30),
            late_floor: 0.5,
        }
    }
}

/// How orders find their courier.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct AuctionConfig {
    /// Who wins and what is paid. Paper: "lower bid prices ... more likely to be accepted".
    pub rule: AuctionRule,
    /// How long bids are taken, s, in [0.1, 10⁵]. Chosen: 30 s.
    pub window: f64,
}

impl Default for AuctionConfig {
    fn default() -> Self {
        Self { rule: AuctionRule::FirstPrice, window: 30.0 }
    }
}

/// What moving costs and rest gives. A courier is full at `capacity`.
///
/// On foot moving costs the metabolic energy of core's [`Exertion`](simworld_core::exertion::Exertion), by the speed walked, the slope, the parcels carried and the snow
/// that lies. `walking`, `walking_speed` and `body` say how many joules a unit of energy is ([`joules`](Self::joules)), and so keep
/// the scale of what the task asks: by default 2,379 J, a full courier 238 kJ or 57 kcal.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct EnergyConfig {
    /// A full courier, in [1, 10⁶]. Ancestor and sibling: 100.
    pub capacity: f64,
    /// Cost of a metre on level pavement at `walking_speed` with empty hands, in [0, 1000]. Ancestor and sibling agree on 0.1
    /// within 20 %.
    pub walking: f64,
    /// The speed at which a metre costs `walking`, m/s, in [0.1, 50]. A comfortable walk: 1.4.
    pub walking_speed: f64,
    /// Mass of the body for which a metre costs `walking`, and of every courier whose entity says none, kg, in [1, 1000]. The mass
    /// that people have under physics: 75.
    pub body: f64,
    /// Cost of a metre on a scooter, in [0, 1000]. Ancestor and sibling: 0.01.
    pub riding: f64,
    /// What a second of rest gives back, in [0, 1000]. Chosen: 0.1, so that a rest from empty to `ready` takes
    /// 200 s and a drink is the better deal for whoever has work.
    pub rest: f64,
    /// At this level an exhausted courier gets up again, in (0, `capacity`]. Chosen: 20.
    pub ready: f64,
    /// Below this level a courier is told that it is low, in [0, `capacity`]. Chosen: 30.
    pub low: f64,
}

impl Default for EnergyConfig {
    fn default() -> Self {
        Self {
            capacity: 100.0,
            walking: 0.1,
            walking_speed: 1.4,
            body: 75.0,
            riding: 0.01,
            rest: 0.1,
            ready: 20.0,
            low: 30.0,
        }
    }
}

/// How fast couriers move, m/s.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SpeedConfig {
    /// Slowest walk, in [0.1, 50]. Ancestor: 1.0.
    pub slowest: f64,
    /// The walk at the start, in [`slowest`, `fastest`]. A comfortable walk: 1.4.
    pub walking: f64,
    /// Fastest walk, in [`slowest`, 50]. Ancestor: 2.5.
    pub fastest: f64,
    /// On a scooter, in [`slowest`, 50]. The limit of e-scooters: 25 km/h.
    pub riding: f64,
}

impl Default for SpeedConfig {
    fn default() -> Self {
        Self { slowest: 1.0, walking: 1.4, fastest: 2.5, riding: 25.0 / 3.6 }
    }
}

/// Where one has to be to buy something.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Shopping {
    /// Anywhere, by app. The paper does not say that a courier goes to a shop, so this is the default.
    #[default]
    Anywhere,
    /// At the access point of a store: a purchase sends the courier to the nearest one.
    AtStore,
}

/// What is sold, and how prices move.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PriceConfig {
    /// Where one has to be to buy.
    pub shopping: Shopping,
    /// A scooter, cents, in [1, 10⁷]. Ancestor: $100.
    pub scooter: Cents,
    /// A drink, cents, in [1, 10⁷]. Ancestor: $5.
    pub drink: Cents,
    /// Energy that a drink gives, in (0, 10⁶]. Ancestor: 60.
    pub drink_energy: f64,
    /// Whether prices move. Paper: "fluctuating prices"; off in the competition.
    pub drift: bool,
    /// Time between two moves, s, in [0.1, 10⁵]. Chosen: 10 s.
    pub interval: f64,
    /// Standard deviation of a move, in [0, 1]. Chosen: 0.02.
    pub volatility: f64,
    /// A move per unit of demand, that is of purchases per courier (goods) or of the share of auctions that ended
    /// without a bid (ceilings), in [0, 10]. Chosen: 0.1.
    pub demand_gain: f64,
    /// Prices stay within this factor of their start, up and down, in [1, 10]. Chosen: 1.25.
    pub bound: f64,
}

impl Default for PriceConfig {
    fn default() -> Self {
        Self {
            shopping: Shopping::Anywhere,
            scooter: Cents(10_000),
            drink: Cents(500),
            drink_energy: 60.0,
            drift: true,
            interval: 10.0,
            volatility: 0.02,
            demand_gain: 0.1,
            bound: 1.25,
        }
    }
}

/// How the pay of a shared order is split.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Split {
    /// By the distance each carried the parcel (chosen: it pays for work done).
    #[default]
    Distance,
    /// In halves (ancestor).
    Equal,
    /// The second courier gets the bounty that the first put into escrow, and no more.
    Bounty,
}

/// How couriers work together.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SharingConfig {
    /// How the pay is split.
    pub split: Split,
}

/// Distances in the plane at which one has arrived, m.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ReachConfig {
    /// On foot, to an access point, in [0.5, 100]. Ancestor: 2.
    pub walking: f64,
    /// On a scooter, to an access point, in [0.5, 100]. Ancestor: 4.
    pub riding: f64,
    /// To a meet-point, and between the couriers that meet, in [0.5, 100]. Ancestor: 5.
    pub meeting: f64,
}

impl Default for ReachConfig {
    fn default() -> Self {
        Self { walking: 2.0, riding: 4.0, meeting: 5.0 }
    }
}

impl DeliveryConfig {
    /// The competition of the paper: 1000 steps, one order a courier, hunger 0.9, fixed prices. Orders are scarce at the
    /// start, one for four couriers, so that bids meet.
    pub fn competition() -> Self {
        Self {
            steps: 1000,
            capacity: 1,
            orders: OrderConfig { hunger_rate: 0.9, initial: 6, ..OrderConfig::default() },
            prices: PriceConfig { drift: false, ..PriceConfig::default() },
            ..Self::default()
        }
    }

    /// Checks every value against its range.
    ///
    /// # Errors
    /// The first field out of range, as a path, with its value and what is allowed.
    pub fn validate(&self) -> Result<(), TaskError> {
        within("steps", self.steps, 1, 1_000_000_000)?;
        within("capacity", self.capacity, 1, 100)?;
        within("initial_money", self.initial_money.0, 0, 1_000_000_000)?;
        within("horizon", self.horizon, 1.0, 1e6)?;
        self.orders.validate()?;
        within("auction.window", self.auction.window, 0.1, 1e5)?;
        if let AuctionRule::Softmin { temperature } = self.auction.rule {
            within("auction.rule.softmin.temperature", temperature, 1e-3, 1e3)?;
        }
        self.energy.validate()?;
        self.speed.validate()?;
        self.prices.validate()?;
        self.battery.validate()?;
        self.weather.validate()?;
        within("reach.walking", self.reach.walking, 0.5, 100.0)?;
        within("reach.riding", self.reach.riding, 0.5, 100.0)?;
        within("reach.meeting", self.reach.meeting, 0.5, 100.0)
    }
}

impl OrderConfig {
    fn validate(&self) -> Result<(), TaskError> {
        within("orders.customers", self.customers, 1, 10_000_000)?;
        within("orders.per_customer_hour", self.per_customer_hour, 0.0, 1e4)?;
        within("orders.hunger_rate", self.hunger_rate, 0.0, 1.0)?;
        within("orders.initial", self.initial, 0, 100_000)?;
        within("orders.base", self.base.0, 0, 10_000_000)?;
        within("orders.per_kilometre", self.per_kilometre.0, 0, 10_000_000)?;
        within("orders.least_factor", self.least_factor, 0.01, 100.0)?;
        within("orders.greatest_factor", self.greatest_factor, self.least_factor, 100.0)?;
        within("orders.radius", self.radius, 1.0, 1e6)?;
        within("orders.told_within", self.told_within, 100.0, EVERYWHERE)?;
        within("orders.allowance", self.allowance, 0.1, 100.0)?;
        within("orders.allowance_speed", self.allowance_speed, 0.1, 50.0)?;
        within("orders.parcel", self.parcel, 0.01, 1000.0)?;
        within("orders.late_per_second", self.late_per_second.0, 0, 1_000_000)?;
        within("orders.late_floor", self.late_floor, 0.0, 1.0)
    }
}

impl EnergyConfig {
    fn validate(&self) -> Result<(), TaskError> {
        within("energy.capacity", self.capacity, 1.0, 1e6)?;
        within("energy.walking", self.walking, 0.0, 1000.0)?;
        within("energy.walking_speed", self.walking_speed, 0.1, 50.0)?;
        within("energy.body", self.body, 1.0, 1000.0)?;
        within("energy.riding", self.riding, 0.0, 1000.0)?;
        within("energy.rest", self.rest, 0.0, 1000.0)?;
        within("energy.ready", self.ready, 1e-3, self.capacity)?;
        within("energy.low", self.low, 0.0, self.capacity)
    }
}

impl SpeedConfig {
    fn validate(&self) -> Result<(), TaskError> {
        within("speed.slowest", self.slowest, 0.1, 50.0)?;
        within("speed.fastest", self.fastest, self.slowest, 50.0)?;
        within("speed.walking", self.walking, self.slowest, self.fastest)?;
        within("speed.riding", self.riding, self.slowest, 50.0)
    }
}

impl PriceConfig {
    fn validate(&self) -> Result<(), TaskError> {
        within("prices.scooter", self.scooter.0, 1, 10_000_000)?;
        within("prices.drink", self.drink.0, 1, 10_000_000)?;
        within("prices.drink_energy", self.drink_energy, 1e-3, 1e6)?;
        within("prices.interval", self.interval, 0.1, 1e5)?;
        within("prices.volatility", self.volatility, 0.0, 1.0)?;
        within("prices.demand_gain", self.demand_gain, 0.0, 10.0)?;
        within("prices.bound", self.bound, 1.0, 10.0)
    }
}

/// An incomparable value, such as NaN, is out of every range.
pub(super) fn within<T: PartialOrd + Display + Copy>(
    field: &str,
    value: T,
    low: T,
    high: T,
) -> Result<(), TaskError> {
    if value >= low && value <= high {
        return Ok(());
    }
    let (field, value) = (field.to_owned(), value.to_string());
    Err(TaskError::Config { field, value, allowed: format!("{low} to {high}") })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_settings_of_the_paper_are_in_range() {
        assert_eq!(DeliveryConfig::default().validate(), Ok(()));
        assert_eq!(DeliveryConfig::competition().validate(), Ok(()));
    }

    #[test]
    fn a_value_out_of_range_is_named() {
        let mut config = DeliveryConfig::default();
        config.energy.walking = f64::NAN;
        let error = config.validate().unwrap_err().to_string();
        assert_eq!(error, "energy.walking = NaN is out of range: give 0 to 1000");
        config = DeliveryConfig { capacity: 0, ..DeliveryConfig::default() };
        assert!(config.validate().unwrap_err().to_string().starts_with("capacity = 0"));
        config = DeliveryConfig::default();
        config.orders.greatest_factor = 0.5;
        assert!(config.validate().unwrap_err().to_string().contains("0.75 to 100"));
    }

    #[test]
    fn an_unknown_key_is_refused() {
        let error = serde_json::from_str::<DeliveryConfig>(r#"{"energy":{"walkin":1}}"#).unwrap_err();
        assert!(error.to_string().contains("unknown field `walkin`"));
    }
}
