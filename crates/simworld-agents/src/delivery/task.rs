//! The task itself: settings, an auction and a state, behind core's [`Task`] seam.

use std::ops::ControlFlow;
use std::sync::Arc;

use simworld_core::geometry::{Aabb, Point2};
use simworld_core::hash::StateHasher;
use simworld_core::id::EntityId;
use simworld_core::scene::{Place, Scene};
use simworld_core::seam::{Metric, Outcome, Task, TaskContext, TaskError, TaskOutput};
use simworld_core::seed::Seed;
use thiserror::Error;

use super::action::CourierAction;
use super::auction::Auction;
use super::config::{DeliveryConfig, Shopping};
use super::money::{Account, Cents, Ledger};
use super::order::Order;
use super::report::DeliveryReport;
use super::routes::Routes;
use super::state::{Courier, Errand, Market, Ride, Site, State, Tally};
use super::turn::Turn;
use super::view::CourierView;

/// Couriers bid for orders, carry and share them, invest and tire.
///
/// The scene must hold restaurants and homes (entities used as [`Place::Restaurant`] and [`Place::Home`], best with
/// an access point); stores only if purchases are made there. Agents are the couriers. A clone is what minds know of it that
/// think at their own pace ([`AsynchronousEpisode`](crate::asynchronous::AsynchronousEpisode)).
#[derive(Clone)]
pub struct DeliveryTask {
    config: DeliveryConfig,
    auction: Arc<dyn Auction>,
    routes: Routes,
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
    /// An order is listed as live and is not, or the other way about.
    #[error("order {order} is {stage} and is listed otherwise")]
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
        Ok(Self { config, auction, routes: Routes::default(), state: None })
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
    /// list of live orders agrees with their stages.
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
        for order in &state.orders {
            let live = !matches!(order.stage.name(), "delivered" | "expired");
            if live != state.live.binary_search(&order.id).is_ok() {
                return Err(AuditError::Listing { order: order.id.0, stage: order.stage.name() });
            }
        }
        Ok(())
    }

    fn begin(&self, scene: &dyn Scene, agents: &[EntityId], seed: Seed) -> Result<State, TaskError> {
        let stream = seed.stream("agents/delivery");
        let mut homes = stream.named("customers").rng();
        let [restaurants, dwellings, stores] = sites(scene);
        let missing =
            |missing: &str, hint: &str| TaskError::Scene { missing: missing.into(), hint: hint.into() };
        if restaurants.is_empty() {
            return Err(missing("restaurant", "spawn a building used as Place::Restaurant"));
        }
        if dwellings.is_empty() {
            return Err(missing("home", "spawn a building used as Place::Home"));
        }
        if stores.is_empty() && self.config.prices.shopping == Shopping::AtStore {
            return Err(missing("store", "spawn a building used as Place::Store, or set prices.shopping"));
        }
        let draw = |_| homes.choose(&dwellings).copied();
        let customers = (0..self.config.orders.customers).filter_map(draw).collect();
        let mut couriers = Vec::with_capacity(agents.len());
        for id in agents {
            let body = scene
                .entity(*id)
                .ok_or_else(|| missing(&format!("courier {id}"), "spawn the agents before the reset"))?;
            couriers.push(self.courier(*id, body.planar()));
        }
        Ok(State {
            tick: 0,
            dt: scene.clock().dt(),
            ledger: Ledger::new(agents.len(), self.config.initial_money),
            couriers,
            orders: Vec::new(),
            live: Vec::new(),
            restaurants,
            customers,
            stores,
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
            notices: 0,
            last_clearing: None,
        })
    }

    fn courier(&self, id: EntityId, position: Point2) -> Courier {
        Courier {
            id,
            position,
            energy: self.config.energy.capacity,
            exhausted: false,
            low: false,
            walking: self.config.speed.walking,
            riding: self.config.speed.riding,
            ride: Ride::None,
            errand: Errand::Idle,
            notices: 0,
            results: Vec::new(),
            results_before: 0,
            tally: Tally::default(),
        }
    }
}

/// What the escrow owes: the ceilings of orders won and not delivered, and bounties put up.
fn owed(state: &State) -> Cents {
    let of = |order: &Order| {
        let Some(terms) = order.stage.terms() else { return Cents::ZERO };
        let bounty = terms.offer.map_or(Cents::ZERO, |offer| offer.bounty);
        let leg = match &order.stage {
            super::order::Stage::Carried(carried) => carried.first.map_or(Cents::ZERO, |leg| leg.bounty),
            _ => Cents::ZERO,
        };
        order.ceiling + bounty + leg
    };
    state.orders.iter().map(of).fold(Cents::ZERO, |sum, part| sum + part)
}

/// Restaurants, homes and stores, each by ascending id.
fn sites(scene: &dyn Scene) -> [Vec<Site>; 3] {
    let mut found = [Vec::new(), Vec::new(), Vec::new()];
    let _ = scene.visit(&Aabb::column_around(Point2::origin(), 1e9), &mut |entity| {
        let group = match entity.info.place {
            Some(Place::Restaurant) => 0,
            Some(Place::Home) => 1,
            Some(Place::Store) => 2,
            _ => return ControlFlow::Continue(()),
        };
        found[group].push(Site { entity: entity.id, access: entity.access() });
        ControlFlow::Continue(())
    });
    for group in &mut found {
        group.sort_by_key(|site| site.entity);
    }
    found
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
        let mut state = self.begin(scene, agents, seed)?;
        Turn {
            config: &self.config,
            auction: &*self.auction,
            routes: &mut self.routes,
            state: &mut state,
            scene,
            out,
        }
        .open_shop();
        self.state = Some(state);
        Ok(())
    }

    fn step(
        &mut self,
        context: &TaskContext<'_>,
        out: &mut TaskOutput,
        outcome: &mut Outcome,
    ) -> Result<(), TaskError> {
        let state = self
            .state
            .as_mut()
            .ok_or_else(|| TaskError::Other("a delivery task is reset before its first step".to_owned()))?;
        self.routes.prepare(context.scene)?;
        let purse = |state: &State, index: usize| state.ledger.balance(Account::Courier(index));
        let before: Vec<Cents> = (0..state.couriers.len()).map(|index| purse(state, index)).collect();
        Turn {
            config: &self.config,
            auction: &*self.auction,
            routes: &mut self.routes,
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
        postcard::to_allocvec(&(&self.config, &self.state))
            .expect("plain data without maps of unknown length can be written to memory")
    }

    /// False also for bytes that were saved under other settings.
    fn restore(&mut self, saved: &[u8]) -> bool {
        let Ok((config, state)) = postcard::from_bytes::<(DeliveryConfig, Option<State>)>(saved) else {
            return false;
        };
        if config != self.config {
            return false;
        }
        self.routes = Routes::default();
        self.state = state;
        true
    }

    fn state_hash(&self, hasher: &mut StateHasher) {
        let saved = self.save();
        hasher.u64(saved.len() as u64).bytes(&saved);
    }
}
