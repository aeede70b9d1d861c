//! Names that things are given.

use simworld_core::seam::PlanError;

use super::super::clause::{Reference, Target};
use super::super::lexer::{Token, is_mark};
use super::super::lexicon::{longest, longest_phrase};
use super::super::phrases::Phrases;
use super::parse::Reader;
use super::statements;
use super::wish::Wish;

/// Between a thing and the name that it has from then on.
const IS_NOW: &[&str] = &[
    "he is",
    "she is",
    "it is",
    "hes",
    "shes",
    "its",
    "he is now",
    "she is now",
    "it is now",
    "he will be",
    "she will be",
    "it will be",
    "he should be",
    "she should be",
    "it should be",
    "he should be called",
    "she should be called",
    "it should be called",
    "he is called",
    "she is called",
    "it is called",
];

/// Behind these a place goes on with "to".
const NEARBY: &[&str] = &["closest", "nearest", "next", "close", "closer", "nearer"];

impl Reader<'_> {
    pub(super) fn name(&mut self, end: usize) -> Result<Vec<Vec<Wish>>, PlanError> {
        let start = self.at;
        // "Rename Rose Park to ..." is about no shorter name; else it is the shortest thing that is one, and the rest is the name.
        let before_to = (start + 1..end).filter(|at| {
            self.quoted(*at).is_none()
                && longest_phrase(&self.lexemes[*at..end], &["to", "as", "into"]).is_some()
                && !self.word(at - 1).is_some_and(|word| NEARBY.contains(&word))
        });
        for cut in before_to.chain(start + 1..end) {
            let Ok(what) = self.one_of(start, cut) else { continue };
            // "Call that a tree? It should be ..." names nothing.
            if self.lexemes[cut].token == Token::Break
                && self.words[self.lexemes[cut].start..].trim_start().starts_with('?')
            {
                return Err(self.not_understood("say what to name, and how"));
            }
            let mut from = cut;
            // "Rename the dog, he is Rex from now on".
            if is_mark(&self.lexemes[cut - 1])
                && let Some(words) = longest_phrase(&self.lexemes[cut..end], IS_NOW)
            {
                from += words;
            }
            from += longest_phrase(&self.lexemes[cut..end], &["to", "as", "into", "it"]).unwrap_or(0);
            let is_later = self.quoted(from.min(end - 1)).is_none()
                && (from + 1..end).any(|at| self.quoted(at).is_some());
            if from >= end
                || is_mark(&self.lexemes[from]) && self.quoted(from + 1).is_none()
                || is_later
                || self.tells_which(cut, end)
                || longest(&self.lexemes[from..end], &super::words::WAYS).is_some()
            {
                continue;
            }
            if matches!(
                what.target,
                Target::Any(_) | Target::Named(_) | Target::It | Target::Them | Target::Id(_)
            ) {
                return self.given_name(what, from, end);
            }
        }
        Err(self.not_understood("say what to name, and how"))
    }

    /// "The oak | nearest to me", "the tree shorter than 8.5 | m": what goes on so in small letters still tells which thing is meant.
    fn tells_which(&self, cut: usize, end: usize) -> bool {
        #[rustfmt::skip]
        const WHICH: &Phrases = &Phrases::of(&["nearest to", "nearest the", "nearest me", "closest to", "closest the", "closest me", "farthest from", "furthest from", "farthest away", "furthest away", "taller than", "shorter than", "higher than", "lower than",
            "bigger than", "larger than", "smaller than", "that is", "that stands", "which is", "which stands", "who is", "who stands"]);
        let rest = &self.lexemes[cut..end];
        let is_small = rest
            .first()
            .is_some_and(|first| self.words[first.start..].starts_with(|first: char| !first.is_uppercase()));
        let is_unit = || {
            matches!(self.lexemes[cut - 1].token, Token::Number(_))
                && longest(rest, super::super::numbers::UNITS).is_some()
        };
        let is_to = || {
            matches!(self.word(cut), Some("to" | "from"))
                && self.word(cut - 1).is_some_and(|word| NEARBY.contains(&word))
        };
        is_small
            && self.quoted(cut).is_none()
            && (longest_phrase(rest, WHICH).is_some() || is_unit() || is_to())
    }

    /// The name that stands from a place on, and what else is named behind it.
    fn given_name(&mut self, what: Reference, from: usize, end: usize) -> Result<Vec<Vec<Wish>>, PlanError> {
        // Behind a name in quotes goes on what else is asked for.
        let quoted = self.quoted(from);
        let closes = quoted.as_ref().map(|name| self.lexemes[from].start + name.len());
        let after = |close: usize| (from..end).find(|at| self.lexemes[*at].start >= close);
        let goes_on = closes.and_then(after).filter(|at| self.is_joint(*at)).unwrap_or(end);
        // "Name the statue Bob and the fountain Alice".
        let other = (from + 1..end).filter(|_| quoted.is_none()).find_map(|at| {
            let words = longest_phrase(&self.lexemes[at..end], &["and"])
                .filter(|words| self.is_certain(at + words))?;
            let mut reader = Reader { at: at + words, ..*self };
            Some((at, reader.name(end).ok()?))
        });
        let mut stop = other.as_ref().map_or(end, |(at, _)| *at);
        if quoted.is_none() {
            // "Call him Tinker, he deserves a nice name": the name ends before the remark.
            if (from + 1..stop).any(|at| self.begins_remark(at, stop)) {
                return Err(self.not_understood("say what to name, and how"));
            }
            // "Name the statue Rosa and make it larger": the name ends before what else is ordered.
            if (from + 1..stop).any(|at| self.goes_on_with_order(at, stop)) {
                return Err(self.not_understood("say what to name, and how"));
            }
            stop = self.without_thanks(from, stop);
        }
        while stop > from + 1 && is_mark(&self.lexemes[stop - 1]) {
            stop -= 1;
        }
        self.at = goes_on;
        let name = quoted.unwrap_or_else(|| self.written(from, stop));
        let wishes = std::iter::once(vec![Wish::Name { what, name }]);
        Ok(wishes.chain(other.into_iter().flat_map(|(_, more)| more)).collect())
    }

    /// Whether a mark stands here and behind it what somebody says of a thing.
    fn begins_remark(&self, at: usize, end: usize) -> bool {
        let is_told = || statements::tells(&self.lexemes[at + 1..end], self.names);
        let is_begun = || {
            longest_phrase(
                &self.lexemes[at + 1..end],
                &[
                    "he",
                    "she",
                    "it",
                    "its",
                    "they",
                    "hes",
                    "shes",
                    "theyre",
                    "that",
                    "this",
                    "because",
                    "since",
                    "i",
                    "we",
                    "the",
                    "my",
                    "our",
                    "so",
                    "everybody",
                    "everyone",
                    "people",
                ],
            )
            .is_some()
        };
        is_mark(&self.lexemes[at]) && (is_begun() || is_told())
    }

    /// Whether "and" stands here and behind it an order about something; "Stand and Deliver" is a name.
    fn goes_on_with_order(&self, at: usize, end: usize) -> bool {
        #[rustfmt::skip]
        const ABOUT: &[&str] = &["it", "him", "her", "them", "the", "that", "this", "a", "an", "my", "our", "another", "two", "three", "four", "some", "all", "both", "every", "each", "one"];
        let Some(and) = longest_phrase(&self.lexemes[at..end], &["and", "and then", "then"]) else {
            return false;
        };
        let next = at + and;
        if next >= end || self.words[self.lexemes[next].start..].starts_with(char::is_uppercase) {
            return false;
        }
        self.order_at(next, end).is_some_and(|(_, words)| {
            let what = next + words;
            let is_sky = || longest(&self.lexemes[what..end], &super::words::SKIES).is_some();
            what < end && (self.word(what).is_some_and(|word| ABOUT.contains(&word)) || is_sky())
        })
    }

    /// Where a name ends without thanks behind it.
    fn without_thanks(&self, from: usize, end: usize) -> usize {
        const THANKS: &[&str] = &[
            "please",
            "pls",
            "thanks",
            "thank you",
            "from now on",
            "from today on",
            "henceforth",
            "ok",
            "okay",
            "will you",
            "would you",
            "instead",
        ];
        let last = self.lexemes[..end].iter().rposition(|lexeme| !is_mark(lexeme)).map_or(end, |at| at + 1);
        let is_last = |at: &usize| longest_phrase(&self.lexemes[*at..last], THANKS) == Some(last - at);
        (from + 1..last).find(is_last).unwrap_or(end)
    }

    /// What stands between quotation marks from here on.
    pub(super) fn quoted(&self, from: usize) -> Option<String> {
        let start = self.lexemes.get(from)?.start;
        let mark = self.words[..start].chars().next_back().filter(|mark| ['\'', '"'].contains(mark))?;
        // "'Mayor's Library'" ends with its last mark: behind one that ends it stands no letter.
        let rest = &self.words[start..];
        let closes = |at: &usize| !rest[at + mark.len_utf8()..].starts_with(char::is_alphanumeric);
        let end = rest.match_indices(mark).map(|(at, _)| at).find(closes)?;
        Some(rest[..end].to_owned())
    }
}
