//! What reasons: a question with a schema goes in, an answer that was checked against it comes out.

use std::sync::Arc;

use serde_json::Value;
use thiserror::Error;

use super::prompts::{Prompt, PromptError, Prompts};
use super::schema;
use crate::model::{ChatModel, ChatReply, ChatRequest, Finish, Image, Message, ModelError};

/// The most characters of an unusable answer that are kept.
const KEPT: usize = 400;
/// The most characters of it that the model is shown again.
const SHOWN: usize = 4000;

/// A question to a reasoner.
#[derive(Clone, Debug)]
pub struct Question {
    /// What one is, and what one may do.
    pub system: String,
    /// The situation, and what is asked.
    pub user: String,
    /// What one sees, the oldest first.
    pub images: Vec<Image>,
    /// What the answer is for: letters, digits and `_`.
    pub name: &'static str,
    /// What the answer must conform to, as [`schema`](super::schema) makes it.
    pub schema: Value,
}

/// Why there is no answer that can be used.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ReasonError {
    /// The model gave none.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// What it gave cannot be used, not even after it was told why.
    #[error("the answer cannot be used: {fault}; it was {answer:?}")]
    Answer {
        /// What is wrong with it.
        fault: String,
        /// Its beginning.
        answer: String,
    },
    /// A prompt cannot be written.
    #[error(transparent)]
    Prompt(#[from] PromptError),
    /// Another reasoner's own reason.
    #[error("{0}")]
    Other(String),
}

impl ReasonError {
    /// Whether what may be spent on the model is spent: then it is asked no more.
    pub const fn is_out_of_budget(&self) -> bool {
        matches!(self, Self::Model(ModelError::Budget { .. }))
    }
}

/// The reasoning behind a mind, a planner or an executor: a model, or a rule.
///
/// ```
/// use simworld_agents::thought::{Question, ReasonError, Reasoner};
/// use serde_json::{Value, json};
///
/// /// Always takes the first of what is possible.
/// struct First;
///
/// impl Reasoner for First {
///     fn reason(
///         &mut self,
///         _: &Question,
///         check: &mut dyn FnMut(&Value) -> Result<(), String>,
///     ) -> Result<Value, ReasonError> {
///         let answer = json!({ "because": "", "deed": { "act": "stop" } });
///         check(&answer).map(|()| answer).map_err(ReasonError::Other)
///     }
/// }
/// ```
pub trait Reasoner: Send {
    /// Answers with a value that conforms to the question's schema and passes `check`, which says what else is wrong with it.
    ///
    /// # Errors
    /// There is no such answer.
    fn reason(
        &mut self,
        question: &Question,
        check: &mut dyn FnMut(&Value) -> Result<(), String>,
    ) -> Result<Value, ReasonError>;

    /// How many requests it made so far; zero of one that makes none.
    fn requests(&self) -> u64 {
        0
    }
}

impl<R: Reasoner + ?Sized> Reasoner for Box<R> {
    fn reason(
        &mut self,
        question: &Question,
        check: &mut dyn FnMut(&Value) -> Result<(), String>,
    ) -> Result<Value, ReasonError> {
        (**self).reason(question, check)
    }

    fn requests(&self) -> u64 {
        (**self).requests()
    }
}

/// Asks a model; an answer that cannot be used is shown to it once more with what is wrong.
pub struct ModelReasoner {
    model: Box<dyn ChatModel>,
    prompts: Arc<Prompts>,
    repairs: u32,
    max_tokens: u32,
    temperature: f64,
    seed: Option<i64>,
    requests: u64,
}

impl std::fmt::Debug for ModelReasoner {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { repairs, max_tokens, temperature, seed, .. } = self;
        write!(
            f,
            "ModelReasoner({repairs} repairs, {max_tokens} tokens, temperature {temperature}, {seed:?})"
        )
    }
}

impl ModelReasoner {
    /// Asks this model: at most 800 tokens an answer, at temperature 0, one repair.
    pub fn new(model: Box<dyn ChatModel>) -> Self {
        let prompts = Arc::new(Prompts::standard());
        Self { model, prompts, repairs: 1, max_tokens: 800, temperature: 0.0, seed: None, requests: 0 }
    }

    /// With prompts of one's own.
    #[must_use]
    pub fn with_prompts(mut self, prompts: Arc<Prompts>) -> Self {
        self.prompts = prompts;
        self
    }

    /// With that many further tries after an answer that cannot be used.
    #[must_use]
    pub fn with_repairs(mut self, repairs: u32) -> Self {
        self.repairs = repairs;
        self
    }

    /// With answers of at most that many tokens.
    #[must_use]
    pub fn with_max_tokens(mut self, tokens: u32) -> Self {
        self.max_tokens = tokens;
        self
    }

    /// With some randomness in the choice of words, 0 to 2, from this seed.
    #[must_use]
    pub fn with_temperature(mut self, temperature: f64, seed: Option<i64>) -> Self {
        self.temperature = temperature;
        self.seed = seed;
        self
    }

    fn request(&self, question: &Question) -> ChatRequest {
        let user = question
            .images
            .iter()
            .fold(Message::user(&question.user), |message, image| message.with_image(image.clone()));
        let messages = [Message::system(&question.system), user];
        let mut request = ChatRequest::new(messages).with_schema(question.name, question.schema.clone());
        request.max_tokens = Some(self.max_tokens);
        request.temperature = Some(self.temperature);
        request.seed = self.seed;
        request
    }
}

impl Reasoner for ModelReasoner {
    fn reason(
        &mut self,
        question: &Question,
        check: &mut dyn FnMut(&Value) -> Result<(), String>,
    ) -> Result<Value, ReasonError> {
        let mut request = self.request(question);
        let mut tries = 0;
        loop {
            self.requests += 1;
            let reply = self.model.chat(&request)?;
            let fault = match usable(&reply, &question.schema, check) {
                Ok(answer) => return Ok(answer),
                Err(fault) => fault,
            };
            if tries == self.repairs {
                return Err(ReasonError::Answer { fault, answer: beginning(&reply.text, KEPT) });
            }
            tries += 1;
            let repair = self.prompts.render(Prompt::Repair, &[("fault", &fault)])?;
            request.messages.truncate(2);
            request.messages.push(Message::assistant(beginning(&reply.text, SHOWN)));
            request.messages.push(Message::user(repair));
        }
    }

    fn requests(&self) -> u64 {
        self.requests
    }
}

/// The value in a reply, if it is whole, conforms and passes.
fn usable(
    reply: &ChatReply,
    schema: &Value,
    check: &mut dyn FnMut(&Value) -> Result<(), String>,
) -> Result<Value, String> {
    if reply.finish == Finish::Length {
        return Err("the answer reached its limit of tokens before it was complete: be brief".to_owned());
    }
    let value = schema::value_in(&reply.text).map_err(|mismatch| mismatch.to_string())?;
    schema::check(&value, schema).map_err(|mismatch| mismatch.to_string())?;
    check(&value)?;
    Ok(value)
}

fn beginning(text: &str, most: usize) -> String {
    text.chars().take(most).collect()
}
