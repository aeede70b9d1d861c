//! What who learns the language says first of all, put plainly before it is read: "me want small dog close to Anna" wants a new one, "me, I ..." is about
//! nobody else, and who is cold asks for no cold weather.

use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{longest, longest_phrase};
use super::super::names::Names;
use super::super::numbers;
use super::super::phrases::Phrases;
use super::forms::{word, word_at};
use super::words::{VERBS, WAYS};

const WANTS: &[&str] = &["want", "need", "like", "wish", "wants", "needs", "wanting", "needing"];
/// Before a noun, or in the place of one.
#[rustfmt::skip]
const DETERMINERS: &[&str] = &["the", "a", "an", "this", "that", "these", "those", "my", "our", "your", "his", "her", "their", "one", "another", "each", "every", "any", "some", "no", "all", "both", "to", "you", "it", "him", "them", "more", "not", "many", "few", "several", "half", "and", "for", "water"];
/// Who is in the weather.
const I_AM: &Phrases =
    &Phrases::of(&["i am", "im", "we are", "i feel", "we feel", "i am feeling", "im feeling", "me am"]);
const SO: &[&str] = &["so", "very", "really", "too", "all", "quite", "a bit", "rather", "always", "feeling"];
/// How he is.
#[rustfmt::skip]
const STATES: &[&str] = &["cold", "hot", "warm", "freezing", "wet", "frozen", "soaked", "chilly", "boiling", "cool", "sweating", "shivering"];

/// Puts it plainly.
pub(super) fn in_plain_words(lexemes: &mut Vec<Lexeme>, names: &Names<'_>) {
    me_is_i(lexemes);
    without_own_state(lexemes);
    a_new_one(lexemes, names);
}

/// "Me, I ...", "me I ...": I.
fn me_is_i(lexemes: &mut Vec<Lexeme>) {
    if word(lexemes, 0) != "me" {
        return;
    }
    let mark = 1 + usize::from(lexemes.get(1).is_some_and(|mark| mark.token == Token::Comma));
    if matches!(word(lexemes, mark), "i" | "we" | "im") {
        lexemes.drain(..mark);
    }
}

/// "I am cold, so ...": without what he is, if more is said.
fn without_own_state(lexemes: &mut Vec<Lexeme>) {
    let Some(am) = longest_phrase(lexemes, I_AM) else { return };
    let so = am + lexemes.get(am..).and_then(|rest| longest_phrase(rest, SO)).unwrap_or(0);
    let is_state = STATES.contains(&word(lexemes, so));
    let mark = so + 1;
    let is_end = lexemes.get(mark).is_some_and(is_mark);
    let rest = lexemes.get(mark + 1..).unwrap_or_default();
    if !is_state || !is_end || rest.iter().all(is_mark) {
        return;
    }
    let therefore = longest_phrase(rest, &["so", "and so"]).unwrap_or(0);
    if therefore < rest.len() {
        lexemes.drain(..mark + 1 + therefore);
    }
}

/// "Me want small dog close to Anna": a small dog, where nothing says that it is one that is there.
fn a_new_one(lexemes: &mut Vec<Lexeme>, names: &Names<'_>) {
    if word(lexemes, 0) != "me" || !WANTS.contains(&word(lexemes, 1)) {
        return;
    }
    let Some(place) = lexemes.first().cloned() else { return };
    lexemes[0] = word_at(&place, "i");
    lexemes[1] = word_at(&place, if word(lexemes, 1).starts_with("want") { "want" } else { "need" });
    let end = lexemes.iter().position(is_mark).unwrap_or(lexemes.len());
    let Some(rest) = lexemes.get(2..end) else { return };
    let way = (1..rest.len()).find(|at| longest(&rest[*at..], &WAYS).is_some());
    let is_several = way.is_some_and(|way| word(rest, way - 1).ends_with('s'));
    let is_known = DETERMINERS.contains(&word(rest, 0))
        || numbers::count(rest).is_some()
        || names.exact(rest).is_some()
        || longest(rest, &VERBS).is_some();
    if way.is_some() && !is_several && !is_known {
        lexemes.insert(2, word_at(&place, "a"));
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::rewritten;
    use super::{me_is_i, without_own_state};

    #[test]
    fn who_speaks_is_spoken_of_plainly() {
        let plain = |said: &str| {
            rewritten(said, |lexemes| {
                me_is_i(lexemes);
                without_own_state(lexemes);
            })
        };
        for (said, meant) in [
            ("me, i am cold, so please one campfire close to eve", "please one campfire close to eve"),
            ("me i need one laptop", "i need one laptop"),
            ("i am freezing. put a campfire here", "put a campfire here"),
            // These say something else.
            ("i am cold", "i am cold"),
            ("me and dmitri want a bench", "me and dmitri want a bench"),
            ("i am here, put a bench next to me", "i am here , put a bench next to me"),
        ] {
            assert_eq!(plain(said), meant, "{said}");
        }
    }
}
