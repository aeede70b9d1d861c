//! The event log: JSON lines, one record each, whole up to the last finished line whenever the run stops.

use std::fs::{File, OpenOptions};
use std::io::{BufRead, BufReader, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use simworld_core::clock::Tick;
use simworld_core::event::Event;
use simworld_core::hash::StateDigest;
use simworld_core::record::{Recording, Stamped};
use simworld_core::seed::Seed;
use thiserror::Error;

/// The version of the format; a reader refuses others.
const VERSION: u32 = 1;

/// One line of a log.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LogRecord {
    /// The first line.
    Header {
        /// The version of the format.
        version: u32,
        /// The seed of the run.
        seed: Seed,
    },
    /// Something asked from outside.
    Command(Stamped),
    /// Something that happened.
    Event(Event),
    /// The digest after a step; what a replay confirms.
    Digest {
        /// The step.
        tick: Tick,
        /// The digest of world, dynamics, task and executors.
        digest: StateDigest,
    },
    /// The last line of a run that was not killed.
    End {
        /// The number of finished steps.
        tick: Tick,
    },
}

/// Why a log cannot be written or read.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum LogError {
    /// The file cannot be used.
    #[error("{path}: {source}")]
    File {
        /// Which file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// A line that is no record.
    #[error("{path}, line {line}: {source}; the lines before it are sound")]
    Line {
        /// Which file.
        path: PathBuf,
        /// Which line, counted from 1.
        line: usize,
        /// What is wrong with it.
        source: serde_json::Error,
    },
    /// No header, or one of another version.
    #[error("{path} is not an event log of version {VERSION}: run the example again to make one")]
    Header {
        /// Which file.
        path: PathBuf,
    },
    /// Records out of order.
    #[error("{path}, line {line}: tick {tick} comes after tick {before}; the log was edited or mixed")]
    Order {
        /// Which file.
        path: PathBuf,
        /// Which line, counted from 1.
        line: usize,
        /// The tick of the line.
        tick: Tick,
        /// The tick before it.
        before: Tick,
    },
}

/// Writes a log line by line.
#[derive(Debug)]
pub struct LogWriter {
    path: PathBuf,
    file: BufWriter<File>,
}

impl LogWriter {
    /// Begins a log.
    ///
    /// # Errors
    /// The file cannot be made.
    pub fn create(path: &Path, seed: Seed) -> Result<Self, LogError> {
        let file = File::create(path).map_err(|source| LogError::File { path: path.to_owned(), source })?;
        let mut writer = Self { path: path.to_owned(), file: BufWriter::new(file) };
        writer.write(&LogRecord::Header { version: VERSION, seed })?;
        Ok(writer)
    }

    /// Goes on with a log that is there, behind its first `length` bytes; what comes after them is cut off.
    ///
    /// # Errors
    /// The file cannot be changed.
    pub fn go_on(path: &Path, length: u64) -> Result<Self, LogError> {
        let file =
            cut_off(path, length).map_err(|source| LogError::File { path: path.to_owned(), source })?;
        Ok(Self { path: path.to_owned(), file: BufWriter::new(file) })
    }

    /// How long the file is with all that was written, bytes.
    ///
    /// # Errors
    /// As [`write`](Self::write).
    pub fn length(&mut self) -> Result<u64, LogError> {
        self.flush()?;
        self.file.stream_position().map_err(|source| LogError::File { path: self.path.clone(), source })
    }

    /// Adds a record.
    ///
    /// # Errors
    /// The disk is full, or the file went away.
    pub fn write(&mut self, record: &LogRecord) -> Result<(), LogError> {
        let line = serde_json::to_writer(&mut self.file, record).map_err(std::io::Error::from);
        line.and_then(|()| self.file.write_all(b"\n"))
            .map_err(|source| LogError::File { path: self.path.clone(), source })
    }

    /// Hands what was written to the system: whatever becomes of this process, it is in the file.
    ///
    /// # Errors
    /// As [`write`](Self::write).
    pub fn flush(&mut self) -> Result<(), LogError> {
        self.file.flush().map_err(|source| LogError::File { path: self.path.clone(), source })
    }

    /// Ends the log.
    ///
    /// # Errors
    /// As [`write`](Self::write).
    pub fn finish(mut self, tick: Tick) -> Result<(), LogError> {
        self.write(&LogRecord::End { tick })?;
        self.flush()
    }
}

/// A file that ends after its first `length` bytes, to be gone on with there.
pub(super) fn cut_off(path: &Path, length: u64) -> std::io::Result<File> {
    let mut file = OpenOptions::new().write(true).open(path)?;
    file.set_len(length)?;
    file.seek(SeekFrom::End(0))?;
    Ok(file)
}

/// What a log says of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadLog {
    /// The seed of the run.
    pub seed: Seed,
    /// Commands and digests.
    pub recording: Recording,
    /// The events, in order.
    pub events: Vec<Event>,
    /// Up to which step the log is whole.
    pub end: Tick,
    /// Why it is not whole to the end of the file, if it is not.
    pub broken_off: Option<String>,
}

/// Reads a log. A last line that is cut short is left out and named in [`ReadLog::broken_off`]; then the log counts
/// as whole up to its last digest.
///
/// # Errors
/// The file cannot be read, has no header, or holds a line in its middle that is no record.
pub fn read_log(path: &Path) -> Result<ReadLog, LogError> {
    let fail = |source| LogError::File { path: path.to_owned(), source };
    let mut lines = BufReader::new(File::open(path).map_err(fail)?).split(b'\n').enumerate();
    let seed = match lines.next().map(|(_, line)| line.map_err(fail)).transpose()? {
        Some(line) => match serde_json::from_slice(&line) {
            Ok(LogRecord::Header { version: VERSION, seed }) => seed,
            _ => return Err(LogError::Header { path: path.to_owned() }),
        },
        None => return Err(LogError::Header { path: path.to_owned() }),
    };
    let mut log = ReadLog {
        seed,
        recording: Recording::default(),
        events: Vec::new(),
        end: Tick(0),
        broken_off: Some("it has no end line".to_owned()),
    };
    let mut fault: Option<LogError> = None;
    for (index, line) in lines {
        if let Some(fault) = fault.take() {
            return Err(fault); // a line follows the one that was no record
        }
        let line = line.map_err(fail)?;
        match serde_json::from_slice(&line) {
            Ok(record) => log.take(record, path, index + 1)?,
            Err(source) => fault = Some(LogError::Line { path: path.to_owned(), line: index + 1, source }),
        }
    }
    if let Some(fault) = fault {
        log.broken_off = Some(fault.to_string());
    }
    Ok(log)
}

impl ReadLog {
    fn take(&mut self, record: LogRecord, path: &Path, line: usize) -> Result<(), LogError> {
        let ordered = |before: Option<Tick>, tick: Tick| match before {
            Some(before) if tick < before => {
                Err(LogError::Order { path: path.to_owned(), line, tick, before })
            }
            _ => Ok(()),
        };
        match record {
            LogRecord::Header { .. } => return Err(LogError::Header { path: path.to_owned() }),
            LogRecord::Command(stamped) => {
                ordered(self.recording.commands.last().map(|last| last.tick), stamped.tick)?;
                self.recording.commands.push(stamped);
            }
            LogRecord::Event(event) => self.events.push(event),
            LogRecord::Digest { tick, digest } => {
                ordered(self.recording.trail.last().map(|last| last.0.next()), tick)?;
                self.recording.trail.push((tick, digest));
                self.end = self.end.max(tick);
            }
            LogRecord::End { tick } => {
                self.end = tick;
                self.broken_off = None;
            }
        }
        Ok(())
    }
}
