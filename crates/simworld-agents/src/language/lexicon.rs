//! Words for kinds and uses.

use simworld_core::scene::{EntityKind, EntityRef, Place};

/// What a noun may mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Meaning {
    Kind(EntityKind),
    Place(Place),
    Vehicle,
    Seat,
}

impl Meaning {
    pub(super) fn fits(self, entity: &EntityRef<'_>) -> bool {
        match self {
            Self::Kind(kind) => entity.kind == kind,
            Self::Place(place) => entity.info.place == Some(place),
            Self::Vehicle => entity.kind.is_vehicle(),
            Self::Seat => entity.kind.is_seat(),
        }
    }
}

/// Synonyms beside the names of kinds and uses themselves.
const SYNONYMS: &[(&str, Meaning)] = &[
    ("house", Meaning::Place(Place::Home)),
    ("apartment", Meaning::Place(Place::Home)),
    ("cafe", Meaning::Place(Place::Restaurant)),
    ("café", Meaning::Place(Place::Restaurant)),
    ("diner", Meaning::Place(Place::Restaurant)),
    ("bistro", Meaning::Place(Place::Restaurant)),
    ("shop", Meaning::Place(Place::Store)),
    ("supermarket", Meaning::Place(Place::Store)),
    ("clinic", Meaning::Place(Place::Hospital)),
    ("gallery", Meaning::Place(Place::Museum)),
    ("academy", Meaning::Place(Place::School)),
    ("warehouse", Meaning::Place(Place::Factory)),
    ("charger", Meaning::Place(Place::ChargingStation)),
    ("pavilion", Meaning::Place(Place::RestArea)),
    ("seat", Meaning::Seat),
    ("vehicle", Meaning::Vehicle),
    ("automobile", Meaning::Kind(EntityKind::Car)),
    ("taxi", Meaning::Kind(EntityKind::Car)),
    ("lorry", Meaning::Kind(EntityKind::Truck)),
    ("van", Meaning::Kind(EntityKind::Truck)),
    ("bike", Meaning::Kind(EntityKind::Bicycle)),
    ("package", Meaning::Kind(EntityKind::Parcel)),
    ("box", Meaning::Kind(EntityKind::Parcel)),
    ("order", Meaning::Kind(EntityKind::Parcel)),
    ("pedestrian", Meaning::Kind(EntityKind::Person)),
    ("man", Meaning::Kind(EntityKind::Person)),
    ("woman", Meaning::Kind(EntityKind::Person)),
    ("human", Meaning::Kind(EntityKind::Person)),
    ("lamp", Meaning::Kind(EntityKind::StreetLamp)),
    ("lamppost", Meaning::Kind(EntityKind::StreetLamp)),
    ("traffic light", Meaning::Kind(EntityKind::TrafficSignal)),
    ("bin", Meaning::Kind(EntityKind::TrashBin)),
    ("trash can", Meaning::Kind(EntityKind::TrashBin)),
    ("crossing", Meaning::Kind(EntityKind::Crosswalk)),
    ("street", Meaning::Kind(EntityKind::Road)),
];

/// What a noun means, typos of one letter in long words included.
pub(super) fn meaning(noun: &str) -> Option<Meaning> {
    let singular = noun.strip_suffix('s').filter(|rest| rest.len() > 2).unwrap_or(noun);
    let exact = |word: &str| {
        let kinds = EntityKind::ALL.iter().map(|kind| (kind.as_str(), Meaning::Kind(*kind)));
        let places = Place::ALL.iter().map(|place| (place.as_str(), Meaning::Place(*place)));
        let all = SYNONYMS.iter().copied().chain(places).chain(kinds);
        all.map(|(name, meaning)| (name.replace('_', " "), meaning))
            .find(|(name, _)| name == word)
            .map(|found| found.1)
    };
    let close = || {
        let kinds = EntityKind::ALL.iter().map(|kind| (kind.as_str(), Meaning::Kind(*kind)));
        let places = Place::ALL.iter().map(|place| (place.as_str(), Meaning::Place(*place)));
        let long = kinds.chain(places).chain(SYNONYMS.iter().copied()).filter(|(name, _)| name.len() >= 5);
        long.map(|(name, meaning)| (strsim::osa_distance(&name.replace('_', " "), singular), meaning))
            .filter(|(distance, _)| *distance == 1)
            .map(|(_, meaning)| meaning)
            .next()
    };
    exact(noun).or_else(|| exact(singular)).or_else(close)
}
