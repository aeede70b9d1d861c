//! The ten high-level actions of the paper, and the swap of a battery, as a type and as calls.

use serde::{Deserialize, Serialize};
use simworld_core::geometry::Point2;
use simworld_core::intent::Intent;
use simworld_core::value::Value;
use thiserror::Error;

use super::money::Cents;
use super::order::OrderId;

/// What a courier decides.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CourierAction {
    /// Asks for an open order: `bid_order(order, price)`, the price in dollars. A later bid replaces an earlier.
    BidOrder {
        /// Which.
        order: OrderId,
        /// What it wants to be paid.
        price: Cents,
    },
    /// Goes to the restaurant of a won order and takes it: `pick_up_order(order)`.
    PickUpOrder {
        /// Which.
        order: OrderId,
    },
    /// Goes to the home and hands the order over: `deliver_order(order)`.
    DeliverOrder {
        /// Which.
        order: OrderId,
    },
    /// Offers to share an order it holds: `share_order(order, [x, y], [bounty])`. Without a point the couriers
    /// meet at the place nearest to the middle of what is left of the route; the bounty is in dollars.
    ShareOrder {
        /// Which.
        order: OrderId,
        /// Where to meet, m.
        meet: Option<Point2>,
        /// What the second courier gets under the bounty split.
        bounty: Cents,
    },
    /// Takes an offer back, or steps back from having accepted it: `cancel_share_order(order)`.
    CancelShareOrder {
        /// Which.
        order: OrderId,
    },
    /// Goes to where a shared order changes hands; for a courier that does not hold the order it means to accept
    /// the offer: `go_to_meet_point(order)`.
    GoToMeetPoint {
        /// Which.
        order: OrderId,
    },
    /// Buys a scooter and rides it: `purchase_scooter()`.
    PurchaseScooter,
    /// Buys a drink and drinks it: `purchase_drinks()`.
    PurchaseDrinks,
    /// Moves at another speed from now on: `adjust_speed(speed)`, m/s.
    AdjustSpeed {
        /// The new speed, m/s.
        speed: f64,
    },
    /// Lets the moment pass: `do_nothing()`.
    DoNothing,
    /// Goes to the nearest charging station and swaps the battery of its scooter, where they have any: `swap_battery()`.
    SwapBattery,
}

/// A call that is no courier action.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{call}: {reason}")]
pub struct CallError {
    /// The call.
    pub call: String,
    /// What is wrong, and what is allowed.
    pub reason: String,
}

impl CourierAction {
    /// The names of the calls, in the order of the variants.
    pub const NAMES: &'static [&'static str] = &[
        "bid_order",
        "pick_up_order",
        "deliver_order",
        "share_order",
        "cancel_share_order",
        "go_to_meet_point",
        "purchase_scooter",
        "purchase_drinks",
        "adjust_speed",
        "do_nothing",
        "swap_battery",
    ];

    /// The position of this action's name in [`NAMES`](Self::NAMES).
    pub fn index(&self) -> usize {
        match self {
            Self::BidOrder { .. } => 0,
            Self::PickUpOrder { .. } => 1,
            Self::DeliverOrder { .. } => 2,
            Self::ShareOrder { .. } => 3,
            Self::CancelShareOrder { .. } => 4,
            Self::GoToMeetPoint { .. } => 5,
            Self::PurchaseScooter => 6,
            Self::PurchaseDrinks => 7,
            Self::AdjustSpeed { .. } => 8,
            Self::DoNothing => 9,
            Self::SwapBattery => 10,
        }
    }

    /// The name of the call.
    pub fn name(&self) -> &'static str {
        Self::NAMES[self.index()]
    }
}

impl From<CourierAction> for Intent {
    fn from(action: CourierAction) -> Self {
        let call = Self::call(action.name());
        let of = |order: OrderId| i64::from(order.0);
        match action {
            CourierAction::BidOrder { order, price } => {
                call.arg("order", of(order)).arg("price", price.dollars())
            }
            CourierAction::PickUpOrder { order }
            | CourierAction::DeliverOrder { order }
            | CourierAction::CancelShareOrder { order }
            | CourierAction::GoToMeetPoint { order } => call.arg("order", of(order)),
            CourierAction::ShareOrder { order, meet, bounty } => {
                let mut call = call.arg("order", of(order));
                if let Some(meet) = meet {
                    call = call.arg("x", meet.x).arg("y", meet.y);
                }
                if bounty > Cents::ZERO { call.arg("bounty", bounty.dollars()) } else { call }
            }
            CourierAction::AdjustSpeed { speed } => call.arg("speed", speed),
            CourierAction::PurchaseScooter
            | CourierAction::PurchaseDrinks
            | CourierAction::SwapBattery
            | CourierAction::DoNothing => call,
        }
    }
}

impl TryFrom<&Intent> for CourierAction {
    type Error = CallError;

    fn try_from(intent: &Intent) -> Result<Self, CallError> {
        let Intent::Call { name, args } = intent else {
            return Err(CallError { call: intent.to_string(), reason: "give a call".to_owned() });
        };
        let arguments = Arguments { intent, args };
        Ok(match name.as_str() {
            "bid_order" => Self::BidOrder { order: arguments.order()?, price: arguments.money("price")? },
            "pick_up_order" => Self::PickUpOrder { order: arguments.order()? },
            "deliver_order" => Self::DeliverOrder { order: arguments.order()? },
            "share_order" => Self::ShareOrder {
                order: arguments.order()?,
                meet: arguments.meet()?,
                bounty: if args.contains_key("bounty") { arguments.money("bounty")? } else { Cents::ZERO },
            },
            "cancel_share_order" => Self::CancelShareOrder { order: arguments.order()? },
            "go_to_meet_point" => Self::GoToMeetPoint { order: arguments.order()? },
            "purchase_scooter" => Self::PurchaseScooter,
            "purchase_drinks" => Self::PurchaseDrinks,
            "adjust_speed" => Self::AdjustSpeed { speed: arguments.number("speed")? },
            "do_nothing" => Self::DoNothing,
            "swap_battery" => Self::SwapBattery,
            _ => return Err(arguments.fault(format!("the calls are {}", Self::NAMES.join(", ")))),
        })
    }
}

/// The arguments of a call, with errors that name it.
struct Arguments<'a> {
    intent: &'a Intent,
    args: &'a std::collections::BTreeMap<String, Value>,
}

impl Arguments<'_> {
    fn fault(&self, reason: String) -> CallError {
        CallError { call: self.intent.to_string(), reason }
    }

    fn order(&self) -> Result<OrderId, CallError> {
        let id = self.args.get("order").and_then(Value::as_i64).and_then(|id| u32::try_from(id).ok());
        id.map(OrderId).ok_or_else(|| self.fault("give order = the number of an order".to_owned()))
    }

    fn number(&self, key: &str) -> Result<f64, CallError> {
        let number = self.args.get(key).and_then(Value::as_f64).filter(|number| number.is_finite());
        number.ok_or_else(|| self.fault(format!("give {key} = a finite number")))
    }

    fn money(&self, key: &str) -> Result<Cents, CallError> {
        let amount = Cents::from_dollars(self.number(key)?).filter(|amount| *amount >= Cents::ZERO);
        amount.ok_or_else(|| self.fault(format!("give {key} = dollars, not negative and at most 10^9")))
    }

    fn meet(&self) -> Result<Option<Point2>, CallError> {
        if !self.args.contains_key("x") && !self.args.contains_key("y") {
            return Ok(None);
        }
        Ok(Some(Point2::new(self.number("x")?, self.number("y")?)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_action_survives_being_a_call() {
        let order = OrderId(4);
        let actions = [
            CourierAction::BidOrder { order, price: Cents(1250) },
            CourierAction::PickUpOrder { order },
            CourierAction::DeliverOrder { order },
            CourierAction::ShareOrder { order, meet: None, bounty: Cents::ZERO },
            CourierAction::ShareOrder { order, meet: Some(Point2::new(3.5, -2.0)), bounty: Cents(99) },
            CourierAction::CancelShareOrder { order },
            CourierAction::GoToMeetPoint { order },
            CourierAction::PurchaseScooter,
            CourierAction::PurchaseDrinks,
            CourierAction::AdjustSpeed { speed: 1.7 },
            CourierAction::DoNothing,
            CourierAction::SwapBattery,
        ];
        for action in actions {
            let call = Intent::from(action);
            assert_eq!(CourierAction::try_from(&call), Ok(action), "{call}");
        }
    }

    #[test]
    fn a_wrong_argument_is_named() {
        let bid = Intent::call("bid_order").arg("order", 4_i64).arg("price", f64::NAN);
        assert!(CourierAction::try_from(&bid).unwrap_err().reason.contains("price"));
        let nothing = CourierAction::try_from(&Intent::call("fly")).unwrap_err();
        assert!(nothing.reason.contains("do_nothing"));
    }
}
