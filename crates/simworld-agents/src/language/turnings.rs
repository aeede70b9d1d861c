//! Turns at a thing, and deeds that belong to each time that something is done: "turn left at the hydrant", "turn around three
//! times, taking a photo each time".

use simworld_core::seam::PlanError;

use super::clause::{Clause, Pace, Reference};
use super::lexer::{Lexeme, Token};
use super::parser::Parser;
use super::phrases::Phrases;

/// What leads to where one turns.
#[rustfmt::skip]
const WHERE: &Phrases = &Phrases::of(&[
    "at", "by", "when you get to", "when you reach", "once you reach", "when you come to", "when you are at", "when youre at", "once you get to", "once you are at",
    "as soon as you reach", "upon reaching", "on reaching", "after reaching",
]);
/// That something belongs to each time.
const EACH_TIME: &Phrases = &Phrases::of(&[
    "each time",
    "every time",
    "each time round",
    "every single time",
    "at each turn",
    "each round",
    "every round",
    "after each",
    "after each one",
    "in between",
]);

impl Parser<'_> {
    /// After "turn": which way, and at what if one has to go there first.
    pub(super) fn turn_somewhere(&mut self) -> Result<Vec<Clause>, PlanError> {
        if self.turned_about() && self.ends_clause() {
            self.turned = Some(1.0);
            return Ok(vec![Clause::Turn { angle: std::f64::consts::PI }]);
        }
        let turn = self.turn()?;
        let start = self.at;
        if matches!(turn, Clause::Turn { .. })
            && self.walks()
            && self.eat_any(WHERE)
            && let Ok(to) = self.reference(0)
            && self.ends_clause()
        {
            return Ok(vec![Clause::Go { to, side: None, pace: Pace::Usual, within: None }, turn]);
        }
        self.at = start;
        Ok(vec![turn])
    }

    /// Whether the verb itself says that one turns round: "swing round", "do an about turn", "reverse direction".
    fn turned_about(&self) -> bool {
        let before = |back: usize| self.at.checked_sub(back).map_or("", |at| self.word_before_at(at));
        ["around", "round", "about", "direction"].contains(&before(0))
            || ["turn", "face"].contains(&before(0)) && before(1) == "about"
    }

    /// "..., taking a photo each time": what is done each time that the order before is.
    pub(super) fn each_time(&mut self, clauses: &mut [Clause]) -> bool {
        let Some(Clause::Repeat { body, .. }) = clauses.last_mut() else { return false };
        let (start, whole) = (self.at, self.lexemes);
        self.at += usize::from(matches!(self.rest(), [Lexeme { token: Token::Comma, .. }, ..]));
        self.eat_any(&["and"]);
        let before = self.eat_any(EACH_TIME);
        let doing = |lexeme: &Lexeme| matches!(&lexeme.token, Token::Word(word) if word.ends_with("ing") && lexeme.lemma.is_some());
        let end = (self.at..whole.len())
            .find(|at| super::lexicon::longest_phrase(&whole[*at..], EACH_TIME).is_some());
        if self.at > start && self.rest().first().is_some_and(doing) && (before || end.is_some()) {
            self.lexemes = &whole[..end.unwrap_or(whole.len())];
            let deeds = self.order();
            self.lexemes = whole;
            if let Ok(deeds) = deeds
                && (self.eat_any(EACH_TIME) || before)
                && self.ends_clause()
            {
                body.extend(deeds);
                return true;
            }
        }
        self.at = start;
        false
    }

    /// "Point at both trees, the maple first", "look at the boats, starting with the red one": which of several comes first.
    pub(super) fn one_first(&mut self, clauses: &mut Vec<Clause>) -> bool {
        let start = self.at;
        if clauses.last_mut().and_then(Clause::plural).is_none() {
            return false;
        }
        let Some(mut several) = clauses.last().cloned() else { return false };
        let comma = usize::from(matches!(self.rest(), [Lexeme { token: Token::Comma, .. }, ..]));
        // "..., nearest first" is the order in which they are done anyway.
        let usual =
            super::lexicon::longest_phrase(&self.rest()[comma..], super::politeness::MANNERS).is_some();
        if usual {
            return false;
        }
        self.at += comma;
        self.eat_any(&["but", "and"]);
        let starts = self.eat_any(&[
            "starting with",
            "beginning with",
            "start with",
            "begin with",
            "starting at",
            "beginning at",
            "starting from",
        ]);
        if let Some(what) = several.plural()
            && what.choice == super::clause::Choice::Open
            && what.except.is_none()
            && self.at > start
            && super::verbs::longest_verb(self.rest()).is_none()
            && let Ok(one) = self.reference(0)
            && one.count == super::clause::Count::One
            && (starts || self.eat_any(&["first"]))
            && self.ends_clause()
        {
            let mut first = several.clone();
            if let Some(what) = first.plural() {
                *what = one.clone();
            }
            if let Some(what) = several.plural() {
                (what.except, what.count) = (Some(Box::new(one)), super::clause::Count::All);
            }
            clauses.pop();
            clauses.extend([first, several]);
            return true;
        }
        self.at = start;
        false
    }

    /// "Via the sundial and the carousel": one more place on the way.
    pub(super) fn another_on_the_way(&mut self) -> Option<Reference> {
        let start = self.at;
        self.at += usize::from(matches!(self.mark(), Some(',')));
        let joined = self.eat_any(&["and then via", "then via", "and via", "and", "and then", "via", "then"])
            || self.at > start;
        let to = if joined && super::verbs::longest_verb(self.rest()).is_none() {
            self.reference(0).ok()
        } else {
            None
        };
        if to.is_none() || !self.ends_clause() {
            self.at = start;
            return None;
        }
        to
    }

    /// Passes "from where you are, ...": that is where every way begins.
    pub(super) fn skip_origin(&mut self) {
        let here = super::lexicon::longest_phrase(
            self.rest(),
            &[
                "from where you are",
                "from where you stand",
                "from your place",
                "from the place where you are",
                "from where you are now",
            ],
        );
        if let Some(words) =
            here.filter(|words| matches!(self.rest().get(*words), Some(Lexeme { token: Token::Comma, .. })))
        {
            self.at += words + 1;
        }
    }

    /// "Three metres forward, two to the right": so many metres as the number says that was passed, if a way follows.
    pub(super) fn bare_step(&mut self, number_at: usize) -> Option<Clause> {
        const WAYS: &[&str] = &[
            "to the left",
            "to the right",
            "to your left",
            "to your right",
            "left",
            "right",
            "forward",
            "forwards",
            "back",
            "backwards",
            "ahead",
        ];
        let start = self.at;
        let number = super::numbers::number(&self.lexemes[number_at..start])
            .filter(|(number, _)| (0.1..=10.0).contains(number));
        if let Some((distance, _)) = number
            && self.length_before()
            && super::lexicon::longest_phrase(self.rest(), WAYS).is_some()
            && let Ok(Clause::Step { direction, .. }) = self.step()
            && self.ends_clause()
        {
            return Some(Clause::Step { direction, distance });
        }
        self.at = start;
        None
    }
}
