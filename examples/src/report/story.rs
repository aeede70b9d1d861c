//! The stories of orders, from post to door, as the events of a run tell them.

use std::collections::BTreeMap;

use simworld_core::clock::Tick;
use simworld_core::event::{Event, EventKind};
use simworld_core::id::EntityId;
use simworld_core::value::Value;

use crate::delivery::Track;

/// Everything that happened to an order.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Story {
    /// Its number.
    pub(super) order: i64,
    pub(super) posted: Tick,
    /// The most that is paid for it, $.
    pub(super) ceiling: f64,
    /// Length of the route from restaurant to home, m.
    pub(super) route: f64,
    pub(super) restaurant: Option<EntityId>,
    pub(super) home: Option<EntityId>,
    /// Every bid, also those that a later one of the same courier replaced: when, who, $.
    pub(super) bids: Vec<(Tick, usize, f64)>,
    pub(super) end: End,
    /// What happened besides bids, in order.
    pub(super) beats: Vec<Beat>,
    /// The entries of the ledger over it.
    pub(super) entries: Vec<Entry>,
}

/// How far an order came.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum End {
    /// It took bids when the log ended.
    Open,
    /// Nobody wanted it.
    Expired(Tick),
    /// It was won, and not brought home before the log ended.
    Won(Award),
    /// It was brought home.
    Delivered(Award, Delivery),
}

/// Who won an order, and on which terms.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Award {
    pub(super) tick: Tick,
    pub(super) courier: usize,
    /// What is paid in time, $.
    pub(super) pay: f64,
    /// When it is late, s; not in older logs.
    pub(super) due: Option<f64>,
}

/// How an order came home.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Delivery {
    pub(super) tick: Tick,
    pub(super) courier: usize,
    /// What was paid, $.
    pub(super) paid: f64,
    /// How late it was, s.
    pub(super) late: f64,
}

/// Something that happened to an order.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Beat {
    pub(super) tick: Tick,
    pub(super) kind: BeatKind,
    pub(super) courier: Option<usize>,
}

/// The kinds of what happens to an order, apart from bids.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum BeatKind {
    Posted,
    Expired,
    Awarded,
    PickedUp,
    /// Offered for sharing, with a bounty, $.
    Shared(f64),
    Accepted,
    Declined,
    /// The offer was taken back, and why.
    Cancelled(String),
    /// It changed hands, and to whom.
    HandedOver(Option<usize>),
    Delivered,
}

/// An entry of the ledger.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Entry {
    pub(super) tick: Tick,
    pub(super) from: Holder,
    pub(super) to: Holder,
    /// $.
    pub(super) amount: f64,
}

/// Whose money.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Holder {
    Courier(usize),
    Other(String),
}

/// The stories of a run, in the order of the orders.
pub(super) fn stories(events: &[Event], track: &Track) -> Vec<Story> {
    let mut stories: BTreeMap<i64, Story> = BTreeMap::new();
    for event in events {
        let EventKind::Task { name, who, data } = &event.kind else { continue };
        let Some(order) = data.get("order").and_then(Value::as_i64) else { continue };
        let facts = Facts { tick: event.tick, courier: who.and_then(|who| track.courier(who)), data, track };
        if name == "order_posted" {
            stories.insert(order, Story::posted(order, &facts));
        } else if let Some(story) = stories.get_mut(&order) {
            story.take(name, &facts);
        }
    }
    stories.into_values().collect()
}

/// What an event says.
struct Facts<'a> {
    tick: Tick,
    courier: Option<usize>,
    data: &'a BTreeMap<String, Value>,
    track: &'a Track,
}

impl Facts<'_> {
    fn number(&self, key: &str) -> f64 {
        self.data.get(key).and_then(Value::as_f64).unwrap_or_default()
    }

    fn entity(&self, key: &str) -> Option<EntityId> {
        self.data.get(key).and_then(Value::as_entity)
    }

    fn text(&self, key: &str) -> String {
        self.data.get(key).map(ToString::to_string).unwrap_or_default()
    }

    fn holder(&self, key: &str) -> Holder {
        let courier = self.entity(key).and_then(|id| self.track.courier(id));
        courier.map_or_else(|| Holder::Other(self.text(key)), Holder::Courier)
    }
}

impl Story {
    fn posted(order: i64, facts: &Facts<'_>) -> Self {
        Self {
            order,
            posted: facts.tick,
            ceiling: facts.number("ceiling"),
            route: facts.number("route"),
            restaurant: facts.entity("restaurant"),
            home: facts.entity("home"),
            bids: Vec::new(),
            end: End::Open,
            beats: vec![Beat { tick: facts.tick, kind: BeatKind::Posted, courier: None }],
            entries: Vec::new(),
        }
    }

    fn take(&mut self, name: &str, facts: &Facts<'_>) {
        let Facts { tick, courier, .. } = *facts;
        let kind = match name {
            "bid_placed" => {
                self.bids.extend(courier.map(|courier| (tick, courier, facts.number("price"))));
                return;
            }
            "money_moved" => {
                let (from, to) = (facts.holder("from"), facts.holder("to"));
                self.entries.push(Entry { tick, from, to, amount: facts.number("amount") });
                return;
            }
            "order_expired" => {
                self.end = End::Expired(tick);
                BeatKind::Expired
            }
            "order_awarded" => {
                let Some(courier) = courier else { return };
                let due = facts.data.get("due").and_then(Value::as_f64);
                self.end = End::Won(Award { tick, courier, pay: facts.number("pay"), due });
                BeatKind::Awarded
            }
            "order_delivered" => {
                let (Some(courier), Some(award)) = (courier, self.award().cloned()) else { return };
                let (paid, late) = (facts.number("paid"), facts.number("late"));
                self.end = End::Delivered(award, Delivery { tick, courier, paid, late });
                BeatKind::Delivered
            }
            "order_picked_up" => BeatKind::PickedUp,
            "order_shared" => BeatKind::Shared(facts.number("bounty")),
            "share_accepted" => BeatKind::Accepted,
            "share_declined" => BeatKind::Declined,
            "share_cancelled" => BeatKind::Cancelled(facts.text("reason")),
            "handed_over" => BeatKind::HandedOver(facts.entity("to").and_then(|id| facts.track.courier(id))),
            _ => return,
        };
        self.beats.push(Beat { tick, kind, courier });
    }

    /// On which terms it was won, if it was.
    pub(super) fn award(&self) -> Option<&Award> {
        match &self.end {
            End::Won(award) | End::Delivered(award, _) => Some(award),
            End::Open | End::Expired(_) => None,
        }
    }

    /// How it came home, if it did.
    pub(super) fn delivery(&self) -> Option<&Delivery> {
        if let End::Delivered(_, delivery) = &self.end { Some(delivery) } else { None }
    }

    /// When it was picked up, if it was.
    pub(super) fn picked_up(&self) -> Option<Tick> {
        self.beats.iter().find(|beat| beat.kind == BeatKind::PickedUp).map(|beat| beat.tick)
    }

    /// When it changed hands and to whom, if it did.
    pub(super) fn handed_over(&self) -> Option<(Tick, usize)> {
        self.beats.iter().find_map(|beat| match beat.kind {
            BeatKind::HandedOver(Some(to)) => Some((beat.tick, to)),
            _ => None,
        })
    }

    /// How much there is to tell: who brings it home, who shares it, who bids, whether it is late.
    pub(super) fn richness(&self) -> usize {
        let delivered = self.delivery().map_or(0, |delivery| 20 + usize::from(delivery.late > 0.0) * 3);
        let shared = usize::from(self.handed_over().is_some()) * 30;
        delivered + shared + self.beats.len() * 2 + self.bids.len().min(12)
    }
}

#[cfg(test)]
mod tests {
    use crate::delivery::Tracked;

    use super::*;

    fn told(tick: u64, name: &str, who: Option<u64>, facts: &[(&str, Value)]) -> Event {
        let kind = EventKind::task(name, who.map(EntityId::from)).with("order", 3_i64);
        let kind = facts.iter().fold(kind, |kind, (key, value)| kind.with(key, value.clone()));
        Event { tick: Tick(tick), kind }
    }

    #[test]
    fn a_story_goes_from_post_to_door() {
        let named = |id: u64| Tracked { id: EntityId::from(id), name: id.to_string() };
        let track = Track {
            dt: 0.1,
            interval: 10,
            couriers: vec![named(5), named(9)],
            samples: Vec::new(),
            passers: Vec::new(),
            passages: Vec::new(),
            traffic: (0, 0),
        };
        let events = [
            told(0, "order_posted", None, &[("ceiling", 20.0.into()), ("home", EntityId::from(2).into())]),
            told(4, "bid_placed", Some(9), &[("price", 15.0.into())]),
            told(9, "order_awarded", Some(9), &[("pay", 15.0.into()), ("due", 60.0.into())]),
            told(
                9,
                "money_moved",
                None,
                &[("from", "customers".into()), ("to", "escrow".into()), ("amount", 20.0.into())],
            ),
            told(30, "order_picked_up", Some(9), &[]),
            told(50, "handed_over", Some(9), &[("to", EntityId::from(5).into())]),
            told(90, "order_delivered", Some(5), &[("paid", 14.0.into()), ("late", 2.5.into())]),
            told(
                90,
                "money_moved",
                None,
                &[("from", "escrow".into()), ("to", EntityId::from(5).into()), ("amount", 14.0.into())],
            ),
        ];
        let stories = stories(&events, &track);
        let [story] = stories.as_slice() else { panic!("{} stories", stories.len()) };
        assert_eq!((story.order, story.ceiling, story.home), (3, 20.0, Some(EntityId::from(2))));
        assert_eq!(story.bids, [(Tick(4), 1, 15.0)]);
        let award = Award { tick: Tick(9), courier: 1, pay: 15.0, due: Some(60.0) };
        let delivery = Delivery { tick: Tick(90), courier: 0, paid: 14.0, late: 2.5 };
        assert_eq!(story.end, End::Delivered(award, delivery));
        assert_eq!((story.picked_up(), story.handed_over()), (Some(Tick(30)), Some((Tick(50), 0))));
        let entry = &story.entries[1];
        assert_eq!((&entry.from, &entry.to), (&Holder::Other("escrow".to_owned()), &Holder::Courier(0)));
        assert_eq!(story.beats.len(), 5);
    }
}
