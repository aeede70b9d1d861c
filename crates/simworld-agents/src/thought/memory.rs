//! What an agent remembers, and what of it comes to mind.

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};
use simworld_core::ops::pow;
use thiserror::Error;

use super::relevance::bm25;

/// What a memory is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum RecordKind {
    /// Something that one did, and what came of it.
    Did,
    /// Something that was said to one.
    Heard,
    /// Something that one saw.
    Saw,
    /// Something that one thought.
    Thought,
}

/// One memory.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// When it was, s of simulated time.
    pub at: f64,
    /// Of what.
    pub kind: RecordKind,
    /// In words.
    pub text: String,
    /// How much it matters, 1 (everyday) to 10.
    pub importance: u8,
    /// When it came to mind last, s.
    pub recalled: f64,
}

impl Record {
    /// A memory of now.
    pub fn new(at: f64, kind: RecordKind, text: String, importance: u8) -> Self {
        Self { at, kind, text, importance: importance.clamp(1, 10), recalled: at }
    }
}

/// A store of memories.
pub trait Memory: Send {
    /// Takes one in.
    fn remember(&mut self, record: Record);

    /// What comes to mind at a question, the best first, at most so many.
    fn recall(&mut self, question: &str, now: f64, most: usize) -> Vec<Record>;

    /// Everything as bytes for a snapshot.
    fn save(&self) -> Vec<u8>;

    /// Takes up saved memories; false if the bytes are not this store's.
    fn restore(&mut self, saved: &[u8]) -> bool;
}

/// How a [`RingMemory`] keeps and ranks.
///
/// The sum of recency, relevance and importance, each scaled to [0, 1] over what is remembered and all weighted alike, is
/// that of Park et al., "Generative Agents" (2023); their recency decays by 0.995 an hour, over days. A run here lasts hours:
/// the half-life is chosen.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct MemoryConfig {
    /// The most memories, 1 to 100 000; the oldest is forgotten first.
    pub capacity: usize,
    /// The time after which a memory that did not come to mind is half as near, s, 1 to 10^9.
    pub half_life: f64,
    /// Weight of recency, 0 to 100.
    pub recency: f64,
    /// Weight of relevance, 0 to 100.
    pub relevance: f64,
    /// Weight of importance, 0 to 100.
    pub importance: f64,
}

impl Default for MemoryConfig {
    fn default() -> Self {
        Self { capacity: 256, half_life: 600.0, recency: 1.0, relevance: 1.0, importance: 1.0 }
    }
}

/// A setting that no memory can work with.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{field} = {value} is out of range: give {allowed}")]
pub struct MemoryConfigError {
    /// The setting.
    pub field: &'static str,
    /// Its value.
    pub value: f64,
    /// What is allowed.
    pub allowed: &'static str,
}

impl MemoryConfig {
    /// Checks every field against its range; NaN is in none.
    ///
    /// # Errors
    /// The first field out of range.
    pub fn validate(&self) -> Result<(), MemoryConfigError> {
        let checks = [
            ("capacity", self.capacity as f64, 1.0..=100_000.0, "1 to 100 000"),
            ("half_life", self.half_life, 1.0..=1e9, "1 to 10^9 s"),
            ("recency", self.recency, 0.0..=100.0, "0 to 100"),
            ("relevance", self.relevance, 0.0..=100.0, "0 to 100"),
            ("importance", self.importance, 0.0..=100.0, "0 to 100"),
        ];
        match checks.into_iter().find(|(_, value, range, _)| !range.contains(value)) {
            Some((field, value, _, allowed)) => Err(MemoryConfigError { field, value, allowed }),
            None => Ok(()),
        }
    }
}

/// The newest memories in a ring; what comes to mind is recent, relevant or important.
#[derive(Clone, Debug, Default)]
pub struct RingMemory {
    config: MemoryConfig,
    records: VecDeque<Record>,
}

impl RingMemory {
    /// An empty memory.
    ///
    /// # Errors
    /// A setting out of range.
    pub fn new(config: MemoryConfig) -> Result<Self, MemoryConfigError> {
        config.validate()?;
        Ok(Self { config, records: VecDeque::new() })
    }

    /// Everything remembered, the oldest first.
    pub fn records(&self) -> impl ExactSizeIterator<Item = &Record> {
        self.records.iter()
    }

    /// The score of every record.
    fn scores(&self, question: &str, now: f64) -> Vec<f64> {
        let texts: Vec<&str> = self.records.iter().map(|record| record.text.as_str()).collect();
        let relevance = scaled(bm25(question, &texts));
        let recency = self.records.iter().map(|record| {
            let ago = (now - record.recalled).max(0.0);
            pow(0.5, ago / self.config.half_life)
        });
        let recency = scaled(recency.collect());
        let importance = scaled(self.records.iter().map(|record| f64::from(record.importance)).collect());
        let weighted = |index: usize| {
            self.config.recency * recency[index]
                + self.config.relevance * relevance[index]
                + self.config.importance * importance[index]
        };
        (0..self.records.len()).map(weighted).collect()
    }
}

/// From 0 for the least to 1 for the greatest; all zero where there is no difference.
fn scaled(values: Vec<f64>) -> Vec<f64> {
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let span = values.iter().copied().fold(f64::NEG_INFINITY, f64::max) - least;
    let scale = |value: f64| if span > 0.0 { (value - least) / span } else { 0.0 };
    values.into_iter().map(scale).collect()
}

impl Memory for RingMemory {
    fn remember(&mut self, record: Record) {
        self.records.push_back(record);
        while self.records.len() > self.config.capacity {
            self.records.pop_front();
        }
    }

    fn recall(&mut self, question: &str, now: f64, most: usize) -> Vec<Record> {
        let scores = self.scores(question, now);
        let mut order: Vec<usize> = (0..scores.len()).collect();
        // Of two that score the same the newer comes first.
        order.sort_unstable_by(|a, b| scores[*b].total_cmp(&scores[*a]).then(b.cmp(a)));
        order.truncate(most);
        for index in &order {
            self.records[*index].recalled = now;
        }
        order.into_iter().map(|index| self.records[index].clone()).collect()
    }

    fn save(&self) -> Vec<u8> {
        // Plain data, which postcard always takes.
        postcard::to_stdvec(&self.records).expect("plain data serialises")
    }

    fn restore(&mut self, saved: &[u8]) -> bool {
        match postcard::from_bytes::<VecDeque<Record>>(saved) {
            Ok(records) if records.len() <= self.config.capacity => {
                self.records = records;
                true
            }
            _ => false,
        }
    }
}
