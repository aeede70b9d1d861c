//! How many by what there is: "half of the cars", "as many stools as there are people".

use simworld_core::seam::PlanError;

use super::super::clause::{Choice, Count, Reference, Target};
use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{longest, longest_phrase};
use super::super::phrases::Phrases;
use super::super::resolve::Purpose;
use super::parse::Reader;

/// A share of several things.
#[rustfmt::skip]
const SHARES: &[(&[&str], f64)] = &[
    (&["half of", "half", "one half of", "a half of", "half of all", "half of all of"], 0.5),
    (&["a third of", "one third of", "a third of all"], 1.0 / 3.0),
    (&["two thirds of", "two thirds of all"], 2.0 / 3.0),
    (&["a quarter of", "one quarter of", "a quarter of all", "a fourth of"], 0.25),
    (&["three quarters of", "three quarters of all"], 0.75),
];
/// More than half of several things, and no share of them.
const MOST: &[&str] = &[
    "most of",
    "most",
    "the majority of",
    "more than half of",
    "most of all",
    "the greater part of",
    "the better part of",
];
/// Behind "as many", of what there are so many.
#[rustfmt::skip]
const AS_THERE_ARE: &Phrases = &Phrases::of(&["as there are", "as we have", "as there", "as you see", "as the number of", "as you can see", "as we see", "as there already are", "as there are already", "as we have got"]);

impl Reader<'_> {
    /// "Half of the cars": any of them, if that makes a whole number.
    pub(super) fn share_of(&self, start: usize, end: usize) -> Option<Result<Reference, PlanError>> {
        let rest = self.lexemes.get(start..end)?;
        let most = longest_phrase(rest, MOST);
        let (share, words) = most.map(|words| (0.5, words)).or_else(|| longest(rest, SHARES))?;
        let from = start + words;
        // "Most lamps", and "half of the lamps".
        if !self.is_certain(from) && (most.is_none() || rest.get(words).is_none_or(is_mark)) {
            return None;
        }
        let what = self.one_of(from, end).ok().filter(super::resolve::plural)?;
        let all = self.how_many(&what);
        // As many as are more than half; of two that is no part.
        let number = if most.is_some() { (all / 2 + 1) as f64 } else { all as f64 * share };
        let is_part = most.is_none() || all > 2;
        if (number - number.round()).abs() > 1e-6 || number < 0.5 || !is_part {
            return Some(Err(self.not_understood("say how many of them")));
        }
        let text = self.written(start, end);
        Some(Ok(Reference { count: Count::Exactly(number.round() as u32), indefinite: true, text, ..what }))
    }

    /// "Each of them", "every one of those", "each": all that were spoken of, and how many words say so.
    pub(super) fn each_of_them(&self, at: usize, end: usize) -> Option<(Reference, usize)> {
        #[rustfmt::skip]
        const EACH: &Phrases = &Phrases::of(&["each of them", "every one of them", "all of them", "each of those", "each of these", "every one of those", "each one of them", "both of them", "all three of them", "each and every one of them",
            "each single one of them", "every single one of them", "all of those", "all of these", "them all", "any of them"]);
        // Alone at the end they say no more.
        const ALONE: &[&str] =
            &["each", "each one", "every one", "every single one", "each single one", "all", "both"];
        let rest = self.lexemes.get(at..end)?;
        let words = longest_phrase(rest, EACH)
            .or_else(|| longest_phrase(rest, ALONE).filter(|words| *words == rest.len()))?;
        if self.word(at) == Some("any") {
            return None;
        }
        let text = "each of them".to_owned();
        Some((Reference { count: Count::All, ..Reference::to(Target::Them, text) }, words))
    }

    /// How many there are of what words name.
    pub(super) fn how_many(&self, what: &Reference) -> usize {
        // The farthest of all is looked for everywhere, and so all of them are found.
        let all = |what: &Reference| {
            let all = Reference { count: Count::One, choice: Choice::Farthest, ..what.clone() };
            self.view.candidates(&all, Purpose::Any).unwrap_or_default()
        };
        let (found, spared) = (all(what), what.except.as_deref().map(all).unwrap_or_default());
        found.iter().filter(|(_, id)| spared.iter().all(|(_, other)| other != id)).count()
    }

    /// The words with a number for "as many ... as there are ...".
    pub(super) fn with_number(&self) -> Option<Vec<Lexeme>> {
        let all = self.lexemes.len();
        let at = (0..all).find(|at| longest_phrase(&self.lexemes[*at..], &["as many"]).is_some())?;
        let (cut, words) =
            (at + 3..all).find_map(|cut| Some((cut, longest_phrase(&self.lexemes[cut..], AS_THERE_ARE)?)))?;
        let from = cut + words;
        let (what, stop) = (from + 1..=all).rev().find_map(|stop| {
            let what = self.one_of(from, stop).ok()?;
            matches!(what.target, Target::Any(_)).then_some((what, stop))
        })?;
        let number = self.how_many(&what);
        if number == 0 {
            return None;
        }
        let number = Lexeme { token: Token::Number(number as f64), lemma: None, ..self.lexemes[at].clone() };
        let mut plain = self.lexemes[..at].to_vec();
        plain.push(number);
        plain.extend_from_slice(&self.lexemes[at + 2..cut]);
        plain.extend_from_slice(&self.lexemes[stop..]);
        Some(plain)
    }
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    let shares = SHARES.iter().flat_map(|(words, _)| *words);
    shares.chain(MOST).chain(AS_THERE_ARE).flat_map(|phrase| phrase.split(' '))
}
