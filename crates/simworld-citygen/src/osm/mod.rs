//! Real places: extracts of OpenStreetMap, as XML or PBF, become streets, buildings and street elements.
//!
//! A [`Place`] is read once; [`Place::plan`] gives its streets, [`City::from_place`](crate::City::from_place) the whole
//! city. What is odd in an extract, and there is much, becomes a [`Warning`] that names the element: it never stops an
//! import. Coordinates are metres on a plane that touches the Earth in the middle of the extract's streets.
//!
//! Data © OpenStreetMap contributors, under the Open Database Licence: whoever shows a city made of it says so, and its
//! map does by itself.

mod building;
mod city;
mod error;
mod footway;
mod ground;
mod mask;
mod near;
mod place;
mod raw;
mod read;
mod side;
mod street;
mod tags;
mod things;

pub use city::{Fill, PlaceOptions};
pub use error::{OsmError, OsmId, Warning};
pub use place::Place;
pub use street::{Parts, ServiceRoads, StreetOptions};

/// The line that the licence of the data asks for.
pub const CREDIT: &str = "© OpenStreetMap contributors, ODbL 1.0";
