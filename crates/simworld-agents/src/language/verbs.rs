//! What one can be told to do, in many words.

use std::sync::LazyLock;

use super::lexer::{Lexeme, Token};
use super::phrases::Index;

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
    Crouch,
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
        (Self::Crouch, "Crouch"),
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

/// The phrases of all verbs.
static VERBS: LazyLock<Index<Verb>> =
    LazyLock::new(|| Index::new(phrases().map(|(verb, phrase)| (phrase, verb))));

/// Every phrase of every verb.
pub(super) fn phrases() -> impl Iterator<Item = (Verb, &'static str)> {
    TABLE.lines().filter_map(|line| line.split_once(" = ")).flat_map(|(name, phrases)| {
        let verb = Verb::ALL.iter().find(|(_, known)| *known == name).map(|(verb, _)| *verb);
        phrases.split(", ").filter_map(move |phrase| Some((verb?, phrase)))
    })
}

/// Whether the word is an order by itself.
pub(super) fn is_verb(word: &str) -> bool {
    VERBS.alone(word).is_some()
}

/// The verb with the most words at the start of `lexemes`, with their number; its first word may be in any form:
/// "sitting down".
pub(super) fn longest_verb(lexemes: &[Lexeme]) -> Option<(Verb, usize)> {
    let first = lexemes.first()?;
    let Token::Word(said) = &first.token else { return None };
    let after = &lexemes[1..];
    let plain = VERBS.longest_behind(said, after);
    let inflected = first.lemma.as_deref().and_then(|lemma| VERBS.longest_behind(lemma, after));
    match (plain, inflected) {
        (Some(plain), Some(inflected)) if inflected.1 <= plain.1 => Some(plain),
        (plain, inflected) => inflected.or(plain),
    }
}

/// The base form of an inflected verb, if the word is one: "sitting", "walked", "goes".
pub(super) fn base_form(word: &str) -> Option<String> {
    if !matches!(word.as_bytes().last(), Some(b's' | b'd' | b'g')) {
        return irregular(word).map(str::to_owned); // every other form has one of these endings
    }
    if ["lets", "has", "being"].contains(&word) {
        return None; // "let us"
    }
    if let Some(base) = irregular(word) {
        return Some(base.to_owned());
    }
    if let Some(stem) = word.strip_suffix("ied").or_else(|| word.strip_suffix("ies")) {
        return Some(format!("{stem}y")).filter(|base| VERBS.begins(base));
    }
    ["ing", "ed", "es", "s"].into_iter().find_map(|ending| {
        let stem = word.strip_suffix(ending).filter(|stem| stem.len() >= 2)?;
        base_of_stem(stem)
    })
}

/// "Sit" of "sitt", "wave" of "wav", "walk" of "walk".
fn base_of_stem(stem: &str) -> Option<String> {
    if VERBS.begins(stem) {
        return Some(stem.to_owned());
    }
    let silent = format!("{stem}e");
    if VERBS.begins(&silent) {
        return Some(silent);
    }
    let mut letters = stem.chars().rev();
    let last = letters.next().filter(|last| letters.next() == Some(*last))?;
    let single = &stem[..stem.len() - last.len_utf8()];
    VERBS.begins(single).then(|| single.to_owned())
}

/// The base of a form that no rule makes.
fn irregular(word: &str) -> Option<&'static str> {
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
    static FORMS: LazyLock<Index<&str>> = LazyLock::new(|| Index::new(IRREGULAR.iter().copied()));
    FORMS.alone(word)
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
        for (verb, _) in Verb::ALL {
            assert!(phrases().any(|(other, _)| other == *verb), "{verb:?} has no words");
        }
        all.sort_unstable();
        assert!(all.windows(2).all(|pair| pair[0] != pair[1]), "{all:?}");
    }
}
