//! New things of which is told behind a mark how many there are, of what colour each is, or where each of them goes: "two saplings
//! by the pine, one to its left and one to its right", "tents behind both cottages, two each", "cones round the hydrant, eight".

use super::super::clause::Count;
use super::super::lexer::is_mark;
use super::super::lexicon::{longest, longest_phrase};
use super::super::numbers;
use super::super::paint::PAINTS;
use super::super::phrases::Phrases;
use super::parse::{Reader, joint};
use super::wish::{Anchor, NewThing, Where, Wish};
use simworld_core::scene::Relation;

/// That so many are for each of what they stand by.
#[rustfmt::skip]
const EACH: &Phrases = &Phrases::of(&["each", "apiece", "for each", "per piece", "to each", "each one", "for each of them", "for every one", "at each", "by each", "respectively each", "per head", "each please"]);
/// Behind a number of what was named before.
#[rustfmt::skip]
const OF_THEM: &Phrases = &Phrases::of(&["of them", "of those", "of these", "in all", "in total", "altogether", "pieces", "in number", "should do", "will do", "would do", "say", "please", "of each", "lengths",
    "of the things", "or so", "at least", "if you can", "are enough", "is enough", "in total please", "items", "units", "exactly"]);
/// Sides of what was named before, without a word of place.
#[rustfmt::skip]
const SIDES: &[(&[&str], Relation)] = &[
    (&["left", "on the left", "to the left", "to its left", "on its left", "to his left", "to her left", "at left", "stage left", "on his left", "on her left"], Relation::LeftOf),
    (&["right", "on the right", "to the right", "to its right", "on its right", "to his right", "to her right", "at right", "stage right", "on his right", "on her right"], Relation::RightOf),
    (&["in front", "front", "before it", "at the front", "ahead", "in front of it"], Relation::InFrontOf),
    (&["behind", "at the back", "back", "behind it", "in the back", "at the rear"], Relation::Behind),
];

impl Reader<'_> {
    /// New things, and behind a mark which of them goes where, or how many they are.
    pub(super) fn shared_out(&self, start: usize, end: usize) -> Option<Vec<Vec<Wish>>> {
        let end = self.before_politeness(start, end);
        (start + 1..end).rev().filter(|at| is_mark(&self.lexemes[*at])).find_map(|mark| {
            if !is_count(&self.lexemes[mark + 1..end])
                && longest(&self.lexemes[mark + 1..end], PAINTS).is_none()
            {
                return None;
            }
            let mut wishes = self.read_plainly(&self.lexemes[start..mark])?;
            let [Wish::Add { things, at }] = &wishes.pop()?[..] else { return None };
            let [thing] = &things[..] else { return None };
            let shares = self.shares(thing, at, mark + 1, end)?;
            wishes.extend(shares.into_iter().map(|wish| vec![wish]));
            Some(wishes)
        })
    }

    /// What is told of new things behind a mark.
    fn shares(&self, thing: &NewThing, at: &[Where], from: usize, end: usize) -> Option<Vec<Wish>> {
        let rest = &self.lexemes[from..end];
        let add = |thing: NewThing, at: Vec<Where>| Wish::Add { things: vec![thing], at };
        if let Some((paint, words)) = longest(rest, PAINTS) {
            let thing = NewThing { paint: Some(paint), ..thing.clone() };
            return (words == rest.len()).then(|| vec![add(thing, at.to_vec())]);
        }
        let (count, words) = any_count(rest)?;
        let behind = from + words;
        let counted = NewThing { count, many: false, ..thing.clone() };
        if behind == end || longest_phrase(&self.lexemes[behind..end], OF_THEM) == Some(end - behind) {
            return (count > 1).then(|| vec![add(counted, at.to_vec())]);
        }
        if longest_phrase(&self.lexemes[behind..end], EACH) == Some(end - behind) {
            return Some(at.iter().map(|place| add(counted.clone(), vec![at_all(place.clone())])).collect());
        }
        let mut shares = Vec::new();
        let mut all = 0;
        let mut next = from;
        while next < end {
            let stop = (next + 1..end).find(|at| self.next_share(*at, end).is_some()).unwrap_or(end);
            let (count, wish) = self.share(thing, at, next, stop)?;
            all += count;
            shares.push(wish);
            next = self.next_share(stop, end).unwrap_or(end);
        }
        (shares.len() > 1 && (thing.count <= 1 || thing.count == all)).then_some(shares)
    }

    /// Where the next share begins, if one ends here.
    fn next_share(&self, at: usize, end: usize) -> Option<usize> {
        let mut next = at;
        while next < end
            && let Some(words) = joint(&self.lexemes[next..end])
        {
            next += words;
        }
        (next > at && next < end && is_count(&self.lexemes[next..end])).then_some(next)
    }

    /// "One to its left", "one red", "two by the clinic".
    fn share(&self, thing: &NewThing, at: &[Where], from: usize, end: usize) -> Option<(u32, Wish)> {
        let (count, words) = any_count(&self.lexemes[from..end])?;
        let mut next = from + words;
        let mut thing = NewThing { count, many: false, ..thing.clone() };
        if let Some((paint, words)) = longest(&self.lexemes[next..end], PAINTS) {
            (thing.paint, next) = (Some(paint), next + words);
            next += longest_phrase(&self.lexemes[next..end], &["one", "ones"]).unwrap_or(0);
        } else if longest_phrase(
            &self.lexemes[next..end],
            &["any colour", "any color", "of any colour", "in any colour"],
        ) == Some(end - next)
        {
            next = end;
        }
        let rest = &self.lexemes[next..end];
        let mut anchor = at.iter().find_map(Where::anchor);
        let places = if rest.is_empty() {
            at.to_vec()
        } else if let Some((relation, words)) = longest(rest, SIDES)
            && words == rest.len()
        {
            vec![Where::To(relation, anchor.unwrap_or(Anchor::It))]
        } else {
            let mut places = self.places_to(next, end)?;
            for place in &mut places {
                place.means(&mut anchor);
            }
            places
        };
        Some((count, Wish::Add { things: vec![thing], at: places }))
    }
}

/// A number of things, one among them.
fn any_count(lexemes: &[super::super::lexer::Lexeme]) -> Option<(u32, usize)> {
    if let Some(found) = numbers::count(lexemes) {
        return Some(found);
    }
    longest_phrase(
        lexemes,
        &[
            "one",
            "just one",
            "another",
            "another one",
            "the one",
            "the other",
            "the other one",
            "the first",
            "the second",
            "a second",
            "the third",
        ],
    )
    .map(|words| (1, words))
}

fn is_count(lexemes: &[super::super::lexer::Lexeme]) -> bool {
    any_count(lexemes).is_some()
}

/// "Behind both cottages" is behind each of them.
fn at_all(mut place: Where) -> Where {
    if let Some(Anchor::Thing(anchor)) = place.anchor_mut()
        && !matches!(anchor.count, Count::One)
    {
        anchor.count = Count::All;
    }
    place
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    let sides = SIDES.iter().flat_map(|(words, _)| *words).copied();
    EACH.iter().chain(OF_THEM).copied().chain(sides).flat_map(|phrase| phrase.split(' '))
}
