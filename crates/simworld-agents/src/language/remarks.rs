//! What people say beside their orders: how they are, and why they want it.

use super::clause::Clause;
use super::lexer::{Lexeme, Token};
use super::lexicon::longest_phrase;
use super::parser::Parser;
use super::phrases::{PhraseList, Phrases};
use super::politeness::filler;
use super::requests;
use super::verbs::longest_verb;

/// What begins a remark of the speaker's on how he is.
#[rustfmt::skip]
const REMARKS: &Phrases = &Phrases::of(&[
    "im", "i am", "ive", "i have", "i feel", "i cant", "i cannot", "i dont", "we are", "weve", "because",
    "my feet", "my legs", "its late", "it is late", "its hot", "its cold", "its getting", "it is getting",
]);
/// What begins a reason.
const BECAUSE: &[&str] = &["because", "since i", "since we", "as i", "as we", "cause i", "cos i"];

/// What takes up who or what was named before.
const PRONOUNS: &[&str] = &["it", "him", "her", "them", "there"];

/// What a sentence spoke of that is no thing of the scene.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Beside {
    /// Photos were asked for as things: "I need two photos of the well, please take them".
    pub(super) shots: bool,
    /// Somebody who is not here: "my sister loves apples, buy her one".
    pub(super) absent: bool,
    /// A driver's passengers.
    pub(super) rides: bool,
}

impl Parser<'_> {
    /// "..., I'm in a hurry": what says how the speaker is, or why, and asks for nothing; whether there was any.
    pub(super) fn skip_remark(&mut self) -> bool {
        self.skip_saying(REMARKS)
    }

    /// "... because it is late".
    pub(super) fn skip_reason(&mut self) -> bool {
        self.skip_saying(BECAUSE)
    }

    fn skip_saying<L: PhraseList + ?Sized>(&mut self, beginnings: &L) -> bool {
        let is_remark = longest_phrase(self.rest(), beginnings).is_some()
            && filler(self.rest()).is_none()
            && longest_verb(self.rest()).is_none()
            && requests::beginnings(self.rest()).is_empty();
        let ends = |lexeme: &Lexeme| match &lexeme.token {
            Token::Comma | Token::Break => true,
            Token::Word(word) => ["so", "and", "then"].contains(&word.as_str()),
            _ => false,
        };
        if is_remark {
            let count = self.rest().iter().position(ends).unwrap_or(self.rest().len());
            // "We're out of bread, can you buy some".
            if let Some(goods) = self.goods_within(self.at, self.at + count) {
                self.wish_for(goods);
            }
            let end = self.at + count;
            let takes_up = |lexeme: &Lexeme| matches!(&lexeme.token, Token::Word(word) if PRONOUNS.contains(&word.as_str()));
            if self.lexemes[end..].iter().any(takes_up) {
                self.named = self.names_within(end);
            }
            self.at = end;
        }
        is_remark
    }

    /// "Can you see the tree next to the chair go over to that one": a question without its mark.
    pub(super) fn seen_by_you(&mut self) -> Option<Vec<Clause>> {
        let start = self.at;
        let you = self.word_before() == "you"
            || longest_phrase(self.rest(), &["you", "do you", "can you"]).is_some();
        if self.eat_any(&["can you see", "do you see", "you see", "see", "do you know", "you know"])
            && let Ok(what) = self.reference(0)
        {
            self.eat_any(&[
                "over there",
                "there",
                "from here",
                "right there",
                "just there",
                "from where you are",
                "by any chance",
            ]);
            let takes_up = self.rest().iter().any(|lexeme| {
                matches!(&lexeme.token, Token::Word(word) if ["it", "there", "that", "him", "her", "them"].contains(&word.as_str()))
            });
            // "You see the statue. Turn towards it": nobody is told to see it.
            let told = you && self.mark().is_some_and(|mark| ['.', '!', ';'].contains(&mark));
            if takes_up
                && (longest_verb(self.rest()).is_some()
                    || told && self.order_follows() && !self.begins_block())
            {
                return Some(self.mention(what));
            }
        }
        self.at = start;
        None
    }
}
