//! A query: the words of somebody who wants a thing, as they were said and as the catalogue would say them.

use super::words::{Synonyms, begins_remark, is_empty, parts, stem};

/// What a word of the thing itself counts, and one of a remark about it.
const THING: f64 = 1.0;
const REMARK: f64 = 0.5;

/// A word of a query.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Term {
    pub(super) stem: String,
    pub(super) weight: f64,
    /// Whether it names the thing: the last word before any remark.
    pub(super) is_head: bool,
}

/// The words of a query, first as they were said, then with synonyms put for what the catalogue calls otherwise.
pub(super) fn readings(words: &str) -> Vec<Vec<Term>> {
    let said: Vec<(String, bool)> = parts(words)
        .scan(false, |remark, word| {
            *remark |= begins_remark(&word);
            Some((word, *remark))
        })
        .collect();
    let kept: Vec<(String, bool)> = said
        .into_iter()
        .filter(|(word, _)| !is_empty(word) && !begins_remark(word))
        .map(|(word, remark)| (stem(&word), remark))
        .collect();
    let plain = terms(&kept);
    let renamed = terms(&renamed(&kept));
    if renamed == plain || plain.is_empty() { vec![plain] } else { vec![plain, renamed] }
}

fn renamed(kept: &[(String, bool)]) -> Vec<(String, bool)> {
    let stems: Vec<String> = kept.iter().map(|(stem, _)| stem.clone()).collect();
    let mut found = Vec::new();
    let mut at = 0;
    while at < kept.len() {
        if let Some((canonical, count)) = Synonyms::table().at_start(&stems[at..]) {
            // What a phrase of thing and remark stands for is the thing.
            found.extend(canonical.iter().map(|stem| (stem.clone(), kept[at].1)));
            at += count;
        } else {
            found.push(kept[at].clone());
            at += 1;
        }
    }
    found
}

fn terms(kept: &[(String, bool)]) -> Vec<Term> {
    let head = kept.iter().rposition(|(_, remark)| !remark).or(kept.len().checked_sub(1));
    let mut terms: Vec<Term> = Vec::new();
    for (index, (stem, remark)) in kept.iter().enumerate() {
        let is_head = Some(index) == head;
        if let Some(known) = terms.iter_mut().find(|term| term.stem == *stem) {
            known.is_head |= is_head;
        } else {
            let weight = if *remark { REMARK } else { THING };
            terms.push(Term { stem: stem.clone(), weight, is_head });
        }
    }
    terms
}

#[cfg(test)]
mod tests {
    use super::*;

    fn said(words: &str) -> Vec<Vec<(String, bool)>> {
        let reading = |terms: Vec<Term>| terms.into_iter().map(|term| (term.stem, term.is_head)).collect();
        readings(words).into_iter().map(reading).collect()
    }

    #[test]
    fn the_last_word_before_a_remark_is_the_thing() {
        let own = |words: &[(&str, bool)]| {
            words.iter().map(|(word, head)| ((*word).to_owned(), *head)).collect::<Vec<_>>()
        };
        assert_eq!(said("the bridges of Paris"), [own(&[("bridge", true), ("paris", false)])]);
        assert_eq!(said("a red sofa")[1], own(&[("red", false), ("couch", true)]));
        assert_eq!(said("porta potty")[1], own(&[("portable", false), ("toilet", true)]));
        assert_eq!(said("the"), [own(&[])]);
    }
}
