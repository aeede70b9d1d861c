//! Checkpoints: the whole state of a run on the disk, so that one that is cut off goes on from there.
//!
//! Each is a file of its own, which is written under another name first. The newest two are kept: should one turn out to be
//! damaged, there is one before it.

use std::fs::{self, File};
use std::io::Write;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use simworld_agents::episode::{EpisodeError, EpisodeSnapshot};
use simworld_core::clock::Tick;
use simworld_core::geometry::Point2;
use simworld_core::hash::{StateDigest, StateHash, StateHasher};
use simworld_core::seed::Seed;
use thiserror::Error;

use super::auctions::AuctionBook;
use super::{Assembly, LogError, ModelUsage, OutputError};

/// The version of the format; a reader refuses others.
const VERSION: u32 = 1;
/// How many are kept.
const KEPT: usize = 2;
/// Bytes of the digest that leads a file.
const DIGEST: usize = 8;

/// A run after a step.
#[derive(Serialize, Deserialize)]
pub(super) struct Checkpoint {
    version: u32,
    pub(super) seed: Seed,
    pub(super) tick: Tick,
    /// Of the state that is kept: a run that takes it up has the same.
    pub(super) digest: StateDigest,
    pub(super) episode: EpisodeSnapshot,
    /// How long log and track were, bytes.
    pub(super) log: u64,
    pub(super) track: u64,
    pub(super) book: AuctionBook,
    pub(super) trails: Vec<Vec<Point2>>,
    pub(super) hashes: Vec<(Tick, StateDigest)>,
    pub(super) usage: Option<ModelUsage>,
}

/// Why a checkpoint is of no use; an older one may be, and the beginning always is.
#[derive(Debug, Error)]
pub(super) enum CheckpointError {
    #[error("it cannot be read: {0}")]
    File(#[from] std::io::Error),
    #[error(transparent)]
    Log(#[from] LogError),
    #[error("it is damaged")]
    Damaged,
    #[error("it is of version {found}, and not of {VERSION}")]
    Version { found: u32 },
    #[error("it is of seed {found}, and not of {}", .expected.0)]
    Seed { found: u64, expected: Seed },
    #[error("{file} is shorter than it was then")]
    Short { file: &'static str },
    #[error("it cannot be taken up: {0}")]
    Episode(#[from] EpisodeError),
    #[error("what was taken up of it is not what was kept: was it made by another version?")]
    Other,
}

/// What is kept beside the episode.
pub(super) struct Beside<'a> {
    pub(super) log: u64,
    pub(super) track: u64,
    pub(super) book: &'a AuctionBook,
    pub(super) trails: &'a [Vec<Point2>],
    pub(super) hashes: &'a [(Tick, StateDigest)],
}

impl Checkpoint {
    /// Of a run as it stands.
    ///
    /// # Errors
    /// A part of it cannot be saved.
    pub(super) fn of(
        assembly: &Assembly,
        seed: Seed,
        tick: Tick,
        beside: &Beside<'_>,
    ) -> Result<Self, EpisodeError> {
        Ok(Self {
            version: VERSION,
            seed,
            tick,
            digest: assembly.episode.digest(),
            episode: assembly.episode.save()?,
            log: beside.log,
            track: beside.track,
            book: beside.book.clone(),
            trails: beside.trails.to_vec(),
            hashes: beside.hashes.to_vec(),
            usage: assembly.thinkers.as_ref().map(|thinkers| thinkers.usage(tick.0)),
        })
    }

    /// Writes it into the folder of its seed, and removes those that are no longer needed.
    ///
    /// # Errors
    /// The folder cannot be written to.
    pub(super) fn write(&self, folder: &Path) -> Result<(), OutputError> {
        let path = folder.join(format!("checkpoint-{:09}.bin", self.tick.0));
        let fail = |source| OutputError::NotWritable { path: path.clone(), source };
        let state = postcard::to_stdvec(self).expect("plain data can be written to memory");
        let draft = path.with_extension("draft");
        let mut file = File::create(&draft).map_err(fail)?;
        let written = file.write_all(&checksum(&state)).and_then(|()| file.write_all(&state));
        written.and_then(|()| file.sync_all()).and_then(|()| fs::rename(&draft, &path)).map_err(fail)?;
        for old in checkpoints(folder).into_iter().skip(KEPT) {
            fs::remove_file(old).map_err(fail)?;
        }
        Ok(())
    }

    /// Reads one of a seed.
    ///
    /// # Errors
    /// It is damaged, or another's.
    pub(super) fn read(path: &Path, seed: Seed) -> Result<Self, CheckpointError> {
        let bytes = fs::read(path)?;
        let (digest, state) = bytes.split_at_checked(DIGEST).ok_or(CheckpointError::Damaged)?;
        if digest != checksum(state) {
            return Err(CheckpointError::Damaged);
        }
        // What another version wrote may not read at all, so its number is read by itself.
        let (found, _) = postcard::take_from_bytes::<u32>(state).map_err(|_| CheckpointError::Damaged)?;
        if found != VERSION {
            return Err(CheckpointError::Version { found });
        }
        let read: Self = postcard::from_bytes(state).map_err(|_| CheckpointError::Damaged)?;
        if read.seed != seed {
            return Err(CheckpointError::Seed { found: read.seed.0, expected: seed });
        }
        Ok(read)
    }

    /// Brings a run that was assembled anew to this state.
    ///
    /// # Errors
    /// It does not fit; the run must then be assembled anew again.
    pub(super) fn take_up(&self, assembly: &mut Assembly) -> Result<(), CheckpointError> {
        assembly.episode.restore(self.episode.clone())?;
        if assembly.episode.digest() != self.digest {
            return Err(CheckpointError::Other);
        }
        if let (Some(thinkers), Some(usage)) = (&mut assembly.thinkers, self.usage) {
            thinkers.go_on_from(usage);
        }
        Ok(())
    }
}

/// The checkpoints of a seed's folder, the newest first.
pub(super) fn checkpoints(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let named = |path: &PathBuf| {
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        name.starts_with("checkpoint-") && path.extension().is_some_and(|extension| extension == "bin")
    };
    let mut found: Vec<PathBuf> = entries.filter(named).collect();
    found.sort_unstable_by(|a, b| b.cmp(a));
    found
}

/// Removes those of a run that came to its end.
pub(super) fn clear(folder: &Path) -> Result<(), OutputError> {
    for path in checkpoints(folder) {
        fs::remove_file(&path).map_err(|source| OutputError::NotWritable { path: path.clone(), source })?;
    }
    Ok(())
}

/// Tells damaged bytes from whole ones.
fn checksum(bytes: &[u8]) -> [u8; DIGEST] {
    StateHasher::new().bytes(bytes).finish().0.to_le_bytes()
}
