//! Words as they are compared: stems, words that say nothing, synonyms.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::LazyLock;

/// What says nothing about a thing.
#[rustfmt::skip]
const EMPTY: &[&str] = &["a", "an", "the", "some", "any", "another", "more", "one", "thing", "things", "something",
    "please", "kind", "sort", "piece", "pair", "new", "nice", "very", "really", "its", "it", "is", "are", "be", "to", "s",
    "my", "your", "our", "this", "these", "those", "and", "or", "place"];
/// What begins a remark about the thing that was named before it.
#[rustfmt::skip]
const REMARKS: &[&str] = &["of", "for", "with", "that", "which", "who", "where", "at", "in", "on", "from", "by", "like",
    "made", "under", "near", "when", "you", "one", "people"];
/// Plurals that follow no rule.
#[rustfmt::skip]
const IRREGULAR: &[(&str, &str)] = &[("men", "man"), ("women", "woman"), ("people", "person"), ("leaves", "leaf"),
    ("mice", "mouse"), ("knives", "knife"), ("shelves", "shelf"), ("buses", "bus"), ("policemen", "policeman"),
    ("firemen", "fireman"), ("glasses", "glass"), ("kids", "child"), ("children", "child"), ("gas", "gas"), ("lens", "lens")];

/// One line for each canonical phrase: `couch: sofa, settee`.
const SYNONYMS: &str = include_str!("synonyms.txt");

/// Every synonym, as stems, with what it stands for; the longest phrases are looked for first.
pub(super) struct Synonyms {
    phrases: BTreeMap<Vec<String>, Vec<String>>,
    words: BTreeSet<String>,
    longest: usize,
}

static TABLE: LazyLock<Synonyms> = LazyLock::new(|| Synonyms::read(SYNONYMS));

impl Synonyms {
    /// Those of the table.
    pub(super) fn table() -> &'static Self {
        &TABLE
    }

    fn read(text: &str) -> Self {
        let (mut phrases, mut words) = (BTreeMap::new(), BTreeSet::new());
        let lines = text.lines().filter(|line| !line.starts_with('#'));
        for (canonical, others) in lines.filter_map(|line| line.split_once(':')) {
            for other in others.split(',') {
                phrases.insert(stems(other), stems(canonical));
                words.extend(parts(other).chain(stems(other)));
            }
        }
        let longest = phrases.keys().map(Vec::len).max().unwrap_or(0);
        Self { phrases, words, longest }
    }

    /// What the words at the start stand for, and how many they are.
    pub(super) fn at_start(&self, stems: &[String]) -> Option<(&[String], usize)> {
        (1..=self.longest.min(stems.len())).rev().find_map(|count| {
            self.phrases.get(&stems[..count]).map(|canonical| (canonical.as_slice(), count))
        })
    }
}

/// Whether a word stands in the table of synonyms.
pub(crate) fn is_synonym(word: &str) -> bool {
    let words = &Synonyms::table().words;
    words.contains(word) || words.contains(&stem(word))
}

/// The stems of a phrase, in order.
pub(super) fn stems(phrase: &str) -> Vec<String> {
    parts(phrase).map(|word| stem(&word)).collect()
}

/// The words of a phrase in small letters.
pub(super) fn parts(phrase: &str) -> impl Iterator<Item = String> + '_ {
    let phrase = phrase.split(|letter: char| !letter.is_alphanumeric() && letter != '\'' && letter != '’');
    phrase.filter(|word| !word.is_empty()).map(|word| {
        let small = word.to_lowercase();
        let own = small.split(['\'', '’']).next().unwrap_or_default();
        own.to_owned()
    })
}

pub(super) fn is_empty(word: &str) -> bool {
    EMPTY.contains(&word)
}

pub(super) fn begins_remark(word: &str) -> bool {
    REMARKS.contains(&word)
}

/// The words of a phrase that say something of a thing, each once and in order.
pub(crate) fn telling(phrase: &str) -> Vec<String> {
    let mut telling: Vec<String> = Vec::new();
    for word in parts(phrase).filter(|word| word.len() > 1 && !is_empty(word) && !begins_remark(word)) {
        if !telling.contains(&word) {
            telling.push(word);
        }
    }
    telling
}

/// A word in the singular.
pub(super) fn stem(word: &str) -> String {
    if let Some((_, one)) = IRREGULAR.iter().find(|(many, _)| *many == word) {
        return (*one).to_owned();
    }
    let length = word.chars().count();
    if length > 4
        && let Some(head) = word.strip_suffix("ies")
    {
        return format!("{head}y");
    }
    let hisses = ["ches", "shes", "sses", "xes", "zes"];
    if length > 4 && hisses.iter().any(|ending| word.ends_with(ending)) {
        return word[..word.len() - 2].to_owned();
    }
    let stays = ["ss", "us", "is"].iter().any(|ending| word.ends_with(ending));
    match word.strip_suffix('s') {
        Some(head) if length > 3 && !stays => head.to_owned(),
        _ => word.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_are_called_as_one() {
        for (many, one) in [
            ("benches", "bench"),
            ("lorries", "lorry"),
            ("boxes", "box"),
            ("houses", "house"),
            ("trees", "tree"),
            ("bus", "bus"),
            ("buses", "bus"),
            ("glass", "glass"),
            ("women", "woman"),
            ("tennis", "tennis"),
            ("skies", "sky"),
        ] {
            assert_eq!(stem(many), one);
        }
        assert_eq!(stems("Children's Bicycles"), ["child", "bicycle"]);
    }

    #[test]
    fn every_line_of_the_synonyms_means_something() {
        let mut seen = BTreeMap::new();
        for line in SYNONYMS.lines().filter(|line| !line.is_empty() && !line.starts_with('#')) {
            let (canonical, others) = line.split_once(':').unwrap_or_else(|| panic!("no colon: {line}"));
            for other in others.split(',') {
                let stems = stems(other);
                assert!(!stems.is_empty(), "{line}");
                let before = seen.insert(stems, canonical.to_owned());
                assert_eq!(before, None, "{other} stands for two things");
            }
        }
        assert!(seen.len() > 150, "{}", seen.len());
    }
}
