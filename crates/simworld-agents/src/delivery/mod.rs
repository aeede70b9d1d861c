//! The delivery economy: couriers bid for orders, carry them, share them, invest and tire.
//!
//! [`DeliveryTask`] is a [`Task`](simworld_core::seam::Task) over any scene with restaurants and homes. Its agents
//! decide with ten high-level actions ([`CourierAction`]); it answers with plans, and watches where bodies really
//! are. Parcels and scooters are entities. Money is whole cents in a double-entry [`Ledger`]. [`PolicyKind`] lists
//! twelve couriers without a model.
//!
//! Frame: world, m; time in s; money in cents, and in dollars where it is an argument or a fact of an event.
//! Source: the case study of the `SimWorld` paper; every constant names its own in [`DeliveryConfig`].

mod action;
mod auction;
mod battery;
mod board;
mod body;
mod calls;
mod config;
mod market;
mod money;
mod order;
mod places;
mod policy;
mod report;
mod routes;
mod state;
mod task;
mod turn;
mod view;
mod weather;
mod work;

pub use action::{CallError, CourierAction};
pub use auction::{Auction, AuctionRule, Award, Bid, FirstPrice, Softmin, Vickrey};
pub use battery::{BatteryConfig, Power};
pub use config::{
    AuctionConfig, DeliveryConfig, EnergyConfig, OrderConfig, PriceConfig, ReachConfig, SharingConfig,
    Shopping, SpeedConfig, Split,
};
pub use money::{Account, Cents, Ledger, Overdrawn};
pub use order::{Awarded, Carried, Delivered, Leg, Offer, Open, Order, OrderId, Stage};
pub use policy::{CourierMind, Persona, PersonaError, PolicyKind};
pub use report::{CourierRow, DeliveryReport};
pub use state::{BidResult, Errand, Item};
pub use task::{AuditError, DeliveryTask};
pub use view::{CourierView, HeldOrder, OpenOrder, SharedOffer};
pub use weather::WeatherConfig;
