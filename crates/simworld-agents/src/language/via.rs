//! Another place on the way, told behind where the way leads: "via the canteen", "and take the route by way of it", "going to the willow
//! first".

use simworld_core::seam::PlanError;

use super::clause::{Clause, Pace, Reference};
use super::parser::Parser;
use super::phrases::Phrases;

/// Before how one goes.
const JOINTS: &Phrases =
    &Phrases::of(&["and", "but", "only", "but only", "and only", "and please", "but please"]);
/// Going, before the place that one comes by.
const GOING: &Phrases = &Phrases::of(&[
    "go",
    "going",
    "by going",
    "walk",
    "walking",
    "by walking",
    "travel",
    "travelling",
    "traveling",
    "do it",
    "do so",
    "get there",
    "getting there",
    "head there",
    "heading",
    "head",
    "drive",
    "driving",
    "run",
    "running",
    "go there",
    "walk there",
    "come",
    "coming",
]);
/// Choosing a way, before what is said of it.
const TAKING: &Phrases = &Phrases::of(&[
    "take",
    "taking",
    "by taking",
    "use",
    "using",
    "choose",
    "choosing",
    "pick",
    "follow",
    "following",
]);
const WAYS: &Phrases = &Phrases::of(&[
    "the route",
    "the way",
    "the road",
    "the path",
    "a route",
    "the long way",
    "the longer way",
    "the scenic route",
    "the long way round",
    "the one",
]);
const LEADING: &Phrases = &Phrases::of(&[
    "that goes",
    "that leads",
    "which goes",
    "which leads",
    "going",
    "leading",
    "that runs",
    "that takes you",
]);
const VIA: &Phrases = &Phrases::of(&["via", "by way of"]);
/// What a way that was chosen leads by.
const BY: &Phrases = &Phrases::of(&["via", "by way of", "by", "past", "through", "along", "over"]);
/// Going to a place that comes before another.
const TO: &Phrases = &Phrases::of(&[
    "going to",
    "going by",
    "going past",
    "going over to",
    "heading to",
    "heading for",
    "walking to",
    "passing",
    "visiting",
    "calling at",
    "dropping by",
    "looking in at",
]);
const FIRST: &Phrases =
    &Phrases::of(&["first", "first of all", "before that", "beforehand", "before anything else"]);
/// Stopping at a place on the way.
const STOPS: &Phrases = &Phrases::of(&[
    "but pass by",
    "stopping at",
    "stopping off at",
    "with a stop at",
    "stopping by",
    "calling at",
    "with a stopover at",
    "but stop at the",
    "but stop off at",
]);
/// Behind such a place.
const ON_IT: &Phrases =
    &Phrases::of(&["on the way", "along the way", "on your way", "first", "en route", "on the way there"]);

impl Parser<'_> {
    /// "Via", "and go by way of", "taking the route through": what brings in a place on the way; nothing is passed where it is none.
    pub(super) fn eat_via(&mut self) -> bool {
        let start = self.at;
        self.eat_any(JOINTS);
        let via = if self.eat_any(TAKING) {
            let is_way = self.eat_any(WAYS);
            self.eat_any(LEADING);
            is_way && self.eat_any(BY)
        } else {
            self.eat_any(GOING);
            self.eat_any(VIA)
        };
        if !via {
            self.at = start;
        }
        via
    }

    /// "The route via the hydrant and the sign to the bus stop", behind a verb: the places on the way are told first.
    pub(super) fn way_by_places(&mut self) -> Option<Vec<Clause>> {
        let start = self.at;
        let ways = self.places_to_the_end();
        if ways.is_none() {
            self.at = start;
        }
        ways
    }

    fn places_to_the_end(&mut self) -> Option<Vec<Clause>> {
        /// Before where the way leads.
        const ON: &Phrases = &Phrases::of(&[
            "to",
            "over to",
            "on to",
            "and on to",
            "and then to",
            "then to",
            "and to",
            "up to",
            "down to",
        ]);
        // "Take the path past the statue" is a verb with its way.
        let is_way = self.eat_any(WAYS) || matches!(self.word_before(), "path" | "road" | "way" | "route");
        self.eat_any(LEADING);
        if !is_way || !self.eat_any(BY) {
            return None;
        }
        let mut places = vec![self.reference(0).ok()?];
        loop {
            let listed = matches!(self.mark(), Some(','));
            self.at += usize::from(listed);
            let leads_on = self.eat_any(ON);
            if !leads_on && !self.eat_any(&["and", "and then", "then", "and via", "via"]) && !listed {
                return None;
            }
            places.push(self.reference(0).ok()?);
            if leads_on {
                break;
            }
        }
        let go = |to| Clause::Go { to, side: None, pace: Pace::Usual, within: None };
        self.ends_clause().then(|| places.into_iter().map(go).collect())
    }

    /// "Going to the willow first".
    pub(super) fn going_first(&mut self) -> Option<Reference> {
        let start = self.at;
        let to = if self.eat_any(TO) { self.reference(0).ok() } else { None };
        let first = to.filter(|_| self.eat_any(FIRST) && self.ends_clause());
        if first.is_none() {
            self.at = start;
        }
        first
    }

    /// "But stop at the kiosk", before the place; its article belongs to it.
    fn eat_stop(&mut self) -> bool {
        let stops = self.eat_any(STOPS);
        self.at -= usize::from(stops && self.word_before() == "the");
        stops
    }

    /// The place on the way that is told behind the last order, set before it.
    pub(super) fn by_another_place(&mut self, clauses: &mut Vec<Clause>) -> Result<bool, PlanError> {
        let to = match self.going_first() {
            Some(to) => to,
            None if self.eat_via() || self.eat_stop() => {
                let to = self.reference(0)?;
                self.eat_any(ON_IT);
                to
            }
            None => return Ok(false),
        };
        let last = clauses.len().saturating_sub(1);
        clauses.insert(last, Clause::Go { to, side: None, pace: Pace::Usual, within: None });
        Ok(true)
    }

    /// Whether that follows a comma.
    pub(super) fn another_place_follows(&mut self) -> bool {
        let start = self.at;
        self.at += 1;
        let follows = self.going_first().is_some() || self.eat_via();
        self.at = start;
        follows
    }
}
