//! Wishes that name the place first and the things behind it: "surround the statue with six shrubs", "line River Walk with
//! trees", "clear the square of benches".

use simworld_core::scene::Relation;

use super::super::clause::{Count, Reference, Stands};
use super::super::lexicon::{longest, longest_phrase};
use super::parse::Reader;
use super::wish::{Anchor, Where, Wish};

/// How things stand to a place that is dressed with them.
#[derive(Clone, Copy)]
enum Dress {
    Along,
    /// Around a thing, and along what is long: a street, a river.
    Border,
    Around,
    In,
}

#[rustfmt::skip]
const DRESS: &[(&[&str], Dress)] = &[
    (&["line", "flank", "line both sides of", "line the side of", "line the sides of"], Dress::Along),
    (&["edge", "border", "fringe", "rim", "hem", "plant the edge of", "plant the edges of", "plant the rim of", "line the edge of", "line the edges of"], Dress::Border),
    (&["surround", "encircle", "ring", "circle", "enclose", "frame", "seal", "seal off", "fence", "fence in", "fence off", "hem in", "wall in", "cordon", "protect", "secure", "guard"], Dress::Around),
    (&["fill", "furnish", "dot", "sprinkle", "equip", "populate", "decorate", "strew", "provide", "plant", "adorn", "dress", "embellish", "grace", "stock", "beautify", "supply", "fit out", "kit out", "outfit"], Dress::In),
];
/// What is to be rid of things.
const CLEAR: &[&str] = &["clear", "rid", "empty", "free", "clean", "strip"];

impl Reader<'_> {
    /// "Surround the statue with six shrubs".
    pub(super) fn dressed(&mut self, end: usize) -> Option<Wish> {
        let start = self.at;
        let wish = self.try_dressed(end);
        self.at = start;
        wish
    }

    fn try_dressed(&mut self, end: usize) -> Option<Wish> {
        self.at += self.polite_at(self.at);
        let (dress, words) = longest(self.rest(end), DRESS)?;
        let from = self.at + words;
        for cut in from + 1..end {
            if longest_phrase(&self.lexemes[cut..end], &["with", "by", "using"]).is_none() {
                continue;
            }
            self.at = from;
            let sides: &[&str] = &[
                "on both sides",
                "on either side",
                "on each side",
                "to both sides",
                "along both sides",
                "at both sides",
            ];
            let stop = (from + 1..cut)
                .find(|at| longest_phrase(&self.lexemes[*at..cut], sides) == Some(cut - at))
                .unwrap_or(cut);
            let Some(anchor) = self.anchor(stop).ok().filter(|_| self.at == stop) else { continue };
            let both = stop < cut
                || longest_phrase(
                    &self.lexemes[from - words..],
                    &["line both sides of", "line the sides of"],
                )
                .is_some();
            self.at = cut + 1;
            if matches!(dress, Dress::In) {
                let things = self
                    .listed(None, end)
                    .ok()
                    .filter(|_| self.before_politeness(self.at, end) <= self.at)?;
                return Some(Wish::Add { things, at: vec![Where::By(anchor)] });
            }
            let mut thing = self.new_thing(end).ok()?;
            let both = both | self.eat_any(sides);
            if self.before_politeness(self.at, end) > self.at {
                continue;
            }
            let place = match dress {
                Dress::Along | Dress::Border if both || thing.count == 2 => Where::BothSides(anchor),
                Dress::Border if goes_round(&anchor) => Where::Around(anchor),
                Dress::Along | Dress::Border => Where::Along(anchor),
                Dress::Around => {
                    if thing.count == 2 {
                        return Some(Wish::Add { things: vec![thing], at: vec![Where::BothSides(anchor)] });
                    }
                    // Less does not surround a thing.
                    thing.count = if thing.count == 1 { 8 } else { thing.count };
                    thing.many = false;
                    let spacing = crate::editing::Spacing::Count(thing.count);
                    return Some(Wish::Row { thing, line: Where::Around(anchor), spacing });
                }
                Dress::In => return None,
            };
            return Some(Wish::Add { things: vec![thing], at: vec![place] });
        }
        None
    }

    /// "Clear the square of benches", "get the trees off Elm Street".
    pub(super) fn cleared(&self, end: usize) -> Option<Wish> {
        let start = self.at + self.polite_at(self.at);
        let end = self.before_politeness(start, end);
        let phrase = |at: usize, phrases: &[&str]| longest_phrase(&self.lexemes[at..end], phrases);
        if let Some(words) = phrase(
            start,
            &[
                "get", "take", "clear", "remove", "sweep", "throw", "chuck", "move", "kick", "drag", "pull",
                "haul", "have",
            ],
        ) && (start..end).any(|at| phrase(at, &["off", "out of"]).is_some())
        {
            // "Out of the square" is where they are.
            let whole: Vec<_> = self.lexemes[..end]
                .iter()
                .enumerate()
                .filter(|(at, _)| !(*at > start && phrase(*at, &["out of"]).is_some()))
                .map(|(at, lexeme)| {
                    if at > 0 && self.word(at) == Some("of") && self.word(at - 1) == Some("out") {
                        super::forms::word_at(lexeme, "in")
                    } else {
                        lexeme.clone()
                    }
                })
                .collect();
            let inner = self.over(&whole);
            let what = inner.one_of(start + words, whole.len()).ok()?;
            let is_there =
                matches!(&what.relation, Some(Stands::OnStreet(_) | Stands::To(Relation::Inside, _)));
            return is_there.then_some(Wish::Remove { what: vec![what] });
        }
        let from = start + phrase(start, CLEAR)?;
        let cut = (from + 1..end).find(|at| phrase(*at, &["of all", "of", "from"]).is_some())?;
        let mut reader = Reader { at: from, ..*self };
        let place = reader.anchor(cut).ok().filter(|_| reader.at == cut)?;
        let what = self.one_of(cut + phrase(cut, &["of all", "of", "from"])?, end).ok()?;
        let relation = match place {
            Anchor::Street(_, roads) => Stands::OnStreet(roads),
            Anchor::Thing(area) => Stands::To(Relation::Inside, Box::new(area)),
            _ => return None,
        };
        let what = Reference { relation: Some(relation), count: Count::All, ..what };
        Some(Wish::Remove { what: vec![what] })
    }
}

/// Whether what borders a thing stands all around it: streets and waters are bordered along their length.
fn goes_round(anchor: &Anchor) -> bool {
    const WATERS: &[&str] = &["river", "canal", "stream", "brook", "quay", "shore", "bank"];
    let Anchor::Thing(thing) = anchor else { return false };
    let text = thing.text.to_lowercase();
    !text.split(' ').any(|word| WATERS.contains(&word))
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    let dress = DRESS.iter().flat_map(|(words, _)| *words).copied();
    dress.chain(CLEAR.iter().copied()).flat_map(|phrase| phrase.split(' '))
}
