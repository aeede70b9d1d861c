//! Kinds of buildings: how large they are, what they are used for, where they stand.

use simworld_core::scene::Place;

/// A kind of building.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Archetype {
    /// Its name in files, the building type.
    pub name: &'static str,
    /// What it is used for.
    pub place: Place,
    /// Least and greatest width along the street, m.
    pub width: (f64, f64),
    /// Least and greatest depth away from the street, m.
    pub depth: (f64, f64),
    /// Least and greatest number of storeys.
    pub storeys: (u32, u32),
    /// How often it is tried in the centre of the city.
    pub central: f64,
    /// How often it is tried at its edge.
    pub peripheral: f64,
    /// Façade colour, linear-light sRGB.
    pub color: [f32; 3],
}

/// Height of a storey, m.
pub const STOREY: f64 = 3.2;

const fn archetype(
    name: &'static str,
    place: Place,
    width: (f64, f64),
    depth: (f64, f64),
    storeys: (u32, u32),
    weights: (f64, f64),
    color: [f32; 3],
) -> Archetype {
    Archetype { name, place, width, depth, storeys, central: weights.0, peripheral: weights.1, color }
}

/// Every kind, from large to small.
pub const ARCHETYPES: &[Archetype] = &[
    archetype(
        "hospital",
        Place::Hospital,
        (30.0, 42.0),
        (20.0, 30.0),
        (4, 8),
        (0.3, 0.3),
        [0.75, 0.77, 0.78],
    ),
    archetype("factory", Place::Factory, (28.0, 40.0), (20.0, 30.0), (1, 3), (0.0, 1.0), [0.35, 0.34, 0.32]),
    archetype("museum", Place::Museum, (26.0, 36.0), (18.0, 28.0), (2, 4), (0.4, 0.1), [0.62, 0.55, 0.42]),
    archetype("school", Place::School, (24.0, 36.0), (14.0, 22.0), (2, 4), (0.5, 0.8), [0.55, 0.28, 0.18]),
    archetype(
        "office_tower",
        Place::Office,
        (20.0, 30.0),
        (18.0, 26.0),
        (8, 22),
        (2.5, 0.1),
        [0.32, 0.42, 0.5],
    ),
    archetype(
        "office_block",
        Place::Office,
        (18.0, 28.0),
        (12.0, 18.0),
        (3, 7),
        (2.0, 0.6),
        [0.45, 0.45, 0.44],
    ),
    archetype("supermarket", Place::Store, (18.0, 28.0), (14.0, 22.0), (1, 2), (0.6, 0.8), [0.6, 0.5, 0.35]),
    archetype(
        "apartment_block",
        Place::Home,
        (16.0, 26.0),
        (11.0, 15.0),
        (4, 9),
        (3.0, 1.2),
        [0.58, 0.46, 0.36],
    ),
    archetype(
        "apartment_slab",
        Place::Home,
        (14.0, 22.0),
        (10.0, 13.0),
        (3, 6),
        (2.0, 1.6),
        [0.66, 0.6, 0.5],
    ),
    archetype(
        "rest_pavilion",
        Place::RestArea,
        (9.0, 13.0),
        (8.0, 11.0),
        (1, 1),
        (0.5, 0.5),
        [0.3, 0.42, 0.25],
    ),
    archetype(
        "restaurant",
        Place::Restaurant,
        (9.0, 15.0),
        (9.0, 14.0),
        (1, 3),
        (2.2, 1.0),
        [0.55, 0.2, 0.13],
    ),
    archetype("corner_store", Place::Store, (8.0, 12.0), (8.0, 12.0), (1, 3), (1.2, 0.8), [0.65, 0.52, 0.2]),
    archetype("row_house", Place::Home, (7.0, 10.0), (9.0, 12.0), (2, 4), (1.5, 2.5), [0.52, 0.25, 0.18]),
    archetype("cottage", Place::Home, (8.0, 12.0), (7.0, 10.0), (1, 2), (0.3, 3.0), [0.72, 0.67, 0.58]),
    archetype(
        "charging_station",
        Place::ChargingStation,
        (7.0, 10.0),
        (6.0, 9.0),
        (1, 1),
        (0.4, 0.5),
        [0.2, 0.4, 0.45],
    ),
    archetype("kiosk", Place::Store, (5.0, 7.0), (5.0, 7.0), (1, 1), (0.4, 0.3), [0.42, 0.5, 0.38]),
];

impl Archetype {
    /// The kind of that name.
    pub fn from_name(name: &str) -> Option<&'static Self> {
        ARCHETYPES.iter().find(|kind| kind.name == name)
    }

    /// How often it is tried at a place whose centrality is between 0 (edge) and 1 (centre).
    pub(crate) fn weight(&self, centrality: f64) -> f64 {
        self.central * centrality + self.peripheral * (1.0 - centrality)
    }
}

/// A kind in a file: its name.
pub(crate) mod by_name {
    use std::fmt;

    use serde::de::{Error, Visitor};
    use serde::{Deserializer, Serializer};

    use super::Archetype;

    pub(crate) fn serialize<S: Serializer>(kind: &Archetype, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(kind.name)
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<&'static Archetype, D::Error> {
        deserializer.deserialize_str(Name)
    }

    struct Name;

    impl Visitor<'_> for Name {
        type Value = &'static Archetype;

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            f.write_str("the name of a kind of building")
        }

        fn visit_str<E: Error>(self, name: &str) -> Result<Self::Value, E> {
            Archetype::from_name(name)
                .ok_or_else(|| E::invalid_value(serde::de::Unexpected::Str(name), &self))
        }
    }
}
