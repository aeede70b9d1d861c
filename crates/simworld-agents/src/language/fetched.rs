//! Things that somebody is to have and that are not handed over yet: "fetch Hana the letter", "fetch me the parcel".

use simworld_core::seam::PlanError;

use super::clause::{Clause, Grip, Reference};
use super::lexicon::{category, longest_phrase};
use super::parser::Parser;

impl Parser<'_> {
    /// "Fetch Gus a newspaper", "fetch Hana the letter".
    pub(super) fn fetched_for(&mut self) -> Result<Option<Vec<Clause>>, PlanError> {
        let start = self.at;
        let Some(whom) = self.somebody_here() else { return Ok(None) };
        let at = self.at;
        if let Some(goods) = self.wished_goods().or_else(|| self.goods()) {
            return self.purchase(goods, Some(whom)).map(Some);
        }
        self.at = at;
        let named = !self.ends_clause()
            && (longest_phrase(self.rest(), &["the", "a", "that", "his", "her", "my"]).is_some()
                || category(self.rest()).is_some());
        if named && let Ok(what) = self.reference(0) {
            return Ok(Some(vec![Clause::Give { what: Some(what), to: whom }]));
        }
        self.at = start;
        Ok(None)
    }

    /// "Fetch me the parcel", where nobody sells such a thing: it is fetched.
    pub(super) fn fetched_rather(&mut self, start: usize) -> Option<Vec<Clause>> {
        let here = self.at;
        let before = start.checked_sub(2)?;
        longest_phrase(&self.lexemes[before..start], &["fetch me", "fetch us", "grab me", "grab us"])?;
        self.at = start;
        let what = self.reference(0).ok().filter(|what| self.ends_clause() && !self.is_somebody(what));
        if what.is_none() {
            self.at = here;
        }
        what.map(|what| vec![Clause::Take { what, to: None, grip: Grip::Lift }])
    }

    /// Who is given something, with what leads to it: "present Anna with a rose".
    pub(super) fn somebody_presented(&mut self) -> Option<Reference> {
        let somebody = self.somebody_here();
        self.at += usize::from(somebody.is_some() && self.peeks("with"));
        somebody
    }
}
