//! "Three deck chairs around the statue, and a guitar on the chair": where several are made, the one is that which was there before.
//!
//! By the time of the second order there are more of them, so that the one that is meant is put into the words before any order is carried out.

use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::category;
use super::super::numbers;
use super::parse::Reader;
use super::resolve::Finder;

/// A number and what is counted by it are no farther apart than that: "three folding deck chairs".
const FARTHEST: usize = 4;

impl Reader<'_> {
    /// The words with the one thing of a kind that is there in the place of its noun, behind several new ones of that kind.
    pub(super) fn with_what_was_there(&self, finder: &Finder<'_>) -> Option<Vec<Lexeme>> {
        let the = (3..self.lexemes.len().saturating_sub(1)).find(|the| self.is_one_behind_several(*the))?;
        let what = self.one_of(the, the + 2).ok()?;
        let thing = finder.one(&what).ok()?;
        let mut lexemes = self.lexemes.to_vec();
        let id = Lexeme { token: Token::Id(thing), lemma: None, ..self.lexemes[the].clone() };
        lexemes.splice(the..the + 2, [id]);
        Some(lexemes)
    }

    /// Whether "the chair" stands there, the first time that one chair is spoken of, and several new chairs are counted before it.
    fn is_one_behind_several(&self, the: usize) -> bool {
        let ends = |at: usize| self.lexemes.get(at).is_none_or(is_mark) || self.word(at) == Some("and");
        let noun = self.word(the + 1).filter(|_| self.word(the) == Some("the") && ends(the + 2));
        let is_class = category(&self.lexemes[the + 1..]).is_some_and(|(_, words)| words == 1);
        let Some(noun) = noun.filter(|noun| is_class && !noun.ends_with('s')) else { return false };
        let is_several = |at: usize| self.word(at).and_then(|word| word.strip_suffix('s')) == Some(noun);
        let is_counted = |from: usize| {
            numbers::count(&self.lexemes[from..the]).is_some_and(|(number, words)| {
                number > 1 && (from + words..the.min(from + words + FARTHEST)).any(is_several)
            })
        };
        // "The three chairs" are there already.
        let is_new = |from: usize| {
            let before = from.checked_sub(1).and_then(|before| self.word(before));
            !matches!(before, Some("the" | "those" | "these" | "my" | "our" | "all" | "at"))
                && is_counted(from)
        };
        (0..the).all(|at| self.word(at) != Some(noun)) && (0..the).any(is_new)
    }
}
