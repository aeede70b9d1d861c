//! Misspelt words of edits: those of verbs, relations and the catalogue come first, then those that all sentences share.

use std::collections::BTreeSet;
use std::sync::LazyLock;

use super::super::lexer::{Lexeme, Token};
use super::super::lexicon::CATEGORIES;
use super::super::names::Names;
use super::super::paint::PAINTS;
use super::super::spelling::{NO_SLIP, correct_but, is_known};
use super::super::streets::StreetNames;
use super::super::verbs::base_form;
use super::forms::is_same;
use super::{lost_spaces, words};
use crate::editing::Stock;
use crate::retrieval::is_synonym;

/// Words shorter than this are taken as they are.
const SHORTEST: usize = 3;
/// From this length on two slips are forgiven.
const LONG: usize = 8;
/// Abbreviations: the mark behind them ends no sentence.
#[rustfmt::skip]
const SHORT_FORMS: &[&str] = &["st", "dr", "mr", "mrs", "ms", "ave", "rd", "no", "mt"];
/// Slips of very short words, which are near too many others.
#[rustfmt::skip]
const USUAL: &[(&str, &str)] = &[
    ("ad", "add"),
    ("wiat", "wait"),
    ("wati", "wait"),
    ("wiating", "waiting"),
    ("watiing", "waiting"),
    ("nxt", "next"),
    ("teh", "the"),
    ("hte", "the"),
    ("adn", "and"),
    ("pls", "please"),
    ("ot", "to"),
    ("pu", "put"),
    ("u", "you"),
    ("nd", "and"),
    ("pant", "paint"),
    ("metrs", "metres"),
    ("meteres", "metres"),
    ("metere", "metres"),
    ("mtrs", "metres"),
    ("evry", "every"),
    ("evrey", "every"),
    ("eveyr", "every"),
    ("norht", "north"),
    ("nothr", "north"),
    ("soth", "south"),
    ("souht", "south"),
    ("suoth", "south"),
    ("sotuh", "south"),
    ("esat", "east"),
    ("wset", "west"),
    ("statu", "statue"),
    ("befor", "before"),
    ("noth", "north"),
    ("nroth", "north"),
    ("tres", "trees"),
    ("tre", "tree"),
    ("char", "chair"),
    ("squre", "square"),
    ("frm", "from"),
    ("ther", "there"),
    ("thre", "there"),
    ("wiht", "with"),
    ("crat", "crate"),
    ("wher", "where"),
    ("whre", "where"),
    ("shoud", "should"),
    ("shuold", "should"),
    ("shold", "should"),
    ("woud", "would"),
    ("tow", "two"),
    ("toward", "towards"),
    ("tress", "trees"),
    ("ona", "on"),
    ("nera", "near"),
    ("pleas", "please"),
    ("plese", "please"),
    ("pleae", "please"),
    ("plaese", "please"),
    ("plase", "please"),
    ("pleaze", "please"),
    ("nxet", "next"),
    ("benhc", "bench"),
    ("bech", "bench"),
    ("becnh", "bench"),
    ("behnd", "behind"),
    ("frnt", "front"),
    ("wth", "with"),
    ("betwen", "between"),
    ("remvoe", "remove"),
    ("remoev", "remove"),
    ("remuv", "remove"),
    ("remuve", "remove"),
    ("removve", "remove"),
    ("muv", "move"),
    ("muve", "move"),
    ("delite", "delete"),
    ("deleet", "delete"),
    ("rotait", "rotate"),
    ("replase", "replace"),
    ("beetween", "between"),
    ("tabel", "table"),
    ("tabels", "tables"),
    ("neer", "near"),
    ("menny", "many"),
    ("meny", "many"),
    ("wether", "weather"),
    ("whereabouts", "where"),
    ("nere", "near"),
    ("bothe", "both"),
    ("aer", "are"),
    ("mak", "make"),
    ("freind", "friend"),
    ("coud", "could"),
    ("culd", "could"),
    ("wuld", "would"),
    ("mvoe", "move"),
    ("moev", "move"),
    ("wya", "way"),
    ("skool", "school"),
    ("pait", "paint"),
    ("paitn", "paint"),
    ("nex", "next"),
    ("awy", "away"),
    ("awya", "away"),
    ("rdo", "red"),
    ("rmove", "remove"),
    ("whit", "white"),
    ("whte", "white"),
    ("thnik", "think"),
    ("befor", "before"),
    ("ar", "are"),
    ("tha", "the"),
    ("fo", "of"),
    ("ni", "in"),
    ("si", "is"),
    ("wich", "which"),
    ("witch", "which"),
    ("sno", "snow"),
];

/// Behind "tow", that it is an order and no slip of "two".
#[rustfmt::skip]
const TOWED: &[&str] = &["the", "teh", "that", "this", "it", "my", "his", "her", "away", "them", "those", "these", "our", "off", "truck", "trucks", "both", "all", "every"];

/// How one spelling comes from another, the likeliest slip first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Slip {
    Swapped,
    Count,
    Letter,
}

/// A sentence as it was heard and, where that differs, as it is spelt: a word that turns of phrase alone know may have been taken for a slip.
pub(super) fn heard_and_spelt(
    words: &str,
    heard: &[Lexeme],
    names: &Names<'_>,
    stock: &Stock,
    streets: &StreetNames,
) -> Vec<Vec<Lexeme>> {
    let spelt = corrected(words, heard, names, stock, streets);
    let differs = !is_same(&spelt, heard);
    std::iter::once(heard.to_vec()).chain(differs.then_some(spelt)).collect()
}

/// A sentence with its slips put right.
pub(super) fn corrected(
    words: &str,
    lexemes: &[Lexeme],
    names: &Names<'_>,
    stock: &Stock,
    streets: &StreetNames,
) -> Vec<Lexeme> {
    let mut spelt = lexemes.to_vec();
    correct(words, &mut spelt, names, stock, streets);
    spelt
}

/// Puts unknown words right that are near one word of edits, and one only; marks of abbreviations go.
pub(super) fn correct(
    words: &str,
    lexemes: &mut Vec<Lexeme>,
    names: &Names<'_>,
    stock: &Stock,
    streets: &StreetNames,
) {
    drop_points_of_short_forms(words, lexemes);
    let known = Known { own: Own { stock }, names, streets };
    let mut at = 0;
    while at < lexemes.len() {
        if let Some(right) = known.respelt(words, lexemes, at) {
            let lexeme = lexemes[at].clone();
            let part =
                |part: String| Lexeme { lemma: base_form(&part), token: Token::Word(part), ..lexeme.clone() };
            lexemes.splice(at..=at, right.into_iter().map(part));
        }
        at += 1;
    }
    let new_names = new_names(words, lexemes);
    correct_but(lexemes, names, &|word| {
        let is_of_name = || word.strip_suffix('s').is_some_and(|stem| names.has_word(stem));
        known.own.contains(word)
            || streets.has_word(word)
            || new_names.iter().any(|name| name == word)
            || is_of_name()
    });
}

/// The words with those that nobody knows put right by how they sound, if there are any: "taksi". Names, which are written with a capital, stay.
pub(super) fn by_sound(
    words: &str,
    lexemes: &[Lexeme],
    names: &Names<'_>,
    stock: &Stock,
    streets: &StreetNames,
) -> Option<Vec<Lexeme>> {
    let known = Known { own: Own { stock }, names, streets };
    let mut right = lexemes.to_vec();
    let mut is_other = false;
    for lexeme in &mut right {
        let Token::Word(word) = &lexeme.token else { continue };
        let written = words.get(lexeme.start..lexeme.end).unwrap_or_default();
        let is_name = written.starts_with(char::is_uppercase);
        if is_name || USUAL.iter().any(|(wrong, _)| wrong == word) || known.has(word, written) {
            continue;
        }
        let own = || known.own.all().into_iter().map(|word| (word, !TABLES.contains(word)));
        let several = || {
            let noun = super::sounds_like::meant(word.strip_suffix('s')?, own())?;
            stock.has_word(&noun).then(|| format!("{noun}s"))
        };
        if let Some(meant) = super::sounds_like::meant(word, own()).or_else(several) {
            lexeme.lemma = base_form(&meant);
            lexeme.token = Token::Word(meant);
            is_other = true;
        }
    }
    is_other.then_some(right)
}

/// "Elm St.": such a point ends nothing.
fn drop_points_of_short_forms(words: &str, lexemes: &mut Vec<Lexeme>) {
    let mut at = 1;
    while at < lexemes.len() {
        let short =
            matches!(&lexemes[at - 1].token, Token::Word(word) if SHORT_FORMS.contains(&word.as_str()));
        if short && lexemes[at].token == Token::Break && words[lexemes[at].start..].starts_with('.') {
            lexemes.remove(at);
        } else {
            at += 1;
        }
    }
}

/// "Tow the car" is an order, and "tow benches" are two.
fn is_tow(lexemes: &[Lexeme], at: usize) -> bool {
    match lexemes.get(at + 1).map(|next| &next.token) {
        Some(Token::Word(next)) => TOWED.contains(&next.as_str()),
        None | Some(Token::Comma | Token::Break | Token::Id(_)) => true,
        _ => false,
    }
}

/// Where words are known.
struct Known<'a> {
    own: Own<'a>,
    names: &'a Names<'a>,
    streets: &'a StreetNames,
}

impl Known<'_> {
    /// The words that were meant by one, if it is misspelt, or two that are written as one.
    fn respelt(&self, words: &str, lexemes: &[Lexeme], at: usize) -> Option<Vec<String>> {
        let Token::Word(word) = &lexemes[at].token else { return None };
        if word == "tow" && is_tow(lexemes, at) {
            return None;
        }
        if let Some(british) = self.british(word) {
            return Some(vec![british]);
        }
        let right = USUAL.iter().find(|(wrong, _)| wrong == word).map(|(_, right)| (*right).to_owned());
        if right.is_none() && self.has(word, &words[lexemes[at].start..lexemes[at].end]) {
            return None;
        }
        // Names are written with a capital, and may be anything.
        let is_name = at > 0 && words[lexemes[at].start..].starts_with(char::is_uppercase);
        // "Annas" are no slip of another word in the plural.
        let is_of_name = word.strip_suffix('s').is_some_and(|stem| self.names.has_word(stem));
        let one = || right.or_else(|| nearest(word, &self.own).filter(|_| !is_name && !is_of_name));
        let knows = |word: &str| self.own.contains(word) || self.names.has_word(word);
        let apart = || lost_spaces::apart(word, &knows).filter(|_| !is_name);
        compound(word, self.own.stock).or_else(apart).or_else(|| one().map(|right| vec![right]))
    }

    /// "Harbor Road" where the road is called Harbour Road.
    fn british(&self, word: &str) -> Option<String> {
        let is_name = |word: &str| self.names.has_word(word) || self.streets.has_word(word);
        let british = word.strip_suffix("or").map(|stem| format!("{stem}our"))?;
        (!is_name(word) && is_name(&british)).then_some(british)
    }

    /// Whether a word is one. "Limes" are no slip of "times".
    fn has(&self, word: &str, written: &str) -> bool {
        let is_plural = !written.contains(['\'', '’'])
            && super::super::sorts::singulars(word).skip(1).any(|word| self.own.stock.has_word(&word));
        is_plural
            || self.own.contains(word)
            || is_known(word)
            || self.names.has_word(word)
            || self.streets.has_word(word)
    }
}

/// What is written with a capital where something is given a name: that is any word.
fn new_names(words: &str, lexemes: &[Lexeme]) -> Vec<String> {
    const NAMES: &[&str] = &["rename", "call", "name", "christen", "label", "called", "named"];
    let renames = lexemes
        .iter()
        .any(|lexeme| matches!(&lexeme.token, Token::Word(word) if NAMES.contains(&word.as_str())));
    let capital = |lexeme: &&Lexeme| words[lexeme.start..].starts_with(char::is_uppercase);
    let named = lexemes.iter().filter(|_| renames).filter(capital);
    named
        .filter_map(|lexeme| match &lexeme.token {
            Token::Word(word) => Some(word.clone()),
            _ => None,
        })
        .collect()
}

/// "Sportscar": the words of an asset's name that are written as one.
fn compound(word: &str, stock: &Stock) -> Option<Vec<String>> {
    Some(stock.name_written_as(word)?.split('_').map(str::to_owned).collect())
}

/// The words of all tables, gathered once.
static TABLES: LazyLock<BTreeSet<String>> = LazyLock::new(|| {
    let mut words: BTreeSet<String> =
        words::words().chain(super::parse::small_words()).map(str::to_owned).collect();
    let nouns = CATEGORIES.iter().flat_map(|category| category.words).flat_map(|phrase| phrase.split(' '));
    for noun in nouns {
        let hisses = ["s", "x", "z", "ch", "sh", "o"].iter().any(|end| noun.ends_with(end));
        words.extend([noun.to_owned(), if hisses { format!("{noun}es") } else { format!("{noun}s") }]);
    }
    words.extend(PAINTS.iter().flat_map(|(words, _)| *words).map(|&word| word.to_owned()));
    words
});

/// The words around edits.
static OTHERS: LazyLock<BTreeSet<&str>> = LazyLock::new(|| super::other_words().collect());

/// The words of edits: those of the tables and of a catalogue.
struct Own<'a> {
    stock: &'a Stock,
}

impl Own<'_> {
    fn contains(&self, word: &str) -> bool {
        TABLES.contains(word)
            || super::forms::is_form(word)
            || OTHERS.contains(word)
            || self.stock.has_word(word)
            || is_synonym(word)
    }

    /// All of them, each once.
    fn all(&self) -> BTreeSet<&str> {
        TABLES.iter().map(String::as_str).chain(self.stock.words()).collect()
    }
}

/// A word with each letter once where it stands twice in a row.
fn once(word: &str) -> String {
    let mut letters: Vec<char> = word.chars().collect();
    letters.dedup();
    letters.into_iter().collect()
}

/// The word that was meant: as it stands, or in the plural of one that is known.
fn nearest(word: &str, own: &Own<'_>) -> Option<String> {
    nearest_as_said(word, own).or_else(|| {
        let stem = word.strip_suffix('s').filter(|stem| stem.chars().count() > SHORTEST)?;
        let noun = nearest_as_said(stem, own).filter(|noun| own.stock.has_word(noun))?;
        Some(format!("{noun}s"))
    })
}

fn nearest_as_said(word: &str, own: &Own<'_>) -> Option<String> {
    let letters = |word: &str| {
        let mut letters: Vec<char> = word.chars().collect();
        letters.sort_unstable();
        letters
    };
    let length = word.chars().count();
    if length < SHORTEST {
        return None;
    }
    let allowed = if length >= LONG { 2 } else { 1 };
    let near = |known: &&str| {
        known.chars().count().abs_diff(length) <= allowed && known.len() >= 3 && !NO_SLIP.contains(known)
    };
    let own = own.all();
    let ranked = own.into_iter().filter(near).map(|known| {
        let slip = if letters(known) == letters(word) {
            Slip::Swapped
        } else if known.chars().count() == length {
            Slip::Letter
        } else {
            Slip::Count
        };
        // Few slip at the first letter.
        let begins = known.chars().next() != word.chars().next();
        let ends = known.chars().next_back() != word.chars().next_back();
        // Letters out of order are one slip, however far one of them went.
        let distance = strsim::osa_distance(word, known);
        // A word of everybody is likelier than one of the catalogue: "bech" is a bench and no beech.
        let is_rare = !TABLES.contains(known);
        // "Dors" are doors and no dorms: who slips forgets the second of two letters.
        let is_single = slip != Slip::Count || once(known) != once(word);
        (
            if slip == Slip::Swapped && distance <= 2 { 1 } else { distance },
            slip,
            (begins, ends),
            (is_single, is_rare),
            known,
        )
    });
    let short = length == SHORTEST;
    let mut best: Vec<_> = ranked
        .filter(|(distance, slip, ..)| *distance <= allowed && !(short && *slip == Slip::Letter))
        .collect();
    best.sort_unstable();
    match &best[..] {
        [(.., only)] => Some((*only).to_owned()),
        [first, second, ..]
            if (first.0, first.1, first.2, first.3) < (second.0, second.1, second.2, second.3) =>
        {
            Some(first.4.to_owned())
        }
        _ => None,
    }
}
