//! What is left of several things when some were named: "paint the red bench white and the others green", "the black car stays, remove the
//! other two", "close the lab's door and lock the rest".
//!
//! Which they are is found in the scene, and put into the words before any order is carried out, so that each order may be read alone.

use simworld_core::id::EntityId;
use simworld_core::scene::EntityKind;

use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{category, longest, longest_phrase};
use super::super::numbers;
use super::super::paint::PAINTS;
use super::super::phrases::Phrases;
use super::follow::plural_of;
use super::forms::{word_at, words_at};
use super::parse::Reader;
use super::resolve::Finder;
use super::words::{VERBS, Verb, WAYS};

/// All others.
#[rustfmt::skip]
const OTHERS: &Phrases = &Phrases::of(&["the others", "all the others", "all others", "all of the others", "the other ones", "the remaining ones", "all the other ones", "all other ones", "the rest", "all the rest", "the rest of them",
    "the rest of those", "all the rest of them", "every other one", "any others"]);
/// The only other one.
const OTHER: &Phrases = &Phrases::of(&["the other one", "the other", "the remaining one"]);
/// Before so many others, or before their noun.
#[rustfmt::skip]
const BEFORE: &Phrases = &Phrases::of(&["the other", "the remaining", "all the other", "all other", "all remaining", "all the remaining", "the rest of the", "the rest of these", "the rest of those", "all of the other"]);
/// As many words name a thing at most.
const LONGEST: usize = 8;

/// Words that speak of others.
struct Others {
    /// Where they begin, and how many they are.
    at: usize,
    words: usize,
    /// How many others there are, if that is said.
    count: Option<usize>,
    /// What they are called, in the singular, if that is said.
    noun: Option<Vec<Lexeme>>,
}

/// What was named of some things before others are spoken of.
struct Named {
    things: Vec<EntityId>,
    /// What all of them are called, in the singular.
    noun: Vec<Lexeme>,
}

impl Reader<'_> {
    /// The words with what is left in the place of "the others".
    pub(super) fn with_what_is_left(&self, finder: &Finder<'_>) -> Option<Vec<Lexeme>> {
        let Others { at, words, count, noun } = (2..self.lexemes.len()).find_map(|at| self.others_at(at))?;
        let named = self.named_before(at, noun.as_deref(), finder)?;
        let place = &self.lexemes[at];
        let (last, head) = named.noun.split_last()?;
        let Token::Word(last) = &last.token else { return None };
        let all: Vec<Lexeme> = words_at(place, "all the")
            .chain(head.iter().cloned())
            .chain([word_at(place, &plural_of(last))])
            .collect();
        let memo = super::memo::Memo::default();
        let all = Reader { memo: &memo, ..self.over(&all) }.one_of(0, all.len()).ok()?;
        let mut left = finder.all(&[all]).ok()?;
        left.retain(|thing| !named.things.contains(thing));
        if left.is_empty() || count.is_some_and(|count| count != left.len()) {
            return None;
        }
        let end = self.lexemes.get(at + words - 1)?.end;
        let token = if let [only] = left[..] { Token::Id(only) } else { Token::Ids(left) };
        let mut lexemes = self.lexemes.to_vec();
        lexemes.splice(at..at + words, [Lexeme { token, lemma: None, end, ..place.clone() }]);
        Some(lexemes)
    }

    /// Whether others are spoken of here.
    fn others_at(&self, at: usize) -> Option<Others> {
        let rest = &self.lexemes[at..];
        if let Some(before) = longest_phrase(rest, BEFORE) {
            let (count, number) = numbers::count(&rest[before..]).unwrap_or((0, 0));
            let count = (number > 0).then_some(count as usize);
            let next = before + number;
            if let Some((_, words)) = category(&rest[next..]) {
                let noun = self.last_noun(at + next, at + next + words)?;
                let singular =
                    noun.last().map(|last| &last.token) == rest.get(next + words - 1).map(|last| &last.token);
                // "The other bench" is one of them.
                let one = if singular { Some(1) } else { count };
                return Some(Others { at, words: next + words, count: one, noun: Some(noun) });
            }
            let ones = longest_phrase(&rest[next..], &["ones"]).unwrap_or(0);
            if number > 0 && self.ends_thing_at(at + next + ones) {
                return Some(Others { at, words: next + ones, count, noun: None });
            }
        }
        if let Some(words) = longest_phrase(rest, OTHERS).filter(|words| self.ends_thing_at(at + words)) {
            return Some(Others { at, words, count: None, noun: None });
        }
        let words = longest_phrase(rest, OTHER).filter(|words| self.ends_thing_at(at + words))?;
        Some(Others { at, words, count: Some(1), noun: None })
    }

    /// Whether a thing may end here: with a mark, a joint, a place, a colour, or a small word behind a subject.
    pub(super) fn ends_thing_at(&self, at: usize) -> bool {
        let Some(next) = self.lexemes.get(at) else { return true };
        is_mark(next)
            || self.is_joint(at)
            || self.is_place(at)
            || longest(&self.lexemes[at..], PAINTS).is_some()
            || self.word(at).is_some_and(|word| {
                super::says::is_between(word)
                    || matches!(
                        word,
                        "towards"
                            | "to"
                            | "with"
                            | "by"
                            | "as"
                            | "go"
                            | "goes"
                            | "stay"
                            | "stays"
                            | "alone"
                            | "please"
                            | "into"
                            | "away"
                            | "too"
                            | "face"
                            | "have"
                            | "has"
                    )
            })
    }

    /// The things of one kind that are named before, none of them as where something goes.
    fn named_before(&self, before: usize, noun: Option<&[Lexeme]>, finder: &Finder<'_>) -> Option<Named> {
        let mut found: Option<Named> = None;
        let mut at = 0;
        while at < before {
            // What is new has others of its own: "put a bin here and the other there".
            let adds = longest(&self.lexemes[at..before], &VERBS).is_some_and(|(verb, words)| {
                matches!(verb, Verb::Add | Verb::Put) && !self.is_definite(at + words)
            });
            if adds && noun.is_none() {
                return None;
            }
            if !self.is_certain(at) || self.is_behind_place(at) {
                at += 1;
                continue;
            }
            let noun = found.as_ref().map(|named| named.noun.as_slice()).or(noun);
            let Some((things, own, end)) = self.mentioned_at(at, before, noun, finder) else {
                at += 1;
                continue;
            };
            found.get_or_insert(Named { things: Vec::new(), noun: own }).things.extend(things);
            at = end;
        }
        found
    }

    /// What is named from here on, if it is of some kind, what that is called, and where the words end.
    fn mentioned_at(
        &self,
        at: usize,
        before: usize,
        noun: Option<&[Lexeme]>,
        finder: &Finder<'_>,
    ) -> Option<(Vec<EntityId>, Vec<Lexeme>, usize)> {
        let longest_end = before.min(at + LONGEST);
        (at + 1..=longest_end).rev().find_map(|end| {
            if is_mark(&self.lexemes[end - 1]) {
                return None;
            }
            let own = self.last_noun(at, end);
            let is_same = |own: &[Lexeme]| {
                noun.is_none_or(|noun| {
                    noun.last().map(|word| &word.token) == own.last().map(|word| &word.token)
                })
            };
            let (what, called) = match (own, noun) {
                (Some(own), _) if is_same(&own) => (self.one_of(at, end).ok()?, own),
                // "The blue one" behind "the red bench".
                (None, Some(noun)) if self.word(end - 1) == Some("one") => {
                    let words: Vec<Lexeme> = self.lexemes[at..end - 1].iter().chain(noun).cloned().collect();
                    let memo = super::memo::Memo::default();
                    (Reader { memo: &memo, ..self.over(&words) }.one_of(0, words.len()).ok()?, noun.to_vec())
                }
                (None, _) => {
                    let what = self.one_of(at, end).ok()?;
                    let ids = finder.all(std::slice::from_ref(&what)).ok()?;
                    let people = words_at(&self.lexemes[at], "person").collect::<Vec<_>>();
                    let is_somebody = |id: &EntityId| {
                        finder.scene.entity(*id).is_some_and(|thing| thing.kind == EntityKind::Person)
                    };
                    (ids.iter().all(is_somebody) && is_same(&people)).then_some((what, people))?
                }
                _ => return None,
            };
            let things = finder.all(std::slice::from_ref(&what)).ok()?;
            Some((things, called, end))
        })
    }

    /// Whether a word of place ends just before.
    fn is_behind_place(&self, at: usize) -> bool {
        (at.saturating_sub(4)..at)
            .any(|from| longest(&self.lexemes[from..at], &WAYS).is_some_and(|(_, words)| from + words == at))
    }
}

/// "Only the red chair stays, remove the others" says the same twice.
pub(super) fn others_too(lexemes: &mut Vec<Lexeme>) {
    #[rustfmt::skip]
    const TOO: &Phrases = &Phrases::of(&["remove the others", "delete the others", "remove the rest", "delete the rest", "take the others away", "take the rest away", "get rid of the others", "get rid of the rest", "the others go", "the rest go", "the rest goes",
        "the others can go", "the rest can go", "the others must go", "the rest must go", "the others have to go", "the rest has to go", "clear the rest", "clear the others", "clear away the rest", "remove all the others", "remove all others",
        "delete all others", "lose the rest", "lose the others", "all others go", "all the others go", "ditch the rest", "ditch the others", "bin the rest", "scrap the rest", "away with the rest", "away with the others"]);
    let Some(only) =
        (0..lexemes.len()).find(|at| longest_phrase(&lexemes[*at..], &["only", "keep", "just"]).is_some())
    else {
        return;
    };
    let stop = lexemes.iter().rposition(|lexeme| !is_mark(lexeme)).map_or(0, |last| last + 1);
    // In any words for it: "fell the others", "cart off the rest".
    let removes = |at: usize| {
        longest(&lexemes[at..stop], &VERBS).is_some_and(|(verb, words)| {
            verb == Verb::Remove
                && longest_phrase(
                    &lexemes[at + words..stop],
                    &["the others", "the rest", "all others", "all the others"],
                ) == Some(stop - at - words)
        })
    };
    let found = (only + 2..stop)
        .find(|at| longest_phrase(&lexemes[*at..stop], TOO) == Some(stop - at) || removes(*at));
    if let Some(at) = found {
        let before = lexemes[..at].iter().rev().take_while(|lexeme| {
            is_mark(lexeme) || matches!(&lexeme.token, Token::Word(word) if word == "and" || word == "so")
        });
        let from = at - before.count();
        lexemes.truncate(from);
    }
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    [OTHERS, OTHER, BEFORE].into_iter().flatten().flat_map(|phrase| phrase.split(' '))
}
