//! Orders as statements of who gets what, and where it goes: "Hana needs the letter", "the parcel goes to the museum".

use super::clause::{Clause, Manner, Pace, Reference, Spot};
use super::lexer::{Lexeme, Token};
use super::lexicon::longest_phrase;
use super::parser::Parser;
use super::phrases::Phrases;

/// Between somebody and what he is to get.
#[rustfmt::skip]
const GETS: &Phrases = &Phrases::of(&[
    "needs", "should get", "should have", "is to get", "must get", "ought to get", "ought to have", "must have",
    "has to get", "has to have", "gets", "is to have", "is waiting for", "wants", "would like", "would love",
    "could do with", "asked for", "has asked for", "is asking for", "deserves", "fancies", "is supposed to get",
    "is after", "want", "need", "would like to have", "could use", "fancy", "are dying for", "are hoping for", "have ordered", "have asked for", "will want", "is dying for", "is hoping for", "expects", "is expecting", "ordered", "has ordered",
]);
/// Between a thing and where or to whom it goes.
#[rustfmt::skip]
const GOES: &Phrases = &Phrases::of(&[
    "should go to", "goes to", "belongs to", "has to go to", "must go to", "needs to go to", "is for",
    "is to go to", "ought to go to", "belongs at", "belongs in", "should go in", "goes in", "should end up at",
    "should end up with", "needs to get to", "has to get to", "must get to", "should get to", "needs to be at",
    "must be at", "should be at", "goes back to", "belongs by", "goes next to", "should go next to", "goes by",
    "goes on", "goes onto", "goes into", "belongs on", "belongs next to", "should go on", "should go into", "has to be at", "has to be in", "should be in",
    "must be in", "needs to be in", "has to go in", "has to go on", "should be on", "goes under", "belongs under", "is supposed to be at", "is meant to be at",
    "goes over to", "should go over to", "needs to be with", "is meant for", "should be with",
]);

/// Who is to be somewhere, before where.
#[rustfmt::skip]
const NEEDED: &Phrases = &Phrases::of(&[
    "youre needed", "you are needed", "youre wanted", "you are wanted", "somebody is needed", "someone is needed", "youre expected",
    "you are expected", "your presence is required", "your presence is requested", "need you", "need somebody", "need someone",
    "want you", "i want to see you", "id like to see you", "i need a robot", "i need a hand", "ill meet you", "i will meet you",
    "ill see you", "i will see you", "ill be waiting for you", "ill wait for you", "meet me", "meet us", "join me", "join us", "see you", "see me",
    "great to have you", "good to have you", "nice to have you", "lovely to have you", "they are expecting you", "theyre expecting you",
    "theyre waiting for you", "they are waiting for you",
]);
/// Who needs somebody, how, and whom: "they want somebody".
const WHO: &Phrases = &Phrases::of(&["i", "we", "they", "he", "she", "people", "everybody", "everyone"]);
#[rustfmt::skip]
const NEEDS: &Phrases = &Phrases::of(&[
    "need", "needs", "want", "wants", "would like", "would love", "require", "requires", "could use", "could do with", "expect",
    "expects", "are expecting", "is expecting", "is waiting for", "are waiting for", "is looking for", "are looking for", "have asked for", "asked for", "are asking for", "is asking for",
]);
const WHOM: &Phrases = &Phrases::of(&[
    "you",
    "somebody",
    "someone",
    "one of you",
    "anybody",
    "anyone",
    "a hand",
    "some help",
    "help",
    "a helper",
    "a volunteer",
    "another person",
    "a person",
]);
/// Between that and a place.
#[rustfmt::skip]
const THERE: &Phrases = &Phrases::of(&[
    "over", "down", "up", "out", "back", "right", "round", "across", "along", "standing", "waiting", "now", "inside",
    "stationed", "posted", "to be", "to stand", "to wait", "all", "urgently", "quickly", "immediately",
]);
/// What says of a thing that was named first that one goes there.
#[rustfmt::skip]
const THAT_IS_WHERE: &Phrases = &Phrases::of(&[
    "thats where", "that is where", "thats the place", "that is the place", "thats the one", "that is the one", "there is where",
    "thats the spot", "that is the spot", "this is where", "thats our stop", "thats your stop", "thats where its at",
]);
#[rustfmt::skip]
const YOU_GO: &Phrases = &Phrases::of(&[
    "i want you to", "i want you", "you should", "you need to", "you have to", "you must", "i need you to", "i need you",
    "id like you to", "id like you", "you are to", "youre to", "we need to", "we have to", "we want to", "i want to", "i need to",
    "we are", "youre", "you are", "you", "we", "they want you to", "they want you", "they need you", "i mean you to", "were",
]);

impl Parser<'_> {
    /// "I need somebody at the bench", "they want you over by the gate".
    pub(super) fn needed_there(&mut self) -> Option<Vec<Clause>> {
        self.eat_any(&["it would be", "itd be", "it is", "its"]);
        if !self.eat_any(NEEDED) {
            let would = self.eat_any(&["id like", "id love"]);
            let somebody =
                would || self.eat_any(WHO) || self.somebody_here().is_some() || self.outsider_before(NEEDS);
            if !somebody || !would && !self.eat_any(NEEDS) || !self.eat_any(WHOM) {
                return None;
            }
        }
        while self.eat_any(THERE) {}
        if super::numbers::walked(self.rest()).is_some() {
            return self.in_so_many_steps(); // "I need you twenty metres further east"
        }
        let at = self.eat_any(&["at", "in", "to", "on", "over at", "down at", "up at", "outside"]);
        let side = if at { None } else { Some(Spot::Beside(self.side()?, None)) };
        let to = self.reference(0).map_err(|error| self.missing.get_or_insert(error).clone()).ok()?;
        self.stated = true;
        Some(vec![Clause::Go { to, side, pace: Pace::Usual, within: None }])
    }

    /// "The door nearest to the bin, that's where I want you to go".
    pub(super) fn place_meant(&mut self) -> Option<Vec<Clause>> {
        let end = self.mark_from(self.at);
        if !(end..self.lexemes.len()).any(|at| longest_phrase(&self.lexemes[at..], THAT_IS_WHERE).is_some()) {
            return None;
        }
        let to = self.reference(0).ok()?;
        self.skip_joints();
        if !self.eat_any(THAT_IS_WHERE) {
            return None;
        }
        self.eat_any(YOU_GO);
        let sits = self.peeks("sit") || self.peeks("sitting");
        self.eat_any(&[
            "go", "be", "head", "walk", "wait", "stand", "going", "headed", "heading", "drive", "sit",
            "sitting", "meet",
        ]);
        self.eat_any(&["to", "next", "now", "down"]);
        let clause = if sits {
            Clause::Sit { on: Some(to) }
        } else {
            Clause::Go { to, side: None, pace: Pace::Usual, within: None }
        };
        self.ends_clause().then(|| vec![clause])
    }

    /// Who gets what, or what goes where.
    pub(super) fn somebody_gets(&mut self) -> Option<Vec<Clause>> {
        let start = self.at;
        for rule in [Self::lets_have, Self::gets, Self::goods_are_for, Self::goes, Self::needed_at] {
            if let Some(clauses) = rule(self).filter(|_| self.ends_clause()) {
                return Some(clauses);
            }
            self.at = start;
        }
        None
    }

    /// "Let Hana have it", "see that Hana gets the letter".
    fn lets_have(&mut self) -> Option<Vec<Clause>> {
        if !self.eat_any(&[
            "let",
            "make sure that",
            "make sure",
            "see that",
            "see to it that",
            "ensure that",
            "ensure",
        ]) {
            return None;
        }
        let to = self.somebody_here()?;
        if !self.eat_any(&["have", "gets", "has", "receives", "keep", "hold", "take", "can have"]) {
            return None;
        }
        self.handed(to)
    }

    fn gets(&mut self) -> Option<Vec<Clause>> {
        let start = self.at;
        // "The kids want three kites": who is no part of the scene gets nothing from anybody's hand.
        if self.outsider_before(GETS) {
            self.eat_any(GETS);
            let bare = longest_phrase(self.rest(), &["one", "some", "it", "them"]).unwrap_or(0);
            if bare > 0 && self.names.goods(&self.rest()[bare..]).is_none() {
                return None; // "my neighbour wants one too"
            }
            let goods = self.goods()?;
            let taken_up = self.rest().iter().any(|lexeme| {
                matches!(&lexeme.token, super::lexer::Token::Word(word) if ["one", "it", "them", "some"].contains(&word.as_str()))
            });
            if taken_up && self.ends_at_mark() {
                self.wish_for(goods);
                self.skip_joints();
                return self.statement_here();
            }
            return self.purchase(goods, None).ok();
        }
        self.at = start;
        let to = self.somebody_here()?;
        if !self.eat_any(GETS) {
            return None;
        }
        self.handed(to)
    }

    /// The thing or the goods that somebody gets.
    fn handed(&mut self, to: Reference) -> Option<Vec<Clause>> {
        if let Some(goods) = self.goods() {
            return self.purchase(goods, Some(to)).ok();
        }
        let what = self.reference(0).ok()?;
        Some(vec![Clause::Give { what: Some(what), to }])
    }

    /// "I need the basket at the tearoom".
    fn needed_at(&mut self) -> Option<Vec<Clause>> {
        if !self.eat_any(&[
            "i need",
            "we need",
            "i want",
            "we want",
            "id like",
            "i would like",
            "they need",
            "they want",
            "i need to have",
            "i want to have",
        ]) {
            return None;
        }
        let what = self.reference(0).ok()?;
        let item = self
            .view
            .find(&what, super::resolve::Purpose::Any)
            .is_ok_and(|found| super::resolve::is_item(found.kind));
        let placed = item
            && self.eat_any(&[
                "at",
                "in",
                "by",
                "over at",
                "next to",
                "on",
                "to be at",
                "to be in",
                "delivered to",
                "brought to",
                "taken to",
                "moved to",
                "outside",
            ]);
        let at = if placed { Some(self.reference(0).ok()?) } else { return None };
        Some(vec![Clause::Drop { what: Some(what), at, manner: Manner::Deliver }])
    }

    /// "The book is for Eve, so buy it and give it to her".
    fn goods_are_for(&mut self) -> Option<Vec<Clause>> {
        let goods = self.goods()?;
        if !self.eat_any(&["is for", "are for", "is meant for", "are meant for", "goes to", "go to"]) {
            return None;
        }
        let to = self.somebody_here()?;
        if self.ends_at_mark() && self.orders_what_is_wished() {
            self.wish_for(goods);
            self.skip_joints();
            let mut clauses = vec![Clause::Mention { what: to }];
            clauses.extend(self.statement_here()?);
            return Some(clauses);
        }
        self.purchase(goods, Some(to)).ok()
    }

    /// "The rucksack has to be at Reception, take it over": both say one thing.
    pub(super) fn goes_somewhere(&mut self) -> Option<Vec<Clause>> {
        let clauses = self.goes().filter(|_| self.ends_at_mark())?;
        let end = self.at;
        self.skip_joints();
        let again = self.eat_any(&["take it", "carry it", "bring it", "get it", "deliver it", "put it"]);
        self.eat_any(&["over", "there", "over there", "across", "along"]);
        self.skip_fillers();
        if again && self.at == self.lexemes.len() {
            return Some(clauses);
        }
        self.at = end;
        None
    }

    fn goes(&mut self) -> Option<Vec<Clause>> {
        if super::verbs::longest_verb(self.rest()).is_some() {
            return None;
        }
        let what = self.reference(0).ok()?;
        longest_phrase(self.rest(), GOES)?;
        self.eat_any(GOES);
        let at = Some(self.reference(0).ok()?);
        Some(vec![Clause::Drop { what: Some(what), at, manner: Manner::Deliver }])
    }

    /// "Carol wants a tea, get one": a topic, since what follows takes it up.
    pub(super) fn wants_one(&mut self) -> Option<Vec<Clause>> {
        let is_mark = |lexeme: &Lexeme| matches!(lexeme.token, Token::Comma | Token::Break);
        let after = self.rest().iter().position(is_mark)?;
        let takes_up = self.rest()[after..].iter().any(|lexeme| {
            matches!(&lexeme.token, Token::Word(word) if ["it", "him", "her", "them", "one", "some"].contains(&word.as_str()))
        });
        if takes_up { self.on_topic() } else { None }
    }
}
