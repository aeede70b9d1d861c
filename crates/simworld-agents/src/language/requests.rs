//! Requests that are no imperatives: "do you think you could ...", "I'd love it if you went ...", "how about going ...".
//!
//! What stands before the verb is passed over if it is made of small words alone and ends as requests end. So no list
//! of whole phrases is needed, and a statement ("I went to the museum") or a question ("did you go?") is no request.

use std::collections::BTreeSet;
use std::sync::LazyLock;

use super::lexer::{Lexeme, Token};
use super::lexicon::longest_phrase;
use super::phrases::Phrases;
use super::verbs::longest_verb;

/// The longest preamble, in words.
const LONGEST: usize = 18;

/// The small words of which preambles are made.
const SMALL: &str = include_str!("small_words.txt");

/// Words after which the order itself may follow, with what stands before them.
const ENDINGS: &str = include_str!("request_endings.txt");
/// "If you" ends a request only after something that says how welcome it would be.
#[rustfmt::skip]
const WELCOME: &[&str] = &[
    "appreciate", "love", "like", "great", "nice", "lovely", "good", "best", "wonderful", "helpful", "help",
    "kind", "grateful", "thankful", "happy", "delighted", "glad", "pleased", "mind", "wonder", "wondering",
    "prefer", "convenient", "better", "favour", "favor", "service", "kindness", "owe", "lot", "world", "solid", "honoured", "honored", "obliged",
];
/// Small words that may stand between an ending and the verb.
#[rustfmt::skip]
const BETWEEN: &[&str] = &[
    "maybe", "perhaps", "please", "just", "kindly", "possibly", "now", "then", "first", "next", "simply",
    "also", "ever so much", "really", "quickly", "go ahead and", "try to", "all",
];
/// What nobody begins a request with: it says what is, or asks what is.
#[rustfmt::skip]
const QUESTIONS: &Phrases = &Phrases::of(&[
    "did", "does", "do you see", "do you want", "have you", "has", "had you", "are you", "is it", "was", "were",
    "when did", "what did", "who", "where", "which",
]);

/// Who is asked for a favour, if it is whoever hears it.
const SOMEBODY: &[&str] = &["somebody", "someone", "anybody", "anyone", "needs", "has", "ought", "one", "of"];

/// Every small word, for the spelling.
pub(super) fn small_words() -> impl Iterator<Item = &'static str> {
    SMALL.split_whitespace()
}

/// Where the order may begin behind a preamble, in lexemes from the start, the shortest preamble first.
pub(super) fn beginnings(lexemes: &[Lexeme]) -> Vec<usize> {
    let mut found = Vec::new();
    if asks(lexemes) || unwanted(lexemes) {
        return found;
    }
    for at in 0..lexemes.len().min(LONGEST) {
        if at > 0 && ends_as_request(&lexemes[..at]) && longest_verb(&lexemes[at..]).is_some() {
            found.push(at);
        }
        match &lexemes[at].token {
            Token::Word(word) if is_small_word(word) || SOMEBODY.contains(&word.as_str()) => {}
            Token::Comma => {}
            _ => break,
        }
    }
    found
}

fn is_small_word(word: &str) -> bool {
    static WORDS: LazyLock<BTreeSet<&str>> = LazyLock::new(|| SMALL.split_whitespace().collect());
    WORDS.contains(word)
}

/// Whether the words ask what is so: "do you see the museum?" wants no answer that walks there.
fn asks(lexemes: &[Lexeme]) -> bool {
    let polite = [
        "is it possible",
        "is it too much",
        "is it ok",
        "is it okay",
        "are you able",
        "are you willing",
        "do you want to",
        "were you able",
    ];
    longest_phrase(lexemes, QUESTIONS).is_some() && longest_phrase(lexemes, &polite).is_none()
}

/// "I don't want you to go there": what follows is not to be done.
fn unwanted(lexemes: &[Lexeme]) -> bool {
    #[rustfmt::skip]
    const UNWANTED: &Phrases = &Phrases::of(&[
        "dont want", "do not want", "would not want", "wouldnt want", "dont need", "do not need", "would not like", "wouldnt like", "dont like", "do not like",
        "dont expect", "do not expect", "dont wish", "do not wish", "would hate", "hate", "did not want", "didnt want", "does not want", "doesnt want", "never want",
        "did not ask", "didnt ask", "never asked",
    ]);
    let who = longest_phrase(lexemes, &["i", "we", "he", "she", "they", "people", "id", "wed"]);
    who.is_some_and(|words| longest_phrase(&lexemes[words..], UNWANTED).is_some())
}

fn word_at(lexemes: &[Lexeme], at: usize) -> Option<&str> {
    match &lexemes.get(at)?.token {
        Token::Word(word) => Some(word),
        _ => None,
    }
}

/// Whether these words, less adverbs at their end, end as requests do.
fn ends_as_request(words: &[Lexeme]) -> bool {
    let mut end = words.len();
    while let Some(shorter) = without_adverb(&words[..end]) {
        end = shorter;
    }
    let words = &words[..end];
    let ends_with = |phrase: &str| {
        let count = phrase.split(' ').count();
        count <= words.len()
            && phrase.split(' ').zip(words.len() - count..).all(|(word, at)| word_at(words, at) == Some(word))
    };
    let welcome =
        || (0..words.len()).any(|at| word_at(words, at).is_some_and(|word| WELCOME.contains(&word)));
    // "Can I get you to" ends in "to"; "let me have you" in "you".
    ENDINGS.lines().any(ends_with)
        || (ends_with("if you") || ends_with("if youd")) && welcome()
        || ends_with("have you") && words.len() > 2
}

/// How many of the words are left without an adverb, or a comma, at their end.
fn without_adverb(words: &[Lexeme]) -> Option<usize> {
    if matches!(words.last(), Some(Lexeme { token: Token::Comma, .. })) {
        return Some(words.len() - 1);
    }
    BETWEEN.iter().find_map(|phrase| {
        let count = phrase.split(' ').count();
        let from = words.len().checked_sub(count).filter(|from| *from > 0)?;
        phrase.split(' ').zip(from..).all(|(word, at)| word_at(words, at) == Some(word)).then_some(from)
    })
}

/// How many lexemes of politeness end the sentence here: "..., would you?", "if it isn't too much trouble".
pub(super) fn coda(lexemes: &[Lexeme]) -> usize {
    #[rustfmt::skip]
    const BEGINNINGS: &Phrases = &Phrases::of(&[
        "would you", "will you", "could you", "can you", "wont you", "if", "when", "whenever", "as soon as",
        "for me", "please", "thanks", "thank you", "there is a good", "theres a good", "thats a good", "okay",
        "ok", "right", "alright", "that would be", "thatd be", "i beg you", "id appreciate",
        "i would appreciate", "theres a", "there is a", "be a", "would be", "itd be", "it would be",
        "will you please", "id be", "i would be", "in case you",
    ]);
    let start = usize::from(matches!(lexemes.first(), Some(Lexeme { token: Token::Comma, .. })));
    if longest_phrase(&lexemes[start..], BEGINNINGS).is_none() {
        return 0;
    }
    let conditional = longest_phrase(&lexemes[start..], &["if", "when", "whenever", "in case you"]).is_some();
    let (mut end, mut last, mut polite) = (start, "", !conditional);
    while let Some(lexeme) = lexemes.get(end) {
        match &lexeme.token {
            Token::Word(word) if is_small(word) => {
                last = word;
                polite |= POLITE.contains(&word.as_str());
            }
            Token::Comma => {}
            Token::Break => break,
            _ => return 0,
        }
        end += 1;
    }
    // "If you" alone wants something to follow.
    let is_whole = !["if", "to", "the", "a"].contains(&last);
    if polite && is_whole { end } else { 0 }
}

/// How many lexemes of a polite condition begin the sentence here: "if you get a moment, ...".
pub(super) fn polite_condition(lexemes: &[Lexeme]) -> usize {
    let Some(mark) = lexemes.iter().position(|lexeme| lexeme.token == Token::Comma) else { return 0 };
    let begins = longest_phrase(lexemes, &["if", "when", "whenever"]).is_some();
    if begins && mark + 1 < lexemes.len() && coda(&lexemes[..mark]) == mark { mark + 1 } else { 0 }
}

/// What makes politeness of a condition: "if you can", "when you have time".
#[rustfmt::skip]
const POLITE: &[&str] = &[
    "mind", "can", "could", "would", "wouldnt", "please", "possible", "trouble", "bother", "like", "moment",
    "time", "ready", "chance", "same", "ok", "okay", "convenient", "kind", "want",
];
/// Small words that say something at the end of a sentence: "if you see me".
const MEANT: &[&str] =
    &["see", "seeing", "say", "said", "tell", "here", "on", "look", "listen", "up", "with", "more", "again"];

fn is_small(word: &str) -> bool {
    const MORE: &[&str] = &[
        "boy", "girl", "dog", "lad", "pup", "robot", "mate", "friend", "sir", "madam", "kindness", "obliged",
        "problem", "robot", "doing", "that",
    ];
    (is_small_word(word) || MORE.contains(&word)) && !MEANT.contains(&word)
}

#[cfg(test)]
mod tests {
    use super::super::lexer::lex;
    use super::*;

    fn begins(text: &str) -> Option<&str> {
        let lexemes = lex(text);
        beginnings(&lexemes).first().map(|at| &text[lexemes[*at].start..])
    }

    #[test]
    fn requests_are_told_from_statements_and_questions() {
        for (text, order) in [
            ("do you think you could wave at Ben", Some("wave at Ben")),
            ("I'd love it if you went to the hospital", Some("went to the hospital")),
            ("if it's not too much trouble, could you please sit", Some("sit")),
            ("would it be too much to ask you to go home", Some("go home")),
            ("how about going to the bus stop", Some("going to the bus stop")),
            ("any chance you could shut the door", Some("shut the door")),
            ("I went to the museum", None),
            ("did you go to the museum", None),
            ("do you see the museum", None),
            ("if you see Eve, wave", None),
            ("you went to the museum", None),
        ] {
            assert_eq!(begins(text), order, "{text}");
        }
    }

    #[test]
    fn thanks_at_the_end_are_passed_over_and_conditions_are_not() {
        let rest = |text: &str| coda(&lex(text));
        assert!(
            rest(", would you?") > 0
                && rest("if it is not too much trouble") > 0
                && rest("please and thank you") > 0
        );
        assert_eq!((rest("if the light is green"), rest("if it rains"), rest("when Ben is here")), (0, 0, 0));
    }
}
