//! Answers: `ok`, a text, bytes, or `error` and why.

use std::fmt::Write;

use thiserror::Error;

use crate::remote::StageError;
use crate::remote::engine::Refused;

/// What a command led to.
pub(super) enum Said {
    /// It was done.
    Done,
    /// An answer in words.
    Text(String),
    /// An answer in bytes.
    Bytes(Vec<u8>),
    /// It is done when so many steps have passed.
    After(u32),
}

/// Why a command was not done. The words are those of the original where it has some.
#[derive(Debug, Error)]
pub(super) enum Failed {
    #[error("Can not find a handler for URI '{0}'")]
    NoHandler(String),
    #[error("Argument Invalid: give {0}")]
    Arguments(&'static str),
    #[error("Argument Invalid: {0}")]
    Value(String),
    #[error("Can not find object: {0}")]
    NoObject(String),
    #[error("Can not find a class with name '{0}'")]
    NoClass(String),
    #[error("Failed to spawn {0}, object exsit.")]
    Exists(String),
    #[error("Renaming an object to overwrite an existing object is not allowed, {0}")]
    Overwrites(String),
    #[error("this has no counterpart here: {0}")]
    NoCounterpart(&'static str),
    #[error("{0} has no counterpart here")]
    Unsupported(String),
    #[error("{0}")]
    State(String),
    #[error("Unrecognized alias {0}")]
    Alias(String),
    #[error(transparent)]
    Refused(#[from] Refused),
}

impl Failed {
    /// Whether a body or the world refused, rather than the line.
    pub(super) fn is_refusal(&self) -> bool {
        matches!(self, Self::Refused(Refused::Stage(StageError::Command(_))) | Self::State(_))
    }
}

pub(super) type Answered = Result<Said, Failed>;

/// The payload of an answer to the request of that number.
pub(super) fn payload(number: &str, answered: Answered) -> Vec<u8> {
    let mut payload = number.as_bytes().to_vec();
    payload.push(b':');
    match answered {
        Ok(Said::Done | Said::After(_)) => payload.extend(b"ok"),
        Ok(Said::Text(text)) => payload.extend(text.as_bytes()),
        Ok(Said::Bytes(bytes)) => payload.extend(bytes),
        Err(failed) => payload.extend(format!("error {failed}").as_bytes()),
    }
    payload
}

/// Numbers with three decimals and blanks between them.
pub(super) fn numbers(values: &[f64]) -> Said {
    let mut text = String::new();
    for value in values {
        let gap = if text.is_empty() { "" } else { " " };
        // Writing to a string cannot fail; a negative zero reads as zero.
        let _ = write!(text, "{gap}{:.3}", value + 0.0);
    }
    Said::Text(text)
}

/// Whether something could be done, as the release's client reads it: a word in JSON, not a boolean.
pub(super) fn success(answered: Result<(), Failed>) -> Answered {
    match answered {
        Ok(()) => Ok(Said::Text(r#"{"Success":"true"}"#.to_owned())),
        Err(failed) if failed.is_refusal() => {
            let reason = serde_json::Value::String(failed.to_string());
            Ok(Said::Text(format!(r#"{{"Success":"false","Reason":{reason}}}"#)))
        }
        Err(failed) => Err(failed),
    }
}
