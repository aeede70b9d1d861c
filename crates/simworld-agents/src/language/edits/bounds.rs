//! Where one wish ends and the next begins.

use super::super::lexer::Token;
use super::super::lexicon::{longest, longest_phrase};
use super::parse::{Reader, joint};
use super::words::{VERBS, Verb, WAYS};

impl Reader<'_> {
    /// Where the wish that begins here ends: before a joint with a verb behind it, or at the end of the words.
    pub(super) fn boundary(&self) -> usize {
        let mut at = self.at + 1;
        let conditional = self.begins_condition();
        while at < self.lexemes.len() {
            if let Some(count) = joint(&self.lexemes[at..]) {
                let mut next = at + count;
                while next < self.lexemes.len() {
                    let more = joint(&self.lexemes[next..]).unwrap_or(0).max(self.polite_at(next));
                    if more == 0 {
                        break;
                    }
                    next += more;
                }
                let goes_on =
                    longest_phrase(&self.lexemes[next..], &["put one", "place one", "stick one", "set one"]);
                let begins = next < self.lexemes.len()
                    && goes_on.is_none()
                    && self
                        .order_at(next, self.lexemes.len())
                        .is_some_and(|(verb, _)| !matches!(verb, Verb::Put | Verb::Take) || !self.is_copy());
                let speaks = self.lexemes[at].token == Token::Break
                    && next < self.lexemes.len()
                    && self.has_verb(self.at, at);
                // What is joined on a condition stands on it too, up to the end of the sentence.
                let belongs =
                    conditional && (self.lexemes[at].token != Token::Break || self.goes_on_otherwise(next));
                let cuts = begins && (self.has_verb_or_sky(self.at, at) || self.says_how_it_should_be(at));
                if (cuts || speaks) && !belongs {
                    return at;
                }
                at = next.max(at + 1);
            } else {
                at += 1;
            }
        }
        self.lexemes.len()
    }

    /// The verb of an order that stands here: "close to the school" is where, and no order to close it.
    pub(super) fn order_at(&self, at: usize, end: usize) -> Option<(Verb, usize)> {
        let rest = &self.lexemes[at..end];
        let way = longest(rest, &WAYS).map_or(0, |(_, words)| words);
        // "Park benches" are no order to park, nor is a trash bin one to trash.
        let is_asset = |words: usize| self.names.asset_words(rest).is_some_and(|asset| asset > words.max(1));
        longest(rest, &VERBS)
            .filter(|(_, words)| way <= *words && !is_asset(*words) && !self.ends_longer_noun(at, end))
    }

    /// "The trash bin that is closest" is no order to bin anything.
    pub(super) fn ends_longer_noun(&self, at: usize, end: usize) -> bool {
        (1..=at.min(2)).any(|back| {
            let phrase = &self.lexemes[at - back..end];
            let words = super::super::lexicon::category(phrase).map_or(0, |(_, words)| words);
            words.max(self.names.asset_words(phrase).unwrap_or(0)) > back
        })
    }

    /// "Copy the fountain and put the copy ..." is one wish.
    fn is_copy(&self) -> bool {
        longest(&self.lexemes[self.at..], &VERBS).is_some_and(|(verb, _)| verb == Verb::Copy)
    }

    fn says_how_it_should_be(&self, end: usize) -> bool {
        let ought: &[&str] =
            &["should", "must", "would look better", "has to", "needs to", "ought to", "is missing", "lacks"];
        (self.at..end).any(|at| longest_phrase(&self.lexemes[at..end], ought).is_some())
    }

    pub(super) fn has_verb(&self, start: usize, end: usize) -> bool {
        (start..end).any(|at| self.order_at(at, end).is_some() && !self.is_in_noun(start, at))
    }

    fn has_verb_or_sky(&self, start: usize, end: usize) -> bool {
        self.has_verb(start, end)
            || (start..end).any(|at| longest(&self.lexemes[at..end], &super::words::SKIES).is_some())
    }
}
