//! What happened in an environment: statistics of episodes, and trajectories as lines of JSON.

mod parallel;
mod single;

use std::collections::BTreeMap;
use std::io::Write;

use serde::{Deserialize, Serialize};
use simworld_core::id::EntityId;
use simworld_core::seam::EnvError;
use simworld_core::seed::Seed;

/// How much is written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Detail {
    /// A line an episode.
    #[default]
    Episodes,
    /// A line a reset, a step and an episode.
    Steps,
}

/// An episode in figures.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct EpisodeSummary {
    /// Which episode since the wrapper was made, from 0.
    pub episode: u64,
    /// The seed it was begun with, if there was one.
    pub seed: Option<Seed>,
    /// Steps.
    pub steps: u64,
    /// Sum of rewards, of all agents.
    pub total: f64,
    /// Sum of rewards of each agent; empty where there is but one.
    pub returns: BTreeMap<EntityId, f64>,
    /// Whether the task came to an end of its own, for the last of the agents.
    pub terminated: bool,
    /// Whether the time ran out, for the last of the agents. Neither: it was broken off by a reset.
    pub truncated: bool,
}

/// A line of a record: `S` is what a reset gives, `A` what is done, `T` what a step gives.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Line<S, A, T> {
    /// An episode begins.
    Reset {
        /// Which.
        episode: u64,
        /// The seed, if there is one.
        seed: Option<Seed>,
        /// The first observation and info, by agent where there are several.
        start: S,
    },
    /// A step.
    Step {
        /// What was done, by agent where there are several.
        action: A,
        /// What came of it, by agent where there are several.
        transition: T,
    },
    /// An episode is over.
    Episode(EpisodeSummary),
}

/// Keeps statistics of episodes, and writes lines of JSON; of one agent or of several.
///
/// The last transition of an episode carries `episode_return` and `episode_length` in its info. A step that fails is not
/// recorded. An episode that is broken off by a reset is: neither terminated nor truncated.
#[derive(Debug)]
pub struct Record<E, W> {
    env: E,
    out: W,
    detail: Detail,
    episodes: Vec<EpisodeSummary>,
    current: Option<EpisodeSummary>,
    begun: u64,
}

impl<E, W: Write> Record<E, W> {
    /// Writes to `out`; [`std::io::sink`] keeps statistics alone.
    pub fn new(env: E, out: W, detail: Detail) -> Self {
        Self { env, out, detail, episodes: Vec::new(), current: None, begun: 0 }
    }

    /// The episodes that are over.
    pub fn episodes(&self) -> &[EpisodeSummary] {
        &self.episodes
    }

    /// What is inside.
    pub fn inner(&self) -> &E {
        &self.env
    }

    /// What was written to.
    pub fn into_writer(self) -> W {
        self.out
    }

    fn write(&mut self, line: &impl Serialize) -> Result<(), EnvError> {
        let written = serde_json::to_writer(&mut self.out, line).map_err(std::io::Error::from);
        written.and_then(|()| self.out.write_all(b"\n")).map_err(|error| EnvError::Wrapper {
            wrapper: "Record",
            reason: format!("a line cannot be written: {error}"),
        })
    }

    /// An episode begins, and with it the one before is over.
    fn begin(&mut self, seed: Option<Seed>) -> Result<u64, EnvError> {
        self.end()?;
        let episode = self.begun;
        self.begun += 1;
        self.current = Some(EpisodeSummary { episode, seed, ..EpisodeSummary::default() });
        Ok(episode)
    }

    /// The episode under way, if there is one, is over.
    fn end(&mut self) -> Result<(), EnvError> {
        let Some(summary) = self.current.take() else { return Ok(()) };
        self.write(&Line::<(), (), ()>::Episode(summary.clone()))?;
        self.episodes.push(summary);
        Ok(())
    }
}
