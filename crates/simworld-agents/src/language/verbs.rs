//! What one can be told to do, in many words.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use super::lexer::{Lexeme, Token};
use super::lexicon::fits;

/// What one can be told to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Verb {
    Go,
    Run,
    Stroll,
    Follow,
    Cross,
    Take,
    Deliver,
    Give,
    Drop,
    PutDown,
    Buy,
    Sit,
    StandUp,
    Stop,
    Wait,
    Board,
    Drive,
    Alight,
    Step,
    Reverse,
    Turn,
    Look,
    Face,
    Point,
    Wave,
    Talk,
    Greet,
    Say,
    Tell,
    Argue,
    Open,
    Close,
    Photo,
    Faster,
    Slower,
    SetSpeed,
    Park,
    Pass,
    Circle,
    /// To and fro between places.
    Shuttle,
    /// To a number, a second for each.
    Count,
}

impl Verb {
    const ALL: &'static [(Self, &'static str)] = &[
        (Self::Go, "Go"),
        (Self::Run, "Run"),
        (Self::Stroll, "Stroll"),
        (Self::Follow, "Follow"),
        (Self::Cross, "Cross"),
        (Self::Take, "Take"),
        (Self::Deliver, "Deliver"),
        (Self::Give, "Give"),
        (Self::Drop, "Drop"),
        (Self::PutDown, "PutDown"),
        (Self::Buy, "Buy"),
        (Self::Sit, "Sit"),
        (Self::StandUp, "StandUp"),
        (Self::Stop, "Stop"),
        (Self::Wait, "Wait"),
        (Self::Board, "Board"),
        (Self::Drive, "Drive"),
        (Self::Alight, "Alight"),
        (Self::Step, "Step"),
        (Self::Reverse, "Reverse"),
        (Self::Turn, "Turn"),
        (Self::Look, "Look"),
        (Self::Face, "Face"),
        (Self::Point, "Point"),
        (Self::Wave, "Wave"),
        (Self::Talk, "Talk"),
        (Self::Greet, "Greet"),
        (Self::Say, "Say"),
        (Self::Tell, "Tell"),
        (Self::Argue, "Argue"),
        (Self::Open, "Open"),
        (Self::Close, "Close"),
        (Self::Photo, "Photo"),
        (Self::Faster, "Faster"),
        (Self::Slower, "Slower"),
        (Self::SetSpeed, "SetSpeed"),
        (Self::Park, "Park"),
        (Self::Pass, "Pass"),
        (Self::Circle, "Circle"),
        (Self::Shuttle, "Shuttle"),
        (Self::Count, "Count"),
    ];
}

/// Each verb with its phrases, a line each: `Go = go, walk, ...`.
const TABLE: &str = include_str!("verbs.txt");

/// No verb has more words.
const LONGEST: usize = 8;

/// The phrases of all verbs by their first word, so that few are looked at.
static VERBS: LazyLock<BTreeMap<&'static str, Vec<(&'static str, Verb)>>> = LazyLock::new(|| {
    let mut verbs: BTreeMap<&str, Vec<(&str, Verb)>> = BTreeMap::new();
    for (verb, phrase) in phrases() {
        verbs.entry(first_word(phrase)).or_default().push((phrase, verb));
    }
    verbs
});

/// Every phrase of every verb.
pub(super) fn phrases() -> impl Iterator<Item = (Verb, &'static str)> {
    TABLE.lines().filter_map(|line| line.split_once(" = ")).flat_map(|(name, phrases)| {
        let verb = Verb::ALL.iter().find(|(_, known)| *known == name).map(|(verb, _)| *verb);
        phrases.split(", ").filter_map(move |phrase| Some((verb?, phrase)))
    })
}

/// Whether the word is an order by itself.
pub(super) fn is_verb(word: &str) -> bool {
    VERBS.get(word).is_some_and(|phrases| phrases.iter().any(|(phrase, _)| *phrase == word))
}

fn first_word(phrase: &str) -> &str {
    phrase.split_once(' ').map_or(phrase, |(first, _)| first)
}

/// The verb with the most words at the start of `lexemes`, with their number; its first word may be in any form:
/// "sitting down".
pub(super) fn longest_verb(lexemes: &[Lexeme]) -> Option<(Verb, usize)> {
    let first = lexemes.first()?;
    let Token::Word(said) = &first.token else { return None };
    let plain = longest_from(said, lexemes);
    let inflected = first.lemma.as_deref().and_then(|lemma| longest_from(lemma, lexemes));
    match (plain, inflected) {
        (Some(plain), Some(inflected)) if inflected.1 <= plain.1 => Some(plain),
        (plain, inflected) => inflected.or(plain),
    }
}

/// As [`longest_verb`], with another first word than the one that is said.
fn longest_from(first: &str, lexemes: &[Lexeme]) -> Option<(Verb, usize)> {
    let after = &lexemes[1..lexemes.len().min(LONGEST)];
    let hits = VERBS.get(first)?.iter().filter_map(|(phrase, verb)| match phrase.split_once(' ') {
        Some((_, rest)) => fits(after, rest).map(|count| (*verb, count + 1)),
        None => Some((*verb, 1)),
    });
    hits.max_by_key(|(_, count)| *count)
}

/// The base form of an inflected verb, if the word is one: "sitting", "walked", "goes".
pub(super) fn base_form(word: &str) -> Option<String> {
    #[rustfmt::skip]
    const IRREGULAR: &[(&str, &str)] = &[
        ("went", "go"), ("gone", "go"), ("been", "go"), ("goes", "go"), ("sat", "sit"), ("took", "take"),
        ("taken", "take"), ("ran", "run"), ("stood", "stand"), ("bought", "buy"), ("gave", "give"), ("given",
        "give"), ("got", "get"), ("had", "have"), ("shown", "show"), ("seen", "see"), ("swung", "swing"),
        ("caught", "catch"), ("laid", "lay"), ("shook", "shake"), ("hung", "hang"), ("began", "begin"), ("drew",
        "draw"), ("drawn", "draw"), ("thrown", "throw"), ("threw", "throw"), ("sent", "send"), ("gotten",
        "get"), ("told", "tell"), ("said", "say"), ("spoken", "speak"), ("ridden", "ride"), ("rode", "ride"),
        ("drove", "drive"), ("driven", "drive"), ("brought", "bring"), ("met", "meet"), ("found", "find"),
        ("came", "come"), ("made", "make"), ("kept", "keep"), ("led", "lead"), ("held", "hold"), ("lying",
        "lie"),
    ];
    if ["lets", "has", "being"].contains(&word) {
        return None; // "let us"
    }
    let is_verb = |stem: &str| VERBS.contains_key(stem);
    if let Some((_, base)) = IRREGULAR.iter().find(|(form, _)| *form == word) {
        return (*base != word).then(|| (*base).to_owned());
    }
    if let Some(stem) = word.strip_suffix("ied").or_else(|| word.strip_suffix("ies")) {
        return Some(format!("{stem}y")).filter(|base| is_verb(base));
    }
    for ending in ["ing", "ed", "es", "s"] {
        let Some(stem) = word.strip_suffix(ending).filter(|stem| stem.len() >= 2) else { continue };
        let mut forms = vec![stem.to_owned(), format!("{stem}e")];
        let letters: Vec<char> = stem.chars().collect();
        if let [.., a, b] = letters[..]
            && a == b
        {
            forms.push(letters[..letters.len() - 1].iter().collect());
        }
        if let Some(base) = forms.into_iter().find(|form| is_verb(form)) {
            return Some(base);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inflected_verbs_have_their_base() {
        for (word, base) in [
            ("sitting", "sit"),
            ("walking", "walk"),
            ("waving", "wave"),
            ("sat", "sit"),
            ("goes", "go"),
            ("dropped", "drop"),
        ] {
            assert_eq!(base_form(word).as_deref(), Some(base));
        }
        assert_eq!(base_form("bench"), None);
        assert_eq!(base_form("thing"), None);
    }

    #[test]
    fn every_line_is_of_a_verb_and_no_phrase_of_two() {
        assert_eq!(TABLE.lines().count(), Verb::ALL.len());
        let mut all: Vec<&str> = phrases().map(|(_, phrase)| phrase).collect();
        assert!(all.iter().all(|phrase| phrase.split(' ').count() <= LONGEST));
        for (verb, _) in Verb::ALL {
            assert!(phrases().any(|(other, _)| other == *verb), "{verb:?} has no words");
        }
        all.sort_unstable();
        assert!(all.windows(2).all(|pair| pair[0] != pair[1]), "{all:?}");
    }
}
