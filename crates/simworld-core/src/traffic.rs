//! What the outside may ask of the traffic of a world.
//!
//! Orders are passed on by [`Command::Traffic`](crate::command::Command::Traffic), so that they are recorded and replayed like
//! everything else that comes from outside. Whoever moves the traffic reads [`World::orders`](crate::scene::World::orders) in
//! its step, does what it can, and reports what it cannot as an event. What nobody takes in the step in which it was asked is
//! reported by the world itself.

use serde::{Deserialize, Serialize};

use crate::event::EventKind;
use crate::geometry::Point2;
use crate::id::{EntityId, LaneId, RoadId};
use crate::net::{LaneDirection, SignalGroup};

/// The name of the event that an order was not carried out, with the facts `order` and `reason`.
pub const REFUSED: &str = "traffic_refused";

/// One direction of a road.
pub type RoadLeg = (RoadId, LaneDirection);

/// What is closed to traffic.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ClosedWay {
    /// All lanes of one direction of a road.
    Leg(RoadLeg),
    /// One lane.
    Lane(LaneId),
    /// A stretch of a lane, from and to, m along it.
    Stretch(LaneId, f64, f64),
}

/// In which lane a vehicle is wanted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LaneChoice {
    /// In the one where it is.
    #[default]
    Keep,
    /// In the next to the left.
    Left,
    /// In the next to the right.
    Right,
    /// Wherever the traffic's own driver would drive.
    AsDriven,
}

/// How long the stages of a junction's signals last, s.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SignalTiming {
    /// Green of vehicles, 5 to 600 s; longer where the walkers beside them need it, for `walk` and the time to clear the crossing.
    pub green: f64,
    /// Yellow of vehicles, 2 to 10 s.
    pub yellow: f64,
    /// Walk, 4 to 600 s. The time to clear a crossing follows it, and depends on its length alone.
    pub walk: f64,
}

/// An order to the traffic. Vehicles and walkers are named by their entities.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum TrafficOrder {
    /// Closes something now, for so many seconds, or for good. The event `closed` tells the `number` of the closure.
    Close {
        /// What.
        what: ClosedWay,
        /// For how long, s.
        seconds: Option<f64>,
    },
    /// Takes a closure back.
    Reopen {
        /// Its number.
        number: u32,
    },
    /// Makes a vehicle stop in its lane as soon as it can: it breaks down, or stands there to load.
    Halt {
        /// Which.
        who: EntityId,
        /// For how long, s, or for good.
        seconds: Option<f64>,
    },
    /// Makes a vehicle park at the kerb and be gone.
    Park {
        /// Which.
        who: EntityId,
        /// On which leg of its route.
        leg: RoadLeg,
        /// Where on it, m.
        station: f64,
        /// How long it takes, s.
        seconds: f64,
    },
    /// Sends a new vehicle on a route, which it enters when there is room.
    SendVehicle {
        /// The kind, as the traffic calls it: `car`, `van`, `truck`, `bus`, `motorcycle`, `bicycle`, `scooter`, `emergency`.
        kind: String,
        /// The legs that it drives.
        route: Vec<RoadLeg>,
        /// Where it stands parked on the first leg and pulls out, m along it; at nothing it drives in at the leg's beginning.
        from: Option<f64>,
        /// Where it parks on the last leg, m along it; at nothing it leaves at the leg's end.
        to: Option<f64>,
    },
    /// Turns the siren of an emergency vehicle on or off.
    Siren {
        /// Whose.
        who: EntityId,
        /// Whether it sounds from now on.
        is_on: bool,
    },
    /// Lets a new walker enter.
    AddWalker {
        /// Near which place, m.
        at: Point2,
        /// Where it goes and leaves; wherever its way leads, if nowhere.
        to: Option<Point2>,
    },
    /// Sends a walker somewhere.
    SendWalker {
        /// Which.
        who: EntityId,
        /// Near which place, m.
        to: Point2,
        /// Whether it leaves there; otherwise it walks on.
        leaves: bool,
    },
    /// Drives a vehicle on its lane, until it is given back or told otherwise.
    Drive {
        /// Which.
        who: EntityId,
        /// Acceleration, m/s².
        acceleration: f64,
        /// The lane.
        lane: LaneChoice,
        /// The leg to take at the end of this one.
        next: Option<RoadLeg>,
    },
    /// Guides a walker on its way, until it is given back or told otherwise.
    Guide {
        /// Which.
        who: EntityId,
        /// How fast it would walk alone, m/s.
        speed: f64,
        /// How far to the right of the middle of its way it keeps, m.
        keep_right: f64,
        /// Whether it crosses at red where there is a gap.
        dares: bool,
    },
    /// Lets a signal group go green as soon as that is safe, and keeps its junction so.
    HoldSignal {
        /// Which.
        group: SignalGroup,
        /// For how long from now, s, or until it is freed.
        seconds: Option<f64>,
    },
    /// Lets the signals of a junction change by themselves again.
    FreeSignal {
        /// One of its groups.
        group: SignalGroup,
    },
    /// Times the signals of a junction anew, from their next changes on.
    TimeSignal {
        /// One of its groups.
        group: SignalGroup,
        /// How long its stages last.
        timing: SignalTiming,
    },
    /// Turns a vehicle round: it takes the quickest open way to the other direction of its road, and goes on from there to where
    /// it was going.
    TurnRound {
        /// Which.
        who: EntityId,
    },
    /// Sends a vehicle on another way from where it is, by the quickest open way to each of these legs in turn; it leaves at the
    /// end of the last.
    Reroute {
        /// Which.
        who: EntityId,
        /// Through which legs.
        through: Vec<RoadLeg>,
    },
    /// Hands a vehicle or a walker over to whoever moves its entity: a physics body, an agent, a user.
    HandOver {
        /// Which.
        who: EntityId,
    },
    /// Gives a vehicle or a walker back to the traffic.
    GiveBack {
        /// Which.
        who: EntityId,
    },
}

impl TrafficOrder {
    /// Its name, in events.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Close { .. } => "close",
            Self::Reopen { .. } => "reopen",
            Self::Halt { .. } => "halt",
            Self::Park { .. } => "park",
            Self::SendVehicle { .. } => "send_vehicle",
            Self::Siren { .. } => "siren",
            Self::AddWalker { .. } => "add_walker",
            Self::SendWalker { .. } => "send_walker",
            Self::Drive { .. } => "drive",
            Self::Guide { .. } => "guide",
            Self::HoldSignal { .. } => "hold_signal",
            Self::FreeSignal { .. } => "free_signal",
            Self::TimeSignal { .. } => "time_signal",
            Self::TurnRound { .. } => "turn_round",
            Self::Reroute { .. } => "reroute",
            Self::HandOver { .. } => "hand_over",
            Self::GiveBack { .. } => "give_back",
        }
    }

    /// Whom it concerns; nobody for closures, signals and those who are yet to come.
    pub const fn who(&self) -> Option<EntityId> {
        match self {
            Self::Halt { who, .. }
            | Self::Park { who, .. }
            | Self::Siren { who, .. }
            | Self::SendWalker { who, .. }
            | Self::Drive { who, .. }
            | Self::Guide { who, .. }
            | Self::TurnRound { who }
            | Self::Reroute { who, .. }
            | Self::HandOver { who }
            | Self::GiveBack { who } => Some(*who),
            Self::Close { .. }
            | Self::Reopen { .. }
            | Self::SendVehicle { .. }
            | Self::AddWalker { .. }
            | Self::HoldSignal { .. }
            | Self::FreeSignal { .. }
            | Self::TimeSignal { .. } => None,
        }
    }

    /// The event that it was not carried out, and why.
    pub fn refused(&self, reason: impl Into<String>) -> EventKind {
        EventKind::task(REFUSED, self.who()).with("order", self.name()).with("reason", reason.into())
    }
}
