//! Recordings: a run with a model replays exactly without it.
//!
//! A tape is a file of JSON lines: who asked, the key of the request, how often the same was asked before, and the answer
//! or the error. It holds no requests and no key. Each agent has its own order, so that what a replay gives does not depend
//! on which agent's thread was faster.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

use serde::{Deserialize, Serialize};

use super::lines::Lines;
use super::{ChatModel, ChatReply, ChatRequest, ModelError, RequestKey};

type Answer = Result<ChatReply, ModelError>;
/// Who asked what.
type Asked = (String, RequestKey);

/// What was recorded, and where what is new goes; agents share it.
pub struct Tape {
    reels: Mutex<BTreeMap<Asked, Reel>>,
    mode: Mode,
}

/// What one agent got for one request.
#[derive(Default)]
struct Reel {
    /// How often it was asked, since the tape was opened.
    asked: u64,
    /// What the file held.
    answers: Vec<Answer>,
}

enum Mode {
    Record(Lines),
    Replay,
    ReplayOrRecord(Lines),
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    agent: String,
    key: RequestKey,
    nth: u64,
    answer: Answer,
}

impl Tape {
    /// Records on a new file.
    ///
    /// # Errors
    /// [`ModelError::Store`] if the file is there already or cannot be made.
    pub fn record(path: &Path) -> Result<Self, ModelError> {
        Ok(Self { reels: Mutex::default(), mode: Mode::Record(Lines::create(path)?) })
    }

    /// Gives what a file holds, and [`ModelError::NotRecorded`] for everything else. No model is asked.
    ///
    /// # Errors
    /// [`ModelError::Store`] if the file cannot be read, with the line.
    pub fn replay(path: &Path) -> Result<Self, ModelError> {
        let reels = in_order(path, Lines::read(path)?)?;
        Ok(Self { reels: Mutex::new(reels), mode: Mode::Replay })
    }

    /// Gives what a file holds, and asks and records the rest. Failures are given as they were recorded, too.
    ///
    /// # Errors
    /// [`ModelError::Store`] if the file cannot be read or written.
    pub fn replay_or_record(path: &Path) -> Result<Self, ModelError> {
        let (entries, lines) = Lines::open(path)?;
        let reels = in_order(lines.path(), entries)?;
        Ok(Self { reels: Mutex::new(reels), mode: Mode::ReplayOrRecord(lines) })
    }

    /// How often that was asked before, and what the file has for it.
    fn next(&self, agent: &str, key: RequestKey) -> (u64, Option<Answer>) {
        let mut reels = self.reels.lock().unwrap_or_else(PoisonError::into_inner);
        let reel = reels.entry((agent.to_owned(), key)).or_default();
        let nth = reel.asked;
        reel.asked += 1;
        (nth, usize::try_from(nth).ok().and_then(|nth| reel.answers.get(nth).cloned()))
    }

    fn keep(&self, agent: &str, key: RequestKey, nth: u64, answer: &Answer) -> Result<(), ModelError> {
        match &self.mode {
            Mode::Record(lines) | Mode::ReplayOrRecord(lines) => {
                lines.append(&Entry { agent: agent.to_owned(), key, nth, answer: answer.clone() })
            }
            Mode::Replay => Ok(()),
        }
    }
}

fn in_order(path: &Path, entries: Vec<Entry>) -> Result<BTreeMap<Asked, Reel>, ModelError> {
    let mut reels: BTreeMap<Asked, Reel> = BTreeMap::new();
    for entry in entries {
        let known = &mut reels.entry((entry.agent, entry.key)).or_default().answers;
        if known.len() as u64 != entry.nth {
            return Err(ModelError::Store {
                path: path.display().to_string(),
                reason: format!(
                    "answer number {} to the request {} stands where number {} belongs: the file was put together from \
                     several; replay each alone",
                    entry.nth,
                    entry.key,
                    known.len()
                ),
            });
        }
        known.push(entry.answer);
    }
    Ok(reels)
}

/// One agent's model on a [`Tape`].
///
/// A replayed stream of text comes in one piece.
pub struct Recorded<M> {
    inner: M,
    agent: String,
    tape: Arc<Tape>,
}

impl<M: ChatModel> Recorded<M> {
    /// Records or replays an agent; its name must be its own on this tape, and the same in a replay.
    pub fn new(inner: M, agent: impl Into<String>, tape: Arc<Tape>) -> Self {
        Self { inner, agent: agent.into(), tape }
    }

    fn taped(&mut self, request: &ChatRequest, ask: impl FnOnce(&mut M) -> Answer) -> (Answer, Source) {
        let key = request.key();
        let (nth, recorded) = self.tape.next(&self.agent, key);
        if let Some(answer) = recorded {
            return (answer, Source::Tape);
        }
        if matches!(self.tape.mode, Mode::Replay) {
            let error = ModelError::NotRecorded { agent: self.agent.clone(), key, nth };
            return (Err(error), Source::Tape);
        }
        let answer = ask(&mut self.inner);
        match self.tape.keep(&self.agent, key, nth, &answer) {
            Ok(()) => (answer, Source::Model),
            Err(error) => (Err(error), Source::Model),
        }
    }
}

/// Where an answer came from.
enum Source {
    Tape,
    Model,
}

impl<M: ChatModel> ChatModel for Recorded<M> {
    fn chat(&mut self, request: &ChatRequest) -> Result<ChatReply, ModelError> {
        self.taped(request, |inner| inner.chat(request)).0
    }

    fn chat_streamed(
        &mut self,
        request: &ChatRequest,
        piece: &mut dyn FnMut(&str),
    ) -> Result<ChatReply, ModelError> {
        let (answer, source) = self.taped(request, |inner| inner.chat_streamed(request, piece));
        if let (Ok(reply), Source::Tape) = (&answer, source)
            && !reply.text.is_empty()
        {
            piece(&reply.text);
        }
        answer
    }
}

/// The model of a replay: nobody.
///
/// [`Recorded`] over [`Tape::replay`] never asks it; alone it answers every request with an error.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoModel;

impl ChatModel for NoModel {
    fn chat(&mut self, _: &ChatRequest) -> Result<ChatReply, ModelError> {
        Err(ModelError::Config("there is no model here: replay a tape, or name a server".into()))
    }
}
