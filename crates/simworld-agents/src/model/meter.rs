//! Books what each request takes, and stops before one that could exceed the budget.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::ledger::{Held, Outcome};
use super::reckon::most_prompt;
use super::{ChatModel, ChatReply, ChatRequest, Ledger, ModelError, Price, Usage};

/// What one agent's model costs.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Tariff {
    /// The price of each model by name.
    pub prices: BTreeMap<String, Price>,
    /// Models that stand in no line of `prices`.
    pub unpriced: Unpriced,
    /// The model where a request names none.
    pub model: String,
    /// The most tokens of an answer where a request sets no limit: the model's own.
    pub most_completion: u32,
}

impl Default for Tariff {
    fn default() -> Self {
        Self {
            prices: BTreeMap::new(),
            unpriced: Unpriced::Refused,
            model: "default".into(),
            most_completion: 4096,
        }
    }
}

/// What becomes of requests to a model without a price.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Unpriced {
    /// They are not sent.
    #[default]
    Refused,
    /// They cost nothing: the model is one's own. Tokens are booked all the same.
    Free,
}

impl Tariff {
    /// The tariff of a model of one's own.
    pub fn free() -> Self {
        Self { unpriced: Unpriced::Free, ..Self::default() }
    }

    fn price(&self, request: &ChatRequest) -> Result<Price, ModelError> {
        let model = request.model.as_ref().unwrap_or(&self.model);
        match (self.prices.get(model), self.unpriced) {
            (Some(price), _) => Ok(*price),
            (None, Unpriced::Free) => Ok(Price::default()),
            (None, Unpriced::Refused) => Err(ModelError::NoPrice { model: model.clone() }),
        }
    }
}

/// Books an agent's requests in a [`Ledger`].
///
/// Before a request goes, the most that it can take is held: a token for every byte of the prompt, and its limit of tokens.
/// So budgets are kept by requests under way together too, unless a server gives more tokens than it was asked for.
pub struct Metered<M> {
    inner: M,
    agent: String,
    tariff: Tariff,
    ledger: Ledger,
}

impl<M: ChatModel> Metered<M> {
    /// Asks `inner` for an agent.
    pub fn new(inner: M, agent: impl Into<String>, tariff: Tariff, ledger: Ledger) -> Self {
        Self { inner, agent: agent.into(), tariff, ledger }
    }

    fn metered(
        &mut self,
        request: &ChatRequest,
        ask: impl FnOnce(&mut M) -> Result<ChatReply, ModelError>,
    ) -> Result<ChatReply, ModelError> {
        let price = self.tariff.price(request)?;
        let completion = request.max_tokens.unwrap_or(self.tariff.most_completion).into();
        let most = Usage { prompt: most_prompt(request), completion };
        let held = Held { tokens: most.total(), cost: price.of(most) };
        self.ledger.hold(&self.agent, held)?;
        let answer = ask(&mut self.inner);
        let outcome = match &answer {
            Ok(reply) => Outcome::Answered(reply.usage, price.of(reply.usage)),
            Err(error) if may_have_worked(error) => Outcome::Uncertain,
            Err(_) => Outcome::Failed,
        };
        self.ledger.settle(&self.agent, held, &outcome);
        answer
    }
}

/// Whether a server may have answered, and charged, although we have no answer.
fn may_have_worked(error: &ModelError) -> bool {
    matches!(
        error,
        ModelError::Transport { .. }
            | ModelError::Timeout { .. }
            | ModelError::BadReply { .. }
            | ModelError::TooLarge { .. }
            | ModelError::Truncated { .. }
            | ModelError::Filtered
    )
}

impl<M: ChatModel> ChatModel for Metered<M> {
    fn chat(&mut self, request: &ChatRequest) -> Result<ChatReply, ModelError> {
        self.metered(request, |inner| inner.chat(request))
    }

    fn chat_streamed(
        &mut self,
        request: &ChatRequest,
        piece: &mut dyn FnMut(&str),
    ) -> Result<ChatReply, ModelError> {
        self.metered(request, |inner| inner.chat_streamed(request, piece))
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Account, Budget, Message, Scripted};
    use super::*;

    const USAGE: Usage = Usage { prompt: 5, completion: 10 };

    fn tariff() -> Tariff {
        let price = Price { prompt: 1_000_000, completion: 2_000_000 };
        Tariff {
            prices: BTreeMap::from([("m".to_owned(), price)]),
            model: "m".into(),
            most_completion: 10,
            ..Tariff::default()
        }
    }

    fn metered(agent: &str, ledger: &Ledger) -> Metered<Scripted> {
        let model = Scripted::rule(|_| Ok(ChatReply { usage: USAGE, ..ChatReply::of("yes") }));
        Metered::new(model, agent, tariff(), ledger.clone())
    }

    #[test]
    fn each_agent_has_an_account() {
        let ledger = Ledger::default();
        let request = ChatRequest::new([Message::user("?")]);
        for (agent, count) in [("ann", 2), ("bob", 1)] {
            for _ in 0..count {
                metered(agent, &ledger).chat(&request).unwrap();
            }
        }
        assert_eq!(ledger.of("ann").cost, 50);
        assert_eq!(ledger.of("bob").usage, USAGE);
        assert_eq!(ledger.total().answered, 3);
        assert_eq!(ledger.total().cost, 75);
        assert_eq!(ledger.agents().len(), 2);
    }

    #[test]
    fn a_budget_stops_before_the_request_that_could_exceed_it() {
        // The most of a request: 1 byte and twice 16 tokens around messages, 10 of the answer: 33 + 20 micro-cents.
        for (budget, requests) in [
            (Budget { cost: Some(52), ..Budget::default() }, 0),
            (Budget { cost: Some(53), ..Budget::default() }, 1),
            (Budget { agent_cost: Some(78), ..Budget::default() }, 2),
            (Budget { tokens: Some(43 + 15 + 15), ..Budget::default() }, 3),
            (Budget { agent_tokens: Some(42), ..Budget::default() }, 0),
        ] {
            let ledger = Ledger::new(budget);
            let mut model = metered("ann", &ledger);
            let request = ChatRequest::new([Message::user("?")]);
            let answered = (0..9).filter(|_| model.chat(&request).is_ok()).count();
            assert_eq!(answered, requests, "{budget:?}");
            let error = model.chat(&request).unwrap_err();
            assert!(matches!(error, ModelError::Budget { .. }), "{error}");
            assert_eq!(model.inner.asked().len(), requests, "what is stopped is not sent");
            assert_eq!(ledger.total().stopped, 10 - requests as u64);
        }
    }

    #[test]
    fn others_are_not_stopped_by_one_who_spent_his_own() {
        let ledger = Ledger::new(Budget { agent_cost: Some(60), ..Budget::default() });
        let request = ChatRequest::new([Message::user("?")]);
        let mut ann = metered("ann", &ledger);
        ann.chat(&request).unwrap();
        ann.chat(&request).unwrap_err();
        metered("bob", &ledger).chat(&request).unwrap();
    }

    #[test]
    fn what_a_server_may_have_charged_counts_against_the_budget() {
        let ledger = Ledger::new(Budget { cost: Some(100), ..Budget::default() });
        let lost = ModelError::Timeout { phase: String::new(), limit: std::time::Duration::ZERO };
        let refused = ModelError::RateLimited { retry_after: None };
        let answers = [Err(refused), Err(lost), Ok(ChatReply::of("yes"))];
        let mut model = Metered::new(Scripted::answers(answers), "ann", tariff(), ledger.clone());
        let request = ChatRequest::new([Message::user("?")]);
        model.chat(&request).unwrap_err();
        assert_eq!(ledger.total(), Account { failed: 1, ..Account::default() });
        model.chat(&request).unwrap_err();
        assert_eq!(ledger.total().uncertain_cost, 53);
        assert!(matches!(model.chat(&request), Err(ModelError::Budget { left: 47, .. })));
    }

    #[test]
    fn requests_under_way_are_held_together() {
        let ledger = Ledger::new(Budget { cost: Some(100), ..Budget::default() });
        let held = Held { tokens: 1, cost: 60 };
        ledger.hold("ann", held).unwrap();
        ledger.hold("bob", held).unwrap_err();
        ledger.settle("ann", held, &Outcome::Failed);
        ledger.hold("bob", held).unwrap();
    }

    #[test]
    fn a_model_without_a_price_is_not_asked() {
        let ledger = Ledger::default();
        let mut model = metered("ann", &ledger);
        let mut request = ChatRequest::new([Message::user("?")]);
        request.model = Some("dear".into());
        assert_eq!(model.chat(&request), Err(ModelError::NoPrice { model: "dear".into() }));
        assert!(model.inner.asked().is_empty());
        model.tariff.unpriced = Unpriced::Free;
        model.chat(&request).unwrap();
        assert_eq!((ledger.total().cost, ledger.total().usage), (0, USAGE));
    }
}
