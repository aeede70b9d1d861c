//! Conditions about whoever is told: what he sees, holds and is near, and questions as conditions.

use super::clause::{Choice, Reference, Test};
use super::lexer::{Lexeme, Token};
use super::lexicon::{longest, longest_phrase};
use super::parser::Parser;
use super::phrases::Phrases;
use super::tests_of::{NEARBY, NEXT_TO_ME};
use simworld_core::seam::PlanError;

/// Having something in hand.
#[rustfmt::skip]
const HOLD: &Phrases = &Phrases::of(&[
    "holding", "hold", "have", "carrying", "carry", "got", "have got", "in possession of", "in hold of",
    "possess", "have picked up", "have taken",
]);
/// Having nothing in hand.
#[rustfmt::skip]
const EMPTY: &Phrases = &Phrases::of(&[
    "your hands are empty", "your hand is empty", "your hands are free", "your hand is free",
    "holding nothing", "hold nothing", "have nothing in your hands", "carry nothing",
    "carrying nothing", "have nothing", "have got nothing", "got nothing", "empty handed",
    "have your hands free", "have a free hand", "have both hands free", "dont have anything",
    "arent holding anything", "are not holding anything", "not holding anything",
    "not carrying anything", "have nothing in your hand", "got nothing in your hands",
    "have got nothing in your hands",
]);
/// Sitting.
const SIT: &[&str] = &["sitting", "seated", "sit", "sitting down", "in a seat", "are sitting", "are seated"];
/// Not sitting.
const STAND: &Phrases = &Phrases::of(&[
    "standing",
    "stand",
    "not sitting",
    "on your feet",
    "not seated",
    "standing up",
    "not sitting down",
    "up",
]);
/// Being near something.
#[rustfmt::skip]
const REACH: &Phrases = &Phrases::of(&[
    "near", "next to", "at", "reach", "get to", "arrive at", "close to", "come to", "beside", "by",
    "reached", "get near", "stand next to", "in front of", "reaching", "arrive in", "within reach of",
    "got to", "arrived at", "come near", "get close to", "come close to", "pass", "come up to",
    "approach", "are near", "are at", "outside", "stand at", "stand by", "stand beside", "arriving at",
    "getting to", "make it to", "made it to", "are next to",
]);
/// Being far from it.
const FAR: &Phrases = &Phrases::of(&[
    "far from",
    "away from",
    "not near",
    "leave",
    "not at",
    "far away from",
    "not close to",
    "not next to",
    "have left",
]);

impl Parser<'_> {
    /// Who is told, or who speaks to him and goes along: "you", "we".
    pub(super) fn subject(&mut self) -> bool {
        const WITH_HAVE: &Phrases =
            &Phrases::of(&["youve", "weve", "ive", "you have", "we have", "i have", "youll have", "you had"]);
        if let Some(words) = longest_phrase(self.rest(), WITH_HAVE) {
            // "You have the letter" is about holding it.
            let participle =
                self.rest().get(words).is_some_and(|lexeme| lexeme.lemma.is_some() || is_participle(lexeme));
            self.at += if participle { words } else { 0 };
            if participle {
                return true;
            }
        }
        let found = self.eat_any(&[
            "you",
            "we",
            "i",
            "youre",
            "were",
            "im",
            "you are",
            "we are",
            "i am",
            "you will",
            "youll",
            "one",
            "you can",
            "we can",
            "you should",
            "you happen to",
            "you could",
            "you manage to",
            "you are able to",
            "your eyes",
            "you ever",
            "we should",
        ]);
        self.adverbs();
        found
    }

    pub(super) fn seen(&mut self) -> Result<Option<Test>, PlanError> {
        #[rustfmt::skip]
        const SEE: &Phrases = &Phrases::of(&[
            "see", "spot", "notice", "find", "catch a glimpse of", "catch sight of", "get to see", "make out",
            "sight", "seen", "spotted", "encounter", "come across", "happen to see", "seeing", "spotting",
            "noticed", "found", "can see", "can spot", "can make out", "have seen", "have spotted",
            "are able to see", "glimpse", "get a glimpse of", "run into", "bump into", "set eyes on",
            "lay eyes on", "have in sight", "get sight of", "discover", "sighted", "come upon", "have in view",
        ]);
        #[rustfmt::skip]
        const BLIND: &Phrases = &Phrases::of(&[
            "dont see", "cannot see", "cant see", "do not see", "no longer see", "lose sight of", "dont spot",
            "cant find", "cannot find", "dont find", "cant spot", "do not spot", "havent seen", "have not seen",
            "no longer spot", "are not able to see", "can no longer see", "cant make out", "dont notice",
        ]);
        self.subject();
        if self.eat_any(BLIND) {
            self.adverbs();
            let what = self.reference(0)?;
            let seen = if what.traits.free { Test::There { what, free: true } } else { Test::Sees(what) };
            return Ok(Some(Test::Not(Box::new(seen))));
        }
        if !self.eat_any(SEE) {
            return Ok(None);
        }
        self.reference(0).map(|what| {
            // Whether a seat is free is asked of those near.
            Some(if what.traits.free { Test::There { what, free: true } } else { Test::Sees(what) })
        })
    }

    /// About the agent itself.
    pub(super) fn mine(&mut self) -> Result<Option<Test>, PlanError> {
        let start = self.at;
        if self.eat_any(EMPTY) {
            return Ok(Some(Test::Not(Box::new(Test::Holds(None)))));
        }
        let subject = self.subject();
        if !subject && longest_phrase(self.rest(), &["reaching", "arriving at", "getting to"]).is_none() {
            self.at = start;
            return Ok(None);
        }
        if self.eat_any(EMPTY) {
            return Ok(Some(Test::Not(Box::new(Test::Holds(None)))));
        }
        let not_holding = self.eat_any(&[
            "dont have",
            "do not have",
            "havent got",
            "have not got",
            "not holding",
            "not carrying",
            "dont hold",
            "are not holding",
            "dont carry",
        ]);
        if not_holding || self.eat_any(HOLD) {
            let holds = self.held()?;
            return Ok(Some(if not_holding { Test::Not(Box::new(holds)) } else { holds }));
        }
        if self.eat_any(STAND) {
            return Ok(Some(Test::Not(Box::new(Test::Seated))));
        }
        if self.eat_any(SIT) {
            self.eat_any(&["down"]);
            return Ok(Some(Test::Seated));
        }
        if self.eat_any(FAR) {
            let what = self.reference(0)?;
            return Ok(Some(Test::Not(Box::new(Test::Near { what, within: NEARBY }))));
        }
        if self.eat_any(REACH) {
            return Ok(Some(Test::Near { what: self.reference(0)?, within: NEXT_TO_ME }));
        }
        Ok(None)
    }

    /// What is in hand: "something", "the letter with you".
    pub(super) fn held(&mut self) -> Result<Test, PlanError> {
        const WITH_YOU: &Phrases = &Phrases::of(&[
            "in your hand",
            "in your hands",
            "with you",
            "on you",
            "in hand",
            "in the hand",
            "in your arms",
            "already",
        ]);
        if self.eat_any(&["something", "anything"]) {
            self.eat_any(WITH_YOU);
            return Ok(Test::Holds(None));
        }
        let what = self.reference(0)?;
        self.eat_any(WITH_YOU);
        Ok(Test::Holds(Some(what)))
    }

    /// "Is the door still open?": a question as a condition.
    pub(super) fn asked(&mut self) -> Option<Test> {
        let start = self.at;
        let (verb, words) = longest(
            self.rest(),
            &[(&["is", "are"][..], true), (&["does", "do", "can", "has", "have", "did"], false)],
        )?;
        self.at += words;
        let outer = std::mem::replace(&mut self.in_test, true);
        let test = if verb && self.peeks("it") {
            self.at += 1;
            self.adverbs();
            self.weather_again()
        } else if verb && self.eat_any(&["there"]) {
            self.reference(0).ok().map(|what| Test::There {
                free: what.traits.free,
                what: Reference { indefinite: true, choice: Choice::Open, ..what },
            })
        } else if verb && longest_phrase(self.rest(), &["anybody", "anyone", "somebody", "someone"]).is_some()
        {
            self.sat_on().ok().flatten()
        } else if verb {
            // In "is the door open" the door is all that the noun phrase takes.
            let what = self.reference(0).ok();
            what.and_then(|what| self.asked_state(what))
        } else {
            self.simple_test().ok()
        };
        self.in_test = outer;
        self.eat_any(&["nearby", "near here", "around", "here"]);
        let asked = test.filter(|_| self.mark() == Some('?'));
        if asked.is_none() {
            self.at = start;
        }
        asked
    }

    /// The state of a thing, also where the noun phrase took it for what the thing is like.
    pub(super) fn asked_state(&mut self, mut what: Reference) -> Option<Test> {
        if let Some((key, set)) = what.traits.state.take() {
            let open = Test::Open(what);
            return (key == simworld_core::scene::OPEN)
                .then(|| if set { open } else { Test::Not(Box::new(open)) });
        }
        if what.traits.free {
            what.traits.free = false;
            return Some(Test::Not(Box::new(Test::InUse(what))));
        }
        self.state_of(what)
    }
}

/// Whether a word says what was done: "seen", "reached".
fn is_participle(lexeme: &Lexeme) -> bool {
    matches!(&lexeme.token, Token::Word(word)
        if ["seen", "spotted", "reached", "arrived", "sighted", "noticed", "found", "picked", "made", "left", "sat", "come"].contains(&word.as_str()))
}
