//! Turning things where they stand.

use std::f64::consts::PI;

use simworld_core::seam::PlanError;

use super::super::lexer::Lexeme;
use super::super::lexicon::{longest, longest_phrase};
use super::super::numbers;
use super::super::paint::PAINTS;
use super::super::phrases::Phrases;
use super::parse::Reader;
use super::wish::Wish;

impl Reader<'_> {
    /// "Rotate the truck 90 degrees to the left", "turn the statue around", "turn Gus towards the fountain", "turn the car red".
    pub(super) fn turns(&mut self, end: usize) -> Result<Vec<Vec<Wish>>, PlanError> {
        #[rustfmt::skip]
    const TOWARDS: &Phrases = &Phrases::of(&["towards", "toward", "to face", "so that it faces", "so it faces", "to look at",
        "at", "facing", "so that it looks at", "so it looks at", "so that he faces", "so that she faces", "to",
        "so she faces", "so he faces", "so they face", "until it faces", "so that they face", "so it looks towards",
        "so she looks at", "so he looks at", "to look towards", "in the direction of", "so that it looks towards",
        "to point at"]);
        let start = self.at;
        // "Turn around the bench that stands on the square".
        if matches!(self.word(start), Some("around" | "round"))
            && self.is_certain(start + 1)
            && let Ok(what) = self.things(start + 1, self.before_politeness(start + 1, end))
        {
            self.at = end;
            return Ok(vec![vec![Wish::Rotate { what, angle: PI }]]);
        }
        for cut in start + 1..end {
            let rest = &self.lexemes[cut..self.before_politeness(cut, end)];
            // "To the right" is no "right?".
            if let Some(angle) = angle(rest).or_else(|| angle(&self.lexemes[cut..end])) {
                if let Ok(what) = self.things(start, cut) {
                    self.at = end;
                    return Ok(vec![vec![Wish::Rotate { what, angle }]]);
                }
            } else if let around = longest_phrase(rest, &["around", "round"]).unwrap_or(0)
                && let Some(count) = longest_phrase(&rest[around..], TOWARDS).map(|words| around + words)
                && let Ok(what) = self.things(start, cut)
                && longest(&self.lexemes[cut + count..end], PAINTS)
                    .is_none_or(|(_, words)| cut + count + words < end)
            {
                self.at = cut + count;
                return self.towards(what, end).map(|wish| vec![vec![wish]]);
            }
        }
        // "By 90 degrees" may stand first: "turn by 90 degrees the truck". And "turn the car red" is about paint.
        for cut in start + 1..end {
            if let Some((paint, words)) = longest(&self.lexemes[cut..end], PAINTS)
                && cut + words == end
                && let Ok(what) = self.things(start, cut)
            {
                self.at = end;
                return Ok(vec![vec![Wish::Paint { what, paint }]]);
            }
            let mut parser = self.parser(cut, end);
            if parser.compass().is_some()
                && parser.at >= self.before_politeness(cut, end)
                && let Ok(what) = self.things(start, cut)
            {
                self.at = cut;
                return self.towards(what, end).map(|wish| vec![vec![wish]]);
            }
        }
        Err(self.not_understood("say what to turn, and by how many degrees or towards what"))
    }
}

/// An angle in words, radians, positive to the left; only if all words are of it.
pub(super) fn angle(lexemes: &[Lexeme]) -> Option<f64> {
    const TURNS: &[(&[&str], f64)] = &[
        (&["a quarter turn", "a quarter of a turn", "quarter turn", "a quarter", "a right angle"], 90.0),
        (&["a half turn", "half a turn", "half way", "halfway", "half way round"], 180.0),
        (&["a bit", "a little", "slightly"], 15.0),
    ];
    #[rustfmt::skip]
    const AROUND: &Phrases = &Phrases::of(&["around", "round", "backwards", "the other way", "the other way round",
        "the other way around", "upside down", "the opposite way", "the opposite direction", "in the other direction", "in the opposite direction", "the other direction", "other way", "back to front", "180", "about face", "all the way around"]);
    #[rustfmt::skip]
    const LEFT: &[&str] = &["left", "to the left", "counterclockwise", "counter clockwise", "anticlockwise",
        "anti clockwise", "leftwards"];
    const RIGHT: &[&str] = &["right", "to the right", "clockwise", "rightwards"];
    if longest_phrase(lexemes, AROUND) == Some(lexemes.len()) {
        return Some(PI);
    }
    // "Around by 90 degrees".
    let lexemes =
        &lexemes[longest_phrase(lexemes, &["around by", "round by", "around", "round"]).unwrap_or(0)..];
    let side_of = |rest: &[Lexeme]| {
        let left = longest_phrase(rest, LEFT).map(|count| (1.0, count));
        left.or(longest_phrase(rest, RIGHT).map(|count| (-1.0, count)))
    };
    let mut at = 0;
    let mut side = side_of(lexemes);
    at += side.map_or(0, |(_, count)| count);
    at += longest_phrase(&lexemes[at..], &["by", "through", "for"]).unwrap_or(0);
    #[rustfmt::skip]
    let degrees = if let Some((degrees, count)) = longest(&lexemes[at..], TURNS) {
        at += count;
        degrees
    } else if let Some((number, count)) = numbers::number(&lexemes[at..]) {
        at += count;
        match longest_phrase(&lexemes[at..], &["degrees", "degree", "deg", "°"]) {
            Some(words) => at += words,
            // "45 left" is told in degrees.
            None if side_of(&lexemes[at..]).is_some() && number > 1.0 => {}
            None => return None,
        }
        number
    } else if side.is_some() && at == lexemes.len() {
        90.0
    } else {
        return None;
    };
    if side.is_none() {
        side = side_of(&lexemes[at..]);
        at += side.map_or(0, |(_, count)| count);
    }
    (at == lexemes.len()).then(|| (degrees * side.map_or(1.0, |(side, _)| side)).to_radians())
}
