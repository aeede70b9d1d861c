//! Who is driven and is no part of a scene: "drop my son off at the school", "pick up my wife at the museum".

use super::clause::{Clause, Pace};
use super::lexer::{Lexeme, Token};
use super::lexicon::longest_phrase;
use super::parser::Parser;
use super::phrases::Phrases;
use super::verbs::Verb;

const WHOSE: &Phrases = &Phrases::of(&[
    "my",
    "our",
    "the",
    "his",
    "her",
    "your",
    "their",
    "these",
    "those",
    "both",
    "all the",
    "my two",
    "our two",
    "my little",
    "my old",
    "both my",
    "both of my",
]);
/// Those whom a driver drives without their being anywhere.
#[rustfmt::skip]
const RIDERS: &Phrases = &Phrases::of(&[
    "son", "sons", "daughter", "daughters", "wife", "husband", "mother", "father", "mum", "mom", "dad", "mummy", "daddy", "parents", "sister", "sisters",
    "brother", "brothers", "aunt", "uncle", "cousin", "cousins", "niece", "nephew", "grandma", "grandpa", "grandmother", "grandfather", "granny", "gran",
    "grandparents", "grandson", "granddaughter", "kids", "children", "little ones", "twins", "baby", "family", "friend", "friends", "girlfriend",
    "boyfriend", "partner", "fiancé", "boss", "colleague", "colleagues", "guest", "guests", "passenger", "passengers", "customer", "customers", "client",
    "clients", "fare", "flatmate", "roommate", "neighbour", "neighbor", "teacher", "patient", "visitor", "visitors", "in laws", "mother in law",
]);
const THEM: &[&str] =
    &["him", "her", "them", "us", "everyone", "everybody", "all of them", "all of us", "both of them"];

impl Parser<'_> {
    /// Whether a remark is about somebody who is not here, and nobody who is: "my grandmother loves sunflowers".
    pub(super) fn speaks_of_absent(&self, from: usize, end: usize, named: &[Clause]) -> bool {
        let somebody = |clause: &Clause| matches!(clause, Clause::Mention { what } if self.is_somebody(what));
        !named.iter().any(somebody)
            && (from..end).any(|at| {
                longest_phrase(&self.lexemes[at..], &["my", "our", "his", "her"]).is_some()
                    && longest_phrase(&self.lexemes[at + 1..], RIDERS).is_some()
            })
    }

    /// Where a vehicle goes to let somebody in or out; of who is in the scene nothing is said here.
    pub(super) fn passenger(&mut self, verb: Verb) -> Option<Vec<Clause>> {
        let drives = || self.view.scene.entity(self.view.who).is_some_and(|me| me.kind.is_vehicle());
        if !matches!(verb, Verb::Drop | Verb::Take | Verb::Deliver | Verb::PutDown | Verb::Drive | Verb::Give)
            || !drives()
        {
            return None;
        }
        let start = self.at;
        let named = self.eat_any(WHOSE) && self.eat_any(RIDERS);
        let aboard = !named && self.rides && self.eat_any(THEM);
        self.eat_any(&["and me", "and myself", "and their friends", "and his friend", "and her friend"]);
        while self.eat_any(&["off", "out", "down", "over", "up", "back", "home", "on time", "safely"]) {}
        let placed = (named || aboard)
            && self.eat_any(&[
                "at",
                "to",
                "from",
                "by",
                "in front of",
                "outside",
                "near",
                "next to",
                "over to",
                "over at",
                "into",
                "in",
                "on",
                "off at",
                "opposite",
            ]);
        let there = (named || aboard) && longest_phrase(self.rest(), &["there", "here"]).is_some();
        let to = if placed || there { self.reference(0).ok() } else { None };
        let Some(to) = to else {
            self.at = start;
            return None;
        };
        self.rides = true;
        let ends = self.rest().first().is_none_or(|next: &Lexeme| !matches!(next.token, Token::Number(_)));
        ends.then(|| vec![Clause::Go { to, side: None, pace: Pace::Usual, within: None }])
    }
}
