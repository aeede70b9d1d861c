//! Questions before what is to be done: "which bench is closest? Bring me there", "check whether the door is closed".

use super::clause::{Choice, Clause, Reference, Target};
use super::lexer::{Lexeme, Token};
use super::parser::{Extent, Parser};

impl Parser<'_> {
    /// "Which bench is closest? Bring me there", "who is nearer, Fay or Gus? Go to that one".
    pub(super) fn which_one(&mut self) -> Option<Vec<Clause>> {
        let start = self.at;
        let who =
            self.eat_any(&["whos", "who is", "who stands", "who sits", "whos standing", "who is standing"]);
        if !who
            && !self.eat_any(&[
                "which of the two",
                "which of the three",
                "which of the",
                "which",
                "which one of the",
                "what",
            ])
        {
            return None;
        }
        let mut what = Reference::to(Target::Here, String::new());
        let noun = if who { None } else { super::lexicon::category(self.rest()) };
        if let Some((class, words)) = noun {
            what.target = Target::Any(class);
            self.at += words;
            self.class = Some(class);
        } else if let Some(ids) =
            self.rest().first().and_then(|first| self.names.sort(&first.token)).filter(|_| !who)
        {
            // "Which stall is the farthest?"
            what.target = Target::Named(ids);
            self.at += 1;
        } else if let Some((ids, words)) =
            self.names.exact(self.rest()).filter(|(ids, _)| !who && ids.len() > 1)
        {
            what.target = Target::Named(ids);
            self.at += words;
        } else if who {
            what.target = Target::Any(super::lexicon::class("person"));
        }
        if !who && !self.eat_any(&["is", "are", "stands", "lies"]) {
            return None;
        }
        if who && self.most_follows().is_none() {
            let stands = self.at;
            self.described(&mut what, 0).ok()?;
            if self.at == stands || what.relation.is_none() || self.mark() != Some('?') {
                return None;
            }
            return self.asked_for(what, start); // "who is standing by the cheese stall? wave to her"
        }
        self.eat_any(&["the"]);
        what.choice = self.most_asked()?;
        self.of_an_anchor(&mut what)?;
        let comma = self.at;
        if matches!(self.mark(), Some(',')) {
            match self.listed() {
                Some(ids) => what.target = Target::Named(ids),
                None => self.at = comma,
            }
        }
        if who && !matches!(what.target, Target::Named(_)) && self.mark() != Some('?') {
            return None;
        }
        // "Which car's the closest, go to that one".
        let taken_up = self.at == comma
            && self.rest().iter().any(|lexeme| matches!(&lexeme.token, Token::Word(word) if ["that", "it", "there"].contains(&word.as_str())));
        let asked = (self.mark() == Some('?') || taken_up) && what.target != Target::Here;
        if asked { self.asked_for(what, start) } else { None }
    }

    /// What was asked for, with the order behind it.
    fn asked_for(&mut self, mut what: Reference, start: usize) -> Option<Vec<Clause>> {
        what.text = self.text_from(start);
        if !self.skip_joints() || self.at >= self.lexemes.len() {
            return None;
        }
        self.eat_any(&["that one", "it is that"]);
        let mut clauses = vec![Clause::Mention { what }];
        clauses.extend(self.statement().ok()?);
        Some(clauses)
    }

    /// Whether a superlative follows.
    fn most_follows(&mut self) -> Option<Choice> {
        let start = self.at;
        self.eat_any(&["the"]);
        let most = self.most_asked();
        self.at = start;
        most
    }

    /// "... to the Camp Store?", "... from the fountain?": nearest to or farthest from what.
    fn of_an_anchor(&mut self, what: &mut Reference) -> Option<()> {
        let nearest = match what.choice {
            Choice::Nearest => true,
            Choice::Farthest => false,
            _ => return Some(()),
        };
        if self.eat_any(&["to", "from", "away from"]) && !self.eat_any(&["you", "me", "us", "here"]) {
            let anchor = self.reference(1).ok()?;
            what.choice = Choice::Open;
            what.relation = Some(super::clause::Stands::NearestTo(Box::new(anchor), nearest));
        }
        Some(())
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
