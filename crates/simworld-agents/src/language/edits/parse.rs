//! Tokens to wishes.
//!
//! ```text
//! sentence = wish { joint wish }
//! wish     = add things [places] { "and" things [places] } | move things places | remove things
//!          | turn things (angle | "towards" thing) | swap thing "and" thing | paint things colour | make things size
//!          | copy thing [places] | name thing name | "how many" things | list things | describe thing | weather
//! places   = place { "and" place };  place = a relation and what it is to (see `places`)
//! ```
//!
//! Where the words can be cut in several ways ("move the bench near the fountain next to the library"), all readings are
//! kept in their order: the first whose things are there is meant.

use simworld_core::seam::PlanError;

use super::super::clause::{Reference, Target};
use super::super::lexer::{Lexeme, Token, written};
use super::super::lexicon::{longest, longest_phrase};
use super::super::names::Names;
use super::super::parser::Parser;
use super::super::phrases::{PhraseList, Phrases};
use super::super::resolve::View;
use super::memo::{Memo, said};
use super::polite::{CODA, POLITE};
pub(super) use super::polite::{joint, small_words};
use super::says::Mood;
use super::wish::Wish;
use super::words::{VERBS, Verb};

/// What is understood, in one line, for answers.
pub(super) const UNDERSTOOD: &str = "say add, put, move, remove, replace, rotate, swap, paint, make bigger or smaller, copy, name, \
     count, list, describe, or what the weather and the time are to be";

/// Before what is to be listed, behind a verb of giving.
const LISTS: &Phrases = &Phrases::of(&[
    "a list of",
    "the list of",
    "list of",
    "an overview of",
    "a listing of",
    "a list with",
    "a short list of",
    "a full list of",
    "a complete list of",
]);

/// Reads one sentence.
#[derive(Clone, Copy)]
pub(super) struct Reader<'a> {
    pub(super) words: &'a str,
    pub(super) lexemes: &'a [Lexeme],
    pub(super) names: &'a Names<'a>,
    pub(super) view: &'a View<'a>,
    pub(super) at: usize,
    /// How often the words were put together anew.
    pub(super) depth: u8,
    pub(super) memo: &'a Memo,
}

impl<'a> Reader<'a> {
    /// All wishes of the sentence, each in all its readings, at least one.
    pub(super) fn sentence(&mut self) -> Result<Vec<Vec<Wish>>, PlanError> {
        let mut wishes: Vec<Vec<Wish>> = Vec::new();
        self.skip_joints();
        while self.at < self.lexemes.len() {
            let end = self.boundary();
            let with = self.at > 0 && self.word(self.at - 1) == Some("with");
            let from = self.at;
            let mut read = self.wish(end)?;
            if wishes
                .last()
                .and_then(|before| before.first())
                .is_some_and(|before| self.is_stray(before, from, &read))
            {
                return Err(Reader { at: from, ..*self }.not_understood("say where it is to go"));
            }
            if self.is_only_told(&read, from, end) {
                return Err(Reader { at: from, ..*self }.not_understood(UNDERSTOOD));
            }
            if let Some([before, ..]) = wishes.last().map(Vec::as_slice) {
                self.share_place(before, from, &mut read);
            }
            if let (Some([before, ..]), Some(first)) = (wishes.last().map(Vec::as_slice), read.first_mut()) {
                for wish in first {
                    super::shared::on_street(before, wish, with);
                }
            }
            wishes.append(&mut read);
            self.skip_joints();
        }
        if wishes.is_empty() { Err(self.not_understood(UNDERSTOOD)) } else { Ok(wishes) }
    }

    /// One wish up to a boundary, or several that share a verb.
    pub(super) fn wish(&mut self, end: usize) -> Result<Vec<Vec<Wish>>, PlanError> {
        let key = (said(self.lexemes), self.at, end, self.depth);
        if let Some((read, at)) = self.memo.wish(&key) {
            self.at = at;
            return read;
        }
        if self.memo.is_spent() {
            return Err(self.not_understood(UNDERSTOOD));
        }
        self.memo.step();
        let read = self.read_wish(end);
        self.memo.keep_wish(key, &read, self.at);
        read
    }

    fn read_wish(&mut self, end: usize) -> Result<Vec<Vec<Wish>>, PlanError> {
        let start = self.at;
        if let Some(made) = self.asked_or_given(end)? {
            return Ok(made);
        }
        if let Some(wish) = self.asked_twice(self.lexemes.len()) {
            self.at = self.lexemes.len();
            return Ok(vec![vec![wish]]);
        }
        if let Some(made) = self.of_its_own_kind(start, end)? {
            self.at = end;
            return Ok(made);
        }
        self.at = start;
        if let Some(made) = self.place_first(end) {
            return Ok(made);
        }
        let refused = match self.ordered(start, end) {
            Ok(Some(made)) => return Ok(made),
            Ok(None) => None,
            Err(refused) => Some(refused),
        };
        self.at = start;
        let bare = self.bare(end);
        if let Ok(Some(wishes)) = bare {
            return Ok(wishes);
        }
        if let Some(made) = self.composed(start, end) {
            self.at = end;
            return Ok(made);
        }
        self.at = start;
        Err(self.refusal(refused, bare.err(), end))
    }

    /// Wishes that verbs alone do not tell: of streets, rows, what is on things, the sky, and those told as statements.
    fn of_its_own_kind(&mut self, start: usize, end: usize) -> Result<Option<Vec<Vec<Wish>>>, PlanError> {
        let one = |wish| Ok(Some(vec![vec![wish]]));
        if let Some(wish) = self.passage(end) {
            return one(wish);
        }
        if let Some(made) = self.rows(end)? {
            return Ok(Some(made));
        }
        if let Some(wish) = self.dressed(end).or_else(|| self.cleared(end)) {
            return one(wish);
        }
        if let Some(sky) = self.sky(end) {
            return one(Wish::Sky(sky));
        }
        Ok(self.stated(start, end))
    }

    /// The answer to what was not understood as an order, nor as new things: the one that says most.
    fn refusal(&self, ordered: Option<PlanError>, bare: Option<PlanError>, end: usize) -> PlanError {
        let start = self.at;
        let refused = match ordered {
            Some(refused @ PlanError::NotFound { .. }) => Some(refused),
            refused => self.not_there(start, end).or(refused),
        };
        // What is not there is a better answer than that nothing is understood.
        if let Some(error @ PlanError::NotFound { .. }) = refused {
            return error;
        }
        let missing =
            || self.beginnings(start, end).into_iter().find_map(|begins| self.missing(begins.at, end));
        missing().or(refused).or(bare).unwrap_or_else(|| self.not_understood(UNDERSTOOD))
    }

    /// What is told as a statement: what somebody lacks, and how something should be.
    fn stated(&mut self, start: usize, end: usize) -> Option<Vec<Vec<Wish>>> {
        let polite = start + self.polite_at(start);
        let paint = self.coated(polite, self.before_politeness(polite, end));
        if let Some(wish) = paint
            .or_else(|| self.measured(polite, end))
            .or_else(|| self.goodbye(polite, end))
            .or_else(|| self.lacking(polite, end))
        {
            return Some(vec![vec![wish]]);
        }
        self.beginnings(start, end).into_iter().find_map(|begins| {
            let mood = if begins.wished { Mood::Wished } else { Mood::Plain };
            self.says(begins.at, end, mood)
        })
    }

    /// The order of the first verb that stands behind small words alone, and is understood.
    fn ordered(&mut self, start: usize, end: usize) -> Result<Option<Vec<Vec<Wish>>>, PlanError> {
        let mut refused = None;
        for begin in start..end {
            let Some((verb, count)) = self.order_at(begin, end) else { continue };
            // "A tow truck" is no order to tow.
            let is_noun = |word: &str| ["a", "an", "the", "my", "your", "our", "his", "its"].contains(&word);
            if begin > start && self.word(begin - 1).is_some_and(is_noun) {
                continue;
            }
            self.at = begin + count;
            self.at += self.particle(verb, end);
            let read = self.after(verb, end);
            // What else stands before a verb may change what is meant; but a thing that is not there is not there.
            if !self.is_preamble(start, begin) {
                if let Err(error @ PlanError::NotFound { .. }) = read
                    && !self.others_do(start, begin)
                {
                    refused = refused.or(Some(error));
                }
                continue;
            }
            match read {
                Ok(wishes) => return Ok(Some(wishes)),
                Err(error) => refused = refused.or(Some(error)),
            }
        }
        refused.map_or(Ok(None), Err)
    }

    /// Whether a size is told up to the end.
    fn has_size(&self, from: usize, end: usize) -> bool {
        (from..end).any(|at| {
            longest(&self.lexemes[at..end], &super::words::FACTORS).is_some_and(|(_, words)| words > 1)
                || longest_phrase(&self.lexemes[at..end], &["by"]).is_some()
                    && super::super::numbers::number(&self.lexemes[at + 1..end]).is_some()
        })
    }

    /// "Plop down a barrel", "put out two chairs": a particle between a verb and what is new.
    fn particle(&self, verb: Verb, end: usize) -> usize {
        let is_particle = matches!(
            self.word(self.at),
            Some("down" | "up" | "out" | "in" | "over" | "on" | "together" | "about")
        );
        let is_new = self.at + 1 < end
            && (longest_phrase(&self.lexemes[self.at + 1..end], &["a", "an", "some", "another", "one"])
                .is_some()
                || super::super::numbers::count(&self.lexemes[self.at + 1..end]).is_some());
        usize::from(matches!(verb, Verb::Add | Verb::Put) && is_particle && is_new)
    }

    /// What a verb asks for, with what stands behind it.
    fn after(&mut self, verb: Verb, end: usize) -> Result<Vec<Vec<Wish>>, PlanError> {
        if let Some(told) = self.told_otherwise(verb, end) {
            return told;
        }
        match verb {
            Verb::Add => self.adds(end),
            // "Put the bench ..." moves it, "put a bench ..." makes one.
            Verb::Put | Verb::Move if self.is_copies(end) => {
                self.copies(end).ok_or_else(|| self.not_understood("say what to copy"))
            }
            Verb::Put => self.put(end),
            Verb::Move => self.brings(end),
            Verb::Take => self.take(end),
            Verb::Remove => self.removes(end),
            Verb::Replace => self.replace(end),
            Verb::Turn => self.turns(end),
            Verb::Swap => self.swap(end),
            Verb::Paint => self.paints(end),
            // "Grow a tall hedge between the cottages".
            Verb::Grow if !self.is_definite(self.at) && !self.has_size(self.at, end) => self.additions(end),
            Verb::Grow => self.sized(end, 1.5),
            Verb::Shrink => self.sized(end, 1.0 / 1.5),
            Verb::Double => self.double(end),
            Verb::Copy => self.copy(end),
            Verb::Name => self.name(end),
            Verb::Count => self.count(end),
            Verb::List => self.list(end),
            Verb::Describe => {
                // "Tell me about your childhood" is about nothing of the scene.
                let of_you = self.word(self.at) == Some("your");
                let what = self
                    .one_to(end)
                    .map_err(|error| if of_you { self.not_understood(UNDERSTOOD) } else { error })?;
                Ok(vec![vec![Wish::Describe { what }]])
            }
            Verb::Make => self.make(end),
            Verb::Close | Verb::Open => self.closes(verb, end),
        }
    }

    /// What behind a verb asks for something else than the verb does alone: a place before a thing, a weather, a list, a colour.
    fn told_otherwise(&mut self, verb: Verb, end: usize) -> Option<Result<Vec<Vec<Wish>>, PlanError>> {
        if matches!(verb, Verb::Add | Verb::Put | Verb::Move)
            && self.word(self.at - 1) != Some("tow")
            && let Some(wishes) = self.place_then_thing(end)
        {
            return Some(Ok(wishes));
        }
        let one = |wish| Some(Ok(vec![vec![wish]]));
        if verb == Verb::Move
            && let Some(wish) = self.towed(self.at, end)
        {
            self.at = end;
            return one(wish);
        }
        if verb == Verb::Add
            && let Some(sky) = self.sky(end)
        {
            self.at = end;
            return one(Wish::Sky(sky));
        }
        if verb == Verb::Add && self.eat_any(LISTS) {
            return Some(self.list(end));
        }
        if matches!(verb, Verb::Paint | Verb::Make)
            && let Some(wish) = self.painted_as(self.at, end)
        {
            self.at = end;
            return one(wish);
        }
        None
    }

    // ---- things ----

    /// What the words name, all of them.
    pub(super) fn things(&self, start: usize, end: usize) -> Result<Vec<Reference>, PlanError> {
        let whole = self.one_of(start, end);
        if let Ok(what) = whole {
            return Ok(vec![what]);
        }
        // What stands in another sentence is listed with nothing: "the cars: the white one has to go".
        if self.lexemes[start..end].iter().rev().skip(1).any(|lexeme| lexeme.token == Token::Break) {
            return whole.map(|what| vec![what]);
        }
        // What stands somewhere is one thing.
        let is_list = !(start..end).any(|at| self.is_place(at));
        // "Both the truck and the hydrant" are one of each.
        let start = start + usize::from(matches!(self.word(start), Some("both")));
        for cut in (start + 1..end).rev() {
            // "The white car the black car and the green car".
            let unmarked = || (is_list && self.word(cut) == Some("the")).then_some(0);
            let Some(count) = joint(&self.lexemes[cut..end]).or_else(unmarked) else { continue };
            if self.stands_by_name(start, cut) {
                continue;
            }
            if let (Ok(mut before), Ok(last)) = (self.things(start, cut), self.one_of(cut + count, end)) {
                before.push(last);
                return Ok(before);
            }
        }
        whole.map(|what| vec![what])
    }

    /// "Fay next to the fountain", of whom the name says enough: in "... and Gus next to the statue" this is where she goes.
    fn stands_by_name(&self, start: usize, end: usize) -> bool {
        self.names.exact(&self.lexemes[start..end]).is_some_and(|(_, words)| {
            (start + words..end).any(|at| at < start + words + 2 && self.is_place(at))
        })
    }

    pub(super) fn one_to(&mut self, end: usize) -> Result<Reference, PlanError> {
        let what = self.one_of(self.at, end)?;
        self.at = end;
        Ok(what)
    }

    /// One thing that the words name, all of them but politeness.
    pub(super) fn one_of(&self, start: usize, end: usize) -> Result<Reference, PlanError> {
        self.memo.thing(said(self.lexemes.get(start..end).unwrap_or_default()), || self.look_up(start, end))
    }

    fn look_up(&self, start: usize, end: usize) -> Result<Reference, PlanError> {
        let end = self.before_politeness(start, end);
        if let Some(what) = self.all_but(start, end) {
            return Ok(what);
        }
        if let Some(each) = self.each_of_them(start, end).filter(|(_, words)| start + words == end) {
            return Ok(each.0);
        }
        if let Some(what) = self.share_of(start, end) {
            return what;
        }
        if let Some(what) = self.of_any_kind(start, end) {
            return what;
        }
        let me = longest_phrase(&self.lexemes[start..end], &["me", "myself", "you", "yourself", "i"]);
        if me == Some(end - start) {
            return Ok(Reference::to(Target::Here, "me".to_owned()));
        }
        let mut parser = self.parser(start, end);
        parser.eat_any(&["all of", "every single", "each and every"]);
        let any = parser.eat_any(&["any of", "any one of", "either of", "whichever of"]);
        let is_one = longest_phrase(parser.rest(), &["one of", "just one of", "only one of"]).is_some();
        let mut what = parser.reference(0)?;
        what.indefinite |= any;
        if (any || is_one)
            && what.count == super::super::clause::Count::One
            && matches!(what.target, Target::Any(_))
        {
            what.count = super::super::clause::Count::Exactly(1);
        }
        self.except(&mut parser, &mut what);
        if parser.at < end { Err(parser.not_understood("end here, or go on with \"and\"")) } else { Ok(what) }
    }

    /// A reader of the same words in another order, or without some of them.
    pub(super) fn over<'b>(&'b self, lexemes: &'b [Lexeme]) -> Reader<'b> {
        Reader { lexemes, at: 0, ..*self }
    }

    /// The parser of noun phrases, over some of the words.
    pub(super) fn parser(&self, start: usize, end: usize) -> Parser<'a> {
        let mut parser = Parser::new(self.words, &self.lexemes[..end.max(start)], self.names, self.view);
        parser.at = start;
        parser
    }

    // ---- the cursor ----

    pub(super) fn rest(&self, end: usize) -> &'a [Lexeme] {
        &self.lexemes[self.at.min(end)..end]
    }

    pub(super) fn word(&self, at: usize) -> Option<&'a str> {
        match &self.lexemes.get(at)?.token {
            Token::Word(word) => Some(word),
            _ => None,
        }
    }

    pub(super) fn eat_any<L: PhraseList + ?Sized>(&mut self, phrases: &L) -> bool {
        let count = longest_phrase(&self.lexemes[self.at..], phrases);
        self.at += count.unwrap_or(0);
        count.is_some()
    }

    pub(super) fn is_joint(&self, at: usize) -> bool {
        joint(&self.lexemes[at..]).is_some()
    }

    /// The words as they were written, without quotes around them.
    pub(super) fn written(&self, start: usize, end: usize) -> String {
        written(self.words, self.lexemes.get(start..end).unwrap_or_default()).to_owned()
    }

    fn skip_joints(&mut self) {
        self.skip_joints_to(self.lexemes.len());
    }

    /// Passes joints and politeness.
    pub(super) fn skip_joints_to(&mut self, end: usize) {
        while self.at < end {
            let count = joint(&self.lexemes[self.at..end]).unwrap_or(0).max(self.polite_at(self.at));
            if count == 0 {
                return;
            }
            self.at += count;
        }
    }

    pub(super) fn polite_at(&self, at: usize) -> usize {
        let rest = &self.lexemes[at.min(self.lexemes.len())..];
        let polite = longest_phrase(rest, POLITE).unwrap_or(0);
        // "Lets have a bench" is a wish.
        let verb = longest(rest, &VERBS).map_or(0, |(_, count)| count);
        let way = longest(rest, &super::words::WAYS).map_or(0, |(_, count)| count);
        if verb.max(way) >= polite { 0 } else { polite }
    }

    /// "The door on my right": no "right?".
    fn is_side(&self, at: usize) -> bool {
        self.word(at) == Some("right") && matches!(self.word(at - 1), Some("my" | "our" | "your"))
    }

    /// Where the words end without politeness behind them.
    pub(super) fn before_politeness(&self, start: usize, mut end: usize) -> usize {
        loop {
            let cut = (start + 1..end).rev().find(|at| {
                longest_phrase(&self.lexemes[*at..end], CODA) == Some(end - at) && !self.is_side(*at)
                    || matches!(self.lexemes[*at].token, Token::Comma | Token::Break) && at + 1 == end
            });
            match cut {
                Some(cut) => end = cut,
                None => return end,
            }
        }
    }

    /// The answer when the words from here on make no sense.
    pub(super) fn not_understood(&self, hint: &str) -> PlanError {
        self.parser(self.at.min(self.lexemes.len()), self.lexemes.len()).not_understood(hint)
    }
}
