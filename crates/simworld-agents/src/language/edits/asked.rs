//! Questions about what is so, which change nothing: "is there a cinema?", "is Mill Lane closed?", "is it raining?", "how tall is
//! the statue?"; and orders to leave something as it is.

use simworld_core::seam::PlanError;

use super::super::clause::Reference;
use super::super::lexicon::{longest, longest_phrase};
use super::super::phrases::Phrases;
use super::parse::Reader;
use super::wish::Wish;
use super::words::VERBS;

/// Asks whether there is something.
#[rustfmt::skip]
const EXISTS: &Phrases = &Phrases::of(&["is there", "are there", "is there any", "are there any", "do we have", "do we have any", "have we got", "have we got any", "have you got", "do you have", "do you have any", "is there already",
    "do you see", "do you see any", "does the city have", "does this place have", "does the campus have", "does the town have", "does the harbour have", "is there still", "are there still", "do we already have"]);
/// Asks how a thing is.
#[rustfmt::skip]
const HOW: &Phrases = &Phrases::of(&["how tall is", "how big is", "how high is", "how wide is", "how long is", "how large is", "how heavy is", "how small is", "how far is", "how far away is", "what colour is", "what color is", "what colour does",
    "which colour is", "which color is", "what size is", "how tall are", "what colour has", "whats the colour of", "whats the color of", "what is the height of", "whats the height of", "whats the size of", "what kind of thing is"]);
/// Asks what the sky is like.
#[rustfmt::skip]
const SKY: &Phrases = &Phrases::of(&["what time is it", "whats the time", "what is the time", "what time of day is it", "whats the weather", "what is the weather", "hows the weather", "how is the weather", "whats the weather like",
    "what is the weather like", "what is the weather like now", "tell me the time", "tell me the weather", "what hour is it"]);
/// What is said of a thing that is asked about.
#[rustfmt::skip]
const STATES: &Phrases = &Phrases::of(&["open", "closed", "locked", "unlocked", "empty", "free", "there", "still there", "here", "big", "small", "tall", "short", "taken", "parked", "broken", "full"]);
/// Of streets.
#[rustfmt::skip]
const PASSABLE: &Phrases = &Phrases::of(&["open", "closed", "shut", "blocked", "passable", "open to traffic", "closed to traffic", "closed now", "open now", "open for traffic", "closed for traffic", "currently closed", "currently open",
    "closed at the moment", "open at the moment", "still closed", "still open", "open for cars", "open to cars", "closed to cars", "closed off", "blocked off", "open again"]);
/// Orders to let a thing be, before it.
#[rustfmt::skip]
const KEEPS: &Phrases = &Phrases::of(&["leave", "keep", "let", "and leave", "but leave", "but keep"]);
/// Behind it.
#[rustfmt::skip]
const AS_IT_IS: &Phrases = &Phrases::of(&["alone", "as it is", "as they are", "where it is", "where they are", "be", "in peace", "untouched", "as is", "where it stands", "where they stand", "unchanged", "in place", "in its place", "the way it is",
    "where she is", "where he is", "as it was", "as they were", "standing", "stay", "stay where it is", "stay where they are", "stay there", "exactly where it is", "just as it is", "the way they are"]);
/// Denies an order.
const DENIES: &Phrases = &Phrases::of(&[
    "dont",
    "do not",
    "never",
    "please dont",
    "please do not",
    "you must not",
    "you mustnt",
    "nobody should",
]);
/// Behind them these are turns of politeness, or deny none.
#[rustfmt::skip]
const NO_DENIAL: &Phrases = &Phrases::of(&["hesitate", "forget", "you", "worry", "mind", "be", "want", "need", "like", "care", "think", "we", "let", "keep", "leave", "stop", "have", "fail", "know"]);

impl Reader<'_> {
    /// A question, or an order to do nothing.
    ///
    /// # Errors
    /// What is asked for is not there.
    pub(super) fn asked(&self, end: usize) -> Result<Option<Wish>, PlanError> {
        let start = self.at;
        let end = self.before_politeness(start, end);
        let words = &self.lexemes[start..end];
        if longest_phrase(words, SKY) == Some(words.len()) || self.asks_sky(start, end) {
            return Ok(Some(Wish::AskSky));
        }
        if let Some(wish) = self.asks_passage(start, end).or_else(|| self.left_alone(start, end)) {
            return Ok(Some(wish));
        }
        if let Some(wish) = self.asks_distance(start, end)? {
            return Ok(Some(wish));
        }
        if let Some(wish) = self.asks_how(start, end) {
            return Ok(Some(wish));
        }
        self.asks_existence(start, end)
    }

    /// "Is it raining?"
    fn asks_sky(&self, start: usize, end: usize) -> bool {
        const ASKS: &Phrases = &Phrases::of(&[
            "is it",
            "isnt it",
            "is it still",
            "is the weather",
            "is the sky",
            "was it",
            "is there any",
            "does it",
            "will it",
            "do you think it will",
            "is it going to",
            "did it",
            "do you think it is going to",
            "do you think its going to",
        ]);
        const WISHES: &[&str] =
            &["time", "possible", "make", "let", "can", "could", "please", "too", "ok", "okay"];
        let Some(words) = longest_phrase(&self.lexemes[start..end], ASKS) else { return false };
        let wishes = (start..end).any(|at| self.word(at).is_some_and(|word| WISHES.contains(&word)));
        let rest = Reader { at: start + words, ..self.up_to(end) };
        !wishes && rest.sky(end).is_some()
    }

    /// "Is Mill Lane closed?", "which streets are closed?"
    fn asks_passage(&self, start: usize, end: usize) -> Option<Wish> {
        #[rustfmt::skip]
        const WHICH: &Phrases = &Phrases::of(&["which streets are", "which roads are", "what streets are", "what roads are", "are any streets", "are any roads", "is any street", "is any road", "which street is", "which road is",
            "how many streets are", "how many roads are", "are there any streets", "are there any closed streets", "are there closed streets", "which of the streets are", "are some streets", "list the closed streets",
            "show me the closed streets", "which streets", "what is", "whats", "list all"]);
        let whole = |at: usize| longest_phrase(&self.lexemes[at.min(end)..end], PASSABLE) == Some(end - at);
        if let Some(words) = longest_phrase(&self.lexemes[start..end], WHICH)
            && (start + words == end || whole(start + words) || self.word(start + words) == Some("closed"))
            && (start..end).any(|at| matches!(self.word(at), Some("closed" | "shut" | "blocked" | "open")))
        {
            return Some(Wish::AskPassage { which: Vec::new() });
        }
        let is = longest_phrase(
            &self.lexemes[start..end],
            &["is", "are", "isnt", "was", "can i use", "can you see if", "tell me if", "is the"],
        )?;
        let (street, after) = self.street_ref(start + is, end)?;
        let is_street = !matches!(street, super::wish::StreetRef::It | super::wish::StreetRef::Unknown(_));
        (is_street && whole(after)).then(|| Wish::AskPassage { which: vec![street] })
    }

    /// "Is closed", "are open to traffic": how many words say so, and whether they say closed.
    pub(super) fn passable(&self, at: usize, end: usize) -> Option<(usize, bool)> {
        let is = longest_phrase(
            &self.lexemes[at..end],
            &["is", "are", "was", "is still", "is already", "is not", "isnt", "is currently"],
        )?;
        let state = longest_phrase(&self.lexemes[at + is..end], PASSABLE)?;
        let is_open = (at + is..at + is + state).any(|at| matches!(self.word(at), Some("open" | "passable")));
        let not = (at..at + is).any(|at| matches!(self.word(at), Some("not" | "isnt")));
        Some((is + state, is_open == not))
    }

    /// "How tall is the statue?", "is the truck orange?"
    fn asks_how(&self, start: usize, end: usize) -> Option<Wish> {
        if let Some(words) = longest_phrase(&self.lexemes[start..end], HOW) {
            let from = start + words;
            let tail = &["from here", "from me", "away", "high", "tall", "have"];
            let stop = (from + 1..end)
                .find(|at| longest_phrase(&self.lexemes[*at..end], tail) == Some(end - at))
                .or_else(|| (from + 1..end).find(|at| self.word(*at) == Some("from")))
                .unwrap_or(end);
            let what = self.one_of(from, stop).ok().filter(|_| self.is_certain(from))?;
            return Some(Wish::Describe { what });
        }
        let is = longest_phrase(&self.lexemes[start..end], &["is", "are", "was", "isnt"])?;
        let from = start + is;
        if !self.is_certain(from) || self.word(from) == Some("it") && self.word(from + 1) == Some("time") {
            return None;
        }
        (from + 1..end).find_map(|cut| {
            let rest = &self.lexemes[cut..end];
            let is_state = longest_phrase(rest, STATES) == Some(rest.len())
                || longest(rest, super::super::paint::PAINTS).is_some_and(|(_, words)| words == rest.len())
                || self.places_to(cut, end).is_some();
            let what = if is_state { self.one_of(from, cut).ok()? } else { return None };
            (!super::says::is_it(&what)).then_some(Wish::Describe { what })
        })
    }

    /// "Is there a cinema?"
    fn asks_existence(&self, start: usize, end: usize) -> Result<Option<Wish>, PlanError> {
        #[rustfmt::skip]
        const NONE: &Phrases = &Phrases::of(&["any chance", "a chance", "any way", "a way", "a possibility", "any possibility", "room", "space", "any room", "enough room", "time", "any reason", "a reason", "any hope", "nothing", "something"]);
        let asks = end
            .checked_sub(1)
            .and_then(|last| self.lexemes.get(last))
            .is_some_and(|last| self.words[last.end..].trim_start().starts_with('?'));
        let any = longest_phrase(&self.lexemes[start..end], &["any", "any more", "no"])
            .filter(|_| asks && self.word(start) == Some("any"));
        let any = any.filter(|_| {
            longest_phrase(&self.lexemes[start..end], &["any chance", "any way", "any idea"]).is_none()
        });
        let Some(words) = longest_phrase(&self.lexemes[start..end], EXISTS).or(any) else { return Ok(None) };
        let from = start + words;
        let is_order = (from..end).any(|at| {
            self.lexemes[at].token == super::super::lexer::Token::Break
                || longest_phrase(&self.lexemes[at..end], &["how many"]).is_some()
        });
        if from >= end || is_order || longest_phrase(&self.lexemes[from..end], NONE).is_some() {
            return Ok(None);
        }
        match self.asked_about_anywhere(from, end) {
            Ok(what) if super::says::is_it(&what) => Ok(None),
            Ok(mut what) => {
                what.count = super::super::clause::Count::All;
                what.indefinite = false;
                Ok(Some(Wish::List { what: Some(what), at: Vec::new() }))
            }
            Err(error @ PlanError::NotFound { .. }) if !self.has_verb(from, end) => Err(error),
            Err(_) => Ok(None),
        }
    }

    /// What is asked about, wherever it may be: "a fountain somewhere" is a fountain.
    fn asked_about_anywhere(&self, from: usize, end: usize) -> Result<Reference, PlanError> {
        self.asked_about(from, end).or_else(|error| {
            let stop = self.without_there(from, end);
            if stop >= end {
                return Err(error);
            }
            self.asked_about(from, stop).map_err(|other| match other {
                PlanError::NotFound { .. } => other,
                _ => error,
            })
        })
    }

    /// "Leave the red bench alone", "do not move the statue", "hands off the fountain".
    fn left_alone(&self, start: usize, end: usize) -> Option<Wish> {
        const UNTOUCHED: &[&str] =
            &["dont touch", "do not touch", "please dont touch", "hands off", "never touch", "nobody touch"];
        let nothing = |start: usize| {
            let why = format!("nothing was changed: {}", self.written(start, end));
            Wish::Nothing { why }
        };
        if let Some(words) = longest_phrase(&self.lexemes[start..end], UNTOUCHED) {
            let what = self.things(start + words, end).ok().filter(|_| self.is_certain(start + words))?;
            return (!what.is_empty()).then(|| nothing(start));
        }
        if let Some(words) = longest_phrase(&self.lexemes[start..end], KEEPS) {
            let from = start + words;
            return (from + 1..end).find_map(|cut| {
                let whole = longest_phrase(&self.lexemes[cut..end], AS_IT_IS) == Some(end - cut);
                let what = if whole { self.things(from, cut).ok()? } else { return None };
                (self.is_certain(from) && !what.is_empty()).then(|| nothing(start))
            });
        }
        // What stands behind may say what is to be done instead.
        let words = longest_phrase(&self.lexemes[start..end], DENIES)?;
        let from = start + words;
        let is_last = self.lexemes[end..].iter().all(super::super::lexer::is_mark);
        let denies = longest_phrase(&self.lexemes[from..end], NO_DENIAL).is_none()
            && longest(&self.lexemes[from..end], &VERBS).is_some()
            && is_last;
        (denies && self.read_plainly(&self.lexemes[from..end]).is_some()).then(|| nothing(start))
    }
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    let lists = [EXISTS, HOW, SKY, STATES, PASSABLE, KEEPS, AS_IT_IS];
    lists.into_iter().flatten().flat_map(|phrase| phrase.split(' '))
}
