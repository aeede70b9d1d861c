//! Questions about the scene: how many there are, and which.

use simworld_core::seam::PlanError;

use super::super::clause::Count;
use super::super::lexicon::{longest, longest_phrase};
use super::super::paint::PAINTS;
use super::parse::Reader;
use super::wish::Wish;

impl Reader<'_> {
    pub(super) fn count(&mut self, end: usize) -> Result<Vec<Vec<Wish>>, PlanError> {
        self.eat_any(&["of"]);
        let start = self.at;
        let stop = self.before_existence(start, end);
        let copula = (start + 1..end).any(|at| {
            longest_phrase(&self.lexemes[at..end], &["are", "is"])
                .is_some_and(|count| longest(&self.lexemes[at + count..end], PAINTS).is_some())
        });
        let whole = self.one_of(start, stop);
        let mut what = match whole {
            Ok(what) if !copula => what,
            whole => {
                let error = whole.err().unwrap_or_else(|| self.not_understood("say what to count"));
                // "How many trees are next to the library": the copula stands between.
                let cut = (start + 1..end).find(|at| {
                    longest_phrase(&self.lexemes[*at..end], &["are", "is", "stand", "sit", "do we have"])
                        .is_some()
                });
                let Some(cut) = cut else { return Err(error) };
                let mut what = self.one_of(start, cut)?;
                self.at = cut;
                what.count = Count::All;
                self.eat_any(&[
                    "are there",
                    "are",
                    "is there",
                    "is",
                    "stand",
                    "sit",
                    "do we have",
                    "are standing",
                ]);
                match longest(self.rest(end), PAINTS) {
                    Some((paint, _)) => what.traits.paint = Some(paint),
                    None => what.relation = self.parser(self.at, stop).relation(0)?,
                }
                what
            }
        };
        what.count = Count::All;
        self.at = end;
        Ok(vec![vec![Wish::Count { what }]])
    }

    /// Where "are there", "do we have in this city" and the like begin.
    pub(super) fn before_existence(&self, start: usize, end: usize) -> usize {
        #[rustfmt::skip]
    const EXISTENCE: &[&str] = &["are there", "is there", "do we have", "are here", "have we got", "exist",
        "do you see", "can you see", "are in", "there are", "we have", "do you have", "in the city", "in this city",
        "in the scene", "on this campus", "on the campus", "in this place", "on campus", "in town", "in this town",
        "in the town", "do i have", "are around", "around here", "in the world", "in the harbour",
        "in the whole city", "in total", "altogether", "stand here", "are standing around", "in the old town",
        "here", "in this harbour", "are present", "present", "all in all", "are out there", "can be seen",
        "can i see", "does this place have", "does the campus have", "does the city have", "does the harbour have",
        "does the town have", "this town has", "this city has", "the campus has", "the city has", "the town has",
        "the harbour has", "this campus has", "this harbour has", "this place has", "we have got", "have we",
        "there is", "in this scene", "in my city", "in our city"];
        (start + 1..end)
            .find(|at| longest_phrase(&self.lexemes[*at..end], EXISTENCE).is_some())
            .unwrap_or(end)
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
        let stop = self.before_existence(start, end);
        let asked = self.word(start.saturating_sub(1)).unwrap_or_default();
        let mut what = self.one_of(start, stop)?;
        self.at = end;
        if ["is", "whats", "wheres"].contains(&asked)
            && what.count == Count::One
            && !self.is_plural(start, stop)
        {
            return Ok(vec![vec![Wish::Describe { what }]]);
        }
        what.count = Count::All;
        Ok(vec![vec![Wish::List { what: Some(what), at: Vec::new() }]])
    }
}
