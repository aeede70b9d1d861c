//! What is said after a noun: where the thing stands, what it is like, and which of several it is.

use simworld_core::scene::{EntityKind, Relation};
use simworld_core::seam::PlanError;

use super::clause::{Choice, Count, Reference, Side, Stands, Target};
use super::lexer::Token;
use super::lexicon::{
    COPULAS, DETERMINERS, MOSTS, category, fits, longest, longest_phrase, longest_relation, longest_side,
};
use super::modifiers::FREE;
use super::parser::Parser;
use super::phrases::Phrases;
use super::reference::{DEEPEST, DOOR_STATES};
use super::rows::COUNTED;

/// What is said of anything that is about.
#[rustfmt::skip]
const YOU_SEE: &Phrases = &Phrases::of(&[
    "you see", "that you see", "you can see", "that you can see", "you find", "that you find", "you can find",
    "you come to", "you come across", "you spot", "there is", "in sight", "in view", "in the area", "there are",
    "that there is", "that there are", "lying about", "lying around", "standing about", "standing around",
    "around here", "in the city", "in the whole city", "in this city", "in town", "in the town", "in the neighbourhood", "in the neighborhood",
    "in this area", "in the vicinity", "of all", "of them all",
]);
/// Before what is sold somewhere.
#[rustfmt::skip]
const SELLING: &Phrases = &Phrases::of(&[
    "that sells", "which sells", "selling", "that sell", "where they sell", "where you can buy",
    "where you can get", "where you get", "where i can get", "where i can buy", "who sells", "that has",
    "which has",
]);
/// Nobody uses it.
#[rustfmt::skip]
const UNUSED: &Phrases = &Phrases::of(&[
    "where nobody sits", "where nobody is sitting", "where no one sits", "where no one is sitting",
    "that nobody is sitting on", "that no one is sitting on", "nobody is sitting on", "no one is sitting on",
    "that nobody uses", "that nobody is using", "nobody is using", "with nobody on it", "with no one on it",
    "without anybody on it",
]);
const IN_USE: &[&str] = &["taken", "occupied", "in use", "used"];
/// The least distance, with nothing or "to" something behind it.
#[rustfmt::skip]
const NEAR_MOST: &Phrases = &Phrases::of(&[
    "nearest", "closest", "nearer", "closer", "nearest you", "closest to you", "nearest to you", "near you", "close to you",
    "nearby", "close by", "closest to me", "nearest to me", "near me", "near here", "nearer", "closer",
    "nearer to you", "closer to you", "next to you", "beside you", "by you", "closest to here",
    "nearest to here", "nearest here", "closest to where you are", "nearest to where you are",
    "closest to where you stand", "nearest to where you stand", "closest to your position",
    "nearest to your position", "nearer to here", "closer to here", "nearest us", "nearest to us", "closest to us", "near us", "close to us", "nearest me", "closest by", "nearest by", "closest at hand", "nearest at hand", "by us", "next to us", "beside us", "next to me",
]);
/// The greatest.
#[rustfmt::skip]
const FAR_MOST: &Phrases = &Phrases::of(&[
    "farthest away", "furthest away", "farthest from you", "furthest from you", "most distant", "farthest",
    "furthest", "farthest away from you", "farthest from here", "furthest from here", "farthest from me",
    "furthest from me", "farthest away from here", "furthest away from here", "furthest away from you",
    "farther", "further", "farther away", "further away", "farther off", "further off", "furthest off",
    "farthest off", "most distant from you", "most distant from here",
]);
const SUPERLATIVES: &Phrases = &Phrases::of(&[
    "nearest",
    "closest",
    "farthest",
    "furthest",
    "nearer",
    "closer",
    "farther",
    "further",
    "most distant",
]);
/// Sides farthest out, behind the noun.
#[rustfmt::skip]
const OUTERMOST: &[(&[&str], Side)] = &[
    (&["on the far left", "furthest to the left", "farthest to the left", "furthest left", "most to the left"],
    Side::Left),
    (&["on the far right", "furthest to the right", "farthest to the right", "furthest right",
    "most to the right"], Side::Right),
];
/// What makes a place no more exact.
#[rustfmt::skip]
const LOOSELY: &Phrases = &Phrases::of(&[
    "right", "just", "directly", "over", "up", "down", "still", "currently", "back", "out", "all the way",
    "somewhere", "over there", "right there", "up there", "down there", "out there", "back there",
    "immediately", "straight",
]);
/// What begins with "by" and the like, and names nothing beside which something stands.
#[rustfmt::skip]
const WAYS: &Phrases = &Phrases::of(&[
    "by way of", "by the shortest", "by the quickest", "by the fastest", "by the most direct", "by car",
    "by foot", "by bus", "by taxi", "by scooter", "by bike", "by bicycle", "by cab",
]);
/// Which are not meant.
const EXCEPT: &Phrases = &Phrases::of(&[
    "except",
    "except for",
    "other than",
    "apart from",
    "excluding",
    "but not",
    "save for",
    "with the exception of",
    "besides",
]);

impl Parser<'_> {
    /// Reads on for as long as something is said of the thing.
    pub(super) fn described(&mut self, reference: &mut Reference, depth: u32) -> Result<(), PlanError> {
        loop {
            let start = self.at;
            if self.in_test && longest_phrase(self.rest(), &["is", "are"]).is_some() {
                return Ok(());
            }
            let plain_is = self.peeks("is") || self.peeks("are");
            let copula = self.copulas();
            if copula && longest_phrase(self.rest().get(1..).unwrap_or_default(), SUPERLATIVES).is_some() {
                self.eat_any(&["the"]); // "the bench that is the farthest"
            }
            let whichever = plain_is && !self.in_test && self.said_whichever();
            let likeness = copula && (!plain_is || whichever) && self.likeness_behind(reference)
                || copula && !self.in_test && self.most_behind(reference);
            if likeness
                || self.use_behind(reference)
                || self.nearest_behind(reference, start, depth)?
                || self.farthest_behind(reference, depth)?
                || self.place_in_row(reference)
                || self.eat_any(COUNTED)
                || matches!(reference.choice, Choice::Nth(_)) && self.eat_any(&["from here", "from you"])
                || self.sold_there(reference)?
                || self.spared(reference, depth)
                || self.stands(reference, depth)?
            {
                continue;
            }
            self.at = start;
            return Ok(());
        }
    }

    /// "Whichever chair is free": the "is" says which.
    fn said_whichever(&self) -> bool {
        const NEAR: usize = 5;
        self.lexemes[self.at.saturating_sub(NEAR)..self.at].iter().any(
            |lexeme| matches!(&lexeme.token, Token::Word(word) if word == "whichever" || word == "whatever"),
        )
    }

    /// "That is", "standing right", "which is located": what leads from a noun to where it is.
    fn copulas(&mut self) -> bool {
        let start = self.at;
        loop {
            let relation = longest_relation(self.rest()).map(|(_, words)| words);
            let side = longest_side(self.rest()).map(|(_, words)| words);
            let place = relation.max(side).unwrap_or(0);
            let words = longest_phrase(self.rest(), COPULAS).max(longest_phrase(self.rest(), LOOSELY));
            let lone = self.peeks("there") && longest_relation(&self.rest()[1..]).is_some();
            match words.or(lone.then_some(1)).filter(|words| *words > place) {
                Some(words) => self.at += words,
                None => return self.at > start,
            }
        }
    }

    /// "... that is red", "... that isn't white".
    pub(super) fn likeness_behind(&mut self, reference: &mut Reference) -> bool {
        let start = self.at;
        let not = self.eat_any(&["not", "neither"]);
        self.eat_any(&["painted", "coloured", "colored", "the", "both"]);
        if let Some((paint, words)) = self.peek_paint() {
            self.at += words;
            if !not {
                reference.traits.paint = Some(paint);
                self.eat_any(&["and"]);
                return true;
            }
            reference.traits.unlike.push(paint);
            while self.eat_any(&["nor", "or", "and not"])
                && let Some((paint, words)) = self.peek_paint()
            {
                self.at += words;
                reference.traits.unlike.push(paint);
            }
            return true;
        }
        if self.eat_any(FREE) && !not || not && self.eat_any(IN_USE) {
            reference.traits.free = true;
            return true;
        }
        if let Some(((key, set), words)) = longest(self.rest(), DOOR_STATES) {
            self.at += words;
            reference.traits.state = Some((key, set != not));
            return true;
        }
        self.at = start;
        false
    }

    /// "... that is the shortest".
    fn most_behind(&mut self, reference: &mut Reference) -> bool {
        let start = self.at;
        let the = self.eat_any(&["the"]);
        if let Some(((measure, most), words)) = longest(self.rest(), MOSTS)
            && (the || self.clause_ends_after(words))
        {
            self.at += words;
            reference.choose(Choice::Most(measure, most));
            return true;
        }
        self.at = start;
        false
    }

    /// Whether the clause ends behind so many words.
    fn clause_ends_after(&mut self, words: usize) -> bool {
        self.at += words;
        let ends = self.ends_clause();
        self.at -= words;
        ends
    }

    fn use_behind(&mut self, reference: &mut Reference) -> bool {
        let unused = self.eat_any(UNUSED);
        reference.traits.free |= unused;
        // "The first chair you see" is the nearest.
        unused || self.eat_any(YOU_SEE) || self.eat_whole_place()
    }

    /// "On campus", "in the park", where that is all that one is in and nothing is called so.
    fn eat_whole_place(&mut self) -> bool {
        #[rustfmt::skip]
        const PLACES: &Phrases = &Phrases::of(&[
            "campus", "park", "zoo", "farm", "beach", "campsite", "camp", "airport", "market", "market place", "marketplace", "harbour", "yard", "village", "square",
            "site", "premises", "grounds", "old town", "quay", "depot", "neighbourhood", "place",
        ]);
        let start = self.at;
        if self.eat_any(&["in the", "on the", "at the", "on this", "in this", "in our", "on our", "on", "in"])
            && let Some(words) = longest_phrase(self.rest(), PLACES)
            && self.names.exact(self.rest()).is_none()
            && longest_phrase(&self.rest()[words..], &["bench", "house", "shop", "door"]).is_none()
        {
            let known = category(self.rest()).is_some_and(|(class, _)| {
                let any = Reference::to(Target::Any(class), String::new());
                self.view.find(&any, super::resolve::Purpose::Any).is_ok()
            });
            self.at += words;
            if !known && self.ends_clause() {
                return true;
            }
        }
        self.at = start;
        false
    }

    /// "... nearest to the museum", "... nearby".
    fn nearest_behind(
        &mut self,
        reference: &mut Reference,
        start: usize,
        depth: u32,
    ) -> Result<bool, PlanError> {
        // "The bench that is second closest to the canteen".
        let before = self.at;
        let nth =
            if self.at > start { super::numbers::ordinal(self.rest()).filter(|nth| *nth > 1) } else { None };
        self.at += usize::from(nth.is_some());
        if !self.eat_any(NEAR_MOST) {
            self.at = before;
            return Ok(false);
        }
        if let Some(nth) = nth {
            reference.choice = Choice::Nth(nth);
        }
        let bare = ["nearest", "closest", "nearer", "closer"]
            .iter()
            .any(|word| fits(&self.lexemes[self.at - 1..], word).is_some());
        if bare
            && self.at > start
            && let Some(anchor) = self.bare_anchor(depth)
        {
            reference.relation = Some(Stands::NearestTo(Box::new(anchor), true));
            return Ok(true);
        }
        if !self.peeks("to") {
            if reference.choice == Choice::Open {
                reference.choice = Choice::Nearest;
            }
            return Ok(true);
        }
        self.at += 1;
        let anchor = self.reference(depth + 1)?;
        reference.relation = Some(Stands::NearestTo(Box::new(anchor), true));
        Ok(true)
    }

    fn farthest_behind(&mut self, reference: &mut Reference, depth: u32) -> Result<bool, PlanError> {
        if let Some((side, words)) = longest(self.rest(), OUTERMOST) {
            self.at += words;
            reference.choose(Choice::Side(side));
            return Ok(true);
        }
        if !self.eat_any(FAR_MOST) {
            return Ok(false);
        }
        self.eat_any(&["to the", "in the"]);
        if let Some(compass) = self.compass() {
            reference.choose(Choice::Compass(compass));
            return Ok(true);
        }
        if self.eat_any(&["from", "away from"]) {
            let anchor = self.reference(depth + 1)?;
            reference.relation = Some(Stands::NearestTo(Box::new(anchor), false));
        } else {
            reference.choose(Choice::Farthest);
        }
        Ok(true)
    }

    fn sold_there(&mut self, reference: &mut Reference) -> Result<bool, PlanError> {
        let start = self.at;
        let Some(words) = longest_phrase(self.rest(), SELLING) else { return Ok(false) };
        let has = self.peeks("that has") || self.peeks("which has");
        self.at += words;
        self.eat_any(&["a", "an", "some", "the"]);
        match self.names.goods(self.rest()) {
            Some((goods, words)) => {
                reference.traits.sells = Some(goods.into());
                self.at += words;
                Ok(true)
            }
            None if has => {
                self.at = start;
                Ok(false)
            }
            None => Err(self.not_understood(&format!("sold here are {}", self.names.sold()))),
        }
    }

    /// "... except the white one": where a scene is edited that is read elsewhere.
    fn spared(&mut self, reference: &mut Reference, depth: u32) -> bool {
        let start = self.at;
        if self.view.streets.is_some() || depth >= DEEPEST || reference.except.is_some() {
            return false;
        }
        let several = reference.count != Count::One;
        if self.eat_any(EXCEPT) || several && self.eat_any(&["but"]) {
            self.class = if let Target::Any(class) = &reference.target { Some(class) } else { self.class };
            if let Ok(except) = self.reference(depth + 1) {
                reference.except = Some(Box::new(except));
                return true;
            }
        }
        self.at = start;
        false
    }

    /// Where it stands; of several places all count.
    fn stands(&mut self, reference: &mut Reference, depth: u32) -> Result<bool, PlanError> {
        const MOST: usize = 3;
        let so_far = match &reference.relation {
            None => 0,
            Some(Stands::All(all)) => all.len(),
            Some(_) => 1,
        };
        if so_far >= MOST || so_far > 0 && self.view.streets.is_some() {
            return Ok(false);
        }
        let start = self.at;
        if so_far == 0
            && let Some(found) = self.has_beside(depth)
        {
            reference.relation = Some(found);
            return Ok(true);
        }
        if so_far > 0 {
            self.eat_any(&["and"]);
        }
        let found = match self.relation(depth) {
            Ok(Some(found)) => Some(found),
            Ok(None) => self.right_at(reference, depth),
            // What follows "and" may be an order of its own.
            Err(_)
                if self
                    .lexemes
                    .get(start)
                    .is_some_and(|lexeme| lexeme.token == Token::Word("and".to_owned())) =>
            {
                None
            }
            Err(error) => return Err(error),
        };
        let Some(found) = found else {
            self.at = start;
            return Ok(false);
        };
        reference.relation = Some(match reference.relation.take() {
            None => found,
            Some(Stands::All(mut all)) => {
                all.push(found);
                Stands::All(all)
            }
            Some(one) => Stands::All(vec![one, found]),
        });
        Ok(true)
    }

    /// "The bench at the museum", "the person on the bench": only of what no order brings there.
    fn right_at(&mut self, reference: &Reference, depth: u32) -> Option<Stands> {
        const BROUGHT: &[EntityKind] = &[EntityKind::Parcel, EntityKind::Prop, EntityKind::Cone];
        let Target::Any(class) = &reference.target else { return None };
        if self.view.streets.is_some()
            || class.is_place()
            || class.is_area()
            || class.kinds().iter().any(|kind| BROUGHT.contains(kind))
        {
            return None;
        }
        let start = self.at;
        let person = class.kinds().contains(&EntityKind::Person);
        let at = self.eat_any(&["at", "over at", "up at", "down at", "outside of"])
            || person && self.eat_any(&["on", "in", "sitting on", "with"]);
        let anchor = if at { self.bare_anchor(depth) } else { None };
        if anchor.is_none() {
            self.at = start;
        }
        anchor.map(|anchor| Stands::To(Relation::NextTo, Box::new(anchor)))
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

    /// How the thing stands to another, if that is said.
    pub(super) fn relation(&mut self, depth: u32) -> Result<Option<Stands>, PlanError> {
        let start = self.at;
        self.copulas();
        if let Some(stands) = self.on_ground(depth)? {
            return Ok(Some(stands));
        }
        if depth < DEEPEST
            && let Some(stands) = self.by_compass(depth)?
        {
            return Ok(Some(stands));
        }
        let side = longest_side(self.rest());
        let relation = longest_relation(self.rest()).filter(|_| longest_phrase(self.rest(), WAYS).is_none());
        if let Some((side, count)) =
            side.filter(|(_, count)| relation.is_none_or(|(_, words)| *count >= words))
        {
            self.at += count;
            return Ok(Some(Stands::Side(side)));
        }
        let between = self.eat_any(&["between", "in between", "halfway between", "midway between"]);
        let of = !between
            && relation.is_none()
            && self.eat_any(&[
                "of",
                "belonging to",
                "belongs to",
                "that belongs to",
                "which belongs to",
                "to",
            ])
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
            return Ok(Some(Stands::Side(match relation {
                Relation::LeftOf => Side::Left,
                Relation::RightOf => Side::Right,
                Relation::Behind => Side::Behind,
                _ => Side::Ahead,
            })));
        }
        Ok(Some(Stands::To(relation, Box::new(self.reference(depth + 1)?))))
    }
}
