//! Weather, season and time of day in words.

use simworld_core::environment::{Environment, Sun};

use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{fits, longest, longest_phrase};
use super::super::numbers;
use super::super::phrases::Phrases;
use super::clock::{HOURS, MINUTES, NAMED_HOURS, beside_the_hour};
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
        // "Not a cloud in the sky" is a sky.
        if stops.is_none() && longest_phrase(rest, DENIES).is_some() && longest(rest, &SKIES).is_none() {
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

/// "8 pm", "20:30", "half past seven in the morning", "a quarter to nine", "ten past noon".
pub(in crate::language) fn hour(lexemes: &[Lexeme]) -> Option<(Sky, usize)> {
    let (minutes, lead) = beside_the_hour(lexemes).unwrap_or((0.0, 0));
    let rest = &lexemes[lead..];
    if let Some((named, words)) = longest(rest, NAMED_HOURS).filter(|_| lead > 0) {
        let hour = named + minutes / MINUTES;
        return Some((Sky::Hour((hour + HOURS) % HOURS), lead + words));
    }
    // "A little rain" is no hour.
    let is_article = ["a", "an"].iter().any(|word| fits(rest, word).is_some());
    // Nor is "half of what it is".
    let is_half = fits(rest, "half").is_some();
    let (number, mut at) = numbers::number(rest).filter(|_| !is_article && !is_half)?;
    at += lead;
    let mut hour = number + minutes / MINUTES;
    // "20:30" is two numbers with a mark between.
    if let [mark, rest @ ..] = &lexemes[at..]
        && mark.token == Token::Break
        && let Some(Token::Number(minutes)) = rest.first().map(|lexeme| &lexeme.token)
        && (0.0..60.0).contains(minutes)
    {
        hour += minutes / MINUTES;
        at += 2;
    }
    // "Seven thirty".
    if let Some((minutes, words)) = numbers::number(&lexemes[at..])
        && minutes.fract() == 0.0
        && (10.0..60.0).contains(&minutes)
        && hour.fract() == 0.0
    {
        hour += minutes / MINUTES;
        at += words;
    }
    at += longest_phrase(&lexemes[at..], &["oclock", "o clock", "hours", "h"]).unwrap_or(0);
    let (hour, words) = in_the_day(hour, &lexemes[at..]);
    at += words;
    // "6 am sharp", and "sharp" behind a bare number is no time.
    if !is_bare(lexemes, at) {
        at += longest_phrase(&lexemes[at..], &["sharp", "on the dot"]).unwrap_or(0);
    }
    (0.0..=HOURS).contains(&hour).then_some((Sky::Hour(hour % HOURS), at))
}

/// An hour by the half of the day that is told behind it, and how many words tell it: "in the evening", "am".
fn in_the_day(hour: f64, behind: &[Lexeme]) -> (f64, usize) {
    const AFTER: &[&str] = &["pm", "p m", "in the evening", "in the afternoon", "at night", "p"];
    const BEFORE: &[&str] = &["am", "a m", "in the morning"];
    let is_twelve = (12.0..13.0).contains(&hour);
    if let Some(count) = longest_phrase(behind, AFTER) {
        let at_night = fits(behind, "at night").is_some();
        // "Two at night" is early, and "twelve at night" begins the day.
        let shift = if at_night && is_twelve {
            -12.0
        } else if hour < 12.0 && !(at_night && hour < 6.0) {
            12.0
        } else {
            0.0
        };
        return (hour + shift, count);
    }
    let count = longest_phrase(behind, BEFORE).unwrap_or(0);
    (if count > 0 && is_twelve { hour - 12.0 } else { hour }, count)
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
