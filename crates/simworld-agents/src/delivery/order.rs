//! Orders and the states they pass through.
//!
//! An order is in exactly one [`Stage`]. Each stage is a type of its own, and each transition a method that
//! consumes one stage and yields the next: an order cannot be delivered that was not picked up.
//!
//! ```text
//! Open ──award──▶ Awarded ──pick_up──▶ Carried ──deliver──▶ Delivered
//!   └──expire──▶ Expired                 └─hand_over─┘
//! ```

use serde::{Deserialize, Serialize};
use simworld_core::geometry::Point3;
use simworld_core::id::EntityId;

use super::auction::Bid;
use super::board::Tender;
use super::money::Cents;

/// Names an order: its place in the list of all orders of the episode.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(transparent)]
pub struct OrderId(pub u32);

impl OrderId {
    /// The position in the list of orders.
    pub const fn index(self) -> usize {
        self.0 as usize
    }
}

impl std::fmt::Display for OrderId {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.0.fmt(f)
    }
}

/// A meal that somebody wants brought home.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Order {
    /// Its name.
    pub id: OrderId,
    /// The restaurant.
    pub restaurant: EntityId,
    /// Where the meal is picked up: the restaurant's access point, m.
    pub pickup: Point3,
    /// The home.
    pub home: EntityId,
    /// Where the meal is delivered: the home's access point, m.
    pub dropoff: Point3,
    /// Length of the route between the two, m.
    pub route: f64,
    /// The most that is paid for it.
    pub ceiling: Cents,
    /// The step in which it was posted.
    pub posted: u64,
    /// Where it stands.
    pub stage: Stage,
}

impl Order {
    /// What hangs on the board of it, as long as it takes bids.
    pub(super) fn tender(&self) -> Option<Tender> {
        let Stage::Open(Open { closes, .. }) = self.stage else { return None };
        let (id, ceiling, route) = (self.id, self.ceiling, self.route);
        Some(Tender { id, at: self.pickup.xy(), ceiling, route, closes })
    }
}

/// Where an order stands.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Stage {
    /// Bids are taken.
    Open(Open),
    /// Won, and waiting at the restaurant.
    Awarded(Awarded),
    /// On its way.
    Carried(Carried),
    /// Brought home.
    Delivered(Delivered),
    /// Nobody wanted it.
    Expired,
}

/// An order that takes bids.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Open {
    /// The step in which the auction closes.
    pub closes: u64,
    /// The bids so far, one a courier.
    pub bids: Vec<Bid>,
}

/// An order that was won.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Awarded {
    /// The winner.
    pub courier: usize,
    /// What is paid for it in time.
    pub pay: Cents,
    /// The step in which it was won.
    pub tick: u64,
    /// Up to when it is in time, s of the episode.
    pub due: f64,
    /// The winner's offer to share it.
    pub offer: Option<Offer>,
}

/// An order under way.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Carried {
    /// What was agreed, and the offer to share it.
    pub terms: Awarded,
    /// Who carries it now.
    pub carrier: usize,
    /// How far the carrier brought it, m.
    pub distance: f64,
    /// Who carried it before, how far (m), and the bounty put up for the carrier.
    pub first: Option<Leg>,
    /// The parcel, once the world shows it.
    pub parcel: Option<EntityId>,
}

/// The first part of a shared delivery.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Leg {
    /// Who carried.
    pub courier: usize,
    /// How far, m.
    pub distance: f64,
    /// What it put up for the second.
    pub bounty: Cents,
}

/// An order brought home.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Delivered {
    /// Who brought it home.
    pub courier: usize,
    /// Who carried it before.
    pub first: Option<usize>,
    /// The step in which it arrived.
    pub tick: u64,
    /// What was paid for it, to one or both.
    pub paid: Cents,
    /// How late it was, s; zero in time.
    pub late: f64,
}

/// An offer to carry an order together.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Offer {
    /// Where the couriers meet, m.
    pub meet: Point3,
    /// What the second courier gets under the bounty split, in escrow.
    pub bounty: Cents,
    /// The second courier, once one accepted.
    pub accepted: Option<usize>,
}

impl Open {
    /// The auction closed with a winner.
    pub fn award(self, courier: usize, pay: Cents, tick: u64, due: f64) -> Awarded {
        Awarded { courier, pay, tick, due, offer: None }
    }
}

impl Awarded {
    /// The winner took it.
    pub fn pick_up(self) -> Carried {
        Carried { carrier: self.courier, terms: self, distance: 0.0, first: None, parcel: None }
    }
}

impl Carried {
    /// The parcel changed hands as offered; `None` if nobody accepted the offer, or it did before.
    pub fn hand_over(self) -> Option<Self> {
        let (Some(offer), None) = (self.terms.offer, self.first) else { return None };
        let second = offer.accepted?;
        let first = Leg { courier: self.carrier, distance: self.distance, bounty: offer.bounty };
        let terms = Awarded { offer: None, ..self.terms };
        Some(Self { terms, carrier: second, distance: 0.0, first: Some(first), parcel: self.parcel })
    }

    /// It is home.
    pub fn deliver(self, tick: u64, paid: Cents, late: f64) -> Delivered {
        Delivered { courier: self.carrier, first: self.first.map(|leg| leg.courier), tick, paid, late }
    }
}

impl Stage {
    /// The name of the stage.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Open(_) => "open",
            Self::Awarded(_) => "awarded",
            Self::Carried(_) => "carried",
            Self::Delivered(_) => "delivered",
            Self::Expired => "expired",
        }
    }

    /// What was agreed, of an order won and not yet delivered.
    pub fn terms(&self) -> Option<&Awarded> {
        match self {
            Self::Awarded(awarded) => Some(awarded),
            Self::Carried(carried) => Some(&carried.terms),
            _ => None,
        }
    }

    /// What was agreed, to change the offer.
    pub fn terms_mut(&mut self) -> Option<&mut Awarded> {
        match self {
            Self::Awarded(awarded) => Some(awarded),
            Self::Carried(carried) => Some(&mut carried.terms),
            _ => None,
        }
    }

    /// Who has the order now: the winner, or whoever carries it.
    pub fn holder(&self) -> Option<usize> {
        match self {
            Self::Awarded(awarded) => Some(awarded.courier),
            Self::Carried(carried) => Some(carried.carrier),
            _ => None,
        }
    }
}
