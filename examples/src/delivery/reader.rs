//! A model that is a script: it knows nothing but its prompt and its schema, reads both, and answers with sense. What it earns says
//! whether prompts tell what a courier needs to know.
//!
//! It works as the policy [`ValueDensity`](simworld_agents::delivery::PolicyKind::ValueDensity) does, with whose couriers it can
//! be compared: it delivers and fetches first, walks briskly with work in hand, and bids a quarter above its cost for the order that
//! is worth most for each metre.

use serde_json::{Value as Json, json};
use simworld_agents::model::{ChatModel, ChatReply, ChatRequest, Part, Scripted};

/// A brisk walk, decimetres a second: the fastest that is no run; what such a walk covers of a way in a second with all waits, m; and
/// what a metre of it costs in energy with empty hands (`EnergyConfig::per_metre`).
const BRISK: i64 = 21;
const PROGRESS: f64 = 2.1 / 1.25;
const TIRING: f64 = 0.122;
/// What a second is worth, cents.
const WAGE: f64 = 3.0;
/// How far ahead it plans, s.
const HORIZON: f64 = 500.0;
/// With less energy it drinks.
const THIRSTY: f64 = 15.0;
/// Energy of a drink, and the share of a job's energy that is made up for by drinks.
const DRINK: (f64, f64) = (60.0, 0.5);

/// The model.
pub fn reader() -> Box<dyn ChatModel> {
    Box::new(Scripted::rule(|request| Ok(answer(request))))
}

fn answer(request: &ChatRequest) -> ChatReply {
    let Some(schema) = request.schema.as_ref().filter(|schema| schema.name != "thought") else {
        return ChatReply::of(r#"{"thought": "I work off what I have, and bid for what pays best."}"#);
    };
    let texts = request.messages.iter().flat_map(|message| &message.content);
    let mut texts =
        texts.filter_map(|part| if let Part::Text(text) = part { Some(text.as_str()) } else { None });
    let prompt = texts.next_back().unwrap_or_default();
    let branches = Branches(&schema.json["properties"]["deed"]);
    let deed = Shift::read(prompt).and_then(|shift| shift.deed(&branches));
    let deed = deed.unwrap_or_else(|| json!({ "act": "do_nothing" }));
    ChatReply::of(json!({ "because": "it pays", "deed": deed }).to_string())
}

/// What the schema allows.
struct Branches<'a>(&'a Json);

impl Branches<'_> {
    /// Whether it allows an act, with that order if one is given.
    fn allow(&self, act: &str, order: Option<&str>) -> bool {
        let all = self.0["anyOf"].as_array().map_or(std::slice::from_ref(self.0), Vec::as_slice);
        let holds = |list: &Json, word: &str| {
            list.as_array().is_some_and(|words| words.iter().any(|other| other == word))
        };
        all.iter().any(|branch| {
            let fields = &branch["properties"];
            holds(&fields["act"]["enum"], act)
                && order.is_none_or(|order| holds(&fields["order"]["enum"], order))
        })
    }
}

/// What a prompt says.
struct Shift<'a> {
    oneself: &'a str,
    held: Vec<Line<'a>>,
    open: Vec<Line<'a>>,
}

/// A line about an order.
struct Line<'a> {
    id: &'a str,
    text: &'a str,
}

impl<'a> Shift<'a> {
    fn read(prompt: &'a str) -> Option<Self> {
        let oneself = prompt.lines().find_map(|line| line.strip_prefix("You: "))?;
        let orders = |title: &str| -> Vec<Line<'a>> {
            let lines = prompt.lines().skip_while(|line| *line != title).skip(1);
            lines.map_while(Line::read).collect()
        };
        Some(Self { oneself, held: orders("Your orders:"), open: orders("Orders that take bids:") })
    }

    fn deed(&self, branches: &Branches<'_>) -> Option<Json> {
        let energy = number(self.oneself, "energy ")?;
        if energy < THIRSTY && !self.held.is_empty() && branches.allow("purchase_drinks", None) {
            return Some(json!({ "act": "purchase_drinks" }));
        }
        self.work(branches).or_else(|| self.hurry(branches)).or_else(|| self.bid(branches))
    }

    /// Goes on with the nearest of its orders, unless it is on its way.
    fn work(&self, branches: &Branches<'_>) -> Option<Json> {
        if !self.oneself.contains("on no errand") {
            return None;
        }
        let all = self.held.iter().filter_map(|line| Some((line, line.number(", ", " m to go there")?)));
        let (line, _) = all.min_by(|a, b| a.1.total_cmp(&b.1))?;
        let act = if line.text.contains("in hand") { "deliver_order" } else { "pick_up_order" };
        branches.allow(act, Some(line.id)).then(|| json!({ "act": act, "order": line.id }))
    }

    /// Walks briskly with work in hand.
    fn hurry(&self, branches: &Branches<'_>) -> Option<Json> {
        let (before, _) = self.oneself.split_once(" m/s of ")?;
        let speed: f64 = before.rsplit(' ').next()?.parse().ok()?;
        let slow = !self.held.is_empty() && speed * 10.0 < BRISK as f64 - 0.5;
        let can = slow && branches.allow("adjust_speed", None);
        can.then(|| json!({ "act": "adjust_speed", "decimetres_per_second": BRISK }))
    }

    /// Bids for the order that is worth most for each metre, of those that pay and can be done.
    fn bid(&self, branches: &Branches<'_>) -> Option<Json> {
        let bids = || self.open.iter().filter(|line| line.text.contains(", you bid "));
        let room = number(self.oneself, "room for ")?;
        if room <= bids().count() as f64 {
            return None;
        }
        let backlog: f64 = self.held.iter().filter_map(Line::way_left).sum();
        let pending: f64 = bids().filter_map(|line| Some(line.job()?.length)).sum();
        let worth = |line: &Line<'a>| {
            let job = line.job()?;
            let cost = self.cost(&job, backlog)?;
            let done = job.closes_in + (backlog + pending + job.length) / PROGRESS <= HORIZON;
            (done && cost < job.ceiling).then_some((job.ceiling / job.length.max(1.0), cost, job))
        };
        let new = self.open.iter().filter(|line| !line.text.contains(", you bid "));
        let all = new.filter(|line| branches.allow("bid_order", Some(line.id)));
        let all = all.filter_map(|line| Some((line.id, worth(line)?)));
        let (id, (_, cost, job)) = all.max_by(|a, b| a.1.0.total_cmp(&b.1.0))?;
        let cents = (cost * 1.25).round().clamp(100.0_f64.min(job.ceiling), job.ceiling) as i64;
        Some(json!({ "act": "bid_order", "order": id, "cents": cents }))
    }

    /// What a job costs in time, energy and lateness, cents.
    fn cost(&self, job: &Job, backlog: f64) -> Option<f64> {
        let drink = number(self.oneself, "a drink costs ")?;
        let drinks = job.length * TIRING / DRINK.0 * DRINK.1;
        let late = (backlog + job.length) / PROGRESS - 1.25 * job.length / 1.6;
        let deducted = (late.max(0.0) * 30.0).min(0.5 * job.ceiling);
        Some(WAGE * job.length / PROGRESS + drinks * drink + deducted)
    }
}

/// An order that takes bids: all lengths in m, the ceiling in cents, the time in s.
struct Job {
    ceiling: f64,
    length: f64,
    closes_in: f64,
}

impl<'a> Line<'a> {
    /// A line that says `order 7 [...]: ...`; names of places are passed over, whatever they say.
    fn read(line: &'a str) -> Option<Self> {
        let rest = line.strip_prefix("order ")?;
        let id = rest.split(' ').next()?;
        Some(Self { id, text: rest.rsplit_once("]: ")?.1 })
    }

    /// The number between two texts.
    fn number(&self, before: &str, after: &str) -> Option<f64> {
        let (front, _) = self.text.split_once(after)?;
        front.rsplit_once(before).map_or(front, |parts| parts.1).trim().parse().ok()
    }

    /// What is left to walk for an order that is held, m.
    fn way_left(&self) -> Option<f64> {
        let on = self.number(" and ", " m on").unwrap_or(0.0);
        Some(self.number(", ", " m to go there")? + on)
    }

    fn job(&self) -> Option<Job> {
        let approach = self.number(", ", " m to the restaurant")?;
        Some(Job {
            ceiling: number(self.text, "at most ")?,
            length: approach + self.number(" and ", " m on")?,
            closes_in: number(self.text, "closes in ")?,
        })
    }
}

/// The number that follows a text.
fn number(text: &str, after: &str) -> Option<f64> {
    let (_, rest) = text.split_once(after)?;
    rest.split([' ', ',', ';']).next()?.parse().ok()
}
