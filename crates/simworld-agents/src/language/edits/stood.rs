//! Where something stood before it was moved or taken away: "cut down the maple and the birch, and put a statue where the maple stood",
//! "move the statue and put a flower bed where it was".
//!
//! By the time of the second order the thing is gone from there, so that its place is put into the words before any is carried out.

use simworld_core::geometry::Point2;

use super::super::clause::Reference;
use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{longest, longest_phrase};
use super::super::phrases::Phrases;
use super::forms::word_at;
use super::parse::Reader;
use super::resolve::Finder;
use super::words::{VERBS, Verb};

/// How many words stand at most between "where" and "stood".
const LONGEST: usize = 6;

impl Reader<'_> {
    /// The words with a point for where something stood that was spoken of before.
    pub(super) fn with_old_places(&self, finder: &Finder<'_>) -> Option<Vec<Lexeme>> {
        let (at, from, end) = (2..self.lexemes.len()).find_map(|at| {
            (self.word(at) == Some("where")).then_some(())?;
            let (from, end) = self.stood(at)?;
            Some((at, from, end))
        })?;
        let stands = if let Some(what) = self.each_moved(at, from) {
            return self.at_each_old_place(finder, &what, at, end);
        } else if from == at + 2 && matches!(self.word(at + 1), Some("it" | "he" | "she")) {
            self.moved_first(at)?
        } else {
            self.named_there(at, from)?
        };
        let thing = finder.one(&stands).ok()?;
        let point = finder.scene.entity(thing)?.planar();
        let mut lexemes = self.lexemes.to_vec();
        lexemes.splice(at..end, point_at(&self.lexemes[at], point));
        Some(lexemes)
    }

    /// What is named between "where" and "stood": it was spoken of before, or something was taken away.
    fn named_there(&self, at: usize, from: usize) -> Option<Reference> {
        let is_one = self.word(from - 1) == Some("one");
        let said = |word: &str| (0..at).any(|before| self.word(before) == Some(word));
        // "Away with the blue bench; put the chair where that bench was".
        if let Some(that) = self.that_was_taken(at, from) {
            return Some(that);
        }
        let was = !matches!(self.word(from), Some("is" | "stands"));
        let goes = was && self.moved_verb(at, true).is_some();
        if !self.is_certain(at + 1) || !(goes || self.word(from - 1).is_some_and(said)) {
            return None;
        }
        if !is_one {
            return self.one_of(at + 1, from).ok();
        }
        // "Take both cars away, and put a tent where the white one stood".
        let noun = self.last_noun(0, at)?;
        let words: Vec<Lexeme> = self.lexemes[at + 1..from - 1].iter().chain(&noun).cloned().collect();
        self.over(&words).one_of(0, words.len()).ok()
    }

    /// What the order before is about, where "that bench" stands behind "where" and it is a bench.
    fn that_was_taken(&self, at: usize, from: usize) -> Option<Reference> {
        let that = matches!(self.word(at + 1), Some("that" | "this")) && at + 2 < from;
        let verb = self.moved_verb(at, true).filter(|_| that)?;
        let mut parser = self.parser(verb, at);
        let what = parser.reference(0).ok()?;
        let end = parser.at;
        let is_named = |noun: usize| (verb..end).any(|at| self.word(at) == self.word(noun));
        (self.is_certain(verb) && (at + 2..from).all(is_named)).then_some(what)
    }

    /// All that was taken away, where "each of them" stands behind "where".
    fn each_moved(&self, at: usize, from: usize) -> Option<Vec<Reference>> {
        #[rustfmt::skip]
        const EACH: &Phrases = &Phrases::of(&["each of them", "each one of them", "each one", "each", "every one of them", "each of those", "each of these", "they each", "each of the three", "each of the two", "both of them"]);
        (longest_phrase(&self.lexemes[at + 1..from], EACH) == Some(from - at - 1)).then_some(())?;
        let verb = self.moved_verb(at, true)?;
        let begin = self.order_of(at)?;
        let stop = (verb + 1..begin).find(|at| is_mark(&self.lexemes[*at])).unwrap_or(begin);
        (verb + 1..=stop).rev().find_map(|stop| self.things(verb, stop).ok())
    }

    /// Where the order begins within which a word stands: "put a planter where ...".
    fn order_of(&self, at: usize) -> Option<usize> {
        (1..at).rev().find(|from| {
            let begins = is_mark(&self.lexemes[from - 1])
                || matches!(self.word(from - 1), Some("and" | "then" | "so" | "please" | "instead"));
            begins
                && longest(&self.lexemes[*from..at], &VERBS)
                    .is_some_and(|(verb, _)| matches!(verb, Verb::Add | Verb::Put))
        })
    }

    /// The order once for each of the old places: "put a planter at (1, 2) and put a planter at (3, 4)".
    fn at_each_old_place(
        &self,
        finder: &Finder<'_>,
        what: &[Reference],
        at: usize,
        end: usize,
    ) -> Option<Vec<Lexeme>> {
        const MOST: usize = 20;
        let begin = self.order_of(at)?;
        let things = finder.all(what).ok().filter(|things| (1..=MOST).contains(&things.len()))?;
        let mut lexemes = self.lexemes[..begin].to_vec();
        for (rank, thing) in things.iter().enumerate() {
            if rank > 0 {
                lexemes.push(word_at(&self.lexemes[at], "and"));
            }
            lexemes.extend_from_slice(&self.lexemes[begin..at]);
            lexemes.extend(point_at(&self.lexemes[at], finder.scene.entity(*thing)?.planar()));
        }
        lexemes.extend_from_slice(&self.lexemes[end..]);
        Some(lexemes)
    }

    /// Where "stood" is behind "where", and where it ends with its clause.
    pub(super) fn stood(&self, at: usize) -> Option<(usize, usize)> {
        const STOOD: &[&str] = &[
            "was",
            "stood",
            "used to be",
            "used to stand",
            "had been",
            "had stood",
            "lay",
            "sat",
            "is",
            "is now",
            "stands",
            "was before",
        ];
        (at + 2..self.lexemes.len().min(at + LONGEST)).find_map(|from| {
            let end = from + longest_phrase(&self.lexemes[from..], STOOD)?;
            let ends = self.lexemes.get(end).is_none_or(is_mark)
                || matches!(self.word(end), Some("and" | "before" | "please" | "instead"))
                || longest(&self.lexemes[end..], &VERBS)
                    .is_some_and(|(verb, _)| matches!(verb, Verb::Add | Verb::Put));
            ends.then_some((from, end))
        })
    }

    /// What the last order before a word moves, if that is what it does.
    fn moved_first(&self, before: usize) -> Option<Reference> {
        let verb = self.moved_verb(before, false)?;
        let mut parser = self.parser(verb, before);
        let mut what = parser.reference(0).ok().filter(|_| self.is_certain(verb))?;
        // "The statue in front of the museum" is the statue that goes there.
        what.relation = None;
        Some(what)
    }

    /// What stands behind the first order that moves something or, if that is asked for, takes it away.
    fn moved_verb(&self, before: usize, taken: bool) -> Option<usize> {
        (0..before).find_map(|at| {
            let begins = at == 0
                || is_mark(&self.lexemes[at - 1])
                || matches!(self.word(at - 1), Some("please" | "and" | "you" | "just" | "then" | "so"));
            // What is taken away leaves its place as "there", but for what is told before its verb.
            let goes = before > 0 && is_mark(&self.lexemes[before - 1])
                || matches!(self.word(before - 1), Some("and" | "then"));
            longest(&self.lexemes[at..before], &VERBS)
                .filter(|(verb, _)| {
                    let takes = matches!(verb, Verb::Remove) && (goes || taken);
                    begins && (takes || matches!(verb, Verb::Move) || taken && matches!(verb, Verb::Take))
                })
                .map(|(_, words)| at + words)
        })
    }
}

/// A point in the place of words.
pub(super) fn point_at(place: &Lexeme, point: Point2) -> [Lexeme; 6] {
    let token = |token: Token| Lexeme { token, lemma: None, ..place.clone() };
    [
        word_at(place, "at"),
        token(Token::Open),
        token(Token::Number(point.x)),
        token(Token::Comma),
        token(Token::Number(point.y)),
        token(Token::Close),
    ]
}
