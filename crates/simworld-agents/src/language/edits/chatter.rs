//! What somebody says beside a request and asks for nothing by: whole sentences before it, behind it and between ("The mayor phoned me twice about
//! this. Put ..."), what a request follows from ("visitors park everywhere, so ..."), and what is told along with it ("..., my knees hurt").
//!
//! The other ways to pass over remarks know one by its words ([`super::remarks`], [`super::idle`]), by its shape ([`super::told`],
//! [`super::aside`]) or by its want of names ([`super::bare`]), while a sentence is read. Here, where a sentence is refused with all of them, its
//! parts are known by what they do not say, as talk before orders is ([`super::super::talk`]): a part that forbids nothing, sets no condition, takes
//! nothing back, orders nothing, wishes for nothing that could be made, and says not which things are meant, is left out, and what is left is heard
//! anew as if it had been said alone.

use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{category, is_plural, longest, longest_phrase};
use super::super::numbers;
use super::super::paint::PAINTS;
use super::super::phrases::Phrases;
use super::super::talk::is_bidden;
use super::super::verbs::longest_verb;
use super::parse::Reader;
use super::unasked::BEGINS;
use super::wish::Wish;
use super::words::{SKIES, VERBS};

/// Begins a reason where no mark stands before it.
const BECAUSE: &Phrases =
    &Phrases::of(&["because", "cause", "cos", "coz", "given that", "seeing that", "seeing as", "now that"]);
/// Words that stand for what was told of.
#[rustfmt::skip]
const OPEN: &[&str] = &["its", "them", "him", "her", "his", "their", "they", "that", "those", "these", "this", "he", "she", "another", "same", "both", "other", "others", "ones"];
/// Before a noun.
#[rustfmt::skip]
pub(super) const DETERMINERS: &[&str] = &["the", "a", "an", "this", "that", "these", "those", "my", "our", "your", "his", "her", "their", "its", "some", "any", "another", "every", "each", "both"];
/// Of those, before a noun of something that is known.
const CERTAIN: &[&str] =
    &["the", "that", "this", "these", "those", "my", "our", "your", "both", "all", "every"];
/// A determiner stands no farther before its noun.
const FARTHEST: usize = 4;

/// Whether a word may begin a reason, or what follows from one, where no mark stands before it.
pub(super) fn begins_reason(lexeme: &Lexeme) -> bool {
    let firsts = BECAUSE.iter().filter_map(|phrase| phrase.split(' ').next());
    let word = super::super::lexer::word_of(lexeme);
    word == "so" || firsts.into_iter().any(|first| first == word)
}

/// A sentence without what in it asks for nothing.
pub(super) struct Way {
    pub(super) lexemes: Vec<Lexeme>,
    /// Whether what was left out names a thing or a place.
    pub(super) named: bool,
}

/// Some words of a sentence, up to a mark or to a word by which something follows from them.
#[derive(Clone, Copy)]
pub(super) struct Part {
    pub(super) from: usize,
    /// Behind its last word.
    pub(super) to: usize,
    /// Where the next part begins.
    next: usize,
    /// Whether a sentence ends with it.
    ends: bool,
}

/// What a part is said for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// It asks for something, or may.
    Asks,
    /// It is said out of politeness or habit.
    Idle,
    /// It tells something.
    Tells,
    /// It takes back what was asked for.
    TakesBack,
}

/// How much is left out.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Reach {
    /// Whole sentences.
    Sentences,
    /// What stands before the request of a sentence too.
    Before,
    /// What stands behind it too.
    Behind,
}

impl Reader<'_> {
    /// The sentence without what in it asks for nothing, in the ways in which that is tried, the least of which is left out first.
    pub(super) fn without_chatter(&self, is_known: &dyn Fn(&Wish) -> bool) -> Vec<Way> {
        let parts = self.spoken_parts();
        let Some(kinds) = self.kinds_of(&parts, is_known) else { return Vec::new() };
        let mut ways: Vec<Way> = Vec::new();
        for reach in [Reach::Sentences, Reach::Before, Reach::Behind] {
            let way = self.without(&parts, &kinds, reach);
            // Each leaves out what the one before does, and more if it is another.
            let last = ways.last().map_or(self.lexemes.len(), |way| way.lexemes.len());
            if way.lexemes.len() < last {
                ways.push(way);
            }
        }
        ways
    }

    fn spoken_parts(&self) -> Vec<Part> {
        let all = self.lexemes.len();
        let mut parts = Vec::new();
        let mut from = 0;
        while from < all {
            let ends =
                |at: &usize| is_mark(&self.lexemes[*at]) || *at > from + 1 && self.begins_without_mark(*at);
            let to = (from..all).find(ends).unwrap_or(all);
            let next = to + self.lexemes[to..].iter().take_while(|lexeme| is_mark(lexeme)).count();
            let breaks = self.lexemes[to..next].iter().any(|mark| mark.token == Token::Break);
            if to > from {
                parts.push(Part { from, to, next, ends: breaks || next == all });
            }
            from = next;
        }
        parts
    }

    /// "Visitors get lost so put ...", "put ... because visitors get lost": where a part begins without a mark.
    fn begins_without_mark(&self, at: usize) -> bool {
        let behind = self.lexemes.get(at + 1..).unwrap_or_default();
        let asks = || {
            longest(behind, &VERBS).is_some()
                || longest_phrase(behind, &["a", "an", "please", "could you", "can you", "would you"])
                    .is_some()
                || numbers::count(behind).is_some()
        };
        let told = || {
            let words = longest_phrase(&self.lexemes[at..], BECAUSE)?;
            self.word(at + words)
        };
        self.word(at) == Some("so") && asks() || told().is_some()
    }

    /// What each part is said for; none if something is taken back, or nothing asked for.
    fn kinds_of(&self, parts: &[Part], is_known: &dyn Fn(&Wish) -> bool) -> Option<Vec<Kind>> {
        let mut kinds: Vec<Kind> = Vec::with_capacity(parts.len());
        for part in parts {
            let is_called = kinds.is_empty() && self.calls_somebody(*part, is_known);
            let asked = kinds.contains(&Kind::Asks);
            let kind = if is_called { Kind::Idle } else { self.kind_of(*part, asked, is_known) };
            if kind == Kind::TakesBack {
                return None;
            }
            kinds.push(kind);
        }
        let asks = parts.iter().zip(&kinds).filter(|(_, kind)| **kind == Kind::Asks);
        let asking: Vec<Part> = asks.map(|(part, _)| *part).collect();
        let is_needed = |part: &Part| self.is_taken_up(*part, &asking) || self.says_which(*part, &asking);
        for (part, kind) in parts.iter().zip(&mut kinds) {
            if *kind == Kind::Tells && is_needed(part) {
                *kind = Kind::Asks;
            }
        }
        (!asking.is_empty()).then_some(kinds)
    }

    /// The words of the parts that are kept.
    fn without(&self, parts: &[Part], kinds: &[Kind], reach: Reach) -> Way {
        let mut way = Way { lexemes: Vec::with_capacity(self.lexemes.len()), named: false };
        let mut begin = 0;
        while begin < parts.len() {
            let end = (begin..parts.len()).find(|at| parts[*at].ends).map_or(parts.len(), |last| last + 1);
            let first = (begin..end).find(|at| kinds[*at] == Kind::Asks);
            let mut is_begun = false;
            for (at, (part, kind)) in parts.iter().zip(kinds).enumerate().take(end).skip(begin) {
                let is_before = first.is_some_and(|first| at < first);
                let is_left_out = *kind != Kind::Asks
                    && (first.is_none() || is_before && reach >= Reach::Before || reach == Reach::Behind);
                if is_left_out {
                    way.named |= !self.names_nothing(part.from, part.to);
                    way.ends_where(*part, self.lexemes);
                } else {
                    // "So", behind what it followed from, says nothing more.
                    let follows = !is_begun && at > begin && self.follows_from(*part);
                    way.lexemes.extend_from_slice(&self.lexemes[part.from + usize::from(follows)..part.next]);
                    is_begun = true;
                }
            }
            begin = end;
        }
        way
    }

    /// "So put a bollard there": whether a part begins with a word by which it follows from what was told.
    fn follows_from(&self, part: Part) -> bool {
        part.from + 1 < part.to && matches!(self.word(part.from), Some("so" | "and" | "hence" | "therefore"))
    }

    /// "Doris, my feet hurt, ...": who is spoken to, by a name that nobody here bears.
    fn calls_somebody(&self, part: Part, is_known: &dyn Fn(&Wish) -> bool) -> bool {
        let Part { from, to, .. } = part;
        let rest = &self.lexemes[from..];
        to == from + 1
            && self.words.get(rest[0].start..).is_some_and(|word| word.starts_with(char::is_uppercase))
            && !self.names_any(from, to)
            && longest(rest, PAINTS).is_none()
            && longest(rest, &VERBS).is_none()
            && longest_verb(rest).is_none()
            && self.word(from).is_some_and(|word| !is_bidden(word))
            && longest_phrase(rest, BEGINS).is_none()
            && !self.is_request(from, to, is_known)
    }

    /// Whether a pronoun of a request behind it may stand for something that a part tells of.
    fn is_taken_up(&self, part: Part, asking: &[Part]) -> bool {
        let is_open = || {
            let behind = asking.iter().filter(|other| other.from >= part.next);
            behind.flat_map(|other| other.from..other.to).any(|at| self.points_back(at))
        };
        // "This" at the end of a part is no noun.
        let is_determiner = |at: usize| self.word(at).is_some_and(|word| DETERMINERS.contains(&word));
        let has_noun = (part.from..part.to - 1).any(is_determiner) || self.names_any(part.from, part.to);
        has_noun && is_open()
    }

    /// Whether a word takes up what was told of before.
    fn points_back(&self, at: usize) -> bool {
        let next = self.word(at + 1).unwrap_or_default();
        let behind = self.lexemes.get(at + 1..).unwrap_or_default();
        match self.word(at) {
            // "Make it snow", "it would be nice to have ...".
            Some("it") => {
                let is_sky = longest(behind, &SKIES).is_some() || super::sky::hour(behind).is_some();
                let makes = at > 0 && matches!(self.word(at - 1), Some("make" | "let" | "have"));
                !(makes && is_sky || matches!(next, "would" | "might" | "may"))
            }
            Some("there") => {
                let is_said =
                    ["is", "are", "should", "must", "has", "have", "needs", "ought", "could", "shall"];
                !is_said.contains(&next)
            }
            // "A second one" is as the first.
            Some("one") => {
                let before = at.checked_sub(1).and_then(|at| self.word(at)).unwrap_or_default();
                let is_next =
                    ["second", "third", "fourth", "fifth", "next", "last", "first"].contains(&before);
                !is_next && category(behind).is_none() && self.names.asset_words(behind).is_none()
            }
            Some(word) => OPEN.contains(&word),
            None => false,
        }
    }

    /// Whether a part may say which things a request is about: it has a noun of one of which there are several, or of one that is not here.
    fn says_which(&self, part: Part, asking: &[Part]) -> bool {
        let is_told = |at: usize| (part.from..part.to).any(|own| self.is_same_noun(own, at));
        let is_of_several = |at: usize, to: usize| {
            let mut parser = self.parser(at, to);
            match parser.reference(0) {
                Ok(what) if parser.at > at => self.how_many(&what) != 1,
                _ => true,
            }
        };
        asking.iter().any(|other| {
            (other.from..other.to).any(|at| {
                self.word(at).is_some_and(|word| CERTAIN.contains(&word))
                    && (at + 1..other.to.min(at + 1 + FARTHEST)).any(is_told)
                    && is_of_several(at, other.to)
            })
        })
    }

    /// Whether two words are one noun, or of one class.
    fn is_same_noun(&self, one: usize, other: usize) -> bool {
        let (Some(said), Some(word)) = (self.word(one), self.word(other)) else { return false };
        let is_noun = said.len() > 2 && !super::frames::is_small(said) && !super::says::is_between(said);
        let is_same = said == word || is_plural(said, word) || is_plural(word, said);
        let class = |at: usize| category(&self.lexemes[at..]).map(|(class, _)| class);
        let of_class = || class(one).zip(class(other)).is_some_and(|(one, other)| std::ptr::eq(one, other));
        is_noun && is_same || of_class()
    }
}

impl Way {
    /// Leaves a part out: what stands before it ends where that did.
    fn ends_where(&mut self, part: Part, lexemes: &[Lexeme]) {
        let mark = lexemes[part.to..part.next].iter().find(|mark| mark.token == Token::Break);
        let (Some(mark), Some(last)) = (mark, self.lexemes.last_mut()) else { return };
        if is_mark(last) {
            *last = mark.clone();
        } else {
            self.lexemes.push(mark.clone());
        }
    }
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    BECAUSE.iter().flat_map(|phrase| phrase.split(' ')).chain(super::unasked::words())
}
