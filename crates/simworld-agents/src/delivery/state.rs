//! Everything the task knows, as data: what a snapshot keeps and the state hash covers.

use serde::{Deserialize, Serialize};
use simworld_core::exertion::{Exertion, Terrain};
use simworld_core::geometry::Point2;
use simworld_core::id::EntityId;
use simworld_core::seed::StreamRng;

use super::board::{Board, insert, remove};
use super::money::{Cents, Ledger};
use super::order::{Order, OrderId, Stage};

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
    /// To swap the battery of its scooter at the nearest charging station.
    Swap,
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
    /// Its battery is empty, and its owner pushes it.
    Dragging(EntityId),
}

/// How a bid of a courier ended.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BidResult {
    /// For which order.
    pub order: OrderId,
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
    pub(super) actions: [u32; 11],
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
    pub(super) swaps: u32,
    /// Taken out of batteries, Wh.
    pub(super) power: f64,
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
    /// Height of its feet then, m.
    pub(super) height: f64,
    /// Who walks with what on what.
    pub(super) exertion: Exertion,
    pub(super) energy: f64,
    pub(super) exhausted: bool,
    pub(super) low: bool,
    /// Speed wanted on foot, m/s.
    pub(super) walking: f64,
    /// Speed wanted on a scooter, m/s.
    pub(super) riding: f64,
    pub(super) ride: Ride,
    /// What the battery of its scooter holds, Wh.
    pub(super) charge: f64,
    /// Whether it was told that this is little.
    pub(super) low_charge: bool,
    pub(super) errand: Errand,
    /// The orders it has won or carries, ascending.
    pub(super) held: Vec<OrderId>,
    /// The orders it agreed to take over, ascending.
    pub(super) accepted: Vec<OrderId>,
    /// The orders it has bid for that still take bids, ascending.
    pub(super) bids: Vec<OrderId>,
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

    /// Whether it pushes a scooter without power.
    pub(super) fn is_dragging(&self) -> bool {
        matches!(self.ride, Ride::Dragging(_))
    }

    /// The speed that it chose, m/s.
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
    /// Orders that take bids, ascending, which is the order in which they close.
    pub(super) open: Vec<OrderId>,
    /// Where couriers are told of them, and of offers.
    pub(super) board: Board,
    /// The bodies of the couriers, ascending, each with its place in the list of agents.
    pub(super) seats: Vec<(EntityId, u32)>,
    pub(super) arrivals: StreamRng,
    pub(super) lots: StreamRng,
    pub(super) moves: StreamRng,
    /// When the next order comes, s; infinite if nobody orders.
    pub(super) next_arrival: f64,
    pub(super) market: Market,
    /// The last winning bid as a share of its ceiling.
    pub(super) last_clearing: Option<f64>,
    /// Factor of the weather on speeds.
    pub(super) pace: f64,
    /// Factor of the weather on what moving costs, beside that of the ground.
    pub(super) effort: f64,
    /// What the snow makes of the pavement.
    pub(super) terrain: Terrain,
}

impl State {
    pub(super) fn now(&self) -> f64 {
        self.tick as f64 * self.dt
    }

    pub(super) fn order(&self, id: OrderId) -> Option<&Order> {
        self.orders.get(id.index())
    }

    pub(super) fn courier_of(&self, who: EntityId) -> Option<usize> {
        let seat = self.seats.binary_search_by_key(&who, |seat| seat.0).ok()?;
        Some(self.seats[seat].1 as usize)
    }

    /// The orders a courier has won or carries, the oldest first.
    pub(super) fn held_by(&self, courier: usize) -> impl Iterator<Item = &Order> {
        self.couriers[courier].held.iter().filter_map(|id| self.order(*id))
    }

    /// How many parcels a courier has with it.
    pub(super) fn carried_by(&self, courier: usize) -> usize {
        self.held_by(courier).filter(|order| matches!(order.stage, Stage::Carried(_))).count()
    }

    /// The orders a courier has won or carries, and those it agreed to take over.
    pub(super) fn load(&self, courier: usize) -> usize {
        self.couriers[courier].held.len() + self.couriers[courier].accepted.len()
    }

    /// Notes that a courier has an order now.
    pub(super) fn hold(&mut self, courier: usize, id: OrderId) {
        insert(&mut self.couriers[courier].held, id);
    }

    /// Notes that it has it no longer.
    pub(super) fn release(&mut self, courier: usize, id: OrderId) {
        remove(&mut self.couriers[courier].held, id);
    }

    /// Notes that a courier agreed to take an order over.
    pub(super) fn agree(&mut self, courier: usize, id: OrderId) {
        insert(&mut self.couriers[courier].accepted, id);
    }

    /// Notes that it no longer does.
    pub(super) fn disagree(&mut self, courier: usize, id: OrderId) {
        remove(&mut self.couriers[courier].accepted, id);
    }
}
