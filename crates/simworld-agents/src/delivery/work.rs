//! What happens where a courier arrives: taking, handing over, delivering, buying; and who is paid.

use simworld_core::command::Command;

use super::config::Split;
use super::money::{Account, Cents};
use super::order::{Carried, OrderId, Stage};
use super::state::{Errand, Item, Ride};
use super::turn::{Turn, fact};

impl Turn<'_> {
    /// Does what a courier came for, if it has arrived.
    pub(super) fn arrive(&mut self, index: usize) {
        let (reach, errand) = (self.reach(index), self.state.couriers[index].errand);
        let place = |id: OrderId| self.state.order(id).map(|order| (order.pickup, order.dropoff));
        match errand {
            Errand::Idle => {}
            Errand::PickUp(id) => {
                if place(id).is_some_and(|(pickup, _)| self.is_at(index, &pickup, reach)) {
                    self.take(index, id);
                }
            }
            Errand::Deliver(id) => {
                if place(id).is_some_and(|(_, dropoff)| self.is_at(index, &dropoff, reach)) {
                    self.deliver(index, id);
                }
            }
            Errand::Meet(id) => self.meet(id),
            Errand::Shop(item) => {
                let store = self.places.store(self.state.couriers[index].position);
                if store.is_some_and(|store| self.is_at(index, &store, reach)) {
                    self.state.couriers[index].errand = Errand::Idle;
                    if let Err(reason) = self.buy(index, item) {
                        self.tell("errand_failed", Some(index), &[("reason", reason.into())]);
                    }
                }
            }
            Errand::Swap => {
                let station = self.places.station(self.state.couriers[index].position);
                if station.is_some_and(|station| self.is_at(index, &station, reach)) {
                    self.state.couriers[index].errand = Errand::Idle;
                    if let Err(reason) = self.swap(index) {
                        self.tell("errand_failed", Some(index), &[("reason", reason.into())]);
                    }
                }
            }
        }
    }

    fn take(&mut self, index: usize, id: OrderId) {
        self.state.couriers[index].errand = Errand::Idle;
        let Stage::Awarded(awarded) = self.state.orders[id.index()].stage.clone() else { return };
        self.state.orders[id.index()].stage = Stage::Carried(awarded.pick_up());
        self.state.couriers[index].tally.picked_up += 1;
        self.spawn_parcel(index, id);
        self.tell("order_picked_up", Some(index), &[("order", fact(id))]);
    }

    /// Two couriers at the meet-point, close to each other: the parcel changes hands.
    fn meet(&mut self, id: OrderId) {
        let Some(Stage::Carried(carried)) = self.state.order(id).map(|order| order.stage.clone()) else {
            return;
        };
        let Some(offer) = carried.terms.offer else { return };
        let (first, Some(second)) = (carried.carrier, offer.accepted) else { return };
        let apart = (self.state.couriers[first].position - self.state.couriers[second].position).norm();
        let both = [first, second].iter().all(|index| self.waits_at_meeting(*index, id, &offer.meet));
        if !both || apart > self.config.reach.meeting {
            return;
        }
        let Some(carried) = carried.hand_over() else { return };
        let parcel = carried.parcel;
        self.state.board.withdraw(offer.meet.xy(), id);
        self.state.release(first, id);
        self.state.disagree(second, id);
        self.state.hold(second, id);
        self.state.orders[id.index()].stage = Stage::Carried(carried);
        for index in [first, second] {
            self.state.couriers[index].errand = Errand::Idle;
            self.state.couriers[index].notices += 1;
        }
        self.state.couriers[first].tally.handed_over += 1;
        let second_id = self.state.couriers[second].id;
        if let Some(child) = parcel.filter(|parcel| self.scene.entity(*parcel).is_some()) {
            let bond = Some(self.grip(second, second_id));
            self.command(Command::Attach { child, bond });
        }
        self.tell("handed_over", Some(first), &[("order", fact(id)), ("to", second_id.into())]);
    }

    fn deliver(&mut self, index: usize, id: OrderId) {
        self.state.couriers[index].errand = Errand::Idle;
        self.withdraw_offer(id, "the order was delivered");
        let Stage::Carried(carried) = self.state.orders[id.index()].stage.clone() else { return };
        let late = (self.state.now() - carried.terms.due).max(0.0);
        let paid = self.reward(&carried, late);
        self.settle(id, &carried, self.state.orders[id.index()].ceiling, paid);
        // Somebody may have taken it out of the world.
        if let Some(parcel) = carried.parcel.filter(|parcel| self.scene.entity(*parcel).is_some()) {
            self.command(Command::Remove { id: parcel });
        }
        let tally = &mut self.state.couriers[index].tally;
        tally.delivered += 1;
        tally.late += u32::from(late > 0.0);
        tally.completion += (self.state.tick - carried.terms.tick) as f64 * self.state.dt;
        self.state.orders[id.index()].stage = Stage::Delivered(carried.deliver(self.state.tick, paid, late));
        self.state.release(index, id);
        let facts = [("order", fact(id)), ("paid", paid.dollars().into()), ("late", late.into())];
        self.tell("order_delivered", Some(index), &facts);
    }

    /// The pay less a deduction for lateness, never below the floor.
    fn reward(&self, carried: &Carried, late: f64) -> Cents {
        let (pay, orders) = (carried.terms.pay, &self.config.orders);
        (pay - orders.late_per_second.times(late)).max(pay.times(orders.late_floor))
    }

    /// Pays couriers and platform out of what the customer paid in.
    fn settle(&mut self, id: OrderId, carried: &Carried, ceiling: Cents, paid: Cents) {
        let mut transfers = Vec::with_capacity(3);
        match carried.first {
            None => transfers.push((carried.carrier, paid)),
            Some(leg) => {
                let whole = leg.distance + carried.distance;
                let share = match self.config.sharing.split {
                    Split::Distance if whole > 0.0 => leg.distance / whole,
                    Split::Distance | Split::Equal => 0.5,
                    Split::Bounty => 1.0,
                };
                let first = paid.times(share);
                transfers.push((leg.courier, first));
                transfers.push((carried.carrier, paid - first));
                transfers.push((carried.carrier, leg.bounty));
            }
        }
        for (index, amount) in transfers {
            self.transfer(id, Account::Courier(index), amount);
            let earned = &mut self.state.couriers[index].tally.earned;
            *earned = *earned + amount;
        }
        self.transfer(id, Account::Platform, ceiling - paid);
    }

    /// Pays out of the escrow what an order brought into it.
    fn transfer(&mut self, id: OrderId, to: Account, amount: Cents) {
        self.pay(Account::Escrow, to, amount, Some(id))
            .expect("the escrow holds the ceiling of every order under way");
    }

    /// Takes an offer off an order and gives its bounty back; both couriers are free.
    pub(super) fn withdraw_offer(&mut self, id: OrderId, reason: &str) {
        let Some(stage) = self.state.orders.get_mut(id.index()).map(|order| &mut order.stage) else { return };
        let Some(holder) = stage.holder() else { return };
        let Some(offer) = stage.terms_mut().and_then(|terms| terms.offer.take()) else { return };
        self.state.board.withdraw(offer.meet.xy(), id);
        if let Some(second) = offer.accepted {
            self.state.disagree(second, id);
        }
        self.transfer(id, Account::Courier(holder), offer.bounty);
        for index in offer.accepted.into_iter().chain([holder]) {
            if self.state.couriers[index].errand == Errand::Meet(id) {
                self.halt(index);
            }
            self.state.couriers[index].notices += 1;
        }
        self.tell("share_cancelled", Some(holder), &[("order", fact(id)), ("reason", reason.into())]);
    }

    pub(super) fn price(&self, item: Item) -> Cents {
        let (prices, market) = (&self.config.prices, &self.state.market);
        match item {
            Item::Scooter => prices.scooter.times(market.scooter),
            Item::Drink => prices.drink.times(market.drink),
        }
    }

    /// Pays for an item and uses it.
    pub(super) fn buy(&mut self, index: usize, item: Item) -> Result<(), String> {
        let price = self.price(item);
        match item {
            Item::Scooter if self.state.couriers[index].ride != Ride::None => {
                return Err("you have a scooter already".to_owned());
            }
            Item::Drink if self.state.couriers[index].energy >= self.config.energy.capacity => {
                return Err("you are not thirsty: your energy is full".to_owned());
            }
            _ => {}
        }
        let payment = self.pay(Account::Courier(index), Account::Shops, price, None);
        payment.map_err(|error| error.to_string())?;
        let facts = [("price", price.dollars().into())];
        let tally = &mut self.state.couriers[index].tally;
        match item {
            Item::Scooter => {
                tally.scooters += 1;
                self.state.market.scooters += 1;
                self.spawn_scooter(index);
                self.tell("scooter_bought", Some(index), &facts);
            }
            Item::Drink => {
                tally.drinks += 1;
                self.state.market.drinks += 1;
                let energy = self.state.couriers[index].energy + self.config.prices.drink_energy;
                self.state.couriers[index].energy = energy.min(self.config.energy.capacity);
                self.tell("drink_bought", Some(index), &facts);
                self.wake(index);
            }
        }
        Ok(())
    }
}
