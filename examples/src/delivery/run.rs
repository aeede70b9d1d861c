//! Plays a configuration, all its seeds, and writes what happened.

use std::path::{Path, PathBuf};
use std::sync::Mutex;

use rayon::prelude::*;
use simworld_agents::delivery::{AuditError, DeliveryReport};
use simworld_agents::episode::EpisodeError;
use simworld_citygen::City;
use simworld_core::clock::Tick;
use simworld_core::geometry::Point2;
use simworld_core::hash::StateHash;
use simworld_core::record::Divergence;
use simworld_core::scene::Scene;
use simworld_core::seam::Task;
use simworld_core::seed::Seed;
use thiserror::Error;

use super::assemble::{AssembleError, Assembly, assemble, make_city};
use super::auctions::Auction;
use super::config::ConfigError;
use super::frames::{FrameError, FrameTaker};
use super::journal::{End, Journal, LOG};
use super::log::{LogError, ReadLog, read_log};
use super::output::{OutputError, OutputFolder};
use super::players::{Brain, Player, players};
use super::report::{RunReport, SeedReport};
use super::{RunConfig, Watch, draw_map};

/// Steps between two updates of the progress display.
const PROGRESS_STEP: u64 = 50;

/// Why a run ended before its time. What was logged until then is whole.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RunError {
    /// A part cannot be made.
    #[error(transparent)]
    Assemble(#[from] AssembleError),
    /// The episode failed.
    #[error(transparent)]
    Episode(#[from] EpisodeError),
    /// Money was made or lost.
    #[error("the books do not balance: {0}")]
    Audit(#[from] AuditError),
    /// The log cannot be written.
    #[error(transparent)]
    Log(#[from] LogError),
    /// The folder cannot be written to.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// The settings of a run that is to go on cannot be read.
    #[error(transparent)]
    Settings(#[from] ConfigError),
    /// A run that went on took another way than before.
    #[error("{path}: {source}; was it made by another version?")]
    Divergence {
        /// The log.
        path: PathBuf,
        /// Where.
        source: Divergence,
    },
    /// The configuration cannot be written.
    #[error("the configuration cannot be written: {0}")]
    Config(#[from] toml::ser::Error),
    /// A frame cannot be written.
    #[error(transparent)]
    Frame(#[from] FrameError),
}

/// What one seed came to.
#[derive(Clone, Debug, PartialEq)]
pub struct SeedRun {
    /// Its figures.
    pub report: SeedReport,
    /// Its figures, courier by courier.
    pub couriers: Option<DeliveryReport>,
    /// Who they were, in the same order.
    pub players: Vec<Player>,
    /// What they bid, order by order.
    pub auctions: Vec<Auction>,
    /// Where each courier went, a point a second.
    pub trails: Vec<Vec<Point2>>,
}

/// Plays all seeds, in parallel, and writes configuration, logs, hashes, maps, frames and the report.
///
/// # Errors
/// The first seed that failed, or a file that cannot be written.
pub fn play(config: &RunConfig, folder: &OutputFolder, watch: &Watch) -> Result<RunReport, RunError> {
    // A city that is not there leaves nothing behind.
    let (city, warnings) = make_city(config)?;
    folder.write("config.toml", config.to_toml()?)?;
    if !warnings.is_empty() {
        let lines: Vec<String> = warnings.iter().map(ToString::to_string).collect();
        folder.write("warnings.txt", lines.join("\n"))?;
    }
    let taker = Mutex::new(frame_taker(config, folder)?);
    let seeds: Vec<Seed> = (0..u64::from(config.seeds)).map(|n| Seed(config.seed.wrapping_add(n))).collect();
    let reports: Vec<SeedReport> = seeds
        .par_iter()
        .map(|seed| {
            let path = folder.seed_folder(*seed)?;
            // Frames are of the first seed: one renderer, one set of pictures.
            let mut taker =
                if *seed == seeds[0] { taker.lock().ok().and_then(|mut taker| taker.take()) } else { None };
            if let Some(finished) = finished(&path, config.steps) {
                return Ok(finished);
            }
            let before = read_log(&path.join(LOG)).ok();
            let run = run_seed(config, &city, *seed, Some(&path), taker.as_mut(), watch)?;
            if let Some(before) = before.filter(|_| !watch.is_stopped() && gives_the_same_again(config)) {
                confirm(&before, &path)?;
            }
            write_seed(folder, &city, &run)?;
            Ok(run.report)
        })
        .collect::<Result<_, RunError>>()?;
    let report = RunReport { players: names(config), seeds: reports };
    folder.write("report.txt", report.to_string())?;
    folder.write("report.json", to_json(&report))?;
    Ok(report)
}

/// Goes on with a run that was cut off: seeds that are finished are kept, the others go on from their newest sound checkpoint or
/// begin anew, and must give every hash that was logged.
///
/// # Errors
/// The folder holds no run, or as [`play`].
pub fn resume(folder: &OutputFolder, watch: &Watch) -> Result<RunReport, RunError> {
    let config = RunConfig::read(&folder.path().join("config.toml"))?;
    play(&config, folder, watch)
}

/// Whether what was cut off comes again as it was: a model that is asked again may answer otherwise, unless it is on a tape.
fn gives_the_same_again(config: &RunConfig) -> bool {
    !config.policies.contains(&Brain::Model) || config.model.tape.is_some()
}

/// The report of a seed that came to its end.
fn finished(path: &Path, steps: u64) -> Option<SeedReport> {
    let whole = read_log(&path.join(LOG)).ok().filter(|log| log.broken_off.is_none())?;
    let bytes = std::fs::read(path.join("report.json")).ok()?;
    let (report, _): (SeedReport, Option<DeliveryReport>) = serde_json::from_slice(&bytes).ok()?;
    (report.steps == whole.end.0 && report.steps >= steps).then_some(report)
}

/// Holds the hashes of a run that was cut off against those of the run that went on.
fn confirm(before: &ReadLog, path: &Path) -> Result<(), RunError> {
    let log = path.join(LOG);
    let after = read_log(&log)?;
    for (tick, digest) in &before.recording.trail {
        let confirmed = after.recording.confirm(*tick, *digest);
        confirmed.map_err(|source| RunError::Divergence { path: log.clone(), source })?;
    }
    Ok(())
}

/// A renderer, if frames are wanted and there is an adapter; without one the reason is written beside the log.
fn frame_taker(config: &RunConfig, folder: &OutputFolder) -> Result<Option<FrameTaker>, RunError> {
    if config.frames == 0 {
        return Ok(None);
    }
    match FrameTaker::new(config.steps, config.frames) {
        Ok(taker) => Ok(Some(taker)),
        Err(reason) => {
            folder.write("no-frames.txt", format!("{reason}\n"))?;
            Ok(None)
        }
    }
}

fn write_seed(folder: &OutputFolder, city: &City, run: &SeedRun) -> Result<(), RunError> {
    let name = |file: &str| format!("seed-{}/{file}", run.report.seed.0);
    folder.write(name("map.svg"), draw_map(city, run))?;
    folder.write(name("report.json"), to_json(&(&run.report, &run.couriers)))?;
    Ok(())
}

fn to_json(value: &impl serde::Serialize) -> String {
    serde_json::to_string_pretty(value).expect("reports are plain data with string keys")
}

fn names(config: &RunConfig) -> String {
    match config.policies.as_slice() {
        [one] => one.as_str().to_owned(),
        several => format!("{} policies", several.len()),
    }
}

/// Plays one seed; with a folder it writes the event log and the trail of hashes there.
///
/// # Errors
/// A part cannot be made, failed, or the log cannot be written.
pub fn run_seed(
    config: &RunConfig,
    city: &City,
    seed: Seed,
    folder: Option<&Path>,
    mut taker: Option<&mut FrameTaker>,
    watch: &Watch,
) -> Result<SeedRun, RunError> {
    let (mut assembly, mut journal) = begin(config, city, seed, folder)?;
    let progress = watch.begin(&format!("seed {}", seed.0), config.steps);
    while !assembly.episode.is_over() && !watch.is_stopped() {
        let stepped = assembly.episode.step().map(|_| ());
        journal.take_step(&assembly)?;
        stepped?;
        assembly.episode.task().audit()?;
        let tick = assembly.episode.simulation().world().clock().tick().0;
        if tick.is_multiple_of(PROGRESS_STEP) {
            progress(tick, &headline(&assembly));
        }
        if let (Some(taker), Some(folder)) = (taker.as_deref_mut(), folder) {
            taker.take_if_due(&assembly, folder)?;
        }
        if !assembly.episode.is_over() {
            journal.checkpoint_if_due(&assembly)?;
        }
    }
    let tick = assembly.episode.simulation().world().clock().tick();
    progress(tick.0, &headline(&assembly));
    let end = if assembly.episode.is_over() { End::Reached } else { End::Stopped };
    if end == End::Stopped {
        journal.checkpoint(&assembly)?;
    }
    let (auctions, trails) = journal.finish(tick, end)?;
    Ok(SeedRun {
        report: seed_report(&assembly, seed, tick),
        couriers: assembly.episode.task().report(),
        players: players(config, seed),
        auctions,
        trails,
    })
}

/// A run at its beginning, or where its folder has a checkpoint of it.
fn begin(
    config: &RunConfig,
    city: &City,
    seed: Seed,
    folder: Option<&Path>,
) -> Result<(Assembly, Journal), RunError> {
    let assembled = || Ok(assemble(config, city, seed)?);
    if let Some(folder) = folder
        && config.checkpoints().is_some()
        && let Some(taken_up) = Journal::take_up(config, seed, folder, &assembled)?
    {
        return Ok(taken_up);
    }
    let assembly = assembled()?;
    let journal = Journal::begin(config, &assembly, seed, folder)?;
    Ok((assembly, journal))
}

/// The report of an assembled run as it stands.
pub(super) fn seed_report(assembly: &Assembly, seed: Seed, end: Tick) -> SeedReport {
    SeedReport {
        seed,
        steps: end.0,
        metrics: assembly.episode.task().metrics(),
        digest: assembly.episode.digest(),
        physical: assembly.physical,
        model: assembly.thinkers.as_ref().map(|thinkers| thinkers.usage(end.0)),
    }
}

fn headline(assembly: &Assembly) -> String {
    assembly.episode.task().report().map_or(String::new(), |report| format!("{} delivered", report.delivered))
}
