//! Orders about goods: what places sell, for whom it is, and who sells it.

use simworld_core::id::EntityId;
use simworld_core::seam::PlanError;

use super::clause::{Clause, Count, Reference, Target};
use super::lexer::Token;
use super::lexicon::{DETERMINERS, category, is_animate, longest_phrase};
use super::numbers;
use super::parser::{Parser, shortened};
use super::phrases::Phrases;

/// Who sells what is said before: "the coffee shop".
const SELLERS: &Phrases =
    &Phrases::of(&["shop", "store", "stand", "stall", "kiosk", "seller", "vendor", "place"]);
/// In what goods come, before "of".
const VESSELS: &[&str] = &[
    "bottle", "cup", "piece", "loaf", "bowl", "can", "slice", "glass", "portion", "bag", "copy", "carton",
    "mug", "plate", "packet", "bit", "helping", "box", "tin", "jar", "pint", "litre", "liter", "bunch",
    "bar", "tub", "roll", "pack", "cone", "bouquet", "block", "tray", "round", "pair", "spot", "drop",
    "scoop", "serving", "sip", "mouthful", "edition",
];
/// Who or what goods are for who is no part of a scene.
#[rustfmt::skip]
const OTHERS: &Phrases = &Phrases::of(&[
    "kids", "children", "boys", "girls", "guys", "team", "crew", "family", "class", "office", "party", "meeting", "guests", "visitors",
    "friends", "colleagues", "others", "gang", "staff", "workers", "students", "lot", "lot of us", "everyone", "everybody", "us", "later", "lunch",
    "dinner", "breakfast", "tonight", "tomorrow", "mum", "mom", "dad", "wife", "husband", "boss", "grandma", "grandpa", "parents", "picnic", "trip",
    "road", "train", "journey", "way",
]);
/// What is said of goods, and makes them no others.
#[rustfmt::skip]
const ADJECTIVES: &Phrases = &Phrases::of(&[
    "nice", "hot", "cold", "fresh", "good", "quick", "delicious", "tasty", "lovely", "proper", "another",
    "more", "little", "small", "big", "large", "new", "warm", "cool", "decent", "strong", "today", "todays",
    "own", "bit of", "cool", "yummy",
]);

/// What is bought, and how many times.
pub(super) struct Goods {
    pub(super) name: String,
    pub(super) times: u32,
}

impl Parser<'_> {
    /// "Buy a coffee at the corner shop": goods are what a place nearby sells.
    pub(super) fn buy(&mut self) -> Result<Vec<Clause>, PlanError> {
        let whom = self.receiver();
        match self.goods() {
            Some(goods) => self.purchase(goods, whom),
            None => Err(self.not_sold()),
        }
    }

    /// What is said behind goods: where, how many times and for whom.
    pub(super) fn purchase(
        &mut self,
        goods: Goods,
        mut whom: Option<Reference>,
    ) -> Result<Vec<Clause>, PlanError> {
        let mut at = None;
        let mut times = goods.times;
        loop {
            if whom.is_none()
                && let Some(receiver) = self.for_whom()
            {
                whom = Some(receiver);
            } else if at.is_none()
                && longest_phrase(self.rest(), &["at", "from", "in", "inside", "over at", "down at", "up at"])
                    .is_some()
            {
                at = self.tail_place(&["at", "from", "in", "inside", "over at", "down at", "up at"])?;
            } else if let Some((more, words)) = numbers::times(self.rest()) {
                self.at += words;
                times *= more;
            } else {
                self.view_goods(&goods.name);
                return Ok(vec![Clause::Buy { goods: goods.name, times, at, whom }]);
            }
        }
    }

    /// Remembers what "one" stands for: "what about a coffee? Go and buy one".
    pub(super) fn view_goods(&mut self, goods: &str) {
        self.wanted = Some(goods.to_owned());
    }

    fn not_sold(&self) -> PlanError {
        let mut at = self.at;
        while longest_phrase(&self.lexemes[at..], &["a", "an", "the", "some", "any", "one"]).is_some() {
            at += 1;
        }
        let rest = &self.lexemes[at..];
        let ends = ["at", "from", "in", "and", "then", "to", "for"];
        let end = (0..rest.len())
            .find(|at| {
                !matches!(rest[*at].token, Token::Word(_)) || longest_phrase(&rest[*at..], &ends).is_some()
            })
            .unwrap_or(rest.len());
        let Some((first, last)) = rest[..end].first().zip(rest[..end].last()) else {
            return self.not_understood("say what to buy");
        };
        let wanted = format!("{} to buy", shortened(&self.words[first.start..last.end.max(first.start)]));
        PlanError::NotFound { wanted, near: self.names.sold() }
    }

    /// "Two cups of coffee", "a nice cup of tea", or "one" of what was spoken of.
    pub(super) fn goods(&mut self) -> Option<Goods> {
        let start = self.at;
        let mut times = 1;
        if let Some((Count::Exactly(count), words)) = self.peek_count() {
            times = count;
            self.at += words;
        }
        let one = self.peeks("one") || self.peeks("some");
        while self.eat_any(&["a", "an", "the", "some", "one", "any", "my", "your", "his", "her"])
            || self.eat_any(ADJECTIVES)
        {}
        if let Some(words) = self.vessel() {
            self.at += words;
            while self.eat_any(ADJECTIVES) {}
        }
        if let Some((name, words)) = self.names.goods(self.rest()) {
            let called = self.names.exact(self.rest()).is_some_and(|(_, named)| named > words);
            if !called {
                self.at += words;
                return Some(Goods { name, times });
            }
        } else if one
            && self.ends_clause_or_place()
            && let Some(name) = self.wanted.clone()
        {
            return Some(Goods { name, times });
        }
        self.at = start;
        None
    }

    fn ends_clause_or_place(&self) -> bool {
        self.ends_clause() || longest_phrase(self.rest(), &["at", "from", "in"]).is_some()
    }

    /// "Cups of", "bottle of".
    fn vessel(&self) -> Option<usize> {
        let Token::Word(word) = &self.rest().first()?.token else { return None };
        let is_vessel = |known: &&str| {
            word == *known
                || word.strip_suffix('s').is_some_and(|one| one == *known)
                || word.strip_suffix("es").is_some_and(|one| one == *known)
                || *known == "loaf" && word == "loaves"
        };
        let of = longest_phrase(self.rest().get(1..)?, &["of"])?;
        VESSELS.iter().any(is_vessel).then_some(1 + of)
    }

    /// Whoever gets it, before what he gets: "fetch Gus a newspaper".
    pub(super) fn receiver(&mut self) -> Option<Reference> {
        if self.eat_any(&["me", "yourself", "us", "myself", "ourselves"]) {
            self.eat_any(&["up", "over", "back"]);
            return None;
        }
        self.somebody_here()
    }

    /// A person, a dog or a robot, if one is named here.
    pub(super) fn somebody_here(&mut self) -> Option<Reference> {
        let start = self.at;
        if !self.may_be_somebody() {
            return None;
        }
        let somebody = self.reference(0).ok().filter(|somebody| self.is_somebody(somebody));
        if somebody.is_none() {
            self.at = start;
        }
        somebody
    }

    /// Whether somebody may be named here: looking for any phrase takes longer.
    fn may_be_somebody(&self) -> bool {
        const NEAR: usize = 6;
        let rest = self.rest();
        let is_class = |at: usize| {
            category(&rest[at..]).is_some_and(|(class, _)| class.kinds().iter().any(|kind| is_animate(*kind)))
        };
        longest_phrase(rest, &["him", "her", "them", "whoever"]).is_some()
            || self.names.exact(rest).is_some_and(|(ids, _)| {
                ids.iter().any(|id| self.view.scene.entity(*id).is_some_and(|entity| is_animate(entity.kind)))
            })
            || longest_phrase(rest, DETERMINERS).is_some() && (1..rest.len().min(NEAR)).any(is_class)
            || matches!(rest.first(), Some(lexeme) if matches!(lexeme.token, Token::Id(_)))
    }

    /// "... for the kids": those who are not here get it from whoever bought it, some other time.
    fn for_others(&mut self) {
        let start = self.at;
        if self.eat_any(&["for"]) {
            self.eat_any(&["all of", "all", "the rest of"]);
            self.eat_any(DETERMINERS);
            if self.eat_any(OTHERS) && self.ends_clause() {
                return;
            }
        }
        self.at = start;
    }

    /// "... for Hana", "... to Hana".
    pub(super) fn for_whom(&mut self) -> Option<Reference> {
        self.for_others();
        let start = self.at;
        if !self.eat_any(&["for", "to", "over to", "across to", "and give it to", "and take it to"]) {
            return None;
        }
        let somebody = self.somebody_here();
        if somebody.is_none() {
            self.at = start;
        }
        somebody
    }

    /// Whether a phrase means a person, a dog or a robot.
    pub(super) fn is_somebody(&self, reference: &Reference) -> bool {
        let is_animate_id =
            |id: &EntityId| self.view.scene.entity(*id).is_some_and(|entity| is_animate(entity.kind));
        match &reference.target {
            Target::Them => true,
            Target::Id(id) => is_animate_id(id),
            Target::Named(ids) => ids.first().is_some_and(is_animate_id),
            Target::Any(class) => class.kinds().iter().any(|kind| is_animate(*kind)),
            _ => false,
        }
    }

    /// "The coffee shop" is any that sells coffee, unless one is called so.
    pub(super) fn sellers(&mut self) -> Option<Vec<EntityId>> {
        let rest = self.rest();
        (1..4).find(|at| rest.get(*at..).is_some_and(|rest| longest_phrase(rest, SELLERS).is_some()))?;
        let (goods, count) = self.names.goods(rest)?;
        let words = count + longest_phrase(&rest[count..], SELLERS)?;
        if self.names.exact(rest).is_some_and(|(_, named)| named >= words) {
            return None;
        }
        self.at += words;
        Some(self.names.sellers(&goods))
    }
}
