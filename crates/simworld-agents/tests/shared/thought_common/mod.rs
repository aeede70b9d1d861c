//! Models that answer as a test wants, and what was asked of them.
#![allow(dead_code, clippy::unwrap_used, reason = "a helper of tests; each file uses its own part")]

pub(crate) mod answers;
pub(crate) mod plans;

use std::sync::{Arc, Mutex};

use simworld_agents::model::{ChatModel, ChatReply, ChatRequest, ModelError, Part, Scripted};

/// Everything that a model was asked.
#[derive(Clone, Default)]
pub(crate) struct Asked(Arc<Mutex<Vec<ChatRequest>>>);

impl Asked {
    pub(crate) fn all(&self) -> Vec<ChatRequest> {
        self.0.lock().unwrap().clone()
    }

    pub(crate) fn last(&self) -> ChatRequest {
        self.all().pop().expect("something was asked")
    }
}

/// A model that answers by a rule, and what it was asked.
pub(crate) fn model(
    mut rule: impl FnMut(usize, &ChatRequest) -> Result<String, ModelError> + Send + 'static,
) -> (Box<dyn ChatModel>, Asked) {
    let asked = Asked::default();
    let shared = asked.clone();
    let mut count = 0;
    let scripted = Scripted::rule(move |request| {
        shared.0.lock().unwrap().push(request.clone());
        count += 1;
        rule(count - 1, request).map(ChatReply::of)
    });
    (Box::new(scripted), asked)
}

/// A model that gives these answers in turn.
pub(crate) fn answering(answers: &[&str]) -> (Box<dyn ChatModel>, Asked) {
    let answers: Vec<String> = answers.iter().map(|answer| (*answer).to_owned()).collect();
    model(move |index, _| answers.get(index).cloned().ok_or(ModelError::ScriptEnded { asked: index }))
}

/// The text of one message.
pub(crate) fn text(request: &ChatRequest, message: usize) -> String {
    let parts = request.messages[message].content.iter().filter_map(|part| match part {
        Part::Text(text) => Some(text.as_str()),
        _ => None,
    });
    parts.collect()
}
