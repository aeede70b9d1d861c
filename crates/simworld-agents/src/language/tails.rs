//! What follows an order and says how often, how long, when and on what condition.

use simworld_core::seam::PlanError;

use super::blocks::{IF, NOT_SO, UNLESS, UNTIL, WHILE};
use super::clause::{Clause, Pace, Target, Test};
use super::deferred::first_and_later;
use super::lexer::{Lexeme, Token};
use super::lexicon::longest_phrase;
use super::numbers;
use super::parser::{Extent, Parser};
use super::phrases::Phrases;
use super::politeness::MANNERS;
use super::repeats::{body_of, over_and_over, repeat};
use super::requests;

/// Before where one goes in the end.
pub(super) const ON_THE_WAY: &Phrases = &Phrases::of(&[
    "on the way to",
    "on your way to",
    "on the way over to",
    "on your way over to",
    "en route to",
    "along the way to",
]);

/// What comes before the order before it.
#[rustfmt::skip]
const AFTER: &Phrases = &Phrases::of(&[
    "after", "but first", "but before that", "but first of all", "but beforehand",
    "but before you do", "but before you do that", "but only after", "right after",
    "straight after", "but start by", "but begin by", "but start off by",
]);

impl Parser<'_> {
    /// What follows an order and says how often, how long or when; `whole` is where the sentence begins, and `group` what
    /// "and" joins.
    pub(super) fn tails(
        &mut self,
        clauses: &mut Vec<Clause>,
        whole: usize,
        group: usize,
    ) -> Result<(), PlanError> {
        loop {
            let start = self.at;
            if self.peeks("first") && matches!(self.rest().get(1), Some(Lexeme { token: Token::Comma, .. })) {
                self.at += 1; // "go there first, but before that ..."
            }
            self.eat_any(&["again and again", "over and over", "over and over again", "repeatedly"]);
            self.skip_fillers();
            self.at += requests::coda(self.rest());
            let comma = matches!(self.rest(), [Lexeme { token: Token::Comma, .. }, ..]);
            let goes_on = comma && (self.tail_follows() || self.another_place_follows());
            if self.done_again(clauses, whole, group)
                || self.done_to_another(clauses, group)
                || self.each_time(clauses)
                || self.one_first(clauses)
                || self.end_first(clauses)
                || self.but_first(clauses, comma)?
            {
            } else if let Some((times, count)) =
                numbers::times(&self.rest()[usize::from(comma)..]).filter(|_| !self.when_it_is())
            {
                self.at += usize::from(comma) + count;
                repeat(clauses, if comma { whole } else { group }, times, comma);
            } else if comma && !goes_on || !self.tail(clauses, comma)? {
                self.at = start;
                return Ok(());
            }
        }
    }

    /// Whether what follows the comma belongs to the order before it.
    fn tail_follows(&self) -> bool {
        #[rustfmt::skip]
        const AFTER_COMMA: &Phrases = &Phrases::of(&[
            "until", "till", "unless", "but if", "but first", "but before that", "but only if", "only if",
            "if and only if", "but not if", "but not before", "or if", "or in case", "provided",
            "provided that", "for", "its for", "it is for", "theyre for", "they are for", "thats for", "that is for", "with", "run", "sprint", "at", "but slowly", "but quickly", "but fast", "and quickly", "and slowly", "but at", "nice and slowly", "but run", "and fast", "but only when", "only when", "forever", "for ever",
            "for ever and ever", "stopping at", "with a stop at", "but before you do", "running", "slowly", "quickly", "fast", "as fast as you can", "at full speed",
            "in a hurry", "but only after", "stopping off at", "stopping by", "but stop off at", "but pass by", "pausing", "waiting", "but only once", "but not until",
            "at the double", "on the double", "and wait", "leaving", "and dont stop until", "and do not stop until",
            "and dont cease until", "and do not cease until", "and dont give up until", "dont stop until",
            "do not stop until", "never stopping until", "not stopping until",
        ]);
        let after = self.rest().get(1..).unwrap_or_default();
        // "..., after you've greeted her" ends the sentence; "..., after that, ..." goes on.
        let end = after.iter().position(|lexeme| matches!(lexeme.token, Token::Comma | Token::Break));
        let last = end.is_none_or(|end| after[end].token == Token::Break);
        let earlier = last
            && longest_phrase(
                after,
                &[
                    "after youve",
                    "after you have",
                    "after having",
                    "before you",
                    "once youve",
                    "once you have",
                ],
            )
            .is_some();
        // "If you see Rex, follow him, but if you don't, go home": what is done otherwise, and no condition of the following.
        let contrary = longest_phrase(after, &["but", "and"]).and_then(|but| {
            let words = longest_phrase(&after[but..], NOT_SO)?;
            after.get(but + words).map(|mark| mark.token == Token::Comma)
        });
        contrary != Some(true)
            && (longest_phrase(after, AFTER_COMMA).is_some() || numbers_for(after) || earlier)
    }

    /// "Close the door when you've bought the bread": what comes first is said behind.
    fn when_done(&mut self, clauses: &mut Vec<Clause>) -> bool {
        let start = self.at;
        let done = self.eat_any(&[
            "when youve",
            "when you have",
            "once youve",
            "once you have",
            "as soon as youve",
            "as soon as you have",
        ]) && self.rest().first().is_some_and(|lexeme| lexeme.lemma.is_some());
        if done
            && let Ok(earlier) = self.order()
            && self.ends_clause()
        {
            let last = clauses.len() - 1;
            clauses.splice(last..last, earlier);
            return true;
        }
        self.at = start;
        false
    }

    /// Whether "near" or the like was said since: whoever walks until he is near something walks straight on.
    fn says_near(&self, from: usize) -> bool {
        let near = |lexeme: &Lexeme| matches!(&lexeme.token, Token::Word(word) if ["near", "close", "nearby"].contains(&word.as_str()));
        self.lexemes[from..self.at].iter().any(near)
    }

    /// ", one after the other": how, where it makes no difference.
    pub(super) fn skip_manner(&mut self) {
        let comma = usize::from(matches!(self.rest(), [Lexeme { token: Token::Comma, .. }, ..]));
        if let Some(count) = longest_phrase(&self.rest()[comma..], MANNERS) {
            self.at += comma + count;
            self.skip_nearest_first();
        }
    }

    /// ", nearest first": the order that is taken anyway.
    fn skip_nearest_first(&mut self) {
        const NEAREST_FIRST: &[&str] = &[
            "nearest first",
            "closest first",
            "the nearest first",
            "the closest first",
            "the nearest one first",
            "the closest one first",
        ];
        let comma = usize::from(matches!(self.rest(), [Lexeme { token: Token::Comma, .. }, ..]));
        self.at += longest_phrase(&self.rest()[comma..], NEAREST_FIRST).map_or(0, |count| comma + count);
    }

    /// "..., but stop at the shop first".
    fn but_first(&mut self, clauses: &mut Vec<Clause>, comma: bool) -> Result<bool, PlanError> {
        let start = self.at;
        self.at += usize::from(comma);
        let is_mark = |lexeme: &Lexeme| matches!(lexeme.token, Token::Comma | Token::Break);
        let end = self.at + self.rest().iter().position(is_mark).unwrap_or(self.rest().len());
        let is_first = |lexeme: &Lexeme| matches!(&lexeme.token, Token::Word(word) if word == "first" || word == "beforehand");
        let said = self.eat_any(&["but"]) && self.lexemes[self.at..end].last().is_some_and(is_first);
        if !said || clauses.is_empty() {
            self.at = start;
            return Ok(false);
        }
        let mut earlier = self.order()?;
        self.for_a_while(&mut earlier);
        if !self.eat_any(&["first", "beforehand"]) {
            self.at = start;
            return Ok(false);
        }
        let at = clauses.len() - 1;
        // "There" is what was spoken of before, and not where one goes first.
        let spoken_of = match &clauses[..] {
            [.., spoken_of @ Clause::Mention { .. }, Clause::Go { to, .. }]
                if matches!(to.target, Target::There | Target::It) =>
            {
                Some(spoken_of.clone())
            }
            _ => None,
        };
        clauses.splice(at..at, earlier.into_iter().chain(spoken_of));
        Ok(true)
    }

    fn tail(&mut self, clauses: &mut Vec<Clause>, comma: bool) -> Result<bool, PlanError> {
        self.at += usize::from(comma);
        if clauses.is_empty() {
            return Ok(false);
        }
        if let Some((seconds, count)) = self.peek_interval() {
            self.at += count;
            let last = clauses.pop().into_iter().collect();
            clauses.push(over_and_over(last, seconds));
            return Ok(true);
        }
        Ok(self.lasts(clauses)?
            || self.when_done(clauses)
            || self.on_condition(clauses)?
            || self.in_turn(clauses)?
            || self.delayed(clauses)
            || self.is_for_somebody(clauses)
            || self.for_a_while(clauses)
            || self.with_pauses(clauses)
            || self.at_a_pace(clauses)?)
    }

    /// "Until it is dark", "while it rains", "for ever".
    fn lasts(&mut self, clauses: &mut Vec<Clause>) -> Result<bool, PlanError> {
        #[rustfmt::skip]
        const FOR_EVER: &Phrases = &Phrases::of(&[
            "forever", "for ever", "for ever and ever", "endlessly", "for good", "indefinitely", "without end",
            "non stop", "nonstop", "forever and ever", "without stopping", "the whole time", "all the time",
            "all day", "all day long", "until i say stop", "until i tell you to stop", "continuously",
            "constantly", "until further notice", "and never stop", "for all eternity", "till i say stop",
            "until i say so", "until i call you", "till i call you", "until i call", "till i call", "until i come", "till i come", "until i come back", "till i come back",
            "until im back", "till im back", "until i get back", "till i get back", "until i return", "till i return",
            "until i tell you otherwise", "till i tell you otherwise", "until i say otherwise", "until you hear from me",
        ]);
        if self.eat_any(FOR_EVER) {
            self.eat_any(&["and never stop", "and dont stop"]);
            if matches!(clauses.last(), Some(Clause::Until { .. })) {
                return Ok(true);
            }
            let body = body_of(clauses.pop());
            clauses.push(Clause::Until { test: Test::Never, body });
            return Ok(true);
        }
        let said = self.at;
        let test = if self.eat_any(UNTIL) {
            let start = self.at;
            match (self.test(), clauses.last()) {
                (Ok(test), _) => test,
                // "Straight on until the fountain".
                (
                    Err(error),
                    Some(
                        Clause::Forward | Clause::Step { .. } | Clause::Until { .. } | Clause::FaceCompass(_),
                    ),
                ) => {
                    self.at = start;
                    let what = self.reference(0).map_err(|_| error)?;
                    Test::Near { what, within: super::tests_of::NEXT_TO_ME }
                }
                (Err(error), _) => return Err(error),
            }
        } else if self.eat_any(WHILE) {
            self.test()?.contrary()
        } else {
            return Ok(false);
        };
        let spoken_of = clauses.last().filter(|_| test.is_about_it()).and_then(Clause::about).cloned();
        if let Some(what) = spoken_of {
            clauses.insert(clauses.len() - 1, Clause::Mention { what });
        }
        if let Some(Clause::Until { test: never @ Test::Never, .. }) = clauses.last_mut() {
            *never = test;
            return Ok(true);
        }
        let body = match (clauses.pop(), &test) {
            // Whoever walks until he is somewhere goes there.
            (Some(Clause::Forward), Test::Near { what, .. }) if !self.says_near(said) => {
                let (to, pace) = (what.clone(), Pace::Usual);
                vec![Clause::Go { to, side: None, pace, within: None }]
            }
            (Some(last @ Clause::Go { .. }), _) => ways_until(clauses, last),
            (last, _) => body_of(last),
        };
        clauses.push(Clause::Until { test, body });
        Ok(true)
    }

    /// "If it rains", "unless it is dark", "when the light is green", "or, if somebody sits there, on the other".
    fn on_condition(&mut self, clauses: &mut Vec<Clause>) -> Result<bool, PlanError> {
        if self.or_if(clauses)? {
            return Ok(true);
        }
        let test = if self.eat_any(UNLESS) {
            self.test()?.contrary()
        } else if self.eat_any(IF) {
            self.test()?
        } else if self.eat_any(&[
            "when",
            "whenever",
            "once",
            "as soon as",
            "the moment",
            "the instant",
            "but only when",
            "only when",
            "but not before",
            "but not until",
            "only once",
            "but only once",
        ]) {
            if let Some(first) = self.deed_done() {
                let later = clauses.pop().into_iter().collect();
                clauses.extend(first_and_later(first, later));
                return Ok(true);
            }
            let test = self.test()?;
            clauses.insert(clauses.len() - 1, Clause::Until { test, body: Vec::new() });
            return Ok(true);
        } else {
            return Ok(false);
        };
        let last = clauses.pop();
        let about_it = last.as_ref().filter(|_| test.is_about_it());
        let spoken_of = about_it.and_then(|last| last.about().or_else(|| last.handled())).cloned();
        let otherwise = self.alternative()?;
        clauses.extend(spoken_of.map(|what| Clause::Mention { what }));
        let then: Vec<Clause> = last.into_iter().collect();
        // "Go to the clinic if it's raining, and to the diner if it isn't".
        if let Some(Clause::If { test: before, otherwise: other, .. }) = clauses.last_mut()
            && otherwise.is_empty()
            && other.is_empty()
            && super::contraries::is_contrary(before, &test)
        {
            *other = then;
            return Ok(true);
        }
        clauses.push(Clause::If { test, then, otherwise });
        Ok(true)
    }

    /// "..., otherwise to the school", behind a condition that follows its order.
    fn alternative(&mut self) -> Result<Vec<Clause>, PlanError> {
        let start = self.at;
        self.skip_joints();
        if self.eat_any(&["otherwise", "else", "or else", "if not", "failing that"]) {
            self.skip_joints();
            return self.orders(Extent::Group);
        }
        self.at = start;
        Ok(Vec::new())
    }

    /// "..., or if somebody is in it, on the one by the table".
    fn or_if(&mut self, clauses: &mut Vec<Clause>) -> Result<bool, PlanError> {
        let start = self.at;
        if !self.eat_any(&["or if", "but if", "or in case", "or when"]) {
            return Ok(false);
        }
        let Some(last) = clauses.last() else { return Ok(false) };
        let spoken_of = last.about().cloned();
        let Ok(test) = self.test() else {
            self.at = start;
            return Ok(false);
        };
        self.skip_joints();
        let mut then = self.orders(Extent::Group)?;
        if let (Some(Clause::Sit { .. }), [Clause::Take { what, to: None, .. }]) = (clauses.last(), &then[..])
        {
            then = vec![Clause::Sit { on: Some(what.clone()) }]; // "..., but if it is taken take the blue one"
        }
        let otherwise = clauses.pop().into_iter().collect();
        clauses.extend(spoken_of.map(|what| Clause::Mention { what }));
        clauses.push(Clause::If { test, then, otherwise });
        Ok(true)
    }

    /// "On the way to the museum", "before going home", "after half a minute", "but first wave".
    fn in_turn(&mut self, clauses: &mut Vec<Clause>) -> Result<bool, PlanError> {
        if self.stopped_over(clauses) || self.by_another_place(clauses)? {
            return Ok(true);
        }
        if self.eat_any(ON_THE_WAY) {
            let to = self.reference(0)?;
            clauses.push(Clause::Go { to, side: None, pace: Pace::Usual, within: None });
        } else if self.eat_any(&["before"]) {
            self.eat_any(&["you"]);
            let start = self.at;
            match self.order() {
                Ok(later) => clauses.extend(later),
                // "... before it closes" says by when, and not what to wait for.
                Err(error) => {
                    self.at = start;
                    let end = self.mark_from(start);
                    if !self.says(start, end) {
                        return Err(error);
                    }
                    self.at = end;
                }
            }
        } else {
            return self.after_that(clauses);
        }
        Ok(true)
    }

    /// "Walk to the bench and pass by the light on the way": the last place comes before the one before it.
    fn stopped_over(&mut self, clauses: &mut [Clause]) -> bool {
        const SO: &Phrases = &Phrases::of(&[
            "on the way",
            "on your way",
            "along the way",
            "en route",
            "on the way there",
            "on your way there",
            "in passing",
            "on route",
        ]);
        let start = self.at;
        let said = self.eat_any(SO) && self.ends_clause();
        let [.., goal @ (Clause::Go { .. } | Clause::Drive { .. }), over] = clauses else {
            self.at = start;
            return false;
        };
        if !said || !matches!(over, Clause::Go { .. } | Clause::Past { .. } | Clause::Buy { .. }) {
            self.at = start;
            return false;
        }
        if let Clause::Past { what, pace } = over {
            *over = Clause::Go { to: what.clone(), side: None, pace: *pace, within: None };
        }
        std::mem::swap(goal, over);
        true
    }

    /// "After half a minute", "but first wave", behind the order that comes later.
    fn after_that(&mut self, clauses: &mut Vec<Clause>) -> Result<bool, PlanError> {
        // "..., and go to the lamp after that".
        let after = longest_phrase(self.rest(), &["after that", "after this"]);
        if let Some(words) = after.filter(|words| self.at + words == self.lexemes.len()) {
            self.at += words;
            return Ok(true);
        }
        let do_so = longest_phrase(self.rest(), &["but before you do", "but before you do that"]).is_some();
        if !self.eat_any(AFTER) {
            return Ok(false);
        }
        self.at += usize::from(do_so && matches!(self.rest(), [Lexeme { token: Token::Comma, .. }, ..]));
        let last = clauses.len() - 1;
        if let Some((seconds, count)) = numbers::duration(self.rest()).filter(|(seconds, _)| *seconds > 0.0) {
            self.at += count;
            clauses.insert(last, Clause::Wait { seconds });
            return Ok(true);
        }
        self.eat_any(&[
            "youve",
            "you have",
            "you had",
            "having",
            "you are done",
            "youre done",
            "you",
            "a visit to",
            "a stop at",
        ]);
        let mut earlier = self.earlier()?;
        self.for_a_while(&mut earlier);
        while self.eat_any(&["and then", "then"]) {
            earlier.extend(self.order()?);
        }
        // "Close the bakery door after you've bought a cake there".
        let there = earlier
            .iter()
            .any(|clause| matches!(clause, Clause::Buy { at: Some(at), .. } if at.target == Target::There));
        let spoken_of = clauses[last].about().filter(|_| there).cloned().map(|what| Clause::Mention { what });
        clauses.splice(last..last, spoken_of.into_iter().chain(earlier));
        Ok(true)
    }
}

/// "For ten seconds", behind a comma.
fn numbers_for(lexemes: &[Lexeme]) -> bool {
    longest_phrase(lexemes, &["for"]).is_some_and(|words| numbers::duration(&lexemes[words..]).is_some())
}

/// "Go to the anchor and then to the lamp until it rains": from one to the other, for whoever has arrived waits for nothing.
fn ways_until(clauses: &mut Vec<Clause>, last: Clause) -> Vec<Clause> {
    let ways = clauses.iter().rev().take_while(|clause| matches!(clause, Clause::Go { .. })).count();
    if ways == 0 {
        return body_of(Some(last));
    }
    let mut body = clauses.split_off(clauses.len() - ways);
    body.push(last);
    body
}
