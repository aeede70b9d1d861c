//! Blocks at the beginning of a statement: conditions, repetitions, and what is done before or after something else.

use simworld_core::seam::PlanError;

use super::clause::{Clause, Pace, Test};
use super::lexer::{Lexeme, Token};
use super::lexicon::{fits, longest_phrase};
use super::numbers;
use super::parser::{Extent, Parser};
use super::phrases::Phrases;
use super::repeats::over_and_over;
use super::tails::ON_THE_WAY;
use super::verbs::longest_verb;

/// What begins a condition.
#[rustfmt::skip]
pub(super) const IF: &Phrases = &Phrases::of(&[
    "if", "in case", "in case of", "in the case of", "provided that", "provided", "providing",
    "in the event that", "in the event", "in the event of", "assuming", "assuming that", "supposing",
    "supposing that", "on condition that", "only if", "but only if", "if and only if",
    "if it should happen that", "if it so happens that", "if it turns out that", "if it happens that",
    "suppose", "suppose that", "lets suppose", "imagine", "imagine that", "say that", "given that", "subject to", "whether", "seeing that", "if you find that", "if you notice that", "if you see that",
]);
pub(super) const UNLESS: &Phrases =
    &Phrases::of(&["unless", "if not", "except if", "except when", "but not if", "so long as not"]);
pub(super) const UNTIL: &Phrases = &Phrases::of(&[
    "until",
    "till",
    "up until",
    "til",
    "up to when",
    "right until",
    "until such time as",
    "until the moment",
    "and dont stop until",
    "and do not stop until",
    "and dont cease until",
    "and do not cease until",
    "dont stop until",
    "do not stop until",
    "do not cease until",
    "never stopping until",
    "not stopping until",
    "without stopping until",
    "as far as when",
    "all the way until",
    "right up until",
    "and dont give up until",
    "just until",
    "only until",
]);
pub(super) const WHILE: &Phrases = &Phrases::of(&[
    "while",
    "as long as",
    "so long as",
    "for as long as",
    "for so long as",
    "whilst",
    "all the while",
]);
#[rustfmt::skip]
pub(super) const WHEN: &Phrases = &Phrases::of(&[
    "when", "whenever", "once", "as soon as", "when and only when", "after", "upon", "the moment", "right after", "immediately after",
    "the instant", "the minute", "directly after", "just after", "straight after", "as soon as ever",
    "every time", "each time", "on reaching", "on arriving at", "on getting to", "on arrival at",
    "upon reaching", "upon arriving at", "upon arrival at", "arriving at", "reaching", "on your arrival at",
]);
/// Those of them that may follow an order.
pub(super) const WHEN_SO: &Phrases = &Phrases::of(&["when", "whenever", "once"]);
/// What begins an order that goes on.
#[rustfmt::skip]
pub(super) const GOES_ON: &Phrases = &Phrases::of(&[
    "keep", "keep on", "continue", "continue to", "go on", "carry on", "dont stop", "do not stop", "never stop",
    "dont quit", "keep up", "dont cease", "do not cease", "dont give up", "never cease", "never quit", "loop",
]);
/// Being somewhere, which one has to go to first: "once you are at the bench, sit down".
#[rustfmt::skip]
const REACHING: &Phrases = &Phrases::of(&[
    "you reach", "you have reached", "youve reached", "you get to", "you have got to", "youve got to",
    "you are at", "youre at", "you arrive at", "you have arrived at", "youve arrived at", "you come to",
    "you are next to", "youre next to", "you are beside", "youre beside", "you are near", "youre near",
    "you make it to", "reaching", "arriving at", "getting to", "at", "you are by", "you get there to", "reach",
    "arrival at", "you stand at", "we reach", "we get to", "were at",
]);
/// What begins what else is done, and what says so of the condition itself.
#[rustfmt::skip]
const ELSE: &Phrases = &Phrases::of(&[
    "otherwise", "else", "or else", "if not", "if no", "and if no", "or", "failing that", "if that fails", "in any other case",
    "in all other cases", "should that not be so", "and if not", "but if not", "and otherwise", "but otherwise",
    "if thats not the case", "if that is not the case", "in the other case",
]);

/// What is done if what was asked is so, and if it is not.
const SO: &Phrases = &Phrases::of(&[
    "if so",
    "if yes",
    "in that case",
    "if it is",
    "if they are",
    "if he is",
    "if she is",
    "then",
    "if there is",
    "if it does",
    "if he does",
    "if she does",
    "if you do",
    "if you can",
    "if you have",
    "if it has",
    "if you see one",
    "then if so",
    "yes",
    "if thats so",
    "if thats the case",
]);
#[rustfmt::skip]
pub(super) const NOT_SO: &Phrases = &Phrases::of(&[
    "if not", "if it isnt", "if it is not", "if its not", "if no", "if there isnt", "if there is not",
    "if he isnt", "if she isnt", "if it doesnt", "if you dont", "if you cant", "if you havent", "no",
    "if none", "otherwise",
]);

impl Parser<'_> {
    /// A block, if one begins here.
    pub(super) fn block(&mut self) -> Result<Option<Vec<Clause>>, PlanError> {
        for rule in
            [Self::conditional, Self::timed, Self::placed, Self::lasting, Self::sequential, Self::repeated]
        {
            let start = self.at;
            if let Some(clauses) = rule(self)? {
                return Ok(Some(clauses));
            }
            self.at = start;
        }
        Ok(None)
    }

    /// "If", "unless", and a question with "if so".
    fn conditional(&mut self) -> Result<Option<Vec<Clause>>, PlanError> {
        if let Some(clauses) = self.checked() {
            return Ok(Some(clauses));
        }
        let should = self.peeks("should") && longest_verb(&self.rest()[1..]).is_none();
        if self.eat_any(UNLESS) {
            return self.either(true).map(Some);
        }
        if self.eat_any(IF) || should && self.eat_any(&["should"]) {
            return self.either(false).map(Some);
        }
        if let Some(test) = self.asked() {
            while matches!(self.rest().first(), Some(Lexeme { token: Token::Break | Token::Comma, .. })) {
                self.at += 1;
            }
            self.eat_any(&["well", "and"]);
            let not = self.eat_any(NOT_SO);
            // "Is it dark? Go to the lodge".
            if not || self.eat_any(SO) || test.is_of_the_world() {
                let test = if not { Test::Not(Box::new(test)) } else { test };
                return self.then_or_else(test).map(Some);
            }
        }
        Ok(None)
    }

    /// "Every ten seconds", "after ten seconds", "for a minute".
    fn timed(&mut self) -> Result<Option<Vec<Clause>>, PlanError> {
        if let Some((seconds, count)) = self.peek_interval() {
            self.at += count;
            self.skip_joints();
            let body = self.statement()?;
            return Ok(Some(vec![over_and_over(body, seconds)]));
        }
        if let Some((seconds, count)) = self.peek_span() {
            self.at += count;
            self.skip_joints();
            let body = self.orders(Extent::Group)?;
            return Ok(Some(vec![Clause::Until { test: Test::Elapsed(seconds), body }]));
        }
        if self.eat_any(&["at", "by"]) {
            let test = self.weather();
            if let Some(test) = test.filter(|_| self.ends_at_mark() || longest_verb(self.rest()).is_some()) {
                self.skip_joints();
                let mut clauses = vec![Clause::Until { test, body: Vec::new() }];
                clauses.extend(self.statement()?);
                return Ok(Some(clauses));
            }
            return Ok(None);
        }
        if self.eat_any(&["after", "in", "within"])
            && let Some((seconds, count)) =
                numbers::duration(self.rest()).filter(|(seconds, _)| *seconds > 0.0)
            && longest_phrase(
                &self.rest()[count..],
                &["have passed", "has passed", "have gone by", "pass", "passes", "are over", "have elapsed"],
            )
            .is_none()
        {
            self.at += count;
            self.eat_any(&["time", "from now"]);
            self.skip_joints();
            let mut clauses = vec![Clause::Wait { seconds }];
            clauses.extend(self.statement()?);
            return Ok(Some(clauses));
        }
        Ok(None)
    }

    /// "At the next light", "on the way to the museum".
    fn placed(&mut self) -> Result<Option<Vec<Clause>>, PlanError> {
        if let Some(clauses) = self.at_junction()? {
            return Ok(Some(clauses));
        }
        if self.eat_any(ON_THE_WAY) {
            let to = self.reference(0)?;
            self.skip_joints();
            let mut clauses = self.statement()?;
            clauses.push(Clause::Go { to, side: None, pace: Pace::Usual, within: None });
            return Ok(Some(clauses));
        }
        // "Having a look at it" is an order of its own.
        let has = self.peeks("having") && longest_verb(self.rest()).is_some_and(|(_, words)| words > 1);
        if !has
            && self.eat_any(&[
                "having",
                "start by",
                "begin by",
                "start off by",
                "start with",
                "begin with",
                "finish by",
                "end by",
                "finish off by",
                "continue by",
                "start out by",
                "kick off by",
                "end with",
                "finish with",
            ])
        {
            if longest_verb(self.rest()).is_none()
                && let Some(clauses) = self.visited()
            {
                return Ok(Some(clauses));
            }
            return self.statement().map(Some);
        }
        Ok(None)
    }

    /// "Until", "while".
    fn lasting(&mut self) -> Result<Option<Vec<Clause>>, PlanError> {
        if self.eat_any(UNTIL) {
            let test = self.test()?;
            self.skip_joints();
            let body = self.orders(Extent::Group)?;
            let waits = matches!(&body[..], [Clause::Stop | Clause::Wait { .. }]);
            return Ok(Some(vec![Clause::Until { test, body: if waits { Vec::new() } else { body } }]));
        }
        if self.eat_any(WHILE) {
            let test = self.test()?.contrary();
            self.skip_joints();
            let start = self.at;
            if self.eat_any(&[
                "wait",
                "stop",
                "stand still",
                "stay",
                "wait here",
                "stand",
                "stay put",
                "stay where you are",
                "stay here",
                "dont move",
                "remain where you are",
            ]) && self.ends_clause()
            {
                return Ok(Some(vec![Clause::Until { test, body: Vec::new() }]));
            }
            self.at = start;
            return Ok(Some(vec![Clause::Until { test, body: self.orders(Extent::Group)? }]));
        }
        Ok(None)
    }

    /// "When", "once", "after", "before".
    fn sequential(&mut self) -> Result<Option<Vec<Clause>>, PlanError> {
        let counts = numbers::times(self.rest()).is_some() && !self.peeks("once");
        if !counts && self.eat_any(WHEN) {
            let reaches = ["reaching", "at", "to"].contains(&self.word_before());
            if reaches {
                let to = self.reference(0)?;
                self.skip_joints();
                let mut clauses = vec![Clause::Go { to, side: None, pace: Pace::Usual, within: None }];
                clauses.extend(self.statement()?);
                return Ok(Some(clauses));
            }
            return match self.afterwards() {
                Ok(clauses) => Ok(Some(clauses)),
                // "Once more" is no time.
                Err(_) if fits(&self.lexemes[self.at - 1..], "once").is_some() => Ok(None),
                Err(error) => Err(error),
            };
        }
        if self.eat_any(&["before", "prior to", "but before"]) {
            self.eat_any(&["you", "that you"]);
            if self.aside_begins() {
                return Ok(None);
            }
            let later = self.statement()?;
            self.skip_joints();
            let mut clauses = self.orders(Extent::Group)?;
            clauses.extend(later);
            return Ok(Some(clauses));
        }
        Ok(None)
    }

    /// "Keep waving", "repeat three times".
    fn repeated(&mut self) -> Result<Option<Vec<Clause>>, PlanError> {
        let start = self.at;
        // "Keep close to Hana" is a verb of its own.
        let is_verb = longest_verb(self.rest()).is_some_and(|(_, words)| words > 2);
        if !is_verb && self.eat_any(GOES_ON) && !self.ends_clause() && longest_verb(self.rest()).is_some() {
            return self.keep().map(Some);
        }
        self.at = start;
        self.eat_any(&[
            "repeat",
            "repeat this",
            "do this",
            "do the following",
            "repeat the following",
            "do",
            "make",
            "do it",
            "do all this",
            "do all of this",
            "do the next thing",
            "do the same",
        ]);
        if let Some((times, count)) = numbers::times(self.rest()).or_else(|| self.rounds_of()) {
            self.at += count;
            // "Repeat three times: ..." is about all that follows.
            let colon = matches!(self.rest(), [Lexeme { token: Token::Break, .. }, ..]);
            self.skip_joints();
            self.eat_any(&["do the following", "do this"]);
            let colon =
                self.skip_joints() && matches!(self.lexemes[self.at - 1].token, Token::Break) || colon;
            let extent = if colon { Extent::Sentence } else { Extent::Group };
            let body = self.orders(extent)?;
            if body.is_empty() {
                return Err(self.not_understood("say what to do so often"));
            }
            return Ok(Some(vec![Clause::Repeat { times, body }]));
        }
        Ok(None)
    }

    /// After "if": the test, what to do, and what else.
    fn either(&mut self, negated: bool) -> Result<Vec<Clause>, PlanError> {
        let test = self.test()?;
        self.then_or_else(if negated { test.contrary() } else { test })
    }

    /// After the test.
    fn then_or_else(&mut self, test: Test) -> Result<Vec<Clause>, PlanError> {
        self.skip_joints();
        let then = self.orders(Extent::Group)?;
        if then.is_empty() {
            return Err(self.not_understood("say what to do then"));
        }
        let then = super::conditions::taken_instead(&test, then);
        let end = self.at;
        self.skip_joints();
        let mut otherwise = Vec::new();
        let negative = matches!(test, Test::Not(_));
        if self.contrary_follows(&test) || self.eat_any(ELSE) || self.denied() || negative && self.affirmed()
        {
            self.skip_joints();
            otherwise = match self.at_another_pace(&then) {
                Some(again) => again,
                None => self.orders(Extent::Group)?,
            };
        } else {
            self.at = end;
        }
        Ok(vec![Clause::If { test, then, otherwise }])
    }

    /// "And if it doesn't": the contrary of the condition, without its words.
    fn denied(&mut self) -> bool {
        let start = self.at;
        self.eat_any(&["and", "but"]);
        let subject = self.eat_any(&["if", "when", "in case"])
            && self.eat_any(&[
                "it", "he", "she", "they", "there", "you", "that", "its", "this", "shes", "hes", "theyre",
                "youre",
            ]);
        let denied = subject
            && self.eat_any(&[
                "doesnt", "does not", "isnt", "is not", "not", "arent", "are not", "dont", "do not", "cant",
                "cannot", "hasnt", "has not", "havent", "wont", "aint",
            ]);
        self.eat_any(&["so", "there", "the case", "any"]);
        if denied && (self.ends_at_mark() || longest_verb(self.rest()).is_some()) {
            return true;
        }
        self.at = start;
        false
    }

    /// "If it is", after "if it isn't raining".
    fn affirmed(&mut self) -> bool {
        let start = self.at;
        self.eat_any(&["and", "but"]);
        let yes = self.eat_any(&[
            "if so",
            "if it is",
            "if it does",
            "if they are",
            "if there is",
            "if he is",
            "if she is",
            "if you do",
            "if you can",
            "if it has",
            "if you are",
            "if yes",
            "if its",
            "when it does",
            "when it is",
        ]);
        if yes && (self.ends_at_mark() || longest_verb(self.rest()).is_some()) {
            return true;
        }
        self.at = start;
        false
    }

    /// After "when": a test to wait for, or an order that comes first.
    fn afterwards(&mut self) -> Result<Vec<Clause>, PlanError> {
        let start = self.at;
        if self.eat_any(REACHING) {
            let to = self.reference(0)?;
            self.skip_joints();
            let mut clauses = vec![Clause::Go { to, side: None, pace: Pace::Usual, within: None }];
            clauses.extend(self.statement()?);
            return Ok(clauses);
        }
        if let Ok(test) = self.test() {
            self.skip_joints();
            let then = if self.at < self.lexemes.len() { self.statement()? } else { Vec::new() };
            let end = self.at;
            self.skip_joints();
            if !then.is_empty() && self.eat_any(&["otherwise", "else", "or else"]) {
                self.skip_joints(); // "when it is dark ..., otherwise ..." does not wait for the dark
                if let Some(otherwise) = self.at_another_pace(&then) {
                    return Ok(vec![Clause::If { test, then, otherwise }]);
                }
            }
            self.at = end;
            // "When you've got the letter, go to the clinic": nobody else brings it.
            let first = match test {
                Test::Holds(Some(what)) => Clause::Take { what, to: None, grip: super::clause::Grip::Lift },
                test => Clause::Until { test, body: Vec::new() },
            };
            return Ok([first].into_iter().chain(then).collect());
        }
        self.at = start;
        self.eat_any(&[
            "you",
            "you have",
            "youve",
            "you are",
            "you had",
            "having",
            "being",
            "youre",
            "we have",
            "weve",
            "you get",
            "being done",
        ]);
        if let Some(there) = self.visited() {
            return Ok(there);
        }
        if self.aside_begins() {
            return Err(self.not_understood("say when in words such as \"when the light is green\""));
        }
        self.statement()
    }
}
