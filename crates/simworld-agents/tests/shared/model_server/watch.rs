//! A model behind the server that is watched: what it was asked, what it answered, and what the meter booked of that.
#![allow(dead_code, reason = "each group of tests uses its own part")]

use std::sync::{Arc, Mutex};

use serde_json::{Value as Json, json};
use simworld_agents::model::{
    Account, ChatModel, ChatReply, ChatRequest, Finish, Ledger, Message, Metered, ModelError, OpenAiChat,
    Part, Tariff, Usage,
};
use simworld_agents::thought::schema;

use super::ModelServer;

/// A question or a repair, and what came back.
#[derive(Clone, Debug)]
pub struct Exchange {
    /// As it was asked, before anything was changed.
    pub request: ChatRequest,
    /// As it came from the server.
    pub answer: Result<ChatReply, ModelError>,
}

impl Exchange {
    /// Whether it holds, behind the question, an answer and what is wrong with that.
    pub fn is_repair(&self) -> bool {
        self.request.messages.len() == 4
    }

    /// The answer, if it is whole and conforms to the schema that was asked by.
    pub fn value(&self) -> Option<Json> {
        let reply = self.answer.as_ref().ok().filter(|reply| reply.finish != Finish::Length)?;
        let value = schema::value_in(&reply.text).ok()?;
        let asked = &self.request.schema.as_ref()?.json;
        schema::check(&value, asked).ok().map(|()| value)
    }
}

/// What one model was asked and answered; clones share it.
#[derive(Clone, Default)]
pub struct Watch {
    exchanges: Arc<Mutex<Vec<Exchange>>>,
    ledger: Ledger,
}

impl Watch {
    /// A metered model behind the server; each request is changed before it goes.
    pub fn model(&self, server: &ModelServer, change: fn(&mut ChatRequest)) -> Box<dyn ChatModel> {
        let client = OpenAiChat::new(server.config()).unwrap();
        let inner = Metered::new(client, "somebody", Tariff::free(), self.ledger.clone());
        Box::new(Watched { inner, change, exchanges: Arc::clone(&self.exchanges) })
    }

    /// Everything so far, the oldest first.
    pub fn all(&self) -> Vec<Exchange> {
        self.exchanges.lock().unwrap().clone()
    }

    /// How much that is.
    pub fn count(&self) -> usize {
        self.exchanges.lock().unwrap().len()
    }

    /// What the meter booked.
    pub fn account(&self) -> Account {
        self.ledger.total()
    }

    /// First answers that do not conform; each is to be repaired.
    pub fn faulty(&self) -> usize {
        let all = self.all();
        all.iter().filter(|exchange| !exchange.is_repair() && exchange.value().is_none()).count()
    }

    /// How many questions and how many repairs there were, after the check that none was lost: each has its answer, each repair
    /// follows what it repairs, and the meter booked them all once.
    pub fn settled(&self) -> (usize, usize) {
        let all = self.all();
        let (mut usage, mut repairs) = (Usage::default(), 0);
        for (index, exchange) in all.iter().enumerate() {
            let reply = exchange.answer.as_ref().unwrap_or_else(|error| panic!("{error}"));
            usage = usage.and(reply.usage);
            let messages = &exchange.request.messages;
            if exchange.is_repair() {
                let before = &all[index - 1];
                let said = before.answer.as_ref().map_or("", |reply| reply.text.as_str());
                assert!(!before.is_repair() && messages[..2] == before.request.messages[..2]);
                assert!(said.starts_with(&words_of(&messages[2])), "{said}");
                repairs += 1;
            } else {
                assert_eq!(messages.len(), 2, "instructions and a question");
            }
        }
        let account = self.account();
        assert_eq!((account.answered, account.failed, account.stopped), (all.len() as u64, 0, 0));
        assert_eq!(account.usage, usage);
        (all.len() - repairs, repairs)
    }
}

/// Notes what passes.
struct Watched {
    inner: Metered<OpenAiChat>,
    change: fn(&mut ChatRequest),
    exchanges: Arc<Mutex<Vec<Exchange>>>,
}

impl ChatModel for Watched {
    fn chat(&mut self, request: &ChatRequest) -> Result<ChatReply, ModelError> {
        let mut changed = request.clone();
        (self.change)(&mut changed);
        let answer = self.inner.chat(&changed);
        let exchange = Exchange { request: request.clone(), answer: answer.clone() };
        self.exchanges.lock().unwrap().push(exchange);
        answer
    }
}

/// The words of a message, without its pictures.
pub fn words_of(message: &Message) -> String {
    let words = message.content.iter().filter_map(|part| match part {
        Part::Text(text) => Some(text.as_str()),
        _ => None,
    });
    words.collect()
}

/// Changes nothing.
pub fn as_asked(_: &mut ChatRequest) {}

/// Takes the pictures out: the model of the tests is blind.
pub fn without_pictures(request: &mut ChatRequest) {
    for message in &mut request.messages {
        message.content.retain(|part| !matches!(part, Part::Image(_)));
    }
}

/// Leaves of a schema what a model of random weights gets right by chance: small numbers, short texts, short lists with
/// something in them, and no word of why it cannot be. What conforms to what is left conforms to the whole.
pub fn make_easy(request: &mut ChatRequest) {
    let Some(asked) = &mut request.schema else { return };
    narrow(&mut asked.json);
    let fields = &mut asked.json["properties"];
    if let Some(cannot) = fields.get_mut("cannot") {
        *cannot = schema::one_of([""]);
    }
    for name in ["steps", "edits"] {
        if let Some(list) = fields.get_mut(name) {
            list["minItems"] = json!(1);
        }
    }
}

/// Grammars know nothing of the bounds of numbers: a random one is mostly far beyond them, so that a few are listed.
fn narrow(part: &mut Json) {
    match part {
        Json::Array(parts) => parts.iter_mut().for_each(narrow),
        Json::Object(fields) => {
            let bound = |name: &str| fields.get(name).and_then(Json::as_i64);
            let (low, high) = (bound("minimum"), bound("maximum"));
            let (letters, items) = (bound("maxLength"), bound("maxItems"));
            if let (Some(low), Some(high)) = (low, high) {
                let mut few = [0_i64, 1, 10].map(|number| number.clamp(low, high)).to_vec();
                few.dedup();
                fields.clear();
                fields.insert("enum".to_owned(), json!(few));
                return;
            }
            if let Some(letters) = letters {
                fields.insert("maxLength".to_owned(), json!(letters.min(8)));
            }
            if let Some(items) = items {
                fields.insert("maxItems".to_owned(), json!(items.min(2)));
            }
            fields.values_mut().for_each(narrow);
        }
        _ => {}
    }
}
