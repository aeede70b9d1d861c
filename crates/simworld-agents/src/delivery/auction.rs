//! Sealed-bid reverse auctions: couriers say for how little they would carry an order.

use serde::{Deserialize, Serialize};
use simworld_core::ops;
use simworld_core::seed::StreamRng;

use super::money::Cents;

/// What a courier asks for an order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Bid {
    /// The courier, by its place in the list of agents.
    pub courier: usize,
    /// What it wants to be paid.
    pub price: Cents,
    /// The step in which it was placed.
    pub tick: u64,
}

/// How an auction ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Award {
    /// Which of the bids won.
    pub bid: usize,
    /// What the winner is paid on delivery, at most the ceiling.
    pub pay: Cents,
}

/// Decides who carries an order.
pub trait Auction: Send + Sync {
    /// Chooses among bids, none of which exceeds the ceiling; `None` only if there are none. Random choices are
    /// drawn from `rng`.
    fn award(&self, ceiling: Cents, bids: &[Bid], rng: &mut StreamRng) -> Option<Award>;
}

/// Which auction is held.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum AuctionRule {
    /// The lowest bid wins and is paid as bid.
    #[default]
    FirstPrice,
    /// The lowest bid wins and is paid the second lowest, or the ceiling if it is alone (Vickrey 1961).
    Vickrey,
    /// A bid wins with a probability that falls with its price, and is paid as bid.
    Softmin {
        /// Price difference that makes a bid e times less likely, dollars, in [0.001, 1000].
        temperature: f64,
    },
}

impl AuctionRule {
    /// The auction of this rule.
    pub fn auction(self) -> Box<dyn Auction> {
        match self {
            Self::FirstPrice => Box::new(FirstPrice),
            Self::Vickrey => Box::new(Vickrey),
            Self::Softmin { temperature } => Box::new(Softmin { temperature }),
        }
    }
}

/// The lowest bid wins and is paid as bid; of equal bids the earlier, then one by lot.
#[derive(Clone, Copy, Debug, Default)]
pub struct FirstPrice;

impl Auction for FirstPrice {
    fn award(&self, _: Cents, bids: &[Bid], rng: &mut StreamRng) -> Option<Award> {
        let bid = lowest(bids, rng)?;
        Some(Award { bid, pay: bids[bid].price })
    }
}

/// The lowest bid wins and is paid the second lowest.
#[derive(Clone, Copy, Debug, Default)]
pub struct Vickrey;

impl Auction for Vickrey {
    fn award(&self, ceiling: Cents, bids: &[Bid], rng: &mut StreamRng) -> Option<Award> {
        let bid = lowest(bids, rng)?;
        let others = bids.iter().enumerate().filter(|(index, _)| *index != bid);
        let pay = others.map(|(_, other)| other.price).min().unwrap_or(ceiling);
        Some(Award { bid, pay })
    }
}

/// A bid wins with probability proportional to exp(-price / temperature).
#[derive(Clone, Copy, Debug)]
pub struct Softmin {
    /// In dollars, positive.
    pub temperature: f64,
}

impl Auction for Softmin {
    fn award(&self, _: Cents, bids: &[Bid], rng: &mut StreamRng) -> Option<Award> {
        let least = bids.iter().map(|bid| bid.price).min()?;
        // Relative to the lowest bid, whose weight is one: no sum of weights vanishes.
        let weight = |bid: &Bid| ops::exp(-(bid.price - least).dollars() / self.temperature);
        let weights: Vec<f64> = bids.iter().map(weight).collect();
        let bid = rng.weighted(&weights)?;
        Some(Award { bid, pay: bids[bid].price })
    }
}

/// The lowest bid; of equal ones the earliest, of those one by lot. A draw is made only if one is needed.
fn lowest(bids: &[Bid], rng: &mut StreamRng) -> Option<usize> {
    let best = bids.iter().map(|bid| (bid.price, bid.tick)).min()?;
    let equal: Vec<usize> =
        (0..bids.len()).filter(|index| (bids[*index].price, bids[*index].tick) == best).collect();
    if equal.len() == 1 { Some(equal[0]) } else { rng.choose(&equal).copied() }
}

#[cfg(test)]
mod tests {
    use simworld_core::seed::Seed;

    use super::*;

    fn bid(courier: usize, price: i64, tick: u64) -> Bid {
        Bid { courier, price: Cents(price), tick }
    }

    fn rng(index: u64) -> StreamRng {
        Seed(1).stream("test").indexed(index).rng()
    }

    const CEILING: Cents = Cents(2000);

    #[test]
    fn the_lowest_bid_wins_and_is_paid_as_bid() {
        let bids = [bid(0, 900, 1), bid(1, 700, 5), bid(2, 800, 0)];
        let award = FirstPrice.award(CEILING, &bids, &mut rng(0));
        assert_eq!(award, Some(Award { bid: 1, pay: Cents(700) }));
        assert_eq!(FirstPrice.award(CEILING, &[], &mut rng(0)), None);
    }

    #[test]
    fn of_equal_bids_the_earlier_wins_and_the_lot_is_fair() {
        let bids = [bid(0, 700, 3), bid(1, 700, 2), bid(2, 700, 2)];
        let mut wins = [0; 3];
        for index in 0..400 {
            wins[FirstPrice.award(CEILING, &bids, &mut rng(index)).unwrap().bid] += 1;
        }
        assert_eq!(wins[0], 0);
        assert!((150..250).contains(&wins[1]), "{wins:?}");
    }

    #[test]
    fn vickrey_pays_the_second_price() {
        let bids = [bid(0, 900, 1), bid(1, 700, 5), bid(2, 800, 0)];
        assert_eq!(Vickrey.award(CEILING, &bids, &mut rng(0)), Some(Award { bid: 1, pay: Cents(800) }));
        assert_eq!(Vickrey.award(CEILING, &bids[..1], &mut rng(0)), Some(Award { bid: 0, pay: CEILING }));
    }

    #[test]
    fn softmin_prefers_low_bids_by_its_temperature() {
        let bids = [bid(0, 1000, 0), bid(1, 1100, 0)];
        let low = |temperature| {
            let auction = Softmin { temperature };
            (0..1000).filter(|i| auction.award(CEILING, &bids, &mut rng(*i)).unwrap().bid == 0).count()
        };
        // One dollar at a temperature of one: odds of e to 1.
        assert!((690..770).contains(&low(1.0)), "{}", low(1.0));
        assert_eq!(low(0.001), 1000);
    }
}
