//! Looking at traffic: what was seen of a run, as figures and as pictures to print.
//!
//! A [`Recorder`] watches a [`Traffic`](crate::Traffic) step by step; the pictures are SVG texts made of what it kept:
//!
//! | picture | shows |
//! |---|---|
//! | [`network_map`] | density, speed or flow of every lane |
//! | [`fundamental_diagram`] | flow over density, of lanes and of the whole network |
//! | [`time_space_diagram`] | the vehicles of a [`Street`] over time, and the reds that they met |
//! | [`service_chart`] | the junctions with the longest control delay, by level of service |
//! | [`junction_film`] | one junction, moving: [`Film`] |
//!
//! ```
//! use std::sync::Arc;
//! use simworld_core::net::{NetworkConfig, RoadNetwork, StreetPlan};
//! use simworld_core::seed::Seed;
//! use simworld_traffic::look::{Quantity, Recorder, network_map};
//! use simworld_traffic::{Traffic, TrafficConfig};
//! let network = RoadNetwork::derive(&StreetPlan::grid(3, 3, 120.0), &NetworkConfig::default())?;
//! let mut traffic = Traffic::new(Arc::new(network), &TrafficConfig::default(), Seed(1))?;
//! let mut recorder = Recorder::new(&traffic);
//! for _ in 0..600 {
//!     traffic.step(0.1);
//!     recorder.look(&traffic, 0.1);
//! }
//! assert!(recorder.totals().mean_speed() > 2.0);
//! let map = network_map(&recorder, traffic.network(), Quantity::Speed);
//! assert!(map.starts_with("<svg") && map.trim_end().ends_with("</svg>"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod axes;
mod film;
mod fundamental;
mod map;
mod recorder;
mod service;
mod service_chart;
mod sheet;
mod street;
mod time_space;

pub use film::{Film, junction_film};
pub use fundamental::fundamental_diagram;
pub use map::{Quantity, network_map};
pub use recorder::{JunctionDelay, LaneUse, Recorder, Totals};
pub use service::LevelOfService;
pub use service_chart::service_chart;
pub use street::Street;
pub use time_space::{Trajectories, time_space_diagram};
