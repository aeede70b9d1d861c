//! The main job: couriers at work in a generated city with traffic and physics.
//!
//! [`RunConfig`] says what to run, [`assemble`] puts a world and an episode together, [`play`] plays it and writes
//! the log, [`replay`] plays the log again and confirms every hash.

mod assemble;
mod auctions;
mod bodies;
mod checkpoint;
mod config;
mod frames;
mod journal;
mod locate;
mod log;
mod map;
mod output;
mod players;
mod reader;
mod replay;
mod report;
mod run;
mod thinkers;
mod track;
mod watch;

pub use assemble::{AssembleError, Assembly, assemble, assemble_with, make_city};
pub use auctions::{Auction, auctions_of};
pub use config::{ConfigError, EVERYWHERE, RunConfig};
pub use frames::{FrameError, FrameTaker};
pub use log::{LogError, LogRecord, LogWriter, ReadLog, read_log};
pub use map::draw_map;
pub use output::{OutputError, OutputFolder};
pub use players::{Brain, BrainError, Player, players};
pub use reader::reader;
pub use replay::{ReplayError, ReplayReport, replay};
pub use report::{COLUMNS, PAPER, RunReport, SeedReport};
pub use run::{RunError, SeedRun, play, resume, run_seed};
pub use thinkers::{Eyes, ModelSettings, ModelUsage, ThinkError, Thinkers};
pub use track::{
    Doing, Mount, Moves, Passage, Passer, Spot, Track, TrackWriter, Tracked, metres, read_track,
};
pub use watch::{Progress, Watch};
