//! Conditions of the weather and the light: "if it rains", "until it has got dark", "in case of rain", "after sunset".

use super::clause::Test;
use super::lexer::Token;
use super::lexicon::{longest, longest_phrase};
use super::parser::Parser;
use super::phrases::Phrases;

/// What the sky does.
#[derive(Clone, Copy)]
enum Sky {
    Rain,
    Snow,
    Dark,
    Light,
    Dry,
}

/// As what "it is" has behind it.
#[rustfmt::skip]
const STATES: &[(&[&str], Sky)] = &[
    (&["raining", "rainy", "wet", "starts to rain", "starts raining", "begins to rain", "begins raining", "rains", "pouring", "pouring down", "drizzling", "raining outside", "bucketing down"],
    Sky::Rain),
    (&["snowing", "snowy", "snowing outside"], Sky::Snow),
    (&["dark", "gets dark", "becomes dark", "night", "nighttime", "night time", "dark outside", "after dark", "after sunset", "pitch dark",
    "dusk"], Sky::Dark),
    (&["light", "day", "daytime", "bright", "daylight", "morning", "light outside", "day time"], Sky::Light),
    (&["dry"], Sky::Dry),
];
/// As verbs, and behind "starts to" and "stops".
const VERBS: &[(&[&str], Sky)] = &[
    (
        &[
            "rains", "rain", "raining", "to rain", "pours", "rained", "pouring", "to pour", "drizzles",
            "the rain",
        ],
        Sky::Rain,
    ),
    (&["snows", "snow", "snowing", "to snow", "snowed"], Sky::Snow),
];
/// As nouns, of which something is said.
const NOUNS: &[(&[&str], Sky)] = &[
    (&["the rain", "rain", "the downpour", "the shower", "the drizzle"], Sky::Rain),
    (&["the snow", "snow", "the snowfall"], Sky::Snow),
];
#[rustfmt::skip]
const BE: &Phrases = &Phrases::of(&[
    "is", "be", "gets", "get", "becomes", "become", "has got", "has become", "has gotten", "turns", "grows",
    "is getting", "should be", "has turned", "was", "gets to be", "goes",
]);
#[rustfmt::skip]
const BEGINS: &Phrases = &Phrases::of(&[
    "starts", "begins", "start", "begin", "has started", "has begun", "comes", "should start", "started",
    "is here", "sets in", "comes on",
]);
#[rustfmt::skip]
const ENDS: &Phrases = &Phrases::of(&[
    "stops", "has stopped", "stop", "is over", "ends", "lets up", "has let up", "has ended", "eases",
    "eases off", "passes", "has passed", "is gone", "has gone", "dies down", "stopped", "ceases", "has ceased",
    "clears", "clears up", "has eased", "has cleared", "has finished", "finishes", "quits",
]);
/// Whole sayings of the day.
#[rustfmt::skip]
const SAYINGS: &[(&[&str], Sky)] = &[
    (&["night falls", "night has fallen", "darkness falls", "darkness has fallen", "the sun sets",
    "the sun has set", "the sun goes down", "the sun has gone down", "the sun is down", "the sun is gone",
    "nightfall", "sunset", "dusk", "dark", "the evening", "evening comes", "the day is over", "it gets late",
    "the lights go out", "night comes", "the sun is setting"], Sky::Dark),
    (&["the sun rises", "the sun has risen", "the sun comes up", "the sun is up", "the sun has come up",
    "day breaks", "sunrise", "dawn", "daybreak", "morning comes", "the morning", "first light", "daylight",
    "the sun is out"], Sky::Light),
];
const NOT: &[&str] = &["not", "no longer", "not yet", "neither"];

impl Parser<'_> {
    pub(super) fn weather(&mut self) -> Option<Test> {
        let start = self.at;
        let found = self.of_sky();
        if let Some((sky, holds)) = found {
            self.eat_any(&[
                "outside",
                "any more",
                "anymore",
                "any longer",
                "again",
                "out",
                "out there",
                "already",
                "yet",
            ]);
            Some(test(sky, holds))
        } else {
            self.at = start;
            None
        }
    }

    /// "Neither dark nor raining", "dark and raining": a state of the sky where "it is" was said before.
    pub(super) fn weather_again(&mut self) -> Option<Test> {
        let start = self.at;
        let not = self.eat_any(NOT);
        if let Some((sky, words)) = longest(self.rest(), STATES) {
            self.at += words;
            return Some(test(sky, !not));
        }
        self.at = start;
        None
    }

    fn of_sky(&mut self) -> Option<(Sky, bool)> {
        if let Some((sky, words)) = longest(self.rest(), SAYINGS) {
            self.at += words;
            return Some((sky, true));
        }
        if self.eat_any(&["there is", "theres", "there be", "there is still"]) {
            let no = self.eat_any(&["no", "not any"]);
            self.eat_any(&["any", "some", "more", "still"]);
            return self.eat(NOUNS).map(|sky| (sky, !no));
        }
        if self.eat_any(&["it", "its"]) {
            let is = self.lexemes[self.at - 1].token == Token::Word("its".to_owned());
            return self.it_does(is);
        }
        let in_case = self.at > 0 && self.lexemes[self.at - 1].token == Token::Word("of".to_owned());
        let sky = self.eat(NOUNS)?;
        if in_case {
            return Some((sky, true));
        }
        self.adverbs();
        let not = self.eat_any(&["has not", "hasnt", "does not", "doesnt", "is not", "wont"]);
        self.adverbs();
        if self.eat_any(ENDS) {
            return Some((sky, not));
        }
        self.eat_any(BEGINS).then_some((sky, !not))
    }

    /// "It to get dark", behind "wait for".
    pub(super) fn sky_to(&mut self) -> Option<Test> {
        let start = self.at;
        let found = if self.eat_any(&["it to", "it to have"]) { self.it_does(false) } else { None };
        if found.is_none() {
            self.at = start;
        }
        found.map(|(sky, holds)| test(sky, holds))
    }

    /// Behind "it".
    fn it_does(&mut self, is: bool) -> Option<(Sky, bool)> {
        self.adverbs();
        self.eat_any(&["has been", "should"]);
        let not = self.eat_any(&["does not", "doesnt", "has not", "hasnt"]);
        self.adverbs();
        if is && self.eat_any(ENDS) {
            return self.eat(VERBS).map(|sky| (sky, not)); // "it's stopped raining"
        }
        if is || self.eat_any(BE) {
            self.adverbs();
            let not = self.eat_any(NOT) || not;
            self.adverbs();
            self.eat_any(&["getting", "too", "so", "very", "the", "either"]);
            return self.eat(STATES).map(|sky| (sky, !not));
        }
        if self.eat_any(ENDS) {
            return self.eat(VERBS).map(|sky| (sky, not));
        }
        self.eat_any(BEGINS);
        self.eat(VERBS).map(|sky| (sky, !not))
    }

    fn eat(&mut self, table: &[(&[&str], Sky)]) -> Option<Sky> {
        let (sky, words) = longest(self.rest(), table)?;
        self.at += words;
        Some(sky)
    }

    /// "Already", "still": when, which a condition says anyway.
    pub(super) fn adverbs(&mut self) {
        while let Some(words) = longest_phrase(
            self.rest(),
            &[
                "already",
                "still",
                "now",
                "really",
                "finally",
                "actually",
                "currently",
                "just",
                "also",
                "yet",
                "at last",
                "at the moment",
                "right now",
                "even",
                "by now",
                "indeed",
                "all",
                "completely",
                "properly",
                "only",
                "ever",
                "in fact",
                "happen to",
                "happens to",
                "suddenly",
                "by then",
                "by any chance",
            ],
        ) {
            self.at += words;
        }
    }
}

fn test(sky: Sky, holds: bool) -> Test {
    let (test, holds) = match sky {
        Sky::Rain => (Test::Raining, holds),
        Sky::Snow => (Test::Snowing, holds),
        Sky::Dark => (Test::Dark, holds),
        Sky::Light => (Test::Dark, !holds),
        Sky::Dry => (Test::Raining, !holds),
    };
    if holds { test } else { Test::Not(Box::new(test)) }
}
