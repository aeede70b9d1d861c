//! What a run keeps of itself while it goes on: the log and the track on the disk, trails and auctions in memory.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use simworld_core::clock::Tick;
use simworld_core::geometry::Point2;
use simworld_core::hash::StateDigest;
use simworld_core::scene::Scene;
use simworld_core::seed::Seed;

use super::auctions::{Auction, AuctionBook};
use super::checkpoint::{Beside, Checkpoint, CheckpointError, checkpoints, clear};
use super::log::{LogError, LogRecord, LogWriter};
use super::track::TrackWriter;
use super::{Assembly, OutputError, RunConfig, RunError};

/// Steps between two points of a courier's trail on the map.
const TRAIL_STEP: u64 = 10;

/// The name of the event log of a seed.
pub(super) const LOG: &str = "events.jsonl";
/// The name of its track.
const TRACK: &str = "track.jsonl";
/// Where a run that went on says from where.
const RESUMED: &str = "resumed.txt";

/// The record of a run under way.
pub(super) struct Journal {
    seed: Seed,
    /// With a folder: where it is, the log and the track.
    files: Option<Files>,
    book: AuctionBook,
    /// Where each courier went.
    trails: Vec<Vec<Point2>>,
    hashes: Vec<(Tick, StateDigest)>,
    /// How much of the growing record of the episode is taken.
    commands: usize,
    digests: usize,
}

struct Files {
    folder: PathBuf,
    log: LogWriter,
    track: TrackWriter,
    /// Steps between two checkpoints, if any are wanted.
    interval: Option<u64>,
}

impl Journal {
    /// Of a run that begins; with a folder it is written there.
    ///
    /// # Errors
    /// The folder cannot be written to.
    pub(super) fn begin(
        config: &RunConfig,
        assembly: &Assembly,
        seed: Seed,
        folder: Option<&Path>,
    ) -> Result<Self, RunError> {
        let files = |folder: &Path| -> Result<Files, RunError> {
            let mut log = LogWriter::create(&folder.join(LOG), seed)?;
            log_events(assembly, &mut log)?;
            let track = TrackWriter::create(&folder.join(TRACK), assembly, config.steps)?;
            clear(folder)?;
            Ok(Files { folder: folder.to_owned(), log, track, interval: config.checkpoints() })
        };
        let mut book = AuctionBook::new(&assembly.couriers);
        assembly.episode.events().iter().for_each(|event| book.take(event));
        Ok(Self {
            seed,
            files: folder.map(files).transpose()?,
            book,
            trails: vec![Vec::new(); assembly.couriers.len()],
            hashes: Vec::new(),
            commands: 0,
            digests: 0,
        })
    }

    /// Of a run that is taken up where its newest sound checkpoint was written; `None` if there is none, and then the run is
    /// to be assembled anew, for a part of it may be changed. Says in a file of the folder from where it went on, and what
    /// could not be used.
    ///
    /// # Errors
    /// The folder cannot be written to.
    pub(super) fn take_up(
        config: &RunConfig,
        seed: Seed,
        folder: &Path,
        assemble: &dyn Fn() -> Result<Assembly, RunError>,
    ) -> Result<Option<(Assembly, Self)>, RunError> {
        let (mut notes, mut found) = (String::new(), None);
        for path in checkpoints(folder) {
            let mut assembly = assemble()?;
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            match Self::from_checkpoint(config, seed, folder, &path, &mut assembly) {
                Ok(journal) => {
                    let tick = assembly.episode.simulation().world().clock().tick();
                    let _ = writeln!(notes, "went on from step {tick}, by {name}");
                    found = Some((assembly, journal));
                    break;
                }
                Err(reason) => {
                    let _ = writeln!(notes, "{name} was left out: {reason}");
                }
            }
        }
        if !notes.is_empty() {
            if found.is_none() {
                notes.push_str("began anew\n");
            }
            let path = folder.join(RESUMED);
            std::fs::write(&path, notes).map_err(|source| OutputError::NotWritable { path, source })?;
        }
        Ok(found)
    }

    fn from_checkpoint(
        config: &RunConfig,
        seed: Seed,
        folder: &Path,
        path: &Path,
        assembly: &mut Assembly,
    ) -> Result<Self, CheckpointError> {
        let checkpoint = Checkpoint::read(path, seed)?;
        let (log, track) = (folder.join(LOG), folder.join(TRACK));
        for (file, path, length) in [(LOG, &log, checkpoint.log), (TRACK, &track, checkpoint.track)] {
            if std::fs::metadata(path)?.len() < length {
                return Err(CheckpointError::Short { file });
            }
        }
        checkpoint.take_up(assembly)?;
        // Only now is anything cut off.
        let log = LogWriter::go_on(&log, checkpoint.log)?;
        let track = TrackWriter::go_on(&track, checkpoint.track, assembly, config.steps)?;
        let folder = folder.to_owned();
        Ok(Self {
            seed,
            files: Some(Files { folder, log, track, interval: config.checkpoints() }),
            book: checkpoint.book,
            trails: checkpoint.trails,
            hashes: checkpoint.hashes,
            // The record of an episode that is taken up begins there.
            commands: 0,
            digests: 0,
        })
    }

    /// Takes in a step, whether it succeeded or not.
    ///
    /// # Errors
    /// The log or the track cannot be written.
    pub(super) fn take_step(&mut self, assembly: &Assembly) -> Result<(), LogError> {
        let commands = &assembly.episode.simulation().recording().commands;
        let new = &assembly.episode.trail()[self.digests..];
        if let Some(Files { log, track, .. }) = &mut self.files {
            for command in &commands[self.commands..] {
                log.write(&LogRecord::Command(command.clone()))?;
            }
            log_events(assembly, log)?;
            for (tick, digest) in new {
                log.write(&LogRecord::Digest { tick: *tick, digest: *digest })?;
            }
            log.flush()?;
            track.take_if_due(assembly)?;
        }
        self.hashes.extend_from_slice(new);
        (self.commands, self.digests) = (commands.len(), assembly.episode.trail().len());
        assembly.episode.events().iter().for_each(|event| self.book.take(event));
        let world = assembly.episode.simulation().world();
        if world.clock().tick().0.is_multiple_of(TRAIL_STEP) {
            for (trail, courier) in self.trails.iter_mut().zip(&assembly.couriers) {
                trail.extend(world.entity(*courier).map(|entity| entity.planar()));
            }
        }
        Ok(())
    }

    /// Writes a checkpoint if one is due after this step, and there is a folder.
    ///
    /// # Errors
    /// A part of the run cannot be saved, or the folder cannot be written to.
    pub(super) fn checkpoint_if_due(&mut self, assembly: &Assembly) -> Result<(), RunError> {
        let tick = assembly.episode.simulation().world().clock().tick();
        match &self.files {
            Some(Files { interval: Some(interval), .. }) if tick.0.is_multiple_of(*interval) => {
                self.checkpoint(assembly)
            }
            _ => Ok(()),
        }
    }

    /// Writes a checkpoint, if there is a folder and the settings want any.
    ///
    /// # Errors
    /// As [`checkpoint_if_due`](Self::checkpoint_if_due).
    pub(super) fn checkpoint(&mut self, assembly: &Assembly) -> Result<(), RunError> {
        let Some(files) = self.files.as_mut().filter(|files| files.interval.is_some()) else { return Ok(()) };
        let tick = assembly.episode.simulation().world().clock().tick();
        let beside = Beside {
            log: files.log.length()?,
            track: files.track.length()?,
            book: &self.book,
            trails: &self.trails,
            hashes: &self.hashes,
        };
        let checkpoint = Checkpoint::of(assembly, self.seed, tick, &beside)?;
        Ok(checkpoint.write(&files.folder)?)
    }

    /// Ends the record after that many steps; checkpoints are no longer needed where a run came to its `end`.
    ///
    /// # Errors
    /// The files cannot be written.
    pub(super) fn finish(self, tick: Tick, end: End) -> Result<(Vec<Auction>, Vec<Vec<Point2>>), RunError> {
        if let Some(Files { folder, log, track, .. }) = self.files {
            log.finish(tick)?;
            track.finish()?;
            let mut text = String::from("tick,digest\n");
            for (tick, digest) in &self.hashes {
                // Writing to a string cannot fail.
                let _ = writeln!(text, "{tick},{digest}");
            }
            let path = folder.join("hashes.csv");
            std::fs::write(&path, text).map_err(|source| OutputError::NotWritable { path, source })?;
            if end == End::Reached {
                clear(&folder)?;
            }
        }
        Ok((self.book.finish(), self.trails))
    }
}

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum End {
    /// After its last step.
    Reached,
    /// Somebody asked it to stop.
    Stopped,
}

fn log_events(assembly: &Assembly, log: &mut LogWriter) -> Result<(), LogError> {
    for event in assembly.episode.events() {
        log.write(&LogRecord::Event(event.clone()))?;
    }
    Ok(())
}
