//! Conditions of the weather and the light: "if it rains", "until it is dark".

use super::clause::Test;
use super::lexicon::longest;
use super::parser::Parser;

/// What makes a condition of the weather, and whether it is to hold.
type Weather = (fn() -> Test, bool);

impl Parser<'_> {
    pub(super) fn weather(&mut self) -> Option<Test> {
        const RULES: &[(&[&str], Weather)] = &[
            (
                &[
                    "it is raining",
                    "its raining",
                    "it rains",
                    "it starts raining",
                    "it starts to rain",
                    "there is rain",
                    "the rain starts",
                    "it begins to rain",
                    "it rain",
                    "it be raining",
                    "it start raining",
                    "it start to rain",
                    "it begins raining",
                    "there be rain",
                ],
                (|| Test::Raining, true),
            ),
            (
                &[
                    "it is not raining",
                    "it stops raining",
                    "the rain stops",
                    "it isnt raining",
                    "it is dry",
                    "its dry",
                    "its not raining",
                    "it has stopped raining",
                    "it doesnt rain",
                ],
                (|| Test::Raining, false),
            ),
            (
                &[
                    "it is snowing",
                    "its snowing",
                    "it snows",
                    "it starts snowing",
                    "it starts to snow",
                    "it snow",
                    "it be snowing",
                    "there is snow",
                ],
                (|| Test::Snowing, true),
            ),
            (&["it is not snowing", "it stops snowing", "it isnt snowing"], (|| Test::Snowing, false)),
            (
                &[
                    "it is dark",
                    "its dark",
                    "it gets dark",
                    "it is night",
                    "night falls",
                    "its night",
                    "the sun sets",
                    "it becomes dark",
                    "the sun goes down",
                    "the sun is down",
                    "it be dark",
                    "it be night",
                    "it get dark",
                    "it is nighttime",
                    "the sun has set",
                    "the sun has gone down",
                ],
                (|| Test::Dark, true),
            ),
            (
                &[
                    "it is light",
                    "it is day",
                    "it is daytime",
                    "the sun rises",
                    "its day",
                    "it is not dark",
                    "it isnt dark",
                    "the sun is up",
                    "the sun comes up",
                    "it gets light",
                    "it is bright",
                ],
                (|| Test::Dark, false),
            ),
        ];
        let ((make, holds), count): (Weather, usize) = longest(self.rest(), RULES)?;
        self.at += count;
        Some(if holds { make() } else { Test::Not(Box::new(make())) })
    }
}
