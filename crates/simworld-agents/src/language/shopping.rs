//! Orders about goods: what places sell, for whom it is, and who sells it.

use simworld_core::id::EntityId;
use simworld_core::seam::PlanError;

use super::clause::{Clause, Count, Reference, Target};
use super::lexer::{Lexeme, Token};
use super::lexicon::{DETERMINERS, category, is_animate, longest_phrase};
use super::numbers;
use super::parser::{Parser, shortened};
use super::phrases::Phrases;
use super::resolve::is_item;
use super::verbs::{Verb, longest_verb};

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
pub(super) const OTHERS: &Phrases = &Phrases::of(&[
    "kids", "children", "boys", "girls", "guys", "team", "crew", "family", "class", "office", "party", "meeting", "guests", "visitors",
    "friends", "colleagues", "others", "gang", "staff", "workers", "students", "lot", "lot of us", "everyone", "everybody", "us", "later", "lunch",
    "dinner", "breakfast", "tonight", "tomorrow", "mum", "mom", "dad", "wife", "husband", "boss", "grandma", "grandpa", "parents", "picnic", "trip",
    "road", "train", "journey", "way", "sister", "brother", "son", "daughter", "grandmother", "grandfather", "mother", "father", "aunt", "uncle", "cousin",
    "neighbour", "neighbor", "neighbours", "neighbors", "girlfriend", "boyfriend", "teacher", "friend", "colleague", "granny", "gran", "nan", "mummy", "daddy",
    "nephew", "niece", "grandson", "granddaughter", "grandparents", "grandkids", "grandchildren", "little ones", "twins", "baby", "husband and me", "birthday",
    "little boy", "little girl", "little one", "little brother", "little sister", "big brother", "big sister", "baby boy", "baby girl", "baby brother", "baby sister",
    "eldest", "youngest", "partner", "other half", "better half", "toddler", "grandchild", "kid", "child", "old man", "old mum", "old dad", "flatmate", "roommate",
]);
/// The place that was spoken of, behind what is bought there.
const THERE: &Phrases = &Phrases::of(&[
    "there",
    "in there",
    "right there",
    "from there",
    "over there",
    "at that place",
    "at that shop",
]);
/// To who speaks, who is nobody in the scene.
const TO_ME: &Phrases = &Phrases::of(&[
    "to me",
    "over to me",
    "back to me",
    "to us",
    "back to us",
    "over to us",
    "back here",
    "over here",
]);
/// What goods are called that were wanted before: "buy them".
#[rustfmt::skip]
const WISHED: &Phrases = &Phrases::of(&[
    "it", "them", "those", "these", "that", "both", "both of them", "all of them", "the lot", "one", "one of them", "some", "some of it", "some of that",
    "one of those", "that one", "this", "them all", "it all", "all of it", "any", "one of these", "some of them", "some more", "another", "a few", "the two",
    "the two of them",
]);
/// What is said of goods, and makes them no others.
#[rustfmt::skip]
const ADJECTIVES: &Phrases = &Phrases::of(&[
    "nice", "hot", "cold", "fresh", "good", "quick", "delicious", "tasty", "lovely", "proper", "another",
    "more", "little", "small", "big", "large", "new", "warm", "cool", "decent", "strong", "today", "todays",
    "own", "bit of", "cool", "yummy",
]);

/// What is bought, and how many times.
#[derive(Clone, Debug)]
pub(super) struct Goods {
    pub(super) name: String,
    pub(super) times: u32,
}

impl Parser<'_> {
    /// "Buy a coffee at the corner shop": goods are what a place nearby sells.
    pub(super) fn buy(&mut self) -> Result<Vec<Clause>, PlanError> {
        if let Some(goods) = self.wished_goods() {
            return self.purchase(goods, None);
        }
        let start = self.at;
        let whom = self.receiver();
        match self.wished_goods().or_else(|| self.goods()) {
            Some(goods) => self.purchase(goods, whom),
            None => self.fetched_rather(start).ok_or_else(|| self.not_sold()),
        }
    }

    /// What is said behind goods: where, how many times and for whom.
    pub(super) fn purchase(
        &mut self,
        goods: Goods,
        mut whom: Option<Reference>,
    ) -> Result<Vec<Clause>, PlanError> {
        let mut at = None;
        let mut several = Vec::new();
        let mut times = goods.times;
        let whom_wished = self.wished_by.take();
        self.wished = false;
        loop {
            if at.is_none() && self.eat_any(THERE) {
                at = Some(Reference::to(Target::There, "there".to_owned()));
                let comma = matches!(self.rest(), [Lexeme { token: Token::Comma, .. }, ..]);
                if comma && longest_phrase(&self.rest()[1..], &["at", "from", "in"]).is_some() {
                    (self.at, at) = (self.at + 1, None); // "buy a soup there, at the tearoom"
                }
            } else if several.is_empty()
                && let Some(all) =
                    if whom.is_none() { self.for_several() } else { self.each_of_them(whom.as_ref()) }
            {
                several = all;
            } else if whom.is_none()
                && several.is_empty()
                && let Some(receiver) = self.for_whom()
            {
                whom = Some(receiver);
            } else if self.view.speaker.is_none() && self.eat_any(TO_ME)
                || self.eat_any(&[
                    "to go",
                    "to take away",
                    "to take with you",
                    "takeaway",
                    "to eat",
                    "to drink",
                ])
            {
            } else if at.is_none()
                && longest_phrase(self.rest(), &["at", "from", "in", "inside", "over at", "down at", "up at"])
                    .is_some()
            {
                at = self.tail_place(&["at", "from", "in", "inside", "over at", "down at", "up at"])?;
            } else if let Some((more, words)) = numbers::times(self.rest()) {
                self.at += words;
                times *= more;
            } else if let Some(heads) = self.for_so_many().filter(|_| times == 1) {
                times = heads;
            } else if times == 1 && self.one_each() {
                times = 2;
            } else {
                self.wanted = Some(Goods { name: goods.name.clone(), times: 1 });
                if !several.is_empty() {
                    return Ok(super::shares::shared_out(&goods, times, at.as_ref(), several));
                }
                let whom = whom.or(whom_wished);
                return Ok(vec![Clause::Buy { goods: goods.name, times, at, whom }]);
            }
        }
    }

    /// Whether those goods were bought before in the sentence.
    pub(super) fn is_bought(&self, goods: &Goods) -> bool {
        !self.wished
            && goods.times == 1
            && self.wanted.as_ref().is_some_and(|wanted| wanted.name == goods.name)
    }

    /// "Coffee for four", "water for the three of us": as many as there are of us.
    fn for_so_many(&mut self) -> Option<u32> {
        let start = self.at;
        if self.eat_any(&["for"]) {
            self.eat_any(&["the", "all", "all of the", "us"]);
            let found = numbers::count(self.rest()).filter(|(count, _)| (2..=50).contains(count));
            if let Some((count, words)) = found {
                self.at += words;
                self.eat_any(&["of us", "people", "persons", "of you", "of them"]);
                if self.ends_clause() {
                    return Some(count);
                }
            }
        }
        self.at = start;
        None
    }

    /// "A coffee for me and one for my husband": two, of which nobody here gets one.
    fn one_each(&mut self) -> bool {
        let start = self.at;
        self.eat_any(&["for me", "for myself", "for you", "for yourself", "for us"]);
        let another = self.eat_any(&["and one", "and another", "and another one", "and one more"]);
        if another && self.eat_any(&["for"]) {
            self.eat_any(DETERMINERS);
            if (self.eat_any(OTHERS) || self.eat_any(&["me", "you", "yourself", "myself"]))
                && self.ends_clause()
            {
                return true;
            }
        }
        self.at = start;
        false
    }

    /// Remembers what is wanted, and "one" stands for: "what about a coffee? Go and buy one".
    pub(super) fn wish_for(&mut self, goods: Goods) {
        (self.wanted, self.wished) = (Some(goods), true);
    }

    /// What is spoken of and can be taken is what "it" stands for, and not the goods beside it: "a basket of apples".
    pub(super) fn settle_wish(&mut self, spoken_of: &[Clause]) {
        let is_thing = |what: &Reference| {
            self.view.find(what, super::resolve::Purpose::Any).is_ok_and(|found| is_item(found.kind))
        };
        if spoken_of.iter().any(|clause| matches!(clause, Clause::Mention { what } if is_thing(what))) {
            self.wished = false;
        }
    }

    /// "For a tea", behind going.
    pub(super) fn goods_gone_for(&mut self) -> Option<Goods> {
        let start = self.at;
        let goods = if self.eat_any(&["for", "out for", "off for", "and have", "out to get"]) {
            self.goods()
        } else {
            None
        };
        if goods.is_none() {
            self.at = start;
        }
        goods
    }

    /// Goods that are named somewhere before a place, with how many.
    pub(super) fn goods_within(&mut self, from: usize, end: usize) -> Option<Goods> {
        let whole = self.lexemes;
        let start = std::mem::replace(&mut self.at, from);
        let wanted = self.wanted.take();
        self.lexemes = &whole[..end];
        let found = (from..end).find_map(|at| {
            self.at = at;
            self.goods()
        });
        self.lexemes = whole;
        (self.at, self.wanted) = (start, wanted);
        found
    }

    /// "Them", "it", "one" for what was wanted before and is not ordered yet: "we need two pretzels, please buy them".
    pub(super) fn wished_goods(&mut self) -> Option<Goods> {
        let goods = self.wanted.clone().filter(|_| self.wished)?;
        let start = self.at;
        let single = longest_phrase(
            self.rest(),
            &["one", "some", "another", "one of them", "one of those", "one of these"],
        )
        .is_some();
        if self.eat_any(WISHED) {
            self.for_others();
            let counts = matches!(self.rest().first(), Some(Lexeme { token: Token::Word(_), .. }))
                && self.names.goods(self.rest()).is_some();
            let goes_on = longest_phrase(
                self.rest(),
                &[
                    "to", "for", "at", "from", "in", "over", "there", "here", "back", "up", "right",
                    "straight", "with",
                ],
            );
            if !counts && (self.ends_clause() || goes_on.is_some()) {
                self.eat_any(&["here", "back", "over", "up", "back here", "over here"]);
                return Some(if single { Goods { times: 1, ..goods } } else { goods });
            }
        }
        self.at = start;
        None
    }

    /// Whether what follows orders the goods that were only wished for: "..., can you go and get them?".
    pub(super) fn orders_what_is_wished(&self) -> bool {
        const MOST: usize = 24;
        let rest = self.rest();
        let is_mark = |lexeme: &Lexeme| matches!(lexeme.token, Token::Comma | Token::Break);
        let Some(mark) =
            rest.iter().position(|lexeme| is_mark(lexeme) || lexeme.token == Token::Word("so".to_owned()))
        else {
            return false;
        };
        let mut at = mark + 1;
        while at < rest.len().min(mark + MOST) {
            let Some((verb, words)) = longest_verb(&rest[at..]) else {
                at += 1;
                continue;
            };
            let gets = matches!(verb, Verb::Buy | Verb::Take | Verb::Deliver);
            let mut after = &rest[(at + words).min(rest.len())..];
            if gets {
                let whom = longest_phrase(
                    after,
                    &["me", "us", "him", "her", "yourself", "up", "me up", "over", "them both"],
                );
                let named = self.names.exact(after).map(|(_, words)| words).filter(|_| whom.is_none());
                let skipped = &after[whom.or(named).unwrap_or(0)..];
                if longest_phrase(skipped, WISHED).is_some() || longest_phrase(after, WISHED).is_some() {
                    return true;
                }
            }
            // "Go to the tearoom and get it": going there comes first.
            let goes =
                matches!(verb, Verb::Go | Verb::Run | Verb::Stroll | Verb::Drive) || gets && after.is_empty();
            if !goes {
                return false;
            }
            after = &after[after.len().min(1)..];
            at = rest.len() - after.len();
        }
        false
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
            && let Some(Goods { name, .. }) = self.wanted.clone()
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
        if self.beside.absent && self.eat_any(&["him", "her", "them"]) {
            return None;
        }
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
            || longest_phrase(rest, super::reported::TITLES).is_some()
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
            let own = longest_phrase(self.rest(), &["my", "our", "his", "her", "their", "your"]).is_some();
            self.eat_any(DETERMINERS);
            while self.eat_any(&[
                "little", "big", "old", "young", "dear", "poor", "eldest", "youngest", "whole", "other",
                "best",
            ]) {}
            let whose = own
                && self
                    .eat_any(&["boy", "girl", "child", "kid", "man", "woman", "lady", "guy", "lad", "dog"]);
            let others = self.eat_any(OTHERS);
            self.eat_any(OTHERS); // "the birthday party"
            if (whose || others) && self.ends_clause() {
                return;
            }
        }
        self.at = start;
    }

    /// "... for Hana", "... to Hana".
    pub(super) fn for_whom(&mut self) -> Option<Reference> {
        self.for_others();
        if self.beside.absent
            && self.eat_any(&["for him", "for her", "for them", "to him", "to her", "to them"])
        {
            return None;
        }
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
        let Some((goods, count)) = self.names.goods(rest) else {
            // "The toy shop" is the one that is called "Toucan Toys", if nothing is called so itself.
            let words = 1 + longest_phrase(rest.get(1..)?, SELLERS)?;
            if self.names.exact(rest).is_some_and(|(_, named)| named >= words) {
                return None;
            }
            let ids = self.names.shops_called(&rest[0].token);
            self.at += if ids.is_empty() { return None } else { words };
            return Some(ids);
        };
        let words = count + longest_phrase(&rest[count..], SELLERS)?;
        if self.names.exact(rest).is_some_and(|(_, named)| named >= words) {
            return None;
        }
        self.at += words;
        Some(self.names.sellers(&goods))
    }
}
