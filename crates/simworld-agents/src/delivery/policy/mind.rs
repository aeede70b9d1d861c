//! The mind of a courier without a model: when it thinks, and what it does first.

use serde::{Deserialize, Serialize};
use simworld_core::id::EntityId;
use simworld_core::intent::Intent;
use simworld_core::scene::Scene;
use simworld_core::seed::{Stream, StreamRng};

use super::bidding::{Learner, admissible, choose};
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
            .or_else(|| self.meet(view))
            .or_else(|| work(view))
            .or_else(|| hurry(view))
            .or_else(|| self.share(view))
            .or_else(|| self.bid(view))
            .unwrap_or(CourierAction::DoNothing)
    }

    /// A scooter pays if what it saves in the time left is worth more than it costs: the time that orders take
    /// shrinks by the ratio of speeds, and each order brings about the usual ceiling.
    fn invest(&self, view: &CourierView<'_>) -> Option<CourierAction> {
        if view.has_scooter() || view.purse() < view.scooter_price() {
            return None;
        }
        let (speed, orders) = (&view.config().speed, &view.config().orders);
        let usual = orders.base.dollars() + orders.per_kilometre.dollars() * orders.radius / 1000.0;
        let each = |speed: f64| 1.5 * orders.radius / speed;
        let gained = view.time_left() * (1.0 / each(speed.riding) - 1.0 / each(view.speed())) * usual * 0.7;
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
        let pending = view.open_orders().filter(|order| order.own_bid.is_some()).count();
        if view.room() <= pending || !self.state.rng.chance(self.persona.bid_rate()) {
            return None;
        }
        let (order, price) = choose(self.kind, &self.state.learner, view, &mut self.state.rng)?;
        let spread = self.persona.spread();
        let noise = self.state.rng.uniform(1.0 - spread, 1.0 + spread);
        let price = admissible(price * self.persona.price_factor() * noise, order.ceiling);
        Some(CourierAction::BidOrder { order: order.id, price })
    }
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

/// Drinks when low on energy and able to pay.
fn drink(view: &CourierView<'_>) -> Option<CourierAction> {
    let low = view.is_exhausted() || (view.energy() < view.config().energy.low && !view.is_riding());
    let useful = view.energy() < view.config().energy.capacity;
    let idle = view.held_orders().next().is_none() && !view.is_exhausted();
    (low && useful && !idle && view.purse() >= view.drink_price()).then_some(CourierAction::PurchaseDrinks)
}

/// Walks faster when late, and comfortably again with time in hand.
fn hurry(view: &CourierView<'_>) -> Option<CourierAction> {
    if view.is_riding() {
        return None;
    }
    let limits = &view.config().speed;
    let short = |held: &HeldOrder| {
        let left = held.distance * 1.2 + if held.carried { 0.0 } else { held.route };
        left / view.speed() > held.due_in
    };
    let late = view.held_orders().any(|held| short(&held));
    let wanted = if late && view.energy() > view.config().energy.low {
        (limits.walking * 1.4).min(limits.fastest)
    } else if late {
        return None;
    } else {
        limits.walking
    };
    let slack = if wanted < view.speed() { view.held_orders().all(|held| held.due_in > 60.0) } else { true };
    (slack && (wanted - view.speed()).abs() > 0.05).then_some(CourierAction::AdjustSpeed { speed: wanted })
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
        if view.notices() != self.state.seen {
            self.state.seen = view.notices();
            self.state.due = self.state.due.min(now + self.state.rng.uniform(REACTION.0, REACTION.1));
        }
        if now < self.state.due {
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
