//! The auctions of a run, gathered from its events.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use simworld_core::event::{Event, EventKind};
use simworld_core::id::EntityId;
use simworld_core::value::Value;

/// One auction: who bid what, and who won.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Auction {
    /// Greatest price that the customer pays, $.
    pub ceiling: f64,
    /// Courier, by index, and its last price, $; in the order of couriers.
    pub bids: Vec<(usize, f64)>,
    /// Who won, by index; `None` while it is open, or if nobody did.
    pub winner: Option<usize>,
}

impl Auction {
    /// Every bid as a share of the ceiling: who, the share, whether it won.
    pub fn shares(&self) -> impl Iterator<Item = (usize, f64, bool)> + '_ {
        let bids = self.bids.iter().filter(|_| self.ceiling > 0.0);
        bids.map(|(who, price)| (*who, price / self.ceiling, self.winner == Some(*who)))
    }
}

/// Gathers auctions event by event.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct AuctionBook {
    /// The place of each courier in the list of them.
    seats: BTreeMap<EntityId, usize>,
    /// By the number of the order.
    auctions: BTreeMap<i64, Auction>,
}

impl AuctionBook {
    /// An empty book of a run with those couriers.
    pub(super) fn new(couriers: &[EntityId]) -> Self {
        Self { seats: couriers.iter().copied().zip(0..).collect(), auctions: BTreeMap::new() }
    }

    /// Takes in an event.
    pub(super) fn take(&mut self, event: &Event) {
        let EventKind::Task { name, who, data } = &event.kind else { return };
        let Some(order) = data.get("order").and_then(Value::as_i64) else { return };
        let number = |key: &str| data.get(key).and_then(Value::as_f64).unwrap_or_default();
        let who = who.and_then(|who| self.seats.get(&who).copied());
        match (name.as_str(), who) {
            ("order_posted", _) => {
                self.auctions.insert(order, Auction { ceiling: number("ceiling"), ..Auction::default() });
            }
            ("bid_placed", Some(who)) => {
                let Some(auction) = self.auctions.get_mut(&order) else { return };
                match auction.bids.binary_search_by_key(&who, |bid| bid.0) {
                    Ok(rank) => auction.bids[rank].1 = number("price"),
                    Err(rank) => auction.bids.insert(rank, (who, number("price"))),
                }
            }
            ("order_awarded", Some(who)) => {
                if let Some(auction) = self.auctions.get_mut(&order) {
                    auction.winner = Some(who);
                }
            }
            _ => {}
        }
    }

    /// The auctions, in the order of their orders.
    pub(super) fn finish(self) -> Vec<Auction> {
        self.auctions.into_values().collect()
    }
}

/// The auctions of a run with those couriers, from its events.
pub fn auctions_of(events: &[Event], couriers: &[EntityId]) -> Vec<Auction> {
    let mut book = AuctionBook::new(couriers);
    for event in events {
        book.take(event);
    }
    book.finish()
}

#[cfg(test)]
mod tests {
    use simworld_core::clock::Tick;

    use super::*;

    #[test]
    fn a_later_bid_replaces_an_earlier_one() {
        let couriers = [EntityId::from(4), EntityId::from(9)];
        let mut book = AuctionBook::new(&couriers);
        let mut tell = |name: &str, who: Option<usize>, facts: &[(&str, Value)]| {
            let kind = EventKind::task(name, who.map(|who| couriers[who]));
            let kind = facts.iter().fold(kind, |kind, (key, value)| kind.with(key, value.clone()));
            book.take(&Event { tick: Tick(1), kind });
        };
        let order = ("order", Value::Integer(3));
        tell("order_posted", None, &[order.clone(), ("ceiling", Value::Number(20.0))]);
        tell("bid_placed", Some(1), &[order.clone(), ("price", Value::Number(18.0))]);
        tell("bid_placed", Some(0), &[order.clone(), ("price", Value::Number(15.0))]);
        tell("bid_placed", Some(1), &[order.clone(), ("price", Value::Number(10.0))]);
        tell("order_awarded", Some(1), &[order]);
        let auctions = book.finish();
        assert_eq!(auctions[0].bids, [(0, 15.0), (1, 10.0)]);
        assert_eq!(auctions[0].shares().collect::<Vec<_>>(), [(0, 0.75, false), (1, 0.5, true)]);
    }
}
