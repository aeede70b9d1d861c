//! What leaves out what was said before: "and one by the clinic too", "the same for the bench", "the chair next to the tree"
//! behind "move the bench next to the fountain and".

use super::super::clause::{Reference, Target};
use super::super::lexer::{Lexeme, Token};
use super::super::lexicon::{category, longest, longest_phrase};
use super::super::numbers;
use super::super::phrases::Phrases;
use super::forms::{word_at, words_at};
use super::parse::Reader;
use super::wish::{Anchor, NewThing, Where, Wish};
use super::words::WAYS;

/// What stands for a new thing as the one before.
#[rustfmt::skip]
const ONE_MORE: &Phrases = &Phrases::of(&["one", "another one", "one more", "another", "a second one", "a third one", "the other one", "the other", "the same",
    "the same thing", "the same again", "a second", "a third", "a fourth", "a fifth", "and another", "one of those", "one of them", "the next one",
    "the next", "the last one", "the last", "the second", "the third", "the second one", "the third one", "a fourth one", "a last one", "yet another",
    "same", "ditto", "same again", "a further one", "a further", "one as well", "one also", "another of those", "one of these", "just one more",
    "a new one", "the same one", "one like it", "another like it", "one just like it", "another one like it", "another one just like it", "one more like it", "the first", "the first one", "a final one", "the final one",
    "it again", "likewise one", "one too", "an identical one", "its twin", "a twin"]);
/// Before several such: "two more", "three of them".
const MORE: &Phrases = &Phrases::of(&[
    "more",
    "more of them",
    "more of those",
    "of them",
    "of those",
    "others",
    "more like it",
    "of the same",
]);
/// What says that the same is to be done to something else.
#[rustfmt::skip]
const SAME_FOR: &Phrases = &Phrases::of(&["the same for", "the same with", "the same to", "same for", "same with", "same to", "do the same to", "do the same for",
    "do the same with", "ditto for", "the same goes for", "same goes for", "likewise for", "likewise", "do that to", "do that for", "do that with",
    "do it to", "do so with", "do so to", "repeat that for", "repeat this for", "repeat for", "repeat with", "repeat that with", "that goes for",
    "the same applies to", "same thing for", "same thing with", "same thing to", "do likewise with", "do likewise to", "do the same thing to",
    "do the same thing for", "do the same thing with", "so should", "so must", "and so should", "as for", "the same treatment for", "ditto",
    "similarly for", "same treatment for", "and for", "and to", "same deal with", "same deal for", "and with"]);
/// Behind it, that it is so too.
#[rustfmt::skip]
const TOO: &Phrases = &Phrases::of(&["too", "as well", "also", "likewise", "the same", "do too", "does too", "should too", "please", "too please", "as well please",
    "the same way", "should be too", "should as well", "is too", "gets the same", "get the same", "gets the same treatment", "gets one too",
    "in the same way", "similarly"]);
/// That somebody gets one too.
#[rustfmt::skip]
const GETS_ONE: &Phrases = &Phrases::of(&["gets one", "gets another", "gets one too", "gets one as well", "needs one", "needs one too", "wants one", "wants one too",
    "could use one", "should have one", "should get one", "gets the same", "has to have one", "deserves one", "does too", "get one", "need one",
    "want one", "get one too", "needs one as well", "also gets one", "also needs one", "also wants one", "should get one too", "could do with one"]);

/// What was said before a part of a sentence.
#[derive(Clone, Default)]
pub(super) struct Said {
    /// The last wish that was read.
    pub(super) wish: Option<Wish>,
    /// The last noun of a class, in the singular.
    pub(super) noun: Option<Vec<Lexeme>>,
    /// The place that a remark just before was about.
    pub(super) place: Vec<Where>,
}

impl Reader<'_> {
    /// A part of a sentence that is whole only with what was said before it.
    pub(super) fn follows(&self, said: &Said, end: usize) -> Option<Vec<Vec<Wish>>> {
        let last = said.wish.as_ref();
        let (from, stop) = (self.at, self.before_politeness(self.at, end));
        self.with_noun(said, from, stop)
            .and_then(|order| self.read_anew(&order))
            .or_else(|| self.gapped(said, last?, from, stop))
    }

    /// "Paint the bench red, and the chair": the same, though nobody says "too".
    pub(super) fn same_of(&self, said: &Said, from: usize, end: usize) -> Option<Vec<Vec<Wish>>> {
        let wish = self.same_for(said.wish.as_ref()?, from, end).filter(|_| self.is_certain(from))?;
        Some(vec![vec![wish]])
    }

    /// A part that says no more than where one more of what was made goes, or of what the same holds.
    pub(super) fn more_of_it(&self, said: &Said, end: usize) -> Option<Vec<Vec<Wish>>> {
        let last = said.wish.as_ref()?;
        let from = self.at;
        let stop = self.before_politeness(from, end);
        let one = |wish| Some(vec![vec![wish]]);
        if let Some(words) = longest_phrase(&self.lexemes[from..stop], SAME_FOR)
            && let Some(wish) = self.same_for(last, from + words, stop)
        {
            return one(wish);
        }
        let bare = (from + 1..=stop)
            .find(|at| *at == stop || longest_phrase(&self.lexemes[*at..stop], TOO) == Some(stop - at))
            .unwrap_or(stop);
        if let Wish::Add { things, at } = last
            && let Some(thing) = things.last()
            && let Some(wish) = self.one_more(thing, at, from, bare)
        {
            return one(wish);
        }
        if let Wish::Add { things, .. } = last
            && let Some(thing) = things.last()
            && let Some(wish) = self.gets_one(thing, from, stop)
        {
            return one(wish);
        }
        let is_said = |word: &str| ["too", "also", "well", "likewise"].contains(&word);
        let too = (stop..end).any(|at| self.word(at).is_some_and(is_said));
        // "And a table too" is one more thing, and not where the first goes.
        let is_certain = !matches!(last, Wish::Add { .. }) || self.is_certain(from);
        let same = if is_certain && (bare < stop || too) { self.same_for(last, from, bare) } else { None };
        same.and_then(one)
    }

    /// The words with the noun that was said before in the place of "one": "the white one" behind cars is the white car.
    pub(super) fn with_noun(&self, said: &Said, from: usize, end: usize) -> Option<Vec<Lexeme>> {
        let alike = self.noun_of_a_place(from, end);
        let noun = alike.as_ref().or(said.noun.as_ref())?;
        let mut words = Vec::with_capacity(end - from + 1);
        let mut changed = false;
        for at in from..end {
            let lexeme = &self.lexemes[at];
            // "Could you add two?"
            if at > from && self.is_count_of_those(at, end) {
                let Token::Word(word) = &noun.last()?.token else { return None };
                words.push(lexeme.clone());
                words.extend(noun[..noun.len() - 1].iter().map(|word| Lexeme {
                    start: lexeme.start,
                    end: lexeme.end,
                    ..word.clone()
                }));
                let plural = if word.ends_with('s') { word.clone() } else { plural_of(word) };
                words.push(word_at(lexeme, &plural));
                changed = true;
                continue;
            }
            let stands_for = match self.word(at) {
                Some("one") => {
                    // "One of them" is a number, and so is "one bench".
                    let is_number =
                        category(&self.lexemes[at + 1..end]).is_some() || self.word(at + 1) == Some("of");
                    !is_number && at > from
                }
                Some("ones") => true,
                _ => false,
            };
            if stands_for {
                changed = true;
                let ones = self.word(at) == Some("ones");
                let (last, head) = noun.split_last()?;
                // "Put one in front" is one that is not there yet.
                let is_new = at > from
                    && self.word(at) == Some("one")
                    && longest(&self.lexemes[at - 1..at], &super::words::VERBS).is_some_and(|(verb, _)| {
                        matches!(
                            verb,
                            super::words::Verb::Add | super::words::Verb::Put | super::words::Verb::Take
                        )
                    });
                // "Our kids are mad about giraffes, put one here" makes no kid.
                if is_new && is_crowd(noun) {
                    return None;
                }
                if is_new {
                    words.push(word_at(lexeme, "a"));
                }
                words.extend(head.iter().map(|word| Lexeme {
                    start: lexeme.start,
                    end: lexeme.end,
                    ..word.clone()
                }));
                let Token::Word(word) = &last.token else { return None };
                words.push(word_at(lexeme, &if ones { plural_of(word) } else { word.clone() }));
            } else {
                words.push(lexeme.clone());
            }
        }
        changed.then_some(words)
    }

    /// "Add two" and no more: so many of what was named before.
    fn is_count_of_those(&self, at: usize, end: usize) -> bool {
        let adds = longest(&self.lexemes[at - 1..at], &super::words::VERBS)
            .is_some_and(|(verb, _)| matches!(verb, super::words::Verb::Add | super::words::Verb::Put));
        let count = numbers::count(&self.lexemes[at..end]).filter(|(_, words)| *words == 1);
        adds && count.is_some() && (at + 1 == end || self.is_place(at + 1))
    }

    /// "Next to the red bench and a lamp next to the blue one": what stands behind the same word of place before.
    fn noun_of_a_place(&self, from: usize, end: usize) -> Option<Vec<Lexeme>> {
        let one =
            (from + 2..end).find(|at| self.word(*at) == Some("one") && self.word(at + 1) != Some("of"))?;
        let way = |at: usize| longest(&self.lexemes[at..end], &WAYS);
        let (own, at) = (from..one)
            .rev()
            .find_map(|at| way(at).filter(|(_, words)| at + words + 1 < one).map(|(own, _)| (own, at)))?;
        self.lexemes.get(at..one).filter(|between| between.len() <= 6)?;
        let before =
            (from..at).find_map(|at| way(at).filter(|(way, _)| *way == own).map(|(_, words)| at + words))?;
        let noun = (before..at.min(before + 4)).find(|at| category(&self.lexemes[*at..end]).is_some())?;
        self.last_noun(noun, end)
    }

    /// The verb of the wish before, where none is said: "... and the chair next to the tree".
    fn gapped(&self, said: &Said, last: &Wish, from: usize, end: usize) -> Option<Vec<Vec<Wish>>> {
        let verbs: &[&str] = match last {
            Wish::Move { .. } => &["move"],
            Wish::Paint { .. } => &["paint"],
            Wish::Scale { .. } | Wish::Resize { .. } => &["make"],
            Wish::Rotate { .. } | Wish::Face { .. } | Wish::FaceCompass { .. } => &["turn", "make"],
            Wish::Swap { .. } => &["swap"],
            // "It deserves a nice name" names nothing once more.
            Wish::Name { .. }
                if longest_phrase(&self.lexemes[from..end], &["it", "he", "she", "they", "its"])
                    .is_none()
                    && self.ends_with_name(from, end) =>
            {
                &["call"]
            }
            Wish::Copy { .. } => &["copy"],
            Wish::Replace { .. } => &["replace"],
            _ => return None,
        };
        let place = self.lexemes.get(from)?;
        let words = self.with_noun(said, from, end).unwrap_or_else(|| self.lexemes[from..end].to_vec());
        let read = |verb: &&str| {
            let order: Vec<Lexeme> = words_at(place, verb).chain(words.iter().cloned()).collect();
            self.read_plainly(&order)
        };
        let mut wishes = verbs.iter().find_map(read)?;
        // "The white car goes behind the clinic, the black one in front of it": of the clinic.
        if let Wish::Move { at, .. } = last
            && let Some(anchor @ Anchor::Thing(_)) = at.iter().find_map(Where::anchor)
        {
            let its = wishes.iter_mut().flatten().flat_map(Wish::places_mut).filter_map(Where::anchor_mut);
            its.filter(|own| own.is_it()).for_each(|own| *own = anchor.clone());
        }
        // The verb that was left out is the same one.
        let same = |wish: &Wish| {
            std::mem::discriminant(wish) == std::mem::discriminant(last)
                || matches!(
                    (wish, last),
                    (
                        Wish::Face { .. } | Wish::FaceCompass { .. } | Wish::Rotate { .. },
                        Wish::Face { .. } | Wish::FaceCompass { .. } | Wish::Rotate { .. }
                    )
                )
        };
        wishes.iter().flatten().all(same).then_some(wishes)
    }

    /// "And the bakery Bready": what is named is written as a name. "The school asked so nicely" names nothing.
    fn ends_with_name(&self, from: usize, end: usize) -> bool {
        let Some(last) = self.lexemes.get(end - 1).filter(|_| end > from) else { return false };
        let written = self.words.get(self.lexemes[from].start..last.end).unwrap_or_default();
        let behind = self.words.get(last.end..).unwrap_or_default();
        let is_to = (from..end).any(|at| matches!(self.word(at), Some("to" | "as" | "into")));
        is_to
            || written.contains(['"', '\'', '“', '”', '‘', '’'])
            || behind.starts_with(['"', '\'', '”', '’'])
            || self.words.get(last.start..).is_some_and(|word| word.starts_with(char::is_uppercase))
    }

    /// The wish before, for something else.
    fn same_for(&self, last: &Wish, from: usize, end: usize) -> Option<Wish> {
        let what = self.things(from, end).ok()?;
        let mut wish = last.clone();
        match &mut wish {
            Wish::Move { what: own, .. }
            | Wish::Remove { what: own }
            | Wish::Rotate { what: own, .. }
            | Wish::Face { what: own, .. }
            | Wish::FaceCompass { what: own, .. }
            | Wish::Paint { what: own, .. }
            | Wish::Resize { what: own, .. }
            | Wish::Scale { what: own, .. } => *own = what,
            Wish::Replace { what: own, .. }
            | Wish::Copy { what: own, .. }
            | Wish::Describe { what: own }
            | Wish::Count { what: own } => {
                let [only] = &what[..] else { return None };
                *own = only.clone();
            }
            Wish::Add { at, .. } => {
                let ([place], [only]) = (&mut at[..], &what[..]) else { return None };
                *place.anchor_mut()? = Anchor::Thing(only.clone());
            }
            _ => return None,
        }
        Some(wish)
    }

    /// "One by the clinic", "two more behind it", "the same behind the bookshop", "a red one here".
    fn one_more(&self, thing: &NewThing, last: &[Where], from: usize, end: usize) -> Option<Wish> {
        let rest = &self.lexemes[from..end];
        let counted = numbers::count(rest).and_then(|(count, words)| {
            let more = longest_phrase(&rest[words..], MORE).unwrap_or(0);
            Some((count, words + more)).filter(|_| more > 0 || self.is_place(from + words))
        });
        let coloured = self.coloured_one(from, end);
        let (count, paint, words) = match (counted, coloured) {
            (Some((count, words)), _) => (count, None, words),
            (None, Some((paint, words))) => (1, Some(paint), words),
            (None, None) => (1, None, longest_phrase(rest, ONE_MORE)?),
        };
        let thing =
            NewThing { count, many: false, paint: paint.or(thing.paint), name: None, ..thing.clone() };
        let at = from + words;
        if at >= end {
            // "And another" stands where the first does.
            return Some(Wish::Add { things: vec![thing], at: last.to_vec() });
        }
        let mut places = self.places_to(at, end)?;
        let mut anchor = last.iter().find_map(Where::anchor);
        for place in &mut places {
            place.means(&mut anchor);
        }
        Some(Wish::Add { things: vec![thing], at: places })
    }

    /// "A red one".
    fn coloured_one(&self, from: usize, end: usize) -> Option<(super::super::paint::Paint, usize)> {
        let article = longest_phrase(&self.lexemes[from..end], &["a", "an", "another", "one"])?;
        let (paint, words) =
            super::super::lexicon::longest(&self.lexemes[from + article..end], super::super::paint::PAINTS)?;
        let one = longest_phrase(&self.lexemes[from + article + words..end], &["one"])?;
        Some((paint, article + words + one))
    }

    /// "Bo gets one too".
    fn gets_one(&self, thing: &NewThing, from: usize, end: usize) -> Option<Wish> {
        let cut =
            (from + 1..end).find(|at| longest_phrase(&self.lexemes[*at..end], GETS_ONE) == Some(end - at))?;
        let anchor = Anchor::Thing(self.one_of(from, cut).ok()?);
        Some(Wish::Add {
            things: vec![NewThing { name: None, ..thing.clone() }],
            at: vec![Where::By(anchor)],
        })
    }

    /// What a remark says is not there, of which one is asked for next: "the school has no bike rack".
    pub(super) fn noun_lacking(&self, from: usize, end: usize) -> Option<Vec<Lexeme>> {
        let no = (from..end).find_map(|at| {
            longest_phrase(
                &self.lexemes[at..end],
                &[
                    "no",
                    "not have a",
                    "not have any",
                    "isnt a",
                    "lacks a",
                    "not a single",
                    "isnt any",
                    "without a",
                    "blocked by the",
                    "obstructed by the",
                    "hidden by the",
                    "covered by the",
                ],
            )
            .map(|words| at + words)
        })?;
        let stop = (no..end)
            .find(|at| {
                super::super::lexer::is_mark(&self.lexemes[*at])
                    || self.is_place(*at)
                    || matches!(
                        self.word(*at),
                        Some(
                            "here"
                                | "there"
                                | "yet"
                                | "anywhere"
                                | "nearby"
                                | "for"
                                | "to"
                                | "and"
                                | "around"
                        )
                    )
            })
            .unwrap_or(end);
        let noun = self.lexemes.get(no..stop).filter(|noun| !noun.is_empty() && noun.len() <= 3)?;
        noun.iter().all(|word| matches!(word.token, Token::Word(_))).then(|| noun.to_vec())
    }

    /// The last noun of a class among the words, in the singular as far as rules go.
    pub(super) fn last_noun(&self, from: usize, end: usize) -> Option<Vec<Lexeme>> {
        // The first noun is what a part is about; nouns behind it belong to its place.
        (from..end).find_map(|at| {
            if let Some(species) = species(&self.lexemes[at]) {
                return Some(vec![word_at(&self.lexemes[at], species)]);
            }
            let (class, words) = category(&self.lexemes[at..end])?;
            // "Paint it green" names no green.
            if longest(&self.lexemes[at..end], super::super::paint::PAINTS)
                .is_some_and(|(_, paint)| paint >= words)
            {
                return None;
            }
            let said = &self.lexemes[at..at + words];
            let Token::Word(last) = &said[words - 1].token else { return None };
            let singular = class
                .words
                .iter()
                .map(|known| known.rsplit(' ').next().unwrap_or(known))
                .find(|known| *known == last || plural_of(known) == *last)
                .unwrap_or(last);
            let mut noun = said.to_vec();
            noun[words - 1] = word_at(&said[words - 1], singular);
            Some(noun)
        })
    }
}

/// The kind of tree that a word is, in the singular, whether or not a tree of the scene is known to be of it.
pub(super) fn species(lexeme: &Lexeme) -> Option<&'static str> {
    const SPECIES: &[&str] = &[
        "oak", "lime", "birch", "pine", "maple", "elm", "ash", "willow", "cedar", "poplar", "chestnut",
        "linden", "spruce", "fir", "beech",
    ];
    let Token::Word(word) = &lexeme.token else { return None };
    SPECIES.iter().copied().find(|one| one == word || *word == plural_of(one))
}

/// Whether a noun is one of people alone.
pub(super) fn is_crowd(noun: &[Lexeme]) -> bool {
    use simworld_core::scene::EntityKind;
    category(noun).is_some_and(|(class, _)| {
        !class.kinds().is_empty() && class.kinds().iter().all(|kind| *kind == EntityKind::Person)
    })
}

/// The plural of a noun as far as rules go.
pub(super) fn plural_of(word: &str) -> String {
    if word.ends_with("sh") || word.ends_with("ch") || word.ends_with('s') || word.ends_with('x') {
        format!("{word}es")
    } else if let Some(stem) = word.strip_suffix('y').filter(|stem| !stem.ends_with(['a', 'e', 'o', 'u'])) {
        format!("{stem}ies")
    } else {
        format!("{word}s")
    }
}

impl Where {
    /// What it is to, if it is to one thing.
    pub(super) fn anchor(&self) -> Option<Anchor> {
        self.clone().anchor_mut().cloned()
    }
}

/// Whether a reference leaves open what it is about.
pub(super) fn is_open(reference: &Reference) -> bool {
    matches!(reference.target, Target::It | Target::Them)
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    [ONE_MORE, MORE, SAME_FOR, TOO, GETS_ONE].into_iter().flatten().flat_map(|phrase| phrase.split(' '))
}
