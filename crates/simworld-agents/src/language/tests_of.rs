//! Conditions: "if the light is green", "until you see a bench".

use simworld_core::net::Aspect;
use simworld_core::seam::PlanError;

use super::clause::{Choice, Reference, Target, Test};
use super::lexer::Token;
use super::lexicon::{fits, longest, longest_phrase};
use super::numbers;
use super::paint::PAINTS;
use super::parser::Parser;

/// How near "near you" is, m.
const NEAR_ME: f64 = 5.0;
/// How near "next to you" is, m, and how near one comes when one arrives.
pub(super) const NEXT_TO_ME: f64 = 3.0;
/// How near "is there a chair nearby" means, m.
pub(super) const NEARBY: f64 = 30.0;

const ASPECTS: &[(&[&str], Aspect)] = &[
    (&["green", "go", "walk"], Aspect::Green),
    (&["yellow", "amber", "orange"], Aspect::Yellow),
    (&["red"], Aspect::Red),
];
const LIGHTS: &[&str] = &[
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
];
const BECOMES: &[&str] = &[
    "is",
    "are",
    "turns",
    "goes",
    "changes to",
    "becomes",
    "shows",
    "turns to",
    "switches to",
    "gets",
    "has turned",
    "is showing",
    "change to",
    "turn",
];

const STATES: &[(&[&str], State)] = &[
    (
        &["free", "empty", "available", "vacant", "unoccupied", "not taken", "not occupied", "not in use"],
        State::Free,
    ),
    (&["taken", "occupied", "in use", "not free", "busy", "full"], State::InUse),
    (&["open", "not closed", "opened", "unlocked"], State::Open),
    (&["closed", "shut", "not open"], State::Closed),
    (
        &["near you", "close to you", "near", "nearby", "with you", "close", "within reach", "close by"],
        State::Near,
    ),
    (
        &[
            "next to you",
            "here",
            "beside you",
            "by your side",
            "there",
            "at your side",
            "in front of you",
            "with you",
        ],
        State::Next,
    ),
    (&["visible", "in sight", "in view"], State::Seen),
];
const ARRIVES: &[&str] = &[
    "arrives",
    "comes",
    "gets here",
    "comes near",
    "arrives here",
    "comes here",
    "is here",
    "comes close",
    "reaches you",
    "has arrived",
    "comes back",
    "comes to you",
    "turns up",
    "shows up",
    "comes near you",
    "arrive",
    "come",
    "turn up",
    "show up",
    "come back",
    "come near",
    "returns",
    "return",
    "is back",
    "walks up",
    "comes up to you",
    "gets to you",
    "reach you",
    "comes over",
    "has come",
    "joins you",
];
const APPEARS: &[&str] = &[
    "comes into view",
    "come into view",
    "appear",
    "can be seen",
    "is in view",
    "appears",
    "comes into sight",
    "becomes visible",
    "is visible",
    "is in sight",
];
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
        let mut test = self.simple_test()?;
        loop {
            let start = self.at;
            let (and, or) = (self.peeks("and"), self.peeks("or"));
            if !and && !or {
                return Ok(test);
            }
            self.at += 1;
            let Ok(other) = self.simple_test() else {
                self.at = start;
                return Ok(test);
            };
            let (one, other) = (Box::new(test), Box::new(other));
            test = if and { Test::Both(one, other) } else { Test::Either(one, other) };
        }
    }

    fn simple_test(&mut self) -> Result<Test, PlanError> {
        let start = self.at;
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

    fn light(&mut self) -> Option<Test> {
        if !self.eat_any(LIGHTS) {
            return None;
        }
        if !self.eat_any(BECOMES) {
            return None;
        }
        let not = self.eat_any(&["not", "no longer", "not yet"]);
        let (shows, count) = longest(self.rest(), ASPECTS)?;
        self.at += count;
        let test = Test::Light { light: None, shows };
        Some(if not { Test::Not(Box::new(test)) } else { test })
    }

    fn seen(&mut self) -> Result<Option<Test>, PlanError> {
        const SEE: &[&str] = &[
            "you see",
            "you have spotted",
            "youve seen",
            "youve spotted",
            "you catch a glimpse of",
            "you get to see",
            "you should see",
            "you happen to see",
            "you make out",
            "you can make out",
            "you can spot",
            "you sight",
            "you can see",
            "you spot",
            "you notice",
            "you find",
            "you catch sight of",
            "see",
            "seeing",
            "you have seen",
            "you are able to see",
            "you encounter",
            "you come across",
        ];
        const BLIND: &[&str] = &[
            "you dont see",
            "you cannot see",
            "you cant see",
            "you do not see",
            "you no longer see",
            "you lose sight of",
        ];
        if self.eat_any(BLIND) {
            return Ok(Some(Test::Not(Box::new(Test::Sees(self.reference(0)?)))));
        }
        if !self.eat_any(SEE) {
            return Ok(None);
        }
        self.reference(0).map(|what| Some(Test::Sees(what)))
    }

    /// "Somebody is sitting on the bench", "nobody is in the chair".
    fn sat_on(&mut self) -> Result<Option<Test>, PlanError> {
        const SOMEBODY: &[&str] =
            &["somebody", "someone", "anybody", "anyone", "a person", "some person", "another person"];
        const NOBODY: &[&str] = &["nobody", "no one", "noone", "nobody else", "no person"];
        self.eat_any(&["there is", "theres"]);
        let nobody = self.eat_any(NOBODY);
        if !nobody && !self.eat_any(SOMEBODY) {
            return Ok(None);
        }
        self.eat_any(&["else"]);
        self.eat_any(&["is", "is already"]);
        let not = self.eat_any(&["not"]);
        self.eat_any(&["sitting", "seated", "sits", "sat", "already sitting"]);
        if !self.eat_any(&["on", "in", "using"]) {
            return Ok(None);
        }
        let taken = Test::InUse(self.reference(0)?);
        Ok(Some(if nobody == not { taken } else { Test::Not(Box::new(taken)) }))
    }

    fn there_is(&mut self) -> Result<Option<Test>, PlanError> {
        const IS: &[&str] = &["there is", "theres", "there are", "you find that there is"];
        const NOT: &[&str] = &[
            "there is no",
            "theres no",
            "there are no",
            "there isnt",
            "there arent",
            "there is not",
            "there are not",
            "there is not a",
        ];
        let not = self.eat_any(NOT);
        if !not && !self.eat_any(IS) {
            return Ok(None);
        }
        let mut what = self.reference(0)?;
        what.indefinite = true;
        what.choice = Choice::Open; // "nearby" is what one asks
        self.eat_any(&[
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

    /// About the agent itself.
    fn mine(&mut self) -> Result<Option<Test>, PlanError> {
        const HOLD: &[&str] = &[
            "you are holding",
            "you hold",
            "you have",
            "you are carrying",
            "you carry",
            "youre holding",
            "youve got",
        ];
        const EMPTY: &[&str] = &[
            "your hands are empty",
            "you are holding nothing",
            "your hand is empty",
            "you hold nothing",
            "your hands are free",
            "you have nothing in your hands",
            "you carry nothing",
        ];
        const SIT: &[&str] =
            &["you are sitting", "you are seated", "you sit", "youre sitting", "youre seated"];
        const STAND: &[&str] = &["you are standing", "you stand", "youre standing", "you are not sitting"];
        const REACH: &[&str] = &[
            "you are near",
            "you are next to",
            "you are at",
            "you reach",
            "you get to",
            "you arrive at",
            "you are close to",
            "you come to",
            "youre near",
            "youre at",
            "you are beside",
            "you are by",
            "you have reached",
            "you get near",
            "you stand next to",
            "you are in front of",
            "youre next to",
            "reaching",
            "you arrive in",
            "you are within reach of",
        ];
        const FAR: &[&str] = &["you are far from", "you are away from", "you are not near", "you leave"];
        if self.eat_any(EMPTY) {
            return Ok(Some(Test::Not(Box::new(Test::Holds(None)))));
        }
        if self.eat_any(SIT) {
            return Ok(Some(Test::Seated));
        }
        if self.eat_any(STAND) {
            return Ok(Some(Test::Not(Box::new(Test::Seated))));
        }
        if self.eat_any(FAR) {
            let what = self.reference(0)?;
            return Ok(Some(Test::Not(Box::new(Test::Near { what, within: NEARBY }))));
        }
        if self.eat_any(REACH) {
            return Ok(Some(Test::Near { what: self.reference(0)?, within: NEXT_TO_ME }));
        }
        if self.eat_any(HOLD) {
            if self.eat_any(&["something", "anything"]) {
                return Ok(Some(Test::Holds(None)));
            }
            return Ok(Some(Test::Holds(Some(self.reference(0)?))));
        }
        Ok(None)
    }

    /// "Ten seconds have passed".
    fn passed(&mut self) -> Option<Test> {
        self.eat_any(&["after"]);
        let (seconds, count) = numbers::duration(self.rest())?;
        self.at += count;
        let passed = self.eat_any(&[
            "have passed",
            "has passed",
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
        let what = self.reference(0)?;
        if self.eat_any(ARRIVES) {
            return Ok(Some(Test::Near { what, within: NEXT_TO_ME }));
        }
        if self.eat_any(APPEARS) {
            return Ok(Some(Test::Sees(what)));
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
        if !self.eat_any(&[
            "is",
            "are",
            "gets",
            "stands",
            "becomes",
            "be",
            "should be",
            "happens to be",
            "has become",
        ]) {
            return Ok(None);
        }
        // "Is not free" is a state of its own, "is not near you" is not.
        let negated =
            longest(self.rest(), STATES).is_none() && self.eat_any(&["not", "no longer", "not yet"]);
        let Some((state, count)) = longest(self.rest(), STATES) else { return Ok(None) };
        self.at += count;
        let not = |test: Test| Test::Not(Box::new(test));
        let test = match state {
            State::Free => not(Test::InUse(what)),
            State::InUse => Test::InUse(what),
            State::Open => Test::Open(what),
            State::Closed => not(Test::Open(what)),
            State::Near => Test::Near { what, within: NEAR_ME },
            State::Next => Test::Near { what, within: NEXT_TO_ME },
            State::Seen => Test::Sees(what),
        };
        Ok(Some(if negated { not(test) } else { test }))
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

    /// A colour at the cursor that says what a thing is like and not what a light shows.
    pub(super) fn peek_paint(&self) -> Option<(super::paint::Paint, usize)> {
        let found = longest(self.rest(), PAINTS)?;
        let is_word = matches!(self.rest().first()?.token, Token::Word(_));
        (is_word && fits(self.rest(), "dark").is_none()).then_some(found)
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
