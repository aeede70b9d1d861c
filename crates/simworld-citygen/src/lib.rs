#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

pub mod block;
pub mod building;
mod city;
mod config;
mod decks;
mod doors;
pub mod edit;
pub mod element;
mod error;
pub mod files;
mod footbridges;
mod geo;
pub mod graph;
pub mod growth;
mod key;
pub mod landscape;
pub mod lot;
pub mod map;
pub mod name;
pub mod occupancy;
#[cfg(feature = "osm")]
pub mod osm;
mod populate;
mod provenance;
pub mod python;
mod range;
mod report;
pub mod settlement;
#[cfg(any(feature = "opendrive", feature = "osm"))]
mod simplify;
mod source;
mod strips;
mod style;
pub mod terrain;
mod threads;
pub mod tile;
pub mod zoning;

pub use city::City;
pub use config::{BuildingConfig, CityConfig, ElementConfig, RoadConfig};
pub use error::CityError;
pub use geo::GeoOrigin;
pub use populate::CityEntities;
pub use provenance::Provenance;
pub use report::{CityReport, Judged, StreetStatistics};
pub use source::RoadSource;
pub use style::{Band, Style, StyleError};
pub use threads::AllThreads;
