//! The ten actions, carried out or refused with a reason.

use simworld_core::geometry::{Point2, Point3};

use super::action::CourierAction;
use super::auction::Bid;
use super::board::insert;
use super::config::{Shopping, Split};
use super::money::{Account, Cents};
use super::order::{Offer, Order, OrderId, Stage};
use super::state::{Errand, Item};
use super::turn::{Turn, fact};

impl Turn<'_> {
    /// Does what a courier decided.
    pub(super) fn act(&mut self, index: usize, action: CourierAction) -> Result<(), String> {
        match action {
            CourierAction::BidOrder { order, price } => self.bid(index, order, price),
            CourierAction::PickUpOrder { order } => self.go_pick_up(index, order),
            CourierAction::DeliverOrder { order } => self.go_deliver(index, order),
            CourierAction::ShareOrder { order, meet, bounty } => self.share(index, order, meet, bounty),
            CourierAction::CancelShareOrder { order } => self.cancel_share(index, order),
            CourierAction::GoToMeetPoint { order } => self.go_meet(index, order),
            CourierAction::PurchaseScooter => self.shop(index, Item::Scooter),
            CourierAction::PurchaseDrinks => self.shop(index, Item::Drink),
            CourierAction::SwapBattery => self.go_swap(index),
            CourierAction::AdjustSpeed { speed } => self.adjust_speed(index, speed),
            CourierAction::DoNothing => Ok(()),
        }?;
        self.state.couriers[index].tally.actions[action.index()] += 1;
        Ok(())
    }

    fn order(&self, id: OrderId) -> Result<&Order, String> {
        self.state.order(id).ok_or_else(|| format!("there is no order {id}"))
    }

    fn bid(&mut self, index: usize, id: OrderId, price: Cents) -> Result<(), String> {
        let order = self.order(id)?;
        if !matches!(order.stage, Stage::Open(_)) {
            return Err(format!("order {id} is {} and takes no bids", order.stage.name()));
        }
        if price <= Cents::ZERO || price > order.ceiling {
            return Err(format!("bid more than nothing and at most {}, not {price}", order.ceiling));
        }
        if self.state.load(index) >= self.config.capacity as usize {
            return Err(format!("you hold as many orders as you may: {}", self.config.capacity));
        }
        let bid = Bid { courier: index, price, tick: self.state.tick };
        if let Stage::Open(open) = &mut self.state.orders[id.index()].stage {
            open.bids.retain(|other| other.courier != index);
            open.bids.push(bid);
        }
        insert(&mut self.state.couriers[index].bids, id);
        let tally = &mut self.state.couriers[index].tally;
        tally.bids += 1;
        tally.bid_sum = tally.bid_sum + price;
        self.tell("bid_placed", Some(index), &[("order", fact(id)), ("price", price.dollars().into())]);
        Ok(())
    }

    /// Sets out on an errand, unless the courier cannot move.
    pub(super) fn set_out(&mut self, index: usize, errand: Errand) -> Result<(), String> {
        if self.state.couriers[index].exhausted {
            return Err("you are exhausted: rest or drink".to_owned());
        }
        self.state.couriers[index].errand = errand;
        self.send(index);
        Ok(())
    }

    fn go_pick_up(&mut self, index: usize, id: OrderId) -> Result<(), String> {
        match &self.order(id)?.stage {
            Stage::Awarded(awarded) if awarded.courier == index => self.set_out(index, Errand::PickUp(id)),
            stage => Err(format!("order {id} is {} and not yours to pick up", stage.name())),
        }
    }

    fn go_deliver(&mut self, index: usize, id: OrderId) -> Result<(), String> {
        match &self.order(id)?.stage {
            Stage::Carried(carried) if carried.carrier == index => self.set_out(index, Errand::Deliver(id)),
            stage => Err(format!("order {id} is {} and you do not carry it", stage.name())),
        }
    }

    fn share(
        &mut self,
        index: usize,
        id: OrderId,
        meet: Option<Point2>,
        bounty: Cents,
    ) -> Result<(), String> {
        let order = self.order(id)?;
        if order.stage.holder() != Some(index) {
            return Err(format!("order {id} is not yours to share"));
        }
        if order.stage.terms().is_some_and(|terms| terms.offer.is_some()) {
            return Err(format!("order {id} is offered already"));
        }
        if matches!(&order.stage, Stage::Carried(carried) if carried.first.is_some()) {
            return Err(format!("order {id} changed hands once, and may not again"));
        }
        if bounty > Cents::ZERO && self.config.sharing.split != Split::Bounty {
            return Err("give no bounty: the pay is split".to_owned());
        }
        let meet = match meet {
            Some(point) => self.places.meet_point(point).ok_or("meet within the city")?,
            None => self.halfway(index, id)?,
        };
        let payment = self.pay(Account::Courier(index), Account::Escrow, bounty, Some(id));
        payment.map_err(|error| error.to_string())?;
        if let Some(terms) = self.state.orders[id.index()].stage.terms_mut() {
            terms.offer = Some(Offer { meet, bounty, accepted: None });
        }
        self.state.couriers[index].tally.shared += 1;
        self.state.board.offer(meet.xy(), id);
        let facts = [
            ("order", fact(id)),
            ("x", meet.x.into()),
            ("y", meet.y.into()),
            ("bounty", bounty.dollars().into()),
        ];
        self.tell("order_shared", Some(index), &facts);
        Ok(())
    }

    /// The place nearest to the middle of what is left of the way: somewhere one can walk to.
    fn halfway(&self, index: usize, id: OrderId) -> Result<Point3, String> {
        let order = self.order(id)?;
        let from = match &order.stage {
            Stage::Carried(_) => self.state.couriers[index].position,
            _ => order.pickup.xy(),
        };
        let middle = nalgebra::center(&from, &order.dropoff.xy());
        self.places.door(middle).ok_or_else(|| "there is no place".to_owned())
    }

    fn cancel_share(&mut self, index: usize, id: OrderId) -> Result<(), String> {
        let stage = &self.order(id)?.stage;
        let Some(offer) = stage.terms().and_then(|terms| terms.offer) else {
            return Err(format!("order {id} is not offered"));
        };
        if stage.holder() == Some(index) {
            self.withdraw_offer(id, "the holder took it back");
            return Ok(());
        }
        if offer.accepted != Some(index) {
            return Err(format!("the offer of order {id} is not yours to cancel"));
        }
        let holder = stage.holder();
        if let Some(terms) = self.state.orders[id.index()].stage.terms_mut() {
            terms.offer = Some(Offer { accepted: None, ..offer });
        }
        self.state.disagree(index, id);
        if self.state.couriers[index].errand == Errand::Meet(id) {
            self.halt(index);
        }
        if let Some(holder) = holder {
            self.state.couriers[holder].notices += 1;
        }
        self.tell("share_declined", Some(index), &[("order", fact(id))]);
        Ok(())
    }

    fn go_meet(&mut self, index: usize, id: OrderId) -> Result<(), String> {
        let stage = &self.order(id)?.stage;
        let Some(offer) = stage.terms().and_then(|terms| terms.offer) else {
            return Err(format!("order {id} is not offered"));
        };
        let holder = stage.holder();
        if holder == Some(index) {
            if matches!(stage, Stage::Awarded(_)) {
                return Err(format!("pick order {id} up first"));
            }
            return self.set_out(index, Errand::Meet(id));
        }
        match offer.accepted {
            Some(second) if second == index => return self.set_out(index, Errand::Meet(id)),
            Some(_) => return Err(format!("somebody else accepted order {id}")),
            None if self.state.load(index) >= self.config.capacity as usize => {
                return Err(format!("you hold as many orders as you may: {}", self.config.capacity));
            }
            None => {}
        }
        self.set_out(index, Errand::Meet(id))?;
        if let Some(terms) = self.state.orders[id.index()].stage.terms_mut() {
            terms.offer = Some(Offer { accepted: Some(index), ..offer });
        }
        self.state.agree(index, id);
        if let Some(holder) = holder {
            self.state.couriers[holder].notices += 1;
        }
        self.tell("share_accepted", Some(index), &[("order", fact(id))]);
        Ok(())
    }

    fn shop(&mut self, index: usize, item: Item) -> Result<(), String> {
        match self.config.prices.shopping {
            Shopping::Anywhere => self.buy(index, item),
            Shopping::AtStore => self.set_out(index, Errand::Shop(item)),
        }
    }

    fn adjust_speed(&mut self, index: usize, speed: f64) -> Result<(), String> {
        let limits = &self.config.speed;
        let riding = self.state.couriers[index].is_riding();
        let fastest = if riding { limits.riding } else { limits.fastest };
        if !(limits.slowest..=fastest).contains(&speed) {
            return Err(format!("give speed = {} to {fastest} m/s", limits.slowest));
        }
        let courier = &mut self.state.couriers[index];
        *(if riding { &mut courier.riding } else { &mut courier.walking }) = speed;
        self.send(index);
        self.tell("speed_adjusted", Some(index), &[("speed", speed.into())]);
        Ok(())
    }
}
