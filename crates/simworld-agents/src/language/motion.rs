//! Orders that move the body: going, stepping, turning, looking.

use std::f64::consts::{FRAC_PI_2, PI};

use simworld_core::action::StepDirection;
use simworld_core::net::Turn;
use simworld_core::scene::Relation;
use simworld_core::seam::PlanError;

use super::clause::{Clause, Course, Pace, Reference, Spot, Target};
use super::lexer::{Lexeme, Token};
use super::lexicon::{fits, longest, longest_phrase, longest_relation};
use super::numbers;
use super::parser::Parser;
use super::phrases::Phrases;

/// The longest single step, m.
const LONGEST_STEP: f64 = 10.0;
/// How far one looks up or down where no angle is said, radians.
pub(super) const GLANCE: f64 = 0.35;
/// Units of length; a step is taken for a metre.
pub(super) const LENGTHS: &Phrases = &Phrases::of(&[
    "metres", "metre", "meters", "meter", "m", "steps", "step", "paces", "pace", "a metre", "a meter",
    "a step",
]);

#[rustfmt::skip]
const DIRECTIONS: &[(&[&str], StepDirection)] = &[
    (&["forward", "forwards", "ahead", "straight ahead", "straight", "straight on", "onward", "onwards",
    "straight forward"], StepDirection::Forward),
    (&["backward", "backwards", "to the rear"], StepDirection::Backward),
    (&["left", "to the left", "to your left", "leftwards", "over to the left", "to the left side"],
    StepDirection::Left),
    (&["right", "to the right", "to your right", "rightwards", "over to the right", "to the right side"],
    StepDirection::Right),
];

/// What leads to a place.
#[rustfmt::skip]
const TOWARDS: &Phrases = &Phrases::of(&[
    "to", "too", "towards", "toward", "up to", "over to", "into", "in", "onto", "on", "at", "for", "back to",
    "down to", "through", "out to", "right up to", "straight to", "as far as", "all the way to",
    "all the way up to", "by", "round to", "along to", "across to", "off to", "back into", "inside", "with",
    "until", "until you reach", "until you get to", "over at", "over by", "up at", "down at", "in on", "in at",
    "on over to", "back over to", "away to", "home to", "over towards", "right over to", "round by", "round at",
    "over into", "down by", "up by", "out at", "right to", "back at", "on", "near to",
]);

/// Going between two places again and again.
#[rustfmt::skip]
const TO_AND_FRO: &Phrases = &Phrases::of(&[
    "back and forth between", "to and fro between", "back and forth from", "and forth between",
    "and forth from", "up and down between", "and down between", "backwards and forwards between",
    "backward and forward between", "and forwards between", "to and fro from", "back and forward between",
    "backwards and forwards from", "up and down from", "back and fro between", "hither and thither between",
]);

#[derive(Clone, Copy)]
pub(super) enum Sense {
    Left,
    Right,
    Around,
}

pub(super) const SENSES: &[(&[&str], Sense)] = &[
    (&["left", "to the left", "to your left", "leftwards", "anticlockwise", "counterclockwise"], Sense::Left),
    (&["right", "to the right", "to your right", "rightwards", "clockwise"], Sense::Right),
    (
        &[
            "around",
            "round",
            "back",
            "about",
            "u turn",
            "you turn",
            "the other way",
            "the other way round",
            "the other way around",
            "the opposite way",
            "the other direction",
            "the opposite direction",
            "in the opposite direction",
            "completely around",
            "completely round",
        ],
        Sense::Around,
    ),
];

impl Parser<'_> {
    pub(super) fn go(&mut self, pace: Pace, start: usize) -> Result<Vec<Clause>, PlanError> {
        self.eat_any(&["first", "then", "next", "finally"]);
        // "Go another four metres".
        if let Some(more) = longest_phrase(
            self.rest(),
            &["another", "a further", "on another", "on for another", "for another"],
        ) && numbers::walked(&self.rest()[more..]).is_some()
        {
            self.at += more;
        }
        let pace = self.pace(pace)?;
        self.eat_any(&["on foot", "by foot"]);
        if let Some(goods) = self.goods_gone_for() {
            return self.purchase(goods, None); // "go for a tea"
        }
        let apart = self.apart();
        if apart.is_none()
            && let Some(clauses) = self.way(pace, start)?
        {
            return Ok(clauses);
        }
        self.eat_any(&[
            "straight",
            "directly",
            "over",
            "back",
            "up",
            "down",
            "away",
            "on",
            "all the way",
            "along",
            "right",
            "across",
            "out",
            "off",
            "yourself",
            "yourself down",
            "yourself over",
            "yourself up",
            "right over",
            "straight over",
            "straight away",
        ]);
        if let Some(clauses) = self.special_way(pace)? {
            return Ok(clauses);
        }
        let pace = self.pace(pace)?;
        if longest_phrase(self.rest(), &["for the", "for that"]).is_some()
            && numbers::duration(&self.rest()[1..]).is_none()
            && longest_phrase(&self.rest()[2..], &["next", "last", "rest", "whole", "time", "first"])
                .is_none()
        {
            self.at += 1; // "go for the white one"
        }
        if let Some(clauses) = self.leads_nowhere(pace, start) {
            return Ok(clauses);
        }
        let within = self.within()?;
        let apart = apart.or_else(|| self.apart());
        let named_side = longest_relation(self.rest()).is_some_and(|(_, words)| words > 1);
        if apart.is_none() && !named_side {
            self.eat_any(TOWARDS);
        }
        self.place_to_go(pace, within, apart, start)
    }

    /// A way that names no place: straight on, by the compass, so many steps, to and fro.
    fn way(&mut self, pace: Pace, start: usize) -> Result<Option<Vec<Clause>>, PlanError> {
        if let Some(to) = self.speaker_calls(start) {
            return Ok(Some(vec![Clause::Go { to, side: None, pace, within: None }]));
        }
        if let Some(clauses) = self.straight_at_junction() {
            return Ok(Some(clauses));
        }
        if let Some(clauses) = self.by_the_compass(pace)? {
            return Ok(Some(clauses));
        }
        if let Some(turn) = self.side_at_junction() {
            return Ok(Some(vec![turn]));
        }
        if self.begins_step() {
            return self.step().map(|step| Some(vec![step]));
        }
        if let Some(clauses) = self.between_places(pace)? {
            return Ok(Some(clauses));
        }
        if self.eat_any(TO_AND_FRO) {
            return self.back_and_forth(pace).map(Some);
        }
        if self.eat_any(&["via", "by way of"]) {
            let go = |to| Clause::Go { to, side: None, pace, within: None };
            let first = go(self.reference(0)?);
            let on = self.eat_any(&["to", "over to", "on to"]);
            return if on { Ok(Some(vec![first, go(self.reference(0)?)])) } else { Ok(Some(vec![first])) };
        }
        if let Some(to) = self.what_somebody_is_up_to(start) {
            return Ok(Some(vec![Clause::Go { to, side: None, pace, within: None }]));
        }
        Ok(None)
    }

    /// "Go back", "keep walking", "go in": no place is named.
    fn leads_nowhere(&mut self, pace: Pace, start: usize) -> Option<Vec<Clause>> {
        let returns = self.lexemes[start..self.at]
            .iter()
            .any(|lexeme| matches!(&lexeme.token, Token::Word(word) if word == "back" || word == "return"));
        if returns && self.ends_clause() {
            let to = Reference::to(Target::Here, "back".to_owned());
            return Some(vec![Clause::Go { to, side: None, pace, within: None }]);
        }
        if self.ends_clause() && self.continues() {
            return Some(vec![Clause::Forward]);
        }
        let inside = self.at;
        if self.eat_any(&["in", "inside"]) && self.ends_clause() {
            return Some(vec![Clause::Board { what: Reference::to(Target::It, "in".to_owned()), to: None }]);
        }
        self.at = inside;
        None
    }

    /// The place itself, beside what it is, and what is said of the way behind it.
    fn place_to_go(
        &mut self,
        pace: Pace,
        within: Option<f64>,
        apart: Option<f64>,
        start: usize,
    ) -> Result<Vec<Clause>, PlanError> {
        let stood =
            self.lexemes[start..self.at].iter().any(|lexeme| lexeme.token == Token::Word("stand".to_owned()));
        if let Some((compass, to)) = self.compass_side()? {
            return Ok(vec![Clause::Go { to, side: Some(Spot::Compass(compass, apart)), pace, within }]);
        }
        let side = self.side().or(if stood { Some(Relation::NextTo) } else { None });
        let side = side.map(|side| Spot::Beside(side, apart));
        let to = self.reference(0)?;
        let is_help = |lexeme: &Lexeme| lexeme.token == Token::Word("help".to_owned());
        if self.lexemes[start..self.at].iter().any(is_help) && self.peeks("with") {
            self.at = self.mark_from(self.at); // "go and help Fay with her bags"
        }
        let pace = self.pace(pace)?;
        self.after_place(Clause::Go { to, side, pace, within }, pace)
    }

    /// "Two metres" before "north of the hydrant" or "behind the statue", m.
    fn apart(&mut self) -> Option<f64> {
        let before = self.at;
        self.eat_any(&["over", "up", "down"]);
        self.eat_any(&["to"]);
        self.eat_any(&["the point", "the spot", "the place", "a point", "a spot", "a place"]);
        let Some((length, words)) = numbers::walked(self.rest()) else {
            self.at = before;
            return None;
        };
        let start = self.at;
        self.at += words;
        self.eat_any(&["to the", "away"]);
        let side = longest_relation(self.rest()).is_some()
            || self.compass().is_some() && longest_phrase(self.rest(), &["of", "from"]).is_some();
        self.at = if side { start + words } else { before };
        side.then_some(length)
    }

    /// "Come", "come over here": to who says it, where that is known.
    fn speaker_calls(&mut self, start: usize) -> Option<Reference> {
        let speaker = self.view.speaker?;
        let here = self.at;
        fits(&self.lexemes[start..], "come")
            .filter(|_| fits(&self.lexemes[start..], "come back").is_none())?;
        self.eat_any(&["here", "over here", "over", "right here", "on over", "closer", "back here"]);
        if !self.ends_clause() {
            self.at = here;
            return None;
        }
        Some(Reference::to(Target::Id(speaker), self.text_from(start)))
    }

    /// Whether what follows says how long to go on.
    pub(super) fn goes_on(&self) -> bool {
        longest_phrase(self.rest(), &["until", "till", "while", "for", "as long as"]).is_some()
    }

    /// As [`goes_on`](Self::goes_on), or nothing follows "keep walking".
    fn continues(&self) -> bool {
        self.goes_on() || self.at > 0 && self.lexemes[self.at - 1].lemma.is_some()
    }

    /// "next to", "behind" and so on before a place.
    pub(super) fn side(&mut self) -> Option<Relation> {
        let (relation, count) = longest_relation(self.rest())?;
        self.at += count;
        Some(relation)
    }

    /// Whether a direction or a length follows: "go forward", "walk 3 m".
    fn begins_step(&self) -> bool {
        let in_digits = matches!(self.rest().first(), Some(Lexeme { token: Token::Number(_), .. }));
        let back = longest_phrase(self.rest(), &["back"]).is_some()
            && numbers::number(&self.rest()[1..])
                .is_some_and(|(_, count)| longest_phrase(&self.rest()[1 + count..], LENGTHS).is_some());
        if self.peeks_halfway()
            || longest_phrase(
                self.rest(),
                &[
                    "right up",
                    "right in",
                    "right at",
                    "right over",
                    "right to",
                    "right by",
                    "right next",
                    "right beside",
                    "right behind",
                ],
            )
            .is_some()
        {
            return false;
        }
        let on = self.peeks("for") && numbers::walked(&self.rest()[1..]).is_some();
        in_digits
            || on
            || back
            || self.counts_steps()
            || longest(self.rest(), DIRECTIONS).is_some() && !self.leads_on()
    }

    /// "Straight to the museum" is no step.
    fn leads_on(&self) -> bool {
        let Some((_, count)) = longest(self.rest(), DIRECTIONS) else { return false };
        longest_phrase(&self.rest()[count..], &["to", "towards", "over to", "into"]).is_some()
            && longest(&self.rest()[count..], DIRECTIONS).is_none()
    }

    pub(super) fn step(&mut self) -> Result<Clause, PlanError> {
        let aside = self
            .eat_any(&["aside", "to the side", "to one side", "sideways"])
            .then_some(StepDirection::Right);
        self.eat_any(&["a bit", "a little", "a little bit", "slightly"]);
        let mut direction = self.direction().or(aside);
        let mut distance = 0.5;
        let number_at = self.at;
        self.eat_any(&["by", "for"]);
        let mut measured = false;
        if let Some((length, words)) = numbers::walked(self.rest()) {
            measured = numbers::length(self.rest()).is_some();
            self.at += words;
            distance = length;
        } else if let Some((number, words)) = numbers::number(self.rest())
            .filter(|_| numbers::times(self.rest()).is_none())
            .filter(|_| numbers::duration(self.rest()).is_none_or(|(_, words)| words < 2))
        {
            self.at += words;
            distance = number;
        } else {
            self.at = number_at;
        }
        self.eat_any(&[
            "further",
            "farther",
            "more",
            "a bit",
            "a little",
            "a little bit",
            "slightly",
            "a tad",
        ]);
        direction = direction.or_else(|| self.direction());
        // "Step forward, two metres".
        let comma = matches!(self.rest(), [Lexeme { token: Token::Comma, .. }, ..]);
        if comma
            && !measured
            && direction.is_some()
            && number_at == self.at
            && let Some((length, words)) = numbers::length(&self.rest()[1..])
        {
            self.at += 1 + words;
            (distance, measured) = (length, true);
        }
        if measured && distance > LONGEST_STEP && distance <= 10_000.0 {
            let course = Course::Relative(direction.unwrap_or(StepDirection::Forward));
            return Ok(Clause::Walk { course, distance, pace: Pace::Usual });
        }
        if !(distance > 0.0 && distance <= LONGEST_STEP) {
            self.at = number_at;
            return Err(self.not_understood("step more than 0 and at most 10 metres"));
        }
        Ok(Clause::Step { direction: direction.unwrap_or(StepDirection::Forward), distance })
    }

    fn direction(&mut self) -> Option<StepDirection> {
        if self.eat_any(&["back", "to the back"]) {
            return Some(StepDirection::Backward);
        }
        let (direction, count) = longest(self.rest(), DIRECTIONS)?;
        self.at += count;
        Some(direction)
    }

    pub(super) fn turn(&mut self) -> Result<Clause, PlanError> {
        if self.eat_any(&["your back on", "your back to", "your back towards", "away from", "your back upon"])
        {
            return Ok(Clause::TurnFrom { what: self.reference(0)? });
        }
        self.eat_any(&[
            "a little",
            "a bit",
            "a little bit",
            "slightly",
            "just a little",
            "your whole body",
            "your body",
            "sideways",
        ]);
        let mut sense = self.sense();
        self.eat_any(&["a little", "a bit", "a little bit", "slightly"]);
        if matches!(self.mark(), Some(','))
            && numbers::angle(self.rest().get(1..).unwrap_or_default()).is_some_and(|(_, words)| words > 1)
        {
            self.at += 1;
        }
        self.eat_any(&["by", "for"]);
        let number_at = self.at;
        let mut angle = FRAC_PI_2;
        if let Some((said, count)) = numbers::angle(self.rest()) {
            self.at += count;
            angle = said;
        }
        sense = sense.or_else(|| self.sense());
        self.eat_any(&["turn", "hand turn"]);
        if sense.is_none()
            && let Some(compass) = self.compass()
        {
            return Ok(Clause::FaceCompass(compass));
        }
        let half_turn = (angle - PI).abs() < 1e-9 || (angle - 2.0 * PI).abs() < 1e-9;
        let Some(sense) = sense.or(half_turn.then_some(Sense::Around)) else {
            return Err(self.not_understood("say left, right or around"));
        };
        if !(angle > 0.0 && angle <= 2.0 * PI) {
            self.at = number_at;
            return Err(self.not_understood("turn by more than 0 and at most 360 degrees"));
        }
        let angle = match sense {
            Sense::Left => angle,
            Sense::Right => -angle,
            Sense::Around if angle > PI + 1e-9 => angle,
            Sense::Around => PI,
        };
        if let Some((nth, lights)) = self.junction() {
            let turn = if angle > 0.0 { Turn::Left } else { Turn::Right };
            return Ok(Clause::TurnAt { turn, nth, lights });
        }
        self.turned = Some(angle.signum());
        Ok(Clause::Turn { angle })
    }

    fn sense(&mut self) -> Option<Sense> {
        let (sense, count) = longest(self.rest(), SENSES)?;
        self.at += count;
        Some(sense)
    }

    /// "Turn to" somebody, or to a side.
    pub(super) fn face(&mut self) -> Result<Clause, PlanError> {
        if self.eat_any(&["the left", "your left", "left"]) {
            return Ok(Clause::Turn { angle: FRAC_PI_2 });
        }
        if self.eat_any(&["the right", "your right", "right"]) {
            return Ok(Clause::Turn { angle: -FRAC_PI_2 });
        }
        if self.eat_any(&[
            "the other way",
            "the opposite way",
            "the other direction",
            "the opposite direction",
            "backwards",
            "the other way round",
        ]) {
            return Ok(Clause::Turn { angle: PI });
        }
        if let Some(compass) = self.compass() {
            return Ok(Clause::FaceCompass(compass));
        }
        if self.eat_any(&["away from"]) {
            return Ok(Clause::TurnFrom { what: self.reference(0)? });
        }
        Ok(Clause::Face { what: self.reference(0)? })
    }
}
