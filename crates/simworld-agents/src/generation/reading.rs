//! From words to an order: which thing, and everything that is said of it, word by word.

use super::GenerateError;
use super::stuff::{STUFFS, Stuff};
use super::thing::{Style, Takes, Thing, Usual};
use super::words::{
    BEHIND, COLORS, HARMLESS, MEASURED, SHADES, SIZES, STRIPED, STRONGER, STYLES, Sides, UNITS, WITHOUT,
    listed,
};
use crate::language::lexer::{Token, lex};
use crate::language::numbers::NUMERALS;
use crate::language::paint::PAINTS;

/// A thing with what words say of it.
#[derive(Clone, Debug)]
pub(super) struct Order {
    pub(super) thing: &'static Thing,
    /// Times the usual length, width and height.
    pub(super) factors: [f64; 3],
    /// Length, width and height that were given, m.
    pub(super) exact: [Option<f64>; 3],
    pub(super) stuff: Option<Stuff>,
    pub(super) color: Option<[f32; 3]>,
    pub(super) accent: Option<[f32; 3]>,
    pub(super) style: Option<Style>,
    pub(super) counts: Vec<u32>,
    pub(super) features: Vec<bool>,
    /// The words that say something of it, for people to ask for it by.
    pub(super) tags: Vec<String>,
    pub(super) unused: Vec<String>,
}

/// Reads a prompt.
pub(super) fn read(words: &str) -> Result<Order, GenerateError> {
    let mut reader = Reader::new(words)?;
    reader.measures()?;
    reader.parts()?;
    reader.qualities();
    reader.finish(words)
}

struct Reader {
    words: Vec<Word>,
    order: Order,
    /// The words of the noun.
    noun: std::ops::Range<usize>,
    /// Where something else than the thing is spoken of.
    behind: usize,
}

#[derive(Clone, Debug)]
struct Word {
    text: String,
    number: Option<f64>,
    is_used: bool,
}

impl Reader {
    fn new(text: &str) -> Result<Self, GenerateError> {
        let mut words: Vec<Word> = lex(text).into_iter().filter_map(|lexeme| word_of(lexeme.token)).collect();
        let Some((thing, noun, behind)) = noun(&words) else {
            return Err(GenerateError::Unknown { words: text.to_owned(), near: nearest(&words) });
        };
        words[noun.clone()].iter_mut().for_each(|word| word.is_used = true);
        let usual = |takes: &Takes| match takes {
            Takes::Count { usual, .. } => Some(*usual),
            _ => None,
        };
        let given = |takes: &Takes| match takes {
            Takes::Feature { usual, .. } => Some(*usual == Usual::With),
            _ => None,
        };
        let order = Order {
            thing,
            factors: [1.0; 3],
            exact: [None; 3],
            stuff: None,
            color: None,
            accent: None,
            style: None,
            counts: thing.takes.iter().filter_map(usual).collect(),
            features: thing.takes.iter().filter_map(given).collect(),
            tags: Vec::new(),
            unused: Vec::new(),
        };
        Ok(Self { words, order, noun, behind })
    }

    // ---- measures ----

    /// "2 m high", "a height of 2 m", "3 by 2 m".
    fn measures(&mut self) -> Result<(), GenerateError> {
        for at in 0..self.words.len() {
            let Some(number) = self.number(at) else { continue };
            let mut numbers = vec![number];
            let mut end = at + 1;
            while self.is(end, &["by", "x", "×"]) {
                let Some(next) = self.number(end + 1) else { break };
                numbers.push(next);
                end += 2;
            }
            let unit = self.text(end).and_then(|unit| listed(UNITS, |row| row.0, unit));
            let Some((_, unit)) = unit else { continue };
            let spoken = at..end + 1;
            if let [only] = numbers[..] {
                let (sides, named) = self.side_of(at, end);
                for index in named {
                    self.words[index].is_used = true;
                }
                self.measure(sides, only * unit)?;
            } else {
                for (sides, number) in [Sides::Longer, Sides::Width, Sides::Height].into_iter().zip(&numbers)
                {
                    let sides = if sides == Sides::Width { self.shorter() } else { sides };
                    self.measure(sides, number * unit)?;
                }
            }
            self.words[spoken].iter_mut().for_each(|word| word.is_used = true);
        }
        Ok(())
    }

    /// The side that a measure from `at` to its unit at `unit` is of, with the words that say so.
    fn side_of(&self, at: usize, unit: usize) -> (Sides, Vec<usize>) {
        let named = |index: usize| {
            self.text(index).and_then(|word| listed(MEASURED, |row| row.0, word)).map(|(_, sides)| *sides)
        };
        let after = if self.is(unit + 1, &["in"]) { unit + 2 } else { unit + 1 };
        if let Some(sides) = named(after) {
            return (sides, vec![after]);
        }
        let before = (1..=2).filter_map(|back| at.checked_sub(back)).find(|index| {
            named(*index).is_some() && (*index + 1 == at || self.is(*index + 1, &["of", "is"]))
        });
        match before.and_then(|index| Some((named(index)?, vec![index]))) {
            Some(found) => found,
            None => (Sides::Main, Vec::new()),
        }
    }

    fn measure(&mut self, sides: Sides, value: f64) -> Result<(), GenerateError> {
        for axis in self.axes(sides) {
            self.order.exact[axis] = Some(checked_size(self.order.thing, axis, value)?);
        }
        Ok(())
    }

    fn shorter(&self) -> Sides {
        let [x, y, _] = self.order.thing.size;
        if x > y { Sides::Width } else { Sides::Depth }
    }

    /// The axes that a word for a side is about: 0 length, 1 width, 2 height.
    fn axes(&self, sides: Sides) -> Vec<usize> {
        let [x, y, z] = self.order.thing.size;
        let is_even = (x - y).abs() < 1e-9;
        match sides {
            Sides::Height => vec![2],
            Sides::All => vec![0, 1, 2],
            Sides::Across => vec![0, 1],
            // What is as long as wide stays so.
            Sides::Width | Sides::Depth | Sides::Longer if is_even => vec![0, 1],
            Sides::Width => vec![1],
            Sides::Depth => vec![0],
            Sides::Longer => vec![usize::from(y > x)],
            Sides::Main if z >= x.max(y) * 0.8 => vec![2],
            Sides::Main => self.axes(Sides::Longer),
        }
    }

    // ---- numbers of parts, and parts that are there or not ----

    fn parts(&mut self) -> Result<(), GenerateError> {
        let thing = self.order.thing;
        let counts = thing.takes.iter().filter_map(|takes| match takes {
            Takes::Count { of, least, most, .. } => Some((*of, *least, *most)),
            _ => None,
        });
        for (which, (of, least, most)) in counts.enumerate() {
            let Some(at) = self.find(of) else { continue };
            if let Some(number) = self.count_before(at) {
                if !(f64::from(least)..=f64::from(most)).contains(&number.1) || number.1.fract() != 0.0 {
                    return Err(GenerateError::Range {
                        thing: thing.names[0].to_owned(),
                        what: "a number of parts of",
                        value: number.1,
                        allowed: format!("{least} to {most} {}", of[0]),
                    });
                }
                self.order.counts[which] = number.1 as u32;
                self.words[number.0].is_used = true;
                self.use_word(at);
            } else if self.order.counts[which] > 0 && !self.is_denied(at) {
                self.use_word(at);
            }
        }
        let features = thing.takes.iter().filter_map(|takes| match takes {
            Takes::Feature { what, .. } => Some(*what),
            _ => None,
        });
        for (which, what) in features.enumerate() {
            let Some(at) = self.find(what) else { continue };
            self.order.features[which] = !self.is_denied(at);
            self.use_word(at);
        }
        Ok(())
    }

    /// The number before a counted word, over at most two words of its own; none at all is 0.
    fn count_before(&mut self, at: usize) -> Option<(usize, f64)> {
        for back in 1..=3 {
            let index = at.checked_sub(back)?;
            if self.words[index].is_used {
                return None;
            }
            if let Some(number) = self.number(index) {
                return Some((index, number));
            }
            if self.is(index, WITHOUT) {
                return Some((index, 0.0));
            }
            if self.is(index, BEHIND) {
                return None;
            }
        }
        None
    }

    /// Whether "without" or "no" stands before a word; then it is used.
    fn is_denied(&mut self, at: usize) -> bool {
        let denied = (1..=2).filter_map(|back| at.checked_sub(back)).find(|index| self.is(*index, WITHOUT));
        if let Some(index) = denied {
            self.words[index].is_used = true;
        }
        denied.is_some()
    }

    // ---- size, colour, material, shape ----

    fn qualities(&mut self) {
        for at in 0..self.words.len() {
            if !self.words[at].is_used
                && (self.size(at) || self.color(at) || self.stuff(at) || self.style(at))
            {
                self.use_word(at);
            }
        }
        for at in 0..self.words.len() {
            let is_stripe = self.order.thing.takes.contains(&Takes::Accent) && self.is(at, STRIPED);
            if self.is(at, HARMLESS) || is_stripe {
                self.words[at].is_used = true;
            }
        }
    }

    fn size(&mut self, at: usize) -> bool {
        let Some((_, sides, factor)) = self.text(at).and_then(|word| listed(SIZES, |row| row.0, word)) else {
            return false;
        };
        let stronger = at > 0 && self.is(at - 1, STRONGER);
        let factor = if stronger { factor * factor.sqrt() } else { *factor };
        if stronger {
            self.words[at - 1].is_used = true;
        }
        for axis in self.axes(*sides) {
            self.order.factors[axis] *= factor;
        }
        true
    }

    fn color(&mut self, at: usize) -> bool {
        let Some(mut color) = self.text(at).and_then(color_of) else { return false };
        // "Dark blue" is one colour, and "dark" by itself another.
        let next = self.text(at + 1).and_then(color_of);
        if next.is_some() && self.is(at, &["dark"]) {
            return false;
        }
        let shade = at.checked_sub(1).and_then(|index| listed(SHADES, |row| row.0, self.text(index)?));
        if let Some((_, towards, share)) = shade {
            color = color.map(|channel| channel + (towards - channel) * share);
        }
        let takes_accent = self.order.thing.takes.contains(&Takes::Accent);
        let is_of_part = at >= self.behind && self.behind_is_with();
        let order = &mut self.order;
        let place = match (order.color, order.accent) {
            (_, None) if is_of_part && takes_accent => &mut order.accent,
            (None, _) => &mut order.color,
            (Some(_), None) if takes_accent => &mut order.accent,
            _ => return false,
        };
        *place = Some(color);
        if shade.is_some() {
            self.use_word(at - 1);
        }
        true
    }

    fn behind_is_with(&self) -> bool {
        self.is(self.behind, &["with", "having"])
    }

    fn stuff(&mut self, at: usize) -> bool {
        let Some((_, stuff, color)) = self.text(at).and_then(|word| listed(STUFFS, |row| row.0, word)) else {
            return false;
        };
        let thing = self.order.thing;
        if self.order.stuff.is_some() {
            return false;
        }
        if !thing.takes.contains(&Takes::Material) {
            return thing.stuff == *stuff && color.is_none();
        }
        self.order.stuff = Some(*stuff);
        // A colour that is said counts more than that of the material.
        let own = color.or((*stuff != thing.stuff).then(|| stuff.color()));
        self.order.color = self.order.color.or(own);
        true
    }

    fn style(&mut self, at: usize) -> bool {
        let Some((_, style)) = self.text(at).and_then(|word| listed(STYLES, |row| row.0, word)) else {
            return false;
        };
        let takes = self.order.thing.takes;
        let (can_be_round, can_be_square) = (takes.contains(&Takes::Round), takes.contains(&Takes::Square));
        match style {
            Style::Round if can_be_round => self.order.style = Some(Style::Round),
            Style::Square if can_be_square => self.order.style = Some(Style::Square),
            // It is so by itself.
            Style::Round => return can_be_square,
            Style::Square => return can_be_round,
        }
        true
    }

    // ---- the end ----

    fn finish(mut self, text: &str) -> Result<Order, GenerateError> {
        let number = |word: &Word| word.number.map_or_else(|| word.text.clone(), |number| number.to_string());
        // "A chair lift" is no chair.
        let stray = self.words[self.noun.end..self.behind].iter().any(|word| !word.is_used);
        if stray {
            return Err(GenerateError::Unknown { words: text.to_owned(), near: nearest(&self.words) });
        }
        self.order.unused = self.words.iter().filter(|word| !word.is_used).map(number).collect();
        Ok(self.order)
    }

    fn text(&self, at: usize) -> Option<&str> {
        self.words.get(at).map(|word| word.text.as_str())
    }

    fn number(&self, at: usize) -> Option<f64> {
        self.words.get(at)?.number
    }

    fn is(&self, at: usize, words: &[&str]) -> bool {
        self.text(at).is_some_and(|word| words.contains(&word))
    }

    /// The first unused word of a list.
    fn find(&self, words: &[&str]) -> Option<usize> {
        (0..self.words.len()).find(|at| !self.words[*at].is_used && self.is(*at, words))
    }

    fn use_word(&mut self, at: usize) {
        self.words[at].is_used = true;
        let word = self.words[at].text.clone();
        if !self.order.tags.contains(&word) {
            self.order.tags.push(word);
        }
    }
}

/// A size within what the thing can have.
pub(super) fn checked_size(thing: &Thing, axis: usize, value: f64) -> Result<f64, GenerateError> {
    /// How much smaller and larger than usual a thing may be.
    const SMALLEST: f64 = 0.25;
    const LARGEST: f64 = 4.0;
    let usual = thing.size[axis];
    if (usual * SMALLEST..=usual * LARGEST).contains(&value) {
        return Ok(value);
    }
    let what = ["a length of", "a width of", "a height of"][axis];
    let allowed = format!("{:.2} to {:.2} m", usual * SMALLEST, usual * LARGEST);
    Err(GenerateError::Range { thing: thing.names[0].to_owned(), what, value, allowed })
}

fn word_of(token: Token) -> Option<Word> {
    /// Words that are no numbers here, though sentences count by them.
    const NO_NUMBERS: &[&str] = &["a", "an", "half", "couple"];
    let (text, number) = match token {
        Token::Number(number) => (String::new(), Some(number)),
        Token::Word(word) => {
            let is_number = !NO_NUMBERS.contains(&word.as_str());
            let number = NUMERALS.iter().find(|(numeral, _)| is_number && *numeral == word).map(|(_, n)| *n);
            (word, number)
        }
        _ => return None,
    };
    Some(Word { text, number, is_used: false })
}

fn color_of(word: &str) -> Option<[f32; 3]> {
    let own = listed(COLORS, |row| row.0, word).map(|(_, color)| *color);
    own.or_else(|| listed(PAINTS, |row| row.0, word).map(|(_, paint)| paint.color()))
}

/// The thing that is named, the words of its name, and where something else is spoken of: the last and longest name before
/// that.
fn noun(words: &[Word]) -> Option<(&'static Thing, std::ops::Range<usize>, usize)> {
    let mut best: Option<(usize, usize, usize, &'static Thing)> = None;
    // "By" between numbers joins them.
    let is_behind = |at: &usize| {
        BEHIND.contains(&words[*at].text.as_str())
            && at.checked_sub(1).is_none_or(|at| words[at].number.is_none())
    };
    let first_behind = (0..words.len()).find(is_behind).unwrap_or(words.len());
    for thing in super::things::all() {
        for name in thing.names {
            let parts: Vec<&str> = name.split([' ', '-']).collect();
            for start in 0..words.len().min(first_behind.max(1)) {
                let end = start + parts.len();
                let Some(said) = words.get(start..end) else { continue };
                let is_called = said.iter().zip(&parts).enumerate().all(|(index, (word, part))| {
                    word.text == *part || index + 1 == parts.len() && is_plural(&word.text, part)
                });
                // "Red and white parasol": what "and" joins are words for the same thing.
                if is_called && best.is_none_or(|(last, length, ..)| (end, parts.len()) > (last, length)) {
                    best = Some((end, parts.len(), start, thing));
                }
            }
        }
    }
    let (end, _, start, thing) = best.or_else(|| noun_behind_and(words))?;
    let behind = words[end..].iter().position(|word| BEHIND.contains(&word.text.as_str()));
    Some((thing, start..end, behind.map_or(words.len(), |at| end + at)))
}

/// The noun where an "and" stands between words that describe it: "a red and white parasol".
fn noun_behind_and(words: &[Word]) -> Option<(usize, usize, usize, &'static Thing)> {
    let joint = words.iter().position(|word| word.text == "and")?;
    let before = words[..joint].iter().all(|word| is_quality(&word.text));
    let (thing, range, _) = noun(&words[joint + 1..]).filter(|_| before)?;
    Some((joint + 1 + range.end, range.len(), joint + 1 + range.start, thing))
}

fn is_plural(word: &str, singular: &str) -> bool {
    ["s", "es"].iter().any(|ending| word.strip_suffix(ending) == Some(singular))
        || word.strip_suffix("ies").is_some_and(|stem| singular.strip_suffix('y') == Some(stem))
}

/// Whether a word says how a thing is, and not what.
fn is_quality(word: &str) -> bool {
    HARMLESS.contains(&word)
        || color_of(word).is_some()
        || listed(STUFFS, |row| row.0, word).is_some()
        || listed(SHADES, |row| row.0, word).is_some()
        || listed(SIZES, |row| row.0, word).is_some()
}

/// The names of the things that are spelled most like one of the words, three of them.
fn nearest(words: &[Word]) -> Vec<String> {
    let said: Vec<&str> =
        words.iter().map(|word| word.text.as_str()).filter(|word| !is_quality(word)).collect();
    let mut ranked: Vec<(f64, &'static str)> = super::things::all()
        .map(|thing| {
            let score = |name: &&str| {
                let parts = name.split(' ').chain([*name]);
                let of =
                    |part: &str| said.iter().map(|word| strsim::jaro_winkler(word, part)).fold(0.0, f64::max);
                parts.map(of).fold(0.0, f64::max)
            };
            (thing.names.iter().map(score).fold(0.0, f64::max), thing.names[0])
        })
        .collect();
    ranked.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(b.1)));
    ranked.into_iter().take(3).map(|(_, name)| name.to_owned()).collect()
}
