//! Complaints that leave to the listener what is to be done: "the statue is too small", "the sign is too close to the kiosk",
//! "there is no bench near the fountain". They are read so only where a sentence asks for nothing else.

use simworld_core::scene::Relation;

use super::super::clause::Reference;
use super::super::lexicon::{longest, longest_phrase};
use super::super::phrases::Phrases;
use super::parse::Reader;
use super::wish::{Where, Wish};

/// What is wrong with a thing.
#[derive(Clone, Copy)]
enum Wrong {
    /// Its size, which is to be so many times what it is.
    Size(f64),
    /// It is to stand so to another.
    Stands(Relation),
    /// It looks the wrong way.
    Turned,
}

#[rustfmt::skip]
const WRONG: &[(&[&str], Wrong)] = &[
    (&["too small", "too little", "too tiny", "too short", "too low", "not big enough", "not large enough", "not tall enough", "not high enough",
        "undersized"], Wrong::Size(1.5)),
    (&["too big", "too large", "too tall", "too high", "too huge", "not small enough", "oversized", "too bulky"], Wrong::Size(1.0 / 1.5)),
    (&["too close to", "too near", "too near to"], Wrong::Stands(Relation::FarFrom)),
    (&["too far from", "too far away from", "too distant from", "not close enough to", "not near enough to", "too far off from"], Wrong::Stands(Relation::Near)),
    (&["facing the wrong way", "the wrong way round", "the wrong way around", "facing backwards", "back to front", "backwards", "looking the wrong way",
        "faces the wrong way", "looks the wrong way", "turned the wrong way"], Wrong::Turned),
];
/// Between the thing and what is wrong with it.
#[rustfmt::skip]
const IS: &[&str] = &["is", "are", "looks", "look", "seems", "seem", "stands", "sits", "a", "bit", "little", "way", "far", "much", "just", "rather", "really", "still",
    "simply", "somewhat", "quite", "feels", "tad", "appears", "lot", "i", "think", "find", "clearly", "standing", "parked", "placed"];
/// That there is none.
#[rustfmt::skip]
const NONE: &Phrases = &Phrases::of(&["there is no", "theres no", "there are no", "there isnt a", "there isnt any", "there arent any", "why is there no", "why are there no", "there is not a",
    "there is not a single", "there isnt a single", "how come there is no", "how come theres no", "how come there are no", "why cant i see a", "there isnt", "why isnt there a", "why is not there a", "why is there not a", "why are there not any", "there is not any", "there are not any", "there is not enough", "why arent there any", "i see no", "where is the", "i miss a",
    "i cant see a", "i cannot find a", "i cant find a", "what is missing is a", "whats missing is a", "all thats missing is a", "all that is missing is a", "missing", "i am missing a",
    "im missing a", "we are missing a", "were missing a", "we lack a", "we are lacking a", "we are short of a", "we have no", "we are short a", "no"]);

impl Reader<'_> {
    /// A sentence that is a complaint, with remarks before it or without.
    pub(super) fn complaint(&self) -> Option<Vec<Vec<Wish>>> {
        #[rustfmt::skip]
        const MEND: &Phrases = &Phrases::of(&["fix that", "fix it", "fix this", "change that", "please fix that", "do something about it", "do something about that", "sort it out", "sort that out",
            "can you fix that", "could you fix that", "please change that", "lets fix that", "lets change that", "make it so", "that should change", "mend that", "remedy that",
            "can we fix that", "turn it", "turn him", "turn her", "turn them", "rotate it", "turn it please", "turn it around", "help", "that needs fixing", "that must change", "can you help", "can you do something about it", "do something", "correct that", "put that right"]);
        let all = self.before_politeness(0, self.lexemes.len());
        let mend = (1..all).find(|at| longest_phrase(&self.lexemes[*at..all], MEND) == Some(all - at));
        let end = self.before_politeness(0, mend.unwrap_or(all));
        let starts = (0..end).filter(|at| *at == 0 || self.is_joint(at - 1));
        starts.take(6).find_map(|from| {
            if from > 0 && !self.is_remark(0, from - 1) {
                return None;
            }
            let wish = self
                .wrong(from, end)
                .or_else(|| self.none_there(from, end))
                .or_else(|| self.has_none(from, end))?;
            Some(vec![vec![wish]])
        })
    }

    fn wrong(&self, from: usize, end: usize) -> Option<Wish> {
        (from + 1..end).find_map(|cut| {
            let small =
                (cut..end).take_while(|at| self.word(*at).is_some_and(|word| IS.contains(&word))).count();
            let at = cut + small;
            let (wrong, words) = longest(&self.lexemes[at..end], WRONG).filter(|_| small > 0)?;
            let what: Vec<Reference> = self.things(from, cut).ok().filter(|_| self.is_definite(from))?;
            let behind = at + words;
            match wrong {
                Wrong::Size(factor) => (behind == end).then_some(Wish::Scale { what, factor }),
                Wrong::Turned => {
                    (behind == end).then_some(Wish::Rotate { what, angle: std::f64::consts::PI })
                }
                Wrong::Stands(relation) => {
                    let mut reader = Reader { at: behind, ..self.up_to(end) };
                    let anchor = reader.anchor(end).ok().filter(|_| reader.at >= end)?;
                    Some(Wish::Move { what, at: vec![Where::To(relation, anchor)] })
                }
            }
        })
    }

    fn none_there(&self, from: usize, end: usize) -> Option<Wish> {
        let words = longest_phrase(&self.lexemes[from..end], NONE)?;
        let mut reader = Reader { at: from + words, ..self.up_to(end) };
        let thing = reader.new_thing(end).ok()?;
        let at = self.places_to(reader.at, end)?;
        Some(Wish::Add { things: vec![thing], at })
    }
}

impl Reader<'_> {
    /// "The bus stop has no bin": it lacks one.
    fn has_none(&self, from: usize, end: usize) -> Option<Wish> {
        const HAS_NO: &[&str] = &[
            "has no",
            "have no",
            "has got no",
            "doesnt have a",
            "doesnt have any",
            "does not have a",
            "has not got a",
            "hasnt got a",
        ];
        let (cut, words) = (from + 1..end)
            .find_map(|cut| longest_phrase(&self.lexemes[cut..end], HAS_NO).map(|words| (cut, words)))?;
        let thing = self
            .one_of(from, cut)
            .ok()
            .filter(|thing| self.is_certain(from) && !super::says::is_it(thing))?;
        let mut reader = Reader { at: cut + words, ..self.up_to(end) };
        let new = reader.new_thing(end).ok().filter(|_| reader.at >= end)?;
        Some(Wish::Add { things: vec![new], at: vec![Where::By(super::wish::Anchor::Thing(thing))] })
    }
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    let wrong = WRONG.iter().flat_map(|(words, _)| *words).copied();
    wrong.chain(IS.iter().chain(NONE).copied()).flat_map(|phrase| phrase.split(' '))
}
