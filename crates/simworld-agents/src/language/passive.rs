//! Orders in the passive and by their results: "the parcel must be taken to Anna", "I want the door closed", "get it
//! opened". The verb is put first, and what is left is read as any other order.

use super::lexer::{Lexeme, Token};
use super::lexicon::longest_phrase;
use super::phrases::Phrases;
use super::verbs::longest_verb;

/// What says that something is to be done, before the verb.
#[rustfmt::skip]
const MODALS: &Phrases = &Phrases::of(&[
    "should be", "must be", "has to be", "have to be", "needs to be", "need to be", "is to be", "are to be",
    "ought to be", "shall be", "can be", "could be", "may be", "might be", "will be", "wants to be",
    "would like to be", "should get", "must get", "needs to get", "has got to be", "is supposed to be",
    "is meant to be", "had better be",
]);
/// Before who or what the verb is about: "I want the door closed".
#[rustfmt::skip]
const CAUSES: &Phrases = &Phrases::of(&[
    "i want", "i need", "i would like", "id like", "id love", "we want", "we need", "get", "have",
    "i want to see", "id like to see", "id like to have", "i want to have", "make sure", "make sure that",
    "see that", "see to it that", "see to it", "ensure", "ensure that", "be sure that", "i would like to have",
    "i would like to see", "let", "lets have", "lets get", "let us have", "lets see", "please have", "please get", "kindly have", "then have", "i wish to have", "i want to get",
]);
/// A question for the same: "could the door be opened?".
const ASKING: &Phrases =
    &Phrases::of(&["could", "can", "should", "must", "may", "might", "would", "shall", "will"]);
/// How something is after an order was carried out.
const RESULTS: &[(&str, &str)] = &[("open", "open"), ("closed", "close"), ("shut", "close")];
/// No subject of a verb has more words.
const LONGEST: usize = 9;

/// Puts the verbs of such orders first, everywhere.
pub(super) fn put_verbs_first(lexemes: &mut Vec<Lexeme>) {
    let mut start = 0;
    while start < lexemes.len() {
        let end = lexemes[start..].iter().position(is_mark).map_or(lexemes.len(), |count| start + count);
        // "Should the door be open, shut it" asks nothing, and says when.
        let conditional = is_word(&lexemes[start], "should")
            && matches!(lexemes.get(end), Some(Lexeme { token: Token::Comma, .. }))
            && end + 1 < lexemes.len();
        if let Some(active) = active(&lexemes[start..end]).filter(|_| !conditional) {
            let count = active.len();
            lexemes.splice(start..end, active);
            start += count;
        } else {
            start = end;
        }
        start += 1;
    }
}

fn is_mark(lexeme: &Lexeme) -> bool {
    let joins = |word: &str| ["and", "then", "so", "otherwise", "else", "but"].contains(&word);
    match &lexeme.token {
        Token::Comma | Token::Break => true,
        Token::Word(word) => joins(word),
        _ => false,
    }
}

/// The same in the active voice, if a passage says so.
fn active(said: &[Lexeme]) -> Option<Vec<Lexeme>> {
    if let Some(asked) = longest_phrase(said, ASKING) {
        let be = (asked + 1..said.len().min(asked + LONGEST)).find(|at| is_word(&said[*at], "be"))?;
        return begins_noun(&said[asked..]).then(|| in_order(&said[asked..be], &said[be + 1..])).flatten();
    }
    if let Some(caused) = longest_phrase(said, CAUSES) {
        let behind = &said[caused..];
        if !begins_noun(behind) {
            return None;
        }
        let is_be = |at: usize| longest_phrase(&behind[at..], &["is", "are", "be", "gets", "to be"]);
        let at = (1..behind.len().min(LONGEST)).find(|at| {
            is_be(*at).is_some_and(|be| verb(&behind[at + be..]).is_some())
                || verb(&behind[*at..]).is_some() && ends_noun(behind, *at)
        })?;
        return in_order(&behind[..at], &behind[at + is_be(at).unwrap_or(0)..]);
    }
    let (at, modal) =
        (1..said.len().min(LONGEST)).find_map(|at| Some((at, longest_phrase(&said[at..], MODALS)?)))?;
    begins_noun(said).then(|| in_order(&said[..at], &said[at + modal..])).flatten()
}

/// The verb, then who or what it is about, then the rest.
fn in_order(about: &[Lexeme], rest: &[Lexeme]) -> Option<Vec<Lexeme>> {
    const OTHERS: &[&str] = &["if", "you", "that", "when", "i", "we", "because", "who", "which", "it's"];
    let (verb, words) = verb(rest)?;
    if about.is_empty() || about.iter().any(|lexeme| OTHERS.iter().any(|word| is_word(lexeme, word))) {
        return None;
    }
    Some(verb.into_iter().chain(about.iter().cloned()).chain(rest[words..].iter().cloned()).collect())
}

/// A participle as an order, with its particle, and how many words that takes.
fn verb(rest: &[Lexeme]) -> Option<(Vec<Lexeme>, usize)> {
    const SAME: &[&str] = &["put", "set", "shut", "let"];
    let first = rest.first()?;
    let Token::Word(word) = &first.token else { return None };
    let as_verb = |base: &str| Lexeme { token: Token::Word(base.to_owned()), lemma: None, ..first.clone() };
    if let Some((_, base)) = RESULTS.iter().find(|(result, _)| result == word) {
        return Some((vec![as_verb(base)], 1));
    }
    let is_participle = !word.ends_with("ing") && !word.ends_with('s');
    let base = match first.lemma.as_deref().filter(|_| is_participle) {
        Some(base) => base,
        None if SAME.contains(&word.as_str()) => word,
        None => return None,
    };
    let mut verb = vec![as_verb(base)];
    let with_particle = [verb[0].clone()].into_iter().chain(rest.get(1).cloned()).collect::<Vec<_>>();
    let takes_particle = with_particle.len() == 2
        && longest_phrase(&rest[1..], &["up", "down", "off", "over", "out"]).is_some()
        && longest_verb(&with_particle).is_some_and(|(_, words)| words == 2);
    if takes_particle {
        verb = with_particle;
    }
    longest_verb(&verb)?;
    let words = verb.len();
    Some((verb, words))
}

fn is_word(lexeme: &Lexeme, word: &str) -> bool {
    matches!(&lexeme.token, Token::Word(said) if said == word)
}

/// Whether a thing may be named here: "I want to go" names none.
fn begins_noun(said: &[Lexeme]) -> bool {
    let first = match said.first().map(|lexeme| &lexeme.token) {
        Some(Token::Word(word)) => word.as_str(),
        Some(Token::Id(_)) => return true,
        _ => return false,
    };
    ![
        "in", "on", "into", "onto", "off", "out", "you", "to", "me", "us", "i", "we", "that", "there", "a",
        "if", "when", "while", "until", "it's",
    ]
    .contains(&first)
        && longest_verb(said).is_none_or(|_| ["the", "this", "that", "my", "it"].contains(&first))
}

/// Whether the verb at that place is none that says what a thing is like: "the closed door".
fn ends_noun(said: &[Lexeme], at: usize) -> bool {
    let article =
        ["the", "a", "an", "this", "that", "my", "any", "every", "each", "all", "nearest", "next", "first"];
    let before = &said[at - 1].token;
    let after = super::lexicon::category(&said[(at + 1).min(said.len())..]);
    !matches!(before, Token::Word(word) if article.contains(&word.as_str())) && after.is_none()
}

#[cfg(test)]
mod tests {
    use super::super::lexer::lex;
    use super::*;

    fn active(text: &str) -> String {
        let mut lexemes = lex(text);
        put_verbs_first(&mut lexemes);
        let word = |lexeme: &Lexeme| match &lexeme.token {
            Token::Word(word) => word.clone(),
            _ => ",".to_owned(),
        };
        lexemes.iter().map(word).collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn passives_and_results_become_orders() {
        for (said, order) in [
            ("the parcel must be taken to Anna", "take the parcel to anna"),
            ("the letter needs to be picked up", "pick up the letter"),
            ("could the library door be opened?", "open the library door ,"),
            ("I want the door closed", "close the door"),
            ("get the library door open, wait", "open the library door , wait"),
            ("make sure that the door is shut", "close the door"),
            ("get the closed door", "get the closed door"),
            ("I want to be taken to the museum", "i want to be taken to the museum"),
            ("if the door is open, close it", "if the door is open , close it"),
            ("get the box", "get the box"),
        ] {
            assert_eq!(active(said), order, "{said}");
        }
    }
}
