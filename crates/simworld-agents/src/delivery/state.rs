//! Everything the task knows, as data: what a snapshot keeps and the state hash covers.

use serde::{Deserialize, Serialize};
use simworld_core::geometry::{Point2, Point3};
use simworld_core::id::EntityId;
use simworld_core::seed::StreamRng;

use super::money::{Cents, Ledger};
use super::order::{Order, OrderId};

/// A place that somebody goes to.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Site {
    pub(super) entity: EntityId,
    pub(super) access: Point3,
}

/// What a courier can buy.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Item {
    /// A scooter.
    Scooter,
    /// A drink.
    Drink,
}

/// What a courier is on its way to do.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Errand {
    /// Nothing.
    Idle,
    /// To take an order at its restaurant.
    PickUp(OrderId),
    /// To bring an order home.
    Deliver(OrderId),
    /// To meet somebody over an order.
    Meet(OrderId),
    /// To buy something at the nearest store.
    Shop(Item),
}

/// A courier's scooter.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Ride {
    /// It has none.
    None,
    /// Bought in the last step; the world shows it in the next.
    Ordered,
    /// It stands beside its owner.
    Beside(EntityId),
    /// Its owner rides it.
    Riding(EntityId),
}

/// How a bid of a courier ended.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BidResult {
    /// What was bid.
    pub price: Cents,
    /// The ceiling of that order.
    pub ceiling: Cents,
    /// Whether it won.
    pub won: bool,
}

/// Counts of what a courier did.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Tally {
    /// Actions taken, by [`CourierAction::index`](super::CourierAction::index).
    pub(super) actions: [u32; 10],
    pub(super) refused: u32,
    pub(super) bids: u32,
    pub(super) bid_sum: Cents,
    pub(super) won: u32,
    pub(super) picked_up: u32,
    pub(super) delivered: u32,
    pub(super) late: u32,
    pub(super) shared: u32,
    pub(super) handed_over: u32,
    pub(super) scooters: u32,
    pub(super) drinks: u32,
    pub(super) exhaustions: u32,
    pub(super) earned: Cents,
    pub(super) energy: f64,
    pub(super) distance: f64,
    /// Time from award to delivery, s, summed over the orders it brought home.
    pub(super) completion: f64,
}

/// A courier.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Courier {
    pub(super) id: EntityId,
    /// As of the last step it was in the scene.
    pub(super) position: Point2,
    pub(super) energy: f64,
    pub(super) exhausted: bool,
    pub(super) low: bool,
    /// Speed wanted on foot, m/s.
    pub(super) walking: f64,
    /// Speed wanted on a scooter, m/s.
    pub(super) riding: f64,
    pub(super) ride: Ride,
    pub(super) errand: Errand,
    /// Counts what happened to this courier: a mind that sees it change has something to think about.
    pub(super) notices: u64,
    /// How its last bids ended, oldest first, and how many ended before those.
    pub(super) results: Vec<BidResult>,
    pub(super) results_before: u64,
    pub(super) tally: Tally,
}

impl Courier {
    pub(super) fn is_riding(&self) -> bool {
        matches!(self.ride, Ride::Riding(_))
    }

    pub(super) fn speed(&self) -> f64 {
        if self.is_riding() { self.riding } else { self.walking }
    }
}

/// Prices as factors on those of the settings, and the demand since they last moved.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Market {
    pub(super) ceiling: f64,
    pub(super) scooter: f64,
    pub(super) drink: f64,
    /// When they move next, s.
    pub(super) next: f64,
    pub(super) closed: u32,
    pub(super) unwanted: u32,
    pub(super) scooters: u32,
    pub(super) drinks: u32,
}

/// The state of an episode.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct State {
    /// Steps taken.
    pub(super) tick: u64,
    /// Length of a step, s.
    pub(super) dt: f64,
    pub(super) ledger: Ledger,
    pub(super) couriers: Vec<Courier>,
    pub(super) orders: Vec<Order>,
    /// Orders that are open, awarded or carried, ascending.
    pub(super) live: Vec<OrderId>,
    pub(super) restaurants: Vec<Site>,
    pub(super) customers: Vec<Site>,
    pub(super) stores: Vec<Site>,
    pub(super) arrivals: StreamRng,
    pub(super) lots: StreamRng,
    pub(super) moves: StreamRng,
    /// When the next order comes, s; infinite if nobody orders.
    pub(super) next_arrival: f64,
    pub(super) market: Market,
    /// Counts what concerns everybody: posted orders and offers.
    pub(super) notices: u64,
    /// The last winning bid as a share of its ceiling.
    pub(super) last_clearing: Option<f64>,
}

impl State {
    pub(super) fn now(&self) -> f64 {
        self.tick as f64 * self.dt
    }

    pub(super) fn order(&self, id: OrderId) -> Option<&Order> {
        self.orders.get(id.index())
    }

    pub(super) fn courier_of(&self, who: EntityId) -> Option<usize> {
        self.couriers.iter().position(|courier| courier.id == who)
    }

    /// The orders that are open, awarded or carried.
    pub(super) fn live_orders(&self) -> impl Iterator<Item = &Order> {
        self.live.iter().filter_map(|id| self.order(*id))
    }

    /// The orders a courier has won or carries, and those it agreed to take over.
    pub(super) fn load(&self, courier: usize) -> usize {
        let concerns = |order: &&Order| {
            let accepted = order.stage.terms().and_then(|terms| terms.offer).and_then(|offer| offer.accepted);
            order.stage.holder() == Some(courier) || accepted == Some(courier)
        };
        self.live_orders().filter(concerns).count()
    }
}
