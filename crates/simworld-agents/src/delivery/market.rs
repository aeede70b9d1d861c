//! Demand: orders come, auctions close, prices move.

use simworld_core::geometry::{Point2, Point3};

use super::auction::Bid;
use super::board::remove;
use super::money::{Account, Cents};
use super::order::{Open, Order, OrderId, Stage};
use super::state::BidResult;
use super::turn::{Turn, fact};

/// Results of bids that a courier remembers.
const MEMORY: usize = 8;

impl Turn<'_> {
    /// The orders that are open at the start, and when the first one comes after them.
    pub(super) fn open_shop(&mut self) {
        for _ in 0..self.config.orders.initial {
            self.post_order();
        }
        self.state.next_arrival = self.next_arrival(0.0);
    }

    /// Orders come as a Poisson process: all customers together, each at its own rate.
    fn next_arrival(&mut self, after: f64) -> f64 {
        let orders = &self.config.orders;
        let each = orders.per_customer_hour * orders.hunger_rate / 3600.0;
        let rate = each * self.places.sites.customers() as f64;
        if rate > 0.0 { after + self.state.arrivals.exponential(rate) } else { f64::INFINITY }
    }

    pub(super) fn take_orders(&mut self) {
        while self.state.next_arrival <= self.state.now() {
            let arrived = self.state.next_arrival;
            self.post_order();
            self.state.next_arrival = self.next_arrival(arrived);
        }
    }

    fn post_order(&mut self) {
        let Some(home) = self.places.sites.draw_home(&mut self.state.arrivals) else { return };
        let orders = &self.config.orders;
        let restaurant = self.places.draw_restaurant(&home, orders.radius, &mut self.state.arrivals);
        let Some(restaurant) = restaurant else { return };
        let route = self.routes.length(&restaurant.access, &home.access);
        let factor = self.state.arrivals.uniform(orders.least_factor, orders.greatest_factor);
        let kilometres = route / 1000.0;
        let fair = orders.base.0 as f64 + orders.per_kilometre.0 as f64 * kilometres;
        let ceiling = Cents((fair * factor * self.state.market.ceiling).round().clamp(1.0, 1e12) as i64);
        let id = OrderId(self.state.orders.len() as u32);
        let window = (self.config.auction.window / self.state.dt).ceil().max(1.0) as u64;
        let order = Order {
            id,
            restaurant: restaurant.entity,
            pickup: restaurant.access,
            home: home.entity,
            dropoff: home.access,
            route,
            ceiling,
            posted: self.state.tick,
            stage: Stage::Open(Open { closes: self.state.tick + window, bids: Vec::new() }),
        };
        self.state.open.push(id);
        if let Some(tender) = order.tender() {
            self.state.board.tender(tender);
        }
        self.state.orders.push(order);
        let facts = [
            ("order", fact(id)),
            ("restaurant", restaurant.entity.into()),
            ("home", home.entity.into()),
            ("route", route.into()),
            ("ceiling", ceiling.dollars().into()),
        ];
        self.tell("order_posted", None, &facts);
    }

    /// Orders close in the order in which they were posted: the window is the same for all.
    pub(super) fn close_auctions(&mut self) {
        let tick = self.state.tick;
        let is_due = |order: &Order| matches!(&order.stage, Stage::Open(open) if open.closes <= tick);
        let due = |id: &&OrderId| self.state.order(**id).is_some_and(is_due);
        let due = self.state.open.iter().take_while(due).count();
        for id in self.state.open.drain(..due).collect::<Vec<_>>() {
            self.close_auction(id);
        }
    }

    /// Awards an order to a bidder who can still take it, or lets it go.
    fn close_auction(&mut self, id: OrderId) {
        let Some(order) = self.state.order(id).cloned() else { return };
        let Stage::Open(open) = order.stage else { return };
        self.state.board.close(order.pickup.xy(), id);
        let free = |bid: &&Bid| self.state.load(bid.courier) < self.config.capacity as usize;
        let bids: Vec<Bid> = open.bids.iter().filter(free).copied().collect();
        let award = self.auction.award(order.ceiling, &bids, &mut self.state.lots);
        // An auction of somebody's own is held to the ceiling.
        let award = award.filter(|award| award.bid < bids.len());
        let winner =
            award.map(|award| (bids[award.bid].courier, award.pay.clamp(Cents::ZERO, order.ceiling)));
        self.state.market.closed += 1;
        for bid in &open.bids {
            let won = winner.is_some_and(|(courier, _)| courier == bid.courier);
            self.remember(bid, id, order.ceiling, won);
        }
        let Some((courier, pay)) = winner else {
            self.state.market.unwanted += 1;
            self.state.orders[id.index()].stage = Stage::Expired;
            self.tell("order_expired", None, &[("order", fact(id)), ("bids", (bids.len() as i64).into())]);
            return;
        };
        self.pay(Account::Customers, Account::Escrow, order.ceiling, Some(id))
            .expect("customers can always pay an amount that is not negative");
        let approach = self.approach(courier, &order.pickup);
        let orders = &self.config.orders;
        let due = self.state.now() + orders.allowance * (approach + order.route) / orders.allowance_speed;
        let bidders = open.bids.len() as i64;
        let awarded = open.award(courier, pay, self.state.tick, due);
        self.state.orders[id.index()].stage = Stage::Awarded(awarded);
        self.state.hold(courier, id);
        self.state.couriers[courier].tally.won += 1;
        self.state.last_clearing = Some(pay.0 as f64 / order.ceiling.0 as f64);
        let facts = [
            ("order", fact(id)),
            ("pay", pay.dollars().into()),
            ("bids", bidders.into()),
            ("due", due.into()),
        ];
        self.tell("order_awarded", Some(courier), &facts);
    }

    /// How far a courier has to a restaurant, m: by the ways that there are, as for the rest of the order.
    fn approach(&mut self, courier: usize, pickup: &Point3) -> f64 {
        let Point2 { coords } = self.state.couriers[courier].position;
        self.routes.length(&Point3::new(coords.x, coords.y, pickup.z), pickup)
    }

    fn remember(&mut self, bid: &Bid, order: OrderId, ceiling: Cents, won: bool) {
        let courier = &mut self.state.couriers[bid.courier];
        remove(&mut courier.bids, order);
        courier.results.push(BidResult { order, price: bid.price, ceiling, won });
        if courier.results.len() > MEMORY {
            courier.results.remove(0);
            courier.results_before += 1;
        }
        courier.notices += 1;
    }

    /// A random walk within bounds, pushed by demand.
    pub(super) fn move_prices(&mut self) {
        let prices = &self.config.prices;
        if !prices.drift || self.state.now() < self.state.market.next {
            return;
        }
        let couriers = self.state.couriers.len() as f64;
        let (market, rng) = (&mut self.state.market, &mut self.state.moves);
        let unwanted = f64::from(market.unwanted) / f64::from(market.closed.max(1));
        let demands = [
            (&mut market.ceiling, unwanted),
            (&mut market.scooter, f64::from(market.scooters) / couriers),
            (&mut market.drink, f64::from(market.drinks) / couriers),
        ];
        for (factor, demand) in demands {
            let push = rng.normal(0.0, prices.volatility) + prices.demand_gain * demand;
            *factor = (*factor * (1.0 + push)).clamp(1.0 / prices.bound, prices.bound);
        }
        (market.closed, market.unwanted, market.scooters, market.drinks) = (0, 0, 0, 0);
        market.next += prices.interval;
        let facts = [
            ("ceiling", market.ceiling.into()),
            ("scooter", market.scooter.into()),
            ("drink", market.drink.into()),
        ];
        self.tell("prices_moved", None, &facts);
    }
}
