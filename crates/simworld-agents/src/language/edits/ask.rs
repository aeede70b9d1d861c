//! Questions about the scene: how many there are, and which.

use simworld_core::seam::PlanError;

use super::super::clause::{Count, Reference};
use super::super::lexer::{Lexeme, Token};
use super::super::lexicon::{longest, longest_phrase};
use super::super::paint::PAINTS;
use super::super::phrases::Phrases;
use super::parse::Reader;
use super::wish::Wish;

/// That something is there, anywhere.
#[rustfmt::skip]
const EXISTENCE: &Phrases = &Phrases::of(&["are there", "is there", "do we have", "are here", "have we got", "exist",
    "do you see", "can you see", "there are", "we have", "do you have", "in the city", "in this city",
    "in the scene", "on this campus", "on the campus", "in this place", "on campus", "in town", "in this town",
    "in the town", "do i have", "are around", "around here", "in the world", "in the harbour",
    "in the whole city", "in total", "altogether", "stand here", "are standing around", "in the old town",
    "here", "in this harbour", "are present", "present", "all in all", "are out there", "can be seen",
    "can i see", "does this place have", "does the campus have", "does the city have", "does the harbour have",
    "does the town have", "this town has", "this city has", "the campus has", "the city has", "the town has",
    "the harbour has", "this campus has", "this harbour has", "this place has", "we have got", "have we",
    "there is", "in this scene", "in my city", "in our city", "do you count", "can you count", "do you find", "are around here", "around", "do we count", "there are in total", "there are altogether", "are there in all", "there are in all", "are there in total", "are there altogether", "in all", "do you make it", "are about"]);

impl Reader<'_> {
    pub(super) fn count(&mut self, end: usize) -> Result<Vec<Vec<Wish>>, PlanError> {
        self.eat_any(&["of"]);
        // "How many cars and trucks are there".
        let stop = self.before_existence(self.at, self.before_politeness(self.at, end));
        let stop = (self.at + 1..stop).find(|at| self.word(*at) == Some("are")).unwrap_or(stop);
        if let Ok(several) = self.things(self.at, stop)
            && several.len() > 1
            && self.existence(stop, end) + stop >= self.before_politeness(self.at, end)
        {
            let text = self.written(self.at, stop);
            self.at = end;
            return Ok(vec![vec![Wish::CountAll { what: several, text }]]);
        }
        let mut what = self.asked_about(self.at, end)?;
        what.count = Count::All;
        self.at = end;
        Ok(vec![vec![Wish::Count { what }]])
    }

    /// "Do we have trees higher than 8 metres? How many?"
    pub(super) fn asked_twice(&mut self, end: usize) -> Option<Wish> {
        let start = self.at + self.polite_at(self.at);
        let begins = longest_phrase(
            &self.lexemes[start..end],
            &["do we have", "are there", "is there", "have we", "do you have", "does it have"],
        )?;
        let ends =
            |at: &usize| longest_phrase(&self.lexemes[*at..end], &["how many", "and how many"]).is_some();
        let cut = (start + begins + 1..end).rev().find(ends)?;
        let said = longest_phrase(&self.lexemes[cut..end], &["how many", "and how many"])?;
        let asks = longest_phrase(&self.lexemes[cut + said..end], &["are there", "are they", "of them"])
            .unwrap_or(0);
        let is_mark = |lexeme: &Lexeme| matches!(lexeme.token, Token::Break | Token::Comma);
        if !self.lexemes[cut + said + asks..end].iter().all(is_mark) {
            return None;
        }
        let stop = (start..cut).rev().find(|at| !is_mark(&self.lexemes[*at]))? + 1;
        let mut what = self.asked_about(start + begins, stop).ok()?;
        what.count = Count::All;
        Some(Wish::Count { what })
    }

    /// What a question is about: all of its words count, also those behind "are there" and "are".
    pub(super) fn asked_about(&self, start: usize, end: usize) -> Result<Reference, PlanError> {
        #[rustfmt::skip]
        const COPULA: &Phrases = &Phrases::of(&["are there", "are", "is there", "is", "stand", "sit", "do we have", "are standing", "there are",
            "exist", "there is", "lie", "grow", "live", "hang", "are growing", "are planted", "are sitting", "are waiting", "are lying", "are parked", "can be found", "are located", "have we got", "are to be found"]);
        let end = self.before_politeness(start, end);
        let cut = (start + 1..end).find(|at| longest_phrase(&self.lexemes[*at..end], COPULA).is_some());
        if let Some(cut) = cut
            && let Ok(what) = self.asked_of(start, cut, end, COPULA)
        {
            return Ok(what);
        }
        let stop = self.before_existence(start, end);
        let said = self.existence(stop, end);
        if stop + said < end {
            return self.asked_of(start, stop, end, COPULA).or_else(|_| self.one_of(start, end));
        }
        self.one_of(start, stop)
    }

    /// "How many trees | are | next to the library": a copula stands between.
    fn asked_of(
        &self,
        start: usize,
        cut: usize,
        end: usize,
        copulas: &Phrases,
    ) -> Result<Reference, PlanError> {
        let mut what = self.one_of(start, cut)?;
        let mut at = cut + longest_phrase(&self.lexemes[cut..end], copulas).unwrap_or(0);
        at += self.existence(at, end);
        if at >= end {
            return Ok(what);
        }
        if let Some((paint, _)) =
            longest(&self.lexemes[at..end], PAINTS).filter(|(_, words)| at + words == end)
        {
            what.traits.paint = Some(paint);
            return Ok(what);
        }
        let mut parser = self.parser(at, end);
        let start = parser.at;
        if parser.likeness_behind(&mut what) && parser.at == end {
            return Ok(what);
        }
        parser.at = start;
        if let Some(than) = parser.comparison() {
            what.traits.than = Some(than);
        } else if what.relation.is_none() {
            what.relation = parser.relation(0)?;
        }
        if parser.at > start && parser.at == end { Ok(what) } else { Err(parser.not_understood("end here")) }
    }

    /// How many words from here say only that something is there.
    fn existence(&self, at: usize, end: usize) -> usize {
        let rest = &self.lexemes[at.min(end)..end];
        let words = longest_phrase(rest, EXISTENCE).unwrap_or(0);
        words
            + longest_phrase(&rest[words..], &["got", "there", "here", "now"])
                .filter(|_| words > 0)
                .unwrap_or(0)
    }

    /// Where "are there", "do we have in this city" and the like begin.
    pub(super) fn before_existence(&self, start: usize, end: usize) -> usize {
        (start + 1..end)
            .find(|at| longest_phrase(&self.lexemes[*at..end], EXISTENCE).is_some())
            .unwrap_or(end)
    }

    /// Whether the verb before asks where something is.
    fn asks_where(&self, start: usize) -> bool {
        (start.saturating_sub(4)..start)
            .any(|at| self.word(at).is_some_and(|word| ["where", "wheres"].contains(&word)))
    }

    pub(super) fn list(&mut self, end: usize) -> Result<Vec<Vec<Wish>>, PlanError> {
        let start = self.at;
        self.eat_any(&[
            "all of",
            "things",
            "the things",
            "everything",
            "all",
            "objects",
            "the objects",
            "are",
            "is",
            "stands",
            "things are",
            "what is",
        ]);
        if self.is_place(self.at)
            && let Ok(at) = self.places(end)
            && self.at == end
        {
            return Ok(vec![vec![Wish::List { what: None, at }]]);
        }
        self.at = start;
        let asked = self.word(start.saturating_sub(1)).unwrap_or_default();
        let mut what = match self.asked_about(start, end) {
            // "What is the capital of France" is no question about the scene.
            Err(PlanError::NotFound { .. })
                if ["is", "whats", "are"].contains(&asked) && !self.asks_where(start) =>
            {
                return Err(self.not_understood("ask what is there: how many, which, where"));
            }
            read => read?,
        };
        self.at = end;
        if (["is", "whats", "wheres"].contains(&asked) || self.asks_where(start))
            && what.count == Count::One
            && !self.is_plural(start, end)
        {
            return Ok(vec![vec![Wish::Describe { what }]]);
        }
        what.count = Count::All;
        Ok(vec![vec![Wish::List { what: Some(what), at: Vec::new() }]])
    }
}
