//! One step of the task: what moved, who arrived, what was ordered and won, what was asked for.

use simworld_core::command::Command;
use simworld_core::event::EventKind;
use simworld_core::geometry::Point3;
use simworld_core::scene::Scene;
use simworld_core::seam::{Goal, Plan, PlanStep, TaskContext, TaskOutput};
use simworld_core::value::Value;

use super::action::CourierAction;
use super::auction::Auction;
use super::config::DeliveryConfig;
use super::money::{Account, Cents, Overdrawn};
use super::order::OrderId;
use super::places::Places;
use super::routes::Routes;
use super::state::{Errand, State};

/// Everything a step works on.
pub(super) struct Turn<'a> {
    pub(super) config: &'a DeliveryConfig,
    pub(super) auction: &'a dyn Auction,
    pub(super) routes: &'a mut Routes,
    pub(super) places: &'a Places,
    pub(super) state: &'a mut State,
    pub(super) scene: &'a dyn Scene,
    pub(super) out: &'a mut TaskOutput,
}

impl Turn<'_> {
    pub(super) fn run(&mut self, context: &TaskContext<'_>) {
        self.state.tick += 1;
        self.weather();
        for index in 0..self.state.couriers.len() {
            self.find_parcels(index);
            self.mount(index);
            self.exert(index);
        }
        for index in 0..self.state.couriers.len() {
            self.arrive(index);
        }
        self.end_errands(context);
        self.take_orders();
        self.close_auctions();
        self.move_prices();
        for (who, intent) in context.intents {
            let Some(index) = self.state.courier_of(*who) else { continue };
            let done = CourierAction::try_from(intent)
                .map_err(|error| error.to_string())
                .and_then(|action| self.act(index, action));
            if let Err(reason) = done {
                self.state.couriers[index].tally.refused += 1;
                self.out.events.push(EventKind::IntentRefused { who: *who, reason });
            }
        }
    }

    /// A plan that ended without an arrival ends the errand; its mind may try again.
    fn end_errands(&mut self, context: &TaskContext<'_>) {
        for event in context.events {
            let (who, reason) = match &event.kind {
                EventKind::PlanDone { who } => (*who, "it came to the end of its way and not to the place"),
                EventKind::PlanFailed { who, reason } => (*who, reason.as_str()),
                _ => continue,
            };
            let Some(index) = self.state.courier_of(who) else { continue };
            match self.state.couriers[index].errand {
                Errand::Idle => {}
                // At the meet-point one waits.
                Errand::Meet(_) if matches!(event.kind, EventKind::PlanDone { .. }) => {}
                _ => {
                    self.state.couriers[index].errand = Errand::Idle;
                    self.tell("errand_failed", Some(index), &[("reason", reason.into())]);
                }
            }
        }
    }

    /// Reports something; the courier concerned has something to think about.
    pub(super) fn tell(&mut self, name: &str, courier: Option<usize>, facts: &[(&str, Value)]) {
        let who = courier.map(|index| {
            self.state.couriers[index].notices += 1;
            self.state.couriers[index].id
        });
        let event = EventKind::task(name, who);
        let event = facts.iter().fold(event, |event, (key, value)| event.with(key, value.clone()));
        self.out.events.push(event);
    }

    /// Moves money over an order or over none, and tells of it: whoever reads the events has every entry of the ledger.
    pub(super) fn pay(
        &mut self,
        from: Account,
        to: Account,
        amount: Cents,
        order: Option<OrderId>,
    ) -> Result<(), Overdrawn> {
        self.state.ledger.pay(from, to, amount)?;
        if amount > Cents::ZERO {
            let mut facts =
                vec![("from", self.name(from)), ("to", self.name(to)), ("amount", amount.dollars().into())];
            facts.extend(order.map(|order| ("order", fact(order))));
            self.tell("money_moved", None, &facts);
        }
        Ok(())
    }

    /// An account as a fact: a courier is an entity, the others are words.
    fn name(&self, account: Account) -> Value {
        match account {
            Account::Courier(index) => self.state.couriers[index].id.into(),
            Account::Escrow => "escrow".into(),
            Account::Platform => "platform".into(),
            Account::Shops => "shops".into(),
            Account::Customers => "customers".into(),
        }
    }

    /// Distance at which a courier has arrived at an access point, m.
    pub(super) fn reach(&self, index: usize) -> f64 {
        if self.state.couriers[index].is_riding() {
            self.config.reach.riding
        } else {
            self.config.reach.walking
        }
    }

    pub(super) fn is_at(&self, index: usize, point: &Point3, reach: f64) -> bool {
        (self.state.couriers[index].position - point.xy()).norm() <= reach
    }

    /// Sends a courier on its errand, at its present speed.
    pub(super) fn send(&mut self, index: usize) {
        let courier = &self.state.couriers[index];
        let dragging = self.config.battery.dragging_speed;
        let most = if courier.is_dragging() { dragging } else { f64::INFINITY };
        let speed = courier.speed().min(most) * self.state.pace;
        // A plan ends well inside the circle in which the task sees an arrival.
        let (at_place, at_meeting) = (self.reach(index) * 0.5, self.config.reach.meeting * 0.3);
        let order = |id: OrderId| self.state.order(id);
        let goal = match courier.errand {
            Errand::Idle => None,
            Errand::PickUp(id) => order(id).map(|order| (Goal::Point(order.pickup), at_place)),
            Errand::Deliver(id) => order(id).map(|order| (Goal::Point(order.dropoff), at_place)),
            Errand::Meet(id) => order(id)
                .and_then(|order| order.stage.terms()?.offer)
                .map(|offer| (Goal::Point(offer.meet), at_meeting)),
            Errand::Shop(_) => self.places.store(courier.position).map(|at| (Goal::Point(at), at_place)),
            Errand::Swap => self.places.station(courier.position).map(|at| (Goal::Point(at), at_place)),
        };
        if let Some((to, within)) = goal {
            let steps = vec![PlanStep::Navigate { to, within, speed: Some(speed) }];
            self.out.plans.push((courier.id, Plan { steps }));
        }
    }

    /// Brings a courier to a halt; its errand is over.
    pub(super) fn halt(&mut self, index: usize) {
        let courier = &mut self.state.couriers[index];
        courier.errand = Errand::Idle;
        let stop = PlanStep::Act(simworld_core::action::Action::Stop);
        self.out.plans.push((courier.id, Plan { steps: vec![stop] }));
    }

    pub(super) fn command(&mut self, command: Command) {
        self.out.commands.push(command);
    }
}

/// The number of an order as a fact.
pub(super) fn fact(order: OrderId) -> Value {
    Value::Integer(i64::from(order.0))
}
