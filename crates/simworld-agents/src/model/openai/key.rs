//! The key is taken out of whatever a server echoes.

use std::sync::Arc;

use serde_json::Value;

use super::super::{ChatReply, ModelError};
use crate::http::ApiKey;

/// Takes the key out of everything that a reply holds.
pub(super) fn scrub_reply(key: &ApiKey, reply: &mut ChatReply) {
    reply.text = key.scrubbed(&reply.text);
    for call in &mut reply.tool_calls {
        call.id = key.scrubbed(&call.id);
        call.name = key.scrubbed(&call.name);
        scrub_value(key, &mut call.arguments);
    }
}

fn scrub_value(key: &ApiKey, value: &mut Value) {
    match value {
        Value::String(text) => *text = key.scrubbed(text),
        Value::Array(items) => items.iter_mut().for_each(|item| scrub_value(key, item)),
        Value::Object(members) => {
            *members = std::mem::take(members)
                .into_iter()
                .map(|(name, mut value)| {
                    scrub_value(key, &mut value);
                    (key.scrubbed(&name), value)
                })
                .collect();
        }
        Value::Null | Value::Bool(_) | Value::Number(_) => {}
    }
}

/// The error without the key in what it quotes.
pub(super) fn scrub_error(error: ModelError, key: Option<&ApiKey>) -> ModelError {
    let Some(key) = key else { return error };
    match error {
        ModelError::BadReply { reason, body } => {
            ModelError::BadReply { reason: key.scrubbed(&reason), body: key.scrubbed(&body) }
        }
        ModelError::Server { status, retry_after, body } => {
            ModelError::Server { status, retry_after, body: key.scrubbed(&body) }
        }
        ModelError::Transport { url, reason } => ModelError::Transport { url, reason: key.scrubbed(&reason) },
        other => other,
    }
}

/// Hands on text that comes in pieces without the key, even where it is cut between two.
pub(super) struct Scrubber {
    key: Option<Arc<ApiKey>>,
    held: String,
}

impl Scrubber {
    pub(super) fn new(key: Option<Arc<ApiKey>>) -> Self {
        Self { key, held: String::new() }
    }

    pub(super) fn push(&mut self, text: &str, out: &mut dyn FnMut(&str)) {
        let Some(key) = &self.key else { return out(text) };
        self.held.push_str(text);
        let clean = key.scrubbed(&self.held);
        // Keep back what may be the beginning of a key.
        let kept = key
            .writings()
            .into_iter()
            .filter_map(|whole| {
                (1..whole.len().min(clean.len() + 1)).rev().find(|count| clean.ends_with(&whole[..*count]))
            })
            .max()
            .unwrap_or(0);
        let (ready, held) = clean.split_at(clean.len() - kept);
        if !ready.is_empty() {
            out(ready);
        }
        let held = held.to_owned();
        self.held = held;
    }

    pub(super) fn end(&mut self, out: &mut dyn FnMut(&str)) {
        if !self.held.is_empty() {
            out(&std::mem::take(&mut self.held));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const KEY: &str = "sk-ab/ab-secret";

    #[test]
    fn a_key_is_found_wherever_a_stream_is_cut() {
        let whole = format!("sk-ab{KEY}, sk-ab\\/ab-secret sk-ab/");
        for first in 0..=whole.len() {
            for second in first..=whole.len() {
                let mut scrubber = Scrubber::new(ApiKey::new(KEY).map(Arc::new));
                let mut heard = String::new();
                for piece in [&whole[..first], &whole[first..second], &whole[second..]] {
                    scrubber.push(piece, &mut |text| heard.push_str(text));
                }
                scrubber.end(&mut |text| heard.push_str(text));
                assert_eq!(heard, "sk-ab[key], [key] sk-ab/", "cut at {first} and {second}");
            }
        }
    }

    #[test]
    fn arguments_are_scrubbed_to_the_bottom() {
        let mut reply = ChatReply::of(KEY);
        reply.tool_calls.push(super::super::super::ToolCall {
            id: KEY.into(),
            name: KEY.into(),
            arguments: serde_json::json!({"a": [{KEY: KEY}]}),
        });
        scrub_reply(&ApiKey::new(KEY).unwrap(), &mut reply);
        assert!(!serde_json::to_string(&reply).unwrap().contains("secret"));
    }
}
