//! What is heard before it is read: sounds of thinking, contractions and forms of address are put aside.

use super::dialects::in_plain_words;
use super::lexer::{Lexeme, Token, lex};
use super::lexicon::{category, longest_phrase};
use super::phrases::Phrases;
use super::politeness::{HESITATIONS, filler};
use super::verbs::longest_verb;

/// Contractions of a verb and "not".
const NEGATED: &[(&str, &str)] = &[
    ("isnt", "is"),
    ("arent", "are"),
    ("wasnt", "was"),
    ("aint", "is"),
    ("hasnt", "has"),
    ("doesnt", "does"),
];
/// Words with "'s" that stand in the tables as they are.
const WHOLE: &[&str] =
    &["its", "thats", "lets", "theres", "whos", "whats", "heres", "wheres", "hows", "todays"];
/// What somebody or something may be: before it "'s" is "is", and not whose.
#[rustfmt::skip]
const STATES: &Phrases = &Phrases::of(&[
    "here", "there", "green", "red", "yellow", "amber", "free", "taken", "occupied", "empty", "open", "closed",
    "shut", "near", "nearby", "close", "next", "visible", "in sight", "in view", "in use", "available", "busy",
    "locked", "unlocked", "not", "arrived", "back", "sitting", "standing", "gone", "been", "got", "waiting",
    "coming", "lonely", "sad", "late", "hungry", "thirsty", "bored", "tired", "ill", "ready", "alone", "lost",
    "in", "on", "at", "by", "behind", "over", "still", "already", "about", "around", "feeling", "looking",
    "asking", "lying", "parked", "stopped", "turned", "become", "come", "dark", "raining", "snowing", "dry",
    "wet", "closest", "nearest", "the closest", "the nearest", "the farthest", "the furthest", "the tallest", "the biggest",
    "the smallest", "the shortest", "the lowest", "the highest", "the largest", "the nearer", "the closer", "stuck", "broken",
]);

/// The tokens of what is said to somebody of that name.
pub(super) fn hear(text: &str, name: Option<&str>) -> Vec<Lexeme> {
    let mut lexemes = lex_speech(text);
    super::slips::small_slips(&mut lexemes);
    without_abbreviations(&mut lexemes);
    in_plain_words(&mut lexemes, text);
    without_example_words(&mut lexemes);
    without_commas_in(&mut lexemes, &["if", "and only if"]);
    without_commas_in(&mut lexemes, &["when", "and only when"]);
    for first in ["sorry", "no", "wait", "oops"] {
        without_commas_in(&mut lexemes, &[first, "i mean"]);
        without_commas_in(&mut lexemes, &[first, "i meant"]);
    }
    with_dashes(&mut lexemes, text);
    without_company(&mut lexemes, text);
    if let Some(name) = name {
        drop_address(&mut lexemes, &lex(name));
    }
    lexemes
}

/// "Walk with me to the well", "go to the museum with me": who speaks goes along, and leads nowhere. "Come with me" alone is following.
fn without_company(lexemes: &mut Vec<Lexeme>, text: &str) {
    #[rustfmt::skip]
    const MOVES: &[&str] = &[
        "come", "walk", "go", "run", "ride", "drive", "stroll", "sit", "stand", "wait", "rest", "travel", "head", "hurry", "move", "stay", "cycle", "march",
        "hike", "down", "along", "over", "up", "out", "on", "here", "there", "back", "off", "jog", "wander", "pop", "step", "going", "coming", "join",
    ];
    const WITH_ME: &Phrases = &Phrases::of(&[
        "with me",
        "with us",
        "together with me",
        "together with us",
        "along with me",
        "along with us",
    ]);
    const LEADS: &Phrases = &Phrases::of(&[
        "to",
        "over",
        "towards",
        "into",
        "on",
        "at",
        "by",
        "until",
        "till",
        "for",
        "in",
        "near",
        "next to",
        "beside",
        "under",
        "behind",
        "down",
        "up",
        "out",
        "across",
        "around",
        "round",
        "through",
        "past",
        "from",
        "as far as",
        "in front of",
        "here",
        "there",
        "onto",
        "inside",
        "back",
        "while",
    ]);
    /// What is left with who speaks stays there.
    const KEPT: &[&str] = &[
        "leave", "put", "drop", "keep", "left", "is", "are", "be", "talk", "speak", "argue", "share",
        "agree", "swap", "chat", "was",
    ];
    let word = |lexeme: &Lexeme| match &lexeme.token {
        Token::Word(word) => Some(word.clone()),
        _ => None,
    };
    let mut at = 1;
    while at < lexemes.len() {
        let begin = (0..at).rev().find(|at| word(&lexemes[*at]).is_none()).map_or(0, |mark| mark + 1);
        let said = &lexemes[begin..at];
        let kept = said.iter().filter_map(word).any(|word| KEPT.contains(&word.as_str()));
        let quoted = || {
            let from = lexemes[at].start;
            super::dialects::in_quotes(text, from) || super::dialects::in_single_quotes(text, from)
        };
        let Some(words) =
            longest_phrase(&lexemes[at..], WITH_ME).filter(|_| !kept && !said.is_empty() && !quoted())
        else {
            at += 1;
            continue;
        };
        let moves = said.last().and_then(word).is_some_and(|word| MOVES.contains(&word.as_str()));
        let after = &lexemes[at + words..];
        let led = said.len() > 2 && (0..said.len()).any(|at| longest_phrase(&said[at..], LEADS).is_some());
        if moves && longest_phrase(after, LEADS).is_some() || !moves && led {
            lexemes.drain(at..at + words);
        } else {
            at += 1;
        }
    }
}

/// "St. Mary's": the full stop of an abbreviation ends no sentence.
fn without_abbreviations(lexemes: &mut Vec<Lexeme>) {
    let mut at = 1;
    while at < lexemes.len() {
        let short = matches!(&lexemes[at - 1].token, Token::Word(word) if ["st", "mr", "mrs", "ms", "dr"].contains(&word.as_str()));
        if short && lexemes[at].token == Token::Break && at + 1 < lexemes.len() {
            lexemes.remove(at);
        }
        at += 1;
    }
}

/// "Turn left, say 30 degrees", "for a bit, like two minutes": the number says what was meant.
fn without_example_words(lexemes: &mut Vec<Lexeme>) {
    let mut at = 1;
    while at + 2 < lexemes.len() {
        let example = longest_phrase(
            &lexemes[at + 1..],
            &["let us say", "lets say", "maybe", "perhaps", "say", "like", "about", "roughly"],
        );
        let Some(words) = example.filter(|_| is_comma(lexemes, at)) else {
            at += 1;
            continue;
        };
        let after = &lexemes[(at + 1 + words).min(lexemes.len())..];
        let preposition = longest_phrase(after, &["for", "to", "at", "for about", "of"]).unwrap_or(0);
        let number = super::numbers::number(&after[preposition..]).is_some()
            && longest_phrase(&after[preposition..], &["a", "an"]).is_none_or(|_| {
                super::numbers::duration(&after[preposition..]).is_some_and(|(_, count)| count > 1)
            });
        if number {
            let vague = [
                "a bit",
                "a little",
                "for a bit",
                "for a while",
                "for a moment",
                "for a little while",
                "for a short while",
            ];
            let from = (1..=4).find(|count| {
                at >= *count
                    && vague
                        .iter()
                        .any(|phrase| super::lexicon::fits(&lexemes[at - count..], phrase) == Some(*count))
            });
            match from {
                Some(count) if preposition == 0 => {
                    lexemes.drain(at - count + 1..=at + words);
                }
                Some(count) => {
                    lexemes.drain(at - count..=at + words);
                }
                None => {
                    lexemes.drain(at..=at + words);
                }
            }
        }
        at += 1;
    }
}

/// "If, and only if, you see her": the parts of one phrase.
fn without_commas_in(lexemes: &mut Vec<Lexeme>, parts: &[&str; 2]) {
    let mut at = 0;
    while at + 2 < lexemes.len() {
        let first = longest_phrase(&lexemes[at..], &parts[..1]) == Some(1) && is_comma(lexemes, at + 1);
        if let Some(words) = longest_phrase(&lexemes[at + 2..], &parts[1..]).filter(|_| first) {
            if is_comma(lexemes, at + 2 + words) {
                lexemes.remove(at + 2 + words);
            }
            lexemes.remove(at + 1);
        }
        at += 1;
    }
}

/// "The letter - bring it to Hana": a dash between words parts them as a comma does.
fn with_dashes(lexemes: &mut Vec<Lexeme>, text: &str) {
    let mut at = 1;
    while at < lexemes.len() {
        let (start, end) = (lexemes[at - 1].end, lexemes[at].start);
        let between = text.get(start..end).unwrap_or_default();
        let dash = between.contains(['–', '—']) || between.contains(" - ") || between.contains(" -- ");
        let is_word = |lexeme: &Lexeme| !matches!(lexeme.token, Token::Comma | Token::Break);
        if dash && is_word(&lexemes[at - 1]) && is_word(&lexemes[at]) {
            lexemes.insert(at, Lexeme { token: Token::Comma, lemma: None, start, end: start });
            at += 1;
        }
        at += 1;
    }
}

/// The words with a pause in the place of a sound between two commas, "it's for the video, um, walk there", of the same length; none if there is no
/// such sound. With both commas taken out, as where somebody looks for a word, the order would go on with the remark.
pub(super) fn pausing(text: &str) -> Option<String> {
    let lexemes = lex(text);
    let mut paused = text.to_owned();
    for at in 1..lexemes.len() {
        if is_sound(&lexemes, at) && is_comma(&lexemes, at - 1) && is_comma(&lexemes, at + 1) {
            let (from, to) = (lexemes[at].start, lexemes[at + 1].end);
            paused.replace_range(from..to, &" ".repeat(to - from));
        }
    }
    (paused != text).then_some(paused)
}

/// As [`lex`], without the sounds that people make while they think, and with contractions in full.
pub(super) fn lex_speech(text: &str) -> Vec<Lexeme> {
    let mut lexemes = lex(text);
    while let Some(at) = (0..lexemes.len()).find(|at| is_sound(&lexemes, *at)) {
        lexemes.remove(at);
        let (before, after) =
            (at.checked_sub(1).is_some_and(|at| is_comma(&lexemes, at)), is_comma(&lexemes, at));
        if after {
            lexemes.remove(at);
        }
        if before {
            lexemes.remove(at - 1);
        }
    }
    in_full(&mut lexemes, text);
    lexemes
}

fn is_comma(lexemes: &[Lexeme], at: usize) -> bool {
    matches!(lexemes.get(at), Some(Lexeme { token: Token::Comma, .. }))
}

/// Sounds, and "like" or "you know" between commas.
fn is_sound(lexemes: &[Lexeme], at: usize) -> bool {
    let Token::Word(word) = &lexemes[at].token else { return false };
    if word == "like" {
        return at > 0 && is_comma(lexemes, at - 1) && is_comma(lexemes, at + 1);
    }
    // No other letters make such sounds, and few words are made of these.
    if !word.bytes().all(|letter| b"aehmoru".contains(&letter)) {
        return false;
    }
    // "Ummm" is one however long it is drawn.
    let mut short = word.clone();
    short.dedup_letters();
    HESITATIONS.contains(&short.as_str()) || HESITATIONS.contains(&word.as_str())
}

trait Drawn {
    /// Makes one letter of several that are the same.
    fn dedup_letters(&mut self);
}

impl Drawn for String {
    fn dedup_letters(&mut self) {
        let mut last = None;
        self.retain(|letter| last.replace(letter) != Some(letter));
    }
}

/// "Isn't" is "is not", and "Ben's here" is "Ben is here".
fn in_full(lexemes: &mut Vec<Lexeme>, text: &str) {
    let mut at = 0;
    while at < lexemes.len() {
        if let Some(words) = parts_of(lexemes, at, text) {
            let lexeme = lexemes[at].clone();
            let both = words.map(|word| Lexeme { token: Token::Word(word), lemma: None, ..lexeme.clone() });
            lexemes.splice(at..=at, both);
            at += 1;
        }
        at += 1;
    }
}

/// The two words of a contraction.
fn parts_of(lexemes: &[Lexeme], at: usize, text: &str) -> Option<[String; 2]> {
    let lexeme = &lexemes[at];
    let Token::Word(word) = &lexeme.token else { return None };
    let written = &text[lexeme.start..lexeme.end];
    if !word.ends_with("nt") && !written.contains(['\'', '’']) {
        return None;
    }
    let (one, other) = if written.eq_ignore_ascii_case("we're") || written.eq_ignore_ascii_case("we’re") {
        ("we".to_owned(), "are")
    } else if let Some((_, verb)) = NEGATED.iter().find(|(short, _)| short == word) {
        ((*verb).to_owned(), "not")
    } else {
        (owner(word, lexeme, text).filter(|_| is_state(&lexemes[at + 1..]))?, "is")
    };
    Some([one, other.to_owned()])
}

/// The word before "'s".
fn owner(word: &str, lexeme: &Lexeme, text: &str) -> Option<String> {
    let written = &text[lexeme.start..lexeme.end];
    let is_contracted = written.ends_with("'s") || written.ends_with("’s");
    (is_contracted && (word == "its" || !WHOLE.contains(&word))).then(|| word[..word.len() - 1].to_owned())
}

fn is_state(rest: &[Lexeme]) -> bool {
    // "Eve's expecting a parcel".
    let goes_on = rest.first().is_some_and(|first| {
        first.lemma.is_some() && matches!(&first.token, Token::Word(word) if word.ends_with("ing"))
    });
    goes_on && category(rest).is_none()
        || longest_phrase(rest, STATES).is_some_and(|count| category(&rest[count..]).is_none())
}

/// Takes the listener's own name out where it stands apart: "Rex, come here", "stay, Rex".
fn drop_address(lexemes: &mut Vec<Lexeme>, name: &[Lexeme]) {
    let mut at = 0;
    while !name.is_empty() && at < lexemes.len() {
        let end = at + name.len();
        let same =
            lexemes.get(at..end).is_some_and(|said| said.iter().zip(name).all(|(a, b)| a.token == b.token));
        let is_mark = |at: usize| matches!(lexemes[at].token, Token::Comma | Token::Break);
        let begins = at == 0 || is_mark(at - 1) || is_polite(&lexemes[..at]);
        let called = at > 0
            && (end >= lexemes.len() || is_mark(end))
            && matches!(&lexemes[at - 1].token, Token::Word(word)
                if ["me", "here", "please", "now", "boy", "girl", "down", "still", "it", "back", "home", "there"].contains(&word.as_str()));
        let begins = begins || called || end >= lexemes.len() && at > 1 && stands_apart(&lexemes[..at]);
        let ends = end >= lexemes.len() || is_mark(end) || at == 0 && longest_verb(&lexemes[end..]).is_some();
        if same && begins && ends && lexemes.len() > name.len() {
            let between =
                at > 0 && end < lexemes.len() && is_comma(lexemes, at - 1) && is_comma(lexemes, end);
            lexemes.drain(at..end + usize::from(between));
        } else {
            at += 1;
        }
    }
}

/// Whether a name behind these words is a form of address: no preposition and no verb stands before it.
fn stands_apart(before: &[Lexeme]) -> bool {
    #[rustfmt::skip]
    const LEADS: &[&str] = &[
        "to", "at", "with", "for", "of", "from", "by", "near", "behind", "beside", "after", "and", "or", "the", "a", "my",
        "than", "like", "in", "on", "towards", "around", "round", "past", "under", "between", "called", "named", "not",
        "next", "front", "toward", "via", "only", "just", "see", "is", "are", "until", "till", "if", "when",
    ];
    let last = &before[before.len() - 1];
    matches!(&last.token, Token::Word(word) if !LEADS.contains(&word.as_str()))
        && longest_verb(&before[before.len() - 1..]).is_none()
}

/// Whether the words are politeness alone: "come on Rex, ...".
fn is_polite(mut lexemes: &[Lexeme]) -> bool {
    while let Some(count) = filler(lexemes) {
        lexemes = &lexemes[count..];
    }
    lexemes.is_empty()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(text: &str, name: Option<&str>) -> String {
        let word = |lexeme: &Lexeme| match &lexeme.token {
            Token::Word(word) => word.clone(),
            Token::Comma => ",".to_owned(),
            other => format!("{other:?}"),
        };
        hear(text, name).iter().map(word).collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn what_means_nothing_is_put_aside() {
        assert_eq!(words("ummm, could you, like, sit", None), "could you sit");
        assert_eq!(words("if Ben's here and it isn't dark", None), "if ben is here and it is not dark");
        assert_eq!(words("go to the library's red door", None), "go to the librarys red door");
        assert_eq!(words("Rex, follow Ben", Some("Rex")), ", follow ben");
        assert_eq!(words("follow Rex", Some("Rex")), "follow rex");
    }
}
