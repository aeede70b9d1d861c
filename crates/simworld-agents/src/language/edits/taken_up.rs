//! What takes up things that were told of ([`super::sets_told`]), with the things themselves in the place of the words for them: "delete the
//! middle one and paint the other two", "put a suitcase beside that car", "in place of the bigger one I want a flower pot".
//!
//! Where it is not clear which of them is meant, or one that is new may be, the words stay as they are.

use simworld_core::id::EntityId;

use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{longest, longest_phrase};
use super::super::numbers;
use super::super::phrases::Phrases;
use super::forms::word_at;
use super::parse::Reader;
use super::resolve::Finder;
use super::sets_told::{Role, Told};
use super::stood::point_at;
use super::words::{VERBS, Verb};

/// The others, whatever they are.
#[rustfmt::skip]
const OTHERS: &Phrases = &Phrases::of(&["the others", "all the others", "all others", "all of the others", "the other ones", "the remaining ones", "the rest", "the rest of them", "all the rest", "any others"]);
/// The only other one.
const OTHER: &Phrases = &Phrases::of(&["the other one", "the other", "the remaining one"]);
/// Before so many others.
const SO_MANY: &Phrases = &Phrases::of(&["the other", "the remaining", "all the other"]);
/// Words for one thing that was told of.
const IT: &Phrases = &Phrases::of(&["it", "that one", "this one", "that very one", "him", "her"]);
/// Words for several.
#[rustfmt::skip]
const THEM: &Phrases = &Phrases::of(&["them", "both of them", "all of them", "all of these", "all of those", "both of these", "both of those", "all three", "all four", "each of them", "every one of them", "those", "these"]);
/// By these something new may be spoken of, or something that is not of the set.
const OPEN: &[&str] = &["one", "ones", "another", "others", "other", "where"];
/// Before what is gone from where something new is to stand.
#[rustfmt::skip]
const IN_PLACE: &Phrases = &Phrases::of(&["in place of", "in the place of", "instead of", "in the stead of", "in lieu of", "at the place of", "on the spot of", "where once was", "to replace"]);
/// That something new is wanted, behind its place.
#[rustfmt::skip]
const WANTED: &Phrases = &Phrases::of(&["i want", "i would like", "id like", "we want", "we would like", "wed like", "i need", "we need", "put", "add", "place", "set", "there should be", "there shall be", "build", "plant", "i wish for", "i want to see", "id like to see", "please put", "please add"]);
/// Between the sentences.
const JOINTS: &Phrases = &Phrases::of(&["and", "but", "so", "then", "now", "and then", "well"]);

/// What was taken up so far.
struct Taken {
    said: Vec<Lexeme>,
    named: Vec<EntityId>,
    /// Whether a pronoun may still be about what was told of first.
    open: bool,
    changed: bool,
}

/// One word for some things.
pub(super) fn those(place: &Lexeme, things: &[EntityId]) -> Lexeme {
    let token = if let [only] = things { Token::Id(*only) } else { Token::Ids(things.to_vec()) };
    Lexeme { token, lemma: None, ..place.clone() }
}

impl Reader<'_> {
    /// The words that follow what was told of, with the things themselves; with the order by which they go, if they do.
    pub(super) fn taken_up(&self, told: &Told, finder: &Finder<'_>) -> Option<Vec<Lexeme>> {
        let mut taken = Taken { said: Vec::new(), named: Vec::new(), open: true, changed: false };
        let mut at = told.from;
        at += longest_phrase(self.lexemes.get(at..)?, JOINTS).unwrap_or(0);
        while at < self.lexemes.len() {
            at += self.take_one(at, told, &mut taken, finder)?;
        }
        if !taken.changed {
            return None;
        }
        let mut said = Vec::new();
        if told.role == Role::Gone {
            let place = self.lexemes.first()?;
            said.push(word_at(place, "remove"));
            said.push(those(place, &told.things));
            said.push(Lexeme { token: Token::Break, lemma: None, ..place.clone() });
        }
        said.extend(placed_first(taken.said));
        Some(said)
    }

    /// Takes one word, or the words for things that were told of; how many they are, none if it is not clear what is meant.
    fn take_one(&self, at: usize, told: &Told, taken: &mut Taken, finder: &Finder<'_>) -> Option<usize> {
        let place = &self.lexemes[at];
        let set = (&told.all[..], told.noun.as_str());
        if told.role == Role::Gone {
            if let Some(words) = self.old_place(at, set, taken, finder) {
                return Some(words);
            }
        } else if let Some((others, words)) = self.others_left(at, told, taken) {
            taken.take(place, &others);
            taken.open = false;
            return Some(words);
        }
        if let Some((one, words)) = self.which_of(at, set, finder) {
            // What is gone is nothing by which something could stand.
            let one = one.filter(|_| told.role == Role::Shown)?;
            taken.take(place, &[one]);
            taken.open = false;
            return Some(words);
        }
        if let Some(words) = self.pronoun(at, told).filter(|_| taken.open && told.role == Role::Shown) {
            taken.take(place, &told.things);
            taken.open = false;
            return Some(words);
        }
        let is_open = self.word(at).is_some_and(|word| OPEN.contains(&word));
        taken.said.push(place.clone());
        (!is_open).then_some(1)
    }

    /// A point for "where the white one was" and "in place of the white one".
    fn old_place(
        &self,
        at: usize,
        set: (&[EntityId], &str),
        taken: &mut Taken,
        finder: &Finder<'_>,
    ) -> Option<usize> {
        let (from, is_where) = match longest_phrase(&self.lexemes[at..], IN_PLACE) {
            Some(words) => (at + words, false),
            None => (at + 1, self.word(at) == Some("where")),
        };
        if from == at + 1 && !is_where {
            return None;
        }
        let (one, words) = self.which_of(from, set, finder)?;
        let end = if is_where {
            self.stood(at).filter(|(stood, _)| *stood == from + words)?.1
        } else {
            from + words
        };
        let point = finder.scene.entity(one?)?.planar();
        taken.said.extend(point_at(&self.lexemes[at], point));
        taken.changed = true;
        Some(end - at)
    }

    /// Those that were not named yet, if others are spoken of here and they are as many as was said.
    fn others_left(&self, at: usize, told: &Told, taken: &Taken) -> Option<(Vec<EntityId>, usize)> {
        let rest = &self.lexemes[at..];
        let is_told = told.things.len() < told.all.len();
        let mut named = taken.named.clone();
        if is_told {
            named.extend_from_slice(&told.things);
        }
        let left: Vec<EntityId> = told.all.iter().copied().filter(|thing| !named.contains(thing)).collect();
        if named.is_empty() || left.is_empty() {
            return None;
        }
        if let Some(before) = longest_phrase(rest, SO_MANY)
            && let Some((count, number)) = numbers::count(&rest[before..])
        {
            let next = before + number;
            let ones = longest_phrase(rest.get(next..)?, &["ones"]);
            let noun = self.noun_at(at + next);
            let words = next + ones.or(noun).unwrap_or(0);
            return (count as usize == left.len()).then_some((left, words));
        }
        if let Some(words) = longest_phrase(rest, OTHERS) {
            return Some((left, words));
        }
        let words = longest_phrase(rest, OTHER)?;
        // "The other car".
        let noun =
            self.noun_at(at + words).filter(|noun| self.word(at + words + noun - 1) == Some(&*told.noun));
        let words = words + noun.unwrap_or(0);
        let ends = noun.is_some() || self.ends_thing_at(at + words);
        (left.len() == 1 && ends).then_some((left, words))
    }

    /// How many words a pronoun has that is about what was told of: "it", "that car", "them".
    fn pronoun(&self, at: usize, told: &Told) -> Option<usize> {
        let rest = &self.lexemes[at..];
        if told.things.len() > 1 {
            let words = longest_phrase(rest, THEM)?;
            let is_alone = self.noun_at(at + words).is_none() && numbers::count(rest.get(words..)?).is_none();
            return is_alone.then_some(words);
        }
        let that = longest_phrase(rest, &["that", "this", "the"]).and_then(|the| {
            let end = the + self.noun_at(at + the)?;
            // "The car next to the bus" may be another.
            let is_that = self.word(at) != Some("the") || rest.get(end).is_none_or(is_mark);
            (is_that && self.word(at + end - 1) == Some(&*told.noun)).then_some(end)
        });
        // "It would be nice" is about nothing.
        let is_idle = longest_phrase(
            rest,
            &["it would be nice", "it is raining", "it would be good", "it would be great", "it looks like"],
        );
        that.or_else(|| longest_phrase(rest, IT)).filter(|_| is_idle.is_none())
    }
}

impl Taken {
    fn take(&mut self, place: &Lexeme, things: &[EntityId]) {
        self.said.push(those(place, things));
        self.named.extend_from_slice(things);
        self.changed = true;
    }
}

/// "At (-6, 5) I want a flower pot" is an order to put one there.
fn placed_first(said: Vec<Lexeme>) -> Vec<Lexeme> {
    const POINT: usize = 6;
    let is_point = said.len() > POINT
        && matches!(&said[0].token, Token::Word(word) if word == "at")
        && said[1].token == Token::Open
        && said[POINT - 1].token == Token::Close;
    if !is_point {
        return said;
    }
    let comma = usize::from(is_mark(&said[POINT]));
    let from = POINT + comma;
    let wanted = longest_phrase(&said[from..], WANTED);
    let verb = longest(&said[from..], &VERBS)
        .filter(|(verb, _)| matches!(verb, Verb::Add | Verb::Put))
        .map(|(_, words)| words);
    let Some(words) = wanted.or(verb) else { return said };
    let thing = from + words;
    let end = (thing..said.len()).find(|at| is_mark(&said[*at])).unwrap_or(said.len());
    let mut told = vec![word_at(&said[0], "put")];
    told.extend_from_slice(&said[thing..end]);
    told.extend_from_slice(&said[..POINT]);
    told.extend_from_slice(&said[end..]);
    told
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    [OTHERS, SO_MANY, THEM, IN_PLACE, WANTED].into_iter().flatten().flat_map(|phrase| phrase.split(' '))
}
