//! Negations that add nothing: "not on it, beside it", "and not a word to the neighbours", "don't add any, I only want to know", "we don't need another
//! bench. What we do need is ...", "make a copy of the bench; the old one may stay where it is".
//!
//! What would be misunderstood with them is freed of them before it is read; the others are left out only where a sentence was refused. What denies a place
//! that was asked for, or says something of what "it" stands for, is kept.

use super::super::lexer::{Lexeme, word_of};
use super::super::lexicon::{longest, longest_phrase};
use super::super::phrases::Phrases;
use super::forms::word;
use super::statements::{Clause, clauses, rest_of};
use super::words::{VERBS, WAYS, Way};

/// That more of something is not needed.
#[rustfmt::skip]
const NEED_NOT: &Phrases = &Phrases::of(&["i dont need", "we dont need", "i do not need", "we do not need", "i dont want", "we dont want", "i do not want", "we do not want", "you dont need", "they dont need", "nobody needs", "no one needs", "nobody wants", "its not that we need", "we certainly dont need", "i certainly dont need", "we really dont need", "i really dont need", "theres no need for", "there is no need for", "it is not that we need"]);
/// Before what there is enough of.
#[rustfmt::skip]
const MORE: &Phrases = &Phrases::of(&["another", "yet another", "any more", "more", "any other", "one more", "an extra", "any extra", "even more", "still more", "a further", "any further", "a second", "a third"]);
/// By these the rest may speak of what was denied.
#[rustfmt::skip]
pub(super) const OPEN: &[&str] = &["it", "its", "them", "they", "their", "one", "ones", "there", "that", "those", "these", "this", "instead", "either", "too", "same"];
/// What was copied.
#[rustfmt::skip]
const ORIGINALS: &Phrases = &Phrases::of(&["the old one", "the old ones", "the original", "the originals", "the original one", "the first one", "the first", "the existing one", "the one we have", "the one that is there", "the one that is there now", "the old"]);
/// Before the noun of what was copied.
const ORIGINAL: &Phrases =
    &Phrases::of(&["the old", "the original", "the first", "the existing", "the present"]);
const LEAVE: &Phrases = &Phrases::of(&["leave", "keep", "let", "just leave", "just keep", "please leave"]);
/// That it stays.
#[rustfmt::skip]
const STAYS: &Phrases = &Phrases::of(&["stays", "stay", "can stay", "may stay", "should stay", "must stay", "shall stay", "will stay", "is to stay", "has to stay", "ought to stay", "is staying", "remains", "remain", "can remain", "may remain", "should remain", "must remain", "shall remain", "will remain", "is to remain", "is fine", "is not to move", "should not move", "must not move", "does not move", "does not have to move", "is not to be moved", "must not be moved", "should not be moved", "is all right", "can be left", "should be left", "is to be left"]);
/// Where.
#[rustfmt::skip]
const WHERE_IT_IS: &Phrases = &Phrases::of(&["where it is", "where it stands", "where it was", "where it is now", "where it has always been", "there", "as it is", "as is", "in place", "in its place", "at its place", "on its spot", "put", "untouched", "alone", "the way it is", "too", "as well", "where it is of course", "of course"]);
/// What makes a copy.
#[rustfmt::skip]
const COPIES: &[&str] = &["copy", "copies", "copied", "duplicate", "duplicates", "clone", "clones", "replica", "replicate", "twin", "double"];
/// Before a clause, and says nothing of it.
const JOINTS: &Phrases = &Phrases::of(&["and", "but", "while", "and please", "but please", "so", "mind"]);
/// Before a place that is not meant.
#[rustfmt::skip]
const NOT: &Phrases = &Phrases::of(&["not", "and not", "but not", "certainly not", "definitely not", "and certainly not", "never", "i said not", "no not", "mind you not", "of course not", "and by no means", "by no means", "i dont mean"]);
/// Before the place that is meant.
const BUT: &Phrases = &Phrases::of(&[
    "but",
    "no",
    "rather",
    "just",
    "only",
    "simply",
    "i said",
    "i mean",
    "but just",
    "but rather",
]);
/// What was spoken of last.
const IT: &Phrases = &Phrases::of(&["it", "him", "her", "them", "that", "this"]);
/// To whom nothing is to be told: what stands behind it says who.
#[rustfmt::skip]
const SECRETS: &Phrases = &Phrases::of(&["not a word", "not one word", "not a single word", "not a peep", "not a whisper", "not a sound", "not a syllable", "dont tell", "do not tell", "dont breathe a word", "dont say a word", "dont say anything", "say nothing", "tell nobody", "tell no one", "no word", "no telling", "keep it from", "keep quiet"]);
/// Behind that.
const TO_WHOM: &[&str] = &["to", "about", "of", "from"];
/// A measure that is as it was said.
#[rustfmt::skip]
const NOT_A_BIT: &Phrases = &Phrases::of(&["not a metre", "not a meter", "not one metre", "not one meter", "not a single metre", "not an inch", "not one inch", "not a centimetre", "not a centimeter", "not a foot", "not a step", "not one step", "not a millimetre", "not a hair", "not a degree", "not a bit", "not a minute", "not a second", "not a soul", "not a single soul", "not a thing", "not a single thing", "not a single one", "not one", "not a one", "no", "nothing", "nobody", "not", "neither"]);
/// Behind that.
#[rustfmt::skip]
const LIMITS: &[&str] = &["more", "less", "further", "farther", "closer", "nearer", "fewer", "over", "under", "off", "short", "beyond", "than", "that", "and", "or", "nor", "no", "not", "one", "a", "metre", "meter", "else", "besides", "later", "earlier", "sooner", "longer", "shorter", "either", "way"];
/// What asks something.
#[rustfmt::skip]
const ASKS: &Phrases = &Phrases::of(&["how many", "how much", "how far", "how tall", "how big", "which", "who", "whos", "what", "whats", "where", "wheres", "is there", "are there", "do we have", "have we", "list", "count", "tell me", "show me", "can you tell me", "could you tell me", "do you know", "describe", "name all"]);
/// That no more than an answer is wanted.
#[rustfmt::skip]
const ONLY_ASKS: &Phrases = &Phrases::of(&["i only want to know", "i just want to know", "i only wanted to know", "i just wanted to know", "i only need to know", "i just need to know", "i only want to see", "i just want to see", "i only want the number", "i just want the number", "i only want an answer", "i just want an answer", "i only want to count them", "i just want to count them", "i only ask", "i am only asking", "im only asking", "im just asking", "i am just asking", "only asking", "just asking", "just wondering", "im only wondering", "im just wondering", "just curious", "im only curious", "im just curious", "just tell me", "only tell me", "just a question", "its only a question", "its just a question", "it is only a question", "nothing more",
    "thats all i want to know", "that is all i want to know", "thats all i need to know", "thats all", "dont do anything", "do not do anything", "dont do a thing", "dont change anything", "dont change a thing", "do not change anything", "dont touch anything", "dont touch a thing", "do not touch anything", "dont touch them", "dont touch it", "change nothing", "touch nothing", "leave them as they are", "leave everything as it is", "leave it as it is", "no need to do anything", "no need to change anything", "you neednt do anything", "you dont have to do anything", "nothing is to be changed"]);
const DONT: &Phrases = &Phrases::of(&[
    "dont",
    "do not",
    "please dont",
    "please do not",
    "no need to",
    "you neednt",
    "you need not",
    "you dont have to",
    "theres no need to",
    "there is no need to",
    "but dont",
]);
/// Behind an order that is not given.
#[rustfmt::skip]
const ANY: &Phrases = &Phrases::of(&["any", "anything", "it", "them", "one", "some", "more", "any more", "any of them", "another", "another one", "a thing", "anybody", "anyone", "him", "her", "any new ones", "new ones", "any others"]);

/// Leaves out what would be misunderstood.
pub(super) fn leave_out(lexemes: &mut Vec<Lexeme>) {
    without_unneeded(lexemes);
    without_originals(lexemes);
}

/// "We don't need another bench. What we do need is a fountain": what there is enough of, before something else.
fn without_unneeded(lexemes: &mut Vec<Lexeme>) {
    /// So many words name it at most.
    const LONGEST: usize = 6;
    let all = clauses(lexemes);
    let is_unneeded = |clause: &&Clause| {
        let said = &lexemes[clause.from..clause.end];
        let need = longest_phrase(said, NEED_NOT);
        let more = need.and_then(|need| Some(need + longest_phrase(&said[need..], MORE)?));
        let behind = lexemes.get(clause.end + 1..).unwrap_or_default();
        let is_open = behind.iter().any(|lexeme| OPEN.contains(&word_of(lexeme)));
        more.is_some_and(|more| (1..=LONGEST).contains(&(said.len() - more)))
            && !behind.is_empty()
            && !is_open
    };
    let first = all.first().filter(is_unneeded).copied();
    if let Some(clause) = first {
        lexemes.drain(..=clause.end);
    }
}

/// "Copy the bench ...; the old one may stay where it is": a copy takes nothing away.
fn without_originals(lexemes: &mut Vec<Lexeme>) {
    let all = clauses(lexemes);
    let is_told = |clause: &Clause| {
        let is_copied = lexemes[..clause.from].iter().any(|lexeme| COPIES.contains(&word_of(lexeme)));
        is_copied && stays(behind_joint(&lexemes[clause.from..clause.end]))
    };
    let out: Vec<Clause> = all.iter().skip(1).filter(|clause| is_told(clause)).copied().collect();
    if !out.is_empty() {
        *lexemes = rest_of(lexemes, &out);
    }
}

/// "The old one may stay where it is", "leave the original where it is".
fn stays(said: &[Lexeme]) -> bool {
    let is_end = |at: usize| {
        let rest = said.get(at..).unwrap_or_default();
        rest.is_empty() || longest_phrase(rest, WHERE_IT_IS) == Some(rest.len())
    };
    let leave = longest_phrase(said, LEAVE);
    let from = leave.unwrap_or(0);
    let rest = &said[from..];
    let named = longest_phrase(rest, ORIGINAL).map(|words| words + 1);
    [longest_phrase(rest, ORIGINALS), named].into_iter().flatten().any(|words| {
        let behind = from + words;
        let stay = said.get(behind..).and_then(|rest| longest_phrase(rest, STAYS));
        match (leave, stay) {
            (None, None) => false,
            (_, Some(stay)) => is_end(behind + stay),
            (Some(_), None) => behind <= said.len() && is_end(behind),
        }
    })
}

/// The words without what is denied for nothing.
pub(super) fn without(lexemes: &[Lexeme]) -> Vec<Lexeme> {
    let plain = without_denied_places(lexemes);
    let is_question = longest_phrase(&plain, ASKS).is_some();
    let is_out = |clause: &Clause| {
        let said = behind_joint(&plain[clause.from..clause.end]);
        is_idle(said) || is_question && only_asks(said)
    };
    let out: Vec<Clause> = clauses(&plain).into_iter().skip(1).filter(|clause| is_out(clause)).collect();
    if out.is_empty() { plain } else { rest_of(&plain, &out) }
}

fn behind_joint(said: &[Lexeme]) -> &[Lexeme] {
    &said[longest_phrase(said, JOINTS).unwrap_or(0)..]
}

/// "Not a word to the neighbours", "not a metre less".
fn is_idle(said: &[Lexeme]) -> bool {
    /// So many words say who is not to be told.
    const LONGEST: usize = 6;
    let is_secret = longest_phrase(said, SECRETS).is_some_and(|words| {
        let tail = &said[words..];
        let is_told =
            said.first().is_some_and(|first| ["dont", "do", "tell", "say"].contains(&word_of(first)));
        tail.is_empty()
            || tail.len() <= LONGEST
                && (is_told || TO_WHOM.contains(&word(tail, 0)))
                && longest(tail, &VERBS).is_none()
    });
    let is_as_said = longest_phrase(said, NOT_A_BIT).is_some_and(|words| {
        let tail = &said[words..];
        // "Not that one" says which.
        let is_other = ["", "that", "one", "a"].contains(&word(tail, 0));
        !is_other && tail.iter().all(|lexeme| LIMITS.contains(&word_of(lexeme)))
    });
    is_secret || is_as_said
}

/// "Don't add any", "I only want to know", behind a question.
fn only_asks(said: &[Lexeme]) -> bool {
    if longest_phrase(said, ONLY_ASKS) == Some(said.len()) {
        return true;
    }
    let Some(dont) = longest_phrase(said, DONT) else { return false };
    let Some((_, verb)) = longest(&said[dont..], &VERBS) else { return false };
    let rest = &said[dont + verb..];
    rest.is_empty() || longest_phrase(rest, ANY) == Some(rest.len())
}

/// "Beside the table. Not on it, beside it" is beside the table.
fn without_denied_places(lexemes: &[Lexeme]) -> Vec<Lexeme> {
    let all = clauses(lexemes);
    for (index, clause) in all.iter().enumerate().skip(1) {
        let before = &lexemes[..all[index - 1].end];
        let said = &lexemes[clause.from..clause.end];
        let denied = longest_phrase(said, NOT).and_then(|not| place_of_it(&said[not..], before));
        let Some(denied) = denied.filter(|denied| !stands(before, *denied)) else { continue };
        let next = all.get(index + 1).copied();
        let meant = next.and_then(|next| {
            let said = &lexemes[next.from..next.end];
            place_of_it(&said[longest_phrase(said, BUT).unwrap_or(0)..], before)
        });
        let out: Vec<Clause> = match (meant, next) {
            (Some(meant), Some(next)) if meant != denied && stands(before, meant) => vec![*clause, next],
            // Of what stands somewhere at all.
            (None, _) if (1..before.len()).any(|at| longest(&before[at..], &WAYS).is_some()) => vec![*clause],
            _ => continue,
        };
        return rest_of(lexemes, &out);
    }
    lexemes.to_vec()
}

/// The place of "beside it", or of "on the table" where that was spoken of.
fn place_of_it(said: &[Lexeme], before: &[Lexeme]) -> Option<Way> {
    /// "The round table".
    const LONGEST: usize = 3;
    let (way, words) = longest(said, &WAYS)?;
    let rest = &said[words..];
    let noun = word_of(rest.last()?);
    let is_it = longest_phrase(rest, IT) == Some(rest.len());
    let is_named = word(rest, 0) == "the"
        && (2..=LONGEST).contains(&rest.len())
        && !noun.is_empty()
        && before.iter().any(|lexeme| word_of(lexeme) == noun);
    (is_it || is_named).then_some(way)
}

/// Whether words tell of such a place.
fn stands(words: &[Lexeme], way: Way) -> bool {
    (1..words.len()).any(|at| longest(&words[at..], &WAYS).is_some_and(|(own, _)| own == way))
}
