//! What comes to mind a moment later, and is put where it belongs: "put a bench by the fountain, a red one", "add a lamp, and make
//! it a tall one", "a stall on the square, in the middle"; and turns that are plain only at the start of an order.

use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{longest, longest_phrase};
use super::super::numbers;
use super::super::paint::PAINTS;
use super::super::phrases::Phrases;
use super::forms::{word_at, words_at};
use super::polite::CODA;
use super::words::WAYS;

/// Before what is said of the new thing once more, behind a mark.
#[rustfmt::skip]
const ONCE_MORE: &Phrases = &Phrases::of(&["a", "an", "preferably a", "preferably an", "ideally a", "ideally an", "maybe a", "but a", "and make it a", "make it a", "and make it an", "make it an", "and make that a",
    "make that a", "it should be a", "it must be a", "it has to be a", "and it should be a", "please a", "possibly a", "best a", "and a"]);
/// As [`ONCE_MORE`], where no mark stands before it.
const MAKES_IT: &[&str] = &["and make it a", "and make it an", "and make that a"];
/// Words that say that another thing is meant.
const ANOTHER: &[&str] = &[
    "new",
    "second",
    "third",
    "fourth",
    "other",
    "further",
    "next",
    "last",
    "similar",
    "different",
    "single",
];
/// What is said of a thing and tells it from no other.
#[rustfmt::skip]
const PRAISE: &[&str] = &["comfy", "comfortable", "cosy", "sturdy", "nice", "good", "pretty", "lovely", "beautiful", "cheap", "simple", "proper", "really", "very", "decent", "quiet", "clean", "solid"];
/// Who is from somewhere, where what they ask for goes.
#[rustfmt::skip]
const WHO: &[&str] = &["kids", "children", "students", "pupils", "people", "guests", "patients", "residents", "visitors", "customers", "lady", "gentleman", "man", "woman", "folks", "staff", "teachers", "nurses", "neighbours", "family"];
/// What stands together stands side by side.
const POSES: &[&str] = &["stand", "sit", "be", "wait", "belong", "go", "standing", "are", "put"];

/// Puts afterthoughts where they belong.
pub(super) fn in_plain_words(lexemes: &mut Vec<Lexeme>) {
    said_once_more(lexemes);
    several_once_more(lexemes);
    let mut at = 0;
    while at < lexemes.len() {
        let begins = begins_order(lexemes, at);
        let rest = &lexemes[at..];
        let place = lexemes[at].clone();
        let is_last = |words: usize| rest.get(words).is_none_or(is_mark);
        if at > 0
            && is_mark(&lexemes[at - 1])
            && let Some(words) = longest_phrase(rest, &["in the middle", "in the centre", "in the center"])
            && is_last(words)
        {
            let of_it: Vec<Lexeme> = words_at(&place, "of it").collect();
            lexemes.splice(at + words..at + words, of_it);
        } else if is_word(&lexemes[at], &["her", "his", "their", "its"])
            && rest.get(1).is_some_and(|next| is_word(next, &["house", "building", "home", "shop"]))
            && (at.saturating_sub(4)..at).any(|from| ends_way(lexemes, from, at))
        {
            lexemes[at] = word_at(&place, "the");
        } else if at > 0 && is_word(&place, &["from"]) && is_word(&lexemes[at - 1], WHO) {
            lexemes[at] = word_at(&place, "at");
        } else if begins && is_word(&place, &["sit", "seat"]) && rest.get(1).is_some_and(names_somebody) {
            lexemes[at] = word_at(&place, "move");
        } else if begins && longest_phrase(rest, &["light a", "light an"]).is_some() {
            lexemes[at] = word_at(&place, "kindle");
        } else if is_word(&place, POSES)
            && rest.get(1).is_some_and(|next| is_word(next, &["together"]))
            && is_last(2)
        {
            let beside: Vec<Lexeme> = words_at(&place, "next to each other").collect();
            lexemes.splice(at + 1..at + 2, beside);
        } else if longest_phrase(
            rest,
            &["before somebody", "before someone", "before anybody", "before anyone", "before people"],
        )
        .is_some()
        {
            lexemes[at] = word_at(&place, "because");
        }
        at += 1;
    }
}

fn is_word(lexeme: &Lexeme, words: &[&str]) -> bool {
    matches!(&lexeme.token, Token::Word(word) if words.contains(&word.as_str()))
}

/// Whether an order may begin here.
fn begins_order(lexemes: &[Lexeme], at: usize) -> bool {
    at == 0
        || is_mark(&lexemes[at - 1])
        || is_word(&lexemes[at - 1], &["and", "then", "please", "so", "just", "lets"])
}

/// Whether a word of place ends before a word.
fn ends_way(lexemes: &[Lexeme], from: usize, at: usize) -> bool {
    longest(&lexemes[from..], &WAYS).is_some_and(|(_, words)| from + words == at)
}

/// Whether no small word stands here, but who is meant.
fn names_somebody(lexeme: &Lexeme) -> bool {
    matches!(lexeme.token, Token::Word(_) | Token::Id(_))
        && !is_word(lexeme, &["down", "here", "there", "on", "at", "in", "and", "next", "by", "back", "up"])
}

/// Where a sentence begins in which something stands.
fn sentence_before(lexemes: &[Lexeme], at: usize) -> usize {
    lexemes[..at].iter().rposition(|lexeme| lexeme.token == Token::Break).map_or(0, |mark| mark + 1)
}

/// Whether nothing stands here but a mark or politeness.
fn is_over(lexemes: &[Lexeme], at: usize) -> bool {
    lexemes.get(at).is_none_or(is_mark) || longest_phrase(&lexemes[at..], CODA) == Some(lexemes.len() - at)
}

/// "A bench by the fountain, a red one" is a red bench by the fountain.
fn said_once_more(lexemes: &mut Vec<Lexeme>) {
    let found = (1..lexemes.len()).find_map(|mark| {
        let from = if is_mark(&lexemes[mark]) {
            mark + 1 + longest_phrase(&lexemes[mark + 1..], ONCE_MORE)?
        } else {
            mark + longest_phrase(&lexemes[mark..], MAKES_IT)?
        };
        let one = (from + 1..lexemes.len().min(from + 4)).find(|at| is_word(&lexemes[*at], &["one"]))?;
        let said = &lexemes[from..one];
        let is_of_it = is_over(lexemes, one + 1)
            && said.iter().all(|word| matches!(word.token, Token::Word(_)) && !is_word(word, ANOTHER));
        // "It should be a red one" is a sentence of its own.
        let clause = sentence_before(lexemes, mark);
        let mut articles = (clause..mark).filter(|at| is_word(&lexemes[*at], &["a", "an"]));
        let article = articles.next().filter(|_| is_of_it && articles.next().is_none())?;
        // "A red car, no, a blue one": what has a colour already gets no second.
        let paint = |from: usize, to: usize| (from..to).any(|at| longest(&lexemes[at..to], PAINTS).is_some());
        if paint(from, one) && paint(article, mark) {
            return None;
        }
        Some((mark, one + 1, article, said.to_vec()))
    });
    let Some((mark, to, article, mut said)) = found else { return };
    said.retain(|word| !is_word(word, PRAISE));
    lexemes.drain(mark..to);
    let noun = article + 1;
    lexemes.splice(noun..noun, said);
}

/// "Two benches by the fountain, red ones".
fn several_once_more(lexemes: &mut Vec<Lexeme>) {
    let found = (1..lexemes.len()).filter(|at| is_mark(&lexemes[*at])).find_map(|mark| {
        let from = mark + 1;
        let ones = (from + 1..lexemes.len().min(from + 3)).find(|at| is_word(&lexemes[*at], &["ones"]))?;
        let said = &lexemes[from..ones];
        let plain = said.iter().all(|word| {
            matches!(word.token, Token::Word(_))
                && !is_word(word, ANOTHER)
                && !is_word(word, &["the", "these", "those", "and", "some", "all", "not"])
        });
        let clause = sentence_before(lexemes, mark);
        let mut counts =
            (clause..mark).filter_map(|at| numbers::count(&lexemes[at..mark]).map(|(_, words)| at + words));
        let behind = counts.next().filter(|_| plain && is_over(lexemes, ones + 1))?;
        Some((mark, ones + 1, behind, said.to_vec()))
    });
    let Some((mark, to, behind, mut said)) = found else { return };
    said.retain(|word| !is_word(word, PRAISE));
    lexemes.drain(mark..to);
    lexemes.splice(behind..behind, said);
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    PRAISE.iter().chain(WHO).chain(POSES).copied()
}
