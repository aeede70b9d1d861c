//! Answers that were written beforehand, or that a rule gives.

use std::collections::VecDeque;

use super::{ChatModel, ChatReply, ChatRequest, ModelError};

/// A model without a model: a list of answers in order, or a rule from request to answer.
pub struct Scripted {
    script: Script,
    asked: Vec<ChatRequest>,
}

type Rule = dyn FnMut(&ChatRequest) -> Result<ChatReply, ModelError> + Send;

enum Script {
    List(VecDeque<Result<ChatReply, ModelError>>),
    Rule(Box<Rule>),
}

impl Scripted {
    /// Gives these answers, one a request, then [`ModelError::ScriptEnded`].
    pub fn answers(answers: impl IntoIterator<Item = Result<ChatReply, ModelError>>) -> Self {
        Self { script: Script::List(answers.into_iter().collect()), asked: Vec::new() }
    }

    /// Gives these texts, one a request, then [`ModelError::ScriptEnded`].
    pub fn texts<T: Into<String>>(texts: impl IntoIterator<Item = T>) -> Self {
        Self::answers(texts.into_iter().map(|text| Ok(ChatReply::of(text))))
    }

    /// Answers as the rule says.
    pub fn rule(rule: impl FnMut(&ChatRequest) -> Result<ChatReply, ModelError> + Send + 'static) -> Self {
        Self { script: Script::Rule(Box::new(rule)), asked: Vec::new() }
    }

    /// What was asked so far, oldest first.
    pub fn asked(&self) -> &[ChatRequest] {
        &self.asked
    }
}

impl ChatModel for Scripted {
    fn chat(&mut self, request: &ChatRequest) -> Result<ChatReply, ModelError> {
        let asked = self.asked.len();
        self.asked.push(request.clone());
        match &mut self.script {
            Script::List(answers) => answers.pop_front().unwrap_or(Err(ModelError::ScriptEnded { asked })),
            Script::Rule(rule) => rule(request),
        }
    }
}

impl std::fmt::Debug for Scripted {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match &self.script {
            Script::List(answers) => {
                write!(f, "Scripted({} asked, {} left)", self.asked.len(), answers.len())
            }
            Script::Rule(_) => write!(f, "Scripted({} asked, by a rule)", self.asked.len()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Message;
    use super::*;

    #[test]
    fn answers_come_in_order_and_end() {
        let mut model: Box<dyn ChatModel> = Box::new(Scripted::texts(["one", "two"]));
        let request = ChatRequest::new([Message::user("?")]);
        let mut pieces = Vec::new();
        assert_eq!(model.chat(&request).unwrap().text, "one");
        model.chat_streamed(&request, &mut |piece| pieces.push(piece.to_owned())).unwrap();
        assert_eq!(pieces, ["two"]);
        assert_eq!(model.chat(&request), Err(ModelError::ScriptEnded { asked: 2 }));
    }

    #[test]
    fn a_rule_sees_the_request() {
        let mut model = Scripted::rule(|request| Ok(ChatReply::of(request.messages.len().to_string())));
        let mut lent: &mut dyn ChatModel = &mut model;
        let reply = ChatModel::chat(&mut lent, &ChatRequest::new([Message::user("?")])).unwrap();
        assert_eq!(reply.text, "1");
        assert_eq!(model.asked().len(), 1);
    }
}
