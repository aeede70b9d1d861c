//! Noun phrases: what an order is about.

use std::sync::Arc;

use simworld_core::scene::{LOCKED, OPEN};
use simworld_core::seam::PlanError;

use super::clause::{Choice, Count, Reference, Side, Stands, Target, Traits};
use super::lexer::{Lexeme, Token, written};
use super::lexicon::{Category, DETERMINERS, category, fits, fits_noun, longest_phrase};
use super::names::Guess;
use super::parser::{Parser, shortened};
use super::phrases::Phrases;

/// How many things may be described by one another: "the bench near the tree near ...".
pub(super) const DEEPEST: u32 = 4;
/// What doors may be.
pub(super) const DOOR_STATES: &[(&[&str], (&str, bool))] = &[
    (&["locked"], (LOCKED, true)),
    (&["unlocked"], (LOCKED, false)),
    (&["open", "opened"], (OPEN, true)),
    (&["closed", "shut"], (OPEN, false)),
];
/// What somebody or something does at a place.
#[rustfmt::skip]
const IS_THERE: &Phrases = &Phrases::of(&[
    "is", "are", "stands", "sits", "waits", "lies", "is standing", "is sitting", "is waiting", "is lying",
    "happens to be", "is parked", "is now", "is right now",
]);

impl Parser<'_> {
    /// A thing or a place.
    pub(super) fn reference(&mut self, depth: u32) -> Result<Reference, PlanError> {
        self.eat_any(&["the point", "point", "the position", "position", "coordinates", "the coordinates"]);
        let start = self.at;
        if !self.peeks_place()
            && self.eat_any(&["where", "wherever", "the place where", "the spot where", "to where"])
        {
            let there = self.reference(depth)?;
            self.eat_any(IS_THERE);
            return Ok(there);
        }
        if self.peeks("both")
            && (self.is_capital(self.at + 1)
                || self.names.exact(&self.rest()[1..]).is_some_and(|(_, words)| {
                    longest_phrase(self.rest().get(1 + words..).unwrap_or_default(), &["and"]).is_some()
                }))
            && category(&self.rest()[1..]).is_none()
        {
            self.at += 1; // "both Anna and Ben" are each named
        }
        self.skip_titles();
        if let Some(one) = self.chosen_of_named() {
            return Ok(one);
        }
        if let Some(them) = self.somebody() {
            return Ok(them);
        }
        if let [Lexeme { token: Token::Ids(ids), .. }, ..] = self.rest() {
            let target = Target::Named(ids.clone());
            self.at += 1;
            return Ok(Reference { count: Count::All, ..Reference::to(target, self.text_from(start)) });
        }
        if let Some(target) = self.simple_target()? {
            return Ok(Reference::to(target, self.text_from(start)));
        }
        let mut reference = Reference::to(Target::Here, String::new());
        self.modifiers(&mut reference);
        let mut text_at = self.at; // answers leave the article out
        if reference.choice != Choice::Open || reference.traits != Traits::default() {
            text_at = start + usize::from(longest_phrase(&self.lexemes[start..], DETERMINERS).is_some());
        }
        let bare = self.spoken_of(&reference);
        reference.target = match bare {
            Some(target) => target,
            None => self.noun_however_described(&mut reference)?,
        };
        self.compound(&mut reference, text_at);
        self.by_name(&mut reference)?;
        self.within_scope(&mut reference);
        match &reference.target {
            Target::Any(category) => self.class = Some(category),
            Target::Named(bearers) if bearers.len() > 1 => {
                (self.class, self.bearers) = (None, Some(bearers.clone()));
            }
            _ => {}
        }
        reference.text = self.text_from(text_at);
        let spoken_of = (self.class, self.bearers.clone());
        self.described(&mut reference, depth)?;
        (self.class, self.bearers) = spoken_of; // "one" is not what it stands by
        self.apposition(&mut reference, depth)?;
        if reference.relation.is_some() {
            reference.text = self.text_from(text_at);
        }
        self.or_another(&mut reference)?;
        Ok(reference)
    }

    /// "The chair, the one by the tree", "the Elm Café, the western one".
    fn apposition(&mut self, reference: &mut Reference, depth: u32) -> Result<(), PlanError> {
        let start = self.at;
        let [Lexeme { token: Token::Comma, .. }, ..] = self.rest() else { return Ok(()) };
        self.at += 1;
        if self.eat_any(&["the one", "the ones", "that one"]) {
            let said = self.at;
            self.described(reference, depth)?;
            if self.at > said {
                return Ok(());
            }
        } else if self.eat_any(&["not the", "and not the", "not that", "not this"]) {
            // "The second scooter, not the first one".
            let mut other = reference.clone();
            self.modifiers(&mut other);
            self.eat_any(&["one", "ones"]);
            if self.ends_at_mark() {
                return Ok(());
            }
        } else if self.eat_any(&["any", "any old", "whichever"]) {
            // "A chair, any chair".
            let class = if let Target::Any(class) = &reference.target { Some(*class) } else { None };
            if class.is_some() && category(self.rest()).map(|(class, _)| class) == class {
                self.at += category(self.rest()).map_or(0, |(_, words)| words);
                return Ok(());
            }
        } else if self.peeks("the") {
            let mut likeness = reference.clone();
            self.modifiers(&mut likeness);
            let states = longest_phrase(
                self.rest(),
                &["one is", "one was", "one has", "one looks", "one isnt", "ones"],
            )
            .is_some();
            if likeness != *reference && !states && self.eat_any(&["one"]) {
                *reference = likeness;
                return self.described(reference, depth);
            }
        }
        self.at = start;
        Ok(())
    }

    /// "The dog called Rex", "the building by the name of Maple House".
    fn by_name(&mut self, reference: &mut Reference) -> Result<(), PlanError> {
        const CALLED: &Phrases = &Phrases::of(&[
            "called",
            "named",
            "by the name of",
            "known as",
            "that is called",
            "thats called",
            "which is called",
            "who is called",
            "whos called",
            "whose name is",
            "with the name",
            "going by the name of",
            "which is named",
            "that is named",
            "that they call",
            "they call",
            "which they call",
            "labelled",
            "labeled",
            "marked",
            "who goes by the name of",
            "who goes by",
            "of the name of",
            "with the name of",
            "that goes by the name of",
        ]);
        let Target::Any(class) = &reference.target else { return Ok(()) };
        let start = self.at;
        if !self.eat_any(CALLED) {
            return Ok(());
        }
        self.eat_any(&["the"]);
        let is_one = |id: &simworld_core::id::EntityId| {
            self.view.scene.entity(*id).is_some_and(|entity| class.holds(&entity))
        };
        let (ids, words) = if let Some(found) = self.names.exact(self.rest()) {
            found
        } else {
            let Target::Named(ids) = self.misspelt()? else {
                self.at = start;
                return Ok(());
            };
            (ids, 0)
        };
        self.at += words;
        let fitting: Vec<_> = ids.iter().copied().filter(is_one).collect();
        reference.target = Target::Named(if fitting.is_empty() { ids } else { fitting });
        Ok(())
    }

    /// "The library door": the first noun says whose.
    fn compound(&mut self, reference: &mut Reference, text_at: usize) {
        let Some((head, words)) = category(self.rest()) else { return };
        if super::dialects::in_quotes(self.words, self.rest()[0].start) {
            return; // "tell Ben 'green'"
        }
        if matches!(&reference.target, Target::Any(category) if *category == head) {
            return;
        }
        self.at += words;
        let whose = Reference {
            target: reference.target.clone(),
            ..Reference::to(Target::It, self.text_from(text_at))
        };
        reference.target = Target::Any(head);
        reference.relation = Some(Stands::Of(Box::new(whose)));
    }

    /// The class or the bearers of the name that was spoken of last.
    fn mentioned(&self) -> Option<Target> {
        match (self.class, &self.bearers) {
            (Some(class), _) => Some(Target::Any(class)),
            (None, bearers) => bearers.clone().map(Target::Named),
        }
    }

    /// Whether "one" was said last: "point at one, then the other".
    fn said_one(&self) -> bool {
        self.at > 0 && self.lexemes[self.at - 1].token == Token::Word("one".to_owned())
    }

    /// Takes over what was said of several before: "on your left are three doors: the middle one".
    fn within_scope(&self, reference: &mut Reference) {
        if let Some(scope) = self.scope.as_ref().filter(|scope| scope.target == reference.target) {
            reference.relation = reference.relation.take().or_else(|| scope.relation.clone());
            reference.traits.paint = reference.traits.paint.or(scope.traits.paint);
        }
    }

    /// "The second closest", "the other": a choice without a noun, out of what was spoken of.
    fn spoken_of(&self, reference: &Reference) -> Option<Target> {
        let chosen = reference.choice != Choice::Open
            || reference.traits.other
            || self.scope.is_some() && self.said_one();
        let is_bare = self.ends_clause()
            || longest_phrase(self.rest(), &["on the", "to the", "from", "in the", "that", "there"])
                .is_some();
        self.mentioned().filter(|_| chosen && is_bare)
    }

    /// "Where you are" is a place of its own.
    fn peeks_place(&self) -> bool {
        longest_phrase(self.rest(), &["where you", "where we", "where i"]).is_some()
    }

    /// What things are made of if that is said, or else a name or a class.
    pub(super) fn sort_or_noun(&mut self, reference: &mut Reference) -> Result<Target, PlanError> {
        let Some((class, asset)) = self.sort() else { return self.noun(reference.choice != Choice::Open) };
        reference.traits.sort = Some(asset);
        Ok(Target::Any(class))
    }

    /// "The beehive", "both oaks": what an asset is called of which there are some, unless a name or a class says as much.
    fn sort(&mut self) -> Option<(&'static Category, Arc<String>)> {
        let sort = self.names.sort_of_asset(self.rest())?;
        let class = category(self.rest());
        let is_narrower = class.is_none_or(|(class, words)| {
            let said = &self.rest()[..words];
            words < sort.words || words == sort.words && fits_noun(said, class.words[0]).is_none()
        });
        if !is_narrower || self.names.exact(self.rest()).is_some_and(|(_, words)| words >= sort.words) {
            return None;
        }
        self.at += sort.words;
        Some((sort.class, sort.asset))
    }

    /// A name or a class of things; of two that fit, the longer.
    fn noun(&mut self, chosen: bool) -> Result<Target, PlanError> {
        if let Some(sellers) = self.sellers() {
            return Ok(Target::Named(sellers));
        }
        let class = category(self.rest());
        // Names are looked up only where one may stand: the index of a large city takes time.
        let may_be_name = match class {
            None => true,
            Some((category, words)) => {
                let next = self.at + words;
                // "The taxi" is rather what is called so than any car.
                let is_narrower = !category.is_place()
                    && fits_noun(&self.lexemes[self.at..next], category.words[0]).is_none();
                // "Cafe lumen": what follows is a word of a name alone.
                let is_named = matches!(self.rest().get(words).map(|next| &next.token),
                    Some(Token::Word(word)) if !super::spelling::is_known(word) && self.names.has_word(word));
                is_narrower
                    || is_named
                    || self.is_capital(self.at)
                    || self.is_capital(next)
                    || fits(&self.lexemes[next..], "of").is_some()
            }
        };
        let named =
            if may_be_name { self.names.exact(self.rest()).or_else(|| self.owner_named()) } else { None };
        match (named, class) {
            (Some((ids, count)), class) if class.is_none_or(|(_, words)| count >= words) => {
                self.at += count;
                Ok(Target::Named(ids))
            }
            (_, Some((category, count))) => {
                let said = &self.rest()[..count];
                self.at += count;
                // "The clinic" is the one that is called so, rather than the nearest hospital.
                // Of shops the nearest is chosen, and not the one that has the word in its name.
                let is_synonym = category.is_place() && !chosen && fits(said, category.words[0]).is_none();
                match if is_synonym { self.names.part(said) } else { None } {
                    Some(Guess::Named(ids)) => Ok(Target::Named(ids)),
                    _ => Ok(Target::Any(category)),
                }
            }
            _ => match self.mentioned() {
                Some(target) if self.eat_any(&["one", "ones"]) => Ok(target),
                _ => self.misspelt(),
            },
        }
    }

    /// Whose name it is before "'s": "the Noodle Bar's door".
    fn owner_named(&self) -> Option<(Vec<simworld_core::id::EntityId>, usize)> {
        const LONGEST: usize = 5;
        let rest = &self.rest()[..self.rest().len().min(LONGEST)];
        let is_owner = |lexeme: &Lexeme| {
            let written = &self.words[lexeme.start..lexeme.end];
            written.ends_with("'s") || written.ends_with("’s")
        };
        let at = rest.iter().position(is_owner).filter(|at| *at > 0)?;
        let mut owner = rest[..=at].to_vec();
        if let Token::Word(word) = &mut owner[at].token {
            word.pop();
        }
        self.names.exact(&owner).filter(|(_, words)| *words == owner.len())
    }

    pub(super) fn text_from(&self, start: usize) -> String {
        shortened(written(self.words, self.lexemes.get(start..self.at).unwrap_or_default()))
    }
}

impl Reference {
    /// The door that one closes behind oneself is behind nobody yet.
    pub(super) fn but_behind(mut self) -> Self {
        let behind = |stands: &Stands| matches!(stands, Stands::Side(Side::Behind));
        match &mut self.relation {
            Some(Stands::All(all)) => all.retain(|stands| !behind(stands)),
            Some(stands) if behind(stands) => self.relation = None,
            _ => {}
        }
        self
    }
}
