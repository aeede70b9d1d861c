//! Words between which a space was lost: "nextto the oak", "paintthe hedge", "in frontof thelamp".
//!
//! Only a word that nobody knows is taken apart, and only where its parts are a phrase of place or a part of one, a verb of an order and a small word behind
//! it, or "the" and a word that is known.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use super::words;

/// Shorter words are no two.
const SHORTEST: usize = 5;
/// Behind "the" a shorter word is none.
const NOUN: usize = 3;
/// Behind the verb of an order.
const BEHIND: &[&str] = &["the", "it", "this", "that", "my", "all", "them"];
/// Before "the", besides verbs and phrases of place.
const BEFORE: &[&str] = &["of", "from", "and", "with", "for", "to", "is", "than", "all", "both", "are"];

/// What several words look like as one, and the words.
static JOINED: LazyLock<BTreeMap<String, String>> = LazyLock::new(|| {
    let mut joined = BTreeMap::new();
    let mut put = |parts: &[&str]| {
        let one = parts.concat();
        if parts.len() > 1 && one.len() >= SHORTEST {
            joined.entry(one).or_insert_with(|| parts.join(" "));
        }
    };
    for phrase in words::ways().chain(BEFORE.iter().copied()) {
        let parts: Vec<&str> = phrase.split(' ').collect();
        for from in 0..parts.len() {
            for to in from + 1..=parts.len() {
                put(&parts[from..to]);
            }
            put(&[&parts[from..], &["the"]].concat());
        }
    }
    for verb in words::verbs().filter(|verb| !verb.contains(' ')) {
        for behind in BEHIND.iter().copied() {
            put(&[verb, behind]);
        }
    }
    joined
});

/// The words that were written as one, if they were.
pub(super) fn apart(word: &str, knows: &dyn Fn(&str) -> bool) -> Option<Vec<String>> {
    if let Some(parts) = JOINED.get(word) {
        return Some(parts.split(' ').map(str::to_owned).collect());
    }
    let noun = word.strip_prefix("the").filter(|noun| noun.len() >= NOUN && knows(noun))?;
    Some(vec!["the".to_owned(), noun.to_owned()])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parts(word: &str) -> Option<String> {
        apart(word, &|word: &str| ["oak", "lamp"].contains(&word)).map(|parts| parts.join(" "))
    }

    #[test]
    fn lost_spaces_are_found_again() {
        for (word, meant) in [
            ("nextto", "next to"),
            ("nexttothe", "next to the"),
            ("paintthe", "paint the"),
            ("makeit", "make it"),
            ("frontof", "front of"),
            ("ontop", "on top"),
            ("behindthe", "behind the"),
            ("ofthe", "of the"),
            ("thelamp", "the lamp"),
        ] {
            assert_eq!(parts(word).as_deref(), Some(meant), "{word}");
        }
    }

    #[test]
    fn other_words_stay_whole() {
        for word in ["unicorn", "rabbit", "theory", "oakthe", "benchnext", "toby"] {
            assert_eq!(parts(word), None, "{word}");
        }
    }
}
