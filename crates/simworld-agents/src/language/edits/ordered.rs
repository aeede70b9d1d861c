//! Orders whose verb says one thing of what is there and another of what is not: "put a bench", "put the bench", "show me the
//! shops", "bring me the cone".

use simworld_core::passage::Passage;
use simworld_core::seam::PlanError;

use super::super::lexicon::{longest, longest_phrase};
use super::super::phrases::Phrases;
use super::parse::Reader;
use super::wish::{StreetRef, Where, Wish};
use super::words::{VERBS, Verb};

/// Behind what somebody does not like as it is.
#[rustfmt::skip]
pub(super) const WHERE_IT_IS: &Phrases = &Phrases::of(&["where it is", "where it stands", "where it is now", "where he is", "where she is", "where they are", "where they stand", "the way it is", "the way it looks", "the way it stands", "as it is", "like that", "like this", "in this place",
    "in that place", "in that spot", "in this spot", "over there", "in that colour", "in this colour"]);

impl Reader<'_> {
    /// Behind a verb of moving: what is there goes, and with a verb of bringing comes what is new.
    pub(super) fn brings(&mut self, end: usize) -> Result<Vec<Vec<Wish>>, PlanError> {
        // "Bring us the van to the postbox".
        let for_me = matches!(self.word(self.at), Some("me" | "us"))
            && self.is_definite(self.at + 1)
            && (self.at + 2..end).any(|at| self.is_place(at));
        self.at += usize::from(for_me);
        if !self.is_definite(self.at)
            && matches!(self.word(self.at - 1), Some("bring" | "send" | "ship" | "ferry"))
            || self.brings_new(end)
        {
            return self.additions(end);
        }
        self.moves(end).map(|wish| vec![wish])
    }

    /// "Wheel a hand cart next to the bin", "heave in a hay bale": what is not here and could be is brought in.
    fn brings_new(&mut self, end: usize) -> bool {
        #[rustfmt::skip]
        const BRINGING: &[&str] = &["heave", "lug", "haul", "wheel", "roll", "drag", "push", "pull", "carry", "cart", "drive", "slide", "trundle", "convey", "tow", "walk", "lead", "shove", "usher", "escort", "steer", "bring", "swing", "hop"];
        if !self.word(self.at - 1).is_some_and(|word| BRINGING.contains(&word)) {
            return false;
        }
        let particle = usize::from(matches!(
            self.word(self.at),
            Some("in" | "over" | "along" | "up" | "out" | "on" | "down")
        ));
        let at = self.at + particle;
        let Some(article) = longest_phrase(
            &self.lexemes[at..end],
            &["a", "an", "some", "two", "three", "four", "five", "six", "another"],
        ) else {
            return false;
        };
        let is_there = (at + article + 1..end)
            .any(|cut| self.is_place(cut) && self.one_of(at, cut).is_ok_and(|what| self.how_many(&what) > 0));
        let is_asset = (at + article..end.min(at + article + 3))
            .any(|noun| self.names.asset_words(&self.lexemes[noun..end]).is_some());
        let is_new = is_asset && !is_there;
        if is_new {
            self.at = at;
        }
        is_new
    }

    /// "I want a bench", and what else is asked for in such words: a list, what is to come here, a copy, how a thing should be.
    pub(super) fn adds(&mut self, end: usize) -> Result<Vec<Vec<Wish>>, PlanError> {
        // "Show me the shops" asks for a list.
        if self.is_shown() {
            return self.list(end);
        }
        // "Bring us the van to the postbox".
        let goes_to = |at: usize| self.word(at) == Some("to") && self.is_place(at);
        let is_for_us = matches!(self.word(self.at - 1), Some("me" | "us")) && self.is_definite(self.at);
        if is_for_us && (self.at + 2..end).any(goes_to) {
            return self.moves(end).map(|wish| vec![wish]);
        }
        if self.is_brought(end) {
            let what = self.things(self.at, end)?;
            self.at = end;
            return Ok(vec![vec![Wish::Move { what, at: vec![Where::Here] }]]);
        }
        if let Some(wish) = self.copies(end) {
            return Ok(wish);
        }
        if self.is_wanted()
            && let Some(wish) = self.small_clause(self.at, end)
        {
            self.at = end;
            return Ok(wish);
        }
        match self.posed(end).filter(|_| self.is_definite(self.at)) {
            Some(wish) => Ok(vec![vec![wish]]),
            None => self.additions(end),
        }
    }

    /// "Put a bench ...", "put the bench ...", "scatter some benches ...".
    pub(super) fn put(&mut self, end: usize) -> Result<Vec<Vec<Wish>>, PlanError> {
        if self.is_for_me(end) || self.is_bare_plural(self.at, end) {
            return self.additions(end);
        }
        if self.is_definite(self.at) {
            return self.puts(end);
        }
        let spreads = (self.at.saturating_sub(2)..self.at).any(|at| {
            matches!(self.word(at), Some("dot" | "scatter" | "sprinkle" | "strew" | "spread" | "distribute"))
        });
        let mut wishes = self.additions(end)?;
        if spreads {
            wishes.iter_mut().flatten().for_each(|wish| self.spread(wish));
        }
        Ok(wishes)
    }

    /// "Close the door": a thing, which is no street.
    pub(super) fn closes(&mut self, verb: Verb, end: usize) -> Result<Vec<Vec<Wish>>, PlanError> {
        if self.one_of(self.at, end).is_err() {
            return Err(self.not_understood("say which street: by its name, or in front of what"));
        }
        let which = vec![StreetRef::Thing(self.one_to(end)?)];
        let passage = if verb == Verb::Open { Passage::Open } else { Passage::Closed };
        Ok(vec![vec![Wish::Passage { which, passage }]])
    }

    pub(super) fn is_shown(&self) -> bool {
        self.at > 1
            && self.word(self.at - 2) == Some("show")
            && matches!(self.word(self.at - 1), Some("me" | "us"))
            && matches!(self.word(self.at), Some("the" | "all" | "every" | "which" | "what" | "where"))
    }

    /// "Put the bench there"; "my castle" need not be there yet.
    pub(super) fn puts(&mut self, end: usize) -> Result<Vec<Vec<Wish>>, PlanError> {
        let from = self.at;
        match self.moves(end) {
            // "Put books on the bench": what is not there, and is spoken of without an article.
            Err(refused @ PlanError::NotFound { .. }) if !self.is_certain(from) => {
                self.at = from;
                self.additions(end).map_err(|_| refused)
            }
            Err(refused) if longest_phrase(&self.lexemes[from..end], &["my", "our"]).is_some() => {
                self.at = from + 1;
                self.additions(end).map_err(|_| refused)
            }
            read => read.map(|wish| vec![wish]),
        }
    }

    /// "Remove the cone"; "I don't want to see that cone here".
    pub(super) fn removes(&mut self, end: usize) -> Result<Vec<Vec<Wish>>, PlanError> {
        let here = self.before_politeness(self.at, end).saturating_sub(1);
        let is_here = here > self.at && matches!(self.word(here), Some("here" | "around" | "standing"));
        let what = match if is_here { self.things(self.at, here).ok() } else { None } {
            Some(what) => what,
            None => self.things(self.at, end)?,
        };
        // "I don't like this hydrant where it is" leaves open what is to be done.
        if longest_phrase(&self.lexemes[self.at..end], &["where"]).is_some()
            || (self.at..end).any(|at| longest_phrase(&self.lexemes[at..end], WHERE_IT_IS) == Some(end - at))
        {
            return Err(self.not_understood("say what is to become of it"));
        }
        let clears = matches!(self.word(self.at.wrapping_sub(1)), Some("clear" | "empty"));
        let what = if clears { what.into_iter().map(super::others::on_it).collect() } else { what };
        self.at = end;
        Ok(vec![vec![Wish::Remove { what }]])
    }

    /// "I want the bench red": something is wanted of a thing that is there.
    pub(super) fn is_wanted(&self) -> bool {
        #[rustfmt::skip]
        const WHO: &[&str] = &["i", "we", "id", "wed", "have", "let", "lets", "can", "could", "may", "need", "needs"];
        let is_who = |at: usize| self.word(at).is_some_and(|word| WHO.contains(&word));
        (self.at.saturating_sub(6)..self.at).any(is_who)
            && self.is_definite(self.at)
            && !self.is_bare_plural(self.at, self.lexemes.len())
    }

    /// "Bring me the cone": what is there comes here.
    pub(super) fn is_brought(&self, end: usize) -> bool {
        let brings = self.at > 1
            && matches!(self.word(self.at - 1), Some("me" | "us"))
            && matches!(self.word(self.at - 2), Some("bring" | "fetch" | "get" | "hand" | "pass"));
        brings
            && longest_phrase(self.rest(end), &["the", "that", "this", "my", "those", "these"]).is_some()
            && self.things(self.at, end).is_ok()
    }

    /// "Put me a bench": whoever says so is not put anywhere.
    pub(super) fn is_for_me(&self, end: usize) -> bool {
        longest_phrase(self.rest(end), &["me", "us"])
            .is_some_and(|words| !self.is_definite((self.at + words).min(end)))
    }

    /// "Benches": some that are not there yet.
    pub(super) fn is_bare_plural(&self, at: usize, end: usize) -> bool {
        // "Park lanterns" are lanterns, and no park.
        let lasts_in_s = |words: usize| self.word(at + words - 1).is_some_and(|word| word.ends_with('s'));
        let asset =
            self.names.asset_words(&self.lexemes[at..end]).filter(|words| *words > 1 && lasts_in_s(*words));
        if asset
            .is_some_and(|words| at + words >= end || self.is_joint(at + words) || self.is_place(at + words))
        {
            return true;
        }
        // "Cherry trees": up to three words say of what kind they are.
        let ends = |at: usize| {
            self.is_joint(at) || self.is_place(at) || longest(&self.lexemes[at..end], &VERBS).is_some()
        };
        let noun = (at..end.min(at + 4)).take_while(|next| *next == at || !ends(*next)).find_map(|next| {
            super::super::lexicon::category(&self.lexemes[next..end]).map(|(_, words)| (next, words))
        });
        // "Throw the bins out" holds an order, and certain things.
        let is_new = |next: usize| {
            (at..next).all(|at| !self.is_certain(at))
                && (next == at || longest(&self.lexemes[at..end], &VERBS).is_none())
        };
        noun.is_some_and(|(next, words)| is_new(next) && self.is_plural(next, next + words))
            && !self.is_certain(at)
    }
}
