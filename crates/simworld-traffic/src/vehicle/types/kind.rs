//! The kinds of vehicles: what they are in a scene, and where they may drive.

use serde::{Deserialize, Serialize};
use simworld_core::net::LaneKind;
use simworld_core::scene::EntityKind;

/// What kind of vehicle it is: that decides where it may drive, and what it is in a scene. Its size and its driver are those
/// of its [`VehicleType`](super::VehicleType).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum VehicleKind {
    /// A passenger car.
    #[default]
    Car,
    /// A delivery van.
    Van,
    /// A lorry.
    Truck,
    /// A city bus.
    Bus,
    /// A motorcycle.
    Motorcycle,
    /// A bicycle with its rider.
    Bicycle,
    /// An electric kick scooter with its rider.
    Scooter,
    /// An ambulance, fire engine or police car.
    Emergency,
}

impl VehicleKind {
    /// Every kind, in the order of declaration.
    pub const ALL: [Self; 8] = [
        Self::Car,
        Self::Van,
        Self::Truck,
        Self::Bus,
        Self::Motorcycle,
        Self::Bicycle,
        Self::Scooter,
        Self::Emergency,
    ];

    /// Its name in files and scenes.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Car => "car",
            Self::Van => "van",
            Self::Truck => "truck",
            Self::Bus => "bus",
            Self::Motorcycle => "motorcycle",
            Self::Bicycle => "bicycle",
            Self::Scooter => "scooter",
            Self::Emergency => "emergency",
        }
    }

    /// What it is in a scene.
    pub const fn entity_kind(self) -> EntityKind {
        match self {
            Self::Car => EntityKind::Car,
            Self::Van | Self::Truck | Self::Emergency => EntityKind::Truck,
            Self::Bus => EntityKind::Bus,
            Self::Motorcycle => EntityKind::Motorcycle,
            Self::Bicycle => EntityKind::Bicycle,
            Self::Scooter => EntityKind::Scooter,
        }
    }

    /// Whether it belongs on cycle lanes.
    pub const fn is_rider(self) -> bool {
        matches!(self, Self::Bicycle | Self::Scooter)
    }

    /// Whether it may drive on lanes of a kind: everybody among everybody, buses and emergency vehicles on bus lanes, bicycles
    /// and scooters on cycle lanes, nobody elsewhere.
    ///
    /// ```
    /// use simworld_core::net::LaneKind;
    /// use simworld_traffic::vehicle::VehicleKind;
    /// assert!(VehicleKind::Bus.may_use(LaneKind::Bus) && !VehicleKind::Car.may_use(LaneKind::Bus));
    /// assert!(VehicleKind::Scooter.may_use(LaneKind::Cycle) && VehicleKind::Scooter.may_use(LaneKind::Driving));
    /// ```
    pub const fn may_use(self, lane: LaneKind) -> bool {
        match lane {
            LaneKind::Driving => true,
            LaneKind::Bus => matches!(self, Self::Bus | Self::Emergency),
            LaneKind::Cycle => self.is_rider(),
            _ => false,
        }
    }

    /// Whether it is better off on a lane of that kind than among the others.
    pub(crate) const fn prefers(self, lane: LaneKind) -> bool {
        match lane {
            LaneKind::Bus => matches!(self, Self::Bus),
            LaneKind::Cycle => self.is_rider(),
            _ => false,
        }
    }
}
