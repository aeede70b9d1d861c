//! What is doubted, and what is to be done if it is so: "there may be a fountain here, I haven't looked; if there is none, put one next to
//! the mailbox", "if there's a bench by the oak, fine, if not, add one".
//!
//! The doubt and the condition behind it become one condition, in the words in which conditions are read.

use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{longest, longest_phrase};
use super::super::phrases::Phrases;
use super::forms::{word_at, words_at};
use super::words::VERBS;

/// Before what may be there, or may not.
#[rustfmt::skip]
const MAY_BE: &Phrases = &Phrases::of(&["there may be", "there might be", "there could be", "there is", "theres", "there are", "whether there is", "whether theres", "whether we have", "if we have", "there is probably", "theres probably", "we may have", "we might have",
    "there is perhaps", "theres perhaps", "there isnt", "there arent", "there was", "there used to be"]);
/// That it is so.
#[rustfmt::skip]
const SO: &Phrases = &Phrases::of(&["if so", "if thats so", "if that is so", "if thats the case", "if that is the case", "if thats right", "if im right", "if i am right", "if thats true", "if that is true", "in that case"]);
/// That it is not.
#[rustfmt::skip]
const NOT_SO: &Phrases = &Phrases::of(&["if not", "if there isnt", "if there is not", "if there is none", "if theres none", "if there are none", "if there isnt one", "if there isnt any", "if there arent any", "if there arent", "if its not there", "if it isnt there", "if not then", "if there is not one", "if we dont", "if we havent"]);
/// Behind what may be there.
const LEFT_OPEN: &[&str] =
    &["already", "yet", "here", "there", "anywhere", "somewhere", "nearby", "around", "now"];
/// So many words stand at most between the doubt and the condition.
const FARTHEST: usize = 12;

/// Puts a doubt and its condition as one condition.
pub(super) fn in_plain_words(lexemes: &mut Vec<Lexeme>) {
    let begins = |at: usize| at > 2 && is_mark(&lexemes[at - 1]);
    let found = (3..lexemes.len()).filter(|at| begins(*at)).find_map(|at| {
        let so = longest_phrase(&lexemes[at..], SO).map(|words| (true, words));
        let (so, words) =
            so.or_else(|| longest_phrase(&lexemes[at..], NOT_SO).map(|words| (false, words)))?;
        let doubt = (0..at - 1)
            .rev()
            .find_map(|from| longest_phrase(&lexemes[from..at], MAY_BE).map(|words| (from, from + words)))?;
        Some((at, at + words, so, doubt))
    });
    let Some((at, behind, so, (from, noun))) = found else { return };
    let start = lexemes[..from].iter().rposition(is_mark).map_or(0, |mark| mark + 1);
    // "If there is a bench, paint it, if not, add one" orders something in both cases.
    let orders = (start..at)
        .any(|at| (at == start || is_mark(&lexemes[at - 1])) && longest(&lexemes[at..], &VERBS).is_some());
    let end = (noun..at).find(|at| is_mark(&lexemes[*at])).unwrap_or(at);
    let denied = matches!(&lexemes[noun - 1].token, Token::Word(word) if word == "isnt" || word == "arent");
    let article = longest_phrase(
        &lexemes[noun..end],
        &["a", "an", "any", "some", "no", "already a", "already an", "not a", "not any", "one"],
    );
    let none = denied || matches!(&lexemes[noun].token, Token::Word(word) if word == "no" || word == "not");
    let Some(article) = article.filter(|_| !orders && at - end <= FARTHEST) else { return };
    let mut thing = lexemes[noun + article..end].to_vec();
    while matches!(thing.last().map(|last| &last.token), Some(Token::Word(word)) if LEFT_OPEN.contains(&word.as_str()))
    {
        thing.pop();
    }
    let rest = lexemes[behind..].iter().skip_while(|lexeme| is_mark(lexeme)).cloned().collect::<Vec<_>>();
    if thing.is_empty() || rest.is_empty() {
        return;
    }
    let place = lexemes[at].clone();
    // "If not" behind "there is no bench" is "if there is one", and "if there isn't" is not.
    let says_none = !so && lexemes[at..behind].len() > 2;
    let condition = if says_none || so == none { "if there is no" } else { "if there is a" };
    let comma = Lexeme { token: Token::Comma, ..word_at(&place, "") };
    let plain: Vec<Lexeme> = words_at(&place, condition).chain(thing).chain([comma]).chain(rest).collect();
    lexemes.splice(start.., plain);
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    [MAY_BE, SO, NOT_SO].into_iter().flatten().flat_map(|phrase| phrase.split(' '))
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::rewritten;
    use super::*;

    fn plain(said: &str) -> String {
        rewritten(said, in_plain_words)
    }

    #[test]
    fn a_doubt_and_its_condition_are_one() {
        assert_eq!(
            plain("there may be a fountain here, we have not looked; if there is none, put one by the hall"),
            "if there is no fountain , put one by the hall"
        );
        assert_eq!(plain("I bet there is no flagpole; if so, add one"), "if there is no flagpole , add one");
        assert_eq!(
            plain("if there is a bench, paint it red, if not, add one"),
            "if there is a bench , paint it red , if not , add one"
        );
    }
}
