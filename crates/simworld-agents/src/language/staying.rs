//! Orders to stay: sitting down, stopping, waiting.

use simworld_core::scene::Relation;
use simworld_core::seam::PlanError;

use super::clause::{Clause, Pace, Reference, Spot, Stands, Test};
use super::lexer::{Lexeme, Token};
use super::lexicon::{Category, fits, longest_phrase, longest_relation};
use super::numbers::{self, MOMENT};
use super::parser::Parser;
use super::phrases::Phrases;
use super::verbs::Verb;

/// The longest wait, s.
pub(super) const LONGEST_WAIT: f64 = 86_400.0;

/// What somebody is waited for to do.
#[rustfmt::skip]
const TO_COME: &Phrases = &Phrases::of(&[
    "to arrive", "to come", "to come here", "to get here", "to reach you", "to come closer", "to come nearer",
    "to come near", "to come over", "to approach", "to come to you", "to be here", "to be near",
    "to come near you", "to get near", "to get close", "to come up", "to return", "to come back", "to walk up",
    "to show up", "to turn up", "to join you", "to catch up",
]);

impl Parser<'_> {
    pub(super) fn sit(&mut self) -> Result<Vec<Clause>, PlanError> {
        // "Sink into a chair", "occupy the bench": what leads to the seat is part of the verb.
        if ["on", "onto", "into", "occupy"].contains(&self.word_before()) && !self.ends_clause() {
            return Ok(vec![Clause::Sit { on: Some(self.reference(0)?) }]);
        }
        self.eat_any(&["there", "here", "down"]);
        let start = self.at;
        let beside = if self.eat_any(&["at"]) {
            Some(Stands::To(Relation::NextTo, Box::new(self.reference(0)?)))
        } else {
            self.relation(0)?
        };
        if beside.is_some() {
            // "Sit by the tree" asks for any seat there.
            let text = format!("seat {}", self.text_from(start));
            let seat = Reference::nearest(Category::seat());
            let seat = Reference { choice: super::clause::Choice::Open, relation: beside, text, ..seat };
            return Ok(vec![Clause::Sit { on: Some(seat) }]);
        }
        if let Some(words) = longest_phrase(self.rest(), &["on", "in"])
            && longest_phrase(
                &self.rest()[words..],
                &["one after the other", "one after another", "each of them", "each one", "one by one"],
            )
            .is_some()
        {
            return Err(self.not_understood("say on which seat, one after the other"));
        }
        Ok(vec![Clause::Sit {
            on: self.tail_place(&[
                "on",
                "in",
                "onto",
                "upon",
                "down on",
                "into",
                "down in",
                "down into",
                "back on",
                "back down on",
                "over on",
            ])?,
        }])
    }

    pub(super) fn stop(&mut self) -> Result<Vec<Clause>, PlanError> {
        if self.peeks("for") || self.peeks("until") || self.peeks("till") || self.peek_time().is_some() {
            return self.wait();
        }
        if self.waits_next() {
            return Ok(Vec::new()); // "stay where you are and wait for ten seconds" is one thing
        }
        if let Some(clauses) = self.stop_of_it() {
            return Ok(clauses);
        }
        let stays = self.at > 0
            && ["stay", "keep", "remain"].contains(&self.word_before())
            && longest_phrase(self.rest(), &["away from", "clear of", "well away from", "off", "out of"])
                .is_some();
        if stays {
            return Err(self.not_understood("keeping away from things is not understood: say where to go"));
        }
        if let Some(clauses) = self.short_of()? {
            return Ok(clauses);
        }
        if self.peeks_halfway()
            && let Some(clauses) = self.special_way(Pace::Usual)?
        {
            return Ok(clauses);
        }
        if self.eat_any(&[
            "at",
            "by",
            "near",
            "next to",
            "beside",
            "outside",
            "in front of",
            "close to",
            "alongside",
            "under",
            "underneath",
            "beneath",
        ]) {
            let to = self.reference(0)?;
            return Ok(vec![Clause::Go { to, side: None, pace: Pace::Usual, within: None }]);
        }
        let moved = matches!(self.previous, Some(Verb::Go | Verb::Run | Verb::Stroll | Verb::Drive));
        let there = self.at > 0 && self.lexemes[self.at - 1].token == Token::Word("there".to_owned());
        if there && self.at > 2 && fits(&self.lexemes[self.at - 3..], "go stand there").is_some()
            || there && self.at > 3 && fits(&self.lexemes[self.at - 4..], "go and stand there").is_some()
        {
            let to = Reference::to(super::clause::Target::There, "there".to_owned());
            return Ok(vec![Clause::Go { to, side: None, pace: Pace::Usual, within: None }]);
        }
        if moved && (self.eat_any(&["there", "right there"]) || there && self.ends_clause()) {
            return Ok(Vec::new()); // one stops where one went
        }
        self.eat_any(&[
            "moving",
            "walking",
            "there",
            "here",
            "running",
            "that",
            "what you are doing",
            "what youre doing",
            "whatever you are doing",
            "whatever youre doing",
            "everything",
            "the car",
            "the vehicle",
            "the taxi",
            "the bus",
            "the truck",
            "the van",
            "driving",
            "moving around",
            "right there",
            "right here",
            "dead",
        ]);
        Ok(vec![Clause::Stop])
    }

    /// Whether somebody is told to stay, and so long.
    fn waits_next(&self) -> bool {
        let stays = (1..=5).any(|back| {
            back <= self.at && ["stay", "remain"].contains(&self.word_before_at(self.at + 1 - back))
        });
        let next = [
            "and wait",
            "and just wait",
            "and wait there",
            "and wait here",
            "and wait for",
            "and wait there for",
            "and wait here for",
            "and just wait for",
        ];
        stays
            && longest_phrase(self.rest(), &next).is_some_and(|words| {
                numbers::duration(&self.rest()[words..]).is_some_and(|(_, count)| count > 1)
            })
    }

    /// What is stopped, or on which side of what.
    fn stop_of_it(&mut self) -> Option<Vec<Clause>> {
        // "Stop following Tom": what is stopped is not begun.
        let start = self.at;
        let stopped = matches!(self.rest().first(), Some(Lexeme { token: Token::Word(word), lemma: Some(_), .. }) if word.ends_with("ing"));
        if stopped && self.order().is_ok() && self.ends_clause() {
            return Some(vec![Clause::Stop]);
        }
        self.at = start;
        // "Stop behind the van".
        let side = longest_relation(self.rest()).filter(|(relation, _)| {
            !matches!(relation, Relation::NextTo | Relation::Near | Relation::Inside | Relation::OnTopOf)
        });
        if let Some((relation, words)) = side
            && longest_phrase(self.rest(), &["outside", "in front of"]).is_none()
        {
            let start = self.at;
            self.at += words;
            if let Ok(to) = self.reference(0) {
                let side = Some(Spot::Beside(relation, None));
                return Some(vec![Clause::Go { to, side, pace: Pace::Usual, within: None }]);
            }
            self.at = start;
        }
        None
    }

    pub(super) fn wait(&mut self) -> Result<Vec<Clause>, PlanError> {
        let here = self.eat_any(&["here", "right here", "where you are"]);
        let there = self.eat_any(&["there", "right there"]);
        let moved = matches!(self.previous, Some(Verb::Go | Verb::Run | Verb::Stroll | Verb::Drive));
        if there && moved && self.ends_at_mark() {
            return Ok(Vec::new()); // one waits where one went
        }
        if here && self.ends_at_mark() {
            return Ok(vec![Clause::Stop]); // "wait here, I'll be back soon"
        }
        if self.eat_any(&["until", "till", "up until"]) {
            return Ok(vec![Clause::Until { test: self.test()?, body: Vec::new() }]);
        }
        if self.eat_any(&["while", "as long as", "so long as"]) {
            let test = Test::Not(Box::new(self.test()?));
            return Ok(vec![Clause::Until { test, body: Vec::new() }]);
        }
        let mut clauses = Vec::new();
        if let Some((relation, count)) = longest_relation(self.rest())
            .or_else(|| fits(self.rest(), "at").map(|count| (Relation::NextTo, count)))
        {
            self.at += count;
            let to = self.reference(0)?;
            let side = Some(relation);
            clauses.push(Clause::Go {
                to,
                side: side.map(|side| Spot::Beside(side, None)),
                pace: Pace::Usual,
                within: None,
            });
        }
        if clauses.is_empty() && self.rests_there(&mut clauses)? {
            return Ok(clauses);
        }
        let is_for = self.eat_any(&["for", "for about", "for at least"]);
        if !clauses.is_empty() && is_for && self.peek_time().is_none() {
            clauses.extend(self.wait_for()?); // "wait at the statue for Hana"
            return Ok(clauses);
        }
        self.eat_any(&["about"]);
        let number_at = self.at;
        let bare = numbers::number(self.rest()).filter(|(_, words)| {
            let after = self.rest().get(*words..).unwrap_or_default();
            !matches!(after.first(), Some(Lexeme { token: Token::Word(_) | Token::Number(_), .. }))
                || super::politeness::joint(after).is_some()
        });
        let Some((seconds, count)) = self.peek_time().or(bare) else {
            if !clauses.is_empty() {
                clauses.push(Clause::Wait { seconds: MOMENT });
                return Ok(clauses);
            }
            if is_for && !self.ends_clause() {
                return self.wait_for();
            }
            return Err(self.not_understood("say how long, as in \"wait 5 seconds\""));
        };
        self.at += count;
        if !(seconds > 0.0 && seconds <= LONGEST_WAIT) {
            self.at = number_at;
            return Err(self.not_understood("wait for more than 0 and at most 86400 seconds"));
        }
        if clauses.is_empty() && !self.rests_there(&mut clauses)? && clauses.is_empty() {
            self.waits_by(&mut clauses)?; // "rest for a minute on the blue bench"
        }
        clauses.push(Clause::Wait { seconds });
        Ok(clauses)
    }

    /// "Wait twenty seconds at the clock": where.
    fn waits_by(&mut self, clauses: &mut Vec<Clause>) -> Result<(), PlanError> {
        if self.eat_any(&["at", "by", "near", "beside", "next to", "outside", "in front of"]) {
            let to = self.reference(0)?;
            clauses.push(Clause::Go { to, side: None, pace: Pace::Usual, within: None });
        }
        Ok(())
    }

    /// "Rest on the red bench", "wait in the library": where, and whether that is all.
    fn rests_there(&mut self, clauses: &mut Vec<Clause>) -> Result<bool, PlanError> {
        if longest_phrase(self.rest(), &["on", "in", "inside", "over at", "over by"]).is_none() {
            return Ok(false);
        }
        let seated = self.peeks("on");
        self.at += longest_phrase(self.rest(), &["on", "in", "inside", "over at", "over by"]).unwrap_or(0);
        let to = self.reference(0)?;
        let seats = seated
            && matches!(&to.target, super::clause::Target::Any(class) if class.kinds().iter().any(|kind| kind.is_seat()));
        clauses.push(if seats {
            Clause::Sit { on: Some(to) }
        } else {
            Clause::Go { to, side: None, pace: Pace::Usual, within: None }
        });
        if seats && self.peek_time().is_none() && longest_phrase(self.rest(), &["for"]).is_none() {
            return Ok(true);
        }
        Ok(false)
    }

    /// "Wait for Anna", "wait for a green light".
    fn wait_for(&mut self) -> Result<Vec<Clause>, PlanError> {
        let start = self.at;
        self.eat_any(&["the", "a"]);
        if self.eat_any(&[
            "green light",
            "green",
            "light to turn green",
            "light to be green",
            "lights to turn green",
        ]) {
            let test = Test::Light { light: None, shows: simworld_core::net::Aspect::Green };
            return Ok(vec![Clause::Until { test, body: Vec::new() }]);
        }
        self.at = start;
        if let Some(test) = self.sky_to().or_else(|| self.light_to_turn()) {
            return Ok(vec![Clause::Until { test, body: Vec::new() }]);
        }
        self.at = start;
        // "If the light isn't green wait for it".
        let light = match &self.tested {
            Some(Test::Not(test)) => Some((**test).clone()),
            tested => tested.clone(),
        };
        if let Some(test @ Test::Light { .. }) = light
            && self.eat_any(&["it", "that"])
            && self.ends_clause()
        {
            return Ok(vec![Clause::Until { test, body: Vec::new() }]);
        }
        self.at = start;
        let what = self.reference(0)?;
        let at = self.at;
        if self.eat_any(&["to be", "to become", "to get"])
            && let Some(test) = self.state_of(what.clone())
        {
            return Ok(vec![Clause::Until { test, body: Vec::new() }]);
        }
        self.at = at;
        for (words, open) in [("to open", true), ("to close", false), ("to shut", false)] {
            if self.eat_any(&[words]) {
                let test = Test::Open(what);
                let test = if open { test } else { Test::Not(Box::new(test)) };
                return Ok(vec![Clause::Until { test, body: Vec::new() }]);
            }
        }
        self.eat_any(TO_COME);
        let test = Test::Near { what, within: super::tests_of::NEXT_TO_ME };
        Ok(vec![Clause::Until { test, body: Vec::new() }])
    }

    /// A length of time; a bare number is seconds.
    pub(super) fn peek_time(&self) -> Option<(f64, usize)> {
        numbers::duration(self.rest())
    }
}
