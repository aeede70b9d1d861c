//! Weather and time of day in words.

use simworld_core::environment::{Environment, Sun};

use super::super::lexer::Token;
use super::super::lexicon::{fits, longest, longest_phrase};
use super::super::numbers;
use super::parse::Reader;
use super::words::{ENDINGS, SKIES, SKY_NOISE, Sky};

impl Reader<'_> {
    /// What sky is wished for, if every word up to the end is about it.
    pub(super) fn sky(&self, end: usize) -> Option<Vec<Sky>> {
        const STOPS: &[&str] = &[
            "stop",
            "end",
            "no more",
            "no",
            "without",
            "get rid of",
            "turn off",
            "remove",
            "clear",
            "disable",
            "lift",
            "halt",
            "switch off",
            "it shouldnt",
            "it should not",
            "it must not",
            "it mustnt",
            "dont let it",
            "do not let it",
        ];
        const DENIES: &[&str] = &["not", "dont", "never", "shouldnt", "mustnt", "doesnt", "isnt"];
        let mut at = self.at;
        if matches!(self.word(at), Some("if" | "unless" | "when" | "whenever" | "once"))
            || longest_phrase(&self.lexemes[at..end], &["clear everything", "clear all", "clear it all"])
                .is_some()
        {
            return None;
        }
        let mut found = Vec::new();
        let mut stops = false;
        while at < end {
            let rest = &self.lexemes[at..end];
            if matches!(rest[0].token, Token::Comma | Token::Break) {
                at += 1;
                continue;
            }
            // "Clear the fog" is no fog, and "clear" is a sky.
            let the =
                |from: usize| longest_phrase(&rest[from..], &["the", "this", "that", "all the"]).unwrap_or(0);
            if let Some(words) = longest_phrase(rest, STOPS)
                && longest(&rest[words + the(words)..], ENDINGS).is_some()
            {
                stops = true;
                at += words + the(words);
                continue;
            }
            if longest_phrase(rest, STOPS).is_none() && longest_phrase(rest, DENIES).is_some() {
                return None;
            }
            let ending = longest(rest, ENDINGS).filter(|_| stops);
            let sky = longest(rest, SKIES);
            let hour = hour(rest).filter(|(_, words)| !is_bare(rest, *words) || self.speaks_of_time(end));
            let noise = longest_phrase(rest, SKY_NOISE).unwrap_or(0);
            if let Some((sky, count)) = ending {
                found.push(sky);
                at += count;
            } else if let Some((sky, count)) = hour {
                found.push(sky);
                at += count;
            } else if let Some((sky, count)) = sky.filter(|(_, count)| *count >= noise) {
                found.push(sky);
                at += count;
            } else if let Some(count) = longest_phrase(rest, STOPS) {
                stops = true;
                at += count;
            } else if noise > 0 {
                at += noise;
            } else if matches!(&rest[0].token, Token::Word(word) if ["stopped", "over", "ends", "ended", "stops"].contains(&word.as_str()))
            {
                for sky in &mut found {
                    *sky = match *sky {
                        Sky::Rain(_) => Sky::DryUp,
                        Sky::Snow(_) => Sky::NoSnow,
                        Sky::Fog(_) => Sky::NoFog,
                        other => other,
                    };
                }
                at += 1;
            } else {
                return None;
            }
        }
        (!found.is_empty()).then_some(found)
    }
}

/// Whether a time of day is told by a number alone.
fn is_bare(lexemes: &[super::super::lexer::Lexeme], words: usize) -> bool {
    numbers::number(lexemes).is_some_and(|(_, number)| number == words)
}

impl Reader<'_> {
    /// Whether a number may be a time of day: "chairs for six" is none.
    fn speaks_of_time(&self, end: usize) -> bool {
        #[rustfmt::skip]
        const TIMES: &[&str] = &["clock", "time", "hour", "morning", "evening", "night", "afternoon", "set", "make", "at", "till", "past", "oclock", "be", "its", "is"];
        (self.at..end).any(|at| self.word(at).is_some_and(|word| TIMES.contains(&word)))
    }
}

/// "8 pm", "20:30", "half past seven in the morning", "noon".
pub(in crate::language) fn hour(lexemes: &[super::super::lexer::Lexeme]) -> Option<(Sky, usize)> {
    const AFTER: &[&str] = &["pm", "p m", "in the evening", "in the afternoon", "at night", "p"];
    const BEFORE: &[&str] = &["am", "a m", "in the morning"];
    let half = longest_phrase(lexemes, &["half past"]).unwrap_or(0);
    // "A little rain" is no hour.
    let is_article = ["a", "an"].iter().any(|word| fits(&lexemes[half..], word).is_some());
    // Nor is "half of what it is".
    let is_half = fits(&lexemes[half..], "half").is_some();
    let (number, mut at) = numbers::number(&lexemes[half..]).filter(|_| !is_article && !is_half)?;
    at += half;
    let mut hour = number + if half > 0 { 0.5 } else { 0.0 };
    // "20:30" is two numbers with a mark between.
    if let [mark, rest @ ..] = &lexemes[at..]
        && mark.token == Token::Break
        && let Some(Token::Number(minutes)) = rest.first().map(|lexeme| &lexeme.token)
        && (0.0..60.0).contains(minutes)
    {
        hour += minutes / 60.0;
        at += 2;
    }
    // "Seven thirty".
    if let Some((minutes, words)) = numbers::number(&lexemes[at..])
        && minutes.fract() == 0.0
        && (10.0..60.0).contains(&minutes)
        && hour.fract() == 0.0
    {
        hour += minutes / 60.0;
        at += words;
    }
    at += longest_phrase(&lexemes[at..], &["oclock", "o clock", "hours", "h"]).unwrap_or(0);
    if let Some(count) = longest_phrase(&lexemes[at..], AFTER) {
        at += count;
        let early = fits(&lexemes[at - count..], "at night").is_some() && hour < 6.0;
        if hour < 12.0 && !early {
            hour += 12.0;
        }
    } else if let Some(count) = longest_phrase(&lexemes[at..], BEFORE) {
        at += count;
        if (12.0..13.0).contains(&hour) {
            hour -= 12.0;
        }
    }
    (0.0..=24.0).contains(&hour).then_some((Sky::Hour(hour % 24.0), at))
}

/// Sun and weather as they are wished for.
pub(in crate::language) fn changed(mut now: Environment, skies: &[Sky]) -> Environment {
    let weather = &mut now.weather;
    let mut hour = None;
    for sky in skies {
        match *sky {
            Sky::Rain(rate) => (weather.rain, weather.snow, weather.cloud_cover) = (rate, 0.0, 0.95),
            Sky::Snow(rate) => {
                (weather.rain, weather.snow, weather.cloud_cover) = (0.0, rate, 0.95);
                weather.temperature = weather.temperature.min(-1.0);
            }
            Sky::Fog(visibility) => (weather.visibility, weather.cloud_cover) = (visibility, 1.0),
            Sky::Clear => {
                let clear = simworld_core::environment::Weather::default();
                *weather = simworld_core::environment::Weather { temperature: weather.temperature, ..clear };
            }
            Sky::Cloudy => weather.cloud_cover = 0.95,
            Sky::DryUp => weather.rain = 0.0,
            Sky::NoSnow => weather.snow = 0.0,
            Sky::NoFog => weather.visibility = 20_000.0,
            Sky::Windy(speed) => weather.wind = simworld_core::geometry::Vector2::new(speed, 0.0),
            Sky::Warmth(degrees) => weather.temperature = degrees,
            Sky::Hour(at) => hour = Some(at),
        }
    }
    if let Some(hour) = hour {
        now.sun = Sun::at_hour(hour);
    }
    now
}
