//! Conditions: "if the light is green", "until you see a bench".

use simworld_core::net::Aspect;
use simworld_core::seam::PlanError;

use super::clause::{Choice, Reference, Target, Test};
use super::lexicon::{longest, longest_phrase};
use super::numbers;
use super::parser::Parser;
use super::phrases::Phrases;
use super::verbs::longest_verb;

/// How near "near you" is, m.
pub(super) const NEAR_ME: f64 = 5.0;
/// How near "next to you" is, m, and how near one comes when one arrives.
pub(super) const NEXT_TO_ME: f64 = 3.0;
/// How near "is there a chair nearby" means, m.
pub(super) const NEARBY: f64 = 30.0;

const ASPECTS: &[(&[&str], Aspect)] = &[
    (&["green", "go", "walk"], Aspect::Green),
    (&["yellow", "amber", "orange"], Aspect::Yellow),
    (&["red"], Aspect::Red),
];
const LIGHTS: &Phrases = &Phrases::of(&[
    "the light",
    "the traffic light",
    "the signal",
    "the lights",
    "the traffic signal",
    "light",
    "it",
    "the pedestrian light",
    "traffic light",
    "the traffic lights",
]);
#[rustfmt::skip]
const BECOMES: &Phrases = &Phrases::of(&[
    "is", "are", "turns", "goes", "changes to", "becomes", "shows", "turns to", "switches to", "gets",
    "has turned", "has gone", "has changed to", "has become", "is on", "jumps to", "has switched to", "stays",
    "to turn", "to change to", "to go", "to become", "to be", "goes to", "gets to", "turns into", "is showing",
    "change to", "turn",
]);

#[rustfmt::skip]
const STATES: &[(&[&str], State)] = &[
    (&["free", "empty", "available", "vacant", "unoccupied", "not taken", "not occupied", "not in use",
    "not busy", "free again", "no longer taken", "no longer occupied", "untaken", "clear"], State::Free),
    (&["taken", "occupied", "in use", "not free", "busy", "full", "not empty", "not available",
    "no longer free", "used"], State::InUse),
    (&["open", "not closed", "opened", "unlocked"], State::Open),
    (&["closed", "shut", "not open"], State::Closed),
    (&["near you", "close to you", "near", "nearby", "with you", "close", "within reach", "close by", "around",
    "about", "anywhere near", "in range", "within range", "at hand", "near us", "close to us"], State::Near),
    (&["next to you", "here", "beside you", "by your side", "there", "at your side", "in front of you",
    "with you"], State::Next),
    (&["findable", "to be found", "visible", "in sight", "in view", "to be seen", "seen", "within sight"], State::Seen),
];
#[rustfmt::skip]
const ARRIVES: &Phrases = &Phrases::of(&[
    "arrives", "comes", "gets here", "comes near", "arrives here", "comes here", "is here", "comes close",
    "reaches you", "has arrived", "comes back", "comes to you", "turns up", "shows up", "comes near you",
    "arrive", "come", "turn up", "show up", "come back", "come near", "returns", "return", "is back",
    "walks up", "comes up to you", "gets to you", "reach you", "comes over", "is back again", "gets back",
    "has come back", "has returned", "has shown up", "has turned up", "approaches", "walks over", "draws near",
    "gets close", "gets near you", "gets close to you", "comes close to you", "walks up to you", "comes by",
    "drops by", "passes by", "comes closer", "gets closer", "comes nearer", "is closer", "is close enough", "has reached you", "has joined you", "has come", "joins you",
]);
const APPEARS: &Phrases = &Phrases::of(&[
    "comes into sight",
    "come into sight",
    "comes in sight",
    "is within sight",
    "comes into view",
    "come into view",
    "appear",
    "can be seen",
    "can be found",
    "can be made out",
    "can be spotted",
    "shows himself",
    "shows herself",
    "comes in sight",
    "comes in view",
    "is in view",
    "appears",
    "comes into sight",
    "becomes visible",
    "is visible",
    "is in sight",
]);
/// Not being near any longer.
#[rustfmt::skip]
const LEAVES: &Phrases = &Phrases::of(&[
    "leaves", "leave", "leaves you", "goes away", "go away", "is gone", "are gone", "walks away", "walks off", "goes off",
    "has left", "has gone", "have left", "have gone", "moves away", "moves off", "moves on", "drives off", "drives away",
    "departs", "is away", "wanders off", "wanders away", "runs off", "runs away", "heads off", "sets off", "has gone away",
    "is out of the way", "clears off", "trots off", "pulls away", "drives on", "has moved on", "is off", "has departed",
]);
const BECOMES_FREE: &[&str] = &["becomes free", "gets free", "becomes available", "frees up"];
const OPENS: &[(&[&str], bool)] = &[(&["opens"], true), (&["closes", "shuts"], false)];

impl Parser<'_> {
    /// A condition.
    pub(super) fn test(&mut self) -> Result<Test, PlanError> {
        let outer = std::mem::replace(&mut self.in_test, true);
        let test = self.tests();
        self.in_test = outer;
        test
    }

    fn tests(&mut self) -> Result<Test, PlanError> {
        self.eat_any(&["by any chance", "by some chance", "for some reason"]);
        self.eat_any(&["either", "both"]);
        let neither = self.eat_any(&["it is neither", "its neither"]);
        let first = if neither { self.weather_again() } else { None };
        let mut test = match first {
            Some(test) => Test::Not(Box::new(test)),
            None => self.simple_test()?,
        };
        loop {
            let start = self.at;
            let nor = self.peeks("nor");
            let (and, or) = (self.peeks("and") || self.peeks("but") || nor, self.peeks("or"));
            if !and && !or {
                return Ok(test);
            }
            self.at += 1;
            self.eat_any(&["if", "when", "while", "that", "also"]);
            let again = self.at;
            let Some(other) = self.weather_again().or_else(|| {
                self.at = again;
                self.simple_test().ok()
            }) else {
                self.at = start;
                return Ok(test);
            };
            let other = if nor { Test::Not(Box::new(other)) } else { other };
            let (one, other) = (Box::new(test), Box::new(other));
            test = if and { Test::Both(one, other) } else { Test::Either(one, other) };
        }
    }

    pub(super) fn simple_test(&mut self) -> Result<Test, PlanError> {
        let start = self.at;
        if let Some(test) = self.same_test() {
            return Ok(test);
        }
        let test = self.new_test(start)?;
        self.tested = Some(test.clone());
        Ok(test)
    }

    /// "Until it is", "unless you don't": what was asked before.
    fn same_test(&mut self) -> Option<Test> {
        let start = self.at;
        let asked = match self.tested.clone()? {
            // "Closed" and "free" are states of their own.
            Test::Not(asked) if !matches!(*asked, Test::Open(_) | Test::InUse(_)) => *asked,
            asked => asked,
        };
        let not = self.eat_any(&[
            "it isnt",
            "it is not",
            "its not",
            "he isnt",
            "she isnt",
            "they arent",
            "you dont",
            "you cant",
            "it doesnt",
            "he doesnt",
            "she doesnt",
            "there isnt",
            "he is not",
            "she is not",
        ]);
        let so = !not
            && self.eat_any(&[
                "it is",
                "its",
                "he is",
                "she is",
                "they are",
                "you do",
                "you can",
                "it does",
                "he does",
                "she does",
                "there is",
                "you see it",
                "you are",
                "it has",
                "he has",
                "she has",
                "you have",
            ]);
        // "Check if it is open, and if so close it".
        let alone = !so && !not && self.eat_any(&["so"]) && longest_verb(self.rest()).is_some();
        if alone || (so || not) && self.ends_at_mark() {
            return Some(if not { Test::Not(Box::new(asked)) } else { asked });
        }
        self.at = start;
        None
    }

    fn new_test(&mut self, start: usize) -> Result<Test, PlanError> {
        for rule in [Self::weather, Self::light, Self::passed] {
            if let Some(test) = rule(self) {
                return Ok(test);
            }
            self.at = start;
        }
        for rule in [Self::sat_on, Self::seen, Self::there_is, Self::mine] {
            if let Some(test) = rule(self)? {
                return Ok(test);
            }
            self.at = start;
        }
        if let Ok(Some(test)) = self.thing_is() {
            return Ok(test);
        }
        self.at = start;
        Err(self.not_understood(
            "a condition is such as \"the light is green\", \"you see a bench\", \"the chair is free\", \"the door is \
             open\", \"it rains\", \"it is dark\" or \"Anna is near you\"",
        ))
    }

    /// "The light to turn green".
    pub(super) fn light_to_turn(&mut self) -> Option<Test> {
        self.eat_any(&["the", "a"]);
        let said = self.eat_any(&["light", "lights", "traffic light", "traffic lights", "signal"])
            && self.eat_any(&[
                "to turn",
                "to change to",
                "to go",
                "to be",
                "to become",
                "to switch to",
                "to show",
                "to turn to",
                "to get",
                "to change into",
            ]);
        let (shows, words) = longest(self.rest(), ASPECTS).filter(|_| said)?;
        self.at += words;
        Some(Test::Light { light: None, shows })
    }

    fn light(&mut self) -> Option<Test> {
        if !self.eat_any(LIGHTS) {
            return None;
        }
        self.adverbs();
        if !self.eat_any(BECOMES) {
            return None;
        }
        self.adverbs();
        let not = self.eat_any(&["not", "no longer", "not yet", "anything but"]);
        self.adverbs();
        let (shows, count) = longest(self.rest(), ASPECTS)?;
        self.at += count;
        self.adverbs();
        self.eat_any(&["again"]);
        let test = Test::Light { light: None, shows };
        Some(if not { Test::Not(Box::new(test)) } else { test })
    }

    /// "Somebody is sitting on the bench", "nobody is in the chair".
    pub(super) fn sat_on(&mut self) -> Result<Option<Test>, PlanError> {
        const SOMEBODY: &Phrases = &Phrases::of(&[
            "somebody",
            "someone",
            "anybody",
            "anyone",
            "a person",
            "some person",
            "another person",
            "anyone at all",
        ]);
        const NOBODY: &[&str] = &["nobody", "no one", "noone", "nobody else", "no person"];
        self.eat_any(&["there is", "theres"]);
        let nobody = self.eat_any(NOBODY);
        if !nobody && !self.eat_any(SOMEBODY) {
            return Ok(None);
        }
        self.eat_any(&["else"]);
        self.adverbs();
        self.eat_any(&["is"]);
        self.adverbs();
        let not = self.eat_any(&["not"]);
        self.eat_any(&["sitting", "seated", "sits", "sat", "already sitting"]);
        let said = self.eat_any(&["on", "in", "using", "uses", "occupying", "has taken", "has"]);
        let taken = if said {
            let seat = self.reference(0)?;
            self.adverbs();
            Test::InUse(seat)
        } else if self.lexemes[self.at - 1].lemma.as_deref() == Some("sit")
            && self.eat_any(&["there", "there already"])
        {
            Test::InUse(Reference::to(Target::It, "it".to_owned()))
        } else {
            return Ok(None);
        };
        Ok(Some(if nobody == not { taken } else { Test::Not(Box::new(taken)) }))
    }

    fn there_is(&mut self) -> Result<Option<Test>, PlanError> {
        const IS: &[&str] = &[
            "there is",
            "theres",
            "there are",
            "you find that there is",
            "there should be",
            "there happens to be",
            "there is still",
        ];
        const NOT: &Phrases = &Phrases::of(&[
            "there is no",
            "theres no",
            "there are no",
            "there isnt",
            "there arent",
            "there is not",
            "there are not",
            "there is not a",
        ]);
        let not = self.eat_any(NOT);
        if !not && !self.eat_any(IS) {
            return Ok(None);
        }
        let mut what = self.reference(0)?;
        what.indefinite = true;
        what.choice = Choice::Open; // "nearby" is what one asks
        self.eat_any(&[
            "anywhere about",
            "anywhere around",
            "anywhere near",
            "anywhere nearby",
            "anywhere near you",
            "anywhere",
            "somewhere",
            "somewhere about",
            "somewhere near",
            "about",
            "in the area",
            "to be seen",
            "in view",
            "nearby",
            "here",
            "around",
            "near you",
            "near here",
            "close by",
            "around here",
            "free",
            "available",
            "left",
            "in sight",
        ]);
        let free = what.traits.free;
        let test = Test::There { what, free };
        Ok(Some(if not { Test::Not(Box::new(test)) } else { test }))
    }

    /// "Ten seconds have passed".
    fn passed(&mut self) -> Option<Test> {
        self.eat_any(&["after"]);
        let (seconds, count) = numbers::duration(self.rest())?;
        self.at += count;
        let passed = self.eat_any(&[
            "have passed",
            "has passed",
            "have elapsed",
            "has elapsed",
            "are up",
            "is up",
            "has gone by",
            "passes",
            "went by",
            "have gone",
            "pass",
            "are over",
            "is over",
            "have gone by",
            "later",
        ]);
        (passed && seconds > 0.0).then_some(Test::Elapsed(seconds))
    }

    /// About a thing: "the chair is free", "Anna arrives".
    fn thing_is(&mut self) -> Result<Option<Test>, PlanError> {
        #[rustfmt::skip]
        const BE: &Phrases = &Phrases::of(&[
            "is", "are", "gets", "stands", "becomes", "be", "should be", "happens to be", "has become",
            "remains", "stays", "sits", "turns out to be", "comes",
        ]);
        let speaker = self.view.speaker.filter(|_| self.eat_any(&["i", "we"]));
        let what = match speaker {
            Some(speaker) => Reference::to(Target::Id(speaker), "me".to_owned()),
            None => self.reference(0)?,
        };
        self.adverbs();
        if let Some(test) = self.reaches_another(&what) {
            return Ok(Some(test));
        }
        if self.eat_any(APPEARS) {
            return Ok(Some(Test::Sees(what)));
        }
        if self.eat_any(ARRIVES) {
            return Ok(Some(Test::Near { what, within: NEXT_TO_ME }));
        }
        if self.eat_any(LEAVES) {
            return Ok(Some(Test::Not(Box::new(Test::Near { what, within: NEAR_ME }))));
        }
        if self.eat_any(BECOMES_FREE) {
            return Ok(Some(Test::Not(Box::new(Test::InUse(what)))));
        }
        if let Some((open, count)) = longest(self.rest(), OPENS) {
            self.at += count;
            let test = Test::Open(what);
            return Ok(Some(if open { test } else { Test::Not(Box::new(test)) }));
        }
        if let Some(test) = self.light_of(&what) {
            return Ok(Some(test));
        }
        if !self.eat_any(BE) {
            return Ok(self.stands_by_another(&what));
        }
        Ok(self.state_of(what))
    }

    /// Behind "the chair is".
    pub(super) fn state_of(&mut self, what: Reference) -> Option<Test> {
        self.adverbs();
        if let Some(test) = self.beside_another(&what) {
            return Some(test);
        }
        // "Is not free" is a state of its own, "is not near you" is not.
        let negated =
            longest(self.rest(), STATES).is_none() && self.eat_any(&["not", "no longer", "not yet"]);
        self.adverbs();
        let not = |test: Test| Test::Not(Box::new(test));
        let (state, count) = longest(self.rest(), STATES)?;
        // "Anna is near ..." is about the two of them, and not about who is told.
        let of_another = matches!(state, State::Near | State::Next)
            && longest_phrase(
                &self.rest()[count..],
                &["the", "a", "an", "my", "his", "her", "that", "this", "it", "him", "them", "to"],
            )
            .is_some();
        if of_another {
            return None;
        }
        self.at += count;
        let test = match state {
            State::Free => not(Test::InUse(what)),
            State::InUse => Test::InUse(what),
            State::Open => Test::Open(what),
            State::Closed => not(Test::Open(what)),
            State::Near => Test::Near { what, within: NEAR_ME },
            State::Next => Test::Near { what, within: NEXT_TO_ME },
            State::Seen => Test::Sees(what),
        };
        self.adverbs();
        Some(if negated { not(test) } else { test })
    }

    /// "The light at the bus stop is green".
    fn light_of(&mut self, what: &Reference) -> Option<Test> {
        let Target::Any(category) = &what.target else { return None };
        if !category.words.contains(&"traffic light") {
            return None;
        }
        let words = longest_phrase(self.rest(), BECOMES)?;
        let (shows, count) = longest(&self.rest()[words..], ASPECTS)?;
        self.at += words + count;
        Some(Test::Light { light: Some(what.clone()), shows })
    }
}

#[derive(Clone, Copy)]
enum State {
    Free,
    InUse,
    Open,
    Closed,
    Near,
    Next,
    Seen,
}
