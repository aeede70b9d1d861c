//! For whom the parts of something are who is no part of a scene: "one is for my sister", "one for me and one for you".

use super::clause::Clause;
use super::lexer::{Lexeme, Token};
use super::lexicon::{DETERMINERS, category, longest_phrase};
use super::parser::Parser;
use super::phrases::Phrases;

/// A part of what was asked for.
#[rustfmt::skip]
const PARTS: &Phrases = &Phrases::of(&[
    "one", "the other", "the other one", "another", "another one", "both", "they", "theyre", "the first", "the first one", "the second", "the second one",
    "the third", "the last one", "two", "three", "the rest", "half", "half of them", "one each", "the others", "these", "those", "all", "the lot", "its",
    "it", "that", "thats", "this",
]);
/// Between a part and whom it is for.
const ARE: &Phrases = &Phrases::of(&[
    "is",
    "are",
    "will be",
    "would be",
    "should be",
    "goes",
    "go",
    "is meant",
    "are meant",
    "s",
]);
/// Those who get it and are no part of the scene, or are told.
const MINE: &Phrases = &Phrases::of(&[
    "me",
    "you",
    "us",
    "yourself",
    "myself",
    "each of us",
    "both of us",
    "ourselves",
    "later",
    "each",
    "everyone",
    "everybody",
]);

impl Parser<'_> {
    /// Passes "one is for my sister and one for me" behind an order, with the mark before it; whether there was any.
    pub(super) fn skip_portions(&mut self) -> bool {
        let start = self.at;
        self.skip_fillers();
        self.at +=
            usize::from(matches!(self.rest(), [Lexeme { token: Token::Comma | Token::Break, .. }, ..]));
        // "Two ice creams please, for my kids".
        let after_mark = self.at;
        if after_mark > start
            && self.eat_any(&["for", "just for", "only for"])
            && (self.eat_any(MINE) || self.somebody_elsewhere())
            && self.ends_clause()
        {
            return true;
        }
        self.at = after_mark;
        if after_mark > start && self.skip_use() && self.ends_clause() {
            return true; // "six apples, please, for a pie"
        }
        self.at = after_mark;
        self.eat_any(&["and", "because", "since", "as"]);
        let mut end = start;
        while self.portion() {
            end = self.at;
            let comma = matches!(self.rest(), [Lexeme { token: Token::Comma, .. }, ..]);
            self.at += usize::from(comma);
            self.eat_any(&["and", "but"]);
        }
        self.at = end;
        if end == start || !self.ends_clause() {
            self.at = start;
            return false;
        }
        true
    }

    /// "Buy a rose, it's for Delia": somebody who is here gets it.
    pub(super) fn is_for_somebody(&mut self, clauses: &mut [Clause]) -> bool {
        let Some(Clause::Buy { whom: whom @ None, .. }) = clauses.last_mut() else { return false };
        let start = self.at;
        if self.eat_any(&[
            "for",
            "its for",
            "it is for",
            "theyre for",
            "they are for",
            "thats for",
            "that is for",
            "its meant for",
        ]) && !self.names_others()
            && let Some(somebody) = self.somebody_here()
            && self.ends_clause()
        {
            *whom = Some(somebody);
            return true;
        }
        self.at = start;
        false
    }

    /// "My kids": children who stand about are not meant.
    fn names_others(&self) -> bool {
        let words = longest_phrase(self.rest(), DETERMINERS).unwrap_or(0);
        words > 0 && longest_phrase(&self.rest()[words..], super::shopping::OTHERS).is_some()
    }

    fn portion(&mut self) -> bool {
        if !self.eat_any(PARTS) {
            return false;
        }
        self.eat_any(&["of them", "of these", "of those", "of it"]);
        self.eat_any(ARE);
        // "Three teas, one with sugar": what nobody sells otherwise.
        if self.eat_any(&["with", "without"]) {
            let end = self.mark_from(self.at);
            let known = (self.at..end).any(|at| {
                let rest = &self.lexemes[at..end];
                category(rest).is_some()
                    || self.names.exact(rest).is_some()
                    || self.names.goods(rest).is_some()
            });
            if !known {
                self.at = end;
            }
            return !known;
        }
        if !self.eat_any(&["for", "to", "just for", "only for", "all for"]) {
            return false;
        }
        self.eat_any(MINE) || self.somebody_elsewhere()
    }

    /// "My sister", "the office": whom nothing in the scene is called.
    fn somebody_elsewhere(&mut self) -> bool {
        const MOST: usize = 4;
        let own = self.eat_any(&["my", "our", "your", "his", "her", "their", "the", "a", "an", "some"]);
        let ends = |at: &usize| {
            let rest = &self.lexemes[*at..];
            !matches!(rest.first(), Some(Lexeme { token: Token::Word(_), .. }))
                || longest_phrase(rest, &["and", "but", "so", "please", "then"]).is_some()
        };
        if own && self.eat_any(super::shopping::OTHERS) {
            return true;
        }
        let last = (self.at + MOST).min(self.lexemes.len());
        let Some(end) = (self.at..=last).find(|at| *at == self.lexemes.len() || ends(at)) else {
            return false;
        };
        let whom = &self.lexemes[self.at..end];
        let is_way = whom.iter().any(|lexeme| matches!(&lexeme.token, Token::Word(word) if ["left", "right", "north", "south", "east", "west", "front", "back"].contains(&word.as_str())));
        let elsewhere = own
            && !is_way
            && !whom.is_empty()
            && (0..whom.len()).all(|at| {
                category(&whom[at..]).is_none()
                    && self.names.exact(&whom[at..]).is_none()
                    && self.names.goods(&whom[at..]).is_none()
            });
        if elsewhere {
            self.at = end;
        }
        elsewhere
    }
}
