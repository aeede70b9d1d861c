//! Another place on the way, told behind where the way leads: "via the canteen", "and take the route by way of it", "going to the willow
//! first".

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
    "stopping at",
    "stopping by",
    "calling at",
    "going via",
    "dropping by",
    "looking in at",
]);
const FIRST: &Phrases =
    &Phrases::of(&["first", "first of all", "before that", "beforehand", "before anything else"]);

impl Parser<'_> {
    /// "Via", "and go by way of", "taking the route through": what brings in a place on the way; nothing is passed where it is none.
    pub(super) fn eat_via(&mut self) -> bool {
        let start = self.at;
        self.eat_any(JOINTS);
        let chosen = self.eat_any(TAKING) && self.eat_any(WAYS);
        let via = if chosen {
            self.eat_any(LEADING);
            self.eat_any(BY)
        } else {
            self.eat_any(GOING);
            self.eat_any(VIA)
        };
        if !via {
            self.at = start;
        }
        via
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

    /// The place on the way that is told behind the last order, set before it.
    pub(super) fn by_another_place(&mut self, clauses: &mut Vec<Clause>) -> bool {
        let start = self.at;
        let to = self.going_first().or_else(|| if self.eat_via() { self.reference(0).ok() } else { None });
        let last = clauses.len().checked_sub(1).filter(|last| matches!(clauses[*last], Clause::Go { .. }));
        let (Some(to), Some(last)) = (to, last) else {
            self.at = start;
            return false;
        };
        clauses.insert(last, Clause::Go { to, side: None, pace: Pace::Usual, within: None });
        true
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
