//! Questions before what is to be done: "which bench is closest? Bring me there", "check whether the door is closed".

use super::clause::{Choice, Clause, Reference, Target};
use super::lexer::{Lexeme, Token};
use super::parser::{Extent, Parser};

impl Parser<'_> {
    /// "Which bench is closest? Bring me there", "who is nearer, Fay or Gus? Go to that one".
    pub(super) fn which_one(&mut self) -> Option<Vec<Clause>> {
        let start = self.at;
        let who = self.eat_any(&["whos", "who is"]);
        if !who && !self.eat_any(&["which of the", "which", "which one of the", "what"]) {
            return None;
        }
        let mut what = Reference::to(Target::Here, String::new());
        let noun = if who { None } else { super::lexicon::category(self.rest()) };
        if let Some((class, words)) = noun {
            what.target = Target::Any(class);
            self.at += words;
            self.class = Some(class);
        }
        if !who && !self.eat_any(&["is", "are", "stands", "lies"]) {
            return None;
        }
        self.eat_any(&["the"]);
        what.choice = self.most_asked()?;
        let comma = self.at;
        if matches!(self.mark(), Some(',')) {
            match self.listed() {
                Some(ids) => what.target = Target::Named(ids),
                None => self.at = comma,
            }
        }
        what.text = self.text_from(start);
        // "Which car's the closest, go to that one".
        let taken_up = self.at == comma
            && self.rest().iter().any(|lexeme| matches!(&lexeme.token, Token::Word(word) if ["that", "it", "there"].contains(&word.as_str())));
        let asked = (self.mark() == Some('?') || taken_up) && what.target != Target::Here;
        if !asked || !self.skip_joints() || self.at >= self.lexemes.len() {
            return None;
        }
        self.eat_any(&["that one", "it is that"]);
        let mut clauses = vec![Clause::Mention { what }];
        clauses.extend(self.statement().ok()?);
        Some(clauses)
    }

    /// ", the school or the hospital?".
    fn listed(&mut self) -> Option<Vec<simworld_core::id::EntityId>> {
        self.at += 1;
        let mut ids = Vec::new();
        loop {
            ids.push(self.named_alone()?);
            self.at += usize::from(matches!(self.mark(), Some(',')));
            if !self.eat_any(&["or", "and"]) {
                return Some(ids);
            }
        }
    }

    /// By what one of several is chosen.
    pub(super) fn most_asked(&mut self) -> Option<Choice> {
        if self.eat_any(&[
            "nearest",
            "closest",
            "nearer",
            "closer",
            "nearest to you",
            "closest to you",
            "nearest you",
            "nearest to us",
            "closest to us",
        ]) {
            Some(Choice::Nearest)
        } else if self.eat_any(&[
            "farthest",
            "furthest",
            "farther",
            "further",
            "farthest away",
            "furthest away",
            "farther away",
            "further away",
        ]) {
            Some(Choice::Farthest)
        } else {
            let ((measure, most), words) = super::lexicon::longest(self.rest(), super::lexicon::MOSTS)?;
            self.at += words;
            Some(Choice::Most(measure, most))
        }
    }

    /// One thing of a choice: "the school or the hospital".
    fn named_alone(&mut self) -> Option<simworld_core::id::EntityId> {
        let mut what = Reference::to(Target::Here, String::new());
        self.modifiers(&mut what);
        let (at, end) = (self.at, (self.at..self.lexemes.len()).find(|at| ends_choice(&self.lexemes[*at]))?);
        let whole = self.lexemes;
        self.lexemes = &whole[..end];
        self.at = at;
        let found = self.reference(0).ok();
        self.lexemes = whole;
        let found = self
            .view
            .find(&Reference { choice: what.choice, ..found? }, super::resolve::Purpose::Any)
            .ok()?;
        Some(found.id)
    }

    /// "Check whether the door is closed and open it if it is": what is asked is asked again behind it.
    pub(super) fn checked(&mut self) -> Option<Vec<Clause>> {
        if !self.eat_any(&[
            "check whether",
            "check if",
            "see whether",
            "see if",
            "find out whether",
            "find out if",
            "look whether",
            "make sure whether",
            "have a look whether",
            "have a look if",
            "check to see if",
            "check to see whether",
        ]) {
            return None;
        }
        self.test().ok()?;
        let joined = self.skip_joints();
        let asked_again = self.rest().iter().any(|lexeme| matches!(&lexeme.token, Token::Word(word) if ["if", "otherwise", "unless"].contains(&word.as_str())));
        if !joined || !asked_again {
            return None;
        }
        self.orders(Extent::Sentence).ok().filter(|clauses| !clauses.is_empty())
    }
}

fn ends_choice(lexeme: &Lexeme) -> bool {
    match &lexeme.token {
        Token::Comma | Token::Break => true,
        Token::Word(word) => word == "or",
        _ => false,
    }
}
