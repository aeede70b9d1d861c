//! Clauses that name nothing of the scene, left out where a sentence is not understood with them: "I'm making an inventory, tedious work, let
//! me tell you: how many lamps are there?"
//!
//! A clause stands between marks. It is left out only if it names no thing, new thing, colour, weather or place, asks for nothing, sets no
//! condition and takes nothing back. What is left is read as any sentence, and stays refused if it makes no sense.

use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{longest, longest_phrase};
use super::super::numbers;
use super::super::paint::PAINTS;
use super::super::phrases::Phrases;
use super::parse::Reader;
use super::words::{SKIES, VERBS};

/// What may stand before a clause.
#[rustfmt::skip]
const SMALL: &Phrases = &Phrases::of(&["and", "so", "but", "oh", "well", "yes", "yeah", "no", "hm", "hmm", "ah", "er", "erm", "um", "ok", "okay", "then", "right", "now", "anyway", "because", "since", "as", "for", "though"]);
/// What reads like an order, and asks for nothing.
#[rustfmt::skip]
pub(super) const IDLE: &Phrases = &Phrases::of(&["let me think", "let me see", "let me tell", "let me say", "let me guess", "let me start", "let me be", "let me put it", "let me just say", "lets see", "lets try", "lets tidy", "lets begin", "lets not", "lets say", "lets teach", "lets face it", "shall we", "tell me", "make no mistake", "do me a favour", "do me a favor", "do us a favour", "go on", "go ahead", "be a dear", "be a love", "be an angel", "be a sport", "hang on", "hold on", "bear with me", "listen", "trust me",
    "mind you", "remember", "imagine", "guess what", "come on", "dont ask", "dont get me wrong", "dont worry", "dont mind", "dont laugh", "dont you", "you wont believe", "believe me", "take my word", "say no more", "remind me", "give me a second", "give me a moment", "give it a go", "fine by me",
    "have a guess", "have a heart", "make of that what you will", "call me old fashioned", "call me crazy", "call it a hunch", "stop me if", "ask me", "what a", "wait for it", "get this", "look", "see", "mark my words", "better safe", "before you ask", "reel them off", "rattle them off", "just rattle them off", "read them out", "you understand", "you see", "you know", "you follow me", "bring it on", "kill me", "shoot me", "sue me"]);
/// Sets a condition, or says when.
#[rustfmt::skip]
const SETS: &Phrases = &Phrases::of(&["if", "unless", "when", "once", "in case", "suppose", "supposing", "provided", "as soon as", "as long as", "only if", "should", "assuming", "after", "until"]);
/// By these a clause may change what is asked for.
#[rustfmt::skip]
const CHANGES: &Phrases = &Phrases::of(&["no wait", "wait no", "i mean", "i meant", "scratch that", "correction", "undo", "never mind", "forget", "instead", "rather", "except", "but not", "not the", "not a", "not that one", "or the", "or a", "or an", "another", "one more", "the same", "twice", "double", "as well",
    "each", "other", "others", "either", "neither", "ditto", "likewise", "stop", "cancel", "take it back", "change my mind", "changed my mind", "leave", "keep", "everything", "anything", "the whole", "wish", "wants", "want", "need", "needs", "must", "ought", "deserve", "deserves", "lacks", "lack", "would like", "id like", "wed like",
    "could use", "could do with"]);
/// Behind a colon, a question.
const ASKS: &Phrases =
    &Phrases::of(&["how many", "which", "what is", "whats", "list", "count", "how much", "describe"]);

impl Reader<'_> {
    /// The words without the clauses that name nothing, if there are such and others.
    pub(super) fn without_idle_clauses(&self, lexemes: &[Lexeme]) -> Option<Vec<Lexeme>> {
        let reader = Reader { lexemes, at: 0, ..*self };
        let question = reader.question_behind_colon();
        let lexemes = &lexemes[question.unwrap_or(0)..];
        let reader = Reader { lexemes, ..reader };
        let mut kept: Vec<Lexeme> = Vec::with_capacity(lexemes.len());
        let (mut left_out, mut from) = (question.is_some(), 0);
        let (mut asked, mut is_behind) = (false, false);
        for unit in lexemes.split_inclusive(is_mark) {
            let end = from + unit.iter().filter(|lexeme| !is_mark(lexeme)).count();
            if from < end && reader.is_idle_clause_of(from, end, asked) {
                (left_out, is_behind) = (true, true);
                // What stood before it ends with its mark.
                if let (Some(last), Some(mark)) = (kept.last_mut(), unit.last().filter(|last| is_mark(last)))
                    && mark.token == Token::Break
                {
                    if is_mark(last) {
                        *last = mark.clone();
                    } else {
                        kept.push(mark.clone());
                    }
                }
            } else {
                let begin = reader.behind_idle_words(from, end);
                left_out |= begin > from;
                // "Not to be gloomy, but a bench ...": nothing is left that it could be told against.
                let is_first = is_behind && kept.iter().all(is_mark);
                let begin = if is_first { begin.max(from + reader.small_words_at(from)) } else { begin };
                (asked, is_behind) = (true, false);
                kept.extend_from_slice(&lexemes[begin..from + unit.len()]);
            }
            from += unit.len();
        }
        (left_out && kept.iter().any(|lexeme| !is_mark(lexeme))).then_some(kept)
    }

    /// "I've a bet with Eve, so I have to know: how many trees are there?": where the question begins.
    fn question_behind_colon(&self) -> Option<usize> {
        let colon = (1..self.lexemes.len()).rev().find(|at| {
            self.words.get(self.lexemes[*at].start..).is_some_and(|rest| rest.starts_with(':'))
                && longest_phrase(self.lexemes.get(at + 1..).unwrap_or_default(), ASKS).is_some()
        })?;
        let mut from = 0;
        for unit in self.lexemes[..=colon].split_inclusive(is_mark) {
            let words = from + self.small_words_at(from);
            let end = from + unit.len();
            if longest(&self.lexemes[words..end], &VERBS).is_some()
                && longest_phrase(&self.lexemes[words..end], IDLE).is_none()
            {
                return None;
            }
            from = end;
        }
        Some(colon + 1)
    }

    fn small_words_at(&self, from: usize) -> usize {
        let mut words = 0;
        while let Some(small) = longest_phrase(&self.lexemes[from + words..], SMALL) {
            words += small;
        }
        words
    }

    /// "Let's teach him a lesson and put a cone there", "go ahead and add it": where the order begins.
    fn behind_idle_words(&self, from: usize, end: usize) -> usize {
        let start = from + self.small_words_at(from).min(end - from);
        if longest_phrase(&self.lexemes[start..end], IDLE).is_none() {
            return from;
        }
        (start + 1..end)
            .find(|at| self.word(at - 1) == Some("and") && longest(&self.lexemes[*at..end], &VERBS).is_some())
            .filter(|at| self.names_nothing_at_all(start, at - 1))
            .unwrap_or(from)
    }

    /// Whether a clause names nothing and asks for nothing; behind a request it tells no number either.
    fn is_idle_clause_of(&self, from: usize, end: usize, asked: bool) -> bool {
        let start = from + self.small_words_at(from).min(end - from);
        let words = &self.lexemes[start..end];
        if words.is_empty() {
            return true;
        }
        let is_idle = longest_phrase(words, IDLE).is_some();
        let any = |phrases: &Phrases| {
            (start..end).any(|at| longest_phrase(&self.lexemes[at..end], phrases).is_some())
        };
        let numbered = || {
            (start..end)
                .any(|at| numbers::number(&self.lexemes[at..end]).is_some_and(|(number, _)| number > 1.0))
        };
        let orders = || {
            longest(words, &VERBS).is_some() || longest_phrase(words, super::told::ORDERS_ANYTHING).is_some()
        };
        // "Let's get rid of both" asks for something, whatever stands before it; "..., not too close" says how.
        let is_those =
            |at: usize| matches!(self.word(at), Some("it" | "them" | "both" | "those" | "these" | "all"));
        let asks_of_those = || {
            (start..end).any(|at| {
                longest(&self.lexemes[at..end], &VERBS)
                    .is_some_and(|(_, words)| (at + words..end.min(at + words + 2)).any(is_those))
            })
        };
        let says_how = || {
            let is_said = self.tells_with_verb(start, end)
                || words.len() == 1 && self.word(start).is_some_and(|word| word.ends_with("ly"));
            !is_said || matches!(self.word(start), Some("not" | "without" | "just" | "only" | "upside"))
        };
        longest_phrase(words, SETS).is_none()
            && !asks_of_those()
            && (is_idle || !asked || !says_how())
            && (is_idle || !orders())
            && !any(CHANGES)
            && !(asked && numbered())
            && self.names_nothing_at_all(start, end)
            && (is_idle || !self.is_asked_by_itself(words))
    }

    /// Whether no thing, new thing, colour, weather, place or street is named.
    fn names_nothing_at_all(&self, from: usize, end: usize) -> bool {
        let told = |at: usize| {
            let rest = &self.lexemes[at..end];
            let is_new = at > from
                && matches!(
                    self.word(at - 1),
                    Some("a" | "an" | "some" | "the" | "more" | "two" | "three" | "four")
                )
                && self.names.asset_words(rest).is_some();
            is_new
                || longest(rest, PAINTS).is_some()
                || longest(rest, &SKIES).is_some()
                || super::sky::hour(rest).is_some()
        };
        self.names_nothing(from, end) && !(from..end).any(told)
    }

    /// Whether a clause is a request by itself.
    fn is_asked_by_itself(&self, words: &[Lexeme]) -> bool {
        let memo = super::memo::Memo::default();
        Reader { lexemes: words, at: 0, memo: &memo, ..*self }.sentence().is_ok()
    }
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    [SMALL, IDLE, SETS, CHANGES, ASKS].into_iter().flatten().flat_map(|phrase| phrase.split(' '))
}
