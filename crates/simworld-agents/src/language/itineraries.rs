//! Lists of places: "waypoints: the fountain, the hydrant, the sign", "the library last, the fountain first".

use super::clause::{Clause, Pace, Target};
use super::lexer::Token;
use super::lexicon::longest_phrase;
use super::parser::Parser;
use super::phrases::Phrases;
use super::verbs::longest_verb;

/// What heads a list of places.
#[rustfmt::skip]
const TOURS: &Phrases = &Phrases::of(&[
    "waypoints", "route", "your route", "the route", "stops", "round trip", "tour", "path", "itinerary",
    "your itinerary", "the tour", "rounds", "round", "circuit", "trip", "lap", "course", "destinations",
    "the stops", "places to visit", "stations", "checkpoints",
]);
/// What says when it is the turn of a place, before it.
#[rustfmt::skip]
const IN_TURN: &Phrases = &Phrases::of(&[
    "first", "first to", "then", "then to", "next", "finally", "second", "third", "last", "and then",
    "and finally",
]);
/// The same behind it.
#[rustfmt::skip]
const TURNS_BEHIND: &Phrases = &Phrases::of(&[
    "first", "second", "third", "fourth", "next", "last", "after that", "afterwards", "to begin with",
    "to end with", "first of all", "last of all", "at the end", "in the end", "at the very end", "at the last", "after it", "after them", "after this",
    "to start with", "to finish with", "to finish", "to start", "comes first", "comes next", "comes last", "comes second", "comes third", "come first", "come last", "for last",
    "for the end", "before it", "before that", "second to last",
]);
/// The turn of a place of which no turn is said, between the first ones and the last.
const ANY_TURN: u32 = 1000;

impl Parser<'_> {
    /// "Waypoints: the fountain, the hydrant, the sign", "hydrant first, cone second, crate last": where one goes in turn.
    pub(super) fn itinerary(&mut self) -> Option<Vec<Clause>> {
        self.stops_in_turn().map(|(clauses, _)| clauses)
    }

    /// Such a list where two or more turns are said: "the library last, the fountain first".
    pub(super) fn numbered_itinerary(&mut self) -> Option<Vec<Clause>> {
        const FEWEST: usize = 2;
        self.stops_in_turn().filter(|(_, said)| *said >= FEWEST).map(|(clauses, _)| clauses)
    }

    /// The places of a list in their turn, and of how many the turn is said.
    fn stops_in_turn(&mut self) -> Option<(Vec<Clause>, usize)> {
        const FEWEST: usize = 2;
        let headed = self.eat_any(TOURS) && self.mark() == Some(':');
        self.at += usize::from(headed);
        let mut stops: Vec<(u32, Clause)> = Vec::new();
        let mut turns = 0;
        let mut sorted = headed;
        let mut end = self.at;
        loop {
            let at = end;
            let before = self.turn_of(IN_TURN);
            self.eat_any(&["to", "on to", "over to"]);
            let Some(stop) = self.stop_on_the_way(sorted || before.is_some()) else {
                self.at = at;
                break;
            };
            let behind = self.turn_of(TURNS_BEHIND).map(|turn| match (turn, stops.last()) {
                (0, Some((before, _))) => before - 1,
                (turn, _) => turn,
            });
            sorted |= before.is_some() || behind.is_some();
            turns += usize::from(behind.is_some());
            stops.push((behind.or(before).unwrap_or(ANY_TURN), stop));
            end = self.at;
            let joined = matches!(self.mark(), Some(',' | ';')) || matches!(self.mark(), Some('.')) && sorted;
            self.at += usize::from(joined);
            if !(joined | self.eat_any(&["and", "then", "and then", "to"])) {
                break;
            }
            self.eat_any(&["and", "then"]);
            if self.at >= self.lexemes.len() || longest_verb(self.rest()).is_some() {
                self.at = end;
                break;
            }
        }
        let taken_up = self.rest().iter().any(|lexeme| {
            matches!(&lexeme.token, Token::Word(word) if ["it", "them", "there", "one", "each", "both", "he", "she", "him", "her"].contains(&word.as_str()))
        });
        // "The library last, the fountain first".
        stops.sort_by_key(|(turn, _)| *turn);
        let clauses: Vec<Clause> = stops.into_iter().map(|(_, stop)| stop).collect();
        (clauses.len() >= FEWEST && (headed || !taken_up) && (self.ends_clause() || self.joined_here()))
            .then_some((clauses, turns))
    }

    /// Passes what says when it is the turn of a place: "first" is 1, "last" comes behind all others, and 0 is before the
    /// place that was named before it.
    fn turn_of(&mut self, words: &Phrases) -> Option<u32> {
        let start = self.at;
        if !self.eat_any(words) {
            return None;
        }
        let said = |word: &str| {
            self.lexemes[start..self.at].iter().any(|lexeme| lexeme.token == Token::Word(word.to_owned()))
        };
        Some(if said("before") {
            0
        } else if said("first") || said("begin") {
            1
        } else if said("last") || said("finally") || said("end") {
            u32::MAX
        } else {
            [("second", 2), ("third", 3), ("fourth", 4)]
                .iter()
                .find_map(|(word, turn)| said(word).then_some(*turn))
                .unwrap_or(ANY_TURN)
        })
    }

    fn joined_here(&self) -> bool {
        longest_phrase(self.rest(), &["and", "then", "so"]).is_some()
    }

    /// A place on a list of places; somebody only where it is plain that it is one.
    fn stop_on_the_way(&mut self, sorted: bool) -> Option<Clause> {
        let go = |to| Clause::Go { to, side: None, pace: Pace::Usual, within: None };
        if self.eat_any(&[
            "back here",
            "back to where you are now",
            "back to where you are",
            "back to the start",
            "back again",
            "back",
        ]) && self.ends_clause()
        {
            return Some(go(super::clause::Reference::to(Target::Here, "back".to_owned())));
        }
        if longest_verb(self.rest()).is_some() && super::lexicon::category(self.rest()).is_none()
            || self.goods().is_some()
        {
            return None;
        }
        let to = self.reference(0).ok().filter(|to| !to.text.ends_with("one"))?;
        let named =
            matches!(to.target, Target::Named(_) | Target::Any(_) | Target::Id(_) | Target::Point { .. });
        (named && (sorted || !self.is_somebody(&to))).then(|| go(to))
    }
}
