//! Noun phrases: what an order is about.

use simworld_core::scene::{LOCKED, OPEN};
use simworld_core::seam::PlanError;

use super::clause::{Choice, Count, Reference, Side, Stands, Target};
use super::lexer::{Lexeme, Token, written};
use super::lexicon::{
    COPULAS, DETERMINERS, FARTHEST, MOSTS, NEAREST, RELATIONS, SIDES, category, fits, longest, longest_phrase,
};
use super::names::Guess;
use super::numbers;
use super::parser::{Parser, shortened};

/// How many things may be described by one another: "the bench near the tree near ...".
const DEEPEST: u32 = 4;
/// Between a superlative and what it chooses from.
const OF_SEVERAL: &[&str] = &["of the", "of these", "of those", "of all the", "of all"];
/// What is said of anything that is about.
const YOU_SEE: &[&str] = &[
    "you see",
    "that you see",
    "you can see",
    "that you can see",
    "you find",
    "that you find",
    "you can find",
    "you come to",
    "you come across",
    "you spot",
    "there is",
    "in sight",
];
/// Before what is sold somewhere.
const SELLING: &[&str] = &[
    "that sells",
    "which sells",
    "selling",
    "that sell",
    "where they sell",
    "where you can buy",
    "who sells",
];
const SUPERLATIVES: &[&str] = &["nearest", "closest", "farthest", "furthest", "nearer", "closer"];
const FREE: &[&str] = &["free", "empty", "available", "vacant", "unoccupied"];
/// What doors may be.
const DOOR_STATES: &[(&[&str], (&str, bool))] = &[
    (&["locked"], (LOCKED, true)),
    (&["unlocked"], (LOCKED, false)),
    (&["open", "opened"], (OPEN, true)),
    (&["closed", "shut"], (OPEN, false)),
];
/// What begins with "by", and names nothing beside which something stands.
const BY_WAYS: &[&str] = &[
    "by way of",
    "by the shortest",
    "by the quickest",
    "by the fastest",
    "by the most direct",
    "by car",
    "by foot",
];
const INDEFINITE: &[&str] = &["a", "an", "any", "some", "one of the", "one of", "another"];

impl Parser<'_> {
    /// A thing or a place.
    pub(super) fn reference(&mut self, depth: u32) -> Result<Reference, PlanError> {
        self.eat_any(&["the point", "point", "the position", "position", "coordinates", "the coordinates"]);
        let start = self.at;
        if !self.peeks_place() && self.eat_any(&["where", "wherever"]) {
            let there = self.reference(depth)?;
            self.eat_any(&[
                "is",
                "are",
                "stands",
                "sits",
                "waits",
                "is standing",
                "is sitting",
                "is waiting",
                "happens to be",
            ]);
            return Ok(there);
        }
        if self.peeks("both") && self.is_capital(self.at + 1) {
            self.at += 1; // "both Anna and Ben" are each named
        }
        if let Some(them) = self.somebody() {
            return Ok(them);
        }
        if let Some(target) = self.simple_target()? {
            return Ok(Reference::to(target, self.text_from(start)));
        }
        let mut reference = Reference::to(Target::Here, String::new());
        self.modifiers(&mut reference);
        let mut text_at = self.at; // answers leave the article out
        if reference.choice != Choice::Open || reference.traits != super::clause::Traits::default() {
            text_at = start + usize::from(longest_phrase(&self.lexemes[start..], DETERMINERS).is_some());
        }
        reference.target = self.noun()?;
        self.compound(&mut reference, text_at);
        match &reference.target {
            Target::Any(category) => self.class = Some(category),
            Target::Named(bearers) if bearers.len() > 1 => {
                (self.class, self.bearers) = (None, Some(bearers.clone()));
            }
            _ => {}
        }
        reference.text = self.text_from(text_at);
        self.described(&mut reference, depth)?;
        self.apposition(&mut reference, depth)?;
        if reference.relation.is_some() {
            reference.text = self.text_from(text_at);
        }
        self.or_another(&reference)?;
        Ok(reference)
    }

    /// "The chair, the one by the tree".
    fn apposition(&mut self, reference: &mut Reference, depth: u32) -> Result<(), PlanError> {
        let start = self.at;
        let [Lexeme { token: Token::Comma, .. }, after @ ..] = self.rest() else { return Ok(()) };
        let Some(words) = longest_phrase(after, &["the one", "the ones", "that one"]) else { return Ok(()) };
        self.at += 1 + words;
        let said = self.at;
        if reference.relation.is_none() {
            self.described(reference, depth)?;
        }
        if self.at == said {
            self.at = start;
        }
        Ok(())
    }

    /// "The bench or the chair" leaves open which.
    fn or_another(&mut self, reference: &Reference) -> Result<(), PlanError> {
        let start = self.at;
        if !self.eat_any(&["or", "or else", "or maybe", "or perhaps"]) {
            return Ok(());
        }
        self.eat_any(&["to", "at", "on"]);
        let Ok(other) = self.reference(0) else {
            self.at = start;
            return Ok(());
        };
        let mut candidates = Vec::new();
        for one in [reference, &other] {
            if let Ok(found) = self.view.find(one, super::resolve::Purpose::Any) {
                candidates.push((found.id, found.label().to_owned()));
            }
        }
        let wanted = format!("of {} or {}", reference.text, other.text);
        Err(PlanError::Ambiguous { wanted, candidates })
    }

    /// Articles, numbers, colours and superlatives before a noun.
    fn modifiers(&mut self, reference: &mut Reference) {
        loop {
            if let Some((count, words)) = self.peek_count() {
                reference.count = count;
                self.at += words;
            } else if let Some(nth) = self.peek_ordinal() {
                reference.choice = Choice::Nth(nth);
                self.at += 1;
            } else if self.eat_any(&["other", "another"]) {
                reference.traits.other = true;
            } else if longest_phrase(self.rest(), INDEFINITE).is_some() && self.eat_any(INDEFINITE) {
                reference.indefinite = true;
            } else if (self.class.is_some() || self.bearers.is_some())
                && longest_phrase(self.rest(), &["one", "ones"]).is_some()
                && category(&self.rest()[1..]).is_none()
            {
                return; // "the white one"
            } else if longest_phrase(self.rest(), &["everybody", "everyone"]).is_some() {
                reference.count = Count::All;
                return;
            } else if self.eat_any(DETERMINERS) {
            } else if self.eat_any(NEAREST) {
                if !matches!(reference.choice, Choice::Nth(_)) {
                    reference.choice = Choice::Nearest;
                }
            } else if self.eat_any(FARTHEST) {
                reference.choice = Choice::Farthest;
            } else if self.eat_any(FREE) {
                reference.traits.free = true;
            } else if self.names_follow() {
                return;
            } else if let Some(choice) = self.compass_choice() {
                reference.choice = choice;
            } else if let Some(((measure, most), words)) = longest(self.rest(), MOSTS) {
                reference.choice = Choice::Most(measure, most);
                self.at += words;
            } else if let Some((paint, words)) = self.peek_paint() {
                reference.traits.paint = Some(paint);
                self.at += words;
            } else if reference.choice != Choice::Open && self.eat_any(OF_SEVERAL) {
                // "The smaller of the two boxes".
                self.at += numbers::count(self.rest()).map_or(0, |(_, words)| words);
            } else if self.eat_any(&["parked"]) {
                reference.traits.parked = true;
            } else if let Some((state, words)) = longest(self.rest(), DOOR_STATES) {
                reference.traits.state = Some(state);
                self.at += words;
            } else {
                return;
            }
        }
    }

    fn peek_ordinal(&self) -> Option<u32> {
        let nth = numbers::ordinal(self.rest())?;
        // "One second" is a time, and nobody calls a thing "second" alone.
        matches!(self.rest().get(1)?.token, Token::Word(_)).then_some(nth)
    }

    /// Whether a name begins here with what else would be an adjective: "Blue Spoon", "Little Italy".
    fn names_follow(&self) -> bool {
        let adjective =
            longest(self.rest(), MOSTS).map(|(_, words)| words).or(self.peek_paint().map(|(_, words)| words));
        let Some(words) = adjective else { return false };
        let after = &self.rest()[words..];
        let is_plain = category(after).is_some() && !self.is_capital(self.at);
        !is_plain && self.names.exact(self.rest()).is_some_and(|(_, count)| count > words)
    }

    /// Whether the token is written with a capital, as names are.
    fn is_capital(&self, at: usize) -> bool {
        let written = self.lexemes.get(at).and_then(|lexeme| self.words[lexeme.start..].chars().next());
        at > 0 && written.is_some_and(char::is_uppercase)
    }

    /// "The library door": the first noun says whose.
    fn compound(&mut self, reference: &mut Reference, text_at: usize) {
        let Some((head, words)) = category(self.rest()) else { return };
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

    /// What is said after a noun: where it stands, and what it is like.
    fn described(&mut self, reference: &mut Reference, depth: u32) -> Result<(), PlanError> {
        loop {
            let start = self.at;
            if self.in_test && longest_phrase(self.rest(), &["is", "are"]).is_some() {
                return Ok(());
            }
            let copula = self.eat_any(COPULAS);
            if copula && longest_phrase(self.rest().get(1..).unwrap_or_default(), SUPERLATIVES).is_some() {
                self.eat_any(&["the"]); // "the bench that is the farthest"
            }
            self.eat_any(&["over there", "right there"]);
            if copula
                && let Some((paint, words)) =
                    self.peek_paint().filter(|_| self.lexemes[start].token != Token::Word("is".to_owned()))
            {
                reference.traits.paint = Some(paint);
                self.at += words;
            } else if self.eat_any(&[
                "nearest",
                "closest",
                "closer",
                "nearer",
                "nearest you",
                "closest to you",
                "nearest to you",
                "near you",
                "close to you",
                "nearby",
                "close by",
                "closest to me",
                "nearest to me",
                "near me",
                "around here",
                "near here",
            ]) {
                let bare = ["nearest", "closest", "nearer", "closer"]
                    .iter()
                    .any(|word| fits(&self.lexemes[self.at - 1..], word).is_some());
                if bare
                    && self.at > start
                    && let Some(anchor) = self.bare_anchor(depth)
                {
                    reference.relation = Some(Stands::NearestTo(Box::new(anchor), true));
                    continue;
                }
                if !(self.peeks("to")) {
                    if reference.choice == Choice::Open {
                        reference.choice = Choice::Nearest;
                    }
                    continue;
                }
                self.at += 1;
                let anchor = self.reference(depth + 1)?;
                reference.relation = Some(Stands::NearestTo(Box::new(anchor), true));
            } else if self.eat_any(&[
                "farthest away",
                "furthest away",
                "farthest from you",
                "furthest from you",
                "most distant",
                "farthest",
                "furthest",
                "farthest away from you",
                "farthest from here",
                "furthest from here",
                "farthest from me",
                "furthest from me",
                "farthest away from here",
                "furthest away from here",
                "furthest away from you",
            ]) {
                if !self.eat_any(&["from", "away from"]) {
                    reference.choice = Choice::Farthest;
                    continue;
                }
                let anchor = self.reference(depth + 1)?;
                reference.relation = Some(Stands::NearestTo(Box::new(anchor), false));
            } else if reference.choice == Choice::Open
                && let Some(compass) = self.in_the_compass()
            {
                reference.choice = Choice::Compass(compass);
            } else if let Some(than) = self.comparison() {
                reference.traits.than = Some(than);
            } else if self.eat_any(SELLING) {
                let Some((goods, words)) = self.names.goods(self.rest()) else {
                    return Err(self.not_understood(&format!("sold here are {}", self.names.sold())));
                };
                reference.traits.sells = Some(goods);
                self.at += words;
            } else if self.eat_any(YOU_SEE) {
                // "The first chair you see" is the nearest.
            } else if reference.relation.is_none()
                && let Some(relation) = self.relation(depth)?
            {
                reference.relation = Some(relation);
            } else {
                self.at = start;
                return Ok(());
            }
        }
    }

    /// "The person nearest the museum": what follows without "to".
    fn bare_anchor(&mut self, depth: u32) -> Option<Reference> {
        let start = self.at;
        let named = longest_phrase(self.rest(), DETERMINERS).is_some()
            || category(self.rest()).is_some()
            || self.names.exact(self.rest()).is_some();
        let anchor = if named && depth < DEEPEST { self.reference(depth + 1).ok() } else { None };
        if anchor.is_none() {
            self.at = start;
        }
        anchor
    }

    /// "Where you are" is a place of its own.
    fn peeks_place(&self) -> bool {
        longest_phrase(self.rest(), &["where you", "where we", "where i"]).is_some()
    }

    /// A name or a class of things; of two that fit, the longer.
    fn noun(&mut self) -> Result<Target, PlanError> {
        if let Some(sellers) = self.sellers() {
            return Ok(Target::Named(sellers));
        }
        let class = category(self.rest());
        // Names are looked up only where one may stand: the index of a large city takes time.
        let may_be_name = match class {
            None => true,
            Some((_, words)) => {
                let next = self.at + words;
                self.is_capital(self.at)
                    || self.is_capital(next)
                    || fits(&self.lexemes[next..], "of").is_some()
            }
        };
        let named = if may_be_name { self.names.exact(self.rest()) } else { None };
        match (named, class) {
            (Some((ids, count)), class) if class.is_none_or(|(_, words)| count >= words) => {
                self.at += count;
                Ok(Target::Named(ids))
            }
            (_, Some((category, count))) => {
                let said = &self.rest()[..count];
                self.at += count;
                // "The clinic" is the one that is called so, rather than the nearest hospital.
                let is_synonym = category.is_place() && fits(said, category.words[0]).is_none();
                match if is_synonym { self.names.part(said) } else { None } {
                    Some(Guess::Named(ids)) => Ok(Target::Named(ids)),
                    _ => Ok(Target::Any(category)),
                }
            }
            _ => {
                let spoken_of = match (self.class, &self.bearers) {
                    (Some(class), _) => Some(Target::Any(class)),
                    (None, bearers) => bearers.clone().map(Target::Named),
                };
                match spoken_of {
                    Some(target) if self.eat_any(&["one", "ones"]) => Ok(target),
                    _ => self.misspelt(),
                }
            }
        }
    }

    /// How the thing stands to another, if that is said.
    pub(super) fn relation(&mut self, depth: u32) -> Result<Option<Stands>, PlanError> {
        let start = self.at;
        self.eat_any(COPULAS);
        if let Some(stands) = self.on_ground(depth)? {
            return Ok(Some(stands));
        }
        if depth < DEEPEST
            && let Some(stands) = self.by_compass(depth)?
        {
            return Ok(Some(stands));
        }
        let side = longest(self.rest(), SIDES);
        let relation =
            longest(self.rest(), RELATIONS).filter(|_| longest_phrase(self.rest(), BY_WAYS).is_none());
        if let Some((side, count)) =
            side.filter(|(_, count)| relation.is_none_or(|(_, words)| *count >= words))
        {
            self.at += count;
            return Ok(Some(Stands::Side(side)));
        }
        let between = self.eat_any(&["between", "in between", "halfway between", "midway between"]);
        let of = !between
            && relation.is_none()
            && self.eat_any(&["of", "belonging to", "to"])
            && self.of_follows(start);
        if !between && !of && relation.is_none() {
            self.at = start;
            return Ok(None);
        }
        if depth >= DEEPEST {
            return Err(self.not_understood("describe a thing by at most four others"));
        }
        if between {
            return self.between(depth).map(Some);
        }
        if of {
            return Ok(Some(Stands::Of(Box::new(self.reference(depth + 1)?))));
        }
        let Some((relation, count)) = relation else { return Ok(None) };
        self.at += count;
        if self.eat_any(&["you", "me", "yourself"]) {
            return Ok(Some(Stands::Side(Side::Ahead)));
        }
        Ok(Some(Stands::To(relation, Box::new(self.reference(depth + 1)?))))
    }

    /// "To" says whose only of a door: "the door to the lab", but "bring the parcel to the lab".
    fn of_follows(&self, start: usize) -> bool {
        let is_to =
            self.lexemes[start..self.at].iter().any(|lexeme| lexeme.token == Token::Word("to".to_owned()));
        let is_door = start > 0
            && matches!(&self.lexemes[start - 1].token, Token::Word(word) if ["door", "doorway", "entrance", "gate"].contains(&word.as_str()));
        !is_to || is_door
    }

    /// The two that a plural stands for: "between the two trees".
    pub(super) fn pair(both: &Reference) -> (Reference, Reference) {
        let nth = |nth| Reference { choice: Choice::Nth(nth), count: Count::One, ..both.clone() };
        (nth(1), nth(2))
    }

    /// "Between the hospital and the museum", "between the two trees".
    fn between(&mut self, depth: u32) -> Result<Stands, PlanError> {
        let one = self.reference(depth + 1)?;
        if self.peeks("and") {
            self.at += 1;
            let other = self.reference(depth + 1)?;
            return Ok(Stands::Between(Box::new(one), Box::new(other)));
        }
        let (one, other) = Self::pair(&one);
        Ok(Stands::Between(Box::new(one), Box::new(other)))
    }

    pub(super) fn text_from(&self, start: usize) -> String {
        shortened(written(self.words, self.lexemes.get(start..self.at).unwrap_or_default()))
    }
}
