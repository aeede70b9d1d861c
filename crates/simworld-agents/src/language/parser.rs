//! Tokens to orders.
//!
//! ```text
//! sentence  = clause { joint clause }
//! joint     = "," | "." | ";" | "and" | "then" | "next" | "after that" | ...
//! clause    = go place | run place | take thing ["to" place] | drop [thing] ["at" place] | sit ["on" thing]
//!           | stand up | stop | wait number [unit] | ride thing ["to" place] | get off | step [direction] [number]
//!           | turn direction [number] | wave "at" thing | take a photo
//! thing     = ["the"] ["nearest" | "farthest"] noun [relation thing] | "it" | id
//! place     = thing | relation thing | "(" number "," number ["," number] ")" | "there" | "here"
//! noun      = a class of things | the name of one
//! relation  = "next to" | "near" | "in front of" | "behind" | "left of" | "right of" | "on top of" | "inside"
//! ```

use std::f64::consts::{FRAC_PI_2, PI};

use simworld_core::action::StepDirection;
use simworld_core::scene::Relation;
use simworld_core::seam::PlanError;

use super::clause::{Choice, Clause, Manner, Pace, Reference, Vehicle};
use super::lexer::{Lexeme, Token};
use super::lexicon::{FILLERS, JOINTS, NUMERALS, RELATIONS, VERBS, Verb, fits, longest, longest_phrase};
use super::names::Names;
use super::resolve::View;

/// What is understood, in one line, for answers.
pub(super) const UNDERSTOOD: &str = "say go to, pick up, drop off, put down, sit down, stand up, stop, wait n seconds, ride, \
     get off, step, turn or wave at, joined by \"and\" or \"then\"";
/// The longest wait, s.
const LONGEST_WAIT: f64 = 86_400.0;
/// The longest single step, m.
const LONGEST_STEP: f64 = 10.0;

/// Reads a sentence from left to right.
pub(super) struct Parser<'a> {
    pub(super) words: &'a str,
    pub(super) lexemes: &'a [Lexeme],
    pub(super) names: &'a Names,
    pub(super) view: &'a View<'a>,
    pub(super) at: usize,
}

impl<'a> Parser<'a> {
    pub(super) fn new(words: &'a str, lexemes: &'a [Lexeme], names: &'a Names, view: &'a View<'a>) -> Self {
        Self { words, lexemes, names, view, at: 0 }
    }

    /// All orders of the sentence, at least one.
    pub(super) fn sentence(&mut self) -> Result<Vec<Clause>, PlanError> {
        let mut clauses = Vec::new();
        self.skip_joints();
        while self.at < self.lexemes.len() {
            clauses.push(self.clause()?);
            self.skip_fillers();
            let joined = self.skip_joints();
            let goes_on = longest(self.rest(), VERBS).is_some();
            if self.at < self.lexemes.len() && !joined && !goes_on {
                return Err(self.not_understood("end here, or go on with \"and\" or \"then\""));
            }
        }
        if clauses.is_empty() { Err(self.not_understood(UNDERSTOOD)) } else { Ok(clauses) }
    }

    fn clause(&mut self) -> Result<Clause, PlanError> {
        let Some((verb, count)) = longest(self.rest(), VERBS) else {
            return Err(self.not_understood(UNDERSTOOD));
        };
        self.at += count;
        match verb {
            Verb::Go if self.begins_step() => self.step(),
            Verb::Take if self.counts_steps() => self.step(),
            Verb::Go => self.go(Pace::Usual),
            Verb::Run => self.go(Pace::Run),
            Verb::Take => self.take(),
            Verb::Deliver => self.drop(Manner::Deliver),
            Verb::Drop => self.drop(Manner::DropOff),
            Verb::PutDown => self.drop(Manner::PutDown),
            Verb::Sit => self.sit(),
            Verb::StandUp => {
                self.tail(&["from"])?; // from which seat is no choice
                self.eat_any(&["again"]);
                Ok(Clause::StandUp)
            }
            Verb::Stop if self.peeks("for") || self.peek_number().is_some() => self.wait(),
            Verb::Stop => {
                self.eat_any(&["moving", "walking", "there", "here"]);
                Ok(Clause::Stop)
            }
            Verb::Wait => self.wait(),
            Verb::Board => {
                Ok(Clause::Board { what: self.reference(0)?, to: self.tail(&["to", "over to", "back to"])? })
            }
            Verb::Alight => Ok(self.alight()),
            Verb::Step => self.step(),
            Verb::Turn => self.turn(),
            Verb::Wave => {
                self.eat_any(&["at", "to", "your hand at", "your hand to", "hand to", "hands to"]);
                Ok(Clause::Wave { to: self.reference(0)? })
            }
            Verb::Photo => Ok(Clause::Photo),
        }
    }

    fn go(&mut self, pace: Pace) -> Result<Clause, PlanError> {
        self.eat_any(&["straight", "directly", "over", "back", "up", "down", "quickly", "slowly", "away"]);
        self.eat_any(&[
            "to", "towards", "toward", "up to", "over to", "into", "in", "onto", "on", "at", "for",
        ]);
        let side = self.side();
        Ok(Clause::Go { to: self.reference(0)?, side, pace, within: None })
    }

    /// "next to", "behind" and so on before a place.
    fn side(&mut self) -> Option<Relation> {
        let (relation, count) = longest(self.rest(), RELATIONS)?;
        self.at += count;
        Some(relation)
    }

    fn take(&mut self) -> Result<Clause, PlanError> {
        let what = self.reference(0)?;
        self.eat_any(&["up", "along", "with you"]);
        Ok(Clause::Take { what, to: self.tail(&["to", "over to", "back to", "into"])? })
    }

    fn drop(&mut self, manner: Manner) -> Result<Clause, PlanError> {
        let places = ["at", "to", "in", "on", "into", "over to", "back to"];
        let what = if self.ends_clause() || longest_phrase(self.rest(), &places).is_some() {
            None
        } else {
            Some(self.reference(0)?)
        };
        self.eat_any(&["down", "off", "up"]);
        let at = self.tail(&places)?;
        if manner == Manner::Deliver && at.is_none() {
            return Err(self.not_understood("say where to, as in \"bring the parcel to the museum\""));
        }
        Ok(Clause::Drop { what, at, manner })
    }

    /// A place after one of these words.
    fn tail(&mut self, words: &[&str]) -> Result<Option<Reference>, PlanError> {
        let side = longest(self.rest(), RELATIONS).map(|(_, count)| count);
        match longest_phrase(self.rest(), words).max(side) {
            Some(count) => {
                self.at += count;
                self.reference(0).map(Some)
            }
            None => Ok(None),
        }
    }

    fn sit(&mut self) -> Result<Clause, PlanError> {
        self.eat_any(&["there", "here"]);
        let start = self.at;
        if let Some(relation) = self.relation(0)? {
            // "Sit by the tree" asks for any seat there.
            let text = format!("seat {}", self.text_from(start));
            let (choice, relation) = (Choice::Open, Some(relation));
            return Ok(Clause::Sit {
                on: Some(Reference { choice, relation, text, ..Reference::to_any_seat() }),
            });
        }
        Ok(Clause::Sit { on: self.tail(&["on", "in", "at", "onto", "upon"])? })
    }

    fn alight(&mut self) -> Clause {
        self.eat_any(&["the", "of the", "of"]);
        let from =
            match (self.peeks("scooter"), self.peeks("car") || self.peeks("bus") || self.peeks("truck")) {
                (true, _) => Vehicle::Scooter,
                (_, true) => Vehicle::Car,
                _ => Vehicle::Any,
            };
        self.at += usize::from(from != Vehicle::Any);
        self.eat_any(&["it", "again"]);
        Clause::Alight { from }
    }

    fn wait(&mut self) -> Result<Clause, PlanError> {
        self.eat_any(&["here", "there"]);
        self.eat_any(&["for", "about"]);
        let Some((number, count)) = self.peek_number() else {
            return Err(self.not_understood("say how long, as in \"wait 5 seconds\""));
        };
        let number_at = self.at;
        self.at += count;
        let seconds = number * self.time_unit();
        if !(seconds > 0.0 && seconds <= LONGEST_WAIT) {
            self.at = number_at;
            return Err(self.not_understood("wait for more than 0 and at most 86400 seconds"));
        }
        Ok(Clause::Wait { seconds })
    }

    /// The length of the unit that follows, s; a second if none does.
    fn time_unit(&mut self) -> f64 {
        const UNITS: &[(&[&str], u32)] = &[
            (&["seconds", "second", "secs", "sec", "s"], 1),
            (&["minutes", "minute", "mins", "min"], 60),
            (&["hours", "hour", "h"], 3600),
        ];
        let (unit, count) = longest(self.rest(), UNITS).unwrap_or((1, 0));
        self.at += count;
        f64::from(unit)
    }

    /// Whether a direction or a length follows: "go forward", "walk 3 m".
    fn begins_step(&self) -> bool {
        let in_digits = matches!(self.rest().first(), Some(Lexeme { token: Token::Number(_), .. }));
        in_digits || self.counts_steps() || longest(self.rest(), DIRECTIONS).is_some()
    }

    /// Whether a number of metres or steps follows: "take two steps".
    fn counts_steps(&self) -> bool {
        self.peek_number().is_some_and(|(_, count)| longest_phrase(&self.rest()[count..], LENGTHS).is_some())
    }

    fn step(&mut self) -> Result<Clause, PlanError> {
        let mut direction = self.direction();
        let mut distance = 0.5;
        let number_at = self.at;
        if let Some((number, count)) = self.peek_number() {
            self.at += count;
            self.eat_any(LENGTHS);
            distance = number;
        }
        direction = direction.or_else(|| self.direction());
        if !(distance > 0.0 && distance <= LONGEST_STEP) {
            self.at = number_at;
            return Err(self.not_understood("step more than 0 and at most 10 metres"));
        }
        Ok(Clause::Step { direction: direction.unwrap_or(StepDirection::Forward), distance })
    }

    fn direction(&mut self) -> Option<StepDirection> {
        if self.eat_any(&["back"]) {
            return Some(StepDirection::Backward);
        }
        let (direction, count) = longest(self.rest(), DIRECTIONS)?;
        self.at += count;
        Some(direction)
    }

    fn turn(&mut self) -> Result<Clause, PlanError> {
        const SIDES: &[(&[&str], Side)] = &[
            (&["left", "to the left", "to your left"], Side::Left),
            (&["right", "to the right", "to your right"], Side::Right),
            (&["around", "round", "back"], Side::Around),
        ];
        let Some((side, count)) = longest(self.rest(), SIDES) else {
            return Err(self.not_understood("say left, right or around"));
        };
        self.at += count;
        self.eat_any(&["by"]);
        let number_at = self.at;
        let mut angle = FRAC_PI_2;
        if let Some((number, count)) = self.peek_number() {
            self.at += count;
            let in_radians = self.eat_any(&["radians", "radian", "rad"]);
            self.eat_any(&["degrees", "degree", "deg", "°"]);
            angle = if in_radians { number } else { number.to_radians() };
        }
        if !(angle > 0.0 && angle <= 2.0 * PI) {
            self.at = number_at;
            return Err(self.not_understood("turn by more than 0 and at most 360 degrees"));
        }
        let angle = match side {
            Side::Left => angle,
            Side::Right => -angle,
            Side::Around => PI,
        };
        Ok(Clause::Turn { angle })
    }

    // ---- the cursor ----

    pub(super) fn rest(&self) -> &'a [Lexeme] {
        &self.lexemes[self.at..]
    }

    fn peeks(&self, word: &str) -> bool {
        fits(self.rest(), word).is_some()
    }

    /// Passes the longest of these phrases, if one is there.
    pub(super) fn eat_any(&mut self, phrases: &[&str]) -> bool {
        let count = longest_phrase(self.rest(), phrases);
        self.at += count.unwrap_or(0);
        count.is_some()
    }

    /// A number in digits or words, with how many tokens it takes.
    fn peek_number(&self) -> Option<(f64, usize)> {
        match &self.rest().first()?.token {
            Token::Number(number) => Some((*number, 1)),
            Token::Word(word) => {
                NUMERALS.iter().find(|(numeral, _)| numeral == word).map(|(_, number)| (*number, 1))
            }
            _ => None,
        }
    }

    fn ends_clause(&self) -> bool {
        matches!(self.rest().first().map(|lexeme| &lexeme.token), None | Some(Token::Comma | Token::Break))
            || longest_phrase(self.rest(), JOINTS).is_some()
            || longest_phrase(self.rest(), FILLERS).is_some()
    }

    /// Passes what joins orders, with the politeness around it; whether there was any.
    fn skip_joints(&mut self) -> bool {
        let start = self.at;
        loop {
            self.skip_fillers();
            let mark =
                matches!(self.rest().first(), Some(l) if matches!(l.token, Token::Comma | Token::Break));
            if mark {
                self.at += 1;
            } else if !self.eat_any(JOINTS) {
                return self.at > start;
            }
        }
    }

    fn skip_fillers(&mut self) {
        while self.eat_any(FILLERS) {}
    }

    /// The answer when the words from here on make no sense.
    pub(super) fn not_understood(&self, hint: &str) -> PlanError {
        let start = self.rest().first().map_or(self.words.len(), |lexeme| lexeme.start);
        PlanError::NotUnderstood {
            words: shortened(self.words),
            fragment: shortened(&self.words[start..]),
            hint: hint.to_owned(),
        }
    }
}

#[derive(Clone, Copy)]
enum Side {
    Left,
    Right,
    Around,
}

/// Units of length; a step is taken for a metre.
const LENGTHS: &[&str] = &["metres", "metre", "meters", "meter", "m", "steps", "step"];

const DIRECTIONS: &[(&[&str], StepDirection)] = &[
    (&["forward", "forwards", "ahead", "straight ahead"], StepDirection::Forward),
    (&["backward", "backwards"], StepDirection::Backward),
    (&["left", "to the left", "to your left"], StepDirection::Left),
    (&["right", "to the right", "to your right"], StepDirection::Right),
];

/// A text cut to a length that fits into an answer.
pub(super) fn shortened(text: &str) -> String {
    const MOST: usize = 80;
    match text.char_indices().nth(MOST) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text.to_owned(),
    }
}
