//! What is taken back by its name behind the order that named it along with others: "paint the mailbox yellow and the hydrant blue, or no,
//! leave the hydrant alone", "add a tent here and a van there, no, forget the van".
//!
//! What was said of it goes, and what was said of the others stays. Where nothing else was asked for, the words stay as they are: to leave
//! something alone is then all that is said.

use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{longest, longest_phrase};
use super::super::phrases::Phrases;
use super::words::VERBS;

/// That something is thought over.
#[rustfmt::skip]
const BUT: &Phrases = &Phrases::of(&["or no", "no", "oh no", "no no", "no wait", "wait no", "wait", "well no", "hm no", "ah no", "no sorry", "sorry no", "sorry", "actually no", "no actually", "actually", "hang on", "hold on", "on second thought", "on second thoughts", "come to think of it", "but no", "or rather", "or wait"]);
/// That it stays as it is, or is not wanted.
#[rustfmt::skip]
const SPARES: &Phrases = &Phrases::of(&["leave", "keep", "spare", "let", "forget", "forget about", "skip", "scratch", "never mind", "not", "leave out", "dont touch", "do not touch", "better leave", "better not", "just leave", "just forget", "lets leave", "lets forget", "lets keep", "we keep", "we leave", "we dont need", "i dont want", "we dont want", "i dont need"]);
/// Behind it.
#[rustfmt::skip]
const AS_IT_IS: &Phrases = &Phrases::of(&["alone", "be", "as it is", "as is", "the way it is", "where it is", "where it stands", "in peace", "out", "out of it", "out of this", "untouched", "as they are", "where they are", "stay", "standing", "stay where it is", "as it was", "there", "in place", "after all", "please", "instead", "then", "for now", "yet"]);
/// Behind these nothing else says that it stays.
const NEED_TAIL: &[&str] = &["leave", "let", "just leave", "better leave", "lets leave", "we leave"];
/// Before a noun.
const DETERMINERS: &Phrases = &Phrases::of(&[
    "the", "a", "an", "that", "this", "my", "our", "those", "these", "some", "one", "two", "three", "four",
    "both", "another",
]);
/// A name has no more words than that.
const LONGEST: usize = 4;

/// Takes out what was taken back by name.
pub(super) fn in_plain_words(lexemes: &mut Vec<Lexeme>) {
    for mark in 3..lexemes.len() {
        let plain = taken_back(lexemes, mark).and_then(|(noun, end)| without(lexemes, mark, &noun, end));
        if let Some(plain) = plain {
            *lexemes = plain;
            return;
        }
    }
}

/// What is taken back behind a mark, by the words of its noun, and where that ends.
fn taken_back(lexemes: &[Lexeme], mark: usize) -> Option<(Vec<Token>, usize)> {
    // "... and the hydrant no, not the hydrant".
    let is_no =
        lexemes[mark].token == Token::Word("no".to_owned()) && lexemes.get(mark + 1).is_some_and(is_mark);
    if !is_mark(&lexemes[mark]) && !is_no {
        return None;
    }
    let mut at = mark;
    let mut is_said = false;
    loop {
        let rest = lexemes.get(at..)?;
        let but = longest_phrase(rest, BUT);
        is_said |= but.is_some();
        let Some(words) = but.or(rest.first().is_some_and(is_mark).then_some(1)) else { break };
        at += words;
    }
    let spares = longest_phrase(&lexemes[at..], SPARES).filter(|_| is_said)?;
    let from = at + spares;
    let ends = |at: &usize| is_mark(&lexemes[*at]) || goes_on(&lexemes[*at..]).is_some();
    let end = (from..lexemes.len()).find(ends).unwrap_or(lexemes.len());
    let tail = (from + 1..end).find(|at| longest_phrase(&lexemes[*at..end], AS_IT_IS) == Some(end - at));
    if tail.is_none() && longest_phrase(&lexemes[at..from], NEED_TAIL).is_some() {
        return None;
    }
    let the = longest_phrase(&lexemes[from..end], &["the", "that", "this", "my", "our", "those", "these"])?;
    let noun = lexemes.get(from + the..tail.unwrap_or(end))?;
    let is_word = |lexeme: &Lexeme| matches!(lexeme.token, Token::Word(_));
    let is_name = (1..=LONGEST).contains(&noun.len()) && noun.iter().all(is_word);
    is_name.then(|| (noun.iter().map(|lexeme| lexeme.token.clone()).collect(), end))
}

/// How many words join another order to what stands before: "and remove the hydrant".
fn goes_on(rest: &[Lexeme]) -> Option<usize> {
    let and = longest_phrase(rest, &["and", "and then", "but", "then"])?;
    let order = rest.get(and..)?;
    let (_, verb) = longest(order, &VERBS)?;
    longest_phrase(order.get(verb..)?, DETERMINERS)?;
    Some(and)
}

/// The words before a mark without what they say of one thing, and those from `end` on.
fn without(lexemes: &[Lexeme], mark: usize, noun: &[Token], end: usize) -> Option<Vec<Lexeme>> {
    let before = &lexemes[..mark];
    let is_there = |at: &usize| {
        before.get(*at..at + noun.len()).is_some_and(|said| said.iter().map(|word| &word.token).eq(noun))
    };
    let at = (0..mark).rev().find(is_there)?;
    let is_and = |at: usize| {
        is_mark(&before[at])
            || matches!(&before[at].token, Token::Word(word) if word == "and" || word == "plus")
    };
    let from = (at.saturating_sub(3)..at)
        .rev()
        .take_while(|from| !is_and(*from))
        .find(|from| longest_phrase(&before[*from..at], DETERMINERS).is_some())
        .unwrap_or(at);
    let stop = (at + noun.len()..mark).find(|at| is_and(*at)).unwrap_or(mark);
    let next = stop + (stop..mark).take_while(|at| is_and(*at)).count();
    let joined = (0..from).rev().take_while(|at| is_and(*at)).count();
    let (cut, to) = if joined > 0 {
        (from - joined, stop)
    } else {
        let verb = (0..from)
            .rev()
            .take(4)
            .find(|at| longest(&before[*at..from], &VERBS).is_some_and(|(_, words)| at + words == from))?;
        let orders = longest(&before[next..], &VERBS).is_some();
        let joined = (0..verb).rev().take_while(|at| is_and(*at)).count();
        match (next < mark, orders, joined) {
            // "Remove the hydrant and the moped": the verb stays.
            (true, false, _) => (from, next),
            (true, true, _) => (verb, next),
            // "Paint the mailbox yellow and remove the hydrant".
            (false, _, 1..) => (verb - joined, stop),
            // "Remove the hedge, no, keep the hedge and remove the hydrant".
            _ => {
                let and = goes_on(&lexemes[end..])?;
                return Some(lexemes[end + and..].to_vec());
            }
        }
    };
    let mut plain = before[..cut].to_vec();
    plain.extend_from_slice(&before[to..]);
    while plain.last().is_some_and(is_mark) {
        plain.pop();
    }
    plain.extend_from_slice(&lexemes[end..]);
    plain.iter().any(|lexeme| !is_mark(lexeme)).then_some(plain)
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    [BUT, SPARES, AS_IT_IS].into_iter().flatten().flat_map(|phrase| phrase.split(' '))
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::rewritten;
    use super::*;

    fn plain(said: &str) -> String {
        rewritten(said, in_plain_words)
    }

    #[test]
    fn what_is_taken_back_by_name_goes_and_the_others_stay() {
        let painted =
            "paint the mailbox yellow and the hydrant blue, or no, leave the hydrant alone, be quick";
        assert_eq!(plain(painted), "paint the mailbox yellow , be quick");
        assert_eq!(
            plain("remove the hydrant and the moped, no, leave the hydrant alone"),
            "remove the moped"
        );
        assert_eq!(plain("add a tent here and a van there, no, forget the van"), "add a tent here");
        assert_eq!(plain("swap the cars and remove the sign, no wait, keep the sign"), "swap the cars");
        let hedge = "remove the hedge, no, keep the hedge and remove the hydrant, and put a pole there";
        assert_eq!(plain(hedge), "remove the hydrant , and put a pole there");
    }

    #[test]
    fn what_is_left_alone_and_is_all_that_was_said_stays() {
        let all = "paint the hydrant blue, no, leave the hydrant alone";
        assert_eq!(plain(all), "paint the hydrant blue , no , leave the hydrant alone");
        let other = "remove the cone and the sign, no, paint the sign";
        assert_eq!(plain(other), "remove the cone and the sign , no , paint the sign");
    }
}
