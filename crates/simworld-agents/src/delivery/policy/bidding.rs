//! What to bid for and how much.

use serde::{Deserialize, Serialize};
use simworld_core::ops;
use simworld_core::seed::StreamRng;

use super::PolicyKind;
use super::pace::{backlog, pending, time_at, working_speed};
use crate::delivery::{BidResult, Cents, CourierView, OpenOrder};

/// What a second is worth to a courier, $: three quarters of what one earns who is paid the usual ceiling of $15 for the
/// usual job, some 500 m that take 360 s on foot with all waits. Who has work to choose from asks for no less.
const WAGE: f64 = 0.03;
/// Share of the energy of a job that is made up for by drinks; the rest comes back while waiting.
const DRUNK_SHARE: f64 = 0.5;
/// Shares of the ceiling among which EXP3 learns.
const ARMS: [f64; 7] = [0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0];
/// Exploration of EXP3; the usual choice for some tens of rounds.
const EXPLORATION: f64 = 0.2;
/// A restaurant farther off is none of a nearest-only courier's business, m.
const CLOSE: f64 = 200.0;

/// What a policy has learnt from how its bids ended.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Learner {
    margin: f64,
    weights: Vec<f64>,
    /// Results taken in so far.
    known: u64,
}

impl Default for Learner {
    fn default() -> Self {
        Self { margin: 0.35, weights: vec![1.0; ARMS.len()], known: 0 }
    }
}

impl Learner {
    /// Takes in how bids ended since last time.
    pub(super) fn learn(&mut self, view: &CourierView<'_>) {
        let (results, known) = view.results_since(self.known);
        self.known = known;
        for result in results {
            let step = if result.won { 0.05 } else { -0.04 };
            self.margin = (self.margin + step).clamp(0.0, 2.0);
            self.reinforce(result);
        }
    }

    /// EXP3: the arm that was played gains by its reward over its probability.
    fn reinforce(&mut self, result: &BidResult) {
        let share = result.price.0 as f64 / result.ceiling.0.max(1) as f64;
        let arm = nearest_arm(share);
        let reward = if result.won { share.min(1.0) } else { 0.0 };
        let probability = self.probabilities()[arm];
        self.weights[arm] *= ops::exp(EXPLORATION * reward / (probability * ARMS.len() as f64));
        let most = self.weights.iter().copied().fold(1.0, f64::max);
        for weight in &mut self.weights {
            *weight = (*weight / most).max(1e-9); // only their proportions matter
        }
    }

    fn probabilities(&self) -> Vec<f64> {
        let total: f64 = self.weights.iter().sum();
        let even = EXPLORATION / ARMS.len() as f64;
        self.weights.iter().map(|weight| (1.0 - EXPLORATION) * weight / total + even).collect()
    }
}

fn nearest_arm(share: f64) -> usize {
    let gap = |arm: &usize| (ARMS[*arm] - share).abs();
    (0..ARMS.len()).min_by(|a, b| gap(a).total_cmp(&gap(b))).unwrap_or(0)
}

/// What work takes of a courier as it stands: reckoned once, and not for every order that it may choose.
struct Means<'a> {
    view: CourierView<'a>,
    /// At which it works, m/s.
    speed: f64,
    /// Energy that a metre takes at that speed.
    per_metre: f64,
    /// What is left to walk for the orders in hand, m.
    backlog: f64,
}

impl<'a> Means<'a> {
    fn of(view: &CourierView<'a>) -> Self {
        let speed = working_speed(view);
        let per_metre = view.per_metre(speed);
        Self { view: *view, speed, per_metre, backlog: backlog(view) }
    }

    /// What a job costs in time, energy and lateness, $.
    ///
    /// Who holds orders already comes to this one later, and pays for that what the customer deducts.
    fn cost(&self, order: &OpenOrder) -> f64 {
        let config = self.view.config();
        let length = order.approach + order.route;
        let drinks = length * self.per_metre / config.prices.drink_energy;
        let orders = &config.orders;
        let late =
            time_at(self.speed, self.backlog + length) - orders.allowance * length / orders.allowance_speed;
        let deducted = (late.max(0.0) * orders.late_per_second.dollars())
            .min((1.0 - orders.late_floor) * order.ceiling.dollars());
        WAGE * time_at(self.speed, length)
            + DRUNK_SHARE * drinks * self.view.drink_price().dollars()
            + deducted
    }
}

/// Chooses among the orders that take bids one to bid for, and a price, before the persona has its say.
///
/// Of what is as good the newest is taken, of what is as near the oldest.
pub(super) fn choose(
    kind: PolicyKind,
    learner: &Learner,
    view: &CourierView<'_>,
    rng: &mut StreamRng,
) -> Option<(OpenOrder, f64)> {
    let means = Means::of(view);
    let cost = |order: &OpenOrder| means.cost(order);
    let (horizon, backlog) = (view.config().horizon, means.backlog + pending(view));
    // What cannot be finished within what it plans, or brings less than it costs, is left to others.
    let worth_it = |order: &OpenOrder| {
        let work = time_at(means.speed, backlog + order.approach + order.route);
        order.closes_in + work <= horizon && cost(order) < order.ceiling.dollars()
    };
    let open = view.tenders().filter(|order| order.own_bid.is_none() && worth_it(order));
    let order = match kind {
        PolicyKind::NearestOnly => {
            let nearer = |a: &OpenOrder, b: &OpenOrder| {
                a.approach.total_cmp(&b.approach).then_with(|| a.id.cmp(&b.id))
            };
            open.filter(|order| order.approach <= CLOSE).min_by(nearer)
        }
        PolicyKind::ValueDensity => {
            best(open, |order| order.ceiling.dollars() / (order.approach + order.route).max(1.0))
        }
        PolicyKind::WideRandom | PolicyKind::Lowballer => {
            let mut all: Vec<OpenOrder> = open.collect();
            all.sort_unstable_by_key(|order| order.id);
            rng.choose(&all).copied()
        }
        _ => best(open, |order| order.ceiling.dollars() - cost(order)),
    }?;
    let (ceiling, cost) = (order.ceiling.dollars(), cost(&order));
    let price = match kind {
        PolicyKind::CostPlusLow => cost * 1.1,
        PolicyKind::CostPlusMedium => cost * 1.35,
        PolicyKind::CostPlusHigh => cost * 1.8,
        PolicyKind::FixedNarrow => ceiling * rng.uniform(0.88, 0.94),
        PolicyKind::WideRandom => ceiling * rng.uniform(0.35, 1.0),
        PolicyKind::WinRateAdaptive => cost * (1.0 + learner.margin),
        PolicyKind::Exp3 => ceiling * rng.weighted(&learner.probabilities()).map_or(1.0, |arm| ARMS[arm]),
        PolicyKind::BestResponse => {
            (ceiling * view.last_clearing().map_or(0.8, |share| share * 0.98)).max(cost)
        }
        PolicyKind::NearestOnly => ceiling * 0.75,
        PolicyKind::ValueDensity => cost * 1.25,
        PolicyKind::Lowballer => ceiling * 0.4,
        PolicyKind::NearlyInactive => ceiling * 0.85,
    };
    Some((order, price))
}

/// The order with the highest score, the newest of several, in whatever order they are read.
fn best(orders: impl Iterator<Item = OpenOrder>, score: impl Fn(&OpenOrder) -> f64) -> Option<OpenOrder> {
    let scored = orders.map(|order| (score(&order), order));
    let better =
        |a: &(f64, OpenOrder), b: &(f64, OpenOrder)| a.0.total_cmp(&b.0).then_with(|| a.1.id.cmp(&b.1.id));
    scored.max_by(better).map(|(_, order)| order)
}

/// A price that may be bid: at least a dollar or the ceiling, at most the ceiling.
pub(super) fn admissible(price: f64, ceiling: Cents) -> Cents {
    Cents::from_dollars(price).unwrap_or(ceiling).clamp(Cents(100).min(ceiling), ceiling)
}
