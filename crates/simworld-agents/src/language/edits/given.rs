//! Conditions: "if there is no bench near the fountain, add one"; and what is left out: "all cars except the red one".

use simworld_core::seam::PlanError;

use super::super::clause::{Count, Reference, Target};
use super::super::lexer::Token;
use super::super::lexicon::{longest, longest_phrase};
use super::super::paint::PAINTS;
use super::super::parser::Parser;
use super::parse::{Reader, joint};
use super::wish::Wish;

/// If there is something.
#[rustfmt::skip]
const IF: &[&str] = &["if there is", "if there are", "if you find", "if you see", "in case there is", "if we have",
    "provided there is", "when there is", "should there be", "if there exists", "as long as there is"];
/// If there is nothing of the kind.
#[rustfmt::skip]
const UNLESS: &[&str] = &["unless there is", "unless there are", "unless you find", "unless we have", "if there isnt",
    "if there is not", "if there arent", "if there are not", "if we dont have", "unless you see", "if you find no"];
/// What is not meant.
#[rustfmt::skip]
const EXCEPT: &[&str] = &["except", "except for", "but", "apart from", "other than", "but not", "besides", "excluding", "save",
    "with the exception of", "not counting", "not", "without", "but leave", "but keep", "but spare", "leaving", "keeping", "sparing",
    "but leave out", "but not for", "leaving out", "only not", "and leave", "and keep"];

/// What is not so of those that are meant.
#[rustfmt::skip]
const IS_NOT: &[&str] = &["that is not", "that are not", "which is not", "which are not", "that isnt", "that arent", "who is not", "who are not", "not being",
    "that is not painted", "that are not painted", "which isnt", "which arent"];

impl Reader<'_> {
    /// A wish on a condition, before it or behind it.
    pub(super) fn given(&mut self, end: usize) -> Result<Option<Vec<Vec<Wish>>>, PlanError> {
        let start = self.at;
        let is_condition = |at: usize| {
            let rest = &self.lexemes[at..end];
            let unless = longest_phrase(rest, UNLESS).map(|words| (false, words));
            unless.or(longest_phrase(rest, IF).map(|words| (true, words))).or_else(|| self.is_so(at, end))
        };
        let Some((at, (there, words))) = (start..end).find_map(|at| Some((at, is_condition(at)?))) else {
            return Ok(None);
        };
        let from = at + words;
        let none = longest_phrase(&self.lexemes[from..end], &["no", "not any", "not a single", "none"]);
        let (there, from) = (there && none.is_none(), from + none.unwrap_or(0));
        if at > start {
            // "Put a bench there unless there is one": the wish stands before it.
            let what = self.coloured(from, end).map_or_else(|| self.one_of(from, end), Ok)?;
            let mut what = what;
            let mut reader = Reader { at: start, ..*self };
            let stop = if joint(&self.lexemes[at - 1..at]).is_some() { at - 1 } else { at };
            let wishes = reader.wish(stop)?;
            if super::says::is_it(&what) {
                // "Remove the hydrant unless it is red".
                let object = wishes.first().and_then(|readings| readings.first()?.object().cloned());
                let Some(object) = object else {
                    return Err(self.not_understood("say what the condition is about"));
                };
                what.traits = super::super::clause::Traits { paint: what.traits.paint, ..object.traits };
                what = Reference { traits: what.traits, ..object };
            }
            self.at = end;
            return Ok(Some(on_condition(wishes, &what, there)));
        }
        let ends = |at: &usize| {
            matches!(self.lexemes[*at].token, Token::Comma | Token::Break)
                || longest_phrase(&self.lexemes[*at..end], &["then"]).is_some()
        };
        let Some(cut) = (from + 1..self.lexemes.len().min(end)).find(ends) else {
            self.at = end;
            return Err(self.not_understood("put a comma behind the condition"));
        };
        let what = self.coloured(from, cut).map_or_else(|| self.one_of(from, cut), Ok)?;
        self.at = cut + 1;
        self.skip_joints_to(end);
        if super::says::is_it(&what) {
            return Err(self.not_understood("say what the condition is about"));
        }
        let wishes = match self.one_of_those(&what, end) {
            Some(wish) => vec![vec![wish]],
            None => self.wish(end)?,
        };
        Ok(Some(on_condition(wishes, &what, there)))
    }

    /// "If Ada is in the park": how a thing that is there stands.
    fn is_so(&self, at: usize, end: usize) -> Option<(bool, usize)> {
        let words = longest_phrase(
            &self.lexemes[at..end],
            &["if", "unless", "only if", "in case", "provided", "provided that", "as long as"],
        )?;
        let is_unless = self.word(at) == Some("unless");
        let cut = (at + words..end).find(|at| joint(&self.lexemes[*at..end]).is_some()).unwrap_or(end);
        if self.coloured(at + words, cut).is_some() {
            return Some((!is_unless, words));
        }
        let mut parser = self.parser(at + words, end);
        let what = parser.reference(0).ok()?;
        let stands = what.relation.is_some() && matches!(what.target, Target::Any(_) | Target::Named(_));
        let ends = parser.at >= end || joint(&self.lexemes[parser.at..end]).is_some();
        (stands && ends).then_some((!is_unless, words))
    }

    /// "The truck is orange": the truck that is.
    fn coloured(&self, from: usize, end: usize) -> Option<Reference> {
        let end = self.before_politeness(from, end);
        let cut =
            (from + 1..end).find(|at| longest_phrase(&self.lexemes[*at..end], &["is", "are"]).is_some())?;
        let (paint, words) = longest(&self.lexemes[cut + 1..end], PAINTS)?;
        let mut what = self.one_of(from, cut).ok().filter(|_| cut + 1 + words == end)?;
        what.traits.paint = Some(paint);
        Some(what)
    }

    /// "Add one": of what was just asked for, and where.
    fn one_of_those(&mut self, what: &Reference, end: usize) -> Option<Wish> {
        let stop = self.before_politeness(self.at, end);
        let adds = longest_phrase(
            self.rest(stop),
            &["add", "put", "place", "build", "make", "create", "plant", "set up", "add me"],
        )?;
        let words = longest_phrase(
            &self.lexemes[self.at + adds..stop],
            &["one", "one there", "one here", "a new one"],
        )?;
        let Target::Any(class) = &what.target else { return None };
        let from = self.at + adds + words;
        let at = if from < stop {
            let mut reader = Reader { at: from, ..*self };
            reader.places(stop).ok().filter(|_| reader.at >= stop)?
        } else {
            let Some(super::super::clause::Stands::To(relation, anchor)) = &what.relation else {
                return None;
            };
            vec![super::wish::Where::To(*relation, super::wish::Anchor::Thing((**anchor).clone()))]
        };
        let thing = super::wish::NewThing {
            words: class.words[0].split(' ').map(str::to_owned).collect(),
            count: 1,
            paint: what.traits.paint,
            scale: 1.0,
            name: None,
            text: class.words[0].to_owned(),
        };
        self.at = end;
        Some(Wish::Add { things: vec![thing], at })
    }

    /// "Except the red one", behind a thing.
    pub(super) fn except(&self, parser: &mut Parser<'_>, what: &mut Reference) {
        let start = parser.at;
        let plural = what.count == Count::All || matches!(what.target, Target::Any(_));
        if self.view.streets.is_some() && plural && parser.eat_any(IS_NOT) {
            if let Some((paint, words)) = longest(parser.rest(), PAINTS) {
                parser.at += words;
                let mut except = Reference { count: Count::All, ..what.clone() };
                except.traits.paint = Some(paint);
                what.except = Some(Box::new(except));
                return;
            }
            parser.at = start;
        }
        if self.view.streets.is_some() && plural && parser.eat_any(EXCEPT) {
            parser.class = if let Target::Any(class) = &what.target { Some(class) } else { None };
            if let Ok(except) = parser.reference(1) {
                what.except = Some(Box::new(except));
                return;
            }
        }
        parser.at = start;
    }
}

fn on_condition(wishes: Vec<Vec<Wish>>, what: &Reference, there: bool) -> Vec<Vec<Wish>> {
    let given = |wish| Wish::Given { what: what.clone(), there, then: Box::new(wish) };
    wishes.into_iter().map(|readings| readings.into_iter().map(given).collect()).collect()
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    IF.iter().chain(UNLESS).chain(EXCEPT).chain(IS_NOT).flat_map(|phrase| phrase.split(' '))
}
