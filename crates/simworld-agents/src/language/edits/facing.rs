//! Which way something looks, told behind where it stands: "put Bo by the kiosk, facing the museum", "two chairs that look at
//! one another".

use super::super::clause::{Reference, Target};
use super::super::lexer::{Lexeme, is_mark};
use super::super::lexicon::longest_phrase;
use super::super::phrases::Phrases;
use super::forms::{word, word_at};
use super::parse::{Reader, joint};
use super::wish::{Anchor, Where, Wish};

/// Before what is looked at, behind a place.
#[rustfmt::skip]
const LOOKS: &Phrases = &Phrases::of(&["facing", "facing towards", "facing to", "looking at", "looking towards", "looking toward", "looking to", "looking over to", "turned towards", "turned to", "turned to face",
    "turned toward", "pointing at", "pointing towards", "pointing to", "pointed at", "pointed towards", "and face", "and faces", "that faces", "that face", "which faces", "who faces",
    "that looks at", "that looks towards", "that looks toward", "that looks to", "which looks at", "who looks at", "and look at", "and looks at", "and look towards", "and looking at", "to look at",
    "and have it face", "and have him face", "and have her face", "and make it face", "and make him face", "and make her face", "and turn it towards", "and turn him towards", "and turn her towards",
    "and turn it to face", "and turn him to face", "and turn her to face", "and turn it to look at", "and have him look at", "and have her look at", "and have it look at", "and face it at",
    "and orient it towards", "and orient it to", "nose to", "nose towards", "gazing at", "watching", "and have them face", "and turn them towards", "and make them face", "its front to",
    "with its front to", "with its front towards", "and he should look at", "and she should look at", "and it should look at", "and they should look at", "and both look at", "both looking at",
    "both facing", "all facing", "oriented towards", "oriented to", "aimed at", "aiming at", "staring at", "and looks to", "and looks towards", "and should face", "and should look at", "to face",
    "so that it faces", "so it faces", "so that he faces", "so that she faces", "so that they face", "and both turned towards", "both turned towards", "and let him look at", "and let her look at",
    "and let it look at", "and let it face", "and let him face", "and let her face", "that looks over to", "both turned to", "facing at", "and towards"]);
/// That things look at one another.
const MUTUAL: &[&str] = &["each other", "one another", "eachother", "each the other"];

/// "Then set him facing Eve" has him look at her, and puts him nowhere.
pub(super) fn in_plain_words(lexemes: &mut Vec<Lexeme>) {
    const SETS: &[&str] = &["set", "stand", "have", "get", "keep", "leave", "turn"];
    #[rustfmt::skip]
    const FACES: &Phrases = &Phrases::of(&["facing", "facing towards", "facing to", "looking at", "looking towards", "looking toward", "gazing at", "staring at"]);
    let found = (0..lexemes.len()).find_map(|at| {
        let is_told = SETS.contains(&word(lexemes, at))
            && matches!(word(lexemes, at + 1), "it" | "him" | "her" | "them");
        let faces = longest_phrase(lexemes.get(at + 2..)?, FACES).filter(|_| is_told)?;
        let rest = lexemes.get(at + 2 + faces..).unwrap_or_default();
        // "Set them facing each other" is read as it stands.
        let is_open = rest.first().is_none_or(is_mark) || longest_phrase(rest, MUTUAL).is_some();
        (!is_open).then_some((at, faces))
    });
    let Some((at, faces)) = found else { return };
    let place = lexemes[at].clone();
    lexemes.splice(at + 2..at + 2 + faces, [word_at(&place, "face")]);
    lexemes[at] = word_at(&place, "make");
}

impl Reader<'_> {
    /// A wish, and behind it which way what it is about looks.
    pub(super) fn looking(&self, start: usize, end: usize) -> Option<Vec<Vec<Wish>>> {
        let end = self.before_politeness(start, end);
        (start + 2..end).find_map(|at| {
            let words = longest_phrase(&self.lexemes[at..end], LOOKS)?;
            let mut stop = at;
            while stop > start && joint(&self.lexemes[stop - 1..stop]).is_some() {
                stop -= 1;
            }
            let from = at + words;
            // What stands behind the next mark may be the place: "a robot facing the door, two metres in front of it".
            let to = (from..end).find(|at| is_mark(&self.lexemes[*at])).unwrap_or(end);
            let order: Vec<Lexeme> = self.lexemes[start..stop]
                .iter()
                .chain(&self.lexemes[(to + 1).min(end)..end])
                .cloned()
                .collect();
            let mut wishes = self.read_plainly(&order)?;
            let last = wishes.last()?.first()?.clone();
            let looks = self.looks(&last, from, to)?;
            wishes.extend(looks.into_iter().map(|wish| vec![wish]));
            Some(wishes)
        })
    }

    /// Where those look whom the last wish was about.
    fn looks(&self, last: &Wish, from: usize, to: usize) -> Option<Vec<Wish>> {
        let (what, places) = match last {
            Wish::Move { what, at } => (what.clone(), at.clone()),
            Wish::Add { things, at } if things.len() == 1 => {
                (vec![Reference::to(Target::It, "it".to_owned())], at.clone())
            }
            _ => return None,
        };
        if longest_phrase(&self.lexemes[from..to], MUTUAL) == Some(to - from) {
            let other = match (&what[..], places.first().and_then(Where::anchor)) {
                ([_], Some(Anchor::Thing(anchor))) => anchor,
                ([_, other], _) => other.clone(),
                _ => return None,
            };
            let one = what.first()?.clone();
            let faces = |what: &Reference, towards: &Reference| Wish::Face {
                what: vec![what.clone()],
                towards: towards.clone(),
            };
            return Some(vec![faces(&one, &other), faces(&other, &one)]);
        }
        let mut reader = Reader { at: from, ..self.up_to(to) };
        let mut wish = reader.towards(what, to).ok().filter(|_| reader.at >= to)?;
        // "Fay on the left of the fountain, facing it": of two things that are spoken of the one by which it stands.
        if let Wish::Face { towards, .. } = &mut wish
            && super::says::is_it(towards)
        {
            let Some(Anchor::Thing(anchor)) = places.iter().find_map(Where::anchor) else { return None };
            *towards = anchor;
        }
        Some(vec![wish])
    }
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    LOOKS.iter().chain(MUTUAL).flat_map(|phrase| phrase.split(' '))
}
