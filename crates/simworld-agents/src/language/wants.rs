//! Orders as statements of who gets what, and where it goes: "Hana needs the letter", "the parcel goes to the museum".

use super::clause::{Clause, Manner, Reference};
use super::lexicon::longest_phrase;
use super::parser::Parser;

/// Between somebody and what he is to get.
#[rustfmt::skip]
const GETS: &[&str] = &[
    "needs", "should get", "should have", "is to get", "must get", "ought to get", "ought to have", "must have",
    "has to get", "has to have", "gets", "is to have", "is waiting for", "wants", "would like", "would love",
    "could do with", "asked for", "has asked for", "is asking for", "deserves", "fancies", "is supposed to get",
    "is after", "will want", "is dying for", "is hoping for", "expects", "ordered", "has ordered",
];
/// Between a thing and where or to whom it goes.
#[rustfmt::skip]
const GOES: &[&str] = &[
    "should go to", "goes to", "belongs to", "has to go to", "must go to", "needs to go to", "is for",
    "is to go to", "ought to go to", "belongs at", "belongs in", "should go in", "goes in", "should end up at",
    "should end up with", "needs to get to", "has to get to", "must get to", "should get to", "needs to be at",
    "must be at", "should be at", "goes back to", "belongs by", "goes next to", "should go next to", "goes by",
    "goes over to", "should go over to", "needs to be with", "is meant for", "should be with",
];

impl Parser<'_> {
    /// Who gets what, or what goes where.
    pub(super) fn somebody_gets(&mut self) -> Option<Vec<Clause>> {
        let start = self.at;
        for rule in [Self::lets_have, Self::gets, Self::goes] {
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
}
