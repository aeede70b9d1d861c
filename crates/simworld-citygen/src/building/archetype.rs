//! Kinds of buildings: how large they are, what they are used for, where they stand.

use simworld_core::scene::Place;

use super::footprint::FootprintKind;
use super::roof::RoofKind;
use crate::zoning::Zone;

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
    /// How often it is tried where people live densest, and where they live most thinly.
    pub dense: f64,
    /// See [`dense`](Self::dense).
    pub sparse: f64,
    /// How often it is tried in a residential, commercial, industrial and civic zone.
    pub zones: [f64; 4],
    /// The outlines it comes in; a plan that does not fit its size becomes a rectangle.
    pub plans: &'static [FootprintKind],
    /// The roofs it comes with.
    pub roofs: &'static [RoofKind],
    /// Façade colour, linear-light sRGB.
    pub color: [f32; 3],
}

/// Height of a storey, m.
pub const STOREY: f64 = 3.2;

use FootprintKind::{Courtyard, L, Rectangle, Stepped, U};
use RoofKind::{Flat, Gable, Hip, Shed};

macro_rules! kinds {
    ($($name:ident: $place:ident, $width:expr, $depth:expr, $storeys:expr, ($dense:expr, $sparse:expr), $zones:expr,
       $plans:expr, $roofs:expr, $color:expr;)+) => {
        &[$(Archetype {
            name: stringify!($name), place: Place::$place, width: $width, depth: $depth, storeys: $storeys,
            dense: $dense, sparse: $sparse, zones: $zones, plans: &$plans, roofs: &$roofs, color: $color,
        },)+]
    };
}

/// Every kind, from large to small.
#[rustfmt::skip]
pub const ARCHETYPES: &[Archetype] = kinds![
    // name: place, width, depth, storeys, (dense, sparse), [residential, commercial, industrial, civic], plans, roofs, colour
    hospital: Hospital, (28.0, 50.0), (20.0, 34.0), (4, 8), (1.0, 1.0), [0.0, 0.0, 0.0, 3.0], [U, L, Courtyard, Rectangle], [Flat], [0.75, 0.77, 0.78];
    factory: Factory, (24.0, 56.0), (18.0, 36.0), (1, 3), (0.6, 1.0), [0.0, 0.0, 4.0, 0.0], [Rectangle, L, U], [Flat, Shed], [0.35, 0.34, 0.32];
    warehouse: Factory, (22.0, 56.0), (16.0, 36.0), (1, 2), (0.6, 1.0), [0.0, 0.0, 4.0, 0.0], [Rectangle, L], [Shed, Gable, Flat], [0.5, 0.48, 0.45];
    museum: Museum, (24.0, 48.0), (18.0, 32.0), (2, 4), (1.0, 0.8), [0.0, 0.1, 0.0, 3.0], [Courtyard, U, Rectangle], [Flat, Hip], [0.62, 0.55, 0.42];
    school: School, (22.0, 48.0), (14.0, 30.0), (2, 4), (0.8, 1.0), [0.08, 0.0, 0.0, 4.0], [U, L, Courtyard, Rectangle], [Flat, Hip, Gable], [0.55, 0.28, 0.18];
    department_store: Store, (22.0, 34.0), (18.0, 26.0), (3, 6), (1.5, 0.3), [0.0, 1.2, 0.0, 0.0], [Rectangle, Stepped], [Flat], [0.55, 0.52, 0.47];
    office_tower: Office, (18.0, 34.0), (16.0, 26.0), (8, 24), (2.2, 0.0), [0.0, 2.6, 0.0, 0.4], [Stepped, Rectangle], [Flat], [0.32, 0.42, 0.5];
    apartment_tower: Home, (17.0, 28.0), (14.0, 22.0), (9, 18), (2.0, 0.0), [1.6, 0.6, 0.0, 0.0], [Stepped, Rectangle], [Flat], [0.6, 0.57, 0.52];
    office_block: Office, (15.0, 30.0), (12.0, 22.0), (3, 7), (1.4, 0.8), [0.1, 2.6, 1.2, 1.2], [Rectangle, L, U], [Flat, Hip], [0.45, 0.45, 0.44];
    apartment_block: Home, (14.0, 26.0), (11.0, 22.0), (4, 9), (2.2, 0.5), [2.2, 1.2, 0.0, 0.3], [Rectangle, L, U, Courtyard], [Flat, Hip], [0.58, 0.46, 0.36];
    supermarket: Store, (17.0, 30.0), (14.0, 24.0), (1, 2), (0.5, 1.0), [0.12, 0.9, 0.3, 0.0], [Rectangle, L], [Flat, Shed], [0.6, 0.5, 0.35];
    apartment_slab: Home, (13.0, 24.0), (10.0, 16.0), (3, 6), (1.6, 0.9), [2.2, 0.9, 0.2, 0.3], [Rectangle, L], [Gable, Hip, Flat], [0.66, 0.6, 0.5];
    clinic: Hospital, (13.0, 22.0), (11.0, 18.0), (2, 4), (0.7, 0.7), [0.03, 0.15, 0.0, 1.5], [L, Rectangle], [Flat, Hip], [0.78, 0.76, 0.7];
    gallery: Museum, (12.0, 22.0), (11.0, 18.0), (1, 3), (0.8, 0.4), [0.0, 0.25, 0.0, 1.4], [Rectangle, L], [Shed, Flat], [0.7, 0.66, 0.58];
    workshop: Factory, (12.0, 24.0), (10.0, 20.0), (1, 2), (0.6, 1.0), [0.05, 0.1, 3.0, 0.0], [Rectangle, L], [Gable, Shed], [0.44, 0.38, 0.32];
    bank: Office, (11.0, 20.0), (11.0, 17.0), (2, 5), (1.2, 0.5), [0.0, 1.6, 0.0, 0.4], [Rectangle], [Hip, Flat], [0.6, 0.58, 0.52];
    villa: Home, (10.0, 17.0), (9.0, 15.0), (1, 3), (0.2, 1.6), [1.5, 0.0, 0.0, 0.0], [L, Rectangle], [Hip, Gable], [0.7, 0.62, 0.52];
    shop_house: Store, (9.0, 16.0), (10.0, 16.0), (2, 4), (1.4, 0.9), [0.35, 2.4, 0.3, 0.3], [Rectangle, L], [Gable, Flat], [0.6, 0.44, 0.3];
    restaurant: Restaurant, (9.0, 17.0), (9.0, 15.0), (1, 3), (1.5, 1.0), [0.55, 2.6, 0.3, 0.5], [Rectangle, L], [Hip, Flat, Gable], [0.55, 0.2, 0.13];
    rest_pavilion: RestArea, (8.0, 14.0), (8.0, 12.0), (1, 1), (0.5, 0.5), [0.16, 0.2, 0.1, 0.5], [Rectangle], [Hip, Gable], [0.3, 0.42, 0.25];
    cafe: Restaurant, (7.0, 12.0), (8.0, 12.0), (1, 2), (1.2, 0.7), [0.35, 1.6, 0.1, 0.4], [Rectangle], [Gable, Flat], [0.5, 0.34, 0.22];
    corner_store: Store, (8.0, 13.0), (8.0, 12.0), (1, 3), (1.0, 0.9), [0.4, 1.3, 0.3, 0.1], [Rectangle], [Flat, Gable], [0.65, 0.52, 0.2];
    row_house: Home, (6.5, 12.0), (9.0, 13.0), (2, 4), (1.6, 1.3), [2.6, 0.5, 0.1, 0.2], [Rectangle], [Gable], [0.52, 0.25, 0.18];
    cottage: Home, (8.0, 14.0), (7.0, 11.0), (1, 2), (0.3, 2.0), [2.4, 0.0, 0.1, 0.0], [Rectangle, L], [Gable, Hip], [0.72, 0.67, 0.58];
    charging_station: ChargingStation, (7.0, 12.0), (6.0, 10.0), (1, 1), (0.5, 0.5), [0.14, 0.4, 0.5, 0.1], [Rectangle], [Shed, Flat], [0.2, 0.4, 0.45];
    kiosk: Store, (5.0, 7.5), (5.0, 7.0), (1, 1), (0.6, 0.4), [0.1, 0.5, 0.2, 0.2], [Rectangle], [Flat], [0.42, 0.5, 0.38];
];

impl Archetype {
    /// The kind of that name.
    pub fn from_name(name: &str) -> Option<&'static Self> {
        ARCHETYPES.iter().find(|kind| kind.name == name)
    }

    /// How often it is tried in a zone where people live that densely, from 0 to 1; never in a park.
    pub fn weight(&self, zone: Zone, density: f64) -> f64 {
        let often = self.dense * density + self.sparse * (1.0 - density);
        match zone {
            Zone::Residential => self.zones[0] * often,
            Zone::Commercial => self.zones[1] * often,
            Zone::Industrial => self.zones[2] * often,
            Zone::Civic => self.zones[3] * often,
            Zone::Park => 0.0,
        }
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
