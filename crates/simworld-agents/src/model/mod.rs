//! Language and vision models: one trait, [`ChatModel`], and what stands behind it.
//!
//! A model answers a [`ChatRequest`] with a [`ChatReply`] or a [`ModelError`] that says what went wrong and how to mend it.
//! Models are outside the simulation: what an agent makes of an answer enters the world as an intent, and is recorded
//! there. Requests and replies are kept as JSON (they hold schemas and arguments of any shape); they are no part of a
//! snapshot.

mod clock;
mod error;
mod key;
mod ledger;
mod lines;
mod log;
mod meter;
mod models;
#[cfg(feature = "http")]
mod openai;
mod pace;
mod reckon;
mod reply;
mod request;
mod retry;
mod scripted;
mod tape;

pub use clock::{Clock, ManualClock, WallClock};
pub use error::ModelError;
pub use key::RequestKey;
pub use ledger::{Account, Budget, Ledger, MicroCents, Price};
pub use log::{LogLine, Logged, ModelLog};
pub use meter::{Metered, Tariff, Unpriced};
pub use models::{Models, ModelsConfig};
#[cfg(feature = "http")]
pub use openai::{LimitField, OpenAiChat, OpenAiConfig, PlainKey, SchemaMode, StreamUsage};
pub use pace::{Pace, Paced};
pub use reply::{ChatReply, Finish, ToolCall, Usage};
pub use request::{ChatRequest, Image, Message, Part, Role, Schema, Tool, ToolChoice};
#[cfg(all(feature = "assets", feature = "http"))]
pub(crate) use retry::Attempts;
pub use retry::{Retried, RetryConfig};
pub use scripted::Scripted;
pub use tape::{NoModel, Recorded, Tape};

/// Answers chat requests: a server, a script, a recording, or another model behind a wrapper.
///
/// ```
/// use simworld_agents::model::{ChatModel, ChatRequest, Message, Scripted};
/// let mut model = Scripted::texts(["Go to the bench."]);
/// let reply = model.chat(&ChatRequest::new([Message::user("What now?")]))?;
/// assert_eq!(reply.text, "Go to the bench.");
/// # Ok::<(), simworld_agents::model::ModelError>(())
/// ```
pub trait ChatModel: Send {
    /// Asks, and waits for the whole answer.
    ///
    /// # Errors
    /// There is no answer, or none that can be read; see [`ModelError`].
    fn chat(&mut self, request: &ChatRequest) -> Result<ChatReply, ModelError>;

    /// Asks, and hands over the text piece by piece while it comes; the pieces together are the reply's text.
    ///
    /// By default there is one piece, at the end.
    ///
    /// # Errors
    /// As [`chat`](Self::chat); pieces handed over before belong to no reply then.
    fn chat_streamed(
        &mut self,
        request: &ChatRequest,
        piece: &mut dyn FnMut(&str),
    ) -> Result<ChatReply, ModelError> {
        let reply = self.chat(request)?;
        if !reply.text.is_empty() {
            piece(&reply.text);
        }
        Ok(reply)
    }
}

macro_rules! forward_model {
    ($($target:ty),+) => {
        $(impl<M: ChatModel + ?Sized> ChatModel for $target {
            fn chat(&mut self, request: &ChatRequest) -> Result<ChatReply, ModelError> {
                (**self).chat(request)
            }

            fn chat_streamed(
                &mut self,
                request: &ChatRequest,
                piece: &mut dyn FnMut(&str),
            ) -> Result<ChatReply, ModelError> {
                (**self).chat_streamed(request, piece)
            }
        })+
    };
}
forward_model!(Box<M>, &mut M);
