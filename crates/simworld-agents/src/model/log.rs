//! A log of what was asked and answered, as JSON lines.

use std::path::Path;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::lines::Lines;
use super::{ChatModel, ChatReply, ChatRequest, Clock, ModelError, RequestKey};

/// A line of the log. It holds no request, only hashes: pictures are large, and prompts stand in the recording of the world.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LogLine {
    /// Who asked.
    pub agent: String,
    /// How often it asked before.
    pub nth: u64,
    /// The hash of the whole request.
    pub request: RequestKey,
    /// The hash of its messages.
    pub prompt: RequestKey,
    /// The answer with its usage, or the error.
    pub answer: Result<ChatReply, ModelError>,
    /// From asking to the answer, s.
    pub latency: f64,
}

/// A file of [`LogLine`]s that agents share.
pub struct ModelLog {
    lines: Lines,
}

impl ModelLog {
    /// A new file.
    ///
    /// # Errors
    /// [`ModelError::Store`] if it is there already or cannot be made.
    pub fn create(path: &Path) -> Result<Self, ModelError> {
        Ok(Self { lines: Lines::create(path)? })
    }

    /// The lines of a file.
    ///
    /// # Errors
    /// [`ModelError::Store`] if it cannot be read, with the line.
    pub fn read(path: &Path) -> Result<Vec<LogLine>, ModelError> {
        Lines::read(path)
    }
}

/// Logs what one agent asks.
pub struct Logged<M> {
    inner: M,
    agent: String,
    nth: u64,
    log: Arc<ModelLog>,
    clock: Arc<dyn Clock>,
}

impl<M: ChatModel> Logged<M> {
    /// Asks `inner` and logs it; latencies are the clock's.
    pub fn new(inner: M, agent: impl Into<String>, log: Arc<ModelLog>, clock: Arc<dyn Clock>) -> Self {
        Self { inner, agent: agent.into(), nth: 0, log, clock }
    }

    fn logged(
        &mut self,
        request: &ChatRequest,
        ask: impl FnOnce(&mut M) -> Result<ChatReply, ModelError>,
    ) -> Result<ChatReply, ModelError> {
        let start = self.clock.now();
        let answer = ask(&mut self.inner);
        let line = LogLine {
            agent: self.agent.clone(),
            nth: self.nth,
            request: request.key(),
            prompt: request.prompt_key(),
            answer,
            latency: self.clock.now().saturating_sub(start).as_secs_f64(),
        };
        self.nth += 1;
        self.log.lines.append(&line)?;
        line.answer
    }
}

impl<M: ChatModel> ChatModel for Logged<M> {
    fn chat(&mut self, request: &ChatRequest) -> Result<ChatReply, ModelError> {
        self.logged(request, |inner| inner.chat(request))
    }

    fn chat_streamed(
        &mut self,
        request: &ChatRequest,
        piece: &mut dyn FnMut(&str),
    ) -> Result<ChatReply, ModelError> {
        self.logged(request, |inner| inner.chat_streamed(request, piece))
    }
}
