//! Figures of merit: the paper's five, the two it promises besides, and a row a courier.

use serde::{Deserialize, Serialize};
use simworld_core::id::EntityId;
use simworld_core::seam::Metric;

use super::action::CourierAction;
use super::config::DeliveryConfig;
use super::money::{Account, Cents};
use super::state::State;

/// How one courier fared.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CourierRow {
    /// Who.
    pub courier: EntityId,
    /// What it owns now less what it owned at the start; a bounty in escrow counts as spent.
    pub profit: Cents,
    /// What it was paid for orders.
    pub earned: Cents,
    /// Bids placed.
    pub bids: u32,
    /// Mean bid, dollars; zero without bids.
    pub mean_bid: f64,
    /// Orders won.
    pub won: u32,
    /// Orders picked up.
    pub picked_up: u32,
    /// Orders brought home, its own and those taken over.
    pub delivered: u32,
    /// Of these, how many late.
    pub late: u32,
    /// Orders offered for sharing.
    pub shared: u32,
    /// Orders handed over to somebody else.
    pub handed_over: u32,
    /// Scooters bought: the paper's strategic investments.
    pub scooters: u32,
    /// Drinks bought.
    pub drinks: u32,
    /// Batteries swapped.
    pub swaps: u32,
    /// Energy taken out of the battery of its scooter, Wh.
    pub power: f64,
    /// Times it ran out of energy.
    pub exhaustions: u32,
    /// Energy consumed.
    pub energy: f64,
    /// Distance moved, m.
    pub distance: f64,
    /// Mean time from award to delivery of the orders it brought home, s; zero without any.
    pub completion_time: f64,
    /// Actions that were carried out, by name in the order of [`CourierAction::NAMES`].
    pub actions: Vec<(String, u32)>,
    /// Intents that were refused.
    pub refused: u32,
}

/// How everybody fared.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DeliveryReport {
    /// One row a courier, in the order of agents.
    pub couriers: Vec<CourierRow>,
    /// Orders posted.
    pub posted: u32,
    /// Orders won by somebody.
    pub awarded: u32,
    /// Orders brought home.
    pub delivered: u32,
    /// Orders nobody wanted.
    pub expired: u32,
    /// Mean time from award to delivery, s; zero without deliveries.
    pub completion_time: f64,
}

impl DeliveryReport {
    pub(super) fn new(config: &DeliveryConfig, state: &State) -> Self {
        let couriers: Vec<CourierRow> =
            (0..state.couriers.len()).map(|index| row(config, state, index)).collect();
        let stage =
            |name: &str| state.orders.iter().filter(|order| order.stage.name() == name).count() as u32;
        let (open, expired, delivered) = (stage("open"), stage("expired"), stage("delivered"));
        let posted = state.orders.len() as u32;
        let completion: f64 = state.couriers.iter().map(|courier| courier.tally.completion).sum();
        Self {
            couriers,
            posted,
            awarded: posted - open - expired,
            delivered,
            expired,
            completion_time: ratio(completion, f64::from(delivered)),
        }
    }

    fn sum(&self, of: impl Fn(&CourierRow) -> f64) -> f64 {
        self.couriers.iter().map(of).sum()
    }

    /// The figures of merit.
    ///
    /// The paper contradicts itself twice, so both readings are given: it shows the success rate as a count
    /// (`orders_per_agent`) and defines it as a rate (`success_rate`); it defines energy efficiency as energy over
    /// revenue (`energy_per_dollar`, less is better) and prints the largest in bold (`dollars_per_energy`).
    pub fn metrics(&self) -> Vec<Metric> {
        let agents = self.couriers.len() as f64;
        let (earned, energy) = (self.sum(|row| row.earned.dollars()), self.sum(|row| row.energy));
        let bids = self.sum(|row| f64::from(row.bids));
        vec![
            Metric::new("profit", ratio(self.sum(|row| row.profit.dollars()), agents), "$"),
            Metric::new("orders_per_agent", ratio(f64::from(self.delivered), agents), "1"),
            Metric::new("success_rate", ratio(f64::from(self.delivered), f64::from(self.awarded)), "1"),
            Metric::new("energy_per_dollar", ratio(energy, earned), "1/$"),
            Metric::new("dollars_per_energy", ratio(earned, energy), "$"),
            Metric::new("sharing_count", self.sum(|row| f64::from(row.shared)), "1"),
            Metric::new("hand_over_count", self.sum(|row| f64::from(row.handed_over)), "1"),
            Metric::new("investment_count", self.sum(|row| f64::from(row.scooters)), "1"),
            Metric::new("drink_count", self.sum(|row| f64::from(row.drinks)), "1"),
            Metric::new("delivery_rate", ratio(f64::from(self.delivered), f64::from(self.posted)), "1"),
            Metric::new("completion_time", self.completion_time, "s"),
            Metric::new("bid_win_rate", ratio(self.sum(|row| f64::from(row.won)), bids), "1"),
        ]
    }
}

fn row(config: &DeliveryConfig, state: &State, index: usize) -> CourierRow {
    let courier = &state.couriers[index];
    let tally = &courier.tally;
    let names = CourierAction::NAMES.iter().map(|name| (*name).to_owned());
    CourierRow {
        courier: courier.id,
        profit: state.ledger.balance(Account::Courier(index)) - config.initial_money,
        earned: tally.earned,
        bids: tally.bids,
        mean_bid: ratio(tally.bid_sum.dollars(), f64::from(tally.bids)),
        won: tally.won,
        picked_up: tally.picked_up,
        delivered: tally.delivered,
        late: tally.late,
        shared: tally.shared,
        handed_over: tally.handed_over,
        scooters: tally.scooters,
        drinks: tally.drinks,
        swaps: tally.swaps,
        power: tally.power,
        exhaustions: tally.exhaustions,
        energy: tally.energy,
        distance: tally.distance,
        completion_time: ratio(tally.completion, f64::from(tally.delivered)),
        actions: names.zip(tally.actions).collect(),
        refused: tally.refused,
    }
}

/// Zero over anything is zero, also over zero: a figure of merit is finite.
fn ratio(part: f64, whole: f64) -> f64 {
    if whole > 0.0 { part / whole } else { 0.0 }
}
