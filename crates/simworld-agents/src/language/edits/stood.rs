//! Where something stood before it was moved or taken away: "cut down the maple and the birch, and put a statue where the maple stood",
//! "move the statue and put a flower bed where it was".
//!
//! By the time of the second order the thing is gone from there, so that its place is put into the words before any is carried out.

use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{longest, longest_phrase};
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
        let what = if from == at + 2 && matches!(self.word(at + 1), Some("it" | "he" | "she")) {
            self.moved_first(at)?
        } else {
            let said = |word: &str| (0..at).any(|before| self.word(before) == Some(word));
            if !self.is_certain(at + 1) || !self.word(from - 1).is_some_and(said) {
                return None;
            }
            self.one_of(at + 1, from).ok()?
        };
        let thing = finder.one(&what).ok()?;
        let point = finder.scene.entity(thing)?.planar();
        let place = &self.lexemes[at];
        let token = |token: Token| Lexeme { token, lemma: None, ..place.clone() };
        let point = [
            word_at(place, "at"),
            token(Token::Open),
            token(Token::Number(point.x)),
            token(Token::Comma),
            token(Token::Number(point.y)),
            token(Token::Close),
        ];
        let mut lexemes = self.lexemes.to_vec();
        lexemes.splice(at..end, point);
        Some(lexemes)
    }

    /// Where "stood" is behind "where", and where it ends with its clause.
    fn stood(&self, at: usize) -> Option<(usize, usize)> {
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
    fn moved_first(&self, before: usize) -> Option<super::super::clause::Reference> {
        let verb = (0..before).find_map(|at| {
            let begins = at == 0
                || is_mark(&self.lexemes[at - 1])
                || matches!(self.word(at - 1), Some("please" | "and" | "you" | "just" | "then" | "so"));
            // What is taken away leaves its place as "there", but for what is told before its verb.
            let goes = before > 0 && is_mark(&self.lexemes[before - 1])
                || matches!(self.word(before - 1), Some("and" | "then"));
            longest(&self.lexemes[at..before], &VERBS)
                .filter(|(verb, _)| {
                    begins && (matches!(verb, Verb::Move) || goes && matches!(verb, Verb::Remove))
                })
                .map(|(_, words)| at + words)
        })?;
        let mut parser = self.parser(verb, before);
        let mut what = parser.reference(0).ok().filter(|_| self.is_certain(verb))?;
        // "The statue in front of the museum" is the statue that goes there.
        what.relation = None;
        Some(what)
    }
}
