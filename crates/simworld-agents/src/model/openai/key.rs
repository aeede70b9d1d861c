//! The key: held where nothing prints it, and taken out of whatever a server echoes.

use std::sync::Arc;

use serde_json::Value;

use super::super::{ChatReply, ModelError};

/// What stands where a key stood.
const HIDDEN: &str = "[key]";

/// Shorter ones would be found in ordinary words.
const SHORTEST: usize = 8;

/// A key. It is not `Clone`, `Serialize` or `Display`, and its `Debug` prints nothing of it.
pub(super) struct ApiKey {
    key: String,
    /// As JSON may write it.
    escaped: String,
    stand_in: String,
}

impl ApiKey {
    pub(super) fn from_variable(variable: &str) -> Result<Self, ModelError> {
        let missing = || ModelError::NoKey { variable: variable.to_owned() };
        let key = std::env::var(variable).map_err(|_| missing())?;
        Self::new(key.trim()).ok_or_else(missing)
    }

    pub(super) fn new(key: &str) -> Option<Self> {
        (key.len() >= SHORTEST && key.bytes().all(|byte| byte.is_ascii_graphic())).then(|| Self {
            key: key.to_owned(),
            escaped: key.replace('/', "\\/"),
            stand_in: format!("Bearer {}", "*".repeat(key.len())),
        })
    }

    /// The header's value with stars in place of the key; the transport puts the key in, behind every log.
    pub(super) fn stand_in(&self) -> &str {
        &self.stand_in
    }

    /// The key itself, for the transport alone.
    pub(super) fn revealed(&self) -> &[u8] {
        self.key.as_bytes()
    }

    /// The text without the key.
    pub(super) fn scrubbed(&self, text: &str) -> String {
        text.replace(&self.key, HIDDEN).replace(&self.escaped, HIDDEN)
    }

    /// Takes the key out of everything that a reply holds.
    pub(super) fn scrub_reply(&self, reply: &mut ChatReply) {
        reply.text = self.scrubbed(&reply.text);
        for call in &mut reply.tool_calls {
            call.id = self.scrubbed(&call.id);
            call.name = self.scrubbed(&call.name);
            self.scrub_value(&mut call.arguments);
        }
    }

    fn scrub_value(&self, value: &mut Value) {
        match value {
            Value::String(text) => *text = self.scrubbed(text),
            Value::Array(items) => items.iter_mut().for_each(|item| self.scrub_value(item)),
            Value::Object(members) => {
                *members = std::mem::take(members)
                    .into_iter()
                    .map(|(name, mut value)| {
                        self.scrub_value(&mut value);
                        (self.scrubbed(&name), value)
                    })
                    .collect();
            }
            Value::Null | Value::Bool(_) | Value::Number(_) => {}
        }
    }
}

impl std::fmt::Debug for ApiKey {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("ApiKey")
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
        let kept = [&key.key, &key.escaped]
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
    fn only_one_line_of_visible_ascii_is_a_key() {
        for wrong in ["", "short", "with space in it", "two\nlines\nhere", "schlüssel-geheim"] {
            assert!(ApiKey::new(wrong).is_none(), "{wrong:?}");
        }
        let key = ApiKey::new(KEY).unwrap();
        assert_eq!(format!("{key:?}"), "ApiKey");
        assert_eq!(key.stand_in().len(), "Bearer ".len() + KEY.len());
    }

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
        ApiKey::new(KEY).unwrap().scrub_reply(&mut reply);
        assert!(!serde_json::to_string(&reply).unwrap().contains("secret"));
    }
}
