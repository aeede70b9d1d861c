//! Conditions: "if the light is green", "until you see a bench".

use simworld_core::net::Aspect;
use simworld_core::seam::PlanError;

use super::clause::{Choice, Reference, Target, Test};
use super::lexer::{Lexeme, Token};
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
    "has gone",
    "has changed to",
    "has become",
    "is on",
    "jumps to",
    "has switched to",
    "stays",
    "to turn",
    "to change to",
    "to go",
    "to become",
    "to be",
    "goes to",
    "gets to",
    "turns into",
    "is showing",
    "change to",
    "turn",
];

const STATES: &[(&[&str], State)] = &[
    (
        &["free", "empty", "available", "vacant", "unoccupied", "not taken", "not occupied", "not in use", "not busy", "free again", "no longer taken", "no longer occupied", "untaken", "clear"],
        State::Free,
    ),
    (&["taken", "occupied", "in use", "not free", "busy", "full", "not empty", "not available", "no longer free", "used"], State::InUse),
    (&["open", "not closed", "opened", "unlocked"], State::Open),
    (&["closed", "shut", "not open"], State::Closed),
    (
        &["near you", "close to you", "near", "nearby", "with you", "close", "within reach", "close by", "around", "about", "anywhere near"],
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
    (&["visible", "in sight", "in view", "to be seen", "seen", "within sight"], State::Seen),
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
    "is back again",
    "gets back",
    "has come back",
    "has returned",
    "has shown up",
    "has turned up",
    "approaches",
    "walks over",
    "draws near",
    "gets close",
    "gets near you",
    "gets close to you",
    "comes close to you",
    "walks up to you",
    "comes by",
    "drops by",
    "passes by",
    "has reached you",
    "has joined you",
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

    /// "The light to turn green".
    pub(super) fn light_to_turn(&mut self) -> Option<Test> {
        self.eat_any(&["the", "a"]);
        let said = self.eat_any(&["light", "lights", "traffic light", "traffic lights", "signal"])
            && self.eat_any(&["to turn", "to change to", "to go", "to be", "to become", "to switch to", "to show", "to turn to", "to get", "to change into"]);
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

    /// Who is told, or who speaks to him and goes along: "you", "we".
    fn subject(&mut self) -> bool {
        const WITH_HAVE: &[&str] = &["youve", "weve", "ive", "you have", "we have", "i have", "youll have", "you had"];
        if let Some(words) = longest_phrase(self.rest(), WITH_HAVE) {
            // "You have the letter" is about holding it.
            let participle = self.rest().get(words).is_some_and(|lexeme| lexeme.lemma.is_some() || is_participle(lexeme));
            self.at += if participle { words } else { 0 };
            if participle {
                return true;
            }
        }
        let found = self.eat_any(&["you", "we", "i", "youre", "were", "im", "you are", "we are", "i am", "you will", "youll", "one", "you can", "we can", "you should",
            "you happen to", "you could", "you manage to", "you are able to", "your eyes", "you ever", "we should"]);
        self.adverbs();
        found
    }

    fn seen(&mut self) -> Result<Option<Test>, PlanError> {
        const SEE: &[&str] = &[
            "see", "spot", "notice", "find", "catch a glimpse of", "catch sight of", "get to see", "make out", "sight", "seen", "spotted", "encounter", "come across",
            "happen to see", "seeing", "spotting", "noticed", "found", "can see", "can spot", "can make out", "have seen", "have spotted", "are able to see", "glimpse",
            "get a glimpse of", "run into", "bump into", "set eyes on", "lay eyes on", "have in sight", "get sight of", "discover", "sighted", "come upon", "have in view",
        ];
        const BLIND: &[&str] = &[
            "dont see", "cannot see", "cant see", "do not see", "no longer see", "lose sight of", "dont spot", "cant find", "cannot find", "dont find", "cant spot",
            "do not spot", "havent seen", "have not seen", "no longer spot", "are not able to see", "can no longer see", "cant make out", "dont notice",
        ];
        self.subject();
        if self.eat_any(BLIND) {
            self.adverbs();
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
            &["somebody", "someone", "anybody", "anyone", "a person", "some person", "another person", "anyone at all"];
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
            Test::InUse(self.reference(0)?)
        } else if self.lexemes[self.at - 1].lemma.as_deref() == Some("sit") && self.eat_any(&["there", "there already"]) {
            Test::InUse(Reference::to(Target::It, "it".to_owned()))
        } else {
            return Ok(None);
        };
        Ok(Some(if nobody == not { taken } else { Test::Not(Box::new(taken)) }))
    }

    fn there_is(&mut self) -> Result<Option<Test>, PlanError> {
        const IS: &[&str] = &["there is", "theres", "there are", "you find that there is", "there should be", "there happens to be", "there is still"];
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
        const HOLD: &[&str] = &["holding", "hold", "have", "carrying", "carry", "got", "have got", "in possession of", "in hold of", "possess", "have picked up", "have taken"];
        const EMPTY: &[&str] = &[
            "your hands are empty", "your hand is empty", "your hands are free", "your hand is free", "holding nothing", "hold nothing", "have nothing in your hands",
            "carry nothing", "carrying nothing", "have nothing", "have got nothing", "got nothing", "empty handed", "have your hands free", "have a free hand",
            "have both hands free", "dont have anything", "arent holding anything", "are not holding anything", "not holding anything", "not carrying anything",
            "have nothing in your hand", "got nothing in your hands", "have got nothing in your hands",
        ];
        const SIT: &[&str] = &["sitting", "seated", "sit", "sitting down", "in a seat", "are sitting", "are seated"];
        const STAND: &[&str] = &["standing", "stand", "not sitting", "on your feet", "not seated", "standing up", "not sitting down", "up"];
        const REACH: &[&str] = &[
            "near", "next to", "at", "reach", "get to", "arrive at", "close to", "come to", "beside", "by", "reached", "get near", "stand next to", "in front of",
            "reaching", "arrive in", "within reach of", "got to", "arrived at", "come near", "get close to", "come close to", "pass", "come up to", "approach",
            "are near", "are at", "outside", "stand at", "stand by", "stand beside", "arriving at", "getting to", "make it to", "made it to", "are next to",
        ];
        const FAR: &[&str] = &["far from", "away from", "not near", "leave", "not at", "far away from", "not close to", "not next to", "have left"];
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
        let not_holding = self.eat_any(&["dont have", "do not have", "havent got", "have not got", "not holding", "not carrying", "dont hold", "are not holding", "dont carry"]);
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
    fn held(&mut self) -> Result<Test, PlanError> {
        const WITH_YOU: &[&str] = &["in your hand", "in your hands", "with you", "on you", "in hand", "in the hand", "in your arms", "already"];
        if self.eat_any(&["something", "anything"]) {
            self.eat_any(WITH_YOU);
            return Ok(Test::Holds(None));
        }
        let what = self.reference(0)?;
        self.eat_any(WITH_YOU);
        Ok(Test::Holds(Some(what)))
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
        let speaker = self.view.speaker.filter(|_| self.eat_any(&["i", "we"]));
        let what = match speaker {
            Some(speaker) => Reference::to(Target::Id(speaker), "me".to_owned()),
            None => self.reference(0)?,
        };
        self.adverbs();
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
        const BE: &[&str] =
            &["is", "are", "gets", "stands", "becomes", "be", "should be", "happens to be", "has become", "remains", "stays", "sits", "turns out to be", "comes"];
        if !self.eat_any(BE) {
            return Ok(None);
        }
        Ok(self.state_of(what))
    }

    /// Behind "the chair is".
    pub(super) fn state_of(&mut self, what: Reference) -> Option<Test> {
        self.adverbs();
        // "Is not free" is a state of its own, "is not near you" is not.
        let negated =
            longest(self.rest(), STATES).is_none() && self.eat_any(&["not", "no longer", "not yet"]);
        self.adverbs();
        let not = |test: Test| Test::Not(Box::new(test));
        let (state, count) = longest(self.rest(), STATES)?;
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

    /// "Is the door still open?": a question as a condition.
    pub(super) fn asked(&mut self) -> Option<Test> {
        let start = self.at;
        let (verb, words) = longest(self.rest(), &[
            (&["is", "are"][..], true),
            (&["does", "do", "can", "has", "have", "did"], false),
        ])?;
        self.at += words;
        let outer = std::mem::replace(&mut self.in_test, true);
        let test = if verb && self.peeks("it") {
            self.at += 1;
            self.adverbs();
            self.weather_again()
        } else if verb && self.eat_any(&["there"]) {
            self.reference(0).ok().map(|what| Test::There { free: what.traits.free, what: Reference { indefinite: true, choice: Choice::Open, ..what } })
        } else if verb && longest_phrase(self.rest(), &["anybody", "anyone", "somebody", "someone"]).is_some() {
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
    fn asked_state(&mut self, mut what: Reference) -> Option<Test> {
        if let Some((key, set)) = what.traits.state.take() {
            let open = Test::Open(what);
            return (key == simworld_core::scene::OPEN).then(|| if set { open } else { Test::Not(Box::new(open)) });
        }
        if what.traits.free {
            what.traits.free = false;
            return Some(Test::Not(Box::new(Test::InUse(what))));
        }
        self.state_of(what)
    }

    /// A colour at the cursor that says what a thing is like and not what a light shows.
    pub(super) fn peek_paint(&self) -> Option<(super::paint::Paint, usize)> {
        let found = longest(self.rest(), PAINTS)?;
        let is_word = matches!(self.rest().first()?.token, Token::Word(_));
        (is_word && fits(self.rest(), "dark").is_none()).then_some(found)
    }
}

/// Whether a word says what was done: "seen", "reached".
fn is_participle(lexeme: &Lexeme) -> bool {
    matches!(&lexeme.token, Token::Word(word)
        if ["seen", "spotted", "reached", "arrived", "sighted", "noticed", "found", "picked", "made", "left", "sat", "come"].contains(&word.as_str()))
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
