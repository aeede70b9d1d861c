//! Learning signal control: signalised junctions as agents of a Gym environment.
//!
//! [`SignalEnv`] implements core's [`ParallelEnv`](simworld_core::seam::ParallelEnv): one agent a junction with signals, an
//! action every five seconds. Observation and defaults are those of sumo-rl (Alegre 2019), so policies carry over; what is
//! seen and what is rewarded are traits, [`SignalObserver`] and [`SignalReward`].
//!
//! A policy of one line, which serves the longest queue, beats fixed stages where one road is busier than the other:
//!
//! ```
//! use std::collections::BTreeMap;
//! use std::sync::Arc;
//! use simworld_core::id::RoadId;
//! use simworld_core::net::{LaneDirection, NetworkConfig, RoadNetwork, StreetPlan};
//! use simworld_core::seam::{Options, ParallelEnv, SpaceValue};
//! use simworld_core::seed::Seed;
//! use simworld_traffic::learn::{SignalEnv, SignalEnvConfig};
//! use simworld_traffic::{Flow, Leg, Route};
//!
//! let network = Arc::new(RoadNetwork::derive(&StreetPlan::crossroads(200.0), &NetworkConfig::default())?);
//! let arm = |road, direction| Leg::new(RoadId(road), direction);
//! let across = |from, to| Route(vec![arm(from, LaneDirection::Backward), arm(to, LaneDirection::Forward)]);
//! let flows = [(0, 2, 650.0), (2, 0, 650.0), (1, 3, 100.0), (3, 1, 100.0)]
//!     .map(|(from, to, per_hour)| Flow::new(across(from, to), per_hour));
//! let config = SignalEnvConfig { flows: flows.to_vec(), seconds: 900.0, ..SignalEnvConfig::default() };
//! let mut env = SignalEnv::new(network, config)?;
//!
//! let mut run = |choose: &dyn Fn(usize, &[f64]) -> i64| -> Result<f64, Box<dyn std::error::Error>> {
//!     let start = env.reset(Some(Seed(1)), &Options::new())?;
//!     let mut seen: BTreeMap<_, _> = start.into_iter().map(|(id, (seen, _))| (id, seen)).collect();
//!     let mut reward = 0.0;
//!     for step in 0.. {
//!         let actions: BTreeMap<_, _> = seen.iter().map(|(id, seen)| {
//!             let SpaceValue::Box(seen) = seen else { unreachable!("observations are boxes") };
//!             (*id, SpaceValue::Discrete(choose(step, seen)))
//!         }).collect();
//!         let transitions = env.step(&actions)?;
//!         reward += transitions.values().map(|transition| transition.reward).sum::<f64>();
//!         if transitions.values().any(|transition| transition.truncated) { break; }
//!         seen = transitions.into_iter().map(|(id, transition)| (id, transition.observation)).collect();
//!     }
//!     Ok(reward)
//! };
//! // Two stages of equal length, and the one whose lanes have the longer queue: the last four entries are
//! // queues, and stage 1 is that of roads 0 and 2.
//! let fixed = run(&|step, _| (step as i64 / 6) % 2)?;
//! let longest = run(&|_, seen| i64::from(seen[7] + seen[9] > seen[8] + seen[10]))?;
//! assert!(longest > fixed, "{longest} against {fixed}");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod config;
mod env;
mod junction;
mod observe;
mod reward;

pub use config::SignalEnvConfig;
pub use env::SignalEnv;
pub use junction::{JunctionState, LaneState};
pub use observe::{DensityAndQueue, SignalObserver};
pub use reward::{AverageSpeed, PressureReward, QueueReward, SignalReward, WaitingTimeReward};
