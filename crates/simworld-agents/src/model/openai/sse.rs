//! Answers that come as a stream of events (`text/event-stream`): any bytes, cut anywhere, give a reply or an error.

use std::collections::BTreeMap;

use serde::Deserialize;
use serde_json::Value;

use super::super::error::shortened;
use super::super::{ChatReply, ChatRequest, ModelError};
use super::answer::{self, WireUsage};

#[derive(Deserialize)]
struct Chunk {
    #[serde(default)]
    choices: Vec<Choice>,
    #[serde(default)]
    usage: Option<WireUsage>,
    #[serde(default)]
    error: Option<Value>,
}

#[derive(Deserialize)]
struct Choice {
    #[serde(default)]
    delta: Delta,
    #[serde(default)]
    finish_reason: Option<String>,
}

#[derive(Default, Deserialize)]
struct Delta {
    #[serde(default)]
    content: Option<String>,
    #[serde(default)]
    tool_calls: Option<Vec<CallPiece>>,
}

#[derive(Deserialize)]
struct CallPiece {
    #[serde(default)]
    index: u64,
    #[serde(default)]
    id: Option<String>,
    #[serde(default)]
    function: FunctionPiece,
}

#[derive(Default, Deserialize)]
struct FunctionPiece {
    #[serde(default)]
    name: Option<String>,
    #[serde(default)]
    arguments: Option<String>,
}

/// Whether more is to come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum State {
    Open,
    Done,
}

/// What has come of a stream.
#[derive(Default)]
pub(super) struct Stream {
    line: Vec<u8>,
    data: String,
    received: usize,
    text: String,
    calls: BTreeMap<u64, Call>,
    usage: Option<WireUsage>,
    finish: Option<String>,
}

#[derive(Default)]
struct Call {
    id: String,
    name: String,
    arguments: String,
}

impl Stream {
    /// Takes the next bytes; hands over the text that they complete.
    pub(super) fn push(&mut self, bytes: &[u8], piece: &mut dyn FnMut(&str)) -> Result<State, ModelError> {
        self.received += bytes.len();
        for byte in bytes {
            match byte {
                b'\n' => {
                    let line = std::mem::take(&mut self.line);
                    let line = line.strip_suffix(b"\r").unwrap_or(&line);
                    if self.line_ended(line, piece)? == State::Done {
                        return Ok(State::Done);
                    }
                }
                _ => self.line.push(*byte),
            }
        }
        Ok(State::Open)
    }

    /// Whether the reply said why it ended; servers that close without `[DONE]` did all the same.
    pub(super) fn is_whole(&self) -> bool {
        self.finish.is_some()
    }

    /// The bytes that came.
    pub(super) fn received(&self) -> usize {
        self.received
    }

    pub(super) fn into_reply(self, request: &ChatRequest) -> Result<ChatReply, ModelError> {
        let finish = answer::finish_of(self.finish.as_deref());
        let mut tool_calls = Vec::new();
        for (index, call) in self.calls.into_values().enumerate() {
            let body = shortened(&call.arguments);
            let call = answer::tool_call(index, call.id, call.name, Value::String(call.arguments), finish)
                .map_err(|reason| ModelError::BadReply { reason, body })?;
            tool_calls.push(call);
        }
        let usage = answer::usage_of(self.usage, request, &self.text, &tool_calls);
        Ok(ChatReply { text: self.text, tool_calls, usage, finish })
    }

    fn line_ended(&mut self, line: &[u8], piece: &mut dyn FnMut(&str)) -> Result<State, ModelError> {
        if line.is_empty() {
            let data = std::mem::take(&mut self.data);
            return self.event(data.trim(), piece);
        }
        // other fields (event, id, retry) and comments say nothing about the reply
        if let Some(data) = line.strip_prefix(b"data:") {
            if !self.data.is_empty() {
                self.data.push('\n');
            }
            self.data.push_str(&String::from_utf8_lossy(data));
        }
        Ok(State::Open)
    }

    fn event(&mut self, data: &str, piece: &mut dyn FnMut(&str)) -> Result<State, ModelError> {
        if data.is_empty() {
            return Ok(State::Open);
        }
        if data == "[DONE]" {
            return Ok(State::Done);
        }
        let chunk: Chunk = serde_json::from_str(data).map_err(|error| ModelError::BadReply {
            reason: format!("an event of the stream: {error}"),
            body: shortened(data),
        })?;
        if let Some(error) = chunk.error {
            let code = error.get("code").and_then(Value::as_u64).filter(|code| (500..600).contains(code));
            let status = code.and_then(|code| u16::try_from(code).ok()).unwrap_or(500);
            return Err(ModelError::Server { status, retry_after: None, body: answer::said(&error) });
        }
        self.usage = chunk.usage.or(self.usage);
        if let Some(choice) = chunk.choices.into_iter().next() {
            self.finish = choice.finish_reason.or(self.finish.take());
            if let Some(text) = choice.delta.content.filter(|text| !text.is_empty()) {
                self.text.push_str(&text);
                piece(&text);
            }
            for part in choice.delta.tool_calls.unwrap_or_default() {
                let call = self.calls.entry(part.index).or_default();
                call.id.push_str(part.id.as_deref().unwrap_or_default());
                call.name.push_str(part.function.name.as_deref().unwrap_or_default());
                call.arguments.push_str(part.function.arguments.as_deref().unwrap_or_default());
            }
        }
        Ok(State::Open)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::super::{Finish, Message};
    use super::*;

    const WHOLE: &str = ": a comment\n\n\
        data: {\"choices\":[{\"delta\":{\"role\":\"assistant\",\"content\":\"\"}}]}\n\n\
        data: {\"choices\":[{\"delta\":{\"content\":\"Gr\u{fc}\"}}]}\r\n\r\n\
        event: x\ndata: {\"choices\":[{\"delta\":\ndata: {\"content\":\"n\"}}]}\n\n\
        data: {\"choices\":[{\"delta\":{\"tool_calls\":[{\"index\":0,\"id\":\"a\",\"function\":{\"name\":\"go\",\"arguments\":\"{\\\"to\"}}]}}]}\n\n\
        data: {\"choices\":[{\"delta\":{\"tool_calls\":[{\"index\":0,\"function\":{\"arguments\":\"\\\":1}\"}}]},\"finish_reason\":\"tool_calls\"}]}\n\n\
        data: {\"choices\":[],\"usage\":{\"prompt_tokens\":3,\"completion_tokens\":4}}\n\n\
        data: [DONE]\n\n";

    fn read(pieces: &[&[u8]]) -> (Result<State, ModelError>, Stream, String) {
        let mut stream = Stream::default();
        let mut heard = String::new();
        let mut state = Ok(State::Open);
        for bytes in pieces {
            if state == Ok(State::Open) {
                state = stream.push(bytes, &mut |text| heard.push_str(text));
            }
        }
        (state, stream, heard)
    }

    #[test]
    fn a_stream_reads_the_same_wherever_it_is_cut() {
        for cut in 0..=WHOLE.len() {
            let (first, second) = WHOLE.as_bytes().split_at(cut);
            let (state, stream, heard) = read(&[first, second]);
            assert_eq!(state, Ok(State::Done), "cut at {cut}");
            let reply = stream.into_reply(&ChatRequest::new([Message::user("?")])).unwrap();
            assert_eq!((reply.text.as_str(), heard.as_str()), ("Gr\u{fc}n", "Gr\u{fc}n"));
            assert_eq!(reply.tool_calls[0].arguments, serde_json::json!({"to": 1}));
            assert_eq!((reply.usage.total(), reply.finish), (7, Finish::ToolCalls));
        }
    }

    #[test]
    fn a_stream_that_ends_before_it_says_why_is_not_whole() {
        let end = WHOLE.find("\"finish_reason\"").unwrap();
        let (state, stream, _) = read(&[&WHOLE.as_bytes()[..end]]);
        assert_eq!(state, Ok(State::Open));
        assert!(!stream.is_whole());
        assert_eq!(stream.received(), end);
    }

    #[test]
    fn failures_within_a_stream_are_errors() {
        let (state, ..) = read(&[b"data: {\"error\":{\"message\":\"no memory\",\"code\":503}}\n\n"]);
        assert_eq!(
            state,
            Err(ModelError::Server { status: 503, retry_after: None, body: "no memory".into() })
        );
        let (state, ..) = read(&[b"data: {\"choices\":5}\n\n"]);
        assert!(matches!(state, Err(ModelError::BadReply { .. })), "{state:?}");
    }

    proptest! {
        #[test]
        fn any_events_are_read_or_refused(
            events in prop::collection::vec("data: ?[ -~\u{e4}]{0,40}\r?\n{1,2}", 0..8),
            cut in 0usize..200,
        ) {
            let whole = events.concat().into_bytes();
            let (first, second) = whole.split_at(cut.min(whole.len()));
            let (in_two, stream, _) = read(&[first, second]);
            let (at_once, ..) = read(&[&whole]);
            prop_assert_eq!(&in_two, &at_once);
            if in_two.is_ok() {
                let _ = stream.into_reply(&ChatRequest::default());
            }
        }

        #[test]
        fn any_bytes_are_read_or_refused(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
            let (state, stream, _) = read(&[&bytes]);
            if state.is_ok() {
                let _ = stream.into_reply(&ChatRequest::default());
            }
        }
    }
}
