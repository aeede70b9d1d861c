//! SUMO beside ours: the same `net.xml`, the same `rou.xml`, the same step, and how many vehicles each moves in a second of
//! processor time.
//!
//! SUMO comes with `pip install eclipse-sumo libsumo`; where Python or these are absent, [`beside`] says so.

mod files;
mod run;

use std::path::{Path, PathBuf};

use simworld_traffic::TrafficError;
use simworld_traffic::sumo::SumoError;
use thiserror::Error;

/// What both simulate: a grid of signalised junctions, 200 m apart, two lanes a direction, and vehicles that all depart at
/// the start on random routes of 60 edges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Workload {
    /// Junctions along each side of the grid.
    pub junctions: u32,
    /// Vehicles.
    pub vehicles: u32,
    /// Step, s.
    pub step: f64,
    /// Simulated time before the measurement, in which they enter, s.
    pub warm_up: f64,
    /// Simulated time that is measured, s.
    pub measured: f64,
}

impl Default for Workload {
    fn default() -> Self {
        Self { junctions: 10, vehicles: 1000, step: 0.1, warm_up: 60.0, measured: 60.0 }
    }
}

/// What one simulator did in the measured time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rate {
    /// Vehicles, summed over the steps.
    pub updates: f64,
    /// Processor time of its thread, s.
    pub seconds: f64,
    /// Mean speed of the vehicles at the end, m/s.
    pub speed: f64,
}

impl Rate {
    /// Vehicle updates a second of processor time.
    pub fn per_second(&self) -> f64 {
        self.updates / self.seconds.max(1e-9)
    }
}

/// Both, side by side.
#[derive(Clone, Debug, PartialEq)]
pub struct Beside {
    /// SUMO's version.
    pub version: String,
    /// SUMO.
    pub sumo: Rate,
    /// Ours.
    pub ours: Rate,
}

impl Beside {
    /// How many times as many vehicles ours moves in the same time.
    pub fn ratio(&self) -> f64 {
        self.ours.per_second() / self.sumo.per_second()
    }
}

/// Why there is no comparison.
#[derive(Debug, Error)]
pub enum BesideError {
    /// SUMO is not there.
    #[error("absent: {python} has no libsumo and eclipse-sumo; pip install them, or name another Python")]
    Absent {
        /// The Python that was asked.
        python: PathBuf,
    },
    /// One of its programs failed.
    #[error("{program} failed: {message}")]
    Program {
        /// Which.
        program: &'static str,
        /// What it said.
        message: String,
    },
    /// The files cannot be written.
    #[error(transparent)]
    Io(#[from] std::io::Error),
    /// The files cannot be read back.
    #[error(transparent)]
    Files(#[from] SumoError),
    /// Our traffic refuses them.
    #[error(transparent)]
    Traffic(#[from] TrafficError),
}

/// Runs both on one workload, SUMO in `python`, with the files in `folder`. The better of `repetitions` runs of each counts.
///
/// # Errors
/// No SUMO, or a program or file that fails.
pub fn beside(
    workload: Workload,
    python: &Path,
    folder: &Path,
    repetitions: u32,
) -> Result<Beside, BesideError> {
    let home = run::sumo_home(python)?;
    let files = files::make(workload, &home, folder)?;
    let best = |a: Rate, b: Rate| if b.per_second() > a.per_second() { b } else { a };
    let (mut sumo, version) = run::sumo(workload, python, &files)?;
    let mut ours = run::ours(workload, &files)?;
    for _ in 1..repetitions {
        sumo = best(sumo, run::sumo(workload, python, &files)?.0);
        ours = best(ours, run::ours(workload, &files)?);
    }
    Ok(Beside { version, sumo, ours })
}
