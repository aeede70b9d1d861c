//! Plays a run again from its log, without minds, and confirms every hash.

use std::fmt;
use std::path::{Path, PathBuf};

use rayon::prelude::*;
use simworld_agents::episode::EpisodeError;
use simworld_citygen::City;
use simworld_core::clock::Tick;
use simworld_core::record::Divergence;
use simworld_core::scene::Scene;
use simworld_core::seed::Seed;
use thiserror::Error;

use super::assemble::{AssembleError, assemble_with, make_city};
use super::config::ConfigError;
use super::log::{LogError, ReadLog, read_log};
use super::{RunConfig, Watch};

/// Why a run could not be confirmed.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ReplayError {
    /// Its configuration cannot be read.
    #[error(transparent)]
    Config(#[from] ConfigError),
    /// A log cannot be read.
    #[error(transparent)]
    Log(#[from] LogError),
    /// A part cannot be made.
    #[error(transparent)]
    Assemble(#[from] AssembleError),
    /// The replay failed.
    #[error(transparent)]
    Episode(#[from] EpisodeError),
    /// The replay went another way.
    #[error("{path}: {source}")]
    Divergence {
        /// The log.
        path: PathBuf,
        /// Where.
        source: Divergence,
    },
    /// The log is another seed's.
    #[error("{path} is the log of seed {found}, and lies in the folder of seed {expected}: put it back")]
    Seed {
        /// The log.
        path: PathBuf,
        /// The seed it names.
        found: u64,
        /// The seed of its folder.
        expected: u64,
    },
}

/// What was confirmed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReplayReport {
    /// For each seed: steps replayed, hashes confirmed, and why the log ends early if it does.
    pub seeds: Vec<(Seed, Tick, usize, Option<String>)>,
}

impl fmt::Display for ReplayReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (seed, end, hashes, broken_off) in &self.seeds {
            write!(f, "seed {}: {end} steps replayed, {hashes} hashes confirmed", seed.0)?;
            match broken_off {
                Some(reason) => writeln!(f, " (the log ends early: {reason})")?,
                None => writeln!(f)?,
            }
        }
        Ok(())
    }
}

/// Plays all logs of a folder again.
///
/// # Errors
/// A file that cannot be read, a part that failed, or the first hash that differs.
pub fn replay(folder: &Path, watch: &Watch) -> Result<ReplayReport, ReplayError> {
    let config = RunConfig::read(&folder.join("config.toml"))?;
    let (city, _) = make_city(&config)?;
    let seeds: Vec<Seed> = (0..u64::from(config.seeds)).map(|n| Seed(config.seed.wrapping_add(n))).collect();
    let replayed = seeds.par_iter().map(|seed| {
        let path = folder.join(format!("seed-{}", seed.0)).join("events.jsonl");
        let log = read_log(&path)?;
        if log.seed != *seed {
            return Err(ReplayError::Seed { path, found: log.seed.0, expected: seed.0 });
        }
        let confirmed = replay_log(&config, &city, &log, watch).map_err(|error| match error {
            Fault::Diverged(source) => ReplayError::Divergence { path, source },
            Fault::Failed(error) => error,
        })?;
        Ok((*seed, log.end, confirmed, log.broken_off))
    });
    Ok(ReplayReport { seeds: replayed.collect::<Result<_, _>>()? })
}

enum Fault {
    Diverged(Divergence),
    Failed(ReplayError),
}

fn replay_log(config: &RunConfig, city: &City, log: &ReadLog, watch: &Watch) -> Result<usize, Fault> {
    let mut assembly =
        assemble_with(config, city, log.seed, None).map_err(|error| Fault::Failed(error.into()))?;
    let progress = watch.begin(&format!("replay {}", log.seed.0), log.end.0);
    let mut confirmed = 0;
    while assembly.episode.simulation().world().clock().tick() < log.end && !watch.is_stopped() {
        let stepped = assembly.episode.replay_step(&log.recording).map(|_| ());
        stepped.map_err(|error| Fault::Failed(error.into()))?;
        for (tick, digest) in &assembly.episode.trail()[confirmed..] {
            log.recording.confirm(*tick, *digest).map_err(Fault::Diverged)?;
            confirmed += 1;
        }
        let tick = assembly.episode.simulation().world().clock().tick().0;
        if tick.is_multiple_of(50) {
            progress(tick, "");
        }
    }
    Ok(confirmed)
}
