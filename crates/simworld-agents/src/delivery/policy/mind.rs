//! The mind of a courier without a model: when it thinks, and what it does first.

use serde::{Deserialize, Serialize};
use simworld_core::id::EntityId;
use simworld_core::intent::Intent;
use simworld_core::scene::Scene;
use simworld_core::seed::{Stream, StreamRng};

use super::bidding::{Learner, admissible, choose};
use super::pace::{backlog, brisk, time_for, usual_pay, usual_time};
use super::{Persona, PolicyKind};
use crate::delivery::{Cents, CourierAction, CourierView, DeliveryTask, Errand, HeldOrder};
use crate::mind::{Mind, MindError};

/// Longest time between two thoughts, s.
const THINK_INTERVAL: f64 = 5.0;
/// Reaction time to something that happened, s: uniform between these.
const REACTION: (f64, f64) = (0.3, 1.5);
/// Longest wait at a meet-point, s.
const PATIENCE: f64 = 60.0;

/// A courier that plays by a policy.
pub struct CourierMind {
    kind: PolicyKind,
    persona: Persona,
    state: MindState,
}

/// What changes while it plays.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct MindState {
    rng: StreamRng,
    /// When it thinks next, s.
    due: f64,
    /// The notices it has reacted to.
    seen: u64,
    learner: Learner,
    /// Since when it is bound to a meeting, s.
    meeting_since: Option<f64>,
}

impl CourierMind {
    /// A mind with its own stream of random choices.
    pub fn new(kind: PolicyKind, persona: Persona, stream: Stream) -> Self {
        let rng = stream.named("courier").rng();
        let learner = Learner::default();
        Self { kind, persona, state: MindState { rng, due: 0.0, seen: 0, learner, meeting_since: None } }
    }

    /// How it bids.
    pub fn kind(&self) -> PolicyKind {
        self.kind
    }

    /// One action, the most pressing.
    fn think(&mut self, view: &CourierView<'_>) -> CourierAction {
        self.state.learner.learn(view);
        if let Some(action) = drink(view) {
            return action;
        }
        if view.is_exhausted() {
            return CourierAction::DoNothing;
        }
        let active = if self.kind == PolicyKind::NearlyInactive { 0.05 } else { 1.0 };
        let works = view.held_orders().next().is_some();
        let rng = &mut self.state.rng;
        if !rng.chance(active) || (!works && rng.chance(self.persona.idleness())) {
            return CourierAction::DoNothing;
        }
        self.invest(view)
            .or_else(|| swap(view))
            .or_else(|| self.meet(view))
            .or_else(|| work(view))
            .or_else(|| hurry(view))
            .or_else(|| self.share(view))
            .or_else(|| self.bid(view))
            .unwrap_or(CourierAction::DoNothing)
    }

    /// A scooter pays if the orders that it lets one deliver in the time that one plans bring more than it costs.
    fn invest(&self, view: &CourierView<'_>) -> Option<CourierAction> {
        if view.has_scooter() || view.purse() < view.scooter_price() {
            return None;
        }
        let riding = usual_time(view, view.config().speed.riding);
        let gained =
            view.config().horizon * (1.0 / riding - 1.0 / usual_time(view, brisk(view))) * usual_pay(view);
        let pays = gained > view.scooter_price().dollars() * self.persona.caution();
        pays.then_some(CourierAction::PurchaseScooter)
    }

    /// Keeps an appointment, or gives it up after waiting too long.
    fn meet(&mut self, view: &CourierView<'_>) -> Option<CourierAction> {
        let own = view.held_orders().find(|held| held.accepted).map(|held| (held.id, held.carried));
        let (order, ready) = own
            .or_else(|| view.offers().find(|offer| offer.accepted).map(|offer| (offer.id, true)))
            .or_else(|| {
                self.state.meeting_since = None;
                None
            })?;
        let since = *self.state.meeting_since.get_or_insert(view.now());
        if view.now() - since > PATIENCE + 300.0 / view.speed().max(0.5) {
            self.state.meeting_since = None;
            return Some(CourierAction::CancelShareOrder { order });
        }
        (ready && view.errand() == Errand::Idle).then_some(CourierAction::GoToMeetPoint { order })
    }

    /// Now and then offers an order whose way is long, or takes an offer on its own way.
    fn share(&mut self, view: &CourierView<'_>) -> Option<CourierAction> {
        let rate = self.persona.sharing();
        if view.room() > 0 && view.errand() == Errand::Idle && self.state.rng.chance(0.3 + 5.0 * rate) {
            let near = view.offers().filter(|offer| offer.distance < 300.0);
            let offer = near.min_by(|a, b| a.distance.total_cmp(&b.distance));
            if let Some(offer) = offer {
                return Some(CourierAction::GoToMeetPoint { order: offer.id });
            }
        }
        let heavy = view.held_orders().filter(|held| held.carried).count() > 1;
        let offered = view.held_orders().any(|held| held.offered);
        let tired = view.energy() < view.config().energy.low;
        let rate = if heavy || tired { rate * 4.0 } else { rate };
        if offered || !self.state.rng.chance(rate) {
            return None;
        }
        let far = view.held_orders().filter(|held| held.distance > 100.0 && !held.second_hand);
        let order = far.max_by(|a, b| a.distance.total_cmp(&b.distance))?.id;
        Some(CourierAction::ShareOrder { order, meet: None, bounty: Cents::ZERO })
    }

    fn bid(&mut self, view: &CourierView<'_>) -> Option<CourierAction> {
        let room = view.room();
        if room <= view.own_bids().count() || !self.state.rng.chance(self.persona.bid_rate()) {
            return None;
        }
        let (order, price) = choose(self.kind, &self.state.learner, view, &mut self.state.rng)?;
        let spread = self.persona.spread();
        let noise = self.state.rng.uniform(1.0 - spread, 1.0 + spread);
        let price = admissible(price * self.persona.price_factor() * noise, order.ceiling);
        Some(CourierAction::BidOrder { order: order.id, price })
    }
}

/// Has the battery swapped when it is empty, or low and nothing else is to be done.
fn swap(view: &CourierView<'_>) -> Option<CourierAction> {
    let low = view.charge().is_some_and(|charge| charge < view.config().battery.low);
    let free = view.errand() == Errand::Idle || (view.is_dragging() && view.errand() != Errand::Swap);
    let can_pay = view.purse() >= view.config().battery.swap;
    (low && free && can_pay).then_some(CourierAction::SwapBattery)
}

/// Delivers or picks up, whichever is nearer; what is late goes first.
fn work(view: &CourierView<'_>) -> Option<CourierAction> {
    if view.errand() != Errand::Idle {
        return None;
    }
    let free = view.held_orders().filter(|held| !(held.accepted && held.carried));
    let rank = |held: &HeldOrder| held.distance + held.due_in.clamp(0.0, 300.0) * 0.2;
    let next = free.min_by(|a, b| rank(a).total_cmp(&rank(b)))?;
    Some(if next.carried {
        CourierAction::DeliverOrder { order: next.id }
    } else {
        CourierAction::PickUpOrder { order: next.id }
    })
}

/// Drinks when what is left of the energy does not carry the work in hand to its end; whoever is free rests instead.
fn drink(view: &CourierView<'_>) -> Option<CourierAction> {
    let energy = &view.config().energy;
    let needed = backlog(view) * view.per_metre(view.speed());
    let low = view.is_exhausted() || view.energy() < (0.5 * energy.low).min(needed);
    let room = energy.capacity - view.energy() >= view.config().prices.drink_energy * 0.5;
    let works = view.held_orders().next().is_some();
    let can_pay = view.purse() >= view.drink_price();
    (low && room && works && can_pay).then_some(CourierAction::PurchaseDrinks)
}

/// Walks briskly with work in hand, as fast as may be when late, and comfortably when tired or free.
fn hurry(view: &CourierView<'_>) -> Option<CourierAction> {
    /// Speeds nearer to each other than this are the same to a walker, m/s.
    const NOTICED: f64 = 0.25;
    if view.is_riding() {
        return None;
    }
    let limits = &view.config().speed;
    let late = |held: HeldOrder| {
        let left = held.distance + if held.carried { 0.0 } else { held.route };
        time_for(view, left) > held.due_in && held.due_in > -60.0
    };
    let tired = view.energy() < view.config().energy.low && view.purse() < view.drink_price();
    let wanted = match view.held_orders().next() {
        Some(_) if tired => limits.walking,
        Some(_) if view.held_orders().any(late) => limits.fastest,
        Some(_) => brisk(view),
        None => limits.walking,
    };
    // Nobody slows down by little who may have to hurry again soon.
    let noticed = if wanted < view.speed() { 2.0 * NOTICED } else { NOTICED };
    ((wanted - view.speed()).abs() > noticed).then_some(CourierAction::AdjustSpeed { speed: wanted })
}

impl Mind<DeliveryTask> for CourierMind {
    fn decide(
        &mut self,
        task: &DeliveryTask,
        _: &dyn Scene,
        who: EntityId,
        out: &mut Vec<Intent>,
    ) -> Result<(), MindError> {
        let Some(view) = task.view(who) else {
            return Err(MindError { who, reason: "it is no courier of this task".to_owned() });
        };
        let now = view.now();
        let MindState { rng, due, seen, .. } = &mut self.state;
        if !view.wakes(seen, due, || now + rng.uniform(REACTION.0, REACTION.1)) {
            return Ok(());
        }
        self.state.due = now + THINK_INTERVAL;
        out.push(self.think(&view).into());
        Ok(())
    }

    fn save(&self) -> Vec<u8> {
        postcard::to_allocvec(&(self.kind, self.persona, &self.state))
            .expect("plain data can be written to memory")
    }

    /// False for the bytes of another policy or persona.
    fn restore(&mut self, saved: &[u8]) -> bool {
        match postcard::from_bytes::<(PolicyKind, Persona, MindState)>(saved) {
            Ok((kind, persona, state)) if kind == self.kind && persona == self.persona => {
                self.state = state;
                true
            }
            _ => false,
        }
    }
}
