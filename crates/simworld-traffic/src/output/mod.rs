//! What engineers take away: trajectories, trips, summaries, detectors and means, as files of SUMO's formats or as CSV,
//! written as they come; and detectors to read from code.
//!
//! A [`Recorder`] looks at the traffic after every step and lets its [`Output`]s see it:
//!
//! ```
//! use std::sync::Arc;
//! use simworld_core::net::{NetworkConfig, RoadNetwork, StreetPlan};
//! use simworld_core::seed::Seed;
//! use simworld_traffic::output::{Fcd, InductionLoop, LoopOutput, Recorder, Syntax};
//! use simworld_traffic::{Traffic, TrafficConfig};
//! let network = Arc::new(RoadNetwork::derive(&StreetPlan::crossroads(100.0), &NetworkConfig::default())?);
//! let mut traffic = Traffic::new(Arc::clone(&network), &TrafficConfig::default(), Seed(1))?;
//! let mut recorder = Recorder::of(&traffic);
//! let trajectories = recorder.add(Fcd::new(Vec::new(), Syntax::Xml, 1.0)?);
//! let lane = network.roads[0].backward[0];
//! let count = recorder.add(LoopOutput::new(vec![InductionLoop::new("in", lane, 40.0)], 60.0));
//! for _ in 0..1200 {
//!     traffic.step(0.1);
//!     recorder.observe(&traffic)?;
//! }
//! recorder.finish()?;
//! let counted: u32 = recorder.get(count).readings().iter().map(|reading| reading.entered).sum();
//! assert!(counted > 0);
//! assert!(recorder.get(trajectories).writer().starts_with(b"<?xml"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Source of the formats: SUMO user documentation, *Simulation/Output*.

mod areas;
mod fcd;
mod loops;
mod means;
mod recorder;
mod summary;
mod trips;
mod write;

pub use areas::{AreaOutput, AreaReading, LaneArea};
pub use fcd::Fcd;
pub use loops::{InductionLoop, LoopOutput, LoopReading};
pub use means::{MeanOutput, Means, PerWhat};
pub use recorder::{Observation, Output, OutputId, Place, Recorder, Seen};
pub use summary::{Summary, SummaryStep};
pub use trips::TripInfo;
pub use write::Syntax;
