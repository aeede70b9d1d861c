//! Why there is no answer, and how to mend it.

use std::time::Duration;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::key::RequestKey;

/// The most bytes of a server's answer that an error keeps.
const KEPT: usize = 400;

/// Why a model gave no answer. No variant ever holds a key.
#[derive(Clone, Debug, PartialEq, Eq, Error, Serialize, Deserialize)]
#[non_exhaustive]
pub enum ModelError {
    /// The server was not reached, or the connection broke.
    #[error(
        "no connection to the model's server at {url}: {reason}; is it running, and is the address right?"
    )]
    Transport {
        /// Its address.
        url: String,
        /// What the system says.
        reason: String,
    },
    /// The answer did not come in time.
    #[error("the model did not answer within {} s ({phase}): allow more time, or ask for fewer tokens", limit.as_secs_f64())]
    Timeout {
        /// What was waited for.
        phase: String,
        /// How long.
        limit: Duration,
    },
    /// Too many requests (status 429).
    #[error("the model's server wants fewer requests{}: pace them, or ask for a higher limit", after(*retry_after))]
    RateLimited {
        /// How long the server wants to be left alone, if it says.
        retry_after: Option<Duration>,
    },
    /// The server failed (status 5xx).
    #[error("the model's server failed with status {status}{}: {body}", after(*retry_after))]
    Server {
        /// The status.
        status: u16,
        /// How long the server wants to be left alone, if it says.
        retry_after: Option<Duration>,
        /// The beginning of what it says.
        body: String,
    },
    /// The key is missing or wrong (status 401 or 403).
    #[error(
        "the model's server does not accept the key (status {status}): {body}; {}",
        match variable {
            Some(name) => format!("put a valid one into the environment variable {name}"),
            None => "name the environment variable that holds one in the configuration".into(),
        }
    )]
    Key {
        /// The status.
        status: u16,
        /// The environment variable that the key was taken from, if any.
        variable: Option<String>,
        /// The beginning of what the server says.
        body: String,
    },
    /// The environment variable that shall hold the key does not.
    #[error(
        "the environment variable {variable} holds no key: set it to one line of at least 8 visible ASCII characters, \
         or name no variable in the configuration"
    )]
    NoKey {
        /// Its name.
        variable: String,
    },
    /// The server does not take the request (another status of 4xx).
    #[error(
        "the model's server refuses the request with status {status}: {body}; does the model know what is asked of it?"
    )]
    Refused {
        /// The status.
        status: u16,
        /// The beginning of what it says.
        body: String,
    },
    /// The server sends to another address; a key is never carried there.
    #[error(
        "the model's server sends to {to} (status {status}): put that address into the configuration if you trust it"
    )]
    Redirected {
        /// The status.
        status: u16,
        /// Where to.
        to: String,
    },
    /// An answer that is not one.
    #[error("the model's answer cannot be read: {reason}; it begins with {body:?}")]
    BadReply {
        /// What is wrong with it.
        reason: String,
        /// Its beginning.
        body: String,
    },
    /// An answer that ended before it was complete.
    #[error(
        "the model's answer ended after {got} bytes before it was complete: allow more tokens, or ask again"
    )]
    Truncated {
        /// The bytes of text that came.
        got: usize,
    },
    /// The server held the answer back.
    #[error("the model's server held the answer back for what it says: ask otherwise")]
    Filtered,
    /// An answer larger than allowed.
    #[error("the model's answer is larger than {limit} bytes: ask for fewer tokens, or raise the limit")]
    TooLarge {
        /// The limit in bytes.
        limit: u64,
    },
    /// The request could exceed a budget; it was not sent.
    #[error(
        "the request could cost {needed} of the {left} that {whose} has left: raise the budget, or ask for fewer tokens"
    )]
    Budget {
        /// Whose budget.
        whose: String,
        /// The most that the request could take.
        needed: u64,
        /// What is left.
        left: u64,
        /// Of what: micro-cents or tokens.
        unit: String,
    },
    /// Nothing is known of what the model costs.
    #[error("the model {model:?} has no price: add one to the prices, zero if it is your own")]
    NoPrice {
        /// Its name.
        model: String,
    },
    /// A recording does not hold the request.
    #[error(
        "the recording holds no answer number {nth} of {agent} to the request {key}: record the run again, or replay what was recorded"
    )]
    NotRecorded {
        /// Who asks.
        agent: String,
        /// The request.
        key: RequestKey,
        /// How often this agent asked the same before.
        nth: u64,
    },
    /// A recording or a log cannot be read or written.
    #[error("{path}: {reason}")]
    Store {
        /// The file, and where in it.
        path: String,
        /// What is wrong, and how to mend it.
        reason: String,
    },
    /// A request that no server could answer; it was not sent.
    #[error("the request cannot be sent: {0}")]
    Request(String),
    /// A configuration that cannot work.
    #[error("the model's configuration: {0}")]
    Config(String),
    /// A script came to its end.
    #[error("the script has no answer number {asked}: give it more answers")]
    ScriptEnded {
        /// How often it was asked before.
        asked: usize,
    },
}

impl ModelError {
    /// Whether the same request may well be answered if it is sent again.
    pub fn is_passing(&self) -> bool {
        matches!(
            self,
            Self::Transport { .. } | Self::Timeout { .. } | Self::RateLimited { .. } | Self::Server { .. }
        )
    }

    /// How long the server wants to be left alone, if it says.
    pub fn retry_after(&self) -> Option<Duration> {
        match self {
            Self::RateLimited { retry_after } | Self::Server { retry_after, .. } => *retry_after,
            _ => None,
        }
    }
}

/// The beginning of a text, cut between characters.
pub(super) fn shortened(text: &str) -> String {
    if text.len() <= KEPT {
        return text.to_owned();
    }
    format!("{}...", &text[..text.floor_char_boundary(KEPT)])
}

fn after(retry_after: Option<Duration>) -> String {
    retry_after.map_or_else(String::new, |wait| format!(" (again after {} s)", wait.as_secs_f64()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_texts_are_cut_between_characters() {
        let text = "é".repeat(300);
        let short = shortened(&text);
        assert_eq!(short.chars().filter(|c| *c == 'é').count(), 200);
        assert!(short.ends_with("..."));
        assert_eq!(shortened("whole"), "whole");
    }

    #[test]
    fn errors_read_back_as_they_were() {
        let error = ModelError::Server {
            status: 503,
            retry_after: Some(Duration::from_millis(1500)),
            body: "x".into(),
        };
        let text = serde_json::to_string(&error).unwrap();
        assert_eq!(serde_json::from_str::<ModelError>(&text).unwrap(), error);
        assert!(error.to_string().contains("again after 1.5 s"), "{error}");
    }
}
