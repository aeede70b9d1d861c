//! The task itself: settings, an auction and a state, behind core's [`Task`] seam.

use std::sync::Arc;

use simworld_core::exertion::{Exertion, Terrain};
use simworld_core::geometry::Point3;
use simworld_core::hash::StateHasher;
use simworld_core::id::EntityId;
use simworld_core::scene::Scene;
use simworld_core::seam::{Metric, Outcome, Task, TaskContext, TaskError, TaskOutput};
use simworld_core::seed::{Seed, Stream};
use thiserror::Error;

use super::action::CourierAction;
use super::auction::Auction;
use super::board::Board;
use super::config::DeliveryConfig;
use super::money::{Account, Cents, Ledger};
use super::order::{Order, Stage};
use super::places::{Places, Sites};
use super::report::DeliveryReport;
use super::routes::Routes;
use super::state::{Courier, Errand, Market, Ride, State, Tally};
use super::turn::Turn;
use super::view::CourierView;

/// Couriers bid for orders, carry and share them, invest and tire.
///
/// The scene must hold restaurants and homes (entities used as [`Place::Restaurant`](simworld_core::scene::Place::Restaurant) and
/// [`Place::Home`](simworld_core::scene::Place::Home), best with
/// an access point); stores only if purchases are made there. Agents are the couriers. A clone is what minds know of it that
/// think at their own pace ([`AsynchronousEpisode`](crate::asynchronous::AsynchronousEpisode)).
#[derive(Clone)]
pub struct DeliveryTask {
    config: DeliveryConfig,
    auction: Arc<dyn Auction>,
    routes: Routes,
    places: Option<Arc<Places>>,
    pub(super) state: Option<State>,
}

/// What contradicts itself in the books of a task.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum AuditError {
    /// Money was made or lost.
    #[error("accounts differ from endowment and inflow by {0}")]
    Imbalance(Cents),
    /// An account is below zero.
    #[error("an account is overdrawn")]
    Overdrawn,
    /// The escrow does not hold what is owed from it.
    #[error("the escrow holds {held} and owes {owed}")]
    Escrow {
        /// What it holds.
        held: Cents,
        /// What it owes: ceilings of orders under way, and bounties.
        owed: Cents,
    },
    /// An order is listed where it does not belong, or is not where it does.
    #[error("order {order} is {stage} and is listed otherwise, or in too many places")]
    Listing {
        /// Which.
        order: u32,
        /// Its stage.
        stage: &'static str,
    },
}

impl DeliveryTask {
    /// A task with these settings.
    ///
    /// # Errors
    /// The first setting out of range.
    pub fn new(config: DeliveryConfig) -> Result<Self, TaskError> {
        config.validate()?;
        let auction = Arc::from(config.auction.rule.auction());
        Ok(Self { config, auction, routes: Routes::default(), places: None, state: None })
    }

    /// With an auction of one's own in place of the one in the settings.
    #[must_use]
    pub fn with_auction(mut self, auction: Box<dyn Auction>) -> Self {
        self.auction = Arc::from(auction);
        self
    }

    /// The settings.
    pub fn config(&self) -> &DeliveryConfig {
        &self.config
    }

    /// Every order of the episode so far, indexed by [`OrderId`](super::OrderId); empty before the reset.
    pub fn orders(&self) -> &[Order] {
        self.state.as_ref().map_or(&[], |state| &state.orders)
    }

    /// The books.
    pub fn ledger(&self) -> Option<&Ledger> {
        self.state.as_ref().map(|state| &state.ledger)
    }

    /// What a courier knows; `None` before the reset and for somebody who is no courier.
    pub fn view(&self, who: EntityId) -> Option<CourierView<'_>> {
        let state = self.state.as_ref()?;
        Some(CourierView::new(&self.config, state, state.courier_of(who)?))
    }

    /// How everybody fares; `None` before the reset.
    pub fn report(&self) -> Option<DeliveryReport> {
        self.state.as_ref().map(|state| DeliveryReport::new(&self.config, state))
    }

    /// Checks the books: money is conserved, nobody is overdrawn, the escrow holds exactly what it owes, and the
    /// lists of orders agree with their stages.
    ///
    /// # Errors
    /// What contradicts itself.
    pub fn audit(&self) -> Result<(), AuditError> {
        let Some(state) = &self.state else { return Ok(()) };
        if state.ledger.imbalance() != Cents::ZERO {
            return Err(AuditError::Imbalance(state.ledger.imbalance()));
        }
        if !state.ledger.is_solvent() {
            return Err(AuditError::Overdrawn);
        }
        let (held, owed) = (state.ledger.balance(Account::Escrow), owed(state));
        if held != owed {
            return Err(AuditError::Escrow { held, owed });
        }
        audit_lists(state)
    }

    fn begin(
        &self,
        scene: &dyn Scene,
        agents: &[EntityId],
        places: &Places,
        stream: Stream,
    ) -> Result<State, TaskError> {
        let missing =
            |missing: &str, hint: &str| TaskError::Scene { missing: missing.into(), hint: hint.into() };
        let mut couriers = Vec::with_capacity(agents.len());
        for id in agents {
            let body = scene
                .entity(*id)
                .ok_or_else(|| missing(&format!("courier {id}"), "spawn the agents before the reset"))?;
            couriers.push(self.courier(*id, body.position()));
        }
        let mut seats: Vec<(EntityId, u32)> = agents.iter().copied().zip(0..).collect();
        seats.sort_unstable();
        let doors = places.sites.restaurants.iter().map(|site| site.access.xy());
        Ok(State {
            tick: 0,
            dt: scene.clock().dt(),
            ledger: Ledger::new(agents.len(), self.config.initial_money),
            couriers,
            orders: Vec::new(),
            open: Vec::new(),
            board: Board::new(self.config.orders.told_within, doors),
            seats,
            arrivals: stream.named("arrivals").rng(),
            lots: stream.named("lots").rng(),
            moves: stream.named("prices").rng(),
            next_arrival: 0.0,
            market: Market {
                ceiling: 1.0,
                scooter: 1.0,
                drink: 1.0,
                next: self.config.prices.interval,
                closed: 0,
                unwanted: 0,
                scooters: 0,
                drinks: 0,
            },
            last_clearing: None,
            pace: 1.0,
            effort: 1.0,
            terrain: Terrain::Paved,
        })
    }

    fn courier(&self, id: EntityId, place: Point3) -> Courier {
        Courier {
            id,
            position: place.xy(),
            height: place.z,
            exertion: Exertion { body: self.config.energy.body, ..Exertion::default() },
            energy: self.config.energy.capacity,
            exhausted: false,
            low: false,
            walking: self.config.speed.walking,
            riding: self.config.speed.riding,
            ride: Ride::None,
            charge: 0.0,
            low_charge: false,
            errand: Errand::Idle,
            held: Vec::new(),
            accepted: Vec::new(),
            bids: Vec::new(),
            notices: 0,
            results: Vec::new(),
            results_before: 0,
            tally: Tally::default(),
        }
    }
}

/// Whether every order is listed where its stage says, and nowhere else.
fn audit_lists(state: &State) -> Result<(), AuditError> {
    let mut listed = 0;
    for order in &state.orders {
        let offer = order.stage.terms().and_then(|terms| terms.offer);
        let has = |list: &[super::order::OrderId]| list.binary_search(&order.id).is_ok();
        let mut sound = true;
        if let Stage::Open(open) = &order.stage {
            sound &= has(&state.open) && state.board.is_open(order.pickup.xy(), order.id);
            sound &= open.bids.iter().all(|bid| has(&state.couriers[bid.courier].bids));
            listed += 2 + open.bids.len();
        }
        if let Some(holder) = order.stage.holder() {
            sound &= has(&state.couriers[holder].held);
            listed += 1;
        }
        if let Some(offer) = offer {
            sound &= state.board.is_offered(offer.meet.xy(), order.id);
            listed += 1;
        }
        if let Some(second) = offer.and_then(|offer| offer.accepted) {
            sound &= has(&state.couriers[second].accepted);
            listed += 1;
        }
        if !sound {
            return Err(AuditError::Listing { order: order.id.0, stage: order.stage.name() });
        }
    }
    let lists =
        state.couriers.iter().map(|courier| courier.held.len() + courier.accepted.len() + courier.bids.len());
    let found = state.open.len() + state.board.len() + lists.sum::<usize>();
    match state.orders.last() {
        Some(order) if found != listed => {
            Err(AuditError::Listing { order: order.id.0, stage: order.stage.name() })
        }
        _ => Ok(()),
    }
}

/// What the escrow owes: the ceilings of orders won and not delivered, and bounties put up.
fn owed(state: &State) -> Cents {
    let of = |order: &Order| {
        let Some(terms) = order.stage.terms() else { return Cents::ZERO };
        let bounty = terms.offer.map_or(Cents::ZERO, |offer| offer.bounty);
        let leg = match &order.stage {
            Stage::Carried(carried) => carried.first.map_or(Cents::ZERO, |leg| leg.bounty),
            _ => Cents::ZERO,
        };
        order.ceiling + bounty + leg
    };
    state.orders.iter().map(of).fold(Cents::ZERO, |sum, part| sum + part)
}

impl Task for DeliveryTask {
    fn reset(
        &mut self,
        scene: &dyn Scene,
        agents: &[EntityId],
        seed: Seed,
        out: &mut TaskOutput,
    ) -> Result<(), TaskError> {
        if agents.is_empty() {
            return Err(TaskError::Scene {
                missing: "courier".to_owned(),
                hint: "give at least one agent".to_owned(),
            });
        }
        self.routes = Routes::default();
        self.routes.prepare(scene)?;
        let stream = seed.stream("agents/delivery");
        let places = Places::new(Sites::of(scene, &self.config, stream)?);
        let mut state = self.begin(scene, agents, &places, stream)?;
        Turn {
            config: &self.config,
            auction: &*self.auction,
            routes: &mut self.routes,
            places: &places,
            state: &mut state,
            scene,
            out,
        }
        .open_shop();
        (self.places, self.state) = (Some(Arc::new(places)), Some(state));
        Ok(())
    }

    fn step(
        &mut self,
        context: &TaskContext<'_>,
        out: &mut TaskOutput,
        outcome: &mut Outcome,
    ) -> Result<(), TaskError> {
        let (Some(places), Some(state)) = (&self.places, &mut self.state) else {
            return Err(TaskError::Other("a delivery task is reset before its first step".to_owned()));
        };
        self.routes.prepare(context.scene)?;
        let purse = |state: &State, index: usize| state.ledger.balance(Account::Courier(index));
        let before: Vec<Cents> = (0..state.couriers.len()).map(|index| purse(state, index)).collect();
        Turn {
            config: &self.config,
            auction: &*self.auction,
            routes: &mut self.routes,
            places,
            state,
            scene: context.scene,
            out,
        }
        .run(context);
        let gained = before.iter().enumerate().map(|(index, was)| (purse(state, index) - *was).dollars());
        outcome.rewards.extend(gained);
        outcome.truncated = state.tick >= self.config.steps;
        Ok(())
    }

    fn metrics(&self) -> Vec<Metric> {
        self.report().map(|report| report.metrics()).unwrap_or_default()
    }

    fn calls(&self) -> &'static [&'static str] {
        CourierAction::NAMES
    }

    fn save(&self) -> Vec<u8> {
        let sites = self.places.as_ref().map(|places| &places.sites);
        postcard::to_allocvec(&(&self.config, sites, &self.state))
            .expect("plain data without maps of unknown length can be written to memory")
    }

    /// False also for bytes that were saved under other settings.
    fn restore(&mut self, saved: &[u8]) -> bool {
        type Saved = (DeliveryConfig, Option<Sites>, Option<State>);
        let Ok((config, sites, state)) = postcard::from_bytes::<Saved>(saved) else { return false };
        if config != self.config || sites.is_some() != state.is_some() {
            return false;
        }
        self.routes = Routes::default();
        (self.places, self.state) = (sites.map(|sites| Arc::new(Places::new(sites))), state);
        true
    }

    fn state_hash(&self, hasher: &mut StateHasher) {
        if let Some(places) = &self.places {
            places.state_hash(hasher);
        }
        let saved = postcard::to_allocvec(&(&self.config, &self.state))
            .expect("plain data without maps of unknown length can be written to memory");
        hasher.u64(saved.len() as u64).bytes(&saved);
    }
}
