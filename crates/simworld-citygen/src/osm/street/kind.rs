//! Which ways are streets, of what rank, and what may drive on them.

use simworld_core::net::RoadClass;

use super::ServiceRoads;
use crate::osm::tags::{Key, Tags};

/// The kind of a way that is a street.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Kind {
    pub(super) class: RoadClass,
    /// A ramp or a slip road between others.
    pub(super) is_link: bool,
    /// Whether people walk along it, where tags say nothing.
    pub(super) has_sidewalks: bool,
    /// Lanes each way, where tags say nothing.
    pub(super) lanes: u8,
    /// Width of a lane, where tags say nothing, dm.
    pub(super) lane: u16,
    /// Speed, where tags say nothing, km/h; 0 for that of the class.
    pub(super) speed: u8,
}

const fn kind(class: RoadClass, is_link: bool, has_sidewalks: bool, lanes: u8, lane: u16, speed: u8) -> Kind {
    Kind { class, is_link, has_sidewalks, lanes, lane, speed }
}

/// Values of `highway` on which cars drive: <https://wiki.openstreetmap.org/wiki/Key:highway>.
const KINDS: [(&str, Kind); 15] = [
    ("motorway", kind(RoadClass::Highway, false, false, 2, 36, 100)),
    ("motorway_link", kind(RoadClass::Highway, true, false, 1, 36, 60)),
    ("trunk", kind(RoadClass::Highway, false, false, 2, 35, 0)),
    ("trunk_link", kind(RoadClass::Highway, true, false, 1, 35, 60)),
    ("primary", kind(RoadClass::Arterial, false, true, 1, 34, 0)),
    ("primary_link", kind(RoadClass::Arterial, true, false, 1, 34, 0)),
    ("secondary", kind(RoadClass::Arterial, false, true, 1, 33, 0)),
    ("secondary_link", kind(RoadClass::Arterial, true, false, 1, 33, 0)),
    ("tertiary", kind(RoadClass::Arterial, false, true, 1, 32, 0)),
    ("tertiary_link", kind(RoadClass::Arterial, true, false, 1, 32, 0)),
    ("unclassified", kind(RoadClass::Local, false, true, 1, 30, 0)),
    ("residential", kind(RoadClass::Local, false, true, 1, 30, 0)),
    ("living_street", kind(RoadClass::Local, false, true, 1, 28, 10)),
    ("road", kind(RoadClass::Local, false, true, 1, 30, 0)),
    ("service", kind(RoadClass::Local, false, false, 1, 27, 20)),
];

/// The kind of a way, if it is a street for cars.
pub(super) fn kind_of(tags: &Tags<'_>) -> Option<Kind> {
    let highway = tags.get(Key::Highway)?;
    let (_, kind) = KINDS.iter().find(|(value, _)| *value == highway)?;
    let is_area = tags.is(Key::Area, "yes");
    (!is_area && is_open(tags)).then_some(*kind)
}

/// Whether a way is a street, service roads apart.
pub(in crate::osm) fn is_street(tags: &Tags<'_>) -> bool {
    kind_of(tags).is_some() && !tags.is(Key::Highway, "service")
}

/// Whether a way is among those that an import wants.
pub(super) fn is_wanted(tags: &Tags<'_>, service: ServiceRoads) -> bool {
    const BY_ROADS: [&str; 5] = ["driveway", "parking_aisle", "drive-through", "emergency_access", "slipway"];
    !tags.is(Key::Highway, "service")
        || (service == ServiceRoads::Through && !tags.is_any(Key::Service, &BY_ROADS))
}

/// Whether the public may drive there: the most particular tag says.
fn is_open(tags: &Tags<'_>) -> bool {
    const CLOSED: [&str; 9] =
        ["no", "private", "agricultural", "forestry", "emergency", "military", "psv", "bus", "delivery"];
    let particular = [Key::MotorCar, Key::MotorVehicle, Key::Vehicle, Key::Access];
    let value = particular.into_iter().find_map(|key| tags.get(key));
    value.is_none_or(|value| !CLOSED.contains(&value))
}
