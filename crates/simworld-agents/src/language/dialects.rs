//! Ways of writing and of speaking that stand for plain words: what is typed in a hurry ("u", "rn"), what was said long ago
//! ("thou shalt", "unto") and what sailors say for left and right.

use std::sync::LazyLock;

use super::lexer::{Lexeme, Token};
use super::phrases::Index;
use super::verbs::base_form;

/// A word and the plain words for it; none where it says nothing.
#[rustfmt::skip]
const PLAIN: &[(&str, &str)] = &[
    ("cud", "could"), ("wud", "would"), ("shud", "should"), ("pleas", "please"), ("upp", "up"), ("att", "at"), ("onn", "on"), ("u", "you"), ("ya", "you"), ("yall", "you"), ("ur", "your"), ("yr", "your"), ("n", "and"), ("wanna", "want to"),
    ("gonna", "going to"), ("gotta", "have to"), ("hafta", "have to"), ("oughta", "ought to"), ("lemme", "let me"),
    ("rn", "right now"), ("smth", "something"), ("sth", "something"),
    ("sb", "somebody"), ("bc", "because"), ("cuz", "because"), ("coz", "because"), ("ppl", "people"),
    ("b4", "before"), ("tmrw", "tomorrow"),
    ("ty", "thanks"), ("tysm", "thanks"), ("thru", "through"), ("nite", "night"), ("gimmie", "gimme"),
    ("omg", ""), ("lol", ""), ("lmao", ""), ("rofl", ""), ("haha", ""), ("hehe", ""), ("idk", ""), ("btw", ""),
    ("fyi", ""), ("imo", ""), ("imho", ""), ("tbh", ""), ("ngl", ""), ("tho", ""), ("though", ""), ("literally", ""),
    ("kinda", ""), ("sorta", ""), ("ffs", ""), ("xd", ""), ("wow", ""), ("phew", ""), ("ugh", ""),
    ("ouch", ""), ("psst", ""), ("hurrah", ""), ("hooray", ""), ("alas", ""),
    ("thou", "you"), ("thee", "you"), ("ye", "you"), ("thy", "your"), ("thine", "your"), ("shalt", "shall"),
    ("wilt", "will"), ("hast", "have"), ("hath", "has"), ("doth", "does"), ("unto", "to"),
    ("upon", "on"), ("hither", "here"), ("thither", "there"), ("thence", "from there"), ("hence", ""),
    ("ere", "before"), ("twixt", "between"), ("betwixt", "between"), ("amidst", "among"), ("tis", "it is"),
    ("twas", "it was"), ("yonder", ""), ("thrice", "three times"), ("nay", "no"), ("aught", "anything"),
    ("naught", "nothing"), ("whilst", "while"), ("amongst", "among"), ("morrow", "tomorrow"),
    ("starboard", "the right"), ("aft", "behind"), ("abaft", "behind"),
];
/// What is dropped where it stands alone between words that are kept as they are.
const KEPT_BEFORE: &[&str] = &["even", "as"];

/// Puts plain words in the place of others.
pub(super) fn in_plain_words(lexemes: &mut Vec<Lexeme>, text: &str) {
    let mut at = 0;
    while at < lexemes.len() {
        let plain = digit_for_word(lexemes, at).or_else(|| plain(lexemes, at, text));
        let Some(plain) = plain else {
            at += 1;
            continue;
        };
        let lexeme = lexemes[at].clone();
        let words: Vec<Lexeme> = plain
            .split(' ')
            .filter(|word| !word.is_empty())
            .map(|word| Lexeme {
                token: Token::Word(word.to_owned()),
                lemma: base_form(word),
                ..lexeme.clone()
            })
            .collect();
        let (count, empty) = (words.len(), words.is_empty());
        lexemes.splice(at..=at, words);
        at += count;
        if empty && at < lexemes.len() && lexemes[at].token == Token::Comma {
            lexemes.remove(at); // "lol, go home"
        }
    }
}

fn plain(lexemes: &[Lexeme], at: usize, text: &str) -> Option<&'static str> {
    static INDEX: LazyLock<Index<&str>> = LazyLock::new(|| Index::new(PLAIN.iter().copied()));
    let Token::Word(word) = &lexemes[at].token else { return None };
    let plain = INDEX.alone(word)?;
    let before = at.checked_sub(1).and_then(|at| word_of(&lexemes[at]));
    let is_number = matches!(at.checked_sub(1).map(|at| &lexemes[at].token), Some(Token::Number(_)));
    let quoted =
        text[..lexemes[at].start].ends_with(['"', '“', '‘', '\'']) || in_quotes(text, lexemes[at].start);
    let capital = at > 0 && text[lexemes[at].start..].starts_with(char::is_uppercase);
    let kept = before.is_some_and(|before| KEPT_BEFORE.contains(&before));
    let between = before.is_some() && lexemes.get(at + 1).and_then(word_of).is_some();
    if word == "n" && !between {
        return None; // north
    }
    // "Ten min" is known as it is.
    let as_it_is = quoted || capital || kept || is_number && word.starts_with("min");
    (!as_it_is).then_some(plain)
}

/// "Go 2 the stop", "wait 4 me".
fn digit_for_word(lexemes: &[Lexeme], at: usize) -> Option<&'static str> {
    let Token::Number(number) = lexemes[at].token else { return None };
    let next = lexemes.get(at + 1).and_then(word_of)?;
    let follows_word = at > 0 && word_of(&lexemes[at - 1]).is_some();
    let brought = at > 0
        && word_of(&lexemes[at - 1])
            .is_some_and(|word| ["it", "them", "this", "over", "back", "go", "walk", "run"].contains(&word));
    let one = lexemes.get(at + 2).is_none_or(|after| word_of(after).is_none());
    if number == 2.0
        && brought
        && one
        && !["times", "steps", "metres", "meters", "m", "seconds", "minutes"].contains(&next)
    {
        return Some("to"); // "bring it 2 Hugo"
    }
    if number == 2.0 && follows_word && ["the", "my", "your", "that", "this"].contains(&next) {
        return Some("to");
    }
    (number == 4.0 && follows_word && ["me", "the", "him", "her", "us", "a"].contains(&next)).then_some("for")
}

fn word_of(lexeme: &Lexeme) -> Option<&str> {
    match &lexeme.token {
        Token::Word(word) => Some(word),
        _ => None,
    }
}

/// The same of single quotes, which stand at the ends of words where an apostrophe stands within.
pub(super) fn in_single_quotes(text: &str, at: usize) -> bool {
    let before = text.get(..at).unwrap_or_default();
    let mut inside = false;
    let mut last = ' ';
    for letter in before.chars().chain([' ']) {
        if last == '\'' && inside && !letter.is_alphanumeric() {
            inside = false;
        } else if letter == '\'' && !last.is_alphanumeric() && !inside {
            inside = true;
            last = ' ';
            continue;
        }
        last = letter;
    }
    inside
}

/// Whether a place in the text stands between quotation marks.
pub(super) fn in_quotes(text: &str, at: usize) -> bool {
    let before = text.get(..at).unwrap_or_default();
    before.matches('"').count() % 2 == 1
        || before.matches('“').count() > before.matches('”').count()
        || before.matches('«').count() > before.matches('»').count()
}
