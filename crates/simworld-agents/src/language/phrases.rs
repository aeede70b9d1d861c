//! Phrases filed by their first word: of the thousands that the grammar knows few are looked at for each word said.

use std::borrow::Cow;

use super::lexer::{Lexeme, Token};
use super::lexicon::fits;

/// A figure of a word that tells most words apart, cheap enough to be had again for every question.
const fn figure(word: &[u8]) -> u64 {
    let mut letters = 0;
    let mut at = 0;
    while at < word.len() && at < 8 {
        letters |= (word[at] as u64) << (8 * at);
        at += 1;
    }
    // What two long words share at their beginnings they rarely share at their ends as well.
    let last = if word.len() > 8 { (word[word.len() - 1] as u64) << 40 } else { 0 };
    (letters ^ last ^ ((word.len() as u64) << 56)).wrapping_mul(0x9E37_79B9_7F4A_7C15)
}

/// The bytes of the first word of a phrase.
const fn first_word(phrase: &str) -> &[u8] {
    let bytes = phrase.as_bytes();
    let mut end = 0;
    while end < bytes.len() && bytes[end] != b' ' {
        end += 1;
    }
    bytes.split_at(end).0
}

/// A list of phrases that knows of most words that none of them begins so.
#[derive(Debug)]
pub(super) struct Phrases {
    list: &'static [&'static str],
    firsts: [u64; 16],
}

impl Phrases {
    /// The list, with a bit set for each first word.
    pub(super) const fn of(list: &'static [&'static str]) -> Self {
        let mut firsts = [0; 16];
        let mut at = 0;
        while at < list.len() {
            let (which, bit) = place(figure(first_word(list[at])));
            firsts[which] |= bit;
            at += 1;
        }
        Self { list, firsts }
    }

    pub(super) fn iter(&self) -> std::slice::Iter<'static, &'static str> {
        self.list.iter()
    }

    /// Whether one of them is this.
    pub(super) fn contains(&self, phrase: &str) -> bool {
        self.may_begin(phrase.split(' ').next().unwrap_or_default()) && self.list.contains(&phrase)
    }
}

impl IntoIterator for &Phrases {
    type Item = &'static &'static str;
    type IntoIter = std::slice::Iter<'static, &'static str>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

/// Which of 1024 bits stands for a figure.
const fn place(figure: u64) -> (usize, u64) {
    ((figure >> 60) as usize, 1 << ((figure >> 54) & 63))
}

/// What phrases may be kept in.
pub(super) trait PhraseList {
    /// Whether one of them may begin with the word: "no" is certain.
    fn may_begin(&self, word: &str) -> bool;
    fn list(&self) -> &[&str];
}

impl PhraseList for Phrases {
    fn may_begin(&self, word: &str) -> bool {
        let (which, bit) = place(figure(word.as_bytes()));
        self.firsts[which] & bit != 0
    }

    fn list(&self) -> &[&str] {
        self.list
    }
}

impl PhraseList for [&str] {
    fn may_begin(&self, _: &str) -> bool {
        true
    }

    fn list(&self) -> &[&str] {
        self
    }
}

impl<const N: usize> PhraseList for [&str; N] {
    fn may_begin(&self, _: &str) -> bool {
        true
    }

    fn list(&self) -> &[&str] {
        self
    }
}

impl<L: PhraseList + ?Sized> PhraseList for &L {
    fn may_begin(&self, word: &str) -> bool {
        (**self).may_begin(word)
    }

    fn list(&self) -> &[&str] {
        (**self).list()
    }
}

/// Phrases with what they stand for, found by their first word.
pub(super) struct Index<T> {
    /// Where a figure's slot is, one more than its place; as many again are left empty.
    table: Vec<u16>,
    slots: Vec<(Cow<'static, str>, Vec<Filed<T>>)>,
}

/// A phrase behind its first word.
struct Filed<T> {
    rest: &'static str,
    words: usize,
    value: T,
}

impl<T: Copy> Index<T> {
    /// Files phrases; of two that are as long the one that came first counts.
    pub(super) fn new(phrases: impl Iterator<Item = (&'static str, T)>) -> Self {
        Self::with_forms(phrases.map(|(phrase, value)| {
            let (first, rest) = phrase.split_once(' ').unwrap_or((phrase, ""));
            (Cow::Borrowed(first), rest, value)
        }))
    }

    /// Files the phrases of a table.
    pub(super) fn of(table: &'static [(&[&str], T)]) -> Self {
        Self::new(table.iter().flat_map(|(phrases, entry)| phrases.iter().map(|phrase| (*phrase, *entry))))
    }

    /// Files phrases under first words of any form.
    pub(super) fn with_forms(phrases: impl Iterator<Item = (Cow<'static, str>, &'static str, T)>) -> Self {
        let mut slots: Vec<(Cow<'static, str>, Vec<Filed<T>>)> = Vec::new();
        let mut by_word = std::collections::BTreeMap::new();
        for (first, rest, value) in phrases {
            let at = *by_word.entry(first.clone()).or_insert_with(|| {
                slots.push((first, Vec::new()));
                slots.len() - 1
            });
            let words = 1 + rest.split_whitespace().count();
            slots[at].1.push(Filed { rest, words, value });
        }
        for (_, filed) in &mut slots {
            filed.sort_by_key(|phrase| std::cmp::Reverse(phrase.words));
        }
        let mut table = vec![0; (slots.len() * 2).next_power_of_two().max(2)];
        for (slot, (first, _)) in slots.iter().enumerate() {
            let mut at = start(figure(first.as_bytes()), table.len());
            while table[at] != 0 {
                at = (at + 1) % table.len();
            }
            table[at] = slot as u16 + 1;
        }
        Self { table, slots }
    }

    fn filed(&self, first: &str) -> &[Filed<T>] {
        let mut at = start(figure(first.as_bytes()), self.table.len());
        while let Some((word, filed)) = self.table[at].checked_sub(1).map(|slot| &self.slots[slot as usize]) {
            if word == first {
                return filed;
            }
            at = (at + 1) % self.table.len();
        }
        &[]
    }

    /// Whether a phrase begins with the word.
    pub(super) fn begins(&self, word: &str) -> bool {
        !self.filed(word).is_empty()
    }

    /// What the word stands for by itself.
    pub(super) fn alone(&self, word: &str) -> Option<T> {
        self.filed(word).iter().find(|phrase| phrase.rest.is_empty()).map(|phrase| phrase.value)
    }

    /// The longest phrase at the start, with the number of its words.
    pub(super) fn longest(&self, lexemes: &[Lexeme]) -> Option<(T, usize)> {
        let Token::Word(first) = &lexemes.first()?.token else { return None };
        self.longest_behind(first, &lexemes[1..])
    }

    /// The longest phrase that begins with the word and goes on so.
    pub(super) fn longest_behind(&self, first: &str, after: &[Lexeme]) -> Option<(T, usize)> {
        let fitting = self.filed(first).iter().find(|phrase| fits_behind(phrase.rest, after))?;
        Some((fitting.value, fitting.words))
    }

    /// As [`Self::longest`], where what goes on is compared in a way of its own.
    pub(super) fn longest_by(
        &self,
        lexemes: &[Lexeme],
        fits: impl Fn(&[Lexeme], &str) -> bool,
    ) -> Option<(T, usize)> {
        let Token::Word(first) = &lexemes.first()?.token else { return None };
        let fitting = self.filed(first).iter().find(|phrase| fits(&lexemes[1..], phrase.rest))?;
        Some((fitting.value, fitting.words))
    }
}

fn fits_behind(rest: &str, after: &[Lexeme]) -> bool {
    rest.is_empty() || fits(after, rest).is_some()
}

/// Where in a table of a power of two a figure is looked for first.
const fn start(figure: u64, length: usize) -> usize {
    (figure >> 40) as usize & (length - 1)
}

#[cfg(test)]
mod tests {
    use super::super::lexer::lex;
    use super::*;

    #[test]
    fn of_the_phrases_of_a_word_the_longest_counts_and_of_two_the_first() {
        let index =
            Index::new([("go", 1), ("go to", 2), ("go to the", 3), ("go to", 4), ("gone", 5)].into_iter());
        let longest = |text: &str| index.longest(&lex(text));
        assert_eq!(longest("go to the bench"), Some((3, 3)));
        assert_eq!(longest("go to a bench"), Some((2, 2)));
        assert_eq!(longest("go"), Some((1, 1)));
        assert_eq!(longest("going"), None);
        assert_eq!(longest("12"), None);
        assert_eq!((index.alone("gone"), index.alone("to")), (Some(5), None));
        assert!(index.begins("go") && !index.begins("to"));
    }

    #[test]
    fn no_first_word_of_a_list_is_ruled_out() {
        const LIST: &Phrases = &Phrases::of(&["to", "over to", "on the other side of", "whensoever it is"]);
        assert!(LIST.iter().all(|phrase| LIST.may_begin(phrase.split(' ').next().unwrap_or_default())));
        assert!(!LIST.may_begin("bench"));
    }
}
