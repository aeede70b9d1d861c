//! What is taken back as a whole: "put a bench by the statue... oh, forget it, leave all as it is", "paint the school yellow, no, never mind".
//!
//! It is so only where nothing is said behind it, and where the words leave no doubt: "never mind" alone may be said of a remark, and "leave it"
//! of one of several things. What stands on a condition is left to those who read conditions.

use super::super::lexer::{Lexeme, Token, is_mark, word_of};
use super::super::lexicon::longest_phrase;
use super::super::phrases::Phrases;
use super::forms::words_at;

/// That somebody thinks it over.
#[rustfmt::skip]
const LEADS: &Phrases = &Phrases::of(&["no", "oh no", "no no", "ah no", "well no", "nah", "no wait", "wait no", "wait", "actually", "actually no", "no actually", "on second thought", "on second thoughts", "hang on", "hold on", "no hang on", "no hold on", "or no", "or rather not", "come to think of it", "no sorry", "sorry no"]);
/// What says no more beside it.
#[rustfmt::skip]
const IDLE: &Phrases = &Phrases::of(&["oh", "ah", "well", "hmm", "hm", "sorry", "you know what", "know what", "thanks", "thank you", "please", "its fine", "it is fine", "thats fine", "all good", "my bad", "my mistake", "silly me", "ive changed my mind", "i have changed my mind", "i changed my mind", "just", "anyway", "so", "then"]);
/// That what was asked for is not wanted any more.
#[rustfmt::skip]
const FORGETS: &Phrases = &Phrases::of(&["forget it", "forget that", "forget about it", "forget about that", "forget the whole thing", "forget all that", "forget all about it", "forget i said that", "forget i said anything", "forget i said it", "forget i asked", "forget what i said", "scratch that", "scratch all that", "strike that", "cancel that", "ignore that", "ignore what i said",
    "disregard that", "skip that", "scrap that"]);
/// As [`FORGETS`], behind words by which it is thought over, or beside others of these.
#[rustfmt::skip]
const STAYS: &Phrases = &Phrases::of(&["never mind", "nevermind", "never mind that", "dont bother", "dont do it", "dont do that", "dont", "do not", "better not", "lets not", "rather not", "leave all as it is", "leave it all as it is", "leave everything as it is", "leave everything as is", "leave everything the way it is", "leave everything as it was", "leave everything alone", "leave everything",
    "leave things as they are", "leave all of it as it is", "leave all that as it is", "keep everything as it is", "keep all as it is", "keep it all as it is", "everything stays as it is", "all stays as it is", "it all stays as it is", "everything can stay as it is", "everything is fine as it is", "change nothing", "dont change anything", "dont change a thing", "do nothing"]);
/// As [`STAYS`], where one thing was spoken of.
#[rustfmt::skip]
const LEAVES: &Phrases = &Phrases::of(&["leave it", "leave it as it is", "leave it as is", "leave it the way it is", "leave it as it was", "leave it be", "leave it alone", "let it be", "let it stay as it is", "it can stay as it is", "it stays as it is", "its fine as it is", "it is fine as it is", "keep it as it is"]);
/// Before a condition.
const CONDITIONS: &[&str] = &["if", "unless", "otherwise", "else", "case", "should", "provided", "when"];

/// What was said behind the last order.
#[derive(Default)]
#[expect(clippy::struct_excessive_bools, reason = "four independent facts, each read by itself")]
struct Said {
    thought_over: bool,
    forgets: bool,
    stays: bool,
    leaves: bool,
}

/// Puts an order to leave everything as it is in the place of what was taken back.
pub(super) fn in_plain_words(lexemes: &mut Vec<Lexeme>) {
    let end = lexemes.iter().rposition(|lexeme| !is_mark(lexeme)).map_or(0, |last| last + 1);
    let found = (2..end).find(|mark| is_mark(&lexemes[*mark]) && is_withdrawn(lexemes, *mark, end));
    let Some(mark) = found else { return };
    let first = mark + lexemes[mark..end].iter().take_while(|lexeme| is_mark(lexeme)).count();
    // With the place of all these words, so that nothing seems to stand behind them.
    let place = Lexeme { start: lexemes[first].start, ..lexemes[end - 1].clone() };
    let plain: Vec<Lexeme> = words_at(&place, "leave all the things as they are").collect();
    lexemes.splice(..end, plain);
}

/// Whether all that is said behind a mark takes back all that was said before it.
fn is_withdrawn(lexemes: &[Lexeme], mark: usize, end: usize) -> bool {
    let before = &lexemes[..mark];
    let has = |words: &[&str]| before.iter().any(|lexeme| words.contains(&word_of(lexeme)));
    if has(CONDITIONS) {
        return false;
    }
    let Some(said) = said_behind(&lexemes[mark..end]) else { return false };
    // "Put a bench by the statue... never mind": somebody breaks off.
    let dots = lexemes[mark..end].iter().take_while(|lexeme| lexeme.token == Token::Break).count();
    let is_dots = dots > 1 || lexemes[mark..end].iter().any(|lexeme| word_of(lexeme) == "…");
    let is_one = !has(&["and", "plus"]) && !before.iter().any(is_mark);
    let doubts = said.thought_over || is_dots;
    said.forgets || doubts && said.stays || doubts && said.leaves && is_one
}

/// What is said, if it is nothing but that.
fn said_behind(rest: &[Lexeme]) -> Option<Said> {
    let mut said = Said::default();
    let mut at = 0;
    while at < rest.len() {
        let phrase = |phrases: &Phrases| longest_phrase(&rest[at..], phrases);
        if is_mark(&rest[at]) || word_of(&rest[at]) == "…" {
            at += 1;
        } else if let Some(words) = phrase(FORGETS) {
            (said.forgets, at) = (true, at + words);
        } else if let Some(words) = phrase(STAYS) {
            (said.stays, at) = (true, at + words);
        } else if let Some(words) = phrase(LEAVES) {
            (said.leaves, at) = (true, at + words);
        } else if let Some(words) = phrase(LEADS) {
            (said.thought_over, at) = (true, at + words);
        } else {
            at += phrase(IDLE)?;
        }
    }
    Some(said)
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::rewritten;
    use super::in_plain_words;

    fn plain(said: &str) -> String {
        rewritten(said, in_plain_words)
    }

    #[test]
    fn what_is_taken_back_as_a_whole_is_left() {
        for said in [
            "put a bench by the statue... oh, forget it, leave all as it is",
            "paint the school yellow... no, never mind, leave it",
            "paint the school yellow, no, leave it as it is",
            "put a bench here and a bin there, no wait, never mind",
            "remove the oak, scratch that",
        ] {
            assert_eq!(plain(said), "leave all the things as they are", "{said}");
        }
    }

    #[test]
    fn what_may_be_said_of_something_else_takes_nothing_back() {
        for said in [
            "put a bench here , its a bit dark , but never mind",
            "put a bench here , never mind",
            "paint the car black and the bin blue , no , leave it",
            "if there is a cat remove it , if not , leave everything as it is",
            "scratch that , put a bench here",
            "the black one , well , leave it as it is",
        ] {
            assert_eq!(plain(said), said, "{said}");
        }
    }
}
