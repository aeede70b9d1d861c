//! One of several that are named: "the well or the statue, whichever is closer", "the taller of the museum and the school".

use simworld_core::id::EntityId;
use simworld_core::seam::PlanError;

use super::clause::{Choice, Count, Reference, Target};
use super::lexer::{Lexeme, Token};
use super::lexicon::longest_phrase;
use super::parser::Parser;
use super::phrases::Phrases;
use super::resolve::Purpose;
use crate::editing::called;

/// Before what decides between them.
#[rustfmt::skip]
const WHICHEVER: &Phrases = &Phrases::of(&[
    "whichever", "whichever one", "whichever of them", "whichever of the two", "whichever of those", "whatever", "the one that", "the one which",
    "depending on which", "depending on which one", "depending on whichever", "depending on what", "just whichever", "whoever", "whoever of them", "that which",
    "choose whichever", "take whichever", "pick whichever", "pick the one that", "choose the one that", "take the one that", "whichever door", "whichever place",
    "according to which", "according to which one", "based on which", "based on which one", "whichever one of them", "whichever one of the two",
]);
/// Any of them will do.
#[rustfmt::skip]
const ANY: &Phrases = &Phrases::of(&[
    "i dont mind", "i dont mind which", "i dont mind which one", "i dont care", "i dont care which", "i dont care which one", "either is fine", "either one is fine",
    "either will do", "either one will do", "it doesnt matter", "it doesnt matter which", "it doesnt matter which one", "doesnt matter", "doesnt matter which",
    "doesnt matter which one", "whichever you like", "whichever you prefer", "whichever you want", "whichever suits you", "your choice", "its your choice",
    "up to you", "its up to you", "its all the same to me", "all the same to me", "whichever", "either", "either one", "no matter which", "no matter which one",
    "whatever you like", "whatever you prefer", "both are fine", "both are fine with me", "either is fine with me", "either works", "whichever works", "you choose",
    "you decide", "you pick", "makes no difference", "it makes no difference", "whichever you fancy", "any will do", "either is ok", "either is okay",
]);
const IS: &[&str] = &[
    "is",
    "is the",
    "s",
    "is to be",
    "are",
    "happens to be",
    "is the one",
    "looks",
    "seems",
    "stands",
    "sits",
    "you find",
    "turns out to be",
];
/// What is said behind what decides, and changes nothing.
#[rustfmt::skip]
const BEHIND: &Phrases = &Phrases::of(&[
    "to you", "to us", "to me", "to here", "from here", "from you", "of the two", "of them", "one", "by", "at hand", "right now", "now", "away", "to where you are",
    "to where you stand", "of those", "of both", "to get to", "to reach",
]);
/// Between things of which one is meant.
const JOINED: &[&str] = &["and", "or", "or else", "and also"];

impl Parser<'_> {
    /// "The bench or the chair" leaves open which, unless what decides is said behind it.
    pub(super) fn or_another(&mut self, reference: &mut Reference) -> Result<(), PlanError> {
        let start = self.at;
        let comma = matches!(self.rest(), [Lexeme { token: Token::Comma, .. }, ..]);
        self.at += usize::from(comma && longest_phrase(&self.rest()[1..], &["or"]).is_some());
        if comma && self.peeks("or else") {
            self.at = start; // "..., or else to the clinic" is what is done otherwise
            return Ok(());
        }
        if !self.eat_any(&["or", "or else", "or maybe", "or perhaps", "or otherwise"]) {
            self.at = start;
            return Ok(());
        }
        self.eat_any(&["to", "at", "on", "else"]);
        let Ok(other) = self.reference(0) else {
            self.at = start;
            return Ok(());
        };
        let mut candidates = Vec::new();
        for one in [&*reference, &other] {
            // Of three the last two were chosen from already.
            let several = matches!(&one.target, Target::Named(ids) if ids.len() > 1 && one.text.is_empty());
            let ids = match &one.target {
                Target::Named(ids) if several => ids.clone(),
                _ => self.view.find(one, Purpose::Any).map(|found| vec![found.id]).unwrap_or_default(),
            };
            for id in ids {
                if let Some(found) = self.view.scene.entity(id) {
                    candidates.push((id, called(self.view.scene, &found)));
                }
            }
        }
        let chosen = if other.text.is_empty() { Some(other.choice) } else { self.whichever() };
        if let Some(choice) = chosen.filter(|_| candidates.len() > 1) {
            let ids: Vec<EntityId> = candidates.into_iter().map(|(id, _)| id).collect();
            self.class = None;
            // Without words of its own it is told from what somebody is called.
            *reference = Reference { choice, ..Reference::to(Target::Named(ids), String::new()) };
            return Ok(());
        }
        if self.view.any_of && candidates.len() > 1 {
            let ids: Vec<EntityId> = candidates.into_iter().map(|(id, _)| id).collect();
            self.class = None;
            *reference = Reference::to(Target::Named(ids), format!("{} or {}", reference.text, other.text));
            return Ok(());
        }
        let wanted = format!("of {} or {}", reference.text, other.text);
        Err(PlanError::Ambiguous { wanted, candidates })
    }

    /// ", whichever is closer", behind the things themselves.
    fn whichever(&mut self) -> Option<Choice> {
        let start = self.at;
        self.at +=
            usize::from(matches!(self.rest(), [Lexeme { token: Token::Comma | Token::Break, .. }, ..]));
        self.eat_any(&["but", "and"]);
        let marked = self.at > start;
        let said = self.at;
        if marked && self.eat_any(ANY) && self.ends_clause() {
            return Some(Choice::Nearest);
        }
        self.at = said;
        let which = self.eat_any(WHICHEVER) || marked && self.eat_any(&["the"]);
        self.eat_any(IS);
        self.eat_any(&["the"]);
        let choice = if which { self.most_asked() } else { None };
        while choice.is_some() && self.eat_any(BEHIND) {}
        self.eat_any(&["is"]);
        if choice.is_none() || !self.ends_clause() {
            self.at = start;
            return None;
        }
        choice
    }

    /// "The nearer of the well and the statue", "whichever is closer, the well or the statue".
    pub(super) fn chosen_of_named(&mut self) -> Option<Reference> {
        let start = self.at;
        let which = self.eat_any(WHICHEVER);
        if !which && !self.eat_any(&["the", "either the"]) {
            return None;
        }
        let found = if which && self.eat_any(&["of"]) {
            self.named_apart().and_then(|ids| {
                self.eat_any(IS);
                self.eat_any(&["the"]);
                self.most_asked().map(|choice| (choice, ids))
            })
        } else {
            self.eat_any(IS);
            self.eat_any(&["the"]);
            self.most_asked().and_then(|choice| {
                while self.eat_any(BEHIND) {}
                let comma = matches!(self.rest(), [Lexeme { token: Token::Comma | Token::Break, .. }, ..]);
                self.at += usize::from(comma && which);
                let of = self.eat_any(&["of", "out of", "of these two", "of the two", "between", "among"]);
                self.at += usize::from(
                    of && matches!(self.rest(), [Lexeme { token: Token::Comma | Token::Break, .. }, ..]),
                );
                if of || comma && which { self.named_apart().map(|ids| (choice, ids)) } else { None }
            })
        };
        if let Some((choice, ids)) = found {
            while self.eat_any(BEHIND) {}
            return Some(Reference { choice, ..Reference::to(Target::Named(ids), self.text_from(start)) });
        }
        self.at = start;
        None
    }

    /// Two or more that are named one by one.
    pub(super) fn named_apart(&mut self) -> Option<Vec<EntityId>> {
        let mut ids = Vec::new();
        loop {
            let end = (self.at..self.lexemes.len())
                .find(|at| {
                    matches!(self.lexemes[*at].token, Token::Comma | Token::Break)
                        || longest_phrase(&self.lexemes[*at..], JOINED).is_some()
                })
                .unwrap_or(self.lexemes.len());
            let whole = self.lexemes;
            let joined = longest_phrase(&whole[end..], JOINED).is_some();
            // The last of them may be followed by anything; those before end where the next begins.
            self.lexemes = if joined { &whole[..end] } else { whole };
            let one = self.reference(1).ok();
            self.lexemes = whole;
            let one = one.filter(|one| one.count == Count::One)?;
            ids.push(self.view.find(&one, Purpose::Any).ok()?.id);
            let comma = matches!(self.rest(), [Lexeme { token: Token::Comma, .. }, ..]);
            let more = usize::from(comma);
            let next = longest_phrase(&self.rest()[more.min(self.rest().len())..], JOINED);
            match next {
                Some(words) => self.at += more + words,
                None if comma && ids.len() == 1 => self.at += 1,
                None => break,
            }
        }
        (ids.len() > 1).then_some(ids)
    }
}
