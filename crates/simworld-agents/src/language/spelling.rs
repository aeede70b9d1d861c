//! Misspelt words: each is put right if one known word, and one only, is near enough.

use super::compass;
use super::lexer::{Lexeme, Token};
use super::lexicon::{CATEGORIES, COPULAS, DETERMINERS, FARTHEST, MOSTS, NEAREST, RELATIONS, SIDES};
use super::paint::PAINTS;
use super::politeness::{FILLERS, JOINTS};
use super::requests;
use super::verbs::{self, base_form};

/// Words that people mean though a known word is near: none of them is a misspelling.
const OTHER_WORDS: &str = include_str!("other_words.txt");

/// Puts the words of a sentence right that are unknown and near one known word, or two known words in one; `names` are
/// the words of names and goods.
pub(super) fn correct(lexemes: &mut Vec<Lexeme>, names: &dyn Fn() -> Vec<String>) {
    let mut known: Option<Vec<String>> = None;
    let mut at = 0;
    while at < lexemes.len() {
        let here = at;
        at += 1;
        let Token::Word(word) = &lexemes[here].token else { continue };
        if word.chars().count() < 3 || is_known(word) {
            continue;
        }
        let names = known.get_or_insert_with(names);
        if names.contains(word) {
            continue;
        }
        let follows_verb = here > 0 && is_verb(&lexemes[here - 1].token);
        if let Some(parts) = parts(word, names) {
            let lexeme = lexemes[here].clone();
            let both = parts.map(|part| Lexeme {
                lemma: base_form(&part),
                token: Token::Word(part),
                ..lexeme.clone()
            });
            lexemes.splice(here..=here, both);
        } else if let Some(right) = nearest(word, names, follows_verb) {
            lexemes[here].lemma = base_form(&right);
            lexemes[here].token = Token::Word(right);
        }
    }
}

/// Whether the token is an order by itself: after it stands no other.
fn is_verb(token: &Token) -> bool {
    matches!(token, Token::Word(word) if verbs::phrases().any(|(_, phrase)| phrase == word))
}

/// "Icecream", "busstop": two words of names, or two of the grammar, that are written as one.
fn parts(word: &str, names: &[String]) -> Option<[String; 2]> {
    let has_meaning = |part: &str| {
        let words = vocabulary();
        words.binary_search_by_key(&part, |(known, _)| *known).is_ok_and(|found| words[found].1)
    };
    let named = |part: &str| names.iter().any(|name| name == part);
    let long = |part: &str| part.chars().count() >= 3;
    let mut splits =
        word.char_indices().map(|(at, _)| word.split_at(at)).filter(|(one, other)| long(one) && long(other));
    let fitting =
        splits.find(|(one, other)| named(one) && named(other) || has_meaning(one) && has_meaning(other));
    fitting.map(|(one, other)| [one.to_owned(), other.to_owned()])
}

/// Words of conditions and quantities, which stand in no table of their own.
const MORE_WORDS: &str = include_str!("more_words.txt");

fn phrases() -> impl Iterator<Item = &'static str> {
    let classes = CATEGORIES.iter().flat_map(|category| category.words);
    let verbs = verbs::phrases().map(|(_, phrase)| phrase);
    let relations = RELATIONS.iter().flat_map(|(words, _)| *words);
    let sides = SIDES.iter().flat_map(|(words, _)| *words);
    let paints = PAINTS.iter().flat_map(|(words, _)| *words);
    let mosts = MOSTS.iter().flat_map(|(words, _)| *words);
    let lists = [FILLERS, JOINTS, COPULAS, DETERMINERS, NEAREST, FARTHEST];
    let rest = lists.into_iter().flatten();
    let tables = classes.chain(relations).chain(sides).chain(paints).chain(mosts).chain(rest).copied();
    tables.chain(verbs)
}

/// Every single word that is known, in alphabetical order, and whether it means something to the grammar.
fn vocabulary() -> &'static [(&'static str, bool)] {
    static WORDS: std::sync::OnceLock<Vec<(&'static str, bool)>> = std::sync::OnceLock::new();
    WORDS.get_or_init(|| {
        let meaning = phrases().flat_map(|phrase| phrase.split(' ')).chain(MORE_WORDS.split_whitespace());
        let small = requests::small_words().chain(compass::words().flat_map(|phrase| phrase.split(' ')));
        let other = OTHER_WORDS.split_whitespace().chain(small).map(|word| (word, false));
        let mut words: Vec<(&str, bool)> = meaning.map(|word| (word, true)).chain(other).collect();
        // Of a word in both lists the meaning counts.
        words.sort_unstable_by(|a, b| a.0.cmp(b.0).then(b.1.cmp(&a.1)));
        words.dedup_by_key(|(word, _)| *word);
        words
    })
}

fn is_known(word: &str) -> bool {
    let listed = |word: &str| vocabulary().binary_search_by_key(&word, |(known, _)| *known).is_ok();
    listed(word)
        || word.strip_suffix('s').is_some_and(listed)
        || word.strip_suffix("es").is_some_and(listed)
        || word.strip_suffix("ies").is_some_and(|stem| listed(&format!("{stem}y")))
        || base_form(word).is_some()
}

/// How one spelling comes from another, the likeliest slip first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Slip {
    /// Letters out of order.
    Swapped,
    /// A letter too many or too few.
    Count,
    /// Another letter: it may be another word.
    Letter,
}

/// The known word nearest to one that is not: at most one edit, or two in seven letters, or two vowels. Of several as
/// near the likelier slip is taken, then what the grammar knows, then what is no verb behind a verb; if that leaves two,
/// or a word of no meaning here, none is.
fn nearest(word: &str, names: &[String], follows_verb: bool) -> Option<String> {
    let mut best: Vec<&str> = Vec::new();
    let mut least = (usize::MAX, Slip::Letter, true);
    let names = names.iter().map(|name| (name.as_str(), true));
    for (candidate, has_meaning) in vocabulary().iter().copied().chain(names) {
        let Some((distance, slip)) = slip(word, candidate) else { continue };
        let rank = (distance, slip, !has_meaning);
        if rank < least {
            least = rank;
            best.clear();
        }
        if rank == least && !best.contains(&candidate) {
            best.push(candidate);
        }
    }
    if follows_verb && best.len() > 1 {
        best.retain(|word| !is_verb(&Token::Word((*word).to_owned())));
    }
    match best[..] {
        [one] if !least.2 => Some(one.to_owned()),
        _ => None,
    }
}

/// How far a spelling is from a word, in edits, and what kind of slip that is; `None` if it is too far.
fn slip(word: &str, candidate: &str) -> Option<(usize, Slip)> {
    let length = word.chars().count();
    let tolerance = if length < 7 { 1 } else { 2 };
    if candidate.len() < 3 || candidate.len().abs_diff(word.len()) > 2 {
        return None;
    }
    if folded(word) == folded(candidate) {
        return Some((1, Slip::Count));
    }
    if !alike(word, candidate) {
        return None;
    }
    let distance = strsim::osa_distance(word, candidate);
    let slip = match candidate.chars().count() == length {
        true if is_anagram(word, candidate) => Slip::Swapped,
        true => Slip::Letter,
        false => Slip::Count,
    };
    let only_vowels = distance == 2 && length >= 4 && skeleton(word) == skeleton(candidate);
    if only_vowels && distance > tolerance {
        return Some((distance, Slip::Letter));
    }
    (distance <= tolerance && !(length == 3 && slip == Slip::Letter)).then_some((distance, slip))
}

/// The word as it sounds, roughly: "foto" and "photo" are one.
fn folded(word: &str) -> String {
    let mut sound = word.replace("ph", "f").replace("ck", "k").replace("wh", "w");
    let mut last = None;
    sound.retain(|letter| last.replace(letter) != Some(letter));
    sound
}

/// Its first letter and the consonants behind it.
fn skeleton(word: &str) -> String {
    let mut letters = word.chars();
    let first = letters.next();
    first.into_iter().chain(letters.filter(|letter| !"aeiouy".contains(*letter))).collect()
}

/// Slips keep the first letter, or swap it with the second.
fn alike(word: &str, candidate: &str) -> bool {
    let (mut a, mut b) = (word.chars(), candidate.chars());
    let (a0, b0, a1, b1) = (a.next(), b.next(), a.next(), b.next());
    a0 == b0 || (a0 == b1 && a1 == b0)
}

fn is_anagram(a: &str, b: &str) -> bool {
    let sorted = |text: &str| {
        let mut letters: Vec<char> = text.chars().collect();
        letters.sort_unstable();
        letters
    };
    sorted(a) == sorted(b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_are_put_right_and_other_words_left_alone() {
        let none: Vec<String> = Vec::new();
        for (slip, right) in [
            ("musem", "museum"),
            ("chiar", "chair"),
            ("pikc", "pick"),
            ("nearst", "nearest"),
            ("teh", "the"),
            ("wallk", "walk"),
        ] {
            assert_eq!(nearest(slip, &none, false).as_deref(), Some(right), "{slip}");
        }
        for word in ["beach", "peer", "boat", "horse", "floor"] {
            assert!(is_known(word), "{word} is a word of its own");
        }
    }
}
