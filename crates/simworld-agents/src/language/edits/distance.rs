//! How far it is from one thing to another: "how far is it from me to the museum?", "what is the distance between the oak and the pine?", "how far apart are
//! Anna and Ben?". It is answered and changes nothing.

use simworld_core::id::EntityId;
use simworld_core::seam::PlanError;

use super::super::clause::{Reference, Target};
use super::super::lexer::is_mark;
use super::super::lexicon::longest_phrase;
use super::super::phrases::Phrases;
use super::parse::Reader;
use super::resolve::Finder;
use super::says::is_it;
use super::wish::Wish;
use crate::editing::{Edit, EditError, called};

/// Before "from the oak to the pine", "between the two", "to the oak".
#[rustfmt::skip]
const ASKS: &Phrases = &Phrases::of(&["how far is it", "how far away is it", "how far off is it", "how far would it be", "how far might it be", "how far do you make it", "how far do i have to go", "how far do i have to walk", "how far must i walk", "how far must i go", "how far have i to go", "how far have i got to walk", "how far does one have to walk", "how far do we have to walk", "how far",
    "how many metres is it", "how many meters is it", "how many metres are there", "how many meters are there", "how many metres", "how many meters", "how many metres is the way", "how long is the way", "how long is the walk", "how long is the distance", "how long is the path", "how long a walk is it", "what is the distance", "whats the distance", "which distance is there", "what distance is it", "what distance is there", "how big is the distance", "how large is the distance", "how great is the distance", "how big is the gap", "how wide is the gap", "how large is the gap", "what is the gap", "whats the gap", "how much space is there", "how much distance is there", "how much room is there",
    "tell me the distance", "give me the distance", "measure the distance", "measure the gap", "tell me how far it is", "do you know how far it is", "can you tell me how far it is", "could you tell me how far it is", "i want to know how far it is", "id like to know how far it is", "how far it is"]);
/// Before a thing, behind which stands from what it is so far.
#[rustfmt::skip]
const STANDS: &Phrases = &Phrases::of(&["how far is", "how far are", "how far away is", "how far away are", "how far off is", "how far does", "how close is", "how close are", "how near is", "how near are", "how many metres is", "how many meters is", "how many metres away is", "how many meters away is", "how distant is", "how far apart are", "how far apart is", "how far away from each other are", "how far from each other are", "how close together are"]);
/// Before a thing alone, which is so far from who speaks.
const FAR: &Phrases = &Phrases::of(&["how far is", "how far away is", "how far off is", "how distant is"]);
/// Between a thing and from what it is so far.
#[rustfmt::skip]
const FROM: &Phrases = &Phrases::of(&["from", "away from", "off from", "to", "distant from", "far from", "stand from", "stand away from", "lie from", "removed from"]);
/// Of two things that are named before it.
#[rustfmt::skip]
const APART: &Phrases = &Phrases::of(&["apart", "from each other", "from one another", "away from each other", "apart from each other", "to each other", "away from one another"]);
/// Behind the question, and says nothing of it.
#[rustfmt::skip]
const TAILS: &Phrases = &Phrases::of(&["roughly", "approximately", "about", "exactly", "precisely", "in metres", "in meters", "as the crow flies", "would you say", "do you think", "do you reckon", "then", "on foot", "by foot", "walking", "give or take", "more or less", "in a straight line", "at the moment", "now", "please", "away"]);
/// Where who speaks is.
#[rustfmt::skip]
const ME: &Phrases = &Phrases::of(&["me", "myself", "here", "us", "where i am", "where i stand", "where im standing", "where i am standing", "where i am now", "where we are", "my position", "my place", "my spot", "you", "where you are"]);

impl Reader<'_> {
    /// How far one thing is from another, if that is asked.
    ///
    /// # Errors
    /// What is asked about is not there.
    pub(super) fn asks_distance(&self, start: usize, end: usize) -> Result<Option<Wish>, PlanError> {
        let end = self.before_tails(start, end);
        let words = &self.lexemes[start..end];
        let way = longest_phrase(words, ASKS).map_or(Ok(None), |asks| self.way_asked(start + asks, end))?;
        let stand = || {
            let stands = longest_phrase(words, STANDS)?;
            self.stand_asked(start + stands, end)
        };
        let asked = match way.or_else(stand) {
            None => self.alone_asked(start, end)?,
            asked => asked,
        };
        Ok(asked.map(|(one, other)| Wish::AskDistance { one, other }))
    }

    /// "How far is the oak?": from who speaks.
    fn alone_asked(&self, start: usize, end: usize) -> Result<Option<(Reference, Reference)>, PlanError> {
        let far = longest_phrase(&self.lexemes[start..end], FAR).map(|words| start + words);
        let Some(from) = far.filter(|from| self.is_certain(*from)) else { return Ok(None) };
        match self.place_asked(from, end) {
            Ok(what) => Ok(Some((what, me()))),
            Err(missing @ PlanError::NotFound { .. }) => Err(missing),
            Err(_) => Ok(None),
        }
    }

    /// Without "roughly" and the like.
    fn before_tails(&self, start: usize, mut end: usize) -> usize {
        loop {
            let tail =
                (start + 1..end).find(|at| longest_phrase(&self.lexemes[*at..end], TAILS) == Some(end - at));
            let marked =
                tail.or_else(|| (end > start + 1 && is_mark(&self.lexemes[end - 1])).then(|| end - 1));
            match marked {
                Some(cut) => end = cut,
                None => return end,
            }
        }
    }

    /// "From the oak to the pine", "between the two", "to the oak".
    fn way_asked(&self, at: usize, end: usize) -> Result<Option<(Reference, Reference)>, PlanError> {
        match self.word(at) {
            Some("from") => self.two_parted_by(&["to", "till", "until"], at + 1, end),
            Some("between") => self.two_parted_by(&["and"], at + 1, end),
            Some("to") if at + 1 < end => match self.two_parted_by(&["from"], at + 1, end)? {
                None => match self.place_asked(at + 1, end) {
                    Ok(what) => Ok(Some((what, me()))),
                    Err(missing @ PlanError::NotFound { .. }) => Err(missing),
                    Err(_) => Ok(None),
                },
                two => Ok(two),
            },
            _ => Ok(None),
        }
    }

    /// Two things, the first of which ends before one of these words.
    fn two_parted_by(
        &self,
        words: &[&str],
        from: usize,
        end: usize,
    ) -> Result<Option<(Reference, Reference)>, PlanError> {
        let mut missing = None;
        for cut in from + 1..end.saturating_sub(1) {
            if !self.word(cut).is_some_and(|word| words.contains(&word)) {
                continue;
            }
            match (self.place_asked(from, cut), self.place_asked(cut + 1, end)) {
                (Ok(one), Ok(other)) => return Ok(Some((one, other))),
                (Err(error @ PlanError::NotFound { .. }), _)
                | (_, Err(error @ PlanError::NotFound { .. })) => missing = Some(error),
                _ => {}
            }
        }
        missing.map_or(Ok(None), Err)
    }

    /// "The oak from the pine", "Anna and Ben", behind which "apart" may stand.
    fn stand_asked(&self, at: usize, end: usize) -> Option<(Reference, Reference)> {
        let from = (at + 1..end).find_map(|cut| Some((cut, longest_phrase(&self.lexemes[cut..end], FROM)?)));
        let apart =
            (at + 1..end).find(|cut| longest_phrase(&self.lexemes[*cut..end], APART) == Some(end - cut));
        if let Some((cut, words)) = from.filter(|_| apart.is_none()) {
            let one = self.place_asked(at, cut).ok()?;
            return Some((one, self.place_asked(cut + words, end).ok()?));
        }
        let end = apart.unwrap_or(end);
        let cut = (at + 1..end).find(|cut| self.word(*cut) == Some("and"))?;
        Some((self.place_asked(at, cut).ok()?, self.place_asked(cut + 1, end).ok()?))
    }

    /// One thing, or who speaks.
    fn place_asked(&self, from: usize, end: usize) -> Result<Reference, PlanError> {
        let words = self.lexemes.get(from..end).unwrap_or_default();
        if longest_phrase(words, ME) == Some(words.len()) {
            return Ok(me());
        }
        let what = self.one_of(from, end)?;
        if is_it(&what) { Err(self.not_understood("say how far from what to what")) } else { Ok(what) }
    }
}

fn me() -> Reference {
    Reference::to(Target::Here, "me".to_owned())
}

impl Finder<'_> {
    /// How far one thing is from another: between the edges of both.
    ///
    /// # Errors
    /// One of them is not there, or several fit.
    pub(super) fn distance_told(&self, one: &Reference, other: &Reference) -> Result<Edit, EditError> {
        let of = |what: &Reference| match &what.target {
            Target::Here => Ok(None),
            _ => self.one(what).map(Some),
        };
        let (one, other) = (of(one)?, of(other)?);
        let (first, second) = (self.told_as(one), self.told_as(other));
        let distance = self.gap_between(one, other);
        let told = if distance < 10.0 { format!("{distance:.1} m") } else { format!("{distance:.0} m") };
        Ok(Edit::Leave { why: format!("it is {told} from {first} to {second}") })
    }

    /// What it is called; who speaks is "you".
    fn told_as(&self, thing: Option<EntityId>) -> String {
        let entity = thing.and_then(|id| self.scene.entity(id));
        entity.map_or_else(
            || "you".to_owned(),
            |entity| format!("{} ({})", called(self.scene, &entity), entity.id),
        )
    }

    /// Between the edges of two things, m; who speaks is a point.
    fn gap_between(&self, one: Option<EntityId>, other: Option<EntityId>) -> f64 {
        let found = |thing: Option<EntityId>| thing.and_then(|id| self.scene.entity(id));
        match (found(one), found(other)) {
            (Some(one), Some(other)) => {
                let first = one.info.shape.obb(one.pose).rectangle();
                first.gap(&other.info.shape.obb(other.pose).rectangle())
            }
            (Some(thing), None) | (None, Some(thing)) => {
                thing.info.shape.planar_distance(thing.pose, &self.focus.from)
            }
            (None, None) => 0.0,
        }
    }
}
