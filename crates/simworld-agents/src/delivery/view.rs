//! What a courier knows when it decides: its own state, the board of open orders, offers and prices.

use simworld_core::geometry::{Point2, Point3};

use super::battery::Power;
use super::board::Tender;
use super::config::DeliveryConfig;
use super::money::{Account, Cents};
use super::order::{Order, OrderId, Stage};
use super::state::{BidResult, Courier, Errand, Ride, State};

/// A courier's view of the task; it borrows, and costs nothing until asked.
#[derive(Clone, Copy)]
pub struct CourierView<'a> {
    config: &'a DeliveryConfig,
    state: &'a State,
    index: usize,
}

/// An order that takes bids, as a courier sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OpenOrder {
    /// Which.
    pub id: OrderId,
    /// The most that is paid.
    pub ceiling: Cents,
    /// Straight distance from the courier to the restaurant, m.
    pub approach: f64,
    /// Length of the route from restaurant to home, m.
    pub route: f64,
    /// Time until the auction closes, s.
    pub closes_in: f64,
    /// What this courier bid, if it did.
    pub own_bid: Option<Cents>,
}

/// An order that a courier has won or carries.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(clippy::struct_excessive_bools, reason = "four independent facts, each read by itself")]
pub struct HeldOrder {
    /// Which.
    pub id: OrderId,
    /// Whether the courier has it in hand; else it waits at the restaurant.
    pub carried: bool,
    /// Where to go with it or for it, m.
    pub target: Point3,
    /// Straight distance to there, m.
    pub distance: f64,
    /// Length of the whole route, m.
    pub route: f64,
    /// What is paid in time.
    pub pay: Cents,
    /// Time until it is late, s; negative once it is.
    pub due_in: f64,
    /// Whether it is offered for sharing.
    pub offered: bool,
    /// Whether somebody accepted the offer.
    pub accepted: bool,
    /// Whether it changed hands before.
    pub second_hand: bool,
}

/// An order of another courier that is offered for sharing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SharedOffer {
    /// Which order.
    pub id: OrderId,
    /// Where to meet, m.
    pub meet: Point3,
    /// Straight distance to there, m.
    pub distance: f64,
    /// Straight distance from there to the home, m.
    pub rest: f64,
    /// What is paid for the order, to both together.
    pub pay: Cents,
    /// The bounty for the second courier.
    pub bounty: Cents,
    /// Whether the viewing courier accepted it.
    pub accepted: bool,
}

impl<'a> CourierView<'a> {
    pub(super) fn new(config: &'a DeliveryConfig, state: &'a State, index: usize) -> Self {
        Self { config, state, index }
    }

    fn courier(&self) -> &'a Courier {
        &self.state.couriers[self.index]
    }

    /// The settings of the task.
    pub fn config(&self) -> &'a DeliveryConfig {
        self.config
    }

    /// The courier's place in the list of agents.
    pub fn index(&self) -> usize {
        self.index
    }

    /// Time of the episode, s.
    pub fn now(&self) -> f64 {
        self.state.now()
    }

    /// A count that grows whenever something happened that this courier may want to act on.
    pub fn notices(&self) -> u64 {
        self.state.board.news(self.position()) + self.courier().notices
    }

    /// Whether it is time to think: `due` has come, or something happened that was not `seen` before, to which the courier reacts
    /// at the time that `reaction` gives, s of the episode.
    pub(crate) fn wakes(&self, seen: &mut u64, due: &mut f64, reaction: impl FnOnce() -> f64) -> bool {
        let notices = self.notices();
        if notices != *seen {
            *seen = notices;
            *due = due.min(reaction());
        }
        self.now() >= *due
    }

    /// Where the courier is, m.
    pub fn position(&self) -> Point2 {
        self.courier().position
    }

    /// What it owns.
    pub fn purse(&self) -> Cents {
        self.state.ledger.balance(Account::Courier(self.index))
    }

    /// Its energy, in [0, capacity].
    pub fn energy(&self) -> f64 {
        self.courier().energy
    }

    /// What a metre at a speed in m/s costs it of energy as things are now, on level ground: riding, or on foot with what it carries
    /// and pushes, in this weather and on what lies on the pavement.
    pub fn per_metre(&self, speed: f64) -> f64 {
        let (courier, energy) = (self.courier(), &self.config.energy);
        let afoot = || energy.per_metre(&courier.exertion, speed);
        let cost = match courier.ride {
            Ride::Riding(_) => energy.riding,
            Ride::Dragging(_) => afoot() * self.config.battery.dragging_effort,
            Ride::None | Ride::Ordered | Ride::Beside(_) => afoot(),
        };
        cost * self.state.effort
    }

    /// Mass of the parcels that it carries, kg.
    pub fn load(&self) -> f64 {
        self.courier().exertion.load
    }

    /// Whether it lies low until it has rested or drunk.
    pub fn is_exhausted(&self) -> bool {
        self.courier().exhausted
    }

    /// The speed at which it moves when it moves, before what the weather takes of it, m/s.
    pub fn speed(&self) -> f64 {
        self.courier().speed()
    }

    /// Whether it bought a scooter.
    pub fn has_scooter(&self) -> bool {
        self.courier().ride != Ride::None
    }

    /// Whether it rides.
    pub fn is_riding(&self) -> bool {
        self.courier().is_riding()
    }

    /// Whether it pushes a scooter whose battery is empty.
    pub fn is_dragging(&self) -> bool {
        self.courier().is_dragging()
    }

    /// The share that the battery of its scooter holds; `None` without a scooter, or where scooters have no batteries.
    pub fn charge(&self) -> Option<f64> {
        let battery = &self.config.battery;
        let powered = battery.power == Power::Battery && self.has_scooter();
        powered.then(|| self.courier().charge / battery.capacity)
    }

    /// The factor of the weather on speeds: 1 where nothing falls.
    pub fn pace(&self) -> f64 {
        self.state.pace
    }

    /// What it is on its way to do.
    pub fn errand(&self) -> Errand {
        self.courier().errand
    }

    /// How many more orders it may take.
    pub fn room(&self) -> usize {
        (self.config.capacity as usize).saturating_sub(self.state.load(self.index))
    }

    /// What a drink costs now.
    pub fn drink_price(&self) -> Cents {
        self.config.prices.drink.times(self.state.market.drink)
    }

    /// What a scooter costs now.
    pub fn scooter_price(&self) -> Cents {
        self.config.prices.scooter.times(self.state.market.scooter)
    }

    /// The last winning bid of anybody as a share of its ceiling.
    pub fn last_clearing(&self) -> Option<f64> {
        self.state.last_clearing
    }

    /// How its bids ended that ended after the first `known`, as far as remembered, and how many ended in all.
    pub fn results_since(&self, known: u64) -> (&'a [BidResult], u64) {
        let courier = self.courier();
        let skip = known.saturating_sub(courier.results_before) as usize;
        let total = courier.results_before + courier.results.len() as u64;
        (courier.results.get(skip..).unwrap_or_default(), total)
    }

    fn distance_to(&self, point: &Point3) -> f64 {
        (point.xy() - self.position()).norm()
    }

    /// The orders that take bids and of which it is told, oldest first.
    pub fn open_orders(&self) -> impl Iterator<Item = OpenOrder> + '_ {
        let mut told: Vec<OpenOrder> = self.tenders().collect();
        told.sort_unstable_by_key(|order| order.id);
        told.into_iter()
    }

    /// The same as they hang on the board.
    pub(super) fn tenders(&self) -> impl Iterator<Item = OpenOrder> + '_ {
        let board = &self.state.board;
        board.tenders(self.position()).filter_map(|tender| self.read(tender))
    }

    /// The orders among them that it has bid for, oldest first.
    pub(super) fn own_bids(&self) -> impl Iterator<Item = OpenOrder> + '_ {
        let orders = self.courier().bids.iter().filter_map(|id| self.state.order(*id));
        orders.filter_map(|order| self.read(&order.tender()?))
    }

    /// What a tender says to it; `None` out of reach.
    fn read(&self, tender: &Tender) -> Option<OpenOrder> {
        let approach = (tender.at - self.position()).norm();
        self.state.board.reaches(approach).then(|| OpenOrder {
            id: tender.id,
            ceiling: tender.ceiling,
            approach,
            route: tender.route,
            closes_in: tender.closes.saturating_sub(self.state.tick) as f64 * self.state.dt,
            own_bid: self.own_bid(tender.id),
        })
    }

    /// What it bid for an order that takes bids.
    fn own_bid(&self, id: OrderId) -> Option<Cents> {
        self.courier().bids.binary_search(&id).ok()?;
        let Stage::Open(open) = &self.state.order(id)?.stage else { return None };
        open.bids.iter().find(|bid| bid.courier == self.index).map(|bid| bid.price)
    }

    /// The orders it has won or carries, oldest first.
    pub fn held_orders(&self) -> impl Iterator<Item = HeldOrder> + '_ {
        self.state.held_by(self.index).filter_map(|order| self.held(order))
    }

    fn held(&self, order: &Order) -> Option<HeldOrder> {
        let terms = order.stage.terms()?;
        if order.stage.holder() != Some(self.index) {
            return None;
        }
        let carried = match &order.stage {
            Stage::Carried(carried) => Some(carried),
            _ => None,
        };
        let target = if carried.is_some() { order.dropoff } else { order.pickup };
        Some(HeldOrder {
            id: order.id,
            carried: carried.is_some(),
            target,
            distance: self.distance_to(&target),
            route: order.route,
            pay: terms.pay,
            due_in: terms.due - self.state.now(),
            offered: terms.offer.is_some(),
            accepted: terms.offer.is_some_and(|offer| offer.accepted.is_some()),
            second_hand: carried.is_some_and(|carried| carried.first.is_some()),
        })
    }

    /// The offers of others that this courier accepted or may accept.
    pub fn offers(&self) -> impl Iterator<Item = SharedOffer> + '_ {
        // What it accepted it knows of wherever it is.
        let accepted = self.courier().accepted.iter().filter_map(|id| self.state.order(*id));
        let open = |order: &Order| order.stage.terms()?.offer.filter(|offer| offer.accepted.is_none());
        let within = |order: &&Order| {
            open(order).is_some_and(|offer| self.state.board.reaches(self.distance_to(&offer.meet)))
        };
        let near = self.state.board.offers(self.position()).filter_map(|id| self.state.order(id));
        let mut offered: Vec<&Order> = near.filter(within).collect();
        offered.sort_unstable_by_key(|order| order.id);
        accepted.chain(offered).filter_map(|order| {
            let terms = order.stage.terms()?;
            let offer = terms.offer?;
            if order.stage.holder() == Some(self.index) {
                return None;
            }
            Some(SharedOffer {
                id: order.id,
                meet: offer.meet,
                distance: self.distance_to(&offer.meet),
                rest: (order.dropoff - offer.meet).norm(),
                pay: terms.pay,
                bounty: offer.bounty,
                accepted: offer.accepted.is_some(),
            })
        })
    }
}
