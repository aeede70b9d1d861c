//! What a courier can do now, as a schema, and how things stand for it, in words.

use serde_json::{Value as Json, json};
use simworld_core::scene::Scene;

use crate::delivery::{
    Cents, CourierAction, CourierView, Errand, HeldOrder, OpenOrder, Order, OrderId, SharedOffer, Shopping,
    Split,
};
use crate::thought::prompts::one_line;
use crate::thought::schema::{any_of, integer, object, one_of, whole, words};

/// The most orders of a kind that are offered, the oldest.
const MOST: usize = 16;
/// An auction that ends sooner than this is over when a bid arrives, s.
const CLOSING: f64 = 0.25;

/// With a larger share of its energy nobody is thirsty; a rest may fill it up before a drink is bought.
const THIRSTY: f64 = 0.98;

/// What a courier can do now: a branch of the schema for each.
pub(super) struct CourierMenu<'a> {
    view: CourierView<'a>,
    held: Vec<HeldOrder>,
    open: Vec<OpenOrder>,
    offers: Vec<SharedOffer>,
}

/// The calls in words.
pub(super) const CALLS: &str =
    "bid_order(order, cents): asks to be paid so much for an open order; a later bid replaces an earlier
pick_up_order(order): goes to the restaurant and takes a won order
deliver_order(order): goes to the home and hands the order over
share_order(order, bounty_cents): offers to hand an order over half-way
cancel_share_order(order): takes that back, or steps back from an offer that you accepted
go_to_meet_point(order): goes to where an order changes hands, and accepts the offer if it is another's
purchase_scooter(), purchase_drinks(): buys one
swap_battery(): goes to a charging station and swaps the battery of the scooter
adjust_speed(decimetres_per_second): moves at another speed from now on; a metre tires the more, the faster one walks, and most at a \
     run, from 2.1 m/s on; parcels, climbs and snow tire too
do_nothing(): lets the moment pass";

impl<'a> CourierMenu<'a> {
    /// The menu follows from the state of the task, and from nothing that is written anywhere. What is chosen of it is done
    /// `after` so long, s: auctions that are over by then are not on it.
    pub(super) fn new(view: CourierView<'a>, after: f64) -> Self {
        let lasts = |order: &OpenOrder| order.closes_in > after + CLOSING;
        let open = view.open_orders().filter(lasts).take(MOST).collect();
        Self { view, held: view.held_orders().collect(), open, offers: view.offers().take(MOST).collect() }
    }

    /// One call with words before it.
    pub(super) fn schema(&self) -> Json {
        let view = &self.view;
        let act = |name: &str| ("act", one_of([name]));
        let mut branches = vec![object([act("do_nothing")])];
        if view.room() > 0 {
            // Each order has a ceiling of its own.
            branches.extend(self.open.iter().map(|order| {
                let cents = integer(1, order.ceiling.0);
                object([act("bid_order"), ("order", one_of([order.id.to_string()])), ("cents", cents)])
            }));
        }
        for (name, orders) in self.errands() {
            if !orders.is_empty() {
                branches.push(object([act(name), ("order", one_of(orders))]));
            }
        }
        let to_share = self.held.iter().filter(|held| !held.offered && !held.second_hand);
        let to_share: Vec<String> = to_share.map(|held| held.id.to_string()).collect();
        if !to_share.is_empty() {
            let most = if view.config().sharing.split == Split::Bounty { view.purse().0.max(0) } else { 0 };
            let bounty = ("bounty_cents", integer(0, most));
            branches.push(object([act("share_order"), ("order", one_of(to_share)), bounty]));
        }
        // Who is exhausted goes nowhere; where things are bought on the spot, it may still drink.
        let shops = !view.is_exhausted() || view.config().prices.shopping == Shopping::Anywhere;
        if shops && !view.has_scooter() && view.purse() >= view.scooter_price() {
            branches.push(object([act("purchase_scooter")]));
        }
        let thirsty = view.energy() < THIRSTY * view.config().energy.capacity;
        if shops && thirsty && view.purse() >= view.drink_price() {
            branches.push(object([act("purchase_drinks")]));
        }
        let can_pay = view.purse() >= view.config().battery.swap;
        let worth_it = view.charge().is_some_and(|charge| charge < 1.0) && view.errand() != Errand::Swap;
        if worth_it && can_pay && !view.is_exhausted() {
            branches.push(object([act("swap_battery")]));
        }
        let (low, high) = self.speeds();
        if low <= high {
            branches.push(object([act("adjust_speed"), ("decimetres_per_second", integer(low, high))]));
        }
        object([("because", words(300)), ("deed", any_of(branches))])
    }

    /// The calls about one order, each with the orders that it is possible for.
    fn errands(&self) -> [(&'static str, Vec<String>); 4] {
        let ids = |fits: &dyn Fn(&HeldOrder) -> bool| -> Vec<String> {
            self.held.iter().filter(|held| fits(held)).map(|held| held.id.to_string()).collect()
        };
        // What it is on its way to do may be done before it is told again.
        let (goes, errand) = (!self.view.is_exhausted(), self.view.errand());
        let mut cancel = ids(&|held| held.offered);
        cancel.extend(self.offers.iter().filter(|offer| offer.accepted).map(|offer| offer.id.to_string()));
        let meets = |id| goes && errand != Errand::Meet(id);
        let mut meet = ids(&|held| meets(held.id) && held.offered && held.carried);
        let room = self.view.room() > 0;
        let accepted = self.offers.iter().filter(|offer| meets(offer.id) && (offer.accepted || room));
        meet.extend(accepted.map(|offer| offer.id.to_string()));
        [
            ("pick_up_order", ids(&|held| goes && !held.carried && errand != Errand::PickUp(held.id))),
            ("deliver_order", ids(&|held| goes && held.carried && errand != Errand::Deliver(held.id))),
            ("cancel_share_order", cancel),
            ("go_to_meet_point", meet),
        ]
    }

    /// The speeds that it may move at, decimetres a second.
    fn speeds(&self) -> (i64, i64) {
        let limits = &self.view.config().speed;
        let fastest = if self.view.is_riding() { limits.riding } else { limits.fastest };
        ((limits.slowest * 10.0).ceil() as i64, (fastest * 10.0).floor() as i64)
    }

    /// What a deed that conforms to the schema stands for.
    pub(super) fn read(deed: &Json) -> Option<CourierAction> {
        let order = || deed["order"].as_str()?.trim_start_matches('#').parse().ok().map(OrderId);
        let cents = |name: &str| whole(&deed[name]).map(Cents);
        Some(match deed["act"].as_str()? {
            "bid_order" => CourierAction::BidOrder { order: order()?, price: cents("cents")? },
            "pick_up_order" => CourierAction::PickUpOrder { order: order()? },
            "deliver_order" => CourierAction::DeliverOrder { order: order()? },
            "share_order" => {
                CourierAction::ShareOrder { order: order()?, meet: None, bounty: cents("bounty_cents")? }
            }
            "cancel_share_order" => CourierAction::CancelShareOrder { order: order()? },
            "go_to_meet_point" => CourierAction::GoToMeetPoint { order: order()? },
            "purchase_scooter" => CourierAction::PurchaseScooter,
            "purchase_drinks" => CourierAction::PurchaseDrinks,
            "adjust_speed" => {
                CourierAction::AdjustSpeed { speed: whole(&deed["decimetres_per_second"])? as f64 / 10.0 }
            }
            "swap_battery" => CourierAction::SwapBattery,
            "do_nothing" => CourierAction::DoNothing,
            _ => return None,
        })
    }

    /// How the courier itself stands.
    pub(super) fn oneself(&self) -> String {
        let view = &self.view;
        let errand = match view.errand() {
            Errand::Idle => "on no errand".to_owned(),
            Errand::PickUp(id) => format!("on the way to pick up order {id}"),
            Errand::Deliver(id) => format!("on the way to deliver order {id}"),
            Errand::Meet(id) => format!("on the way to meet over order {id}"),
            Errand::Swap => "on the way to swap the battery".to_owned(),
            Errand::Shop(item) => format!("on the way to buy a {}", format!("{item:?}").to_lowercase()),
        };
        let ride = match view.charge() {
            _ if view.is_dragging() => ", pushing a scooter whose battery is empty".to_owned(),
            Some(charge) if view.is_riding() => format!(", riding, battery {:.0} %", charge * 100.0),
            _ => if view.is_riding() { ", riding" } else { "" }.to_owned(),
        };
        let tired = if view.is_exhausted() { ", exhausted" } else { "" };
        let (low, high) = self.speeds();
        let went = |share| format!("; the last order went for {:.0} % of what was offered", share * 100.0);
        let went = view.last_clearing().map(went).unwrap_or_default();
        format!(
            "{} cents, energy {:.0} of {:.0}{tired}, {:.1} m/s of {:.1} to {:.1}{ride}, {errand}, room for {} more orders; a \
             drink costs {} cents, a scooter {}{went}",
            view.purse().0,
            view.energy(),
            view.config().energy.capacity,
            view.speed(),
            low as f64 / 10.0,
            high as f64 / 10.0,
            view.room(),
            view.drink_price().0,
            view.scooter_price().0
        )
    }

    /// The orders that it has won, a line each; names come from the scene.
    pub(super) fn held(&self, orders: &[Order], scene: &dyn Scene) -> String {
        let line = |held: &HeldOrder| {
            let state = if held.carried { "in hand" } else { "at the restaurant" };
            let shared = match (held.offered, held.accepted) {
                (true, true) => ", offered and accepted",
                (true, false) => ", offered",
                _ => "",
            };
            let way = named(held.id, orders, scene);
            let on = if held.carried { String::new() } else { format!(" and {:.0} m on", held.route) };
            format!(
                "order {} {way}: {state}, {:.0} m to go there{on}, pays {} cents, due in {:.0} s{shared}",
                held.id, held.distance, held.pay.0, held.due_in
            )
        };
        self.held.iter().map(line).collect::<Vec<_>>().join("\n")
    }

    /// The orders that take bids, a line each.
    pub(super) fn open(&self, orders: &[Order], scene: &dyn Scene) -> String {
        let line = |order: &OpenOrder| {
            let own = order.own_bid.map(|bid| format!(", you bid {}", bid.0)).unwrap_or_default();
            let way = named(order.id, orders, scene);
            format!(
                "order {} {way}: at most {} cents, {:.0} m to the restaurant and {:.0} m on, closes in {:.0} s{own}",
                order.id, order.ceiling.0, order.approach, order.route, order.closes_in
            )
        };
        self.open.iter().map(line).collect::<Vec<_>>().join("\n")
    }

    /// The orders that others would share, a line each.
    pub(super) fn offers(&self, orders: &[Order], scene: &dyn Scene) -> String {
        let line = |offer: &SharedOffer| {
            let own = if offer.accepted { ", accepted by you" } else { "" };
            let way = named(offer.id, orders, scene);
            format!(
                "order {} {way}: meet {:.0} m from here, {:.0} m on, pays {} cents to both, bounty {}{own}",
                offer.id, offer.distance, offer.rest, offer.pay.0, offer.bounty.0
            )
        };
        self.offers.iter().map(line).collect::<Vec<_>>().join("\n")
    }
}

/// From where to where an order goes, as people call the places.
fn named(id: OrderId, orders: &[Order], scene: &dyn Scene) -> String {
    let name = |entity| scene.entity(entity).map(|place| one_line(place.label())).unwrap_or_default();
    let order = orders.get(id.index());
    order.map(|order| json!([name(order.restaurant), name(order.home)]).to_string()).unwrap_or_default()
}
