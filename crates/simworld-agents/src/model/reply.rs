//! What a model answers.

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::error::{ModelError, shortened};

/// The answer to a request.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ChatReply {
    /// What the model said; empty if it only calls.
    pub text: String,
    /// What it calls, in order.
    pub tool_calls: Vec<ToolCall>,
    /// What the answer took.
    pub usage: Usage,
    /// Why it ended.
    pub finish: Finish,
}

impl ChatReply {
    /// A whole answer of words that took nothing.
    pub fn of(text: impl Into<String>) -> Self {
        Self { text: text.into(), ..Self::default() }
    }

    /// The text as a value of the type that the request's schema describes.
    ///
    /// # Errors
    /// [`ModelError::Truncated`] if the answer reached its limit of tokens first, [`ModelError::Filtered`] if the server held
    /// it back, [`ModelError::BadReply`] if it is no such value.
    pub fn json<T: DeserializeOwned>(&self) -> Result<T, ModelError> {
        match self.finish {
            Finish::Length => return Err(ModelError::Truncated { got: self.text.len() }),
            Finish::Filter => return Err(ModelError::Filtered),
            Finish::Stop | Finish::ToolCalls | Finish::Other => {}
        }
        serde_json::from_str(&self.text).map_err(|error| ModelError::BadReply {
            reason: format!("the text is not what the schema asks for: {error}"),
            body: shortened(&self.text),
        })
    }
}

/// A tool that the model wants called.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ToolCall {
    /// By which its result is sent back.
    pub id: String,
    /// The tool's name, as the model gave it: it may be none of those offered.
    pub name: String,
    /// JSON as the model gave it; whether it fits the tool's schema is for the caller to check.
    pub arguments: Value,
}

/// Tokens that a request took.
///
/// Where a server does not say, they are reckoned: a token for every three bytes begun, more than text takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Usage {
    /// Of the request.
    pub prompt: u64,
    /// Of the answer.
    pub completion: u64,
}

impl Usage {
    /// Both together.
    pub fn total(self) -> u64 {
        self.prompt.saturating_add(self.completion)
    }

    /// This and another one.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self {
            prompt: self.prompt.saturating_add(other.prompt),
            completion: self.completion.saturating_add(other.completion),
        }
    }
}

/// Why an answer ended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Finish {
    /// It was complete, or came to a stop text.
    #[default]
    Stop,
    /// It reached its limit of tokens: the text is cut.
    Length,
    /// It wants tools called.
    ToolCalls,
    /// The server held it back.
    Filter,
    /// For a reason of the server's own.
    Other,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cut_answer_is_no_value_even_if_it_reads_as_one() {
        let mut reply = ChatReply::of("12");
        assert_eq!(reply.json::<u32>(), Ok(12));
        reply.finish = Finish::Length;
        assert_eq!(reply.json::<u32>(), Err(ModelError::Truncated { got: 2 }));
        reply.finish = Finish::Filter;
        assert_eq!(reply.json::<u32>(), Err(ModelError::Filtered));
    }

    #[test]
    fn an_answer_of_another_shape_says_where_it_differs() {
        let error = ChatReply::of("{\"step\": \"left\"}").json::<Vec<u8>>().unwrap_err();
        assert!(error.to_string().contains("line 1"), "{error}");
    }
}
