//! Plays a configuration, all its seeds, and writes what happened.

use std::fmt::Write as _;
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
use super::auctions::{Auction, AuctionBook};
use super::config::ConfigError;
use super::frames::{FrameError, FrameTaker};
use super::log::{LogError, LogRecord, LogWriter, ReadLog, read_log};
use super::output::{OutputError, OutputFolder};
use super::players::{Player, players};
use super::report::{RunReport, SeedReport};
use super::track::TrackWriter;
use super::{RunConfig, Watch, draw_map};

/// Steps between two points of a courier's trail on the map.
const TRAIL_STEP: u64 = 10;
/// Steps between two updates of the progress display.
const PROGRESS_STEP: u64 = 50;

/// The name of the event log of a seed.
const LOG: &str = "events.jsonl";

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
    folder.write("config.toml", config.to_toml()?)?;
    let (city, warnings) = make_city(config)?;
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
            if let Some(before) = before.filter(|_| !watch.is_stopped()) {
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

/// Goes on with a run that was cut off: seeds that are finished are kept, the others are played again and must give every
/// hash that was logged.
///
/// # Errors
/// The folder holds no run, or as [`play`].
pub fn resume(folder: &OutputFolder, watch: &Watch) -> Result<RunReport, RunError> {
    let config = RunConfig::read(&folder.path().join("config.toml"))?;
    play(&config, folder, watch)
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
    let mut assembly = assemble(config, city, seed)?;
    let mut log = folder.map(|folder| LogWriter::create(&folder.join(LOG), seed)).transpose()?;
    let track = |folder: &Path| TrackWriter::create(&folder.join("track.jsonl"), &assembly, config.steps);
    let mut track = folder.map(track).transpose()?;
    let progress = watch.begin(&format!("seed {}", seed.0), config.steps);
    let mut trails: Vec<Vec<Point2>> = vec![Vec::new(); assembly.couriers.len()];
    let (mut written, mut book) = (Written::default(), AuctionBook::new(&assembly.couriers));
    assembly.episode.events().iter().for_each(|event| book.take(event));
    if let Some(log) = &mut log {
        Written::log_events(&assembly, log)?;
    }
    while !assembly.episode.is_over() && !watch.is_stopped() {
        let stepped = assembly.episode.step().map(|_| ());
        if let Some(log) = &mut log {
            written.log_step(&assembly, log)?;
        }
        if let Some(track) = &mut track {
            track.take_if_due(&assembly)?;
        }
        stepped?;
        assembly.episode.events().iter().for_each(|event| book.take(event));
        assembly.episode.task().audit()?;
        let tick = assembly.episode.simulation().world().clock().tick().0;
        if tick.is_multiple_of(TRAIL_STEP) {
            extend_trails(&assembly, &mut trails);
        }
        if tick.is_multiple_of(PROGRESS_STEP) {
            progress(tick, &headline(&assembly));
        }
        if let (Some(taker), Some(folder)) = (taker.as_deref_mut(), folder) {
            taker.take_if_due(&assembly, folder)?;
        }
    }
    let end = assembly.episode.simulation().world().clock().tick();
    progress(end.0, &headline(&assembly));
    if let Some(log) = log {
        log.finish(end)?;
    }
    if let Some(track) = track {
        track.finish()?;
    }
    if let Some(folder) = folder {
        write_trail(folder, &assembly)?;
    }
    Ok(SeedRun {
        report: seed_report(&assembly, seed, end),
        couriers: assembly.episode.task().report(),
        players: players(config, seed),
        auctions: book.finish(),
        trails,
    })
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

fn extend_trails(assembly: &Assembly, trails: &mut [Vec<Point2>]) {
    let world = assembly.episode.simulation().world();
    for (trail, courier) in trails.iter_mut().zip(&assembly.couriers) {
        trail.extend(world.entity(*courier).map(|entity| entity.planar()));
    }
}

/// How much of the growing record is in the log.
#[derive(Default)]
struct Written {
    commands: usize,
    digests: usize,
}

impl Written {
    fn log_step(&mut self, assembly: &Assembly, log: &mut LogWriter) -> Result<(), LogError> {
        let commands = &assembly.episode.simulation().recording().commands;
        for command in &commands[self.commands..] {
            log.write(&LogRecord::Command(command.clone()))?;
        }
        self.commands = commands.len();
        Self::log_events(assembly, log)?;
        let trail = assembly.episode.trail();
        for (tick, digest) in &trail[self.digests..] {
            log.write(&LogRecord::Digest { tick: *tick, digest: *digest })?;
        }
        self.digests = trail.len();
        log.flush()
    }

    fn log_events(assembly: &Assembly, log: &mut LogWriter) -> Result<(), LogError> {
        for event in assembly.episode.events() {
            log.write(&LogRecord::Event(event.clone()))?;
        }
        Ok(())
    }
}

/// The trail of hashes as a table of its own, for eyes and diff.
fn write_trail(folder: &Path, assembly: &Assembly) -> Result<(), RunError> {
    let mut text = String::from("tick,digest\n");
    for (tick, digest) in assembly.episode.trail() {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{tick},{digest}");
    }
    let path = folder.join("hashes.csv");
    std::fs::write(&path, text).map_err(|source| OutputError::NotWritable { path, source })?;
    Ok(())
}
