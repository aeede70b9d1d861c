//! Things of any kind, and of several: "everything red", "all the things in the park", "the furniture".

use simworld_core::scene::Relation;
use simworld_core::seam::PlanError;

use super::super::clause::{Count, Reference, Stands, Target};
use super::super::lexer::{Lexeme, Token};
use super::super::lexicon::{
    ALL_THINGS, Category, FURNITURE, PLANTS, category, class, longest, longest_phrase,
};
use super::super::paint::PAINTS;
use super::super::phrases::Phrases;
use super::forms::word_at;
use super::parse::Reader;
use super::words::{VERBS, Verb};

/// Nouns of several classes.
#[rustfmt::skip]
const NOUNS: &[(&[&str], &Category)] = &[
    (&["everything", "anything", "things", "stuff", "every thing", "all things", "all the things", "all the stuff", "all that", "the lot", "all objects", "objects", "items"], &ALL_THINGS),
    (&["furniture", "street furniture", "furnishings", "pieces of furniture"], &FURNITURE),
    (&["plants", "vegetation", "greenery", "plant life", "trees and shrubs", "trees and bushes"], &PLANTS),
];
/// One of any kind, where its colour is told.
const ONE: &[&str] = &["thing", "object", "item"];
/// What may stand before such a noun.
#[rustfmt::skip]
const BEFORE: &Phrases = &Phrases::of(&["the", "all", "all the", "all of the", "every", "every single", "any", "these", "those", "my", "our", "of"]);

impl Reader<'_> {
    /// "The red thing": one, of whatever kind.
    fn one_of_any_kind(&self, start: usize, end: usize) -> Option<Result<Reference, PlanError>> {
        let the = start + longest_phrase(&self.lexemes[start..end], &["the", "that", "this"])?;
        let (_, words) = longest(&self.lexemes[the..end], PAINTS)?;
        let paint = &self.lexemes[the..the + words];
        let behind = the + words + longest_phrase(&self.lexemes[the + words..end], ONE)?;
        let place = &self.lexemes[start];
        let words: Vec<Lexeme> = [word_at(place, "all"), word_at(place, "the")]
            .into_iter()
            .chain(paint.iter().cloned())
            .chain([word_at(place, "objects")])
            .chain(self.lexemes[behind..end].iter().cloned())
            .collect();
        let found = self.of_class(&words, &ALL_THINGS, start, end);
        Some(found.map(|what| Reference { count: Count::One, ..what }))
    }

    /// Things of several classes, if the words name such.
    pub(super) fn of_any_kind(&self, start: usize, end: usize) -> Option<Result<Reference, PlanError>> {
        if let Some(one) = self.one_of_any_kind(start, end) {
            return Some(one);
        }
        let mut at = start + longest_phrase(&self.lexemes[start..end], BEFORE).unwrap_or(0);
        let before = longest(&self.lexemes[at..end], PAINTS).map(|(_, words)| at..at + words);
        at = before.as_ref().map_or(at, |paint| paint.end);
        let (class, words) = longest(&self.lexemes[start..end], NOUNS)
            .map(|(class, words)| (class, start + words))
            .or_else(|| longest(&self.lexemes[at..end], NOUNS).map(|(class, words)| (class, at + words)))?;
        let behind = words
            + longest_phrase(
                &self.lexemes[words..end],
                &["that is", "which is", "that are", "thats", "that stands"],
            )
            .unwrap_or(0);
        let after = longest(&self.lexemes[behind..end], PAINTS).map(|(_, paint)| behind..behind + paint);
        let rest = after.as_ref().map_or(words, |paint| paint.end);
        let place = self.lexemes.get(start)?;
        let noun = [word_at(place, "all"), word_at(place, "the")];
        let paint = before.or(after).map_or(&[][..], |paint| &self.lexemes[paint]);
        let words: Vec<Lexeme> = noun
            .into_iter()
            .chain(paint.iter().cloned())
            .chain([word_at(place, "objects")])
            .chain(self.lexemes[rest..end].iter().cloned())
            .collect();
        let read = self.of_class(&words, class, start, end);
        // "Everything on the table".
        let on = words.iter().position(|lexeme| lexeme.token == Token::Word("on".to_owned()));
        let (Err(_), Some(on)) = (&read, on) else { return Some(read) };
        let place = words[on].clone();
        let top: Vec<Lexeme> = words[..=on]
            .iter()
            .cloned()
            .chain([word_at(&place, "top"), word_at(&place, "of")])
            .chain(words[on + 1..].iter().cloned())
            .collect();
        Some(self.of_class(&top, class, start, end))
    }

    fn of_class(
        &self,
        words: &[Lexeme],
        class_of: &'static Category,
        start: usize,
        end: usize,
    ) -> Result<Reference, PlanError> {
        let reader = self.over(words);
        let mut parser = reader.parser(0, words.len());
        let mut what = parser.reference(0)?;
        self.except(&mut parser, &mut what);
        let is_all = matches!(what.target, Target::Any(own) if std::ptr::eq(own, class("object")));
        if parser.at < words.len() || !is_all {
            return Err(parser.not_understood("end here, or go on with \"and\""));
        }
        what.target = Target::Any(class_of);
        what.count = Count::All;
        if let Some(except) = &mut what.except
            && matches!(except.target, Target::Any(own) if std::ptr::eq(own, class("object")))
        {
            except.target = Target::Any(class_of);
        }
        what.text = self.written(start, end);
        // "Everything with wheels" is less than everything: nothing may be left unread behind it.
        let is_bare = what.traits.paint.is_none() && what.relation.is_none() && what.except.is_none();
        let behind = self.lexemes.get(end - 1).map_or("", |last| &self.words[last.end..]);
        if is_bare
            && std::ptr::eq(class_of, &raw const ALL_THINGS)
            && behind.chars().any(char::is_alphanumeric)
        {
            return Err(parser.not_understood("say which things: of what kind, colour or place"));
        }
        Ok(what)
    }

    /// Whether a word that may be a verb belongs to a noun: "the trash bin", "a tow truck".
    pub(super) fn is_in_noun(&self, start: usize, at: usize) -> bool {
        #[rustfmt::skip]
        const BEFORE: &Phrases = &Phrases::of(&["the", "a", "an", "my", "your", "our", "his", "its", "their", "this", "that", "these", "those", "no", "any", "every", "each"]);
        let spans = |from: usize| category(&self.lexemes[from..]).is_some_and(|(_, words)| from + words > at);
        at > start
            && (self.word(at - 1).is_some_and(|word| BEFORE.contains(word))
                || (start.max(at.saturating_sub(2))..at).any(spans))
    }

    /// That what an order is about, or a place before it, is not there: "paint the ferry blue", "by the birch, put a chair".
    pub(super) fn not_there(&self, start: usize, end: usize) -> Option<PlanError> {
        let missing = |error: PlanError| matches!(error, PlanError::NotFound { .. }).then_some(error);
        if self.is_place(start) {
            let mut reader = Reader { at: start, ..self.up_to(end) };
            return reader.place(end).err().and_then(missing);
        }
        let (verb, words) = longest(&self.lexemes[start..end], &VERBS)?;
        let at = start + words;
        let is_change = matches!(
            verb,
            Verb::Paint
                | Verb::Make
                | Verb::Turn
                | Verb::Grow
                | Verb::Shrink
                | Verb::Name
                | Verb::Copy
                | Verb::Move
                | Verb::Put
        );
        longest_phrase(&self.lexemes[at..end], &["the", "that", "this"])
            .filter(|_| is_change && at + 2 < end)?;
        let is_known = category(&self.lexemes[at + 1..end]).is_some()
            || self.names.part(&self.lexemes[at + 1..at + 2]).is_some()
            || longest(&self.lexemes[at + 1..end], PAINTS).is_some();
        if is_known { None } else { self.one_of(at, at + 2).err().and_then(missing) }
    }

    /// "All but the last lamp": those of the class of what is left out.
    pub(super) fn all_but(&self, start: usize, end: usize) -> Option<Reference> {
        #[rustfmt::skip]
        const ALL_BUT: &[&str] = &["all but", "all except", "all except for", "everything but", "all but for", "every one but", "all apart from"];
        let from = start + longest_phrase(&self.lexemes[start..end], ALL_BUT)?;
        let mut parser = self.parser(from, end);
        let except = parser.reference(0).ok().filter(|_| parser.at >= end)?;
        let Target::Any(_) = &except.target else { return None };
        let plain = Reference::to(except.target.clone(), self.written(start, end));
        let text = self.written(start, end);
        let relation = except.relation.clone();
        // "All but one lamp": any one of them stays.
        let one = matches!(self.lexemes[from].token, Token::Number(_)) || self.word(from) == Some("one");
        let count = if one && except.count == Count::One { Count::Exactly(1) } else { except.count };
        let except = Reference { count, indefinite: except.indefinite || one, ..except };
        Some(Reference { count: Count::All, relation, except: Some(Box::new(except)), text, ..plain })
    }
}

/// "Clear the table": what is on it, and not the table; "clear the cars" is the cars.
pub(super) fn on_it(what: Reference) -> Reference {
    let holds = matches!(what.target, Target::Any(own) if own.is_area() || std::ptr::eq(own, class("table")));
    if !holds || what.count != Count::One {
        return what;
    }
    let relation = if matches!(what.target, Target::Any(own) if own.is_area()) {
        Relation::Inside
    } else {
        Relation::OnTopOf
    };
    let text = format!("thing there: {}", what.text);
    let all = Reference::to(Target::Any(&ALL_THINGS), text);
    Reference { count: Count::All, relation: Some(Stands::To(relation, Box::new(what))), ..all }
}

/// "Every other tree" is every second.
pub(super) fn in_plain_words(lexemes: &mut Vec<Lexeme>) {
    // "The shop selling newspapers" is the one that sells them.
    let is_selling = |lexeme: &Lexeme| lexeme.token == Token::Word("selling".to_owned());
    while let Some(at) = lexemes.iter().position(is_selling).filter(|at| *at > 0) {
        let place = lexemes[at].clone();
        lexemes.splice(at..=at, [word_at(&place, "that"), word_at(&place, "sells")]);
    }
    for at in 1..lexemes.len() {
        let other = longest_phrase(&lexemes[at - 1..], &["every other", "each other"]) == Some(2)
            && matches!(&lexemes[at - 1].token, Token::Word(word) if word == "every")
            && category(&lexemes[at + 1..]).is_some();
        if other {
            lexemes[at] = word_at(&lexemes[at], "second");
        }
    }
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    NOUNS.iter().flat_map(|(words, _)| *words).flat_map(|phrase| phrase.split(' ')).chain(["selling"])
}
