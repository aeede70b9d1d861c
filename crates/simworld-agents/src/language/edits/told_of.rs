//! Who is told of, whatever he does, and for whom a pronoun stands behind it: "Hana posts a lot of cards; put a letter box within five metres of her",
//! "Ada fancies a lie-down; a deck chair right next to her would be lovely", "Poor Carol's legs are tired, she needs a chair at her side".
//!
//! What he does may be any words, also such that are nouns as well. So this is tried only where a sentence was refused in every other way, where one body
//! alone is named in what is told, nothing there asks for anything, and the rest speaks of no thing by a pronoun.

use simworld_core::id::EntityId;

use super::super::lexer::{Lexeme, is_mark, word_of};
use super::super::lexicon::{category, is_animate, longest, longest_phrase};
use super::super::names::Names;
use super::super::phrases::Phrases;
use super::forms::{word, word_at, words_at};
use super::remarked::plain_noun;
use super::told::ORDERS_ANYTHING;
use super::words::{VERBS, WAYS};

/// So many marks are tried.
const MOST_MARKS: usize = 3;
/// Before who is told of.
#[rustfmt::skip]
const LEADS: &[&str] = &["oh", "well", "poor", "dear", "our", "old", "good", "as", "since", "because", "and", "but", "now", "look", "see", "lovely", "sweet", "little", "ah", "clearly", "apparently"];
/// By these something is asked for in what is told.
#[rustfmt::skip]
const ASKS: &Phrases = &Phrases::of(&["if", "unless", "until", "except", "instead", "i mean", "i meant", "scratch that", "no wait", "wait no", "correction", "undo", "never mind", "forget it", "please", "could you", "can you", "would you", "will you", "how about", "why not", "should", "must", "ought", "shall", "lets", "let us", "rather than", "only the",
    "not the", "has to go", "needs to go", "is to go", "has to be", "needs to be", "is to be", "not"]);
/// Who may be meant as well, though nobody of the scene is named by it.
#[rustfmt::skip]
const OTHERS: &[&str] = &["mother", "mum", "mom", "father", "dad", "friend", "friends", "sister", "brother", "daughter", "son", "wife", "husband", "boss", "colleague", "teacher", "student", "woman", "man", "girl", "boy", "lady", "client", "baby", "granny", "grandmother", "grandfather", "neighbour", "doctor", "nurse", "guest", "visitor", "dog", "cat", "robot",
    "girlfriend", "boyfriend", "aunt", "uncle", "cousin", "child", "customer", "partner"];
/// Before what is asked for because of it.
const SO: &Phrases = &Phrases::of(&[
    "so please",
    "and so",
    "so",
    "therefore",
    "hence",
    "thus",
    "that is why",
    "thats why",
    "which is why",
]);
/// Words for who is told of.
const WHOM: &[&str] = &["him", "her", "he", "she"];
const SHORT: &[(&str, &str)] = &[("hes", "is"), ("shes", "is"), ("hell", "will"), ("shell", "will")];
/// At somebody's side, before and behind whose it is.
const AT: &[&str] = &["at", "by", "on"];
/// What speaks of a thing that was named before.
const POINTS_BACK: &[&str] = &["it", "its", "them", "there", "they", "that", "those", "one", "ones", "his"];

/// The requests behind what is told, each with the name in the place of the pronouns for who is told of.
pub(super) fn ways(words: &str, lexemes: &[Lexeme], names: &Names<'_>) -> Vec<Vec<Lexeme>> {
    let marks = (2..lexemes.len().saturating_sub(2)).filter(|at| is_mark(&lexemes[*at]));
    marks
        .take(MOST_MARKS)
        .filter_map(|mark| {
            let (who, name) = told_of(words, &lexemes[..mark], names)?;
            with_name(&lexemes[mark + 1..], &name, &who, names)
        })
        .collect()
}

/// Somebody of the scene: by his name who he is, and else nobody certain; how many words name him; and what stands for him.
type Somebody = (Vec<EntityId>, usize, Vec<Lexeme>);

/// Who of the scene is told of, and his name, if nobody else is and nothing is asked for.
fn told_of(words: &str, told: &[Lexeme], names: &Names<'_>) -> Option<(Vec<EntityId>, Vec<Lexeme>)> {
    let leads = |lexeme: &&Lexeme| is_mark(lexeme) || LEADS.contains(&word_of(lexeme));
    let from = told.iter().take_while(leads).count();
    let (who, count, name) = somebody(words, &told[from..], names)?;
    let rest = &told[from + count..];
    let asks = |at: usize| {
        longest_phrase(&rest[at..], ASKS).is_some() && !is_guess(rest, at) || OTHERS.contains(&word(rest, at))
    };
    let is_other = |at: usize| {
        somebody(words, &rest[at..], names).is_some_and(|(other, ..)| other.is_empty() || other != who)
    };
    let is_order = longest_phrase(told, ORDERS_ANYTHING).is_some()
        || from == 0 && longest(told, &VERBS).is_some_and(|(_, words)| words > count);
    let tells = rest.iter().any(|lexeme| !is_mark(lexeme));
    (tells && !is_order && !(0..rest.len()).any(|at| asks(at) || is_other(at))).then_some((who, name))
}

/// Whether "must" only guesses how somebody is: "must be bored", and not "must be next to her".
fn is_guess(rest: &[Lexeme], at: usize) -> bool {
    #[rustfmt::skip]
    const FEELS: &[&str] = &["bored", "lonely", "lonesome", "tired", "exhausted", "knackered", "hungry", "thirsty", "starving", "parched", "famished", "cold", "freezing", "hot", "boiling", "sad", "unhappy", "miserable", "fed", "sick", "scared", "frightened", "worn", "weary", "dying", "gasping", "desperate", "uncomfortable", "sleepy", "shattered", "restless", "soaked", "drenched", "depressed", "homesick"];
    #[rustfmt::skip]
    const HOW: &[&str] = &["so", "very", "really", "all", "awfully", "terribly", "quite", "rather", "pretty", "dead", "absolutely", "feeling", "getting", "utterly"];
    if word(rest, at) != "must" || !matches!(word(rest, at + 1), "be" | "feel" | "get" | "seem") {
        return false;
    }
    let from = at + 2;
    let how = (from..rest.len()).take_while(|at| HOW.contains(&word(rest, *at))).count();
    FEELS.contains(&word(rest, from + how))
}

/// Who is named here: "Hana", "Hana's", "the dog".
fn somebody(words: &str, lexemes: &[Lexeme], names: &Names<'_>) -> Option<Somebody> {
    let one = |said: &[Lexeme]| {
        let (ids, count) = names.exact(said)?;
        (ids.len() == 1 && is_body(&ids, names)).then_some((ids, count))
    };
    if let Some((ids, count)) = one(lexemes) {
        return Some((ids, count, lexemes[..count].to_vec()));
    }
    if let Some(count) = plain_noun(lexemes).filter(|count| is_body_of_a_sort(&lexemes[..*count])) {
        return Some((Vec::new(), count, lexemes[..count].to_vec()));
    }
    let owner = vec![owner_at(words, lexemes.first()?)?];
    one(&owner).filter(|(_, count)| *count == 1).map(|(ids, _)| (ids, 1, owner))
}

/// Whether a noun phrase ends with a word for somebody: "the brown dog".
fn is_body_of_a_sort(said: &[Lexeme]) -> bool {
    let noun = (0..said.len()).find_map(|at| {
        category(&said[at..]).filter(|(_, words)| at + words == said.len()).map(|(class, _)| class)
    });
    noun.is_some_and(|class| {
        let kinds = class.kinds();
        !kinds.is_empty() && kinds.iter().all(|kind| is_animate(*kind))
    })
}

/// Whose something is, by the "'s" that is written: "Fay's".
pub(super) fn owner_at(words: &str, lexeme: &Lexeme) -> Option<Lexeme> {
    let written = words.get(lexeme.start..lexeme.end)?;
    let is_owner = written.ends_with("'s") || written.ends_with("’s");
    let stem = word_of(lexeme).strip_suffix('s').filter(|stem| is_owner && !stem.is_empty())?;
    Some(word_at(lexeme, stem))
}

/// A request with the name in the place of the pronouns; none if it has none, names somebody else before them, or speaks of something else that was named
/// before.
fn with_name(order: &[Lexeme], name: &[Lexeme], who: &[EntityId], names: &Names<'_>) -> Option<Vec<Lexeme>> {
    let so = longest_phrase(order, SO).unwrap_or(0);
    let order = &order[so..];
    let (mut told, mut any) = (Vec::with_capacity(order.len() + name.len()), false);
    let mut at = 0;
    while at < order.len() {
        let said = word(order, at);
        let is_other =
            || names.exact(&order[at..]).is_some_and(|(ids, _)| ids != who && is_body(&ids, names));
        if let Some(end) = at_side(order, at) {
            told.extend(words_at(&order[at], "next to"));
            told.extend_from_slice(name);
            (at, any) = (end, true);
        } else if let Some((_, verb)) = SHORT.iter().find(|(short, _)| *short == said) {
            told.extend_from_slice(name);
            told.push(word_at(&order[at], verb));
            (at, any) = (at + 1, true);
        } else if WHOM.contains(&said) && !is_possessive(order, at) {
            told.extend_from_slice(name);
            (at, any) = (at + 1, true);
        } else if points_back(order, at) || WHOM.contains(&said) || !any && is_other() {
            return None;
        } else {
            told.push(order[at].clone());
            at += 1;
        }
    }
    any.then_some(told)
}

/// Whether a word speaks of a thing that was named before: "one" does, and "one chair" does not.
fn points_back(order: &[Lexeme], at: usize) -> bool {
    let is_number = || {
        let behind = order.get(at + 1..).unwrap_or_default();
        word(order, at) == "one" && !word(order, at + 1).is_empty() && longest(behind, &WAYS).is_none()
    };
    POINTS_BACK.contains(&word(order, at)) && !is_number()
}

/// Whether any of some things is somebody.
fn is_body(ids: &[EntityId], names: &Names<'_>) -> bool {
    ids.iter().any(|id| names.scene.entity(*id).is_some_and(|entity| is_animate(entity.kind)))
}

/// Where "at her side" ends, if it begins here.
fn at_side(order: &[Lexeme], at: usize) -> Option<usize> {
    let is_side = AT.contains(&word(order, at))
        && matches!(word(order, at + 1), "his" | "her")
        && word(order, at + 2) == "side";
    is_side.then_some(at + 3)
}

/// "Her bench", and neither "next to her would be lovely" nor "near her by the oak".
fn is_possessive(order: &[Lexeme], at: usize) -> bool {
    let behind = order.get(at + 1..).unwrap_or_default();
    word(order, at) == "her" && category(behind).is_some() && longest(behind, &WAYS).is_none()
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::lex;
    use super::{at_side, is_body_of_a_sort, is_guess, is_possessive, owner_at, points_back};

    #[test]
    fn whose_something_is_is_written() {
        let owner = |said: &str| owner_at(said, &lex(said)[0]).map(|owner| owner.token);
        assert_eq!(owner("Hana's legs"), Some(lex("hana")[0].token.clone()));
        assert_eq!(owner("Carlos waits"), None);
    }

    #[test]
    fn her_may_be_whose() {
        let is_whose = |said: &str| {
            let lexemes = lex(said);
            (0..lexemes.len()).any(|at| is_possessive(&lexemes, at))
        };
        assert!(is_whose("a lamp near her bench"));
        assert!(!is_whose("a deck chair right next to her would be lovely"));
        assert!(!is_whose("the tree nearest to her"));
        assert_eq!(at_side(&lex("at her side"), 0), Some(3));
        assert_eq!(at_side(&lex("at her bench"), 0), None);
    }

    #[test]
    fn somebody_may_have_no_name() {
        assert!(is_body_of_a_sort(&lex("the brown dog")));
        assert!(!is_body_of_a_sort(&lex("the brown bench")));
    }

    #[test]
    fn how_somebody_must_be_is_guessed() {
        let guesses = |said: &str| is_guess(&lex(said), 0);
        assert!(guesses("must be bored all on his own") && guesses("must feel so lonely"));
        assert!(!guesses("must be next to anna") && !guesses("must be green") && !guesses("must go"));
    }

    #[test]
    fn one_may_be_a_number() {
        let points = |said: &str| points_back(&lex(said), 0);
        assert!(points("one next to her") && points("one") && points("it is here"));
        assert!(!points("one chair next to her"));
    }
}
