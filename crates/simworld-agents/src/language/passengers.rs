//! Rides: who is driven and is no part of a scene ("drop my son off at the school"), in what one goes ("to the museum in the red
//! car"), and where one gets off.

use simworld_core::seam::PlanError;

use super::clause::{Clause, Pace, Reference, Target, Vehicle};
use super::lexer::{Lexeme, Token};
use super::lexicon::{class, longest, longest_phrase};
use super::orders::BRINGS;
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

    /// "To the hospital in the red car": a vehicle behind where one goes.
    pub(super) fn in_vehicle(&mut self) -> Option<Clause> {
        let start = self.at;
        let what = if self.eat_any(&["in", "with", "using", "on"]) { self.reference(0).ok() } else { None };
        let what = what.filter(|what| {
            self.view.find(what, super::resolve::Purpose::Any).is_ok_and(|found| found.kind.is_vehicle())
        });
        if what.is_none() {
            self.at = start;
        }
        what.map(|what| Clause::Board { what, to: None })
    }

    /// "Get off at the museum": one rides there first.
    pub(super) fn alight_at(&mut self) -> Vec<Clause> {
        let off = self.alight();
        let start = self.at;
        let to = if self.eat_any(&[
            "at",
            "in front of",
            "outside",
            "by",
            "near",
            "next to",
            "when you get to",
            "when you reach",
            "when you are at",
        ]) {
            self.reference(0).ok()
        } else {
            None
        };
        let Some(to) = to else {
            self.at = start;
            return vec![off];
        };
        vec![Clause::Go { to, side: None, pace: Pace::Usual, within: None }, off]
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
        let aboard = !named && self.beside.rides && self.eat_any(THEM);
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
        self.beside.rides = true;
        let ends = self.rest().first().is_none_or(|next: &Lexeme| !matches!(next.token, Token::Number(_)));
        ends.then(|| vec![Clause::Go { to, side: None, pace: Pace::Usual, within: None }])
    }

    pub(super) fn board(&mut self) -> Result<Vec<Clause>, PlanError> {
        let what = if self.ends_clause() {
            Reference::to(Target::It, "it".to_owned())
        } else if self.eat_any(&["to", "over to", "across to", "up to", "down to", "back to", "along to"]) {
            // "Ride to the school": on what one is on.
            let to = self.reference(0)?;
            return Ok(vec![match self.mount()? {
                Some(what) => Clause::Board { what, to: Some(to) },
                None => Clause::Go { to, side: None, pace: Pace::Usual, within: None },
            }]);
        } else {
            self.reference(0)?
        };
        self.eat_any(&["over", "up", "down", "across", "back"]);
        Ok(vec![Clause::Board { what, to: self.tail_place(BRINGS)? }])
    }

    /// "Ride to Emil on the scooter": what one is to ride there.
    pub(super) fn mount(&mut self) -> Result<Option<Reference>, PlanError> {
        let said = self.eat_any(&["on", "in", "with", "using", "aboard"]);
        if said { self.reference(0).map(Some) } else { Ok(None) }
    }

    fn alight(&mut self) -> Clause {
        self.eat_any(&["the", "of the", "of"]);
        self.eat_any(&["white", "black", "red", "blue", "green", "yellow", "orange"]);
        let cars = [
            "bicycle",
            "bike",
            "motorcycle",
            "car",
            "bus",
            "truck",
            "taxi",
            "van",
            "vehicle",
            "cab",
            "lorry",
        ];
        let from = if self.peeks("scooter") {
            Vehicle::Scooter
        } else if longest_phrase(self.rest(), &cars).is_some() {
            Vehicle::Car
        } else {
            Vehicle::Any
        };
        self.at += usize::from(from != Vehicle::Any);
        self.eat_any(&["it", "again"]);
        Clause::Alight { from }
    }

    /// "By car", "on foot".
    pub(super) fn by_vehicle(&mut self) -> Option<Clause> {
        const VEHICLES: &[(&[&str], &str)] = &[
            (&["by car", "by taxi", "by cab"], "car"),
            (&["by bus"], "bus"),
            (&["by scooter"], "scooter"),
            (&["by bike", "by bicycle"], "bicycle"),
        ];
        let (word, count) = longest(self.rest(), VEHICLES)?;
        self.at += count;
        Some(Clause::Board {
            what: Reference { indefinite: true, ..Reference::nearest(class(word)) },
            to: None,
        })
    }
}
