//! Nouns that a class has for any of its things, and that people have for one of them alone: a cab is a taxi and no car of another sort, a kid is a child,
//! a bloke a man.
//!
//! Where something is spoken of that is there, such a noun still means any of its class: who says "that cab" may mean any car that looks like one.

use super::super::sorts::singulars;
use crate::editing::Stock;

/// What is said, and what the catalogue calls it.
#[rustfmt::skip]
const NICKNAMES: &[(&[&str], &str)] = &[
    (&["cab", "taxicab", "minicab"], "taxi"),
    (&["kid", "kiddo", "kiddie", "toddler", "nipper", "infant", "schoolchild", "schoolkid"], "child"),
    (&["lad", "laddie", "schoolboy"], "boy"),
    (&["lass", "lassie", "schoolgirl"], "girl"),
    (&["bloke", "chap", "guy", "gentleman", "gentlemen", "fellow", "geezer"], "man"),
    (&["lady", "ladies", "gal"], "woman"),
];

/// What the catalogue calls what somebody calls so, if it has it.
pub(super) fn plainly(said: &str, stock: &Stock) -> Option<&'static str> {
    let is_said = |words: &[&str]| singulars(said).any(|one| words.contains(&one.as_str()));
    let (_, plain) = NICKNAMES.iter().find(|(words, _)| is_said(words))?;
    (stock.catalogue.find(said).is_none() && stock.catalogue.find(plain).is_some()).then_some(*plain)
}

/// Every word of the table, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    NICKNAMES.iter().flat_map(|(words, _)| *words).copied()
}
