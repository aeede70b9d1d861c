//! Weather, season and time of day in words.

use simworld_core::environment::{Environment, Sun};

use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{fits, longest, longest_phrase};
use super::super::numbers;
use super::super::phrases::Phrases;
use super::parse::Reader;
use super::words::{ENDINGS, SKIES, SKY_NOISE, Sky, warmth_of};

/// Before what is to stop.
#[rustfmt::skip]
const STOPS: &Phrases = &Phrases::of(&["stop", "end", "no more", "no", "without", "get rid of", "turn off", "remove", "clear", "disable", "lift", "halt", "switch off", "it shouldnt",
    "it should not", "it must not", "it mustnt", "dont let it", "do not let it"]);
/// Who says so has weather enough.
pub(super) const COMPLAINS: &[&str] = &[
    "it is so",
    "its so",
    "it is too",
    "its too",
    "it is way too",
    "its way too",
    "it is always",
    "its always",
    "it is far too",
    "its far too",
    "its to",
    "is to",
    "is too",
    "is far too",
    "is so",
    "is very",
];
/// Before the weather that is to come, from which an order follows.
pub(super) const FORECASTS: &Phrases = &Phrases::of(&[
    "they say",
    "they said",
    "they promised",
    "the forecast says",
    "i heard",
    "its going to",
    "it is going to",
    "its gonna",
    "theres going to be",
    "it will be",
    "itll be",
    "its supposed to",
    "well have",
    "is coming",
    "are coming",
    "is on its way",
    "is expected",
    "is forecast",
]);
/// How somebody feels.
#[rustfmt::skip]
pub(super) const SHIVERS: &Phrases = &Phrases::of(&["were freezing", "we are freezing", "im freezing", "i am freezing", "shes freezing", "hes freezing", "theyre freezing", "they are freezing", "everybody is freezing", "everyone is freezing", "people are freezing", "is freezing", "were soaking", "im soaking",
    "something hot", "something cold", "something warm", "something cool", "anything hot", "anything cold",
    "were cold", "im cold", "were hot", "im hot"]);
/// What denies something else, so that nothing is wished for.
const DENIES: &[&str] = &["not", "dont", "never", "shouldnt", "mustnt", "doesnt", "isnt"];

/// What was heard of the sky so far.
#[derive(Default)]
struct Heard {
    found: Vec<Sky>,
    /// Whether what is named next is to stop.
    stops: bool,
}

impl Heard {
    /// "The rain has stopped": what was named is over.
    fn is_over(&mut self) {
        for sky in &mut self.found {
            *sky = match *sky {
                Sky::Rain(_) => Sky::DryUp,
                Sky::Snow(_) => Sky::NoSnow,
                Sky::Fog(_) => Sky::NoFog,
                other => other,
            };
        }
    }
}

impl Reader<'_> {
    /// What sky is wished for, if every word up to the end is about it, and is not told beside a request.
    pub(super) fn sky(&self, end: usize) -> Option<Vec<Sky>> {
        self.sky_named(end).filter(|_| !self.is_sky_told(self.at, end))
    }

    /// Whether some words are about the sky alone, and told beside a request for something else.
    pub(super) fn tells_of_sky(&self, from: usize, end: usize) -> bool {
        Reader { at: from, ..self.up_to(end) }.sky_named(end).is_some() && self.is_sky_told(from, end)
    }

    /// What sky is named, if every word up to the end is about it.
    fn sky_named(&self, end: usize) -> Option<Vec<Sky>> {
        let mut at = self.at;
        if matches!(self.word(at), Some("if" | "unless" | "when" | "whenever" | "once"))
            || longest_phrase(&self.lexemes[at..end], &["clear everything", "clear all", "clear it all"])
                .is_some()
        {
            return None;
        }
        // "We had a lovely day", "we drove for six hours": how it was, and for how long.
        let was = |at: usize| match self.word(at) {
            Some("had") => !matches!(self.word(at + 1), Some("better" | "in")),
            Some("hours") => true,
            _ => false,
        };
        let begin = self.lexemes[..at].iter().rposition(is_mark).map_or(0, |mark| mark + 1);
        if (begin..end).any(was) {
            return None;
        }
        // "It is so hot" asks for no other weather.
        let complains = |from: usize| longest_phrase(&self.lexemes[from..end], COMPLAINS);
        if complains(at).is_some()
            || (at.saturating_sub(4)..at).any(|from| complains(from).is_some_and(|words| from + words >= at))
        {
            return None;
        }
        let mut heard = Heard::default();
        while at < end {
            at += self.hear_sky(&self.lexemes[at..end], end, &mut heard)?;
        }
        (!heard.found.is_empty()).then_some(heard.found)
    }

    /// The next words about the sky, and how many they are; none if they are about something else.
    fn hear_sky(&self, rest: &[Lexeme], end: usize, heard: &mut Heard) -> Option<usize> {
        if matches!(rest[0].token, Token::Comma | Token::Break) {
            return Some(1);
        }
        // "Clear the fog" is no fog, and "clear" is a sky.
        let stops = longest_phrase(rest, STOPS);
        let the =
            |from: usize| longest_phrase(&rest[from..], &["the", "this", "that", "all the"]).unwrap_or(0);
        if let Some(words) = stops
            && longest(&rest[words + the(words)..], ENDINGS).is_some()
        {
            heard.stops = true;
            return Some(words + the(words));
        }
        if stops.is_none() && longest_phrase(rest, DENIES).is_some() {
            return None;
        }
        let noise = longest_phrase(rest, SKY_NOISE).unwrap_or(0);
        let ending = longest(rest, ENDINGS).filter(|_| heard.stops);
        let hour = || hour(rest).filter(|(_, words)| !is_bare(rest, *words) || self.speaks_of_time(end));
        let sky = || longest(rest, &SKIES).filter(|(_, count)| *count >= noise);
        if let Some((sky, count)) = ending.or_else(hour).or_else(sky) {
            heard.found.push(sky);
            return Some(count);
        }
        if stops.is_some() {
            heard.stops = true;
            return stops;
        }
        if noise > 0 {
            return Some(noise);
        }
        let is_over = longest_phrase(rest, &["stopped", "over", "ends", "ended", "stops"]);
        if is_over.is_some() {
            heard.is_over();
        }
        is_over
    }
}

/// Whether a time of day is told by a number alone.
fn is_bare(lexemes: &[Lexeme], words: usize) -> bool {
    numbers::number(lexemes).is_some_and(|(_, number)| number == words)
}

impl Reader<'_> {
    /// Whether a number may be a time of day: "chairs for six" is none.
    fn speaks_of_time(&self, end: usize) -> bool {
        #[rustfmt::skip]
        const TIMES: &[&str] = &["clock", "time", "hour", "morning", "evening", "night", "afternoon", "set", "make", "at", "till", "past", "oclock", "be", "its", "is"];
        // "We will be sixteen" is no hour.
        let is_it = || {
            (self.at..end).any(|at| matches!(self.word(at), Some("it" | "its" | "time" | "clock" | "hour")))
        };
        (self.at..end).any(|at| {
            self.word(at)
                .is_some_and(|word| TIMES.contains(&word) && (!matches!(word, "be" | "is") || is_it()))
        })
    }
}

/// "8 pm", "20:30", "half past seven in the morning", "noon".
pub(in crate::language) fn hour(lexemes: &[Lexeme]) -> Option<(Sky, usize)> {
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
    // "6 am sharp", and "sharp" behind a bare number is no time.
    if !is_bare(lexemes, at) {
        at += longest_phrase(&lexemes[at..], &["sharp", "on the dot"]).unwrap_or(0);
    }
    (0.0..=24.0).contains(&hour).then_some((Sky::Hour(hour % 24.0), at))
}

/// Sun, weather and season as they are wished for.
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
            Sky::Season(season) => {
                (now.season, weather.temperature) = (Some(season), warmth_of(season));
            }
            Sky::Hour(at) => hour = Some(at),
        }
    }
    if let Some(hour) = hour {
        now.sun = Sun::at_hour(hour);
    }
    now
}
