//! Conditions on how two others stand: "if Anna is near the bin", "when the dog reaches the well", "until Ben leaves the shop".

use simworld_core::scene::Relation;

use super::clause::{Reference, Stands, Test};
use super::lexer::Token;
use super::lexicon::{DETERMINERS, category, longest_phrase};
use super::parser::Parser;
use super::phrases::Phrases;
use super::tests_of::{NEAR_ME, NEXT_TO_ME};

/// How somebody is at a place, before where: it changes nothing.
const POSTURES: &Phrases = &Phrases::of(&[
    "standing",
    "sitting",
    "waiting",
    "parked",
    "lying",
    "still",
    "right",
    "back",
    "over",
    "already",
    "now",
    "walking",
    "seated",
    "just",
    "currently",
    "hanging around",
    "located",
    "somewhere",
    "anywhere",
    "really",
]);
/// At a thing.
#[rustfmt::skip]
const AT: &Phrases = &Phrases::of(&[
    "next to", "beside", "at", "by", "with", "in front of", "outside", "alongside", "opposite", "under", "behind", "in", "inside", "together with",
]);
/// Near it.
#[rustfmt::skip]
const NEAR: &Phrases = &Phrases::of(&["near", "near to", "close to", "not far from", "around", "in the vicinity of", "within reach of", "anywhere near", "close by"]);
/// Coming there.
#[rustfmt::skip]
const REACHES: &Phrases = &Phrases::of(&[
    "reaches", "gets to", "arrives at", "has reached", "comes to", "comes near", "gets near", "gets close to", "comes close to", "walks up to", "joins",
    "meets", "has arrived at", "arrives in", "is back at", "gets back to", "comes back to", "returns to", "has got to", "goes to", "walks to", "runs to",
    "has joined", "has met", "approaches", "shows up at", "turns up at", "enters", "passes", "passes by", "goes past", "stops at", "sits down next to",
]);
/// Going from there.
#[rustfmt::skip]
const LEAVES: &Phrases = &Phrases::of(&[
    "leaves", "has left", "walks away from", "moves away from", "gets away from", "goes away from", "is away from", "is far from", "walks off from",
    "has gone from", "drives away from", "runs away from", "is no longer at", "is no longer near",
]);

impl Parser<'_> {
    /// "Anna reaches the bin", "the dog leaves the well": behind whom.
    pub(super) fn reaches_another(&mut self, one: &Reference) -> Option<Test> {
        let start = self.at;
        let leaves = self.eat_any(LEAVES);
        if (leaves || self.eat_any(REACHES))
            && let Some(other) = self.another_there()
        {
            let within = if leaves { NEAR_ME } else { NEXT_TO_ME };
            let test = Test::Together { one: one.clone(), other: Box::new(other), within };
            return Some(if leaves { Test::Not(Box::new(test)) } else { test });
        }
        self.at = start;
        None
    }

    /// "Near the bin", "not at the bus stop", behind "Anna is".
    pub(super) fn beside_another(&mut self, one: &Reference) -> Option<Test> {
        let start = self.at;
        let not = self.eat_any(&["not", "no longer", "not yet"]);
        while self.eat_any(POSTURES) {}
        let near = self.eat_any(NEAR);
        if (near || self.eat_any(AT))
            && let Some(other) = self.another_there()
        {
            let within = if near { NEAR_ME } else { NEXT_TO_ME };
            let test = Test::Together { one: one.clone(), other: Box::new(other), within };
            return Some(if not { Test::Not(Box::new(test)) } else { test });
        }
        self.at = start;
        None
    }

    /// "The dog stands by the well": where the noun phrase took the place with it.
    pub(super) fn stands_by_another(&self, one: &Reference) -> Option<Test> {
        let Some(Stands::To(relation @ (Relation::NextTo | Relation::Near), other)) = &one.relation else {
            return None;
        };
        let within = if *relation == Relation::Near { NEAR_ME } else { NEXT_TO_ME };
        let alone = Reference { relation: None, ..one.clone() };
        self.ends_clause().then(|| Test::Together { one: alone, other: other.clone(), within })
    }

    /// A thing or somebody that is named, and not who is told.
    fn another_there(&mut self) -> Option<Reference> {
        let names_one = longest_phrase(self.rest(), DETERMINERS).is_some()
            || longest_phrase(self.rest(), &["it", "him", "her", "them", "me", "us"]).is_some()
            || self.is_capital(self.at)
            || matches!(self.rest().first().map(|lexeme| &lexeme.token), Some(Token::Id(_)))
            || category(self.rest()).is_some()
            || self.names.exact(self.rest()).is_some();
        if names_one { self.reference(0).ok() } else { None }
    }
}
