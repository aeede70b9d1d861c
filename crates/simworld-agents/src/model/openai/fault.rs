//! What went wrong, from statuses, headers and the HTTP library's errors.

use std::time::Duration;

use serde_json::Value;
use ureq::http::response::Parts;

use super::super::ModelError;
use super::super::error::shortened;
use super::answer;
use super::config::OpenAiConfig;
use crate::http::{self, ApiKey};

/// The error of a status that is not good, with the beginning of what the server says.
pub(super) fn of_status(
    head: &Parts,
    said: &[u8],
    key: Option<&ApiKey>,
    config: &OpenAiConfig,
) -> ModelError {
    let status = head.status.as_u16();
    let clean = |text: &str| key.map_or_else(|| text.to_owned(), |key| key.scrubbed(text));
    // The key goes first: a cut could leave half of it.
    let body = match serde_json::from_slice::<Value>(said) {
        Ok(value) => answer::said(&Value::String(clean(&message_of(&value)))),
        Err(_) => shortened(clean(&String::from_utf8_lossy(said)).trim()),
    };
    let retry_after = http::retry_after(&head.headers);
    match status {
        300..=399 => {
            let to = head.headers.get("location").and_then(|to| to.to_str().ok()).unwrap_or("nowhere");
            ModelError::Redirected { status, to: shortened(&clean(to)) }
        }
        401 | 403 => ModelError::Key { status, variable: config.key_variable.clone(), body },
        429 => ModelError::RateLimited { retry_after },
        408 | 500..=599 => ModelError::Server { status, retry_after, body },
        _ => ModelError::Refused { status, body },
    }
}

/// The error of a request that was not answered, or whose answer broke off after some bytes.
pub(super) fn of_transport(
    error: ureq::Error,
    got: Option<usize>,
    key: Option<&ApiKey>,
    config: &OpenAiConfig,
) -> ModelError {
    match error {
        ureq::Error::Timeout(phase) => {
            let connecting = matches!(phase, ureq::Timeout::Connect | ureq::Timeout::Resolve);
            let seconds = if connecting { config.connect_timeout } else { config.timeout };
            let phase =
                if connecting { "waiting for the connection" } else { "waiting for the whole answer" };
            ModelError::Timeout { phase: phase.into(), limit: Duration::from_secs_f64(seconds) }
        }
        ureq::Error::BodyExceedsLimit(limit) => ModelError::TooLarge { limit },
        ureq::Error::BadUri(_) | ureq::Error::Http(_) => {
            ModelError::Config(format!("base_url {}: {error}", config.base_url))
        }
        ureq::Error::Protocol(_) | ureq::Error::LargeResponseHeader(..) => {
            let reason = key.map_or_else(|| error.to_string(), |key| key.scrubbed(&error.to_string()));
            ModelError::BadReply { reason: format!("it is no HTTP: {reason}"), body: String::new() }
        }
        error => match got {
            Some(got) => broken(config, got, &error.to_string()),
            None => ModelError::Transport { url: config.base_url.clone(), reason: error.to_string() },
        },
    }
}

/// The error of an answer that broke off.
pub(super) fn broken(config: &OpenAiConfig, got: usize, reason: &str) -> ModelError {
    ModelError::Transport {
        url: config.base_url.clone(),
        reason: format!("the answer broke off after {got} bytes: {reason}"),
    }
}

fn message_of(value: &Value) -> String {
    let error = value.get("error").unwrap_or(value);
    let message = error.get("message").unwrap_or(error);
    message.as_str().map_or_else(|| message.to_string(), str::to_owned)
}
