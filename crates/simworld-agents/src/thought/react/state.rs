//! What a thinking mind is set to, and what it keeps from turn to turn.

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};
use simworld_core::event::{Event, EventKind};
use simworld_core::id::EntityId;
use thiserror::Error;

use crate::thought::prompts::one_line;

/// The most messages that wait to be read.
const INBOX: usize = 16;
/// The most characters of a message that are read.
const MESSAGE: usize = 400;

/// How a [`ReactMind`](super::ReactMind) thinks.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ReactConfig {
    /// The most turns, 1 to 100 000.
    pub most_turns: u32,
    /// The tokens that its senses may take in a prompt, 50 to 100 000.
    pub tokens: usize,
    /// The memories that come to mind in a turn, 0 to 100.
    pub remembered: usize,
    /// The last turns that it is told of, 0 to 100.
    pub told_turns: usize,
    /// Time after which it thinks anew though its deed has not ended, s, 1 to 86 400.
    pub patience: f64,
    /// Turns in a row without a usable answer that it survives, 0 to 1000.
    pub faults: u32,
    /// The rest that it takes after such a turn, s, 0 to 3600.
    pub rest: f64,
}

impl Default for ReactConfig {
    fn default() -> Self {
        Self {
            most_turns: 40,
            tokens: 1500,
            remembered: 6,
            told_turns: 5,
            patience: 120.0,
            faults: 2,
            rest: 5.0,
        }
    }
}

/// A setting that no mind can work with.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{field} = {value} is out of range: give {allowed}")]
pub struct ReactConfigError {
    /// The setting.
    pub field: &'static str,
    /// Its value.
    pub value: f64,
    /// What is allowed.
    pub allowed: &'static str,
}

impl ReactConfig {
    /// Checks every field against its range; NaN is in none.
    ///
    /// # Errors
    /// The first field out of range.
    pub fn validate(&self) -> Result<(), ReactConfigError> {
        let checks = [
            ("most_turns", f64::from(self.most_turns), 1.0..=100_000.0, "1 to 100 000"),
            ("tokens", self.tokens as f64, 50.0..=100_000.0, "50 to 100 000"),
            ("remembered", self.remembered as f64, 0.0..=100.0, "0 to 100"),
            ("told_turns", self.told_turns as f64, 0.0..=100.0, "0 to 100"),
            ("patience", self.patience, 1.0..=86_400.0, "1 to 86 400 s"),
            ("faults", f64::from(self.faults), 0.0..=1000.0, "0 to 1000"),
            ("rest", self.rest, 0.0..=3600.0, "0 to 3600 s"),
        ];
        match checks.into_iter().find(|(_, value, range, _)| !range.contains(value)) {
            Some((field, value, _, allowed)) => Err(ReactConfigError { field, value, allowed }),
            None => Ok(()),
        }
    }
}

/// One turn: what was thought, what was done, and what came of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Turn {
    /// When, s of simulated time.
    pub at: f64,
    /// The thought.
    pub because: String,
    /// The deed, as a call.
    pub deed: String,
    /// What came of it; empty while it is under way.
    pub outcome: String,
}

/// Why a mind stopped thinking.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Ending {
    /// It says that its goal is reached.
    Reached {
        /// Why.
        why: String,
    },
    /// It says that its goal cannot be reached.
    Hopeless {
        /// Why.
        why: String,
    },
    /// It had all its turns.
    OutOfTurns,
    /// What it may spend on its model is spent.
    OutOfBudget {
        /// How much was left, and how much it would have taken.
        why: String,
    },
}

/// Everything that a snapshot holds, beside memory and mood.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct State {
    pub(super) turns: u32,
    /// Turns in a row without a usable answer.
    pub(super) faults: u32,
    /// Before this it does not think, s.
    pub(super) due: f64,
    /// Since when a deed is under way, s.
    pub(super) busy_since: Option<f64>,
    /// When events were felt last, s.
    pub(super) felt: f64,
    /// What was said to it and not yet read.
    pub(super) inbox: VecDeque<(EntityId, String)>,
    /// What happened since it decided last, to be felt and remembered at the next decision.
    pub(super) news: Vec<Event>,
    pub(super) log: VecDeque<Turn>,
    pub(super) ending: Option<Ending>,
}

impl State {
    /// Takes down what concerns `who`.
    pub(super) fn notice(&mut self, events: &[Event], who: EntityId) {
        for event in events {
            let outcome = match &event.kind {
                EventKind::PlanDone { who: actor } if *actor == who => "done".to_owned(),
                EventKind::PlanFailed { who: actor, reason } if *actor == who => format!("failed: {reason}"),
                EventKind::IntentRefused { who: actor, reason } if *actor == who => {
                    format!("refused: {reason}")
                }
                EventKind::Said { who: speaker, to, words } if *to == who => {
                    let words: String = one_line(words).chars().take(MESSAGE).collect();
                    self.inbox.push_back((*speaker, words));
                    if self.inbox.len() > INBOX {
                        self.inbox.pop_front();
                    }
                    self.news.push(event.clone());
                    continue;
                }
                EventKind::ActionFailed { who: actor, .. } if *actor == who => {
                    self.news.push(event.clone());
                    continue;
                }
                EventKind::Contact { a, b, .. } if *a == who || *b == who => {
                    self.news.push(event.clone());
                    continue;
                }
                _ => continue,
            };
            self.busy_since = None;
            if let Some(turn) = self.log.back_mut().filter(|turn| turn.outcome.is_empty()) {
                turn.outcome = one_line(&outcome);
            }
            self.news.push(event.clone());
        }
    }

    /// Whether it has something to think about now.
    pub(super) fn is_due(&self, now: f64, patience: f64) -> bool {
        let waits = self.busy_since.is_some_and(|since| now < since + patience);
        self.ending.is_none() && now >= self.due && (!waits || !self.inbox.is_empty())
    }

    /// The last turns in words, the newest last.
    pub(super) fn told(&self, most: usize) -> String {
        let line = |turn: &Turn| {
            let outcome = if turn.outcome.is_empty() { "under way" } else { &turn.outcome };
            format!("{:.0} s: {} → {} → {outcome}", turn.at, one_line(&turn.because), one_line(&turn.deed))
        };
        let skipped = self.log.len().saturating_sub(most);
        self.log.iter().skip(skipped).map(line).collect::<Vec<_>>().join("\n")
    }

    pub(super) fn messages(&self) -> String {
        let line = |(speaker, words): &(EntityId, String)| format!("{speaker}: {words:?}");
        self.inbox.iter().map(line).collect::<Vec<_>>().join("\n")
    }
}
