//! What is said behind an order and asks for nothing, whatever it says: "..., dinner takes a while".
//!
//! Remarks are known by what they say. Of these only that is known which they do not say: nothing that is here, and no word by
//! which something could be asked for otherwise. They are passed over where a sentence is not understood with them.

use super::lexer::{Lexeme, Token, is_mark};
use super::lexicon::{category, longest, longest_phrase};
use super::names::Names;
use super::numbers::number;
use super::paint::PAINTS;
use super::phrases::Phrases;
use super::politeness::filler;
use super::requests;
use super::verbs::longest_verb;

/// Words by which something may be asked for, or asked for otherwise.
#[rustfmt::skip]
const DEMANDS: &Phrases = &Phrases::of(&[
    "if", "unless", "until", "till", "when", "whenever", "before", "after", "then", "not", "dont", "no", "never", "cant", "isnt",
    "wont", "without", "but", "except", "only", "instead", "rather", "better", "should", "shall", "please", "let", "lets", "other", "others",
    "another", "one", "ones", "same", "again", "twice", "too", "also", "as well", "want", "wants", "need", "needs", "would", "him", "her",
    "them", "left", "right", "north", "south", "east", "west", "big", "small", "tall", "largest", "smallest", "tallest", "nearest", "farthest",
    "first", "second", "third", "last", "next", "back", "which", "where", "who", "what", "how", "or", "and", "so", "behind", "beside", "near",
    "under", "between", "across", "along", "towards", "inside", "outside",
]);
/// What a remark begins with.
#[rustfmt::skip]
const SUBJECTS: &Phrases = &Phrases::of(&[
    "its", "it is", "it was", "it has", "it looks", "theres", "there is", "there are", "there was", "thats", "that is", "this is",
    "i am", "im", "i", "we are", "we", "you are", "youre", "you look", "you must", "your", "my", "our", "his", "everybody", "everyone",
    "people", "somebody", "someone", "he is", "hes", "she is", "shes", "they are", "theyre",
]);
/// Verbs that say how something is.
#[rustfmt::skip]
const STATES: &Phrases = &Phrases::of(&[
    "is", "are", "was", "were", "has", "have", "had", "takes", "looks", "seems", "feels", "goes", "comes", "gets", "keeps", "begins", "starts",
    "ends", "closes", "opens", "says", "hurts", "hurt", "must be", "might be", "could be", "will be",
]);

/// The words before the last mark, if what is said behind it is a remark that asks for nothing.
pub(super) fn without_remark<'a>(lexemes: &'a [Lexeme], names: &Names<'_>) -> Option<&'a [Lexeme]> {
    let end = lexemes.iter().rposition(|lexeme| !is_mark(lexeme))? + 1;
    let mark = lexemes[..end].iter().rposition(is_mark)?;
    (mark > 0 && is_idle(&lexemes[mark + 1..end], names)).then(|| &lexemes[..mark])
}

/// Whether a clause tells something, and nothing of what is here or of what is to be done.
fn is_idle(clause: &[Lexeme], names: &Names<'_>) -> bool {
    let says = |from: usize| longest_phrase(&clause[from..], STATES).is_some();
    let tells = longest_phrase(clause, SUBJECTS).is_some() || (1..clause.len().min(4)).any(says);
    let asks = longest_verb(clause).is_some()
        || filler(clause).is_some()
        || !requests::beginnings(clause).is_empty();
    let speaks_of_something = |from: usize| {
        let rest = &clause[from..];
        longest_phrase(rest, DEMANDS).is_some()
            || longest(rest, PAINTS).is_some()
            || number(rest).is_some()
            || category(rest).is_some()
            || names.exact(rest).is_some()
    };
    clause.len() >= 3
        && clause.iter().all(|lexeme| matches!(lexeme.token, Token::Word(_)))
        && tells
        && !asks
        && !(0..clause.len()).any(speaks_of_something)
}
