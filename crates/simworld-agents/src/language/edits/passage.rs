//! Closing and opening streets: "close the road in front of the museum", "nobody should be able to drive down Station Road",
//! "Mill Lane should be open again".

use simworld_core::passage::Passage;
use simworld_core::scene::Relation;

use super::super::lexer::Token;
use super::super::lexicon::{longest, longest_phrase};
use super::super::phrases::Phrases;
use super::parse::{Reader, joint};
use super::wish::{Anchor, StreetRef, Wish};
use super::words::{CLOSING, OPENING, WAYS, Way};

/// That a street is closed, or to be.
#[rustfmt::skip]
const CLOSED: &Phrases = &Phrases::of(&["a no go", "no go", "a no go area", "a no go zone", "closed", "blocked", "shut", "barred", "sealed off", "car free", "carfree", "free of cars",
    "free of traffic", "traffic free", "off limits", "no more cars", "no cars", "no traffic", "no more traffic",
    "no vehicles", "no car", "nobody should be able to drive", "nobody may drive", "nobody drives", "no one may drive",
    "nobody should drive", "cars should not drive", "cars must not drive", "cars may not use", "cars cannot use",
    "without cars", "without traffic", "pedestrians only", "impassable", "nobody is to drive", "no cars allowed", "have no business", "has no business", "pedestrian only", "for pedestrians only", "a pedestrian zone", "pedestrian zone", "into a pedestrian zone",
    "pedestrianised", "pedestrianized", "a car free zone", "car free zone", "a no go zone", "no go zone", "nobody should drive", "nobody is allowed to drive", "no driving", "not for cars", "only for pedestrians", "for walkers only", "walkers only",
    "foot traffic only", "pedestrians and bikes only", "a dead end for cars", "no through traffic", "out of bounds", "off limits to cars", "cars are banned", "ban on cars", "stay off", "stay out of", "stay away from", "keep off", "a play street",
    "a walking street", "no longer be open", "no longer open", "must not be used", "may not be used", "cannot be used", "cant be used", "nobody should use", "cars should stay off", "traffic should stay off"]);
/// That a street is open, or to be.
#[rustfmt::skip]
const OPEN: &Phrases = &Phrases::of(&["open", "reopened", "opened", "unblocked", "passable", "back in use", "traffic may use",
    "cars may use", "traffic can use", "cars can use", "traffic is allowed", "cars are allowed", "cars may drive",
    "let the cars back", "let cars back", "let traffic back", "let the traffic back", "cars can drive", "usable",
    "traffic may return", "cars may return", "opened up", "let the cars back in", "let cars back in", "let traffic back in", "let the traffic back in", "shut long enough", "closed long enough", "blocked long enough", "shut for long enough", "closed for long enough", "shut for too long", "closed for too long", "free for traffic", "free for the traffic", "free to traffic", "free for cars", "free again", "free for all", "can be used", "may be used", "can be driven", "drivable", "back to normal", "flow again", "flowing again", "give back to traffic", "give back to cars", "for everyone again"]);
/// For whom a street is closed or open, before it is said from where to where.
#[rustfmt::skip]
const TRAFFIC: &Phrases = &Phrases::of(&["to traffic", "to all traffic", "to through traffic", "to the traffic", "to cars", "to all cars", "to vehicles", "to all vehicles", "to motor traffic", "to motor vehicles", "to motorists", "to drivers",
    "for traffic", "for all traffic", "for through traffic", "for the traffic", "for cars", "for all cars", "for vehicles", "for all vehicles", "for drivers", "completely", "entirely", "off", "down", "up", "again", "again to traffic", "again for traffic", "to traffic again",
    "for traffic again", "to cars again", "for cars again", "only", "just", "in both directions", "both ways"]);
/// A piece of a street that is told by how it is: only such a one can be opened, or closed.
#[rustfmt::skip]
const PIECE_THAT_IS: &Phrases = &Phrases::of(&["closed stretch", "closed piece", "closed end", "closed portion", "closed off part", "closed off half", "closed off bit", "closed off section", "closed off stretch", "closed off end",
    "blocked half", "blocked part", "blocked bit", "blocked section", "blocked stretch", "blocked piece", "blocked end", "blocked portion", "blocked off half", "blocked off part", "blocked off bit", "blocked off section", "blocked off stretch", "blocked off end",
    "shut half", "shut part", "shut bit", "shut section", "shut stretch", "shut piece", "shut end", "barred half", "barred part", "barred bit", "barred section", "barred stretch", "sealed off half", "sealed off part", "sealed off bit", "sealed off section",
    "sealed off stretch", "part that is closed", "half that is closed", "bit that is closed", "section that is closed", "stretch that is closed", "part thats closed", "half thats closed", "bit thats closed", "section thats closed", "stretch thats closed",
    "part that is blocked", "half that is blocked", "bit that is blocked", "section that is blocked", "stretch that is blocked", "part thats blocked", "half thats blocked", "bit thats blocked", "section thats blocked", "stretch thats blocked"]);
/// What says nothing more.
#[rustfmt::skip]
const NOISE: &Phrases = &Phrases::of(&["to", "traffic", "for", "on", "onto", "from", "again", "please", "is", "be", "should be", "must be",
    "should", "must", "down", "make", "now", "let", "cars", "all", "up", "and", "the", "of", "to traffic", "to all traffic",
    "to cars", "for traffic", "for cars", "has to be", "needs to be", "shall be", "i want", "we want", "to be", "allowed",
    "vehicles", "along", "in", "any more", "anymore", "any longer", "completely", "entirely", "off", "can you", "could you",
    "would you", "id like", "i would like", "lets", "let us", "there should be", "there must be", "there shall be", "both ways",
    "through", "temporarily", "just", "are", "have", "into", "get", "it is", "time", "its time to", "keep", "declare",
    "every car", "at once", "immediately", "right away", "stretch", "today", "will be", "so that", "ought to be", "from now on",
    "was", "were", "closed half", "closed part", "closed bit", "closed section", "half", "part of", "part", "section of", "bit of",
    "this", "that", "there", "until further notice", "for good", "for the moment", "for now", "for a while", "for the time being",
    "both directions", "in both directions", "want", "we", "i", "would like", "see", "high", "what if", "if", "were to be", "a", "turn", "goes", "go", "gets", "becomes", "become", "been", "tomorrow", "tonight", "this week", "this weekend", "for the day", "for today", "for the weekend", "for the parade", "for the market", "for the festival", "for the race", "for the marathon", "for the party", "for the event", "it", "please can", "needs", "need", "has", "with", "whole", "entire", "thing", "drivers", "driver", "my", "ok", "so", "right", "by", "at", "can", "may", "will", "id", "like", "love", "us", "in its whole length", "in its entire length", "on its whole length", "over its whole length", "along its whole length", "in full", "from end to end", "in whole", "all the way", "were to"]);

/// Which way a sentence goes.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Key {
    Says(Passage),
    Nothing,
}

impl Reader<'_> {
    /// A wish about streets alone, if every word up to the end is about it.
    pub(super) fn passage(&self, end: usize) -> Option<Wish> {
        let end = self.before_politeness(self.at, end);
        if longest_phrase(&self.lexemes[self.at..end], &["if", "unless", "when", "whenever", "once", "until"])
            .is_some()
        {
            return None;
        }
        // "Mill Lane was closed" tells what was.
        let was = |at: usize| {
            matches!(self.word(at), Some("was" | "were" | "been"))
                && matches!(self.word(at + 1), Some("closed" | "shut" | "blocked" | "barred"))
                // "Has been shut long enough".
                && longest_phrase(&self.lexemes[at + 1..end], OPEN).is_none()
        };
        // "They closed Mill Lane last year" tells, and asks for nothing.
        let they = longest_phrase(
            &self.lexemes[self.at..end],
            &[
                "they",
                "theyve",
                "they have",
                "somebody",
                "someone",
                "he",
                "she",
                "the council",
                "the city",
                "the police",
                "because they",
                "since they",
            ],
        );
        let closed = they.is_some_and(|words| {
            matches!(
                self.word(self.at + words),
                Some("closed" | "shut" | "blocked" | "barred" | "opened" | "reopened")
            )
        });
        let behind_them = self.at > 0
            && matches!(self.word(self.at - 1), Some("they" | "theyve" | "somebody" | "someone"))
            && matches!(self.word(self.at), Some("closed" | "shut" | "blocked" | "barred" | "opened"));
        if closed || behind_them || (self.at..end).any(was) {
            return None;
        }
        for cut in self.at..end {
            let Some((first, mut at)) = self.street_ref(cut, end) else { continue };
            let mut which = vec![first];
            while let Some(words) = at.checked_sub(0).and_then(|at| joint(&self.lexemes[at..end]))
                && let Some((next, after)) = self.street_ref(at + words, end)
            {
                which.push(next);
                at = after;
            }
            let (Some(before), Some(behind)) = (self.keys(self.at, cut), self.keys(at, end)) else {
                continue;
            };
            match (before, behind) {
                (Key::Says(one), Key::Says(other)) if one != other => {}
                (Key::Says(passage), _) | (Key::Nothing, Key::Says(passage)) => {
                    return Some(Wish::Passage { which, passage });
                }
                _ => {}
            }
        }
        None
    }

    /// What the words say about streets; `None` if a word is about something else.
    fn keys(&self, start: usize, end: usize) -> Option<Key> {
        let (mut at, mut key) = (start, Key::Nothing);
        while at < end {
            let rest = &self.lexemes[at..end];
            if matches!(rest[0].token, Token::Comma | Token::Break) {
                at += 1;
                continue;
            }
            let closes = longest_phrase(rest, CLOSING).max(longest_phrase(rest, CLOSED)).unwrap_or(0);
            let opens = longest_phrase(rest, OPENING).max(longest_phrase(rest, OPEN)).unwrap_or(0);
            let noise = longest_phrase(rest, NOISE).max(longest_phrase(rest, PIECE_THAT_IS)).unwrap_or(0);
            let noise = noise.max(self.polite_at(at).min(end - at));
            let most = closes.max(opens).max(noise);
            if most == 0 {
                return None;
            }
            if most > noise || noise == closes || noise == opens {
                let passage = if closes >= opens { Passage::Closed } else { Passage::Open };
                if key != Key::Nothing && key != Key::Says(passage) {
                    return None;
                }
                key = Key::Says(passage);
            }
            at += most;
        }
        Some(key)
    }

    /// A street that is named or described from here on, and where that ends.
    pub(super) fn street_ref(&self, at: usize, end: usize) -> Option<(StreetRef, usize)> {
        let streets = self.view.streets?;
        let skip = longest_phrase(
            &self.lexemes[at..end],
            &["the", "all of", "both", "both of", "the whole of", "the whole"],
        )
        .unwrap_or(0);
        if let Some(found) = self.half_street(at + skip, end) {
            return Some(found);
        }
        if let Some(street) = streets.at(&self.lexemes[at + skip..end]) {
            let after = at + skip + street.words;
            if let Some((compass, after)) = self.half(after, end) {
                return Some((StreetRef::Half(street.roads.to_vec(), compass), after));
            }
            if let Some((compass, cross, after)) = self.beyond(after, end) {
                return Some((StreetRef::Beyond { roads: street.roads.to_vec(), compass, cross }, after));
            }
            let (between, after) = self.crossing_streets(after, end);
            return Some((StreetRef::Named { roads: street.roads.to_vec(), between }, after));
        }
        self.described_street(at, end).or_else(|| self.unknown_street(at, end))
    }

    /// "North of Elm Street", behind a street that crosses it, and where that ends.
    fn beyond(
        &self,
        at: usize,
        end: usize,
    ) -> Option<(super::super::compass::Compass, Vec<simworld_core::id::RoadId>, usize)> {
        let mut parser = self.parser(at, end);
        let compass = parser.compass()?;
        let of = longest_phrase(&self.lexemes[parser.at.min(end)..end], &["of"]);
        let from = parser.at.min(end) + of.unwrap_or(0);
        // Whoever reads directions may have read "of" too.
        let is_of = of.is_some() || self.word(from.checked_sub(1)?) == Some("of");
        let street = self.view.streets?.at(self.lexemes.get(from..end)?).filter(|_| is_of)?;
        Some((compass, street.roads.to_vec(), from + street.words))
    }

    /// "The eastern half of Oak Street".
    fn half_street(&self, at: usize, end: usize) -> Option<(StreetRef, usize)> {
        let (compass, after) = self.half(at, end)?;
        let from = after + longest_phrase(&self.lexemes[after..end], &["of the", "of", "on"])?;
        let street = self.view.streets?.at(&self.lexemes[from..end])?;
        Some((StreetRef::Half(street.roads.to_vec(), compass), from + street.words))
    }

    /// "At the west end", "eastern half", and where that ends.
    fn half(&self, at: usize, end: usize) -> Option<(super::super::compass::Compass, usize)> {
        let mut parser = self.parser(at, end);
        parser.eat_any(&["at its", "at the", "on its", "on the", "at"]);
        let start = parser.at;
        parser.eat_any(&["the"]);
        let compass = if let Some(compass) = parser.compass_of_part() {
            compass
        } else {
            parser.at = start;
            parser.compass()?
        };
        parser
            .eat_any(&[
                "half",
                "part",
                "end",
                "bit",
                "section",
                "stretch",
                "piece",
                "side",
                "portion",
                "most half",
            ])
            .then_some((compass, parser.at))
    }

    /// "Between Harbour Road and Station Road".
    fn crossing_streets(
        &self,
        at: usize,
        end: usize,
    ) -> (Option<[Vec<simworld_core::id::RoadId>; 2]>, usize) {
        let found = || {
            let streets = self.view.streets?;
            // "Close Oak Street to traffic between Harbour Road and Station Road".
            let from = at + longest_phrase(&self.lexemes[at..end], TRAFFIC).unwrap_or(0);
            let from = from + longest_phrase(&self.lexemes[from..end], &["between", "from"])?;
            let one = streets.in_short(&self.lexemes[from..end])?;
            let mut next = from + one.words;
            next += longest_phrase(&self.lexemes[next..end], &["and", "to", "up to"])?;
            let other = streets.in_short(&self.lexemes[next..end])?;
            Some(([one.roads.to_vec(), other.roads.to_vec()], next + other.words))
        };
        found().map_or((None, at), |(both, after)| (Some(both), after))
    }

    /// "The road in front of the museum", "the nearest street", "all the roads around the museum", "it".
    fn described_street(&self, start: usize, end: usize) -> Option<(StreetRef, usize)> {
        #[rustfmt::skip]
        const BEFORE: &[&str] = &["the", "that", "this", "all the", "all", "every", "all of the", "any", "whatever", "a"];
        const STREETS: &[&str] = &["road", "street", "roads", "streets", "lane", "lanes", "carriageway"];
        const PARTS: &[&str] = &["part", "bit", "stretch", "section", "piece", "half"];
        #[rustfmt::skip]
        const RUNS: &[&str] = &["that runs", "which runs", "running", "that is", "that goes", "that passes", "which is", "that leads",
            "right", "directly", "just", "that are", "which are", "passing", "going"];
        let phrase = |at: usize, phrases: &[&str]| longest_phrase(&self.lexemes[at.min(end)..end], phrases);
        let is_it = |words: usize| start + words == end || joint(&self.lexemes[start + words..end]).is_some();
        if let Some(words) = phrase(start, &["it", "them", "that one", "that street", "that road"])
            .filter(|words| is_it(*words))
        {
            return Some((StreetRef::It, start + words));
        }
        let every = phrase(
            start,
            &[
                "all streets",
                "all the streets",
                "all roads",
                "all the roads",
                "every street",
                "every road",
                "all closed streets",
                "all the closed streets",
            ],
        );
        if let Some(words) = every.filter(|words| is_it(*words))
            && (0..start).any(|at| matches!(self.word(at), Some("open" | "reopen" | "unblock")))
        {
            return Some((StreetRef::Closed, start + words));
        }
        let mut at = start + phrase(start, BEFORE).unwrap_or(0);
        let nearest = phrase(at, &["nearest", "closest", "nearby"]);
        let closed = phrase(at, &["closed", "blocked", "shut"]);
        at += nearest.or(closed).unwrap_or(0);
        // "The closed part" is what is closed.
        at += phrase(at, STREETS).or_else(|| closed.and_then(|_| phrase(at, PARTS)))?;
        if nearest.is_some() {
            at += phrase(at, &["to me", "here", "from here", "to here"]).unwrap_or(0);
            return Some((StreetRef::Nearest, at));
        }
        if closed.is_some() {
            return Some((StreetRef::Closed, at));
        }
        at += phrase(at, RUNS).unwrap_or(0);
        let (way, words) = longest(&self.lexemes[at.min(end)..end], &WAYS)
            .or(phrase(at, &["past"]).map(|words| (Way::At, words)))?;
        let mut reader = Reader { at: at + words, ..*self };
        let Ok(Anchor::Thing(thing)) = reader.anchor(end) else { return None };
        let street = match way {
            Way::To(relation) => StreetRef::To(relation, thing),
            Way::Around => StreetRef::Around(thing),
            Way::At | Way::Along | Way::On | Way::Edge => StreetRef::To(Relation::NextTo, thing),
            _ => return None,
        };
        Some((street, reader.at))
    }

    /// "Pine Street", which is not here; or a thing that is no street.
    fn unknown_street(&self, start: usize, end: usize) -> Option<(StreetRef, usize)> {
        #[rustfmt::skip]
        const KINDS: &Phrases = &Phrases::of(&["street", "road", "lane", "avenue", "walk", "boulevard", "alley", "drive", "way", "st", "rd", "ave"]);
        let is_name = |at: usize| {
            self.word(at).is_some_and(|word| {
                longest_phrase(&self.lexemes[at..=at], NOISE).is_none() && !KINDS.contains(word)
            })
        };
        if !is_name(start)
            || longest_phrase(&self.lexemes[start..end], CLOSING)
                .or(longest_phrase(&self.lexemes[start..end], OPENING))
                .is_some()
        {
            return None;
        }
        let last = (start + 1..end.min(start + 4))
            .find(|at| self.word(*at).is_some_and(|word| KINDS.contains(word)))?;
        // "Use Mill Lane" holds the name of a street that is there.
        let is_known =
            |at: usize| self.view.streets.is_some_and(|streets| streets.at(&self.lexemes[at..end]).is_some());
        (start..last)
            .all(|at| is_name(at) && !is_known(at))
            .then(|| (StreetRef::Unknown(self.written(start, last + 1)), last + 1))
    }
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    CLOSING.iter().chain(OPENING).chain(CLOSED).chain(OPEN).flat_map(|phrase| phrase.split(' '))
}
